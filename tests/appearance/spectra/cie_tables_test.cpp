#include "appearance/spectra/cie_tables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace spectra {
namespace {

double luminosity(int nm) { return colour_matching(kClosedFormGrid)(nm - 360, 1); }

/// Wavelength between nm and nm + 1 where V, linear in between, is a tenth.
double tenth_between(int nm) {
  return nm + (0.1 - luminosity(nm)) / (luminosity(nm + 1) - luminosity(nm));
}

// The observer was normalised to equal areas; the table is rounded to 6-7 digits, hence 4e-4.
TEST(CieTables, ColourMatchingFunctionsHaveEqualAreas) {
  const Eigen::RowVector3d area = colour_matching(kClosedFormGrid).colwise().sum();
  EXPECT_NEAR(area[0] / area[1], 1, 4e-4);
  EXPECT_NEAR(area[2] / area[1], 1, 4e-4);
}

TEST(CieTables, LuminosityPeaksWithOneAt555) {
  Eigen::Index peak = 0;
  EXPECT_EQ(colour_matching(kClosedFormGrid).col(1).maxCoeff(&peak), 1);
  EXPECT_EQ(kClosedFormGrid.wavelength_nm(static_cast<int>(peak)), 555);
}

// [Neumann2004] 3.1 prints 429 nm for the blue side, where V is 0.011.
TEST(CieTables, LuminosityIsATenthAt472And651) {
  EXPECT_NEAR(tenth_between(471), 472, 0.5);
  EXPECT_NEAR(tenth_between(650), 651, 0.5);
}

// [Neumann2004] 3.1 prints V at the ends of 400..700 nm.
TEST(CieTables, LuminosityAtTheEndsOfTransportIsAsPrinted) {
  EXPECT_EQ(luminosity(400), 0.000396);
  EXPECT_EQ(luminosity(700), 0.004102);
}

TEST(CieTables, BandsAreSamplesOfTheOneNanometreTable) {
  const auto& fine = colour_matching(kClosedFormGrid);
  const auto& bands = colour_matching(kTransportGrid);
  ASSERT_EQ(bands.rows(), 31);
  for (int k = 0; k < 31; ++k) EXPECT_EQ(bands.row(k), fine.row(40 + 10 * k)) << k;
}

TEST(CieTables, ReferenceStaysValidAndIsMadeOnce) {
  const auto* first = &colour_matching(kTransportGrid);
  (void)colour_matching({.first_nm = 380, .step_nm = 5, .count = 81});
  EXPECT_EQ(first, &colour_matching(kTransportGrid));
}

TEST(CieTables, GridOffTheTableIsRefused) {
  EXPECT_THROW((void)colour_matching({.first_nm = 359, .step_nm = 1, .count = 2}),
               std::invalid_argument);
  EXPECT_THROW((void)colour_matching({.first_nm = 829, .step_nm = 1, .count = 3}),
               std::invalid_argument);
  EXPECT_THROW((void)colour_matching({.first_nm = 400, .step_nm = 2.5, .count = 3}),
               std::invalid_argument);
  EXPECT_THROW((void)colour_matching({.first_nm = 400, .step_nm = 1, .count = -50}),
               std::invalid_argument);
  EXPECT_THROW((void)colour_matching({.first_nm = std::nan(""), .step_nm = 1, .count = 3}),
               std::invalid_argument);
}

}  // namespace
}  // namespace spectra
