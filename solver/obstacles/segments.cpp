#include "solver/obstacles/segments.h"

#include <Eigen/Geometry>
#include <algorithm>

// Highway compiles this file once per instruction set and picks at run time.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/obstacles/segments.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();

namespace solver::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<float, 16>;
using V = hn::Vec<D>;

/// This share of a segment counts as its ends, which lie on surfaces.
constexpr float kEnd = 1e-4F;

struct Ends {
  V x0, y0, z0, x1, y1, z1;
};

/// Heights of both ends over a plane.
struct Heights {
  V from, to;
};

HWY_INLINE Heights heights(D d, const FloatPlane& p, const Ends& e) {
  const V x = hn::Set(d, p.x), y = hn::Set(d, p.y), z = hn::Set(d, p.z),
          offset = hn::Set(d, p.offset_m);
  return {hn::MulAdd(x, e.x0, hn::MulAdd(y, e.y0, hn::MulSub(z, e.z0, offset))),
          hn::MulAdd(x, e.x1, hn::MulAdd(y, e.y1, hn::MulSub(z, e.z1, offset)))};
}

/// From and to where on the way, 0 to 1, segments are behind all planes; nowhere if from >= to.
struct Span {
  V from, to;
};

HWY_INLINE Span behind_all(D d, const FloatPlane* planes, std::size_t count, const Ends& e) {
  const V zero = hn::Zero(d), never = hn::Set(d, 2.0F);
  Span inside{hn::Set(d, kEnd), hn::Set(d, 1 - kEnd)};
  for (std::size_t k = 0; k < count; ++k) {
    const Heights h = heights(d, planes[k], e);
    const V fall = hn::Sub(h.from, h.to), at = hn::Div(h.from, fall);
    const auto enters = hn::Gt(fall, zero), leaves = hn::Lt(fall, zero);
    const auto stays_out = hn::And(hn::Eq(fall, zero), hn::Ge(h.from, zero));
    inside.from = hn::IfThenElse(enters, hn::Max(inside.from, at), inside.from);
    inside.to = hn::IfThenElse(leaves, hn::Min(inside.to, at), inside.to);
    inside.from = hn::IfThenElse(stays_out, never, inside.from);
  }
  return inside;
}

/// 16 segments, coordinate by coordinate.
std::uint32_t blocked16(const FloatPlane* planes, std::size_t count, bool plate, const float* from,
                        const float* to) {
  const D d;
  const std::size_t lanes = hn::Lanes(d);
  std::uint32_t blocked = 0;
  for (std::size_t i = 0; i < 16; i += lanes) {
    const Ends e{hn::LoadU(d, from + i), hn::LoadU(d, from + 16 + i), hn::LoadU(d, from + 32 + i),
                 hn::LoadU(d, to + i),   hn::LoadU(d, to + 16 + i),   hn::LoadU(d, to + 32 + i)};
    const std::size_t skipped = plate ? 1 : 0;
    const Span inside = behind_all(d, planes + skipped, count - skipped, e);
    auto hit = hn::Lt(inside.from, inside.to);
    if (plate) {
      const Heights h = heights(d, planes[0], e);
      const V at = hn::Div(h.from, hn::Sub(h.from, h.to)), zero = hn::Zero(d);
      const auto crosses = hn::Xor(hn::Gt(h.from, zero), hn::Gt(h.to, zero));
      hit = hn::And(crosses, hn::And(hn::Ge(at, inside.from), hn::Le(at, inside.to)));
    }
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, hit, bits);
    blocked |= (static_cast<std::uint32_t>(bits[0]) | static_cast<std::uint32_t>(bits[1]) << 8U)
               << i;
  }
  return blocked;
}

}  // namespace solver::HWY_NAMESPACE

HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace solver {
namespace {

using Eigen::Vector3d;

HWY_EXPORT(blocked16);

/// The planes of a body, or a plate's and those that stand on its edges, outside in front.
std::vector<Plane> planes_of(const Blocker& blocker, bool plate) {
  std::vector<Plane> planes;
  if (!plate) {
    for (const Blocker::Face& face : blocker.faces) planes.push_back(face.plane);
    return planes;
  }
  const Blocker::Face& front = blocker.faces.front();
  planes.push_back(front.plane);
  for (std::size_t k = 0; k < front.corners.size(); ++k) {
    const auto corner = [&](std::size_t c) -> const Vector3d& {
      return blocker.corners[static_cast<std::size_t>(front.corners[c % front.corners.size()])];
    };
    const Vector3d outwards = (corner(k + 1) - corner(k)).cross(front.plane.normal).normalized();
    planes.push_back({outwards, outwards.dot(corner(k))});
  }
  return planes;
}

/// How far the planes of a body move inwards, so that rounding to float hides nothing that only
/// touches it: a millionth of the room, but never through a thin body.
double margin_m(const Blocker& blocker, double reach_m) {
  double thickness_m = 1e300;
  for (const Blocker::Face& face : blocker.faces) {
    double depth_m = 0;
    for (const Vector3d& c : blocker.corners) {
      depth_m = std::max(depth_m, -face.plane.height_m(c));
    }
    thickness_m = std::min(thickness_m, depth_m);
  }
  return std::min(1e-6 * reach_m, 0.1 * thickness_m);
}

}  // namespace

Segments::Segments(const std::vector<Blocker>& blockers) {
  Eigen::AlignedBox3d box;
  for (const Blocker& b : blockers) {
    for (const Vector3d& c : b.corners) box.extend(c);
  }
  if (!box.isEmpty()) middle_m_ = box.center();
  for (const Blocker& b : blockers) {
    Body body{.plate = b.faces.size() == 2};
    const double margin = body.plate ? 0 : margin_m(b, box.diagonal().norm());
    for (const Plane& p : planes_of(b, body.plate)) {
      const Eigen::Vector3f n = p.normal.cast<float>();
      const double offset_m = p.offset_m - p.normal.dot(middle_m_) - margin;
      body.planes.push_back({n.x(), n.y(), n.z(), static_cast<float>(offset_m)});
    }
    bodies_.push_back(std::move(body));
  }
}

std::uint32_t Segments::blocked(std::size_t blocker, const Points16& from,
                                const Points16& to) const {
  const Body& body = bodies_[blocker];
  return HWY_DYNAMIC_DISPATCH(blocked16)(body.planes.data(), body.planes.size(), body.plate,
                                         from.data(), to.data());
}

}  // namespace solver

#endif
