#include "scenes/luminaires/eulumdat_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "scenes/luminaires/plane_symmetry.h"

namespace scenes {
namespace {

using Eigen::Index;
using Eigen::Vector3d;

constexpr double kMost_cd = 1e12, kMostSets = 20, kSameAngle_deg = 1e-6;
constexpr std::size_t kSetLines = 6, kRatios = 10;

struct PlacedValue {
  double value = 0;
  Token place;
};

class EulumdatReader {
 public:
  explicit EulumdatReader(const LuminaireText& text) : text_(text), faults_(text.path()) {}

  Luminaire read() {
    const Token first = text_.line(0);
    if (first.text.starts_with("IESNA") || first.text.starts_with("IES:")) {
      faults_.add(first, "this is an IES file", "name it .ies");
      faults_.throw_faults();
    }
    read_head();
    read_lamps();
    read_angles();
    read_intensities();
    expect_end();
    faults_.throw_faults();
    return finish();
  }

 private:
  /// The next line, whatever it holds.
  Token text_line() { return text_.line(at_++); }

  PlacedValue number(std::string_view what, bool unit_may_follow = false);
  double within(std::string_view what, double least, double most);
  std::size_t count(std::string_view what, double least, double most);
  void require_lines(std::size_t count, std::string_view what);
  void read_head();
  void read_sizes();
  void read_lamps();
  void read_angles();
  void check_planes();
  std::vector<PlacedValue> angles(std::size_t count, std::string_view which);
  void note_step(const std::vector<PlacedValue>& angles, double step_deg, std::string_view which);
  /// Indices of the planes that are stored, in the order of the file.
  [[nodiscard]] std::vector<std::size_t> stored_planes() const;
  void read_intensities();
  void expect_end();
  Luminaire finish();

  const LuminaireText& text_;
  LuminaireFaults faults_;
  std::size_t at_ = 0;  ///< the next line
  std::string maker_, name_;
  int symmetry_ = 0;
  std::size_t planes_ = 0, gammas_ = 0;
  double plane_step_deg_ = 0, gamma_step_deg_ = 0;
  Vector3d size_m_ = Vector3d::Zero();  ///< along x, y, z
  bool round_area_ = false, absolute_ = false;
  double output_ratio_ = 0, conversion_ = 1, flux_lm_ = 0, watts_ = 0;
  std::vector<PlacedValue> c_, gamma_;
  HalfPlanes stored_;
  std::vector<std::string> notes_;
};

PlacedValue EulumdatReader::number(std::string_view what, bool unit_may_follow) {
  const Token line = text_line();
  std::string digits(line.text);
  if (unit_may_follow) digits = digits.substr(0, digits.find_first_of(" \t"));
  std::ranges::replace(digits, ',', '.');
  if (const auto value = number_in(digits)) return {.value = *value, .place = line};
  faults_.add(line,
              line.text.empty() ? fmt::format("{} is missing", what)
                                : fmt::format("{} is no number", quoted(line.text)),
              fmt::format("give the {}", what));
  return {.value = std::numeric_limits<double>::quiet_NaN(), .place = line};
}

double EulumdatReader::within(std::string_view what, double least, double most) {
  const PlacedValue n = number(what);
  if (n.value < least || n.value > most) {
    faults_.add(n.place, fmt::format("{} {}", what, n.value),
                fmt::format("give {:g} to {:g}", least, most));
    return std::numeric_limits<double>::quiet_NaN();
  }
  return n.value;
}

/// 0 after a fault.
std::size_t EulumdatReader::count(std::string_view what, double least, double most) {
  const PlacedValue n = number(what);
  if (std::isnan(n.value)) return 0;
  if (n.value >= least && n.value <= most && n.value == std::floor(n.value)) {
    return static_cast<std::size_t>(n.value);
  }
  faults_.add(n.place, fmt::format("{} {}", what, n.value),
              fmt::format("give a whole number from {:g} to {:.0f}", least, most));
  return 0;
}

/// Ends the reading if the file is too short for what was announced: all else would be a guess.
void EulumdatReader::require_lines(std::size_t count, std::string_view what) {
  const std::size_t left = text_.lines().size() - std::min(at_, text_.lines().size());
  if (left >= count) return;
  faults_.add({.text = {}, .line = static_cast<int>(text_.lines().size()), .column = 1},
              fmt::format("ends after {} of {} {}", left, count, what),
              "one value stands on each line");
  faults_.throw_faults();
}

void EulumdatReader::read_head() {
  require_lines(26, "lines before the lamps");
  maker_ = readable(text_line().text);
  (void)text_line();  // type indicator: the symmetry says all of it
  const PlacedValue symmetry = number("symmetry");
  symmetry_ = symmetry.value >= 0 && symmetry.value <= 4 ? static_cast<int>(symmetry.value) : -1;
  if (symmetry_ != symmetry.value && !std::isnan(symmetry.value)) {
    faults_.add(symmetry.place, fmt::format("symmetry {}", symmetry.value),
                "0 is none, 1 round, 2 in plane C0-C180, 3 in C90-C270, 4 in both");
  }
  const Token planes_line = text_.line(at_);
  planes_ = count("number of C-planes", 1, kMostIntensities);
  if (planes_ > 0 && ((symmetry_ == 2 && planes_ % 2 > 0) || (symmetry_ > 2 && planes_ % 4 > 0))) {
    faults_.add(planes_line, fmt::format("number of C-planes {}", planes_),
                symmetry_ == 2 ? "symmetry 2 needs an even number"
                               : fmt::format("symmetry {} needs a multiple of 4", symmetry_));
  }
  plane_step_deg_ = within("step of C-planes", 0, 360);
  gammas_ = count("number of gamma angles", 2, kMostIntensities);
  gamma_step_deg_ = within("step of gamma angles", 0, 180);
  (void)text_line();  // report
  name_ = readable(text_line().text);
  at_ += 3;  // number, file, date
  read_sizes();
  (void)number("downward flux");
  output_ratio_ = within("light output ratio in %", 0, 1e4) / 100;
  const PlacedValue conversion = number("conversion factor");
  conversion_ = conversion.value;
  if (conversion.value <= 0) {
    faults_.add(conversion.place, fmt::format("conversion factor {}", conversion.value),
                "give a number above 0, as a rule 1");
  }
  if (const double tilt_deg = number("tilt in the measurement").value;
      tilt_deg != 0 && !std::isnan(tilt_deg)) {
    notes_.push_back(
        fmt::format("measured at a tilt of {} degrees, which turns nothing", tilt_deg));
  }
}

void EulumdatReader::read_sizes() {
  constexpr double kMost_mm = 1000 * kMostSize_m;
  for (const char* what : {"length", "width", "height"}) (void)within(what, 0, kMost_mm);
  const double length_mm = within("luminous length", 0, kMost_mm),
               width_mm = within("luminous width", 0, kMost_mm);
  double height_mm = 0;
  for (const char* what : {"luminous height at C0", "luminous height at C90",
                           "luminous height at C180", "luminous height at C270"}) {
    height_mm = std::max(height_mm, within(what, 0, kMost_mm));
  }
  round_area_ = width_mm == 0 && length_mm > 0;
  // C90-C270 runs along the luminaire.
  size_m_ = Vector3d(round_area_ ? length_mm : width_mm, length_mm, height_mm) / 1000;
}

void EulumdatReader::read_lamps() {
  const std::size_t sets = count("number of lamp sets", 1, kMostSets);
  if (sets == 0) faults_.throw_faults();
  require_lines(sets * kSetLines + kRatios, "lines on lamps and direct ratios");
  for (std::size_t s = 0; s < sets; ++s) {
    const PlacedValue lamps = number("number of lamps");
    (void)text_line();  // type
    const PlacedValue flux = number("flux of the lamps");
    at_ += 2;  // colour, rendering
    const PlacedValue watts = number("watts", true);
    if (flux.value < 0) {
      faults_.add(flux.place, fmt::format("negative lamp flux {}", flux.value), "give 0 or more");
    }
    if (s > 0) continue;
    absolute_ = lamps.value < 0;
    flux_lm_ = flux.value;
    watts_ = std::isnan(watts.value) ? 0 : std::max(0.0, watts.value);
  }
  if (sets > 1) {
    notes_.push_back(
        fmt::format("{} sets of lamps are listed: they are alternatives, the first "
                    "is taken",
                    sets));
  }
  for (std::size_t k = 0; k < kRatios; ++k) (void)number("direct ratio");
}

std::vector<PlacedValue> EulumdatReader::angles(std::size_t count, std::string_view which) {
  std::vector<PlacedValue> all;
  for (std::size_t k = 0; k < count; ++k) all.push_back(number(fmt::format("{} angle", which)));
  for (std::size_t k = 1; k < count; ++k) {
    if (all[k].value <= all[k - 1].value) {
      faults_.add(all[k].place,
                  fmt::format("{} angle {} after {}", which, all[k].value, all[k - 1].value),
                  "give them rising; do the counts agree with the angles?");
      break;
    }
  }
  return all;
}

void EulumdatReader::note_step(const std::vector<PlacedValue>& all, double step_deg,
                               std::string_view which) {
  if (!(step_deg > 0)) return;
  for (std::size_t k = 1; k < all.size(); ++k) {
    if (std::abs(all[k].value - all[k - 1].value - step_deg) > kSameAngle_deg) {
      notes_.push_back(
          fmt::format("the {} angles are not {} degrees apart: the angles count", which, step_deg));
      return;
    }
  }
}

void EulumdatReader::read_angles() {
  if (planes_ == 0 || gammas_ == 0) faults_.throw_faults();
  require_lines(planes_ + gammas_, "angles");
  c_ = angles(planes_, "C");
  gamma_ = angles(gammas_, "gamma");
  note_step(c_, plane_step_deg_, "C");
  note_step(gamma_, gamma_step_deg_, "gamma");
  if (c_.front().value < 0 || c_.back().value >= 360) {
    const PlacedValue& wrong = c_.front().value < 0 ? c_.front() : c_.back();
    faults_.add(wrong.place, fmt::format("C angle {}", wrong.value), "give 0 to below 360");
  }
  if (gamma_.front().value < 0 || gamma_.back().value > 180) {
    const PlacedValue& wrong = gamma_.front().value < 0 ? gamma_.front() : gamma_.back();
    faults_.add(wrong.place, fmt::format("gamma angle {}", wrong.value), "give 0 to 180");
  }
  if (faults_.none()) check_planes();
  if (symmetry_ < 0) faults_.throw_faults();
}

/// Symmetry needs its planes at their places in the list.
void EulumdatReader::check_planes() {
  const auto need = [&](std::size_t index, double c_deg) {
    if (std::abs(c_[index].value - c_deg) < kSameAngle_deg) return;
    faults_.add(
        c_[index].place,
        fmt::format("C angle {} where symmetry {} has {}", c_[index].value, symmetry_, c_deg),
        "list all planes from 0, also those that are not stored");
  };
  if (symmetry_ != 1) need(0, 0);
  if (symmetry_ == 2) need(planes_ / 2, 180);
  if (symmetry_ == 3) need(3 * planes_ / 4, 270);
  if (symmetry_ == 3 || symmetry_ == 4) need(planes_ / 4, 90);
}

std::vector<std::size_t> EulumdatReader::stored_planes() const {
  const std::size_t stored = symmetry_ == 1   ? 1
                             : symmetry_ == 4 ? planes_ / 4 + 1
                             : symmetry_ == 0 ? planes_
                                              : planes_ / 2 + 1;
  const std::size_t first = symmetry_ == 3 ? 3 * planes_ / 4 : 0;  // C270, C0, C90
  std::vector<std::size_t> planes;
  for (std::size_t k = 0; k < stored; ++k) planes.push_back((first + k) % planes_);
  return planes;
}

void EulumdatReader::read_intensities() {
  const std::vector<std::size_t> planes = stored_planes();
  const std::size_t values = planes.size() * gammas_;
  if (static_cast<double>(values) > kMostIntensities) {
    faults_.add(text_.line(3), fmt::format("{} intensities", values),
                "ten million are the most that are read");
    faults_.throw_faults();
  }
  require_lines(values, "intensities");
  const double lamp_klm = flux_lm_ > 0 ? flux_lm_ / 1000 : 1;
  const Token start = text_.line(at_);
  stored_.intensity_cd.resize(static_cast<Index>(planes.size()), static_cast<Index>(gammas_));
  for (std::size_t p = 0; p < planes.size(); ++p) {
    stored_.angle_deg.push_back(c_[planes[p]].value);
    for (std::size_t g = 0; g < gammas_; ++g) {
      const PlacedValue v = number("intensity");
      const double cd = v.value * conversion_ * lamp_klm;
      if (v.value < 0) {
        faults_.add(v.place,
                    fmt::format("negative intensity {} at gamma {}, C {}", v.value, gamma_[g].value,
                                c_[planes[p]].value),
                    "give 0 or more");
      } else if (cd > kMost_cd) {
        faults_.add(v.place, fmt::format("intensity {} cd", cd),
                    "no luminaire has more than 1e12 cd");
      }
      stored_.intensity_cd(static_cast<Index>(p), static_cast<Index>(g)) = cd;
    }
  }
  if (faults_.none() && !(stored_.intensity_cd.maxCoeff() > 0)) {
    faults_.add(start, "no light at all", "give some intensity above 0");
  }
}

void EulumdatReader::expect_end() {
  std::size_t more = 0;
  Token first;
  for (; at_ < text_.lines().size(); ++at_) {
    const Token line = text_.line(at_);
    if (line.text.empty()) continue;
    if (more++ == 0) first = line;
  }
  if (more > 0) {
    faults_.add(first, fmt::format("{} than announced", counted(more, "more value")),
                "make the counts and the values agree");
  }
}

Luminaire EulumdatReader::finish() {
  constexpr std::array kSymmetries{PlaneSymmetry::none, PlaneSymmetry::round,
                                   PlaneSymmetry::about_0_180, PlaneSymmetry::about_90_270,
                                   PlaneSymmetry::both};
  const PlaneSymmetry symmetry = kSymmetries[static_cast<std::size_t>(symmetry_)];
  const HalfPlanes all = all_around(stored_, symmetry);
  std::vector<double> gamma;
  for (const PlacedValue& g : gamma_) gamma.push_back(g.value);
  Luminaire lamp{.path = text_.path(),
                 .format = "EULUMDAT",
                 .name = maker_ + (maker_.empty() || name_.empty() ? "" : ", ") + name_,
                 .symmetry = std::string(to_string(symmetry)),
                 .intensity = {Goniometry::c, gamma, all.angle_deg, all.intensity_cd}};
  lamp.flux_lm = lamp.intensity.flux_lm();
  lamp.input_W = watts_;
  lamp.shape = size_m_.isZero() ? LuminousShape::point
               : size_m_.z() == 0
                   ? (round_area_ ? LuminousShape::ellipse : LuminousShape::rectangle)
               : round_area_ ? LuminousShape::cylinder
                             : LuminousShape::box;
  lamp.size_m = size_m_;
  lamp.needs_flux = flux_lm_ == 0;
  if (lamp.needs_flux) {
    notes_.emplace_back("lamp flux 0: cd per klm need it; give \"flux_lm\" in the room");
  } else {
    if (!absolute_) lamp.lamps_lm = flux_lm_;
    if (output_ratio_ > 0) lamp.printed_lm = output_ratio_ * flux_lm_;
  }
  lamp.notes = notes_;
  for (std::string& note : oddities(lamp)) lamp.notes.push_back(std::move(note));
  return lamp;
}

}  // namespace

Luminaire read_eulumdat(const LuminaireText& text) { return EulumdatReader(text).read(); }

}  // namespace scenes
