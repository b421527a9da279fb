#include "solver/judges/battery.h"

#include <cmath>

#include "solver/judges/battery_cases.h"

namespace solver {

Check worst_of(const Check& what, const Eigen::ArrayXd& expected, const Eigen::ArrayXd& computed) {
  Check worst = what;
  for (Eigen::Index i = 0; i < expected.size(); ++i) {
    Check one = what;
    one.expected = expected[i];
    one.computed = computed[i];
    if (i == 0 || !(one.relative_error() <= worst.relative_error())) worst = one;
    if (std::isnan(worst.relative_error())) break;
  }
  return worst;
}

const std::vector<CheckGroup>& battery() {
  static const std::vector<CheckGroup> kGroups{
      {"squares", check_squares},
      {"offsets", check_offsets},
      {"strips", check_strips},
      {"touching", check_touching_polygons},
      {"sphere", check_sphere},
      {"plates", check_plates},
      {"cube", check_cube},
      {"brick", check_brick},
      {"furnace", check_white_furnace},
      {"flux", check_flux},
      {"CIE 171 5.2", check_cie171_5_2},
      {"CIE 171 5.3", check_cie171_5_3},
      {"CIE 171 5.4", check_cie171_5_4},
      {"CIE 171 5.6", check_cie171_5_6},
      {"CIE 171 5.7", check_cie171_5_7},
      {"CIE 171 5.8", check_cie171_5_8},
      {"CIE 171 5.9", check_daylight_roof},
      {"CIE 171 5.11", check_daylight_facade},
      {"daylight", check_daylight_flux},
      {"sun", check_sun_position},
  };
  return kGroups;
}

}  // namespace solver
