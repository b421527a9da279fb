#pragma once
#include <functional>
#include <string>

#include "appearance/spectra/spectrum.h"

namespace spectra {

/// The light that decides how a viewed wall looks: radiosities, W m^-2 nm^-1 (radiance times pi),
/// on one grid.
struct ViewedLight {
  Spectrum sample;      ///< the viewed point itself
  Spectrum background;  ///< mean over the ring from 1 to 11 degrees around the view axis
  Spectrum field;  ///< solid-angle mean from 11 to 90 degrees: the adapting field, lamps included
  Spectrum white;  ///< the reference white: an ideal diffuser at the viewed point unless chosen
                   ///< otherwise
  Spectrum lamps = {};  ///< what an ideal diffuser there sends of light that no surface has
                        ///< reflected, of any amount; of that alone the colour counts
  bool lamps_by_flux =
      false;             ///< no lamp sees the point: `lamps` is all light that enters the room
  double angle_deg = 0;  ///< of the cone that is as large, in solid angle, as the paint in view
};

/// The room as the paint sees it: the reflectance of the painted surfaces in, the viewed light out.
using RoomResponse = std::function<ViewedLight(const Spectrum& reflectance)>;

/// The viewed light and, band by band, its derivative by the reflectance of the paint in that band
/// (light in one band depends on that band's reflectance alone).
struct ViewedLightSlope {
  ViewedLight light;
  ViewedLight by_reflectance;
};

using RoomResponseSlope = std::function<ViewedLightSlope(const Spectrum& reflectance)>;

/// The room in one of its lightings.
struct LitRoom {
  std::string name;   ///< of the scenario; empty: all lights as they are
  double weight = 1;  ///< among the lightings
  RoomResponse view;
};

/// How the distances under several lightings become one: their weighted mean, or the largest.
enum class Judgement { mean, worst };

/// How viewing conditions are read from the lit room [Neumann2004] 2.4, 3.6, 4.4, Table 5.
enum class Surround { neumann, cie, illuminance, average, dim, dark };
/// sample: the paper's shortcut, Y_b = Y of the wall; fixed: a number
enum class Background { ring, sample, fixed };
enum class ReferenceWhite { ideal, surfaces };  ///< surfaces: mean over near-white surfaces in view

struct ViewingChoices {
  Surround surround = Surround::neumann;
  Background background = Background::ring;
  ReferenceWhite white = ReferenceWhite::ideal;
  double white_share = 1;    ///< of `white` in the adopted one; the rest is `ViewedLight::lamps`,
                             ///< both at equal Y
  double background_y = 20;  ///< Y_b where the background is fixed
  bool size_effect = false;  ///< large fields look lighter and more chromatic
  double angle_deg = 0;      ///< of the viewed paint, for the size effect; 0: as it is in view
};

}  // namespace spectra
