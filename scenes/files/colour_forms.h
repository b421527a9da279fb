#pragma once
#include <optional>
#include <string>

#include "appearance/spectra/stated_colour.h"
#include "appearance/spectra/text/json_reader.h"

namespace scenes {

struct NamedColour {
  std::optional<spectra::StatedColour> colour;  ///< none after a fault
  std::string name;                             ///< for reports: "Lab 81.2 1.9 19.8 (D65/2)"
};

/// Is it { hex }, { Lab }, { XYZ }, { xyY } or { LRV }?
[[nodiscard]] bool states_colour(const spectra::JsonNode& node);

/// One of these; Lab, XYZ and xyY may have an illuminant (D65) and an observer (2) beside.
[[nodiscard]] NamedColour read_colour(const spectra::JsonNode& node);

}  // namespace scenes
