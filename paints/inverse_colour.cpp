#include "paints/inverse_colour.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "appearance/jab_slope.h"
#include "paints/bounded_least_squares.h"

namespace paints {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index kBands = spectra::kTransportGrid.count;
constexpr double kExact = 1e-10;              // in J, a_C and b_C
constexpr std::array kStarts{0.2, 0.5, 0.8};  // greys, as shares of `most`

using Wishes = std::span<const WishInLight>;

spectra::Spectrum spectrum(const VectorXd& rho) { return {spectra::kTransportGrid, rho.array()}; }

/// A reflectance and how it looks: J, a_C, b_C minus the wish, all lightings below each other.
struct Look {
  VectorXd rho, missed;
  MatrixXd slope;        ///< of `missed`, by rho
  std::string no_model;  ///< why the model does not define it in some lighting; else empty
};

Look look(Wishes wishes, const InverseOptions& options, const VectorXd& rho) {
  const auto rows = static_cast<Index>(3 * wishes.size());
  Look found{.rho = rho, .missed = VectorXd(rows), .slope = MatrixXd(rows, kBands), .no_model = {}};
  Index row = 0;
  for (const WishInLight& wish : wishes) {
    try {
      const auto [status, jab, slope] =
          appearance::jab_slope(wish.room(spectrum(rho)), options.viewing);
      const Target& t = wish.target;
      found.missed.segment<3>(row) = jab - Eigen::Vector3d(t.lightness, t.a_c, t.b_c);
      found.slope.middleRows<3>(row) = slope;
      if (!status.all_defined()) found.no_model = to_string(status);
    } catch (const std::domain_error& error) {
      found.no_model = error.what();
    }
    row += 3;
  }
  return found;
}

/// D: a row for each pair of neighbouring bands.
const MatrixXd& differences() {
  static const MatrixXd matrix = [] {
    MatrixXd d = MatrixXd::Zero(kBands - 1, kBands);
    d.diagonal().setConstant(-1);
    d.diagonal(1).setOnes();
    return d;
  }();
  return matrix;
}

VectorXd roughness_gradient(const VectorXd& rho) {
  return differences().transpose() * (differences() * rho);
}

/// weight/2 |D rho|^2 + 1/2 |missed + shift|^2 within the bounds: the augmented Lagrangian times
/// `weight`, so shift / weight are the multipliers of `missed`.
struct Penalty {
  double weight;
  VectorXd shift;

  [[nodiscard]] double value(const Look& at) const {
    if (!at.no_model.empty()) return std::numeric_limits<double>::infinity();
    return (weight * (differences() * at.rho).squaredNorm() + (at.missed + shift).squaredNorm()) /
           2;
  }

  [[nodiscard]] VectorXd gradient(const Look& at) const {
    return weight * roughness_gradient(at.rho) + at.slope.transpose() * (at.missed + shift);
  }
};

/// Bands held at a bound, where the gradient pushes outwards.
bool held(double rho, double gradient, double most) {
  return (rho <= 0 && gradient > 0) || (rho >= most && gradient < 0);
}

/// The penalty's second derivatives, those of the appearance by differences of its slope.
MatrixXd curvature(Wishes wishes, const InverseOptions& options, const Penalty& penalty,
                   const Look& at) {
  MatrixXd second(kBands, kBands);
  const VectorXd now = at.slope.transpose() * (at.missed + penalty.shift);
  for (Index k = 0; k < kBands; ++k) {
    const double step = at.rho[k] > 0.5 * options.most ? -1e-6 : 1e-6;
    VectorXd rho = at.rho;
    rho[k] += step;
    const MatrixXd slope = look(wishes, options, rho).slope;
    second.col(k) = (slope.transpose() * (at.missed + penalty.shift) - now) / step;
  }
  return (second + second.transpose()) / 2 + at.slope.transpose() * at.slope +
         penalty.weight * differences().transpose() * differences();
}

/// Newton: the reflectance within the bounds that is best if the penalty were quadratic. Where it
/// curves down it is taken to curve up as much, so that the step leads downhill.
VectorXd quadratic_best(const Look& at, const VectorXd& gradient, const MatrixXd& curvature,
                        double most) {
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(curvature);
  const Eigen::ArrayXd values = eigen.eigenvalues().array().abs();
  const VectorXd root = values.max(1e-14 * values.maxCoeff()).sqrt();
  const MatrixXd a = root.asDiagonal() * eigen.eigenvectors().transpose();
  const VectorXd b =
      a * at.rho - root.cwiseInverse().asDiagonal() * (eigen.eigenvectors().transpose() * gradient);
  return bounded_least_squares(a, b, VectorXd::Zero(kBands), VectorXd::Constant(kBands, most),
                               at.rho);
}

/// Newton steps within the bounds until the penalty falls no more.
Look minimised(Wishes wishes, const InverseOptions& options, const Penalty& penalty, Look at) {
  constexpr int kMaxSteps = 200;
  for (int count = 0; count < kMaxSteps; ++count) {
    const VectorXd gradient = penalty.gradient(at);
    const VectorXd best =
        quadratic_best(at, gradient, curvature(wishes, options, penalty, at), options.most);
    const VectorXd step = best - at.rho;
    const double value = penalty.value(at), slope = gradient.dot(step);
    bool fell = false;
    for (double length = 1; length > 1e-9 && slope < 0 && !fell; length /= 2) {
      // A whole step ends exactly on the bounds that it meets.
      const VectorXd rho =
          length == 1 ? best : (at.rho + length * step).cwiseMax(0).cwiseMin(options.most);
      const Look next = look(wishes, options, rho);
      fell = penalty.value(next) <= value + 1e-4 * length * slope && penalty.value(next) < value;
      if (fell) at = next;
    }
    if (!fell) break;
  }
  return at;
}

/// What is left of a gradient that should vanish in free bands and push outwards at bounds.
double violation(const VectorXd& rho, const VectorXd& gradient, double most) {
  double worst = 0;
  for (Index k = 0; k < rho.size(); ++k) {
    if (!held(rho[k], gradient[k], most)) worst = std::max(worst, std::abs(gradient[k]));
  }
  return worst;
}

Eigen::Matrix3Xd by_lighting(const VectorXd& stacked) {
  return Eigen::Map<const Eigen::Matrix3Xd>(stacked.data(), 3, stacked.size() / 3);
}

InverseColour answer(const Look& at, const VectorXd& multipliers, const VectorXd& gradient,
                     const InverseOptions& options) {
  const double lightings = static_cast<double>(at.missed.size()) / 3;
  return {.reflectance = spectrum(at.rho),
          .exact = at.missed.cwiseAbs().maxCoeff() <= kExact,
          .missed = by_lighting(at.missed),
          .distance = std::sqrt(at.missed.squaredNorm() / lightings),
          .roughness = (differences() * at.rho).squaredNorm(),
          .multipliers = by_lighting(multipliers),
          .bound_multipliers = gradient.array(),
          .stationarity = violation(at.rho, gradient, options.most),
          .limit = {}};
}

/// Method of multipliers [Powell1969]; where the wish cannot be met, `weight` falls to its least,
/// and a last minimum without multipliers is the nearest.
InverseColour solved_from(Wishes wishes, const InverseOptions& options, Look at) {
  constexpr double kLeastWeight = 1e-8;  // the squared distance found is this near to the least
  constexpr int kMaxRounds = 40;
  Penalty penalty{.weight = 1, .shift = VectorXd::Zero(at.missed.size())};
  double missed = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kMaxRounds; ++round) {
    at = minimised(wishes, options, penalty, at);
    penalty.shift += at.missed;
    const double now = at.missed.cwiseAbs().maxCoeff();
    if (now <= kExact) {
      const VectorXd multipliers = penalty.shift / penalty.weight;
      return answer(at, multipliers,
                    roughness_gradient(at.rho) + at.slope.transpose() * multipliers, options);
    }
    if (now > 0.1 * missed) {
      if (penalty.weight < 2 * kLeastWeight) break;  // 2: whatever rounding did to it
      penalty.weight /= 10;
      penalty.shift /= 10;
    }
    missed = now;
  }
  at = minimised(wishes, options, {kLeastWeight, VectorXd::Zero(at.missed.size())}, at);
  return answer(at, at.missed, at.slope.transpose() * at.missed, options);
}

bool better(const InverseColour& a, const InverseColour& b) {
  if (a.exact != b.exact) return a.exact;
  return a.exact ? a.roughness < b.roughness : a.distance < b.distance;
}

void require_sound(Wishes wishes, const InverseOptions& options) {
  if (wishes.empty()) throw std::invalid_argument("an inverse colour needs a lighting");
  if (!(options.most > 0 && options.most < 1)) {
    throw std::invalid_argument(
        fmt::format("reflectances up to {}; want a number within 0..1", options.most));
  }
  for (const WishInLight& wish : wishes) {
    const Target& t = wish.target;
    if (!std::isfinite(t.lightness + t.a_c + t.b_c)) {
      throw std::invalid_argument(
          fmt::format("target J {} a_C {} b_C {}; want numbers", t.lightness, t.a_c, t.b_c));
    }
  }
}

}  // namespace

InverseColour inverse_colour(Wishes wishes, const InverseOptions& options) {
  require_sound(wishes, options);
  std::optional<InverseColour> best;
  std::string no_model;
  for (const double share : kStarts) {
    const Look start = look(wishes, options, VectorXd::Constant(kBands, share * options.most));
    if (!start.no_model.empty()) {
      no_model = start.no_model;
      continue;
    }
    const InverseColour found = solved_from(wishes, options, start);
    if (!best || better(found, *best)) best = found;
  }
  if (!best) throw std::domain_error(no_model);
  if (!best->exact) best->limit = colour_limit(wishes, best->reflectance, options);
  return *best;
}

}  // namespace paints
