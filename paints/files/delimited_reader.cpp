#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "paints/files/colour_cells.h"
#include "paints/files/delimited_table.h"
#include "paints/files/format_readers.h"
#include "paints/files/source_text.h"
#include "paints/files/table_layout.h"

namespace paints {
namespace {

using spectra::CsvRow;
using Kind = TableLayout::Kind;

struct Reading {
  DelimitedTable table;
  std::optional<TableLayout> layout;
};

/// Every separator that cuts all rows into equally many cells of a known layout.
std::vector<Reading> readings(const std::string& path, std::string_view text,
                              const ReadChoices& choices) {
  std::vector<Reading> sound;
  std::optional<Reading> fallback;
  for (const char separator : {';', '\t', ',', ' '}) {
    if (choices.separator != 0 && choices.separator != separator) continue;
    if (separator == ' ' && !sound.empty()) continue;
    if (text.find(separator) == text.npos && (separator != ',' || fallback)) continue;
    Reading reading{.table = cut(path, text, separator), .layout = {}};
    reading.layout = layout_of(reading.table);
    const auto width = [](const Reading& r) {
      return r.table.rows.empty() ? 0 : r.table.rows.front().cells.size();
    };
    if (reading.layout && reading.table.even && reading.table.faults.empty() &&
        (width(reading) > 1 || reading.layout->kind == Kind::list)) {
      sound.push_back(std::move(reading));
    } else if (!fallback || (reading.layout && !fallback->layout) ||
               (reading.layout.has_value() == fallback->layout.has_value() &&
                width(reading) > width(*fallback) && separator != ' ')) {
      fallback = std::move(reading);
    }
  }
  if (sound.empty() && fallback) sound.push_back(std::move(*fallback));
  return sound;
}

/// Reads a table whose layout is known.
class TableReader {
 public:
  TableReader(const Reading& reading, const ReadChoices& choices, PaintDraft& draft)
      : table_(reading.table),
        layout_(*reading.layout),
        roles_(layout_.roles),
        draft_(draft),
        choices_(choices),
        comma_(reading.table.separator != ',') {}

  void read() {
    require_even();
    if (layout_.kind == Kind::down) return read_down();
    if (layout_.kind == Kind::across && !check_header()) return;
    if (table_.rows.size() == first_row()) {
      draft_.fault({}, "no curves and no colours below the header", "give one per row");
      return;
    }
    for (const std::size_t c : roles_.others) {
      draft_.file.kept_columns.push_back(layout_.header ? header()[c]
                                                        : fmt::format("column {}", c + 1));
    }
    read_rows();
  }

 private:
  const std::vector<std::string>& header() const { return table_.rows.front().cells; }

  std::size_t first_row() const { return layout_.header ? 1 : 0; }

  DraftPlace place(const CsvRow& row, std::size_t c) const {
    const bool named = layout_.header && c < header().size();
    return {.at = row.places[std::min(c, row.places.size() - 1)],
            .pointer = named ? header()[c] : ""};
  }

  void require_even() {
    if (table_.even) return;
    for (const CsvRow& row : table_.rows) {
      if (row.cells.size() == header().size()) continue;
      draft_.fault({.at = {row.line, 1}, .pointer = ""},
                   fmt::format("{} cells, but the {} has {}", row.cells.size(),
                               layout_.header ? "header" : "first row", header().size()),
                   "give one cell per column; quote cells that hold the separator");
    }
  }

  /// Names, and wavelengths side by side that rise or fall.
  bool check_header() {
    const CsvRow& row = table_.rows.front();
    if (!key_column()) {
      draft_.fault(place(row, 0), "there is no column of names", "add a column \"name\"");
      return false;
    }
    const auto& waves = roles_.wavelengths;
    std::size_t next = 0;
    bool sound = true;
    for (std::size_t c = waves.front().first; c <= waves.back().first; ++c) {
      if (next < waves.size() && waves[next].first == c) {
        ++next;
        continue;
      }
      draft_.fault(place(row, c), "not a wavelength",
                   "give wavelengths in nm side by side, other columns before or behind them");
      sound = false;
    }
    const bool falling = waves.front().second > waves.back().second;
    for (std::size_t k = 1; k < waves.size(); ++k) {
      const double nm = waves[k].second, before = waves[k - 1].second;
      if (nm == before) {
        draft_.fault({.at = row.places[waves[k].first], .pointer = ""},
                     fmt::format("second column named \"{}\"", header()[waves[k].first]),
                     "give each wavelength once");
      } else if ((nm < before) != falling) {
        draft_.fault(place(row, waves[k].first), fmt::format("{} nm after {} nm", nm, before),
                     "order the columns by wavelength");
      }
      sound = sound && (nm < before) == falling && nm != before;
    }
    return sound;
  }

  /// What names a paint: name or code, else the first column that is nothing else.
  std::optional<std::size_t> key_column() {
    if (!roles_.name && !roles_.code && !roles_.others.empty()) {
      roles_.name = roles_.others.front();
      roles_.others.erase(roles_.others.begin());
    }
    return roles_.name ? roles_.name : roles_.code;
  }

  void read_rows() {
    const auto key = key_column();
    if (!key) {
      draft_.fault(place(table_.rows.front(), 0), "there is no column of names",
                   "add a column \"name\" or \"code\"");
      return;
    }
    ColourCells colours(draft_, choices_);
    for (std::size_t r = first_row(); r < table_.rows.size(); ++r) {
      for (const ColourColumns& c : roles_.colours)
        colours.measure(c, table_.rows[r].cells, comma_);
    }
    for (std::size_t r = first_row(); r < table_.rows.size(); ++r) {
      const CsvRow& row = table_.rows[r];
      if (row.cells.size() != header().size()) continue;  // a fault already
      draft_.paints.push_back(paint_of(row, *key, colours));
    }
    tell_other_colours();
  }

  DraftPaint paint_of(const CsvRow& row, std::size_t key, ColourCells& colours) {
    DraftPaint paint;
    paint.place = place(row, key);
    if (roles_.name) paint.name = row.cells[*roles_.name];
    if (roles_.code) paint.code = row.cells[*roles_.code];
    for (const std::size_t c : roles_.others) paint.kept.push_back(row.cells[c]);
    if (layout_.kind == Kind::across) read_spectrum(row, paint);
    std::vector<DraftPlace> places;
    for (std::size_t c = 0; c < row.cells.size(); ++c) places.push_back(place(row, c));
    for (const ColourColumns& c : roles_.colours) {
      if (!paint.colour) paint.colour = colours.read(c, row.cells, places, comma_);
    }
    if (roles_.lrv) read_lrv(row, paint);
    if (!paint.colour && paint.values.empty() && paint.lrv) {
      paint.colour = spectra::from_lrv(*paint.lrv);
      ++greys_;
    }
    if (layout_.kind != Kind::across && !paint.colour && draft_.faults.empty()) {
      draft_.fault(paint.place, "no colour in this row", "give one, or leave the row out");
    }
    return paint;
  }

  void read_spectrum(const CsvRow& row, DraftPaint& paint) {
    for (const auto& [c, nm] : roles_.wavelengths) add_value(row, c, nm, paint);
  }

  void add_value(const CsvRow& row, std::size_t c, double nm, DraftPaint& paint) {
    const auto value = parse_decimal(row.cells[c], comma_);
    if (!value) {
      draft_.fault(place(row, c), fmt::format("\"{}\" is not a number", row.cells[c]),
                   comma_ ? "give a finite number" : "give a finite number with a decimal point");
    }
    paint.nm.push_back(nm);
    paint.values.push_back(value.value_or(0));
    paint.value_at.push_back(row.places[c]);
  }

  void read_lrv(const CsvRow& row, DraftPaint& paint) {
    const std::string& cell = row.cells[*roles_.lrv];
    if (cell.empty()) return;
    std::string_view digits = cell;
    if (digits.ends_with('%')) digits.remove_suffix(1);
    paint.lrv = parse_decimal(digits, comma_);
    if (paint.lrv && *paint.lrv >= 0 && *paint.lrv <= 100) return;
    draft_.fault(place(row, *roles_.lrv), fmt::format("\"{}\" is no LRV", cell),
                 "give a number from 0 to 100");
    paint.lrv.reset();
  }

  void tell_other_colours() {
    if (layout_.kind == Kind::colours && roles_.colours.size() > 1) {
      std::vector<std::string> others;
      for (std::size_t i = 1; i < roles_.colours.size(); ++i) {
        others.emplace_back(to_string(roles_.colours[i].kind));
      }
      draft_.note(fmt::format("colours are taken from {}; {} only where that is empty",
                              to_string(roles_.colours.front().kind), fmt::join(others, ", ")));
    }
    if (greys_ > 0) {
      draft_.note(fmt::format("{} paints have an LRV alone and were taken as grey", greys_));
    }
    if (layout_.kind == Kind::list) {
      draft_.note(
          fmt::format("there is no header: column {} was taken as the name", *roles_.name + 1));
    }
  }

  void read_down() {
    const std::string stem = std::filesystem::path(draft_.file.path).stem().string();
    const std::size_t width = header().size();
    for (std::size_t c = 1; c < width; ++c) {
      DraftPaint paint;
      paint.place = {.at = table_.rows.front().places[c], .pointer = ""};
      paint.name = layout_.header ? header()[c] : width == 2 ? stem : fmt::format("{} {}", stem, c);
      for (std::size_t r = first_row(); r < table_.rows.size(); ++r) {
        const CsvRow& row = table_.rows[r];
        if (row.cells.size() == width) add_value(row, c, *parse_wavelength(row.cells[0]), paint);
      }
      draft_.paints.push_back(std::move(paint));
    }
    if (!layout_.header) {
      draft_.note("there is no header: the paints are named after the file");
    }
  }

  const DelimitedTable& table_;
  TableLayout layout_;
  ColumnRoles& roles_;
  PaintDraft& draft_;
  const ReadChoices& choices_;
  bool comma_;
  int greys_ = 0;
};

}  // namespace

void read_delimited(std::string_view text, const ReadChoices& choices, PaintDraft& draft) {
  draft.file.format = "CSV";
  const std::vector<Reading> sound = readings(draft.file.path, text, choices);
  if (sound.empty()) {
    draft.fault({}, "the chosen separator is not in the file", "choose another one");
    return;
  }
  if (sound.size() > 1) {
    std::vector<std::string> names;
    for (const Reading& reading : sound) names.push_back(separator_name(reading.table.separator));
    draft.fault({}, fmt::format("the cells may be separated by {}", fmt::join(names, " or by ")),
                "choose separator=comma, semicolon or tab");
    return;
  }
  const Reading& reading = sound.front();
  draft.faults = reading.table.faults;
  if (!draft.faults.empty()) return;  // what follows a stray quote is cut wrongly
  if (!reading.layout) {
    const CsvRow& first = reading.table.rows.front();
    draft.fault({.at = first.places[0], .pointer = first.cells[0]},
                fmt::format("no wavelengths and no colours in {} columns separated by {}",
                            first.cells.size(), separator_name(reading.table.separator)),
                "name the columns: name, 400, 410, ... or name, hex or name, L*, a*, b*");
    return;
  }
  draft.file.rule = describe(*reading.layout, reading.table);
  TableReader(reading, choices, draft).read();
}

}  // namespace paints
