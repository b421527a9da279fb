#pragma once
#include <optional>
#include <string>

#include "appearance/ciecam02.h"
#include "appearance/viewing_conditions.h"

namespace apps {

/// Correlates as they are reported: nothing where the model leaves one undefined.
struct Reported {
  explicit Reported(const appearance::Correlates& correlates);

  std::optional<double> j, c, q, m, s, a_c, b_c, a_m, b_m, a_s, b_s;
  double h_deg, hue_quadrature;
};

/// A colour under one viewing condition.
struct Seen {
  spectra::RelativeXyz xyz;
  appearance::Correlates correlates;
};

/// A paint as on the swatch and as on a surface of the room.
struct Shift {
  std::string paint, surface;
  bool reconstructed = false;  ///< its spectrum was computed from a colour, not measured
  Seen swatch, room;
};

[[nodiscard]] Seen seen_in_room(const appearance::RoomView& view);
[[nodiscard]] Seen seen_on_swatch(
    const spectra::Spectrum& reflectance,
    const appearance::SwatchCondition& swatch = appearance::standard_swatch());

}  // namespace apps
