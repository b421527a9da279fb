#pragma once
#include <string>
#include <vector>

#include "apps/studies/model_spread.h"
#include "apps/system/output_files.h"

namespace apps {

/// An SVG picture of the plane of a_C and b_C: the paint that is best under each choice, or the
/// first row where nothing is ranked.
/// @param spread  with at least one row
[[nodiscard]] std::string model_spread_picture(const std::string& title, const ModelSpread& spread);

/// It, and the table beside it; none if there is nothing to tell.
[[nodiscard]] std::vector<OutputFile> model_spread_files(const std::filesystem::path& out,
                                                         const std::string& title,
                                                         const ModelSpread& spread);

}  // namespace apps
