#include "solver/rooms/room_picture.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "appearance/spectra/photometry.h"
#include "solver/exchange/exchange.h"
#include "solver/factors/sequence.h"
#include "solver/rooms/room_faces.h"
#include "solver/sensors/gather.h"
#include "solver/sensors/refined_field.h"
#include "solver/sources/area_lamps.h"
#include "solver/sources/direct_light.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Vector3d;
using std::numbers::pi;

/// Illuminance of a unit in each band, lx.
ArrayXd lux_of_bands(const spectra::Grid& grid) {
  ArrayXd lux(grid.count);
  for (Eigen::Index b = 0; b < lux.size(); ++b) {
    spectra::Spectrum unit{grid, ArrayXd::Zero(grid.count)};
    unit.values[b] = 1;
    lux[b] = spectra::luminous(unit);
  }
  return lux;
}

}  // namespace

/// A room's faces, its light, and what the camera sees of them.
struct RoomPicture::Scene {
  Scene(const scenes::Room& room, const RoomTransport& transport, const RoomSolution& solution,
        const Camera& of_camera, const PictureOptions& options);

  /// Light without sharp shadows: what is reflected, and what comes from skies.
  [[nodiscard]] ArrayXd soft_at(std::size_t facet, const Vector3d& point) const {
    const Eigen::VectorXd weights = gather.row(point, facets[facet].normal).weights;
    return (reflected.matrix().transpose() * weights).array() +
           sources.skylight_at(point, facets[facet].normal);
  }

  /// Of lamps of every other kind, at a point.
  [[nodiscard]] ArrayXd sharp_at(std::size_t facet, const Vector3d& point) const {
    ArrayXd light = sources.sharp_at(point, facets[facet].normal);
    lamps.add(point, facets[facet].normal, light);
    return light;
  }

  [[nodiscard]] RefinedField::Rules rules(const PictureOptions& options) const;
  [[nodiscard]] Attention attention(std::size_t facet, const RefinedField::Triangle& triangle,
                                    const PictureOptions& options) const;
  /// Irradiance of what a fragment shows, mean over it.
  [[nodiscard]] ArrayXd irradiance(std::size_t facet, const Fragment& fragment, bool exact) const;
  [[nodiscard]] Vector3d on_facet(std::size_t facet, const Eigen::Vector2d& film) const;
  /// Radiosity of what a fragment shows, lit like that.
  [[nodiscard]] ArrayXd radiosity(std::size_t facet, const Fragment& fragment,
                                  const ArrayXd& light) const;
  /// Calls take(column, area, irradiance, radiosity) for all that a row shows in columns from
  /// `first` to before `end`.
  template <typename Take>
  void for_each_part(int row, int first, int end, bool exact, const Take& take) const;

  const Camera camera;
  scenes::PatchMesh faces;
  std::vector<Facet> facets, patch_facets;
  std::vector<ArrayXd> exitance, reflectance;  ///< of each facet
  std::vector<char> opening;                   ///< whether each facet is part of one
  ArrayXd lux;
  Visibility visibility;
  std::optional<SlopeMoments> slopes;
  PointGather gather;
  Bands reflected;  ///< B - S of the patches
  AreaLamps lamps;
  DirectSources sources;
  Shadows hidden;  ///< from the eye
  std::vector<Plane> view;
  std::vector<FilmPiece> pieces;
  std::optional<RefinedField> field;
};

namespace {

std::vector<ArrayXd> of_faces(const scenes::PatchMesh& faces, const auto& of_surface) {
  std::vector<ArrayXd> all;
  for (const int surface : faces.surface) {
    all.push_back(of_surface(static_cast<std::size_t>(surface)));
  }
  return all;
}

std::optional<SlopeMoments> slopes_of(const std::vector<Facet>& facets,
                                      const RoomSolution& solution) {
  const auto n = static_cast<Eigen::Index>(facets.size());
  if (solution.radiosity.radiosity.rows() == n) return std::nullopt;
  return std::make_optional<SlopeMoments>(facets);
}

/// Slopes made less steep where the light of a patch would fall below 0 in a corner, as next to a
/// patch of sun: means stay, and no point nearby is lit by less than nothing.
Bands nowhere_negative(const std::vector<Facet>& facets, Bands light) {
  const auto n = static_cast<Eigen::Index>(facets.size());
  if (light.rows() == n) return light;
  const std::vector<SlopeBasis> bases = slope_bases(facets);
  for (Eigen::Index p = 0; p < n; ++p) {
    const Facet& facet = facets[static_cast<std::size_t>(p)];
    BandRow lowest = BandRow::Zero(light.cols());
    for (const Vector3d& corner : facet.vertices) {
      const Eigen::Vector2d psi = bases[static_cast<std::size_t>(p)].at(corner - facet.centre);
      lowest = lowest.min(psi[0] * light.row(n + p) + psi[1] * light.row(2 * n + p));
    }
    const BandRow kept =
        (light.row(p) + lowest < 0)
            .select((light.row(p) / -lowest).max(0.0).min(1.0), BandRow::Ones(lowest.size()));
    light.row(n + p) *= kept;
    light.row(2 * n + p) *= kept;
  }
  return light;
}

}  // namespace

RoomPicture::Scene::Scene(const scenes::Room& room, const RoomTransport& transport,
                          const RoomSolution& solution, const Camera& of_camera,
                          const PictureOptions& options)
    : camera(of_camera),
      faces(whole_mesh(room)),
      facets(facets_of(faces)),
      patch_facets(facets_of(transport.mesh)),
      exitance(of_faces(faces, [&](std::size_t s) { return room.surfaces[s].exitance.values; })),
      reflectance(of_faces(faces, [&](std::size_t s) { return solution.reflectances[s].values; })),
      lux(lux_of_bands(room.grid)),
      visibility(room, transport.mesh),
      slopes(slopes_of(patch_facets, solution)),
      gather(transport.mesh, patch_facets, visibility, slopes ? &*slopes : nullptr),
      reflected(nowhere_negative(
          patch_facets,
          solution.radiosity.radiosity - transport.lightings.at(solution.lighting).emission)),
      lamps(facets, exitance, visibility),
      sources(room, visibility),
      hidden(visibility.blockers(), from_point(camera.eye_m())),
      view(view_planes(camera)),
      pieces(film_pieces(camera, facets, visibility.blockers())) {
  for (const int s : faces.surface) {
    opening.push_back(room.surfaces[static_cast<std::size_t>(s)].kind ==
                      scenes::SurfaceKind::opening);
  }
  field.emplace(facets, rules(options));
}

RefinedField::Rules RoomPicture::Scene::rules(const PictureOptions& options) const {
  return {.sample =
              [this](std::size_t facet, const Vector3d& point) {
                RefinedField::Sample sample{.values = soft_at(facet, point)};
                const ArrayXd all = sample.values + sharp_at(facet, point);
                sample.scale = std::sqrt(all.square().mean());
                return sample;
              },
          .attention =
              [this, options](std::size_t facet, const RefinedField::Triangle& triangle) {
                return attention(facet, triangle, options);
              },
          .tolerance = options.tolerance};
}

Attention RoomPicture::Scene::attention(std::size_t facet, const RefinedField::Triangle& triangle,
                                        const PictureOptions& options) const {
  if (facets[facet].plane().height_m(camera.eye_m()) <= 0) return Attention::none;
  std::vector<Vector3d> seen(triangle.begin(), triangle.end());
  if ((seen[1] - seen[0]).cross(seen[2] - seen[0]).dot(facets[facet].normal) < 0) {
    std::swap(seen[1], seen[2]);
  }
  for (const Plane& plane : view) {
    if (!seen.empty()) seen = clip(seen, plane);
  }
  if (seen.empty() || hidden.lit_parts(seen).empty()) return Attention::none;
  double edge_m = 0, edge_pixels = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    edge_m = std::max(edge_m, (triangle[k] - triangle[(k + 1) % 3]).norm());
  }
  if (edge_m > options.coarse_m) return Attention::cut;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const Eigen::Vector2d from = camera.film_of(seen[k]);
    edge_pixels =
        std::max(edge_pixels, (from - camera.film_of(seen[(k + 1) % seen.size()])).norm());
  }
  return edge_pixels < options.coarse_pixels ? Attention::coarse : Attention::fine;
}

Vector3d RoomPicture::Scene::on_facet(std::size_t facet, const Eigen::Vector2d& film) const {
  const Facet& f = facets[facet];
  const Vector3d direction = camera.direction(film);
  return camera.eye_m() +
         f.normal.dot(f.centre - camera.eye_m()) / f.normal.dot(direction) * direction;
}

ArrayXd RoomPicture::Scene::irradiance(std::size_t facet, const Fragment& fragment,
                                       bool exact) const {
  const Vector3d point = on_facet(facet, fragment.middle), &normal = facets[facet].normal;
  ArrayXd light = ArrayXd::Zero(lux.size());
  if (exact) {
    light = soft_at(facet, point);
  } else {
    field->add(facet, point, light);
  }
  lamps.add(point, normal, light);
  if (!sources.empty_but_for_skies()) {
    std::vector<Vector3d> polygon;
    for (const Eigen::Vector2d& corner : fragment.outline) {
      polygon.push_back(on_facet(facet, corner));
    }
    light += sources.over(polygon, point, normal);
  }
  return light;
}

ArrayXd RoomPicture::Scene::radiosity(std::size_t facet, const Fragment& fragment,
                                      const ArrayXd& light) const {
  ArrayXd shown = exitance[facet] + reflectance[facet] * light;
  if (opening[facet]) {
    shown += pi * sources.radiance(camera.eye_m(), on_facet(facet, fragment.middle),
                                   faces.surface[facet]);
  }
  return shown;
}

template <typename Take>
void RoomPicture::Scene::for_each_part(int row, int first, int end, bool exact,
                                       const Take& take) const {
  for (const FilmPiece& piece : pieces) {
    for_each_fragment(piece, row, [&](const Fragment& fragment) {
      if (fragment.column < first || fragment.column >= end) return;
      const ArrayXd light = irradiance(piece.facet, fragment, exact);
      take(fragment.column, fragment.area, light, radiosity(piece.facet, fragment, light));
    });
  }
}

RoomPicture::RoomPicture(const scenes::Room& room, const RoomTransport& transport,
                         const RoomSolution& solution, const Camera& camera,
                         const PictureOptions& options)
    : scene_(std::make_unique<Scene>(room, transport, solution, camera, options)) {}

RoomPicture::~RoomPicture() = default;

PictureRows RoomPicture::rows(int first, int count) const {
  const int width = scene_->camera.width();
  PictureRows picture{.radiance = Bands::Zero(Eigen::Index{count} * width, scene_->lux.size()),
                      .illuminance = ArrayXd::Zero(Eigen::Index{count} * width)};
  tbb::parallel_for(0, count, [&](int k) {
    const auto take = [&](int column, double area, const ArrayXd& light, const ArrayXd& shown) {
      const Eigen::Index pixel = Eigen::Index{k} * width + column;
      picture.radiance.row(pixel) += (area / pi * shown).transpose();
      picture.illuminance[pixel] += area * (scene_->lux * light).sum();
    };
    scene_->for_each_part(first + k, 0, width, false, take);
  });
  return picture;
}

BandRow RoomPicture::gathered(int column, int row) const {
  BandRow radiance = BandRow::Zero(scene_->lux.size());
  scene_->for_each_part(row, column, column + 1, true,
                        [&](int, double area, const ArrayXd&, const ArrayXd& shown_here) {
                          radiance += (area / pi * shown_here).transpose();
                        });
  return radiance;
}

PictureCheck RoomPicture::check(int pixels) const {
  const Sequence4 sequence(0);
  ArrayXd error(pixels);
  tbb::parallel_for(0, pixels, [&](int k) {
    const int column = static_cast<int>(sequence(k, 0) * scene_->camera.width());
    const int row = static_cast<int>(sequence(k, 1) * scene_->camera.height());
    const BandRow truth = gathered(column, row);
    BandRow shown = BandRow::Zero(truth.size());
    scene_->for_each_part(row, column, column + 1, false,
                          [&](int, double area, const ArrayXd&, const ArrayXd& shown_here) {
                            shown += (area / pi * shown_here).transpose();
                          });
    const double size = truth.square().mean();
    error[k] = size > 0 ? std::sqrt((shown - truth).square().mean() / size) : 0;
  });
  return {.pixels = pixels,
          .rms = std::sqrt(error.square().mean()),
          .largest = error.maxCoeff(),
          .share_above_2_percent = (error > 0.02).cast<double>().mean()};
}

std::size_t RoomPicture::nodes() const { return scene_->field->nodes(); }

double RoomPicture::largest_left() const { return scene_->field->largest_left(); }

}  // namespace solver
