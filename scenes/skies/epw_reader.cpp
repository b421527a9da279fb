#include "scenes/skies/epw_reader.h"

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cmath>
#include <string_view>

#include "appearance/spectra/text/csv_reader.h"
#include "appearance/spectra/text/input_bytes.h"

namespace scenes {
namespace {

constexpr std::size_t kMostBytes = std::size_t{64} << 20, kMostFaults = 100;
constexpr std::size_t kHeaderLines = 8;

struct Cell {
  std::string_view text;
  int column = 1;
};

struct Line {
  int number = 0;
  std::vector<Cell> cells;
};

std::vector<Line> lines_of(std::string_view text) {
  std::vector<Line> lines;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    Line cut{.number = number};
    for (std::size_t from = 0; from <= line.size();) {
      const std::size_t comma = std::min(line.find(',', from), line.size());
      cut.cells.push_back({line.substr(from, comma - from), static_cast<int>(from) + 1});
      from = comma + 1;
    }
    lines.push_back(std::move(cut));
  }
  return lines;
}

/// Reads cells as numbers and collects faults; NaN stands for what could not be read.
class EpwReader {
 public:
  explicit EpwReader(const std::string& path) : path_(path) {}

  [[nodiscard]] WeatherFile read();

 private:
  struct Range {
    double least, most;
    const char* name;
  };

  void fault(int line, int column, std::string problem, std::string remedy) {
    if (faults_.size() < kMostFaults) {
      faults_.push_back({path_, line, column, "", std::move(problem), std::move(remedy)});
    }
  }

  [[nodiscard]] double number(const Line& line, std::size_t cell, const Range& range) {
    const auto value = spectra::parse_number(line.cells[cell].text);
    if (value && *value >= range.least && *value <= range.most) return *value;
    fault(line.number, line.cells[cell].column,
          value ? fmt::format("{} of {} is out of range", range.name, *value)
                : fmt::format("\"{}\" is no number", line.cells[cell].text),
          fmt::format("{} goes from {} to {}", range.name, range.least, range.most));
    return NAN;
  }

  void read_place(const Line& line, WeatherFile& file);
  void read_hour(const Line& line, WeatherFile& file);

  const std::string& path_;
  std::vector<spectra::Fault> faults_;
};

void EpwReader::read_place(const Line& line, WeatherFile& file) {
  if (line.cells[0].text != "LOCATION" || line.cells.size() < 9) {
    fault(line.number, 1, "this is no EnergyPlus weather file",
          "its first line is LOCATION,city,state,country,source,number,latitude,longitude,zone");
    return;
  }
  file.place = std::string(line.cells[1].text);
  file.latitude_deg = number(line, 6, {-90, 90, "the latitude"});
  file.longitude_deg = number(line, 7, {-180, 180, "the longitude"});
  file.zone_h = number(line, 8, {-12, 14, "the time zone"});
}

void EpwReader::read_hour(const Line& line, WeatherFile& file) {
  using namespace std::chrono;
  constexpr std::size_t kDewPoint = 7, kDirect = 14, kDiffuse = 15;
  constexpr double kNoDewPoint = 99.9;
  if (line.cells.size() == 1 && line.cells[0].text.empty()) return;
  if (line.cells.size() <= kDiffuse) {
    fault(line.number, 1, fmt::format("the line has {} cells", line.cells.size()),
          "a line of weather has 35, irradiances in the 15th and 16th");
    return;
  }
  const std::size_t before = faults_.size();
  const double year_number = number(line, 0, {1900, 2200, "the year"}),
               month_number = number(line, 1, {1, 12, "the month"}),
               day_number = number(line, 2, {1, 31, "the day"}),
               hour_number = number(line, 3, {1, 24, "the hour"}),
               dew_point_C = number(line, kDewPoint, {-90, 100, "the dew point"}),
               direct = number(line, kDirect, {0, 2000, "the direct normal irradiance"}),
               diffuse = number(line, kDiffuse, {0, 2000, "the diffuse horizontal irradiance"});
  if (faults_.size() > before) return;
  const year_month_day date{year{static_cast<int>(year_number)},
                            month{static_cast<unsigned>(month_number)},
                            day{static_cast<unsigned>(day_number)}};
  if (!date.ok()) {
    fault(line.number, 1, "there is no such day", "mend year, month or day");
    return;
  }
  const sys_days midnight{date};
  const double days = static_cast<double>(midnight.time_since_epoch().count());
  const sys_days new_year{year_month_day{date.year(), January, day{1}}};
  const int day_of_year = static_cast<int>((midnight - new_year).count()) + 1;
  WeatherHour hour{
      .month = static_cast<int>(month_number),
      .day = static_cast<int>(day_number),
      .hour = static_cast<int>(hour_number),
      .moment = {.julian_day = kJulianDayOf1970 + days + (hour_number - 0.5 - file.zone_h) / 24,
                 .day_of_year = day_of_year},
      .weather = {.direct_normal_W_m2 = direct,
                  .diffuse_horizontal_W_m2 = diffuse,
                  .day_of_year = day_of_year}};
  if (dew_point_C < kNoDewPoint) {
    hour.weather.precipitable_water_cm = precipitable_water_cm(dew_point_C);
  }
  file.hours.push_back(hour);
}

WeatherFile EpwReader::read() {
  const std::string text =
      spectra::read_input(path_, kMostBytes, "give a weather file of single years");
  const std::vector<Line> lines = lines_of(text);
  WeatherFile file{.path = path_};
  if (lines.empty()) {
    fault(0, 0, "the file is empty", "give an EnergyPlus weather file");
  } else {
    read_place(lines[0], file);
  }
  if (faults_.empty()) {
    for (std::size_t k = kHeaderLines; k < lines.size(); ++k) read_hour(lines[k], file);
    if (faults_.empty() && file.hours.empty()) {
      fault(0, 0, "there are no hours in it", "eight lines of header, then a line an hour");
    }
  }
  if (!faults_.empty()) throw spectra::InputError(faults_);
  return file;
}

}  // namespace

WeatherFile read_epw(const std::string& path) { return EpwReader(path).read(); }

}  // namespace scenes
