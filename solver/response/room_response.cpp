#include "solver/response/room_response.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <stdexcept>

#include "solver/rooms/room_light.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using spectra::Spectrum;

constexpr int kViewOutputs = 3;        ///< irradiance, background, field
constexpr double kSilentPole = 1e-12;  ///< share of an output below which a pole is left out

bool near_white(const Spectrum& reflectance) { return (reflectance.values >= kNearWhite).all(); }

int outputs_per_view(bool white_of_surfaces, int groups) {
  return kViewOutputs + (white_of_surfaces ? 1 + groups : 0);
}

PaintedPatches painted_patches(const scenes::Room& room, const RoomTransport& t) {
  PaintedPatches painted{.groups = static_cast<int>(room.paint.size()),
                         .fixed = Bands(t.exchange.rows(), room.grid.count)};
  for (int p = 0; p < t.exchange.rows(); ++p) {
    const int s = t.mesh.surface[static_cast<std::size_t>(p % t.mesh.size())];
    painted.group.push_back(scenes::paint_group(room, s));
    painted.fixed.row(p) =
        room.surfaces[static_cast<std::size_t>(s)].reflectance.values.transpose();
  }
  return painted;
}

/// The near-axis weights of the surfaces that count as near-white: row 0 those of fixed
/// reflectance, row 1 + j group j.
MatrixXd near_white_weights(const scenes::Room& room, const RoomTransport& t,
                            const ViewedWall& wall, const std::vector<int>& group) {
  MatrixXd weights = MatrixXd::Zero(1 + static_cast<Index>(room.paint.size()), t.exchange.rows());
  for (int p = 0; p < t.exchange.rows(); ++p) {
    const auto at = static_cast<std::size_t>(p);
    const auto s = static_cast<std::size_t>(t.mesh.surface[at % t.mesh.surface.size()]);
    const Spectrum& fixed = room.surfaces[s].reflectance;
    if (group[at] >= 0 || near_white(fixed)) {
      weights(1 + group[at], p) = wall.view.near_axis.weights[p];
    }
  }
  return weights;
}

}  // namespace

ReducedViews reduce_views(const scenes::Room& room, const RoomTransport& transport,
                          const ReductionOptions& options) {
  if (room.paint.empty() || transport.viewed.size() != room.paint.size()) {
    throw std::invalid_argument(fmt::format("{} viewed points for {} painted groups",
                                            transport.viewed.size(), room.paint.size()));
  }
  const PaintedPatches painted = painted_patches(room, transport);
  ReducedViews views{.grid = room.grid,
                     .viewed = static_cast<int>(transport.viewed.size()),
                     .white_of_surfaces = room.viewing.white == spectra::ReferenceWhite::surfaces};
  std::vector<OutputRow> outputs;
  for (const ViewedWall& wall : transport.viewed) {
    outputs.push_back({.on_radiosity = wall.row.gather.weights});
    outputs.push_back({.on_radiosity = wall.view.background.weights});
    outputs.push_back({.on_radiosity = wall.view.field.weights});
    if (!views.white_of_surfaces) continue;
    const MatrixXd weights = near_white_weights(room, transport, wall, painted.group);
    for (Index k = 0; k < weights.rows(); ++k) outputs.push_back({.on_irradiance = weights.row(k)});
    views.share.push_back(weights.leftCols(transport.mesh.size()).rowwise().sum());
  }
  std::vector<SourceLight> lights;
  const std::size_t first = room.scenarios.empty() ? 0 : 1;
  const std::size_t count = room.scenarios.empty() ? 1 : room.scenarios.size();
  for (std::size_t l = first; l < first + count; ++l) {
    lights.push_back({transport.lightings[l].emission, transport.lightings[l].direct});
  }
  views.room = reduce_room(transport.exchange, lights, painted, outputs, options);

  // Point lights, sun and skies shine on the viewed points, and skies into the eye, past all
  // patches.
  const int stride = outputs_per_view(views.white_of_surfaces, views.room.groups);
  for (int v = 0; v < views.viewed; ++v) {
    const ViewedWall& wall = transport.viewed[static_cast<std::size_t>(v)];
    for (std::size_t l = 0; l < count; ++l) {
      const SeenSky& sky = wall.sky[first + l];
      for (int b = 0; b < room.grid.count; ++b) {
        auto of_light =
            views.room.bands[static_cast<std::size_t>(b)].constant.col(static_cast<Index>(l));
        of_light[v * stride] += wall.row.direct[first + l][b];
        of_light[v * stride + 1] += sky.background[b];
        of_light[v * stride + 2] += sky.field[b];
      }
    }
  }
  for (std::size_t v = 0; v < transport.viewed.size(); ++v) {
    views.angle_deg.push_back(painted_angle_deg(room, transport, v));
    std::vector<LampLight>& lamps = views.lamps.emplace_back();
    for (std::size_t l = 0; l < count; ++l) {
      lamps.push_back(lamp_light(room, transport, v, first + l));
    }
  }
  return views;
}

RoomResponse::RoomResponse(const ReducedViews& views, int varying, int viewed,
                           const std::vector<Spectrum>& paints)
    : grid_(views.grid),
      highest_reflectance_(views.room.highest_reflectance),
      varying_(varying),
      viewed_(viewed),
      outputs_(views.white_of_surfaces ? kOutputs : kViewOutputs) {
  if (grid_.count > kMostBands) {
    throw std::invalid_argument(
        fmt::format("{} bands; want at most {}", grid_.count, int{kMostBands}));
  }
  const int groups = views.room.groups;
  if (varying < 0 || varying >= groups || viewed < 0 || viewed >= views.viewed ||
      (groups > 1 && static_cast<int>(paints.size()) != groups)) {
    throw std::invalid_argument(fmt::format("group {} seen from {}, with {} paints, of {} groups",
                                            varying, viewed, paints.size(), groups));
  }
  for (int j = 0; j < groups; ++j) {
    if (j != varying) check(paints[static_cast<std::size_t>(j)]);
  }
  lamps_ = views.lamps.at(static_cast<std::size_t>(viewed));
  angle_deg_ = views.angle_deg.at(static_cast<std::size_t>(viewed));
  set_outputs(views, paints);
  if (viewed != varying) viewed_paint_ = lane_of(paints[static_cast<std::size_t>(viewed)]);

  Lanes none;
  none.fill(Lane::Zero());
  sums_.resize(static_cast<std::size_t>(views.room.bands.front().gamma.cols()), {.constant = none});
  for (int band = 0; band < grid_.count; ++band) {
    VectorXd reflectance = VectorXd::Zero(groups);
    for (int j = 0; j < groups; ++j) {
      if (j != varying) reflectance[j] = paints[static_cast<std::size_t>(j)].values[band];
    }
    add_band(views, band, reflectance);
  }
}

/// Which outputs of the reduced room are wanted, and how they add up.
void RoomResponse::set_outputs(const ReducedViews& views, const std::vector<Spectrum>& paints) {
  const int groups = views.room.groups;
  const int stride = outputs_per_view(views.white_of_surfaces, groups), first = viewed_ * stride;
  chosen_ = MatrixXd::Zero(outputs_, stride * views.viewed);
  for (int o = 0; o < kViewOutputs; ++o) chosen_(o, first + o) = 1;
  if (!views.white_of_surfaces) return;
  const VectorXd& share = views.share[static_cast<std::size_t>(viewed_)];
  const int white = first + kViewOutputs;  // of the fixed surfaces; those of the groups follow
  chosen_(white_given, white) = 1;
  chosen_(white_varying, white + 1 + varying_) = 1;
  share_given_ = share[0];
  share_varying_ = share[1 + varying_];
  for (int j = 0; j < groups; ++j) {
    if (j == varying_ || !near_white(paints[static_cast<std::size_t>(j)])) continue;
    chosen_(white_given, white + 1 + j) = 1;
    share_given_ += share[1 + j];
  }
}

/// Eliminates the groups whose paint is given from c = gamma + K R c, y = y0 + Phi R c, and brings
/// K of the varying group to its eigenvectors.
void RoomResponse::add_band(const ReducedViews& views, int band, const VectorXd& reflectance) {
  const ReducedRoom::Band& b = views.room.bands[static_cast<std::size_t>(band)];
  const auto& t = views.room.transfers[static_cast<std::size_t>(b.transfer)];
  std::vector<int> own, given;
  for (int i = 0; i < static_cast<int>(t.group.size()); ++i) {
    (t.group[static_cast<std::size_t>(i)] == varying_ ? own : given).push_back(i);
  }
  MatrixXd k = t.k(own, own), gamma = b.gamma(own, Eigen::all);
  MatrixXd phi = (chosen_ * t.phi)(Eigen::all, own), constant = chosen_ * b.constant;
  if (!given.empty()) {
    VectorXd root(static_cast<Index>(given.size()));  // sqrt(R) of the given groups
    for (Index i = 0; i < root.size(); ++i) {
      const int vector = given[static_cast<std::size_t>(i)];
      root[i] = std::sqrt(reflectance[t.group[static_cast<std::size_t>(vector)]]);
    }
    const MatrixXd to_given = root.asDiagonal() * t.k(given, own);
    const MatrixXd light_given = root.asDiagonal() * b.gamma(given, Eigen::all);
    const MatrixXd from_given = (chosen_ * t.phi)(Eigen::all, given) * root.asDiagonal();
    const Eigen::LLT<MatrixXd> among_given(MatrixXd::Identity(root.size(), root.size()) -
                                           root.asDiagonal() * t.k(given, given) *
                                               root.asDiagonal());
    const MatrixXd bounced_light = among_given.solve(light_given);
    const MatrixXd bounced = among_given.solve(to_given);
    constant += from_given * bounced_light;
    gamma += to_given.transpose() * bounced_light;
    phi += from_given * bounced;
    k += to_given.transpose() * bounced;
  }
  for (std::size_t l = 0; l < sums_.size(); ++l) {
    for (int o = 0; o < outputs_; ++o) {
      sums_[l].constant[static_cast<std::size_t>(o)][band] = constant(o, static_cast<Index>(l));
    }
  }
  if (own.empty()) return;  // a band without light
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(k);
  const MatrixXd from_pole = phi * eigen.eigenvectors();
  const MatrixXd into_pole = eigen.eigenvectors().transpose() * gamma;
  // The largest part that a pole can take of any output, by the lighting's own brightness.
  MatrixXd relative = into_pole;
  for (Index l = 0; l < relative.cols(); ++l) {
    relative.col(l) /= std::max(constant.col(l).norm(), 1e-300);
  }
  const ArrayXd most =
      (highest_reflectance_ / (1 - highest_reflectance_ * eigen.eigenvalues().array())).abs();
  const ArrayXd loudest =
      from_pole.colwise().norm().transpose().array() * relative.rowwise().norm().array() * most;
  std::size_t kept = 0;
  for (Index i = 0; i < k.rows(); ++i) {
    if (loudest[i] <= kSilentPole) continue;
    if (kept == pole_.size()) add_pole();
    pole_[kept][band] = eigen.eigenvalues()[i];
    for (std::size_t l = 0; l < sums_.size(); ++l) {
      for (int o = 0; o < outputs_; ++o) {
        sums_[l].weight[kept][static_cast<std::size_t>(o)][band] =
            from_pole(o, i) * into_pole(i, static_cast<Index>(l));
      }
    }
    ++kept;
  }
}

/// Silent in every band so far.
void RoomResponse::add_pole() {
  pole_.push_back(Lane::Zero());
  Lanes none;
  none.fill(Lane::Zero());
  for (Sums& s : sums_) s.weight.push_back(none);
}

void RoomResponse::check(const Spectrum& paint) const {
  if (!(paint.grid == grid_)) throw std::invalid_argument("the paint is not on the room's grid");
  if (!(paint.values >= 0 && paint.values <= highest_reflectance_).all()) {
    throw std::invalid_argument(fmt::format("reflectance from {} to {}; want 0 to {}",
                                            paint.values.minCoeff(), paint.values.maxCoeff(),
                                            highest_reflectance_));
  }
}

RoomResponse::Lane RoomResponse::lane_of(const Spectrum& paint) const {
  Lane lane = Lane::Zero();
  lane.head(grid_.count) = paint.values;
  return lane;
}

spectra::ViewedLight RoomResponse::viewed(const Lanes& outputs, const Lane& sample,
                                          const Spectrum& paint) const {
  const auto on_grid = [&](const auto& lane) { return Spectrum{grid_, lane.head(grid_.count)}; };
  spectra::ViewedLight light{.sample = on_grid(sample),
                             .background = on_grid(outputs[background]),
                             .field = on_grid(outputs[field])};
  if (outputs_ == kViewOutputs) {
    light.white = on_grid(outputs[irradiance]);
    return light;
  }
  const double varying = near_white(paint) ? 1 : 0, share = share_given_ + varying * share_varying_;
  if (!(share > 0)) {
    throw std::domain_error(fmt::format(
        "no surface in view reflects {} in every band; take the ideal white", kNearWhite));
  }
  const Lane white = (outputs[white_given] + varying * outputs[white_varying]) / share;
  light.white = on_grid(white);
  return light;
}

spectra::ViewedLight RoomResponse::light(const Spectrum& paint, std::size_t lighting) const {
  check(paint);
  const Sums& sums = sums_.at(lighting);
  const auto outputs = static_cast<std::size_t>(outputs_);
  const Lane rho = lane_of(paint);
  Lanes y = sums.constant;
  for (std::size_t k = 0; k < pole_.size(); ++k) {
    const Lane p = rho / (1 - rho * pole_[k]);
    for (std::size_t o = 0; o < outputs; ++o) y[o] += sums.weight[k][o] * p;
  }
  spectra::ViewedLight light =
      viewed(y, (viewed_ == varying_ ? rho : viewed_paint_) * y[irradiance], paint);
  add_lamps(light, lighting);
  return light;
}

/// What no paint changes.
void RoomResponse::add_lamps(spectra::ViewedLight& light, std::size_t lighting) const {
  light.lamps = lamps_[lighting].light;
  light.lamps_by_flux = lamps_[lighting].by_flux;
  light.angle_deg = angle_deg_;
}

spectra::ViewedLightSlope RoomResponse::slope(const Spectrum& paint, std::size_t lighting) const {
  check(paint);
  const Sums& sums = sums_.at(lighting);
  const auto outputs = static_cast<std::size_t>(outputs_);
  const Lane rho = lane_of(paint);
  Lanes y = sums.constant, by_rho;
  by_rho.fill(Lane::Zero());
  for (std::size_t k = 0; k < pole_.size(); ++k) {
    const Lane rest = 1 - rho * pole_[k], p = rho / rest, once = rest.inverse();
    for (std::size_t o = 0; o < outputs; ++o) {
      y[o] += sums.weight[k][o] * p;
      by_rho[o] += sums.weight[k][o] * once * once;  // d/drho of rho / (1 - rho lambda)
    }
  }
  const bool own = viewed_ == varying_;
  const Lane wall = own ? rho : viewed_paint_;
  const Lane direct = own ? y[irradiance] : Lane(Lane::Zero());
  spectra::ViewedLightSlope slope{
      .light = viewed(y, wall * y[irradiance], paint),
      .by_reflectance = viewed(by_rho, wall * by_rho[irradiance] + direct, paint)};
  add_lamps(slope.light, lighting);
  return slope;
}

}  // namespace solver
