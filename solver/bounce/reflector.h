#pragma once
#include <Eigen/Core>
#include <vector>

#include "solver/bands.h"

namespace solver {

/// What patches do with the light that arrives, B = S + R H: a number per patch and band, or a
/// matrix per patch that also carries light from one of three bands to another [Granier2004] eq.
/// 6-7, [Kolchin2001] eq. 2. Matrices may have negative entries, and lengthen a vector beyond any
/// of them.
///
/// It knows a norm in which it shortens light: ||x|| = ||sqrt(A) x||_2 per band for numbers; for
/// matrices ||sqrt(A) x T^t||_2 over all bands with one T, searched so that the longest of
/// |T R T^-1| is short. As F has norm 1 in either, `contraction` is the norm of R F.
class Reflector {
 public:
  /// @throws std::invalid_argument  if a number is not finite
  explicit Reflector(Bands reflectance);
  /// @param material  index into `matrices`, per patch
  /// @throws std::invalid_argument  if a matrix is not finite or an index names none
  Reflector(std::vector<Eigen::Matrix3d> matrices, std::vector<int> material);

  [[nodiscard]] Eigen::Index patches() const;
  [[nodiscard]] Eigen::Index bands() const;

  [[nodiscard]] bool couples_bands() const { return !matrices_.empty(); }

  /// Patch x band; empty if it couples bands.
  [[nodiscard]] const Bands& numbers() const { return numbers_; }

  [[nodiscard]] Bands reflect(const Bands& arriving) const;
  [[nodiscard]] BandRow reflect(Eigen::Index patch, const BandRow& arriving) const;

  /// Per band; for matrices the same in all.
  [[nodiscard]] const Eigen::ArrayXd& contraction() const { return contraction_; }

  /// The norm above, per band; the caller has multiplied by sqrt(A).
  [[nodiscard]] Eigen::ArrayXd norms(const Bands& weighted) const;

  /// ||x_k||_2 of band k is at most this times the norm of x.
  [[nodiscard]] const Eigen::ArrayXd& reach() const { return reach_; }

  /// Sums per band; over all bands, in each, where bands are one system.
  [[nodiscard]] Eigen::ArrayXd pooled(const Eigen::ArrayXd& sums) const;

  /// Some bands only; all of them if it couples bands.
  [[nodiscard]] Reflector columns(const std::vector<Eigen::Index>& bands) const;

 private:
  Bands numbers_;
  std::vector<Eigen::Matrix3d> matrices_;
  std::vector<int> material_;
  Eigen::Matrix3d scale_ = Eigen::Matrix3d::Identity();  ///< T
  Eigen::ArrayXd contraction_, reach_;
};

}  // namespace solver
