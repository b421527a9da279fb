#pragma once
#include <string>

#include "appearance/spectra/spectrum_file.h"

namespace spectra {

/// Spectra of lamps from a file of any kind that is met:
///  - `name,400,410,...` and a row each, as read_spectrum_file takes it;
///  - columns of text: nm, then a value or several, by comma, semicolon, tab or blanks; with
///    semicolons or tabs the comma is decimal; lines of letters, quotes, # ; ! are comments, the
///    last before the numbers may name the columns; CGATS between BEGIN_DATA and END_DATA;
///  - XML: TM-27 (.spdx), or TM-33 with a spectrum for each emitter.
/// A curve without a name of its own is called by its number, from 1. Values below 0, down to 1 %
/// of the peak, are taken as 0.
/// @throws FileError   if it cannot be read
/// @throws InputError  with every fault: numbers that are none, nm not rising or outside 200 to
/// 2500, 400 to 700 nm not covered, fewer than 10 samples in it, values below -1 % of the peak, a
/// reflectance or transmittance
[[nodiscard]] SpectrumFile read_light_file(const std::string& path);

}  // namespace spectra
