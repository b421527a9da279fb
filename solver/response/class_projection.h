#pragma once
#include <Eigen/Core>
#include <vector>

#include "solver/response/band_classes.h"

namespace solver {

/// A class of bands, and what is known of how its painted patches light each other: an orthonormal
/// basis V, what K makes of it, and what it shows at the outputs.
struct ReducedClass {
  BandClass light;
  Eigen::MatrixXd constant;      ///< outputs x sources, all paints black
  Eigen::MatrixXd black;         ///< g, painted patches x sources
  Eigen::MatrixXd basis, moved;  ///< V, K V; painted patches x n
  Eigen::MatrixXd phi;           ///< outputs x n
  std::vector<int> group;        ///< of each vector

  [[nodiscard]] Eigen::Index sources() const { return light.share.rows(); }
};

/// A group's part of an irradiance, what K makes of it, and what it shows at the outputs.
struct BasisVector {
  int group = 0;
  Eigen::VectorXd v, moved, phi;
};

/// Orthonormalised; left out if less than this share of it is new to the basis.
void add_vector(ReducedClass& c, BasisVector vector, double new_share);

/// V^T K V.
[[nodiscard]] Eigen::MatrixXd symmetric_transfer(const ReducedClass& c);

/// The reflectance of each vector's group.
[[nodiscard]] Eigen::VectorXd by_vector(const std::vector<int>& group,
                                        const Eigen::VectorXd& reflectance);

/// (I - K R)^-1 gamma
[[nodiscard]] Eigen::MatrixXd coefficients(const Eigen::MatrixXd& k, const Eigen::VectorXd& r,
                                           const Eigen::MatrixXd& gamma);

/// ||g + K R h - h|| / ||h|| of the projected irradiance h.
/// @param k  symmetric_transfer(c)
[[nodiscard]] double residual(const ReducedClass& c, Eigen::Index source,
                              const Eigen::VectorXd& paint, const Eigen::MatrixXd& k);

}  // namespace solver
