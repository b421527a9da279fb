#include "scenes/files/curve_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <stdexcept>

#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/lamp_choice.h"
#include "appearance/spectra/light_file.h"
#include "appearance/spectra/photometry.h"
#include "appearance/spectra/reconstruct.h"
#include "appearance/spectra/spectrum_library.h"
#include "scenes/files/colour_forms.h"

namespace scenes {
namespace {

using spectra::JsonNode;
using spectra::JsonObject;
using spectra::Limits;
using spectra::Samples;
using spectra::Spectrum;

constexpr Limits kReflectance{.least = 0, .most = 1, .below_most = true};
constexpr Limits kTransmittance{.least = 0, .most = 1};
constexpr Limits kPower{.least = 0, .most = 1e12};
constexpr Limits kWavelength_nm{.least = 100, .most = 1e4};

/// { nm, values }; no samples after a fault.
Samples read_samples(const JsonNode& node, const Limits& limits) {
  const JsonObject curve = node.object({"nm", "values"});
  const auto nm = curve.need("nm"), values = curve.need("values");
  if (!nm || !values) return {};
  Samples samples;
  for (const JsonNode& entry : nm->list(2, 100'000)) {
    const double wavelength = entry.number(kWavelength_nm);
    if (!samples.nm.empty() && wavelength <= samples.nm.back()) {
      entry.fault(fmt::format("{} nm follows {} nm", wavelength, samples.nm.back()),
                  "give strictly rising wavelengths");
      return {};
    }
    samples.nm.push_back(wavelength);
  }
  if (samples.nm.empty()) return {};
  samples.values = values->numbers(samples.nm.size(), limits);
  bool readable = true;
  for (const double v : samples.nm) readable = readable && std::isfinite(v);
  for (const double v : samples.values) readable = readable && std::isfinite(v);
  return readable ? samples : Samples{};
}

Samples samples_of(const Spectrum& spectrum) {
  Samples samples;
  for (int k = 0; k < spectrum.grid.count; ++k) {
    samples.nm.push_back(spectrum.grid.wavelength_nm(k));
    samples.values.push_back(spectrum.values[k]);
  }
  return samples;
}

void no_such_curve(const JsonNode& node, const std::string& path, const std::string& name,
                   const std::vector<std::string>& names) {
  const std::string near = spectra::nearest_name(name, names);
  node.fault(fmt::format("{} has no curve \"{}\"", path, name),
             near.empty() ? fmt::format("it has {}, among them \"{}\"", names.size(),
                                        names.empty() ? "" : names.front())
                          : fmt::format("did you mean \"{}\"?", near));
}

}  // namespace

CurveReader::CurveReader(spectra::JsonFile& file, const spectra::Grid& grid)
    : file_(file), grid_(grid), folder_(std::filesystem::path(file.path()).parent_path()) {}

Spectrum CurveReader::unreadable() const {
  return spectra::constant(grid_, std::numeric_limits<double>::quiet_NaN());
}

std::string CurveReader::resolve(const std::string& path) const {
  return (std::filesystem::path(folder_) / path).string();
}

void CurveReader::note(const JsonNode& node, const std::string& what) {
  notes_.push_back(node.pointer() + ": " + what);
}

std::optional<Spectrum> CurveReader::on_grid(const JsonNode& node, const Samples& samples,
                                             Kind kind) {
  if (samples.nm.empty()) return std::nullopt;
  if (const std::string missing = spectra::missing_range(samples, grid_); !missing.empty()) {
    const bool overlaps =
        samples.nm.front() <= grid_.last_nm() && samples.nm.back() >= grid_.first_nm;
    if (grid_ != spectra::kClosedFormGrid || !overlaps) {
      node.fault(fmt::format("the curve lacks {}", missing),
                 fmt::format("cover {}..{} nm", grid_.first_nm, grid_.last_nm()));
      return std::nullopt;
    }
    note(node,
         fmt::format("{} completed by {}", missing, kind == Kind::light ? "0" : "the end values"));
  }
  return kind == Kind::light ? spectra::light_on(grid_, samples)
                             : spectra::reflectance_on(grid_, samples);
}

Spectrum CurveReader::reflecting(const JsonNode& node, const Samples& samples) {
  return on_grid(node, samples, Kind::reflectance).value_or(unreadable());
}

Spectrum CurveReader::shining(const JsonNode& node, const Samples& samples) {
  const std::optional<Spectrum> light = on_grid(node, samples, Kind::light);
  if (light && spectra::luminous(*light) <= 0) {
    node.fault("the spectrum holds no visible light", "give some power between 400 and 700 nm");
  }
  return light.value_or(unreadable());
}

Reflectance CurveReader::reflectance(const JsonNode& node) {
  if (node.is(JsonNode::Kind::number)) {
    const double rho = node.number(kReflectance);
    return {.spectrum = spectra::constant(grid_, rho), .name = fmt::format("{}", rho)};
  }
  if (node.has("paint") || node.has("munsell")) return paint(node);
  if (node.has("reconstruct_srgb")) return reconstructed(node);
  if (node.has("file") || node.has("name")) {
    return paint_of_file(node);
  }
  if (states_colour(node)) return stated(node);
  if (node.has("nm") || node.has("values")) {
    return {.spectrum = reflecting(node, read_samples(node, kReflectance)), .name = "from samples"};
  }
  if (node.is(JsonNode::Kind::object) && !node.empty()) {
    (void)node.object({"nm", "values", "paint", "file", "name", "reconstruct_srgb", "hex", "Lab",
                       "XYZ", "xyY", "LRV", "munsell"});
  } else {
    node.fault("this is no reflectance",
               "give a number from 0 to below 1, or {\"nm\", \"values\"}, {\"paint\"}, "
               "{\"file\", \"name\"}, {\"reconstruct_srgb\"}, {\"hex\"}, {\"Lab\"}, {\"XYZ\"}, "
               "{\"xyY\"}, {\"LRV\"} or {\"munsell\"}");
  }
  return {.spectrum = unreadable()};
}

Reflectance CurveReader::paint(const JsonNode& node) {
  const bool munsell = node.has("munsell");
  std::string name =
      node.object({munsell ? "munsell" : "paint"}).name(munsell ? "munsell" : "paint");
  if (name.empty()) return {.spectrum = unreadable()};
  if (munsell) name = "munsell-renotation:" + name;
  try {
    const auto [set, entry] = spectra::find_paint(name);
    return {.spectrum = reflecting(node, entry->samples),
            .reconstructed = set->reconstructed,
            .name = fmt::format("{}:{}", set->name, entry->name)};
  } catch (const std::invalid_argument& error) {
    node.fault(error.what(), "give \"ATLAS:NAME\", the atlas being " +
                                 spectra::alternatives(spectra::atlas_names()));
  }
  return {.spectrum = unreadable()};
}

Reflectance CurveReader::reconstructed(const JsonNode& node) {
  const std::vector<double> rgb =
      node.object({"reconstruct_srgb"}).numbers("reconstruct_srgb", 3, {.least = 0, .most = 1});
  const auto reconstruction = std::isfinite(rgb[0] + rgb[1] + rgb[2])
                                  ? spectra::reconstruct_srgb(rgb[0], rgb[1], rgb[2])
                                  : spectra::Reconstruction{};
  if (!reconstruction.converged) {
    if (std::isfinite(rgb[0] + rgb[1] + rgb[2])) {
      node.fault("no reflectance below 1 has this colour", "choose a less light or less pure one");
    }
    return {.spectrum = unreadable()};
  }
  const Samples samples = samples_of(reconstruction.reflectance);
  note(node, "the reflectance was reconstructed from an sRGB colour, not measured");
  return {.spectrum = reflecting(node, samples),
          .reconstructed = true,
          .name = fmt::format("sRGB {} {} {}", rgb[0], rgb[1], rgb[2])};
}

Reflectance CurveReader::stated(const JsonNode& node) {
  const NamedColour colour = read_colour(node);
  if (!colour.colour) return {.spectrum = unreadable()};
  const spectra::Reconstruction r = spectra::reconstruct_stated(*colour.colour);
  if (!r.converged) {
    node.fault("no reflectance below 1 has this colour", "choose a less light or less pure one");
    return {.spectrum = unreadable()};
  }
  note(node, fmt::format("the reflectance was reconstructed from {}, not measured", colour.name));
  return {.spectrum = reflecting(node, samples_of(r.reflectance)),
          .reconstructed = true,
          .name = colour.name};
}

Spectrum CurveReader::transmittance(const JsonNode& node) {
  if (node.is(JsonNode::Kind::number)) {
    return spectra::constant(grid_, node.number(kTransmittance));
  }
  return reflecting(node, read_samples(node, kTransmittance));
}

Spectrum CurveReader::absolute_light(const JsonNode& node) {
  return shining(node, read_samples(node, kPower));
}

LightShape CurveReader::light_shape(const JsonNode& node) {
  if (node.has("preset")) return preset(node);
  return {.spectrum = shining(node, curve_of_light(node))};
}

Samples CurveReader::curve_of_light(const JsonNode& node) {
  try {
    if (node.has("illuminant")) {
      const std::vector<std::string>& names = spectra::illuminant_names();
      const auto name = node.object({"illuminant"}).find("illuminant");
      const int index = name->choice(names);
      return index < 0 ? Samples{} : spectra::illuminant(names[static_cast<std::size_t>(index)]);
    }
    if (node.has("planck_K")) {
      const double temperature_K =
          node.object({"planck_K"}).number("planck_K", {.least = 100, .most = 1e6});
      return std::isfinite(temperature_K) ? spectra::planck(temperature_K) : Samples{};
    }
    if (node.has("daylight_K")) {
      const double cct_K =
          node.object({"daylight_K"}).number("daylight_K", {.least = 4000, .most = 25000});
      return std::isfinite(cct_K) ? spectra::daylight(cct_K) : Samples{};
    }
    if (node.has("box")) return lamp_by_box(node);
    if (node.has("lamp")) {
      const std::string name = node.object({"lamp"}).name("lamp");
      return name.empty() ? Samples{} : spectra::find_lamp(name).spectrum->samples;
    }
  } catch (const std::invalid_argument& error) {
    node.fault(error.what(), "see scenes/README.md for the lamps and illuminants there are");
    return {};
  }
  if (node.has("file") || node.has("name")) return light_of_file(node);
  if (node.has("nm") || node.has("values")) return read_samples(node, kPower);
  if (node.is(JsonNode::Kind::object) && !node.empty()) {
    (void)node.object({"illuminant", "planck_K", "daylight_K", "lamp", "box", "preset", "nm",
                       "values", "file", "name"});
  } else {
    node.fault("this is no spectrum of light",
               "give {\"illuminant\"}, {\"planck_K\"}, {\"daylight_K\"}, {\"lamp\"}, {\"box\"}, "
               "{\"preset\"}, {\"nm\", \"values\"} or {\"file\", \"name\"}");
  }
  return {};
}

Samples CurveReader::lamp_by_box(const JsonNode& node) {
  const auto place = node.object({"box"}).find("box");
  const JsonObject entry = place->object({"kind", "cct_K", "ra", "r9"});
  const auto kind = entry.need("kind");
  const int index = kind ? kind->choice(spectra::lamp_kinds()) : -1;
  spectra::LampBox box{.cct_K = entry.number("cct_K", {.least = 1000, .most = 25000}),
                       .ra = entry.number("ra", {.least = 0, .most = 100})};
  if (entry.has("r9")) box.r9 = entry.number("r9", {.least = -400, .most = 100});
  if (index < 0 || !std::isfinite(box.cct_K + box.ra + box.r9.value_or(0))) return {};
  box.kind = spectra::lamp_kinds()[static_cast<std::size_t>(index)];
  const std::vector<spectra::LampMatch> matches = spectra::lamps_like(box);
  const auto fitting = std::ranges::find_if(
      matches, [&](const spectra::LampMatch& m) { return spectra::stands_for(*m.lamp, box); });
  const spectra::LampFacts& lamp =
      fitting == matches.end() ? *matches.front().lamp : *fitting->lamp;
  if (fitting == matches.end()) {
    place->fault(
        fmt::format("no measured {} lamp is near {} K, Ra {}; the nearest is houser:{}, "
                    "{}: {}",
                    box.kind, box.cct_K, box.ra, lamp.name, lamp.label, spectra::in_words(lamp)),
        "take that one as {\"lamp\"}, or see \"roomhue lamps\", or give its spectrum");
    return {};
  }
  note(node,
       fmt::format("taken as houser:{}, {}: {}", lamp.name, lamp.label, spectra::in_words(lamp)));
  return spectra::find_lamp("houser:" + lamp.name).spectrum->samples;
}

LightShape CurveReader::preset(const JsonNode& node) {
  const std::string name = node.object({"preset"}).name("preset");
  std::vector<std::string> names;
  for (const spectra::LampPreset& lamp : spectra::lamp_presets()) {
    if (lamp.name == name) {
      return {.spectrum = shining(node, spectra::planck(lamp.temperature_K)),
              .efficacy_lm_W = lamp.efficacy_lm_W};
    }
    names.push_back(lamp.name);
  }
  if (!name.empty()) {
    const std::string near = spectra::nearest_name(name, names);
    node.fault(fmt::format("there is no lamp preset \"{}\"", name),
               near.empty() ? "give " + spectra::alternatives(names)
                            : fmt::format("did you mean \"{}\"?", near));
  }
  return {.spectrum = unreadable()};
}

template <typename File>
const File* CurveReader::file(const JsonNode& node, const std::string& path,
                              std::map<std::string, File>& known,
                              File (*read)(const std::string& path)) {
  if (const auto found = known.find(path); found != known.end()) return &found->second;
  try {
    return &known.emplace(path, read(path)).first->second;
  } catch (const spectra::FileError& error) {
    node.fault(error.what(), "give a path relative to the folder of this file");
  } catch (const spectra::InputError& error) {
    file_.add(error.faults());
    node.fault(fmt::format("{} is faulty", path), "mend that file");
  }
  return nullptr;
}

void CurveReader::check_atlas(const JsonNode& node, const std::string& path) {
  (void)file(node, path, paint_files_, &paints::read_paint_file);
}

Reflectance CurveReader::paint_of_file(const JsonNode& node) {
  Reflectance reflectance{.spectrum = unreadable(), .name = "from file"};
  const JsonObject reference = node.object({"file", "name"});
  const std::string path = reference.name("file"), name = reference.name("name");
  if (path.empty() || name.empty()) return reflectance;
  const paints::PaintFile* paints =
      file(node, resolve(path), paint_files_, &paints::read_paint_file);
  if (paints == nullptr) return reflectance;
  const auto found = std::ranges::find(paints->paints, name, &paints::FilePaint::name);
  if (found == paints->paints.end()) {
    std::vector<std::string> names;
    for (const paints::FilePaint& paint : paints->paints) names.push_back(paint.name);
    no_such_curve(node, path, name, names);
    return reflectance;
  }
  if (paints->percent) note(node, path + " is in percent; divided by 100");
  for (const std::string& said : paints->notes) note(node, path + ": " + said);
  reflectance.spectrum = reflecting(node, found->reflectance);
  reflectance.reconstructed = found->reconstructed;
  return reflectance;
}

Samples CurveReader::light_of_file(const JsonNode& node) {
  const JsonObject reference = node.object({"file", "name"});
  const std::string path = reference.name("file");
  const std::string name = reference.has("name") ? reference.name("name") : "";
  if (path.empty() || (reference.has("name") && name.empty())) return {};
  const spectra::SpectrumFile* curves =
      file(node, resolve(path), light_files_, &spectra::read_light_file);
  if (curves == nullptr) return {};
  const std::vector<spectra::NamedSpectrum>& entries = curves->set.entries;
  if (name.empty() && entries.size() == 1) return entries.front().samples;
  std::vector<std::string> names;
  for (const spectra::NamedSpectrum& entry : entries) {
    if (entry.name == name) return entry.samples;
    names.push_back(entry.name);
  }
  if (name.empty()) {
    node.fault(fmt::format("{} has {} curves", path, names.size()),
               "add \"name\", one of " + spectra::alternatives(names));
    return {};
  }
  no_such_curve(node, path, name, names);
  return {};
}

}  // namespace scenes
