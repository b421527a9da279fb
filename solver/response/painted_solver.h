#pragma once
#include <Eigen/Core>
#include <vector>

#include "solver/exchange/exchange_areas.h"
#include "solver/response/painted_patches.h"

namespace solver {

/// One column of a solve, whatever band it belongs to, and what is kept of its answer.
struct PaintedColumn {
  Eigen::ArrayXd fixed;  ///< reflectance per patch; not read where painted
  Eigen::VectorXd emission, direct;
  Eigen::VectorXd paint;     ///< reflectance of each group
  Eigen::VectorXd received;  ///< out: sqrt(A) H on the painted patches
  Eigen::VectorXd outputs;   ///< out
};

/// Full solves of a painted room, of which only the light on the painted patches and the outputs
/// are kept.
class PaintedSolver {
 public:
  static constexpr Eigen::Index kColumnsAtOnce = 32;  ///< that one pass of the solver takes

  /// The arguments must outlive it. @throws std::invalid_argument  if no patch is painted
  PaintedSolver(const ExchangeAreas& exchange, const PaintedPatches& painted,
                const std::vector<OutputRow>& outputs, double relative_error);

  void solve(std::vector<PaintedColumn>& columns) const;

  /// What a group of patches receives; 0 on the others.
  [[nodiscard]] Eigen::VectorXd part(const Eigen::VectorXd& received, int group) const;

  /// A group's part of what the painted patches receive, sent out again with all paints black: what
  /// arrives is K E_j v.
  [[nodiscard]] PaintedColumn emitter(const Eigen::ArrayXd& fixed, const Eigen::VectorXd& received,
                                      int group) const;

  [[nodiscard]] Eigen::Index painted_patches() const { return root_area_.size(); }

  [[nodiscard]] Eigen::Index outputs() const { return static_cast<Eigen::Index>(outputs_.size()); }

 private:
  [[nodiscard]] int group_of(Eigen::Index painted) const;
  void solve_some(PaintedColumn* first, Eigen::Index count) const;

  const ExchangeAreas& exchange_;
  const PaintedPatches& painted_;
  const std::vector<OutputRow>& outputs_;
  double relative_error_;
  std::vector<int> patches_;  ///< those that are painted
  Eigen::ArrayXd root_area_;  ///< of them
};

}  // namespace solver
