#include "solver/rooms/reflected_field.h"

#include <tbb/parallel_for.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "solver/exchange/exchange.h"
#include "solver/factors/slope_basis.h"
#include "solver/sensors/gather.h"

namespace solver {
namespace {

constexpr int kPad = 8;  ///< floats

}  // namespace

ReflectedField::ReflectedField(const scenes::PatchMesh& mesh, const Bands& reflected)
    : padded_((static_cast<int>(reflected.cols()) + kPad - 1) / kPad * kPad),
      frames_(mesh.polygon.size()),
      values_(mesh.polygon.size() * 3 * static_cast<std::size_t>(padded_)) {
  const std::vector<Facet> facets = facets_of(mesh);
  tbb::parallel_for(std::size_t{0}, facets.size(), [&](std::size_t p) {
    const Facet& f = facets[p];
    const Eigen::Vector3d along = (f.vertices[1] - f.vertices[0]).normalized();
    frames_[p] = {.centre_m = f.centre, .along = along, .across = f.normal.cross(along)};
    set_slopes(mesh, facets, reflected, p);
  });
}

void ReflectedField::set_slopes(const scenes::PatchMesh& mesh, const std::vector<Facet>& facets,
                                const Bands& reflected, std::size_t patch) {
  const auto own = static_cast<Eigen::Index>(patch);
  const Frame& frame = frames_[patch];
  Eigen::ArrayXd along = Eigen::ArrayXd::Zero(reflected.cols()), across = along;
  const auto add = [&](const Eigen::Vector3d& gradient, const Eigen::ArrayXd& amount) {
    along += frame.along.dot(gradient) * amount;
    across += frame.across.dot(gradient) * amount;
  };
  if (const Eigen::Index n = mesh.size(); reflected.rows() > n) {
    const SlopeBasis basis = slope_basis(facets[patch]);
    add(basis.gradient_per_m[0], reflected.row(n + own).transpose());
    add(basis.gradient_per_m[1], reflected.row(2 * n + own).transpose());
  } else {
    for (const auto& [k, a] : gradient_weights(mesh, facets, patch)) {
      add(a, (reflected.row(k) - reflected.row(own)).transpose());
    }
  }
  Eigen::ArrayXd lowest = Eigen::ArrayXd::Zero(reflected.cols());
  for (const Eigen::Vector3d& corner : facets[patch].vertices) {
    const Eigen::Vector3d r = corner - frame.centre_m;
    lowest = lowest.min(frame.along.dot(r) * along + frame.across.dot(r) * across);
  }
  const Eigen::ArrayXd mean = reflected.row(own).transpose();
  const Eigen::ArrayXd part =
      (mean + lowest < 0)
          .select((mean / -lowest).max(0.0).min(1.0), Eigen::ArrayXd::Ones(mean.size()));
  float* value = &values_[patch * 3 * static_cast<std::size_t>(padded_)];
  Eigen::Map<Eigen::ArrayXf>(value, mean.size()) = mean.cast<float>();
  Eigen::Map<Eigen::ArrayXf>(value + padded_, mean.size()) = (part * along).cast<float>();
  Eigen::Map<Eigen::ArrayXf>(value + 2 * padded_, mean.size()) = (part * across).cast<float>();
}

}  // namespace solver
