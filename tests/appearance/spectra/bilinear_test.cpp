#include "appearance/spectra/bilinear.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>

#include "appearance/spectra/cie_tables.h"

namespace spectra {
namespace {

using Eigen::Matrix3d, Eigen::Vector3d;

const nlohmann::json& published() {
  static const nlohmann::json numbers = [] {
    std::ifstream file(TEST_DATA "/granier2004.json");
    return nlohmann::json::parse(file);
  }();
  return numbers;
}

Vector3d triple(const nlohmann::json& list) {
  return Vector3d(list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>());
}

/// Largest difference to matrices in the paper's order, K[e](c, d).
double distance_to(const nlohmann::json& printed, const BilinearSet& set) {
  double worst = 0;
  for (int e = 0; e < 3; ++e) {
    for (int c = 0; c < 3; ++c) {
      for (int d = 0; d < 3; ++d) {
        const double k = set.k[static_cast<std::size_t>(c)](d, e);
        worst = std::max(worst, std::abs(k - printed.at(e).at(c).at(d).get<double>()));
      }
    }
  }
  return worst;
}

double incoherence(const BilinearSet& set) {
  return (reflection_matrix(set, Vector3d::Ones()) - Matrix3d::Identity()).cwiseAbs().maxCoeff();
}

BilinearSet classical() {
  BilinearSet set{.name = "classical", .space = "srgb", .k = {}};
  for (int c = 0; c < 3; ++c) {
    set.k[static_cast<std::size_t>(c)] = Vector3d::Unit(c).asDiagonal();
  }
  return set;
}

void expect_near(const Vector3d& a, const Vector3d& b, double tolerance) {
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), tolerance) << a.transpose() << " | " << b.transpose();
}

TEST(BilinearSet, PrintedIsAsPrinted) {
  const BilinearSet& set = bilinear_set("granier-iso");
  EXPECT_EQ(distance_to(published().at("printed_K"), set), 0);
  EXPECT_LT(incoherence(set), 2.1e-10);
}

// The least squares over 27 coefficients that the paper leaves open, recovered from its print.
TEST(BilinearSet, PrintIsReproducedFromTheColourMatchingFunctions) {
  EXPECT_LT(distance_to(published().at("printed_K"), bilinear_set("iso")), 3e-4);
}

TEST(BilinearSet, OursAreExactlySymmetricAndCoherent) {
  for (const std::string& name : bilinear_set_names()) {
    const BilinearSet& set = bilinear_set(name);
    for (const Matrix3d& k : set.k) EXPECT_EQ(k, k.transpose()) << name;
    EXPECT_LT(incoherence(set), name == "granier-iso" ? 2.1e-10 : 1e-12) << name;
  }
}

// Functions that do not overlap and whose dual is as wide as they: light in one cannot reach
// another.
TEST(BilinearCoefficients, DisjointBoxesGiveTheClassicalProduct) {
  Eigen::MatrixX3d boxes = Eigen::MatrixX3d::Zero(30003, 3);
  for (int c = 0; c < 3; ++c) boxes.block(1 + 10001 * c, c, 10000, 1).setConstant(1 + c);
  const auto k = bilinear_coefficients(boxes);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_LT((k[c] - classical().k[c]).norm(), 1e-3);
}

// Two hats and their dual by hand: b_r = hat on {0, 1, 2}, b_g the same shifted by 1, b_b far away.
// Gram [2/3 1/6; 1/6 2/3], so b_r = 1.6 r - 0.4 g; hat^3 integrates to 1/2, hat^2 hat' to 1/12.
TEST(BilinearCoefficients, HatsGiveTheIntegralsDoneByHand) {
  Eigen::MatrixX3d hats = Eigen::MatrixX3d::Zero(8, 3);
  hats(1, 0) = hats(2, 1) = hats(6, 2) = 1;
  const double u = 1.6, v = -0.4;
  Matrix3d raw = Matrix3d::Zero();  // <b_d b_e, r>
  raw(0, 0) = (u * u * 6 + 2 * u * v + v * v) / 12;
  raw(0, 1) = raw(1, 0) = (u * v * 6 + u * u + v * v + u * v) / 12;
  raw(1, 1) = (v * v * 6 + 2 * u * v + u * u) / 12;
  // The nearest coherent matrix differs from it by v_d + v_e, which cancels in mixed differences.
  const Matrix3d k = bilinear_coefficients(hats)[0];
  for (int d = 0; d < 3; ++d) {
    for (int e = 0; e < 3; ++e) {
      const auto mixed = [&](const Matrix3d& m) { return m(d, e) - m(d, 2) - m(2, e) + m(2, 2); };
      EXPECT_NEAR(mixed(k), mixed(raw), 1e-14) << d << e;
    }
  }
  EXPECT_LT((k.rowwise().sum() - Vector3d::Unit(0)).norm(), 1e-14);
}

TEST(BilinearCoefficients, IgnoreTheScaleOfEachFunction) {
  Eigen::MatrixX3d cmf = colour_matching(kTransportGrid);
  const auto k = bilinear_coefficients(cmf);
  cmf.col(1) *= 7;
  cmf.col(2) *= -0.1;
  const auto scaled = bilinear_coefficients(cmf);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_LT((k[c] - scaled[c]).norm(), 1e-12);
}

TEST(BilinearCoefficients, UselessFunctionsAreRefused) {
  Eigen::MatrixX3d cmf = colour_matching(kTransportGrid);
  cmf.col(2).setZero();
  EXPECT_THROW((void)bilinear_coefficients(cmf), std::invalid_argument);
  cmf.col(2) = cmf.col(0) - 2 * cmf.col(1);
  EXPECT_THROW((void)bilinear_coefficients(cmf), std::invalid_argument);
  EXPECT_THROW((void)bilinear_coefficients(Eigen::MatrixX3d::Ones(2, 3)), std::invalid_argument);
}

TEST(BilinearProduct, HasThePublishedDigits) {
  const BilinearSet& set = bilinear_set("granier-iso");
  const BilinearSet blue = with_alpha(set, {0, 0, 1});
  for (const auto& p : published().at("products")) {
    const Vector3d a = triple(p.at("a")), b = triple(p.at("b"));
    expect_near(product(set, a, b), triple(p.at("bilinear")), 1e-15);
    expect_near(product(blue, a, b), triple(p.at("alpha001")), 1e-14);
    expect_near(product(classical(), a, b), triple(p.at("classical")), 1e-15);
  }
}

TEST(BilinearProduct, UnderWhiteOfAnyLevelIsTheClassicalOne) {
  const Vector3d paint(0.9, 0.3, 0.02);
  for (const std::string& name : bilinear_set_names()) {
    const double tolerance = name == "granier-iso" ? 2e-10 : 1e-12;
    for (const double level : {1e-6, 0.5, 1., 1e4}) {
      const Vector3d light = Vector3d::Constant(level);
      expect_near(product(bilinear_set(name), light, paint) / level, paint, tolerance);
    }
  }
}

TEST(BilinearProduct, CommutesAndIsTheMatrixTimesTheLight) {
  const Vector3d light(0.4, 0.9, 1), paint(0.6, 0.1, 0.3);
  for (const std::string& name : bilinear_set_names()) {
    const BilinearSet& set = bilinear_set(name);
    expect_near(product(set, light, paint), product(set, paint, light), 1e-15);
    expect_near(product(set, light, paint), reflection_matrix(set, paint) * light, 1e-15);
  }
}

TEST(WithAlpha, IsThePublishedSetAndKeepsCoherence) {
  const BilinearSet blue = with_alpha(bilinear_set("granier-iso"), {0, 0, 1});
  EXPECT_LT(distance_to(published().at("alpha_001_K"), blue), 1e-15);
  for (const std::string& name : bilinear_set_names()) {
    const BilinearSet adjusted = with_alpha(bilinear_set(name), {0.2, 0.7, 1.1});
    EXPECT_LT(incoherence(adjusted), name == "granier-iso" ? 1e-7 : 1e-11) << name;
    for (const Matrix3d& k : adjusted.k) EXPECT_EQ(k, k.transpose());
  }
}

TEST(WithAlpha, ZeroIsClassicalAndTheSetsOwnSharesChangeNothing) {
  const BilinearSet& set = bilinear_set("srgb");
  const BilinearSet none = with_alpha(set, Vector3d::Zero());
  const BilinearSet own =
      with_alpha(set, {1 - set.k[0](0, 0), 1 - set.k[1](1, 1), 1 - set.k[2](2, 2)});
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_EQ(none.k[c], classical().k[c]);
    EXPECT_LT((own.k[c] - set.k[c]).norm(), 1e-15);
  }
}

TEST(WithAlpha, RefusesWhatHasNoAnswer) {
  EXPECT_THROW((void)with_alpha(classical(), {0, 0.1, 0}), std::invalid_argument);
  EXPECT_THROW((void)with_alpha(bilinear_set("iso"), {0, std::nan(""), 0}), std::invalid_argument);
  EXPECT_THROW((void)bilinear_set("prophoto"), std::invalid_argument);
}

TEST(BilinearQuotient, HasThePublishedDigits) {
  const BilinearSet& set = bilinear_set("granier-iso");
  for (const auto& p : published().at("relight_sky_to_yellow")) {
    const Vector3d reflectance = quotient(set, triple(p.at("pixel")), triple(p.at("old")));
    expect_near(reflectance, triple(p.at("reflectance")), 1e-14);
    expect_near(product(set, triple(p.at("new")), reflectance), triple(p.at("bilinear")), 1e-14);
  }
}

TEST(BilinearQuotient, UndoesTheProductBelowTheLimitAndIsRefusedAbove) {
  std::mt19937 random(1);
  const auto uniform = [&] { return static_cast<double>(random() % 1000) / 999; };
  for (const std::string& name : bilinear_set_names()) {
    const BilinearSet& set = bilinear_set(name);
    for (int i = 0; i < 2000; ++i) {
      const Vector3d a(uniform(), uniform(), uniform()), b(uniform(), uniform(), uniform());
      if (division_condition(set, b) < kMaxDivisionCondition) {
        expect_near(quotient(set, product(set, a, b), b), a, 1e-10);
      } else {
        EXPECT_THROW((void)quotient(set, a, b), std::domain_error);
      }
    }
  }
}

// No 8-bit colour but black is singular in the printed set, yet some come very close.
TEST(BilinearQuotient, NamesTheConditionNumber) {
  const BilinearSet& set = bilinear_set("granier-iso");
  EXPECT_NEAR(division_condition(set, {85, 4, 22}), 1.2e7, 0.05e7);
  EXPECT_EQ(division_condition(set, Vector3d::Zero()), std::numeric_limits<double>::infinity());
  EXPECT_EQ(division_condition(set, {1, std::nan(""), 1}), std::numeric_limits<double>::infinity());
  try {
    (void)quotient(set, {1, 1, 1}, {85, 4, 22});
    FAIL() << "divided";
  } catch (const std::domain_error& e) {
    EXPECT_NE(std::string(e.what()).find("condition number 1.2"), std::string::npos) << e.what();
  }
}

TEST(SingularSurface, OfTheClassicalProductIsWhereAComponentIsZero) {
  for (const CubicTerm& t : singular_surface(classical())) {
    EXPECT_EQ(t.coefficient, t.r == 1 && t.g == 1 ? 1 : 0) << t.r << t.g << t.b;
  }
}

TEST(SingularSurface, IsTheDeterminantOfTheMatrix) {
  const BilinearSet& set = bilinear_set("granier-iso");
  const auto terms = singular_surface(set);
  const auto value = [&](const Vector3d& c) {
    double sum = 0;
    for (const CubicTerm& t : terms) {
      sum += t.coefficient * std::pow(c[0], t.r) * std::pow(c[1], t.g) * std::pow(c[2], t.b);
    }
    return sum;
  };
  const Vector3d pure(-0.000429, 0.010756, 0.002520);  // det K_r, det K_g, det K_b
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(value(Vector3d::Unit(c)), pure[c], 5e-7);
  for (const Vector3d& c : {Vector3d(0.3, 0.2, 0.9), Vector3d(1, -0.4, 0.1), Vector3d(0, 1, 1)}) {
    EXPECT_NEAR(value(c), reflection_matrix(set, c).determinant(), 1e-15);
  }
}

// [Granier2004] 5.3: of the 8-bit colours only (0, 0, 0) is singular. The sign changes
// nevertheless.
TEST(SingularSurface, PassesBetweenTheEightBitColours) {
  double c[4][4] = {};
  for (const CubicTerm& t : singular_surface(bilinear_set("granier-iso"))) {
    c[t.r][t.g] = t.coefficient;
  }
  int negative = 0, zero = 0;
  for (int r = 0; r < 256; ++r) {
    for (int g = 0; g < 256; ++g) {
      const double c3 = c[0][0], c2 = c[1][0] * r + c[0][1] * g,
                   c1 = (c[2][0] * r + c[1][1] * g) * r + c[0][2] * g * g,
                   c0 = ((c[3][0] * r + c[2][1] * g) * r + c[1][2] * g * g) * r +
                        c[0][3] * g * g * g;
      for (int b = 0; b < 256; ++b) {
        const double determinant = ((c3 * b + c2) * b + c1) * b + c0;
        negative += determinant < 0;
        zero += determinant == 0;
      }
    }
  }
  EXPECT_EQ(zero, 1);
  EXPECT_EQ(negative, 203334);
}

}  // namespace
}  // namespace spectra
