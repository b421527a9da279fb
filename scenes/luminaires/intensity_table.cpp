#include "scenes/luminaires/intensity_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace scenes {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::Vector3d;
using std::numbers::pi;

constexpr double kDegree = pi / 180;
constexpr double kSameAngle_deg = 1e-9;

double smallest_step_deg(const std::vector<double>& angles) {
  double smallest = angles[1] - angles[0];
  for (std::size_t i = 1; i < angles.size(); ++i) {
    smallest = std::min(smallest, angles[i] - angles[i - 1]);
  }
  return smallest;
}

/// Integral of cos(u) (m + slope (u - a)) from a to b, where it is m_a and m_b at the ends.
double under_cosine(double a, double b, double m_a, double m_b) {
  const double slope = (m_b - m_a) / (b - a);
  return m_b * std::sin(b) - m_a * std::sin(a) + slope * (std::cos(b) - std::cos(a));
}

}  // namespace

IntensityTable::Axis::Axis(std::vector<double> angles) : angles_deg(std::move(angles)) {
  if (angles_deg.size() < 2) throw std::invalid_argument("a table needs two angles or more");
  const double step =
      (angles_deg.back() - angles_deg[0]) / static_cast<double>(angles_deg.size() - 1);
  bool even = true;
  for (std::size_t i = 1; i < angles_deg.size(); ++i) {
    if (!(angles_deg[i] > angles_deg[i - 1])) {
      throw std::invalid_argument(
          fmt::format("angle {} follows {}", angles_deg[i], angles_deg[i - 1]));
    }
    even = even &&
           std::abs(angles_deg[i] - angles_deg[0] - static_cast<double>(i) * step) < kSameAngle_deg;
  }
  per_deg = even ? 1 / step : 0;
}

IntensityTable::Cell IntensityTable::Axis::cell(double angle_deg) const {
  const double first = angles_deg.front(), last = angles_deg.back();
  // Angles of a direction round: the edge of the table belongs to it.
  if (!(angle_deg >= first - kSameAngle_deg && angle_deg <= last + kSameAngle_deg)) return {};
  const auto cells = static_cast<Index>(angles_deg.size()) - 1;
  if (per_deg > 0) {
    const double place = std::clamp((angle_deg - first) * per_deg, 0.0, static_cast<double>(cells));
    const Index low = std::min(static_cast<Index>(place), cells - 1);
    return {.low = low, .share = place - static_cast<double>(low)};
  }
  const auto above = std::upper_bound(angles_deg.begin() + 1, angles_deg.end() - 1, angle_deg);
  const double share = (angle_deg - *(above - 1)) / (*above - *(above - 1));
  return {.low = above - angles_deg.begin() - 1, .share = std::clamp(share, 0.0, 1.0)};
}

IntensityTable::IntensityTable(Goniometry type, std::vector<double> polar_deg,
                               std::vector<double> azimuth_deg, Eigen::ArrayXXd intensity_cd)
    : type_(type),
      polar_(std::move(polar_deg)),
      azimuth_(std::move(azimuth_deg)),
      intensity_cd_(std::move(intensity_cd)) {
  const auto planes = static_cast<Index>(azimuth_.angles_deg.size());
  if (intensity_cd_.rows() != planes ||
      intensity_cd_.cols() != static_cast<Index>(polar_.angles_deg.size())) {
    throw std::invalid_argument("the table has not as many intensities as angles");
  }
  over_azimuth_ = ArrayXd::Zero(intensity_cd_.cols());
  for (Index k = 0; k + 1 < planes; ++k) {
    const double step_rad = kDegree * (azimuth_.angles_deg[static_cast<std::size_t>(k) + 1] -
                                       azimuth_.angles_deg[static_cast<std::size_t>(k)]);
    over_azimuth_ += step_rad / 2 * (intensity_cd_.row(k) + intensity_cd_.row(k + 1)).transpose();
  }
}

double IntensityTable::finest_step_deg() const {
  return std::min(smallest_step_deg(polar_.angles_deg), smallest_step_deg(azimuth_.angles_deg));
}

IntensityTable::Angles IntensityTable::angles_of(const Vector3d& e) const {
  const double x = e.x(), y = e.y(), z = e.z();
  switch (type_) {
    case Goniometry::a:
      return {.polar_deg = std::atan2(z, std::hypot(x, y)) / kDegree,
              .azimuth_deg = std::atan2(-y, x) / kDegree};
    case Goniometry::b:
      return {.polar_deg = std::atan2(-y, std::hypot(x, z)) / kDegree,
              .azimuth_deg = std::atan2(x, -z) / kDegree};
    case Goniometry::c:
      break;
  }
  const double c_deg = std::atan2(y, x) / kDegree;
  return {.polar_deg = std::atan2(std::hypot(x, y), -z) / kDegree,
          .azimuth_deg = c_deg < 0 ? c_deg + 360 : c_deg};
}

double IntensityTable::at(const Vector3d& direction) const {
  const Angles angles = angles_of(direction);
  const Cell p = polar_.cell(angles.polar_deg), a = azimuth_.cell(angles.azimuth_deg);
  if (p.low < 0 || a.low < 0) return 0;
  const double near =
      (1 - p.share) * intensity_cd_(a.low, p.low) + p.share * intensity_cd_(a.low, p.low + 1);
  const double far = (1 - p.share) * intensity_cd_(a.low + 1, p.low) +
                     p.share * intensity_cd_(a.low + 1, p.low + 1);
  return (1 - a.share) * near + a.share * far;
}

double IntensityTable::most_in(const Angles& low, const Angles& high) const {
  const auto range = [](const Axis& axis, double from, double to) {
    const auto& all = axis.angles_deg;
    if (to < all.front() || from > all.back()) return std::pair<Index, Index>(0, 0);
    const auto first = std::upper_bound(all.begin() + 1, all.end() - 1, from) - 1;
    const auto last = std::lower_bound(all.begin() + 1, all.end() - 1, to);
    return std::pair<Index, Index>(first - all.begin(), last - first + 1);
  };
  const auto [polar, polars] = range(polar_, low.polar_deg, high.polar_deg);
  const auto [azimuth, azimuths] = range(azimuth_, low.azimuth_deg, high.azimuth_deg);
  if (polars == 0 || azimuths == 0) return 0;
  return intensity_cd_.block(azimuth, polar, azimuths, polars).maxCoeff();
}

double IntensityTable::most_within(const Vector3d& direction, double radius_rad) const {
  const Angles centre = angles_of(direction);
  const double radius_deg = radius_rad / kDegree;
  const Angles low{.polar_deg = centre.polar_deg - radius_deg, .azimuth_deg = -360},
      high{.polar_deg = centre.polar_deg + radius_deg, .azimuth_deg = 720};
  const double to_pole_rad =
      kDegree * (type_ == Goniometry::c ? std::min(centre.polar_deg, 180 - centre.polar_deg)
                                        : 90 - std::abs(centre.polar_deg));
  if (to_pole_rad <= radius_rad) return most_in(low, high);
  const double reach_deg = std::asin(std::sin(radius_rad) / std::sin(to_pole_rad)) / kDegree;
  double most = 0;
  for (const double turn_deg : {-360.0, 0.0, 360.0}) {
    const double azimuth_deg = centre.azimuth_deg + turn_deg;
    most = std::max(most, most_in({low.polar_deg, azimuth_deg - reach_deg},
                                  {high.polar_deg, azimuth_deg + reach_deg}));
  }
  return most;
}

double IntensityTable::flux_lm() const {
  return flux_lm(polar_.angles_deg.front(), polar_.angles_deg.back());
}

double IntensityTable::flux_lm(double from_deg, double to_deg) const {
  // As latitudes all three types have the area element cos u du.
  const double equator_deg = type_ == Goniometry::c ? 90 : 0;
  double sum = 0;
  for (std::size_t i = 0; i + 1 < polar_.angles_deg.size(); ++i) {
    const double low = polar_.angles_deg[i], high = polar_.angles_deg[i + 1];
    const double from = std::max(low, from_deg), to = std::min(high, to_deg);
    if (from >= to) continue;
    const double m_low = over_azimuth_[static_cast<Index>(i)],
                 slope = (over_azimuth_[static_cast<Index>(i) + 1] - m_low) / (high - low);
    sum += under_cosine(kDegree * (from - equator_deg), kDegree * (to - equator_deg),
                        m_low + slope * (from - low), m_low + slope * (to - low));
  }
  return sum;
}

}  // namespace scenes
