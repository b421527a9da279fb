#pragma once
#include <Eigen/Core>
#include <string>

#include "appearance/spectra/tristimulus.h"

namespace appearance {

/// The surround's factors of [CIE159] Table 1 ([Neumann2004] Table 5 with N_c of dim corrected to
/// 0.9).
struct SurroundFactors {
  double f = 1, c = 0.69, n_c = 1;
};

struct ViewingConditions {
  spectra::RelativeXyz white;           ///< adopted white; y is Y_w, usually 100
  double adapting_luminance_cd_m2 = 0;  ///< L_A
  double background_y = 0;              ///< Y_b, on the scale of white.y
  SurroundFactors surround;
};

/// What the model leaves undefined for a sample. All false: OK.
struct Status {
  bool negative_cone =
      false;  ///< NEGCONE: a cone response is negative; all correlates stay defined
  bool negative_achromatic = false;    ///< A_NEG: A < 0; only h and H are defined
  bool no_chroma_denominator = false;  ///< TDEN: t has no denominator; J, Q, h and H are defined

  [[nodiscard]] bool all_defined() const { return !negative_achromatic && !no_chroma_denominator; }
};

/// "OK", or the names above joined by '+'.
[[nodiscard]] std::string to_string(const Status& status);

/// Perceptual correlates [CIE159]. Those that `status` leaves undefined are 0.
struct Correlates {
  Status status;
  double lightness = 0;       ///< J
  double chroma = 0;          ///< C
  double hue_deg = 0;         ///< h, 0..360
  double hue_quadrature = 0;  ///< H, 0..400
  double brightness = 0;      ///< Q
  double colourfulness = 0;   ///< M
  double saturation = 0;      ///< s
  double a_c = 0, b_c = 0;    ///< C cos h, C sin h
  double a_m = 0, b_m = 0;
  double a_s = 0, b_s = 0;
};

/// The conditions digested once: reuse it for many samples. Symbols of [CIE159] in the comments.
struct Adaptation {
  double background_induction = 0;  ///< N_bb = N_cb
  double lightness_exponent = 0;    ///< c z
  double f_l_4th = 0;               ///< F_L^0.25: M = C F_L^0.25
  double chroma_factor = 0;         ///< (1.64 - 0.29^n)^0.73
  double white_response = 0;        ///< A_w
  double chroma_scale = 0;          ///< 50000/13 N_c N_cb
  double brightness_scale = 0;      ///< Q / sqrt(J/100) = 4/c (A_w + 4) F_L^0.25
  double saturation_scale = 0;      ///< s / sqrt(alpha) = 50 sqrt(c / (A_w + 4))
  Eigen::Matrix3d cones_from_xyz;   ///< XYZ -> F_L/100 times the adapted cone responses R' G' B'
  Eigen::Matrix3d xyz_from_cones;   ///< its inverse
};

/// @throws std::domain_error  non-finite input; L_A, Y_b, Y_w <= 0; c or N_c outside 0..2; F
/// outside 0..1; a CAT02 component of the white <= 0; a white without achromatic response
[[nodiscard]] Adaptation adapt(const ViewingConditions& conditions);

/// Never a NaN: what a sample leaves undefined is 0 and named in `status`. J = C = Q = M = 0 where
/// the achromatic response is 0, h = 0 for black.
/// @throws std::domain_error  if the sample is not finite
[[nodiscard]] Correlates ciecam02_forward(const spectra::RelativeXyz& sample,
                                          const Adaptation& adaptation);

struct LightnessChromaHue {
  double lightness = 0, chroma = 0, hue_deg = 0;
};

/// The stimulus that looks so; its components may be negative for wishes no light can fulfil.
/// J = C = 0 is black, whatever the hue.
/// @throws std::domain_error  non-finite, J < 0, C < 0, or no stimulus has these correlates
[[nodiscard]] spectra::RelativeXyz ciecam02_inverse(const LightnessChromaHue& wished,
                                                    const Adaptation& adaptation);

/// Hue composition, whole shares of the two neighbouring unique hues in the order R Y G B R: 105 ->
/// "95Y 5G"; a share that rounds to nothing is left out: 100 -> "100Y".
/// @throws std::invalid_argument  outside 0..400
[[nodiscard]] std::string hue_composition(double hue_quadrature);

}  // namespace appearance
