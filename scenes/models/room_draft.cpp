#include "scenes/models/room_draft.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <set>
#include <stdexcept>

#include "scenes/geometry/corner_weld.h"
#include "scenes/shapes/plates.h"

namespace scenes {
namespace {

using Eigen::Vector3d;

constexpr double kSliver_m2 = 1e-6;  ///< a piece of a window that is smaller is left out

/// The rooms that are asked for. @throws std::invalid_argument
std::vector<const ModelRoom*> choose(const BuildingModel& model,
                                     const std::vector<std::string>& names) {
  std::vector<std::string> known;
  for (const ModelRoom& room : model.rooms) known.push_back("\"" + room.name + "\"");
  const std::string list = fmt::format("its rooms are {}", fmt::join(known, ", "));
  if (model.rooms.empty()) throw std::invalid_argument("the model has no room");
  if (names.empty() && model.rooms.size() > 1) {
    throw std::invalid_argument("the model has several rooms; choose by --room: " + list);
  }
  if (names.empty()) return {&model.rooms.front()};
  std::vector<const ModelRoom*> chosen;
  for (const std::string& name : names) {
    const auto room = std::ranges::find_if(
        model.rooms, [&](const ModelRoom& r) { return r.identifier == name || r.name == name; });
    if (room == model.rooms.end()) {
      throw std::invalid_argument(fmt::format("the model has no room \"{}\"; {}", name, list));
    }
    if (std::ranges::find(chosen, &*room) == chosen.end()) chosen.push_back(&*room);
  }
  return chosen;
}

Polygon common(Polygon convex, const Polygon& other_convex) {
  for (std::size_t i = 0; i < other_convex.size() && !convex.empty(); ++i) {
    convex = clip(convex, edge_line(other_convex, i));
  }
  return without_collinear_corners(convex, 1e-9);
}

class Drafting {
 public:
  Drafting(const BuildingModel& model, std::vector<const ModelRoom*> rooms)
      : model_(model), rooms_(std::move(rooms)), corners_(model.tolerance_m) {
    draft_.notes = model.notes;
    names_ = {"walls"};
  }

  RoomDraft draft() {
    for (const ModelRoom* room : rooms_) {
      draft_.name += (draft_.name.empty() ? "" : " + ") + room->name;
      for (const ModelFace& face : room->faces) add_face(face, *room);
    }
    for (const ModelRoom* room : rooms_) {
      for (ModelSheet sheet : room->sheets) {
        sheet.name = unique(sheet.name);
        draft_.surfaces.push_back({sheet.name, sheet.finish});
        draft_.sheets.push_back(std::move(sheet));
      }
    }
    for (const ModelSensor& sensor : model_.sensors) {
      if (sensor.room.empty() || chosen(sensor.room)) draft_.sensors.push_back(sensor);
    }
    return std::move(draft_);
  }

 private:
  [[nodiscard]] bool chosen(const std::string& room) const {
    return std::ranges::any_of(
        rooms_, [&](const ModelRoom* r) { return r->identifier == room || r->name == room; });
  }

  std::string unique(const std::string& wished) {
    std::string name = wished;
    for (int k = 2; !names_.insert(name).second; ++k) name = fmt::format("{} {}", wished, k);
    return name;
  }

  void add_face(const ModelFace& face, const ModelRoom& room) {
    if (face.kind == ModelFaceKind::open) {
      if (chosen(face.neighbour)) return;
      throw std::invalid_argument(
          fmt::format("room \"{}\" is open to \"{}\" by \"{}\"; import both, with another --room",
                      room.name, face.neighbour, face.name));
    }
    RoomDraft::Face shell{.surface = unique(face.name), .outline = corners_.welded(face.outline)};
    for (const Outline& hole : face.holes) shell.holes.push_back(corners_.welded(hole));
    draft_.surfaces.push_back({shell.surface, face.finish});
    for (const ModelPart& part : face.parts) {
      const bool passage =
          !part.outdoors && part.finish.transmittance > 0 && chosen(part.neighbour);
      if (passage) {
        shell.holes.push_back(corners_.welded(part.outline));
        draft_.notes.push_back(fmt::format("\"{}\" between the rooms is taken as open", part.name));
      } else {
        add_part(part, shell);
      }
    }
    draft_.faces.push_back(std::move(shell));
  }

  /// The parts of it that lie on its face, as convex pieces.
  void add_part(const ModelPart& part, const RoomDraft::Face& face) {
    const PlaneCoordinates plane(face.outline);
    std::vector<Polygon> pieces;
    double kept_m2 = 0;
    for (const Outline& piece : convex_parts(part.outline, part.holes)) {
      for (const Outline& ground : convex_parts(face.outline, face.holes)) {
        Polygon cut = common(plane.flatten(piece), plane.flatten(ground));
        if (cut.size() < 3 || area(cut) < kSliver_m2) continue;
        kept_m2 += area(cut);
        pieces.push_back(std::move(cut));
      }
    }
    double whole_m2 = vector_area_m2(part.outline).norm();
    for (const Outline& hole : part.holes) whole_m2 -= vector_area_m2(hole).norm();
    if (kept_m2 < whole_m2 - kSliver_m2) {
      draft_.notes.push_back(fmt::format("{:.3g} m2 of \"{}\" are not on its face; left out",
                                         whole_m2 - kept_m2, part.name));
    }
    for (const Polygon& piece : pieces) {
      RoomDraft::Opening& opening = draft_.openings.emplace_back();
      opening.name = unique(part.name);
      opening.finish = part.finish;
      opening.lit = part.outdoors && part.finish.transmittance > 0;
      for (const Eigen::Vector2d& p : piece) opening.outline.push_back(plane.lift(p));
    }
    if (!part.outdoors && part.finish.transmittance > 0) {
      draft_.notes.push_back(fmt::format(
          "\"{}\" looks into a room that was not asked for; taken as black", part.name));
    }
  }

  const BuildingModel& model_;
  std::vector<const ModelRoom*> rooms_;
  CornerWeld corners_;
  RoomDraft draft_;
  std::set<std::string> names_;
};

}  // namespace

RoomDraft draft_room(const BuildingModel& model, const std::vector<std::string>& rooms) {
  return Drafting(model, choose(model, rooms)).draft();
}

}  // namespace scenes
