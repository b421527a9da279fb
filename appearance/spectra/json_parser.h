#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "appearance/spectra/json_reader.h"

namespace spectra {

struct PlacedFault {
  std::size_t offset = 0;
  std::string pointer, problem, remedy;
};

struct ParsedJson {
  JsonValue root;
  bool complete = false;  ///< false: the last fault ended the parsing
  std::vector<PlacedFault> faults;
};

/// Parses by nlohmann's SAX interface, which keeps no positions: the place of every token is found
/// by following the text beside it.
[[nodiscard]] ParsedJson parse_json(std::string_view text);

/// One reference token of a JSON pointer (RFC 6901), with its slash.
[[nodiscard]] std::string pointer_token(std::string_view key);

}  // namespace spectra
