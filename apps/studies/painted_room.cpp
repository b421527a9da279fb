#include "apps/studies/painted_room.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace apps {
namespace {

std::vector<spectra::LitRoom> lightings_of(const scenes::Room& room) {
  if (room.scenarios.empty()) return {{}};
  std::vector<spectra::LitRoom> lightings;
  for (const scenes::Scenario& s : room.scenarios) {
    lightings.push_back({.name = s.name, .weight = s.weight});
  }
  return lightings;
}

/// The paint that each group has now; none if surfaces of a group differ.
std::vector<spectra::Spectrum> present_paints(const scenes::Room& room) {
  std::vector<spectra::Spectrum> paints;
  for (const scenes::PaintTask& group : room.paint) {
    const auto reflectance = [&](int s) -> const spectra::Spectrum& {
      return room.surfaces[static_cast<std::size_t>(s)].reflectance;
    };
    paints.push_back(reflectance(group.surfaces.front()));
    for (const int s : group.surfaces) {
      if ((reflectance(s).values != paints.back().values).any()) return {};
    }
  }
  return paints;
}

}  // namespace

PaintedRoom::PaintedRoom(RoomRun& run, const RankOptions& options, const std::filesystem::path& out,
                         double highest_reflectance)
    : run_(run),
      options_(options),
      out_(out),
      file_(options.response.empty() ? out / "response.json"
                                     : std::filesystem::path(options.response)),
      key_(response_key(run.room, options.room)) {
  require_writable(out);
  if (file_.has_parent_path()) require_writable(file_.parent_path());
  require_free_for_response(file_);
  if (auto known = load_response(file_, key_);
      known && known->front().room.highest_reflectance >= highest_reflectance) {
    meshes_ = std::move(*known);
    loaded_ = true;
    run_.clock.stop("response");
    return;
  }
  need_transport();
  reduce(highest_reflectance);
}

void PaintedRoom::reduce(double highest_reflectance) {
  solver::ReductionOptions reduction{.highest_reflectance = highest_reflectance};
  meshes_.push_back(solver::reduce_views(run_.room, run_.transport, reduction));
  run_.clock.stop("response");
  reduction.relative_error = 1e-3;  // of what is itself a small difference
  reduction.solver_error = 1e-6;
  solver::TransportOptions longer = transport_options(run_, options_.room, out_);
  const double patch_m = longer.patch_m > 0 ? longer.patch_m : run_.room.patch_m;
  const int patches = run_.transport.mesh.size();
  for (const double factor : {2.0, 4.0}) {
    longer.patch_m = factor * patch_m;
    const solver::RoomTransport transport = solver::prepare_transport(run_.room, longer);
    if (transport.mesh.size() == patches && factor == 2) break;  // nothing can be told
    meshes_.push_back(solver::reduce_views(run_.room, transport, reduction));
  }
  run_.clock.stop("response on longer patches");
}

std::vector<std::vector<spectra::LitRoom>> PaintedRoom::rooms_of_longer_patches() const {
  std::vector<std::vector<spectra::LitRoom>> rooms;
  for (std::size_t k = 1; k < meshes_.size(); ++k) {
    rooms.push_back(lit_rooms(run_.room, meshes_[k]));
  }
  return rooms;
}

void PaintedRoom::need_transport() {
  if (prepared_) return;
  prepare(run_, options_.room, out_);
  prepared_ = true;
}

std::vector<spectra::LitRoom> PaintedRoom::lightings() const { return lightings_of(run_.room); }

std::vector<spectra::LitRoom> PaintedRoom::rooms(
    int varying, int viewed, const std::vector<spectra::Spectrum>& paints) const {
  return lit_rooms(run_.room, views(), varying, viewed, paints);
}

std::vector<spectra::RoomResponseSlope> PaintedRoom::slopes(
    int varying, int viewed, const std::vector<spectra::Spectrum>& paints) const {
  const auto response =
      std::make_shared<const solver::RoomResponse>(views(), varying, viewed, paints);
  std::vector<spectra::RoomResponseSlope> slopes;
  for (std::size_t l = 0; l < response->lightings(); ++l) {
    slopes.emplace_back(
        [response, l](const spectra::Spectrum& paint) { return response->slope(paint, l); });
  }
  return slopes;
}

std::vector<spectra::LitRoom> PaintedRoom::solved_rooms() {
  std::vector<spectra::LitRoom> rooms = lightings();
  for (std::size_t l = 0; l < rooms.size(); ++l) {
    rooms[l].view = [this, l](const spectra::Spectrum& paint) {
      return solver::viewed_light(run_.room, run_.transport, solve({paint}, l));
    };
  }
  return rooms;
}

solver::RoomSolution PaintedRoom::solve(const std::vector<spectra::Spectrum>& paints,
                                        std::size_t lighting) {
  need_transport();
  const std::size_t first_scenario = run_.room.scenarios.empty() ? 0 : 1;
  solver::RoomSolution solution =
      solver::solve_room(run_.room, run_.transport, options_.room.radiosity,
                         {.lighting = first_scenario + lighting, .paints = paints});
  ++solves_;
  not_converged_ += solution.radiosity.converged ? 0 : 1;
  return solution;
}

spectra::ViewedLight PaintedRoom::as_painted(int group) {
  const std::vector<spectra::Spectrum> now = present_paints(run_.room);
  const bool known = std::ranges::all_of(now, [&](const spectra::Spectrum& paint) {
    return (paint.values <= views().room.highest_reflectance).all();
  });
  if (!now.empty() && known) {
    return rooms(group, group, now).front().view(now[static_cast<std::size_t>(group)]);
  }
  const solver::RoomSolution solution = solve({}, 0);
  return solver::viewed_light(run_.room, run_.transport, solution, static_cast<std::size_t>(group));
}

bool PaintedRoom::converged() const { return not_converged_ == 0 && views().room.converged; }

Json PaintedRoom::record() const {
  const solver::ReducedRoom& room = views().room;
  std::size_t vectors = 0;
  for (const auto& t : room.transfers) vectors = std::max(vectors, t.group.size());
  return {{"file", file_.string()},
          {"key", key_},
          {"loaded", loaded_},
          {"solves", room.solves},
          {"held_out_solves", room.held_out},
          {"largest_relative_error", room.largest_error},
          {"highest_reflectance", room.highest_reflectance},
          {"basis_vectors", vectors},
          {"converged", room.converged},
          {"full_solves", solves_},
          {"full_solves_not_converged", not_converged_}};
}

std::vector<OutputFile> PaintedRoom::files() const {
  if (loaded_) return {};
  return {response_file(file_, key_, meshes_)};
}

std::vector<spectra::LitRoom> lit_rooms(const scenes::Room& room, const solver::ReducedViews& views,
                                        int varying, int viewed,
                                        const std::vector<spectra::Spectrum>& paints) {
  const auto response =
      std::make_shared<const solver::RoomResponse>(views, varying, viewed, paints);
  std::vector<spectra::LitRoom> rooms = lightings_of(room);
  for (std::size_t l = 0; l < rooms.size(); ++l) {
    rooms[l].view = [response, l](const spectra::Spectrum& paint) {
      return response->light(paint, l);
    };
  }
  return rooms;
}

}  // namespace apps
