#include "apps/pictures/spectral_exr.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "apps/pictures/half_floats.h"

namespace apps {
namespace {

using Attributes = std::vector<std::pair<std::string, std::string>>;

/// A file in memory.
class MemoryFile : public Imf::OStream {
 public:
  MemoryFile() : OStream("picture") {}

  void write(const char* bytes, int count) override {
    const auto n = static_cast<std::size_t>(count);
    if (text_.size() < at_ + n) text_.resize(at_ + n);
    std::memcpy(text_.data() + at_, bytes, n);
    at_ += n;
  }

  uint64_t tellp() override { return at_; }

  void seekp(uint64_t position) override { at_ = position; }

  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_;
  std::size_t at_ = 0;
};

/// Floats of light shrink by a fifth, for more time than all else of a pixel takes: they stay as
/// they are.
Imf::Header header_of(int width, int height, ExrNumbers numbers, const Attributes& attributes) {
  Imf::Header header(width, height);
  header.compression() = numbers == ExrNumbers::half ? Imf::ZIP_COMPRESSION : Imf::NO_COMPRESSION;
  for (const auto& [name, text] : attributes) header.insert(name, Imf::StringAttribute(text));
  return header;
}

std::size_t bytes_of(ExrNumbers numbers) { return numbers == ExrNumbers::half ? 2 : 4; }

Imf::PixelType type_of(ExrNumbers numbers) {
  return numbers == ExrNumbers::half ? Imf::HALF : Imf::FLOAT;
}

}  // namespace

std::string spectral_channel(double nm) {
  std::string name = fmt::format("S0.{:.6f}nm", nm);
  std::ranges::replace(name, '.', ',');
  name[2] = '.';
  return name;
}

struct SpectralExr::Writer {
  explicit Writer(const SpectralExrHead& of) : head(of) {
    for (int k = 0; k < head.grid.count; ++k) {
      names.push_back(spectral_channel(head.grid.wavelength_nm(k)));
    }
    names.insert(names.end(), {"R", "G", "B"});
    Imf::Header header = header_of(head.width, head.height, head.numbers, head.attributes);
    header.insert("spectralLayoutVersion", Imf::StringAttribute("1.0"));
    header.insert("emissiveUnits", Imf::StringAttribute("W.m^-2.sr^-1"));
    for (const std::string& name : names) {
      header.channels().insert(name, Imf::Channel(type_of(head.numbers)));
    }
    output = std::make_unique<Imf::OutputFile>(file, header, head.threads);
  }

  /// Rows of one channel, in the file's numbers.
  [[nodiscard]] std::vector<char> plane(const auto& column) const {
    const Eigen::ArrayXf floats = column.template cast<float>();
    std::vector<char> bytes(static_cast<std::size_t>(floats.size()) * bytes_of(head.numbers));
    if (head.numbers == ExrNumbers::half) {
      halves_from_floats(floats.data(), static_cast<int>(floats.size()),
                         reinterpret_cast<std::uint16_t*>(bytes.data()));
    } else {
      std::memcpy(bytes.data(), floats.data(), bytes.size());
    }
    return bytes;
  }

  void add(const solver::Bands& radiance, const solver::Bands& rgb) {
    const auto width = static_cast<std::size_t>(head.width), stride = bytes_of(head.numbers);
    const auto rows = static_cast<int>(radiance.rows() / head.width);
    std::vector<std::vector<char>> planes;
    for (Eigen::Index k = 0; k < radiance.cols(); ++k) planes.push_back(plane(radiance.col(k)));
    for (Eigen::Index k = 0; k < rgb.cols(); ++k) planes.push_back(plane(rgb.col(k)));
    Imf::FrameBuffer slices;
    for (std::size_t k = 0; k < planes.size(); ++k) {
      // The library wants the address of pixel (0, 0), rows above this block.
      const auto above = static_cast<std::ptrdiff_t>(stride * width) * written;
      char* origin =
          reinterpret_cast<char*>(reinterpret_cast<std::intptr_t>(planes[k].data()) - above);
      slices.insert(names[k], Imf::Slice(type_of(head.numbers), origin, stride, stride * width));
    }
    output->setFrameBuffer(slices);
    output->writePixels(rows);
    written += rows;
  }

  SpectralExrHead head;
  std::vector<std::string> names;
  MemoryFile file;
  std::unique_ptr<Imf::OutputFile> output;
  int written = 0;
};

SpectralExr::SpectralExr(const SpectralExrHead& head) : writer_(std::make_unique<Writer>(head)) {}

SpectralExr::~SpectralExr() = default;

void SpectralExr::add(const solver::Bands& radiance, const solver::Bands& rgb) {
  writer_->add(radiance, rgb);
}

std::string SpectralExr::file() {
  if (writer_->written != writer_->head.height) {
    throw std::runtime_error("rows of the picture are missing");
  }
  writer_->output.reset();  // writes the table of rows
  return writer_->file.take();
}

std::string scalar_exr(int width, int height, const Eigen::ArrayXf& values,
                       const Attributes& attributes) {
  MemoryFile file;
  Imf::Header header = header_of(width, height, ExrNumbers::floats, attributes);
  header.channels().insert("Y", Imf::Channel(Imf::FLOAT));
  {
    Imf::OutputFile output(file, header);
    Imf::FrameBuffer slices;
    const auto bytes = reinterpret_cast<const char*>(values.data());
    slices.insert("Y", Imf::Slice(Imf::FLOAT, const_cast<char*>(bytes), sizeof(float),
                                  sizeof(float) * static_cast<std::size_t>(width)));
    output.setFrameBuffer(slices);
    output.writePixels(height);
  }
  return file.take();
}

}  // namespace apps
