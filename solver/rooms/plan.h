#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "solver/factors/slope_basis.h"
#include "solver/sensors/eye.h"

namespace solver {

/// What a scene does not need and is therefore left out, and why.
struct Omission {
  std::string what, why;
  double saved_seconds = 0;  ///< of one core, rough
};

/// Patches that are too many for exchange areas of their own: their light is gathered from coarser
/// ones that are solved (fine_light.h).
struct FinePlan {
  double patch_m = 0;        ///< 0: there are none, the solved patches are those asked for
  std::int64_t patches = 0;  ///< estimated from areas
};

/// Above this number of unknowns (patches, or three times as many where light is linear on them)
/// coarser patches are solved.
inline constexpr int kMostSolvedPatches = 30000;

/// Made before anything is computed; what it leaves out changes no result beyond rounding, unless
/// there are fine patches.
struct Plan {
  int patches = 0;     ///< that are solved
  double patch_m = 0;  ///< their longest edge
  FinePlan fine;
  std::int64_t pairs = 0;             ///< of patches that face each other
  std::int64_t occludable_pairs = 0;  ///< of those, pairs that something might stand between
  int bands = 0;                      ///< that carry light
  int solved_bands = 0;  ///< of those, the ones whose solution is not another's times a number
  std::int64_t memory_bytes = 0;  ///< peak, estimated
  double expected_seconds = 0;    ///< of one core, rough
  std::vector<Omission> left_out;
};

/// The memory that this process may still take, bytes.
[[nodiscard]] std::int64_t available_memory_bytes();

/// A job cannot fit: exit code 3, with the size and the patch size that would fit.
class TooLarge : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What light is on a patch.
enum class Light {
  constant,
  linear  ///< three numbers a patch, on patches with edges 2.5 times as long
};

/// Numbers a patch and band.
[[nodiscard]] inline int modes_of(Light light) {
  return light == Light::linear ? SlopeBasis::kModes : 1;
}

/// The longest edge of patches for a patch_m: as asked for with constant light; 2.5 times as long
/// with linear light, which takes about the same time and leaves a fifth of the error or less.
[[nodiscard]] inline double longest_edge_m(double patch_m, Light light) {
  return light == Light::linear ? 2.5 * patch_m : patch_m;
}

struct TransportOptions {
  double patch_m = 0;                   ///< 0: the room's own
  Light light = Light::linear;          ///< what it is on a patch
  std::vector<ViewedPoint> views;       ///< empty: the viewed point of each painted group
  int rays = 64;                        ///< for a pair of patches, if the first 16 disagree
  int lamp_rays = 256;                  ///< for a pair with a lamp
  std::int64_t memory_limit_bytes = 0;  ///< 0: what the machine has free
  bool skip = true;                     ///< leave out what the scene does not need
  /// False: of viewed points the irradiance alone, not what else the eye takes in.
  bool eye = true;
};

}  // namespace solver
