#pragma once
#include <array>
#include <vector>

#include "appearance/spectra/viewed_light.h"
#include "scenes/room.h"
#include "solver/response/reduced_room.h"
#include "solver/rooms/lamp_white.h"
#include "solver/rooms/transport.h"

namespace solver {

/// The painted room as its viewers see it, under each lighting, as a function of all paints. Plain
/// data, to be saved and loaded.
struct ReducedViews {
  ReducedRoom room;  ///< its lights are the scenarios, or all lights as they are if there are none
  spectra::Grid grid;
  int viewed = 0;                      ///< viewed points: one per group of painted surfaces
  bool white_of_surfaces = false;      ///< else the white is ideal
  std::vector<Eigen::VectorXd> share;  ///< per viewed point: of the view, what fixed near-white
                                       ///< surfaces take, and what each group would as such
  std::vector<std::vector<LampLight>> lamps;  ///< per viewed point and lighting
  std::vector<double> angle_deg;              ///< of the paint in view, per viewed point
};

/// @throws std::invalid_argument  if nothing is painted, or the transport's viewed points are not
/// one per group
[[nodiscard]] ReducedViews reduce_views(const scenes::Room& room, const RoomTransport& transport,
                                        const ReductionOptions& options = {});

/// What the viewer of one group of painted surfaces gets, as a function of one group's paint; the
/// other paints are given. In each band every output is, with the eigenvalues lambda_k < 1 of the
/// projected K,
///   y0 + sum_k w_k rho / (1 - rho lambda_k).
class RoomResponse {
 public:
  /// @param varying  the group whose paint varies
  /// @param viewed   the group that is looked at
  /// @param paints   of each group; that of `varying` is not read and may be empty
  /// @throws std::invalid_argument  if there is no such group or another's paint is missing
  RoomResponse(const ReducedViews& views, int varying, int viewed,
               const std::vector<spectra::Spectrum>& paints);

  [[nodiscard]] std::size_t lightings() const { return sums_.size(); }

  /// @throws std::invalid_argument  if the paint is no reflectance on the room's grid, from 0 to
  /// the highest that the room was reduced for
  /// @throws std::domain_error      if the white is that of near-white surfaces and none is in view
  [[nodiscard]] spectra::ViewedLight light(const spectra::Spectrum& paint,
                                           std::size_t lighting = 0) const;

  /// With exact derivatives.
  [[nodiscard]] spectra::ViewedLightSlope slope(const spectra::Spectrum& paint,
                                                std::size_t lighting = 0) const;

 private:
  /// Irradiance, background, field; then, for the white of surfaces, the light of those whose paint
  /// is given and of the varying group.
  enum Output { irradiance, background, field, white_given, white_varying, kOutputs };

  static constexpr int kMostBands = 32;
  using Lane = Eigen::Array<double, kMostBands, 1>;  ///< one value per band, 0 beyond the grid
  using Lanes = std::array<Lane, kOutputs>;

  struct Sums {
    Lanes constant;             ///< y0
    std::vector<Lanes> weight;  ///< w_k, per pole
  };

  [[nodiscard]] Lane lane_of(const spectra::Spectrum& paint) const;
  [[nodiscard]] spectra::ViewedLight viewed(const Lanes& outputs, const Lane& sample,
                                            const spectra::Spectrum& paint) const;
  void add_lamps(spectra::ViewedLight& light, std::size_t lighting) const;
  void set_outputs(const ReducedViews& views, const std::vector<spectra::Spectrum>& paints);
  void add_band(const ReducedViews& views, int band, const Eigen::VectorXd& reflectance);
  void add_pole();
  void check(const spectra::Spectrum& paint) const;

  spectra::Grid grid_;
  double highest_reflectance_ = 0;
  int varying_ = 0, viewed_ = 0, outputs_ = 0;
  Eigen::MatrixXd chosen_;                      ///< outputs_ x outputs of the reduced room
  double share_given_ = 0, share_varying_ = 0;  ///< of the view, as near-white surfaces
  Lane viewed_paint_;                           ///< where the viewed group does not vary
  std::vector<Lane> pole_;                      ///< lambda_k
  std::vector<Sums> sums_;                      ///< per lighting
  std::vector<LampLight> lamps_;                ///< per lighting
  double angle_deg_ = 0;
};

}  // namespace solver
