#include "paints/colour_limit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

#include "appearance/spectra/cie_tables.h"

namespace paints {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int kLevels = 200;     // reflectances at which the room is asked, even steps
constexpr int kMaxSteps = 5000;  // of the search for the widest gap

/// The wall in one lighting, a row per band, a column per level: light, relative to the white, and
/// its derivative by the level.
struct Levels {
  MatrixXd light, slope;
};

/// What an eye adapted to this light must see; throws std::domain_error where nothing looks so.
Eigen::Vector3d wished_stimulus(const Target& target, const appearance::RoomView& view) {
  const auto [x, y, z] = appearance::ciecam02_inverse(
      view.size.inverse({.lightness = target.lightness,
                         .chroma = std::hypot(target.a_c, target.b_c),
                         .hue_deg = std::atan2(target.b_c, target.a_c) * 180 / std::numbers::pi}),
      appearance::adapt(view.conditions));
  return {x, y, z};
}

/// The white is held at `white_y`.
Levels levels_of(const WishInLight& wish, double white_y, double most) {
  const Eigen::Index bands = spectra::kTransportGrid.count;
  Levels levels{MatrixXd(bands, kLevels + 1), MatrixXd(bands, kLevels + 1)};
  const double scale =
      100 * spectra::kMaxLuminousEfficacy_lm_W * spectra::kTransportGrid.step_nm / white_y;
  for (int i = 0; i <= kLevels; ++i) {
    const auto [light, by_reflectance] = wish.room(
        spectra::constant(spectra::kTransportGrid, most * (static_cast<double>(i) / kLevels)));
    levels.light.col(i) = scale * light.sample.values;
    levels.slope.col(i) = scale * most / kLevels * by_reflectance.sample.values;
  }
  return levels;
}

/// The farthest that paints get along a normal.
struct Support {
  VectorXd stimuli;  ///< of the farthest paint among the levels, lightings below each other
  double bound = 0;  ///< for the reflectances between them too
};

/// The light of a wall is a power series in its reflectance, one term per bounce, none negative. So
/// it rises and is convex: between two levels a chord bounds it from above, a tangent from below.
Support support(const std::vector<Levels>& lightings, const VectorXd& normal) {
  const auto& weights = spectra::colour_matching(spectra::kTransportGrid);
  const Eigen::Index bands = weights.rows();
  MatrixXd along = MatrixXd::Zero(bands, kLevels + 1);
  MatrixXd bound = MatrixXd::Zero(bands, kLevels);  // at the upper end of each step
  for (std::size_t l = 0; l < lightings.size(); ++l) {
    const auto& [light, slope] = lightings[l];
    const VectorXd weight = weights * normal.segment<3>(3 * static_cast<Eigen::Index>(l));
    const VectorXd plus = weight.cwiseMax(0), minus = weight.cwiseMin(0);
    along += weight.asDiagonal() * light;
    bound += plus.asDiagonal() * light.rightCols(kLevels);
    bound += minus.asDiagonal() * (light + slope).leftCols(kLevels);
  }
  Support farthest{.stimuli = VectorXd::Zero(normal.size()), .bound = 0};
  for (Eigen::Index k = 0; k < bands; ++k) {
    Eigen::Index best = 0;
    const double reached = along.row(k).maxCoeff(&best);
    farthest.bound += std::max(reached, bound.row(k).maxCoeff());
    for (std::size_t l = 0; l < lightings.size(); ++l) {
      farthest.stimuli.segment<3>(3 * static_cast<Eigen::Index>(l)) +=
          lightings[l].light(k, best) * weights.row(k).transpose();
    }
  }
  return farthest;
}

/// Walks from paint to paint towards the wish [Gilbert1966]; what is left to go is the normal.
ColourLimit widest_gap(const std::vector<Levels>& lightings, const VectorXd& wished) {
  ColourLimit limit;
  VectorXd nearest = VectorXd::Zero(wished.size());
  double widest = -std::numeric_limits<double>::infinity();
  for (int step = 0; step < kMaxSteps; ++step) {
    const VectorXd left = wished - nearest;
    if (left.norm() < 1e-9) break;  // attained, to the digits of the model
    const VectorXd normal = left.normalized();
    const Support far = support(lightings, normal);
    if (const double gap = normal.dot(wished) - far.bound; gap > widest) {
      widest = gap;
      limit.normal = Eigen::Map<const Eigen::Matrix3Xd>(normal.data(), 3, normal.size() / 3);
      limit.wished = normal.dot(wished);
      limit.bound = far.bound;
      if (gap > 0.99 * left.norm()) break;  // no plane has a gap wider than `left`
    }
    const VectorXd along = far.stimuli - nearest;
    const double length = along.squaredNorm() > 0 ? left.dot(along) / along.squaredNorm() : 0;
    if (!(length > 0)) break;
    nearest += std::min(length, 1.0) * along;
  }
  return limit;
}

}  // namespace

ColourLimit colour_limit(std::span<const WishInLight> wishes, const spectra::Spectrum& paint,
                         const InverseOptions& options) {
  VectorXd wished(static_cast<Eigen::Index>(3 * wishes.size()));
  std::vector<Levels> lightings;
  for (std::size_t l = 0; l < wishes.size(); ++l) {
    const appearance::RoomView view =
        appearance::view_of_room(wishes[l].room(paint).light, options.viewing);
    try {
      wished.segment<3>(3 * static_cast<Eigen::Index>(l)) = wished_stimulus(wishes[l].target, view);
    } catch (const std::domain_error&) {
      return {.no_stimulus = true, .normal = {}};
    }
    lightings.push_back(levels_of(wishes[l], view.illuminance_lx, options.most));
  }
  return widest_gap(lightings, wished);
}

}  // namespace paints
