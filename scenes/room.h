#pragma once
#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "appearance/spectra/spectrum.h"
#include "appearance/spectra/viewed_light.h"
#include "scenes/geometry/outline.h"
#include "scenes/luminaires/luminaire.h"
#include "scenes/skies/glass.h"
#include "scenes/skies/weather_sky.h"

namespace scenes {

using spectra::Spectrum;

/// A planar frame: point = origin + u * along + v * up; the unit normal points into the room. Floor
/// and ceiling take x and y; slanting and upright faces run level along, and up.
struct Frame {
  Eigen::Vector3d origin_m = Eigen::Vector3d::Zero(), along = Eigen::Vector3d::UnitX(),
                  up = Eigen::Vector3d::UnitY(), normal = Eigen::Vector3d::UnitZ();
};

/// A plane face of what encloses the air. All of them close it.
struct ShellFace {
  int surface = 0;                  ///< into Room::surfaces
  Frame frame;                      ///< of a wall: from the foot of its first corner
  Outline outline;                  ///< simple
  std::vector<Outline> holes = {};  ///< within it, counter-clockwise as well
};

/// A window or a door: a convex part of a shell face.
struct Opening {
  std::string name;
  int face = 0;  ///< into Room::shell
  Outline outline;
  Spectrum transmittance;  ///< for sun and sky, 0..1, from every direction; or
  std::optional<Glass> glass = {};
};

/// A lamp flush with a shell face: a convex part of it, and patches of the mesh.
struct Panel {
  std::string name;
  int face = 0;  ///< into Room::shell
  Outline outline;
};

/// What hides: a convex polyhedron, or a plate, whose two faces look away from each other.
struct ConvexPart {
  std::vector<Eigen::Vector3d> corners;
  std::vector<std::vector<int>> faces;  ///< corners, counter-clockwise seen from outside
};

/// A piece of furniture.
struct Body {
  std::string name;
  std::vector<Outline> faces;          ///< all of its surface, plane and simple
  std::vector<ConvexPart> parts;       ///< that fill it, or plates on its faces
  std::vector<int> part_of_face = {};  ///< Surface::part of each face; empty: all 0
  bool two_sided = false;              ///< faces come in pairs that look away from each other
};

struct PointLight {
  std::string name;
  Eigen::Vector3d at_m;
  Spectrum spectral_flux;  ///< W nm^-1, into all directions alike
};

struct Sun {
  std::string name;
  double azimuth_deg = 0;  ///< clockwise from +y seen from above
  double altitude_deg = 0;
  Spectrum normal_irradiance;  ///< W m^-2 nm^-1 outside, perpendicular to the beam
};

/// A luminaire at its place: intensities by direction from a file, one spectrum for all of them.
struct PlacedLuminaire {
  std::string name;
  std::shared_ptr<const Luminaire> type;
  Eigen::Vector3d at_m;    ///< its photometric centre
  Eigen::Matrix3d axes;    ///< columns: its own x, y, z in the room
  Spectrum spectral_flux;  ///< W nm^-1, all of it
};

enum class SurfaceKind { floor, ceiling, wall, opening, panel, furniture };

/// Everything that reflects or shines by area. Order: floor, ceiling, walls, openings, panels,
/// furniture.
struct Surface {
  std::string name;
  SurfaceKind kind = SurfaceKind::floor;
  int index = 0;               ///< into openings, panels or furniture
  int part = 0;                ///< of furniture that has several surfaces
  Spectrum reflectance;        ///< 0 <= rho < 1
  Spectrum exitance;           ///< S, W m^-2 nm^-1; zero unless it is a lamp
  bool reconstructed = false;  ///< its reflectance was computed from a colour, not measured
};

/// A small surface whose irradiance is asked for.
struct Receiver {
  std::string name;
  Eigen::Vector3d at_m;    ///< in the air or on a surface
  Eigen::Vector3d normal;  ///< unit, into the air
};

/// An eye in the air, and what it looks at.
struct View {
  Eigen::Vector3d eye_m, look_at_m;
};

/// A place to take a picture from.
struct NamedView {
  std::string name;
  View view;
  double fov_deg = 0;  ///< horizontal field of view; 0: as the picture's maker chooses
};

/// The light that a swatch is looked at in.
struct SwatchLight {
  Spectrum irradiance;       ///< W m^-2 nm^-1
  double background_y = 20;  ///< Y_b
  spectra::Surround surround = spectra::Surround::average;
};

/// Where a swatch is held: in the standard condition, at the viewed point of the room as it is
/// painted now, or in a light of its own.
enum class SwatchPlace { standard, here, own };

/// The wished appearance: a reflectance seen on the swatch, or J, C, h under the standard
/// conditions.
struct TargetColour {
  std::string name;                                ///< for reports
  std::variant<Spectrum, Eigen::Vector3d> colour;  ///< reflectance, or J, C, h in degrees
  double angle_deg = 2;                            ///< of the swatch, for the size effect
  SwatchPlace seen = SwatchPlace::standard;
  SwatchLight own = {};  ///< where it is seen in one of its own
};

/// Surfaces that share one paint, and how it is to look.
struct PaintTask {
  std::string name;           ///< for reports
  std::vector<int> surfaces;  ///< into Room::surfaces
  std::string atlas;          ///< a name, or a path resolved against the room file's folder
  std::optional<TargetColour> target;  ///< needed for ranking only
  std::optional<View> view;            ///< of this group
  double weight = 1;                   ///< of its distance from the target, among the groups
  int top = 20;                        ///< paints that are listed
};

/// A light as the file lists it, and what it gives alone.
struct Light {
  std::string name;
  SurfaceKind kind = SurfaceKind::panel;  ///< panel or opening, if `index` says which
  int index = -1;                         ///< into panels or openings; -1: none of them
  int point = -1, sun = -1, luminaire = -1,
      sky = -1;       ///< into point_lights, suns, luminaires, skies
  Spectrum exitance;  ///< S of its surface, W m^-2 nm^-1
};

/// A lighting of the room: some of its lights, scaled.
struct Scenario {
  std::string name;
  double weight = 1;          ///< among the scenarios
  std::vector<double> scale;  ///< of each of Room::lights; 0: off
};

/// A room as the file describes it, checked: plain data on one grid.
struct Room {
  std::string name;
  spectra::Grid grid;
  double patch_m = 0;  ///< longest patch edge that the mesh aims at
  std::vector<ShellFace> shell;
  std::vector<Opening> openings;
  std::vector<Panel> panels;
  std::vector<Body> furniture;
  std::vector<Surface> surfaces;
  std::vector<PointLight> point_lights;
  std::vector<Sun> suns;
  std::vector<Sky> skies;                 ///< seen through all openings
  std::vector<WeatherSky> weather_skies;  ///< of which of them are hours of a weather file
  std::vector<PlacedLuminaire> luminaires;
  std::vector<Receiver> receivers;
  std::optional<View> view;
  std::vector<NamedView> views;  ///< for pictures, beside `view`
  spectra::ViewingChoices viewing;
  std::vector<PaintTask> paint;  ///< groups that are painted independently; none: empty
  std::vector<Light> lights;
  std::vector<Scenario> scenarios;  ///< none: all lights as they are
  spectra::Judgement judgement = spectra::Judgement::mean;
  std::vector<std::string> notes;  ///< what was assumed or converted, for the report
};

/// The room under the lights of a scenario alone.
[[nodiscard]] Room relit(const Room& room, const Scenario& scenario);

/// The group that a surface is painted with; -1: none.
[[nodiscard]] int paint_group(const Room& room, int surface);

/// -1 if there is none.
[[nodiscard]] int find_surface(const Room& room, std::string_view name);

}  // namespace scenes
