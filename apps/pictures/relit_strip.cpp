#include "apps/pictures/relit_strip.h"

#include <algorithm>
#include <cmath>

namespace apps {
namespace {

// Loops over a strip are kept so plain that the compiler vectorises each of them; as the strip is
// in the first-level cache, several passes cost less than one that branches.
using Rgb = std::array<float*, 3>;
using Lanes = Eigen::Array<float, 16, 1>;  // reductions by hand: their order is ours to keep

int count_not_finite(const Rgb& rgb, int count) {
  int found = 0;
  for (int i = 0; i < count; ++i) {
    const float probe = 0 * rgb[0][i] + 0 * rgb[1][i] + 0 * rgb[2][i];  // NaN unless all are finite
    found += probe == 0 ? 0 : 1;
  }
  return found;
}

int count_negative(const float* values, int count) {
  int found = 0;
  for (int i = 0; i < count; ++i) found += values[i] < 0 ? 1 : 0;
  return found;
}

int count_negative_pixels(const Rgb& rgb, int count) {
  int found = 0;
  for (int i = 0; i < count; ++i) {
    found += std::min(rgb[0][i], std::min(rgb[1][i], rgb[2][i])) < 0 ? 1 : 0;
  }
  return found;
}

int count_overflowed(const Rgb& rgb, const std::array<float, 3>& infinite, int count) {
  int found = 0;
  for (int i = 0; i < count; ++i) {
    bool fits = true;  // written so that infinity minus infinity does not fit either
    for (std::size_t c = 0; c < 3; ++c) fits = fits && std::abs(rgb[c][i]) < infinite[c];
    found += fits ? 0 : 1;
  }
  return found;
}

ChannelStatistics channel_of(const float* values, int count) {
  Lanes sum = Lanes::Zero(), low = Lanes::Constant(values[0]), high = low;
  const int whole = count - count % static_cast<int>(Lanes::SizeAtCompileTime);
  for (int i = 0; i < whole; i += static_cast<int>(Lanes::SizeAtCompileTime)) {
    const Lanes v = Eigen::Map<const Lanes>(values + i);
    sum += v;
    low = low.min(v);
    high = high.max(v);
  }
  ChannelStatistics channel{
      .lowest = low.minCoeff(), .highest = high.maxCoeff(), .sum = sum.cast<double>().sum()};
  for (int i = whole; i < count; ++i) {
    channel.lowest = std::min(channel.lowest, values[i]);
    channel.highest = std::max(channel.highest, values[i]);
    channel.sum += static_cast<double>(values[i]);
  }
  if (channel.lowest < 0) channel.negative = count_negative(values, count);
  return channel;
}

void add(ChannelStatistics& to, const ChannelStatistics& channel) {
  to.lowest = std::min(to.lowest, channel.lowest);
  to.highest = std::max(to.highest, channel.highest);
  to.sum += channel.sum;
  to.negative += channel.negative;
}

// AVX2 without FMA gives the same bits.
__attribute__((target_clones("avx2", "default"))) void multiply(const Eigen::Matrix3f& m,
                                                                const Rgb& rgb, int count) {
  float* __restrict r = rgb[0];
  float* __restrict g = rgb[1];
  float* __restrict b = rgb[2];
  const float rr = m(0, 0), rg = m(0, 1), rb = m(0, 2);
  const float gr = m(1, 0), gg = m(1, 1), gb = m(1, 2);
  const float br = m(2, 0), bg = m(2, 1), bb = m(2, 2);
  for (int i = 0; i < count; ++i) {
    const float x = r[i], y = g[i], z = b[i];
    r[i] = rr * x + rg * y + rb * z;
    g[i] = gr * x + gg * y + gb * z;
    b[i] = br * x + bg * y + bb * z;
  }
}

/// relight_strip() where all pixels are finite.
void relight_finite(const Relighting& relighting, const Rgb& rgb, int count,
                    PixelStatistics& statistics) {
  for (std::size_t c = 0; c < 3; ++c) add(statistics.before[c], channel_of(rgb[c], count));
  multiply(relighting.matrix, rgb, count);
  bool negative = false, fits = true;
  for (std::size_t c = 0; c < 3; ++c) {
    const ChannelStatistics channel = channel_of(rgb[c], count);
    add(statistics.after[c], channel);
    negative = negative || channel.negative > 0;
    fits = fits && std::abs(channel.sum) < std::numeric_limits<double>::infinity() &&
           std::max(-channel.lowest, channel.highest) < relighting.infinite[c];
  }
  if (negative) statistics.negative += count_negative_pixels(rgb, count);
  if (!fits) statistics.overflowed += count_overflowed(rgb, relighting.infinite, count);
}

}  // namespace

void PixelStatistics::add(const PixelStatistics& other) {
  pixels += other.pixels;
  not_finite += other.not_finite;
  negative += other.negative;
  overflowed += other.overflowed;
  for (std::size_t c = 0; c < 3; ++c) {
    apps::add(before[c], other.before[c]);
    apps::add(after[c], other.after[c]);
  }
}

void relight_strip(const Relighting& relighting, const std::array<float*, 3>& rgb, int count,
                   PixelStatistics& statistics) {
  statistics.pixels += count;
  const int not_finite = count_not_finite(rgb, count);
  if (not_finite == 0) return relight_finite(relighting, rgb, count, statistics);

  statistics.not_finite += not_finite;
  std::array<int, kStrip> kept;
  int finite = 0;
  for (int i = 0; i < count; ++i) {
    kept[static_cast<std::size_t>(finite)] = i;
    finite += std::isfinite(rgb[0][i]) && std::isfinite(rgb[1][i]) && std::isfinite(rgb[2][i]);
  }
  if (finite == 0) return;
  std::array<std::array<float, kStrip>, 3> copy;
  const Rgb packed{copy[0].data(), copy[1].data(), copy[2].data()};
  const auto each = [&](const auto& move) {
    for (std::size_t c = 0; c < 3; ++c) {
      for (int k = 0; k < finite; ++k)
        move(packed[c][k], rgb[c][kept[static_cast<std::size_t>(k)]]);
    }
  };
  each([](float& to, float from) { to = from; });
  relight_finite(relighting, packed, finite, statistics);
  each([](float from, float& to) { to = from; });
}

}  // namespace apps
