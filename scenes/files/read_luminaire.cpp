// Luminaires of a room file: a photometric file, where it hangs, and how much light it gives.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "appearance/spectra/photometry.h"
#include "scenes/files/room_reader.h"
#include "scenes/geometry/fits.h"
#include "scenes/luminaires/luminaire_file.h"
#include "scenes/luminaires/measures.h"

namespace scenes {

using Eigen::Vector3d;
using spectra::JsonNode;
using spectra::JsonObject;

namespace {

constexpr spectra::Limits kFlux_lm{.least = 0, .most = 1e9, .above_least = true};
constexpr spectra::Limits kDim{.least = 0, .most = 10, .above_least = true};
constexpr spectra::Limits kTurn_deg{.least = -360, .most = 360};

/// Points all over the luminous body, in the room.
std::vector<Vector3d> body_of(const PlacedLuminaire& luminaire) {
  std::vector<Vector3d> points;
  for (const double x : {-0.5, -0.25, 0.0, 0.25, 0.5}) {
    for (const double y : {-0.5, -0.25, 0.0, 0.25, 0.5}) {
      for (const double z : {-0.5, 0.5}) {
        const Vector3d local = luminaire.type->size_m.cwiseProduct(Vector3d(x, y, z));
        points.push_back(luminaire.at_m + luminaire.axes * local);
      }
    }
  }
  return points;
}

}  // namespace

std::shared_ptr<const Luminaire> RoomReader::luminaire_file(const JsonNode& node,
                                                            const std::string& path) {
  const auto known = luminaire_files_.find(path);
  if (known != luminaire_files_.end()) return known->second;
  std::shared_ptr<const Luminaire>& type = luminaire_files_[path];
  try {
    type = std::make_shared<const Luminaire>(read_luminaire(path));
    for (const std::string& note : type->notes) {
      room_.notes.push_back(fmt::format("{}: {}: {}", node.pointer(), path, note));
    }
  } catch (const spectra::FileError& error) {
    node.fault(error.what(), "give a path relative to the folder of this file");
  } catch (const spectra::InputError& error) {
    file_.add(error.faults());
    node.fault(fmt::format("{} is faulty", path), "mend that file");
  }
  return type;
}

void RoomReader::read_luminaire_light(const LightEntry& entry) {
  const JsonObject place = entry.kind.object({"file", "at_m", "aim", "rotate_deg"});
  const std::string path = place.name("file");
  const std::vector<double> at = place.numbers("at_m", 3, kCoordinate_m);
  std::vector<double> aim{0, 0, -1};
  if (place.has("aim")) aim = place.numbers("aim", 3, kCoordinate_m);
  const double rotate_deg = place.number_or("rotate_deg", 0, kTurn_deg);
  if (Vector3d(aim[0], aim[1], aim[2]).norm() < 1e-9) {
    place.find("aim")->fault("the aim has no direction", "give for example [0, 0, -1], down");
  }
  const auto type =
      path.empty() ? nullptr : luminaire_file(*place.find("file"), curves_.resolve(path));
  PlacedLuminaire luminaire{.name = entry.name,
                            .type = type,
                            .at_m = {at[0], at[1], at[2]},
                            .axes = luminaire_axes({aim[0], aim[1], aim[2]}, rotate_deg),
                            .spectral_flux = curves_.zero()};
  luminaire.spectral_flux = luminaire_flux(entry, luminaire);
  if (type && shell_sound_) check_luminaire(luminaire, entry.kind);
  room_.lights.push_back(
      {.name = entry.name, .luminaire = static_cast<int>(room_.luminaires.size())});
  room_.luminaires.push_back(std::move(luminaire));
}

spectra::Spectrum RoomReader::luminaire_flux(const LightEntry& entry,
                                             const PlacedLuminaire& luminaire) {
  const JsonObject& light = entry.light;
  for (const char* key : {"power_W", "efficacy_lm_W", "illuminance_lx", "exitance_W_m2_nm"}) {
    if (const auto node = light.find(key)) {
      node->fault(fmt::format("\"{}\" has no meaning for a luminaire", key),
                  "give \"flux_lm\" or \"dim\", or neither: its file knows its flux");
    }
  }
  const auto flux = light.find("flux_lm"), dim = light.find("dim"), shape = light.need("spectrum");
  const spectra::Spectrum spectrum = shape ? curves_.light_shape(*shape).spectrum : curves_.zero();
  if (flux && dim) dim->fault("the light has two amounts, flux_lm and dim", "keep one of them");
  const double factor = dim ? dim->number(kDim) : 1;
  double flux_lm = flux ? flux->number(kFlux_lm) : NAN;
  if (!flux && luminaire.type) {
    const double tilt_deg = std::acos(std::clamp(luminaire.axes(2, 2), -1.0, 1.0)) * 180 /
                            std::numbers::pi;  // of its axis from straight down
    const double tilt = luminaire.type->tilt ? luminaire.type->tilt->at(tilt_deg) : 1;
    flux_lm = luminaire.type->flux_lm * factor * tilt;
    if (tilt != 1) {
      room_.notes.push_back(fmt::format("{}: at a tilt of {:.1f} degrees its file dims it to {:g}",
                                        entry.kind.pointer(), tilt_deg, tilt));
    }
    if (luminaire.type->needs_flux) {
      light.fault("the file of the luminaire gives no lamp flux", "give \"flux_lm\"");
    } else if (!(flux_lm > 0) && !std::isnan(flux_lm)) {
      light.fault("tilted like this the luminaire gives no light", "see TILT= in its file");
    }
  }
  if (!(flux_lm > 0) || !(spectra::luminous(spectrum) > 0)) return curves_.zero();
  return spectra::scaled_to_luminous(spectrum, flux_lm);
}

void RoomReader::check_luminaire(const PlacedLuminaire& luminaire, const JsonNode& place) {
  if (!luminaire.at_m.allFinite() || !luminaire.axes.allFinite()) return;
  const double clearance = clearance_m(luminaire.at_m);
  if (clearance < -kTouch_m) {
    place.fault("the luminaire is outside the room or in furniture", "move it into the air");
    return;
  }
  if (clearance > kTouch_m && clearance < kShortest_m) {
    place.fault("the luminaire is less than 1 mm from a surface",
                "move it away, or put it exactly on the surface");
    return;
  }
  const Vector3d& size = luminaire.type->size_m;
  for (const Vector3d& point : body_of(luminaire)) {
    if (clearance_m(point) >= -kTouch_m - kShortest_m / 1000) continue;
    place.fault(
        fmt::format("its luminous area, {:.3g} x {:.3g} x {:.3g} m, reaches beyond the room "
                    "or into furniture",
                    size.x(), size.y(), size.z()),
        "move it, or turn it by rotate_deg; at_m is its middle");
    return;
  }
  if (clearance <= kTouch_m) note_flush(luminaire, place);
}

/// Flush with a surface, it loses what it sends into it.
void RoomReader::note_flush(const PlacedLuminaire& luminaire, const JsonNode& place) {
  Vector3d inward = Vector3d::UnitZ();
  const auto take = [&](const Outline& outline, const std::vector<Outline>& holes) {
    const FlatFace face(outline, holes);
    if (face.distance_m(luminaire.at_m) <= kTouch_m) inward = face.plane().normal();
  };
  for (const Body& body : room_.furniture) {
    for (const Outline& face : body.faces) take(face, {});
  }
  for (const ShellFace& face : room_.shell) take(face.outline, face.holes);
  const double lost = share_behind(luminaire.type->intensity, luminaire.axes.transpose() * inward);
  if (lost < 1e-6) return;
  room_.notes.push_back(fmt::format("{}: flush with a surface, which takes {:.3g} % of its light",
                                    place.pointer(), 100 * lost));
}

}  // namespace scenes
