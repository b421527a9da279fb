#include "apps/studies/colour_methods.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "appearance/spectra/bilinear.h"
#include "appearance/spectra/display_colour.h"
#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/rgb_to_spectrum.h"
#include "apps/studies/band_groups.h"
#include "solver/rooms/room_colour.h"

namespace apps {
namespace {

using Eigen::ArrayXd, Eigen::MatrixXd, Eigen::Vector3d;
using spectra::Spectrum;

const scenes::Surface& surface_of(const ComparedRoom& compared, std::size_t viewed) {
  return compared.room.surfaces[static_cast<std::size_t>(compared.surfaces[viewed])];
}

spectra::Xyz xyz(const Vector3d& v) { return {.x = v[0], .y = v[1], .z = v[2]}; }

MethodColours solve_spectra(const ComparedRoom& compared) {
  const solver::RoomSolution solution =
      solver::solve_room(compared.room, compared.transport, compared.radiosity);
  MethodColours colours{.converged = solution.radiosity.converged};
  for (std::size_t k = 0; k < compared.surfaces.size(); ++k) {
    const scenes::Surface& surface = surface_of(compared, k);
    const ArrayXd sent =
        surface.exitance.values + surface.reflectance.values * solution.viewed[k].irradiance;
    colours.sent.push_back(spectra::absolute_xyz({.grid = compared.room.grid, .values = sent}));
  }
  return colours;
}

MethodColours solve_groups(const ComparedRoom& compared, int groups) {
  const auto& [room, transport, surfaces, radiosity] = compared;
  const MatrixXd mean = means_of_groups(room.grid.count, groups);
  const MatrixXd spread = (mean.array() > 0).cast<double>();
  const auto grouped = [&](const solver::Bands& bands) -> solver::Bands {
    return (bands.matrix() * mean).array();
  };
  std::vector<ArrayXd> rho;
  for (const scenes::Surface& surface : room.surfaces) {
    rho.emplace_back(mean.transpose() * surface.reflectance.values.matrix());
  }
  solver::Bands reflectance(transport.exchange.rows(), groups);
  for (int p = 0; p < transport.exchange.rows(); ++p) {
    reflectance.row(p) = rho[static_cast<std::size_t>(
        transport.mesh.surface[static_cast<std::size_t>(p % transport.mesh.size())])];
  }
  const solver::Lighting& light = transport.lightings.front();
  const solver::RadiositySolution solution = solver::solve_radiosity(
      transport.exchange, grouped(light.emission), grouped(light.direct), reflectance, radiosity);
  MethodColours colours{.converged = solution.converged};
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    const solver::ReceiverRow& row = transport.viewed[k].row;
    const ArrayXd arriving = solution.radiosity.matrix().transpose() * row.gather.weights +
                             mean.transpose() * row.direct.front().matrix();
    const ArrayXd shone = mean.transpose() * surface_of(compared, k).exitance.values.matrix();
    const ArrayXd sent = shone + rho[static_cast<std::size_t>(surfaces[k])] * arriving;
    colours.sent.push_back(
        spectra::absolute_xyz({.grid = room.grid, .values = spread * sent.matrix()}));
  }
  return colours;
}

MethodColours solve_model(const ComparedRoom& compared, const solver::ColourModel& model) {
  const solver::ColourSolution solution =
      solver::solve_room_colour(compared.room, compared.transport, model, compared.radiosity);
  MethodColours colours{
      .converged = solution.light.radiosity.converged,
      .negative_patches = std::max(solution.negative.irradiance, solution.negative.radiosity)};
  for (std::size_t k = 0; k < compared.surfaces.size(); ++k) {
    const Vector3d shone = spectra::rgb_of_light(model.space, surface_of(compared, k).exitance);
    const Vector3d arriving = solution.light.viewed[k].irradiance;
    const auto& reflection = solution.reflections[static_cast<std::size_t>(compared.surfaces[k])];
    colours.sent.push_back(xyz(solution.xyz_from_rgb * (shone + reflection * arriving)));
  }
  return colours;
}

/// All the light that enters the room.
ArrayXd lamp_light(const solver::RoomTransport& transport) {
  const solver::Lighting& light = transport.lightings.front();
  const int patches = transport.mesh.size();
  return ((light.emission + light.direct).topRows(patches).matrix().transpose() *
          transport.exchange.area_m2.head(patches).matrix())
      .array();
}

/// [Kolchin2001] eq. 6, the representative light being that of the room's lamps together.
solver::ColourModel diagonal_for_lamps(const ComparedRoom& compared) {
  const spectra::RgbSpace& srgb = spectra::rgb_space("srgb");
  const auto matching = spectra::rgb_matching(srgb, compared.room.grid);
  const ArrayXd light = lamp_light(compared.transport);
  solver::ColourModel model = solver::colour_model("display:diagonal");
  model.reflection = [matching, light](const Spectrum& reflectance) -> Eigen::Matrix3d {
    return spectra::object_diagonal(matching, reflectance.values, light).asDiagonal();
  };
  return model;
}

/// What makes a reflectance from the linear sRGB of a surface, or from its tristimulus values.
using Upsampling = std::function<spectra::Reconstruction(const Spectrum& surface)>;

MethodColours solve_reconstructed(const ComparedRoom& compared, const Upsampling& upsample) {
  constexpr double kAlmostAll = 1 - 1e-6;  // the solver takes no perfect reflector
  scenes::Room room = compared.room;
  std::vector<std::string> clipped, unreached;
  for (scenes::Surface& surface : room.surfaces) {
    const spectra::Reconstruction found = upsample(surface.reflectance);
    const ArrayXd& made = found.reflectance.values;
    if (!found.converged) unreached.push_back(surface.name);
    surface.reflectance.values = made.max(0).min(kAlmostAll);
    if ((made - surface.reflectance.values).abs().maxCoeff() > 1e-6) {
      clipped.push_back(surface.name);
    }
  }
  MethodColours colours =
      solve_spectra({room, compared.transport, compared.surfaces, compared.radiosity});
  if (!clipped.empty()) {
    colours.note = fmt::format("clipped to 0..1: {}", fmt::join(clipped, ", "));
  }
  if (!unreached.empty()) {
    colours.note += fmt::format("{}no spectrum has quite the colour of: {}",
                                clipped.empty() ? "" : "; ", fmt::join(unreached, ", "));
  }
  return colours;
}

const Spectrum& d65() {
  static const Spectrum light =
      spectra::light_on(spectra::kTransportGrid, spectra::illuminant("D65"));
  return light;
}

spectra::Reconstruction smits_of(const Spectrum& surface) {
  const spectra::RgbSpace& srgb = spectra::rgb_space("srgb");
  static const spectra::SmitsBasis basis = spectra::smits_basis(srgb, spectra::kTransportGrid);
  return {
      .reflectance = spectra::smits_reflectance(basis, spectra::rgb_of_reflectance(srgb, surface)),
      .converged = true};
}

/// Black and what else the search cannot reach comes as near as it got.
template <spectra::Reconstruction (*kReconstruct)(const spectra::RelativeXyz&, const Spectrum&)>
spectra::Reconstruction reconstruction_of(const Spectrum& surface) {
  if ((surface.values == 0).all()) return {.reflectance = surface, .converged = true};
  return kReconstruct(spectra::relative_xyz(surface, d65()), d65());
}

ColourMethod groups_method(int groups) {
  return {.name = fmt::format("spectral:{}", groups),
          .what = fmt::format("{} bands", groups),
          .solve = [groups](const ComparedRoom& room) { return solve_groups(room, groups); }};
}

ColourMethod model_method(const std::string& name, const std::string& what) {
  return {.name = name,
          .what = what,
          .solve = [model = solver::colour_model(name)](const ComparedRoom& room) {
            return solve_model(room, model);
          }};
}

ColourMethod upsampling_method(const std::string& name, const std::string& what,
                               Upsampling upsample) {
  return {.name = "reconstructed:" + name,
          .what = what,
          .solve = [upsample = std::move(upsample)](const ComparedRoom& room) {
            return solve_reconstructed(room, upsample);
          }};
}

}  // namespace

ColourMethod spectral_method() {
  return {.name = "spectral:31", .what = "31 bands", .solve = solve_spectra};
}

std::vector<ColourMethod> judged_methods() {
  std::vector<ColourMethod> methods{groups_method(9), groups_method(3)};
  for (const char* space : {"srgb", "bt2020", "acescg"}) {
    methods.push_back(model_method(fmt::format("rgb:{}", space), "classical RGB"));
  }
  for (const std::string& set : spectra::bilinear_set_names()) {
    methods.push_back(model_method("bilinear:" + set, "bilinear RGB"));
  }
  methods.push_back(model_method("display:spectral", "display matrices"));
  methods.push_back({.name = "display:lamps",
                     .what = "display factors, exact under the room's lamps",
                     .solve = [](const ComparedRoom& room) -> MethodColours {
                       try {
                         return solve_model(room, diagonal_for_lamps(room));
                       } catch (const std::invalid_argument& error) {
                         return {.sent = std::vector<spectra::Xyz>(room.surfaces.size()),
                                 .converged = false,
                                 .note = error.what()};
                       }
                     }});
  methods.push_back(upsampling_method("smoothest", "31 bands, smoothest reflectance of its sRGB",
                                      reconstruction_of<spectra::reconstruct_reflectance>));
  methods.push_back(upsampling_method("smits", "31 bands, Smits' mixture for its sRGB", smits_of));
  methods.push_back(upsampling_method("sigmoid", "31 bands, sigmoid of its sRGB",
                                      reconstruction_of<spectra::reconstruct_sigmoid>));
  return methods;
}

}  // namespace apps
