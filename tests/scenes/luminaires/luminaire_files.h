#pragma once
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "scenes/luminaires/luminaire_file.h"
#include "tests/scenes/room_files.h"

namespace scenes {

/// The parts of an IES file; tests change them.
struct IesText {
  std::string version = "IESNA:LM-63-2002";
  std::string tilt = "TILT=NONE";
  std::string lamps = "1 1000 1", type = "1 2", size = "0 0 0", factors = "1 1 20";
  std::vector<double> vertical{0, 45, 90}, horizontal{0};
  std::vector<double> candela{300, 200, 0};

  [[nodiscard]] std::string text() const {
    return fmt::format("{}\n[LUMINAIRE] lamp\n{}\n{} {} {} {} {}\n{}\n{}\n{}\n{}\n", version, tilt,
                       lamps, vertical.size(), horizontal.size(), type, size, factors,
                       fmt::join(vertical, " "), fmt::join(horizontal, " "),
                       fmt::join(candela, " "));
  }
};

/// The parts of an EULUMDAT file.
struct LdtText {
  int symmetry = 1, planes = 1;
  std::vector<double> c{0}, gamma{0, 45, 90};
  std::vector<double> per_klm{300, 200, 0};
  std::string luminous = "1200\n300\n0\n0\n0\n0";
  std::string output = "100\n50\n1\n0";  ///< downward, LORL, conversion, tilt
  std::string lamps = "1\n2\nT16\n2000\n840\n1A/>90\n29 W";

  [[nodiscard]] std::string text() const {
    return fmt::format(
        "maker\n1\n{}\n{}\n0\n{}\n0\nreport\nlamp\nnumber\nfile\ndate\n1250\n350\n60\n{}\n{}\n{}\n"
        "{}\n{}\n{}\n{}\n",
        symmetry, planes, gamma.size(), luminous, output, lamps, "1\n1\n1\n1\n1\n1\n1\n1\n1\n1",
        fmt::join(c, "\n"), fmt::join(gamma, "\n"), fmt::join(per_klm, "\n"));
  }
};

inline Luminaire read(const IesText& file) {
  return read_luminaire(write_file("lamp.ies", file.text()));
}

inline Luminaire read(const LdtText& file) {
  return read_luminaire(write_file("lamp.ldt", file.text()));
}

/// Of the axes of IntensityTable, at angles of type C.
inline Eigen::Vector3d direction_c(double c_deg, double gamma_deg) {
  const double c = c_deg * M_PI / 180, gamma = gamma_deg * M_PI / 180;
  return {std::sin(gamma) * std::cos(c), std::sin(gamma) * std::sin(c), -std::cos(gamma)};
}

inline std::string joined(const std::vector<std::string>& notes) {
  return fmt::format("{}", fmt::join(notes, "\n"));
}

}  // namespace scenes
