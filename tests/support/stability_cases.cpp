#include "tests/support/stability_cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "appearance/spectra/text/input_error.h"
#include "tests/support/stability_rooms.h"

namespace stability {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

constexpr double kRefused = std::numeric_limits<double>::infinity();

double relative(double value, double truth) { return std::abs(value / truth - 1); }

/// From an element to a parallel rectangle a x b at height 1 above it, one of whose corners is on
/// its normal [Howell2010].
double corner_factor(double a, double b) {
  const double x = std::sqrt(1 + a * a), y = std::sqrt(1 + b * b);
  return (a / x * std::atan(b / x) + b / y * std::atan(a / y)) / (2 * pi);
}

struct Rectangle {
  double x0, x1, y0, y1;
};

/// From a floor element at (x, y) to a rectangle in the ceiling.
double ceiling_factor(double x, double y, const Rectangle& r, double height_m) {
  const auto corner = [&](double dx, double dy) {
    const double sign = dx * dy < 0 ? -1 : 1;
    return sign * corner_factor(std::abs(dx) / height_m, std::abs(dy) / height_m);
  };
  return corner(r.x1 - x, r.y1 - y) - corner(r.x0 - x, r.y1 - y) - corner(r.x1 - x, r.y0 - y) +
         corner(r.x0 - x, r.y0 - y);
}

std::string receiver(const std::string& at_m, const std::string& normal) {
  return R"({"name": "at )" + at_m + normal + R"(", "at_m": )" + at_m + R"(, "normal": )" + normal +
         "}";
}

/// A panel of 1 mm at 1e-6 m from the wall cuts the floor of a hall into strips; the ceiling is one
/// patch of 100 m^2 that shines.
double tiny_and_huge_patches() {
  const BoxSize hall{.x_m = 10, .y_m = 10, .z_m = 3};
  const scenes::Room room = room_of(box_members(hall, 20, 0) + R"(, "lights": [
        { "name": "dot", "panel": { "on": "floor", "center_m": [0.000501, 2], "size_m": [0.001, 0.001] },
          "exitance_W_m2_nm": { "nm": [400, 700], "values": [1, 1] } },
        { "name": "sky", "panel": { "on": "ceiling", "center_m": [5, 5], "size_m": [10, 10] },
          "exitance_W_m2_nm": { "nm": [400, 700], "values": [1, 1] } } ])");
  const Solved black = solve(room);
  const scenes::PatchMesh& mesh = black.transport.mesh;
  double worst = 0, smallest_m2 = 1, largest_m2 = 0;
  for (std::size_t p = 0; p < mesh.area_m2.size(); ++p) {
    smallest_m2 = std::min(smallest_m2, mesh.area_m2[p]);
    largest_m2 = std::max(largest_m2, mesh.area_m2[p]);
    if (mesh.area_m2[p] > 1.5e-6 || mesh.normal[p].z() < 0.5) continue;
    const Vector3d& at = mesh.centre[p];
    const double truth = ceiling_factor(at.x(), at.y(), {0, 10, 0, 10}, 3);
    worst = std::max(worst, relative(black.irradiance()[static_cast<Eigen::Index>(p)], truth));
  }
  if (!(smallest_m2 < 1.1e-9 && largest_m2 > 99)) return kRefused;
  return std::max(worst, furnace_error(room));
}

const std::string kTwoReceivers = R"(, "receivers": [)" + receiver("[5, 2, 1.35]", "[-1, 0, 0]") +
                                  ", " + receiver("[3.5, 1, 0]", "[0, 0, 1]") + "]";
const std::string kLampInTheEast =
    panel_member(R"({"on": "ceiling", "center_m": [3.5, 2], "size_m": [1, 1]})");

/// Two cupboards from wall to wall and floor to ceiling fill the western 2 m of a box: against the
/// box without them, in whole faces, which are the same. Furnace too, with the slot between them.
double cupboards(const std::string& slot_m, bool furnace) {
  const auto surfaces = [](const std::string& patch_m) {
    return R"(, "height_m": 2.7, "patch_m": )" + patch_m +
           R"(, "surfaces": { "floor": 0.6, "ceiling": 0.9, "walls": 0.8)";
  };
  const auto filled = [&](const std::string& patch_m) {
    return room_of(R"("plan_m": [[0, 0], [5, 0], [5, 4], [0, 4]])" + surfaces(patch_m) +
                   R"(, "a": 0.8, "b": 0.8 }, "furniture": [
         { "name": "a", "box_m": { "min": [0, 0, 0], "max": [1, 4, 2.7] } },
         { "name": "b", "box_m": { "min": [)" +
                   slot_m + R"(, 0, 0], "max": [2, 4, 2.7] } } ], )" + kLampInTheEast +
                   kTwoReceivers);
  };
  // Constant light, whose patches know nothing of what stands beside them.
  const auto in_whole_faces = [](const scenes::Room& room) {
    return solve(room, 1e-9, solver::Light::constant);
  };
  const Solved bare =
      in_whole_faces(room_of(R"("plan_m": [[2, 0], [5, 0], [5, 4], [2, 4]])" + surfaces("5") +
                             "}, " + kLampInTheEast + kTwoReceivers));
  const Solved with_cupboards = in_whole_faces(filled("5"));
  double worst = furnace ? furnace_error(filled("0.5")) : 0;
  for (std::size_t k = 0; k < 2; ++k) {
    worst = std::max(worst, relative(with_cupboards.at_receiver(k), bare.at_receiver(k)));
  }
  return worst;
}

double touching_furniture() { return cupboards("1", true); }

double furniture_with_a_slot() { return cupboards("1.000001", true); }

/// Two boxes on the floor with a slot that is open at three sides; light does enter it.
double open_slot() {
  const scenes::Room room = room_of(
      R"("plan_m": [[0, 0], [5, 0], [5, 4], [0, 4]], "height_m": 2.7, "patch_m": 0.6,
         "surfaces": { "floor": 0.6, "ceiling": 0.9, "walls": 0.8, "a": 0.7, "b": 0.7 },
         "furniture": [ { "name": "a", "box_m": { "min": [1, 1, 0], "max": [2, 3, 1] } },
                        { "name": "b", "box_m": { "min": [2.000001, 1, 0], "max": [3, 3, 1] } } ], )" +
      kLampInTheEast + kTwoReceivers);
  return std::max(furnace_error(room), mean_light_error(solve(uniform(room, 0.99)), 0.99));
}

/// A lamp 10 m long and 1 mm wide over a floor of one patch, against the line source integrated
/// over the floor; a board 1 mm thick and 9 m long that stands askew, in a furnace.
double needles() {
  const BoxSize hall{.x_m = 10, .y_m = 3, .z_m = 3};
  const std::string lamp =
      panel_member(R"({"on": "ceiling", "center_m": [5, 1.5], "size_m": [10, 0.001]})");
  const Solved black = solve(room_of(box_members(hall, 20, 0) + ", " + lamp));
  const auto line = [&](double x, double y) {  // irradiance at a floor point
    const double d2 = hall.z_m * hall.z_m + (y - 1.5) * (y - 1.5), d = std::sqrt(d2);
    const auto end = [d](double s) { return s * d / (s * s + d * d) + std::atan(s / d); };
    return 0.001 * hall.z_m * hall.z_m / (2 * pi * d2 * d) * (end(hall.x_m - x) + end(x));
  };
  constexpr int kSteps = 300;
  double mean = 0;
  for (int i = 0; i < kSteps; ++i) {
    for (int k = 0; k < kSteps; ++k) {
      mean += line(hall.x_m * (i + 0.5) / kSteps, hall.y_m * (k + 0.5) / kSteps) / kSteps / kSteps;
    }
  }
  const scenes::Room board = room_of(
      R"("plan_m": [[0, 0], [10, 0], [10, 3], [0, 3]], "height_m": 3, "patch_m": 20,
         "surfaces": { "floor": 0.6, "ceiling": 0.9, "walls": 0.8, "board": 0.7 },
         "furniture": [ { "name": "board", "rotate_z_deg": 7,
                          "box_m": { "min": [0.5, 1.5, 0], "max": [9.5, 1.5010001, 1] } } ], )" +
      lamp);
  return std::max(relative(black.irradiance()[0], mean), furnace_error(board));
}

/// A_i F_ij summed over all pairs of two surfaces, m^2.
double exchange_of_surfaces(const scenes::Room& room, double patch_m, int from, int to) {
  const solver::RoomTransport t = solver::prepare_transport(room, {.patch_m = patch_m});
  double sum = 0;
  for (int i = 0; i < t.mesh.size(); ++i) {
    if (t.mesh.surface[static_cast<std::size_t>(i)] != from) continue;
    for (int j = 0; j < t.mesh.size(); ++j) {
      if (t.mesh.surface[static_cast<std::size_t>(j)] != to) continue;
      sum += t.exchange.area_m2[i] * t.exchange.form_factor(i, j);
    }
  }
  return sum;
}

/// Walls that meet at 1 degree: crossed strings [Howell2010] where they are 1 km high,
/// whose end effect is below 4e-5; in a room of usual height the furnace.
double sharp_corner() {
  const double opposite_m = 5 * std::tan(pi / 180), slant_m = std::hypot(5, opposite_m);
  const auto wedge = [&](double height_m) {
    return room_of(
        fmt::format(R"("plan_m": [[0, 0], [5, 0], [5, {}]], "height_m": {}, "patch_m": 0.5,
                       "surfaces": {{ "floor": 0.6, "ceiling": 0.9, "walls": 0.8 }}, )",
                    opposite_m, height_m) +
        panel_member(R"({"on": "wall_2", "center_m": [0.04, 1], "size_m": [0.05, 0.5]})"));
  };
  scenes::Room tall = wedge(1000);
  tall.panels.clear();
  tall.surfaces.pop_back();
  const double strings = 1000 * (5 + slant_m - opposite_m) / 2;
  const double wall_to_wall = exchange_of_surfaces(tall, 1000, 2, 4);
  const scenes::Room low = wedge(2.7);
  return std::max({relative(wall_to_wall, strings), furnace_error(low),
                   mean_light_error(solve(uniform(low, 0.999)), 0.999)});
}

/// Light in one band: as in white light there, and none elsewhere.
double monochrome() {
  scenes::Room room = uniform(box(), 0.9);
  const Solved white = solve(room);
  scenes::Surface& lamp = room.surfaces.back();
  const double exitance = lamp.exitance.values[15];
  lamp.exitance.values.setZero();
  lamp.exitance.values[15] = exitance;
  const Solved yellow = solve(room);
  const solver::Bands& one = yellow.solution.radiosity.irradiance;
  const auto& all = white.solution.radiosity.irradiance;
  const double elsewhere = one.leftCols(15).abs().sum() + one.rightCols(15).abs().sum();
  return elsewhere > 0 ? kRefused : (one.col(15) / all.col(15) - 1).abs().maxCoeff();
}

/// Nothing reflects: the panel's light alone, in closed form.
double all_black() {
  const Solved black =
      solve(room_of(box_members({}, 0.5, 0) + ", " +
                    panel_member(R"({"on": "ceiling", "center_m": [2.5, 2], "size_m": [1, 1]})") +
                    R"(, "receivers": [)" + receiver("[2.5, 2, 0]", "[0, 0, 1]") + ", " +
                    receiver("[0.3, 3.1, 0]", "[0, 0, 1]") + "]"));
  const Rectangle panel{2, 3, 1.5, 2.5};
  const double beside = relative(black.at_receiver(1), ceiling_factor(0.3, 3.1, panel, 2.7));
  return std::max(beside, relative(black.at_receiver(0), ceiling_factor(2.5, 2, panel, 2.7)));
}

/// 1 - rho = 1e-9, by the conservation law; a reflectance of 1 is refused.
double all_white() {
  constexpr double kAbsorbed = 1e-9;
  try {
    (void)room_of(box_members({}, 0.5, 1));
    return kRefused;
  } catch (const spectra::InputError&) {
  }
  return mean_light_error(solve(uniform(box(), 1 - kAbsorbed), 1e-4), 1 - kAbsorbed);
}

/// 31 bands from 1e-12 to 1e12 W m^-2 nm^-1 in one solve, against the same room at 1.
double faint_and_glaring() {
  const Eigen::ArrayXd exitance =
      Eigen::ArrayXd::LinSpaced(31, std::log(1e-12), std::log(1e12)).exp();
  const Eigen::ArrayXd nm = Eigen::ArrayXd::LinSpaced(31, 400, 700);
  const scenes::Room room =
      room_of(box_members({}, 0.5, 0.9) +
              fmt::format(R"(, "lights": [ {{ "name": "lamp", "panel": {{ "on": "ceiling",
        "center_m": [2.5, 2], "size_m": [1, 1], "reflectance": 0.9 }},
        "exitance_W_m2_nm": {{ "nm": [{}], "values": [{}] }} }} ])",
                          fmt::join(nm, ", "), fmt::join(exitance, ", ")));
  const Eigen::ArrayXd truth = solve(uniform(box(), 0.9)).irradiance();
  const Solved scaled = solve(room);
  double worst = 0;
  for (Eigen::Index k = 0; k < exitance.size(); ++k) {
    const Eigen::ArrayXd band =
        scaled.means(scaled.solution.radiosity.irradiance).col(k) / exitance[k];
    worst = std::max(worst, (band / truth - 1).abs().maxCoeff());
  }
  return worst;
}

/// A point lamp 1 mm from a wall: inverse squares on it, solid angles of its patches, and with
/// reflection the conservation law.
double lamp_close_to_a_wall() {
  const scenes::Room room = room_of(
      box_members({}, 0.5, 0) +
      R"(, "lights": [ { "name": "lamp", "point": { "at_m": [2.3, 0.001, 1.3] },
        "spectrum": { "illuminant": "E" }, "flux_lm": 1000 } ], "receivers": [)" +
      receiver("[2.305, 0, 1.3]", "[0, 1, 0]") + ", " + receiver("[2.5, 2, 0]", "[0, 0, 1]") + "]");
  const Solved black = solve(room);
  const double intensity = room.point_lights.front().spectral_flux.values[0] / (4 * pi);
  const auto inverse_square = [&](const Vector3d& at, double distance_m) {
    return intensity * distance_m / std::pow((Vector3d(2.3, 0.001, 1.3) - at).norm(), 3);
  };
  double worst = std::max(relative(black.at_receiver(0), inverse_square({2.305, 0, 1.3}, 0.001)),
                          relative(black.at_receiver(1), inverse_square({2.5, 2, 0}, 1.3)));
  const scenes::PatchMesh& mesh = black.transport.mesh;
  for (int p = 0; p < mesh.size(); ++p) {
    const auto i = static_cast<std::size_t>(p);
    if (mesh.normal[i].y() < 0.5) continue;  // the wall behind the lamp
    double angle = 0;                        // of the rectangle, by its corners
    for (const Vector3d& corner : mesh.polygon[i]) {
      const double a = corner.x() - 2.3, b = corner.z() - 1.3, h = 0.001;
      const Vector3d side = corner - mesh.centre[i];
      angle += std::copysign(1.0, side.x() * side.z()) *
               std::atan(a * b / (h * std::sqrt(a * a + b * b + h * h)));
    }
    worst = std::max(worst, relative(black.irradiance()[p] * mesh.area_m2[i], intensity * angle));
  }
  return std::max(worst, mean_light_error(solve(uniform(room, 0.9)), 0.9));
}

/// Receivers where a shining wall meets the floor, 1/2 of whose sky it fills; in the corner of a
/// second wall, 3/8 seen from their bisector; and in a furnace.
double receiver_on_an_edge() {
  const scenes::Room room = room_of(
      box_members({}, 0.5, 0) + ", " +
      panel_member(R"({"on": "wall_3", "center_m": [2.5, 1.35], "size_m": [5, 2.7]})") +
      R"(, "receivers": [)" + receiver("[1.7, 4, 0]", "[0, 0, 1]") + ", " +
      receiver("[0, 4, 0]", "[0, 0, 1]") + ", " + receiver("[0, 4, 1.2]", "[1, 0, 0]") + "]");
  const Solved black = solve(room);
  const double corner =
      std::max(relative(black.at_receiver(1), 0.375), relative(black.at_receiver(2), 0.5));
  return std::max({corner, relative(black.at_receiver(0), 0.5), furnace_error(room)});
}

}  // namespace

const std::vector<Case>& cases() {
  static const std::vector<Case> kCases{
      {.name = "patches from 1e-9 to 100 m^2",
       .danger = "closed forms are differences of terms as large as the larger face",
       .remedy = "below an area ratio of 1e-8: Gauss points on the small face, the exact contour "
                 "integral over the large one",
       .truth = "element and rectangle in closed form; white furnace",
       .limit = 1e-6,
       .error = tiny_and_huge_patches},
      {.name = "touching furniture",
       .danger = "faces that coincide see each other, rows do not close",
       .remedy = "cuts away on both sides what touches within 1e-9 m",
       .truth = "the room without what the furniture fills; white furnace",
       .limit = 1e-7,
       .error = touching_furniture},
      {.name = "furniture 1e-6 m apart",
       .danger = "a closed slot; patches that see nothing but each other",
       .remedy = "meshes the slot; patches that scaling cannot close see themselves a little",
       .truth = "the room without what the furniture fills; white furnace, in the slot too",
       .limit = 1e-5,
       .error = furniture_with_a_slot},
      {.name = "open slot 1e-6 m wide",
       .danger =
           "of two facing patches one sees a trace of the room by a lucky ray, the other none: "
           "no scaling closes both rows",
       .remedy = "such patches see themselves a little, which takes up the difference",
       .truth = "white furnace; mean light of a uniform room",
       .limit = 1e-6,
       .error = open_slot},
      {.name = "aspect ratio 1e4",
       .danger = "quadrature that takes a needle for a square; rays along a thin board",
       .remedy = "distances count in diameters; near pairs are in closed form or exact on one side",
       .truth = "line source over a floor, integrated; white furnace around an askew board",
       .limit = 1e-5,
       .error = needles},
      {.name = "corner of 1 degree",
       .danger = "walls that nearly face each other from 0 to 9 cm away; slivers in the tip",
       .remedy = "exact contour integrals, and rows that close",
       .truth = "crossed strings for walls 1 km high (end effect up to 4e-5); white furnace; mean "
                "light at 0.999",
       .limit = 1e-4,
       .error = sharp_corner},
      {.name = "monochrome light",
       .danger = "division by bands without light; light that leaks into them",
       .remedy = "solves lit bands only",
       .truth = "the same band of white light; exactly 0 elsewhere",
       .limit = 1e-12,
       .error = monochrome},
      {.name = "all black",
       .danger = "division by a reflectance of 0",
       .remedy = "takes irradiance from a gather, never from (B - S) / rho",
       .truth = "element and rectangle in closed form",
       .limit = 1e-12,
       .error = all_black},
      {.name = "all white",
       .danger = "light that does not fade: 1 - rho = 1e-9 multiplies every error by 1e9",
       .remedy = "rows that close to rounding, refinement in double, a bound with 1 / (1 - rho); "
                 "refuses a reflectance of 1",
       .truth = "mean light of a uniform room",
       .limit = 1e-6,
       .error = all_white},
      {.name = "1e-12 to 1e12 W m^-2 nm^-1",
       .danger = "floats overflow or lose faint bands beside glaring ones",
       .remedy = "scales each band to norm 1 before it rounds to float",
       .truth = "the same room at 1 W m^-2 nm^-1",
       .limit = 1e-12,
       .error = faint_and_glaring},
      {.name = "lamp 1 mm from a wall",
       .danger = "irradiance that changes a millionfold within a patch",
       .remedy = "solid angles of whole patches, inverse squares at receivers",
       .truth = "solid angle of a rectangle in closed form; inverse squares; mean light",
       .limit = 1e-8,
       .error = lamp_close_to_a_wall},
      {.name = "receiver on an edge",
       .danger = "it lies in the plane of a wall that fills half of its sky, and sees it edge-on",
       .remedy = "reads the limit from the air, 1e-7 m off the edge",
       .truth = "1/2 of a shining wall, 3/8 on the diagonal of its corner; white furnace",
       .limit = 1e-6,
       .error = receiver_on_an_edge},
  };
  return kCases;
}

}  // namespace stability
