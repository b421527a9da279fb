#pragma once
#include <Eigen/Core>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "appearance/spectra/grid.h"
#include "solver/bands.h"

namespace apps {

/// Pixel types of OpenEXR.
enum class ExrNumbers { half, floats };

struct SpectralExrHead {
  int width = 0, height = 0;
  spectra::Grid grid;
  ExrNumbers numbers = ExrNumbers::floats;
  int threads = 1;
  std::vector<std::pair<std::string, std::string>> attributes;  ///< provenance: name, text
};

/// A picture of spectral radiance in OpenEXR, in the layout of [Fichet2021]: a channel
/// S0.400,000000nm per band, emissive, W m^-2 sr^-1 and here a density per nm, with R, G, B (linear
/// BT.709 in cd m^-2) for viewers that know no spectra. Written row by row into memory.
class SpectralExr {
 public:
  explicit SpectralExr(const SpectralExrHead& head);
  ~SpectralExr();
  SpectralExr(const SpectralExr&) = delete;
  SpectralExr& operator=(const SpectralExr&) = delete;

  /// The next rows from the top. @param radiance  pixel x band  @param rgb  pixel x 3
  void add(const solver::Bands& radiance, const solver::Bands& rgb);

  /// The file, once all rows are there. @throws std::runtime_error  if they are not
  [[nodiscard]] std::string file();

 private:
  struct Writer;
  std::unique_ptr<Writer> writer_;
};

/// S0.400,000000nm: six decimals and a comma.
[[nodiscard]] std::string spectral_channel(double nm);

/// A picture of one float per pixel, channel Y, in OpenEXR. @param values  rows from the top
[[nodiscard]] std::string scalar_exr(
    int width, int height, const Eigen::ArrayXf& values,
    const std::vector<std::pair<std::string, std::string>>& attributes);

}  // namespace apps
