#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "appearance/spectra/text/csv_reader.h"
#include "paints/files/paint_file.h"

namespace paints {

/// Where a value stands, and what the file calls it.
struct DraftPlace {
  spectra::CsvPlace at;
  std::string pointer;
};

/// A paint as it was found, before any rule that needs the whole file.
struct DraftPaint {
  std::string name, code;
  DraftPlace place;
  std::vector<double> nm, values;           ///< as the file has them, in its order and scale
  std::vector<spectra::CsvPlace> value_at;  ///< one per value, or one for all
  std::optional<spectra::StatedColour> colour;
  std::optional<double> lrv;
  std::vector<std::string> kept;
};

/// A file under way: each reader fills one, `finish` applies the rules that are common to all.
struct PaintDraft {
  explicit PaintDraft(std::string file_path) { file.path = std::move(file_path); }

  void fault(const DraftPlace& place, std::string problem, std::string remedy);

  void note(std::string what) { file.notes.push_back(std::move(what)); }

  PaintFile file;  ///< path, format, rule, notes and kept columns
  std::vector<DraftPaint> paints;
  double full_scale = 0;  ///< of the format: 1 or 100 (or its norm); 0: by the values
  std::vector<spectra::Fault> faults;
};

/// Names, scale, order and range of the spectra, colours as reflectances.
/// @throws spectra::InputError  with the draft's faults and those found here
[[nodiscard]] PaintFile finish(PaintDraft draft, const ReadChoices& choices);

/// A wavelength as headers write it, in nm: 400, "400 nm", R400, R_400, nm400, SPECTRAL_NM_400,
/// "0.4 um"; nothing outside 200..2500. A comma may be the decimal sign.
[[nodiscard]] std::optional<double> parse_wavelength(std::string_view cell);

/// A number, with a decimal comma where `comma` says so.
[[nodiscard]] std::optional<double> parse_decimal(std::string_view cell, bool comma);

}  // namespace paints
