#include "scenes/luminaires/number_stream.h"

#include <fmt/format.h>

#include <limits>

namespace scenes {

std::string NumberStream::remedy() const {
  return tokens_.met_comma() ? "a comma separates here, decimals take a point"
                             : "make the counts and the numbers agree";
}

PlacedNumber NumberStream::read(const Token& token) {
  if (const auto value = number_in(token.text)) return {.value = *value, .place = token};
  if (token.text.empty()) {
    faults_->add(token, "nothing between two commas", remedy());
  } else {
    faults_->add(token, fmt::format("{} is no number", quoted(token.text)),
                 "give a number such as 12 or 0.5");
  }
  return {.value = std::numeric_limits<double>::quiet_NaN(), .place = token};
}

void NumberStream::each(std::size_t count, std::string_view what,
                        const std::function<void(std::size_t, const PlacedNumber&)>& use) {
  for (std::size_t k = 0; k < count && !ended_; ++k) {
    const std::optional<Token> token = tokens_.next();
    if (token) {
      use(k, read(*token));
      continue;
    }
    ended_ = true;
    faults_->add(tokens_.last(), fmt::format("ends after {} of {} {}", k, count, what), remedy());
  }
}

std::vector<PlacedNumber> NumberStream::take(std::size_t count, std::string_view what) {
  std::vector<PlacedNumber> numbers;
  each(count, what, [&](std::size_t, const PlacedNumber& n) { numbers.push_back(n); });
  return numbers;
}

void NumberStream::expect_end() {
  if (ended_) return;
  const std::optional<Token> first = tokens_.next();
  if (!first) return;
  std::size_t more = 1;
  while (tokens_.next()) ++more;
  if (number_in(first->text)) {
    faults_->add(*first, fmt::format("{} than announced", counted(more, "more number")), remedy());
  } else {
    faults_->add(*first, fmt::format("{} after the last number", quoted(first->text)),
                 "end the file here");
  }
}

std::optional<std::size_t> NumberStream::count(const PlacedNumber& number, std::size_t least,
                                               std::string_view what) {
  const double v = number.value;
  if (std::isnan(v)) return std::nullopt;
  if (v >= static_cast<double>(least) && v <= kMostIntensities && v == std::floor(v)) {
    return static_cast<std::size_t>(v);
  }
  faults_->add(number.place, fmt::format("{} {}", what, v),
               fmt::format("give a whole number from {}", least));
  return std::nullopt;
}

}  // namespace scenes
