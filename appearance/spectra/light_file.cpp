#include "appearance/spectra/light_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <pugixml.hpp>
#include <string_view>

#include "appearance/spectra/text/csv_reader.h"
#include "appearance/spectra/text/input_bytes.h"

namespace spectra {
namespace {

constexpr std::size_t kMostBytes = std::size_t{16} << 20, kMostFaults = 100;

struct Place {
  int line = 0, column = 0;
};

/// A curve on its way, with the places of its numbers.
struct Draft {
  std::string name;
  std::vector<double> nm, values;
  std::vector<Place> places;
};

class Faults {
 public:
  explicit Faults(const std::string& path) : path_(path) {}

  void add(Place at, std::string problem, std::string remedy) {
    if (all_.size() < kMostFaults) {
      all_.push_back({path_, at.line, at.column, "", std::move(problem), std::move(remedy)});
    }
  }

  void throw_if_any() const {
    if (!all_.empty()) throw InputError(all_);
  }

 private:
  const std::string& path_;
  std::vector<Fault> all_;
};

std::string_view trimmed(std::string_view text) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

struct Token {
  std::string text;
  int column = 1;
};

/// Cells of a line; a comma is decimal where something else separates.
std::vector<Token> tokens_of(std::string_view line) {
  const bool semicolons = line.find(';') != line.npos, tabs = line.find('\t') != line.npos;
  const auto separates = [&](char c) {
    return semicolons ? c == ';' : tabs ? c == '\t' : c == ',' || c == ' ';
  };
  std::vector<Token> tokens;
  for (std::size_t from = 0; from <= line.size();) {
    std::size_t to = from;
    while (to < line.size() && !separates(line[to])) ++to;
    const std::string_view cell = trimmed(line.substr(from, to - from));
    if (!cell.empty()) tokens.push_back({std::string(cell), static_cast<int>(from) + 1});
    from = to + 1;
  }
  if (semicolons || tabs) {
    for (Token& token : tokens) std::ranges::replace(token.text, ',', '.');
  }
  return tokens;
}

bool is_comment(std::string_view line) {
  const char first = line.front();
  return std::isalpha(static_cast<unsigned char>(first)) != 0 || std::strchr("\"'#;!", first);
}

/// Columns of text.
class ColumnReader {
 public:
  ColumnReader(std::string_view text, Faults& faults) : text_(text), faults_(faults) {}

  [[nodiscard]] std::vector<Draft> read();

 private:
  void take(std::string_view line, int number);

  std::string_view text_;
  Faults& faults_;
  std::vector<Token> heading_;
  std::vector<Draft> drafts_;
};

std::vector<Draft> ColumnReader::read() {
  if (text_.substr(0, 3) == "\xEF\xBB\xBF") text_.remove_prefix(3);
  const bool tables =
      text_.find("BEGIN_DATA\n") != text_.npos || text_.find("BEGIN_DATA\r") != text_.npos;
  bool inside = !tables;
  int number = 0;
  for (std::string_view left = text_; !left.empty();) {
    const std::size_t end = std::min(left.find('\n'), left.size());
    const std::string_view line = left.substr(0, end);
    left.remove_prefix(std::min(end + 1, left.size()));
    ++number;
    const std::string_view content = trimmed(line);
    if (content.empty()) continue;
    if (tables && content == "BEGIN_DATA") {
      inside = true;
    } else if (tables && content == "END_DATA") {
      inside = false;
    } else if (is_comment(content)) {
      if (drafts_.empty()) heading_ = tokens_of(line);
    } else if (inside) {
      take(line, number);
    }
  }
  return drafts_;
}

void ColumnReader::take(std::string_view line, int number) {
  const std::vector<Token> tokens = tokens_of(line);
  if (drafts_.empty()) {
    const bool named = heading_.size() == tokens.size();
    for (std::size_t c = 1; c < tokens.size(); ++c) {
      drafts_.push_back({.name = named ? heading_[c].text : std::to_string(c)});
    }
  }
  if (tokens.size() < 2 || tokens.size() != drafts_.size() + 1) {
    faults_.add(
        {number, 1}, fmt::format("{} numbers in the line", tokens.size()),
        fmt::format("give nm and {}",
                    drafts_.size() < 2 ? "a value" : fmt::format("{} values", drafts_.size())));
    return;
  }
  std::vector<double> numbers;
  for (const Token& token : tokens) {
    const auto value = parse_number(token.text);
    if (!value) {
      faults_.add({number, token.column}, fmt::format("\"{}\" is no number", token.text),
                  "give numbers; a decimal comma needs semicolons or tabs between the cells");
      return;
    }
    numbers.push_back(*value);
  }
  for (std::size_t c = 1; c < numbers.size(); ++c) {
    drafts_[c - 1].nm.push_back(numbers[0]);
    drafts_[c - 1].values.push_back(numbers[c]);
    drafts_[c - 1].places.push_back({number, tokens[c].column});
  }
}

/// A name without its prefix.
std::string_view local(const char* name) {
  const char* colon = std::strchr(name, ':');
  return colon == nullptr ? name : colon + 1;
}

/// Spectra of TM-27 and TM-33.
class XmlReader {
 public:
  XmlReader(std::string_view text, Faults& faults) : text_(text), faults_(faults) {}

  [[nodiscard]] std::vector<Draft> read() {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(text_.data(), text_.size());
    if (!parsed) {
      faults_.add(place(parsed.offset), fmt::format("no XML: {}", parsed.description()),
                  "give the file as it was written");
      return {};
    }
    walk(document, 0);
    return std::move(drafts_);
  }

 private:
  [[nodiscard]] Place place(std::ptrdiff_t offset) const {
    const auto at =
        std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)), text_.size());
    const std::string_view before = text_.substr(0, at);
    const std::size_t line_start = before.rfind('\n') == before.npos ? 0 : before.rfind('\n') + 1;
    return {static_cast<int>(std::ranges::count(before, '\n')) + 1,
            static_cast<int>(at - line_start) + 1};
  }

  void walk(const pugi::xml_node& node, int depth) {
    constexpr int kMostDepth = 64;
    if (depth > kMostDepth) {
      faults_.add(place(node.offset_debug()), "nested deeper than 64", "flatten the file");
      return;
    }
    for (const pugi::xml_node& child : node.children()) {
      if (local(child.name()) == "SpectralDistribution") {
        take(child);
      } else {
        walk(child, depth + 1);
      }
    }
  }

  void take(const pugi::xml_node& node) {
    drafts_.push_back({.name = std::to_string(drafts_.size() + 1)});
    for (const pugi::xml_node& child : node.children()) {
      const std::string_view name = local(child.name());
      const std::string_view text = trimmed(child.child_value());
      if (name == "SpectralQuantity" && (text == "reflectance" || text == "transmittance")) {
        faults_.add(place(child.offset_debug()), fmt::format("a {} is no lamp", text),
                    "give the spectrum of a light");
      }
      if (name != "SpectralData") continue;
      const auto nm = parse_number(child.attribute("wavelength").value()),
                 value = parse_number(text);
      if (!nm || !value) {
        faults_.add(place(child.offset_debug()), "a sample without two numbers",
                    "write <SpectralData wavelength=\"555\">0.7</SpectralData>");
        continue;
      }
      drafts_.back().nm.push_back(*nm);
      drafts_.back().values.push_back(*value);
      drafts_.back().places.push_back(place(child.offset_debug()));
    }
  }

  std::string_view text_;
  Faults& faults_;
  std::vector<Draft> drafts_;
};

/// The rules for all of them; slightly negative values become 0.
void check(Draft& draft, Faults& faults) {
  constexpr double kFirst_nm = 400, kLast_nm = 700, kLowest = -0.01;
  constexpr int kLeastSamples = 10;
  double peak = 0;
  for (const double value : draft.values) peak = std::max(peak, value);
  int within = 0;
  for (std::size_t k = 0; k < draft.nm.size(); ++k) {
    const double nm = draft.nm[k];
    if (nm < 200 || nm > 2500) {
      faults.add(draft.places[k], fmt::format("{} nm is out of range", nm),
                 "give nanometres from 200 to 2500, not micrometres");
      return;
    }
    if (k > 0 && nm <= draft.nm[k - 1]) {
      faults.add(draft.places[k], fmt::format("{} nm after {} nm", nm, draft.nm[k - 1]),
                 "order the samples by rising wavelength");
      return;
    }
    within += nm >= kFirst_nm && nm <= kLast_nm ? 1 : 0;
    if (draft.values[k] < kLowest * peak) {
      faults.add(draft.places[k], fmt::format("{} is below -1 % of the peak", draft.values[k]),
                 "no lamp shines with less than nothing");
    }
    draft.values[k] = std::max(0.0, draft.values[k]);
  }
  if (within < kLeastSamples || draft.nm.front() > kFirst_nm || draft.nm.back() < kLast_nm) {
    faults.add(draft.places.empty() ? Place{} : draft.places.front(),
               fmt::format("{} samples from 400 to 700 nm{}", within,
                           within < kLeastSamples ? "" : ", which they do not cover"),
               "cover 400..700 nm with at least 10 samples");
  } else if (!(peak > 0)) {
    faults.add(draft.places.front(), "there is no light in it", "give some power");
  }
}

bool is_table_of_rows(std::string_view text) {
  if (text.substr(0, 3) == "\xEF\xBB\xBF") text.remove_prefix(3);
  return text.substr(0, 5) == "name,";
}

}  // namespace

SpectrumFile read_light_file(const std::string& path) {
  const std::string text = read_input(path, kMostBytes, "give a file of one or few lamps");
  if (is_table_of_rows(text)) return read_spectrum_file(path, CurveKind::light);
  Faults faults(path);
  const std::string_view content = trimmed(text);
  const bool xml = content.find_first_not_of("\xEF\xBB\xBF\n") != content.npos &&
                   content[content.find_first_not_of("\xEF\xBB\xBF\n")] == '<';
  std::vector<Draft> drafts =
      xml ? XmlReader(text, faults).read() : ColumnReader(text, faults).read();
  faults.throw_if_any();
  if (drafts.empty()) faults.add({}, "there is no spectrum in it", "give nm and a value per line");
  SpectrumFile file{.set = {.name = path, .source = path, .entries = {}}};
  for (Draft& draft : drafts) {
    check(draft, faults);
    file.set.entries.push_back(
        {.name = draft.name,
         .samples = {.nm = std::move(draft.nm), .values = std::move(draft.values)},
         .label = ""});
  }
  faults.throw_if_any();
  return file;
}

}  // namespace spectra
