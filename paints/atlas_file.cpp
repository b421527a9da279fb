#include "paints/atlas_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "appearance/spectra/spectrum_library.h"
#include "appearance/spectra/text/input_error.h"
#include "paints/files/paint_reader.h"

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

Atlas read_atlas(const std::string& path_and_choices, const spectra::Grid& grid) {
  const PaintFile file = read_paint_file(path_and_choices);
  Atlas atlas{.name = path_and_choices,
              .source = path_and_choices,
              .percent = file.percent,
              .notes = file.notes};
  atlas.paints.reserve(file.paints.size());
  for (const FilePaint& paint : file.paints) {
    require_coverage(file.path, paint.reflectance, grid);
    atlas.reconstructed = atlas.reconstructed || paint.reconstructed;
    atlas.paints.push_back({.name = paint.name,
                            .reflectance = spectra::reflectance_on(grid, paint.reflectance),
                            .label = paint.label});
  }
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
        .remedy = fmt::format("give the curves for {}..{} nm; of up to 10 nm ends=hold keeps "
                              "the end values",
                              grid.first_nm, grid.last_nm())}});
}

Atlas load_atlas(const std::string& name_or_path, const spectra::Grid& grid) {
  const std::vector<std::string>& names = spectra::atlas_names();
  if (std::find(names.begin(), names.end(), name_or_path) != names.end()) {
    return on_grid(spectra::atlas(name_or_path), grid);
  }
  if (!std::filesystem::exists(paint_source(name_or_path).path)) {
    throw spectra::FileError(fmt::format("{}: neither a file nor one of the atlases {}",
                                         name_or_path, fmt::join(names, ", ")));
  }
  return read_atlas(name_or_path, grid);
}

}  // namespace paints
