#include "paints/atlas_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "appearance/spectra/spectrum_file.h"
#include "appearance/spectra/spectrum_library.h"
#include "appearance/spectra/text/input_error.h"

namespace paints {
namespace {

Atlas on_grid(const spectra::SpectrumSet& set, const spectra::Grid& grid) {
  Atlas atlas{.name = set.name, .source = set.source, .reconstructed = set.reconstructed};
  atlas.paints.reserve(set.entries.size());
  for (const spectra::NamedSpectrum& entry : set.entries) {
    atlas.paints.push_back({.name = entry.name,
                            .reflectance = spectra::reflectance_on(grid, entry.samples),
                            .label = entry.label});
  }
  return atlas;
}

Atlas read_atlas(const std::string& path, const spectra::Grid& grid) {
  const spectra::SpectrumFile file =
      spectra::read_spectrum_file(path, spectra::CurveKind::reflectance);
  // The header gives every curve the same wavelengths, so the first one speaks for all.
  require_coverage(path, file.set.entries.front().samples, grid);
  Atlas atlas = on_grid(file.set, grid);
  atlas.percent = file.percent;
  return atlas;
}

}  // namespace

void require_coverage(const std::string& path, const spectra::Samples& curve,
                      const spectra::Grid& grid) {
  const std::string missing = spectra::missing_range(curve, grid);
  if (missing.empty()) return;
  throw spectra::InputError(
      {{.file = path,
        .line = 1,
        .column = 1,
        .pointer = "header",
        .problem = fmt::format("{} missing", missing),
        .remedy = fmt::format("give the curves for {}..{} nm", grid.first_nm, grid.last_nm())}});
}

Atlas load_atlas(const std::string& name_or_path, const spectra::Grid& grid) {
  const std::vector<std::string>& names = spectra::atlas_names();
  if (std::find(names.begin(), names.end(), name_or_path) != names.end()) {
    return on_grid(spectra::atlas(name_or_path), grid);
  }
  if (!std::filesystem::exists(name_or_path)) {
    throw spectra::FileError(fmt::format("{}: neither a file nor one of the atlases {}",
                                         name_or_path, fmt::join(names, ", ")));
  }
  return read_atlas(name_or_path, grid);
}

}  // namespace paints
