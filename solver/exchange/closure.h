#pragma once
#include "solver/exchange/exchange_areas.h"

namespace solver {

/// Finds d > 0 with d_i sum_j X_ij d_j = A_i for every patch that sees something, by Newton's
/// method whose linear systems are symmetric and solved by conjugate gradients; patches of narrow
/// gaps that no scaling closes get some exchange with themselves. Then fills scaling, defects,
/// largest_self_view, isolated, gather_norm, and what closes the slopes.
void close(ExchangeAreas& exchange);

}  // namespace solver
