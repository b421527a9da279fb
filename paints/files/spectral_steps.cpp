#include "paints/files/spectral_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace paints {
namespace {

constexpr double kBand_nm = 10;
constexpr std::size_t kFewest = 8;

bool steps_are(const spectra::Samples& samples, double step_nm) {
  for (std::size_t k = 1; k < samples.nm.size(); ++k) {
    if (std::abs(samples.nm[k] - samples.nm[k - 1] - step_nm) > 1e-6) return false;
  }
  return samples.nm.size() >= kFewest;
}

/// Means over +-5 nm around each 10 nm that has samples on both sides.
spectra::Samples band_means(const spectra::Samples& fine) {
  spectra::Samples bands;
  const double last_nm = fine.nm.back();
  for (double nm = std::ceil(fine.nm.front() / kBand_nm) * kBand_nm; nm <= last_nm;
       nm += kBand_nm) {
    const auto from = std::lower_bound(fine.nm.begin(), fine.nm.end(), nm - kBand_nm / 2),
               to = std::upper_bound(from, fine.nm.end(), nm + kBand_nm / 2);
    if (from == to) continue;
    double sum = 0;
    for (auto k = from; k != to; ++k) {
      sum += fine.values[static_cast<std::size_t>(k - fine.nm.begin())];
    }
    bands.nm.push_back(nm);
    bands.values.push_back(sum / static_cast<double>(to - from));
  }
  return bands;
}

/// A sample in each middle, by the cubic through its four neighbours; at the ends by a parabola.
spectra::Samples halved(const spectra::Samples& coarse) {
  const auto& v = coarse.values;
  const std::size_t n = v.size();
  spectra::Samples fine;
  for (std::size_t k = 0; k < n; ++k) {
    fine.nm.push_back(coarse.nm[k]);
    fine.values.push_back(v[k]);
    if (k + 1 == n) break;
    double middle = 0;
    if (k == 0) {
      middle = (3 * v[0] + 6 * v[1] - v[2]) / 8;
    } else if (k + 2 == n) {
      middle = (3 * v[n - 1] + 6 * v[n - 2] - v[n - 3]) / 8;
    } else {
      middle = (9 * (v[k] + v[k + 1]) - v[k - 1] - v[k + 2]) / 16;
    }
    fine.nm.push_back((coarse.nm[k] + coarse.nm[k + 1]) / 2);
    fine.values.push_back(std::clamp(middle, 0.0, std::max({v[k], v[k + 1], 0.9999})));
  }
  return fine;
}

}  // namespace

void SpectralSteps::regularise(spectra::Samples& samples, bool hold_ends) {
  if (samples.nm.size() >= kFewest) {
    const double mean_step =
        (samples.nm.back() - samples.nm.front()) / static_cast<double>(samples.nm.size() - 1);
    if (mean_step < 0.999) {
      samples = band_means(samples);
      ++averaged_;
    } else if (steps_are(samples, 2 * kBand_nm)) {
      samples = halved(samples);
      ++interpolated_;
    }
  }
  if (!hold_ends || samples.nm.empty()) return;
  const double first = spectra::kTransportGrid.first_nm, last = spectra::kTransportGrid.last_nm();
  if (samples.nm.front() > first && samples.nm.front() <= first + kBand_nm) {
    samples.nm.insert(samples.nm.begin(), first);
    samples.values.insert(samples.values.begin(), samples.values.front());
    ++held_;
  }
  if (samples.nm.back() < last && samples.nm.back() >= last - kBand_nm) {
    samples.nm.push_back(last);
    samples.values.push_back(samples.values.back());
    ++held_;
  }
}

void SpectralSteps::tell(std::vector<std::string>& notes) const {
  if (averaged_ > 0) {
    notes.push_back(fmt::format(
        "{} spectra in steps below 1 nm were averaged over 10 nm around each 10 nm", averaged_));
  }
  if (interpolated_ > 0) {
    notes.push_back(fmt::format(
        "{} spectra in steps of 20 nm were interpolated by a cubic to 10 nm", interpolated_));
  }
  if (held_ > 0) {
    notes.push_back(fmt::format("{} ends of spectra were held to 400 or 700 nm", held_));
  }
}

}  // namespace paints
