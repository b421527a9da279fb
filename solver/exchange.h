#pragma once
#include <Eigen/Core>
#include <vector>

namespace solver {

struct ExchangeAreas;  // being written

}  // namespace solver
