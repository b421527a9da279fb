#include "scenes/luminaires/ies_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <utility>

#include "scenes/luminaires/ies_conventions.h"
#include "scenes/luminaires/ies_tilt.h"
#include "scenes/luminaires/number_stream.h"
#include "scenes/luminaires/plane_symmetry.h"

namespace scenes {
namespace {

using Eigen::ArrayXXd;
using Eigen::Index;
using Eigen::Vector3d;

constexpr double kFoot_m = 0.3048;
constexpr double kMost_cd = 1e12;
constexpr double kSameAngle_deg = 1e-6;

/// What stands behind "TILT=", if the line is that.
std::optional<Token> tilt_value(const Token& line) {
  if (!upper(line.text.substr(0, 4)).starts_with("TILT")) return std::nullopt;
  std::size_t at = line.text.find_first_not_of(" \t", 4);
  if (at == line.text.npos || line.text[at] != '=') return std::nullopt;
  at = std::min(line.text.find_first_not_of(" \t", at + 1), line.text.size());
  return Token{.text = line.text.substr(at),
               .line = line.line,
               .column = line.column + static_cast<int>(at)};
}

class IesReader {
 public:
  explicit IesReader(const LuminaireText& text) : text_(text), faults_(text.path()) {}

  Luminaire read() {
    const std::size_t numbers = read_head();
    NumberStream stream(text_, numbers, faults_);
    if (upper(tilt_.text) == "INCLUDE") tilt_curve_ = read_tilt(stream, faults_);
    if (stream.ended()) faults_.throw_faults();
    read_header(stream);
    read_angles(stream);
    read_intensities(stream);
    stream.expect_end();
    faults_.throw_faults();
    return finish();
  }

 private:
  struct Header {
    double lamps = 0, lumens = 0, multiplier = 1, ballast = 1, last = 1, watts = 0;
    std::size_t verticals = 0, horizontals = 0;
    Goniometry type = Goniometry::c;
    Vector3d size_m = Vector3d::Zero();  // width, length, height
  };

  std::size_t read_head();
  void read_keyword(const Token& line);
  void read_tilt_line();
  void read_header(NumberStream& stream);
  void read_type(const PlacedNumber& type);
  double size_in_m(const PlacedNumber& size, double unit_m, std::string_view what);
  void read_angles(NumberStream& stream);
  void check_rising(const std::vector<PlacedNumber>& angles, std::string_view which);
  void check_vertical();
  void check_horizontal();
  void check_mirrored(const std::vector<PlacedNumber>& angles, std::string_view which);
  void read_intensities(NumberStream& stream);
  [[nodiscard]] double factor() const;
  [[nodiscard]] HalfPlanes planes() const;
  [[nodiscard]] IntensityTable table(std::string& symmetry) const;
  Luminaire finish();

  const LuminaireText& text_;
  LuminaireFaults faults_;
  Token tilt_;
  int year_ = 0;
  std::string format_;
  std::map<std::string, std::string> keywords_;
  std::optional<Tilt> tilt_curve_;
  Header header_;
  std::vector<PlacedNumber> vertical_, horizontal_;
  PlaneSymmetry symmetry_ = PlaneSymmetry::none;
  bool closes_ = false;  ///< plane 360 is left out
  std::vector<double> values_;
  std::vector<std::string> notes_;
};

/// @returns the line where the numbers begin
std::size_t IesReader::read_head() {
  const Token first = text_.line(0);
  year_ = ies_year(first.text);
  format_ = readable(first.text);
  if (year_ == 1986 && !upper(first.text).starts_with("IES")) {
    format_ = "IES LM-63-1986";
    notes_.emplace_back("the first line names no version: read as LM-63-1986");
  } else if (year_ == 0) {
    notes_.push_back(
        fmt::format("the version {} is not known: read as LM-63-2002", quoted(first.text)));
    year_ = 2002;
  }
  for (std::size_t l = 0; l < text_.lines().size(); ++l) {
    const Token line = text_.line(l);
    if (const auto value = tilt_value(line)) {
      tilt_ = *value;
      read_tilt_line();
      return l + 1;
    }
    read_keyword(line);
  }
  faults_.add({.text = {}, .line = static_cast<int>(text_.lines().size()), .column = 1},
              "no line TILT=", "write TILT=NONE before the numbers; is it an IES file at all?");
  faults_.throw_faults();
  return 0;
}

void IesReader::read_keyword(const Token& line) {
  const std::size_t end = line.text.find(']');
  if (!line.text.starts_with('[') || end == line.text.npos) return;
  const std::string value = readable(line.text.substr(end + 1));
  const std::size_t start = std::min(value.find_first_not_of(' '), value.size());
  keywords_.emplace(upper(line.text.substr(1, end - 1)), value.substr(start));
}

void IesReader::read_tilt_line() {
  const std::string kind = upper(tilt_.text);
  if (kind == "NONE" || kind == "INCLUDE") return;
  const std::string remedy = "write TILT=NONE if light does not change with tilt";
  if (kind.empty()) {
    faults_.add(tilt_, "nothing stands behind TILT=", remedy);
    return;
  }
  const std::string name(tilt_.text);
  const auto path = std::filesystem::path(text_.path()).parent_path() / name;
  try {
    if (name.find_first_of("/\\") != name.npos) throw spectra::FileError(name);
    const LuminaireText curve = read_luminaire_text(path.string());
    LuminaireFaults faults(curve.path());
    NumberStream stream(curve, 0, faults);
    tilt_curve_ = read_tilt(stream, faults);
    stream.expect_end();
    faults.throw_faults();
  } catch (const spectra::FileError&) {
    faults_.add(tilt_, fmt::format("cannot read {} beside it", readable(tilt_.text)), remedy);
  } catch (const spectra::InputError& error) {
    faults_.add(tilt_, fmt::format("{} is faulty", readable(tilt_.text)), "mend that file");
    faults_.add(error.faults());
  }
}

void IesReader::read_header(NumberStream& stream) {
  const std::vector<PlacedNumber> n = stream.take(13, "numbers that follow TILT=");
  if (stream.ended()) faults_.throw_faults();
  const auto positive = [&](const PlacedNumber& v, std::string_view what) {
    if (!(v.value <= 0)) return v.value;
    faults_.add(v.place, fmt::format("{} {}", what, v.value), "give a number above 0");
    return 1.0;
  };
  header_.lamps = n[0].value;
  header_.lumens = n[1].value;
  header_.multiplier = positive(n[2], "candela multiplier");
  const auto verticals = stream.count(n[3], 2, "number of vertical angles");
  const auto horizontals = stream.count(n[4], 1, "number of horizontal angles");
  read_type(n[5]);
  const double unit_m = n[6].value == 1 ? kFoot_m : 1;
  if (n[6].value == n[6].value && n[6].value != 1 && n[6].value != 2) {
    faults_.add(n[6].place, fmt::format("units {}", n[6].value), "1 is feet, 2 is metres");
  }
  header_.size_m = {size_in_m(n[7], unit_m, "width"), size_in_m(n[8], unit_m, "length"),
                    size_in_m(n[9], unit_m, "height")};
  header_.ballast = positive(n[10], "ballast factor");
  header_.last = year_ < 1995 ? positive(n[11], "ballast-lamp factor") : n[11].value;
  header_.watts = n[12].value;
  if (!verticals || !horizontals) faults_.throw_faults();
  header_.verticals = verticals.value_or(0);
  header_.horizontals = horizontals.value_or(0);
  if (static_cast<double>(header_.verticals) * static_cast<double>(header_.horizontals) >
      kMostIntensities) {
    faults_.add(n[4].place,
                fmt::format("{} x {} intensities", header_.verticals, header_.horizontals),
                "ten million are the most that are read");
    faults_.throw_faults();
  }
}

void IesReader::read_type(const PlacedNumber& type) {
  if (type.value == 2) {
    header_.type = Goniometry::b;
  } else if (type.value == 3) {
    header_.type = Goniometry::a;
  } else if (type.value == type.value && type.value != 1) {
    faults_.add(type.place, fmt::format("photometric type {}", type.value),
                "1 is C, 2 is B, 3 is A");
  }
}

double IesReader::size_in_m(const PlacedNumber& size, double unit_m, std::string_view what) {
  const double size_m = size.value * unit_m;
  if (std::abs(size_m) > kMostSize_m) {
    faults_.add(size.place, fmt::format("luminous {} {} m", what, size_m),
                "sizes are in feet or metres, at most 100 m");
  }
  return size_m;
}

void IesReader::check_rising(const std::vector<PlacedNumber>& angles, std::string_view which) {
  for (std::size_t i = 1; i < angles.size(); ++i) {
    if (angles[i].value <= angles[i - 1].value) {
      faults_.add(angles[i].place,
                  fmt::format("{} angle {} after {}", which, angles[i].value, angles[i - 1].value),
                  "give them rising; do the counts agree with the angles?");
      return;
    }
  }
}

void IesReader::check_vertical() {
  const PlacedNumber &first = vertical_.front(), &last = vertical_.back();
  if (header_.type != Goniometry::c) return check_mirrored(vertical_, "vertical");
  if (first.value != 0 && first.value != 90 && !std::isnan(first.value)) {
    faults_.add(first.place, fmt::format("vertical angles begin at {}", first.value),
                "must be 0 or 90");
  }
  if (last.value != 90 && last.value != 180 && !std::isnan(last.value)) {
    faults_.add(last.place, fmt::format("vertical angles end at {}", last.value),
                "must be 90 or 180");
  }
}

void IesReader::check_mirrored(const std::vector<PlacedNumber>& angles, std::string_view which) {
  const PlacedNumber &first = angles.front(), &last = angles.back();
  if (last.value != 90 && !std::isnan(last.value)) {
    faults_.add(last.place, fmt::format("{} angles end at {}", which, last.value), "must be 90");
  }
  if (first.value != 0 && first.value != -90 && !std::isnan(first.value)) {
    faults_.add(first.place, fmt::format("{} angles begin at {}", which, first.value),
                "must be 0 or -90");
  }
}

void IesReader::check_horizontal() {
  if (header_.type != Goniometry::c) {
    if (horizontal_.size() > 1) return check_mirrored(horizontal_, "horizontal");
    faults_.add(horizontal_[0].place, "one horizontal angle", "types A and B need -90 or 0 to 90");
    return;
  }
  const PlacedNumber &first = horizontal_.front(), &last = horizontal_.back();
  if (horizontal_.size() == 1) {
    symmetry_ = PlaneSymmetry::round;
  } else if (first.value == 0 && last.value == 90) {
    symmetry_ = PlaneSymmetry::both;
  } else if (first.value == 0 && last.value == 180) {
    symmetry_ = PlaneSymmetry::about_0_180;
  } else if (first.value == 90 && last.value == 270) {
    symmetry_ = PlaneSymmetry::about_90_270;
  } else if (first.value == 0 && last.value < 360 &&
             std::abs(360 - 2 * last.value + horizontal_.end()[-2].value) < kSameAngle_deg) {
    closes_ = true;
  } else if ((first.value != 0 || last.value != 360) && !std::isnan(first.value + last.value)) {
    const bool begins_well = first.value == 0 || first.value == 90;
    const PlacedNumber& wrong = begins_well ? last : first;
    faults_.add(
        wrong.place,
        fmt::format("horizontal angles {} at {}", begins_well ? "end" : "begin", wrong.value),
        begins_well ? "must be 0, 90, 180, 360 or 90..270" : "must be 0, or 90..270");
  }
}

void IesReader::read_angles(NumberStream& stream) {
  vertical_ = stream.take(header_.verticals, "vertical angles");
  if (stream.ended()) faults_.throw_faults();
  check_rising(vertical_, "vertical");
  check_vertical();
  horizontal_ = stream.take(header_.horizontals, "horizontal angles");
  if (stream.ended()) faults_.throw_faults();
  check_rising(horizontal_, "horizontal");
  check_horizontal();
}

double IesReader::factor() const {
  return header_.multiplier * header_.ballast * (year_ < 1995 ? header_.last : 1);
}

void IesReader::read_intensities(NumberStream& stream) {
  const std::size_t count = header_.verticals * header_.horizontals;
  bool light = false;
  stream.each(count, "candela values", [&](std::size_t k, const PlacedNumber& v) {
    const double vertical = vertical_[k % header_.verticals].value,
                 horizontal = horizontal_[k / header_.verticals].value;
    if (v.value < 0) {
      faults_.add(v.place,
                  fmt::format("negative intensity {} at vertical {}, horizontal {}", v.value,
                              vertical, horizontal),
                  "give 0 or more");
    } else if (v.value * factor() > kMost_cd) {
      faults_.add(v.place, fmt::format("intensity {} cd", v.value * factor()),
                  "no luminaire has more than 1e12 cd");
    }
    light = light || !(v.value <= 0);
    values_.push_back(v.value * factor());
  });
  if (!light && !stream.ended()) {
    faults_.add(stream.last(), "no light at all", "give some intensity above 0");
  }
}

HalfPlanes IesReader::planes() const {
  HalfPlanes planes;
  for (const PlacedNumber& h : horizontal_) planes.angle_deg.push_back(h.value);
  const auto rows = static_cast<Index>(header_.horizontals),
             columns = static_cast<Index>(header_.verticals);
  using Rows = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  planes.intensity_cd = Eigen::Map<const Rows>(values_.data(), rows, columns);
  return planes;
}

IntensityTable IesReader::table(std::string& symmetry) const {
  std::vector<double> vertical;
  for (const PlacedNumber& v : vertical_) vertical.push_back(v.value);
  if (header_.type == Goniometry::c) {
    const HalfPlanes all = all_around(planes(), symmetry_);
    symmetry = to_string(symmetry_);
    return {Goniometry::c, vertical, all.angle_deg, all.intensity_cd};
  }
  HalfPlanes sides = planes();
  const bool mirrored_h = sides.angle_deg[0] == 0, mirrored_v = vertical[0] == 0;
  if (mirrored_h) sides = both_sides(sides);
  HalfPlanes rows{.angle_deg = vertical, .intensity_cd = sides.intensity_cd.transpose()};
  if (mirrored_v) rows = both_sides(rows);
  symmetry = mirrored_h && mirrored_v ? "left and right, up and down alike"
             : mirrored_h             ? "left and right alike"
             : mirrored_v             ? "up and down alike"
                                      : "none";
  if (header_.type == Goniometry::b) {
    return {Goniometry::b, sides.angle_deg, rows.angle_deg, rows.intensity_cd};
  }
  return {Goniometry::a, rows.angle_deg, sides.angle_deg, rows.intensity_cd.transpose()};
}

Luminaire IesReader::finish() {
  std::string symmetry;
  Luminaire lamp{.path = text_.path(), .format = format_, .intensity = table(symmetry)};
  lamp.symmetry = symmetry;
  for (const char* key : {"MANUFAC", "LUMINAIRE"}) {
    const auto found = keywords_.find(key);
    if (found != keywords_.end() && !found->second.empty()) {
      lamp.name += (lamp.name.empty() ? "" : ", ") + found->second;
    }
  }
  lamp.flux_lm = lamp.intensity.flux_lm();
  if (header_.lumens > 0 && header_.lamps > 0) lamp.lamps_lm = header_.lamps * header_.lumens;
  lamp.input_W = std::max(0.0, header_.watts);
  const auto [shape, known] = ies_shape(header_.size_m.x(), header_.size_m.y(), header_.size_m.z());
  lamp.shape = shape;
  // Length lies along horizontal angle 0; a round luminaire may give one diameter alone.
  Vector3d size_m(std::abs(header_.size_m.y()), std::abs(header_.size_m.x()),
                  std::abs(header_.size_m.z()));
  if (size_m.x() == 0 && header_.size_m.x() < 0) size_m.x() = size_m.y();
  lamp.size_m = size_m;
  if (!known) {
    notes_.emplace_back("the signs of width, length and height fit no shape: taken as a box");
  }
  if (closes_) notes_.emplace_back("the plane 360 is left out: it is taken to be plane 0");
  if ((year_ == 1995 || year_ == 2002) && header_.last != 1) {
    notes_.push_back(fmt::format(
        "the ballast-lamp factor {} is not applied: since 1995 it is no factor", header_.last));
  }
  lamp.tilt = tilt_curve_;
  lamp.notes = notes_;
  for (std::string& note : oddities(lamp)) lamp.notes.push_back(std::move(note));
  return lamp;
}

}  // namespace

Luminaire read_ies(const LuminaireText& text) { return IesReader(text).read(); }

}  // namespace scenes
