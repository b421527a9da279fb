// Datacolor QTX: sections of KEY=VALUE.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "paints/files/format_readers.h"
#include "paints/files/source_text.h"

namespace paints {
namespace {

struct Section {
  bool batch = false;
  spectra::CsvPlace at;
  std::map<std::string, std::pair<std::string, int>> keys;  ///< value and line
};

/// "[STANDARD_DATA 1]", "[BATCH]"; nothing else opens a section.
std::optional<bool> batch_section(std::string_view line) {
  const std::string word = lower(trimmed(line));
  if (!word.starts_with('[') || word.find(']') == word.npos) return {};
  if (word.starts_with("[standard")) return false;
  if (word.starts_with("[batch")) return true;
  return {};
}

class QtxReader {
 public:
  QtxReader(const ReadChoices& choices, PaintDraft& draft) : choices_(choices), draft_(draft) {}

  void read(std::string_view text) {
    draft_.file.format = "QTX";
    draft_.file.rule = "sections [STANDARD_DATA] or [BATCH_DATA]";
    draft_.full_scale = 100;
    split(text);
    for (const Section& section : sections_) {
      if (is_picked(section)) read_section(section);
    }
    if (draft_.paints.empty() && draft_.faults.empty()) {
      draft_.fault({}, fmt::format("no section is \"{}\"", choices_.pick),
                   "choose pick=standards, batches, or a word of ..._VIEWING");
    }
    if (tristimulus_) draft_.note("X, Y, Z of the file are for an unnamed light and were not read");
  }

 private:
  void split(std::string_view text) {
    int number = 0;
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
      const std::string_view line = text.substr(at, end - at);
      ++number;
      if (const auto batch = batch_section(line)) {
        sections_.push_back({.batch = *batch, .at = {number, 1}, .keys = {}});
      } else if (const std::size_t equals = line.find('=');
                 equals != line.npos && !sections_.empty()) {
        const std::string key(trimmed(line.substr(0, equals)));
        sections_.back().keys[key] = {std::string(trimmed(line.substr(equals + 1))), number};
      }
      at = end + (text.substr(end).starts_with("\r\n") ? 2 : 1);
    }
  }

  std::string value(const Section& section, const std::string& key) const {
    const auto found = section.keys.find((section.batch ? "BAT_" : "STD_") + key);
    if (found == section.keys.end()) return "";
    std::string_view text = found->second.first;
    while (text.ends_with(',')) text.remove_suffix(1);
    return std::string(trimmed(text));
  }

  bool is_picked(const Section& section) const {
    if (choices_.pick.empty()) return true;
    if (choices_.pick == "standards") return !section.batch;
    if (choices_.pick == "batches") return section.batch;
    return value(section, "VIEWING").find(choices_.pick) != std::string::npos;
  }

  DraftPlace place(const Section& section, const std::string& key) const {
    const std::string name = (section.batch ? "BAT_" : "STD_") + key;
    const auto found = section.keys.find(name);
    return {
        .at = found == section.keys.end() ? section.at : spectra::CsvPlace{found->second.second, 1},
        .pointer = name};
  }

  void read_section(const Section& section) {
    DraftPaint paint;
    paint.name = value(section, "NAME");
    paint.place = place(section, "NAME");
    const std::string viewing = value(section, "VIEWING");
    if (!viewing.empty()) paint.kept.push_back(viewing);
    const auto points = spectra::parse_number(value(section, "REFLPOINTS")),
               step = spectra::parse_number(value(section, "REFLINTERVAL")),
               first = spectra::parse_number(value(section, "REFLLOW"));
    tristimulus_ = tristimulus_ || !value(section, "X").empty();
    read_values(section, paint);
    const double count = static_cast<double>(paint.values.size());
    if (!points || !step || !first || *step < 0.1 || *step > 100 || *first < 200 || *first > 2500) {
      draft_.fault({.at = section.at, .pointer = ""}, "no wavelengths",
                   "give REFLPOINTS, REFLINTERVAL and REFLLOW");
      return;
    }
    if (*points != count) {
      draft_.fault(place(section, "R"),
                   fmt::format("{} values, but {} are announced", count, *points),
                   "mend REFLPOINTS or the values");
      return;
    }
    for (std::size_t k = 0; k < paint.values.size(); ++k) {
      paint.nm.push_back(*first + static_cast<double>(k) * *step);
    }
    draft_.paints.push_back(std::move(paint));
  }

  /// Percent by commas, with one more comma at the end.
  void read_values(const Section& section, DraftPaint& paint) {
    std::string text = value(section, "R");
    const DraftPlace at = place(section, "R");
    for (std::size_t from = 0; !text.empty() && from <= text.size();) {
      const std::size_t end = std::min(text.find(',', from), text.size());
      const std::string cell(trimmed(std::string_view(text).substr(from, end - from)));
      const auto number = spectra::parse_number(cell);
      if (!number) {
        draft_.fault(at, fmt::format("\"{}\" is not a number", cell.substr(0, 40)),
                     "give percent with commas between them");
        return;
      }
      paint.values.push_back(*number);
      from = end + 1;
    }
    paint.value_at.assign(paint.values.size(), at.at);
  }

  const ReadChoices& choices_;
  PaintDraft& draft_;
  std::vector<Section> sections_;
  bool tristimulus_ = false;
};

}  // namespace

bool is_qtx(std::string_view text) {
  for (std::size_t at = text.find('['); at != text.npos; at = text.find('[', at + 1)) {
    if (at > 0 && text[at - 1] != '\n' && text[at - 1] != '\r') continue;
    if (batch_section(text.substr(
            at, std::min<std::size_t>(text.find_first_of("\r\n", at), text.size()) - at))) {
      return true;
    }
  }
  return false;
}

void read_qtx(std::string_view text, const ReadChoices& choices, PaintDraft& draft) {
  QtxReader(choices, draft).read(text);
}

}  // namespace paints
