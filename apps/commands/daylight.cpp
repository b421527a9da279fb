#include <fmt/format.h>

#include <algorithm>

#include "apps/commands/commands.h"
#include "apps/reports/csv.h"
#include "apps/run/room_run.h"
#include "apps/run/solution_columns.h"
#include "apps/system/output_files.h"
#include "apps/system/terminal.h"
#include "solver/rooms/daylight_hours.h"

namespace apps {
namespace {

/// Levels whose share of the hours of daylight is told, lx.
constexpr double kLevels_lx[] = {100, 300, 500, 2000};

struct Range {
  std::size_t first = 0, end = 0;  ///< into the weather file
};

Range range_of(const DaylightCommand& command, const scenes::WeatherFile& file) {
  if (!command.hours) return {0, file.hours.size()};
  const auto [first, last] = *command.hours;
  if (last < first || static_cast<std::size_t>(last) > file.hours.size()) {
    throw spectra::InputError(
        {{file.path, 0, 0, "", fmt::format("hours {} to {}, of {}", first, last, file.hours.size()),
          "give --hours FIRST,LAST within them"}});
  }
  return {static_cast<std::size_t>(first) - 1, static_cast<std::size_t>(last)};
}

/// One receiver over all hours of daylight.
struct Account {
  double mean_lx = 0, most_lx = 0;
  std::vector<double> shares;  ///< of the hours at or above each level
};

double lux_of(const solver::HourOfLight& hour, std::size_t receiver,
              const SolutionColumns& columns) {
  return (columns.lux.transpose() * hour.irradiance.row(static_cast<Eigen::Index>(receiver))).sum();
}

Account account_of(const std::vector<solver::HourOfLight>& hours, std::size_t receiver,
                   const SolutionColumns& columns) {
  Account account{.shares = std::vector<double>(std::size(kLevels_lx))};
  int count = 0;
  for (const solver::HourOfLight& hour : hours) {
    if (!hour.daylight) continue;
    ++count;
    const double lux = lux_of(hour, receiver, columns);
    account.mean_lx += lux;
    account.most_lx = std::max(account.most_lx, lux);
    for (std::size_t k = 0; k < account.shares.size(); ++k) {
      if (lux >= kLevels_lx[k]) account.shares[k] += 1;
    }
  }
  if (count == 0) return account;
  account.mean_lx /= count;
  for (double& share : account.shares) share /= count;
  return account;
}

std::string hours_csv(const scenes::Room& room, const scenes::WeatherFile& file,
                      const std::vector<solver::HourOfLight>& hours,
                      const SolutionColumns& columns) {
  std::string names;
  for (const std::string& name : columns.names) names += ",E" + name;
  CsvText csv("hour,month,day,ends,sun_azimuth_deg,sun_altitude_deg,receiver,illuminance_lx" +
              names);
  for (const solver::HourOfLight& hour : hours) {
    const scenes::WeatherHour& at = file.hours[hour.hour];
    for (std::size_t r = 0; r < room.receivers.size(); ++r) {
      csv.cell(static_cast<int>(hour.hour) + 1).cell(at.month).cell(at.day).cell(at.hour);
      csv.cell(hour.azimuth_deg).cell(hour.altitude_deg).cell(room.receivers[r].name);
      const auto value = [&](double number) {
        csv.cell(hour.defined ? std::optional(number) : std::nullopt);
      };
      value(lux_of(hour, r, columns));
      for (const double band : hour.irradiance.row(static_cast<Eigen::Index>(r))) value(band);
      csv.end_row();
    }
  }
  return csv.take();
}

std::string summary_csv(const scenes::Room& room, const std::vector<Account>& accounts) {
  std::string names;
  for (const double level : kLevels_lx) names += fmt::format(",share_from_{:g}_lx", level);
  CsvText csv("receiver,mean_lx,largest_lx" + names);
  for (std::size_t r = 0; r < accounts.size(); ++r) {
    csv.cell(room.receivers[r].name).cell(accounts[r].mean_lx).cell(accounts[r].most_lx);
    for (const double share : accounts[r].shares) csv.cell(share);
    csv.end_row();
  }
  return csv.take();
}

std::string text_of(const scenes::Room& room, const std::vector<Account>& accounts) {
  std::vector<std::string> head{"receiver", "mean lx", "largest lx"};
  for (const double level : kLevels_lx) head.push_back(fmt::format(">= {:g} lx", level));
  std::vector<std::vector<std::string>> rows{head};
  for (std::size_t r = 0; r < accounts.size(); ++r) {
    rows.push_back({room.receivers[r].name, fmt::format("{:.0f}", accounts[r].mean_lx),
                    fmt::format("{:.0f}", accounts[r].most_lx)});
    for (const double share : accounts[r].shares) {
      rows.back().push_back(fmt::format("{:.1f} %", 100 * share));
    }
  }
  return table("<>>>>>>", rows);
}

const scenes::WeatherSky& weather_of(const RoomRun& run) {
  if (run.room.weather_skies.empty()) {
    throw room_fault(
        run, "/lights", "no sky of this room comes from a weather file",
        "give one \"at\": {\"epw\": FILE, \"hour\": N}; its other hours are taken too");
  }
  if (run.room.receivers.empty()) {
    throw room_fault(run, "", "there are no receivers", "add some to \"receivers\"");
  }
  return run.room.weather_skies.front();
}

}  // namespace

Exit daylight_hours(const DaylightCommand& command, const Session& session) {
  Json options = to_json(command.options);
  if (command.hours) options["hours"] = {command.hours->first, command.hours->second};
  RoomRun run = open_room(command.room, "daylight", options, session);
  const scenes::WeatherSky over = weather_of(run);
  const Range range = range_of(command, *over.file);
  run.room.scenarios.clear();
  run.room.skies.resize(1);
  prepare(run, command.options, command.out);
  const solver::DaylightHours daylight(run.room, run.transport, command.options.radiosity);
  run.clock.stop("responses");
  const std::vector<solver::HourOfLight> hours = daylight.of(over, range.first, range.end);
  run.clock.stop("hours");

  const SolutionColumns columns = columns_of(run.room.grid);
  std::vector<Account> accounts;
  for (std::size_t r = 0; r < run.room.receivers.size(); ++r) {
    accounts.push_back(account_of(hours, r, columns));
  }
  Json undefined = Json::array();
  for (const solver::HourOfLight& hour : hours) {
    if (!hour.defined) undefined.push_back(hour.hour + 1);
  }
  const auto lit = std::ranges::count_if(hours, &solver::HourOfLight::daylight);
  run.record["daylight"] = {{"place", over.file->place},
                            {"hours", hours.size()},
                            {"with_daylight", lit},
                            {"sky_undefined", undefined}};
  if (!undefined.empty()) {
    tell("note: for {} hours the Perez model has no sky; they are left empty\n", undefined.size());
  }
  RunResult result = finish(run, daylight.converged(),
                            {{.path = std::filesystem::path(command.out) / "daylight.csv",
                              .text = hours_csv(run.room, *over.file, hours, columns)},
                             {.path = std::filesystem::path(command.out) / "daylight_summary.csv",
                              .text = summary_csv(run.room, accounts)}},
                            command.out);
  result.text =
      text_of(run.room, accounts) +
      fmt::format("of {} hours with daylight, of {}; shares of those hours\n", lit, hours.size());
  result.data = {{"status", result.record["status"]},
                 {"folder", command.out},
                 {"daylight", run.record["daylight"]}};
  return print_result(result, session);
}

}  // namespace apps
