#pragma once
#include <string>

#include "paints/files/paint_file.h"

namespace paints {

/// "shop.csv?white=D50/2,scale=percent": a path, and behind a question mark what is chosen of
/// ReadChoices; if there is a file of the whole name, that.
struct PaintSource {
  std::string path;
  ReadChoices choices;
};

/// @throws spectra::InputError  if a choice is none of those there are
[[nodiscard]] PaintSource paint_source(const std::string& path_and_choices);

/// Reads paints from a file of any of these formats (README.md): recognised by what is in it, never
/// by its name. What was assumed is a note; where two readings are possible a fault asks for the
/// choice.
/// @throws spectra::FileError   if it cannot be read
/// @throws spectra::InputError  with every fault (the first 100)
[[nodiscard]] PaintFile read_paint_file(const std::string& path_and_choices);

/// The same for bytes in memory; `path` serves the messages.
[[nodiscard]] PaintFile parse_paint_file(const std::string& path, std::string bytes,
                                         const ReadChoices& choices = {});

}  // namespace paints
