#pragma once
#include <functional>
#include <string>
#include <vector>

#include "solver/rooms/room_light.h"

namespace apps {

/// A way to solve a prepared room. A further one joins by a row in solver_methods().
struct SolverMethod {
  std::string name;
  bool iterates = true;        ///< its error can be asked for
  int most_patches = 1 << 30;  ///< beyond which it takes too long
  std::function<solver::RoomSolution(const scenes::Room&, const solver::RoomTransport&,
                                     const solver::RadiosityOptions&)>
      solve;
};

[[nodiscard]] const std::vector<SolverMethod>& solver_methods();

}  // namespace apps
