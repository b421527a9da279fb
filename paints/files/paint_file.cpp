#include "paints/files/paint_file.h"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "appearance/spectra/text/csv_reader.h"

namespace paints {
namespace {

constexpr const char* kChoices =
    "separator=comma|semicolon|tab, scale=fraction|percent, wavelengths=FIRST:LAST:STEP, "
    "white=D65/2, pick=TEXT, ends=hold, fluorescence=clip, lrv=trust, impossible=skip";

/// "400:700:10"
std::optional<spectra::Grid> parse_grid(std::string_view text) {
  const std::size_t a = text.find(':'), b = text.rfind(':');
  if (a == text.npos || a == b) return {};
  const auto first = spectra::parse_number(text.substr(0, a)),
             last = spectra::parse_number(text.substr(a + 1, b - a - 1)),
             step = spectra::parse_number(text.substr(b + 1));
  if (!first || !last || !step || *first < 200 || *last > 2500 || *step < 0.1) return {};
  const double count = (*last - *first) / *step + 1;
  if (count < 2 || std::abs(count - std::round(count)) > 1e-9) return {};
  return spectra::Grid{
      .first_nm = *first, .step_nm = *step, .count = static_cast<int>(std::round(count))};
}

}  // namespace

void set_choice(ReadChoices& choices, std::string_view key, std::string_view value) {
  const auto is = [&](std::string_view k, std::string_view v) { return key == k && value == v; };
  if (is("separator", "comma")) {
    choices.separator = ',';
  } else if (is("separator", "semicolon")) {
    choices.separator = ';';
  } else if (is("separator", "tab")) {
    choices.separator = '\t';
  } else if (is("scale", "fraction")) {
    choices.full_scale = 1;
  } else if (is("scale", "percent")) {
    choices.full_scale = 100;
  } else if (key == "wavelengths" && parse_grid(value)) {
    choices.wavelengths = parse_grid(value);
  } else if (key == "white" && spectra::parse_white(value)) {
    choices.white = spectra::parse_white(value);
  } else if (key == "pick" && !value.empty()) {
    choices.pick = value;
  } else if (is("ends", "hold")) {
    choices.hold_ends = true;
  } else if (is("fluorescence", "clip")) {
    choices.clip_fluorescence = true;
  } else if (is("lrv", "trust")) {
    choices.trust_lrv = true;
  } else if (is("impossible", "skip")) {
    choices.skip_impossible = true;
  } else {
    throw std::invalid_argument(
        fmt::format("\"{}={}\" is no way to read paints; there are {}", key, value, kChoices));
  }
}

}  // namespace paints
