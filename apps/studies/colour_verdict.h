#pragma once
#include <optional>
#include <string>
#include <vector>

#include "appearance/viewing_conditions.h"
#include "apps/studies/colour_methods.h"
#include "apps/studies/seen.h"

namespace apps {

/// One eye for all methods, adapted to the true light: no error hides in the adaptation to it.
struct Eye {
  appearance::Adaptation adaptation;
  appearance::SizeEffect size;
  spectra::RelativeXyz white;
  double white_y = 0;  ///< lm m^-2
};

[[nodiscard]] Eye eye_of(const appearance::RoomView& view);

/// A computed colour beside the true one.
struct Verdict {
  Seen seen;
  std::optional<double> distance;  ///< in J, a_C, b_C; none where the model defines no J or C
  double de00 = 0;                 ///< Delta E_00
};

[[nodiscard]] Verdict judge(const spectra::Xyz& sent, const spectra::Xyz& truth, const Eye& eye);

/// A method in a room.
struct MethodVerdict {
  std::string name, what;
  double seconds = 0;  ///< median of the repeats
  MethodColours colours;
  std::vector<Verdict> surfaces;
};

struct MeanAndWorst {
  double mean = 0, worst = 0;
  std::size_t worst_surface = 0;
};

[[nodiscard]] MeanAndWorst de00_of(const MethodVerdict& method);

/// Of the distances that are defined; 0 if none is.
[[nodiscard]] MeanAndWorst distance_of(const MethodVerdict& method);

}  // namespace apps
