#include "apps/reports/room_reports.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "appearance/spectra/alpha_opic.h"
#include "appearance/spectra/correlated_temperature.h"
#include "apps/reports/csv.h"

namespace apps {
namespace {

/// ",E400,E410,...,E700"
std::string band_names(const SolutionColumns& columns, char quantity) {
  std::string names;
  for (const std::string& name : columns.names) names += fmt::format(",{}{}", quantity, name);
  return names;
}

/// Nothing where there is no bound.
std::optional<double> finite(double bound) {
  return std::isfinite(bound) ? std::optional(bound) : std::nullopt;
}

constexpr const char* kColourNames =
    ",CCT_K,Duv,S_cone_EDI_lx,M_cone_EDI_lx,L_cone_EDI_lx,rhodopic_EDI_lx,melanopic_EDI_lx";

/// What the light is for lamps' people and for the receptors of the eye.
void colour_cells(CsvText& csv, const spectra::Spectrum& light) {
  const auto temperature =
      spectra::correlated_temperature(spectra::chromaticity(spectra::absolute_xyz(light)));
  csv.cell(temperature ? std::optional(temperature->cct_K) : std::nullopt);
  csv.cell(temperature ? std::optional(temperature->duv) : std::nullopt);
  for (const double lx : spectra::equivalent_daylight_lx(light)) csv.cell(lx);
}

void point_cells(CsvText& csv, const Eigen::Vector3d& point_m) {
  csv.cell(point_m.x()).cell(point_m.y()).cell(point_m.z());
}

}  // namespace

double illuminance_lx(const SolutionColumns& columns, const solver::ReceiverLight& light) {
  return (columns.lux * light.irradiance).sum();
}

std::string receivers_csv(const scenes::Room& room, const SolutionColumns& columns,
                          const solver::RoomSolution& solution) {
  const bool spectral = columns.names.size() == static_cast<std::size_t>(room.grid.count);
  CsvText csv("receiver,x_m,y_m,z_m,illuminance_lx" + band_names(columns, 'E') +
              ",solver_error_bound,mesh_error" + (spectral ? kColourNames : ""));
  for (std::size_t i = 0; i < room.receivers.size(); ++i) {
    const solver::ReceiverLight& light = solution.receivers[i];
    csv.cell(room.receivers[i].name);
    point_cells(csv, room.receivers[i].at_m);
    csv.cell(illuminance_lx(columns, light));
    for (const double band : light.irradiance) csv.cell(band);
    csv.cell(finite(light.solver_error_bound)).cell(light.mesh_error);
    if (spectral) colour_cells(csv, {room.grid, light.irradiance});
    csv.end_row();
  }
  return csv.take();
}

void write_patches_csv(const scenes::Room& room, const SolutionColumns& columns,
                       const PatchLight& light, const TextSink& sink) {
  constexpr int kRowsAtOnce = 1024;
  const scenes::PatchMesh& mesh = light.mesh;
  CsvText csv("patch,surface,x_m,y_m,z_m,area_m2" + band_names(columns, 'H') +
              band_names(columns, 'B') +
              (light.standard_error != nullptr ? ",standard_error" : ""));
  for (int patch = 0; patch < mesh.size(); ++patch) {
    const auto i = static_cast<std::size_t>(patch);
    csv.cell(patch).cell(room.surfaces[static_cast<std::size_t>(mesh.surface[i])].name);
    point_cells(csv, mesh.centre[i]);
    csv.cell(mesh.area_m2[i]);
    for (const double band : light.irradiance.row(patch)) csv.cell(band);
    for (const double band : light.radiosity.row(patch)) csv.cell(band);
    if (light.standard_error != nullptr) csv.cell((*light.standard_error)[patch]);
    csv.end_row();
    if (patch % kRowsAtOnce == kRowsAtOnce - 1) sink(csv.take());
  }
  sink(csv.take());
}

}  // namespace apps
