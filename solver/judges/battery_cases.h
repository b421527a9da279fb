#pragma once
#include <Eigen/Core>
#include <random>
#include <vector>

#include "solver/bounce/radiosity.h"
#include "solver/exchange/exchange.h"
#include "solver/judges/check.h"

namespace solver {

/// Inside the battery: its groups, and what they share.

std::vector<Check> check_squares();
std::vector<Check> check_offsets();
std::vector<Check> check_strips();
std::vector<Check> check_touching_polygons();
std::vector<Check> check_sphere();
std::vector<Check> check_plates();
std::vector<Check> check_cube();
std::vector<Check> check_brick();
std::vector<Check> check_white_furnace();
std::vector<Check> check_flux();
std::vector<Check> check_cie171_5_2();
std::vector<Check> check_cie171_5_3();
std::vector<Check> check_cie171_5_4();
std::vector<Check> check_cie171_5_6();
std::vector<Check> check_cie171_5_7();
std::vector<Check> check_cie171_5_8();
std::vector<Check> check_daylight_roof();
std::vector<Check> check_daylight_facade();
std::vector<Check> check_daylight_flux();
std::vector<Check> check_sun_position();

/// The pair that errs most.
[[nodiscard]] Check worst_of(const Check& what, const Eigen::ArrayXd& expected,
                             const Eigen::ArrayXd& computed);

/// The same numbers on every machine, unlike the distributions of the standard library.
class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}

  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(random_()) * 0x1p-32;
  }

  Bands bands(Eigen::Index rows, Eigen::Index columns, double high) {
    return Bands::NullaryExpr(rows, columns, [&] { return (*this)(0, high); });
  }

 private:
  std::mt19937 random_;
};

/// Between two opposite corners that differ along two axes; its front is where `front` lies.
[[nodiscard]] Facet rectangle(const Eigen::Vector3d& low, const Eigen::Vector3d& high,
                              const Eigen::Vector3d& front);

/// Row by row, as `worst_of` takes them.
[[nodiscard]] inline Eigen::ArrayXd flat(const Bands& bands) {
  return Eigen::Map<const Eigen::ArrayXd>(bands.data(), bands.size());
}

}  // namespace solver
