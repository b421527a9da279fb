#include <fmt/format.h>

#include <algorithm>

#include "apps/commands/commands.h"
#include "apps/pictures/polar_diagram.h"
#include "apps/run/run_record.h"
#include "apps/system/output_files.h"
#include "apps/system/terminal.h"
#include "scenes/luminaires/luminaire_file.h"
#include "scenes/luminaires/measures.h"

namespace apps {
namespace {

using Eigen::Vector3d;

/// Full angles over which there is still a share of the peak, in the planes C0-C180 and C90-C270.
struct Spread {
  double across_deg = 0, along_deg = 0;
};

Spread spread_of(const scenes::IntensityTable& table, double share) {
  const Vector3d across =
      table.type() == scenes::Goniometry::a ? Vector3d(0, 0, 1) : Vector3d(1, 0, 0);
  const Vector3d along = Vector3d::UnitY();
  const auto both = [&](const Vector3d& side) {
    return scenes::reach_deg(table, side, share) + scenes::reach_deg(table, -side, share);
  };
  return {both(across), both(along)};
}

std::string type_of(const scenes::IntensityTable& table) {
  const char* names[] = {"C", "B", "A"};
  return names[static_cast<int>(table.type())];
}

std::string size_of(const scenes::Luminaire& lamp) {
  if (lamp.shape == scenes::LuminousShape::point) return "point";
  return fmt::format("{}, {:g} x {:g} x {:g} m", scenes::to_string(lamp.shape), lamp.size_m.x(),
                     lamp.size_m.y(), lamp.size_m.z());
}

std::string zone_table(const scenes::Luminaire& lamp) {
  std::vector<std::vector<std::string>> rows{{"angle from its axis", "lm", "%"}};
  for (const scenes::Zone& zone : scenes::zones(lamp.intensity)) {
    rows.push_back({fmt::format("{:g} to {:g} degrees", zone.from_deg, zone.to_deg),
                    fmt::format("{:.1f}", zone.flux_lm),
                    fmt::format("{:.1f}", 100 * zone.flux_lm / lamp.flux_lm)});
  }
  return table("<>>", rows);
}

std::string text_of(const scenes::Luminaire& lamp) {
  const scenes::IntensityTable& intensity = lamp.intensity;
  const Spread beam = spread_of(intensity, 0.5), field = spread_of(intensity, 0.1);
  std::vector<std::vector<std::string>> rows{{"what", "value"}};
  const auto row = [&](const std::string& what, const std::string& value) {
    rows.push_back({what, value});
  };
  row("file", fmt::format("{}, type {}, {}", lamp.format, type_of(intensity), lamp.symmetry));
  if (!lamp.name.empty()) row("name", lamp.name);
  row("angles", fmt::format("{} x {}, steps from {:g} degrees", intensity.polar_deg().size(),
                            intensity.azimuth_deg().size(), intensity.finest_step_deg()));
  row("flux", fmt::format("{:.1f} lm", lamp.flux_lm));
  if (lamp.printed_lm) row("flux as printed", fmt::format("{:.1f} lm", *lamp.printed_lm));
  row("lamps", lamp.lamps_lm ? fmt::format("{:.1f} lm", *lamp.lamps_lm) : "absolute photometry");
  if (lamp.input_W > 0) {
    row("input, efficacy",
        fmt::format("{:g} W, {:.1f} lm/W", lamp.input_W, lamp.flux_lm / lamp.input_W));
  }
  row("peak", fmt::format("{:.1f} cd", intensity.peak_cd()));
  row("beam angle, 50 %",
      fmt::format("{:.1f} x {:.1f} degrees (C0-C180, C90-C270)", beam.across_deg, beam.along_deg));
  row("field angle, 10 %",
      fmt::format("{:.1f} x {:.1f} degrees", field.across_deg, field.along_deg));
  row("luminous area", size_of(lamp));
  return table("<<", rows) + "\n" + zone_table(lamp);
}

Json json_of(const Spread& spread) {
  return {{"C0_C180", spread.across_deg}, {"C90_C270", spread.along_deg}};
}

Json data_of(const scenes::Luminaire& lamp) {
  const scenes::IntensityTable& table = lamp.intensity;
  Json zones = Json::array();
  for (const scenes::Zone& zone : scenes::zones(table)) {
    zones.push_back(
        {{"from_deg", zone.from_deg}, {"to_deg", zone.to_deg}, {"flux_lm", zone.flux_lm}});
  }
  return {{"file", lamp.path},
          {"format", lamp.format},
          {"name", lamp.name},
          {"type", type_of(table)},
          {"symmetry", lamp.symmetry},
          {"flux_lm", lamp.flux_lm},
          {"printed_lm", lamp.printed_lm ? Json(*lamp.printed_lm) : Json()},
          {"lamps_lm", lamp.lamps_lm ? Json(*lamp.lamps_lm) : Json()},
          {"input_W", lamp.input_W > 0 ? Json(lamp.input_W) : Json()},
          {"peak_cd", table.peak_cd()},
          {"beam_angle_deg", json_of(spread_of(table, 0.5))},
          {"field_angle_deg", json_of(spread_of(table, 0.1))},
          {"shape", scenes::to_string(lamp.shape)},
          {"size_m", {lamp.size_m.x(), lamp.size_m.y(), lamp.size_m.z()}},
          {"zones", zones},
          {"notes", lamp.notes}};
}

}  // namespace

Exit describe_lamp(const FileCommand& command, const Session& session) {
  const scenes::Luminaire lamp = scenes::read_luminaire(command.in);
  report_notes(lamp.notes);
  if (!command.out.empty()) {
    const std::vector<OutputFile> files{{.path = command.out, .text = polar_diagram(lamp)}};
    write_files(files);
    report_written(files);
  }
  put(session.json ? data_of(lamp).dump(2) + "\n" : text_of(lamp));
  return Exit::done;
}

}  // namespace apps
