#pragma once
#include <string>
#include <vector>

#include "scenes/room.h"

namespace scenes {

/// Corners nearer than this are one; faces are plane to it.
inline constexpr double kWeld_m = 1e-6;

/// All faces together have at most so many: the work grows with the square.
inline constexpr std::size_t kMostShellCorners = 40'000;

/// What is wrong with a face of a shell.
struct ShellFault {
  std::size_t face = 0;
  std::string problem, remedy;
};

/// Welds the corners of faces and turns their fronts to the air, whichever way they were given;
/// corners may lie on edges of other faces. Sets their frames.
/// @param faces  plane simple polygons; holes within them
/// @param several  they may make several shells, beside each other
/// @return why they do not enclose one space: open edges, edges of three faces, faces that cross or
/// lie on each other, several shells; then the faces are as good as they could be made
[[nodiscard]] std::vector<ShellFault> close_shell(std::vector<ShellFace>& faces,
                                                  bool several = false);

}  // namespace scenes
