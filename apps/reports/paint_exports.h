#pragma once
#include <string>
#include <vector>

#include "paints/paint_list.h"

namespace apps {

/// What paints can be written as, by the end of the file's name.
enum class PaintExport { csv, cxf, ase, gpl };

/// @throws spectra::FileError  if the name ends in none of .csv, .cxf, .ase and .gpl
[[nodiscard]] PaintExport export_by_name(const std::string& path);

/// The whole file: spectra on the 31 bands as our own CSV or CxF3; sRGB colours under D65 as an
/// Adobe (ASE) or GIMP (GPL) palette. Reconstructed spectra are marked in each but ASE.
[[nodiscard]] std::string exported(PaintExport format, const paints::PaintFile& file,
                                   const std::vector<paints::ListedPaint>& listed);

}  // namespace apps
