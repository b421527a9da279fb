#pragma once
#include <string>

#include "scenes/room.h"
#include "scenes/shapes/bodies.h"
#include "scenes/shapes/roof.h"

namespace scenes {

/// Makes rooms in code. Nothing is checked; surfaces are registered as they are added, so add
/// openings before panels and panels before furniture.
class RoomBuilder {
 public:
  /// A prism.
  /// @param reflectance  of all surfaces but openings and panels, which are black
  /// @throws std::invalid_argument  if the plan is not counter-clockwise, or the height not above 0
  RoomBuilder(const Polygon& plan_m, double height_m, double reflectance = 0.5,
              const spectra::Grid& grid = spectra::kTransportGrid);

  /// Under planes of which the lowest counts.
  RoomBuilder(const Polygon& plan_m, const std::vector<RoofPlane>& planes, double reflectance = 0.5,
              const spectra::Grid& grid = spectra::kTransportGrid);

  /// A room of any shape; its surfaces, all walls, are named face_1, face_2, ...
  explicit RoomBuilder(std::vector<ShellFace> shell, double reflectance = 0.5,
                       const spectra::Grid& grid = spectra::kTransportGrid);

  /// @param wall  from 0; low_m: along the wall and up
  RoomBuilder& opening(int wall, const Eigen::Vector2d& low_m, const Eigen::Vector2d& size_m,
                       double transmittance = 1);
  RoomBuilder& panel(int face, const Eigen::Vector2d& centre_m, const Eigen::Vector2d& size_m);
  RoomBuilder& box(const Eigen::Vector3d& min_m, const Eigen::Vector3d& max_m,
                   double rotate_z_deg = 0);
  RoomBuilder& body(Body body);

  RoomBuilder& patches(double patch_m) {
    room_.patch_m = patch_m;
    return *this;
  }

  [[nodiscard]] const Room& room() const { return room_; }

 private:
  /// The first face of a surface.
  [[nodiscard]] int face_of(int surface) const;
  void add(std::string name, SurfaceKind kind, std::size_t index = 0);

  Room room_;
  double reflectance_;
};

/// A rectangle with its corner in the origin.
[[nodiscard]] Polygon rectangular_plan(double width_m, double depth_m);

}  // namespace scenes
