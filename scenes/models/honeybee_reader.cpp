#include "scenes/models/honeybee_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "appearance/spectra/text/json_reader.h"
#include "scenes/models/honeybee_finishes.h"

namespace scenes {
namespace {

using Eigen::Vector3d;
using spectra::JsonNode;
using spectra::JsonObject;

constexpr std::size_t kMost = 200'000;
constexpr spectra::Limits kPlace{.least = -1e6, .most = 1e6};

const std::array<std::string, 5> kUnits{"Meters", "Millimeters", "Centimeters", "Feet", "Inches"};
constexpr std::array<double, 5> kMetres{1, 0.001, 0.01, 0.3048, 0.0254};

/// What is told of an object: its display name, else its identifier.
std::string name_of(const JsonObject& object) {
  const auto display = given(object, "display_name");
  return display ? display->text() : object.name("identifier");
}

std::vector<JsonNode> entries(const JsonObject& object, const char* key) {
  const auto node = given(object, key);
  return node ? node->list(0, kMost) : std::vector<JsonNode>{};
}

std::optional<JsonNode> radiance_of(const JsonObject& object) {
  const auto properties = given(object, "properties");
  return properties ? given(properties->any_object(), "radiance") : std::nullopt;
}

class HoneybeeReader {
 public:
  explicit HoneybeeReader(spectra::JsonFile& file)
      : file_(file), top_(file.root().any_object()), finishes_(radiance_of(top_), model_.notes) {}

  BuildingModel read() {
    const auto type = top_.need("type");
    if (type && type->text() != "Model") {
      type->fault("this is no Honeybee model", "give a file whose type is \"Model\"");
      file_.throw_faults();
    }
    model_.name = name_of(top_);
    read_units();
    for (const JsonNode& node : entries(top_, "rooms")) read_room(node);
    note_left_out();
    read_sensors();
    file_.throw_faults();
    return std::move(model_);
  }

 private:
  void read_units() {
    if (const auto units = given(top_, "units")) {
      const int unit = units->choice(kUnits);
      if (unit >= 0) metres_ = kMetres[static_cast<std::size_t>(unit)];
    }
    const auto tolerance = given(top_, "tolerance");
    const double stated = tolerance ? tolerance->number({.least = 0, .most = 1e3}) : 0;
    if (stated > 0) model_.tolerance_m = stated * metres_;
  }

  void read_room(const JsonNode& node) {
    const JsonObject room = node.any_object();
    ModelRoom& read = model_.rooms.emplace_back();
    read.identifier = room.name("identifier");
    read.name = name_of(room);
    set_.clear();
    if (const auto radiance = radiance_of(room)) {
      if (const auto set = given(radiance->any_object(), "modifier_set")) set_ = set->text();
    }
    for (const JsonNode& face : entries(room, "faces")) read_face(face, read);
    for (const JsonNode& shade : entries(room, "indoor_shades")) read_shade(shade, read);
    note_shades(room, "outdoor_shades", read.name);
  }

  void read_face(const JsonNode& node, ModelRoom& room) {
    static const std::array<std::string, 4> kKinds{"Wall", "Floor", "RoofCeiling", "AirBoundary"};
    static const std::array<const char*, 4> kSets{"wall_set", "floor_set", "roof_ceiling_set", ""};
    const JsonObject object = node.any_object();
    ModelFace face{.name = name_of(object)};
    const auto kind_node = object.need("face_type");
    const int kind = kind_node ? std::max(kind_node->choice(kKinds), 0) : 0;
    face.kind = static_cast<ModelFaceKind>(kind);
    read_polygon(object, face.outline, face.holes);
    const bool outdoors = read_boundary(object, face.neighbour);
    if (face.kind != ModelFaceKind::open) {
      const std::string part = std::string(kSets[static_cast<std::size_t>(kind)]) +
                               (outdoors ? "/exterior_modifier" : "/interior_modifier");
      face.finish = finishes_.of(radiance_of(object), set_, part);
    }
    for (const JsonNode& aperture : entries(object, "apertures")) {
      read_part(aperture, true, face, room);
    }
    for (const JsonNode& door : entries(object, "doors")) read_part(door, false, face, room);
    for (const JsonNode& shade : entries(object, "indoor_shades")) read_shade(shade, room);
    note_shades(object, "outdoor_shades", face.name);
    room.faces.push_back(std::move(face));
  }

  void read_part(const JsonNode& node, bool aperture, ModelFace& face, ModelRoom& room) {
    const JsonObject object = node.any_object();
    ModelPart part{.name = name_of(object)};
    read_polygon(object, part.outline, part.holes);
    part.outdoors = read_boundary(object, part.neighbour);
    const auto flag = [&](const char* key) {
      const auto value = given(object, key);
      return value && value->truth();
    };
    std::string role = part.outdoors ? "door_set/exterior_modifier" : "door_set/interior_modifier";
    if (!aperture && flag("is_glass")) {
      role =
          part.outdoors ? "door_set/exterior_glass_modifier" : "door_set/interior_glass_modifier";
    }
    if (aperture) {
      role = !part.outdoors                        ? "aperture_set/interior_modifier"
             : flag("is_operable")                 ? "aperture_set/operable_modifier"
             : face.kind == ModelFaceKind::ceiling ? "aperture_set/skylight_modifier"
                                                   : "aperture_set/window_modifier";
    }
    part.finish = finishes_.of(radiance_of(object), set_, role);
    for (const JsonNode& shade : entries(object, "indoor_shades")) read_shade(shade, room);
    note_shades(object, "outdoor_shades", part.name);
    face.parts.push_back(std::move(part));
  }

  void read_shade(const JsonNode& node, ModelRoom& room) {
    const JsonObject object = node.any_object();
    ModelSheet sheet{.name = name_of(object)};
    read_polygon(object, sheet.outline, sheet.holes);
    sheet.finish = finishes_.of(radiance_of(object), set_, "shade_set/interior_modifier");
    room.sheets.push_back(std::move(sheet));
  }

  /// @return outdoors; the room beyond a face inside
  static bool read_boundary(const JsonObject& object, std::string& neighbour) {
    const auto boundary = given(object, "boundary_condition");
    if (!boundary) return true;
    const JsonObject condition = boundary->any_object();
    const auto type = given(condition, "type");
    if (const auto others = given(condition, "boundary_condition_objects")) {
      const std::vector<JsonNode> names = others->list(1, 10);
      if (!names.empty()) neighbour = names.back().text();
    }
    return !type || type->text() == "Outdoors";
  }

  void read_polygon(const JsonObject& object, Outline& outline, std::vector<Outline>& holes) const {
    const auto node = object.need("geometry");
    if (!node) return;
    const JsonObject geometry = node->any_object();
    if (const auto boundary = geometry.need("boundary")) outline = read_ring(*boundary);
    for (const JsonNode& hole : entries(geometry, "holes")) holes.push_back(read_ring(hole));
  }

  [[nodiscard]] Outline read_ring(const JsonNode& node) const {
    Outline ring;
    for (const JsonNode& corner : node.list(3, kMost)) {
      const std::vector<double> p = corner.numbers(3, kPlace);
      ring.push_back(metres_ * Vector3d(p[0], p[1], p[2]));
    }
    return ring;
  }

  void note_shades(const JsonObject& object, const char* key, const std::string& name) {
    const std::size_t count = entries(object, key).size();
    if (count > 0) {
      model_.notes.push_back(
          fmt::format("{} shades outside of \"{}\" are not carried over", count, name));
    }
  }

  void note_left_out() {
    for (const char* key : {"orphaned_faces", "orphaned_shades", "orphaned_apertures",
                            "orphaned_doors", "shade_meshes"}) {
      const std::size_t count = entries(top_, key).size();
      if (count > 0) model_.notes.push_back(fmt::format("{} {} are not carried over", count, key));
    }
  }

  void read_sensors() {
    const auto radiance = radiance_of(top_);
    if (!radiance) return;
    for (const JsonNode& node : entries(radiance->any_object(), "sensor_grids")) {
      const JsonObject grid = node.any_object();
      const std::string name = name_of(grid);
      const auto room = given(grid, "room_identifier");
      int number = 0;
      for (const JsonNode& entry : entries(grid, "sensors")) {
        const JsonObject sensor = entry.any_object();
        const std::vector<double> p = sensor.numbers("pos", 3, kPlace),
                                  d = sensor.numbers("dir", 3, kPlace);
        model_.sensors.push_back({.name = fmt::format("{} {}", name, ++number),
                                  .at_m = metres_ * Vector3d(p[0], p[1], p[2]),
                                  .normal = {d[0], d[1], d[2]},
                                  .room = room ? room->text() : ""});
      }
    }
    const std::size_t views = entries(radiance->any_object(), "views").size();
    if (views > 0) model_.notes.push_back(fmt::format("{} views are not carried over", views));
  }

  spectra::JsonFile& file_;
  JsonObject top_;
  BuildingModel model_;
  HoneybeeFinishes finishes_;
  double metres_ = 1;  ///< a unit of the model
  std::string set_;    ///< modifier set of the room that is read
};

}  // namespace

BuildingModel read_honeybee(const std::string& path) {
  spectra::JsonFile file = spectra::read_json_file(path);
  return HoneybeeReader(file).read();
}

}  // namespace scenes
