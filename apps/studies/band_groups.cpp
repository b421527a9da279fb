#include "apps/studies/band_groups.h"

namespace apps {

using Eigen::ArrayXd, Eigen::Index, Eigen::MatrixXd;

MatrixXd means_of_groups(Index bands, Index groups) {
  MatrixXd mean = MatrixXd::Zero(bands, groups);
  for (Index k = 0; k < bands; ++k) mean(k, (2 * k + 1) * groups / (2 * bands)) = 1;
  return mean * mean.colwise().sum().cwiseInverse().asDiagonal();
}

PreparedRoom with_bands(PreparedRoom prepared, const MatrixXd& combine) {
  const auto combined = [&](const ArrayXd& values) -> ArrayXd {
    return (combine.transpose() * values.matrix()).array();
  };
  prepared.room.grid.count = static_cast<int>(combine.cols());
  for (scenes::Surface& surface : prepared.room.surfaces) {
    for (spectra::Spectrum* spectrum : {&surface.reflectance, &surface.exitance}) {
      *spectrum = {.grid = prepared.room.grid, .values = combined(spectrum->values)};
    }
  }
  solver::RoomTransport& t = prepared.transport;
  for (solver::Lighting& light : t.lightings) {
    light.emission = (light.emission.matrix() * combine).array();
    light.direct = (light.direct.matrix() * combine).array();
  }
  const auto combine_direct = [&](solver::ReceiverRow& row) {
    for (ArrayXd& direct : row.direct) direct = combined(direct);
  };
  for (solver::ReceiverRow& row : t.receivers) combine_direct(row);
  for (solver::ViewedWall& wall : t.viewed) {
    combine_direct(wall.row);
    for (solver::SeenSky& sky : wall.sky) {
      sky = {.background = combined(sky.background), .field = combined(sky.field)};
    }
  }
  return prepared;
}

}  // namespace apps
