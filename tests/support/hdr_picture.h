#pragma once
#include <Imath/half.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "appearance/spectra/bilinear.h"

namespace support {

/// A picture of high dynamic range whose reflectances are known: a wall of 24 painted fields, lit
/// by a window of the light's own colour, a thousand times brighter than the darkest corner.
struct HdrPicture {
  int width = 192, height = 128;
  std::array<std::vector<float>, 3> rgb;
  std::vector<float> alpha;    ///< 0 in the window
  std::vector<float> depth_m;  ///< infinite in the window
};

/// The same wall in light of any colour: each pixel is the product of light and reflectance, dimmed
/// by the distance from the window.
inline HdrPicture hdr_picture(const spectra::BilinearSet& set, const Eigen::Vector3d& light) {
  HdrPicture picture;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const double u = (x + 0.5) / picture.width, v = (y + 0.5) / picture.height;
      const bool window = u < 0.15 && v < 0.4;
      const int field = static_cast<int>(u * 6) + 6 * static_cast<int>(v * 4);
      // Reflectances all over the colour solid, 0.04 to 0.96, no two fields alike.
      const Eigen::Vector3d paint{0.04 + 0.92 * (field * 7 % 24) / 23,
                                  0.04 + 0.92 * (field * 5 % 24) / 23,
                                  0.04 + 0.92 * (field * 11 % 24) / 23};
      const double depth_m = 0.3 + 4 * std::hypot(u, v);
      const Eigen::Vector3d seen =
          window ? Eigen::Vector3d(100 * light)
                 : Eigen::Vector3d(spectra::product(set, light, paint) / (depth_m * depth_m));
      for (int c = 0; c < 3; ++c) {
        picture.rgb[static_cast<std::size_t>(c)].push_back(static_cast<float>(seen[c]));
      }
      picture.alpha.push_back(window ? 0.0F : 1.0F);
      picture.depth_m.push_back(window ? INFINITY : static_cast<float>(depth_m));
    }
  }
  return picture;
}

/// R, G, B and A as halves, Z as float.
inline void write_exr(const HdrPicture& picture, const std::string& path) {
  Imf::Header header(picture.width, picture.height);
  Imf::FrameBuffer slices;
  std::array<std::vector<half>, 4> halves;
  const auto row = static_cast<std::size_t>(picture.width);
  for (std::size_t c = 0; c < 4; ++c) {
    const std::vector<float>& values = c < 3 ? picture.rgb[c] : picture.alpha;
    halves[c].assign(values.begin(), values.end());
    const std::string name(1, "RGBA"[c]);
    header.channels().insert(name, Imf::Channel(Imf::HALF));
    slices.insert(name, Imf::Slice(Imf::HALF, reinterpret_cast<char*>(halves[c].data()),
                                   sizeof(half), sizeof(half) * row));
  }
  std::vector<float> depth_m = picture.depth_m;
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  slices.insert("Z", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(depth_m.data()), sizeof(float),
                                sizeof(float) * row));
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(slices);
  file.writePixels(picture.height);
}

}  // namespace support
