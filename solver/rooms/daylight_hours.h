#pragma once
#include <vector>

#include "solver/rooms/room_light.h"

namespace solver {

struct HourOfLight {
  std::size_t hour = 0;                      ///< into WeatherFile::hours
  double azimuth_deg = 0, altitude_deg = 0;  ///< of the sun; clockwise from +y
  bool defined = true;                       ///< false: no sky for this weather, no light told
  bool daylight = false;
  Bands irradiance;  ///< receiver x band, W m^-2 nm^-1
};

/// What receivers get of daylight, for thousands of skies over one room. Light that comes in is D
/// on the patches, and a receiver reads w of their radiosities: w^t (1 - rho F)^-1 rho D = u^t rho
/// D. So u is solved for once, a receiver and band each, by the same solver, as the exchange is
/// symmetric: u = A (v + H), v = w / A, H the light that rho v sends around. Each sky then takes no
/// more than its first shot.
class DaylightHours {
 public:
  /// All must outlive this. Lamps of the room do not count.
  DaylightHours(const scenes::Room& room, const RoomTransport& transport,
                const RadiosityOptions& options = {});

  /// Whether every receiver and band converged.
  [[nodiscard]] bool converged() const { return converged_; }

  /// Irradiance, receiver x band, W m^-2 nm^-1: exactly 0 where there is no sky.
  [[nodiscard]] Bands at(const scenes::SkyOfHour& hour, bool with_sun) const;

  /// Of hours of a weather file, from `first` to before `end`.
  [[nodiscard]] std::vector<HourOfLight> of(const scenes::WeatherSky& over, std::size_t first,
                                            std::size_t end) const;

 private:
  scenes::Room dark_;  ///< the room without any light
  const RoomTransport& transport_;
  Visibility visibility_;
  std::vector<Facet> facets_;
  std::vector<SlopeBasis> bases_;
  std::vector<Bands> response_;  ///< rho u of each receiver, row x band
  bool converged_ = true;
};

}  // namespace solver
