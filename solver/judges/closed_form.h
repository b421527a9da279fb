#pragma once
#include <Eigen/Core>
#include <array>

namespace solver {

/// Row per part, column per wavelength.
using Parts = Eigen::ArrayXXd;

/// Form factors of a cube: 0.2 for every pair [Neumann2004], or those of the unit cube in closed
/// form.
struct CubeFactors {
  double opposite = 0.2, adjacent = 0.2;
};

[[nodiscard]] CubeFactors exact_cube_factors();

/// [Neumann2004] eq. 13-16, six faces in the order x0, x1, y0, y1, z0, z1. Exact factors keep a
/// closed form: a face sees its opposite, and of the rest only the sum.
/// @param emission  S >= 0
/// @return radiosities, 6 x wavelengths, in the unit of the emission
/// @throws std::invalid_argument  if a size differs, an emission is negative or not finite, or a
/// reflectance is not in [0, 1)
[[nodiscard]] Parts cube_radiosity(const Parts& emission, const Parts& reflectance,
                                   const CubeFactors& factors = {});

/// A room with a window in the wall at y = 0 and furniture along the three other walls, which makes
/// the lower part of each wall another surface [Neumann2004].
struct BrickShape {
  double width_m = 0, depth_m = 0, height_m = 0;
  double furniture_height = 0;  ///< share of the wall's height, 0 <= share < 1
  double window_width_m = 0, window_height_m = 0, window_sill_m = 0, window_offset_m = 0;
};

/// Form factors between the ten parts (scenes::kBrickParts); row i, column j: F_ij. Rows sum to 1
/// and areas times factors are symmetric, to rounding. Rows of parts without area are zero.
/// @throws std::invalid_argument  if a length is negative or not finite, the room has no volume,
/// or the window leaves its wall
[[nodiscard]] Eigen::Matrix<double, 10, 10> brick_form_factors(const BrickShape& shape);
[[nodiscard]] Eigen::Array<double, 10, 1> brick_areas_m2(const BrickShape& shape);

/// [Neumann2004] 4.3: ten unknowns, the window among them: its reflectance may be above 0.
/// @param emission  S >= 0
/// @return radiosities, 10 x wavelengths, in the unit of the emission
/// @throws std::invalid_argument  as cube_radiosity and brick_form_factors do
[[nodiscard]] Parts brick_radiosity(const BrickShape& shape, const Parts& emission,
                                    const Parts& reflectance);

}  // namespace solver
