#include "solver/exchange/exchange_areas.h"

namespace solver {

double ExchangeAreas::form_factor(int i, int j) const {
  return scaling[i] * unscaled.at(i, j) * scaling[j] / area_m2[i];
}

}  // namespace solver
