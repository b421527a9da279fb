#include "paints/search_space.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace paints {
namespace {

constexpr double kFirstShare = 0.05;  // of a base that is added
constexpr double kNoShare = 1e-7;     // a base with less is left out

}  // namespace

SearchSpace::SearchSpace(const BaseSet& set, const ViewedTable& table, const Eigen::Vector3d& wish,
                         int threads)
    : table_(table), wish_(wish), threads_(threads) {
  for (const Base& base : set.bases) {
    strength_.push_back(std::exp((base.absorption * base.scattering).log().mean() / 2));
  }
}

Parts SearchSpace::strengths(const BaseNumbers& bases) const {
  Parts all = Parts::Ones();
  for (int i = 0; i < bases.count; ++i) {
    all[i] = strength_[static_cast<std::size_t>(bases.at[static_cast<std::size_t>(i)])];
  }
  return all;
}

Eigen::Vector3d SearchSpace::look(const BaseNumbers& bases, const Parts& shares) const {
  return table_.jab(bases, shares.cwiseQuotient(strengths(bases)));
}

Candidate SearchSpace::fitted(const BaseNumbers& bases, const Parts& shares) const {
  const Parts strength = strengths(bases);
  const auto look = [&](const Parts& parts) { return table_.slope(bases, parts); };
  return in_order(bases, fit_parts(look, wish_, shares.cwiseQuotient(strength), strength));
}

std::vector<Candidate> SearchSpace::extended(const Candidate& from) const {
  const auto last = static_cast<std::size_t>(from.bases.count);
  BaseNumbers bases = from.bases;
  ++bases.count;
  std::vector<Candidate> found;
  for (int base = 0; base < size(); ++base) {
    if (std::count(from.bases.at.begin(), from.bases.at.begin() + from.bases.count, base)) continue;
    bases.at[last] = base;
    const JabOfParts seen = table_.slope(bases, from.parts);
    if (seen.by_parts.col(bases.count - 1).dot(seen.jab - wish_) >= 0) continue;
    Parts shares = from.parts.cwiseProduct(strengths(bases));
    shares /= shares.sum();
    shares[bases.count - 1] = kFirstShare;
    found.push_back(fitted(bases, shares));
  }
  return found;
}

Candidate in_order(const BaseNumbers& bases, const Fit& fit) {
  std::vector<std::pair<int, double>> kept;
  for (int i = 0; i < bases.count; ++i) {
    if (fit.parts[i] > kNoShare) {
      kept.emplace_back(bases.at[static_cast<std::size_t>(i)], fit.parts[i]);
    }
  }
  std::sort(kept.begin(), kept.end());
  Candidate candidate{.bases = {}, .parts = Parts::Zero(), .distance = fit.distance};
  for (const auto& [base, part] : kept) {
    candidate.bases.at[static_cast<std::size_t>(candidate.bases.count)] = base;
    candidate.parts[candidate.bases.count++] = part;
  }
  candidate.parts /= candidate.parts.sum();
  return candidate;
}

void keep_nearest(std::vector<Candidate>& candidates, std::size_t most) {
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& p, const Candidate& q) {
    return std::tie(p.distance, p.bases) < std::tie(q.distance, q.bases);
  });
  std::set<BaseNumbers> seen;
  std::erase_if(candidates, [&](const Candidate& c) {
    return seen.size() >= most || !seen.insert(c.bases).second;
  });
}

}  // namespace paints
