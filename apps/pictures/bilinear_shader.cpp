#include "apps/pictures/bilinear_shader.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <vector>

namespace apps {
namespace {

/// Printed coefficients are coherent to 2e-9 at worst; a float holds 6e-8.
constexpr double kCoherent = 1e-8;

/// Nine digits read back as the same float; '#' keeps the point that the language asks for; + 0.0
/// turns -0 into 0.
std::string vec3(const Eigen::Vector3d& v) {
  return fmt::format("vec3({:#.9g}, {:#.9g}, {:#.9g})", v[0] + 0.0, v[1] + 0.0, v[2] + 0.0);
}

/// k^c_de as a vector over c.
Eigen::Vector3d transfer(const spectra::BilinearSet& set, int d, int e) {
  return {set.k[0](d, e), set.k[1](d, e), set.k[2](d, e)};
}

}  // namespace

BilinearShader bilinear_shader(const spectra::BilinearSet& set) {
  std::vector<std::string> lines;
  Eigen::Matrix3d sums;  // column d holds S_cd over c
  for (int d = 0; d < 3; ++d) {
    sums.col(d) = transfer(set, d, 0) + transfer(set, d, 1) + transfer(set, d, 2);
  }
  if (sums.isIdentity(kCoherent)) {
    lines = {"vec3 colour = light * reflectance"};
  } else {
    lines = {"vec3 product = light * reflectance", "vec3 colour = product.r * " + vec3(sums.col(0)),
             "colour += product.g * " + vec3(sums.col(1)),
             "colour += product.b * " + vec3(sums.col(2))};
  }
  lines.insert(lines.end(), {"vec3 tint = light.gbr - light.brg",
                             "vec3 other = reflectance.gbr - reflectance.brg", "tint *= other",
                             "colour -= tint.r * " + vec3(transfer(set, 1, 2)),
                             "colour -= tint.g * " + vec3(transfer(set, 2, 0)),
                             "colour -= tint.b * " + vec3(transfer(set, 0, 1))});
  const auto count = static_cast<int>(lines.size());
  return {.glsl = fmt::format("// Bilinear reflection, set {}: {} vector instructions more than\n"
                              "// light * reflectance. Wants floats of high precision.\n"
                              "vec3 bilinear(vec3 light, vec3 reflectance) {{\n"
                              "  {};\n"
                              "  return colour;\n"
                              "}}\n",
                              set.name, count - 1, fmt::join(lines, ";\n  ")),
          .instructions = count};
}

}  // namespace apps
