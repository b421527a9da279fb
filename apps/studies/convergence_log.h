#pragma once
#include <string>
#include <utility>
#include <vector>

#include "apps/studies/convergence_answer.h"
#include "apps/studies/convergence_timing.h"

namespace apps {

/// The method without mesh, rays and iterations; solver/ambient_term.h.
inline constexpr const char* kAmbientTerm = "extended ambient term";

/// One way to compute the room, timed and judged.
struct ConvergenceRun {
  std::string factor;   ///< in which it differs from the baseline: method, patch_m, rays, bands,
                        ///< reflectance; or baseline
  std::string method;   ///< of the solver
  std::string setting;  ///< of the factor
  double patch_m = 0;
  int patches = 0, bands = 0, rays = 0;
  double relative_error = 0;  ///< asked of the solver
  int iterations = 0;         ///< of the band that took most
  bool converged = false;
  int repeats = 0;                  ///< whose medians the seconds are
  double setup_s = 0, solve_s = 0;  ///< mesh, exchange areas, gather rows; radiosities
  AnswerErrors errors;              ///< all of it, from `reference`
  AnswerErrors own;                 ///< what the factor alone leaves
  double one_minus_rho = 0;         ///< reflectance only: 1 - rho of all surfaces
  std::string quantity;             ///< whose error it is
  std::string reference;            ///< against which
};

void note_solution(ConvergenceRun& run, const Timed<solver::RoomSolution>& solved);

struct Convergence {
  std::string room;
  std::string reference;             ///< what most runs are judged by, in words
  std::vector<ConvergenceRun> runs;  ///< the baseline first
  std::vector<solver::Omission> left_out;
};

/// What the runs of an experiment share: where results and omissions go, and when to stop.
class ConvergenceLog {
 public:
  explicit ConvergenceLog(double seconds);

  void add(ConvergenceRun run) { result_.runs.push_back(std::move(run)); }

  void leave_out(const std::string& what, const std::string& why);

  /// False once the time is over or would be after `needed_s` more; then `what` is left out.
  [[nodiscard]] bool may_start(const std::string& what, double needed_s = 0);

  [[nodiscard]] Convergence& result() { return result_; }

 private:
  double end_s_;
  Convergence result_;
};

}  // namespace apps
