#include "appearance/spectra/stated_colour.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <mutex>
#include <stdexcept>

#include "appearance/spectra/cie_tables.h"
#include "appearance/spectra/illuminants.h"

namespace spectra {
namespace {

using Sums = Eigen::Matrix<double, Eigen::Dynamic, 3>;

/// Weights of the three sums over a grid, Y of a perfect diffuser 1.
Sums weights_on(const Grid& grid, const StatedWhite& white) {
  if (white.observer_deg != 2 && white.observer_deg != 10) {
    throw std::invalid_argument(
        fmt::format("an observer has 2 or 10 degrees, not {}", white.observer_deg));
  }
  const Spectrum light = light_on(grid, illuminant(white.illuminant));
  const Sums matching =
      white.observer_deg == 2 ? Sums(colour_matching(grid)) : colour_matching_10_deg(grid);
  const Sums sums = matching.array().colwise() * light.values;
  return sums / sums.col(1).sum();
}

struct Weights {
  Sums bands;
  RelativeXyz band_white, published_white;
};

RelativeXyz white_of(const Sums& weights) {
  const Eigen::RowVector3d xyz = 100 * weights.colwise().sum();
  return {.x = xyz[0], .y = xyz[1], .z = xyz[2]};
}

/// Made once for each white; the reference stays valid.
const Weights& weights_of(const StatedWhite& white) {
  static std::mutex mutex;
  static std::map<std::pair<std::string, int>, Weights> cache;
  const std::lock_guard lock(mutex);
  const auto known = cache.find({white.illuminant, white.observer_deg});
  if (known != cache.end()) return known->second;
  Weights made{.bands = weights_on(kTransportGrid, white), .band_white = {}, .published_white = {}};
  made.band_white = white_of(made.bands);
  made.published_white = white_of(weights_on(kClosedFormGrid, white));
  return cache.emplace(std::pair(white.illuminant, white.observer_deg), std::move(made))
      .first->second;
}

/// The inverse of the compression of CIELAB: a cube, continued by its tangent at 6/29.
double expanded(double f) {
  constexpr double kKnee = 6. / 29;
  return f > kKnee ? f * f * f : 3 * kKnee * kKnee * (f - 4. / 29);
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

std::string without_blanks(std::string_view text) {
  std::string kept;
  std::copy_if(text.begin(), text.end(), std::back_inserter(kept),
               [](char c) { return c != ' ' && c != '\t'; });
  return kept;
}

}  // namespace

std::optional<StatedWhite> parse_white(std::string_view text) {
  const std::string word = without_blanks(text);
  const std::size_t slash = word.find('/');
  if (slash == word.npos) return {};
  std::string name = word.substr(0, slash), observer = word.substr(slash + 1);
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  for (const std::string_view unit : {"degrees", "degree", "deg", "\xC2\xB0"}) {
    if (observer.ends_with(unit)) observer.erase(observer.size() - unit.size());
  }
  const auto& names = illuminant_names();
  if (std::find(names.begin(), names.end(), name) == names.end()) return {};
  if (observer != "2" && observer != "10") return {};
  return StatedWhite{.illuminant = name, .observer_deg = observer == "2" ? 2 : 10};
}

std::string to_string(const StatedWhite& white) {
  return fmt::format("{}/{}", white.illuminant, white.observer_deg);
}

RelativeXyz band_white(const StatedWhite& white) { return weights_of(white).band_white; }

RelativeXyz published_white(const StatedWhite& white) { return weights_of(white).published_white; }

RelativeXyz xyz_under(const StatedWhite& white, const Spectrum& reflectance) {
  if (reflectance.grid != kTransportGrid) {
    throw std::invalid_argument("a reflectance on the transport grid is wanted");
  }
  const Eigen::RowVector3d xyz =
      100 * reflectance.values.matrix().transpose() * weights_of(white).bands;
  return {.x = xyz[0], .y = xyz[1], .z = xyz[2]};
}

StatedColour from_lab(const Eigen::Vector3d& lab, const StatedWhite& white) {
  const RelativeXyz w = band_white(white);
  const double f = (lab[0] + 16) / 116;
  return {.xyz = {.x = w.x * expanded(f + lab[1] / 500),
                  .y = w.y * expanded(f),
                  .z = w.z * expanded(f - lab[2] / 200)},
          .white = white};
}

StatedColour from_xyz(const RelativeXyz& xyz, const StatedWhite& white) {
  const RelativeXyz bands = band_white(white), published = published_white(white);
  return {.xyz = {.x = xyz.x * bands.x / published.x,
                  .y = xyz.y * bands.y / published.y,
                  .z = xyz.z * bands.z / published.z},
          .white = white};
}

StatedColour from_xy_y(double x, double y, double luminance, const StatedWhite& white) {
  if (!(y > 0)) throw std::invalid_argument(fmt::format("y must be above 0, not {}", y));
  return from_xyz({luminance * x / y, luminance, luminance * (1 - x - y) / y}, white);
}

StatedColour from_srgb(const Eigen::Vector3d& rgb) { return {.xyz = srgb_xyz(rgb), .white = {}}; }

StatedColour from_lrv(double lrv) {
  const RelativeXyz w = band_white({});
  return {.xyz = {lrv * w.x / 100, lrv * w.y / 100, lrv * w.z / 100}, .white = {}};
}

std::optional<Eigen::Vector3d> parse_hex(std::string_view text) {
  const std::string word = without_blanks(text);
  const bool marked = word.starts_with('#');
  const std::string_view digits = std::string_view(word).substr(marked ? 1 : 0);
  if (digits.size() != 6 && !(marked && digits.size() == 3)) return {};
  Eigen::Vector3d rgb;
  const std::size_t each = digits.size() / 3;
  for (std::size_t i = 0; i < 3; ++i) {
    const int high = hex_digit(digits[each * i]), low = hex_digit(digits[each * i + each - 1]);
    if (high < 0 || low < 0) return {};
    rgb[static_cast<Eigen::Index>(i)] = (16 * high + low) / 255.0;
  }
  return rgb;
}

Reconstruction reconstruct_stated(const StatedColour& colour) {
  const RelativeXyz& xyz = colour.xyz;
  if (xyz.x == 0 && xyz.y == 0 && xyz.z == 0) {
    return {.reflectance = constant(kTransportGrid, 0), .converged = true};
  }
  return reconstruct_from_sums(kTransportGrid, weights_of(colour.white).bands,
                               Eigen::Vector3d(xyz.x, xyz.y, xyz.z) / 100);
}

}  // namespace spectra
