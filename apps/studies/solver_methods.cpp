#include "apps/studies/solver_methods.h"

namespace apps {
namespace {

using solver::Method, solver::RadiosityOptions;

constexpr int kMostDirectPatches = 3000;

SolverMethod radiosity_method(const std::string& name, const RadiosityOptions& method) {
  const bool direct = method.method == Method::direct;
  return {.name = name,
          .iterates = !direct,
          .most_patches = direct ? kMostDirectPatches : 1 << 30,
          .solve = [method](const scenes::Room& room, const solver::RoomTransport& transport,
                            RadiosityOptions options) {
            options.method = method.method;
            options.ambient = method.ambient;
            options.overshoot = method.overshoot;
            return solver::solve_room(room, transport, options);
          }};
}

SolverMethod radiosity_method(Method method) {
  return radiosity_method(solver::to_string(method), {.method = method});
}

}  // namespace

const std::vector<SolverMethod>& solver_methods() {
  static const std::vector<SolverMethod> methods{
      radiosity_method(Method::conjugate_gradients),
      radiosity_method(Method::jacobi),
      radiosity_method(Method::gauss_seidel),
      radiosity_method(Method::direct),
      radiosity_method("progressive with overshoot",
                       {.method = Method::progressive, .overshoot = true}),
      radiosity_method("progressive with ambient term",
                       {.method = Method::progressive, .ambient = true}),
      radiosity_method(Method::progressive)};  // the slowest last: time may be over
  return methods;
}

}  // namespace apps
