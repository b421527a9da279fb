#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "apps/run/room_run.h"
#include "paints/choice_spread.h"

namespace apps {

/// What the target looks like by a choice.
using WishUnder = std::function<paints::Target(const spectra::ViewingChoices&)>;

/// The stated choices of the appearance model: white of share 1 and 0.5, background by ring and 20,
/// size effect off and on. `asked` is what the room file chooses, one of them or one more.
struct ModelChoices {
  std::vector<paints::Choice> all;
  std::size_t asked = 0;

  /// Of the eight.
  [[nodiscard]] static std::size_t at(bool half_white, bool fixed_background, bool size_effect);
};

inline constexpr std::size_t kStatedChoices = 8;

[[nodiscard]] ModelChoices model_choices(const spectra::ViewingChoices& asked,
                                         const WishUnder& wish);

/// A colour under every choice.
struct SpreadRow {
  std::string name;
  std::vector<paints::ChoiceLook> looks;
  std::vector<int> ranks;  ///< per choice; none: it is not ranked
};

/// How far the choice moves what is told of a room: the model's own error bar.
struct ModelSpread {
  ModelChoices choices;
  std::vector<SpreadRow> rows;       ///< the first matters most; none if no paint is left
  std::vector<std::string> winners;  ///< paint that is best under each choice; empty: none ranked

  /// Largest distance in J, a_C, b_C between two looks of a row that differ in one choice.
  struct Moves {
    double white = 0, background = 0, size = 0;
    int undefined = 0;  ///< choices by which CIECAM02 does not define the look: left out
  };

  [[nodiscard]] Moves moves(std::size_t row = 0) const;
};

/// A colour in a room, or as it is seen already, under every choice.
[[nodiscard]] SpreadRow spread_row(const RoomRun& run, const std::string& name,
                                   const spectra::Spectrum& reflectance,
                                   const std::vector<spectra::LitRoom>& rooms,
                                   const ModelChoices& choices,
                                   paints::Distance distance = paints::Distance::jab);

/// A ranking under every choice.
struct RankedSpread {
  std::vector<paints::SpreadPaint> ranked;
  ModelSpread told;  ///< of the first ten by the choice that was asked for, and of those that are
                     ///< best by another
};

[[nodiscard]] RankedSpread ranked_spread(
    const RoomRun& run, const std::vector<const paints::Paint*>& candidates,
    const std::vector<spectra::LitRoom>& rooms, paints::Distance distance,
    const ModelChoices& choices, const std::function<std::string(const paints::Paint&)>& name);

/// The `top` of the ranking by the largest distance over the choices.
void order_robustly(paints::Ranking& ranking, const std::vector<paints::SpreadPaint>& spread,
                    std::size_t top);

}  // namespace apps
