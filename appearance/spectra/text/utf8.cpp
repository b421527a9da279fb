#include "appearance/spectra/text/utf8.h"

namespace spectra {
namespace {

constexpr unsigned char kContinuationLow = 0x80, kContinuationHigh = 0xBF;

/// RFC 3629 section 4: what may follow a lead byte; length 0: no lead byte of several.
struct Sequence {
  std::size_t length = 0;
  unsigned char second_low = kContinuationLow, second_high = kContinuationHigh;
};

Sequence sequence_of(unsigned char lead) {
  if (lead < 0xC2 || lead > 0xF4) return {};
  if (lead < 0xE0) return {.length = 2};
  if (lead == 0xE0) return {.length = 3, .second_low = 0xA0};
  if (lead == 0xED) return {.length = 3, .second_high = 0x9F};
  if (lead < 0xF0) return {.length = 3};
  if (lead == 0xF0) return {.length = 4, .second_low = 0x90};
  if (lead == 0xF4) return {.length = 4, .second_high = 0x8F};
  return {.length = 4};
}

}  // namespace

std::size_t first_invalid_utf8(std::string_view text) {
  std::size_t at = 0;
  while (at < text.size()) {
    if (static_cast<unsigned char>(text[at]) < 0x80) {  // the common case, kept quick
      ++at;
      continue;
    }
    const Sequence want = sequence_of(static_cast<unsigned char>(text[at]));
    if (want.length == 0 || at + want.length > text.size()) return at;
    for (std::size_t i = 1; i < want.length; ++i) {
      const auto byte = static_cast<unsigned char>(text[at + i]);
      const unsigned char low = i == 1 ? want.second_low : kContinuationLow;
      const unsigned char high = i == 1 ? want.second_high : kContinuationHigh;
      if (byte < low || byte > high) return at;
    }
    at += want.length;
  }
  return std::string_view::npos;
}

}  // namespace spectra
