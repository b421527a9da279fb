#pragma once
#include "solver/bounce/radiosity_system.h"

namespace solver {

/// Each returns the certificate of its last radiosities and adds its sweeps to `iterations`.
struct MethodResult {
  Certificate certificate;
  Eigen::ArrayXi iterations;  ///< per band
};

[[nodiscard]] MethodResult lockstep_conjugate_gradients(const RadiositySystem& system,
                                                        const RadiosityOptions& options);
[[nodiscard]] MethodResult jacobi(const RadiositySystem& system, const RadiosityOptions& options);
[[nodiscard]] MethodResult gauss_seidel(const RadiositySystem& system,
                                        const RadiosityOptions& options);
[[nodiscard]] MethodResult progressive(const RadiositySystem& system,
                                       const RadiosityOptions& options);
[[nodiscard]] MethodResult direct(const RadiositySystem& system, const RadiosityOptions& options);
[[nodiscard]] MethodResult bicgstab(const RadiositySystem& system, const RadiosityOptions& options);

}  // namespace solver
