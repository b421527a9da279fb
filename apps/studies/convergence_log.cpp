#include "apps/studies/convergence_log.h"

#include <algorithm>
#include <chrono>

namespace apps {
namespace {

double now_s() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

void note_solution(ConvergenceRun& run, const Timed<solver::RoomSolution>& solved) {
  const solver::RadiositySolution& radiosity = solved.value.radiosity;
  run.solve_s = solved.seconds;
  run.repeats = solved.repeats;
  run.iterations = 0;
  for (const solver::BandReport& band : radiosity.bands) {
    run.iterations = std::max(run.iterations, band.iterations);
  }
  run.converged = radiosity.converged;
}

ConvergenceLog::ConvergenceLog(double seconds) : end_s_(now_s() + seconds) {}

void ConvergenceLog::leave_out(const std::string& what, const std::string& why) {
  result_.left_out.push_back({.what = what, .why = why});
}

bool ConvergenceLog::may_start(const std::string& what, double needed_s) {
  if (now_s() + needed_s < end_s_) return true;
  leave_out(what, "the time is over; give more with --seconds");
  return false;
}

}  // namespace apps
