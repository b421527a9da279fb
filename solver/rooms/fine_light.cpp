#include "solver/rooms/fine_light.h"

#include <cmath>
#include <stdexcept>

#include "appearance/spectra/display_colour.h"
#include "solver/exchange/exchange.h"
#include "solver/sources/direct_light.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;

Bands first_shot(const scenes::Room& room, const scenes::PatchMesh& mesh) {
  if (room.point_lights.empty() && room.suns.empty() && room.luminaires.empty() &&
      room.skies.empty()) {
    return Bands::Zero(mesh.size(), room.grid.count);
  }
  return DirectSources(room, Visibility(room, mesh)).on_patches(mesh, facets_of(mesh)).irradiance;
}

Bands surface_emission(const scenes::Room& room) {
  Bands emission(static_cast<Index>(room.surfaces.size()), room.grid.count);
  for (Index s = 0; s < emission.rows(); ++s) {
    emission.row(s) = room.surfaces[static_cast<std::size_t>(s)].exitance.values.transpose();
  }
  return emission;
}

/// @param emission  surface x component
/// @param reflect  (surface, row of irradiance) -> what it reflects
template <typename Reflect>
FineLight gather(const scenes::Room& room, const RoomTransport& transport, const Bands& radiosity,
                 const Bands& emission, Bands direct, scenes::PatchMesh mesh,
                 const FineOptions& options, const Reflect& reflect) {
  const Index n = mesh.size();
  FineLight fine{.mesh = std::move(mesh), .rays_per_patch = options.rays};
  const auto at = [&](Index p) { return fine.mesh.area_m2[static_cast<std::size_t>(p)]; };
  const auto surface = [&](Index p) { return fine.mesh.surface[static_cast<std::size_t>(p)]; };
  fine.energy.emitted = fine.energy.absorbed = ArrayXd::Zero(emission.cols());
  for (Index p = 0; p < n; ++p) {
    fine.energy.emitted += at(p) * (emission.row(surface(p)) + direct.row(p)).transpose();
  }
  FineIrradiance light = gather_to_fine(room, transport.mesh, radiosity, emission, fine.mesh,
                                        std::move(direct), options);
  fine.irradiance = std::move(light.irradiance);
  fine.standard_error = std::move(light.standard_error);
  fine.lost_rays = light.lost_rays;
  fine.radiosity.resize(n, emission.cols());
  for (Index p = 0; p < n; ++p) {
    const ArrayXd arriving = fine.irradiance.row(p).transpose();
    const ArrayXd reflected = reflect(surface(p), arriving);
    fine.radiosity.row(p) = emission.row(surface(p)) + reflected.transpose();
    fine.energy.absorbed += at(p) * (arriving - reflected);
  }
  const double emitted = fine.energy.emitted.sum();
  if (emitted > 0) {
    fine.energy.relative_defect =
        (fine.energy.emitted - fine.energy.absorbed).abs().sum() / emitted;
  }
  fine.rms_standard_error = std::sqrt(fine.standard_error.square().mean());
  fine.largest_standard_error = fine.standard_error.maxCoeff();
  return fine;
}

scenes::PatchMesh fine_mesh(const scenes::Room& room, const RoomTransport& transport) {
  if (!(transport.plan.fine.patch_m > 0)) {
    throw std::invalid_argument("the patches that were asked for are those that were solved");
  }
  return scenes::mesh_room(room, transport.plan.fine.patch_m);
}

}  // namespace

FineLight fine_light(const scenes::Room& room, const RoomTransport& transport,
                     const RoomSolution& solution, const FineOptions& options) {
  scenes::PatchMesh mesh = fine_mesh(room, transport);
  Bands direct = first_shot(room, mesh);
  return gather(room, transport, solution.radiosity.radiosity, surface_emission(room),
                std::move(direct), std::move(mesh), options,
                [&](int surface, const ArrayXd& arriving) -> ArrayXd {
                  return solution.reflectances[static_cast<std::size_t>(surface)].values * arriving;
                });
}

FineLight fine_light(const scenes::Room& room, const RoomTransport& transport,
                     const ColourModel& model, const ColourSolution& solution,
                     const FineOptions& options) {
  const MatrixXd from_bands = spectra::rgb_matching(model.space, room.grid).transpose();
  scenes::PatchMesh mesh = fine_mesh(room, transport);
  const auto projected = [&](const Bands& spectral) -> Bands {
    return (spectral.matrix() * from_bands).array();
  };
  Bands direct = projected(first_shot(room, mesh));
  return gather(room, transport, solution.light.radiosity.radiosity,
                projected(surface_emission(room)), std::move(direct), std::move(mesh), options,
                [&](int surface, const ArrayXd& arriving) -> ArrayXd {
                  return solution.reflections[static_cast<std::size_t>(surface)] *
                         arriving.matrix();
                });
}

}  // namespace solver
