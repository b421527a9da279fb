#include "appearance/spectra/text/json_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "appearance/spectra/text/input_bytes.h"
#include "appearance/spectra/text/json_parser.h"

namespace spectra {
namespace {

using Kind = JsonValue::Kind;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t kMostBytes = std::size_t{16} << 20;
constexpr std::size_t kMostFaults = 1000;

const char* kind_name(Kind kind) {
  switch (kind) {
    case Kind::null:
      return "null";
    case Kind::boolean:
      return "true or false";
    case Kind::number:
      return "a number";
    case Kind::text:
      return "a text";
    case Kind::list:
      return "a list";
    case Kind::object:
      return "an object";
  }
  return "";
}

/// Control characters would upset terminals and CSV files.
bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

std::string printable(std::string text) {
  std::replace_if(text.begin(), text.end(), is_control, '?');
  return text;
}

int edit_distance(std::string_view a, std::string_view b) {
  std::vector<int> row(b.size() + 1);
  std::iota(row.begin(), row.end(), 0);
  for (std::size_t i = 0; i < a.size(); ++i) {
    int diagonal = row[0];
    row[0] = static_cast<int>(i) + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const int replaced = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
    }
  }
  return row.back();
}

}  // namespace

bool Limits::allow(double value) const {
  return (above_least ? value > least : value >= least) &&
         (below_most ? value < most : value <= most);
}

std::string Limits::words() const {
  std::string words = "a number";
  if (std::isfinite(least)) words += fmt::format(" {} {}", above_least ? "above" : "from", least);
  if (std::isfinite(most)) {
    words += std::isfinite(least) ? (above_least ? " and " : " to ") : " ";
    words += below_most    ? fmt::format("below {}", most)
             : above_least ? fmt::format("up to {}", most)
                           : fmt::format("{}", most);
  }
  return words;
}

void JsonNode::fault(std::string problem, std::string remedy) const {
  file_->fault(value_->offset, pointer_, std::move(problem), std::move(remedy));
}

double JsonNode::number(const Limits& limits) const {
  if (!is(Kind::number)) {
    fault(fmt::format("{} stands where a number belongs", kind_name(kind())),
          "give " + limits.words());
    return kNaN;
  }
  if (limits.allow(value_->number)) return value_->number;
  fault(fmt::format("{} is out of range", value_->number), "give " + limits.words());
  return kNaN;
}

int JsonNode::whole_number(int least, int most) const {
  const std::string remedy = fmt::format("give a whole number from {} to {}", least, most);
  if (!is(Kind::number)) {
    fault(fmt::format("{} stands where a whole number belongs", kind_name(kind())), remedy);
  } else if (!(value_->number >= least && value_->number <= most)) {
    fault(fmt::format("{} is out of range", value_->number), remedy);
  } else if (value_->number != std::floor(value_->number)) {
    fault(fmt::format("{} is no whole number", value_->number), remedy);
  } else {
    return static_cast<int>(value_->number);
  }
  return least;
}

std::string JsonNode::text() const {
  if (is(Kind::text)) return value_->text;
  fault(fmt::format("{} stands where a text belongs", kind_name(kind())),
        "give a text in double quotes");
  return "";
}

std::string JsonNode::name() const {
  if (!is(Kind::text)) return text();
  if (value_->text.empty()) {
    fault("the name is empty", "give a name of at least one letter");
  } else if (std::any_of(value_->text.begin(), value_->text.end(), is_control)) {
    fault("the name holds a control character", "use letters, digits, blanks and punctuation");
    return "";
  }
  return value_->text;
}

int JsonNode::choice(std::span<const std::string> names) const {
  if (!is(Kind::text)) {
    fault(fmt::format("{} stands where a word belongs", kind_name(kind())),
          "give " + alternatives(names));
    return -1;
  }
  const auto found = std::find(names.begin(), names.end(), value_->text);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  fault(fmt::format("\"{}\" is not known here", value_->text), "give " + alternatives(names));
  return -1;
}

std::vector<JsonNode> JsonNode::list(std::size_t least, std::size_t most) const {
  std::vector<JsonNode> nodes;
  if (!is(Kind::list)) {
    fault(fmt::format("{} stands where a list belongs", kind_name(kind())),
          "give a list in square brackets");
    return nodes;
  }
  const std::size_t count = value_->items.size();
  if (count < least || count > most) {
    fault(fmt::format("the list has {} entries", count),
          least == most ? fmt::format("give exactly {}", least)
                        : fmt::format("give {} to {}", least, most));
    return nodes;
  }
  nodes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    nodes.emplace_back(*file_, value_->items[i], fmt::format("{}/{}", pointer_, i));
  }
  return nodes;
}

std::vector<double> JsonNode::numbers(std::size_t count, const Limits& limits) const {
  std::vector<double> values;
  for (const JsonNode& node : list(count, count)) values.push_back(node.number(limits));
  values.resize(count, kNaN);
  return values;
}

bool JsonNode::has(std::string_view key) const {
  return std::any_of(value_->keys.begin(), value_->keys.end(),
                     [&](const JsonValue::Key& k) { return k.name == key; });
}

JsonObject JsonNode::any_object() const {
  const bool readable = is(Kind::object);
  if (!readable) {
    fault(fmt::format("{} stands where an object belongs", kind_name(kind())),
          "give an object in braces");
  }
  return {*this, readable};
}

JsonNode JsonNode::beside(std::vector<std::string> keys) const {
  JsonNode node = *this;
  node.known_elsewhere_ = std::move(keys);
  return node;
}

JsonObject JsonNode::object(const std::vector<std::string>& keys) const {
  const auto in = [](const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const JsonValue::Key& key : value_->keys) {
    if (in(keys, key.name) || in(known_elsewhere_, key.name)) continue;
    const std::string near = nearest_name(key.name, keys);
    file_->fault(key.offset, pointer_ + pointer_token(key.name),
                 fmt::format("the key \"{}\" is unknown here", key.name),
                 near.empty() ? "known here: " + alternatives(keys)
                              : fmt::format("did you mean \"{}\"?", near));
  }
  return any_object();
}

std::optional<JsonNode> JsonObject::find(std::string_view key) const {
  if (!readable_) return std::nullopt;
  const JsonValue& value = *node_.value_;
  for (std::size_t i = 0; i < value.keys.size(); ++i) {
    if (value.keys[i].name == key) {
      return JsonNode(*node_.file_, value.items[i], node_.pointer_ + pointer_token(key));
    }
  }
  return std::nullopt;
}

std::vector<std::pair<std::string, JsonNode>> JsonObject::entries() const {
  std::vector<std::pair<std::string, JsonNode>> all;
  if (!readable_) return all;
  for (const JsonValue::Key& key : node_.value_->keys) all.emplace_back(key.name, *find(key.name));
  return all;
}

std::optional<JsonNode> JsonObject::need(std::string_view key) const {
  std::optional<JsonNode> found = find(key);
  if (!found && readable_) {
    fault(fmt::format("the key \"{}\" is missing", key), fmt::format("add \"{}\"", key));
  }
  return found;
}

double JsonObject::number(std::string_view key, const Limits& limits) const {
  const std::optional<JsonNode> node = need(key);
  return node ? node->number(limits) : kNaN;
}

double JsonObject::number_or(std::string_view key, double fallback, const Limits& limits) const {
  const std::optional<JsonNode> node = find(key);
  return node ? node->number(limits) : fallback;
}

std::string JsonObject::name(std::string_view key) const {
  const std::optional<JsonNode> node = need(key);
  return node ? node->name() : "";
}

std::vector<double> JsonObject::numbers(std::string_view key, std::size_t count,
                                        const Limits& limits) const {
  const std::optional<JsonNode> node = need(key);
  return node ? node->numbers(count, limits) : std::vector<double>(count, kNaN);
}

std::vector<JsonNode> JsonObject::list_or_empty(std::string_view key, std::size_t most) const {
  const std::optional<JsonNode> node = find(key);
  return node ? node->list(0, most) : std::vector<JsonNode>{};
}

void JsonObject::fault(std::string problem, std::string remedy) const {
  node_.fault(std::move(problem), std::move(remedy));
}

JsonFile::JsonFile(std::string path, std::string text)
    : path_(std::move(path)), text_(std::move(text)) {
  ParsedJson parsed = parse_json(text_);
  root_ = std::move(parsed.root);
  for (PlacedFault& f : parsed.faults) {
    fault(f.offset, std::move(f.pointer), std::move(f.problem), std::move(f.remedy));
  }
  if (!parsed.complete) throw_faults();
}

void JsonFile::fault(std::size_t offset, std::string pointer, std::string problem,
                     std::string remedy) {
  if (faults_.size() == kMostFaults) {
    ++more_faults_;
    return;
  }
  faults_.emplace_back(offset, Fault{.file = path_,
                                     .pointer = printable(std::move(pointer)),
                                     .problem = printable(std::move(problem)),
                                     .remedy = printable(std::move(remedy))});
}

void JsonFile::add(const std::vector<Fault>& faults) {
  for (const Fault& fault : faults) faults_.emplace_back(text_.size(), fault);
}

void JsonFile::throw_faults() const {
  if (faults_.empty()) return;
  auto placed = faults_;
  std::stable_sort(placed.begin(), placed.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Fault> faults;
  std::size_t at = 0, line_start = 0;
  int line = 1;
  for (auto& [offset, fault] : placed) {
    for (; at < std::min(offset, text_.size()); ++at) {
      if (text_[at] != '\n') continue;
      ++line;
      line_start = at + 1;
    }
    if (fault.file == path_) {
      fault.line = line;
      fault.column = static_cast<int>(offset - line_start) + 1;
    }
    faults.push_back(std::move(fault));
  }
  if (more_faults_ > 0) {
    faults.push_back({.file = path_,
                      .problem = fmt::format("{} more faults", more_faults_),
                      .remedy = "mend those above first"});
  }
  throw InputError(std::move(faults));
}

JsonFile read_json_file(const std::string& path) {
  std::string text =
      read_input(path, kMostBytes, "is it a room file? Keep long spectra in CSV files");
  return {path, std::move(text)};
}

std::string nearest_name(std::string_view word, std::span<const std::string> candidates) {
  std::string best;
  // More than a third of the letters wrong is another word.
  int best_edits = static_cast<int>(word.size() + 2) / 3 + 1;
  if (word.size() > 100) return best;
  for (const std::string& candidate : candidates) {
    const int edits = edit_distance(word, candidate);
    if (edits < best_edits) {
      best_edits = edits;
      best = candidate;
    }
  }
  return best;
}

std::string alternatives(std::span<const std::string> names) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 == names.size() ? " or " : ", ";
    text += "\"" + names[i] + "\"";
  }
  return text;
}

}  // namespace spectra
