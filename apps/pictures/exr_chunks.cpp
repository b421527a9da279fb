#include "apps/pictures/exr_chunks.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTiledInputPart.h>
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <optional>

namespace apps {
namespace {

using Imath::Box2i;

bool is_looked_at(const Imf::Header& header) {
  const Imf::Compression c = header.compression();
  return Imf::isImage(header.type()) && (c == Imf::NO_COMPRESSION || c == Imf::RLE_COMPRESSION ||
                                         c == Imf::ZIPS_COMPRESSION || c == Imf::ZIP_COMPRESSION);
}

int lines_of_chunk(const Imf::Header& header) {
  constexpr int kZipLines = 16;
  return header.compression() == Imf::ZIP_COMPRESSION ? kZipLines : 1;
}

/// Multiples of `step` from `from` to `to`.
std::int64_t samples(std::int64_t from, std::int64_t to, std::int64_t step) {
  const auto floor = [step](std::int64_t v) {
    return v >= 0 ? v / step : -((step - 1 - v) / step);
  };
  return floor(to) - floor(from - 1);
}

/// What the pixels of a window take.
std::int64_t bytes_of(const Imf::ChannelList& channels, const Box2i& window) {
  std::int64_t bytes = 0;
  for (auto it = channels.begin(); it != channels.end(); ++it) {
    const Imf::Channel& channel = it.channel();
    bytes += samples(window.min.x, window.max.x, channel.xSampling) *
             samples(window.min.y, window.max.y, channel.ySampling) *
             (channel.type == Imf::HALF ? 2 : 4);
  }
  return bytes;
}

/// Signed counts: n >= 0 repeats the next byte n + 1 times, n < 0 copies the next -n.
std::int64_t unpacked_rle(const char* data, int size) {
  std::int64_t bytes = 0;
  for (int at = 0; at < size;) {
    const int count = static_cast<signed char>(data[at]);
    const int taken = count < 0 ? -count : 1;
    if (at + 1 + taken > size) return -1;
    bytes += count < 0 ? -count : count + 1;
    at += 1 + taken;
  }
  return bytes;
}

std::int64_t unpacked_zip(const char* data, int size) {
  std::array<unsigned char, 65536> part{};
  z_stream stream{};
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data));
  stream.avail_in = static_cast<uInt>(size);
  if (inflateInit(&stream) != Z_OK) return -1;
  std::int64_t bytes = 0;
  int status = Z_OK;
  while (status == Z_OK) {
    stream.next_out = part.data();
    stream.avail_out = static_cast<uInt>(part.size());
    status = inflate(&stream, Z_NO_FLUSH);
    bytes += static_cast<std::int64_t>(part.size() - stream.avail_out);
  }
  inflateEnd(&stream);
  return status == Z_STREAM_END ? bytes : -1;
}

/// What is wrong with a chunk of pixels that take so many bytes.
std::string fault_of(Imf::Compression compression, const char* data, int size,
                     std::int64_t expected) {
  if (size == expected) return "";  // as they are
  std::int64_t unpacked = size;
  if (size < expected && compression != Imf::NO_COMPRESSION) {
    unpacked =
        compression == Imf::RLE_COMPRESSION ? unpacked_rle(data, size) : unpacked_zip(data, size);
  }
  if (unpacked == expected) return "";
  return unpacked < 0 ? "it cannot be unpacked"
                      : fmt::format("it holds {} bytes, its pixels take {}", unpacked, expected);
}

std::string short_lines(Imf::MultiPartInputFile& file, int part) {
  Imf::InputPart in(file, part);
  const Imf::Header& header = in.header();
  const Box2i all = header.dataWindow();
  const int lines = lines_of_chunk(header);
  for (std::int64_t y = all.min.y; y <= all.max.y; y += lines) {
    Box2i window = all;
    window.min.y = static_cast<int>(y);
    window.max.y = static_cast<int>(std::min<std::int64_t>(y + lines - 1, all.max.y));
    const char* data = nullptr;
    int size = 0;
    in.rawPixelData(window.min.y, data, size);
    const std::string fault =
        fault_of(header.compression(), data, size, bytes_of(header.channels(), window));
    if (!fault.empty()) return fmt::format("lines from {}: {}", window.min.y, fault);
  }
  return "";
}

std::string short_tiles(Imf::MultiPartInputFile& file, int part) {
  Imf::TiledInputPart in(file, part);
  const Imf::Header& header = in.header();
  for (int ly = 0; ly < in.numYLevels(); ++ly) {
    for (int lx = 0; lx < in.numXLevels(); ++lx) {
      if (!in.isValidLevel(lx, ly)) continue;
      for (int row = 0; row < in.numYTiles(ly); ++row) {
        for (int column = 0; column < in.numXTiles(lx); ++column) {
          int x = column, y = row, level_x = lx, level_y = ly, size = 0;
          const char* data = nullptr;
          in.rawTileData(x, y, level_x, level_y, data, size);
          // Of tiles in falling order the library gives the next one of the file, and says which.
          const Box2i window = in.dataWindowForTile(x, y, level_x, level_y);
          const std::string fault =
              fault_of(header.compression(), data, size, bytes_of(header.channels(), window));
          if (!fault.empty()) {
            return fmt::format("tile {}, {} of level {}, {}: {}", x, y, level_x, level_y, fault);
          }
        }
      }
    }
  }
  return "";
}

}  // namespace

std::string implausible_size(const Imf::Header& header, std::int64_t file_bytes) {
  if (!is_looked_at(header)) return "";
  // A run of RLE, and deflate at its best, make one byte of so many.
  constexpr std::int64_t kMostOfRle = 64, kMostOfZip = 1032;
  const Imf::Compression c = header.compression();
  const std::int64_t ratio = c == Imf::NO_COMPRESSION    ? 1
                             : c == Imf::RLE_COMPRESSION ? kMostOfRle
                                                         : kMostOfZip;
  const std::int64_t bytes = bytes_of(header.channels(), header.dataWindow());
  if (bytes / ratio <= file_bytes) return "";
  return fmt::format("the picture would take {} bytes, a file of {} cannot hold it", bytes,
                     file_bytes);
}

std::string short_chunk(Imf::MultiPartInputFile& file, int part) {
  if (!is_looked_at(file.header(part))) return "";
  return file.header(part).type() == Imf::TILEDIMAGE ? short_tiles(file, part)
                                                     : short_lines(file, part);
}

}  // namespace apps
