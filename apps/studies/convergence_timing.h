#pragma once
#include <algorithm>
#include <chrono>
#include <vector>

namespace apps {

/// What a job gave, and the median of its seconds.
template <typename Value>
struct Timed {
  Value value;
  double seconds = 0;
  int repeats = 0;
};

inline constexpr int kTimingRepeats = 3;
inline constexpr double kLongEnough_s = 1;  ///< a job that took so long is not repeated

template <typename Job>
auto timed(const Job& job, int repeats = kTimingRepeats) -> Timed<decltype(job())> {
  std::vector<double> seconds;
  Timed<decltype(job())> result{};
  while (result.repeats < repeats) {
    const auto start = std::chrono::steady_clock::now();
    result.value = job();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    seconds.push_back(took.count());
    ++result.repeats;
    if (took.count() >= kLongEnough_s) break;
  }
  std::ranges::sort(seconds);
  result.seconds = seconds[seconds.size() / 2];
  return result;
}

}  // namespace apps
