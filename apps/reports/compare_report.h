#pragma once
#include <string>
#include <vector>

#include "apps/run/room_options.h"
#include "apps/studies/colour_verdict.h"

namespace apps {

/// A room by every method; the first is the judge, whose differences are 0.
struct Comparison {
  std::string room;
  int patches = 0;
  std::vector<std::string> surfaces = {};
  std::vector<MethodVerdict> methods = {};
};

/// compare.csv: a row per method and surface.
[[nodiscard]] std::string compare_csv(const Comparison& comparison);

/// methods.csv: a row per method, mean and worst over the surfaces.
[[nodiscard]] std::string methods_csv(const Comparison& comparison);
[[nodiscard]] Json method_list(const Comparison& comparison);
[[nodiscard]] std::string method_table(const Comparison& comparison);

/// summary.md: a page in words, are three numbers enough for this room?
[[nodiscard]] std::string summary(const Comparison& comparison);

}  // namespace apps
