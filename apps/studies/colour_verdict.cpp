#include "apps/studies/colour_verdict.h"

#include <cmath>

#include "appearance/ciede2000.h"

namespace apps {
namespace {

std::optional<double> distance(const appearance::Correlates& p, const appearance::Correlates& q) {
  if (!p.status.all_defined() || !q.status.all_defined()) return std::nullopt;
  return std::hypot(p.lightness - q.lightness, p.a_c - q.a_c, p.b_c - q.b_c);
}

/// Of `value` over the surfaces that have one.
template <typename Value>
MeanAndWorst mean_and_worst(const MethodVerdict& method, Value value) {
  MeanAndWorst result;
  int count = 0;
  for (std::size_t k = 0; k < method.surfaces.size(); ++k) {
    const std::optional<double> v = value(method.surfaces[k]);
    if (!v) continue;
    ++count;
    result.mean += (*v - result.mean) / count;
    if (*v > result.worst) result = {result.mean, *v, k};
  }
  return result;
}

}  // namespace

Eye eye_of(const appearance::RoomView& view) {
  return {.adaptation = appearance::adapt(view.conditions),
          .size = view.size,
          .white = view.conditions.white,
          .white_y = view.illuminance_lx};
}

Verdict judge(const spectra::Xyz& sent, const spectra::Xyz& truth, const Eye& eye) {
  const auto seen = [&](const spectra::Xyz& light) -> Seen {
    const spectra::RelativeXyz xyz = spectra::relative_xyz(light, eye.white_y);
    return {.xyz = xyz, .correlates = appearance::seen(xyz, eye.adaptation, eye.size)};
  };
  const Seen is = seen(sent), should_be = seen(truth);
  return {.seen = is,
          .distance = distance(is.correlates, should_be.correlates),
          .de00 = appearance::ciede2000(appearance::cielab(is.xyz, eye.white),
                                        appearance::cielab(should_be.xyz, eye.white))};
}

MeanAndWorst de00_of(const MethodVerdict& method) {
  return mean_and_worst(method, [](const Verdict& v) { return std::optional(v.de00); });
}

MeanAndWorst distance_of(const MethodVerdict& method) {
  return mean_and_worst(method, [](const Verdict& v) { return v.distance; });
}

}  // namespace apps
