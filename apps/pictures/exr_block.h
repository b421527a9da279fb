#pragma once
#include <Imath/ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "apps/pictures/relit_strip.h"

namespace apps {

/// Memory for a rectangle of a picture, all its channels in their own pixel types.
class ExrBlock {
 public:
  /// @param width, height  the largest rectangle that the block will hold
  ExrBlock(const Imf::ChannelList& channels, std::int64_t width, std::int64_t height);

  /// What a block takes.
  [[nodiscard]] static std::int64_t bytes(const Imf::ChannelList& channels, std::int64_t width,
                                          std::int64_t height);

  /// Lets the block stand for the pixels of `window`; to be read into and written from.
  [[nodiscard]] Imf::FrameBuffer at(const Imath::Box2i& window);

  /// Relights the R, G, B of the window in place.
  PixelStatistics relight(const Eigen::Matrix3f& matrix, int threads);

 private:
  struct Plane {
    std::string name;
    Imf::Channel channel;
    std::size_t row_bytes = 0;
    std::vector<std::byte> samples;
  };

  void relight_row(const Relighting& relighting, std::size_t row, PixelStatistics& statistics);

  std::vector<Plane> planes_;
  std::array<std::size_t, 3> rgb_{};  // where R, G and B are among the planes
  std::int64_t width_ = 0, height_ = 0;
};

}  // namespace apps
