#pragma once
#include <Eigen/Core>
#include <vector>

#include "solver/bands.h"

namespace solver {

/// A linear reading of a solved room, sum_j b_j B_j + sum_j h_j H_j.
struct OutputRow {
  Eigen::VectorXd on_radiosity, on_irradiance;  ///< b, h: per row of ExchangeAreas
};

/// A room of which some patches are painted: those of a group alike, each group by itself.
struct PaintedPatches {
  std::vector<int> group;  ///< per row of ExchangeAreas; -1: its reflectance is fixed
  int groups = 1;          ///< 1 to 3
  Bands fixed;             ///< reflectances, row x band; read where group is -1
};

/// The lights that the room is reduced for, row x band each.
struct SourceLight {
  Bands emission, direct;  ///< S, D
};

}  // namespace solver
