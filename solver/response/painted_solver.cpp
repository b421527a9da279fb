#include "solver/response/painted_solver.h"

#include <algorithm>
#include <stdexcept>

#include "solver/bounce/radiosity.h"

namespace solver {

using Eigen::ArrayXd;
using Eigen::Index;
using Eigen::VectorXd;

namespace {

double read(const OutputRow& row, const RadiositySolution& solution, Index column) {
  double sum = 0;
  if (row.on_radiosity.size() > 0) {
    sum += row.on_radiosity.dot(solution.radiosity.col(column).matrix());
  }
  if (row.on_irradiance.size() > 0) {
    sum += row.on_irradiance.dot(solution.irradiance.col(column).matrix());
  }
  return sum;
}

}  // namespace

PaintedSolver::PaintedSolver(const ExchangeAreas& exchange, const PaintedPatches& painted,
                             const std::vector<OutputRow>& outputs, double relative_error)
    : exchange_(exchange), painted_(painted), outputs_(outputs), relative_error_(relative_error) {
  for (int p = 0; p < exchange.rows(); ++p) {
    if (painted.group[static_cast<std::size_t>(p)] >= 0) patches_.push_back(p);
  }
  if (patches_.empty()) throw std::invalid_argument("no patch is painted");
  root_area_ = exchange.area_m2(patches_).sqrt();
}

int PaintedSolver::group_of(Index painted) const {
  return painted_.group[static_cast<std::size_t>(patches_[static_cast<std::size_t>(painted)])];
}

void PaintedSolver::solve(std::vector<PaintedColumn>& columns) const {
  const Index count = static_cast<Index>(columns.size());
  for (Index first = 0; first < count; first += kColumnsAtOnce) {
    solve_some(columns.data() + first, std::min(kColumnsAtOnce, count - first));
  }
}

void PaintedSolver::solve_some(PaintedColumn* first, Index count) const {
  const Index n = exchange_.rows();
  Bands emission(n, count), direct(n, count), reflectance(n, count);
  for (Index k = 0; k < count; ++k) {
    emission.col(k) = first[k].emission;
    direct.col(k) = first[k].direct;
    reflectance.col(k) = first[k].fixed;
    for (Index p = 0; p < painted_patches(); ++p) {
      reflectance(patches_[static_cast<std::size_t>(p)], k) = first[k].paint[group_of(p)];
    }
  }
  const RadiositySolution
      solution =  // linear light may be negative: a part of it, or a mean in a slot
      solve_radiosity(exchange_, emission, direct, Reflector(std::move(reflectance)),
                      {.relative_error = relative_error_});
  for (Index k = 0; k < count; ++k) {
    first[k].received = solution.irradiance.col(k)(patches_) * root_area_;
    first[k].outputs.resize(outputs());
    for (Index o = 0; o < outputs(); ++o) {
      first[k].outputs[o] = read(outputs_[static_cast<std::size_t>(o)], solution, k);
    }
  }
}

VectorXd PaintedSolver::part(const VectorXd& received, int group) const {
  VectorXd part = received;
  for (Index p = 0; p < part.size(); ++p) {
    if (group_of(p) != group) part[p] = 0;
  }
  return part;
}

PaintedColumn PaintedSolver::emitter(const ArrayXd& fixed, const VectorXd& received,
                                     int group) const {
  PaintedColumn column{.fixed = fixed,
                       .emission = VectorXd::Zero(exchange_.rows()),
                       .direct = VectorXd::Zero(exchange_.rows()),
                       .paint = VectorXd::Zero(painted_.groups)};
  const VectorXd sent = part(received, group);
  for (Index p = 0; p < sent.size(); ++p) {
    const int row = patches_[static_cast<std::size_t>(p)];
    const double emission = sent[p] / root_area_[p];
    column.emission[row] = exchange_.modes == 1 ? std::max(0.0, emission) : emission;
  }
  return column;
}

}  // namespace solver
