#include "appearance/spectra/bilinear.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "appearance/spectra/cie_tables.h"

namespace spectra {
namespace {

using Eigen::Matrix3d, Eigen::MatrixX3d, Eigen::Vector3d;
using Coefficients = std::array<Matrix3d, 3>;

/// The matrices of [Granier2004] 5.3. Printed are K_e(c, d) = k^c_de; here the same by component.
Coefficients printed_coefficients() {
  Coefficients k;
  k[0] << .6533043776, .2708567778, .0758388444,  //
      .2708567778, -.2135258222, -.05733095555,   //
      .0758388444, -.05733095555, -.01850788891;
  k[1] << .0594368555, -.0413179278, -.01811892773,  //
      -.0413179278, .9943860889, .0469318388,        //
      -.01811892773, .0469318388, -.02881291107;
  k[2] << -.01119056664, .0005536667, .0106368999,  //
      .0005536667, -.04014829995, .0395946333,      //
      .0106368999, .0395946333, .9497684667;
  return k;
}

/// Integrals over functions that are linear between samples one apart. A product of up to three of
/// them is a cubic in each interval, which Simpson's rule integrates exactly.
class Integrals {
 public:
  explicit Integrals(Eigen::Index samples)
      : weights_(Eigen::VectorXd::Constant(samples, 1. / 3)), last_(samples - 1) {
    weights_[0] = weights_[last_] = 1. / 6;
  }

  [[nodiscard]] double of(const Eigen::ArrayXd& f, const Eigen::ArrayXd& g,
                          const Eigen::ArrayXd& h) const {
    const Eigen::ArrayXd middles = middle(f) * middle(g) * middle(h);
    return weights_.dot((f * g * h).matrix()) + middles.sum() * 2 / 3;
  }

 private:
  [[nodiscard]] Eigen::ArrayXd middle(const Eigen::ArrayXd& f) const {
    return (f.head(last_) + f.tail(last_)) / 2;
  }

  Eigen::VectorXd weights_;
  Eigen::Index last_;
};

/// The nearest symmetric matrix whose rows sum to those of `rows`: k + v 1' + 1 v'.
Matrix3d nearest_with_row_sums(const Matrix3d& k, const Vector3d& rows) {
  const Vector3d missing = rows - k.rowwise().sum();
  const Vector3d v = (missing.array() - missing.sum() / 6) / 3;
  return k + (v.replicate<1, 3>() + v.transpose().replicate<3, 1>());
}

const std::vector<BilinearSet>& sets() {
  static const std::vector<BilinearSet> all = [] {
    std::vector<BilinearSet> made{{"granier-iso", "iso", printed_coefficients()}};
    for (const char* name : {"iso", "srgb", "bt2020", "acescg", "xyz"}) {
      made.push_back(bilinear_set_of(rgb_space(name)));
    }
    return made;
  }();
  return all;
}

}  // namespace

const std::vector<std::string>& bilinear_set_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> collected;
    for (const BilinearSet& set : sets()) collected.push_back(set.name);
    return collected;
  }();
  return names;
}

const BilinearSet& bilinear_set(std::string_view name) {
  const auto found = std::ranges::find(sets(), name, &BilinearSet::name);
  if (found != sets().end()) return *found;
  throw std::invalid_argument(fmt::format("no bilinear set \"{}\"; there are {}", name,
                                          fmt::join(bilinear_set_names(), ", ")));
}

Coefficients bilinear_coefficients(const MatrixX3d& matching) {
  if (matching.rows() < 3)
    throw std::invalid_argument("matching functions of fewer than 3 samples");
  const Integrals integral(matching.rows());
  const Eigen::ArrayXd one = Eigen::ArrayXd::Ones(matching.rows());
  Eigen::ArrayX3d dual(matching.rows(), 3), bar(matching.rows(), 3);
  for (int c = 0; c < 3; ++c) {
    const double area = integral.of(matching.col(c), one, one);
    if (!(std::abs(area) > 1e-12 * matching.col(c).cwiseAbs().sum())) {
      throw std::invalid_argument("a colour matching function without area");
    }
    bar.col(c) = matching.col(c) / area;
  }
  Matrix3d gram;  // eq. 12
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) gram(i, j) = integral.of(bar.col(i), bar.col(j), one);
  }
  const Eigen::FullPivLU<Matrix3d> lu(gram);
  if (!lu.isInvertible()) throw std::invalid_argument("linearly dependent matching functions");
  dual = (bar.matrix() * lu.inverse()).array();

  Coefficients k;
  for (int c = 0; c < 3; ++c) {
    const auto slot = static_cast<std::size_t>(c);
    for (int d = 0; d < 3; ++d) {
      for (int e = 0; e <= d; ++e) {
        k[slot](d, e) = k[slot](e, d) = integral.of(dual.col(d), dual.col(e), bar.col(c));
      }
    }
    k[slot] = nearest_with_row_sums(k[slot], Vector3d::Unit(c));
  }
  return k;
}

BilinearSet bilinear_set_of(const RgbSpace& space) {
  constexpr Grid kEveryTenth{.first_nm = 360, .step_nm = 10, .count = 48};
  const MatrixX3d matching =
      colour_matching(kEveryTenth) * space.xyz_from_rgb.inverse().transpose();
  return {.name = space.name, .space = space.name, .k = bilinear_coefficients(matching)};
}

BilinearSet with_alpha(const BilinearSet& set, const Vector3d& alpha) {
  BilinearSet adjusted{
      .name = fmt::format("{}:alpha={},{},{}", set.name, alpha[0], alpha[1], alpha[2]),
      .space = set.space,
      .k = set.k};
  for (int c = 0; c < 3; ++c) {
    Matrix3d& k = adjusted.k[static_cast<std::size_t>(c)];
    const double transferred = 1 - k(c, c);
    if (!std::isfinite(alpha[c]) || (alpha[c] != 0 && transferred == 0)) {
      throw std::invalid_argument(fmt::format(
          "alpha = {} cannot be had for component {} of the set {}", alpha[c], c, set.name));
    }
    k *= alpha[c] == 0 ? 0 : alpha[c] / transferred;
    k(c, c) = 1 - alpha[c];
  }
  return adjusted;
}

Matrix3d reflection_matrix(const BilinearSet& set, const Vector3d& reflectance) {
  Matrix3d r;
  for (int c = 0; c < 3; ++c) {
    r.row(c) = (set.k[static_cast<std::size_t>(c)] * reflectance).transpose();
  }
  return r;
}

Vector3d product(const BilinearSet& set, const Vector3d& light, const Vector3d& reflectance) {
  return reflection_matrix(set, reflectance) * light;
}

double division_condition(const BilinearSet& set, const Vector3d& divisor) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  if (!divisor.allFinite()) return kInfinity;
  const Vector3d sigma =
      Eigen::JacobiSVD<Matrix3d>(reflection_matrix(set, divisor)).singularValues();
  return sigma[2] > 0 ? sigma[0] / sigma[2] : kInfinity;
}

Vector3d quotient(const BilinearSet& set, const Vector3d& colour, const Vector3d& divisor) {
  const double condition = division_condition(set, divisor);
  if (!(condition < kMaxDivisionCondition)) {
    throw std::domain_error(fmt::format(
        "division by ({}, {}, {}) in the set {}: condition number {:.3g}, allowed below {:g}",
        divisor[0], divisor[1], divisor[2], set.name, condition, kMaxDivisionCondition));
  }
  return reflection_matrix(set, divisor).fullPivLu().solve(colour);
}

std::array<CubicTerm, 10> singular_surface(const BilinearSet& set) {
  std::array<CubicTerm, 10> terms;
  std::size_t count = 0;
  for (int r = 3; r >= 0; --r) {
    for (int g = 3 - r; g >= 0; --g) terms[count++] = {.r = r, .g = g, .b = 3 - r - g};
  }
  // The determinant is linear in each row, and row c is a combination of the three k[c].row(e).
  for (int i = 0; i < 27; ++i) {
    const std::array<int, 3> pick{i / 9, i / 3 % 3, i % 3};
    Matrix3d rows;
    for (int c = 0; c < 3; ++c) {
      const auto slot = static_cast<std::size_t>(c);
      rows.row(c) = set.k[slot].row(pick[slot]);
    }
    const auto power = [&](int e) { return static_cast<int>(std::ranges::count(pick, e)); };
    const auto term = std::ranges::find_if(
        terms, [&](const CubicTerm& t) { return t.r == power(0) && t.g == power(1); });
    term->coefficient += rows.determinant();
  }
  return terms;
}

}  // namespace spectra
