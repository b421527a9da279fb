#pragma once
#include "solver/exchange/exchange_areas.h"

namespace solver {

/// Finds d > 0 with d_i sum_j X_ij d_j = A_i for every patch that sees something, by Newton's
/// method whose linear systems are symmetric and solved by conjugate gradients; patches of narrow
/// gaps that no scaling closes get some exchange with themselves. Then fills scaling, defects,
/// largest_self_view, isolated and gather_norm.
void close(ExchangeAreas& exchange);

/// X v in double.
[[nodiscard]] Eigen::ArrayXd unscaled_times(const SymmetricTiles& tiles, const Eigen::ArrayXd& v);

}  // namespace solver
