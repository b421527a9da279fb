#pragma once
#include "solver/judges/closed_form.h"

namespace solver {

/// The brick that tests start from.
inline const BrickShape kOffice{.width_m = 5,
                                .depth_m = 4,
                                .height_m = 2.7,
                                .furniture_height = 0.3,
                                .window_width_m = 2,
                                .window_height_m = 1.4,
                                .window_sill_m = 0.9,
                                .window_offset_m = 1.5};

}  // namespace solver
