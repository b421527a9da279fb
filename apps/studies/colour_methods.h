#pragma once
#include <functional>
#include <string>
#include <vector>

#include "appearance/spectra/tristimulus.h"
#include "solver/rooms/room_light.h"

namespace apps {

/// A prepared room whose viewed points lie on surfaces, one each.
struct ComparedRoom {
  const scenes::Room& room;
  const solver::RoomTransport& transport;
  std::vector<int> surfaces;  ///< of the viewed points, in their order
  solver::RadiosityOptions radiosity;
};

/// A room as one method computes it.
struct MethodColours {
  std::vector<spectra::Xyz> sent;  ///< by the surfaces towards the eye, Y in lm m^-2
  bool converged = true;
  int negative_patches = 0;  ///< that receive less than no light in some component
  std::string note;          ///< what did not fit the method; empty if all did
};

/// A way to compute the colours of a room.
struct ColourMethod {
  std::string name;  ///< "spectral:9", "rgb:srgb", "reconstructed:smits"
  std::string what;  ///< for people
  std::function<MethodColours(const ComparedRoom&)> solve;
};

/// The judge: 31 bands.
[[nodiscard]] ColourMethod spectral_method();

/// Those it judges: 9 and 3 bands; RGB; the bilinear sets; display matrices; reflectances
/// reconstructed from the sRGB of each surface, lights as they are.
[[nodiscard]] std::vector<ColourMethod> judged_methods();

}  // namespace apps
