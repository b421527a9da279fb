#include "paints/files/delimited_table.h"

#include <algorithm>

#include "paints/files/source_text.h"

namespace paints {
namespace {

constexpr std::size_t kMaxQuoteFaults = 100;

/// One pass over the text; a fault in a row does not stop the pass.
class Cutter {
 public:
  Cutter(const std::string& path, std::string_view text, char separator)
      : path_(path), text_(text) {
    table_.separator = separator;
  }

  DelimitedTable cut(std::size_t most_rows) {
    while (at_ < text_.size() && table_.faults.size() < kMaxQuoteFaults &&
           (most_rows == 0 || table_.rows.size() < most_rows)) {
      take(read_row());
    }
    drop_empty_last_columns();
    for (const spectra::CsvRow& row : table_.rows) {
      table_.even = table_.even && row.cells.size() == table_.rows.front().cells.size();
    }
    return std::move(table_);
  }

 private:
  spectra::CsvPlace here() const { return {line_, static_cast<int>(at_ - line_start_) + 1}; }

  bool at_line_end() const {
    return at_ >= text_.size() || text_[at_] == '\n' || text_[at_] == '\r';
  }

  bool at_separator() const {
    if (at_line_end()) return false;
    return table_.separator == ' ' ? text_[at_] == ' ' || text_[at_] == '\t'
                                   : text_[at_] == table_.separator;
  }

  void skip_blanks() {
    while (!at_line_end() && text_[at_] == ' ') ++at_;
  }

  void fault(spectra::CsvPlace place, const char* problem, const char* remedy) {
    table_.faults.push_back({path_, place.line, place.column, "", problem, remedy});
  }

  void take(spectra::CsvRow row) {
    const bool empty = std::all_of(row.cells.begin(), row.cells.end(),
                                   [](const std::string& cell) { return cell.empty(); });
    if (!empty) table_.rows.push_back(std::move(row));
  }

  spectra::CsvRow read_row() {
    spectra::CsvRow row{.line = line_, .cells = {}, .places = {}};
    for (bool more = true; more;) {
      skip_blanks();
      if (table_.separator == ' ' && at_line_end()) break;
      row.places.push_back(here());
      row.cells.push_back(at_ < text_.size() && text_[at_] == '"' ? read_quoted() : read_plain());
      more = at_separator();
      while (more && at_separator()) {
        ++at_;
        if (table_.separator != ' ') break;
      }
    }
    end_line();
    return row;
  }

  std::string read_plain() {
    const spectra::CsvPlace start = here();
    const std::size_t from = at_;
    while (!at_line_end() && !at_separator()) ++at_;
    const std::string_view cell = trimmed(text_.substr(from, at_ - from));
    if (table_.separator != ' ' && cell.find('"') != cell.npos) {
      fault(start, "quote inside an unquoted cell", "quote the whole cell, with \"\" for each \"");
    }
    return std::string(cell);
  }

  std::string read_quoted() {
    const spectra::CsvPlace start = here();
    std::string cell;
    while (++at_ < text_.size()) {
      if (text_[at_] == '"') {
        if (at_ + 1 >= text_.size() || text_[at_ + 1] != '"') break;
        ++at_;
      }
      cell += text_[at_];
      if (text_[at_] == '\n') {
        ++line_;
        line_start_ = at_ + 1;
      }
    }
    if (at_ >= text_.size()) {
      fault(start, "quote that is never closed", "close it with a \" before the next separator");
      return cell;
    }
    ++at_;
    skip_blanks();
    if (!at_line_end() && !at_separator()) {
      fault(here(), "text after the closing quote", "quote the whole cell, with \"\" for each \"");
      while (!at_line_end() && !at_separator()) ++at_;
    }
    return cell;
  }

  void end_line() {
    if (at_ < text_.size() && text_[at_] == '\r') ++at_;
    if (at_ < text_.size() && text_[at_] == '\n') ++at_;
    ++line_;
    line_start_ = at_;
  }

  /// Spreadsheets write separators behind the last column, in some rows or in all.
  void drop_empty_last_columns() {
    std::size_t width = 0;
    for (const spectra::CsvRow& row : table_.rows) {
      std::size_t used = row.cells.size();
      while (used > 0 && row.cells[used - 1].empty()) --used;
      width = std::max(width, used);
    }
    const std::size_t header = table_.rows.empty() ? 0 : table_.rows.front().cells.size();
    for (spectra::CsvRow& row : table_.rows) {
      while (row.cells.size() > width || (row.cells.size() > header && row.cells.back().empty())) {
        row.cells.pop_back();
        row.places.pop_back();
      }
    }
  }

  const std::string& path_;
  std::string_view text_;
  std::size_t at_ = 0, line_start_ = 0;
  int line_ = 1;
  DelimitedTable table_;
};

}  // namespace

DelimitedTable cut(const std::string& path, std::string_view text, char separator,
                   std::size_t most_rows) {
  return Cutter(path, text, separator).cut(most_rows);
}

std::string separator_name(char separator) {
  switch (separator) {
    case '\t':
      return "tab";
    case ' ':
      return "blanks";
    default:
      return std::string("'") + separator + "'";
  }
}

}  // namespace paints
