#pragma once
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "appearance/spectra/viewed_light.h"
#include "scenes/patch_mesh.h"
#include "scenes/room.h"
#include "solver/radiosity.h"

namespace solver {

struct TransportOptions {
  double patch_m = 0;  ///< 0: the room's own
  double visibility_error =
      1e-3;  ///< standard error aimed at for the visible share of lamps at receivers
  std::int64_t memory_limit_bytes = 0;  ///< 0: what the machine has free
};

/// What a scene does not need and is therefore left out, and why.
struct Omission {
  std::string what, why;
};

/// Made before anything is computed; it never changes a result beyond rounding.
struct Plan {
  int patches = 0;
  std::int64_t pairs = 0;             ///< of patches that can face each other
  std::int64_t occludable_pairs = 0;  ///< of those, pairs that something might stand between
  int bands = 0;                      ///< that carry light
  std::int64_t memory_bytes = 0;      ///< peak, estimated
  double expected_seconds = 0;        ///< of one core
  std::vector<Omission> left_out;
};

[[nodiscard]] Plan make_plan(const scenes::Room& room, const scenes::PatchMesh& mesh);

/// The memory that this process may still take, bytes.
[[nodiscard]] std::int64_t available_memory_bytes();

/// Thrown when a job cannot fit: exit code 3, with the size and the patch size that would fit.
class TooLarge : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Everything about a room that does not depend on reflectances: mesh, exchange areas, direct
/// light, and the rows that turn patch radiosities into what is asked for. Built once per geometry
/// and lighting.
struct RoomTransport {
  scenes::PatchMesh mesh;
  Plan plan;
  struct Data;
  std::shared_ptr<const Data> data;
  std::map<std::string, double> seconds;  ///< per stage: mesh, exchange, gather
  double closure_defect = 0;              ///< max_i |sum_j F_ij - 1|
  double reciprocity_defect = 0;          ///< max_ij |A_i F_ij - A_j F_ji| / A_i
  double largest_scaling = 0;             ///< max_i |d_i - 1|: how much closure had to mend
};

/// @throws TooLarge
[[nodiscard]] RoomTransport prepare_transport(const scenes::Room& room,
                                              const TransportOptions& options = {});

struct EnergyBalance {  ///< W nm^-1 per band
  Eigen::ArrayXd emitted, absorbed;
  double relative_defect = 0;  ///< |emitted - absorbed| summed over bands / emitted
};

struct ReceiverLight {
  Eigen::ArrayXd irradiance;      ///< W m^-2 nm^-1
  double solver_error_bound = 0;  ///< relative to the largest band; proven
  double visibility_error = 0;    ///< relative standard error of sampled visibility
};

struct RoomSolution {
  RadiositySolution radiosity;
  std::vector<ReceiverLight> receivers;  ///< in the order of Room::receivers
  EnergyBalance energy;
};

/// Surfaces in `room.paint->surfaces` take `paint` where it is given.
[[nodiscard]] RoomSolution solve_room(const scenes::Room& room, const RoomTransport& transport,
                                      const RadiosityOptions& options = {},
                                      const spectra::Spectrum* paint = nullptr);

/// The point that is looked at, where from, and on which surface. By default the free centre of the
/// longest painted wall, from 2 m away on its normal or half the room.
struct ViewedPoint {
  Eigen::Vector3d eye_m, point_m, normal;
  int surface = 0;
};

/// @throws std::invalid_argument  if the view ray meets nothing that is painted... or there is no
/// wall to view
[[nodiscard]] ViewedPoint viewed_point(const scenes::Room& room);

/// What the eye sees of a solved room. `sample_reflectance` is that of the viewed surface.
[[nodiscard]] spectra::ViewedLight viewed_light(const scenes::Room& room,
                                                const RoomTransport& transport,
                                                const RoomSolution& solution);

/// Full solve per paint: "reflectance -> light".
[[nodiscard]] spectra::RoomResponse full_solve_response(const scenes::Room& room,
                                                        const RoomTransport& transport,
                                                        const RadiosityOptions& options = {});

}  // namespace solver
