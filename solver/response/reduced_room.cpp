#include "solver/response/reduced_room.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "solver/bounce/radiosity_methods.h"
#include "solver/response/class_projection.h"
#include "solver/response/painted_solver.h"

namespace solver {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Share of a vector that must be new to the basis, in units of the solver's error: less would be
/// made of that error.
constexpr double kNewDirection = 1e4;
constexpr int kHeldOut = 2;        ///< solves of all bands; with several lights each band has
constexpr int kHeldOutOfMany = 6;  ///< another light in each
constexpr double kTighter = 0.1;   ///< where held-out solves disagree

/// A class of bands under one of its lights, with paints that are worth a solve.
struct Snapshot {
  ReducedClass* of = nullptr;
  Index source = 0;
  PaintedColumn column;
};

class Reduction {
 public:
  Reduction(const ExchangeAreas& exchange, const std::vector<SourceLight>& lights,
            const PaintedPatches& painted, const std::vector<OutputRow>& outputs,
            const ReductionOptions& options)
      : exchange_(exchange),
        lights_(lights),
        painted_(painted),
        options_(options),
        solver_(exchange, painted, outputs, options.solver_error),
        residual_(options.relative_error) {
    for (BandClass& c : band_classes(exchange.area_m2, lights, painted)) {
      lit_bands_ += static_cast<int>(c.bands.size());
      classes_.push_back({.light = std::move(c)});
    }
    list_candidates();
  }

  ReducedRoom run() {
    start();
    while (true) {
      const bool room_left = grow();
      ReducedRoom reduced = result();
      measure(reduced);
      if (reduced.converged || !room_left || residual_ < 1e-15) return reduced;
      residual_ *= kTighter;
    }
  }

 private:
  void list_candidates();
  void solve(std::vector<PaintedColumn>& columns);
  void start();
  bool grow();

  [[nodiscard]] Index vectors() const {
    Index sum = 0;
    for (const ReducedClass& c : classes_) sum += c.basis.cols();
    return sum;
  }

  [[nodiscard]] PaintedColumn column_of(const ReducedClass& c, Index source, VectorXd paint) const;
  void add_worst(ReducedClass& c, int most, std::vector<Snapshot>& worst) const;
  void add_parts(ReducedClass& c, const VectorXd& received, std::vector<VectorXd> moved,
                 std::vector<VectorXd> phi) const;
  void absorb(std::vector<Snapshot>& snapshots);
  [[nodiscard]] ReducedRoom result() const;
  void measure(ReducedRoom& reduced);

  const ExchangeAreas& exchange_;
  const std::vector<SourceLight>& lights_;
  const PaintedPatches& painted_;
  const ReductionOptions& options_;
  PaintedSolver solver_;
  double residual_;  ///< relative, at which a class has enough vectors
  std::vector<ReducedClass> classes_;
  std::vector<VectorXd> candidates_;  ///< reflectances of the groups
  double solves_ = 0;
  int measured_ = 0;  ///< held-out solves so far
  int lit_bands_ = 0;
};

/// Reflectances whose distance to 1 is spaced geometrically, every combination over the groups.
void Reduction::list_candidates() {
  const int levels = painted_.groups == 1 ? 33 : painted_.groups == 2 ? 9 : 5;
  const auto level = [&](int i) {
    return 1 - std::pow(1 - options_.highest_reflectance, static_cast<double>(i) / (levels - 1));
  };
  int count = 1;
  for (int j = 0; j < painted_.groups; ++j) count *= levels;
  for (int code = 0; code < count; ++code) {
    VectorXd paint(painted_.groups);
    for (int j = 0, rest = code; j < painted_.groups; ++j, rest /= levels) {
      paint[j] = level(rest % levels);
    }
    candidates_.push_back(paint);
  }
}

void Reduction::solve(std::vector<PaintedColumn>& columns) {
  if (columns.empty()) return;
  solver_.solve(columns);
  solves_ += static_cast<double>(columns.size()) / lit_bands_;
}

PaintedColumn Reduction::column_of(const ReducedClass& c, Index source, VectorXd paint) const {
  return {.fixed = c.light.fixed,
          .emission = c.light.sources.emission.col(source),
          .direct = c.light.sources.direct.col(source),
          .paint = std::move(paint)};
}

/// All paints black: y0 and g. Then each group's part of g, so that the basis is exact there.
void Reduction::start() {
  std::vector<PaintedColumn> black;
  for (ReducedClass& c : classes_) {
    for (Index s = 0; s < c.sources(); ++s) {
      black.push_back(column_of(c, s, VectorXd::Zero(painted_.groups)));
    }
  }
  solve(black);
  std::vector<PaintedColumn> parts;
  std::size_t k = 0;
  for (ReducedClass& c : classes_) {
    c.black.resize(solver_.painted_patches(), c.sources());
    c.constant.resize(solver_.outputs(), c.sources());
    c.basis.resize(solver_.painted_patches(), 0);
    c.moved = c.basis;
    c.phi.resize(solver_.outputs(), 0);
    for (Index s = 0; s < c.sources(); ++s, ++k) {
      c.black.col(s) = black[k].received;
      c.constant.col(s) = black[k].outputs;
      for (int j = 0; j < painted_.groups; ++j)
        parts.push_back(solver_.emitter(c.light.fixed, c.black.col(s), j));
    }
  }
  solve(parts);
  k = 0;
  for (ReducedClass& c : classes_) {
    for (Index s = 0; s < c.sources(); ++s) {
      std::vector<VectorXd> moved, phi;
      for (int j = 0; j < painted_.groups; ++j, ++k) {
        moved.push_back(parts[k].received);
        phi.push_back(parts[k].outputs);
      }
      add_parts(c, c.black.col(s), std::move(moved), std::move(phi));
    }
  }
}

void Reduction::add_parts(ReducedClass& c, const VectorXd& received, std::vector<VectorXd> moved,
                          std::vector<VectorXd> phi) const {
  for (int j = 0; j < painted_.groups; ++j) {
    const auto at = static_cast<std::size_t>(j);
    add_vector(c,
               {.group = j,
                .v = solver_.part(received, j),
                .moved = std::move(moved[at]),
                .phi = std::move(phi[at])},
               kNewDirection * options_.solver_error);
  }
}

/// Up to `most` reflectances for each source of a class where the residual is too large: the
/// largest first, then others at some distance.
void Reduction::add_worst(ReducedClass& c, int most, std::vector<Snapshot>& worst) const {
  const auto distance = [](const VectorXd& p, const VectorXd& q) {
    return ((1 - p.array()) / (1 - q.array())).log().abs().maxCoeff();
  };
  const MatrixXd k = symmetric_transfer(c);
  for (Index s = 0; s < c.sources(); ++s) {
    std::vector<std::pair<double, const VectorXd*>> open;
    for (const VectorXd& paint : candidates_) {
      const double left = residual(c, s, paint, k);
      if (left > residual_) open.emplace_back(left, &paint);
    }
    std::ranges::stable_sort(open, std::greater{}, [](const auto& entry) { return entry.first; });
    std::vector<const VectorXd*> chosen;
    for (const auto& candidate : open) {
      const VectorXd* paint = candidate.second;
      if (static_cast<int>(chosen.size()) == most) break;
      if (std::ranges::all_of(chosen,
                              [&](const VectorXd* other) { return distance(*paint, *other) > 1; }))
        chosen.push_back(paint);
    }
    for (const VectorXd* paint : chosen) {
      worst.push_back({.of = &c, .source = s, .column = column_of(c, s, *paint)});
    }
  }
}

/// @return false if more solves bring nothing or are used up
bool Reduction::grow() {
  Index sources = 0, most_sources = 0;
  for (const ReducedClass& c : classes_) {
    sources += c.sources();
    most_sources = std::max(most_sources, c.sources());
  }
  if (sources == 0) return true;  // no light, nothing to learn
  const int at_once = static_cast<int>(std::max<Index>(1, PaintedSolver::kColumnsAtOnce / sources));
  const double most = static_cast<double>(options_.most_solves * painted_.groups) *
                      static_cast<double>(most_sources);
  while (solves_ < most) {
    std::vector<Snapshot> snapshots;
    for (ReducedClass& c : classes_) add_worst(c, at_once, snapshots);
    if (snapshots.empty()) return true;
    const Index before = vectors();
    absorb(snapshots);
    if (vectors() == before) return false;  // rounding has the last word
  }
  return false;
}

/// Solves, and makes basis vectors of the answers. Since h - g = sum_j rho_j K E_j h, the part of
/// the group with the largest rho needs no solve of its own.
void Reduction::absorb(std::vector<Snapshot>& snapshots) {
  const auto brightest = [](const PaintedColumn& column) {
    Index group = 0;
    column.paint.maxCoeff(&group);
    return group;
  };
  std::vector<PaintedColumn> solved, parts;
  for (Snapshot& s : snapshots) solved.push_back(std::move(s.column));
  solve(solved);
  for (const PaintedColumn& h : solved) {
    for (int j = 0; j < painted_.groups; ++j) {
      if (j != brightest(h)) parts.push_back(solver_.emitter(h.fixed, h.received, j));
    }
  }
  solve(parts);
  auto part = parts.begin();
  for (std::size_t k = 0; k < snapshots.size(); ++k) {
    ReducedClass& c = *snapshots[k].of;
    const PaintedColumn& h = solved[k];
    std::vector<VectorXd> moved(static_cast<std::size_t>(painted_.groups));
    std::vector<VectorXd> phi = moved;
    VectorXd rest = h.received - c.black.col(snapshots[k].source);
    VectorXd rest_outputs = h.outputs - c.constant.col(snapshots[k].source);
    for (int j = 0; j < painted_.groups; ++j) {
      if (j == brightest(h)) continue;
      rest -= h.paint[j] * part->received;
      rest_outputs -= h.paint[j] * part->outputs;
      moved[static_cast<std::size_t>(j)] = std::move(part->received);
      phi[static_cast<std::size_t>(j)] = std::move(part->outputs);
      ++part;
    }
    const auto free = static_cast<std::size_t>(brightest(h));
    moved[free] = rest / h.paint.maxCoeff();
    phi[free] = rest_outputs / h.paint.maxCoeff();
    add_parts(c, h.received, std::move(moved), std::move(phi));
  }
}

ReducedRoom Reduction::result() const {
  const Index lights = static_cast<Index>(lights_.size());
  ReducedRoom reduced{.groups = painted_.groups,
                      .solves = solves_,
                      .highest_reflectance = options_.highest_reflectance};
  // A band without light: no vectors, no outputs.
  const auto outputs = solver_.outputs();
  reduced.transfers.push_back({.k = MatrixXd(0, 0), .phi = MatrixXd(outputs, 0)});
  reduced.bands.resize(static_cast<std::size_t>(painted_.fixed.cols()),
                       {.gamma = MatrixXd(0, lights), .constant = MatrixXd::Zero(outputs, lights)});
  for (const ReducedClass& c : classes_) {
    const MatrixXd gamma = c.basis.transpose() * c.black * c.light.share;
    const MatrixXd constant = c.constant * c.light.share;
    for (std::size_t b = 0; b < c.light.bands.size(); ++b) {
      const Index first = static_cast<Index>(b) * lights;
      reduced.bands[static_cast<std::size_t>(c.light.bands[b])] = {
          .transfer = static_cast<int>(reduced.transfers.size()),
          .gamma = gamma.middleCols(first, lights),
          .constant = constant.middleCols(first, lights)};
    }
    reduced.transfers.push_back({.k = symmetric_transfer(c), .phi = c.phi, .group = c.group});
  }
  return reduced;
}

/// Full solves at reflectances that differ from band to band and were not chosen by the residual;
/// those that were missed become candidates for the basis.
void Reduction::measure(ReducedRoom& reduced) {
  const auto reflectance = [&](int band, int solve, int group) {
    const double turn = std::numbers::phi * (band + 1) + 0.3 * solve + 0.414 * group + 0.13;
    return 1 - std::pow(1 - options_.highest_reflectance, turn - std::floor(turn));
  };
  const double before = solves_;
  const int lights = static_cast<int>(lights_.size());
  reduced.held_out = lights > 1 ? kHeldOutOfMany : kHeldOut;
  for (int number = 0; number < reduced.held_out; ++number) {
    std::vector<PaintedColumn> columns;
    std::vector<std::pair<int, int>> bands;  // and the light of each
    for (const ReducedClass& c : classes_) {
      for (const int band : c.light.bands) {
        VectorXd paint(painted_.groups);
        for (int j = 0; j < painted_.groups; ++j) {
          paint[j] = reflectance(band, measured_ + number, j);
        }
        const int light = (band + number) % lights;
        const SourceLight& source = lights_[static_cast<std::size_t>(light)];
        columns.push_back({.fixed = c.light.fixed,
                           .emission = source.emission.col(band),
                           .direct = source.direct.col(band),
                           .paint = paint});
        bands.emplace_back(band, light);
      }
    }
    solve(columns);
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const VectorXd y = reduced.outputs(bands[k].first, columns[k].paint).col(bands[k].second);
      bool missed = false;
      for (Index o = 0; o < y.size(); ++o) {
        const double solved = std::abs(columns[k].outputs[o]);
        if (!(solved > 0)) continue;
        const double error = std::abs(y[o] - columns[k].outputs[o]) / solved;
        if (!(error <= reduced.largest_error)) reduced.largest_error = error;  // NaN counts
        missed = missed || error > options_.relative_error;
      }
      if (missed) candidates_.push_back(columns[k].paint);
    }
  }
  solves_ = before;
  measured_ += reduced.held_out;  // the next check is at other reflectances
  reduced.converged =
      reduced.largest_error <= options_.relative_error && exchange_.closure_defect <= kClosed;
}

void check(const ExchangeAreas& exchange, const std::vector<SourceLight>& lights,
           const PaintedPatches& painted, const std::vector<OutputRow>& outputs) {
  const Index n = exchange.rows();
  const auto require = [](bool holds, const char* what) {
    if (!holds) throw std::invalid_argument(fmt::format("the room to reduce: {}", what));
  };
  require(static_cast<Index>(painted.group.size()) == n && painted.fixed.rows() == n,
          "groups and reflectances want one row per function of a patch");
  require(painted.groups >= 1 && painted.groups <= 3, "1 to 3 groups can be painted");
  require(!lights.empty(), "there is no light");
  for (const SourceLight& l : lights) {
    require(l.emission.rows() == n && l.direct.rows() == n &&
                l.emission.cols() == painted.fixed.cols() &&
                l.direct.cols() == painted.fixed.cols(),
            "light and reflectances differ in size");
  }
  for (const OutputRow& o : outputs) {
    require((o.on_radiosity.size() == 0 || o.on_radiosity.size() == n) &&
                (o.on_irradiance.size() == 0 || o.on_irradiance.size() == n),
            "an output wants one weight per function of a patch");
  }
}

}  // namespace

MatrixXd ReducedRoom::outputs(int band, const VectorXd& reflectance) const {
  const Band& b = bands[static_cast<std::size_t>(band)];
  const Transfer& t = transfers[static_cast<std::size_t>(b.transfer)];
  const VectorXd r = by_vector(t.group, reflectance);
  return b.constant + t.phi * (r.asDiagonal() * coefficients(t.k, r, b.gamma));
}

ReducedRoom reduce_room(const ExchangeAreas& exchange, const std::vector<SourceLight>& lights,
                        const PaintedPatches& painted, const std::vector<OutputRow>& outputs,
                        const ReductionOptions& options) {
  check(exchange, lights, painted, outputs);
  return Reduction(exchange, lights, painted, outputs, options).run();
}

}  // namespace solver
