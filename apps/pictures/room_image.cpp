#include "apps/pictures/room_image.h"

#include <algorithm>
#include <vector>

#include "appearance/spectra/tristimulus.h"
#include "apps/pictures/for_rows.h"

namespace apps {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr int kRowsAtOnce = 64;
constexpr double kWhiteOnFilm = 0.8;

/// X, Y, Z of a unit in each band, bands x 3.
Eigen::MatrixX3d xyz_of_bands(const spectra::Grid& grid) {
  Eigen::MatrixX3d matrix(grid.count, 3);
  for (Index b = 0; b < grid.count; ++b) {
    spectra::Spectrum unit{grid, Eigen::ArrayXd::Zero(grid.count)};
    unit.values[b] = 1;
    const spectra::Xyz xyz = spectra::absolute_xyz(unit);
    matrix.row(b) << xyz.x, xyz.y, xyz.z;
  }
  return matrix;
}

PngPicture blank(const RoomImage& image, int bits) {
  return {.width = image.width,
          .height = image.height,
          .bits = bits,
          .samples = std::vector<std::uint16_t>(static_cast<std::size_t>(image.xyz.size()))};
}

void set_pixel(PngPicture& png, std::size_t pixel, const Vector3d& encoded) {
  for (std::size_t c = 0; c < 3; ++c) {
    png.samples[3 * pixel + c] = png_sample(encoded[static_cast<Index>(c)], png.bits);
  }
}

/// Calls job(pixel, xyz, row) for every pixel.
template <typename Job>
void for_pixels(const RoomImage& image, int threads, const Job& job) {
  for_rows(image.height, threads, [&](std::size_t row) {
    for (std::size_t x = 0; x < static_cast<std::size_t>(image.width); ++x) {
      const std::size_t pixel = row * static_cast<std::size_t>(image.width) + x;
      const Vector3d xyz = image.xyz.row(static_cast<Index>(pixel)).cast<double>().transpose();
      job(pixel, xyz, row);
    }
  });
}

}  // namespace

RoomImage take_picture(const solver::RoomPicture& picture, int width, int height,
                       const spectra::Grid& grid, SpectralExr* exr) {
  const Index pixels = Index{width} * height;
  RoomImage image{.width = width, .height = height};
  image.xyz.resize(pixels, 3);
  image.illuminance_lx.resize(pixels);
  const Eigen::MatrixX3d to_xyz = xyz_of_bands(grid);
  for (int first = 0; first < height; first += kRowsAtOnce) {
    const int count = std::min(kRowsAtOnce, height - first);
    const solver::PictureRows rows = picture.rows(first, count);
    const Eigen::MatrixX3d xyz = rows.radiance.matrix() * to_xyz;
    solver::Bands rgb(xyz.rows(), 3);
    for (Index p = 0; p < xyz.rows(); ++p) {
      rgb.row(p) = appearance::linear_srgb_of(xyz.row(p).transpose()).transpose().array();
    }
    if (exr != nullptr) exr->add(rows.radiance, rgb);
    image.xyz.middleRows(Index{first} * width, xyz.rows()) = xyz.cast<float>().array();
    image.illuminance_lx.segment(Index{first} * width, xyz.rows()) = rows.illuminance.cast<float>();
  }
  return image;
}

std::int64_t picture_bytes(std::int64_t width, std::int64_t height, int bands, ExrNumbers numbers) {
  constexpr std::int64_t kKept = 16, kPngs = 2 * 3 * 4;  // XYZ and lx; samples and files
  const std::int64_t spectral = (bands + 3) * (numbers == ExrNumbers::half ? 2 : 4);
  const std::int64_t block = std::min<std::int64_t>(height, kRowsAtOnce) * width * bands * 20;
  return width * height * (spectral + kKept + kPngs) + block;
}

Photograph photograph(const RoomImage& image, double white_cd_m2, int bits, int threads) {
  Photograph photo{.png = blank(image, bits), .exposure = kWhiteOnFilm / white_cd_m2};
  std::vector<std::int64_t> changed(static_cast<std::size_t>(image.height)), white = changed;
  for_pixels(image, threads, [&](std::size_t pixel, const Vector3d& xyz, std::size_t row) {
    const appearance::Desaturated film =
        appearance::desaturated(appearance::linear_srgb_of(photo.exposure * xyz));
    changed[row] += film.changed ? 1 : 0;
    white[row] += film.changed && film.linear.minCoeff() >= 1 ? 1 : 0;
    set_pixel(photo.png, pixel, appearance::srgb_encoded(film.linear));
  });
  for (const std::int64_t n : changed) photo.desaturated += n;
  for (const std::int64_t n : white) photo.white += n;
  return photo;
}

SeenPicture seen_picture(const RoomImage& image, const appearance::Display& display,
                         double white_cd_m2, int bits, int threads) {
  SeenPicture seen{.png = blank(image, bits)};
  std::vector<SeenPicture> rows(static_cast<std::size_t>(image.height));
  for_pixels(image, threads, [&](std::size_t pixel, const Vector3d& xyz, std::size_t row) {
    const Vector3d relative = 100 / white_cd_m2 * xyz;
    const appearance::DisplayedPixel p = display.show({relative[0], relative[1], relative[2]});
    SeenPicture& told = rows[row];
    told.too_light += p.too_light ? 1 : 0;
    told.less_chroma += p.less_chroma ? 1 : 0;
    told.undefined += p.undefined ? 1 : 0;
    if (p.less_chroma && !p.undefined) {
      told.largest_reduction = std::max(told.largest_reduction, p.chroma - p.chroma_shown);
    }
    set_pixel(seen.png, pixel, p.srgb);
  });
  for (const SeenPicture& row : rows) {
    seen.too_light += row.too_light;
    seen.less_chroma += row.less_chroma;
    seen.undefined += row.undefined;
    seen.largest_reduction = std::max(seen.largest_reduction, row.largest_reduction);
  }
  return seen;
}

}  // namespace apps
