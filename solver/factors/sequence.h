#pragma once
#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>

namespace solver {

using Samples16 = Eigen::Array<float, 16, 1>;

/// Additive recurrence in four dimensions, k times a fixed step in each, shifted by a hash of the
/// seed. Low discrepancy without tables; any run of consecutive points is such a sequence again.
class Sequence4 {
 public:
  using Steps = std::array<double, 4>;

  /// 1/g, 1/g^2, ..., g the positive root of g^5 = g + 1: even in all four dimensions together.
  static constexpr Steps kEven{0.85667488385450287, 0.73389185662460043, 0.62870672081186297,
                               0.53859725722361198};

  /// The first two are those of the plane, 1/g and 1/g^2 with g^3 = g + 1, the others sqrt 2 and
  /// sqrt 3: for integrands that depend on the first two most.
  static constexpr Steps kPlaneFirst{0.75487766624669276, 0.56984029099805327, 0.41421356237309505,
                                     0.73205080756887729};

  explicit Sequence4(std::uint64_t seed, const Steps& steps = kEven) : step_(steps) {
    for (double& s : shift_) {
      seed += 0x9e3779b97f4a7c15ULL;  // splitmix64
      std::uint64_t z = seed;
      z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
      z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
      s = static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }
  }

  [[nodiscard]] double operator()(int k, int dimension) const {
    const auto d = static_cast<std::size_t>(dimension);
    const double v = shift_[d] + k * step_[d];
    return v - static_cast<double>(static_cast<std::int64_t>(v));
  }

  /// 16 consecutive points of one dimension, in 32 bits.
  [[nodiscard]] Samples16 sixteen(int first, int dimension) const {
    constexpr double kWhole = 0x1p32;
    const auto start = static_cast<std::uint32_t>((*this)(first, dimension) * kWhole);
    const auto step =
        static_cast<std::uint32_t>(step_[static_cast<std::size_t>(dimension)] * kWhole);
    Samples16 points;
    for (std::uint32_t k = 0; k < 16; ++k) {
      const std::uint32_t at = start + k * step;  // wraps as the sequence does
      points[static_cast<int>(k)] = static_cast<float>(static_cast<std::int32_t>(at >> 8U));
    }
    return points * 0x1p-24F;
  }

 private:
  Steps step_, shift_{};
};

}  // namespace solver
