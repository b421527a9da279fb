#include "solver/response/band_classes.h"

#include <Eigen/QR>
#include <algorithm>

namespace solver {
namespace {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kSameLight = 1e-12;  ///< share of a column that other columns do not combine to

/// Columns are chosen by a pivoted QR among those there are, so that light stays non-negative.
void find_sources(const ArrayXd& area_m2, const std::vector<SourceLight>& lights, BandClass& c) {
  const Index n = area_m2.size();
  MatrixXd light(2 * n, static_cast<Index>(c.bands.size() * lights.size()));
  Index column = 0;
  for (const int band : c.bands) {
    for (const SourceLight& l : lights) {
      light.col(column++) << (l.emission.col(band) * area_m2.sqrt()).matrix(),
          (l.direct.col(band) * area_m2.sqrt()).matrix();
    }
  }
  VectorXd size = light.colwise().norm();
  for (double& s : size) s = s > 0 ? s : 1;
  light = light * size.cwiseInverse().asDiagonal();
  Eigen::ColPivHouseholderQR<MatrixXd> qr;
  qr.setThreshold(kSameLight);
  qr.compute(light);
  const Index rank = qr.rank();
  const MatrixXd r = qr.matrixR().topRows(rank).template triangularView<Eigen::Upper>();
  MatrixXd share(rank, light.cols());
  share << MatrixXd::Identity(rank, rank),
      r.leftCols(rank).triangularView<Eigen::Upper>().solve(r.rightCols(light.cols() - rank));
  c.share = share * qr.colsPermutation().transpose() * size.asDiagonal();
  const MatrixXd chosen = (light * qr.colsPermutation()).eval().leftCols(rank);
  c.sources = {.emission = chosen.topRows(n).array().colwise() * area_m2.rsqrt(),
               .direct = chosen.bottomRows(n).array().colwise() * area_m2.rsqrt()};
}

}  // namespace

std::vector<BandClass> band_classes(const ArrayXd& area_m2, const std::vector<SourceLight>& lights,
                                    const PaintedPatches& painted) {
  std::vector<BandClass> classes;
  for (int band = 0; band < static_cast<int>(painted.fixed.cols()); ++band) {
    const bool lit = std::ranges::any_of(lights, [&](const SourceLight& light) {
      return (light.emission.col(band) > 0).any() || (light.direct.col(band) > 0).any();
    });
    if (!lit) continue;
    ArrayXd fixed = painted.fixed.col(band);
    for (Index p = 0; p < fixed.size(); ++p) {
      if (painted.group[static_cast<std::size_t>(p)] >= 0) fixed[p] = 0;
    }
    auto same =
        std::ranges::find_if(classes, [&](const BandClass& c) { return (c.fixed == fixed).all(); });
    if (same == classes.end()) {
      classes.push_back({.fixed = fixed});
      same = classes.end() - 1;
    }
    same->bands.push_back(band);
  }
  for (BandClass& c : classes) find_sources(area_m2, lights, c);
  return classes;
}

}  // namespace solver
