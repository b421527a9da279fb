#include <fmt/format.h>

#include <algorithm>

#include "appearance/spectra/alpha_opic.h"
#include "appearance/spectra/correlated_temperature.h"
#include "appearance/spectra/lamp_choice.h"
#include "appearance/spectra/light_file.h"
#include "appearance/spectra/photometry.h"
#include "apps/commands/commands.h"
#include "apps/run/run_record.h"
#include "apps/system/terminal.h"

namespace apps {
namespace {

using spectra::LampFacts;

Json json_of(const LampFacts& lamp) {
  return {{"lamp", "houser:" + lamp.name},
          {"label", lamp.label},
          {"kind", lamp.kind},
          {"cct_K", lamp.cct_K},
          {"duv", lamp.duv},
          {"ra", lamp.ra},
          {"r9", lamp.r9},
          {"rf", lamp.rf},
          {"rg", lamp.rg}};
}

/// Those asked for, the nearest to the box first; by number if nothing is said of it.
std::vector<const LampFacts*> chosen(const LampsCommand& command) {
  std::vector<const LampFacts*> list;
  const bool by_box = command.cct_K || command.ra || command.r9;
  if (by_box) {
    // What is not said counts for nothing: take it from each lamp itself.
    std::vector<std::pair<double, const LampFacts*>> ranked;
    for (const LampFacts& lamp : spectra::lamp_facts()) {
      const spectra::LampBox box{.kind = lamp.kind,
                                 .cct_K = command.cct_K.value_or(lamp.cct_K),
                                 .ra = command.ra.value_or(lamp.ra),
                                 .r9 = command.r9};
      if (!command.kind.empty() && lamp.kind != command.kind) continue;
      ranked.emplace_back(spectra::distance_from(lamp, box), &lamp);
    }
    std::ranges::stable_sort(ranked, {}, [](const auto& entry) { return entry.first; });
    for (const auto& [distance, lamp] : ranked) list.push_back(lamp);
  } else {
    for (const LampFacts& lamp : spectra::lamp_facts()) {
      if (command.kind.empty() || lamp.kind == command.kind) list.push_back(&lamp);
    }
  }
  if (command.top > 0 && list.size() > static_cast<std::size_t>(command.top)) {
    list.resize(static_cast<std::size_t>(command.top));
  }
  return list;
}

Exit list_measured(const LampsCommand& command, const Session& session) {
  const std::vector<const LampFacts*> list = chosen(command);
  if (session.json) {
    Json data = Json::array();
    for (const LampFacts* lamp : list) data.push_back(json_of(*lamp));
    put(data.dump(2) + "\n");
    return Exit::done;
  }
  std::vector<std::vector<std::string>> rows{
      {"lamp", "kind", "CCT K", "Duv", "Ra", "R9", "Rf", "Rg", "label"}};
  for (const LampFacts* lamp : list) {
    rows.push_back({"houser:" + lamp->name, lamp->kind, fmt::format("{:.0f}", lamp->cct_K),
                    fmt::format("{:.4f}", lamp->duv), fmt::format("{:.0f}", lamp->ra),
                    fmt::format("{:.0f}", lamp->r9), fmt::format("{:.0f}", lamp->rf),
                    fmt::format("{:.0f}", lamp->rg), lamp->label});
  }
  put(table("<<>>>>>><", rows));
  return Exit::done;
}

/// Of a user's own spectra; per lux.
Exit describe_spectra(const std::string& path, const Session& session) {
  Json data = Json::array();
  std::vector<std::vector<std::string>> rows{
      {"curve", "x", "y", "CCT K", "Duv", "melanopic", "S", "M", "L", "rhodopic"}};
  for (const spectra::NamedSpectrum& entry : spectra::read_light_file(path).set.entries) {
    const spectra::Spectrum light =
        spectra::scaled_to_luminous(spectra::light_on(spectra::kTransportGrid, entry.samples), 1);
    const spectra::Chromaticity xy = spectra::chromaticity(spectra::absolute_xyz(light));
    const auto temperature = spectra::correlated_temperature(xy);
    const auto edi = spectra::equivalent_daylight_lx(light);
    Json receptors;
    for (int r = 0; r < spectra::kReceptors; ++r) {
      receptors[std::string(to_string(static_cast<spectra::Receptor>(r)))] =
          edi[static_cast<std::size_t>(r)];
    }
    data.push_back({{"curve", entry.name},
                    {"x", xy.x},
                    {"y", xy.y},
                    {"cct_K", temperature ? Json(temperature->cct_K) : Json()},
                    {"duv", temperature ? Json(temperature->duv) : Json()},
                    {"EDI_per_lx", receptors}});
    const auto number = [](double value) { return fmt::format("{:.4f}", value); };
    rows.push_back({entry.name, number(xy.x), number(xy.y),
                    temperature ? fmt::format("{:.0f}", temperature->cct_K) : "-",
                    temperature ? number(temperature->duv) : "-", number(edi[4]), number(edi[0]),
                    number(edi[1]), number(edi[2]), number(edi[3])});
  }
  put(session.json ? data.dump(2) + "\n"
                   : table("<>>>>>>>>>", rows) +
                         "receptors: equivalent daylight illuminance per lux; 31 bands\n");
  return Exit::done;
}

}  // namespace

Exit tell_lamps(const LampsCommand& command, const Session& session) {
  return command.in.empty() ? list_measured(command, session)
                            : describe_spectra(command.in, session);
}

}  // namespace apps
