#include "apps/pictures/exr_block.h"

#include <Imath/ImathFun.h>

#include <algorithm>
#include <limits>
#include <string_view>

#include "apps/pictures/for_rows.h"
#include "apps/pictures/half_floats.h"

namespace apps {
namespace {

std::int64_t bytes_of(Imf::PixelType type) { return type == Imf::HALF ? 2 : 4; }

/// Most samples that so many pixels can hold, wherever they begin.
std::int64_t samples_in(std::int64_t pixels, int sampling) {
  return (pixels + sampling - 2) / sampling + 1;
}

}  // namespace

ExrBlock::ExrBlock(const Imf::ChannelList& channels, std::int64_t width, std::int64_t height) {
  for (auto it = channels.begin(); it != channels.end(); ++it) {
    const Imf::Channel& channel = it.channel();
    const std::int64_t columns = samples_in(width, channel.xSampling);
    const std::int64_t rows = samples_in(height, channel.ySampling);
    const auto row_bytes = static_cast<std::size_t>(columns * bytes_of(channel.type));
    for (std::size_t c = 0; c < 3; ++c) {
      if (it.name() == std::string_view("RGB").substr(c, 1)) rgb_[c] = planes_.size();
    }
    planes_.push_back(
        {.name = it.name(),
         .channel = channel,
         .row_bytes = row_bytes,
         .samples = std::vector<std::byte>(row_bytes * static_cast<std::size_t>(rows))});
  }
}

std::int64_t ExrBlock::bytes(const Imf::ChannelList& channels, std::int64_t width,
                             std::int64_t height) {
  std::int64_t total = 0;
  for (auto it = channels.begin(); it != channels.end(); ++it) {
    total += samples_in(width, it.channel().xSampling) *
             samples_in(height, it.channel().ySampling) * bytes_of(it.channel().type);
  }
  return total;
}

Imf::FrameBuffer ExrBlock::at(const Imath::Box2i& window) {
  width_ = std::int64_t{window.max.x} - window.min.x + 1;
  height_ = std::int64_t{window.max.y} - window.min.y + 1;
  Imf::FrameBuffer slices;
  for (Plane& plane : planes_) {
    const auto& [type, x_sampling, y_sampling, linear] = plane.channel;
    const std::int64_t stride = bytes_of(type);
    const std::int64_t first =
        Imath::divp(window.min.x, x_sampling) * stride +
        Imath::divp(window.min.y, y_sampling) * static_cast<std::int64_t>(plane.row_bytes);
    // The library wants the address of pixel (0, 0), which may be far outside of the block.
    char* origin = reinterpret_cast<char*>(reinterpret_cast<std::intptr_t>(plane.samples.data()) -
                                           static_cast<std::intptr_t>(first));
    slices.insert(plane.name, Imf::Slice(type, origin, static_cast<std::size_t>(stride),
                                         plane.row_bytes, x_sampling, y_sampling));
  }
  return slices;
}

PixelStatistics ExrBlock::relight(const Eigen::Matrix3f& matrix, int threads) {
  Relighting relighting{.matrix = matrix};
  for (std::size_t c = 0; c < 3; ++c) {
    const bool is_half = planes_[rgb_[c]].channel.type == Imf::HALF;
    relighting.infinite[c] = is_half ? kInfiniteHalf : std::numeric_limits<float>::infinity();
  }
  std::vector<PixelStatistics> rows(static_cast<std::size_t>(height_));
  for_rows(height_, threads, [&](std::size_t row) { relight_row(relighting, row, rows[row]); });
  PixelStatistics sum;
  for (const PixelStatistics& row : rows) sum.add(row);
  return sum;
}

void ExrBlock::relight_row(const Relighting& relighting, std::size_t row,
                           PixelStatistics& statistics) {
  std::array<std::array<float, kStrip>, 3> as_float;
  for (std::int64_t x = 0; x < width_; x += kStrip) {
    const auto count = static_cast<int>(std::min<std::int64_t>(kStrip, width_ - x));
    std::array<float*, 3> rgb{};
    std::array<std::uint16_t*, 3> halves{};
    for (std::size_t c = 0; c < 3; ++c) {
      Plane& plane = planes_[rgb_[c]];
      std::byte* samples = plane.samples.data() + row * plane.row_bytes;
      if (plane.channel.type == Imf::HALF) {
        halves[c] = reinterpret_cast<std::uint16_t*>(samples) + x;
        rgb[c] = as_float[c].data();
        floats_from_halves(halves[c], count, rgb[c]);
      } else {
        rgb[c] = reinterpret_cast<float*>(samples) + x;
      }
    }
    relight_strip(relighting, rgb, count, statistics);
    for (std::size_t c = 0; c < 3; ++c) {
      if (halves[c] != nullptr) halves_from_floats(rgb[c], count, halves[c]);
    }
  }
}

}  // namespace apps
