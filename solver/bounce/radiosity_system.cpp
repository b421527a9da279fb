#include "solver/bounce/radiosity_system.h"

#include <fmt/format.h>

#include <limits>
#include <stdexcept>

namespace solver {

using Eigen::ArrayXd;
using Eigen::Index;

const char* to_string(Method method) {
  switch (method) {
    case Method::jacobi:
      return "jacobi";
    case Method::gauss_seidel:
      return "gauss-seidel";
    case Method::progressive:
      return "progressive";
    case Method::direct:
      return "direct";
    case Method::bicgstab:
      return "bicgstab";
    case Method::automatic:
      return "auto";
    case Method::conjugate_gradients:
      break;
  }
  return "cg";
}

Method method_for(const Reflector& reflector, Method wished) {
  const bool symmetric = !reflector.couples_bands() && (reflector.numbers() >= 0).all();
  const bool takes_any =
      wished == Method::jacobi || wished == Method::gauss_seidel || wished == Method::bicgstab;
  if (wished == Method::automatic) {
    return symmetric ? Method::conjugate_gradients : Method::bicgstab;
  }
  if (!symmetric && !takes_any) {
    throw std::invalid_argument(
        fmt::format("method {} needs reflectances of 0 or more; matrices and negative numbers want "
                    "jacobi, gauss-seidel or bicgstab",
                    to_string(wished)));
  }
  return wished;
}

Certificate certify(const RadiositySystem& system, const Bands& radiosity, double relative_error) {
  Certificate c;
  c.irradiance = gather(system.exchange, radiosity) + system.direct;
  c.radiosity = system.emission + system.reflector.reflect(c.irradiance);
  c.change = c.radiosity - radiosity;
  c.norm = error_norms(system, c.change);
  const Bands weighted = c.irradiance.colwise() * system.exchange.area_m2.sqrt();
  c.allowed = relative_error *
              system.reflector.pooled(weighted.matrix().colwise().squaredNorm().transpose()).sqrt();
  return c;
}

ArrayXd error_norms(const RadiositySystem& system, const Bands& change) {
  const ArrayXd norm = system.reflector.norms(change.colwise() * system.exchange.area_m2.sqrt());
  const ArrayXd bound = norm * system.reflector.reach() / (1 - system.contraction);
  return (system.contraction < 1).select(bound, std::numeric_limits<double>::infinity());
}

}  // namespace solver
