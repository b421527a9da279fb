#include "apps/studies/paint_wish.h"

#include <fmt/format.h>

#include <algorithm>
#include <variant>

#include "apps/system/terminal.h"

namespace apps {
namespace {

/// "/paint/target", or "/paint/1/target" where several groups are painted.
std::string pointer(const RoomRun& run, std::size_t group, const char* key) {
  return run.room.paint.size() > 1 ? fmt::format("/paint/{}/{}", group, key)
                                   : fmt::format("/paint/{}", key);
}

}  // namespace

const scenes::TargetColour& target_of(const RoomRun& run, std::size_t group) {
  if (group >= run.room.paint.size() || !run.room.paint[group].target) {
    throw room_fault(run, pointer(run, group, "target"), "is missing, and it is needed here",
                     "say which colour is wished, e.g. { \"paint\": \"munsell-nickerson:231\" }");
  }
  return *run.room.paint[group].target;
}

appearance::SwatchCondition swatch_of(const RoomRun& run, const scenes::TargetColour& target,
                                      const spectra::ViewingChoices& viewing,
                                      const std::optional<spectra::ViewedLight>& here) {
  appearance::SwatchCondition swatch = appearance::standard_swatch();
  if (target.seen == scenes::SwatchPlace::own) {
    swatch =
        appearance::swatch_in(target.own.irradiance, target.own.background_y, target.own.surround);
  } else if (target.seen == scenes::SwatchPlace::here) {
    swatch.light = here.value().white;
    swatch.conditions =
        seeing(run, [&] { return appearance::view_of_room(*here, viewing).conditions; });
  }
  if (viewing.size_effect) swatch.size = appearance::size_effect(target.angle_deg);
  return swatch;
}

std::optional<spectra::ViewedLight> light_here(const RoomRun& run, PaintedRoom& painted,
                                               std::size_t group) {
  if (target_of(run, group).seen != scenes::SwatchPlace::here) return std::nullopt;
  return painted.as_painted(static_cast<int>(group));
}

appearance::SwatchCondition swatch_of_group(const RoomRun& run, PaintedRoom& painted,
                                            std::size_t group) {
  if (!run.room.paint[group].target) return appearance::standard_swatch();
  return swatch_of(run, target_of(run, group), run.room.viewing, light_here(run, painted, group));
}

void tell_white(const RoomRun& run, const appearance::RoomView& view) {
  if (run.room.viewing.white_share == 1 || !view.lamps_by_flux) return;
  report_notes(
      {"/view/white: no lamp shines on the viewed point, so the white counts the light of all "
       "lamps as it enters the room"});
}

void require_wish(const RoomRun& run, std::size_t group) {
  const scenes::TargetColour& target = target_of(run, group);
  if (target.seen == scenes::SwatchPlace::here) return;
  (void)wished(run, target, swatch_of(run, target, run.room.viewing, std::nullopt), group);
}

paints::Target wished(const RoomRun& run, const scenes::TargetColour& target,
                      const appearance::SwatchCondition& swatch, std::size_t group) {
  if (const auto* reflectance = std::get_if<spectra::Spectrum>(&target.colour)) {
    const appearance::Correlates correlates = seen_on_swatch(*reflectance, swatch).correlates;
    if (!correlates.status.all_defined()) {
      throw room_fault(run, pointer(run, group, "target"),
                       "CIECAM02 does not define how this swatch looks",
                       "choose a less saturated target");
    }
    return paints::target_of(correlates);
  }
  const auto& jch = std::get<Eigen::Vector3d>(target.colour);
  return paints::target_of(
      appearance::LightnessChromaHue{.lightness = jch[0], .chroma = jch[1], .hue_deg = jch[2]});
}

void require_one_group(const RoomRun& run) {
  if (run.room.paint.size() == 1) return;
  throw room_fault(
      run, "/paint",
      fmt::format("paints {} groups of surfaces, and one is wanted here", run.room.paint.size()),
      "name the surfaces of one group, e.g. { \"surfaces\": [\"walls\"] }");
}

void require_painted_view(const RoomRun& run, std::size_t group) {
  const solver::ViewedPoint at = viewed_point(run, group);
  const std::vector<int>& painted = run.room.paint[group].surfaces;
  if (std::find(painted.begin(), painted.end(), at.surface) == painted.end()) {
    throw room_fault(run, run.room.paint[group].view ? pointer(run, group, "view") : "/view",
                     fmt::format("looks at \"{}\", which is not painted", surface_name(run, at)),
                     "look at one of paint.surfaces, or leave the view out");
  }
}

double highest_reflectance(const paints::Atlas& atlas,
                           const std::optional<scenes::TargetColour>& target) {
  double highest = kHighestReflectance;
  for (const paints::Paint& p : atlas.paints) {
    highest = std::max(highest, p.reflectance.values.maxCoeff());
  }
  const auto* reflectance = target ? std::get_if<spectra::Spectrum>(&target->colour) : nullptr;
  if (reflectance != nullptr) {
    highest = std::max(highest, reflectance->values.maxCoeff());
  }
  return highest;
}

}  // namespace apps
