#pragma once
#include <optional>
#include <string>
#include <vector>

namespace spectra {

/// A measured lamp of "houser" as boxes tell of lamps. Ra, R9 [CIE13.3] and Rf, Rg [CIE224] were
/// computed for this project.
struct LampFacts {
  std::string name;   ///< its number
  std::string label;  ///< the maker's
  std::string kind;   ///< one of lamp_kinds, or "model", "other"
  double cct_K = 0, duv = 0, ra = 0, r9 = 0, rf = 0, rg = 0;
};

[[nodiscard]] const std::vector<LampFacts>& lamp_facts();

/// LED, fluorescent, halogen, incandescent, metal halide, sodium, mercury.
[[nodiscard]] const std::vector<std::string>& lamp_kinds();

/// What is printed on the box of a lamp.
struct LampBox {
  std::string kind;  ///< empty: any, but models
  double cct_K = 0, ra = 0;
  std::optional<double> r9;
};

struct LampMatch {
  const LampFacts* lamp = nullptr;
  double distance = 0;
};

/// sqrt((dCCT / 50 K)^2 + dRa^2 + (Duv / 0.002)^2 + (dR9 / 10)^2)
[[nodiscard]] double distance_from(const LampFacts& lamp, const LampBox& box);

/// Lamps of that kind, the best match first.
[[nodiscard]] std::vector<LampMatch> lamps_like(const LampBox& box);

/// Whether a lamp may stand for the box: within 6 % in colour temperature, in Ra from 3 below what
/// is printed to 10 above (boxes give the least), in R9 not more than 30 below.
[[nodiscard]] bool stands_for(const LampFacts& lamp, const LampBox& box);

/// "2775 K, Duv 0.0011, Ra 94, R9 90"
[[nodiscard]] std::string in_words(const LampFacts& lamp);

}  // namespace spectra
