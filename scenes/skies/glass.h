#pragma once
#include <Eigen/Core>
#include <vector>

namespace scenes {

/// Panes of clear or tinted glass, uncoated, refractive index 1.52, all alike. In each band a pane
/// lets through what its inside does not absorb, and its two sides reflect (Fresnel); what bounces
/// within and between panes is summed up, per polarisation, and then the mean is taken.
class Glass {
 public:
  /// Of clear panes, each 0.88 by itself.
  [[nodiscard]] static double clear_at_normal(int panes);

  /// The largest transmittance at normal incidence, of panes that absorb nothing.
  [[nodiscard]] static double most_at_normal(int panes);

  /// @param panes      1 or 2
  /// @param at_normal  per band, 0 to most_at_normal
  Glass(int panes, const Eigen::ArrayXd& at_normal);

  /// Per band, of light whose direction has this cosine with the normal.
  [[nodiscard]] Eigen::ArrayXd transmittance(double cosine) const;

  /// The same where it differs from band to band, and those numbers put to their bands.
  [[nodiscard]] Eigen::ArrayXd distinct_transmittance(double cosine) const;
  [[nodiscard]] Eigen::ArrayXd in_bands(const Eigen::ArrayXd& distinct) const;

  /// Per band, of light from all sides of a half-space, even radiance.
  [[nodiscard]] Eigen::ArrayXd diffuse_transmittance() const;
  [[nodiscard]] Eigen::ArrayXd diffuse_reflectance() const;

  [[nodiscard]] int panes() const { return panes_; }

  [[nodiscard]] const Eigen::ArrayXd& at_normal() const { return at_normal_; }

 private:
  struct Share {
    double transmitted = 0, reflected = 0;
  };

  [[nodiscard]] static Share of_panes(int panes, double inside, double cosine);
  template <typename Of>
  [[nodiscard]] Eigen::ArrayXd from_all_sides(const Of& of_share) const;

  int panes_;
  Eigen::ArrayXd at_normal_;
  std::vector<double> inside_;  ///< transmittance of one pane's inside along its normal; distinct
  std::vector<int> of_band_;    ///< into inside_
};

}  // namespace scenes
