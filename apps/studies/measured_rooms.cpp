#include "apps/studies/measured_rooms.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "appearance/spectra/spectrum_file.h"
#include "appearance/spectra/text/csv_reader.h"
#include "appearance/viewing_conditions.h"
#include "scenes/files/room_json.h"
#include "solver/response/room_response.h"
#include "solver/rooms/lamp_white.h"
#include "solver/rooms/room_light.h"

namespace apps {
namespace {

using spectra::Spectrum;

/// Bands from kShapeFrom_nm up: the last of the grid.
int bands_compared(const spectra::Grid& grid) {
  return grid.count - static_cast<int>(std::ceil((kShapeFrom_nm - grid.first_nm) / grid.step_nm));
}

Spectrum reading(const spectra::SpectrumFile& file, const std::string& name) {
  for (const spectra::NamedSpectrum& s : file.set.entries) {
    if (s.name == name) return spectra::light_on(spectra::kTransportGrid, s.samples);
  }
  throw spectra::InputError({{.file = file.set.name,
                              .pointer = "",
                              .problem = "there is no row \"" + name + "\"",
                              .remedy = "take the file as it came"}});
}

/// Of the receivers, with bounces and without.
struct BoxLight {
  std::vector<Spectrum> all, direct;
};

BoxLight light_in_box(const scenes::Room& room, double patch_m) {
  const solver::RoomTransport t =
      solver::prepare_transport(room, {.patch_m = patch_m, .eye = false});
  const solver::RoomSolution solution = solver::solve_room(room, t);
  BoxLight light;
  for (std::size_t r = 0; r < room.receivers.size(); ++r) {
    light.all.push_back({room.grid, solution.receivers[r].irradiance});
    const Eigen::VectorXd direct =
        t.lightings.front().emission.matrix().transpose() * t.receivers[r].gather.weights;
    light.direct.push_back({room.grid, direct.array()});
  }
  return light;
}

double largest_difference(const Spectrum& coarse, const Spectrum& fine) {
  return ((coarse.values - fine.values).abs() / fine.values.maxCoeff()).maxCoeff();
}

struct WallColour {
  Spectrum reflectance;
  std::string group;
};

std::vector<WallColour> wall_colours(const std::string& path, const spectra::Grid& grid) {
  std::vector<WallColour> colours;
  for (const spectra::CsvRow& row : spectra::read_csv(path).rows) {
    const auto [set, entry] = spectra::find_paint(row.cells.at(1));
    colours.push_back(
        {.reflectance = spectra::reflectance_on(grid, entry->samples), .group = row.cells.at(2)});
  }
  return colours;
}

/// How much nearer a hue quadrature comes to another, the short way round.
bool moves_to(double hue, double from, double to) {
  const auto gap = [&](double h) { return std::abs(std::remainder(h - hue, 400)); };
  return gap(to) < gap(from);
}

/// Sums over the colours; the means are taken at the end.
struct Directions {
  SeenDirections seen;
  int yellowish = 0, reddish = 0, other = 0;

  void add(const std::string& group, const appearance::Correlates& swatch,
           const appearance::Correlates& room) {
    constexpr double kYellow = 100, kBluishRed = 375;  // hue quadrature
    const double change = room.chroma - swatch.chroma;
    ++seen.colours;
    seen.chroma += change;
    seen.lightness += room.lightness - swatch.lightness;
    seen.chroma_rises += change > 0 ? 1 : 0;
    const auto moved = [&](double hue) {
      return moves_to(hue, swatch.hue_quadrature, room.hue_quadrature) ? 1 : 0;
    };
    seen.to_bluish_red += moved(kBluishRed);
    if (group == "yellowish") {
      ++yellowish, seen.yellowish += change, seen.to_yellow += moved(kYellow);
      return;
    }
    ++seen.others;
    seen.others_rise += change > 0 ? 1 : 0;
    if (group == "reddish") {
      ++reddish, seen.reddish += change;
    } else {
      ++other, seen.other += change;
    }
  }

  [[nodiscard]] SeenDirections mean() const {
    SeenDirections m = seen;
    m.yellowish_colours = yellowish;
    m.chroma /= std::max(m.colours, 1), m.lightness /= std::max(m.colours, 1);
    m.yellowish /= std::max(yellowish, 1);
    m.reddish /= std::max(reddish, 1);
    m.other /= std::max(other, 1);
    return m;
  }
};

std::vector<spectra::ViewingChoices> all_choices() {
  std::vector<spectra::ViewingChoices> choices;
  for (const bool size : {false, true}) {
    for (const auto background : {spectra::Background::ring, spectra::Background::fixed}) {
      for (const double share : {1.0, 0.75, 0.5, 0.0}) {
        choices.push_back({.background = background,
                           .white_share = share,
                           .background_y = 20,
                           .size_effect = size});
      }
    }
  }
  return choices;
}

}  // namespace

ShapeError shape_error(const Spectrum& computed, const Spectrum& measured) {
  const spectra::Grid& grid = computed.grid;
  const int count = bands_compared(grid), first = grid.count - count;
  if (!(measured.grid == grid) || count <= 0 || first < 0) {
    throw std::invalid_argument("spectral shapes on different grids, or on one that ends too soon");
  }
  const Eigen::ArrayXd ratio = computed.values.tail(count) / measured.values.tail(count);
  if (!(ratio.isFinite().all() && (ratio > 0).all())) {
    throw std::invalid_argument("a spectral shape is not above 0");
  }
  const Eigen::ArrayXd error = ratio * (ratio.sum() / ratio.square().sum()) - 1;
  Eigen::Index at = 0;
  error.abs().maxCoeff(&at);
  return {.rms = std::sqrt(error.square().mean()),
          .worst = error[at],
          .worst_nm = grid.wavelength_nm(first + static_cast<int>(at))};
}

MeasuredBox compare_box(const std::string& folder) {
  const scenes::Room room = scenes::read_room(folder + "/stanford_box.json");
  const spectra::SpectrumFile file =
      spectra::read_spectrum_file(folder + "/stanford_box_light.csv", spectra::CurveKind::light);
  const Spectrum first = reading(file, "target first reading");
  const Spectrum second = reading(file, "target second reading");
  const Spectrum measured{room.grid, (first.values + second.values) / 2};
  const BoxLight light = light_in_box(room, room.patch_m);
  const BoxLight fine = light_in_box(room, room.patch_m / 2);
  const int count = bands_compared(room.grid);
  const Eigen::ArrayXd apart = first.values.tail(count) / second.values.tail(count) - 1;
  MeasuredBox box{.places = {},
                  .between_readings = shape_error(first, second).rms,
                  .between_amounts = std::sqrt(apart.square().mean())};
  for (std::size_t r = 0; r < room.receivers.size(); ++r) {
    box.places.push_back({.name = room.receivers[r].name,
                          .with_bounces = shape_error(light.all[r], measured),
                          .without = shape_error(light.direct[r], measured),
                          .mesh_error = largest_difference(light.all[r], fine.all[r])});
  }
  return box;
}

std::vector<SeenDirections> compare_rooms(const std::string& folder) {
  std::vector<SeenDirections> rows;
  for (const char* name : {"room_north", "room_south"}) {
    const scenes::Room room = scenes::read_room(folder + "/" + name + ".json");
    const std::vector<WallColour> colours = wall_colours(folder + "/room_colours.csv", room.grid);
    const solver::RoomTransport transport = solver::prepare_transport(room);
    const solver::ReducedViews views = solver::reduce_views(room, transport);
    const solver::RoomResponse response(views, 0, 0, {});
    for (const spectra::ViewingChoices& choices : all_choices()) {
      Directions directions{.seen = {.room = name, .choices = choices}};
      for (const WallColour& colour : colours) {
        const spectra::ViewedLight light = response.light(colour.reflectance);
        directions.add(colour.group, appearance::on_swatch(colour.reflectance).correlates,
                       appearance::seen(appearance::view_of_room(light, choices)));
      }
      rows.push_back(directions.mean());
    }
  }
  return rows;
}

}  // namespace apps
