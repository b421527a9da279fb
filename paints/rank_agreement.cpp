#include "paints/rank_agreement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <stdexcept>

namespace paints {
namespace {

void require_comparable(const std::vector<double>& a, const std::vector<double>& b) {
  if (a.size() != b.size()) {
    throw std::invalid_argument(fmt::format("{} scores beside {}", a.size(), b.size()));
  }
  const auto is_nan = [](double score) { return std::isnan(score); };
  if (std::ranges::any_of(a, is_nan) || std::ranges::any_of(b, is_nan)) {
    throw std::invalid_argument("a score is not a number");
  }
}

int sign_of(double x) { return (x > 0) - (x < 0); }

/// The places of the `top` lowest scores, rising.
std::vector<std::size_t> best_places(const std::vector<double>& scores, std::size_t top) {
  std::vector<std::size_t> places(scores.size());
  std::iota(places.begin(), places.end(), std::size_t{0});
  std::ranges::stable_sort(places, {}, [&](std::size_t i) { return scores[i]; });
  places.resize(top);
  std::ranges::sort(places);
  return places;
}

}  // namespace

double kendall_tau(const std::vector<double>& a, const std::vector<double>& b) {
  require_comparable(a, b);
  std::int64_t agreement = 0, untied_a = 0, untied_b = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const int in_a = sign_of(a[i] - a[j]), in_b = sign_of(b[i] - b[j]);
      agreement += in_a * in_b;
      untied_a += in_a * in_a;
      untied_b += in_b * in_b;
    }
  }
  if (untied_a == 0 || untied_b == 0) {
    throw std::invalid_argument(fmt::format("no order among {} scores", a.size()));
  }
  return static_cast<double>(agreement) /
         std::sqrt(static_cast<double>(untied_a) * static_cast<double>(untied_b));
}

int top_overlap(const std::vector<double>& a, const std::vector<double>& b, std::size_t top) {
  require_comparable(a, b);
  if (a.size() < top) {
    throw std::invalid_argument(fmt::format("the best {} of {}", top, a.size()));
  }
  std::vector<std::size_t> common;
  std::ranges::set_intersection(best_places(a, top), best_places(b, top),
                                std::back_inserter(common));
  return static_cast<int>(common.size());
}

}  // namespace paints
