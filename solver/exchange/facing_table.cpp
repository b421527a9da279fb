#include "solver/exchange/facing_table.h"

#include "solver/factors/facet.h"

namespace solver {

FacingTable::FacingTable(const scenes::PatchMesh& mesh)
    : patches_(mesh.polygon.size()), plane_of_(mesh.plane.begin(), mesh.plane.end()) {
  planes_ = *std::max_element(plane_of_.begin(), plane_of_.end()) + 1;
  std::vector<Plane> plane(planes_);
  for (std::size_t i = 0; i < patches_; ++i) {
    plane[plane_of_[i]] = {mesh.normal[i], mesh.normal[i].dot(mesh.centre[i])};
  }
  heights_.resize(planes_ * patches_);
  std::vector<Range> all(planes_ * planes_);
  for (std::size_t p = 0; p < planes_; ++p) {
    for (std::size_t j = 0; j < patches_; ++j) {
      Range& range = heights_[p * patches_ + j];
      for (const Eigen::Vector3d& v : mesh.polygon[j]) range.extend(plane[p].height_m(v));
      Range& of_plane = all[p * planes_ + plane_of_[j]];
      of_plane.extend(range.lowest_m);
      of_plane.extend(range.highest_m);
    }
  }
  for (std::size_t p = 0; p < planes_; ++p) {
    for (std::size_t q = 0; q < planes_; ++q) {
      const Pair pair = relation(all[p * planes_ + q], all[q * planes_ + p]);
      of_planes_.push_back(pair == Pair::straddling ? Pair::mixed : pair);
    }
  }
}

}  // namespace solver
