#include "paints/files/paint_draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "paints/files/source_text.h"
#include "paints/files/spectral_steps.h"

namespace paints {
namespace {

constexpr std::size_t kMaxFaults = 100;
constexpr double kPercentAbove = 1.5, kFractionUpTo = 1.2;
constexpr double kDarkNoise = 0.01;  ///< below 0 by so much is noise of the instrument
constexpr double kClipped = 0.9999;  ///< what a fluorescent band is cut to

spectra::CsvPlace place_of(const DraftPaint& paint, std::size_t k) {
  return k < paint.value_at.size() ? paint.value_at[k] : paint.place.at;
}

DraftPlace value_place(const DraftPaint& paint, std::size_t k) {
  return {.at = place_of(paint, k), .pointer = fmt::format("{}", paint.nm[k])};
}

double largest(const DraftPaint& paint) {
  return paint.values.empty() ? 0 : *std::max_element(paint.values.begin(), paint.values.end());
}

/// What 100 % is in the file; 0 after a fault.
double full_scale(PaintDraft& draft, const ReadChoices& choices) {
  if (choices.full_scale > 0) return choices.full_scale;
  if (draft.full_scale > 0) return draft.full_scale;
  std::vector<double> tops;
  for (const DraftPaint& paint : draft.paints) {
    if (!paint.values.empty()) tops.push_back(largest(paint));
  }
  if (tops.empty()) return 1;
  std::sort(tops.begin(), tops.end());
  const double top = tops.back(), middle = tops[(tops.size() - 1) / 2];
  if (top <= kFractionUpTo) return 1;
  if (top > kPercentAbove && middle > kFractionUpTo) {
    return 100;
  }
  draft.fault({}, fmt::format("the largest value is {}: fraction or percent?", top),
              "choose scale=fraction or scale=percent");
  return 0;
}

/// Falling wavelengths are turned; false if they neither rise nor fall.
bool put_in_order(PaintDraft& draft, DraftPaint& paint, bool& turned) {
  if (paint.nm.size() >= 2 && paint.nm.front() > paint.nm.back()) {
    std::reverse(paint.nm.begin(), paint.nm.end());
    std::reverse(paint.values.begin(), paint.values.end());
    std::reverse(paint.value_at.begin(), paint.value_at.end());
    turned = true;
  }
  for (std::size_t k = 1; k < paint.nm.size(); ++k) {
    if (paint.nm[k] > paint.nm[k - 1]) continue;
    draft.fault(value_place(paint, k),
                fmt::format("{} nm after {} nm", paint.nm[k], paint.nm[k - 1]),
                "order the wavelengths, each once");
    return false;
  }
  return true;
}

/// Within 0 to below 1, or a fault.
void check_range(PaintDraft& draft, const DraftPaint& source, FilePaint& paint, double scale,
                 const ReadChoices& choices) {
  for (std::size_t k = 0; k < paint.reflectance.values.size(); ++k) {
    double& value = paint.reflectance.values[k];
    if (value >= 0 && value < 1) continue;
    if (value < 0 && value >= -kDarkNoise) {
      value = 0;
    } else if (value >= 1 && value <= 3 && choices.clip_fluorescence) {
      value = kClipped;
      paint.fluorescent = true;
    } else {
      const std::string limit =
          scale == 1 ? "1" : fmt::format("{}, this file being in percent", scale);
      draft.fault(value_place(source, k), fmt::format("{} is out of range", source.values[k]),
                  value < 0 ? "give a reflectance from 0 to below 1"
                            : fmt::format("give a reflectance from 0 to below {}; of a fluorescent "
                                          "sample fluorescence=clip takes what is below",
                                          limit));
    }
  }
}

void check_names(PaintDraft& draft) {
  const bool codes =
      !draft.paints.empty() && std::all_of(draft.paints.begin(), draft.paints.end(),
                                           [](const DraftPaint& p) { return !p.code.empty(); });
  std::map<std::string, int> first_line;
  for (DraftPaint& paint : draft.paints) {
    if (codes) std::swap(paint.name, paint.code);  // the code is the key, the name a label
    if (!codes && paint.name.empty()) std::swap(paint.name, paint.code);
    if (paint.name.empty()) {
      draft.fault(paint.place, "no name", "name every paint");
      continue;
    }
    const auto [earlier, is_new] = first_line.try_emplace(paint.name, paint.place.at.line);
    if (is_new) continue;
    draft.fault(paint.place,
                fmt::format("\"{}\" again, first in line {}", paint.name, earlier->second),
                codes ? "give each paint a code of its own"
                      : "give each paint a name of its own, or add a column \"code\"");
  }
}

std::string label_of(const DraftPaint& paint) {
  std::string label = paint.code;
  for (const std::string& cell : paint.kept) {
    if (cell.empty()) continue;
    label += (label.empty() ? "" : ", ") + cell;
  }
  return label;
}

/// Where a colour and an LRV stand side by side they often contradict each other.
class LrvCheck {
 public:
  /// The colour, scaled to the LRV if that is trusted.
  spectra::StatedColour checked(const DraftPaint& paint, bool trust) {
    spectra::StatedColour colour = *paint.colour;
    if (!paint.lrv) return colour;
    const double apart = *paint.lrv - colour.xyz.y;
    ++count_;
    if (std::abs(apart) > 1) {
      ++contradicting_;
      sum_ += apart;
    }
    if (trust && colour.xyz.y > 0) {
      const double m = *paint.lrv / colour.xyz.y;
      colour.xyz = {m * colour.xyz.x, m * colour.xyz.y, m * colour.xyz.z};
    }
    return colour;
  }

  void tell(PaintDraft& draft, bool trust) const {
    if (contradicting_ == 0) return;
    draft.note(
        fmt::format("the LRV is off from Y of the colour by more than 1 in {} of {} paints, "
                    "on average by {:+.1f}; {}",
                    contradicting_, count_, sum_ / contradicting_,
                    trust ? "the colours were scaled to it (lrv=trust)"
                          : "the colours were kept (lrv=trust scales them)"));
  }

 private:
  int count_ = 0, contradicting_ = 0;
  double sum_ = 0;
};

spectra::Samples as_samples(const spectra::Spectrum& spectrum) {
  spectra::Samples samples;
  for (int k = 0; k < spectrum.grid.count; ++k) {
    samples.nm.push_back(spectrum.grid.wavelength_nm(k));
    samples.values.push_back(spectrum.values[k]);
  }
  return samples;
}

/// From the draft's paints to those of the file.
class Finisher {
 public:
  Finisher(PaintDraft& draft, const ReadChoices& choices) : draft_(draft), choices_(choices) {}

  void run() {
    scale_ = full_scale(draft_, choices_);
    draft_.file.percent = scale_ == 100;
    for (DraftPaint& paint : draft_.paints) {
      FilePaint made{.name = paint.name, .label = label_of(paint), .reflectance = {}};
      made.lrv = paint.lrv;
      made.kept = paint.kept;
      const bool taken =
          paint.values.empty() ? from_colour(paint, made) : from_spectrum(paint, made);
      if (taken) draft_.file.paints.push_back(std::move(made));
    }
    tell();
  }

 private:
  bool from_spectrum(DraftPaint& source, FilePaint& made) {
    if (!put_in_order(draft_, source, turned_) || scale_ == 0) return false;
    made.reflectance = {.nm = source.nm, .values = source.values};
    if (scale_ != 1) {
      for (double& value : made.reflectance.values) value /= scale_;
    }
    check_range(draft_, source, made, scale_, choices_);
    steps_.regularise(made.reflectance, choices_.hold_ends);
    fluorescent_ += made.fluorescent ? 1 : 0;
    return true;
  }

  bool from_colour(const DraftPaint& source, FilePaint& made) {
    if (!source.colour) {
      if (draft_.faults.empty()) {
        draft_.fault(source.place, "neither a spectrum nor a colour", "give one, or leave it out");
      }
      return false;
    }
    const auto colour = lrv_.checked(source, choices_.trust_lrv);
    const spectra::Reconstruction r = spectra::reconstruct_stated(colour);
    made.reconstructed = true;
    if (r.converged) {
      made.reflectance = as_samples(r.reflectance);
      ++reconstructed_;
      return true;
    }
    if (choices_.skip_impossible) {
      ++skipped_;
      return false;
    }
    draft_.fault(source.place,
                 fmt::format("no reflectance below 1 has the colour of \"{}\" (Y {:.2f})",
                             source.name, colour.xyz.y),
                 "mend it, or leave such colours out with impossible=skip");
    return false;
  }

  void tell() {
    if (turned_) draft_.note("the wavelengths fall; turned round");
    steps_.tell(draft_.file.notes);
    lrv_.tell(draft_, choices_.trust_lrv);
    if (reconstructed_ > 0) {
      draft_.note(fmt::format("{} reflectances were reconstructed from colours, not measured",
                              reconstructed_));
    }
    if (skipped_ > 0) {
      draft_.note(fmt::format("{} colours that no reflectance has were left out", skipped_));
    }
    if (fluorescent_ > 0) {
      draft_.note(fmt::format("{} fluorescent paints were cut to below 1: how they glow is lost",
                              fluorescent_));
    }
  }

  PaintDraft& draft_;
  const ReadChoices& choices_;
  double scale_ = 1;
  bool turned_ = false;
  int reconstructed_ = 0, skipped_ = 0, fluorescent_ = 0;
  LrvCheck lrv_;
  SpectralSteps steps_;
};

}  // namespace

void PaintDraft::fault(const DraftPlace& place, std::string problem, std::string remedy) {
  if (faults.size() >= kMaxFaults) return;
  faults.push_back({file.path, place.at.line, place.at.column, place.pointer, std::move(problem),
                    std::move(remedy)});
}

PaintFile finish(PaintDraft draft, const ReadChoices& choices) {
  if (draft.paints.empty() && draft.faults.empty()) {
    draft.fault({}, "no curves and no colours", "give one paint per row");
  }
  check_names(draft);
  Finisher(draft, choices).run();
  if (draft.file.paints.empty() && draft.faults.empty()) {
    draft.fault({}, "no paint is left", "give a paint whose colour a reflectance can have");
  }
  if (!draft.faults.empty()) {
    std::stable_sort(draft.faults.begin(), draft.faults.end(), [](const auto& a, const auto& b) {
      return std::pair(a.line, a.column) < std::pair(b.line, b.column);
    });
    throw spectra::InputError(std::move(draft.faults));
  }
  return std::move(draft.file);
}

std::optional<double> parse_decimal(std::string_view cell, bool comma) {
  if (!comma || cell.find(',') == cell.npos) return spectra::parse_number(cell);
  std::string text(cell);
  if (text.find('.') != text.npos || std::count(text.begin(), text.end(), ',') > 1) return {};
  std::replace(text.begin(), text.end(), ',', '.');
  return spectra::parse_number(text);
}

std::optional<double> parse_wavelength(std::string_view cell) {
  if (cell.size() > 40) return {};
  std::string word;
  for (const char c : lower(cell)) {
    if (c != ' ' && c != '\t' && c != '_' && c != '(' && c != ')' && c != '[' && c != ']')
      word += c;
  }
  for (const std::string_view prefix : {"spectral", "spec", "refl", "r", "nm", "wl"}) {
    if (word.starts_with(prefix)) word.erase(0, prefix.size());
  }
  double unit_nm = 1;
  for (const std::string_view suffix : {"nm", "micrometer", "um", "\xC2\xB5m", "\xCE\xBCm"}) {
    if (!word.ends_with(suffix)) continue;
    word.erase(word.size() - suffix.size());
    unit_nm = suffix == "nm" ? 1 : 1000;
    break;
  }
  if (word.empty() || word.find_first_not_of("0123456789.,") != word.npos) return {};
  const auto value = parse_decimal(word, true);
  if (!value || *value * unit_nm < 200 || *value * unit_nm > 2500) return {};
  return *value * unit_nm;
}

}  // namespace paints
