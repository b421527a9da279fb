#pragma once
#include <Eigen/Core>
#include <Eigen/LU>
#include <array>
#include <cmath>

/// The arithmetic of CIECAM02 [CIE159], for double and for scalars that carry derivatives. Inside
/// appearance/ only; its checks, its special cases and its contracts are in ciecam02.h.
namespace appearance::steps {

template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;
template <typename T>
using Matrix3 = Eigen::Matrix<T, 3, 3>;

inline const Eigen::Matrix3d kCat02{
    {0.7328, 0.4296, -0.1624}, {-0.7036, 1.6975, 0.0061}, {0.0030, 0.0136, 0.9834}};
inline const Eigen::Matrix3d kHuntPointerEstevez{
    {0.38971, 0.68898, -0.07868}, {-0.22981, 1.18340, 0.04641}, {0, 0, 1}};
// [Neumann2004] eq. 26 misprints digits of this product, so it is computed.
inline const Eigen::Matrix3d kConesFromCat02 = kHuntPointerEstevez * kCat02.inverse();

inline constexpr double kNoise = 0.305;  // the 0.1 offsets within R'a + G'a + 1.05 B'a

/// base^exponent for base >= 0, cheaper than std::pow; its error of 1e-15 instead of 1e-16 is far
/// below what is promised here.
template <typename T, typename Exponent>
T positive_power(const T& base, const Exponent& exponent) {
  using std::exp, std::log;
  return exp(T(exponent * log(base)));
}

/// The compression [CIE159] without its offset 0.1, which the sums below contain exactly. So black
/// is exactly 0 and dark colours keep their digits. Negative cones are compressed symmetrically.
template <typename T>
Vector3<T> compressed(const Vector3<T>& cones) {
  using std::abs, std::exp, std::log;
  std::array<T, 3> power{};  // |cone|^0.42, all logarithms first: none waits for another
  for (int i = 0; i < 3; ++i) power[i] = log(T(abs(cones[i])));
  for (T& p : power) p = exp(T(0.42 * p));
  Vector3<T> response;
  for (int i = 0; i < 3; ++i) {
    response[i] = (cones[i] < 0 ? -400.0 : 400.0) * power[i] / (27.13 + power[i]);
  }
  return response;
}

/// A / N_bb
template <typename T>
T achromatic(const Vector3<T>& r) {
  return 2 * r[0] + r[1] + r[2] / 20;
}

template <typename T>
struct Opponent {
  T strength, cos_h, sin_h;  ///< hypot(a, b), and the direction of (a, b)
};

template <typename T>
Opponent<T> opponent(const Vector3<T>& r) {
  using std::sqrt;
  const T red_green = (11 * r[0] - 12 * r[1] + r[2]) / 11;  // a
  const T yellow_blue = (r[0] + r[1] - 2 * r[2]) / 9;       // b
  const T strength = sqrt(T(red_green * red_green + yellow_blue * yellow_blue));
  if (strength == 0) return {.strength = T(0), .cos_h = T(1), .sin_h = T(0)};
  return {.strength = strength, .cos_h = red_green / strength, .sin_h = yellow_blue / strength};
}

/// e_t from cos h and sin h: (cos(h + 2 rad) + 3.8) / 4
template <typename T>
T eccentricity(const T& cos_h, const T& sin_h) {
  static const double kCos2 = std::cos(2.0), kSin2 = std::sin(2.0);
  return (cos_h * kCos2 - sin_h * kSin2 + 3.8) / 4;
}

/// F_L
template <typename T>
T luminance_adaptation(const T& adapting_luminance_cd_m2) {
  using std::pow;
  const T l = 5 * adapting_luminance_cd_m2;
  const T k4 = pow(T(l + 1), -4.0), rest = 1 - k4;
  return 0.2 * k4 * l + 0.1 * rest * rest * pow(l, 1.0 / 3);
}

template <typename T>
struct Conditions {
  Vector3<T> white;
  T adapting_luminance_cd_m2, background_y, f, c, n_c;
};

/// As in `Adaptation`, whose doubles `seen` takes as well.
template <typename T>
struct Adapted {
  T f_l, background_induction, lightness_exponent, chroma_factor, chroma_scale;
  T white_response{};
  Vector3<T> gain;
  Matrix3<T> cones_from_xyz;
};

template <typename T>
Adapted<T> adapted(const Conditions<T>& view) {
  using std::exp, std::pow, std::sqrt;
  const Vector3<T> white = kCat02.cast<T>() * view.white;
  const T& la = view.adapting_luminance_cd_m2;
  const T n = view.background_y / view.white[1], f_l = luminance_adaptation(la);
  const T d = view.f * (1 - exp(T(-(la + 42) / 92)) / 3.6);
  const T background_induction = 0.725 * pow(n, -0.2);

  Adapted<T> a{.f_l = f_l,
               .background_induction = background_induction,
               .lightness_exponent = view.c * (1.48 + sqrt(n)),
               .chroma_factor = pow(T(1.64 - exp(T(std::log(0.29) * n))), 0.73),
               .chroma_scale = 50000.0 / 13 * view.n_c * background_induction,
               .gain = {},
               .cones_from_xyz = {}};
  for (int i = 0; i < 3; ++i) a.gain[i] = view.white[1] * d / white[i] + 1 - d;
  const Matrix3<T> gained = a.gain.asDiagonal() * kCat02.cast<T>();
  a.cones_from_xyz = (kConesFromCat02.cast<T>() * gained) * T(f_l / 100);
  a.white_response =
      background_induction * achromatic(compressed(Vector3<T>(a.cones_from_xyz * view.white)));
  return a;
}

/// What J, C and h are made of, whether the model defines them or not.
template <typename T>
struct Seen {
  bool negative_cone;
  T response, denominator;  ///< A, and the denominator of t
  T root_j{}, alpha{};      ///< sqrt(J / 100) and C / sqrt(J / 100); 0 where undefined
  Opponent<T> hue;

  [[nodiscard]] bool has_lightness() const { return !(response < 0); }

  [[nodiscard]] bool has_chroma() const { return has_lightness() && !(denominator <= 0); }
};

template <typename T, typename AnyAdaptation>
Seen<T> seen(const Vector3<T>& xyz, const AnyAdaptation& a) {
  const Vector3<T> cones = a.cones_from_xyz * xyz, r = compressed(cones);
  Seen<T> s{.negative_cone = cones[0] < 0 || cones[1] < 0 || cones[2] < 0,
            .response = a.background_induction * achromatic(r),
            .denominator = r[0] + r[1] + 1.05 * r[2] + kNoise,
            .hue = opponent(r)};
  if (s.has_lightness()) {
    s.root_j = positive_power(T(s.response / a.white_response), T(a.lightness_exponent / 2));
  }
  if (s.has_chroma()) {
    const T t =
        a.chroma_scale * eccentricity(s.hue.cos_h, s.hue.sin_h) * s.hue.strength / s.denominator;
    s.alpha = positive_power(t, 0.9) * a.chroma_factor;
  }
  return s;
}

}  // namespace appearance::steps
