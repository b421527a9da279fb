#include "apps/solver_methods.h"

namespace apps {
namespace {

using solver::Method;

constexpr int kMostDirectPatches = 3000;

SolverMethod radiosity_method(Method method) {
  return {.name = solver::to_string(method),
          .iterates = method != Method::direct,
          .most_patches = method == Method::direct ? kMostDirectPatches : 1 << 30,
          .solve = [method](const scenes::Room& room, const solver::RoomTransport& transport,
                            solver::RadiosityOptions options) {
            options.method = method;
            return solver::solve_room(room, transport, options);
          }};
}

}  // namespace

const std::vector<SolverMethod>& solver_methods() {
  static const std::vector<SolverMethod> methods{
      radiosity_method(Method::conjugate_gradients), radiosity_method(Method::jacobi),
      radiosity_method(Method::gauss_seidel), radiosity_method(Method::progressive),
      radiosity_method(Method::direct)};
  return methods;
}

}  // namespace apps
