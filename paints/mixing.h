#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "appearance/spectra/spectrum.h"
#include "paints/atlas_file.h"

namespace paints {

/// The surface of the film [Saunderson1942]: light that comes from outside is thrown back there by
/// k1 (as far as the measured reflectances include it: 0 where gloss was shut out), light that
/// comes from within the film by k2. Measured R = k1 + (1 - k1)(1 - k2) r / (1 - k2 r), where r is
/// the body's reflectance of the theory. Zeros: no correction.
struct Saunderson {
  double k1 = 0, k2 = 0;
};

/// Reflectance of an opaque film from K/S and back [KubelkaMunk1931]:
/// K/S = (1 - r)^2 / 2r. Without digits lost at either end.
[[nodiscard]] double body_reflectance(double k_over_s);
[[nodiscard]] double k_over_s(double body_reflectance);

/// Between what is measured and the body of the film.
[[nodiscard]] double measured_reflectance(double body, const Saunderson& surface);
[[nodiscard]] double body_behind(double measured, const Saunderson& surface);

/// A paint as an ingredient: absorption K and scattering S per band, per part of it.
struct Base {
  std::string name, label;
  Eigen::ArrayXd absorption, scattering;
};

/// Paints that can be mixed with each other.
struct BaseSet {
  spectra::Grid grid;
  Saunderson surface;
  std::vector<Base> bases;
  std::vector<std::string> left_out;  ///< names of paints too dark in some band to have a K/S
};

/// Single-constant theory [Duncan1940]: every paint of the atlas as a base with S = 1 and K = K/S
/// of its reflectance, which takes all paints to scatter alike. Paints without a K/S (reflectance
/// not above k1 somewhere) are left out.
/// @throws std::invalid_argument  unless 0 <= k1, k2 < 1
[[nodiscard]] BaseSet bases_of(const Atlas& atlas, const Saunderson& surface = {});

/// Opaque film of the bases, each with its parts: K and S add up in parts, and only their
/// proportions matter.
struct Mixture {
  spectra::Spectrum reflectance;
  Eigen::MatrixXd by_parts;  ///< bands x bases named: exact derivatives of the reflectance
};

/// @param bases  indices into set.bases, with parts >= 0 for each
/// @throws std::invalid_argument  sizes that differ, an unknown base, parts negative or all zero
[[nodiscard]] Mixture mixture(const BaseSet& set, const std::vector<int>& bases,
                              const Eigen::VectorXd& parts);

}  // namespace paints
