#include "solver/bounce/radiosity.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <limits>

#include "solver/exchange/exchange.h"
#include "tests/solver/enclosures.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;

constexpr int kBands = 5;

/// Truth: B = (I - rho F)^-1 (S + rho D) by LU in double.
Bands direct_radiosity(const MatrixXd& f, const Bands& s, const Bands& d, const Bands& rho) {
  Bands b(s.rows(), s.cols());
  for (Eigen::Index k = 0; k < s.cols(); ++k) {
    const MatrixXd m =
        MatrixXd::Identity(f.rows(), f.cols()) - rho.col(k).matrix().asDiagonal() * f;
    b.col(k) = m.partialPivLu().solve((s.col(k) + rho.col(k) * d.col(k)).matrix()).array();
  }
  return b;
}

class EveryMethod : public testing::TestWithParam<Method> {};

INSTANTIATE_TEST_SUITE_P(Methods, EveryMethod,
                         testing::Values(Method::conjugate_gradients, Method::jacobi,
                                         Method::gauss_seidel, Method::progressive, Method::direct,
                                         Method::bicgstab),
                         [](const auto& method) {
                           std::string name = to_string(method.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

TEST_P(EveryMethod, AgreesWithDirectSolveWithinItsBounds) {
  const ExchangeAreas exchange = random_enclosure(kPatches, 1);
  const Bands s = random_bands(kPatches, kBands, 10, 2), d = random_bands(kPatches, kBands, 5, 3);
  const Bands rho = random_bands(kPatches, kBands, 0.95, 4);
  const MatrixXd f = dense(exchange);
  const Bands exact = direct_radiosity(f, s, d, rho);
  const Bands exact_irradiance = (f * exact.matrix()).array() + d;
  for (const double relative_error : {1e-3, 1e-6, 1e-10}) {
    const RadiositySolution solution = solve_radiosity(
        exchange, s, d, rho, {.method = GetParam(), .relative_error = relative_error});
    ASSERT_TRUE(solution.converged);
    for (int k = 0; k < kBands; ++k) {
      const BandReport& band = solution.bands[static_cast<std::size_t>(k)];
      const ArrayXd error = (solution.irradiance.col(k) - exact_irradiance.col(k)).abs();
      const double rms =
          std::sqrt((exchange.area_m2 * error.square()).sum() / exchange.area_m2.sum());
      const double rounding = 1e-12 * exact_irradiance.col(k).maxCoeff();
      EXPECT_LE(rms, band.rms_error_bound + rounding);
      EXPECT_LE(error.maxCoeff(), band.max_error_bound + rounding);
      const ArrayXd wrong = solution.radiosity.col(k) - exact.col(k);
      EXPECT_LE(std::sqrt((exchange.area_m2 * wrong.square()).sum()),
                band.norm_error_bound + rounding);
      EXPECT_GT(band.iterations, 0);
    }
  }
}

// S_i = (1 - rho_i) c gives B_i = c whatever the reflectances: every error of closure or storage
// shows.
TEST_P(EveryMethod, WhiteFurnace) {
  const ExchangeAreas exchange = random_enclosure(kPatches, 5);
  const bool sweeps =  // these need 1 / (1 - rho) of them
      GetParam() == Method::jacobi || GetParam() == Method::gauss_seidel ||
      GetParam() == Method::progressive;
  const double highest = sweeps ? 0.99 : 0.9999;
  const Bands rho = random_bands(kPatches, kBands, highest, 6);
  const Bands zero = Bands::Zero(kPatches, kBands);
  const RadiositySolution solution = solve_radiosity(
      exchange, 7 * (1 - rho), zero, rho, {.method = GetParam(), .relative_error = 1e-7});
  EXPECT_LT((solution.radiosity / 7 - 1).abs().maxCoeff(), 1e-6);
}

// absorbed = emitted to rounding times the solver's error
TEST_P(EveryMethod, AbsorbsWhatIsEmitted) {
  const ExchangeAreas exchange = random_enclosure(kPatches, 8);
  const Bands s = random_bands(kPatches, 1, 10, 9), d = random_bands(kPatches, 1, 5, 10);
  const Bands rho = random_bands(kPatches, 1, 0.9, 11);
  const RadiositySolution solution =
      solve_radiosity(exchange, s, d, rho, {.method = GetParam(), .relative_error = 1e-9});
  const ArrayXd& area = exchange.area_m2;
  const double absorbed = (area * ((1 - rho) * solution.irradiance).col(0)).sum();
  EXPECT_NEAR(absorbed / (area * (s + d).col(0)).sum(), 1, 1e-8);
}

constexpr RadiosityOptions kShooting{.method = Method::progressive, .relative_error = 1e-8};

RadiosityOptions shooting(bool ambient, bool overshoot) {
  RadiosityOptions options = kShooting;
  options.ambient = ambient;
  options.overshoot = overshoot;
  return options;
}

/// Inside a sphere F_ij = A_j / sum A.
ExchangeAreas sphere(int patches) {
  const ArrayXd area = random_bands(patches, 1, 1, 30).col(0) + 0.1;
  return close_exchange(area.matrix() * area.matrix().transpose() / area.sum(), area);
}

/// A row of rooms, each of which sees only itself and its neighbours.
ExchangeAreas corridor(int rooms) {
  constexpr int kOfRoom = 8;
  const int n = rooms * kOfRoom;
  const MatrixXd x = MatrixXd::NullaryExpr(n, n, [](auto i, auto j) {
    const auto apart = std::abs(i / kOfRoom - j / kOfRoom);
    return apart == 0 ? 1.0 : apart == 1 ? 0.5 : 0.0;
  });
  return close_exchange(x, ArrayXd::Ones(n));
}

TEST(Progressive, AmbientTermAndOvershootKeepTheBounds) {
  const ExchangeAreas exchange = random_enclosure(kPatches, 31);
  const Bands s = random_bands(kPatches, kBands, 10, 32), d = random_bands(kPatches, kBands, 5, 33);
  const Bands rho = random_bands(kPatches, kBands, 0.95, 34);
  const Bands exact = direct_radiosity(dense(exchange), s, d, rho);
  for (const auto& [ambient, overshoot] :
       {std::pair{true, false}, std::pair{false, true}, std::pair{true, true}}) {
    for (const int most_sweeps : {1, 100}) {
      RadiosityOptions options = shooting(ambient, overshoot);
      options.max_iterations = most_sweeps;
      const RadiositySolution solution = solve_radiosity(exchange, s, d, rho, options);
      EXPECT_TRUE(solution.converged || most_sweeps == 1);
      for (int k = 0; k < kBands; ++k) {
        const ArrayXd wrong = solution.radiosity.col(k) - exact.col(k);
        EXPECT_LE(std::sqrt((exchange.area_m2 * wrong.square()).sum()),
                  solution.bands[static_cast<std::size_t>(k)].norm_error_bound + 1e-11);
      }
    }
  }
}

// There the ambient term is the whole solution before anything is shot, but for form factors that
// are stored in float.
TEST(Progressive, AmbientTermIsExactInASphere) {
  const ExchangeAreas exchange = sphere(kPatches);
  const Bands s = random_bands(kPatches, 2, 1, 35), d = random_bands(kPatches, 2, 1, 36);
  const Bands rho = random_bands(kPatches, 2, 0.9, 37);
  RadiosityOptions options = shooting(true, false);
  options.relative_error = 1e-5;
  const RadiositySolution solution = solve_radiosity(exchange, s, d, rho, options);
  EXPECT_EQ(solution.bands[0].iterations, 0);
  const Bands exact = direct_radiosity(dense(exchange), s, d, rho);
  EXPECT_LT((solution.radiosity / exact - 1).abs().maxCoeff(), 1e-6);
  options.ambient = false;
  EXPECT_GT(solve_radiosity(exchange, s, d, rho, options).bands[0].iterations, 0);
}

// What is absorbed is what is emitted, but for the light that an early answer does not know of.
TEST(Progressive, AmbientTermKeepsTheEnergyOfAnEarlyAnswer) {
  const ExchangeAreas exchange = corridor(12);
  const int n = exchange.patches();
  Bands s = Bands::Zero(n, 1);
  s.topRows(2).setConstant(1);
  const Bands rho = random_bands(n, 1, 0.2, 38) + 0.75;
  const auto lost = [&](bool ambient) {
    RadiosityOptions options = shooting(ambient, false);
    options.max_iterations = 1;
    const RadiositySolution early = solve_radiosity(exchange, s, 0 * s, rho, options);
    const double absorbed = ((1 - rho) * early.irradiance).colwise().sum()[0];
    return std::abs(1 - absorbed / s.sum());
  };
  EXPECT_GT(lost(false), 0.1);
  EXPECT_LT(lost(true), 0.5 * lost(false));
}

TEST(Progressive, OvershootNeedsFewerShotsInACorridor) {
  const ExchangeAreas exchange = corridor(12);
  const int n = exchange.patches();
  const Bands s = random_bands(n, 1, 1, 39);
  const auto sweeps = [&](double reflectance, bool overshoot) {
    const Bands rho = Bands::Constant(n, 1, reflectance);
    const RadiositySolution solution =
        solve_radiosity(exchange, s, 0 * s, rho, shooting(false, overshoot));
    EXPECT_TRUE(solution.converged);
    return solution.bands[0].iterations;
  };
  EXPECT_LT(sweeps(0.9, true), sweeps(0.9, false));
  EXPECT_LT(sweeps(0.99, true), 0.5 * sweeps(0.99, false));
}

TEST(Progressive, OtherMethodsRefuseItsOptions) {
  const ExchangeAreas exchange = sphere(10);
  const Bands s = Bands::Ones(10, 1);
  for (RadiosityOptions options : {shooting(true, false), shooting(false, true)}) {
    options.method = Method::jacobi;
    EXPECT_THROW((void)solve_radiosity(exchange, s, s, 0.5 * s, options), std::invalid_argument);
  }
}

TEST(SolveRadiosity, HalfBlackRoomNeedsNoDivisionByReflectance) {
  const ExchangeAreas exchange = random_enclosure(kPatches, 12);
  Bands rho = random_bands(kPatches, kBands, 0.9, 13);
  rho.topRows(kPatches / 2).setZero();
  const Bands s = random_bands(kPatches, kBands, 1, 14), zero = 0 * s;
  const RadiositySolution solution = solve_radiosity(exchange, s, zero, rho);
  const Bands exact = direct_radiosity(dense(exchange), s, zero, rho);
  EXPECT_LT((solution.radiosity / exact - 1).abs().maxCoeff(), 1e-5);
}

TEST(SolveRadiosity, BandsDoNotTouchEachOther) {
  const ExchangeAreas exchange = random_enclosure(kPatches, 15);
  const Bands s = random_bands(kPatches, kBands, 1, 16), zero = 0 * s;
  const Bands rho = random_bands(kPatches, kBands, 0.9, 17);
  const Bands together =
      solve_radiosity(exchange, s, zero, rho, {.relative_error = 1e-9}).radiosity;
  for (int k = 0; k < kBands; ++k) {
    const Bands alone =
        solve_radiosity(exchange, s.col(k), zero.col(k), rho.col(k), {.relative_error = 1e-9})
            .radiosity;
    EXPECT_LT((alone.col(0) / together.col(k) - 1).abs().maxCoeff(), 1e-7);
  }
}

// 24 orders of magnitude between bands: each keeps its own relative accuracy.
TEST(SolveRadiosity, WeakBandsAreAsAccurateAsStrongOnes) {
  const ExchangeAreas exchange = random_enclosure(kPatches, 18);
  Bands s(kPatches, 3);
  s.col(0) = random_bands(kPatches, 1, 1, 19);
  s.col(1) = s.col(0) * 1e-12;
  s.col(2) = s.col(0) * 1e12;
  const Bands rho = Bands::Constant(kPatches, 3, 0.8), zero = 0 * s;
  const Bands b = solve_radiosity(exchange, s, zero, rho).radiosity;
  EXPECT_LT((b.col(1) / b.col(0) * 1e12 - 1).abs().maxCoeff(), 1e-6);
  EXPECT_LT((b.col(2) / b.col(0) * 1e-12 - 1).abs().maxCoeff(), 1e-6);
}

TEST(SolveRadiosity, DarkBandsAreNotSolved) {
  const ExchangeAreas exchange = random_enclosure(kPatches, 20);
  Bands s = random_bands(kPatches, 3, 1, 21);
  s.col(1).setZero();
  const RadiositySolution solution =
      solve_radiosity(exchange, s, 0 * s, Bands::Constant(kPatches, 3, 0.5));
  EXPECT_TRUE((solution.radiosity.col(1) == 0).all());
  EXPECT_EQ(solution.bands[1].iterations, 0);
  EXPECT_GT(solution.bands[2].iterations, 0);
}

TEST(SolveRadiosity, RunningOutOfIterationsIsAResultWithAValidBound) {
  const ExchangeAreas exchange = random_enclosure(kPatches, 22);
  const Bands s = random_bands(kPatches, 1, 1, 23), zero = 0 * s;
  const Bands rho = Bands::Constant(kPatches, 1, 0.99);
  const RadiositySolution solution =
      solve_radiosity(exchange, s, zero, rho, {.method = Method::jacobi, .max_iterations = 5});
  EXPECT_FALSE(solution.converged);
  const Bands exact = direct_radiosity(dense(exchange), s, zero, rho);
  const ArrayXd error =
      (solution.irradiance.col(0) - (dense(exchange) * exact.matrix()).array()).abs();
  EXPECT_GT(solution.bands[0].max_error_bound, error.maxCoeff());
}

TEST(SolveRadiosity, IterationsStayFlatAsReflectanceGoesToOne) {
  const ExchangeAreas exchange = random_enclosure(kPatches, 24);
  const Bands s = random_bands(kPatches, 1, 1, 25), zero = 0 * s;
  for (const double rho : {0.5, 0.99, 0.9999}) {
    const RadiositySolution solution =
        solve_radiosity(exchange, s, zero, Bands::Constant(kPatches, 1, rho));
    EXPECT_TRUE(solution.converged) << rho;
    EXPECT_LE(solution.bands[0].iterations, 20) << rho;
  }
}

TEST(SolveRadiosity, RefusesWhatIsNoRoom) {
  const ExchangeAreas exchange = random_enclosure(kPatches, 26);
  const Bands one = Bands::Ones(kPatches, 1), half = one / 2;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW((void)solve_radiosity(exchange, one, one, one), std::invalid_argument);
  EXPECT_THROW((void)solve_radiosity(exchange, one, one, -half), std::invalid_argument);
  EXPECT_THROW((void)solve_radiosity(exchange, -one, one, half), std::invalid_argument);
  EXPECT_THROW((void)solve_radiosity(exchange, nan * one, one, half), std::invalid_argument);
  EXPECT_THROW((void)solve_radiosity(exchange, one, nan * one, half), std::invalid_argument);
  EXPECT_THROW((void)solve_radiosity(exchange, one, one, nan * half), std::invalid_argument);
  EXPECT_THROW((void)solve_radiosity(exchange, one.topRows(3), one, half), std::invalid_argument);
}

TEST(CloseExchange, RowsSumToOneAndStaySymmetric) {
  const ExchangeAreas exchange = random_enclosure(200, 27);
  const MatrixXd f = dense(exchange);
  EXPECT_LT((f.rowwise().sum().array() - 1).abs().maxCoeff(), 1e-14);
  const MatrixXd flux = exchange.area_m2.matrix().asDiagonal() * f;
  EXPECT_LT((flux - flux.transpose()).cwiseAbs().maxCoeff(), 1e-16);
  EXPECT_LT(exchange.closure_defect, 1e-14);
  EXPECT_EQ(exchange.reciprocity_defect, 0);
}

TEST(CloseExchange, PatchThatSeesNothingIsNamed) {
  MatrixXd x = MatrixXd::Constant(4, 4, 0.25);
  x.row(2).setZero();
  x.col(2).setZero();
  const ExchangeAreas exchange = close_exchange(x, ArrayXd::Ones(4));
  EXPECT_EQ(exchange.isolated, std::vector<int>{2});
  EXPECT_LT(exchange.closure_defect, 1e-14);
  EXPECT_NEAR(exchange.form_factor(0, 1), 1.0 / 3, 1e-7);
}

TEST(CloseExchange, RefusesAsymmetryAndNegativeEntries) {
  MatrixXd x = MatrixXd::Ones(3, 3);
  x(0, 1) = 2;
  EXPECT_THROW((void)close_exchange(x, ArrayXd::Ones(3)), std::invalid_argument);
  EXPECT_THROW((void)close_exchange(-MatrixXd::Ones(3, 3), ArrayXd::Ones(3)),
               std::invalid_argument);
  EXPECT_THROW((void)close_exchange(MatrixXd::Ones(3, 3), ArrayXd::Zero(3)), std::invalid_argument);
}

}  // namespace
}  // namespace solver
