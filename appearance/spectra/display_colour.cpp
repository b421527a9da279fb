#include "appearance/spectra/display_colour.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <stdexcept>

#include "appearance/spectra/cie_tables.h"
#include "appearance/spectra/spectrum_library.h"
#include "appearance/spectra/tristimulus.h"

namespace spectra {
namespace {

using Eigen::ArrayXd, Eigen::Matrix3d, Eigen::Matrix3Xd, Eigen::MatrixXd, Eigen::Vector3d;

Matrix3d inverse(const Matrix3d& m, const char* what) {
  const Eigen::FullPivLU<Matrix3d> lu(m);
  if (!lu.isInvertible()) throw std::invalid_argument(fmt::format("{} has no inverse", what));
  return lu.inverse();
}

MatrixXd compute_room_lights() {
  MatrixXd lamp_moment = MatrixXd::Zero(kTransportGrid.count, kTransportGrid.count);
  for (const NamedSpectrum& lamp : lamps("houser").entries) {
    const Spectrum light = light_on(kTransportGrid, lamp.samples);
    const Eigen::VectorXd v = light.values / absolute_xyz(light).y;
    lamp_moment += v * v.transpose();
  }
  // Light off a paper is lamp times reflectance: the sum over all pairs is a product of two sums.
  MatrixXd filters = MatrixXd::Ones(kTransportGrid.count, kTransportGrid.count);
  for (const NamedSpectrum& paper : atlas("munsell-nickerson").entries) {
    const Eigen::VectorXd rho = reflectance_on(kTransportGrid, paper.samples).values;
    filters += rho * rho.transpose();
  }
  return lamp_moment.cwiseProduct(filters);
}

}  // namespace

DisplayConversion three_component_conversion(const Matrix3d& from_reference) {
  return {.from_reference = from_reference,
          .to_reference = inverse(from_reference, "the conversion to the display")};
}

DisplayConversion least_squares_conversion(const Matrix3Xd& from_reference,
                                           const MatrixXd& second_moment) {
  if (second_moment.rows() != from_reference.cols() ||
      second_moment.cols() != from_reference.cols()) {
    throw std::invalid_argument(fmt::format("lights of {} x {} in a reference of {} components",
                                            second_moment.rows(), second_moment.cols(),
                                            from_reference.cols()));
  }
  const Eigen::MatrixX3d seen = second_moment * from_reference.transpose();
  return {.from_reference = from_reference,
          .to_reference =
              seen * inverse(from_reference * seen, "the second moment of the lights' colours")};
}

Matrix3d object_matrix(const DisplayConversion& conversion, const ArrayXd& object) {
  return conversion.from_reference * object.matrix().asDiagonal() * conversion.to_reference;
}

Vector3d object_diagonal(const Matrix3Xd& from_reference, const ArrayXd& object,
                         const ArrayXd& light) {
  const Vector3d shown = from_reference * light.matrix();
  if (!(shown.array() != 0).all()) {
    throw std::invalid_argument("the representative light lacks a component of the display");
  }
  return (from_reference * (object * light).matrix()).cwiseQuotient(shown);
}

Matrix3d object_matrix_for_reference_light(const Matrix3d& from_reference,
                                           const Eigen::Array3d& object) {
  return from_reference * object.matrix().asDiagonal();
}

Matrix3Xd rgb_matching(const RgbSpace& display, const Grid& grid) {
  return kMaxLuminousEfficacy_lm_W * grid.step_nm *
         inverse(xyz_from_rgb_on(grid, display), "the display's matrix") *
         colour_matching(grid).transpose();
}

const MatrixXd& room_lights_second_moment() {
  static const MatrixXd moment = compute_room_lights();
  return moment;
}

Matrix3d linear_adaptation(const Vector3d& from_white_xyz, const Vector3d& to_white_xyz) {
  Matrix3d responses;
  responses << 0.8951, 0.2664, -0.1614,  //
      -0.7502, 1.7135, 0.0367,           //
      0.0389, -0.0685, 1.0296;
  const Vector3d from = responses * from_white_xyz, to = responses * to_white_xyz;
  if (!((from.array() > 0).all() && (to.array() > 0).all())) {
    throw std::invalid_argument("a white with a response that is not above 0 cannot be adapted to");
  }
  return responses.inverse() * to.cwiseQuotient(from).asDiagonal() * responses;
}

}  // namespace spectra
