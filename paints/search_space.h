#pragma once
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <atomic>
#include <thread>
#include <vector>

#include "paints/mixing.h"
#include "paints/recipe_fit.h"
#include "paints/viewed_table.h"

namespace paints {

/// A recipe of the search; its numbers are as good as the table's.
struct Candidate {
  BaseNumbers bases;
  Parts parts;  ///< sum 1
  double distance = 0;
};

/// What all stages of the search share: the mixtures of a set, as they look in a room, and the
/// wish. Shares are parts times the base's strength sqrt(K S), a mean over the bands: half and half
/// of a black and a white then looks half way between them.
class SearchSpace {
 public:
  SearchSpace(const BaseSet& set, const ViewedTable& table, const Eigen::Vector3d& wish,
              int threads);

  [[nodiscard]] int size() const { return static_cast<int>(strength_.size()); }

  [[nodiscard]] int threads() const { return threads_; }

  [[nodiscard]] const Eigen::Vector3d& wish() const { return wish_; }

  /// J, a_C, b_C.
  [[nodiscard]] Eigen::Vector3d look(const BaseNumbers& bases, const Parts& shares) const;

  [[nodiscard]] double distance(const Eigen::Vector3d& jab) const { return (jab - wish_).norm(); }

  /// Downhill from these shares; bases that end with no part are gone from the answer.
  [[nodiscard]] Candidate fitted(const BaseNumbers& bases, const Parts& shares) const;

  /// The candidate with every further base that brings it nearer to first order, fitted.
  [[nodiscard]] std::vector<Candidate> extended(const Candidate& from) const;

  [[nodiscard]] Parts strengths(const BaseNumbers& bases) const;

 private:
  const ViewedTable& table_;
  Eigen::Vector3d wish_;
  int threads_;
  std::vector<double> strength_;  // per base
};

/// Of a fit, without the bases that ended with no part, the others in rising order.
[[nodiscard]] Candidate in_order(const BaseNumbers& bases, const Fit& fit);

/// Keeps the nearest of each set of bases, at most `most`, nearest first.
void keep_nearest(std::vector<Candidate>& candidates, std::size_t most);

/// job(0), ..., job(count - 1), each once, on `threads` threads.
template <typename Job>
void in_parallel(int count, int threads, const Job& job) {
  std::atomic<int> next{0};
  const auto work = [&] {
    for (int i = next++; i < count; i = next++) job(i);
  };
  std::vector<std::jthread> helpers;
  for (int i = 1; i < std::min(threads, count); ++i) helpers.emplace_back(work);
  work();
}

}  // namespace paints
