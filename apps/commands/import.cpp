#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "appearance/spectra/srgb_transfer.h"
#include "appearance/spectra/text/input_error.h"
#include "apps/commands/commands.h"
#include "apps/run/run_record.h"
#include "apps/system/output_files.h"
#include "apps/system/terminal.h"
#include "scenes/files/room_json.h"
#include "scenes/models/honeybee_reader.h"
#include "scenes/models/room_draft.h"

namespace apps {
namespace {

using Eigen::Vector3d;
using OrderedJson = nlohmann::ordered_json;

constexpr std::size_t kMostReceivers = 10'000;

OrderedJson json_of(const Vector3d& p) { return {p.x(), p.y(), p.z()}; }

OrderedJson json_of(const scenes::Outline& outline) {
  OrderedJson corners = OrderedJson::array();
  for (const Vector3d& p : outline) corners.push_back(json_of(p));
  return corners;
}

/// A grey as a number, else the sRGB of its linear r, g, b.
OrderedJson reflectance_of(const scenes::ModelFinish& finish) {
  const Eigen::Array3d& rgb = finish.reflectance;
  if (rgb.maxCoeff() - rgb.minCoeff() < 1e-9) return rgb[0];
  const Eigen::Array3d srgb = rgb.unaryExpr(&spectra::srgb_encoded);
  return {{"reconstruct_srgb", {srgb[0], srgb[1], srgb[2]}}};
}

OrderedJson shell_of(const scenes::RoomDraft& draft) {
  OrderedJson faces = OrderedJson::array();
  for (const scenes::RoomDraft::Face& face : draft.faces) {
    OrderedJson entry{{"surface", face.surface}, {"outline_m", json_of(face.outline)}};
    for (const scenes::Outline& hole : face.holes) entry["holes_m"].push_back(json_of(hole));
    faces.push_back(std::move(entry));
  }
  return faces;
}

/// Sheets have no holes: what has becomes several.
OrderedJson furniture_of(const scenes::RoomDraft& draft) {
  OrderedJson furniture = OrderedJson::array();
  for (const scenes::ModelSheet& sheet : draft.sheets) {
    furniture.push_back({{"name", sheet.name}, {"sheet", {{"outline_m", json_of(sheet.outline)}}}});
  }
  return furniture;
}

/// The room file, and what the user has to know of it.
OrderedJson room_of(const scenes::RoomDraft& draft, double sky_lx,
                    std::vector<std::string>& notes) {
  OrderedJson openings = OrderedJson::array(), lights = openings, receivers = openings;
  OrderedJson surfaces = OrderedJson::object();
  for (const auto& [name, finish] : draft.surfaces) surfaces[name] = reflectance_of(finish);
  for (const scenes::RoomDraft::Opening& opening : draft.openings) {
    openings.push_back({{"name", opening.name},
                        {"outline_m", json_of(opening.outline)},
                        {"transmittance", opening.finish.transmittance}});
    surfaces[opening.name] = reflectance_of(opening.finish);
    if (!opening.lit) continue;
    lights.push_back({{"name", "sky by " + opening.name},
                      {"opening", opening.name},
                      {"spectrum", {{"illuminant", "D65"}}},
                      {"illuminance_lx", sky_lx * opening.finish.transmittance}});
  }
  notes.push_back(lights.empty()
                      ? "there is no window and no lamp: add a light to \"lights\""
                      : fmt::format("the model has no lamps; each window shines as a diffuse D65 "
                                    "sky of {:g} lx times its transmittance: change \"lights\"",
                                    sky_lx));
  for (const scenes::ModelSensor& sensor : draft.sensors) {
    if (receivers.size() == kMostReceivers) {
      notes.push_back(fmt::format("{} sensors, of which the first {} are taken",
                                  draft.sensors.size(), kMostReceivers));
      break;
    }
    receivers.push_back({{"name", sensor.name},
                         {"at_m", json_of(sensor.at_m)},
                         {"normal", json_of(sensor.normal)}});
  }
  return {{"roomhue", 1},         {"name", draft.name},   {"faces", shell_of(draft)},
          {"patch_m", 0.3},       {"openings", openings}, {"furniture", furniture_of(draft)},
          {"surfaces", surfaces}, {"lights", lights},     {"receivers", receivers}};
}

/// A line for each entry of a list.
std::string text_of(const OrderedJson& room) {
  std::string text = "{";
  const char* comma = "\n";
  for (const auto& [key, value] : room.items()) {
    text += fmt::format("{}  {}: ", comma, OrderedJson(key).dump());
    comma = ",\n";
    if (!value.is_structured() || value.empty()) {
      text += value.dump();
      continue;
    }
    const char* next = value.is_array() ? "[\n" : "{\n";
    for (const auto& [name, entry] : value.items()) {
      text += fmt::format("{}    {}{}", next,
                          value.is_array() ? "" : OrderedJson(name).dump() + ": ", entry.dump());
      next = ",\n";
    }
    text += value.is_array() ? "\n  ]" : "\n  }";
  }
  return text + "\n}\n";
}

}  // namespace

Exit import_model(const ImportCommand& command, const Session& session) {
  const scenes::BuildingModel model = scenes::read_honeybee(command.in);
  scenes::RoomDraft draft;
  try {
    draft = scenes::draft_room(model, command.rooms);
  } catch (const std::invalid_argument& error) {
    throw spectra::InputError({{.file = command.in,
                                .problem = error.what(),
                                .remedy = "give --room once for each room that is meant"}});
  }
  std::vector<std::string> notes = draft.notes;
  const std::string text = text_of(room_of(draft, command.sky_lx, notes));
  report_notes(notes);
  write_files({{.path = command.out, .text = text}});
  report_written({{.path = command.out, .text = ""}});
  if (session.json) put(Json{{"room", command.out}, {"notes", notes}}.dump(2) + "\n");
  const bool lit = std::ranges::any_of(draft.openings, &scenes::RoomDraft::Opening::lit);
  if (lit) (void)scenes::read_room(command.out);  // its faults are those of the model
  return Exit::done;
}

}  // namespace apps
