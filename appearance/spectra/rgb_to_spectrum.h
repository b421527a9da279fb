#pragma once
#include <Eigen/Core>
#include <array>

#include "appearance/spectra/reconstruct.h"
#include "appearance/spectra/rgb_space.h"

namespace spectra {

/// The curves that [Smits1999] mixes, red, green and blue. White is 1, and cyan, magenta and yellow
/// are 1 less these: what is smoothest for a colour is so for its complement.
using SmitsBasis = std::array<Spectrum, 3>;

/// Made for a space and grid as [Smits1999] says: each curve has its colour under the space's white
/// and, within 0..1, the least sum of squared differences of neighbours.
/// @throws std::invalid_argument  if a primary is no colour of a reflectance (srgb has none such)
[[nodiscard]] SmitsBasis smits_basis(const RgbSpace& space, const Grid& grid);

/// As much white as all three components have, of the rest as much of a secondary as two have, the
/// rest of a primary. Has exactly the colour `rgb`; values leave 0..1 only if components do.
[[nodiscard]] Spectrum smits_reflectance(const SmitsBasis& basis, const Eigen::Vector3d& rgb);

/// rho = 1/2 + x / (2 sqrt(1 + x^2)) with x = c0 nm^2 + c1 nm + c2 [Jakob2019].
[[nodiscard]] Spectrum sigmoid_spectrum(const Grid& grid, const Eigen::Vector3d& coefficients);

/// The sigmoid of a quadratic with these tristimulus values under a light, on the light's grid, by
/// damped Gauss-Newton steps on the three coefficients. Not converged: the best that was found.
/// @throws std::invalid_argument  if the light has no luminance
[[nodiscard]] Reconstruction reconstruct_sigmoid(const RelativeXyz& xyz, const Spectrum& light);

}  // namespace spectra
