#include "solver/visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "solver/ray_scene.h"
#include "solver/sequence.h"

namespace solver {
namespace {

using Eigen::Vector3d;

constexpr double kTouching_m = 1e-9;
constexpr std::uint8_t kBehind = 0x80;
/// Rays stop this share of their length short of both ends, so that the surfaces they join do not
/// block them.
constexpr float kEndGap = 1e-4F;
constexpr int kPacket = 16;

/// Running ratio of two sums with the standard error of the ratio (its samples taken as
/// independent, which for low-discrepancy points errs on the safe side).
struct WeightedShare {
  double weight = 0, open = 0, open_squared = 0, weight_squared = 0, cross = 0;
  int count = 0;
  bool some_open = false, some_blocked = false;  ///< among rays that carry light

  void add(double w, bool is_open) {
    (is_open ? some_open : some_blocked) |= w > 0;
    const double o = is_open ? w : 0;
    weight += w;
    open += o;
    weight_squared += w * w;
    open_squared += o * o;
    cross += o * w;
    ++count;
  }

  /// Some rays carry light, and what they say is the same.
  [[nodiscard]] bool agreed() const { return some_open != some_blocked; }

  /// All, where no ray carries light: two that hardly face each other.
  [[nodiscard]] VisibleShare share() const {
    if (weight <= 0) return {};
    const double ratio = open / weight;
    const double variance = open_squared - 2 * ratio * cross + ratio * ratio * weight_squared;
    return {ratio, std::sqrt(std::max(0.0, variance)) / weight};
  }
};

double kernel(const Vector3d& p, const Vector3d& np, const Vector3d& q, const Vector3d& nq) {
  const Vector3d r = q - p;
  const double r2 = r.squaredNorm();
  return std::max(0.0, np.dot(r)) * std::max(0.0, -nq.dot(r)) / (r2 * r2);
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

  [[nodiscard]] Vector3d point(double s, double t) const {
    return area_point(part_ ? *part_ : whole_, s, t);
  }

 private:
  const Facet& whole_;
  std::optional<Facet> part_;
};

}  // namespace

Visibility::Visibility(const scenes::Room& room, const scenes::PatchMesh& mesh, bool skip)
    : skip_(skip) {
  const scenes::Occluders faces = scenes::occluders(room);
  if (faces.triangles.empty()) return;
  for (const scenes::Box& box : room.furniture) {
    const std::vector<Eigen::Vector2d> base = scenes::footprint(box);
    Blocker blocker{
        .planes = {{Vector3d::UnitZ(), box.max_m.z()}, {-Vector3d::UnitZ(), -box.min_m.z()}}};
    for (std::size_t k = 0; k < base.size(); ++k) {
      const Eigen::Vector2d edge = base[(k + 1) % base.size()] - base[k];
      const Vector3d outward = Vector3d(edge.y(), -edge.x(), 0).normalized();
      blocker.planes.push_back({outward, outward.head<2>().dot(base[k])});
      blocker.corners.emplace_back(base[k].x(), base[k].y(), box.min_m.z());
      blocker.corners.emplace_back(base[k].x(), base[k].y(), box.max_m.z());
    }
    blockers_.push_back(std::move(blocker));
  }
  for (int s = 0; s < static_cast<int>(room.surfaces.size()); ++s) {
    const scenes::Surface& surface = room.surfaces[static_cast<std::size_t>(s)];
    if (surface.kind != scenes::SurfaceKind::wall) continue;
    const scenes::Frame frame = scenes::frame_of(room, s);
    const Plane plane{frame.normal, frame.normal.dot(frame.origin_m)};
    const bool whole_plan_in_front =
        std::all_of(room.plan_m.begin(), room.plan_m.end(), [&](const Eigen::Vector2d& p) {
          return plane.height_m({p.x(), p.y(), 0}) > -kTouching_m;
        });
    if (whole_plan_in_front) continue;  // a wall of the convex hull hides nothing
    const auto i = static_cast<std::size_t>(surface.index);
    Blocker blocker{.planes = {plane}};
    for (const Eigen::Vector2d& p : {room.plan_m[i], room.plan_m[(i + 1) % room.plan_m.size()]}) {
      blocker.corners.emplace_back(p.x(), p.y(), 0);
      blocker.corners.emplace_back(p.x(), p.y(), room.height_m);
    }
    blockers_.push_back(std::move(blocker));
  }
  if (blockers_.empty()) return;
  scene_ = std::make_unique<RayScene>(faces.triangles);
  patch_masks_.resize(static_cast<std::size_t>(mesh.size()) * blockers_.size());
  for (std::size_t p = 0; p < mesh.polygon.size(); ++p) {
    const Plane own{mesh.normal[p], mesh.normal[p].dot(mesh.centre[p])};
    separate(mesh.polygon[p], own, &patch_masks_[p * blockers_.size()]);
  }
}

Visibility::Visibility() = default;

Visibility::~Visibility() = default;

template <typename Vertices>
void Visibility::separate(const Vertices& vertices, const Plane& own, std::uint8_t* mask) const {
  for (std::size_t b = 0; b < blockers_.size(); ++b) {
    mask[b] = 0;
    const Blocker& blocker = blockers_[b];
    const bool behind =
        std::all_of(blocker.corners.begin(), blocker.corners.end(),
                    [&](const Vector3d& c) { return own.height_m(c) < kTouching_m; });
    if (behind) mask[b] |= kBehind;
    for (std::size_t f = 0; f < blocker.planes.size(); ++f) {
      const bool outside = std::all_of(vertices.begin(), vertices.end(), [&](const Vector3d& v) {
        return blocker.planes[f].height_m(v) > -kTouching_m;
      });
      if (outside) mask[b] |= static_cast<std::uint8_t>(1U << f);
    }
  }
}

namespace {

bool any_blocker_between(const std::uint8_t* a, const std::uint8_t* b, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    if (((a[k] | b[k]) & kBehind) == 0 && (a[k] & b[k]) == 0) return true;
  }
  return false;
}

}  // namespace

bool Visibility::may_block(int i, int j) const {
  const std::size_t n = blockers_.size();
  if (!skip_) return n > 0;
  return any_blocker_between(patch_masks_.data() + static_cast<std::size_t>(i) * n,
                             patch_masks_.data() + static_cast<std::size_t>(j) * n, n);
}

bool Visibility::may_block(const SeparationMask& set, int patch) const {
  const std::size_t n = blockers_.size();
  if (!skip_) return n > 0;
  return any_blocker_between(set.data(), patch_masks_.data() + static_cast<std::size_t>(patch) * n,
                             n);
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

bool Visibility::may_block(const SeparationMask& a, const SeparationMask& b) {
  return any_blocker_between(a.data(), b.data(), a.size());
}

std::uint32_t Visibility::blocked16(const Vector3d* from, const Vector3d* to, int count) const {
  alignas(64) RTCRay16 rays{};
  alignas(64) std::array<int, kPacket> valid{};
  for (int k = 0; k < count; ++k) {
    const Vector3d r = to[k] - from[k];
    const Eigen::Vector3f origin = scene_->local(from[k]);
    valid[static_cast<std::size_t>(k)] = -1;
    rays.org_x[k] = origin.x();
    rays.org_y[k] = origin.y();
    rays.org_z[k] = origin.z();
    rays.dir_x[k] = static_cast<float>(r.x());
    rays.dir_y[k] = static_cast<float>(r.y());
    rays.dir_z[k] = static_cast<float>(r.z());
    rays.tnear[k] = kEndGap;
    rays.tfar[k] = 1 - kEndGap;
    rays.mask[k] = ~0U;
  }
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded16(valid.data(), scene_->get(), &context, &rays);
  std::uint32_t blocked = 0;
  for (int k = 0; k < count; ++k) {
    if (rays.tfar[k] < 0) blocked |= 1U << k;
  }
  return blocked;
}

VisibleShare Visibility::between(const Facet& i, const Facet& j, std::uint64_t seed,
                                 int most_rays) const {
  const Sequence4 sequence(seed);
  const Front front_i(i, j.plane()), front_j(j, i.plane());
  WeightedShare sum;
  for (int done = 0; done < most_rays; done += kPacket) {
    std::array<Vector3d, kPacket> from, to;
    for (int k = 0; k < kPacket; ++k) {
      const auto s = static_cast<std::size_t>(k);
      from[s] = front_i.point(sequence(done + k, 0), sequence(done + k, 1));
      to[s] = front_j.point(sequence(done + k, 2), sequence(done + k, 3));
    }
    const std::uint32_t blocked = blocked16(from.data(), to.data(), kPacket);
    for (int k = 0; k < kPacket; ++k) {
      const auto s = static_cast<std::size_t>(k);
      sum.add(kernel(from[s], i.normal, to[s], j.normal), (blocked >> k & 1U) == 0);
    }
    if (done == 0 && sum.agreed()) break;
  }
  return sum.share();
}

VisibleShare Visibility::from_point(const Vector3d& point, const Vector3d& normal,
                                    const Facet& facet, std::uint64_t seed, double error,
                                    int most_rays) const {
  const Sequence4 sequence(seed);
  const Front front(facet, Plane{normal, normal.dot(point)});
  WeightedShare sum;
  std::array<Vector3d, kPacket> from, to;
  from.fill(point);
  for (int target = 4 * kPacket; target <= most_rays; target *= 2) {
    while (sum.count < target) {
      for (int k = 0; k < kPacket; ++k) {
        to[static_cast<std::size_t>(k)] =
            front.point(sequence(sum.count + k, 0), sequence(sum.count + k, 1));
      }
      const std::uint32_t blocked = blocked16(from.data(), to.data(), kPacket);
      for (int k = 0; k < kPacket; ++k) {
        const Vector3d& q = to[static_cast<std::size_t>(k)];
        sum.add(kernel(point, normal, q, facet.normal), (blocked >> k & 1U) == 0);
      }
    }
    if (sum.share().standard_error <= error) break;
  }
  return sum.share();
}

VisibleShare Visibility::towards(const Facet& facet, std::uint64_t seed, int rays,
                                 const std::function<Target(const Vector3d&)>& target) const {
  if (unobstructed()) return {};
  const Sequence4 sequence(seed);
  WeightedShare sum;
  std::array<Vector3d, kPacket> from, to;
  std::array<double, kPacket> weight{};
  while (sum.count < rays) {
    for (int k = 0; k < kPacket; ++k) {
      const auto s = static_cast<std::size_t>(k);
      from[s] = area_point(facet, sequence(sum.count + k, 0), sequence(sum.count + k, 1));
      const Target t = target(from[s]);
      to[s] = t.point_m;
      weight[s] = t.weight;
    }
    const std::uint32_t blocked = blocked16(from.data(), to.data(), kPacket);
    for (int k = 0; k < kPacket; ++k) {
      sum.add(weight[static_cast<std::size_t>(k)], (blocked >> k & 1U) == 0);
    }
    if (sum.count == kPacket && sum.agreed()) break;
  }
  return sum.share();
}

bool Visibility::open_segment(const Vector3d& from, const Vector3d& to) const {
  return unobstructed() || blocked16(&from, &to, 1) == 0;
}

}  // namespace solver
