// Computed beside measured: how shapes are compared, and what comes out for the measured box.
#include "apps/studies/measured_rooms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace apps {
namespace {

using spectra::Spectrum;

Spectrum ramp(double scale, double tilt) {
  Spectrum s = spectra::constant(spectra::kTransportGrid, 0);
  for (int k = 0; k < s.grid.count; ++k) s.values[k] = scale * (1 + tilt * k);
  return s;
}

TEST(ShapeError, IsNothingForTheSameShapeOfAnyAmount) {
  EXPECT_LT(shape_error(ramp(7, 0.02), ramp(1, 0.02)).rms, 1e-15);
}

TEST(ShapeError, IsThatOfTheBestAmount) {
  // 12 bands as measured and 11 twice as high: the amount s takes 12 (s - 1)^2 + 11 (2 s - 1)^2
  // to its least.
  const Spectrum measured = spectra::constant(spectra::kTransportGrid, 1);
  Spectrum computed = measured;
  computed.values.tail(11) = 2;  // of the 23 from 480 nm up
  const double s = (12.0 + 22) / (12 + 44);
  const ShapeError error = shape_error(computed, measured);
  EXPECT_NEAR(error.rms, std::sqrt((12 * (s - 1) * (s - 1) + 11 * (2 * s - 1) * (2 * s - 1)) / 23),
              1e-15);
  EXPECT_NEAR(error.worst, s - 1, 1e-15);
}

TEST(ShapeError, WantsLightInEveryBand) {
  EXPECT_THROW((void)shape_error(ramp(1, 0), ramp(0, 0)), std::invalid_argument);
}

TEST(MeasuredRooms, BouncesExplainTheBox) {
  const MeasuredBox box = compare_box(SOURCE_DIR "/scenes/measured");
  EXPECT_LT(box.between_readings, 0.006);  // 0.0055 with the box's readings; 0.0042 here
  ASSERT_EQ(box.places.size(), 5U);
  const BoxPlace& centre = box.places.front();
  EXPECT_EQ(centre.name, "back wall, centre");
  EXPECT_NEAR(centre.with_bounces.rms, 0.030, 0.0005);
  EXPECT_NEAR(centre.without.rms, 0.104, 0.003);  // 0.1015 here: why they differ is open
  for (const BoxPlace& place : box.places) {
    EXPECT_LT(place.mesh_error, 1e-3) << place.name;
    EXPECT_LT(place.with_bounces.rms, 0.040) << place.name;
  }
}

}  // namespace
}  // namespace apps
