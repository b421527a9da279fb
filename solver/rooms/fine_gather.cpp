#include "solver/rooms/fine_gather.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "solver/factors/sequence.h"
#include "solver/obstacles/patch_rays.h"
#include "solver/obstacles/visibility.h"
#include "solver/rooms/reflected_field.h"
#include "solver/rooms/room_faces.h"

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::Vector3d;

/// Rays start this far in front of their patch: more than a float's rounding in a room, less than
/// anything that casts a shadow.
constexpr double kOffset_m = 1e-5;

/// Neighbours in one plane; their rays go in the same directions.
struct Group {
  std::size_t first = 0;
  int count = 0;
};

std::vector<Group> groups_of(const scenes::PatchMesh& mesh) {
  std::vector<Group> groups;
  for (std::size_t p = 0; p < mesh.polygon.size(); ++p) {
    const bool joins = !groups.empty() && groups.back().count < kRayPacket &&
                       mesh.plane[groups.back().first] == mesh.plane[p] &&
                       mesh.surface[groups.back().first] == mesh.surface[p];
    if (joins) {
      ++groups.back().count;
    } else {
      groups.push_back({.first = p, .count = 1});
    }
  }
  return groups;
}

/// Rows are area means over each face of the room.
Bands face_means(const std::vector<RoomFace>& faces, const std::vector<int>& face_of,
                 const scenes::PatchMesh& mesh, const Bands& values) {
  Bands mean = Bands::Zero(static_cast<Index>(faces.size()), values.cols());
  ArrayXd area_m2 = ArrayXd::Zero(mean.rows());
  for (std::size_t p = 0; p < face_of.size(); ++p) {
    mean.row(face_of[p]) += mesh.area_m2[p] * values.row(static_cast<Index>(p));
    area_m2[face_of[p]] += mesh.area_m2[p];
  }
  return mean.colwise() / area_m2;
}

std::vector<int> faces_of_patches(const std::vector<RoomFace>& faces,
                                  const scenes::PatchMesh& mesh) {
  std::vector<int> face_of;
  for (std::size_t p = 0; p < mesh.polygon.size(); ++p) {
    const auto face = std::ranges::find_if(faces, [&](const RoomFace& f) {
      return f.surface == mesh.surface[p] && f.plane == mesh.plane[p];
    });
    face_of.push_back(static_cast<int>(face - faces.begin()));
  }
  return face_of;
}

Bands without_emission(const scenes::PatchMesh& mesh, const Bands& radiosity,
                       const Bands& emission) {
  Bands reflected = radiosity;
  for (Index p = 0; p < mesh.size(); ++p) {  // lamps have no slopes
    reflected.row(p) -= emission.row(mesh.surface[static_cast<std::size_t>(p)]);
  }
  return reflected;
}

/// What a fine patch has in view, by whole faces.
struct Outlook {
  Facet facet;
  ArrayXd factor;     ///< form factors to the faces, as if nothing stood between
  ArrayXd full_view;  ///< 1: nothing stands between; 0: something may
};

/// One run of rays from a group of patches.
struct Batch {
  Batch(Index faces, int padded_bands) : sum(kRayPacket, padded_bands), hits(kRayPacket, faces) {}

  Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> sum;    ///< patch x band
  Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> hits;  ///< patch x face
};

class FineGather {
 public:
  FineGather(const scenes::Room& room, const scenes::PatchMesh& solved, const Bands& radiosity,
             const Bands& emission, const FineOptions& options)
      : options_(options),
        emission_(emission),
        faces_(room_faces(room)),
        face_of_(faces_of_patches(faces_, solved)),
        field_(solved, without_emission(solved, radiosity, emission)),
        face_reflected_(
            face_means(faces_, face_of_, solved, without_emission(solved, radiosity, emission))),
        rays_(solved),
        visibility_(room, {}) {
    for (const RoomFace& face : faces_) {
      masks_.emplace_back();
      for (const Facet& part : face.parts) masks_.back().push_back(visibility_.separation(part));
    }
  }

  /// Adds to the group's rows of `light.irradiance`, sets its standard errors.
  void gather(const Group& group, const scenes::PatchMesh& fine, FineIrradiance& light) {
    std::vector<Outlook> outlooks;
    for (int k = 0; k < group.count; ++k) {
      outlooks.push_back(outlook(fine.polygon[group.first + static_cast<std::size_t>(k)]));
    }
    Bands mean = Bands::Zero(group.count, emission_.cols()), square = mean;
    Batch batch(static_cast<Index>(faces_.size()), field_.padded_bands());
    for (int b = 0; b < kFineBatches; ++b) {
      trace(group, b, outlooks, batch);
      for (int k = 0; k < group.count; ++k) {
        const ArrayXd estimate = corrected(outlooks[static_cast<std::size_t>(k)], batch, k);
        mean.row(k) += estimate.transpose() / kFineBatches;
        square.row(k) += estimate.square().transpose() / kFineBatches;
      }
    }
    for (int k = 0; k < group.count; ++k) {
      const auto patch = static_cast<Index>(group.first) + k;
      ArrayXd variance =
          (square.row(k) - mean.row(k).square()).max(0).transpose() / (kFineBatches - 1);
      const ArrayXd lamps = lamp_light(outlooks[static_cast<std::size_t>(k)],
                                       static_cast<std::uint64_t>(patch), variance);
      light.irradiance.row(patch) += mean.row(k) + lamps.transpose();
      const double strongest = light.irradiance.row(patch).maxCoeff();
      light.standard_error[patch] = strongest > 0 ? std::sqrt(variance.maxCoeff()) / strongest : 0;
    }
  }

  [[nodiscard]] std::int64_t lost_rays() const { return lost_; }

 private:
  [[nodiscard]] Outlook outlook(const std::vector<Vector3d>& polygon) const {
    const auto n = static_cast<Index>(faces_.size());
    Outlook view{
        .facet = make_facet(polygon), .factor = ArrayXd::Zero(n), .full_view = ArrayXd::Ones(n)};
    const SeparationMask own = visibility_.separation(view.facet);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const auto at = static_cast<Index>(f);
      for (std::size_t part = 0; part < faces_[f].parts.size(); ++part) {
        const double factor = mean_form_factor(view.facet, faces_[f].parts[part]);
        view.factor[at] += factor;
        if (factor > 0 && Visibility::may_block(own, masks_[f][part])) view.full_view[at] = 0;
      }
    }
    return view;
  }

  void trace(const Group& group, int number, const std::vector<Outlook>& outlooks, Batch& batch) {
    batch.sum.setZero();
    batch.hits.setZero();
    const Sequence4 sequence(group.first, Sequence4::kPlaneFirst);
    const Vector3d& normal = outlooks.front().facet.normal;
    const Vector3d u = normal.unitOrthogonal(), v = normal.cross(u);
    const int rays = options_.rays / kFineBatches;
    std::array<Vector3d, kRayPacket> from;
    std::int64_t lost = 0;
    for (int k = number * rays; k < (number + 1) * rays; ++k) {
      const double sine2 = sequence(k, 0), azimuth = 2 * std::numbers::pi * sequence(k, 1);
      const Vector3d direction = std::sqrt(1 - sine2) * normal +
                                 std::sqrt(sine2) * (std::cos(azimuth) * u + std::sin(azimuth) * v);
      for (std::size_t i = 0; i < outlooks.size(); ++i) {
        from[i] =
            area_point(outlooks[i].facet, sequence(k, 2), sequence(k, 3)) + kOffset_m * normal;
      }
      const ParallelHits hits = rays_.first_hits(from, group.count, direction);
      for (std::size_t i = 0; i < outlooks.size(); ++i) {
        if (hits.patch[i] < 0) {
          ++lost;
          continue;
        }
        const auto row = static_cast<Index>(i);
        field_.add(hits.patch[i], from[i] + hits.distance_m[i] * direction, &batch.sum(row, 0));
        batch.hits(row, face_of_[static_cast<std::size_t>(hits.patch[i])]) += 1;
      }
    }
    lost_ += lost;
  }

  /// The batch's mean over a patch's rays, with the shares of faces in full view put right. The
  /// other faces together stay at their mean level, so that no step is left where they begin.
  [[nodiscard]] ArrayXd corrected(const Outlook& view, const Batch& batch, int patch) const {
    const double rays = batch.hits.row(patch).sum();
    if (rays == 0) return ArrayXd::Zero(emission_.cols());
    const ArrayXd mean =
        batch.sum.row(patch).head(emission_.cols()).cast<double>().transpose() / rays;
    const ArrayXd missed =
        view.full_view * (view.factor - batch.hits.row(patch).transpose() / rays);
    const ArrayXd behind = (1 - view.full_view) * view.factor;
    const auto level = [&](const ArrayXd& weight) -> ArrayXd {
      return (weight.matrix().transpose() * face_reflected_.matrix()).transpose().array();
    };
    const double open = behind.sum();
    return open > 0 ? ArrayXd(mean + level(missed) - missed.sum() / open * level(behind))
                    : ArrayXd(mean + level(missed));
  }

  /// Adds to the variance what sampled visibility leaves open.
  [[nodiscard]] ArrayXd lamp_light(const Outlook& view, std::uint64_t seed,
                                   ArrayXd& variance) const {
    ArrayXd light = ArrayXd::Zero(emission_.cols());
    const SeparationMask own = visibility_.separation(view.facet);
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      const ArrayXd emitted = emission_.row(faces_[f].surface).transpose();
      const double factor = view.factor[static_cast<Index>(f)];
      if (factor == 0 || (emitted == 0).all()) continue;
      if (view.full_view[static_cast<Index>(f)] == 1) {
        light += factor * emitted;
        continue;
      }
      for (std::size_t part = 0; part < faces_[f].parts.size(); ++part) {
        const Facet& lamp = faces_[f].parts[part];
        const double whole = mean_form_factor(view.facet, lamp);
        if (whole == 0) continue;
        const VisibleShare seen =
            visibility_.between(view.facet, own, lamp, masks_[f][part],
                                seed << 16U ^ (f << 8U | part), options_.lamp_rays);
        light += whole * seen.share * emitted;
        variance += (whole * seen.standard_error * emitted).square();
      }
    }
    return light;
  }

  const FineOptions options_;
  const Bands& emission_;  ///< surface x band
  std::vector<RoomFace> faces_;
  std::vector<int> face_of_;  ///< of the solved patches
  ReflectedField field_;
  Bands face_reflected_;  ///< face x band
  PatchRays rays_;
  Visibility visibility_;
  std::vector<std::vector<SeparationMask>> masks_;  ///< of the faces' parts
  std::atomic<std::int64_t> lost_{0};
};

}  // namespace

FineIrradiance gather_to_fine(const scenes::Room& room, const scenes::PatchMesh& solved,
                              const Bands& radiosity, const Bands& emission,
                              const scenes::PatchMesh& fine, Bands direct,
                              const FineOptions& options) {
  if (options.rays < kFineBatches || options.rays % kFineBatches != 0) {
    throw std::invalid_argument(
        fmt::format("{} rays; want a multiple of {}", options.rays, kFineBatches));
  }
  FineIrradiance light{.irradiance = std::move(direct),
                       .standard_error = ArrayXd::Zero(fine.size())};
  FineGather gather(room, solved, radiosity, emission, options);
  const std::vector<Group> groups = groups_of(fine);
  tbb::parallel_for(std::size_t{0}, groups.size(),
                    [&](std::size_t g) { gather.gather(groups[g], fine, light); });
  light.lost_rays = gather.lost_rays();
  return light;
}

}  // namespace solver
