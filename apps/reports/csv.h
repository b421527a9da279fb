#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "appearance/spectra/spectrum.h"

namespace apps {

/// Text of a CSV file [RFC4180]: cells quoted where they must be, rows ended by CR LF, numbers as
/// the shortest decimals that read back as the same double.
class CsvText {
 public:
  CsvText() = default;
  /// `header` is written as it stands: names with commas between them.
  explicit CsvText(std::string_view header);

  CsvText& cell(std::string_view text);
  CsvText& cell(double value);
  CsvText& cell(int value);
  CsvText& cell(std::optional<double> value);  ///< an empty cell where there is no value
  void end_row();

  /// What there is so far; the next row starts from nothing.
  [[nodiscard]] std::string take() { return std::exchange(text_, {}); }

 private:
  void separate();

  std::string text_;
  bool at_row_start_ = true;
};

/// `name,400,410,...` and a row each: reflectances as room files and atlases take them.
/// @param named  on one grid, at least one
[[nodiscard]] std::string reflectances_csv(
    const std::vector<std::pair<std::string, spectra::Spectrum>>& named);

}  // namespace apps
