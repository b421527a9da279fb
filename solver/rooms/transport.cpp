#include "solver/rooms/transport.h"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>

#include "solver/bounce/repeated_bands.h"
#include "solver/exchange/exchange.h"
#include "solver/rooms/mesh_choice.h"
#include "solver/sources/direct_light.h"

namespace solver {
namespace {

using Eigen::ArrayXd;

constexpr int kMostPlannedRows = 2000;  ///< rows whose pairs the plan counts
/// Seconds of one core, measured on a 2.5 GHz server core: a guide for people, nothing depends on
/// it.
constexpr double kPairSeconds = 1.5e-7, kOccludablePairSeconds = 1.2e-6, kSweepSeconds = 4e-10,
                 kFinePatchSeconds = 4e-4;
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

/// Lamps have no slopes: what shines is even on a patch.
Bands emission_of(const scenes::Room& room, const scenes::PatchMesh& mesh, int modes) {
  Bands emission = Bands::Zero(Eigen::Index{modes} * mesh.size(), room.grid.count);
  for (int p = 0; p < mesh.size(); ++p) {
    emission.row(p) = surface_of(room, mesh, p).exitance.values.transpose();
  }
  return emission;
}

/// Every spectrum that shines, a row each.
Bands lights_of(const scenes::Room& room) {
  std::vector<const spectra::Spectrum*> all;
  for (const scenes::Surface& s : room.surfaces) all.push_back(&s.exitance);
  for (const scenes::PointLight& p : room.point_lights) all.push_back(&p.spectral_flux);
  for (const scenes::Sun& s : room.suns) all.push_back(&s.normal_irradiance);
  for (const scenes::PlacedLuminaire& l : room.luminaires) all.push_back(&l.spectral_flux);
  const auto count = static_cast<Eigen::Index>(all.size());
  const auto skies = static_cast<Eigen::Index>(room.skies.size());
  Bands lights(count + skies, room.grid.count);
  for (Eigen::Index k = 0; k < count; ++k) {
    lights.row(k) = all[static_cast<std::size_t>(k)]->values.transpose();
  }
  for (Eigen::Index k = 0; k < skies; ++k) {
    const scenes::Sky& sky = room.skies[static_cast<std::size_t>(k)];
    lights.row(count + k) =
        sky.cd_m2 * sky.scale * sky.components.rowwise().sum().transpose().array();
  }
  return lights;
}

/// Bands in which anything shines, and of those the ones that do not repeat an earlier one.
struct BandCounts {
  int lit = 0, distinct = 0;
};

BandCounts count_bands(const scenes::Room& room) {
  const Bands lights = lights_of(room);
  Bands reflectances(static_cast<Eigen::Index>(room.surfaces.size()), room.grid.count);
  for (std::size_t s = 0; s < room.surfaces.size(); ++s) {
    reflectances.row(static_cast<Eigen::Index>(s)) =
        room.surfaces[s].reflectance.values.transpose();
  }
  std::vector<Eigen::Index> bands;
  for (Eigen::Index b = 0; b < lights.cols(); ++b) {
    if ((lights.col(b) > 0).any()) bands.push_back(b);
  }
  const auto lit = static_cast<int>(bands.size());
  const auto repeats = static_cast<int>(take_repeated_bands(lights, reflectances, bands).size());
  return {.lit = lit, .distinct = lit - repeats};
}

/// The room under each of its lightings: all lights as they are, then the scenarios.
std::vector<scenes::Room> relit_rooms(const scenes::Room& room) {
  std::vector<scenes::Room> rooms{room};
  for (const scenes::Scenario& s : room.scenarios) rooms.push_back(scenes::relit(room, s));
  return rooms;
}

Lighting lighting_of(const scenes::Room& lit, const DirectSources& sources,
                     const scenes::PatchMesh& mesh, const std::vector<Facet>& facets,
                     const std::vector<SlopeBasis>& bases) {
  DirectLight direct = sources.on_patches(mesh, facets, bases);
  return {.emission = emission_of(lit, mesh, bases.empty() ? 1 : SlopeBasis::kModes),
          .direct = std::move(direct.irradiance),
          .direct_scaling = direct.largest_scaling()};
}

/// What a row of means over directions has of the sky in openings, pi times radiance.
ArrayXd seen_sky(const GatherRow& row, const Eigen::Vector3d& eye_m, const scenes::Room& room,
                 const scenes::PatchMesh& mesh, const DirectSources& sources) {
  ArrayXd sum = ArrayXd::Zero(room.grid.count);
  if (!sources.has_skies()) return sum;
  for (int p = 0; p < mesh.size(); ++p) {
    const auto i = static_cast<std::size_t>(p);
    if (surface_of(room, mesh, p).kind != scenes::SurfaceKind::opening || row.weights[p] == 0) {
      continue;
    }
    for (const QuadraturePoint& at : quadrature(mesh.polygon[i], 2)) {
      sum += row.weights[p] * at.weight_m2 / mesh.area_m2[i] * std::numbers::pi *
             sources.radiance(eye_m, at.position, mesh.surface[i]);
    }
  }
  return sum;
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

double sweep_seconds(int patches, int bands) {
  return kUsualSweeps * kSweepSeconds * patches * patches * std::ceil(bands / 16.0);
}

/// What is left out of the pairs, of their rays, and of the bands.
std::vector<Omission> omissions(const scenes::Room& room, const Plan& plan, bool unobstructed,
                                const std::string& why_coarse) {
  std::vector<Omission> all;
  const std::int64_t n = plan.patches, pairs = n * (n - 1) / 2;
  all.push_back({fmt::format("{} of {} pairs", pairs - plan.pairs, pairs),
                 "the patches lie in one plane or turn their backs to each other",
                 kPairSeconds * static_cast<double>(pairs - plan.pairs)});
  const std::int64_t free_pairs = plan.pairs - plan.occludable_pairs;
  const double rays_saved = kOccludablePairSeconds * static_cast<double>(free_pairs);
  if (unobstructed) {
    all.push_back(
        {"visibility", "an empty convex room: nothing can stand between two patches", rays_saved});
  } else {
    all.push_back({fmt::format("rays for {} of {} pairs", free_pairs, plan.pairs),
                   "no furniture and no wall can stand between them", rays_saved});
  }
  const int dark = room.grid.count - plan.bands, repeats = plan.bands - plan.solved_bands;
  const auto saved = [&](int more, int fewer) {
    return sweep_seconds(plan.patches, more) - sweep_seconds(plan.patches, fewer);
  };
  if (dark > 0) {
    all.push_back({fmt::format("{} of {} bands", dark, room.grid.count), "no lamp shines in them",
                   saved(room.grid.count, plan.bands)});
  }
  if (repeats > 0) {
    all.push_back({fmt::format("{} of {} bands", repeats, room.grid.count),
                   "same reflectances as another band, and its light times a factor",
                   saved(plan.bands, plan.solved_bands)});
  }
  if (plan.fine.patch_m > 0) {
    const double pairs_of_fine = 0.5 * std::pow(static_cast<double>(plan.fine.patches), 2);
    all.push_back({fmt::format("exchange areas of about {} patches", plan.fine.patches),
                   fmt::format("{}; {} coarse patches are solved, and rays gather their light",
                               why_coarse, plan.patches),
                   kPairSeconds * pairs_of_fine});
  }
  return all;
}

Plan plan_with(const scenes::Room& room, const MeshChoice& choice, const Visibility& visibility,
               bool skip) {
  const BandCounts bands = count_bands(room);
  Plan plan{.patches = choice.solved.size(),
            .patch_m = choice.patch_m,
            .fine = choice.fine,
            .bands = bands.lit,
            .solved_bands = bands.distinct,
            .memory_bytes = choice.memory_bytes};
  count_pairs(choice.solved, visibility, plan);
  if (skip) {
    plan.left_out = omissions(room, plan, visibility.unobstructed(), choice.reason);
  } else {
    plan.solved_bands = room.grid.count;
  }
  plan.expected_seconds = kPairSeconds * static_cast<double>(plan.pairs) +
                          kOccludablePairSeconds * static_cast<double>(plan.occludable_pairs) +
                          sweep_seconds(plan.patches, plan.solved_bands) +
                          kFinePatchSeconds * static_cast<double>(plan.fine.patches);
  return plan;
}

}  // namespace

void set_threads(int threads) {
  if (threads < 1) throw std::invalid_argument(fmt::format("{} threads; want 1 or more", threads));
  static std::unique_ptr<tbb::global_control> control;
  control = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                  static_cast<std::size_t>(threads));
}

Plan make_plan(const scenes::Room& room, const TransportOptions& options) {
  const MeshChoice choice = choose_mesh(room, options);
  return plan_with(room, choice, Visibility(room, choice.solved, options.skip), options.skip);
}

RoomTransport prepare_transport(const scenes::Room& room, const TransportOptions& options) {
  Stopwatch watch;
  RoomTransport t;
  MeshChoice choice = choose_mesh(room, options);
  t.seconds["mesh"] = watch.lap();
  const Visibility visibility(room, choice.solved, options.skip);
  t.plan = plan_with(room, choice, visibility, options.skip);
  t.mesh = std::move(choice.solved);
  t.seconds["plan"] = watch.lap();

  const std::vector<bool> lamp = lamp_patches(room, t.mesh);
  const std::vector<Facet> facets = facets_of(t.mesh);
  const auto slopes =
      options.light == Light::linear ? std::make_optional<SlopeMoments>(facets) : std::nullopt;
  const std::vector<SlopeBasis> bases = slopes ? slopes->bases() : std::vector<SlopeBasis>();
  t.exchange = compute_exchange(t.mesh, visibility,
                                {.lamp = lamp,
                                 .rays = options.rays,
                                 .lamp_rays = options.lamp_rays,
                                 .skip = options.skip,
                                 .slopes = slopes ? &*slopes : nullptr});
  t.closure_defect = t.exchange.closure_defect;
  t.reciprocity_defect = t.exchange.reciprocity_defect;
  t.largest_scaling = t.exchange.largest_scaling;
  if (!t.exchange.isolated.empty()) {
    t.plan.left_out.push_back(
        {fmt::format("{} patches", t.exchange.isolated.size()), "they see nothing", 0});
  }
  t.seconds["exchange"] = watch.lap();

  std::vector<DirectSources> sources;
  for (const scenes::Room& lit : relit_rooms(room)) {
    sources.emplace_back(lit, visibility);
    t.lightings.push_back(lighting_of(lit, sources.back(), t.mesh, facets, bases));
  }
  for (std::size_t s = 0; s < room.scenarios.size(); ++s) {
    t.lightings[s + 1].name = room.scenarios[s].name;
  }
  const PointGather gather(t.mesh, facets, visibility, slopes ? &*slopes : nullptr);
  const auto row = [&](const Eigen::Vector3d& point, const Eigen::Vector3d& normal) {
    ReceiverRow r{.gather = gather.row(point, normal)};
    for (const DirectSources& s : sources) r.direct.push_back(s.at_point(point, normal));
    return r;
  };
  t.receivers.resize(room.receivers.size());
  tbb::parallel_for(std::size_t{0}, room.receivers.size(), [&](std::size_t k) {
    const scenes::Receiver& r = room.receivers[k];
    t.receivers[k] = row(r.at_m, r.normal.normalized());
  });
  for (const ViewedPoint& at : options.views.empty() ? default_views(room) : options.views) {
    ViewedWall wall{
        .at = at,
        .row = row(at.point_m, at.normal),
        .view = options.eye ? view_rows(at.eye_m, at.point_m, t.mesh, bases) : ViewRows{}};
    for (const DirectSources& s : sources) {
      if (!options.eye) continue;
      wall.sky.push_back({.background = seen_sky(wall.view.background, at.eye_m, room, t.mesh, s),
                          .field = seen_sky(wall.view.field, at.eye_m, room, t.mesh, s)});
    }
    t.viewed.push_back(std::move(wall));
  }
  t.seconds["gather"] = watch.lap();
  return t;
}

}  // namespace solver
