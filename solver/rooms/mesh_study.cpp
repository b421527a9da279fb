#include "solver/rooms/mesh_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace solver {
namespace {

constexpr double kOrder2 = 1.0 / 3;  ///< (E_h - E) / (E_2h - E_h) where E_h - E ~ h^2
/// By what the error falls at least from patches twice as long.
constexpr double kConstantGain = 2, kLinearGain = 3;
constexpr double kFirstPatches = 200;  ///< of the first mesh that is tried, about
constexpr int kMostSteps = 12;
constexpr double kShareOfSolver = 0.01;
/// The usual rays leave less than a quarter of this at a point, in all sample rooms; and their
/// multiple that is never exceeded.
constexpr double kFewRays = 2e-3, kMostRays = 64;

/// All points of a solution.
std::vector<ReceiverLight*> points_of(RoomSolution& solution) {
  std::vector<ReceiverLight*> points;
  for (auto* some : {&solution.receivers, &solution.viewed}) {
    for (ReceiverLight& p : *some) points.push_back(&p);
  }
  return points;
}

/// A point on meshes of h, 2 h and 4 h.
void compare(ReceiverLight& h, const ReceiverLight& h2, const ReceiverLight& h4, Light light,
             bool extrapolate) {
  const Eigen::ArrayXd step = h.irradiance - h2.irradiance, before = h2.irradiance - h4.irradiance;
  const double strongest = h.irradiance.maxCoeff();
  const double told = left_by_mesh(step.abs().maxCoeff(), before.abs().maxCoeff(), light);
  h.mesh_error = strongest > 0 ? told / strongest : 0;
  if (extrapolate) h.irradiance = (h.irradiance + kOrder2 * step).max(0.0);
}

PointErrors largest_errors(RoomSolution& solution) {
  PointErrors worst;
  for (const ReceiverLight* p : points_of(solution)) {
    worst.mesh = std::max(worst.mesh, p->mesh_error.value_or(1));
    worst.solver = std::max(worst.solver, p->solver_error_bound);
  }
  return worst;
}

/// The patch size of a mesh of about so many patches.
double patch_m_for(const scenes::Room& room, double patches) {
  constexpr double kWhole_m = 1e9;  // faces stay whole
  double area_m2 = 0;
  for (const double a : scenes::mesh_room(room, kWhole_m).area_m2) area_m2 += a;
  return std::sqrt(area_m2 / patches);
}

/// Patches as long as `left` asks for where the error falls as h^1.5, with linear light as h^2.5.
double next_patch_m(double patch_m, Light light, const PointErrors& error, double left) {
  const double order = light == Light::linear ? 2.5 : 1.5;
  return patch_m * std::clamp(0.9 * std::pow(left / error.mesh, 1 / order), 0.6, 0.8);
}

}  // namespace

double left_by_mesh(double step, double before, Light light) {
  const double gain = light == Light::linear ? kLinearGain : kConstantGain;
  return std::max(std::abs(step), std::abs(before) / gain) / (gain - 1);
}

bool study_mesh(const scenes::Room& room, const TransportOptions& transport,
                const RadiosityOptions& radiosity, double patch_m, bool extrapolate,
                RoomSolution& solution) {
  const auto solved_with = [&](double factor) {
    TransportOptions longer = transport;
    longer.patch_m = factor * patch_m;
    longer.eye = false;
    return solve_room(room, prepare_transport(room, longer), radiosity,
                      {.lighting = solution.lighting});
  };
  RoomSolution twice = solved_with(2), four_times = solved_with(4);
  if (twice.radiosity.irradiance.rows() == solution.radiosity.irradiance.rows()) return false;
  const auto h = points_of(solution), h2 = points_of(twice), h4 = points_of(four_times);
  for (std::size_t k = 0; k < h.size(); ++k)
    compare(*h[k], *h2[k], *h4[k], transport.light, extrapolate);
  return true;
}

ToleranceSolution solve_to_tolerance(const scenes::Room& room, double tolerance,
                                     TransportOptions transport, RadiosityOptions radiosity) {
  if (!(tolerance > 0 && tolerance < 1)) {
    throw std::invalid_argument(fmt::format("tolerance {}; want more than 0, below 1", tolerance));
  }
  ToleranceSolution best;
  best.relative_error = radiosity.relative_error = kShareOfSolver * tolerance;
  const double more = std::clamp(kFewRays / tolerance, 1.0, kMostRays);
  best.rays = transport.rays = static_cast<int>(more * transport.rays);
  transport.lamp_rays = static_cast<int>(more * transport.lamp_rays);
  transport.patch_m = patch_m_for(room, kFirstPatches);
  for (int step = 0; step < kMostSteps && !best.reached; ++step) {
    try {
      best.transport = {};  // two of them need not fit
      best.transport = prepare_transport(room, transport);
    } catch (const TooLarge&) {
      if (best.steps.empty()) throw;
    }
    const bool too_many = best.transport.mesh.size() == 0 || best.transport.plan.fine.patch_m > 0;
    if (too_many && !best.steps.empty()) {
      transport.patch_m = best.steps.back().patch_m;
      best.transport = prepare_transport(room, transport);
      return best;
    }
    best.solution = solve_room(room, best.transport, radiosity);
    study_mesh(room, transport, radiosity, transport.patch_m, false, best.solution);
    const PointErrors error = largest_errors(best.solution);
    best.steps.push_back({transport.patch_m, best.transport.mesh.size(), error});
    best.reached = best.solution.radiosity.converged && error.sum() <= tolerance;
    const double left = tolerance - error.solver;
    transport.patch_m =
        next_patch_m(transport.patch_m, transport.light, error, std::max(left, 0.1 * tolerance));
  }
  return best;
}

}  // namespace solver
