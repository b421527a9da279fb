#pragma once
#include <string>
#include <vector>

#include "appearance/spectra/viewed_light.h"
#include "solver/rooms/transport.h"

namespace apps {

/// A computed spectral shape beside a measured one, the amount fitted: relative differences.
struct ShapeError {
  double rms = 0, worst = 0;
  double worst_nm = 0;
};

/// Both over kShapeFrom_nm and up; positive: computed too much.
/// @throws std::invalid_argument  if they are on different grids or something is not above 0
[[nodiscard]] ShapeError shape_error(const spectra::Spectrum& computed,
                                     const spectra::Spectrum& measured);

/// Below, lamp and box of the measured one do not belong together: their blue peaks differ.
inline constexpr double kShapeFrom_nm = 480;

/// A place in the measured box where the white target may have stood.
struct BoxPlace {
  std::string name;
  ShapeError with_bounces, without;
  double mesh_error = 0;  ///< largest relative difference from patches of half the length
};

struct MeasuredBox {
  std::vector<BoxPlace> places;
  double between_readings = 0;  ///< rms of the two readings of the target, one scale fitted
  double between_amounts = 0;   ///< rms of first / second - 1, as they were read
};

/// @param folder  that holds stanford_box.json and its readings
/// @throws spectra::FileError, spectra::InputError
[[nodiscard]] MeasuredBox compare_box(const std::string& folder);

/// What 79 observers saw change between sample and room [Harleman2007], as computed by one choice
/// of the model: over the walls' colours, change from the swatch to the room.
struct SeenDirections {
  std::string room;
  spectra::ViewingChoices choices;
  int colours = 0, chroma_rises = 0;
  int others = 0, others_rise = 0;                           ///< of those that are not yellowish
  double chroma = 0, yellowish = 0, reddish = 0, other = 0;  ///< mean change of C
  double lightness = 0;                                      ///< mean change of J
  int to_yellow = 0, yellowish_colours = 0;  ///< yellowish ones whose hue moves to unique yellow
  int to_bluish_red = 0;                     ///< whose hue moves to a red with a quarter of blue
};

/// Both rooms under every choice of white, background and size; a row for each choice and room.
/// @throws spectra::FileError, spectra::InputError
[[nodiscard]] std::vector<SeenDirections> compare_rooms(const std::string& folder);

}  // namespace apps
