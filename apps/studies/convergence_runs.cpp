#include "apps/studies/convergence_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "apps/studies/band_groups.h"
#include "apps/studies/convergence_timing.h"
#include "apps/studies/solver_methods.h"
#include "apps/system/terminal.h"
#include "scenes/files/room_json.h"

namespace apps {
namespace {

using Eigen::MatrixXd;
using solver::Method, solver::RadiosityOptions, solver::RoomSolution, solver::RoomTransport;

constexpr double kTight = 1e-12;  ///< relative error of what others are judged by
constexpr std::array kTolerances{1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8};
constexpr std::array kPatchFactors{2.0, 1.4, 0.7, 0.5};
constexpr std::array kRays{16, 32, 64, 128, 256};
constexpr int kMostRays = 512, kLampRays = 4;  ///< judge of the rays; times as many to lamps
constexpr std::array kReferenceFactors{0.25, 0.35, 0.5, 0.7};
constexpr double kMostReferencePatches = 6e4;
constexpr int kMostSweeps = 500, kCoarsePatches = 300;
constexpr spectra::Grid kWideGrid{.first_nm = 380, .step_nm = 5, .count = 81};
constexpr const char* kPerBand = "irradiance per band";
constexpr const char* kXyz = "X, Y, Z of the irradiance";

RadiosityOptions tight() {
  return {.method = Method::conjugate_gradients, .relative_error = kTight};
}

class Experiment {
 public:
  Experiment(RoomRun& run, const ConvergenceOptions& options)
      : run_(run), options_(options), log_(options.seconds), wish_(ranking_wish(run)) {
    baseline_m_ = options.patch_m > 0 ? options.patch_m : run.room.patch_m;
    for (std::size_t g = 0; g < std::max<std::size_t>(1, run.room.paint.size()); ++g) {
      views_.push_back(viewed_point(run, g));
    }
    log_.result().room = run.room.name;
  }

  Convergence measure();

 private:
  /// A run with what all have in common; `solve` takes options.
  ConvergenceRun baseline_run(const std::string& factor, const std::string& setting) const;
  [[nodiscard]] solver::TransportOptions transport_options() const;
  [[nodiscard]] RoomAnswer answer(const scenes::Room& room, const RoomTransport& transport,
                                  const RoomSolution& solution) const;
  void rank(RoomAnswer& answer, const scenes::Room& room, const RoomTransport& transport) const;

  void make_baseline();
  void make_reference();
  [[nodiscard]] bool affordable_reference(double factor) const;
  void add_tolerances(const SolverMethod& method);
  void add_ambient_term();
  void add_transport(ConvergenceRun run, const solver::TransportOptions& options,
                     const RoomAnswer* own_judge);
  void add_patch_sizes();
  void add_other_light();
  void add_rays();
  void add_bands();
  void add_band_groups(int groups, const RoomAnswer& judge, const std::string& judged_by);
  std::optional<RoomAnswer> add_wide_bands();
  void sweep();

  RoomRun& run_;
  const ConvergenceOptions& options_;
  ConvergenceLog log_;
  RankingWish wish_;
  std::vector<solver::ViewedPoint> views_;
  double baseline_m_ = 0, setup_s_ = 0, reference_m_ = 0;
  RoomAnswer exact_;      ///< of the baseline, but for the solver's tolerance
  RoomAnswer reference_;  ///< on a finer mesh
};

ConvergenceRun Experiment::baseline_run(const std::string& factor,
                                        const std::string& setting) const {
  const RadiosityOptions usual;
  return {.factor = factor,
          .method = solver::to_string(Method::conjugate_gradients),
          .setting = setting,
          .patch_m = baseline_m_,
          .patches = run_.transport.mesh.size(),
          .bands = run_.room.grid.count,
          .rays = transport_options().rays,
          .relative_error = usual.relative_error,
          .setup_s = setup_s_,
          .quantity = kPerBand,
          .reference = fmt::format("patch_m {:.3g}", reference_m_)};
}

solver::TransportOptions Experiment::transport_options() const {
  return {.patch_m = baseline_m_, .light = options_.light, .views = views_};
}

RoomAnswer Experiment::answer(const scenes::Room& room, const RoomTransport& transport,
                              const RoomSolution& solution) const {
  return seeing(run_, [&] { return answer_of(room, transport, solution); });
}

void Experiment::rank(RoomAnswer& answer, const scenes::Room& room,
                      const RoomTransport& transport) const {
  if (!wish_.task) return;
  answer.paint_distance =
      seeing(run_, [&] { return paint_distances(room, transport, *wish_.task); });
}

void Experiment::make_baseline() {
  Timed<RoomTransport> built =
      timed([&] { return solver::prepare_transport(run_.room, transport_options()); });
  run_.transport = std::move(built.value);
  setup_s_ = built.seconds;
  run_.clock.stop("baseline");
  run_.record["transport"] = describe(run_.transport);
  exact_ =
      answer(run_.room, run_.transport, solver::solve_room(run_.room, run_.transport, tight()));
  rank(exact_, run_.room, run_.transport);
}

/// Whether a finer mesh is planned to fit into the memory and half of the time.
bool Experiment::affordable_reference(double factor) const {
  const double patches = run_.transport.mesh.size() / (factor * factor);
  if (patches > kMostReferencePatches) return false;
  const solver::Plan plan =
      solver::make_plan(run_.room, {.patch_m = factor * baseline_m_, .light = options_.light});
  const double rounds = wish_.task ? 2 : 1;  // a ranking costs about as much again
  return plan.fine.patch_m == 0 && plan.memory_bytes < solver::available_memory_bytes() / 2 &&
         rounds * plan.expected_seconds < options_.seconds / 2;
}

/// Two refinements finer than the baseline, or as fine as can be afforded.
void Experiment::make_reference() {
  const auto factor =
      std::ranges::find_if(kReferenceFactors, [&](double f) { return affordable_reference(f); });
  if (factor == kReferenceFactors.end()) {
    reference_m_ = baseline_m_;
    reference_ = exact_;
    log_.result().reference = fmt::format(
        "the baseline's own mesh (patch_m {:.3g}), solved to {:g}: no finer one fits into half of "
        "the {:g} s, so the error of the mesh is not measured; give more with --seconds",
        baseline_m_, kTight, options_.seconds);
    return;
  }
  reference_m_ = *factor * baseline_m_;
  solver::TransportOptions options = transport_options();
  options.patch_m = reference_m_;
  options.rays *= 2;
  options.lamp_rays *= 2;
  const RoomTransport fine = solver::prepare_transport(run_.room, options);
  reference_ = answer(run_.room, fine, solver::solve_room(run_.room, fine, tight()));
  rank(reference_, run_.room, fine);
  log_.result().reference = fmt::format(
      "the same room with patch_m {:.3g} ({} patches, {:.3g} of the baseline's edge{}), twice the "
      "rays, solved by cg to {:g}; no closed form is known for the light at a point",
      reference_m_, fine.mesh.size(), *factor,
      *factor > kReferenceFactors.front()
          ? fmt::format(", the finest planned to fit into half of the {:g} s", options_.seconds)
          : "",
      kTight);
}

void Experiment::add_tolerances(const SolverMethod& method) {
  if (run_.transport.exchange.rows() > method.most_patches) {
    log_.leave_out(method.name, fmt::format("{} unknowns; it takes too long beyond {}",
                                            run_.transport.exchange.rows(), method.most_patches));
    return;
  }
  std::vector<double> tolerances(kTolerances.begin(), kTolerances.end());
  if (!method.iterates) tolerances = {RadiosityOptions().relative_error};
  double last_s = 0;
  for (const double tolerance : tolerances) {
    const std::string setting = method.iterates ? fmt::format("{:g}", tolerance) : "";
    if (!log_.may_start(setting.empty() ? method.name : method.name + " " + setting, 2 * last_s))
      continue;
    ConvergenceRun run = baseline_run("method", setting);
    run.method = method.name;
    run.relative_error = tolerance;
    const Timed<RoomSolution> solved = timed([&] {
      return method.solve(run_.room, run_.transport,
                          {.relative_error = tolerance, .max_iterations = kMostSweeps});
    });
    note_solution(run, solved);
    last_s = solved.seconds;
    const RoomAnswer found = answer(run_.room, run_.transport, solved.value);
    run.errors = errors_of(found, reference_);
    run.own = errors_of(found, exact_);
    log_.add(std::move(run));
  }
}

/// The cheapest answer: no mesh, no rays, nothing to iterate.
void Experiment::add_ambient_term() {
  const Timed<RoomAnswer> found =
      timed([&] { return ambient_answer(run_.room, run_.transport.viewed); });
  log_.add({.factor = "method",
            .method = kAmbientTerm,
            .bands = run_.room.grid.count,
            .converged = true,
            .repeats = found.repeats,
            .solve_s = found.seconds,
            .errors = errors_of(found.value, reference_),
            .own = errors_of(found.value, exact_),
            .quantity = kPerBand,
            .reference = fmt::format("patch_m {:.3g}", reference_m_)});
}

/// A run that needs a transport of its own. @param own_judge  null: the reference
void Experiment::add_transport(ConvergenceRun run, const solver::TransportOptions& options,
                               const RoomAnswer* own_judge) {
  const Timed<RoomTransport> built =
      timed([&] { return solver::prepare_transport(run_.room, options); });
  const RoomTransport& transport = built.value;
  run.patch_m = options.patch_m;
  run.patches = transport.mesh.size();
  run.rays = options.rays;
  run.setup_s = built.seconds;
  const Timed<RoomSolution> solved =
      timed([&] { return solver::solve_room(run_.room, transport); });
  note_solution(run, solved);
  RoomAnswer found = answer(run_.room, transport, solved.value);
  rank(found, run_.room, transport);
  run.errors = errors_of(found, reference_);
  run.own = errors_of(found, own_judge != nullptr ? *own_judge : reference_);
  log_.add(std::move(run));
}

void Experiment::add_patch_sizes() {
  for (const double factor : kPatchFactors) {
    solver::TransportOptions options = transport_options();
    options.patch_m = factor * baseline_m_;
    const std::string what = fmt::format("patch_m {:.3g}", options.patch_m);
    if (options.patch_m < 1.35 * reference_m_) {
      log_.leave_out(what, "the reference is hardly finer");
      continue;
    }
    if (!log_.may_start(what, setup_s_ * std::pow(factor, -4))) continue;
    add_transport(baseline_run("patch_m", fmt::format("{:.3g}", options.patch_m)), options,
                  nullptr);
  }
}

/// The same unknowns with the other kind of light.
void Experiment::add_other_light() {
  const bool linear = options_.light == solver::Light::linear;
  const std::string other = linear ? "constant" : "linear";
  if (!log_.may_start(other + " light", 2 * setup_s_)) return;
  solver::TransportOptions options = transport_options();
  options.light = linear ? solver::Light::constant : solver::Light::linear;
  add_transport(baseline_run("light", other), options, nullptr);
}

void Experiment::add_rays() {
  if (run_.transport.plan.occludable_pairs == 0) {
    log_.leave_out("ray counts", "nothing can stand between two patches: no ray is cast");
    return;
  }
  const auto with_rays = [&](int rays) {
    solver::TransportOptions options = transport_options();
    options.rays = rays;
    options.lamp_rays = kLampRays * rays;
    return options;
  };
  if (!log_.may_start("ray counts", 4 * setup_s_)) return;
  const RoomTransport most = solver::prepare_transport(run_.room, with_rays(kMostRays));
  const RoomAnswer judge = answer(run_.room, most, solver::solve_room(run_.room, most, tight()));
  for (const int rays : kRays) {
    if (!log_.may_start(fmt::format("{} rays", rays), setup_s_)) continue;
    add_transport(baseline_run("rays", fmt::format("{}", rays)), with_rays(rays), &judge);
  }
}

/// Means over groups of the 31 bands, of light and reflectance alike. Timed as a room of so many
/// bands; seen, like paints in it, as steps on the 31.
void Experiment::add_band_groups(int groups, const RoomAnswer& judge,
                                 const std::string& judged_by) {
  const MatrixXd mean = means_of_groups(run_.room.grid.count, groups);
  const MatrixXd steps = mean * (mean.array() > 0).cast<double>().matrix().transpose();
  ConvergenceRun run = baseline_run("bands", fmt::format("{}", groups));
  run.bands = groups;
  run.quantity = kXyz;
  run.reference = judged_by;
  const PreparedRoom narrow = with_bands({run_.room, run_.transport}, mean);
  note_solution(run, timed([&] { return solver::solve_room(narrow.room, narrow.transport); }));

  const PreparedRoom wide = with_bands({run_.room, run_.transport}, steps);
  RoomAnswer found =
      answer(wide.room, wide.transport, solver::solve_room(wide.room, wide.transport));
  if (wish_.task) {
    RankingTask task = *wish_.task;
    for (paints::Paint& paint : task.atlas.paints) {
      paint.reflectance.values = steps.transpose() * paint.reflectance.values.matrix();
    }
    found.paint_distance =
        seeing(run_, [&] { return paint_distances(wide.room, wide.transport, task); });
  }
  run.errors = run.own = errors_of(in_tristimulus_values(found, wide.room.grid), judge);
  log_.add(std::move(run));
}

/// 81 bands from 380 to 780 nm, if the room's spectra reach so far. @return their answer
std::optional<RoomAnswer> Experiment::add_wide_bands() {
  scenes::Room room;
  try {
    room = scenes::read_room(run_.path, kWideGrid);
  } catch (const spectra::InputError& error) {
    log_.leave_out(
        fmt::format("{} bands", kWideGrid.count),
        fmt::format("the inputs do not cover 380..780 nm: {}", error.faults().front().problem));
    return {};
  }
  if (!log_.may_start(fmt::format("{} bands", kWideGrid.count), 4 * setup_s_)) return {};
  const RoomTransport transport = solver::prepare_transport(room, transport_options());
  ConvergenceRun run = baseline_run("bands", fmt::format("{}", kWideGrid.count));
  run.bands = kWideGrid.count;
  run.quantity = kXyz;
  run.reference = fmt::format("{} bands solved to {:g}, same mesh", kWideGrid.count, kTight);
  const Timed<RoomSolution> solved = timed([&] { return solver::solve_room(room, transport); });
  note_solution(run, solved);
  RoomAnswer judge = in_tristimulus_values(
      answer(room, transport, solver::solve_room(room, transport, tight())), kWideGrid);
  run.errors = run.own =
      errors_of(in_tristimulus_values(answer(room, transport, solved.value), kWideGrid), judge);
  log_.add(std::move(run));
  return judge;
}

void Experiment::add_bands() {
  RoomAnswer judge = in_tristimulus_values(exact_, run_.room.grid);
  std::string judged_by =
      fmt::format("{} bands solved to {:g}, same mesh", run_.room.grid.count, kTight);
  if (std::optional<RoomAnswer> wide = add_wide_bands()) {
    judge = std::move(*wide);
    judge.paint_distance = exact_.paint_distance;  // an atlas is ranked on 31 bands
    judged_by = log_.result().runs.back().reference;
  }
  for (const int groups : {3, 9, run_.room.grid.count}) {
    if (!log_.may_start(fmt::format("{} bands", groups))) continue;
    add_band_groups(groups, judge, judged_by);
  }
}

void Experiment::sweep() {
  if (!log_.may_start("the sweep of reflectances")) return;
  solver::TransportOptions options = transport_options();
  RoomTransport coarse = run_.transport;
  while (coarse.exchange.rows() > kCoarsePatches) {
    options.patch_m *= std::sqrt(2);
    const scenes::PatchMesh mesh =
        scenes::mesh_room(run_.room, solver::longest_edge_m(options.patch_m, options.light));
    const int unknowns = solver::modes_of(options.light) * mesh.size();
    if (unknowns > kCoarsePatches && options.patch_m < 8 * baseline_m_) continue;
    coarse = solver::prepare_transport(run_.room, options);
    break;
  }
  sweep_reflectance(
      with_bands({run_.room, std::move(coarse)}, means_of_groups(run_.room.grid.count, 1)), log_);
}

Convergence Experiment::measure() {
  make_baseline();
  make_reference();
  run_.clock.stop("reference");
  // The runs have the other half, however long the reference really took.
  ConvergenceLog runs(options_.seconds / 2);
  runs.result() = std::move(log_.result());
  log_ = std::move(runs);
  if (!wish_.task) log_.leave_out("rankings", wish_.why_not);
  log_.leave_out(
      "rankings by method and tolerance",
      "the room response is solved by cg to its own tolerance, whatever solves the room");
  ConvergenceRun baseline = baseline_run("baseline", "");
  const Timed<RoomSolution> solved =
      timed([&] { return solver::solve_room(run_.room, run_.transport); });
  note_solution(baseline, solved);
  RoomAnswer found = answer(run_.room, run_.transport, solved.value);
  baseline.own = errors_of(found, exact_);
  found.paint_distance = exact_.paint_distance;
  baseline.errors = errors_of(found, reference_);
  log_.add(std::move(baseline));

  const std::vector<SolverMethod>& methods = solver_methods();
  std::vector<std::function<void()>> steps{[&] { add_ambient_term(); },
                                           [&] { add_tolerances(methods.front()); },
                                           [&] { add_other_light(); },
                                           [&] { add_patch_sizes(); },
                                           [&] { add_rays(); },
                                           [&] { add_bands(); },
                                           [&] { sweep(); }};
  for (std::size_t m = 1; m < methods.size(); ++m) {
    steps.emplace_back([&, m] { add_tolerances(methods[m]); });
  }
  Progress progress("factors", static_cast<int>(steps.size()));
  for (const auto& step : steps) {
    step();
    progress.step();
  }
  run_.clock.stop("runs");
  return std::move(log_.result());
}

}  // namespace

Convergence measure_convergence(RoomRun& run, const ConvergenceOptions& options) {
  return Experiment(run, options).measure();
}

}  // namespace apps
