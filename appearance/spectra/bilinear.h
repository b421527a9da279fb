#pragma once
#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "appearance/spectra/rgb_space.h"

namespace spectra {

/// The product of two colours, light and reflectance, as a bilinear form [Granier2004]. A set is
/// coherent if white times a colour is that colour: sum_e k^c_de is 1 for d = c, else 0 (eq. 9).
struct BilinearSet {
  std::string name;
  std::string space;                 ///< the RgbSpace whose colours it multiplies
  std::array<Eigen::Matrix3d, 3> k;  ///< k[c](d, e) = k^c_de, symmetric
};

/// granier-iso (as printed, 10 digits), iso (the same, derived here), srgb, bt2020, acescg, xyz.
[[nodiscard]] const std::vector<std::string>& bilinear_set_names();

/// @throws std::invalid_argument  naming the known sets
[[nodiscard]] const BilinearSet& bilinear_set(std::string_view name);

/// [Granier2004] section 5.2: k^c_de of colour matching functions (columns r, g, b) given at evenly
/// spaced wavelengths and linear in between; each is scaled to area 1 first. The coefficients of
/// eq. 4, 11 and 12 are then moved by the least sum of squares that makes them coherent.
/// @throws std::invalid_argument  if a function has no area or the three are linearly dependent
[[nodiscard]] std::array<Eigen::Matrix3d, 3> bilinear_coefficients(
    const Eigen::MatrixX3d& matching);

/// The set of a space: its colour matching functions, 10 nm, 360..830 nm. Scaled to area 1 they
/// take light relative to the space's white as if that white were equal-energy.
[[nodiscard]] BilinearSet bilinear_set_of(const RgbSpace& space);

/// [Granier2004] 6.2: alpha_c is the share of component c that comes from other products than
/// light_c reflectance_c; (0, 0, 0) is the classical product. Coherence is kept.
/// @throws std::invalid_argument  if alpha is not finite, or above 0 where k^c_cc = 1
[[nodiscard]] BilinearSet with_alpha(const BilinearSet& set, const Eigen::Vector3d& alpha);

/// R with product(light, reflectance) = R light (eq. 7).
[[nodiscard]] Eigen::Matrix3d reflection_matrix(const BilinearSet& set,
                                                const Eigen::Vector3d& reflectance);

/// Commutes. Components may be negative.
[[nodiscard]] Eigen::Vector3d product(const BilinearSet& set, const Eigen::Vector3d& light,
                                      const Eigen::Vector3d& reflectance);

/// Division is refused from this condition number on: it would lose four more digits.
inline constexpr double kMaxDivisionCondition = 1e4;

/// Ratio of the largest to the smallest singular value of the matrix of a colour; infinity on the
/// singular surface and for colours that are no numbers.
[[nodiscard]] double division_condition(const BilinearSet& set, const Eigen::Vector3d& divisor);

/// The colour whose product with `divisor` is `colour` (4.1).
/// @throws std::domain_error  naming the condition number, at kMaxDivisionCondition and above
[[nodiscard]] Eigen::Vector3d quotient(const BilinearSet& set, const Eigen::Vector3d& colour,
                                       const Eigen::Vector3d& divisor);

/// One term of a homogeneous cubic in (r, g, b).
struct CubicTerm {
  int r = 0, g = 0, b = 0;  ///< exponents, their sum is 3
  double coefficient = 0;
};

/// The surface of colours that cannot be divided by: where these ten terms sum to 0, which is the
/// determinant of the matrix of (r, g, b).
[[nodiscard]] std::array<CubicTerm, 10> singular_surface(const BilinearSet& set);

}  // namespace spectra
