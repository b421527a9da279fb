#pragma once
#include <string>
#include <vector>

#include "paints/ranking.h"

namespace paints {

/// One way to model what people see, and how the target looks by it.
struct Choice {
  std::string name;
  spectra::ViewingChoices viewing;
  Target target;
};

/// Under one choice: distance from the target over all lightings, look in the first of them.
struct ChoiceLook {
  double distance = 0;  ///< infinite where the model leaves the look undefined
  appearance::Correlates correlates;
};

struct SpreadPaint {
  const Paint* paint = nullptr;
  std::vector<ChoiceLook> looks;  ///< per choice

  /// Over the choices.
  [[nodiscard]] double largest_distance() const;
};

/// Choices and how distances are taken under them.
struct SpreadOptions {
  std::vector<Choice> choices;
  Distance distance = Distance::jab;
  spectra::Judgement judgement = spectra::Judgement::mean;
};

/// One paint under every choice; each lighting of the room is asked once.
[[nodiscard]] std::vector<ChoiceLook> looks_of(const spectra::Spectrum& reflectance,
                                               const std::vector<spectra::LitRoom>& rooms,
                                               const SpreadOptions& options);

/// Each of these paints.
[[nodiscard]] std::vector<SpreadPaint> spread_of(const std::vector<const Paint*>& paints,
                                                 const std::vector<spectra::LitRoom>& rooms,
                                                 const SpreadOptions& options);

/// Rank of every paint under a choice, from 1; ties by their order.
[[nodiscard]] std::vector<int> ranks_under(const std::vector<SpreadPaint>& paints,
                                           std::size_t choice);

}  // namespace paints
