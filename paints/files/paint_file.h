#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "appearance/spectra/spectrum.h"
#include "appearance/spectra/stated_colour.h"

namespace paints {

/// What is decided where a file itself leaves it open, KEY=VALUE behind its name.
struct ReadChoices {
  char separator = 0;                         ///< separator=comma|semicolon|tab; 0: by rule
  double full_scale = 0;                      ///< scale=fraction|percent: 1 or 100; 0: by rule
  std::optional<spectra::Grid> wavelengths;   ///< wavelengths=400:700:10, of spectra without any
  std::optional<spectra::StatedWhite> white;  ///< white=D50/2, of colours
  std::string pick;                ///< pick=TEXT: one of several tables, conditions or kinds
  bool hold_ends = false;          ///< ends=hold: end values over the last 10 nm to 400 and 700
  bool clip_fluorescence = false;  ///< fluorescence=clip: what exceeds 1 is cut, and marked
  bool trust_lrv = false;          ///< lrv=trust: scales a colour to its LRV
  bool skip_impossible = false;    ///< impossible=skip: leaves out colours no paint can have
};

/// Adds a choice. @throws std::invalid_argument  with the keys and values there are
void set_choice(ReadChoices& choices, std::string_view key, std::string_view value);

/// One paint as a file gives it.
struct FilePaint {
  std::string name;               ///< unique in the file: the code where there is one
  std::string label;              ///< for people: the name beside a code, then what was kept
  spectra::Samples reflectance;   ///< fractions, 0 <= rho < 1, by rising wavelength
  bool reconstructed = false;     ///< from a colour, not measured
  bool fluorescent = false;       ///< exceeded 1 and was cut
  std::optional<double> lrv;      ///< as stated, 0 to 100
  std::vector<std::string> kept;  ///< cells of PaintFile::kept_columns
};

struct PaintFile {
  std::string path;
  std::string format;              ///< "CSV", "CxF3", "CGATS", "QTX"
  std::string rule;                ///< by which it was recognised
  std::vector<std::string> notes;  ///< what was assumed, converted or found odd, a sentence each
  std::vector<std::string> kept_columns;
  std::vector<FilePaint> paints;  ///< in the order of the file, at least one
  bool percent = false;           ///< reflectances were divided by 100
};

}  // namespace paints
