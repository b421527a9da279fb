#pragma once
#include <memory>
#include <vector>

#include "scenes/room.h"
#include "solver/bands.h"
#include "solver/rooms/room_light.h"
#include "solver/sensors/camera.h"
#include "solver/sensors/film.h"

namespace solver {

struct PictureOptions {
  /// Of reflected light at the nodes it is interpolated between: RMS over the bands, relative to
  /// all light there.
  double tolerance = 0.01;
  double coarse_m = 0.6;     ///< triangles with longer edges are halved in any case
  double coarse_pixels = 2;  ///< triangles with shorter edges on the film are not refined
};

/// Whole rows of a picture, pixel by pixel.
struct PictureRows {
  Bands radiance;              ///< W m^-2 sr^-1 nm^-1, box-filtered over each pixel
  Eigen::ArrayXd illuminance;  ///< lx, of what the pixel shows
};

/// What interpolation does to pixels: RMS over the bands, relative to the RMS of the pixel.
struct PictureCheck {
  int pixels = 0;
  double rms = 0, largest = 0, share_above_2_percent = 0;
};

/// A solved room as a camera sees it. Each pixel is the sum over the pieces of surfaces that it
/// shows, exactly as large as they are, of the radiance in the piece's middle: what lamps and
/// windows emit, and what is reflected of their light, which is computed at that very point with
/// exact shadows, and of all light that surfaces reflect. That is gathered from the solution at the
/// nodes of a RefinedField and interpolated.
class RoomPicture {
 public:
  /// All must outlive this. @param solution  in lighting 0, all lights as they are
  RoomPicture(const scenes::Room& room, const RoomTransport& transport,
              const RoomSolution& solution, const Camera& camera,
              const PictureOptions& options = {});
  ~RoomPicture();
  RoomPicture(const RoomPicture&) = delete;
  RoomPicture& operator=(const RoomPicture&) = delete;

  /// The same bits for any number of threads.
  [[nodiscard]] PictureRows rows(int first, int count) const;

  /// Radiance of one pixel, with reflected light gathered at its very points.
  [[nodiscard]] BandRow gathered(int column, int row) const;

  /// Compares with `gathered` at pixels of low discrepancy.
  [[nodiscard]] PictureCheck check(int pixels) const;

  /// Where reflected light was gathered.
  [[nodiscard]] std::size_t nodes() const;
  /// The largest error between nodes where triangles were too small on the film to be halved.
  [[nodiscard]] double largest_left() const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace solver
