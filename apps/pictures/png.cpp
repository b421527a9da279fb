#include "apps/pictures/png.h"

#include <png.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace apps {
namespace {

constexpr int kCompression = 4;  ///< of zlib; more takes longer and saves little

void append(png_structp png, png_bytep data, std::size_t size) {
  static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), size);
}

void flush_nothing(png_structp) {}

[[noreturn]] void fail(png_structp, png_const_charp message) {
  throw std::runtime_error(std::string("PNG: ") + message);
}

void ignore(png_structp, png_const_charp) {}

/// libpng's two structures, freed whatever happens.
class Writer {
 public:
  explicit Writer(std::string& file)
      : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, fail, ignore)) {
    if (png_ == nullptr) throw std::runtime_error("PNG: libpng cannot start");
    info_ = png_create_info_struct(png_);
    png_set_write_fn(png_, &file, append, flush_nothing);
  }

  ~Writer() { png_destroy_write_struct(&png_, &info_); }

  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  void head(const PngPicture& picture) {
    png_set_compression_level(png_, kCompression);
    png_set_IHDR(png_, info_, static_cast<png_uint_32>(picture.width),
                 static_cast<png_uint_32>(picture.height), picture.bits, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB_gAMA_and_cHRM(png_, info_, PNG_sRGB_INTENT_PERCEPTUAL);
    std::vector<png_text> texts;
    for (const auto& [keyword, text] : picture.texts) {
      png_text entry{};
      entry.compression = PNG_TEXT_COMPRESSION_NONE;
      entry.key = const_cast<char*>(keyword.c_str());  // libpng only reads them
      entry.text = const_cast<char*>(text.c_str());
      texts.push_back(entry);
    }
    png_set_text(png_, info_, texts.data(), static_cast<int>(texts.size()));
    png_write_info(png_, info_);
  }

  void row(const std::vector<std::uint8_t>& bytes) { png_write_row(png_, bytes.data()); }

  void end() { png_write_end(png_, nullptr); }

 private:
  png_structp png_;
  png_infop info_ = nullptr;
};

}  // namespace

std::string png_file(const PngPicture& picture) {
  std::string file;
  Writer writer(file);
  writer.head(picture);
  const std::size_t row_samples = 3 * static_cast<std::size_t>(picture.width);
  std::vector<std::uint8_t> bytes;
  for (std::size_t first = 0; first < picture.samples.size(); first += row_samples) {
    bytes.clear();
    for (std::size_t k = first; k < first + row_samples; ++k) {
      if (picture.bits == 16) bytes.push_back(static_cast<std::uint8_t>(picture.samples[k] >> 8U));
      bytes.push_back(static_cast<std::uint8_t>(picture.samples[k] & 0xffU));
    }
    writer.row(bytes);
  }
  writer.end();
  return file;
}

std::uint16_t png_sample(double value, int bits) {
  const double most = bits == 16 ? 65535 : 255;
  return static_cast<std::uint16_t>(std::nearbyint(std::clamp(value, 0.0, 1.0) * most));
}

}  // namespace apps
