#include "appearance/spectra/text/json_parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <unordered_set>

namespace spectra {
namespace {

using Kind = JsonValue::Kind;

constexpr std::size_t kMostNesting = 32;
constexpr std::size_t kMostValues = 1'000'000;

/// Follows the text from token to token; the parser vouches that they are well formed.
class TokenFinder {
 public:
  explicit TokenFinder(std::string_view text) : text_(text) {
    if (text.starts_with("\xEF\xBB\xBF")) end_ = 3;
  }

  /// Offset of the next token that is no comma or colon.
  std::size_t next() {
    const std::size_t start = std::min(text_.find_first_not_of(" \t\r\n,:", end_), text_.size());
    end_ = end_of(start);
    return start;
  }

  /// Where a token that the parser refuses is: behind at most one comma or colon.
  [[nodiscard]] std::size_t after_separator() const {
    std::size_t at = skip_space(end_);
    if (at < text_.size() && (text_[at] == ',' || text_[at] == ':')) at = skip_space(at + 1);
    return at;
  }

 private:
  [[nodiscard]] std::size_t skip_space(std::size_t from) const {
    return std::min(text_.find_first_not_of(" \t\r\n", from), text_.size());
  }

  [[nodiscard]] std::size_t end_of(std::size_t start) const {
    if (start >= text_.size()) return text_.size();
    if (text_[start] == '"') {
      std::size_t i = start + 1;
      while (i < text_.size() && text_[i] != '"') i += text_[i] == '\\' ? 2 : 1;
      return std::min(i + 1, text_.size());
    }
    if (std::string_view("[]{}").find(text_[start]) != std::string_view::npos) return start + 1;
    return std::min(text_.find_first_of(" \t\r\n,:[]{}\"", start), text_.size());
  }

  std::string_view text_;
  std::size_t end_ = 0;
};

/// "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while parsing
/// value - unexpected end of input; expected ..." without the library's own words, and without the
/// bytes last read, which may be no UTF-8.
std::string syntax_problem(std::string_view message) {
  if (message.find("out_of_range.406") != std::string_view::npos) {
    return "the number is too large for double precision";
  }
  const std::size_t start = message.find("syntax error");
  if (start != std::string_view::npos) message.remove_prefix(start);
  const std::size_t last_read = message.find("; last read: '");
  return std::string(message.substr(0, last_read));
}

class TreeBuilder : public nlohmann::json::json_sax_t {
 public:
  TreeBuilder(std::string_view text, ParsedJson& result)
      : tokens_(text), text_(text), result_(result) {}

  bool null() override { return leaf({.kind = Kind::null}); }

  bool boolean(bool value) override {
    return leaf({.kind = Kind::boolean, .number = value ? 1.0 : 0.0});
  }

  bool number_integer(number_integer_t value) override {
    return leaf({.kind = Kind::number, .number = static_cast<double>(value)});
  }

  bool number_unsigned(number_unsigned_t value) override {
    return leaf({.kind = Kind::number, .number = static_cast<double>(value)});
  }

  bool number_float(number_float_t value, const string_t&) override {
    return leaf({.kind = Kind::number, .number = value});
  }

  bool string(string_t& value) override {
    return leaf({.kind = Kind::text, .text = std::move(value)});
  }

  bool binary(binary_t&) override { return false; }

  bool start_object(std::size_t) override { return open(Kind::object); }

  bool start_array(std::size_t) override { return open(Kind::list); }

  bool end_object() override { return close(); }

  bool end_array() override { return close(); }

  bool key(string_t& name) override {
    Container& top = open_.back();
    const std::size_t offset = tokens_.next();
    if (!top.seen.insert(name).second) {
      fault(offset, pointer() + pointer_token(name),
            fmt::format("the key \"{}\" appears twice in this object", name),
            "keep one of the two");
    }
    top.value->keys.push_back({name, offset});
    return true;
  }

  bool parse_error(std::size_t bytes_read, const std::string&,
                   const nlohmann::detail::exception& error) override {
    // The parser has read the refused token, but no further.
    const std::size_t last_byte = std::max<std::size_t>(bytes_read, 1) - 1;
    fault(std::min(tokens_.after_separator(), last_byte), pointer_of_next(),
          syntax_problem(error.what()),
          "mend the JSON here: a comma, colon, quote or bracket may be missing or too many");
    return false;
  }

 private:
  struct Container {
    JsonValue* value;
    std::unordered_set<std::string> seen;
  };

  void fault(std::size_t offset, std::string pointer, std::string problem, std::string remedy) {
    result_.faults.push_back({offset, std::move(pointer), std::move(problem), std::move(remedy)});
  }

  /// Where a value would stand whose key has been read.
  [[nodiscard]] std::string pointer_of_next() const {
    if (open_.empty()) return "";
    const JsonValue& top = *open_.back().value;
    return top.keys.size() > top.items.size() ? pointer() + pointer_token(top.keys.back().name)
                                              : pointer();
  }

  /// Of the innermost open container.
  [[nodiscard]] std::string pointer() const {
    std::string path;
    for (std::size_t i = 0; i + 1 < open_.size(); ++i) {
      const JsonValue& parent = *open_[i].value;
      path += parent.kind == Kind::object ? pointer_token(parent.keys.back().name)
                                          : fmt::format("/{}", parent.items.size() - 1);
    }
    return path;
  }

  JsonValue* add(JsonValue value) {
    value.offset = tokens_.next();
    if (++count_ > kMostValues) {
      fault(value.offset, pointer(), fmt::format("the file has more than {} values", kMostValues),
            "leave out what a room does not need, or keep spectra in CSV files");
      return nullptr;
    }
    JsonValue* place = &result_.root;
    if (!open_.empty()) {
      // Only the innermost open container grows, so pointers to the outer ones stay valid.
      place = &open_.back().value->items.emplace_back();
    }
    *place = std::move(value);
    return place;
  }

  bool leaf(JsonValue value) { return add(std::move(value)) != nullptr; }

  bool open(Kind kind) {
    JsonValue* place = add({.kind = kind});
    if (place == nullptr) return false;
    open_.push_back({place, {}});
    if (open_.size() <= kMostNesting) return true;
    fault(place->offset, pointer(), fmt::format("nested deeper than {} levels", kMostNesting),
          "remove some of the brackets");
    return false;
  }

  bool close() {
    tokens_.next();
    open_.pop_back();
    return true;
  }

  TokenFinder tokens_;
  std::string_view text_;
  ParsedJson& result_;
  std::vector<Container> open_;
  std::size_t count_ = 0;
};

}  // namespace

ParsedJson parse_json(std::string_view text) {
  ParsedJson result;
  // The library takes a NUL for the end of the file and would not look behind it.
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos) {
    result.faults.push_back({nul, "", "the file contains a NUL byte",
                             "save it as plain UTF-8 text (not UTF-16, not binary)"});
    return result;
  }
  TreeBuilder builder(text, result);
  result.complete = nlohmann::json::sax_parse(text.begin(), text.end(), &builder);
  return result;
}

std::string pointer_token(std::string_view key) {
  std::string token = "/";
  for (const char c : key) {
    if (c == '~') {
      token += "~0";
    } else if (c == '/') {
      token += "~1";
    } else {
      token += c;
    }
  }
  return token;
}

}  // namespace spectra
