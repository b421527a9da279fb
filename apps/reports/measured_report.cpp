#include "apps/reports/measured_report.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "appearance/viewing_conditions.h"
#include "apps/reports/csv.h"
#include "apps/system/terminal.h"

namespace apps {
namespace {

bool faces_sun(const SeenDirections& d) { return d.room == "room_south"; }

std::string background_of(const SeenDirections& d) {
  return d.choices.background == spectra::Background::fixed
             ? fmt::format("{:g}", d.choices.background_y)
             : appearance::to_string(d.choices.background);
}

/// The published directions of a room, each by whether it comes out.
struct Sign {
  const char* what;
  bool out;
};

std::vector<Sign> signs_of(const SeenDirections& d) {
  if (faces_sun(d)) {
    return {{"all colours gain chroma", d.chroma_rises == d.colours},
            {"yellowish gain most", d.yellowish > d.reddish && d.yellowish > d.other},
            {"reddish gain least", d.reddish < d.yellowish && d.reddish < d.other},
            {"yellowish turn to yellow", d.to_yellow == d.yellowish_colours}};
  }
  return {{"all but yellowish gain chroma", d.others_rise == d.others},
          {"yellowish gain none", d.yellowish <= 0},
          {"hues turn to bluish red", d.to_bluish_red == d.colours}};
}

std::string yes_no(bool yes) { return yes ? "yes" : "no"; }

std::string box_table(const MeasuredBox& box) {
  std::vector<std::vector<std::string>> rows{
      {"target at", "rms", "worst", "at nm", "rms without bounces", "worst", "mesh"}};
  const auto percent = [](double v) { return fmt::format("{:.1f} %", 100 * v); };
  for (const BoxPlace& p : box.places) {
    rows.push_back({p.name, percent(p.with_bounces.rms),
                    fmt::format("{:+.1f} %", 100 * p.with_bounces.worst),
                    fmt::format("{:g}", p.with_bounces.worst_nm), percent(p.without.rms),
                    fmt::format("{:+.1f} %", 100 * p.without.worst),
                    fmt::format("{:.3f} %", 100 * p.mesh_error)});
  }
  return fmt::format(
             "A box of 0.30 m built and measured [Lyu2021]: spectral shape of target over lamp, "
             "{:g} to 700 nm,\none scale fitted. The two readings of the target differ by {:.2f} % "
             "rms in shape, {:.2f} % as they were read.\n\"mesh\": from patches half as "
             "long.\n\n",
             kShapeFrom_nm, 100 * box.between_readings, 100 * box.between_amounts) +
         table("<>>>>>>", rows);
}

std::string rooms_table(const std::vector<SeenDirections>& rooms, bool sun) {
  std::vector<std::vector<std::string>> lines{{"white", "Y_b", "size", "gain C", "C", "yellowish",
                                               "reddish", "other", "J", "to yellow",
                                               "to bluish red"}};
  for (const SeenDirections& d : rooms) {
    if (faces_sun(d) != sun) continue;
    const auto change = [](double v) { return fmt::format("{:+.1f}", v); };
    lines.push_back({fmt::format("{:g}", d.choices.white_share), background_of(d),
                     d.choices.size_effect ? "on" : "off",
                     fmt::format("{}/{}", d.chroma_rises, d.colours), change(d.chroma),
                     change(d.yellowish), change(d.reddish), change(d.other), change(d.lightness),
                     fmt::format("{}/{}", d.to_yellow, d.yellowish_colours),
                     fmt::format("{}/{}", d.to_bluish_red, d.colours)});
    for (const Sign& s : signs_of(d)) {
      if (lines.size() == 2) lines.front().emplace_back(s.what);
      lines.back().push_back(yes_no(s.out));
    }
  }
  return table("><<>>>>>>>>" + std::string(lines.front().size() - 11, '<'), lines);
}

}  // namespace

std::string measured_text(const Measured& measured) {
  std::string text = box_table(measured.box);
  text += fmt::format(
      "\nRooms painted in one colour, seen by 79 people [Harleman2007]: mean change from the "
      "swatch "
      "to the room,\n16 colours, and whether each published direction comes out. Window and "
      "daylight "
      "are assumed.\nSize effect: {}.\n",
      appearance::kSizeEffectCaution);
  text += "\naway from the sun\n" + rooms_table(measured.rooms, false);
  text += "\nfacing the sun\n" + rooms_table(measured.rooms, true);
  return text;
}

Json describe(const Measured& measured) {
  Json json{{"box",
             {{"between_readings_rms", measured.box.between_readings},
              {"between_readings_as_read_rms", measured.box.between_amounts},
              {"places", Json::array()}}},
            {"rooms", Json::array()},
            {"size_effect_caution", appearance::kSizeEffectCaution}};
  for (const BoxPlace& p : measured.box.places) {
    json["box"]["places"].push_back({{"name", p.name},
                                     {"rms", p.with_bounces.rms},
                                     {"worst", p.with_bounces.worst},
                                     {"worst_nm", p.with_bounces.worst_nm},
                                     {"rms_without_bounces", p.without.rms},
                                     {"worst_without_bounces", p.without.worst},
                                     {"mesh_error", p.mesh_error}});
  }
  for (const SeenDirections& d : measured.rooms) {
    Json signs;
    for (const Sign& s : signs_of(d)) signs[s.what] = s.out;
    json["rooms"].push_back({{"room", d.room},
                             {"white_share", d.choices.white_share},
                             {"background", background_of(d)},
                             {"size_effect", d.choices.size_effect},
                             {"change_C", d.chroma},
                             {"change_J", d.lightness},
                             {"directions", signs}});
  }
  return json;
}

std::vector<OutputFile> measured_files(const std::filesystem::path& out, const Measured& measured) {
  CsvText box("place,rms,worst,worst_nm,rms_without_bounces,worst_without_bounces,mesh_error");
  for (const BoxPlace& p : measured.box.places) {
    box.cell(p.name).cell(p.with_bounces.rms).cell(p.with_bounces.worst);
    box.cell(p.with_bounces.worst_nm).cell(p.without.rms).cell(p.without.worst);
    box.cell(p.mesh_error).end_row();
  }
  CsvText rooms(
      "room,white_share,background,size_effect,colours,gain_C,change_C,change_C_yellowish,"
      "change_C_reddish,change_C_other,change_J,yellowish,to_yellow,to_bluish_red,direction,"
      "comes_out,caution");
  for (const SeenDirections& d : measured.rooms) {
    for (const Sign& s : signs_of(d)) {
      rooms.cell(d.room).cell(d.choices.white_share).cell(background_of(d));
      rooms.cell(d.choices.size_effect ? "on" : "off").cell(d.colours).cell(d.chroma_rises);
      rooms.cell(d.chroma).cell(d.yellowish).cell(d.reddish).cell(d.other).cell(d.lightness);
      rooms.cell(d.yellowish_colours).cell(d.to_yellow).cell(d.to_bluish_red);
      rooms.cell(s.what).cell(yes_no(s.out));
      rooms.cell(d.choices.size_effect ? appearance::kSizeEffectCaution : "").end_row();
    }
  }
  return {{.path = out / "measured_box.csv", .text = box.take()},
          {.path = out / "measured_rooms.csv", .text = rooms.take()}};
}

}  // namespace apps
