#pragma once
#include <optional>
#include <string>
#include <vector>

#include "apps/run/room_run.h"
#include "paints/ranking.h"

namespace apps {

/// What a room answers: light where it was asked for, and what an eye makes of it.
struct RoomAnswer {
  std::vector<Eigen::ArrayXd> irradiance;           ///< receivers, then viewed points; per band
  std::vector<std::optional<Eigen::Vector3d>> jab;  ///< J, a_C, b_C of each viewed point
  std::vector<double> paint_distance;  ///< of each paint of the atlas; NaN: the model has none;
                                       ///< empty: not ranked
};

/// How far an answer is from a better one; empty where that is not defined.
struct AnswerErrors {
  std::optional<double> max_relative, rms_relative;  ///< of irradiance, over points and bands
  std::optional<double> distance_jab;                ///< largest over viewed points
  std::optional<double> kendall_tau;
  std::optional<int> top_overlap;  ///< of the best kTopPaints
};

inline constexpr std::size_t kTopPaints = 10;

/// What is ranked.
struct RankingTask {
  paints::Atlas atlas;
  paints::Target target;
  double highest_reflectance = 0;
};

/// What the room wishes to be ranked, and else why there is nothing to rank.
struct RankingWish {
  std::optional<RankingTask> task;
  std::string why_not;
};

[[nodiscard]] RankingWish ranking_wish(const RoomRun& run);

/// Without the distances of paints.
/// @throws std::domain_error  if there is no light to view the room by
[[nodiscard]] RoomAnswer answer_of(const scenes::Room& room, const solver::RoomTransport& transport,
                                   const solver::RoomSolution& solution);

/// The light alone, by the extended ambient term.
[[nodiscard]] RoomAnswer ambient_answer(const scenes::Room& room,
                                        const std::vector<solver::ViewedWall>& viewed);

/// The distance of every paint from the target, by the room response.
/// @throws std::domain_error  if there is no light to view the room by
[[nodiscard]] std::vector<double> paint_distances(const scenes::Room& room,
                                                  const solver::RoomTransport& transport,
                                                  const RankingTask& task);

/// With X, Y, Z of the irradiance in place of its bands, so that answers on different bands can be
/// compared.
[[nodiscard]] RoomAnswer in_tristimulus_values(RoomAnswer answer, const spectra::Grid& grid);

/// What gets no light in the better answer does not count.
/// @throws std::invalid_argument  unless both answers have the same points and bands
[[nodiscard]] AnswerErrors errors_of(const RoomAnswer& answer, const RoomAnswer& better);

}  // namespace apps
