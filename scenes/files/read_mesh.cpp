// Furniture from a mesh file.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "scenes/files/room_reader.h"
#include "scenes/models/obj_reader.h"
#include "scenes/shapes/mesh_body.h"

namespace scenes {

using Eigen::Vector3d;
using spectra::JsonNode;
using spectra::JsonObject;

namespace {

constexpr std::size_t kMostFaults = 20;

const std::array<std::string, 5> kUnits{"m", "cm", "mm", "ft", "in"};
constexpr std::array<double, 5> kMetres{1, 0.01, 0.001, 0.3048, 0.0254};
const std::array<std::string, 2> kUp{"z", "y"};

/// Polygons in the room; their parts are numbered as `materials`, in order of appearance.
std::vector<MeshPolygon> polygons_of(const ObjFile& file, double metres, bool y_up,
                                     const Vector3d& at_m, std::vector<std::string>& materials) {
  std::vector<MeshPolygon> polygons;
  for (const ObjFile::Face& face : file.faces) {
    const std::string material = face.material.empty() ? "unnamed" : face.material;
    const auto known = std::ranges::find(materials, material);
    MeshPolygon polygon{.outline = {}, .part = static_cast<int>(known - materials.begin())};
    if (known == materials.end()) materials.push_back(material);
    for (const int c : face.corners) {
      const Vector3d& p = file.corners[static_cast<std::size_t>(c)];
      polygon.outline.push_back(at_m + metres * (y_up ? Vector3d(p.x(), -p.z(), p.y()) : p));
    }
    polygons.push_back(std::move(polygon));
  }
  return polygons;
}

}  // namespace

std::optional<Body> RoomReader::read_mesh(const JsonNode& node, const std::string& name) {
  const JsonObject mesh = node.object({"file", "unit", "up", "at_m", "two_sided"});
  const std::string path = mesh.name("file");
  const auto unit_node = mesh.need("unit"), up_node = mesh.need("up");
  const int unit = unit_node ? unit_node->choice(kUnits) : -1,
            up = up_node ? up_node->choice(kUp) : -1;
  std::vector<double> at{0, 0, 0};
  if (mesh.has("at_m")) at = mesh.numbers("at_m", 3, kCoordinate_m);
  const auto two_sided = mesh.find("two_sided");
  if (two_sided && !two_sided->is(JsonNode::Kind::boolean)) {
    two_sided->fault("this is neither true nor false", "give true for a mesh that is not closed");
    return {};
  }
  if (path.empty() || unit < 0 || up < 0 || !vector3(at).allFinite()) return {};
  const JsonNode file_node = *mesh.find("file");
  try {
    const ObjFile file = read_obj(curves_.resolve(path));
    std::vector<std::string> materials;
    const MeshBody made = mesh_body(
        name,
        polygons_of(file, kMetres[static_cast<std::size_t>(unit)], up == 1, vector3(at), materials),
        two_sided && two_sided->truth());
    for (const std::vector<std::string>& notes : {file.notes, made.notes}) {
      for (const std::string& note : notes) room_.notes.push_back(path + ": " + note);
    }
    for (std::size_t k = 0; k < std::min(made.faults.size(), kMostFaults); ++k) {
      file_node.fault(made.faults[k],
                      "mend the model; if it is thin and open, set \"two_sided\": true");
    }
    if (made.faults.size() > kMostFaults) {
      file_node.fault(fmt::format("{} more faults", made.faults.size() - kMostFaults),
                      "mend the model");
    }
    if (materials.size() > 1) materials_[name] = materials;
    return made.faults.empty() ? std::optional(made.body) : std::nullopt;
  } catch (const spectra::FileError& error) {
    file_node.fault(error.what(), "give a path relative to the folder of this file");
  } catch (const spectra::InputError& error) {
    file_.add(error.faults());
    file_node.fault(fmt::format("{} is faulty", path), "mend that file");
  }
  return {};
}

}  // namespace scenes
