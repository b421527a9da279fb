#include "scenes/luminaires/ies_tilt.h"

#include <fmt/format.h>

namespace scenes {

Tilt read_tilt(NumberStream& stream, LuminaireFaults& faults) {
  constexpr std::size_t kMostAngles = 10'000;
  const std::vector<PlacedNumber> head = stream.take(2, "numbers about tilt");
  if (head.size() < 2) return {};
  const double position = head[0].value;
  if (position == position && position != 1 && position != 2 && position != 3) {
    faults.add(head[0].place, fmt::format("lamp position {}", position),
               "1 is vertical, 2 stays horizontal, 3 tips");
  }
  const auto count = stream.count(head[1], 2, "number of tilt angles");
  if (count && *count > kMostAngles) {
    faults.add(head[1].place, fmt::format("{} tilt angles", *count), "give at most 10 000");
  }
  if (!count || *count > kMostAngles) faults.throw_faults();
  Tilt tilt;
  for (const PlacedNumber& angle : stream.take(*count, "tilt angles")) {
    if (!tilt.angle_deg.empty() && angle.value <= tilt.angle_deg.back()) {
      faults.add(angle.place,
                 fmt::format("tilt angle {} after {}", angle.value, tilt.angle_deg.back()),
                 "give them rising");
    } else if (angle.value < 0 || angle.value > 180) {
      faults.add(angle.place, fmt::format("tilt angle {}", angle.value), "give 0 to 180");
    }
    tilt.angle_deg.push_back(angle.value);
  }
  for (const PlacedNumber& factor : stream.take(*count, "tilt factors")) {
    if (factor.value < 0) {
      faults.add(factor.place, fmt::format("negative tilt factor {}", factor.value),
                 "give 0 or more");
    } else if (factor.value > 1000) {
      faults.add(factor.place, fmt::format("tilt factor {}", factor.value),
                 "give factors, not percent");
    }
    tilt.factor.push_back(factor.value);
  }
  return tilt;
}

}  // namespace scenes
