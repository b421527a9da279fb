#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/commands/commands.h"
#include "scenes/files/closed_form_json.h"
#include "solver/judges/closed_form_inverse.h"

namespace apps {

/// Row per part, as the closed forms want it.
[[nodiscard]] solver::Parts parts_of(std::span<const spectra::Spectrum> spectra);

/// A wish, the names of its parts, and the reflectance that answers it.
struct AnsweredWish {
  scenes::WishedPart wished;
  std::string of, by;
  solver::InverseReflectance inverse;
};

using Inverse = std::function<solver::InverseReflectance(const solver::WishedRadiosity&)>;

/// Answers the wish of a file, if there is one, and paints part `by` with the answer.
[[nodiscard]] std::optional<AnsweredWish> answer(const std::optional<scenes::WishedPart>& wished,
                                                 std::span<const char* const> part_names,
                                                 const Inverse& inverse,
                                                 solver::Parts& reflectance);

/// What cube and brick have to tell.
struct ClosedFormReport {
  std::string subcommand, form_factors;
  std::vector<std::string> part_names, notes;
  solver::Parts radiosity;  ///< W m^-2 nm^-1, on the closed-form grid
  std::optional<AnsweredWish> wish;
};

/// Writes radiosity.csv and run.json; for a wish also wished.csv and reflectance.csv.
/// @throws spectra::FileError
void write_report(const ClosedFormReport& report, const FileCommand& command,
                  const Session& session);

}  // namespace apps
