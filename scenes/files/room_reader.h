#pragma once
#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "appearance/spectra/text/json_reader.h"
#include "scenes/files/curve_reader.h"
#include "scenes/geometry/fits.h"
#include "scenes/geometry/plane_polygon.h"
#include "scenes/room.h"
#include "scenes/shapes/enclosure.h"
#include "scenes/shapes/roof.h"
#include "scenes/skies/weather_sky.h"

namespace scenes {

/// Builds a Room from a file; one use. Numbers that could not be read are NaN, and checks are
/// written so that NaN passes them: one slip gives one fault.
class RoomReader {
 public:
  /// `file` must outlive the reader.
  RoomReader(spectra::JsonFile& file, const spectra::Grid& grid);

  /// @throws spectra::InputError  with every fault of the file
  [[nodiscard]] Room read();

 private:
  /// Where an entry stands in the file, for checks that come later.
  using Places = std::vector<spectra::JsonNode>;

  struct LightEntry {
    spectra::JsonObject light;
    spectra::JsonNode kind;  ///< the value of "panel", "opening", "point", "sun", "sky" or
                             ///< "luminaire"
    std::string name;
  };

  /// What a panel's light says about its surface.
  struct Lamp {
    Reflectance reflectance;
    spectra::Spectrum exitance;
  };

  /// The amounts that a kind of light takes, and the area that its flux is spread over.
  struct AmountRules {
    std::string_view kind;
    std::vector<std::string> keys;
    double area_m2 = 1;
  };

  /// A convex part of a shell face; no corners if it could not be read.
  struct FacePart {
    int face = -1;  ///< into Room::shell
    Outline outline;
    double area_m2 = NAN;
  };

  // read_plan.cpp
  void read_patch_size();
  void read_plan();
  void check_plan(const Places& corners);
  void read_wall_names();
  void read_shell();
  void set_shell(std::vector<ShellFace> shell);
  void read_ceiling(const spectra::JsonNode& node, std::vector<RoofPlane>& planes);
  void read_heights(const spectra::JsonNode& node, std::vector<RoofPlane>& planes);
  [[nodiscard]] RoofPlane read_roof_plane(const spectra::JsonNode& node);
  [[nodiscard]] static RoofPlane read_points_of_plane(const spectra::JsonObject& plane,
                                                      const spectra::JsonNode& points);
  void claim_name(const spectra::JsonNode& place, const std::string& name);
  void add_shell_surface(const std::string& name, SurfaceKind kind);
  /// -1 and a fault if there is no such wall; -1 without one if walls are not known.
  [[nodiscard]] int wall_named(const spectra::JsonNode& node) const;

  // read_faces.cpp
  void read_faces(const spectra::JsonNode& node);
  [[nodiscard]] std::optional<ShellFace> read_face(const spectra::JsonNode& node);
  void close_faces(std::vector<ShellFace> faces, const Places& places);

  // read_openings.cpp
  void read_openings();
  [[nodiscard]] FacePart read_part_of_wall(const spectra::JsonObject& opening);
  /// By `on`, `center_m` and `size_m`, or by `outline_m`.
  [[nodiscard]] FacePart read_part(const spectra::JsonObject& shape, const std::string& what);
  [[nodiscard]] FacePart read_rectangle(const spectra::JsonObject& shape, const std::string& what);
  [[nodiscard]] FacePart read_polygon(const spectra::JsonNode& outline, const std::string& what);
  [[nodiscard]] int face_under(int surface, const Eigen::Vector2d& point_m) const;
  [[nodiscard]] bool fits_on_face(const FacePart& part) const;
  /// Openings and panels that are there already.
  void check_overlap(const FacePart& part, const spectra::JsonNode& place,
                     const std::string& what) const;
  [[nodiscard]] Polygon flat(int face, const Outline& outline) const;

  // read_furniture.cpp
  void read_furniture();
  [[nodiscard]] std::optional<Body> read_body(const spectra::JsonObject& entry,
                                              const std::string& name);
  [[nodiscard]] std::optional<Body> read_box(const spectra::JsonObject& entry,
                                             const std::string& name);
  [[nodiscard]] std::optional<Eigen::Isometry3d> read_rotation(const spectra::JsonNode& node,
                                                               const Body& body);
  void check_body(std::size_t body) const;

  // read_mesh.cpp
  [[nodiscard]] std::optional<Body> read_mesh(const spectra::JsonNode& node,
                                              const std::string& name);
  void check_covered() const;

  // read_lights.cpp
  void read_lights();
  void read_light(const spectra::JsonObject& light);
  void read_panel(const LightEntry& entry);
  [[nodiscard]] int surface_named(const spectra::JsonNode& on) const;
  void read_lit_opening(const LightEntry& entry);
  void read_point(const LightEntry& entry);
  void read_sun(const LightEntry& entry);
  void check_sun(const Sun& sun, const spectra::JsonNode& place);
  [[nodiscard]] spectra::Spectrum emitted(const spectra::JsonObject& light,
                                          const AmountRules& rules);

  // read_daylight.cpp
  struct SunPlace {
    double azimuth_deg = 0;  ///< clockwise from +y
    double altitude_deg = 0;
    int day = 1;  ///< of the year
  };

  static constexpr const char *kNoSuchSky = "the Perez model has no sky for such weather",
                              *kMendWeather =
                                  "check both irradiances and the hour, or take a "
                                  "\"cie\" type";

  void read_north();
  /// Of a sun whose spectrum is not told.
  [[nodiscard]] spectra::Spectrum sun_spectrum() const;
  [[nodiscard]] std::optional<SunPlace> read_sun_place(const spectra::JsonNode& node);
  void add_sun_of_sky(const spectra::JsonNode& node, const std::string& sky, const SunPlace& place,
                      const spectra::Spectrum& beam);
  [[nodiscard]] std::optional<Glass> read_glass(const spectra::JsonNode& node);
  void read_sky(const LightEntry& entry);
  [[nodiscard]] static std::optional<Obstruction> read_obstruction(const spectra::JsonNode& node);
  [[nodiscard]] SkyColour read_sky_colour(const spectra::JsonObject& light, bool overcast,
                                          const spectra::JsonNode& place);
  [[nodiscard]] static std::optional<Weather> read_weather(const spectra::JsonObject& sky, int type,
                                                           int day);
  [[nodiscard]] double read_sky_amount(const LightEntry& entry, const spectra::JsonObject& sky,
                                       int type, const SkyPattern& pattern);
  [[nodiscard]] spectra::Spectrum read_beam(const LightEntry& entry, const spectra::JsonObject& sky,
                                            const SunPlace& place, double weather_lx);
  [[nodiscard]] Sky sky_of(const LightEntry& entry, const spectra::JsonObject& node, int type,
                           const SunPlace& place, double ground_reflectance);

  // read_weather.cpp
  [[nodiscard]] std::optional<SunPlace> read_weather_hour(const spectra::JsonNode& node);
  /// Null after a fault.
  [[nodiscard]] std::shared_ptr<const WeatherFile> weather_file(const spectra::JsonNode& node,
                                                                const std::string& path);
  [[nodiscard]] static std::optional<std::pair<int, int>> read_hours(const spectra::JsonObject& at,
                                                                     const WeatherFile& file);
  void read_weather_sky(const LightEntry& entry, const spectra::JsonObject& node,
                        const spectra::JsonNode& at, WeatherSky over);
  void add_weather_hour(const LightEntry& entry, const std::optional<spectra::JsonNode>& sun_node,
                        WeatherSky over, int hour, const std::string& name);

  // read_luminaire.cpp
  void read_luminaire_light(const LightEntry& entry);
  /// Null after a fault.
  [[nodiscard]] std::shared_ptr<const Luminaire> luminaire_file(const spectra::JsonNode& node,
                                                                const std::string& path);
  [[nodiscard]] spectra::Spectrum luminaire_flux(const LightEntry& entry,
                                                 const PlacedLuminaire& luminaire);
  void check_luminaire(const PlacedLuminaire& luminaire, const spectra::JsonNode& place);
  void note_flush(const PlacedLuminaire& luminaire, const spectra::JsonNode& place);

  // read_surfaces.cpp
  void read_surfaces();
  void add_surface(const std::string& name, SurfaceKind kind, std::size_t index = 0);
  void set_reflectance(Surface& surface, const spectra::JsonObject& given,
                       const std::optional<Reflectance>& walls);

  // read_task.cpp
  void read_receivers();
  void read_view();
  void read_named_views();
  void read_view_points(const spectra::JsonObject& view, std::optional<View>& into);
  void read_scenarios();
  void read_scenario(const spectra::JsonNode& node);
  void read_paint();
  void read_paint_group(const spectra::JsonNode& node);
  void read_painted(const spectra::JsonNode& node, PaintTask& task);
  void read_atlas(const spectra::JsonNode& node, PaintTask& task);
  /// Distance to the nearest surface; negative outside the room and within furniture.
  [[nodiscard]] double clearance_m(const Eigen::Vector3d& point_m) const;

  // read_seeing.cpp
  void read_viewing_choices(const spectra::JsonObject& view);
  void read_target(const spectra::JsonNode& node, PaintTask& task);
  /// @param correlates  the target is no swatch, but J, C, h
  void read_swatch(const spectra::JsonObject& swatch, bool correlates, TargetColour& target);
  [[nodiscard]] SwatchLight read_swatch_light(const spectra::JsonNode& node);

  spectra::JsonFile& file_;
  CurveReader curves_;
  spectra::JsonObject top_;
  Room room_;
  double north_deg_ = 0;      ///< clockwise from +y
  bool walls_known_ = false;  ///< their number, hence their names
  bool plan_sound_ = false;   ///< a simple counter-clockwise polygon
  bool shell_sound_ = false;  ///< Room::shell is there, closed
  bool lights_known_ = true;  ///< which openings are lit
  std::vector<std::string> wall_names_;
  std::vector<std::pair<std::string, SurfaceKind>> shell_surfaces_;  ///< as Room::surfaces begin
  std::vector<std::string> names_;  ///< taken by walls, openings, furniture, lights
  Polygon plan_m_;
  Enclosure enclosure_;
  Places opening_places_, body_places_;
  std::vector<double> opening_area_m2_;
  std::vector<char> body_read_;  ///< whether each of Room::furniture could be read
  std::map<std::string, std::vector<std::string>> materials_;       ///< of meshes that have several
  std::vector<std::optional<spectra::Spectrum>> opening_exitance_;  ///< of those that are lit
  std::map<std::string, std::shared_ptr<const Luminaire>> luminaire_files_;
  std::map<std::string, std::shared_ptr<const WeatherFile>> weather_files_;
  std::vector<int> dark_hours_;           ///< of the sky that is being read
  std::vector<std::string> hour_lights_;  ///< skies of several hours that shine: scenarios
  std::vector<Lamp> lamps_;               ///< as room_.panels
};

/// Lengths and places that a room can have, metres.
inline constexpr spectra::Limits kLength_m{.least = 1e-3, .most = 1e4};
/// 1 mm as the difference of two places, which rounds.
inline constexpr double kShortest_m = kLength_m.least - kTouch_m;
inline constexpr spectra::Limits kCoordinate_m{.least = -1e4, .most = 1e4};

inline Eigen::Vector3d vector3(const std::vector<double>& v) { return {v[0], v[1], v[2]}; }

}  // namespace scenes
