#pragma once
#include <Eigen/Core>
#include <string_view>
#include <vector>

namespace scenes {

/// Which half planes C stand for others.
enum class PlaneSymmetry {
  none,
  round,         ///< one plane is all
  about_0_180,   ///< I(C) = I(-C)
  about_90_270,  ///< I(C) = I(180 - C)
  both,
};

/// "round", "mirrored in the plane 0-180"
[[nodiscard]] std::string_view to_string(PlaneSymmetry symmetry);

/// A row of intensities for each half plane.
struct HalfPlanes {
  std::vector<double> angle_deg;
  Eigen::ArrayXXd intensity_cd;  ///< angle x gamma
};

/// All planes from 0 to 360, rising, both ends included. A plane 360 that is stored stays as it is;
/// else it is plane 0.
/// @param stored  at least one plane; angles in any order, 0..360
[[nodiscard]] HalfPlanes all_around(const HalfPlanes& stored, PlaneSymmetry symmetry);

/// Angles from 0 up, mirrored to both sides of 0.
[[nodiscard]] HalfPlanes both_sides(const HalfPlanes& stored);

}  // namespace scenes
