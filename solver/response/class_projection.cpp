#include "solver/response/class_projection.h"

#include <Eigen/LU>
#include <cmath>

namespace solver {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

void add_vector(ReducedClass& c, BasisVector vector, double new_share) {
  auto& [group, v, moved, phi] = vector;
  const double size = v.norm();
  for (int pass = 0; pass < 2; ++pass) {  // twice, against rounding
    for (Index i = 0; i < c.basis.cols(); ++i) {
      if (c.group[static_cast<std::size_t>(i)] != group) continue;
      const double along = c.basis.col(i).dot(v);
      v -= along * c.basis.col(i);
      moved -= along * c.moved.col(i);
      phi -= along * c.phi.col(i);
    }
  }
  const double left = v.norm();
  if (!(left > new_share * size)) return;
  const Index n = c.basis.cols();
  c.basis.conservativeResize(Eigen::NoChange, n + 1);
  c.moved.conservativeResize(Eigen::NoChange, n + 1);
  c.phi.conservativeResize(Eigen::NoChange, n + 1);
  c.basis.col(n) = v / left;
  c.moved.col(n) = moved / left;
  c.phi.col(n) = phi / left;
  c.group.push_back(group);
}

MatrixXd symmetric_transfer(const ReducedClass& c) {
  MatrixXd k = c.basis.transpose() * c.moved;
  // What the solves left open grows with each vector, so the earlier of a pair is believed.
  for (Index i = 0; i < k.rows(); ++i) {
    for (Index j = 0; j < i; ++j) k(j, i) = k(i, j);
  }
  return k;
}

VectorXd by_vector(const std::vector<int>& group, const VectorXd& reflectance) {
  VectorXd r(static_cast<Index>(group.size()));
  for (Index i = 0; i < r.size(); ++i) r[i] = reflectance[group[static_cast<std::size_t>(i)]];
  return r;
}

MatrixXd coefficients(const MatrixXd& k, const VectorXd& r, const MatrixXd& gamma) {
  const MatrixXd system = MatrixXd::Identity(k.rows(), k.cols()) - k * r.asDiagonal();
  return system.partialPivLu().solve(gamma);
}

double residual(const ReducedClass& c, Index source, const VectorXd& paint, const MatrixXd& k) {
  const VectorXd r = by_vector(c.group, paint);
  const VectorXd g = c.black.col(source);
  const VectorXd h = coefficients(k, r, c.basis.transpose() * g);
  const VectorXd rest = g + c.moved * (r.asDiagonal() * h) - c.basis * h;
  return h.norm() > 0 ? rest.norm() / h.norm() : 0;
}

}  // namespace solver
