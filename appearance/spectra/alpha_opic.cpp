#include "appearance/spectra/alpha_opic.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "appearance/spectra/compiled_tables.h"

namespace spectra {
namespace {

/// Efficacy of luminous radiation of D65 for each receptor, W/lm [CIES026].
constexpr std::array<double, kReceptors> kOfDaylight_W_lm{0.8173e-3, 1.4558e-3, 1.6289e-3,
                                                          1.4497e-3, 1.3262e-3};

/// S, M, L, rods at every 5 nm from 390.
const std::array<std::vector<double>, 4>& tables() {
  static const std::array<std::vector<double>, 4> loaded = [] {
    std::array<std::vector<double>, 4> columns;
    for (const CsvRow& row : compiled_table(CompiledTable::alpha_opic).rows) {
      for (std::size_t c = 0; c < columns.size(); ++c) {
        columns[c].push_back(compiled_number(row.cells.at(c + 1)));
      }
    }
    return columns;
  }();
  return loaded;
}

/// Linear between values at `first`, `first + step`, ...; 0 beyond them.
template <typename Values>
double between(const Values& values, double first, double step, double at) {
  const double place = (at - first) / step;
  const double last = static_cast<double>(std::size(values)) - 1;
  if (place < 0 || place > last) return 0;
  const auto low = static_cast<std::size_t>(std::min(place, last - 1));
  const double share = place - static_cast<double>(low);
  return (1 - share) * values[low] + share * values[low + 1];
}

/// The A1 template, alpha and beta band.
double pigment(double nm, double peak_nm) {
  const double x = peak_nm / nm;
  const double a = 0.8795 + 0.0459 * std::exp(-std::pow(peak_nm - 300, 2) / 11940);
  const double alpha = 1 / (std::exp(69.7 * (a - x)) + std::exp(28 * (0.922 - x)) +
                            std::exp(-14.9 * (1.104 - x)) + 0.674);
  return alpha + 0.26 * std::exp(-std::pow((nm - 340.2) / 53.1, 2));
}

/// Quanta behind the lens, as energy: lambda G 10^-D, 1 at 490 nm.
double melanopic(double nm) {
  static constexpr std::array<double, 31> kLensDensity{
      1.487, .980, .620, .464, .364, .307, .264, .223,  .194, .174, .154,
      .134,  .120, .107, .094, .080, .067, .056, .047,  .038, .031, .025,
      .019,  .015, .011, .008, .005, .002, 0,    -.002, -.003};
  constexpr double kPeak_nm = 480, kFirst_nm = 400, kLast_nm = 700;
  if (nm < kFirst_nm || nm > kLast_nm) return 0;
  const auto quanta = [](double at) {
    return at * pigment(at, kPeak_nm) * std::pow(10, -between(kLensDensity, 400, 10, at));
  };
  return quanta(nm) / quanta(490);
}

}  // namespace

std::string_view to_string(Receptor receptor) {
  static constexpr std::array<std::string_view, kReceptors> kNames{"S_cone", "M_cone", "L_cone",
                                                                   "rhodopic", "melanopic"};
  return kNames[static_cast<std::size_t>(receptor)];
}

double sensitivity(Receptor receptor, double nm) {
  constexpr double kFirst_nm = 390, kStep_nm = 5;
  if (receptor == Receptor::melanopic) return melanopic(nm);
  return between(tables()[static_cast<std::size_t>(receptor)], kFirst_nm, kStep_nm, nm);
}

std::array<double, kReceptors> equivalent_daylight_lx(const Spectrum& light) {
  std::array<double, kReceptors> lx{};
  for (std::size_t r = 0; r < lx.size(); ++r) {
    for (int k = 0; k < light.grid.count; ++k) {
      lx[r] += light.grid.step_nm * light.values[k] *
               sensitivity(static_cast<Receptor>(r), light.grid.wavelength_nm(k));
    }
    lx[r] /= kOfDaylight_W_lm[r];
  }
  return lx;
}

}  // namespace spectra
