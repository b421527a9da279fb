#include "apps/studies/convergence_answer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "apps/studies/paint_wish.h"
#include "apps/studies/painted_room.h"
#include "paints/rank_agreement.h"
#include "solver/response/room_response.h"
#include "solver/rooms/ambient_term.h"

namespace apps {
namespace {

using Eigen::ArrayXd, Eigen::Vector3d;

std::optional<Vector3d> jab_of(const appearance::RoomView& view) {
  const Reported seen(seen_in_room(view).correlates);
  if (!seen.j || !seen.a_c || !seen.b_c) return {};
  return Vector3d(*seen.j, *seen.a_c, *seen.b_c);
}

/// Scores of the paints that both answers define.
struct CommonScores {
  std::vector<double> a, b;
};

CommonScores common_scores(const std::vector<double>& a, const std::vector<double>& b) {
  CommonScores common;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    if (std::isnan(a[i]) || std::isnan(b[i])) continue;
    common.a.push_back(a[i]);
    common.b.push_back(b[i]);
  }
  return common;
}

std::string why_not_ranked(const RoomRun& run) {
  const std::vector<scenes::PaintTask>& paint = run.room.paint;
  if (paint.empty()) return "the room paints no surfaces";
  if (paint.size() > 1) return "the room paints several groups of surfaces";
  if (!paint.front().target) return "the room names no target";
  if (paint.front().target->seen == scenes::SwatchPlace::here) {
    return "the target is held in the room, so it changes with the settings";
  }
  const int viewed = viewed_point(run).surface;
  const bool painted = scenes::paint_group(run.room, viewed) == 0;
  return painted ? "" : "the viewed surface is not painted";
}

}  // namespace

RankingWish ranking_wish(const RoomRun& run) {
  if (std::string why = why_not_ranked(run); !why.empty()) return {.task = {}, .why_not = why};
  const scenes::TargetColour& target = target_of(run);
  const appearance::SwatchCondition swatch = swatch_of(run, target, run.room.viewing, std::nullopt);
  RankingTask task{.atlas = paints::load_atlas(run.room.paint.front().atlas, run.room.grid),
                   .target = wished(run, target, swatch)};
  task.highest_reflectance = highest_reflectance(task.atlas, target);
  if (task.atlas.paints.size() < kTopPaints) {
    return {.task = {}, .why_not = fmt::format("the atlas has fewer than {} paints", kTopPaints)};
  }
  return {.task = std::move(task), .why_not = {}};
}

RoomAnswer answer_of(const scenes::Room& room, const solver::RoomTransport& transport,
                     const solver::RoomSolution& solution) {
  RoomAnswer answer;
  for (const auto* points : {&solution.receivers, &solution.viewed}) {
    for (const solver::ReceiverLight& light : *points) {
      answer.irradiance.push_back(light.irradiance);
    }
  }
  for (std::size_t v = 0; v < transport.viewed.size(); ++v) {
    answer.jab.push_back(jab_of(appearance::view_of_room(
        solver::viewed_light(room, transport, solution, v), room.viewing)));
  }
  return answer;
}

RoomAnswer ambient_answer(const scenes::Room& room, const std::vector<solver::ViewedWall>& viewed) {
  std::vector<scenes::Receiver> points = room.receivers;
  for (const solver::ViewedWall& wall : viewed) {
    points.push_back({.name = "", .at_m = wall.at.point_m, .normal = wall.at.normal});
  }
  RoomAnswer answer;
  const solver::Bands irradiance = solver::extended_ambient_term(room, points);
  for (Eigen::Index p = 0; p < irradiance.rows(); ++p) {
    answer.irradiance.emplace_back(irradiance.row(p).transpose());
  }
  answer.jab.resize(viewed.size());
  return answer;
}

std::vector<double> paint_distances(const scenes::Room& room,
                                    const solver::RoomTransport& transport,
                                    const RankingTask& task) {
  const solver::ReducedViews views =
      solver::reduce_views(room, transport,
                           {.highest_reflectance = task.highest_reflectance,
                            .relative_error = 1e-5,  // far below what meshes and rays do to colours
                            .solver_error = 1e-9});
  const paints::Ranking ranking =
      paints::rank(task.atlas, task.target, lit_rooms(room, views),
                   {.viewing = room.viewing, .judgement = room.judgement});
  std::vector<double> distance(task.atlas.paints.size(), std::numeric_limits<double>::quiet_NaN());
  for (const paints::RankedPaint& p : ranking.paints) {
    distance[static_cast<std::size_t>(p.paint - task.atlas.paints.data())] = p.distance;
  }
  return distance;
}

RoomAnswer in_tristimulus_values(RoomAnswer answer, const spectra::Grid& grid) {
  for (ArrayXd& irradiance : answer.irradiance) {
    const spectra::Xyz xyz = spectra::absolute_xyz({.grid = grid, .values = irradiance});
    irradiance = Eigen::Array3d(xyz.x, xyz.y, xyz.z);
  }
  return answer;
}

AnswerErrors errors_of(const RoomAnswer& answer, const RoomAnswer& better) {
  if (answer.irradiance.size() != better.irradiance.size() ||
      answer.jab.size() != better.jab.size()) {
    throw std::invalid_argument(
        fmt::format("{} points beside {}", answer.irradiance.size(), better.irradiance.size()));
  }
  AnswerErrors errors;
  double largest = 0, squares = 0;
  Eigen::Index values = 0;
  for (std::size_t p = 0; p < answer.irradiance.size(); ++p) {
    const ArrayXd &is = answer.irradiance[p], &ought = better.irradiance[p];
    if (is.size() != ought.size()) {
      throw std::invalid_argument(fmt::format("{} bands beside {}", is.size(), ought.size()));
    }
    const ArrayXd off = (ought > 0).select((is - ought).abs() / ought.max(1e-300), 0.0);
    largest = std::max(largest, off.maxCoeff());
    squares += off.square().sum();
    values += (ought > 0).count();
  }
  if (values > 0) {
    errors.max_relative = largest;
    errors.rms_relative = std::sqrt(squares / static_cast<double>(values));
  }
  for (std::size_t v = 0; v < answer.jab.size(); ++v) {
    if (!answer.jab[v] || !better.jab[v]) continue;
    const double distance = (*answer.jab[v] - *better.jab[v]).norm();
    errors.distance_jab = std::max(errors.distance_jab.value_or(0), distance);
  }
  const CommonScores scores = common_scores(answer.paint_distance, better.paint_distance);
  if (scores.a.size() >= kTopPaints) {
    errors.kendall_tau = paints::kendall_tau(scores.a, scores.b);
    errors.top_overlap = paints::top_overlap(scores.a, scores.b, kTopPaints);
  }
  return errors;
}

}  // namespace apps
