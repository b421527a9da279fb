#pragma once
#include <span>
#include <string>
#include <vector>

#include "apps/commands.h"
#include "solver/closed_form.h"

namespace apps {

/// Row per part, as the closed forms want it.
[[nodiscard]] solver::Parts parts_of(std::span<const spectra::Spectrum> spectra);

/// What cube and brick have to tell.
struct ClosedFormReport {
  std::string subcommand, form_factors;
  std::vector<std::string> part_names, notes;
  solver::Parts radiosity;  ///< W m^-2 nm^-1, on the closed-form grid
};

/// Writes radiosity.csv and run.json.
/// @throws spectra::FileError
void write_report(const ClosedFormReport& report, const FileCommand& command,
                  const Session& session);

}  // namespace apps
