#include "appearance/spectra/relighting.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <limits>
#include <stdexcept>

namespace spectra {
namespace {

void require_divisor(const Eigen::Vector3d& light, double condition) {
  if (condition < kMaxDivisionCondition) return;  // written so that NaN fails too
  throw std::domain_error(
      fmt::format("({:g}, {:g}, {:g}) cannot be divided by: condition number {:.3g}, want below "
                  "{:g}",
                  light[0], light[1], light[2], condition, kMaxDivisionCondition));
}

}  // namespace

Eigen::Matrix3d relighting_matrix(const BilinearSet& set, const Eigen::Vector3d& from,
                                  const Eigen::Vector3d& to) {
  require_divisor(from, division_condition(set, from));
  return reflection_matrix(set, to) * reflection_matrix(set, from).inverse();
}

Eigen::Matrix3d classical_relighting_matrix(const Eigen::Vector3d& from,
                                            const Eigen::Vector3d& to) {
  const double smallest = from.cwiseAbs().minCoeff();
  require_divisor(from, smallest > 0 ? from.cwiseAbs().maxCoeff() / smallest
                                     : std::numeric_limits<double>::infinity());
  return to.cwiseQuotient(from).asDiagonal();
}

}  // namespace spectra
