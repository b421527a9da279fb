#include "apps/studies/convergence_answer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "apps/studies/band_groups.h"
#include "apps/studies/convergence_log.h"

namespace apps::test {
namespace {

using Eigen::Array2d, Eigen::Vector3d;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

// Relative errors 0.1, 0 and 0.2, 0.2: RMS sqrt((0.01 + 0.04 + 0.04) / 4).
TEST(AnswerErrors, AreTheLargestAndTheRmsOverPointsAndBands) {
  const RoomAnswer is{.irradiance = {Array2d(1.1, 2), Array2d(4, 12)},
                      .jab = {Vector3d(50, 1, 2), Vector3d(53, 4, 0)},
                      .paint_distance = {}};
  const RoomAnswer ought{.irradiance = {Array2d(1, 2), Array2d(5, 10)},
                         .jab = {Vector3d(50, 1, 2), Vector3d(50, 0, 0)},
                         .paint_distance = {}};
  const AnswerErrors errors = errors_of(is, ought);
  EXPECT_NEAR(*errors.max_relative, 0.2, 1e-15);
  EXPECT_NEAR(*errors.rms_relative, std::sqrt(0.09 / 4), 1e-15);
  EXPECT_EQ(*errors.distance_jab, 5);  // 3, 4, 0
  EXPECT_FALSE(errors.kendall_tau);
}

TEST(AnswerErrors, PassOverWhatIsDarkAndWhatHasNoLook) {
  const RoomAnswer is{.irradiance = {Array2d(1, 1)}, .jab = {std::nullopt}, .paint_distance = {}};
  const RoomAnswer ought{
      .irradiance = {Array2d(0, 2)}, .jab = {Vector3d(1, 2, 3)}, .paint_distance = {}};
  const AnswerErrors errors = errors_of(is, ought);
  EXPECT_EQ(*errors.max_relative, 0.5);
  EXPECT_EQ(*errors.rms_relative, 0.5);
  EXPECT_FALSE(errors.distance_jab);
}

TEST(AnswerErrors, RankOnlyPaintsThatBothDefine) {
  RoomAnswer is, ought;
  for (int i = 0; i < 12; ++i) {
    is.paint_distance.push_back(i);
    ought.paint_distance.push_back(i);
  }
  is.paint_distance[3] = ought.paint_distance[7] = kNaN;
  std::swap(is.paint_distance[0], is.paint_distance[1]);
  const AnswerErrors errors = errors_of(is, ought);  // 45 pairs, one of them the other way
  EXPECT_NEAR(*errors.kendall_tau, 43.0 / 45, 1e-15);
  EXPECT_EQ(*errors.top_overlap, 10);
}

TEST(AnswerErrors, RefuseOtherPointsOrBands) {
  const RoomAnswer one{.irradiance = {Array2d(1, 1)}, .jab = {}, .paint_distance = {}};
  const RoomAnswer wide{.irradiance = {Vector3d(1, 1, 1)}, .jab = {}, .paint_distance = {}};
  EXPECT_THROW((void)errors_of(one, {}), std::invalid_argument);
  EXPECT_THROW((void)errors_of(one, wide), std::invalid_argument);
}

TEST(WithBands, CombinesLightAndReflectanceAlike) {
  PreparedRoom prepared;
  prepared.room.grid = spectra::kTransportGrid;
  const Eigen::ArrayXd ramp = Eigen::ArrayXd::LinSpaced(31, 0, 0.3);
  prepared.room.surfaces.push_back({.name = "wall",
                                    .reflectance = {prepared.room.grid, ramp},
                                    .exitance = spectra::constant(prepared.room.grid, 2)});
  prepared.transport.lightings.push_back(
      {.name = "", .emission = ramp.transpose(), .direct = 2 * ramp.transpose()});
  const PreparedRoom narrow = with_bands(prepared, means_of_groups(31, 3));
  const Eigen::Array3d means(0.045, 0.15, 0.255);  // of bands 0..9, 10..20 and 21..30
  EXPECT_TRUE(narrow.room.surfaces[0].reflectance.values.isApprox(means, 1e-12));
  EXPECT_TRUE(narrow.room.surfaces[0].exitance.values.isApproxToConstant(2, 1e-12));
  EXPECT_TRUE(narrow.transport.lightings[0].emission.row(0).transpose().isApprox(means, 1e-12));
  EXPECT_TRUE(narrow.transport.lightings[0].direct.row(0).transpose().isApprox(2 * means, 1e-12));
  EXPECT_EQ(narrow.room.grid.count, 3);
}

TEST(ConvergenceLog, LeavesOutWhatIsLate) {
  ConvergenceLog late(0), early(1000);
  EXPECT_FALSE(late.may_start("jacobi"));
  ASSERT_EQ(late.result().left_out.size(), 1U);
  EXPECT_EQ(late.result().left_out[0].what, "jacobi");
  EXPECT_TRUE(early.may_start("jacobi", 10));
  EXPECT_FALSE(early.may_start("jacobi", 2000));
}

}  // namespace
}  // namespace apps::test
