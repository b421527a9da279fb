#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "appearance/spectra/text/json_reader.h"
#include "scenes/models/building_model.h"

namespace scenes {

/// A key's value; nothing if it is missing or null.
[[nodiscard]] std::optional<spectra::JsonNode> given(const spectra::JsonObject& object,
                                                     const char* key);

/// The modifiers of a Honeybee model, and which of them holds where.
class HoneybeeFinishes {
 public:
  /// @param radiance  properties.radiance of the model
  HoneybeeFinishes(const std::optional<spectra::JsonNode>& radiance,
                   std::vector<std::string>& notes);

  /// @param own  properties.radiance of the object, whose modifier comes first
  /// @param set  of the room; empty: the global one
  /// @param part  of the set, as "wall_set/interior_modifier"
  [[nodiscard]] ModelFinish of(const std::optional<spectra::JsonNode>& own, const std::string& set,
                               const std::string& part);

 private:
  void read_modifier(const spectra::JsonNode& node);
  [[nodiscard]] ModelFinish finish_of(const spectra::JsonNode& node);
  void read_set(const spectra::JsonNode& node);
  void note_once(const std::string& note);

  std::vector<std::string>& notes_;
  std::map<std::string, ModelFinish> modifiers_;
  std::map<std::string, std::map<std::string, std::string>> sets_;  ///< set, part -> modifier
  std::string global_set_;
};

}  // namespace scenes
