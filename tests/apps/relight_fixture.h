#pragma once
#include <gtest/gtest.h>

#include <Eigen/Core>

#include "tests/apps/exr_files.h"
#include "tests/apps/program.h"

namespace apps::test {

/// From the blue sky of [Granier2004] 7.2 to its yellow light.
inline const std::string kLights = " --from 0.4,0.9,1.0 --to 1.0,0.9,0.1 ";
inline const Eigen::Vector3d kSky{0.4, 0.9, 1.0}, kYellow{1.0, 0.9, 0.1};

struct Relight : ::testing::Test {
  [[nodiscard]] ProgramRun relight(const std::string& options = kLights) const {
    return roomhue("relight " + in.string() + " " + out.string() + " " + options);
  }

  /// A small picture of floats, its pixels given.
  void write_pixels(const std::vector<Eigen::Vector3d>& pixels,
                    Imf::PixelType type = Imf::FLOAT) const {
    Imf::Header header(static_cast<int>(pixels.size()), 1);
    for (const char* name : {"R", "G", "B"}) header.channels().insert(name, Imf::Channel(type));
    write_exr(in.string(), header, [&](const std::string& channel, std::size_t k) {
      return pixels[k][channel == "R" ? 0 : channel == "G" ? 1 : 2];
    });
  }

  TemporaryFolder folder;
  fs::path in = folder / "in.exr", out = folder / "out.exr";
};

}  // namespace apps::test
