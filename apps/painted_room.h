#pragma once
#include "apps/colour_reports.h"
#include "apps/room_run.h"
#include "apps/terminal.h"

namespace apps {

/// A prepared room that is solved paint by paint; keeps count of what the solver said.
class PaintedRoom {
 public:
  /// `paints` is the number of views expected, for the progress line.
  PaintedRoom(const RoomRun& run, const solver::RadiosityOptions& options, int paints);

  [[nodiscard]] solver::RoomSolution solve(const spectra::Spectrum& paint);

  /// The response that ranking asks for.
  [[nodiscard]] spectra::ViewedLight view(const spectra::Spectrum& paint);

  [[nodiscard]] bool converged() const { return not_converged_ == 0; }

  [[nodiscard]] Json record() const;

 private:
  const RoomRun& run_;
  solver::RadiosityOptions options_;
  Progress progress_;
  int solves_ = 0, not_converged_ = 0, most_iterations_ = 0;
};

[[nodiscard]] Seen seen_in_room(const appearance::RoomView& view);
[[nodiscard]] Seen seen_on_swatch(const spectra::Spectrum& reflectance);

}  // namespace apps
