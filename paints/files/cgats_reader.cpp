// CGATS.17 and its relatives: .ti3, IT8.7, text of profiling software.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "paints/files/colour_cells.h"
#include "paints/files/format_readers.h"
#include "paints/files/source_text.h"

namespace paints {
namespace {

struct Token {
  std::string text;
  spectra::CsvPlace at;
};

struct CgatsTable {
  std::map<std::string, std::string> keywords;
  std::vector<std::string> fields;
  std::vector<Token> values;
  int line = 0;
};

/// Words of a line, by blanks; "..." is one word, "" in it a quote.
std::vector<Token> words_of(std::string_view line, int number) {
  std::vector<Token> words;
  std::size_t at = 0;
  while (at < line.size()) {
    if (line[at] == ' ' || line[at] == '\t' || line[at] == '\r') {
      ++at;
      continue;
    }
    if (line[at] == '#') break;  // a comment
    Token token{.text = "", .at = {number, static_cast<int>(at) + 1}};
    if (line[at] == '"') {
      for (++at; at < line.size(); ++at) {
        if (line[at] == '"') {
          if (at + 1 >= line.size() || line[at + 1] != '"') break;
          ++at;
        }
        token.text += line[at];
      }
      ++at;
    } else {
      const std::size_t end = std::min(line.find_first_of(" \t\r", at), line.size());
      token.text = line.substr(at, end - at);
      at = end;
    }
    words.push_back(std::move(token));
  }
  return words;
}

/// The tables of a file, one behind the other.
class CgatsParser {
 public:
  CgatsParser(std::string_view text, PaintDraft& draft) : text_(text), draft_(draft) {}

  std::vector<CgatsTable> parse() {
    int number = 0;
    for (std::size_t at = 0; at < text_.size();) {
      const std::size_t end = std::min(text_.find_first_of("\r\n", at), text_.size());
      take(words_of(text_.substr(at, end - at), ++number));
      at = end + (text_.substr(end).starts_with("\r\n") ? 2 : 1);
    }
    if (mode_ != Mode::keywords) {
      draft_.fault({.at = {table_.line, 1}, .pointer = ""},
                   mode_ == Mode::data ? "BEGIN_DATA without END_DATA"
                                       : "BEGIN_DATA_FORMAT without END_DATA_FORMAT",
                   "the file seems cut off: export it anew");
    }
    return std::move(tables_);
  }

 private:
  enum class Mode { keywords, format, data };

  void take(std::vector<Token> words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
      const std::string& word = words[i].text;
      if (word == "BEGIN_DATA_FORMAT" || word == "BEGIN_DATA") {
        mode_ = word == "BEGIN_DATA" ? Mode::data : Mode::format;
        table_.line = words[i].at.line;
        if (mode_ == Mode::format) table_.fields.clear();
      } else if (word == "END_DATA_FORMAT") {
        mode_ = Mode::keywords;
      } else if (word == "END_DATA") {
        close_table();
      } else if (mode_ == Mode::format) {
        table_.fields.push_back(word);
      } else if (mode_ == Mode::data) {
        table_.values.push_back(std::move(words[i]));
      } else {
        if (i + 1 < words.size()) table_.keywords[word] = words[i + 1].text;
        return;
      }
    }
  }

  /// A table without a format has that of the one before.
  void close_table() {
    mode_ = Mode::keywords;
    if (table_.fields.empty() && !tables_.empty()) table_.fields = tables_.back().fields;
    if (table_.fields.empty()) {
      draft_.fault({.at = {table_.line, 1}, .pointer = ""}, "data without a format",
                   "name the fields between BEGIN_DATA_FORMAT and END_DATA_FORMAT");
    } else if (table_.values.size() % table_.fields.size() != 0) {
      draft_.fault({.at = {table_.line, 1}, .pointer = ""},
                   fmt::format("{} values do not fill rows of {} fields", table_.values.size(),
                               table_.fields.size()),
                   "give each row a value per field");
    } else {
      tables_.push_back(table_);
    }
    table_ = {};
  }

  std::string_view text_;
  PaintDraft& draft_;
  Mode mode_ = Mode::keywords;
  CgatsTable table_;
  std::vector<CgatsTable> tables_;
};

class CgatsReader {
 public:
  CgatsReader(const ReadChoices& choices, PaintDraft& draft) : choices_(choices), draft_(draft) {}

  void read(std::string_view text) {
    draft_.file.format = "CGATS";
    first_word_ = std::string(trimmed(text).substr(0, trimmed(text).find_first_of(" \t\r\n")));
    draft_.file.rule = fmt::format("text with BEGIN_DATA, its first word {}", first_word_);
    if (first_word_ == "SPECT" && choices_.full_scale == 0) {
      draft_.fault({.at = {1, 1}, .pointer = ""}, "SPECT files are mostly lamps",
                   "if this is a reflectance, choose scale=fraction or scale=percent");
      return;
    }
    std::vector<CgatsTable> tables = CgatsParser(text, draft_).parse();
    std::vector<std::size_t> usable;
    for (std::size_t i = 0; i < tables.size(); ++i) {
      const ColumnRoles roles = roles_of(tables[i].fields);
      const bool picked = choices_.pick.empty() || choices_.pick == fmt::format("{}", i + 1);
      if (picked && (!roles.wavelengths.empty() || !roles.colours.empty())) usable.push_back(i);
    }
    if (usable.size() == 1) return read_table(tables[usable.front()]);
    if (!draft_.faults.empty()) return;
    if (usable.empty()) {
      draft_.fault({}, "no table has spectra or colours",
                   "name fields like SPECTRAL_NM_400 or LAB_L");
    } else {
      draft_.fault({.at = {tables[usable[1]].line, 1}, .pointer = ""},
                   fmt::format("{} tables have spectra or colours", usable.size()),
                   fmt::format("choose pick={}", usable.front() + 1) + " or another number");
    }
  }

 private:
  std::string keyword(const CgatsTable& table, std::initializer_list<const char*> names) const {
    for (const char* name : names) {
      const auto found = table.keywords.find(name);
      if (found != table.keywords.end()) return found->second;
    }
    return "";
  }

  /// SPECTRAL_BANDS, _START_NM and _END_NM say what rounded field names do not; false if they
  /// contradict the fields.
  bool set_wavelengths(const CgatsTable& table, ColumnRoles& roles) {
    const auto number = [&](std::initializer_list<const char*> names) {
      return spectra::parse_number(keyword(table, names));
    };
    const auto bands = number({"SPECTRAL_BANDS"}), first = number({"SPECTRAL_START_NM"}),
               last = number({"SPECTRAL_END_NM"});
    if (!bands || roles.wavelengths.empty()) return true;
    const std::size_t count = roles.wavelengths.size();
    if (*bands != static_cast<double>(count)) {
      draft_.fault({.at = {table.line, 1}, .pointer = "SPECTRAL_BANDS"},
                   fmt::format("{} bands are stated, and {} fields are there", *bands, count),
                   "mend SPECTRAL_BANDS or the fields");
      return false;
    }
    if (!first || !last || count < 2) return true;
    const double step = (*last - *first) / static_cast<double>(count - 1);
    for (std::size_t k = 0; k < count; ++k) {
      const double nm = *first + static_cast<double>(k) * step;
      if (std::abs(nm - roles.wavelengths[k].second) > 1) {
        draft_.fault({.at = {table.line, 1}, .pointer = table.fields[roles.wavelengths[k].first]},
                     fmt::format("the field is {} nm, by start, end and bands it is {:.1f}",
                                 roles.wavelengths[k].second, nm),
                     "mend the names or SPECTRAL_START_NM and SPECTRAL_END_NM");
        return false;
      }
      roles.wavelengths[k].second = nm;
    }
    return true;
  }

  void set_scale(const CgatsTable& table) {
    const auto norm = spectra::parse_number(keyword(table, {"SPECTRAL_NORM", "SPEC_SCALE"}));
    if (norm && *norm > 0) {
      draft_.full_scale = *norm;
    } else if (first_word_ == "CTI3") {
      draft_.full_scale = 100;
    }
  }

  std::optional<spectra::StatedWhite> white_of(const CgatsTable& table) const {
    const std::string source = keyword(table, {"MEASUREMENT_SOURCE"});
    std::string light = keyword(table, {"ILLUMINANT", "ILLUMINATION_NAME"}),
                observer = keyword(table, {"OBSERVER", "OBSERVER_ANGLE"});
    for (const char* name : {"A", "C", "D50", "D55", "D65", "D75"}) {
      if (source.find(std::string("Illumination=") + name) != source.npos) light = name;
    }
    if (source.find("ObserverAngle=10") != source.npos) observer = "10";
    if (source.find("ObserverAngle=2") != source.npos) observer = "2";
    const std::size_t digits = std::min(observer.find_first_not_of("0123456789"), observer.size());
    return spectra::parse_white(
        fmt::format("{}/{}", light, std::string_view(observer).substr(0, digits)));
  }

  void read_table(const CgatsTable& table) {
    ColumnRoles roles = roles_of(table.fields);
    if (!set_wavelengths(table, roles)) return;
    set_scale(table);
    const auto white = white_of(table);
    const bool needs_white = roles.wavelengths.empty() && !white && !choices_.white &&
                             !roles.colours.front().white &&
                             roles.colours.front().kind != ColourColumns::Kind::rgb;
    if (needs_white) {
      draft_.fault({.at = {table.line, 1}, .pointer = ""},
                   fmt::format("no white is stated for {}", to_string(roles.colours.front().kind)),
                   "choose white=D50/2, D65/2 or another");
      return;
    }
    check_count(table);
    for (const std::size_t c : roles.others) draft_.file.kept_columns.push_back(table.fields[c]);
    ColourCells colours(draft_, choices_, white);
    const std::size_t width = table.fields.size();
    std::vector<std::vector<std::string>> rows;
    for (std::size_t at = 0; at < table.values.size(); at += width) {
      std::vector<std::string>& cells = rows.emplace_back();
      for (std::size_t c = 0; c < width; ++c) cells.push_back(table.values[at + c].text);
      for (const ColourColumns& columns : roles.colours) colours.measure(columns, cells, false);
    }
    for (std::size_t r = 0; r < rows.size(); ++r) {
      read_row(table, roles, rows[r], r * width, colours);
    }
  }

  void read_row(const CgatsTable& table, const ColumnRoles& roles,
                const std::vector<std::string>& cells, std::size_t at, ColourCells& colours) {
    DraftPaint paint;
    std::vector<DraftPlace> places;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      places.push_back({.at = table.values[at + c].at, .pointer = table.fields[c]});
    }
    paint.place = places.front();
    if (roles.name) paint.name = cells[*roles.name];
    if (roles.code) paint.code = cells[*roles.code];
    if (!roles.name && !roles.code) paint.name = fmt::format("{}", at / cells.size() + 1);
    for (const std::size_t c : roles.others) paint.kept.push_back(cells[c]);
    for (const auto& [c, nm] : roles.wavelengths) {
      const auto value = spectra::parse_number(cells[c]);
      if (!value) {
        draft_.fault(places[c], fmt::format("\"{}\" is not a number", cells[c]),
                     "give a finite number");
      }
      paint.nm.push_back(nm);
      paint.values.push_back(value.value_or(0));
      paint.value_at.push_back(places[c].at);
    }
    if (paint.values.empty()) {
      for (const ColourColumns& columns : roles.colours) {
        if (!paint.colour) paint.colour = colours.read(columns, cells, places, false);
      }
    }
    draft_.paints.push_back(std::move(paint));
  }

  /// NUMBER_OF_SETS and NUMBER_OF_FIELDS may be wrong: what is there counts.
  void check_count(const CgatsTable& table) {
    const auto tell = [&](const char* name, std::size_t there) {
      const auto stated = spectra::parse_number(keyword(table, {name}));
      if (stated && *stated != static_cast<double>(there)) {
        draft_.note(fmt::format("{} is {}, but there are {}", name, *stated, there));
      }
    };
    tell("NUMBER_OF_FIELDS", table.fields.size());
    tell("NUMBER_OF_SETS", table.values.size() / table.fields.size());
  }

  const ReadChoices& choices_;
  PaintDraft& draft_;
  std::string first_word_;
};

}  // namespace

bool is_cgats(std::string_view text) {
  for (std::size_t at = text.find("BEGIN_DATA"); at != text.npos;
       at = text.find("BEGIN_DATA", at + 1)) {
    if (at == 0 || text[at - 1] == '\n' || text[at - 1] == '\r') return true;
  }
  const std::string_view word = trimmed(text);
  return word.starts_with("CGATS.") || word.starts_with("CTI3") || word.starts_with("ISO28178") ||
         word.starts_with("IT8.7/");
}

void read_cgats(std::string_view text, const ReadChoices& choices, PaintDraft& draft) {
  CgatsReader(choices, draft).read(text);
}

}  // namespace paints
