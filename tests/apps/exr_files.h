#pragma once
#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfTiledInputFile.h>
#include <OpenEXR/ImfTiledOutputFile.h>

#include <functional>
#include <map>
#include <string>
#include <vector>

namespace apps::test {

/// Samples of one picture by channel, row by row, each as the bytes of its own pixel type.
using Planes = std::map<std::string, std::vector<char>>;

inline std::size_t bytes_of(Imf::PixelType type) { return type == Imf::HALF ? 2 : 4; }

inline std::size_t width_of(const Imath::Box2i& window) {
  return static_cast<std::size_t>(window.max.x - window.min.x + 1);
}

/// Room for every channel of the header over a window.
inline Planes planes_for(const Imf::Header& header, const Imath::Box2i& window) {
  Planes planes;
  const std::size_t pixels =
      width_of(window) * static_cast<std::size_t>(window.max.y - window.min.y + 1);
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    planes[it.name()].resize(pixels * bytes_of(it.channel().type));
  }
  return planes;
}

inline Imf::FrameBuffer slices_of(const Imf::Header& header, const Imath::Box2i& window,
                                  Planes& planes) {
  Imf::FrameBuffer slices;
  for (auto it = header.channels().begin(); it != header.channels().end(); ++it) {
    slices.insert(it.name(), Imf::Slice::Make(it.channel().type, planes[it.name()].data(), window));
  }
  return slices;
}

/// The k-th sample of a channel as a number.
inline double sample(const Imf::Header& header, const Planes& planes, const std::string& channel,
                     std::size_t k) {
  const char* at = planes.at(channel).data();
  switch (header.channels()[channel.c_str()].type) {
    case Imf::HALF:
      return static_cast<double>(reinterpret_cast<const half*>(at)[k]);
    case Imf::FLOAT:
      return static_cast<double>(reinterpret_cast<const float*>(at)[k]);
    default:
      return reinterpret_cast<const std::uint32_t*>(at)[k];
  }
}

inline void set_sample(Imf::PixelType type, char* samples, std::size_t k, double value) {
  switch (type) {
    case Imf::HALF:
      reinterpret_cast<half*>(samples)[k] = half(static_cast<float>(value));
      break;
    case Imf::FLOAT:
      reinterpret_cast<float*>(samples)[k] = static_cast<float>(value);
      break;
    default:
      reinterpret_cast<std::uint32_t*>(samples)[k] = static_cast<std::uint32_t>(value);
  }
}

/// Calls visit(lx, ly, window) for each level of resolution; scan lines have one.
template <typename Tiled, typename Visit>
void for_levels(const Tiled& file, const Visit& visit) {
  for (int ly = 0; ly < file.numYLevels(); ++ly) {
    for (int lx = 0; lx < file.numXLevels(); ++lx) {
      if (file.isValidLevel(lx, ly)) visit(lx, ly, file.dataWindowForLevel(lx, ly));
    }
  }
}

/// Value of a sample from channel name and position.
using Paint = std::function<double(const std::string& channel, std::size_t k)>;

inline Planes painted(const Imf::Header& header, const Imath::Box2i& window, const Paint& paint) {
  Planes planes = planes_for(header, window);
  for (auto& [name, bytes] : planes) {
    const Imf::PixelType type = header.channels()[name.c_str()].type;
    const std::size_t count = bytes.size() / bytes_of(type);
    for (std::size_t k = 0; k < count; ++k) set_sample(type, bytes.data(), k, paint(name, k));
  }
  return planes;
}

/// Writes scan lines or, where the header describes tiles, tiles of every level.
inline void write_exr(const std::string& path, const Imf::Header& header, const Paint& paint) {
  if (!header.hasTileDescription()) {
    Planes planes = painted(header, header.dataWindow(), paint);
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(slices_of(header, header.dataWindow(), planes));
    file.writePixels(header.dataWindow().max.y - header.dataWindow().min.y + 1);
    return;
  }
  Imf::TiledOutputFile file(path.c_str(), header);
  for_levels(file, [&](int lx, int ly, const Imath::Box2i& window) {
    Planes planes = painted(header, window, paint);
    file.setFrameBuffer(slices_of(header, window, planes));
    file.writeTiles(0, file.numXTiles(lx) - 1, 0, file.numYTiles(ly) - 1, lx, ly);
  });
}

struct ReadExr {
  Imf::Header header;
  std::vector<Planes> levels;
};

inline ReadExr read_exr(const std::string& path) {
  Imf::InputFile file(path.c_str());
  ReadExr picture{.header = file.header(), .levels = {}};
  if (!picture.header.hasTileDescription()) {
    const Imath::Box2i window = picture.header.dataWindow();
    picture.levels.push_back(planes_for(picture.header, window));
    file.setFrameBuffer(slices_of(picture.header, window, picture.levels[0]));
    file.readPixels(window.min.y, window.max.y);
    return picture;
  }
  Imf::TiledInputFile tiled(path.c_str());
  for_levels(tiled, [&](int lx, int ly, const Imath::Box2i& window) {
    picture.levels.push_back(planes_for(picture.header, window));
    tiled.setFrameBuffer(slices_of(picture.header, window, picture.levels.back()));
    tiled.readTiles(0, tiled.numXTiles(lx) - 1, 0, tiled.numYTiles(ly) - 1, lx, ly);
  });
  return picture;
}

}  // namespace apps::test
