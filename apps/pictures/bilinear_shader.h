#pragma once
#include <string>

#include "appearance/spectra/bilinear.h"

namespace apps {

/// A function in the shading language of OpenGL ES, versions 1.00 and 3.00 alike.
struct BilinearShader {
  std::string glsl;  ///< vec3 bilinear(vec3 light, vec3 reflectance)
  /// Vector instructions (multiply, add or multiply-add of a vec3), one per line of the function;
  /// the classical product light * reflectance is one.
  int instructions = 0;
};

/// The product of a set as a shader [Granier2004] 7.3. Since k^c_de = k^c_ed, with row sums
/// S_cd = sum_e k^c_de,
///   C_c = sum_d S_cd l_d r_d - sum_{d<e} k^c_de (l_d - l_e) (r_d - r_e),
/// and S is the identity in a coherent set: the classical product, corrected by what light and
/// reflectance both differ from grey.
[[nodiscard]] BilinearShader bilinear_shader(const spectra::BilinearSet& set);

}  // namespace apps
