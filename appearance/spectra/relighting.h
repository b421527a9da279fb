#pragma once
#include <Eigen/Core>

#include "appearance/spectra/bilinear.h"

namespace spectra {

/// M with pixel' = M pixel: a picture's colours when light of colour `from` gives way to `to`, each
/// pixel divided by the one and multiplied by the other [Granier2004] 7.2.
/// @throws std::domain_error  naming the condition number of `from`, at kMaxDivisionCondition and
///                            above
[[nodiscard]] Eigen::Matrix3d relighting_matrix(const BilinearSet& set, const Eigen::Vector3d& from,
                                                const Eigen::Vector3d& to);

/// The same component by component: the classical way, for comparison.
/// @throws std::domain_error  as above; the condition number is that of diag(from)
[[nodiscard]] Eigen::Matrix3d classical_relighting_matrix(const Eigen::Vector3d& from,
                                                          const Eigen::Vector3d& to);

}  // namespace spectra
