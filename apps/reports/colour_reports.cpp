#include "apps/reports/colour_reports.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "appearance/spectra/spectrum_library.h"
#include "apps/reports/csv.h"
#include "apps/system/terminal.h"

namespace apps {
namespace {

std::optional<double> change(std::optional<double> from, std::optional<double> to) {
  return from && to ? std::optional(*to - *from) : std::nullopt;
}

/// The short way round a circle: within +- circle / 2.
double turn(double from, double to, double circle) { return std::remainder(to - from, circle); }

/// The numeric columns of shift.csv for one condition.
struct ShiftRow {
  double X, Y, Z, x, y;
  std::optional<double> J, C;
  double h_deg, H;
  std::optional<double> a_C, b_C;
};

ShiftRow row_of(const Seen& seen) {
  const auto& [xyz, correlates] = seen;
  const auto [x, y] = spectra::chromaticity(xyz);
  const Reported r(correlates);
  return {xyz.x, xyz.y, xyz.z, x, y, r.j, r.c, r.h_deg, r.hue_quadrature, r.a_c, r.b_c};
}

ShiftRow change(const ShiftRow& from, const ShiftRow& to) {
  return {.X = to.X - from.X,
          .Y = to.Y - from.Y,
          .Z = to.Z - from.Z,
          .x = to.x - from.x,
          .y = to.y - from.y,
          .J = change(from.J, to.J),
          .C = change(from.C, to.C),
          .h_deg = turn(from.h_deg, to.h_deg, 360),
          .H = turn(from.H, to.H, 400),
          .a_C = change(from.a_C, to.a_C),
          .b_C = change(from.b_C, to.b_C)};
}

void cells(CsvText& csv, const ShiftRow& row) {
  csv.cell(row.X).cell(row.Y).cell(row.Z).cell(row.x).cell(row.y);
  csv.cell(row.J).cell(row.C).cell(row.h_deg).cell(row.H).cell(row.a_C).cell(row.b_C);
}

Json json_of(std::optional<double> value) { return value ? Json(*value) : Json(); }

Json json_of(const ShiftRow& row) {
  return {{"X", row.X},
          {"Y", row.Y},
          {"Z", row.Z},
          {"x", row.x},
          {"y", row.y},
          {"J", json_of(row.J)},
          {"C", json_of(row.C)},
          {"h_deg", row.h_deg},
          {"H", row.H},
          {"a_C", json_of(row.a_C)},
          {"b_C", json_of(row.b_C)}};
}

std::string arrow(std::optional<double> from, std::optional<double> to) {
  const auto number = [](std::optional<double> v) { return v ? fmt::format("{:.1f}", *v) : "-"; };
  return fmt::format("{:>5} -> {:>5}", number(from), number(to));
}

const char* spectrum_kind(bool reconstructed) {
  return reconstructed ? "reconstructed" : "measured";
}

}  // namespace

std::string chroma_arrow(const Shift& shift) {
  return arrow(Reported(shift.swatch.correlates).c, Reported(shift.room.correlates).c);
}

std::string hue_arrow(const Shift& shift) {
  return arrow(shift.swatch.correlates.hue_deg, shift.room.correlates.hue_deg);
}

std::string shift_csv(const std::vector<Shift>& shifts) {
  CsvText csv(
      "paint,surface,condition,X,Y,Z,x,y,J,C,h_deg,H,a_C,b_C,hue_composition,status,spectrum");
  for (const Shift& shift : shifts) {
    const auto condition = [&](const char* name, const ShiftRow& row, const Seen* seen) {
      csv.cell(shift.paint).cell(shift.surface).cell(name);
      cells(csv, row);
      csv.cell(seen ? appearance::hue_composition(seen->correlates.hue_quadrature) : "");
      csv.cell(seen ? appearance::to_string(seen->correlates.status) : "");
      csv.cell(spectrum_kind(shift.reconstructed)).end_row();
    };
    const ShiftRow swatch = row_of(shift.swatch), room = row_of(shift.room);
    condition("swatch", swatch, &shift.swatch);
    condition("room", room, &shift.room);
    condition("change", change(swatch, room), nullptr);
  }
  return csv.take();
}

Json shift_list(const std::vector<Shift>& shifts) {
  Json list = Json::array();
  for (const Shift& shift : shifts) {
    const ShiftRow swatch = row_of(shift.swatch), room = row_of(shift.room);
    list.push_back({{"paint", shift.paint},
                    {"surface", shift.surface},
                    {"spectrum", spectrum_kind(shift.reconstructed)},
                    {"swatch", json_of(swatch)},
                    {"room", json_of(room)},
                    {"change", json_of(change(swatch, room))}});
  }
  return list;
}

std::string shift_table(const std::vector<Shift>& shifts) {
  std::vector<std::vector<std::string>> rows{
      {"paint", "surface", "lightness", "chroma", "hue", "in the room"}};
  for (const Shift& shift : shifts) {
    const appearance::Correlates& room = shift.room.correlates;
    rows.push_back(
        {shift.paint, shift.surface, arrow(Reported(shift.swatch.correlates).j, Reported(room).j),
         chroma_arrow(shift), hue_arrow(shift), appearance::hue_composition(room.hue_quadrature)});
  }
  return table("<<>>><", rows);
}

std::string paint_name(const paints::Atlas& atlas, const paints::Paint& paint) {
  const std::vector<std::string>& compiled_in = spectra::atlas_names();
  const bool known =
      std::find(compiled_in.begin(), compiled_in.end(), atlas.name) != compiled_in.end();
  return known ? atlas.name + ":" + paint.name : paint.name;
}

std::string ranking_csv(const paints::Ranking& ranking, const paints::Atlas& atlas,
                        const paints::Target& target, int top, const std::vector<double>& solved,
                        const RankingErrors& errors) {
  CsvText csv(
      "rank,paint,distance,J,a_C,b_C,C,h_deg,H,dJ,da_C,db_C,x,y,label,hue_composition,status,"
      "spectrum,distance_solved,inconstancy,distance_mesh_error,J_mesh_error,a_C_mesh_error,"
      "b_C_mesh_error,ties_with");
  const auto count = std::min(static_cast<std::size_t>(top), ranking.paints.size());
  for (std::size_t i = 0; i < count; ++i) {
    const paints::RankedPaint& ranked = ranking.paints[i];
    const paints::SeenPaint& seen = ranked.seen.front();
    const appearance::Correlates& k = seen.correlates;
    csv.cell(static_cast<int>(i) + 1).cell(paint_name(atlas, *ranked.paint)).cell(ranked.distance);
    csv.cell(k.lightness).cell(k.a_c).cell(k.b_c);
    csv.cell(k.chroma).cell(k.hue_deg).cell(k.hue_quadrature);
    csv.cell(k.lightness - target.lightness).cell(k.a_c - target.a_c).cell(k.b_c - target.b_c);
    csv.cell(seen.chromaticity.x).cell(seen.chromaticity.y);
    csv.cell(ranked.paint->label).cell(appearance::hue_composition(k.hue_quadrature));
    csv.cell(appearance::to_string(k.status)).cell(spectrum_kind(atlas.reconstructed));
    csv.cell(i < solved.size() ? std::optional(solved[i]) : std::nullopt);
    csv.cell(ranked.inconstancy);
    const bool told = i < errors.of_paint.size();
    const auto error = [&](double LookError::*value) {
      csv.cell(told ? std::optional(errors.of_paint[i].*value) : std::nullopt);
    };
    error(&LookError::distance);
    error(&LookError::lightness);
    error(&LookError::a_c);
    error(&LookError::b_c);
    csv.cell(told && errors.ties_with[i] > 0 ? fmt::format("{}", errors.ties_with[i]) : "");
    csv.end_row();
  }
  return csv.take();
}

std::string scenarios_csv(const paints::Ranking& ranking, const paints::Atlas& atlas,
                          const std::vector<spectra::LitRoom>& rooms, int top) {
  CsvText csv("rank,paint,scenario,weight,distance,J,a_C,b_C,C,h_deg,H,x,y,illuminance_lx");
  const auto count = std::min(static_cast<std::size_t>(top), ranking.paints.size());
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t l = 0; l < rooms.size(); ++l) {
      const paints::SeenPaint& seen = ranking.paints[i].seen[l];
      const appearance::Correlates& k = seen.correlates;
      csv.cell(static_cast<int>(i) + 1).cell(paint_name(atlas, *ranking.paints[i].paint));
      csv.cell(rooms[l].name).cell(rooms[l].weight).cell(seen.distance);
      csv.cell(k.lightness).cell(k.a_c).cell(k.b_c).cell(k.chroma).cell(k.hue_deg);
      csv.cell(k.hue_quadrature).cell(seen.chromaticity.x).cell(seen.chromaticity.y);
      csv.cell(seen.view.illuminance_lx).end_row();
    }
  }
  return csv.take();
}

}  // namespace apps
