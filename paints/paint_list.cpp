#include "paints/paint_list.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "appearance/spectra/rgb_space.h"
#include "paints/atlas_file.h"

namespace paints {
namespace {

/// The transfer function of IEC 61966-2-1, from light to component.
double srgb_component(double linear) {
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

}  // namespace

std::vector<ListedPaint> listed(const PaintFile& file) {
  constexpr double kRounding = 1e-9;  // a reconstructed hex code may leave 0..1 by this
  const spectra::RgbSpace& srgb = spectra::rgb_space("srgb");
  const spectra::RelativeXyz white = spectra::band_white({});
  std::vector<ListedPaint> all;
  for (const FilePaint& paint : file.paints) {
    require_coverage(file.path, paint.reflectance, spectra::kTransportGrid);
    const spectra::Spectrum rho =
        spectra::reflectance_on(spectra::kTransportGrid, paint.reflectance);
    ListedPaint made{.xyz = spectra::xyz_under({}, rho), .lab = {}, .srgb = {}};
    made.lab = appearance::cielab(made.xyz, white);
    const Eigen::Vector3d linear = spectra::rgb_of_reflectance(srgb, rho);
    made.in_srgb = linear.minCoeff() > -kRounding && linear.maxCoeff() < 1 + kRounding;
    made.srgb = linear.cwiseMax(0).cwiseMin(1).unaryExpr(&srgb_component);
    all.push_back(made);
  }
  return all;
}

std::vector<std::pair<std::size_t, std::size_t>> duplicates(const PaintFile& file) {
  std::map<std::pair<std::vector<double>, std::vector<double>>, std::size_t> first;
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (std::size_t i = 0; i < file.paints.size(); ++i) {
    const spectra::Samples& s = file.paints[i].reflectance;
    const auto [earlier, is_new] = first.try_emplace({s.nm, s.values}, i);
    if (!is_new) found.emplace_back(i, earlier->second);
  }
  return found;
}

std::string hex_code(const ListedPaint& paint) {
  const auto byte = [&](Eigen::Index c) { return std::lround(255 * paint.srgb[c]); };
  return fmt::format("#{:02X}{:02X}{:02X}", byte(0), byte(1), byte(2));
}

}  // namespace paints
