#include "solver/transport.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <memory>

#include "solver/direct_light.h"

namespace solver {
namespace {

constexpr int kMostPlannedRows = 2000;  ///< rows whose pairs the plan counts
constexpr int kFloatCopies = 8,
              kLightingCopies = 8,  ///< of the same, in double, while light is reduced
    kDoubleCopies = 14;             ///< of patch x band arrays alive at the peak of a solve

/// Seconds of one core, measured on a 2.5 GHz server core: a guide for people, nothing depends on
/// it.
constexpr double kPairSeconds = 1.5e-7, kOccludablePairSeconds = 1.2e-6, kSweepSeconds = 4e-10;
constexpr int kUsualSweeps = 40;

class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(start_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

const scenes::Surface& surface_of(const scenes::Room& room, const scenes::PatchMesh& mesh,
                                  int patch) {
  return room.surfaces[static_cast<std::size_t>(mesh.surface[static_cast<std::size_t>(patch)])];
}

std::vector<bool> lamp_patches(const scenes::Room& room, const scenes::PatchMesh& mesh) {
  std::vector<bool> lamp;
  for (int p = 0; p < mesh.size(); ++p) {
    lamp.push_back((surface_of(room, mesh, p).exitance.values > 0).any());
  }
  return lamp;
}

Bands emission_of(const scenes::Room& room, const scenes::PatchMesh& mesh) {
  Bands emission(mesh.size(), room.grid.count);
  for (int p = 0; p < mesh.size(); ++p) {
    emission.row(p) = surface_of(room, mesh, p).exitance.values.transpose();
  }
  return emission;
}

/// Bands in which anything shines.
int lit_bands(const scenes::Room& room) {
  Eigen::ArrayXd light = Eigen::ArrayXd::Zero(room.grid.count);
  for (const scenes::Surface& s : room.surfaces) light += s.exitance.values;
  for (const scenes::PointLight& p : room.point_lights) light += p.spectral_flux.values;
  for (const scenes::Sun& s : room.suns) light += s.normal_irradiance.values;
  return static_cast<int>((light > 0).count());
}

/// A lower estimate from the surfaces alone, before a mesh of any size is made.
double estimated_patches(const scenes::Room& room, double patch_m) {
  double area = 0;
  for (std::size_t i = 0; i < room.plan_m.size(); ++i) {
    const Eigen::Vector2d &p = room.plan_m[i], &q = room.plan_m[(i + 1) % room.plan_m.size()];
    area += (q - p).norm() * room.height_m;  // wall
    area += p.x() * q.y() - p.y() * q.x();   // floor and ceiling, each half of it
  }
  return area / (patch_m * patch_m);
}

double bytes_for(double patches, const scenes::Room& room) {
  const int bands = room.grid.count;
  const double lightings = 1 + static_cast<double>(room.scenarios.size());
  const double padded = std::ceil(bands / 16.0) * 16;
  return patches * patches / 2 * sizeof(float) +
         patches * padded * (kFloatCopies * sizeof(float) + kDoubleCopies * sizeof(double)) +
         patches * bands * lightings * kLightingCopies * sizeof(double) + 2000 * patches;
}

void require_memory(double bytes, std::int64_t limit, double patch_m) {
  if (bytes <= static_cast<double>(limit)) return;
  // Nearly all of it grows as patch_m^-4.
  const double fits_m = patch_m * std::pow(bytes / static_cast<double>(limit), 0.25) * 1.02;
  throw TooLarge(fmt::format(
      "the solve at patch_m {:g} needs {:.3g} GB of memory and {:.3g} GB are free; "
      "patch_m {:.2g} would fit",
      patch_m, bytes * 1e-9, static_cast<double>(limit) * 1e-9, std::ceil(fits_m * 100) / 100));
}

/// The room under each of its lightings: all lights as they are, then the scenarios.
std::vector<scenes::Room> relit_rooms(const scenes::Room& room) {
  std::vector<scenes::Room> rooms{room};
  for (const scenes::Scenario& s : room.scenarios) rooms.push_back(scenes::relit(room, s));
  return rooms;
}

Lighting lighting_of(const scenes::Room& lit, const scenes::PatchMesh& mesh,
                     const std::vector<Facet>& facets, const Visibility& visibility) {
  DirectLight direct = direct_light_on_patches(lit, mesh, facets, visibility);
  return {.emission = emission_of(lit, mesh),
          .direct = std::move(direct.irradiance),
          .direct_scaling = direct.largest_scaling};
}

std::vector<ViewedPoint> default_views(const scenes::Room& room) {
  std::vector<ViewedPoint> views;
  for (std::size_t g = 0; g < std::max<std::size_t>(1, room.paint.size()); ++g) {
    views.push_back(viewed_point(room, g));
  }
  return views;
}

void count_pairs(const scenes::PatchMesh& mesh, const Visibility& visibility, Plan& plan) {
  const std::size_t n = mesh.polygon.size(), step = n / kMostPlannedRows + 1;
  std::int64_t pairs = 0, occludable = 0;
  for (std::size_t i = 0; i < n; i += step) {
    for (std::size_t j = 0; j < n; ++j) {
      const Eigen::Vector3d r = mesh.centre[j] - mesh.centre[i];
      if (mesh.normal[i].dot(r) <= 0 || mesh.normal[j].dot(r) >= 0) continue;
      ++pairs;
      if (!visibility.unobstructed() &&
          visibility.may_block(static_cast<int>(i), static_cast<int>(j)))
        ++occludable;
    }
  }
  const auto scale = static_cast<std::int64_t>(step);
  plan.pairs = pairs * scale / 2;
  plan.occludable_pairs = occludable * scale / 2;
}

Plan plan_with(const scenes::Room& room, const scenes::PatchMesh& mesh,
               const Visibility& visibility) {
  Plan plan{.patches = mesh.size(), .bands = lit_bands(room)};
  count_pairs(mesh, visibility, plan);
  plan.memory_bytes = static_cast<std::int64_t>(bytes_for(mesh.size(), room));
  const double n = mesh.size();
  plan.expected_seconds = kPairSeconds * static_cast<double>(plan.pairs) +
                          kOccludablePairSeconds * static_cast<double>(plan.occludable_pairs) +
                          kUsualSweeps * kSweepSeconds * n * n * std::ceil(plan.bands / 16.0);
  const std::int64_t all_pairs = std::int64_t{mesh.size()} * (mesh.size() - 1) / 2;
  plan.left_out.push_back({fmt::format("{} of {} pairs", all_pairs - plan.pairs, all_pairs),
                           "the patches lie in one plane or turn their backs to each other"});
  if (visibility.unobstructed()) {
    plan.left_out.push_back(
        {"visibility", "an empty convex room: nothing can stand between two patches"});
  } else {
    plan.left_out.push_back(
        {fmt::format("rays for {} of {} pairs", plan.pairs - plan.occludable_pairs, plan.pairs),
         "no furniture and no wall can stand between them"});
  }
  if (plan.bands < room.grid.count) {
    plan.left_out.push_back(
        {fmt::format("{} of {} bands", room.grid.count - plan.bands, room.grid.count),
         "no lamp shines in them"});
  }
  return plan;
}

}  // namespace

void set_threads(int threads) {
  if (threads < 1) throw std::invalid_argument(fmt::format("{} threads; want 1 or more", threads));
  static std::unique_ptr<tbb::global_control> control;
  control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                  static_cast<std::size_t>(threads));
}

std::int64_t available_memory_bytes() {
  std::ifstream file("/proc/meminfo");
  std::string word;
  while (file >> word) {
    std::int64_t kilobytes = 0;
    if (word == "MemAvailable:" && file >> kilobytes) return kilobytes * 1024;
  }
  return std::int64_t{4} << 30;  // a system that does not say is taken to have 4 GB
}

Plan make_plan(const scenes::Room& room, const scenes::PatchMesh& mesh) {
  return plan_with(room, mesh, Visibility(room, mesh));
}

RoomTransport prepare_transport(const scenes::Room& room, const TransportOptions& options) {
  const double patch_m = options.patch_m > 0 ? options.patch_m : room.patch_m;
  const std::int64_t limit =
      options.memory_limit_bytes > 0 ? options.memory_limit_bytes : available_memory_bytes();
  require_memory(bytes_for(estimated_patches(room, patch_m), room), limit, patch_m);

  Stopwatch watch;
  RoomTransport t;
  t.mesh = scenes::mesh_room(room, patch_m);
  t.seconds["mesh"] = watch.lap();
  const Visibility visibility(room, t.mesh);
  t.plan = plan_with(room, t.mesh, visibility);
  require_memory(static_cast<double>(t.plan.memory_bytes), limit, patch_m);
  t.seconds["plan"] = watch.lap();

  const std::vector<bool> lamp = lamp_patches(room, t.mesh);
  t.exchange = compute_exchange(
      t.mesh, visibility, {.lamp = lamp, .rays = options.rays, .lamp_rays = options.lamp_rays});
  t.closure_defect = t.exchange.closure_defect;
  t.reciprocity_defect = t.exchange.reciprocity_defect;
  t.largest_scaling = t.exchange.largest_scaling;
  if (!t.exchange.isolated.empty()) {
    t.plan.left_out.push_back(
        {fmt::format("{} patches", t.exchange.isolated.size()), "they see nothing"});
  }
  t.seconds["exchange"] = watch.lap();

  const std::vector<Facet> facets = facets_of(t.mesh);
  const std::vector<scenes::Room> lit = relit_rooms(room);
  for (const scenes::Room& r : lit) {
    t.lightings.push_back(lighting_of(r, t.mesh, facets, visibility));
  }
  for (std::size_t s = 0; s < room.scenarios.size(); ++s) {
    t.lightings[s + 1].name = room.scenarios[s].name;
  }
  const GatherOptions gather{
      .lamp = lamp, .lamp_error = options.visibility_error, .rays = options.rays};
  const auto row = [&](const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
    ReceiverRow r{.gather = gather_at_point(point, normal, t.mesh, facets, visibility, gather)};
    for (const scenes::Room& l : lit) {
      r.direct.push_back(direct_light_at_point(l, point, normal, visibility));
    }
    return r;
  };
  t.receivers.resize(room.receivers.size());
  tbb::parallel_for(std::size_t{0}, room.receivers.size(), [&](std::size_t k) {
    const scenes::Receiver& r = room.receivers[k];
    t.receivers[k] = row(r.at_m, r.normal.normalized());
  });
  for (const ViewedPoint& at : options.views.empty() ? default_views(room) : options.views) {
    t.viewed.push_back({.at = at,
                        .row = row(at.point_m, at.normal),
                        .view = view_rows(at.eye_m, at.point_m, t.mesh)});
  }
  t.seconds["gather"] = watch.lap();
  return t;
}

}  // namespace solver
