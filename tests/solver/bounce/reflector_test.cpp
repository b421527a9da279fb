// Radiosity with a matrix per patch.
#include "solver/bounce/reflector.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <limits>

#include "appearance/spectra/bilinear.h"
#include "tests/solver/enclosures.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Matrix3d;
using Eigen::MatrixXd;
using Eigen::Vector3d;

/// Patches with their materials.
struct Materials {
  std::vector<Matrix3d> matrices;
  std::vector<int> of_patch;

  [[nodiscard]] Reflector reflector() const { return {matrices, of_patch}; }
};

Materials in_turn(std::vector<Matrix3d> matrices, int patches = kPatches) {
  Materials materials{.matrices = std::move(matrices), .of_patch = {}};
  for (int p = 0; p < patches; ++p) {
    materials.of_patch.push_back(p % static_cast<int>(materials.matrices.size()));
  }
  return materials;
}

/// Paints as saturated as they come, and a grey.
std::vector<Matrix3d> paints(const spectra::BilinearSet& set, double most = 0.9) {
  std::vector<Matrix3d> matrices;
  for (const Vector3d& rgb : {Vector3d(1, 0.06, 0.06), Vector3d(0.06, 1, 0.06),
                              Vector3d(0.06, 0.06, 1), Vector3d(0.9, 0.9, 0.9)}) {
    matrices.push_back(spectra::reflection_matrix(set, most * rgb));
  }
  return matrices;
}

/// Truth: (1 - R F) B = S + R D by LU in double, unknowns in the order patch, component.
Bands direct_radiosity(const MatrixXd& f, const Bands& s, const Bands& d, const Materials& m) {
  const Eigen::Index n = f.rows();
  const Bands known = s + m.reflector().reflect(d);
  MatrixXd system = MatrixXd::Identity(3 * n, 3 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto material = static_cast<std::size_t>(m.of_patch[static_cast<std::size_t>(i)]);
    for (Eigen::Index j = 0; j < n; ++j) {
      system.block<3, 3>(3 * i, 3 * j) -= f(i, j) * m.matrices[material];
    }
  }
  const Eigen::VectorXd b =
      system.partialPivLu().solve(Eigen::Map<const Eigen::VectorXd>(known.data(), 3 * n));
  return Eigen::Map<const Bands>(b.data(), n, 3);
}

class MatrixMethod : public testing::TestWithParam<Method> {};

INSTANTIATE_TEST_SUITE_P(Methods, MatrixMethod,
                         testing::Values(Method::jacobi, Method::gauss_seidel, Method::bicgstab),
                         [](const auto& method) {
                           std::string name = to_string(method.param);
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// alpha = (0, 0, 1) makes matrices whose plain norm is far above 1: only their own norm proves it.
TEST_P(MatrixMethod, AgreesWithDirectSolveWithinItsBounds) {
  const ExchangeAreas exchange = random_enclosure(kPatches, 1);
  const Bands s = random_bands(kPatches, 3, 10, 2), d = random_bands(kPatches, 3, 5, 3);
  const MatrixXd f = dense(exchange);
  const spectra::BilinearSet& printed = spectra::bilinear_set("granier-iso");
  for (const auto& set : {printed, spectra::with_alpha(printed, {0, 0, 1})}) {
    const Materials materials = in_turn(paints(set));
    const Bands exact = direct_radiosity(f, s, d, materials);
    const Bands exact_irradiance = (f * exact.matrix()).array() + d;
    for (const double relative_error : {1e-3, 1e-6, 1e-10}) {
      const RadiositySolution solution =
          solve_radiosity(exchange, s, d, materials.reflector(),
                          {.method = GetParam(), .relative_error = relative_error});
      ASSERT_TRUE(solution.converged && solution.proven);
      for (int k = 0; k < 3; ++k) {
        const BandReport& band = solution.bands[static_cast<std::size_t>(k)];
        const ArrayXd error = (solution.irradiance.col(k) - exact_irradiance.col(k)).abs();
        const double rms =
            std::sqrt((exchange.area_m2 * error.square()).sum() / exchange.area_m2.sum());
        const double rounding = 1e-12 * exact_irradiance.maxCoeff();
        EXPECT_LE(rms, band.rms_error_bound + rounding);
        EXPECT_LE(error.maxCoeff(), band.max_error_bound + rounding);
        const ArrayXd wrong = solution.radiosity.col(k) - exact.col(k);
        EXPECT_LE(std::sqrt((exchange.area_m2 * wrong.square()).sum()),
                  band.norm_error_bound + rounding);
      }
    }
  }
}

TEST_P(MatrixMethod, DiagonalMatricesGiveTheAnswerOfNumbers) {
  const ExchangeAreas exchange = random_enclosure(kPatches, 4);
  const Bands s = random_bands(kPatches, 3, 10, 5), d = random_bands(kPatches, 3, 5, 6);
  const Bands rho = random_bands(kPatches, 3, 0.95, 7);
  Materials materials;
  for (int p = 0; p < kPatches; ++p) {
    materials.matrices.push_back(rho.row(p).matrix().asDiagonal());
    materials.of_patch.push_back(p);
  }
  const RadiositySolution numbers = solve_radiosity(exchange, s, d, rho, {.relative_error = 1e-12});
  const RadiositySolution matrices = solve_radiosity(
      exchange, s, d, materials.reflector(), {.method = GetParam(), .relative_error = 1e-12});
  EXPECT_LT((matrices.radiosity / numbers.radiosity - 1).abs().maxCoeff(), 1e-11);
}

// sum A (S + D) = sum A (H - R H), component by component.
TEST_P(MatrixMethod, AbsorbsWhatIsEmitted) {
  const ExchangeAreas exchange = random_enclosure(kPatches, 8);
  const Bands s = random_bands(kPatches, 3, 10, 9), d = random_bands(kPatches, 3, 5, 10);
  const Materials materials = in_turn(paints(spectra::bilinear_set("bt2020")));
  const RadiositySolution solution = solve_radiosity(
      exchange, s, d, materials.reflector(), {.method = GetParam(), .relative_error = 1e-10});
  const Bands absorbed = solution.irradiance - materials.reflector().reflect(solution.irradiance);
  const ArrayXd in = ((s + d).colwise() * exchange.area_m2).colwise().sum();
  const ArrayXd out = (absorbed.colwise() * exchange.area_m2).colwise().sum();
  EXPECT_LT((out / in - 1).abs().maxCoeff(), 1e-8);
}

/// Jacobi until nothing but rounding changes.
Bands settled(const ExchangeAreas& exchange, const Bands& s, const Reflector& reflector) {
  return solve_radiosity(
             exchange, s, 0 * s, reflector,
             {.method = Method::jacobi, .relative_error = 1e-300, .max_iterations = 120})
      .radiosity;
}

// The white furnace with S = (1 - R) c: by coherence R white = reflectance, so that S and the
// answer are those of classical multiplication.
TEST(CoherentSets, WhiteFurnaceIsTheClassicalOne) {
  const ExchangeAreas exchange = random_enclosure(kPatches, 11);
  const Bands paint = random_bands(10, 3, 0.9, 12), rho = paint.replicate(kPatches / 10, 1);
  for (const char* name : {"iso", "srgb", "bt2020", "acescg", "xyz"}) {
    std::vector<Matrix3d> matrices;
    for (int m = 0; m < 10; ++m) {
      matrices.push_back(
          spectra::reflection_matrix(spectra::bilinear_set(name), paint.row(m).transpose()));
    }
    const Materials materials = in_turn(matrices);
    for (const double level : {1e-6, 1.0, 1e6}) {
      const Bands white = Bands::Constant(kPatches, 3, level);
      const Bands s = white - materials.reflector().reflect(white);
      EXPECT_LT((s / (level * (1 - rho)) - 1).abs().maxCoeff(), 1e-12) << name;
      const Bands bilinear = settled(exchange, s, materials.reflector());
      const Bands classical = settled(exchange, level * (1 - rho), Reflector(rho));
      EXPECT_LT((bilinear / classical - 1).abs().maxCoeff(), 1e-12) << name;
    }
  }
}

// Grey paints are multiples of white: R = rho 1, whatever the light.
TEST(CoherentSets, GreyRoomIsTheClassicalOneUnderAnyLight) {
  const ExchangeAreas exchange = random_enclosure(kPatches, 13);
  const Bands s = random_bands(kPatches, 3, 10, 14);
  const std::array<double, 3> greys{0.2, 0.5, 0.9};
  for (const char* name : {"iso", "srgb", "bt2020", "acescg", "xyz"}) {
    std::vector<Matrix3d> matrices;
    for (const double grey : greys) {
      matrices.push_back(
          spectra::reflection_matrix(spectra::bilinear_set(name), Vector3d::Constant(grey)));
    }
    Bands rho(kPatches, 3);
    for (int p = 0; p < kPatches; ++p) {
      rho.row(p).setConstant(greys[static_cast<std::size_t>(p % 3)]);
    }
    const Bands bilinear = settled(exchange, s, in_turn(matrices).reflector());
    const Bands classical = settled(exchange, s, Reflector(rho));
    EXPECT_LT((bilinear / classical - 1).abs().maxCoeff(), 1e-12) << name;
  }
}

// No norm is shorter than the largest eigenvalue. The search gives up at 2 % of what is left to 1.
TEST(ReflectorContraction, ReachesTheLargestEigenvalueWherePlainNormsExceedOne) {
  const spectra::BilinearSet& printed = spectra::bilinear_set("granier-iso");
  for (const auto& set : {printed, spectra::with_alpha(printed, {0, 0, 1})}) {
    const std::vector<Matrix3d> matrices = paints(set);
    double largest = 0, plain = 0;
    for (const Matrix3d& m : matrices) {
      largest = std::max(largest, m.eigenvalues().cwiseAbs().maxCoeff());
      plain = std::max(plain, m.operatorNorm());
    }
    const double contraction = in_turn(matrices).reflector().contraction()[0];
    EXPECT_GE(contraction, largest);
    EXPECT_LT(1 - largest, 1.1 * (1 - contraction)) << set.name;
    EXPECT_LE(contraction, plain);
  }
}

TEST(ReflectorContraction, IsTheHighestReflectanceForNumbers) {
  const Reflector reflector(Bands{{0.2, 0.7}, {0.5, -0.8}});
  EXPECT_EQ(reflector.contraction()[0], 0.5);
  EXPECT_EQ(reflector.contraction()[1], 0.8);
}

// One material turns green to red and the other red to green, times 1.2: taking turns, they make
// light grow, so that no norm proves anything; mixed evenly, they halve it.
TEST(SolveMatrixRadiosity, FadingLightWithoutAProofIsSolvedWithEstimatedBounds) {
  Matrix3d to_red = Matrix3d::Zero(), to_green = Matrix3d::Zero();
  to_red(0, 1) = to_green(1, 0) = 1.2;
  const Materials materials = in_turn({to_red, to_green});
  const ExchangeAreas exchange = random_enclosure(kPatches, 15);
  const Bands s = random_bands(kPatches, 3, 10, 16), zero = 0 * s;
  for (const Method method : {Method::jacobi, Method::gauss_seidel, Method::bicgstab}) {
    const RadiositySolution solution = solve_radiosity(exchange, s, zero, materials.reflector(),
                                                       {.method = method, .relative_error = 1e-9});
    EXPECT_FALSE(solution.proven);
    EXPECT_TRUE(solution.converged);
    EXPECT_NEAR(solution.bands[0].contraction, 0.6, 0.01);
    const Bands exact = direct_radiosity(dense(exchange), s, zero, materials);
    EXPECT_LT((solution.radiosity - exact).abs().maxCoeff(), 1e-7 * exact.maxCoeff());
  }
}

TEST(SolveMatrixRadiosity, GrowingLightHasNoAnswerAndSaysSo) {
  const Materials materials = in_turn({1.1 * Matrix3d::Identity()});
  const ExchangeAreas exchange = random_enclosure(kPatches, 17);
  const Bands s = random_bands(kPatches, 3, 10, 18), zero = 0 * s;
  const RadiositySolution solution = solve_radiosity(exchange, s, zero, materials.reflector());
  EXPECT_FALSE(solution.converged);
  EXPECT_FALSE(solution.proven);
  EXPECT_NEAR(solution.bands[1].contraction, 1.1, 1e-6);
  EXPECT_EQ(solution.bands[1].max_error_bound, std::numeric_limits<double>::infinity());
  const Bands first_bounce = s + 1.1 * gather(exchange, s);
  EXPECT_LT((solution.radiosity - first_bounce).abs().maxCoeff(), 1e-12 * first_bounce.maxCoeff());
}

TEST(SolveMatrixRadiosity, SweepsStayFlatAsReflectanceGoesToOne) {
  const ExchangeAreas exchange = random_enclosure(kPatches, 19);
  const Bands s = random_bands(kPatches, 3, 1, 20), zero = 0 * s;
  const spectra::BilinearSet& set = spectra::bilinear_set("srgb");
  for (const double most : {0.5, 0.99, 0.9999}) {
    const Materials materials =
        in_turn({spectra::reflection_matrix(set, {most, most, most}),
                 spectra::reflection_matrix(set, {most, 0.9 * most, 0.9 * most})});
    const RadiositySolution solution = solve_radiosity(exchange, s, zero, materials.reflector());
    EXPECT_TRUE(solution.converged) << most;
    EXPECT_EQ(solution.method, Method::bicgstab);
    EXPECT_LE(solution.bands[0].iterations, 30) << most;
  }
}

TEST(SolveMatrixRadiosity, NegativeNumbersAreSolvedByBiCgStab) {
  const ExchangeAreas exchange = random_enclosure(kPatches, 21);
  const Bands s = random_bands(kPatches, 2, 10, 22), zero = 0 * s;
  Bands rho = random_bands(kPatches, 2, 0.8, 23);
  rho.col(1) -= 0.1;
  const RadiositySolution solution =
      solve_radiosity(exchange, s, zero, Reflector(rho), {.relative_error = 1e-10});
  EXPECT_EQ(solution.method, Method::bicgstab);
  const MatrixXd m =
      MatrixXd::Identity(kPatches, kPatches) - rho.col(1).matrix().asDiagonal() * dense(exchange);
  const ArrayXd exact = m.partialPivLu().solve(s.col(1).matrix()).array();
  EXPECT_LT((solution.radiosity.col(1) - exact).abs().maxCoeff(), 1e-9 * exact.maxCoeff());
}

TEST(SolveMatrixRadiosity, RefusesWhatItCannotSolve) {
  const ExchangeAreas exchange = random_enclosure(kPatches, 24);
  const Bands s = random_bands(kPatches, 3, 1, 25);
  const Reflector reflector = in_turn({0.5 * Matrix3d::Identity()}).reflector();
  for (const Method method : {Method::conjugate_gradients, Method::progressive, Method::direct}) {
    EXPECT_THROW((void)solve_radiosity(exchange, s, s, reflector, {.method = method}),
                 std::invalid_argument);
  }
  EXPECT_THROW((void)solve_radiosity(exchange, s.leftCols(2), s.leftCols(2), reflector),
               std::invalid_argument);
  EXPECT_THROW((void)solve_radiosity(exchange, s, s, in_turn({Matrix3d::Zero()}, 3).reflector()),
               std::invalid_argument);
  EXPECT_THROW(Reflector({Matrix3d::Zero()}, {0, 1}), std::invalid_argument);
  EXPECT_THROW(Reflector({Matrix3d::Zero()}, {-1}), std::invalid_argument);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(Reflector({nan * Matrix3d::Identity()}, {0}), std::invalid_argument);
  EXPECT_THROW(Reflector(Bands::Constant(2, 2, nan)), std::invalid_argument);
}

}  // namespace
}  // namespace solver
