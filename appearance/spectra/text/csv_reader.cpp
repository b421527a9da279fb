#include "appearance/spectra/text/csv_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <utility>

#include "appearance/spectra/text/input_bytes.h"
#include "appearance/spectra/text/utf8.h"

namespace spectra {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{256} << 20;
constexpr std::size_t kMaxFaults = 100;

bool ends_cell(char c) { return c == ',' || c == '\r' || c == '\n'; }

/// One pass over the text; a fault in a row does not stop the pass.
class Parser {
 public:
  Parser(const std::string& path, std::string_view text) : text_(text) { table_.path = path; }

  CsvTable parse() {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = line_start_ = 3;
    check_encoding();
    if (faults_.empty()) read_header();
    while (faults_.size() < kMaxFaults && at_ < text_.size()) {
      CsvRow row = read_row();
      const bool empty_line = row.cells.size() == 1 && row.cells[0].empty();
      if (!empty_line) take(std::move(row));
    }
    if (!faults_.empty()) throw InputError(std::move(faults_));
    return std::move(table_);
  }

 private:
  CsvPlace here() const { return {line_, static_cast<int>(at_ - line_start_) + 1}; }

  void fault(CsvPlace place, std::string problem, std::string remedy) {
    faults_.push_back(
        {table_.path, place.line, place.column, "", std::move(problem), std::move(remedy)});
  }

  void check_encoding() {
    const std::size_t bad = std::min(text_.find('\0'), first_invalid_utf8(text_));
    if (bad >= text_.size()) return;
    for (std::size_t end = text_.find('\n'); end < bad; end = text_.find('\n', end + 1)) {
      ++line_;
      line_start_ = end + 1;
    }
    at_ = bad;
    fault(here(), text_[bad] == '\0' ? "NUL byte" : "byte that is no UTF-8",
          "save the file as CSV in UTF-8");
    at_ = text_.size();
  }

  void read_header() {
    while (at_ < text_.size() && end_of_line()) {
    }
    if (at_ == text_.size()) {
      fault({}, "the file is empty", "give a header row and one row per entry");
      return;
    }
    CsvRow row = read_row();
    table_.header = std::move(row.cells);
    table_.header_places = std::move(row.places);
    std::set<std::string_view> seen;
    for (std::size_t i = 0; i < table_.header.size(); ++i) {
      const std::string& name = table_.header[i];
      if (name.empty()) {
        fault(table_.header_places[i], "column without a name", "name every column in the header");
      } else if (!seen.insert(name).second) {
        fault(table_.header_places[i], fmt::format("second column named \"{}\"", name),
              "give each column a name of its own");
      }
    }
  }

  void take(CsvRow row) {
    if (row.cells.size() == table_.header.size()) {
      table_.rows.push_back(std::move(row));
      return;
    }
    fault({row.line, 1},
          fmt::format("{} cells, but the header has {}", row.cells.size(), table_.header.size()),
          "give one cell per column; quote cells that hold a comma");
  }

  CsvRow read_row() {
    CsvRow row;
    row.line = line_;
    row.cells.reserve(table_.header.size());
    row.places.reserve(table_.header.size());
    bool more = true;
    while (more) {
      row.places.push_back(here());
      const bool quoted = at_ < text_.size() && text_[at_] == '"';
      row.cells.push_back(quoted ? read_quoted() : read_plain());
      more = at_ < text_.size() && text_[at_] == ',';
      if (more) ++at_;
    }
    end_of_line();
    return row;
  }

  std::size_t end_of_cell() const {
    return static_cast<std::size_t>(
        std::find_if(text_.begin() + static_cast<std::ptrdiff_t>(at_), text_.end(), ends_cell) -
        text_.begin());
  }

  std::string read_plain() {
    const std::size_t end = end_of_cell();
    const std::string_view cell = text_.substr(at_, end - at_);
    if (cell.find('"') != cell.npos) {
      fault(here(), "quote inside an unquoted cell", "quote the whole cell, with \"\" for each \"");
    }
    at_ = end;
    return std::string(cell);
  }

  std::string read_quoted() {
    const CsvPlace start = here();
    std::string cell;
    while (++at_ < text_.size()) {
      if (text_[at_] == '"') {
        const bool escaped = at_ + 1 < text_.size() && text_[at_ + 1] == '"';
        if (!escaped) break;
        ++at_;
      }
      cell += text_[at_];
      if (text_[at_] == '\n') {
        ++line_;
        line_start_ = at_ + 1;
      }
    }
    if (at_ >= text_.size()) {
      fault(start, "quote that is never closed", "close it with a \" before the next comma");
      at_ = text_.size();
      return cell;
    }
    ++at_;
    if (at_ < text_.size() && !ends_cell(text_[at_])) {
      fault(here(), "text after a closing quote", "write \"\" for a quote inside a quoted cell");
      at_ = end_of_cell();
    }
    return cell;
  }

  /// CR, LF or both together; false if the line goes on.
  bool end_of_line() {
    const std::size_t start = at_;
    if (at_ < text_.size() && text_[at_] == '\r') ++at_;
    if (at_ < text_.size() && text_[at_] == '\n') ++at_;
    if (at_ == start) return false;
    ++line_;
    line_start_ = at_;
    return true;
  }

  std::string_view text_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1;
  CsvTable table_;
  std::vector<Fault> faults_;
};

}  // namespace

CsvTable read_csv(const std::string& path) {
  const std::string text = read_input(path, kMaxBytes, "split the file");
  return parse_csv(path, text);
}

CsvTable parse_csv(const std::string& path, std::string_view text) {
  return Parser(path, text).parse();
}

Fault cell_fault(const CsvTable& table, const CsvRow& row, std::size_t column, std::string problem,
                 std::string remedy) {
  const CsvPlace place = row.places.at(column);
  return {table.path,         place.line,       place.column, table.header.at(column),
          std::move(problem), std::move(remedy)};
}

std::optional<double> parse_number(std::string_view cell) {
  const std::size_t first = cell.find_first_not_of(" \t"), last = cell.find_last_not_of(" \t");
  if (first == cell.npos) return {};
  cell = cell.substr(first, last - first + 1);
  if (cell.starts_with('+') && !cell.starts_with("+-")) cell.remove_prefix(1);

  double value = 0;
  const auto [end, error] = std::from_chars(cell.begin(), cell.end(), value);
  if (error != std::errc{} || end != cell.end() || !std::isfinite(value)) return {};
  return value;
}

}  // namespace spectra
