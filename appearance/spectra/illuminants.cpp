#include "appearance/spectra/illuminants.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <cmath>
#include <stdexcept>

#include "appearance/spectra/compiled_tables.h"

namespace spectra {
namespace {

/// Illuminant C and the daylight components, 380..780 nm, step 5.
struct Tables {
  std::vector<double> nm, c;
  std::array<std::vector<double>, 3> daylight;
};

const Tables& tables() {
  static const Tables loaded = [] {
    Tables t;
    for (const CsvRow& row : compiled_table(CompiledTable::illuminants).rows) {
      t.nm.push_back(compiled_number(row.cells.at(0)));
      t.c.push_back(compiled_number(row.cells.at(1)));
      for (std::size_t i = 0; i < 3; ++i) {
        t.daylight[i].push_back(compiled_number(row.cells.at(2 + i)));
      }
    }
    return t;
  }();
  return loaded;
}

template <class Power>
Samples formula(double first_nm, double last_nm, Power power) {
  Samples s;
  for (double nm = first_nm; nm <= last_nm; ++nm) {
    s.nm.push_back(nm);
    s.values.push_back(power(nm));
  }
  return s;
}

/// [CIE15] 3.1: exact by definition, with the second radiation constant of 1931 and 2848 K, which
/// together are 2856 K today.
double illuminant_a(double nm) {
  constexpr double kC2_nm_K = 1.435e7, kTemperature_K = 2848;
  return 100 * std::pow(560 / nm, 5) * std::expm1(kC2_nm_K / (kTemperature_K * 560)) /
         std::expm1(kC2_nm_K / (kTemperature_K * nm));
}

double rounded_to_thousandths(double value) { return std::round(1000 * value) / 1000; }

}  // namespace

const std::vector<std::string>& illuminant_names() {
  static const std::vector<std::string> names{"A", "C", "D50", "D55", "D65", "D75", "E"};
  return names;
}

Samples illuminant(std::string_view name) {
  // The D names are older than today's second radiation constant: c_2 was 1.4380e-2 m K [CIE15].
  constexpr double kConstantRevised = 1.4388 / 1.4380;
  if (name == "A") return formula(360, 830, illuminant_a);
  if (name == "C") return {.nm = tables().nm, .values = tables().c};
  if (name == "D50") return daylight(5000 * kConstantRevised);
  if (name == "D55") return daylight(5500 * kConstantRevised);
  if (name == "D65") return daylight(6500 * kConstantRevised);
  if (name == "D75") return daylight(7500 * kConstantRevised);
  if (name == "E") return {.nm = {360, 830}, .values = {1, 1}};
  throw std::invalid_argument(
      fmt::format("no illuminant \"{}\"; there are {}", name, fmt::join(illuminant_names(), ", ")));
}

Samples planck(double temperature_K) {
  if (!(temperature_K >= 100 && temperature_K <= 1e6)) {
    throw std::invalid_argument(
        fmt::format("a Planckian temperature must be within 100..1e6 K, not {}", temperature_K));
  }
  constexpr double kC2_nm_K = 14387669;
  return formula(355, 835, [=](double nm) {
    return std::pow(1000 / nm, 5) / std::expm1(kC2_nm_K / (nm * temperature_K));
  });
}

Samples daylight(double cct_K) {
  if (!(cct_K >= 4000 && cct_K <= 25000)) {
    throw std::invalid_argument(
        fmt::format("daylight must have a temperature within 4000..25000 K, not {}", cct_K));
  }
  const Eigen::Vector2d exact = daylight_weights(cct_K);
  // Rounded as [CIE15] asks: so D65 comes out as its published table, within 0.001 of 100.
  const double m1 = rounded_to_thousandths(exact[0]), m2 = rounded_to_thousandths(exact[1]);

  const auto& [s0, s1, s2] = tables().daylight;
  Samples s{.nm = tables().nm, .values = {}};
  for (std::size_t k = 0; k < s.nm.size(); ++k) {
    s.values.push_back(s0[k] + m1 * s1[k] + m2 * s2[k]);
  }
  return s;
}

std::array<Samples, 3> daylight_components() {
  std::array<Samples, 3> components;
  for (std::size_t k = 0; k < 3; ++k) {
    components[k] = {.nm = tables().nm, .values = tables().daylight[k]};
  }
  return components;
}

/// [CIE15] 3.1: chromaticity on the daylight locus, then the weights of the components.
Eigen::Vector2d daylight_weights(double cct_K) {
  const double u = 1000 / cct_K;
  const double x = cct_K <= 7000 ? 0.244063 + u * (0.09911 + u * (2.9678 - u * 4.6070))
                                 : 0.237040 + u * (0.24748 + u * (1.9018 - u * 2.0064));
  const double y = -0.275 + x * (2.870 - x * 3.000);
  const double m = 0.0241 + 0.2562 * x - 0.7341 * y;
  return {(-1.3515 - 1.7703 * x + 5.9114 * y) / m, (0.0300 - 31.4424 * x + 30.0717 * y) / m};
}

const std::vector<LampPreset>& lamp_presets() {
  static const std::vector<LampPreset> presets{
      {"north-sky light", 7500, 0},
      {"average daylight", 6500, 0},
      {"xenon flash", 6500, 0},
      {"sunlight + skylight", 5500, 0},
      {"sunlight 20 deg altitude", 4700, 0},
      {"sunlight 10 deg altitude", 4000, 0},
      {"fluorescent white", 3500, 0},
      {"tungsten halogen short life", 3300, 0},
      {"studio tungsten", 3200, 25},
      {"fluorescent warm white", 3000, 83},
      {"tungsten halogen long life", 3000, 21},
      {"tungsten 100 W 110 V", 2850, 15},
      {"tungsten 100 W 240 V", 2750, 13},
      {"tungsten 40 W 110 V", 2700, 12},
      {"tungsten 40 W 240 V", 2650, 10},
      {"sunlight at sunset", 2000, 0},
      {"candle flame", 1900, 0},
  };
  return presets;
}

}  // namespace spectra
