#pragma once
#include <cstdint>

#include "scenes/mesh/patch_mesh.h"
#include "scenes/room.h"
#include "solver/bounce/radiosity.h"

namespace solver {

struct FineOptions {
  int rays = 2048;       ///< per patch into the hemisphere, a multiple of kFineBatches
  int lamp_rays = 1024;  ///< per patch and lamp that something hides in part
};

inline constexpr int kFineBatches = 8;

/// What reaches the patches of a mesh that is too fine for exchange areas of its own.
struct FineIrradiance {
  Bands irradiance;               ///< H, area means
  Eigen::ArrayXd standard_error;  ///< of a patch's noisiest band, relative to its strongest
  std::int64_t lost_rays = 0;     ///< that met nothing: gaps narrower than the rays' offset
};

/// H = D + lamps + indirect light, from the solution on a coarser mesh.
///
/// Lamps: form factors to whole lamps are exact, what hides them is sampled. Indirect light: rays
/// of equal weight in the cosine hemisphere find what the coarse patches reflect, linear within
/// each (ReflectedField). Neighbouring patches share directions, which are of low discrepancy and
/// the same for any number of threads. The share of rays that meets a face in full view is known
/// exactly, so for those faces the difference to the sampled share counts with the face's mean
/// (control variate); in an empty convex room only differences within faces are left to chance.
///
/// The standard error comes from kFineBatches runs of rays, taken as independent: as they
/// complement each other, it errs on the safe side. It leaves out what the coarse mesh does to the
/// light.
/// @param radiosity  B of the solved patches, slopes included
/// @param emission  S, surface x band
/// @param direct  D of the fine patches, from sources that are no patches
[[nodiscard]] FineIrradiance gather_to_fine(const scenes::Room& room,
                                            const scenes::PatchMesh& solved, const Bands& radiosity,
                                            const Bands& emission, const scenes::PatchMesh& fine,
                                            Bands direct, const FineOptions& options = {});

}  // namespace solver
