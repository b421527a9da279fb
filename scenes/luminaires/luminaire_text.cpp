#include "scenes/luminaires/luminaire_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <tuple>
#include <utility>

#include "appearance/spectra/text/input_bytes.h"
#include "appearance/spectra/text/utf8.h"

namespace scenes {
namespace {

constexpr std::size_t kMostBytes = std::size_t{128} << 20, kMostFaults = 100;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\f' || c == '\v'; }

}  // namespace

LuminaireText::LuminaireText(std::string path, std::string bytes)
    : path_(std::move(path)), bytes_(std::move(bytes)) {
  std::string_view rest = bytes_;
  rest = rest.substr(0, rest.find('\x1A'));
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
    lines_.push_back(rest.substr(0, end));
    rest.remove_prefix(end);
    rest.remove_prefix(rest.starts_with("\r\n") ? 2 : rest.empty() ? 0 : 1);
  }
  if (!lines_.empty() && lines_[0].starts_with("\xEF\xBB\xBF")) lines_[0].remove_prefix(3);
}

Token LuminaireText::line(std::size_t index) const {
  const int number = static_cast<int>(index) + 1;
  if (index >= lines_.size()) return {.text = {}, .line = number, .column = 1};
  std::string_view text = lines_[index];
  std::size_t first = 0;
  while (first < text.size() && is_blank(text[first])) ++first;
  std::size_t end = text.size();
  while (end > first && is_blank(text[end - 1])) --end;
  return {.text = text.substr(first, end - first),
          .line = number,
          .column = static_cast<int>(first) + 1};
}

Token TokenStream::take(std::size_t length) {
  last_ = {.text = text_->lines()[line_].substr(at_, length),
           .line = static_cast<int>(line_) + 1,
           .column = static_cast<int>(at_) + 1};
  return last_;
}

std::optional<Token> TokenStream::next() {
  for (; line_ < text_->lines().size(); ++line_, at_ = 0) {
    const std::string_view text = text_->lines()[line_];
    while (at_ < text.size()) {
      if (is_blank(text[at_])) {
        ++at_;
      } else if (text[at_] == ',') {
        const Token nothing = take(0);
        ++at_;
        met_comma_ = true;
        if (std::exchange(after_comma_, true)) return nothing;
      } else {
        std::size_t length = 1;
        while (at_ + length < text.size() && !is_blank(text[at_ + length]) &&
               text[at_ + length] != ',') {
          ++length;
        }
        const Token token = take(length);
        at_ += length;
        after_comma_ = false;
        return token;
      }
    }
  }
  return std::nullopt;
}

LuminaireText read_luminaire_text(const std::string& path) {
  std::string bytes = spectra::read_input(path, kMostBytes, "this is no lamp");
  if (bytes.find_first_not_of(" \t\r\n\x1A") == bytes.npos) {
    throw spectra::InputError({{path, 0, 0, "", "the file is empty", "give an IES or LDT file"}});
  }
  return {path, std::move(bytes)};
}

void LuminaireFaults::add(const Token& place, std::string problem, std::string remedy) {
  if (faults_.size() >= kMostFaults) {
    ++more_;
    return;
  }
  faults_.push_back({path_, place.line, place.column, "", std::move(problem), std::move(remedy)});
}

void LuminaireFaults::add(const std::vector<spectra::Fault>& faults) {
  faults_.insert(faults_.end(), faults.begin(), faults.end());
}

void LuminaireFaults::throw_faults() {
  if (faults_.empty()) return;
  std::ranges::stable_sort(faults_, {}, [&](const spectra::Fault& f) {
    return std::tuple(f.file != path_, f.line, f.column);
  });
  if (more_ > 0) {
    faults_.push_back({path_, 0, 0, "", fmt::format("and {} more", counted(more_, "fault")), ""});
  }
  throw spectra::InputError(std::move(faults_));
}

std::optional<double> number_in(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) {
    return std::nullopt;
  }
  return value;
}

std::string readable(std::string_view bytes) {
  std::string text;
  const bool latin1 = spectra::first_invalid_utf8(bytes) != bytes.npos;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7F || (latin1 && byte >= 0x80 && byte < 0xA0)) {
      text += ' ';
    } else if (latin1 && byte >= 0x80) {
      text += static_cast<char>(0xC0 | (byte >> 6));
      text += static_cast<char>(0x80 | (byte & 0x3F));
    } else {
      text += c;
    }
  }
  return text;
}

std::string quoted(std::string_view bytes) {
  constexpr std::size_t kMost = 24;
  if (bytes.size() <= kMost) return fmt::format("\"{}\"", readable(bytes));
  std::size_t end = kMost;  // not within a character of UTF-8
  while (end > 0 && (static_cast<unsigned char>(bytes[end]) & 0xC0) == 0x80) --end;
  return fmt::format("\"{}...\"", readable(bytes.substr(0, end)));
}

std::string counted(std::size_t count, std::string_view noun) {
  return fmt::format("{} {}{}", count, noun, count == 1 ? "" : "s");
}

}  // namespace scenes
