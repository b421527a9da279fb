// tests/data/ciecam02_vectors.csv holds CIECAM02 as the standard prints it, computed in 50 digits
// by tests/support/ciecam02_reference.py.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "appearance/ciecam02.h"
#include "appearance/spectra/text/csv_reader.h"

namespace appearance {
namespace {

struct Vector {
  std::string name, status;
  spectra::RelativeXyz sample;
  ViewingConditions view;
  std::vector<std::optional<double>> expected;  // J, C, h, Q, M, s, H
};

std::vector<Vector> vectors() {
  const spectra::CsvTable csv = spectra::read_csv(TEST_DATA "/ciecam02_vectors.csv");
  std::vector<Vector> all;
  for (const spectra::CsvRow& row : csv.rows) {
    std::vector<std::optional<double>> v;
    for (std::size_t c = 2; c < row.cells.size(); ++c) {
      v.push_back(spectra::parse_number(row.cells[c]));
    }
    all.push_back({.name = row.cells[0] + " in line " + std::to_string(row.line),
                   .status = row.cells[1],
                   .sample = {*v[0], *v[1], *v[2]},
                   .view = {.white = {*v[3], *v[4], *v[5]},
                            .adapting_luminance_cd_m2 = *v[6],
                            .background_y = *v[7],
                            .surround = {*v[8], *v[9], *v[10]}},
                   .expected = {v.begin() + 11, v.end()}});
  }
  return all;
}

// 1e-9 of the value, absolute below 1; a hue angle is as uncertain as its chroma is small.
void expect_correlates(const Correlates& p, const Vector& v) {
  const std::vector<double> computed{p.lightness,     p.chroma,     p.hue_deg,       p.brightness,
                                     p.colourfulness, p.saturation, p.hue_quadrature};
  const double chroma = v.expected[1].value_or(1);
  const double hue_tolerance = 1e-9 / std::clamp(chroma, 1e-9, 1.0);
  for (std::size_t i = 0; i < computed.size(); ++i) {
    const bool is_hue = i == 2 || i == 6;
    const double wanted = v.expected[i].value_or(0);  // undefined is reported as 0
    const double tolerance = is_hue ? hue_tolerance : 1e-9 * std::max(1.0, std::abs(wanted));
    EXPECT_NEAR(computed[i], wanted, tolerance) << "correlate " << i;
  }
}

TEST(Ciecam02Vectors, EveryStatusAndDefinedCorrelateAgreesTo1em9) {
  const std::vector<Vector> all = vectors();
  ASSERT_GT(all.size(), 150U);
  for (const Vector& v : all) {
    SCOPED_TRACE(v.name);
    if (v.status == "DOMAIN") {
      EXPECT_THROW((void)adapt(v.view), std::domain_error);
      continue;
    }
    const Correlates p = ciecam02_forward(v.sample, adapt(v.view));
    EXPECT_EQ(to_string(p.status), v.status);
    expect_correlates(p, v);
  }
}

TEST(Ciecam02Vectors, InverseReturnsEveryStimulusTo1em9) {
  for (const Vector& v : vectors()) {
    SCOPED_TRACE(v.name);
    if (!v.expected[1]) continue;  // no chroma, nothing to invert
    const auto xyz =
        ciecam02_inverse({*v.expected[0], *v.expected[1], *v.expected[2]}, adapt(v.view));
    const double size =
        std::max({std::abs(v.sample.x), std::abs(v.sample.y), std::abs(v.sample.z)});
    EXPECT_NEAR(xyz.x, v.sample.x, 1e-9 * size);
    EXPECT_NEAR(xyz.y, v.sample.y, 1e-9 * size);
    EXPECT_NEAR(xyz.z, v.sample.z, 1e-9 * size);
  }
}

}  // namespace
}  // namespace appearance
