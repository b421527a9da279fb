#pragma once
#include <string>
#include <vector>

#include "apps/commands/commands.h"
#include "apps/pictures/room_image.h"
#include "apps/run/room_run.h"
#include "paints/ranking.h"
#include "solver/sensors/camera.h"

namespace apps {

/// Paints of all groups, and what is written below a picture with them.
struct BestPaints {
  std::vector<spectra::Spectrum> paints;
  std::string caption;
};

/// The paints that come nearest to the wish.
struct PaintSearch {
  std::vector<BestPaints> best;
  std::vector<paints::Target> wishes;  ///< of each group
  bool converged = true;
  Json record;
  std::vector<OutputFile> files;  ///< the room response
};

/// @param run  with the room's own views
/// @throws spectra::InputError  if a group has no target
[[nodiscard]] PaintSearch search_paints(RoomRun run, const PictureCommand& command,
                                        std::size_t count);

/// The light that a picture is taken in, of the room's run, and the eye that is there.
struct LitPicture {
  solver::RoomSolution solution;
  appearance::RoomView view;
};

/// Solves a room on the run's transport. @param room  the run's, painted anew
/// @throws spectra::InputError  if there is no light to view it by
[[nodiscard]] LitPicture lit_picture(const RoomRun& run, const scenes::Room& room,
                                     const PictureCommand& command);

/// Now, as wished and in the best paints, side by side. @param best  seen.png
[[nodiscard]] PngPicture before_after(const RoomRun& run, const scenes::Room& before,
                                      const solver::Camera& camera,
                                      const solver::PictureOptions& options, const PngPicture& best,
                                      const PaintSearch& search, const appearance::Display& display,
                                      const PictureCommand& command, int threads);

/// The room in each of the best paints, as the eye sees it that is adapted to it.
/// @param camera  of a picture that is small
[[nodiscard]] PngPicture contact_sheet(const RoomRun& run, const PaintSearch& search,
                                       const solver::Camera& camera,
                                       const solver::PictureOptions& options,
                                       const PictureCommand& command, int threads);

}  // namespace apps
