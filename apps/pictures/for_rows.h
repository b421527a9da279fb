#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace apps {

/// Calls job(row) for all rows; each thread takes a few at a time, as it comes to them. What a job
/// throws is thrown here, once all threads have stopped.
template <typename Job>
void for_rows(std::int64_t rows, int threads, const Job& job) {
  constexpr std::int64_t kAtOnce = 16;
  std::atomic<std::int64_t> next = 0;
  const auto work = [&] {
    for (std::int64_t first = next.fetch_add(kAtOnce); first < rows;
         first = next.fetch_add(kAtOnce)) {
      const std::int64_t end = std::min(first + kAtOnce, rows);
      for (std::int64_t row = first; row < end; ++row) job(static_cast<std::size_t>(row));
    }
  };
  std::exception_ptr failure;
  std::once_flag failed;
  const auto guarded = [&] {
    try {
      work();
    } catch (...) {
      std::call_once(failed, [&] { failure = std::current_exception(); });
      next = rows;
    }
  };
  {
    std::vector<std::jthread> others;
    for (int k = 1; k < threads && k * kAtOnce < rows; ++k) others.emplace_back(guarded);
    guarded();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace apps
