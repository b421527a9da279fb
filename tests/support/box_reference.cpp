// Writes the reference light of the closed 5 x 4 x 2.7 m box of scenes/rooms/box.json to standard
// output, by path tracing that shares no code with the solver: cosine-weighted directions, faces
// met in closed form, the lamp's light added at every bounce by its contour integral. Nothing is
// discretised; what is left is noise, given beside.
//
//   g++ -O2 -std=c++20 tests/support/box_reference.cpp -o box_reference && ./box_reference >
//   tests/data/box_reference.csv
//
// The irradiance of a receiver is a power series in reflectance, so the coefficients serve every
// wall colour:
//   walls:   E = exitance * sum_m c_m rho_w^m, floor 0.25, ceiling 0.85, lamp 0, m wall bounces;
//   uniform: E = exitance * sum_m c_m rho^m, every face rho, the lamp too; c_m goes to (lamp area)
//   / (room area).
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>

namespace {

using Vector = std::array<double, 3>;

constexpr Vector kSize{5, 4, 2.7};
constexpr Vector kLampLow{1.9, 1.4, 2.7}, kLampHigh{3.1, 2.6, 2.7};
constexpr int kMostBounces = 60;
constexpr int kBatches = 64, kPathsPerBatch = 1 << 16;

struct Receiver {
  const char* name;
  Vector at;
  int axis;     // of the normal
  double sign;  // of the normal
};

constexpr std::array<Receiver, 5> kReceivers{
    {{"north wall middle", {2.5, 4.0, 1.35}, 1, -1},
     {"floor middle", {2.5, 2.0, 0.0}, 2, 1},
     {"ceiling", {0.6, 0.6, 2.7}, 2, -1},
     {"north wall 5 cm above the floor", {2.5, 4.0, 0.05}, 1, -1},
     {"floor 5 cm from the west wall", {0.05, 2.0, 0.0}, 2, 1}}};

struct Random {  // PCG, 64 bits of state
  std::uint64_t state;

  double operator()() {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    const auto mixed = static_cast<std::uint32_t>(((state >> 18U) ^ state) >> 27U);
    const auto turn = static_cast<std::uint32_t>(state >> 59U);
    const std::uint32_t out = (mixed >> turn) | (mixed << ((32U - turn) & 31U));
    return (out + 0.5) * 0x1p-32;
  }
};

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// Form factor from a point to the lamp; the lamp is above every point that sees it.
double lamp_factor(const Vector& p, int axis, double sign) {
  if (axis == 2 && sign < 0) return 0;
  const std::array<Vector, 4> corner{{{kLampLow[0], kLampLow[1], kSize[2]},
                                      {kLampHigh[0], kLampLow[1], kSize[2]},
                                      {kLampHigh[0], kLampHigh[1], kSize[2]},
                                      {kLampLow[0], kLampHigh[1], kSize[2]}}};
  double sum = 0;
  for (std::size_t k = 0; k < 4; ++k) {
    Vector a{}, b{};
    for (std::size_t d = 0; d < 3; ++d) {
      a[d] = corner[k][d] - p[d];
      b[d] = corner[(k + 1) % 4][d] - p[d];
    }
    const Vector c = cross(a, b);
    const double length = std::sqrt(dot(c, c));
    if (length > 0)
      sum += std::atan2(length, dot(a, b)) * sign * c[static_cast<std::size_t>(axis)] / length;
  }
  return std::abs(sum) / (2 * std::numbers::pi);
}

/// The next face along a cosine-weighted direction.
void bounce(Vector& p, int& axis, double& sign, double u, double v) {
  const double radius = std::sqrt(u), angle = 2 * std::numbers::pi * v;
  Vector d{};
  d[static_cast<std::size_t>(axis)] = sign * std::sqrt(1 - u);
  d[static_cast<std::size_t>((axis + 1) % 3)] = radius * std::cos(angle);
  d[static_cast<std::size_t>((axis + 2) % 3)] = radius * std::sin(angle);
  double nearest = 1e300;
  int face = 0;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    if (k == axis && d[i] * sign <= 0) continue;
    const double t = d[i] > 0 ? (kSize[i] - p[i]) / d[i] : d[i] < 0 ? -p[i] / d[i] : 1e300;
    if (t < nearest) {
      nearest = t;
      face = k;
    }
  }
  const auto f = static_cast<std::size_t>(face);
  for (std::size_t k = 0; k < 3; ++k) p[k] += nearest * d[k];
  sign = d[f] > 0 ? -1 : 1;
  p[f] = d[f] > 0 ? kSize[f] : 0;
  axis = face;
}

bool on_lamp(const Vector& p, int axis, double sign) {
  return axis == 2 && sign < 0 && p[0] > kLampLow[0] && p[0] < kLampHigh[0] && p[1] > kLampLow[1] &&
         p[1] < kLampHigh[1];
}

using Series = std::array<double, kMostBounces + 1>;

/// One path adds to both series; its first two bounces are stratified by (k + shift) of an additive
/// recurrence.
void trace(const Receiver& r, std::uint64_t k, const std::array<double, 4>& shift, Random& random,
           Series& walls, Series& uniform) {
  constexpr std::array<double, 4> kStep{0.85667488385450287, 0.73389185662460043,
                                        0.62870672081186297, 0.53859725722361198};
  Vector p = r.at;
  int axis = r.axis;
  double sign = r.sign, weight = 1;
  std::size_t wall_bounces = 0;
  for (std::size_t m = 1; m <= kMostBounces; ++m) {
    double u = 0, v = 0;
    if (m <= 2) {
      const std::size_t d = 2 * (m - 1);
      u = std::fmod(shift[d] + static_cast<double>(k) * kStep[d], 1);
      v = std::fmod(shift[d + 1] + static_cast<double>(k) * kStep[d + 1], 1);
    } else {
      u = random();
      v = random();
    }
    bounce(p, axis, sign, u, v);
    const double light = lamp_factor(p, axis, sign);
    uniform[m] += light;
    if (on_lamp(p, axis, sign)) weight = 0;
    if (axis == 2) {
      weight *= sign > 0 ? 0.25 : 0.85;
    } else {
      ++wall_bounces;
    }
    walls[wall_bounces] += weight * light;
  }
}

}  // namespace

int main() {
  std::printf("receiver,case,m,coefficient,standard_error\n");
  for (const Receiver& r : kReceivers) {
    std::array<Series, 2> sum{}, square{};
    Random random{12345};
    for (int b = 0; b < kBatches; ++b) {
      const std::array<double, 4> shift{random(), random(), random(), random()};
      std::array<Series, 2> batch{};
      for (int k = 0; k < kPathsPerBatch; ++k) {
        trace(r, static_cast<std::uint64_t>(k), shift, random, batch[0], batch[1]);
      }
      for (std::size_t c = 0; c < 2; ++c) {
        for (std::size_t m = 0; m <= kMostBounces; ++m) {
          const double mean =
              batch[c][m] / kPathsPerBatch + (m == 0 ? lamp_factor(r.at, r.axis, r.sign) : 0);
          sum[c][m] += mean;
          square[c][m] += mean * mean;
        }
      }
    }
    for (std::size_t c = 0; c < 2; ++c) {
      for (std::size_t m = 0; m <= kMostBounces; ++m) {
        const double mean = sum[c][m] / kBatches;
        const double variance =
            std::fmax(0, square[c][m] / kBatches - mean * mean) / (kBatches - 1);
        std::printf("%s,%s,%zu,%.9g,%.2g\n", r.name, c == 0 ? "walls" : "uniform", m, mean,
                    std::sqrt(variance));
      }
    }
  }
}
