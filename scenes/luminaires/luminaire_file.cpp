#include "scenes/luminaires/luminaire_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "scenes/luminaires/eulumdat_reader.h"
#include "scenes/luminaires/ies_reader.h"

namespace scenes {

Luminaire read_luminaire(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  if (ending != ".ies" && ending != ".ldt") {
    throw spectra::InputError({{path, 0, 0, "", "the name of a luminaire ends in .ies or .ldt",
                                "give an IES LM-63 or EULUMDAT file"}});
  }
  const LuminaireText text = read_luminaire_text(path);
  return ending == ".ies" ? read_ies(text) : read_eulumdat(text);
}

}  // namespace scenes
