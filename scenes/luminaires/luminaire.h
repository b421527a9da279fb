#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "scenes/luminaires/intensity_table.h"

namespace scenes {

enum class LuminousShape { point, rectangle, ellipse, box, cylinder, sphere };

/// "rectangle"
[[nodiscard]] std::string_view to_string(LuminousShape shape);

/// How light changes with the angle between the luminaire's axis and straight down.
struct Tilt {
  std::vector<double> angle_deg, factor;

  /// Linear in between, the end values beyond.
  [[nodiscard]] double at(double angle_deg) const;
};

/// A photometric file: what it says, on the luminaire's own axes (IntensityTable).
struct Luminaire {
  std::string path;
  std::string format;    ///< "IESNA:LM-63-2002", "EULUMDAT"
  std::string name;      ///< as the file words it, for people; may be empty
  std::string symmetry;  ///< in words
  IntensityTable intensity;
  double flux_lm = 0;                ///< of the interpolant
  std::optional<double> lamps_lm;    ///< printed flux of the bare lamps; none: absolute photometry
  std::optional<double> printed_lm;  ///< of the luminaire, as the file has it
  double input_W = 0;                ///< 0: not told
  LuminousShape shape = LuminousShape::point;
  Eigen::Vector3d size_m = Eigen::Vector3d::Zero();  ///< of the luminous area, along x, y, z
  std::optional<Tilt> tilt;
  bool needs_flux = false;  ///< intensities are per 1000 lm of lamps whose flux the file leaves out
  std::vector<std::string> notes;  ///< what was assumed or is odd, one sentence each
};

/// Where the axes of a luminaire point in a room, as columns: a turn about its own z,
/// counter-clockwise from above, then the shortest turn from -z to `aim`; straight up: half a turn
/// about x.
[[nodiscard]] Eigen::Matrix3d luminaire_axes(const Eigen::Vector3d& aim, double rotate_deg);

/// What does not fit together in a file, though it can be read: planes that should agree, fluxes.
[[nodiscard]] std::vector<std::string> oddities(const Luminaire& luminaire);

}  // namespace scenes
