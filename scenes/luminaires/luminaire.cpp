#include "scenes/luminaires/luminaire.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace scenes {

std::string_view to_string(LuminousShape shape) {
  switch (shape) {
    case LuminousShape::rectangle:
      return "rectangle";
    case LuminousShape::ellipse:
      return "ellipse";
    case LuminousShape::box:
      return "box";
    case LuminousShape::cylinder:
      return "cylinder";
    case LuminousShape::sphere:
      return "sphere";
    default:
      return "point";
  }
}

double Tilt::at(double angle) const {
  const auto above = std::ranges::upper_bound(angle_deg, angle);
  if (above == angle_deg.begin()) return factor.front();
  if (above == angle_deg.end()) return factor.back();
  const auto i = static_cast<std::size_t>(above - angle_deg.begin());
  const double share = (angle - angle_deg[i - 1]) / (angle_deg[i] - angle_deg[i - 1]);
  return (1 - share) * factor[i - 1] + share * factor[i];
}

Eigen::Matrix3d luminaire_axes(const Eigen::Vector3d& aim, double rotate_deg) {
  const Eigen::Vector3d down(0, 0, -1), to = aim.stableNormalized();
  const Eigen::AngleAxisd turn(rotate_deg * std::numbers::pi / 180, Eigen::Vector3d::UnitZ());
  const bool up = to.z() > 1 - 1e-12;
  const Eigen::Matrix3d tip = up ? Eigen::Vector3d(1, -1, -1).asDiagonal().toDenseMatrix()
                                 : Eigen::Quaterniond::FromTwoVectors(down, to).toRotationMatrix();
  return tip * turn.toRotationMatrix();
}

std::vector<std::string> oddities(const Luminaire& luminaire) {
  constexpr double kNoticed = 0.01, kNoticedFlux = 0.05;  // of the peak; of the printed flux
  std::vector<std::string> notes;
  const IntensityTable& table = luminaire.intensity;
  const Eigen::ArrayXXd& cd = table.intensity_cd();
  const double noticed_cd = kNoticed * table.peak_cd();
  if (table.type() == Goniometry::c) {
    if ((cd.row(0) - cd.row(cd.rows() - 1)).abs().maxCoeff() > noticed_cd) {
      notes.emplace_back("the planes 0 and 360 differ by more than 1 % of the peak");
    }
    for (const auto& [pole_deg, column] :
         {std::pair{0.0, Eigen::Index{0}}, std::pair{180.0, cd.cols() - 1}}) {
      const bool pole = table.polar_deg()[static_cast<std::size_t>(column)] == pole_deg;
      if (pole && cd.col(column).maxCoeff() - cd.col(column).minCoeff() > noticed_cd) {
        notes.push_back(fmt::format(
            "the planes disagree at vertical angle {} by more than 1 % of the peak", pole_deg));
      }
    }
  }
  if (luminaire.printed_lm && *luminaire.printed_lm > 0) {
    const double ratio = luminaire.flux_lm / *luminaire.printed_lm;
    if (std::abs(ratio - 1) > kNoticedFlux) {
      notes.push_back(fmt::format("the intensities give {:.0f} lm, the file prints {:.0f} lm",
                                  luminaire.flux_lm, *luminaire.printed_lm));
    }
  } else if (luminaire.lamps_lm && luminaire.flux_lm > (1 + kNoticedFlux) * *luminaire.lamps_lm) {
    notes.push_back(
        fmt::format("the intensities give {:.0f} lm, more than the {:.0f} lm of the lamps",
                    luminaire.flux_lm, *luminaire.lamps_lm));
  }
  return notes;
}

}  // namespace scenes
