#include "solver/obstacles/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "solver/factors/sequence.h"

namespace solver {
namespace {

using Eigen::Vector3d;

constexpr double kTouching_m = 1e-9;
constexpr std::uint8_t kBehind = 0x80;
constexpr int kPacket = 16;
constexpr std::uint32_t kAllBlocked = 0xffff;

/// Running ratio of two sums with the standard error of the ratio (its samples taken as
/// independent, which for low-discrepancy points errs on the safe side).
struct WeightedShare {
  double weight = 0, open = 0, open_squared = 0, weight_squared = 0, cross = 0;

  void add(const Samples16& weights, std::uint32_t blocked) {
    for (int k = 0; k < kPacket; ++k) {
      const double w = weights[k], o = (blocked >> k & 1U) == 0 ? w : 0;
      weight += w;
      open += o;
      weight_squared += w * w;
      open_squared += o * o;
      cross += o * w;
    }
  }

  /// All, where no ray carries light: two that hardly face each other.
  [[nodiscard]] VisibleShare share() const {
    if (weight <= 0) return {};
    const double ratio = open / weight;
    const double variance = open_squared - 2 * ratio * cross + ratio * ratio * weight_squared;
    return {ratio, std::sqrt(std::max(0.0, variance)) / weight};
  }
};

/// cos cos / r^2 / r^2 of 16 segments.
Samples16 kernels(const Points16& from, const Vector3d& normal_from, const Points16& to,
                  const Vector3d& normal_to) {
  const Points16 r = to - from;
  const auto along = [&](const Vector3d& n) -> Samples16 {
    return (r.matrix() * n.cast<float>()).array().max(0.0F);
  };
  const Samples16 r2 = r.square().rowwise().sum().max(std::numeric_limits<float>::min());
  return along(normal_from) * along(-normal_to) / r2 / r2;
}

/// A facet, or what of it is in front of a plane: points behind carry no light.
class Front {
 public:
  Front(const Facet& facet, const Plane& plane) : whole_(facet) {
    const auto behind = [&](const Vector3d& v) { return plane.height_m(v) < -kTouching_m; };
    if (std::ranges::none_of(facet.vertices, behind)) return;
    std::vector<Vector3d> vertices = clip(facet.vertices, plane);
    if (!vertices.empty()) part_ = make_facet(std::move(vertices));
  }

  /// Area points from two dimensions of the sequence.
  [[nodiscard]] Points16 points(const Segments& segments, const Sequence4& sequence, int first,
                                int dimension) const {
    const Facet& facet = part_ ? *part_ : whole_;
    const std::vector<Vector3d>& v = facet.vertices;
    const Samples16 s = sequence.sixteen(first, dimension),
                    t = sequence.sixteen(first, dimension + 1);
    Points16 p;
    if (facet.rectangle) {
      const Eigen::Vector3f corner = segments.local(v[0]), along_s = (v[1] - v[0]).cast<float>(),
                            along_t = (v[3] - v[0]).cast<float>();
      for (int d = 0; d < 3; ++d) p.col(d) = corner[d] + along_s[d] * s + along_t[d] * t;
    } else {
      for (int k = 0; k < kPacket; ++k) p.row(k) = segments.local(area_point(facet, s[k], t[k]));
    }
    return p;
  }

 private:
  const Facet& whole_;
  std::optional<Facet> part_;
};

/// Whether one blocker can be between two sets.
bool stands_between(std::uint8_t a, std::uint8_t b) {
  return ((a | b) & kBehind) == 0 && (a & b) == 0;
}

}  // namespace

Visibility::Visibility(const scenes::Room& room, const scenes::PatchMesh& mesh, bool skip)
    : skip_(skip), blockers_(blockers_of(room)), segments_(blockers_) {
  if (blockers_.empty()) return;
  patch_masks_.resize(static_cast<std::size_t>(mesh.size()) * blockers_.size());
  for (std::size_t p = 0; p < mesh.polygon.size(); ++p) {
    const Plane own{mesh.normal[p], mesh.normal[p].dot(mesh.centre[p])};
    separate(mesh.polygon[p], own, &patch_masks_[p * blockers_.size()]);
  }
}

template <typename Vertices>
void Visibility::separate(const Vertices& vertices, const Plane& own, std::uint8_t* mask) const {
  for (std::size_t b = 0; b < blockers_.size(); ++b) {
    mask[b] = 0;
    const Blocker& blocker = blockers_[b];
    const bool behind =
        std::all_of(blocker.corners.begin(), blocker.corners.end(),
                    [&](const Vector3d& c) { return own.height_m(c) < kTouching_m; });
    if (behind) mask[b] |= kBehind;
    for (std::size_t g = 0; g < blocker.guards.size(); ++g) {
      const bool outside = std::all_of(vertices.begin(), vertices.end(), [&](const Vector3d& v) {
        return blocker.guards[g].height_m(v) > -kTouching_m;
      });
      if (outside) mask[b] |= static_cast<std::uint8_t>(1U << g);
    }
  }
}

bool Visibility::may_block(std::span<const std::uint8_t> a, std::span<const std::uint8_t> b) {
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (stands_between(a[k], b[k])) return true;
  }
  return false;
}

bool Visibility::may_block(int i, int j) const {
  return skip_ ? may_block(separation(i), separation(j)) : !unobstructed();
}

bool Visibility::may_block(const SeparationMask& set, int patch) const {
  return skip_ ? may_block(set, separation(patch)) : !unobstructed();
}

std::span<const std::uint8_t> Visibility::separation(int patch) const {
  const std::size_t n = blockers_.size();
  return {patch_masks_.data() + static_cast<std::size_t>(patch) * n, n};
}

SeparationMask Visibility::separation(const Vector3d& point, const Vector3d& normal) const {
  SeparationMask mask(blockers_.size());
  separate(std::array{point}, Plane{normal, normal.dot(point)}, mask.data());
  return mask;
}

SeparationMask Visibility::separation(const Facet& facet) const {
  SeparationMask mask(blockers_.size());
  separate(facet.vertices, facet.plane(), mask.data());
  return mask;
}

/// Calls add(from, to, blocked) for every 16 rays. @return false if the first 16 agree
template <typename Add>
bool Visibility::follow_rays(const Facet& i, std::span<const std::uint8_t> mask_i, const Facet& j,
                             std::span<const std::uint8_t> mask_j, std::uint64_t seed,
                             int most_rays, VisibleShare& agreed, const Add& add) const {
  const Sequence4 sequence(seed);
  const Front front_i(i, j.plane()), front_j(j, i.plane());
  for (int done = 0; done < most_rays; done += kPacket) {
    const Points16 from = front_i.points(segments_, sequence, done, 0),
                   to = front_j.points(segments_, sequence, done, 2);
    std::uint32_t blocked = 0;
    for (std::size_t b = 0; b < blockers_.size() && blocked != kAllBlocked; ++b) {
      if (!skip_ || stands_between(mask_i[b], mask_j[b])) {
        blocked |= segments_.blocked(b, from, to);
      }
    }
    if (done == 0 && (blocked == 0 || blocked == kAllBlocked)) {
      agreed.share = blocked == 0 ? 1 : 0;
      return false;
    }
    add(from, to, blocked);
  }
  return true;
}

VisibleShare Visibility::between(const Facet& i, std::span<const std::uint8_t> mask_i,
                                 const Facet& j, std::span<const std::uint8_t> mask_j,
                                 std::uint64_t seed, int most_rays) const {
  WeightedShare sum;
  VisibleShare agreed;
  const auto add = [&](const Points16& from, const Points16& to, std::uint32_t blocked) {
    sum.add(kernels(from, i.normal, to, j.normal), blocked);
  };
  return follow_rays(i, mask_i, j, mask_j, seed, most_rays, agreed, add) ? sum.share() : agreed;
}

Eigen::Matrix3d Visibility::hidden_moments(const Facet& i, const SlopeBasis& basis_i,
                                           std::span<const std::uint8_t> mask_i, const Facet& j,
                                           const SlopeBasis& basis_j,
                                           std::span<const std::uint8_t> mask_j, std::uint64_t seed,
                                           int most_rays) const {
  const auto functions = [&](const Points16& points, const Facet& f, const SlopeBasis& basis) {
    Eigen::Array<float, kPacket, 3> psi;
    psi.col(0) = 1;
    const Eigen::Vector3f centre = segments_.local(f.centre);
    for (int a = 0; a < 2; ++a) {
      const Eigen::Vector3f g = basis.gradient_per_m[static_cast<std::size_t>(a)].cast<float>();
      psi.col(a + 1) = (points.matrix() * g).array() - g.dot(centre);
    }
    return psi;
  };
  double all = 0;
  Eigen::Matrix3d hidden = Eigen::Matrix3d::Zero();
  const auto add = [&](const Points16& from, const Points16& to, std::uint32_t blocked) {
    const Samples16 weights = kernels(from, i.normal, to, j.normal);
    Samples16 lost = weights;
    for (int k = 0; k < kPacket; ++k) {
      if ((blocked >> k & 1U) == 0) lost[k] = 0;
    }
    all += weights.cast<double>().sum();
    const auto psi_i = functions(from, i, basis_i), psi_j = functions(to, j, basis_j);
    hidden += ((psi_i.colwise() * lost).matrix().transpose() * psi_j.matrix()).cast<double>();
  };
  VisibleShare agreed;
  if (!follow_rays(i, mask_i, j, mask_j, seed, most_rays, agreed, add) || !(all > 0)) {
    return Eigen::Matrix3d::Zero();
  }
  return hidden / all;
}

}  // namespace solver
