#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "appearance/spectra/spectrum.h"
#include "appearance/spectra/spectrum_file.h"
#include "appearance/spectra/text/json_reader.h"
#include "paints/files/paint_reader.h"

namespace scenes {

struct Reflectance {
  spectra::Spectrum spectrum;
  bool reconstructed = false;  ///< computed from a colour, not measured
  std::string name;            ///< of the paint, for reports
};

/// Relative spectral power, and the efficacy that is known with it.
struct LightShape {
  spectra::Spectrum spectrum;
  double efficacy_lm_W = 0;  ///< 0: not known
};

/// Reads every form of reflectance and light of the room format (scenes/README.md) onto one grid.
/// Faults are collected in the JSON file; a curve with a fault comes back as NaN.
class CurveReader {
 public:
  /// `file` must outlive the reader; paths are relative to its folder.
  CurveReader(spectra::JsonFile& file, const spectra::Grid& grid);

  [[nodiscard]] const spectra::Grid& grid() const { return grid_; }

  [[nodiscard]] spectra::Spectrum zero() const { return spectra::constant(grid_, 0); }

  /// A number, { nm, values }, { paint }, { file, name }, { reconstruct_srgb } or a colour
  /// (colour_forms.h); 0 <= rho < 1.
  [[nodiscard]] Reflectance reflectance(const spectra::JsonNode& node);
  /// A number or { nm, values }; 0 to 1.
  [[nodiscard]] spectra::Spectrum transmittance(const spectra::JsonNode& node);
  /// { illuminant }, { planck_K }, { daylight_K }, { lamp }, { box }, { preset }, { nm, values } or
  /// { file, name }, with some luminance.
  [[nodiscard]] LightShape light_shape(const spectra::JsonNode& node);
  /// { nm, values } in W m^-2 nm^-1.
  [[nodiscard]] spectra::Spectrum absolute_light(const spectra::JsonNode& node);

  /// A fault at `node` if `path` is no readable file of reflectances.
  void check_atlas(const spectra::JsonNode& node, const std::string& path);

  /// A path of the file, seen from here.
  [[nodiscard]] std::string resolve(const std::string& path) const;

  /// What was completed or converted, one sentence each.
  [[nodiscard]] const std::vector<std::string>& notes() const { return notes_; }

 private:
  using Kind = spectra::CurveKind;

  [[nodiscard]] spectra::Spectrum unreadable() const;
  void note(const spectra::JsonNode& node, const std::string& what);
  [[nodiscard]] Reflectance paint(const spectra::JsonNode& node);
  [[nodiscard]] Reflectance reconstructed(const spectra::JsonNode& node);
  [[nodiscard]] LightShape preset(const spectra::JsonNode& node);
  [[nodiscard]] spectra::Samples lamp_by_box(const spectra::JsonNode& node);
  [[nodiscard]] spectra::Samples curve_of_light(const spectra::JsonNode& node);
  [[nodiscard]] Reflectance paint_of_file(const spectra::JsonNode& node);
  [[nodiscard]] Reflectance stated(const spectra::JsonNode& node);
  [[nodiscard]] spectra::Samples light_of_file(const spectra::JsonNode& node);
  /// A file once read stays in `known`; nothing after a fault.
  template <typename File>
  [[nodiscard]] const File* file(const spectra::JsonNode& node, const std::string& path,
                                 std::map<std::string, File>& known,
                                 File (*read)(const std::string& path));
  [[nodiscard]] std::optional<spectra::Spectrum> on_grid(const spectra::JsonNode& node,
                                                         const spectra::Samples& samples,
                                                         Kind kind);
  [[nodiscard]] spectra::Spectrum reflecting(const spectra::JsonNode& node,
                                             const spectra::Samples& samples);
  [[nodiscard]] spectra::Spectrum shining(const spectra::JsonNode& node,
                                          const spectra::Samples& samples);

  spectra::JsonFile& file_;
  spectra::Grid grid_;
  std::string folder_;
  std::vector<std::string> notes_;
  std::map<std::string, paints::PaintFile> paint_files_;
  std::map<std::string, spectra::SpectrumFile> light_files_;
};

}  // namespace scenes
