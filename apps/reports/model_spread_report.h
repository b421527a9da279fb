#pragma once
#include <string>

#include "apps/studies/model_spread.h"

namespace apps {

/// model_spread.csv: every row under every choice.
[[nodiscard]] std::string model_spread_csv(const ModelSpread& spread);

/// What the choices move, for people. @param what  is moved: "the best paint"
[[nodiscard]] std::string model_spread_text(const ModelSpread& spread, const std::string& what,
                                            std::size_t row = 0);

/// For run.json and --json.
[[nodiscard]] Json describe(const ModelSpread& spread);

}  // namespace apps
