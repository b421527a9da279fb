#pragma once
#include <string>
#include <vector>

#include "appearance/spectra/spectrum.h"

namespace paints {

/// Steps of measured curves that need more than a straight line: finer than 1 nm they are noise and
/// averaged over +-5 nm around each 10 nm; at 20 nm the middle is found by a cubic.
class SpectralSteps {
 public:
  /// @param hold_ends  the end values stand for up to 10 nm that are missing from 400 and to 700
  void regularise(spectra::Samples& samples, bool hold_ends);

  /// What was done, a sentence each.
  void tell(std::vector<std::string>& notes) const;

 private:
  int averaged_ = 0, interpolated_ = 0, held_ = 0;
};

}  // namespace paints
