#include "apps/pictures/exr_relighting.h"

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfDeepScanLineInputPart.h>
#include <OpenEXR/ImfDeepScanLineOutputPart.h>
#include <OpenEXR/ImfDeepTiledInputPart.h>
#include <OpenEXR/ImfDeepTiledOutputPart.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfTestFile.h>
#include <OpenEXR/ImfThreading.h>
#include <OpenEXR/ImfTiledInputPart.h>
#include <OpenEXR/ImfTiledOutputPart.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "appearance/spectra/text/input_error.h"
#include "apps/pictures/exr_block.h"
#include "apps/pictures/exr_chunks.h"
#include "solver/rooms/room_light.h"

namespace apps {
namespace {

namespace fs = std::filesystem;
using Imath::Box2i;

constexpr std::int64_t kBlockBytes = std::int64_t{1} << 24;  // of pixels in memory at a time

/// Unlike the library's own stream, tells of a byte that could not be written after the file has
/// been closed: destructors of output files keep failures to themselves.
class Output : public Imf::OStream {
 public:
  explicit Output(const fs::path& path)
      : OStream(path.c_str()), file_(path, std::ios::binary | std::ios::trunc) {
    check();
  }

  void write(const char* bytes, int count) override {
    file_.write(bytes, count);
    check();
  }

  uint64_t tellp() override { return static_cast<uint64_t>(std::streamoff(file_.tellp())); }

  void seekp(uint64_t position) override {
    file_.seekp(static_cast<std::streamoff>(position));
    check();
  }

  void finish() {
    file_.close();
    check();
  }

 private:
  void check() {
    if (file_) return;
    throw spectra::FileError(
        fmt::format("{}: cannot be written: {}", fileName(), std::strerror(errno)));
  }

  std::ofstream file_;
};

[[noreturn]] void refuse(const fs::path& in, const std::string& problem,
                         const std::string& remedy) {
  throw spectra::InputError({{.file = in.string(), .problem = problem, .remedy = remedy}});
}

bool is_deep(const Imf::Header& header) { return !Imf::isImage(header.type()); }

bool has_rgb(const Imf::Header& header) {
  const Imf::ChannelList& channels = header.channels();
  return !is_deep(header) && channels.findChannel("R") != nullptr &&
         channels.findChannel("G") != nullptr && channels.findChannel("B") != nullptr;
}

/// Every reason why the parts cannot be relit.
void require_relightable(const std::vector<Imf::Header>& parts, const fs::path& in) {
  std::vector<spectra::Fault> faults;
  if (std::none_of(parts.begin(), parts.end(), has_rgb)) {
    std::vector<std::string> names;
    for (const Imf::Header& part : parts) {
      for (auto it = part.channels().begin(); it != part.channels().end(); ++it) {
        names.emplace_back(it.name());
      }
    }
    refuse(in,
           fmt::format("no flat picture with the channels R, G, B; there are {}",
                       fmt::join(names, ", ")),
           "give a picture with R, G, B");
  }
  for (const Imf::Header& part : parts) {
    if (!has_rgb(part)) continue;
    for (const char* name : {"R", "G", "B"}) {
      const Imf::Channel& channel = part.channels()[name];
      if (channel.type == Imf::UINT) {
        faults.push_back({.file = in.string(),
                          .pointer = name,
                          .problem = "holds whole numbers",
                          .remedy = "give half or float"});
      }
      if (channel.xSampling != 1 || channel.ySampling != 1) {
        faults.push_back({.file = in.string(),
                          .pointer = name,
                          .problem = "has not a value for each pixel",
                          .remedy = "give a picture without subsampling of R, G, B"});
      }
    }
  }
  if (!faults.empty()) throw spectra::InputError(faults);
}

/// Every part whose pixels are not all there.
void require_whole(Imf::MultiPartInputFile& input, const std::vector<Imf::Header>& parts,
                   const fs::path& in) {
  const auto file_bytes = static_cast<std::int64_t>(fs::file_size(in));
  std::vector<spectra::Fault> faults;
  for (std::size_t part = 0; part < parts.size(); ++part) {
    std::string fault = implausible_size(parts[part], file_bytes);
    if (fault.empty()) fault = short_chunk(input, static_cast<int>(part));
    if (fault.empty()) continue;
    faults.push_back({.file = in.string(),
                      .pointer = fmt::format("part {}", part),
                      .problem = fault,
                      .remedy = "give a complete OpenEXR picture"});
  }
  if (!faults.empty()) throw spectra::InputError(faults);
}

/// A file of one or more parts on its way to another.
class Copy {
 public:
  Copy(const fs::path& path, Imf::MultiPartInputFile& in, Imf::MultiPartOutputFile& out,
       const Eigen::Matrix3f& matrix, int threads)
      : path_(path), in_(in), out_(out), matrix_(matrix), threads_(threads) {}

  PixelStatistics relight_scan_lines(int part);
  PixelStatistics relight_tiles(int part);

  template <typename InputPart, typename OutputPart>
  void copy_part(int part) {
    InputPart in(in_, part);
    OutputPart(out_, part).copyPixels(in);
  }

 private:
  PixelStatistics relight_level(Imf::TiledInputPart& in, Imf::TiledOutputPart& out, int lx, int ly);
  void require_memory(std::int64_t bytes) const;

  const fs::path& path_;
  Imf::MultiPartInputFile& in_;
  Imf::MultiPartOutputFile& out_;
  Eigen::Matrix3f matrix_;
  int threads_;
};

void Copy::require_memory(std::int64_t bytes) const {
  if (bytes <= kBlockBytes || bytes <= solver::available_memory_bytes()) return;
  throw solver::TooLarge(fmt::format("{}: a single line or tile takes {:.3g} GB of memory",
                                     path_.string(), static_cast<double>(bytes) * 1e-9));
}

PixelStatistics Copy::relight_scan_lines(int part) {
  Imf::InputPart in(in_, part);
  Imf::OutputPart out(out_, part);
  const Imf::Header& header = in.header();
  const Box2i& all = header.dataWindow();
  const std::int64_t width = std::int64_t{all.max.x} - all.min.x + 1;
  const std::int64_t height = std::int64_t{all.max.y} - all.min.y + 1;
  const std::int64_t line_bytes = ExrBlock::bytes(header.channels(), width, 1);
  require_memory(line_bytes);
  const std::int64_t lines = std::clamp(kBlockBytes / line_bytes, std::int64_t{1}, height);
  ExrBlock block(header.channels(), width, lines);

  PixelStatistics statistics;
  for (std::int64_t done = 0; done < height; done += lines) {
    const auto count = static_cast<int>(std::min(lines, height - done));
    const auto before = static_cast<int>(done);
    Box2i window = all;  // lines are written in the file's own order, or the library hoards them
    window.min.y = header.lineOrder() == Imf::DECREASING_Y ? all.max.y - before - count + 1
                                                           : all.min.y + before;
    window.max.y = window.min.y + count - 1;
    const Imf::FrameBuffer slices = block.at(window);
    in.setFrameBuffer(slices);
    in.readPixels(window.min.y, window.max.y);
    statistics.add(block.relight(matrix_, threads_));
    out.setFrameBuffer(slices);
    out.writePixels(count);
  }
  return statistics;
}

PixelStatistics Copy::relight_tiles(int part) {
  Imf::TiledInputPart in(in_, part);
  Imf::TiledOutputPart out(out_, part);
  PixelStatistics statistics;
  for (int ly = 0; ly < in.numYLevels(); ++ly) {
    for (int lx = 0; lx < in.numXLevels(); ++lx) {
      if (!in.isValidLevel(lx, ly)) continue;
      const PixelStatistics level = relight_level(in, out, lx, ly);
      if (lx == 0 && ly == 0) statistics = level;
    }
  }
  return statistics;
}

PixelStatistics Copy::relight_level(Imf::TiledInputPart& in, Imf::TiledOutputPart& out, int lx,
                                    int ly) {
  const Imf::Header& header = in.header();
  const std::int64_t width = std::min<std::int64_t>(in.tileXSize(), in.levelWidth(lx));
  const std::int64_t height = std::min<std::int64_t>(in.tileYSize(), in.levelHeight(ly));
  const std::int64_t tile_bytes = ExrBlock::bytes(header.channels(), width, height);
  require_memory(tile_bytes);
  const int columns = in.numXTiles(lx), rows = in.numYTiles(ly);
  const int at_once =
      static_cast<int>(std::clamp<std::int64_t>(kBlockBytes / tile_bytes, 1, columns));
  ExrBlock block(header.channels(), width * at_once, height);

  PixelStatistics statistics;
  for (int k = 0; k < rows; ++k) {
    const int row = header.lineOrder() == Imf::DECREASING_Y ? rows - 1 - k : k;
    for (int first = 0; first < columns; first += at_once) {
      const int last = std::min(columns - first, at_once) + first - 1;
      Box2i window = in.dataWindowForTile(first, row, lx, ly);
      window.extendBy(in.dataWindowForTile(last, row, lx, ly));
      const Imf::FrameBuffer slices = block.at(window);
      in.setFrameBuffer(slices);
      in.readTiles(first, last, row, row, lx, ly);
      statistics.add(block.relight(matrix_, threads_));
      out.setFrameBuffer(slices);
      out.writeTiles(first, last, row, row, lx, ly);
    }
  }
  return statistics;
}

/// Relights or copies one part.
PixelStatistics pass_on(Copy& copy, int part, const Imf::Header& header) {
  const std::string& type = header.type();
  if (has_rgb(header)) {
    return type == Imf::TILEDIMAGE ? copy.relight_tiles(part) : copy.relight_scan_lines(part);
  }
  if (type == Imf::TILEDIMAGE) copy.copy_part<Imf::TiledInputPart, Imf::TiledOutputPart>(part);
  if (type == Imf::SCANLINEIMAGE) copy.copy_part<Imf::InputPart, Imf::OutputPart>(part);
  if (type == Imf::DEEPTILE) {
    copy.copy_part<Imf::DeepTiledInputPart, Imf::DeepTiledOutputPart>(part);
  }
  if (type == Imf::DEEPSCANLINE) {
    copy.copy_part<Imf::DeepScanLineInputPart, Imf::DeepScanLineOutputPart>(part);
  }
  return {};
}

ExrPart describe(const Imf::Header& header) {
  const Box2i& window = header.dataWindow();
  return {.name = header.hasName() ? header.name() : "",
          .width = window.max.x - window.min.x + 1,
          .height = window.max.y - window.min.y + 1,
          .relit = has_rgb(header)};
}

void require_readable(const fs::path& in) {
  std::ifstream file(in, std::ios::binary);
  if (!file || file.peek() == std::ifstream::traits_type::eof()) {
    const bool empty = file.is_open() && !fs::is_directory(in);
    if (empty) refuse(in, "is empty", "give an OpenEXR picture");
    throw spectra::FileError(fmt::format("{}: cannot be read: {}", in.string(),
                                         file.is_open() ? "it is a folder" : std::strerror(errno)));
  }
  if (!Imf::isOpenExrFile(in.c_str()))
    refuse(in, "is no OpenEXR file", "give a picture in OpenEXR");
}

}  // namespace

ExrReport relight_exr(const fs::path& in, const fs::path& out, const Eigen::Matrix3d& matrix,
                      int threads) {
  require_readable(in);
  Imf::setGlobalThreadCount(threads > 1 ? threads : 0);
  try {
    Imf::MultiPartInputFile input(in.c_str(), threads);
    std::vector<Imf::Header> headers;
    for (int part = 0; part < input.parts(); ++part) headers.push_back(input.header(part));
    require_relightable(headers, in);
    require_whole(input, headers, in);

    Output stream(out);
    ExrReport report;
    {
      Imf::MultiPartOutputFile output(stream, headers.data(), input.parts(), false, threads);
      Copy copy(in, input, output, matrix.cast<float>(), threads);
      for (int part = 0; part < input.parts(); ++part) {
        const Imf::Header& header = headers[static_cast<std::size_t>(part)];
        report.parts.push_back(describe(header));
        report.statistics.add(pass_on(copy, part, header));
      }
    }
    stream.finish();
    return report;
  } catch (const Iex::BaseExc& error) {  // failures of the output throw FileError
    refuse(in, error.what(), "give a complete OpenEXR picture");
  }
}

}  // namespace apps
