#pragma once
#include <Eigen/Core>
#include <span>

#include "appearance/spectra/viewed_light.h"
#include "paints/ranking.h"

namespace paints {

/// A room in one of its lightings, and how the wall shall look there.
struct WishInLight {
  spectra::RoomResponseSlope room;  ///< on the transport grid
  Target target;
};

struct InverseOptions {
  spectra::ViewingChoices viewing;
  double most = 0.999;  ///< no band of the answer reflects more
};

/// A plane between the stimuli that a wall can send and those that are wished: X, Y, Z in each
/// lighting, on the scale of its white at Y = 100. For optimal colours see [MacAdam1935].
///
/// The eye is held in the state of adaptation that a given paint brings about, so the wish is one
/// stimulus per lighting. The bound holds for every reflectance within 0..most, with all
/// interreflection: light in a band depends on the reflectance of that band alone and rises with
/// it. So `wished > bound` proves that no paint at all looks as wished to an eye in this state. It
/// does not rule out another paint that brings the eye into another state.
struct ColourLimit {
  bool no_stimulus = false;  ///< no stimulus, of paint or not, looks as wished in this state
  Eigen::Matrix3Xd normal;   ///< of length 1 over all lightings; a column per lighting
  double wished = 0;         ///< normal times the wished stimuli
  double bound = 0;          ///< no paint gets further along the normal

  [[nodiscard]] bool proves() const { return no_stimulus || wished > bound; }
};

/// The plane with the widest gap that was found, with the eye as `paint` leaves it.
/// @throws std::domain_error  if a room leaves the viewer without light
[[nodiscard]] ColourLimit colour_limit(std::span<const WishInLight> wishes,
                                       const spectra::Spectrum& paint,
                                       const InverseOptions& options);

}  // namespace paints
