#include "solver/judges/closed_form.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "solver/factors/pair_factor.h"

namespace solver {
namespace {

using Array6 = Eigen::Array<double, 6, 1>;
using Array10 = Eigen::Array<double, 10, 1>;
using Matrix10 = Eigen::Matrix<double, 10, 10>;

constexpr std::array kOpposite{1, 0, 3, 2, 5, 4};

void require_parts(const Parts& emission, const Parts& reflectance, Eigen::Index parts) {
  if (emission.rows() != parts || reflectance.rows() != parts ||
      emission.cols() != reflectance.cols()) {
    throw std::invalid_argument(fmt::format(
        "emission is {} x {}, reflectance {} x {}; want {} parts and as many "
        "wavelengths in both",
        emission.rows(), emission.cols(), reflectance.rows(), reflectance.cols(), parts));
  }
  if (!(emission >= 0 && emission.isFinite()).all()) {  // written so that NaN fails too
    throw std::invalid_argument("an emission is negative or not finite");
  }
  if (!(reflectance >= 0 && reflectance < 1).all()) {
    throw std::invalid_argument("a reflectance is not in [0, 1)");
  }
}

/// An axis-aligned rectangle, no extent along `axis`; `sign` -1 takes its light away from another.
struct Rectangle {
  int axis = 0;
  Eigen::Array3d low, high;
  double sign = 1;
};

/// A_i F_ij of two rectangles that bound the brick.
double exchange_area_m2(const Rectangle& i, const Rectangle& j) {
  const auto span = [](const Rectangle& r, int axis) { return Span{r.low[axis], r.high[axis]}; };
  if (i.axis == j.axis) {
    const double gap_m = std::abs(i.low[i.axis] - j.low[j.axis]);
    const int first = (i.axis + 1) % 3, second = (i.axis + 2) % 3;
    return gap_m == 0 ? 0
                      : parallel_rectangles(span(i, first), span(i, second), span(j, first),
                                            span(j, second), gap_m);
  }
  // Distances are from the line in which the two planes meet.
  const auto distance = [](const Rectangle& r, const Rectangle& other) {
    const double line = other.low[other.axis];
    const double a = std::abs(r.low[other.axis] - line), b = std::abs(r.high[other.axis] - line);
    return Span{std::min(a, b), std::max(a, b)};
  };
  const int along = 3 - i.axis - j.axis;
  return perpendicular_rectangles(distance(i, j), span(i, along), distance(j, i), span(j, along));
}

void require_brick(const BrickShape& s) {
  const auto length = [](double value) { return value >= 0 && std::isfinite(value); };
  const bool box = length(s.width_m) && length(s.depth_m) && length(s.height_m) &&
                   s.width_m * s.depth_m * s.height_m > 0;
  if (!box) throw std::invalid_argument("width, depth and height of a brick must be above 0");
  if (!(s.furniture_height >= 0 && s.furniture_height < 1)) {
    throw std::invalid_argument("furniture_height is a share of the height; want 0 to below 1");
  }
  const bool inside = length(s.window_width_m) && length(s.window_height_m) &&
                      length(s.window_offset_m) && length(s.window_sill_m) &&
                      s.window_offset_m + s.window_width_m <= s.width_m &&
                      s.window_sill_m + s.window_height_m <= s.height_m;
  if (!inside) throw std::invalid_argument("the window does not lie in its wall");
}

/// The ten parts as sums of rectangles, in the order of scenes::kBrickParts.
std::array<std::vector<Rectangle>, 10> brick_parts(const BrickShape& s) {
  require_brick(s);
  const double w = s.width_m, d = s.depth_m, h = s.height_m, f = s.furniture_height * h;
  const double left = s.window_offset_m, right = left + s.window_width_m;
  const double sill = s.window_sill_m, top = sill + s.window_height_m;
  const Rectangle window{.axis = 1, .low = {left, 0, sill}, .high = {right, 0, top}};
  Rectangle hole = window;
  hole.sign = -1;
  return {{{{.axis = 2, .low = {0, 0, 0}, .high = {w, d, 0}}},
           {{.axis = 2, .low = {0, 0, h}, .high = {w, d, h}}},
           {{.axis = 1, .low = {0, 0, 0}, .high = {w, 0, h}}, hole},
           {window},
           {{.axis = 0, .low = {w, 0, f}, .high = {w, d, h}}},
           {{.axis = 1, .low = {0, d, f}, .high = {w, d, h}}},
           {{.axis = 0, .low = {0, 0, f}, .high = {0, d, h}}},
           {{.axis = 0, .low = {w, 0, 0}, .high = {w, d, f}}},
           {{.axis = 1, .low = {0, d, 0}, .high = {w, d, f}}},
           {{.axis = 0, .low = {0, 0, 0}, .high = {0, d, f}}}}};
}

Matrix10 exchange_areas_m2(const BrickShape& shape) {
  const auto parts = brick_parts(shape);
  Matrix10 exchange = Matrix10::Zero();
  for (int i = 0; i < 10; ++i) {
    for (int j = 0; j < i; ++j) {
      for (const Rectangle& a : parts[static_cast<std::size_t>(i)]) {
        for (const Rectangle& b : parts[static_cast<std::size_t>(j)]) {
          exchange(i, j) += a.sign * b.sign * exchange_area_m2(a, b);
        }
      }
      exchange(j, i) = exchange(i, j) = std::max(exchange(i, j), 0.0);
    }
  }
  return exchange;
}

/// Sixteen terms cancel in each closed form, and small parts feel it. Scaling X_ij to
/// d_i X_ij d_j, d = 1 + e, closes the rows again and keeps reciprocity; e is so small that its
/// square is lost.
Matrix10 closed(const Matrix10& exchange_m2, const Array10& area_m2) {
  const Array10 defect = area_m2 - exchange_m2.rowwise().sum().array();
  Matrix10 system = exchange_m2;
  system.diagonal().array() += (area_m2 > 0).select(area_m2, 1);
  const Array10 scale = 1 + system.lu().solve(defect.matrix()).array();
  return scale.matrix().asDiagonal() * exchange_m2 * scale.matrix().asDiagonal();
}

/// B_i = S_i + rho_i (o B_i' + a (B - s)), with i' opposite to i, s = B_i + B_i', and B the sum of
/// all six. For one pair that is 2 x 2 in B_i and B_i', and linear in the light c = a (B - s) that
/// comes from the four others: s = e + g c, hence s = (e + a g B)/(1 + a g); the three s sum to B.
/// With o = a = 0.2 these are eq. 15-16.
Array6 cube_at_one_wavelength(const Array6& emission, const Array6& rho, const CubeFactors& f) {
  const Array6 opposite_rho = rho(kOpposite), opposite_emission = emission(kOpposite);
  const Array6 determinant = 1 - f.opposite * f.opposite * rho * opposite_rho;
  // B_i = own + gain c
  const Array6 own = (emission + f.opposite * rho * opposite_emission) / determinant;
  const Array6 gain = rho * (1 + f.opposite * opposite_rho) / determinant;
  const Array6 e = own + own(kOpposite), ag = f.adjacent * (gain + gain(kOpposite));
  // Each pair is counted twice in these sums over six.
  const double total = (e / (1 + ag)).sum() / 2 / (1 - (ag / (1 + ag)).sum() / 2);
  return own + gain * f.adjacent * (total - e) / (1 + ag);
}

}  // namespace

CubeFactors exact_cube_factors() {
  using std::numbers::pi, std::numbers::sqrt2;
  // Opposite unit squares at unit distance [Howell2010] C-11; the four others share the rest.
  const double opposite = (std::log(4.0 / 3) + 4 * sqrt2 * std::atan(1 / sqrt2)) / pi - 1;
  return {.opposite = opposite, .adjacent = (1 - opposite) / 4};
}

Parts cube_radiosity(const Parts& emission, const Parts& reflectance, const CubeFactors& factors) {
  require_parts(emission, reflectance, 6);
  Parts radiosity(6, emission.cols());
  for (Eigen::Index k = 0; k < emission.cols(); ++k) {
    radiosity.col(k) = cube_at_one_wavelength(emission.col(k), reflectance.col(k), factors);
  }
  return radiosity;
}

Matrix10 brick_form_factors(const BrickShape& shape) {
  const Array10 area = brick_areas_m2(shape);
  const Matrix10 exchange = closed(exchange_areas_m2(shape), area);
  return (area > 0).select(area.inverse(), 0).matrix().asDiagonal() * exchange;
}

Array10 brick_areas_m2(const BrickShape& shape) {
  Array10 area = Array10::Zero();
  int part = 0;
  for (const std::vector<Rectangle>& rectangles : brick_parts(shape)) {
    for (const Rectangle& r : rectangles) {
      const Eigen::Array3d size = r.high - r.low;
      area[part] += r.sign * size[(r.axis + 1) % 3] * size[(r.axis + 2) % 3];
    }
    ++part;
  }
  return area;
}

Parts brick_radiosity(const BrickShape& shape, const Parts& emission, const Parts& reflectance) {
  require_parts(emission, reflectance, 10);
  const Matrix10 factors = brick_form_factors(shape);
  Parts radiosity(10, emission.cols());
  for (Eigen::Index k = 0; k < emission.cols(); ++k) {
    const Matrix10 bounces = reflectance.col(k).matrix().asDiagonal() * factors;
    radiosity.col(k).matrix() =
        (Matrix10::Identity() - bounces).lu().solve(emission.col(k).matrix());
  }
  return radiosity;
}

}  // namespace solver
