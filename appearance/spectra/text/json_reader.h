#pragma once
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "appearance/spectra/text/input_error.h"
#include "appearance/spectra/text/json_parser.h"

namespace spectra {

/// The numbers that a key takes.
struct Limits {
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  bool above_least = false;  ///< `least` itself is refused
  bool below_most = false;   ///< `most` itself is refused

  [[nodiscard]] bool allow(double value) const;
  [[nodiscard]] std::string words() const;  ///< "a number from 0 to below 1"
};

class JsonFile;
class JsonObject;

/// A value to be read. Reading never throws: faults are collected in the file, and what could not
/// be read becomes NaN, "" or an empty list, so that the rest can be read and checked as well.
/// Valid as long as its JsonFile.
class JsonNode {
 public:
  using Kind = JsonValue::Kind;

  JsonNode(JsonFile& file, const JsonValue& value, std::string pointer)
      : file_(&file), value_(&value), pointer_(std::move(pointer)) {}

  [[nodiscard]] Kind kind() const { return value_->kind; }

  [[nodiscard]] bool is(Kind kind) const { return value_->kind == kind; }

  /// A list or object without entries, or any other value.
  [[nodiscard]] bool empty() const { return value_->items.empty(); }

  [[nodiscard]] const std::string& pointer() const { return pointer_; }

  /// True if it is `true`.
  [[nodiscard]] bool truth() const { return is(Kind::boolean) && value_->number != 0; }

  [[nodiscard]] double number(const Limits& limits = {}) const;
  [[nodiscard]] int whole_number(int least, int most) const;  ///< `least` after a fault
  [[nodiscard]] std::string text() const;
  /// A name: text without control characters, not empty.
  [[nodiscard]] std::string name() const;
  /// Index of its text in `names`, -1 after a fault.
  [[nodiscard]] int choice(std::span<const std::string> names) const;
  [[nodiscard]] std::vector<JsonNode> list(std::size_t least = 0, std::size_t most = 1000) const;
  /// Exactly `count` numbers; all NaN after a fault.
  [[nodiscard]] std::vector<double> numbers(std::size_t count, const Limits& limits = {}) const;
  /// Keys other than these are faults.
  [[nodiscard]] JsonObject object(const std::vector<std::string>& keys) const;
  /// The same, for a reader who does not know these keys: they are none of its faults.
  [[nodiscard]] JsonNode beside(std::vector<std::string> keys) const;
  /// An object whose keys are names that the file makes up.
  [[nodiscard]] JsonObject any_object() const;
  /// True if it is an object with this key.
  [[nodiscard]] bool has(std::string_view key) const;

  void fault(std::string problem, std::string remedy) const;

 private:
  friend class JsonObject;

  JsonFile* file_;
  const JsonValue* value_;
  std::string pointer_;
  std::vector<std::string> known_elsewhere_;
};

/// An object whose keys are known. If the value was no object, every key is absent and no further
/// fault is added.
class JsonObject {
 public:
  JsonObject(JsonNode node, bool readable) : node_(std::move(node)), readable_(readable) {}

  [[nodiscard]] bool has(std::string_view key) const { return find(key).has_value(); }

  [[nodiscard]] std::optional<JsonNode> find(std::string_view key) const;
  /// Every key and its value, in the order of the file.
  [[nodiscard]] std::vector<std::pair<std::string, JsonNode>> entries() const;
  /// A fault if it is missing.
  [[nodiscard]] std::optional<JsonNode> need(std::string_view key) const;

  [[nodiscard]] double number(std::string_view key, const Limits& limits = {}) const;
  [[nodiscard]] double number_or(std::string_view key, double fallback,
                                 const Limits& limits = {}) const;
  [[nodiscard]] std::string name(std::string_view key) const;
  [[nodiscard]] std::vector<double> numbers(std::string_view key, std::size_t count,
                                            const Limits& limits = {}) const;
  /// Empty if the key is absent.
  [[nodiscard]] std::vector<JsonNode> list_or_empty(std::string_view key,
                                                    std::size_t most = 1000) const;

  void fault(std::string problem, std::string remedy) const;

 private:
  JsonNode node_;
  bool readable_;
};

/// A parsed JSON file (RFC 8259) and the faults found in it.
class JsonFile {
 public:
  /// @param path  as it shall stand in the faults
  /// @throws InputError  if `text` is not JSON: syntax, UTF-8, NUL, a number beyond double, nesting
  /// deeper than 32, more than a million values
  JsonFile(std::string path, std::string text);
  JsonFile(const JsonFile&) = delete;
  JsonFile& operator=(const JsonFile&) = delete;

  [[nodiscard]] JsonNode root() { return {*this, root_, ""}; }

  [[nodiscard]] const std::string& path() const { return path_; }

  void fault(std::size_t offset, std::string pointer, std::string problem, std::string remedy);
  /// Adds the faults of another file, behind those of this one.
  void add(const std::vector<Fault>& faults);
  /// @throws InputError  with all faults in the order of the file, if there are any
  void throw_faults() const;

 private:
  std::string path_, text_;
  JsonValue root_;
  std::vector<std::pair<std::size_t, Fault>> faults_;
  std::size_t more_faults_ = 0;  ///< beyond the thousand that are kept
};

/// Reads and parses. @throws FileError  if it cannot be read  @throws InputError  as above, and if
/// it is larger than 16 MiB
[[nodiscard]] JsonFile read_json_file(const std::string& path);

/// The candidate with the fewest edits from `word`; "" if none is near.
[[nodiscard]] std::string nearest_name(std::string_view word,
                                       std::span<const std::string> candidates);

/// "a, b or c"
[[nodiscard]] std::string alternatives(std::span<const std::string> names);

}  // namespace spectra
