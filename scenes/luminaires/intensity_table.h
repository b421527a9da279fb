#pragma once
#include <Eigen/Core>
#include <vector>

namespace scenes {

/// How a table of intensities lays its angles over the sphere [LM63]. Each is a net of latitudes
/// (the polar angle) and longitudes (the azimuth). Axes of the luminaire: x towards horizontal
/// angle 0, z up; type A looks along x, the others along -z.
enum class Goniometry {
  c,  ///< polar: gamma from -z, azimuth: plane C, counter-clockwise from x seen from above
  b,  ///< polar: horizontal, azimuth: vertical, clockwise from -z; floodlights
  a,  ///< polar: vertical, azimuth: horizontal, clockwise from x; headlamps
};

/// Luminous intensity by direction, cd, linear in both angles between the tabulated ones and 0
/// beyond them. Symmetries are written out: type C covers 0..360, A and B what light leaves.
class IntensityTable {
 public:
  /// Both angles in degrees, rising. @param intensity_cd  azimuth x polar
  /// @throws std::invalid_argument  if sizes differ, angles do not rise, or there are less than two
  IntensityTable(Goniometry type, std::vector<double> polar_deg, std::vector<double> azimuth_deg,
                 Eigen::ArrayXXd intensity_cd);

  [[nodiscard]] Goniometry type() const { return type_; }

  [[nodiscard]] const std::vector<double>& polar_deg() const { return polar_.angles_deg; }

  [[nodiscard]] const std::vector<double>& azimuth_deg() const { return azimuth_.angles_deg; }

  [[nodiscard]] const Eigen::ArrayXXd& intensity_cd() const { return intensity_cd_; }

  [[nodiscard]] double peak_cd() const { return intensity_cd_.maxCoeff(); }

  /// Smallest step of either angle, degrees.
  [[nodiscard]] double finest_step_deg() const;

  /// @param direction  in the axes of the luminaire, of any length above 0
  [[nodiscard]] double at(const Eigen::Vector3d& direction) const;

  /// At least the largest intensity within an angle around a direction.
  [[nodiscard]] double most_within(const Eigen::Vector3d& direction, double radius_rad) const;

  /// Flux of exactly this surface, lm: in closed form, no sampling.
  [[nodiscard]] double flux_lm() const;

  /// The same between two polar angles: for type C a zone of gamma.
  [[nodiscard]] double flux_lm(double from_deg, double to_deg) const;

 private:
  /// Where an angle lies among the tabulated ones; outside if `low` is -1.
  struct Cell {
    Eigen::Index low = -1;
    double share = 0;  ///< of the way to the next
  };

  struct Axis {
    std::vector<double> angles_deg;
    double per_deg = 0;  ///< 1 / step; 0: uneven

    explicit Axis(std::vector<double> angles);
    [[nodiscard]] Cell cell(double angle_deg) const;
  };

  struct Angles {
    double polar_deg = 0, azimuth_deg = 0;
  };

  [[nodiscard]] Angles angles_of(const Eigen::Vector3d& direction) const;
  [[nodiscard]] double most_in(const Angles& low, const Angles& high) const;

  Goniometry type_;
  Axis polar_, azimuth_;
  Eigen::ArrayXXd intensity_cd_;
  Eigen::ArrayXd over_azimuth_;  ///< integral of I over the azimuth at each polar angle, cd rad
};

}  // namespace scenes
