#include "scenes/luminaires/plane_symmetry.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace scenes {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;

std::vector<double> equals_of(double c_deg, PlaneSymmetry symmetry) {
  switch (symmetry) {
    case PlaneSymmetry::about_0_180:
      return {c_deg, 360 - c_deg};
    case PlaneSymmetry::about_90_270:
      return {c_deg, 180 - c_deg};
    case PlaneSymmetry::both:
      return {c_deg, 180 - c_deg, 180 + c_deg, 360 - c_deg};
    default:
      return {c_deg};
  }
}

}  // namespace

std::string_view to_string(PlaneSymmetry symmetry) {
  switch (symmetry) {
    case PlaneSymmetry::round:
      return "round";
    case PlaneSymmetry::about_0_180:
      return "mirrored in the plane 0-180";
    case PlaneSymmetry::about_90_270:
      return "mirrored in the plane 90-270";
    case PlaneSymmetry::both:
      return "mirrored in both planes";
    default:
      return "none";
  }
}

HalfPlanes all_around(const HalfPlanes& stored, PlaneSymmetry symmetry) {
  std::map<double, ArrayXd> planes;  // by angle, 0 to below 360
  std::map<double, ArrayXd> last;    // plane 360, if it is stored
  for (std::size_t k = 0; k < stored.angle_deg.size(); ++k) {
    const ArrayXd row = stored.intensity_cd.row(static_cast<Index>(k)).transpose();
    if (symmetry == PlaneSymmetry::none && stored.angle_deg[k] == 360) {
      last.emplace(360, row);
      continue;
    }
    const double c_deg = symmetry == PlaneSymmetry::round ? 0 : stored.angle_deg[k];
    for (const double equal_deg : equals_of(c_deg, symmetry)) {
      planes.emplace(std::fmod(equal_deg + 360, 360), row);  // the first that comes stays
    }
    if (symmetry == PlaneSymmetry::round) break;
  }
  if (planes.begin()->first > 0) {
    const auto& [first_deg, first] = *planes.begin();
    const auto& [before_deg, before] = *planes.rbegin();
    const double share = (360 - before_deg) / (360 - before_deg + first_deg);
    planes.emplace(0, (1 - share) * before + share * first);
  }
  last.emplace(360, planes.begin()->second);
  planes.merge(last);

  HalfPlanes all{.angle_deg = {},
                 .intensity_cd = {static_cast<Index>(planes.size()), stored.intensity_cd.cols()}};
  for (const auto& [c_deg, row] : planes) {
    all.intensity_cd.row(static_cast<Index>(all.angle_deg.size())) = row.transpose();
    all.angle_deg.push_back(c_deg);
  }
  return all;
}

HalfPlanes both_sides(const HalfPlanes& stored) {
  const auto n = static_cast<Index>(stored.angle_deg.size());
  HalfPlanes all{.angle_deg = {}, .intensity_cd = {2 * n - 1, stored.intensity_cd.cols()}};
  for (Index k = 1 - n; k < n; ++k) {
    const Index from = std::abs(k);
    const double angle_deg = stored.angle_deg[static_cast<std::size_t>(from)];
    all.angle_deg.push_back(k < 0 ? -angle_deg : angle_deg);
    all.intensity_cd.row(k + n - 1) = stored.intensity_cd.row(from);
  }
  return all;
}

}  // namespace scenes
