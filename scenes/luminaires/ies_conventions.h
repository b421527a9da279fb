#pragma once
#include <string>
#include <string_view>

#include "scenes/luminaires/luminaire.h"

namespace scenes {

/// In capitals, as keywords are compared.
[[nodiscard]] std::string upper(std::string_view text);

/// The year of a first line; 0: it claims to be a version, but none that is known; 1986: none.
[[nodiscard]] int ies_year(std::string_view first_line);

struct IesShape {
  LuminousShape shape = LuminousShape::point;
  bool known = true;  ///< false: the signs fit no shape
};

/// By the signs of width, length and height, whatever the version says [LM63].
[[nodiscard]] IesShape ies_shape(double width, double length, double height);

}  // namespace scenes
