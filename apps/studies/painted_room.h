#pragma once
#include <filesystem>
#include <vector>

#include "apps/run/response_file.h"
#include "apps/run/room_run.h"
#include "apps/studies/seen.h"

namespace apps {

/// A room as a function of its paints: by its response, which is kept in a file between runs, and
/// by full solves that the response is checked with.
class PaintedRoom {
 public:
  /// Loads the response or makes it, for reflectances up to `highest_reflectance`.
  /// @throws spectra::FileError   if nothing can be written to `out`
  /// @throws spectra::InputError, solver::TooLarge
  PaintedRoom(RoomRun& run, const RankOptions& options, const std::filesystem::path& out,
              double highest_reflectance);

  /// Names and weights of the lightings, without a view.
  [[nodiscard]] std::vector<spectra::LitRoom> lightings() const;

  /// lit_rooms() of its response.
  [[nodiscard]] std::vector<spectra::LitRoom> rooms(
      int varying = 0, int viewed = 0, const std::vector<spectra::Spectrum>& paints = {}) const;

  /// The same on patches twice and four times as long; none where these cut the room no other way.
  [[nodiscard]] std::vector<std::vector<spectra::LitRoom>> rooms_of_longer_patches() const;

  /// With derivatives, one per lighting.
  [[nodiscard]] std::vector<spectra::RoomResponseSlope> slopes(
      int varying = 0, int viewed = 0, const std::vector<spectra::Spectrum>& paints = {}) const;

  /// The same lightings by a full solve for each paint of a single group.
  [[nodiscard]] std::vector<spectra::LitRoom> solved_rooms();

  /// A full solve in one of the lightings of `rooms`.
  [[nodiscard]] solver::RoomSolution solve(const std::vector<spectra::Spectrum>& paints,
                                           std::size_t lighting = 0);

  /// What the viewer of a group sees in the room as it is painted now, in the first lighting: by
  /// the response where each group has one paint now, else by a full solve.
  [[nodiscard]] spectra::ViewedLight as_painted(int group);

  [[nodiscard]] bool converged() const;

  /// For run.json.
  [[nodiscard]] Json record() const;

  /// The files to write beside the results: the response, if it was made anew.
  [[nodiscard]] std::vector<OutputFile> files() const;

 private:
  [[nodiscard]] const solver::ReducedViews& views() const { return meshes_.front(); }

  void need_transport();
  void reduce(double highest_reflectance);

  RoomRun& run_;
  const RankOptions& options_;
  std::filesystem::path out_, file_;
  std::string key_;
  ResponseOnMeshes meshes_;
  bool loaded_ = false, prepared_ = false;
  int solves_ = 0, not_converged_ = 0;
};

/// The lightings of a reduced room as the viewer of one group sees them while one group's paint
/// varies. @param paints  of each group; that of `varying` is not read; empty for a single group
[[nodiscard]] std::vector<spectra::LitRoom> lit_rooms(
    const scenes::Room& room, const solver::ReducedViews& views, int varying = 0, int viewed = 0,
    const std::vector<spectra::Spectrum>& paints = {});

/// The highest reflectance that a response is made for, unless a paint has a higher one.
inline constexpr double kHighestReflectance = 0.9995;

}  // namespace apps
