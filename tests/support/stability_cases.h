#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "scenes/room.h"

namespace stability {

/// A stiff or extreme case, run through the engine, against a truth that does not come from it.
struct Case {
  std::string name;
  std::string danger;           ///< what could fail
  std::string remedy;           ///< what the engine does
  std::string truth;            ///< what the result is compared with
  double limit = 0;             ///< of the error
  double (*error)() = nullptr;  ///< runs it; relative to the truth, infinite if it is refused
};

[[nodiscard]] const std::vector<Case>& cases();

/// Reflectances of the iterations table.
inline constexpr double kReflectances[] = {0.5, 0.9, 0.99, 0.999, 0.9999};

/// A room in which light travels far before it fades.
struct StiffRoom {
  std::string name;
  scenes::Room (*room)() = nullptr;
  int most_iterations = 0;  ///< to 1e-8
};

[[nodiscard]] const std::vector<StiffRoom>& stiff_rooms();

struct Iterations {
  int patches = 0;
  std::vector<int> with_clusters;     ///< of each of kReflectances, to 1e-8, proven
  std::vector<int> without_clusters;  ///< plain conjugate gradients
  double error = 0;  ///< largest of conservation law, white furnace and direct solve
};

[[nodiscard]] Iterations iterate(const StiffRoom& stiff);

}  // namespace stability
