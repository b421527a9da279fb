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

/// [Neumann2004] eq. 13-16, six faces in the order x0, x1, y0, y1, z0, z1; exact factors keep a
/// closed form (rank one per pair of opposite faces). @return radiosities, 6 x wavelengths
/// @throws std::invalid_argument  if a size differs or a reflectance is not in [0, 1)
[[nodiscard]] Parts cube_radiosity(const Parts& emission, const Parts& reflectance,
                                   const CubeFactors& factors = {});

struct BrickShape {
  double width_m = 0, depth_m = 0, height_m = 0;
  double furniture_height = 0;  ///< share of the wall's height
  double window_width_m = 0, window_height_m = 0, window_sill_m = 0, window_offset_m = 0;
};

/// Form factors between the ten parts (scenes::kBrickParts); row i, column j: F_ij. Rows of parts
/// without area are zero.
[[nodiscard]] Eigen::Matrix<double, 10, 10> brick_form_factors(const BrickShape& shape);
[[nodiscard]] Eigen::Array<double, 10, 1> brick_areas_m2(const BrickShape& shape);

/// @return radiosities, 10 x wavelengths
[[nodiscard]] Parts brick_radiosity(const BrickShape& shape, const Parts& emission,
                                    const Parts& reflectance);

}  // namespace solver
