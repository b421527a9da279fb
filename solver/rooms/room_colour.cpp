#include "solver/rooms/room_colour.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "appearance/spectra/bilinear.h"
#include "appearance/spectra/display_colour.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Matrix3d;
using Eigen::Matrix3Xd;
using Eigen::Vector3d;
using spectra::Spectrum;

/// "a:b" -> "a" and "b"; nothing after the last colon.
std::pair<std::string_view, std::string_view> split(std::string_view text, char at) {
  const std::size_t colon = text.find(at);
  if (colon == std::string_view::npos) return {text, {}};
  return {text.substr(0, colon), text.substr(colon + 1)};
}

double number(std::string_view text) {
  double value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc() || stop != end) {
    throw std::invalid_argument(fmt::format("alpha \"{}\" is no number", text));
  }
  return value;
}

/// "alpha=r,g,b"
Vector3d alpha_of(std::string_view text) {
  const auto [key, values] = split(text, '=');
  const auto [r, rest] = split(values, ',');
  const auto [g, b] = split(rest, ',');
  if (key != "alpha") throw std::invalid_argument(fmt::format("\"{}\"; want alpha=r,g,b", text));
  return {number(r), number(g), number(b)};
}

ColourModel classical(const spectra::RgbSpace& space) {
  return {.name = "rgb:" + space.name,
          .space = space,
          .reflection = [space](const Spectrum& reflectance) -> Matrix3d {
            return spectra::rgb_of_reflectance(space, reflectance).asDiagonal();
          },
          .approximation =
              "light and reflectance are three numbers each, multiplied component by "
              "component: exact under the space's white"};
}

ColourModel bilinear(std::string_view options) {
  const auto [name, alpha] = split(options, ':');
  spectra::BilinearSet set = spectra::bilinear_set(name.empty() ? "granier-iso" : name);
  if (!alpha.empty()) set = spectra::with_alpha(set, alpha_of(alpha));
  const spectra::RgbSpace& space = spectra::rgb_space(set.space);
  return {.name = "bilinear:" + set.name,
          .space = space,
          .reflection = [space, set](const Spectrum& reflectance) -> Matrix3d {
            return spectra::reflection_matrix(set, spectra::rgb_of_reflectance(space, reflectance));
          },
          .approximation =
              "light and reflectance are three numbers each, multiplied by a bilinear "
              "product [Granier2004]: exact under the space's white; components may "
              "become negative"};
}

ColourModel display_from_spectra(const spectra::RgbSpace& space) {
  const auto conversion = spectra::least_squares_conversion(
      spectra::rgb_matching(space, spectra::kTransportGrid), spectra::room_lights_second_moment());
  return {.name = "display:spectral",
          .space = space,
          .reflection = [conversion](const Spectrum& reflectance) -> Matrix3d {
            return spectra::object_matrix(conversion, reflectance.values);
          },
          .approximation =
              "a surface is a matrix on the light's three numbers [Kolchin2001], "
              "fitted to its spectrum over lamps and lamps off papers"};
}

ColourModel display_from(const spectra::RgbSpace& space, const spectra::RgbSpace& reference) {
  const spectra::Grid& grid = spectra::kTransportGrid;
  const auto conversion = spectra::three_component_conversion(
      spectra::xyz_from_rgb_on(grid, space).inverse() * spectra::xyz_from_rgb_on(grid, reference));
  return {.name = "display:" + reference.name,
          .space = space,
          .reflection = [conversion, reference](const Spectrum& reflectance) -> Matrix3d {
            return spectra::object_matrix(conversion,
                                          spectra::rgb_of_reflectance(reference, reflectance));
          },
          .approximation =
              "a surface is the matrix on the display's three numbers that multiplies "
              "those of the reference space component by component [Kolchin2001]"};
}

ColourModel display_diagonal(const spectra::RgbSpace& space) {
  const Matrix3Xd matching = spectra::rgb_matching(space, spectra::kTransportGrid);
  const ArrayXd light = spectra::light_on(spectra::kTransportGrid, space.white).values;
  return {.name = "display:diagonal",
          .space = space,
          .reflection = [matching, light](const Spectrum& reflectance) -> Matrix3d {
            return spectra::object_diagonal(matching, reflectance.values, light).asDiagonal();
          },
          .approximation =
              "a surface is three factors on the display's three numbers, exact for "
              "the representative light D65 [Kolchin2001]"};
}

ColourModel display(std::string_view mode) {
  const spectra::RgbSpace& space = spectra::rgb_space("srgb");
  if (mode.empty() || mode == "spectral") return display_from_spectra(space);
  if (mode == "diagonal") return display_diagonal(space);
  if (mode == "reference-light") {
    throw std::invalid_argument(
        "display:reference-light takes light in the reference space and leaves it in the "
        "display's, where no surface can reflect it again: it is for direct light only and cannot "
        "be solved with interreflections");
  }
  for (const char* reference : {"xyz", "iso", "bt2020", "acescg"}) {
    if (mode == reference) return display_from(space, spectra::rgb_space(reference));
  }
  throw std::invalid_argument(fmt::format(
      "no display mode \"{}\"; there are spectral, xyz, iso, bt2020, acescg, diagonal", mode));
}

/// The same in every row where nothing crosses over, else matrices.
/// @param surface  per row
Reflector reflector_of(const std::vector<Matrix3d>& reflections, const std::vector<int>& surface) {
  for (const Matrix3d& m : reflections) {
    if (!m.isDiagonal(0)) return {reflections, surface};
  }
  Bands numbers(static_cast<Eigen::Index>(surface.size()), 3);
  for (std::size_t p = 0; p < surface.size(); ++p) {
    numbers.row(static_cast<Eigen::Index>(p)) =
        reflections[static_cast<std::size_t>(surface[p])].diagonal().transpose();
  }
  return Reflector(std::move(numbers));
}

/// Of the patches' means; slopes have either sign.
NegativeLight negative_light(const RadiositySolution& light, int patches) {
  constexpr double kNoise = 1e-6;  // of the brightest: what the solver may leave
  NegativeLight negative;
  const Bands irradiance = light.irradiance.topRows(patches);
  const Bands radiosity = light.radiosity.topRows(patches);
  const double brightest = std::max(irradiance.maxCoeff(), radiosity.maxCoeff());
  const auto count = [&](const Bands& b) {
    return static_cast<int>((b < -kNoise * brightest).rowwise().any().count());
  };
  negative.irradiance = count(irradiance);
  negative.radiosity = count(radiosity);
  if (negative.irradiance + negative.radiosity > 0) {
    negative.lowest = std::min(irradiance.minCoeff(), radiosity.minCoeff()) / brightest;
  }
  return negative;
}

}  // namespace

ColourModel colour_model(std::string_view name) {
  const auto [kind, options] = split(name, ':');
  if (kind == "rgb") return classical(spectra::rgb_space(options.empty() ? "srgb" : options));
  if (kind == "bilinear") return bilinear(options);
  if (kind == "display") return display(options);
  throw std::invalid_argument(fmt::format(
      "no colour \"{}\"; there are rgb[:SPACE], bilinear[:SET[:alpha=r,g,b]], display[:MODE]",
      name));
}

ColourSolution solve_room_colour(const scenes::Room& room, const RoomTransport& transport,
                                 const ColourModel& model, const RadiosityOptions& options) {
  const Matrix3Xd to_rgb = spectra::rgb_matching(model.space, room.grid);
  const auto projected = [&](const Bands& spectral) -> Bands {
    return (spectral.matrix() * to_rgb.transpose()).array();
  };
  const Lighting& all_lights = transport.lightings.front();
  const Bands emission = projected(all_lights.emission), direct = projected(all_lights.direct);
  ColourSolution solution{.light = {},
                          .xyz_from_rgb = spectra::xyz_from_rgb_on(room.grid, model.space),
                          .reflections = {},
                          .negative = {}};
  RoomSolution& light = solution.light;
  for (const scenes::Surface& surface : room.surfaces) {
    light.reflectances.push_back(surface.reflectance);
    solution.reflections.push_back(model.reflection(surface.reflectance));
  }
  std::vector<int> surface;  // of each row
  for (int mode = 0; mode < transport.exchange.modes; ++mode) {
    surface.insert(surface.end(), transport.mesh.surface.begin(), transport.mesh.surface.end());
  }
  light.radiosity = solve_radiosity(transport.exchange, emission, direct,
                                    reflector_of(solution.reflections, surface), options);
  const auto read = [&](const ReceiverRow& row) {
    return read_light(row.gather, to_rgb * row.direct.front().matrix(), light.radiosity);
  };
  for (const ReceiverRow& row : transport.receivers) light.receivers.push_back(read(row));
  for (const ViewedWall& wall : transport.viewed) light.viewed.push_back(read(wall.row));
  const Bands reflected = light.radiosity.radiosity - emission;
  light.energy = energy_balance(transport.exchange.area_m2.head(transport.mesh.size()),
                                emission + direct, light.radiosity.irradiance - reflected);
  solution.negative = negative_light(light.radiosity, transport.mesh.size());
  return solution;
}

ViewedColours viewed_colours(const scenes::Room& room, const RoomTransport& transport,
                             const ColourSolution& solution, std::size_t viewed) {
  const ViewedWall& wall = transport.viewed.at(viewed);
  const auto xyz = [&](const Vector3d& rgb) {
    const Vector3d v = solution.xyz_from_rgb * rgb;
    return spectra::Xyz{.x = v[0], .y = v[1], .z = v[2]};
  };
  const auto sum = [](const spectra::Xyz& a, const spectra::Xyz& b) {
    return spectra::Xyz{.x = a.x + b.x, .y = a.y + b.y, .z = a.z + b.z};
  };
  const auto seen = [&](const GatherRow& row, const ArrayXd& sky) {
    const Vector3d rgb =
        (row.weights.transpose() * solution.light.radiosity.radiosity.matrix()).transpose();
    return sum(xyz(rgb), spectra::absolute_xyz({room.grid, sky}));
  };
  const auto surface = static_cast<std::size_t>(wall.at.surface);
  const Vector3d arriving = solution.light.viewed[viewed].irradiance;
  const spectra::Xyz shone = spectra::absolute_xyz(room.surfaces[surface].exitance);
  const spectra::Xyz reflected = xyz(solution.reflections[surface] * arriving);
  return {.sample = sum(shone, reflected),
          .background = seen(wall.view.background, wall.sky.front().background),
          .field = seen(wall.view.field, wall.sky.front().field),
          .white = xyz(arriving)};
}

}  // namespace solver
