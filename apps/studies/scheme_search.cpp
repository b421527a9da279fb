#include "apps/studies/scheme_search.h"

#include <algorithm>

#include "apps/studies/paint_wish.h"

namespace apps {

SchemeGroups scheme_groups(const RoomRun& run, const std::string& atlas) {
  SchemeGroups all;
  const std::size_t count = run.room.paint.size();
  for (const scenes::PaintTask& group : run.room.paint) {
    all.atlases.push_back(paints::load_atlas(atlas.empty() ? group.atlas : atlas, run.room.grid));
  }
  for (std::size_t g = 0; g < count; ++g) {
    const scenes::TargetColour& target = target_of(run, g);
    require_painted_view(run, g);
    require_wish(run, g);
    all.groups.push_back(
        {.atlas = &all.atlases[g], .target = {}, .weight = run.room.paint[g].weight});
    all.highest_reflectance =
        std::max(all.highest_reflectance, highest_reflectance(all.atlases[g], target));
  }
  return all;
}

std::vector<std::optional<spectra::ViewedLight>> set_targets(const RoomRun& run,
                                                             PaintedRoom& painted,
                                                             SchemeGroups& groups) {
  std::vector<std::optional<spectra::ViewedLight>> here;
  for (std::size_t g = 0; g < groups.groups.size(); ++g) {
    here.push_back(light_here(run, painted, g));
    groups.swatches.push_back(swatch_of(run, target_of(run, g), run.room.viewing, here[g]));
    groups.groups[g].target = wished(run, target_of(run, g), groups.swatches[g], g);
  }
  return here;
}

paints::SchemeRanking search_schemes(const RoomRun& run, const PaintedRoom& painted,
                                     const SchemeGroups& groups, paints::Distance distance,
                                     std::size_t top) {
  const auto room = [&](int varying, const std::vector<spectra::Spectrum>& paints) {
    std::vector<std::vector<spectra::LitRoom>> views;
    for (int viewed = 0; viewed < static_cast<int>(run.room.paint.size()); ++viewed) {
      views.push_back(painted.rooms(varying, viewed, paints));
    }
    return views;
  };
  return seeing(run, [&] {
    return paints::rank_schemes(groups.groups, room,
                                {.distance = distance,
                                 .viewing = run.room.viewing,
                                 .judgement = run.room.judgement,
                                 .top = top});
  });
}

}  // namespace apps
