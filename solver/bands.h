#pragma once
#include <Eigen/Core>

namespace solver {

/// One row per patch, one column per band. In a spectral solve a band is one wavelength and the
/// unit is W m^-2 nm^-1; the solver itself never asks.
using Bands = Eigen::Array<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
using BandRow = Eigen::Array<double, 1, Eigen::Dynamic>;

}  // namespace solver
