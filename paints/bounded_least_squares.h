#pragma once
#include <Eigen/Core>

namespace paints {

/// Minimises |a x - b| over low <= x <= high by active sets with QR [Stark1995], from a start
/// within the bounds. Steps stop after ten per unknown; the result is then no worse than the start.
/// @param a  of full column rank
[[nodiscard]] Eigen::VectorXd bounded_least_squares(const Eigen::MatrixXd& a,
                                                    const Eigen::VectorXd& b,
                                                    const Eigen::VectorXd& low,
                                                    const Eigen::VectorXd& high,
                                                    Eigen::VectorXd start);

}  // namespace paints
