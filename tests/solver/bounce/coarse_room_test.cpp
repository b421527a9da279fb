#include "solver/bounce/coarse_room.h"

#include <gtest/gtest.h>

#include "solver/exchange/clusters.h"
#include "tests/solver/enclosures.h"
#include "tests/support/stability_rooms.h"

namespace solver {
namespace {

using Eigen::ArrayXd;

// Closure and reciprocity of the patches are those of their clusters.
TEST(CoarseRoom, ClustersOfACorridorCloseAndKeepToTheirSurface) {
  const RoomTransport t = prepare_transport(stability::corridor());
  const Eigen::MatrixXd& x = t.exchange.cluster_exchange_m2;
  ASSERT_GE(x.rows(), 32);
  ArrayXd area = ArrayXd::Zero(x.rows());
  std::vector<int> surface(static_cast<std::size_t>(x.rows()), -1);
  for (int p = 0; p < t.mesh.size(); ++p) {
    const auto i = static_cast<std::size_t>(p);
    const int c = t.exchange.cluster[i];
    area[c] += t.mesh.area_m2[i];
    int& own = surface[static_cast<std::size_t>(c)];
    EXPECT_TRUE(own == -1 || own == t.mesh.surface[i]);
    own = t.mesh.surface[i];
  }
  EXPECT_LT((x.rowwise().sum().array() / area - 1).abs().maxCoeff(), 1e-12);
  EXPECT_LT((x - x.transpose()).cwiseAbs().maxCoeff(), 1e-12);
}

// Even light in a room that reflects rho everywhere: S / (1 - rho) arrives, whatever the clusters.
TEST(CoarseRoom, EvenLightIsExact) {
  const RoomTransport t = prepare_transport(stability::box());
  const Eigen::Index n = t.mesh.size();
  Bands one = Bands::Zero(t.exchange.rows(), 1);  // the slopes of even light
  one.topRows(n) = 1;
  const Bands rho = Bands::Constant(t.exchange.rows(), 1, 0.999);
  const RadiositySystem system{.exchange = t.exchange,
                               .emission = one,
                               .direct = 0 * one,
                               .reflector = Reflector(rho),
                               .contraction = ArrayXd::Constant(1, 0.999)};
  const Bands irradiance = CoarseRoom(system).irradiance(one);
  EXPECT_LT((irradiance * (1 - 0.999) - one).abs().maxCoeff(), 1e-10);
}

TEST(CoarseRoom, MoreSurfacesThanPayMakeNoClusters) {
  scenes::PatchMesh mesh = scenes::mesh_room(stability::box(), 0.3);
  for (std::size_t p = 0; p < mesh.surface.size(); ++p) mesh.surface[p] = static_cast<int>(p);
  EXPECT_TRUE(cluster_patches(mesh).empty());
}

// 40 bands, of which all but two arrive early and leave the product.
TEST(CoarseRoom, BandsThatArriveEarlyChangeNothingForTheOthers) {
  const ExchangeAreas exchange = random_enclosure(kPatches, 31);
  Bands rho = Bands::Constant(kPatches, 40, 0.05);
  rho.col(3).setConstant(0.9999);
  rho.col(37).setConstant(0.99);
  const Bands s = random_bands(kPatches, 40, 1, 32), zero = 0 * s;
  const RadiosityOptions options{.relative_error = 1e-10};
  const RadiositySolution together = solve_radiosity(exchange, s, zero, rho, options);
  ASSERT_TRUE(together.converged);
  EXPECT_GT(together.bands[3].iterations, together.bands[4].iterations);
  for (const int k : {3, 4, 37}) {
    const RadiositySolution alone =
        solve_radiosity(exchange, s.col(k), zero.col(k), rho.col(k), options);
    const ArrayXd difference = together.radiosity.col(k) / alone.radiosity.col(0) - 1;
    EXPECT_LT(difference.abs().maxCoeff(), 1e-10) << k;
    EXPECT_EQ(together.bands[static_cast<std::size_t>(k)].iterations, alone.bands[0].iterations);
  }
}

}  // namespace
}  // namespace solver
