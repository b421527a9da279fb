#pragma once
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "scenes/room.h"

namespace solver {

/// Coefficients c_m of tests/support/box_reference.cpp, per receiver.
inline std::map<std::string, std::vector<double>> box_reference(const std::string& wanted) {
  std::map<std::string, std::vector<double>> series;
  std::ifstream file(TEST_DATA "/box_reference.csv");
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::string receiver, kind, m, coefficient;
    std::getline(cells, receiver, ',');
    std::getline(cells, kind, ',');
    std::getline(cells, m, ',');
    std::getline(cells, coefficient, ',');
    if (kind == wanted) series[receiver].push_back(std::stod(coefficient));
  }
  return series;
}

/// Irradiance at the receivers of the box with painted walls.
inline std::map<std::string, Eigen::ArrayXd> salmon_box(const scenes::Room& room) {
  const Eigen::ArrayXd wall = room.surfaces[2].reflectance.values;
  std::map<std::string, Eigen::ArrayXd> exact;
  for (const auto& [receiver, c] : box_reference("walls")) {
    Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(wall.size());
    Eigen::ArrayXd power = Eigen::ArrayXd::Ones(wall.size());
    for (const double coefficient : c) {
      sum += coefficient * power;
      power *= wall;
    }
    exact[receiver] = room.surfaces.back().exitance.values * sum;
  }
  return exact;
}

}  // namespace solver
