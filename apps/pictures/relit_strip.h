#pragma once
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <limits>

namespace apps {

/// One channel of a picture, over the pixels whose three components are finite numbers.
struct ChannelStatistics {
  float lowest = std::numeric_limits<float>::infinity();
  float highest = -std::numeric_limits<float>::infinity();
  double sum = 0;
  std::int64_t negative = 0;
};

/// What relighting met and made, before values are rounded to the file's type.
struct PixelStatistics {
  std::int64_t pixels = 0;
  std::int64_t not_finite = 0;  ///< NaN or infinite component: left as it was
  std::int64_t negative = 0;    ///< a component below 0 after relighting
  std::int64_t overflowed = 0;  ///< a component too large for the type of its channel
  std::array<ChannelStatistics, 3> before, after;

  void add(const PixelStatistics& other);
};

/// A change of light: every pixel becomes matrix * pixel.
struct Relighting {
  Eigen::Matrix3f matrix;
  /// From here on a value is infinite in the type of its channel, R, G, B.
  std::array<float, 3> infinite{};
};

/// Longest strip: three channels of it stay in the first-level cache.
inline constexpr int kStrip = 1024;

/// Relights `count` pixels in place, 1 to kStrip of them, and adds to the statistics. The sums of a
/// strip do not depend on where it lies in memory.
void relight_strip(const Relighting& relighting, const std::array<float*, 3>& rgb, int count,
                   PixelStatistics& statistics);

}  // namespace apps
