#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "apps/pictures/line_chart.h"
#include "apps/reports/convergence_report.h"

namespace apps {
namespace {

double total_s(const ConvergenceRun& run) { return run.setup_s + run.solve_s; }

/// What is exactly 0, or what rounding decides, is drawn here.
constexpr double kSmallest = 1e-15;

double visible(const std::optional<double>& error) {
  return error ? std::max(*error, kSmallest) : 0;
}

/// The runs of a factor by their cost, judged by the reference.
template <typename Belongs, typename Label>
ChartLine factor_line(const Convergence& convergence, const std::string& name,
                      const Belongs& belongs, const Label& label) {
  ChartLine line{.name = name, .points = {}};
  for (const ConvergenceRun& run : convergence.runs) {
    if (!belongs(run)) continue;
    line.points.push_back({.x = total_s(run),
                           .y = visible(run.errors.max_relative),
                           .label = label(run),
                           .hollow = !run.converged});
  }
  return line;
}

ChartLine patch_line(const Convergence& convergence) {
  ChartLine line = factor_line(
      convergence, "patch size",
      [](const ConvergenceRun& run) { return run.factor == "patch_m" || run.factor == "baseline"; },
      [](const ConvergenceRun& run) { return fmt::format("{:.2g} m", run.patch_m); });
  std::ranges::stable_sort(line.points, {}, &ChartPoint::x);
  line.labels_below = true;
  return line;
}

/// Only the ends are named: the runs cost much the same.
ChartLine ray_line(const Convergence& convergence) {
  ChartLine line = factor_line(
      convergence, "rays per pair", [](const ConvergenceRun& run) { return run.factor == "rays"; },
      [](const ConvergenceRun& run) { return run.setting + " rays"; });
  for (std::size_t k = 1; k + 1 < line.points.size(); ++k) line.points[k].label.clear();
  return line;
}

/// Without the most bands, which are their own judge.
ChartLine band_line(const Convergence& convergence) {
  int most = 0;
  for (const ConvergenceRun& run : convergence.runs) {
    if (run.factor == "bands") most = std::max(most, run.bands);
  }
  return factor_line(
      convergence, "bands (error of X, Y, Z)",
      [most](const ConvergenceRun& run) { return run.factor == "bands" && run.bands < most; },
      [](const ConvergenceRun& run) { return run.setting + " bands"; });
}

std::vector<std::string> method_names_in(const Convergence& convergence,
                                         const std::string& factor) {
  std::vector<std::string> names;
  for (const ConvergenceRun& run : convergence.runs) {
    if (run.factor != factor || std::ranges::find(names, run.method) != names.end()) continue;
    names.push_back(run.method);
  }
  return names;
}

/// One line per method, from the runs of a factor.
template <typename Point>
std::vector<ChartLine> method_lines(const Convergence& convergence, const std::string& factor,
                                    const Point& point) {
  std::vector<ChartLine> lines;
  for (const std::string& name : method_names_in(convergence, factor)) {
    ChartLine line{.name = name, .points = {}};
    for (const ConvergenceRun& run : convergence.runs) {
      if (run.factor == factor && run.method == name) line.points.push_back(point(run));
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

/// A text in lines of the page's width.
std::vector<std::string> wrapped(const std::string& text) {
  constexpr std::size_t kWidth = 150;
  std::vector<std::string> lines;
  std::size_t begin = 0;
  while (text.size() - begin > kWidth) {
    const std::size_t end = text.rfind(' ', begin + kWidth);
    if (end == std::string::npos || end <= begin) break;
    lines.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  lines.push_back(text.substr(begin));
  return lines;
}

}  // namespace

std::string work_precision_picture(const Convergence& convergence) {
  Chart whole{.title = "The whole error, one factor at a time",
              .x_label = "set-up and solve, s",
              .y_label = "largest relative error of irradiance",
              .lines = {patch_line(convergence), ray_line(convergence), band_line(convergence)}};
  std::erase_if(whole.lines, [](const ChartLine& line) { return line.points.empty(); });
  Chart methods{.title = "What the solver alone leaves, by method and tolerance",
                .x_label = "solve, s",
                .y_label = "largest relative error of irradiance, same mesh",
                .lines = method_lines(convergence, "method", [](const ConvergenceRun& run) {
                  return ChartPoint{.x = run.solve_s,
                                    .y = visible(run.own.max_relative),
                                    .label = "",
                                    .hollow = !run.converged};
                })};
  std::vector<std::string> notes =
      wrapped("Baseline: " + settings_of(convergence.runs.front()) + ".");
  for (const std::string& line : wrapped("Reference: " + convergence.reference + ".")) {
    notes.push_back(line);
  }
  notes.push_back("Hollow: stopped before the tolerance was proven. " + timing_rule());
  return chart_page("Error against run time: " + convergence.room, {whole, methods}, notes);
}

std::string iterations_picture(const Convergence& convergence) {
  const auto line_of = [&](const auto& value) {
    return method_lines(convergence, "reflectance", [&](const ConvergenceRun& run) {
      return ChartPoint{
          .x = run.one_minus_rho, .y = value(run), .label = "", .hollow = !run.converged};
    });
  };
  const Chart iterations{
      .title = "Iterations to a proven error of 1e-6",
      .x_label = "1 - rho of all surfaces",
      .y_label = "iterations (sweeps over the matrix)",
      .lines = line_of([](const ConvergenceRun& run) -> double { return run.iterations; })};
  const Chart errors{
      .title = "Error that is left",
      .x_label = "1 - rho of all surfaces",
      .y_label = "relative error of mean irradiance",
      .lines = line_of([](const ConvergenceRun& run) { return visible(run.errors.max_relative); })};
  return chart_page(
      "Bright rooms: " + convergence.room, {iterations, errors},
      {"Reference: the closed form of mean irradiance, flux / (A (1 - rho)). One "
       "band, a coarse mesh.",
       fmt::format("Hollow: stopped before the tolerance was proven. Errors below "
                   "{:g} are drawn there. Points that are missing would take too long; "
                   "summary.txt names them.",
                   kSmallest)});
}

}  // namespace apps
