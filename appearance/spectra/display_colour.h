#pragma once
#include <Eigen/Core>

#include "appearance/spectra/rgb_space.h"

namespace spectra {

/// From a reference, in which an object multiplies light component by component (31 bands, or three
/// components), to the three components of a display, L = A L_ref, and back [Kolchin2001].
struct DisplayConversion {
  Eigen::Matrix3Xd from_reference;  ///< A
  Eigen::MatrixX3d to_reference;    ///< P, the guess of L_ref; A P = identity
};

/// A reference of three components: P is the inverse of A.
/// @throws std::invalid_argument  if A has none
[[nodiscard]] DisplayConversion three_component_conversion(const Eigen::Matrix3d& from_reference);

/// A reference of more components: P loses least over a set of lights, given by the sum of light
/// light' over the set (bands x bands).
/// @throws std::invalid_argument  if the sizes differ or the lights span fewer than 3 colours
[[nodiscard]] DisplayConversion least_squares_conversion(const Eigen::Matrix3Xd& from_reference,
                                                         const Eigen::MatrixXd& second_moment);

/// The object colour C = A diag(object) P, with C L for light L (eq. 5): exact for a reference of
/// three components; else the C of least sum of |C A L_ref - A diag(object) L_ref|^2 over the set
/// of lights (eq. 4). `object` is the reflectance of a surface or the transmittance of glass.
[[nodiscard]] Eigen::Matrix3d object_matrix(const DisplayConversion& conversion,
                                            const Eigen::ArrayXd& object);

/// The diagonal C that is exact for one representative light (eq. 6), in the reference.
/// @throws std::invalid_argument  if a display component of the light is 0
[[nodiscard]] Eigen::Vector3d object_diagonal(const Eigen::Matrix3Xd& from_reference,
                                              const Eigen::ArrayXd& object,
                                              const Eigen::ArrayXd& light);

/// C = A diag(object), by which light that is still in a reference of three components arrives in
/// the display (section 3, L = L_ref). For direct light only: the product cannot be reflected
/// again.
[[nodiscard]] Eigen::Matrix3d object_matrix_for_reference_light(
    const Eigen::Matrix3d& from_reference, const Eigen::Array3d& object);

/// The A of a spectral reference: rgb_of_light as a matrix, 3 x bands.
[[nodiscard]] Eigen::Matrix3Xd rgb_matching(const RgbSpace& display, const Grid& grid);

/// The stated set of lights: the 401 measured lamps at one luminance each, once as they are and
/// once after a bounce off each of the 462 measured papers. Sum of light light', transport grid.
[[nodiscard]] const Eigen::MatrixXd& room_lights_second_moment();

/// Complete linear adaptation of XYZ from one white to another: von Kries on the sharpened
/// responses of CIECAM97s with its exponent p = 1 [CIE131]. @throws std::invalid_argument  if a
/// response of a white is not above 0
[[nodiscard]] Eigen::Matrix3d linear_adaptation(const Eigen::Vector3d& from_white_xyz,
                                                const Eigen::Vector3d& to_white_xyz);

}  // namespace spectra
