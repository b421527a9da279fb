#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

namespace scenes {

/// Polygons as a Wavefront OBJ file lists them, in its own unit and axes.
struct ObjFile {
  struct Face {
    std::vector<int> corners;  ///< into ObjFile::corners
    std::string material;      ///< of `usemtl`; empty: none
    int line = 0;
  };

  std::vector<Eigen::Vector3d> corners;
  std::vector<Face> faces;
  std::vector<std::string> notes;  ///< what was left out
};

/// Points, lines, curves, texture coordinates and normals are left out; material files are not
/// read. `usemtl` rules, not `g`.
/// @throws spectra::FileError   if it cannot be read
/// @throws spectra::InputError  with every fault of the file, up to a hundred
[[nodiscard]] ObjFile read_obj(const std::string& path);

}  // namespace scenes
