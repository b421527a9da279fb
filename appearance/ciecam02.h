#pragma once
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

/// The conditions digested once: reuse it for many samples.
struct Adaptation;

/// @throws std::domain_error  non-finite input; L_A, Y_b, Y_w <= 0; a CAT02 component of the white
/// <= 0
[[nodiscard]] Adaptation adapt(const ViewingConditions& conditions);

/// @throws std::domain_error  if the sample is not finite
[[nodiscard]] Correlates ciecam02_forward(const spectra::RelativeXyz& sample,
                                          const Adaptation& adaptation);

struct LightnessChromaHue {
  double lightness = 0, chroma = 0, hue_deg = 0;
};

/// @throws std::domain_error  non-finite, J < 0, C < 0, or no stimulus has these correlates
[[nodiscard]] spectra::RelativeXyz ciecam02_inverse(const LightnessChromaHue& wished,
                                                    const Adaptation& adaptation);

/// Hue composition, shares of the two neighbouring unique hues in the order R Y G B R: 105 -> "95Y
/// 5G".
[[nodiscard]] std::string hue_composition(double hue_quadrature);

}  // namespace appearance
