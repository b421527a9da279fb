#include "apps/painted_room.h"

#include <algorithm>

namespace apps {

PaintedRoom::PaintedRoom(const RoomRun& run, const solver::RadiosityOptions& options, int paints)
    : run_(run), options_(options), progress_("paints", paints) {}

solver::RoomSolution PaintedRoom::solve(const spectra::Spectrum& paint) {
  solver::RoomSolution solution = solver::solve_room(run_.room, run_.transport, options_, &paint);
  ++solves_;
  not_converged_ += solution.radiosity.converged ? 0 : 1;
  for (const solver::BandReport& band : solution.radiosity.bands) {
    most_iterations_ = std::max(most_iterations_, band.iterations);
  }
  return solution;
}

spectra::ViewedLight PaintedRoom::view(const spectra::Spectrum& paint) {
  const solver::RoomSolution solution = solve(paint);
  progress_.step();
  return solver::viewed_light(run_.room, run_.transport, solution);
}

Json PaintedRoom::record() const {
  return {{"solves", solves_},
          {"not_converged", not_converged_},
          {"most_iterations", most_iterations_}};
}

Seen seen_in_room(const appearance::RoomView& view) {
  return {
      .xyz = view.sample,
      .correlates = appearance::ciecam02_forward(view.sample, appearance::adapt(view.conditions))};
}

Seen seen_on_swatch(const spectra::Spectrum& reflectance) {
  const auto [xyz, correlates] = appearance::on_swatch(reflectance);
  return {.xyz = xyz, .correlates = correlates};
}

}  // namespace apps
