#pragma once
#include <Eigen/Core>
#include <optional>
#include <span>

#include "appearance/spectra/viewed_light.h"
#include "paints/colour_limit.h"
#include "paints/ranking.h"

namespace paints {

/// The answer to a wish, and what proves it.
struct InverseColour {
  spectra::Spectrum reflectance;  ///< 0 <= rho <= most
  bool exact = false;             ///< else the nearest that was found
  Eigen::Matrix3Xd missed;        ///< J, a_C, b_C as seen minus as wished; a column per lighting
  double distance = 0;   ///< root mean square over the lightings of the distance in J, a_C, b_C
  double roughness = 0;  ///< sum of the squared differences of neighbouring bands

  /// Karush-Kuhn-Tucker: gradient + slope' multipliers = bound_multipliers, which are 0 in free
  /// bands, >= 0 in bands at 0 and <= 0 in bands at `most`. `stationarity` is the largest
  /// violation. If exact, the gradient is that of roughness / 2; else it is 0, the multipliers are
  /// `missed`, and no small change of the reflectance brings it nearer.
  Eigen::Matrix3Xd multipliers;      ///< as `missed`
  Eigen::ArrayXd bound_multipliers;  ///< one per band
  double stationarity = 0;

  std::optional<ColourLimit> limit;  ///< unless exact: what forbids the wish
};

/// The smoothest reflectance that looks exactly as wished, in every one of the lightings: smooth by
/// the squared differences of neighbouring bands [VanTrigt1990], so that ends which nobody sees
/// stay flat, and a grey wish in a neutral room is answered by a grey. Augmented Lagrangian
/// [Powell1969] around Newton steps within the bounds [Stark1995], from three greys; of
/// several exact answers the smoothest, else the nearest is kept. Both are proven locally optimal
/// only: a room is not linear in its paint.
/// @throws std::invalid_argument  without lightings, or if a target is not finite or `most` is not
/// within 0..1
/// @throws std::domain_error      if a room leaves the viewer without light
[[nodiscard]] InverseColour inverse_colour(std::span<const WishInLight> wishes,
                                           const InverseOptions& options = {});

}  // namespace paints
