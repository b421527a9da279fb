#pragma once
#include <Eigen/Core>

#include "solver/rooms/transport.h"

namespace apps {

/// Neighbouring bands taken as one, all groups as equal as they can be: bands x groups, each column
/// a mean.
[[nodiscard]] Eigen::MatrixXd means_of_groups(Eigen::Index bands, Eigen::Index groups);

/// A room together with its transport.
struct PreparedRoom {
  scenes::Room room;
  solver::RoomTransport transport;
};

/// The same room whose light and reflectances are other combinations of its bands: columns of
/// `combine`, bands x columns. Of `room`, only the surfaces are changed, and the grid's number of
/// bands.
[[nodiscard]] PreparedRoom with_bands(PreparedRoom prepared, const Eigen::MatrixXd& combine);

}  // namespace apps
