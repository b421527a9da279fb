// Reflectances near 1 in rooms through which light travels slowly.
#include <algorithm>
#include <cmath>
#include <limits>

#include "tests/support/stability_cases.h"
#include "tests/support/stability_rooms.h"

namespace stability {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using solver::Bands;

constexpr double kAskedFor = 1e-8;

/// One band for each of kReflectances.
solver::RadiositySolution solve_all(const solver::ExchangeAreas& exchange, const ArrayXd& emission,
                                    solver::Method method, double relative_error) {
  constexpr Index kBands = std::size(kReflectances);
  Bands reflectance(exchange.rows(), kBands);
  for (Index k = 0; k < kBands; ++k) reflectance.col(k).setConstant(kReflectances[k]);
  const Bands source = emission.replicate(1, kBands);
  return solver::solve_radiosity(exchange, source, 0 * source, reflectance,
                                 {.method = method, .relative_error = relative_error});
}

std::vector<int> counts(const solver::RadiositySolution& solution) {
  std::vector<int> iterations;
  for (const solver::BandReport& band : solution.bands) {
    iterations.push_back(band.converged ? band.iterations : std::numeric_limits<int>::max());
  }
  return iterations;
}

}  // namespace

const std::vector<StiffRoom>& stiff_rooms() {
  static const std::vector<StiffRoom> kRooms{{"box 5 x 4 x 2.7 m", box, 20},
                                             {"two rooms joined by a door", two_rooms, 30},
                                             {"corridor 30 x 1.5 x 2.5 m", corridor, 40},
                                             {"slab 8 x 8 x 0.2 m", slab, 70}};
  return kRooms;
}

Iterations iterate(const StiffRoom& stiff) {
  const scenes::Room room = stiff.room();
  solver::ExchangeAreas exchange;
  const solver::RoomTransport transport = solver::prepare_transport(room);
  exchange = transport.exchange;
  const ArrayXd emission = transport.lightings.front().emission.col(0);
  const auto cg = solver::Method::conjugate_gradients;
  const auto solution = solve_all(exchange, emission, cg, kAskedFor);
  const auto direct = solve_all(exchange, emission, solver::Method::direct, kAskedFor);
  Iterations result{.patches = exchange.patches(), .with_clusters = counts(solution)};
  result.error = furnace_error(room);
  const Index patches = exchange.patches();
  const ArrayXd area = exchange.area_m2.head(patches);
  for (Index k = 0; k < solution.irradiance.cols(); ++k) {
    const ArrayXd irradiance = solution.irradiance.col(k), exact = direct.irradiance.col(k);
    const double mean = (area * irradiance.head(patches)).sum() / area.sum();
    const double expected =
        (area * emission.head(patches)).sum() / (area.sum() * (1 - kReflectances[k]));
    result.error = std::max({result.error, std::abs(mean / expected - 1),
                             (irradiance - exact).abs().maxCoeff() / mean});
  }
  exchange.cluster.clear();
  result.without_clusters = counts(solve_all(exchange, emission, cg, kAskedFor));
  return result;
}

}  // namespace stability
