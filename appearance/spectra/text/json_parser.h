#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace spectra {

/// A JSON value and where it stands in its file.
struct JsonValue {
  enum class Kind { null, boolean, number, text, list, object };

  struct Key {
    std::string name;
    std::size_t offset = 0;
  };

  Kind kind = Kind::null;
  std::size_t offset = 0;  ///< of its first byte
  double number = 0;       ///< finite
  std::string text;
  std::vector<JsonValue> items;  ///< of a list or an object
  std::vector<Key> keys;         ///< object: keys[i] names items[i]
};

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
