#include <array>

#include "solver/factors/pair_factor.h"
#include "solver/judges/battery_cases.h"
#include "solver/judges/battery_rooms.h"
#include "solver/judges/closed_form.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::MatrixXd;

constexpr int kBands = 31;
/// X is stored in float; closed rows keep what that costs far below this, however bright the room.
constexpr double kFloatStorage = 1e-6;
constexpr double kSolved = 1e-10;  ///< relative error asked of a solve, small beside the tolerances

constexpr std::array kMethods{Method::conjugate_gradients, Method::jacobi, Method::gauss_seidel,
                              Method::progressive,         Method::direct, Method::bicgstab};

Bands parts_solved(const ExchangeAreas& exchange, const Parts& emission, const Parts& reflectance) {
  return solve_radiosity(exchange, emission, Bands::Zero(emission.rows(), emission.cols()),
                         Bands(reflectance), {.relative_error = kSolved})
      .radiosity;
}

/// Faces x0, x1, y0, y1, z0, z1 of a unit cube.
std::vector<Facet> cube_faces() {
  const Eigen::Vector3d middle(0.5, 0.5, 0.5);
  return {rectangle({0, 0, 0}, {0, 1, 1}, middle), rectangle({1, 0, 0}, {1, 1, 1}, middle),
          rectangle({0, 0, 0}, {1, 0, 1}, middle), rectangle({0, 1, 0}, {1, 1, 1}, middle),
          rectangle({0, 0, 0}, {1, 1, 0}, middle), rectangle({0, 0, 1}, {1, 1, 1}, middle)};
}

/// The parts of a brick in the order of scenes::kBrickParts, the wall around the window in four.
std::vector<std::vector<Facet>> brick_faces(const BrickShape& s) {
  const double w = s.width_m, d = s.depth_m, h = s.height_m, f = s.furniture_height * h;
  const double left = s.window_offset_m, right = left + s.window_width_m;
  const double sill = s.window_sill_m, top = sill + s.window_height_m;
  const Eigen::Vector3d middle(w / 2, d / 2, h / 2);
  const auto face = [&](const Eigen::Vector3d& low, const Eigen::Vector3d& high) {
    return rectangle(low, high, middle);
  };
  return {{face({0, 0, 0}, {w, d, 0})},
          {face({0, 0, h}, {w, d, h})},
          {face({0, 0, 0}, {left, 0, h}), face({right, 0, 0}, {w, 0, h}),
           face({left, 0, 0}, {right, 0, sill}), face({left, 0, top}, {right, 0, h})},
          {face({left, 0, sill}, {right, 0, top})},
          {face({w, 0, f}, {w, d, h})},
          {face({0, d, f}, {w, d, h})},
          {face({0, 0, f}, {0, d, h})},
          {face({w, 0, 0}, {w, d, f})},
          {face({0, d, 0}, {w, d, f})},
          {face({0, 0, 0}, {0, d, f})}};
}

/// One patch per part, whatever its shape.
ExchangeAreas exchange_of(const std::vector<std::vector<Facet>>& parts) {
  const auto n = static_cast<Eigen::Index>(parts.size());
  MatrixXd exchange = MatrixXd::Zero(n, n);
  ArrayXd area_m2 = ArrayXd::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (const Facet& a : parts[static_cast<std::size_t>(i)]) {
      area_m2[i] += a.area_m2;
      for (Eigen::Index j = 0; j < i; ++j) {
        for (const Facet& b : parts[static_cast<std::size_t>(j)]) {
          exchange(j, i) = exchange(i, j) += exchange_area(a, b);
        }
      }
    }
  }
  return close_exchange(exchange, area_m2);
}

}  // namespace

// Inside a sphere F_ij = A_j / A, wherever the patches lie: all see the same light. With
// b = sum_j A_j B_j / A and H_i = D_i + b:
// b = sum_j A_j (S_j + rho_j D_j) / sum_j A_j (1 - rho_j).
std::vector<Check> check_sphere() {
  constexpr int kPatches = 100;
  Dice dice(5);
  const ArrayXd area_m2 = ArrayXd::NullaryExpr(kPatches, [&] { return dice(0.01, 1); });
  const MatrixXd exchange = area_m2.matrix() * area_m2.matrix().transpose() / area_m2.sum();
  const ExchangeAreas sphere = close_exchange(exchange, area_m2);
  const Bands emission = dice.bands(kPatches, kBands, 1), direct = dice.bands(kPatches, kBands, 1),
              reflectance = dice.bands(kPatches, kBands, 0.9999);
  const auto flux = [&](const Bands& density) {
    return (area_m2.matrix().transpose() * density.matrix()).array().eval();
  };
  const BandRow even = flux(emission + reflectance * direct) / flux(1 - reflectance);
  const Bands expected = direct.rowwise() + even;
  std::vector<Check> checks;
  for (const Method method : kMethods) {
    const RadiositySolution solution = solve_radiosity(
        sphere, emission, direct, reflectance, {.method = method, .relative_error = kSolved});
    checks.push_back(worst_of({.name = std::string("sphere, ") + to_string(method),
                               .quantity = "irradiance, W/m2/nm, 100 patches",
                               .tolerance = kFloatStorage},
                              flat(expected), flat(solution.irradiance)));
  }
  return checks;
}

// Infinite plates see only each other: B_1 = (S_1 + rho_1 S_2) / (1 - rho_1 rho_2).
std::vector<Check> check_plates() {
  const ExchangeAreas plates = close_exchange(MatrixXd{{0, 2}, {2, 0}}, ArrayXd::Constant(2, 2));
  Dice dice(6);
  const Bands emission = dice.bands(2, kBands, 1);
  Bands reflectance(2, kBands);
  reflectance << BandRow::LinSpaced(kBands, 0, 0.999), BandRow::LinSpaced(kBands, 0.999, 0.99);
  const Bands other_emission = emission.colwise().reverse();
  const Bands expected = (emission + reflectance * other_emission).rowwise() /
                         (1 - reflectance.colwise().prod()).eval();
  std::vector<Check> checks;
  for (const Method method : kMethods) {
    const RadiositySolution solution =
        solve_radiosity(plates, emission, Bands::Zero(2, kBands), reflectance,
                        {.method = method, .relative_error = kSolved});
    checks.push_back(worst_of({.name = std::string("infinite plates, ") + to_string(method),
                               .quantity = "radiosity, W/m2/nm",
                               .tolerance = 1e-8},
                              flat(expected), flat(solution.radiosity)));
  }
  return checks;
}

// [Neumann2004] eq. 13-16: with the factor 0.2 for every pair, and with those of the unit cube.
std::vector<Check> check_cube() {
  Dice dice(7);
  const Parts emission = dice.bands(6, kBands, 1), reflectance = dice.bands(6, kBands, 0.9999);
  std::vector<std::vector<Facet>> parts;
  for (const Facet& face : cube_faces()) parts.push_back({face});
  const MatrixXd printed = 0.2 * (MatrixXd::Ones(6, 6) - MatrixXd::Identity(6, 6));
  const auto check = [&](const char* name, const CubeFactors& factors,
                         const ExchangeAreas& exchange) {
    return worst_of(
        {.name = name, .quantity = "radiosity, W/m2/nm, 6 faces", .tolerance = kFloatStorage},
        flat(cube_radiosity(emission, reflectance, factors)),
        flat(parts_solved(exchange, emission, reflectance)));
  };
  return {check("cube, factors 0.2", {}, close_exchange(printed, ArrayXd::Ones(6))),
          check("cube, exact factors", exact_cube_factors(), exchange_of(parts))};
}

// [Neumann2004] 4.3, ten parts.
std::vector<Check> check_brick() {
  const BrickShape shape{.width_m = 5,
                         .depth_m = 4,
                         .height_m = 2.7,
                         .furniture_height = 0.3,
                         .window_width_m = 2,
                         .window_height_m = 1.2,
                         .window_sill_m = 0.9,
                         .window_offset_m = 1};
  Dice dice(8);
  const Parts emission = dice.bands(10, kBands, 1), reflectance = dice.bands(10, kBands, 0.9999);
  return {worst_of(
      {.name = "brick", .quantity = "radiosity, W/m2/nm, 10 parts", .tolerance = kFloatStorage},
      flat(brick_radiosity(shape, emission, reflectance)),
      flat(parts_solved(exchange_of(brick_faces(shape)), emission, reflectance)))};
}

}  // namespace solver
