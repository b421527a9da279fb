#include "apps/studies/repaint.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>

#include "appearance/spectra/spectrum_library.h"
#include "appearance/spectra/text/json_reader.h"
#include "paints/atlas_file.h"

namespace apps {
namespace {

using spectra::Fault;

/// A paint of the group's atlas, else a qualified name; nothing and a fault if there is none.
std::optional<spectra::Spectrum> find(const scenes::Room& room, const scenes::PaintTask& group,
                                      const std::string& name, const std::string& given,
                                      std::vector<Fault>& faults) {
  const paints::Atlas atlas = paints::load_atlas(group.atlas, room.grid);
  const std::string bare =
      name.starts_with(atlas.name + ":") ? name.substr(atlas.name.size() + 1) : name;
  const auto paint = std::ranges::find(atlas.paints, bare, &paints::Paint::name);
  if (paint != atlas.paints.end()) return paint->reflectance;
  try {
    const auto [set, spectrum] = spectra::find_paint(name);
    return spectra::reflectance_on(room.grid, spectrum->samples);
  } catch (const std::invalid_argument&) {
    std::vector<std::string> names;
    for (const paints::Paint& p : atlas.paints) names.push_back(p.name);
    const std::string near = spectra::nearest_name(bare, names);
    faults.push_back({.file = "--paint " + given,
                      .problem = fmt::format("{} has no paint \"{}\"", atlas.name, name),
                      .remedy = near.empty() ? fmt::format("take one like {}", names.front())
                                             : fmt::format("did you mean {}?", near)});
    return std::nullopt;
  }
}

void paint(scenes::Room& room, const scenes::PaintTask& group, const spectra::Spectrum& paint) {
  for (const int s : group.surfaces) {
    room.surfaces[static_cast<std::size_t>(s)].reflectance = paint;
  }
}

}  // namespace

scenes::Room painted(scenes::Room room, const std::vector<spectra::Spectrum>& paints) {
  for (std::size_t g = 0; g < paints.size(); ++g) paint(room, room.paint[g], paints[g]);
  return room;
}

Json repaint(RoomRun& run, const std::vector<std::string>& paints) {
  std::vector<std::string> groups;
  for (const scenes::PaintTask& group : run.room.paint) groups.push_back(group.name);
  std::vector<Fault> faults;
  Json record = Json::object();
  for (const std::string& given : paints) {
    const std::size_t equals = given.find('=');
    const std::string name = given.substr(0, equals);
    const auto group = std::ranges::find(run.room.paint, name, &scenes::PaintTask::name);
    if (equals == std::string::npos || group == run.room.paint.end()) {
      faults.push_back({.file = "--paint " + given,
                        .problem = equals == std::string::npos
                                       ? std::string("is no GROUP=PAINT")
                                       : fmt::format("the room paints no group \"{}\"", name),
                        .remedy = groups.empty()
                                      ? std::string("name the surfaces in \"paint\" of the room")
                                      : "take " + spectra::alternatives(groups)});
      continue;
    }
    const auto found = find(run.room, *group, given.substr(equals + 1), given, faults);
    if (!found) continue;
    paint(run.room, *group, *found);
    record[name] = given.substr(equals + 1);
  }
  if (!faults.empty()) throw spectra::InputError(faults);
  return record;
}

}  // namespace apps
