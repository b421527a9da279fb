#include "appearance/spectra/text/input_error.h"

#include <fmt/format.h>

namespace spectra {
namespace {

std::string joined(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) {
    if (!text.empty()) text += '\n';
    text += to_string(fault);
  }
  return text;
}

}  // namespace

std::string to_string(const Fault& fault) {
  std::string text = fault.file;
  if (fault.line > 0) text += fmt::format(":{}:{}", fault.line, fault.column);
  if (!fault.pointer.empty()) text += ": " + fault.pointer;
  text += ": " + fault.problem;
  if (!fault.remedy.empty()) text += "; " + fault.remedy;
  return text;
}

InputError::InputError(std::vector<Fault> faults)
    : std::runtime_error(joined(faults)), faults_(std::move(faults)) {}

}  // namespace spectra
