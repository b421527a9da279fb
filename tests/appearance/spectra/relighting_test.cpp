#include "appearance/spectra/relighting.h"

#include <gmock/gmock.h>

#include <stdexcept>

namespace spectra {
namespace {

using Eigen::Vector3d;

const Vector3d kSky{0.4, 0.9, 1.0}, kYellow{1.0, 0.9, 0.1};

struct Relit {
  const char* name;
  Vector3d pixel, bilinear, classical;
};

class BlueSkyToYellow : public ::testing::TestWithParam<Relit> {};

// The lights of [Granier2004] 7.2 with the printed matrices, which have ten digits; the products
// were computed in double outside of this program, so that all their digits count.
TEST_P(BlueSkyToYellow, AgreesInAllDigits) {
  const auto& [name, pixel, bilinear, classical] = GetParam();
  const Eigen::Matrix3d m = relighting_matrix(bilinear_set("granier-iso"), kSky, kYellow);
  EXPECT_LT((m * pixel - bilinear).cwiseAbs().maxCoeff(), 1e-14);
  const Eigen::Matrix3d diagonal = classical_relighting_matrix(kSky, kYellow);
  EXPECT_LT((diagonal * pixel - classical).cwiseAbs().maxCoeff(), 1e-14);
}

INSTANTIATE_TEST_SUITE_P(
    Relighting, BlueSkyToYellow,
    ::testing::Values(Relit{"grey",
                            {0.2, 0.2, 0.2},
                            {0.3952010889440369, 0.20913416734351092, 0.01681264185754162},
                            {0.5, 0.2, 0.02}},
                      Relit{"the_sky_itself",
                            {0.4, 0.9, 1.0},
                            {1.0000000000269376, 0.8999999999854661, 0.0999999999993097},
                            {1.0, 0.9, 0.1}},
                      Relit{"red",
                            {0.6, 0.1, 0.1},
                            {0.9843925718314916, 0.14757534079528525, -0.0017220878546574565},
                            {1.5, 0.1, 0.01}},
                      Relit{"blue",
                            {0.1, 0.1, 0.6},
                            {0.2395361801632406, 0.11408960398773899, 0.07947983521349145},
                            {0.25, 0.1, 0.06}},
                      Relit{"black", {0, 0, 0}, {0, 0, 0}, {0, 0, 0}}),
    [](const auto& relit) { return relit.param.name; });

TEST(Relighting, ThereAndBackIsTheIdentity) {
  for (const std::string& name : bilinear_set_names()) {
    const BilinearSet& set = bilinear_set(name);
    const Eigen::Matrix3d there = relighting_matrix(set, kSky, {0.9, 0.8, 0.7});
    const Eigen::Matrix3d back = relighting_matrix(set, {0.9, 0.8, 0.7}, kSky);
    // Condition numbers here are below 100, so that rounding stays below 1e-13.
    EXPECT_TRUE((back * there).isIdentity(1e-13)) << name;
  }
}

TEST(Relighting, BetweenWhitesScalesAsTheClassicalWayDoes) {
  for (const std::string& name : bilinear_set_names()) {
    const Eigen::Matrix3d m =
        relighting_matrix(bilinear_set(name), Vector3d::Constant(0.5), Vector3d::Constant(2));
    EXPECT_TRUE(m.isApprox(4 * Eigen::Matrix3d::Identity(), 1e-9)) << name;  // printed: 2e-10
  }
}

TEST(Relighting, RefusesAnIllConditionedLightWithTheNumber) {
  const BilinearSet& set = bilinear_set("granier-iso");
  try {
    (void)relighting_matrix(set, {85, 4, 22}, kYellow);  // condition 1.2e7
    FAIL();
  } catch (const std::domain_error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("1.24e+07"));
  }
  EXPECT_THROW((void)relighting_matrix(set, {0, 0, 0}, kYellow), std::domain_error);
  EXPECT_THROW((void)classical_relighting_matrix({0, 0, 0}, kYellow), std::domain_error);
  EXPECT_THROW((void)classical_relighting_matrix({1, 0, 1}, kYellow), std::domain_error);
  EXPECT_NO_THROW((void)relighting_matrix(set, {1, 0, 1}, kYellow));
}

}  // namespace
}  // namespace spectra
