#pragma once
#include <Eigen/Core>
#include <array>
#include <vector>

#include "appearance/jab_slope.h"
#include "paints/mixing.h"

namespace paints {

inline constexpr int kMostBases = 4;

/// The bases of a recipe by their places in the set, rising; the first `count` of four.
struct BaseNumbers {
  int count = 0;
  std::array<int, kMostBases> at{};

  auto operator<=>(const BaseNumbers&) const = default;
};

/// Of each base; 0 beyond the recipe's count.
using Parts = Eigen::Vector4d;

/// How a mixture looks, and how that changes with its parts.
struct JabOfParts {
  Eigen::Vector3d jab;
  Eigen::Matrix<double, 3, kMostBases> by_parts;
};

/// How any mixture of a set of bases looks in a room, in about half a microsecond: since light in a
/// band depends on the reflectance in that band alone, the room is asked at 65 grey paints, and
/// cubes through values and slopes give the light in between. A search tool: float, and off by
/// h^4/384 of the fourth derivative; what is found with it is to be refined with the room itself.
class ViewedTable {
 public:
  /// @throws std::invalid_argument  if there are no bases, or more than 32 bands
  /// @throws std::domain_error      if the room leaves the viewer without light
  ViewedTable(const BaseSet& set, const spectra::RoomResponseSlope& room,
              const spectra::ViewingChoices& viewing);

  [[nodiscard]] Eigen::Vector3d jab(const BaseNumbers& bases, const Parts& parts) const;
  [[nodiscard]] JabOfParts slope(const BaseNumbers& bases, const Parts& parts) const;

 private:
  using Bands = Eigen::Array<float, Eigen::Dynamic, 1, 0, 32, 1>;
  using Light = Eigen::Array4f;  // sample, white, field, background

  struct Cubic {
    Light c0, c1, c2, c3;  // in the offset from the node, 0 to 1
  };
  struct Film;

  /// The cubic that holds a reflectance, and how far into it.
  struct Piece {
    const Cubic& cubic;
    float t;
  };

  [[nodiscard]] Piece piece(int band, float place) const;  // place: reflectance in intervals
  [[nodiscard]] Film mix(const BaseNumbers& bases, const Parts& parts) const;
  void fit(const spectra::RoomResponseSlope& room, const spectra::Grid& grid);

  int bands_;
  double largest_ = 0;  // reflectance of any base
  Saunderson surface_;
  appearance::Adopted adopted_;
  std::vector<Bands> absorption_, scattering_;  // per base
  std::vector<Cubic> cubics_;                   // band by band
  Eigen::ArrayX3f weights_;                     // colour matching functions, in lm W^-1 per band
};

}  // namespace paints
