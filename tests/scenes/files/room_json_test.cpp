#include "scenes/files/room_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "appearance/spectra/illuminants.h"
#include "appearance/spectra/photometry.h"
#include "appearance/spectra/reconstruct.h"
#include "appearance/spectra/spectrum_library.h"
#include "tests/scenes/room_files.h"

namespace scenes {
namespace {

using spectra::kTransportGrid;
using testing::ElementsAre;
using testing::HasSubstr;

// Scaling a spectrum and adding it up again rounds 31 products: a few 1e-16, with room to spare.
constexpr double kRounding = 1e-13;

std::vector<spectra::Fault> faults_in(const json& room) {
  return faults_of([&] { (void)read(room); });
}

std::string all_notes(const Room& room) {
  std::string notes;
  for (const std::string& note : room.notes) notes += note + "\n";
  return notes;
}

/// The panel's luminous flux, lm, of a room whose first light is `light`.
double flux_of_panel_lm(const json& light) {
  json file = sample_room();
  for (const auto& [key, value] : light.items()) file["lights"][0][key] = value;
  if (!light.contains("flux_lm")) file["lights"][0].erase("flux_lm");
  return spectra::luminous(surface(read(file), "panel").exitance) * 1.2 * 0.6;
}

TEST(RoomJson, PanelHasExactlyItsFlux) {
  EXPECT_NEAR(flux_of_panel_lm({{"flux_lm", 4000}}), 4000, 4000 * kRounding);
}

TEST(RoomJson, PowerTimesEfficacyIsFlux) {
  EXPECT_NEAR(flux_of_panel_lm({{"power_W", 40}, {"efficacy_lm_W", 90}}), 3600, 3600 * kRounding);
}

// [Neumann2004] Table 4: tungsten (100 W, 240 V) has 13 lm/W.
TEST(RoomJson, PresetBringsItsEfficacy) {
  const json preset{{"preset", "tungsten 100 W 240 V"}};
  EXPECT_NEAR(flux_of_panel_lm({{"spectrum", preset}, {"power_W", 100}}), 1300, 1300 * kRounding);
  EXPECT_NEAR(flux_of_panel_lm({{"spectrum", preset}, {"power_W", 100}, {"efficacy_lm_W", 15}}),
              1500, 1500 * kRounding);
}

TEST(RoomJson, OpeningHasExactlyItsIlluminance) {
  EXPECT_NEAR(spectra::luminous(surface(read(sample_room()), "window").exitance), 3000,
              3000 * kRounding);
}

TEST(RoomJson, FluxOfAnOpeningIsSpreadOverItsArea) {
  json file = sample_room();
  file["lights"][1].erase("illuminance_lx");
  file["lights"][1]["flux_lm"] = 2800;
  EXPECT_NEAR(spectra::luminous(surface(read(file), "window").exitance), 1000, 1000 * kRounding);
}

TEST(RoomJson, LightsOfOneOpeningAddUp) {
  json file = sample_room();
  file["lights"].push_back(file["lights"][1]);
  file["lights"][2]["name"] = "sky again";
  EXPECT_NEAR(spectra::luminous(surface(read(file), "window").exitance), 6000, 6000 * kRounding);
}

TEST(RoomJson, PointHasItsFluxAndSunItsNormalIlluminance) {
  json file = sample_room();
  file["surfaces"]["window"] = 0.1;
  file["lights"] = json::parse(R"([
    { "name": "bulb", "point": { "at_m": [3, 1, 2] }, "spectrum": { "planck_K": 2700 },
      "flux_lm": 800 },
    { "name": "sun", "sun": { "azimuth_deg": 190, "altitude_deg": 30 },
      "spectrum": { "daylight_K": 5500 }, "illuminance_lx": 50000 } ])");
  const Room room = read(file);
  EXPECT_NEAR(spectra::luminous(room.point_lights.at(0).spectral_flux), 800, 800 * kRounding);
  EXPECT_NEAR(spectra::luminous(room.suns.at(0).normal_irradiance), 50000, 50000 * kRounding);
  EXPECT_EQ(room.suns.at(0).azimuth_deg, 190);
  EXPECT_TRUE((surface(room, "window").exitance.values == 0).all());
}

TEST(RoomJson, AbsoluteExitanceIsTakenAsItIs) {
  json file = sample_room();
  json& light = file["lights"][0];
  light.erase("flux_lm");
  light.erase("spectrum");
  std::vector<double> nm, values;
  for (int k = 0; k < kTransportGrid.count; ++k) {
    nm.push_back(kTransportGrid.wavelength_nm(k));
    values.push_back(0.01 * (k % 7 + 1));
  }
  light["exitance_W_m2_nm"] = {{"nm", nm}, {"values", values}};
  const Room room = read(file);
  const Spectrum& exitance = surface(room, "panel").exitance;
  EXPECT_EQ(std::vector<double>(exitance.values.begin(), exitance.values.end()), values);
}

TEST(RoomJson, SpectrumBesideAbsoluteExitanceIsReplacedAndSaid) {
  json file = sample_room();
  file["lights"][0].erase("flux_lm");
  file["lights"][0]["exitance_W_m2_nm"] = {{"nm", {400, 700}}, {"values", {0.1, 0.1}}};
  EXPECT_THAT(all_notes(read(file)), HasSubstr("/lights/0/spectrum"));
}

struct SpectrumForm {
  std::string name, form;
  std::function<Spectrum()> expected;  ///< up to a factor
};

class EverySpectrum : public testing::TestWithParam<SpectrumForm> {};

TEST(RoomJson, BoxesThatNoMeasuredLampIsLike) {
  json file = sample_room();
  const auto told = [&](const char* box) {
    file["lights"][0]["spectrum"] = {{"box", json::parse(box)}};
    std::string all;
    for (const auto& fault : faults_of([&] { (void)read(file); })) all += to_string(fault) + "\n";
    return all;
  };
  EXPECT_THAT(told(R"({"kind": "LED", "cct_K": 4000, "ra": 95})"),
              testing::HasSubstr("/lights/0/spectrum/box: no measured LED lamp is near 4000 K"));
  EXPECT_THAT(told(R"({"kind": "metal halide", "cct_K": 2000, "ra": 90})"),
              testing::HasSubstr("no measured metal halide lamp"));
  EXPECT_THAT(told(R"({"kind": "candle", "cct_K": 2700, "ra": 90})"), testing::HasSubstr("kind"));
  EXPECT_THAT(told(R"({"kind": "LED", "cct_K": 27, "ra": 90})"), testing::HasSubstr("cct_K"));
  EXPECT_THAT(told(R"({"kind": "LED"})"), testing::HasSubstr("\"ra\""));
}

TEST_P(EverySpectrum, HasTheShapeOfItsSource) {
  json file = sample_room();
  file["lights"][0]["spectrum"] = json::parse(GetParam().form);
  const Spectrum shape = surface(read(file), "panel").exitance;
  const Spectrum expected = spectra::scaled_to_luminous(GetParam().expected(), 4000 / 0.72);
  EXPECT_TRUE(shape.values.isApprox(expected.values, 1e-12)) << shape.values.transpose();
}

Spectrum transport(const spectra::Samples& samples) {
  return spectra::light_on(kTransportGrid, samples);
}

INSTANTIATE_TEST_SUITE_P(
    RoomJson, EverySpectrum,
    testing::Values(
        SpectrumForm{"illuminant", R"({"illuminant": "D65"})",
                     [] { return transport(spectra::illuminant("D65")); }},
        SpectrumForm{"planck", R"({"planck_K": 2856})",
                     [] { return transport(spectra::planck(2856)); }},
        SpectrumForm{"daylight", R"({"daylight_K": 5000})",
                     [] { return transport(spectra::daylight(5000)); }},
        SpectrumForm{"lamp", R"({"lamp": "houser:12"})",
                     [] { return transport(spectra::lamps("houser").entries[11].samples); }},
        SpectrumForm{"box", R"({"box": {"kind": "LED", "cct_K": 2700, "ra": 90}})",
                     [] { return transport(spectra::lamps("houser").entries[142].samples); }},
        SpectrumForm{"preset", R"({"preset": "studio tungsten"})",
                     [] { return transport(spectra::planck(3200)); }},
        SpectrumForm{"samples", R"({"nm": [400, 500, 700], "values": [1, 2, 4]})",
                     [] {
                       return transport({{400, 500, 700}, {1, 2, 4}});
                     }},
        SpectrumForm{"file", R"({"file": "lamps.csv", "name": "odd, one"})",
                     [] {
                       return transport({{390, 550, 710}, {3, 1, 2}});
                     }}),
    [](const auto& form) { return form.param.name; });

class EveryReflectance : public testing::TestWithParam<SpectrumForm> {};

TEST_P(EveryReflectance, HasTheValuesOfItsSource) {
  json file = sample_room();
  file["surfaces"]["floor"] = json::parse(GetParam().form);
  const Spectrum floor = surface(read(file), "floor").reflectance;
  EXPECT_TRUE(floor.values.isApprox(GetParam().expected().values, 1e-14))
      << floor.values.transpose();
}

INSTANTIATE_TEST_SUITE_P(
    RoomJson, EveryReflectance,
    testing::Values(
        SpectrumForm{"number", "0.3", [] { return spectra::constant(kTransportGrid, 0.3); }},
        SpectrumForm{"zero", "0", [] { return spectra::constant(kTransportGrid, 0); }},
        SpectrumForm{"samples", R"({"nm": [400, 700], "values": [0.1, 0.4]})",
                     [] {
                       Spectrum line = spectra::constant(kTransportGrid, 0);
                       for (int k = 0; k < 31; ++k) line.values[k] = 0.1 + 0.01 * k;
                       return line;
                     }},
        SpectrumForm{"paint", R"({"paint": "munsell-nickerson:117"})",
                     [] {
                       const auto& atlas = spectra::atlas("munsell-nickerson");
                       return spectra::reflectance_on(kTransportGrid, atlas.entries[116].samples);
                     }},
        SpectrumForm{"file", R"({"file": "paints.csv", "name": "b"})",
                     [] { return spectra::constant(kTransportGrid, 0.25); }},
        SpectrumForm{"reconstruct_srgb", R"({"reconstruct_srgb": [0.8, 0.5, 0.4]})",
                     [] { return spectra::reconstruct_srgb(0.8, 0.5, 0.4).reflectance; }}),
    [](const auto& form) { return form.param.name; });

/// Files that the two suites above refer to, relative to the room file.
class CurveFiles : public testing::Environment {
 public:
  void SetUp() override {
    write_file("lamps.csv", "name,390,550,710\n\"odd, one\",3,1,2\nother,1,1,1\n");
    write_file("paints.csv", "name,400,700\na,80,90\nb,25,25\n");
  }
};

const auto* const kCurveFiles = testing::AddGlobalTestEnvironment(new CurveFiles);

TEST(RoomJson, SurfacesComeInTheirOrder) {
  std::vector<std::string> names;
  for (const Surface& s : read(sample_room()).surfaces) names.push_back(s.name);
  EXPECT_THAT(names, ElementsAre("floor", "ceiling", "south", "east", "north", "west", "window",
                                 "panel", "desk"));
}

TEST(RoomJson, WallsAreOverriddenByName) {
  const Room room = read(sample_room());
  EXPECT_EQ(surface(room, "south").reflectance.values[0], 0.5);
  EXPECT_EQ(surface(room, "north").reflectance.values[0], 0.6);
}

TEST(RoomJson, LitOpeningsAndPanelsAreBlackUnlessGiven) {
  json file = sample_room();
  EXPECT_EQ(surface(read(file), "window").reflectance.values.maxCoeff(), 0);
  EXPECT_EQ(surface(read(file), "panel").reflectance.values.maxCoeff(), 0);
  file["surfaces"]["window"] = 0.1;
  file["lights"][0]["reflectance"] = 0.7;
  EXPECT_EQ(surface(read(file), "window").reflectance.values.minCoeff(), 0.1);
  EXPECT_EQ(surface(read(file), "panel").reflectance.values.minCoeff(), 0.7);
  file["lights"][0].erase("reflectance");
  file["lights"][0]["panel"]["reflectance"] = 0.6;
  EXPECT_EQ(surface(read(file), "panel").reflectance.values.minCoeff(), 0.6);
}

TEST(RoomJson, NamelessWallsAreNumberedFromOne) {
  json file = sample_room();
  file.erase("wall_names");
  file["openings"][0]["wall"] = "wall_1";
  file["surfaces"].erase("north");
  file["surfaces"]["wall_3"] = 0.6;
  EXPECT_EQ(surface(read(file), "wall_3").reflectance.values[0], 0.6);
}

TEST(RoomJson, GeometryIsTakenAsGiven) {
  const Room room = read(sample_room());
  EXPECT_EQ(room.shell.at(0).outline.at(2), Eigen::Vector3d(5, 4, 0));
  EXPECT_EQ(room.openings.at(0).face, 2);
  EXPECT_EQ(room.openings.at(0).transmittance.values.minCoeff(), 1);
  EXPECT_EQ(room.panels.at(0).face, 1);
  EXPECT_EQ(room.furniture.at(0).parts.at(0).corners.at(6), Eigen::Vector3d(2, 2, 0.75));
  EXPECT_EQ(room.receivers.at(0).normal, Eigen::Vector3d(0, -1, 0));
  EXPECT_EQ(room.view->look_at_m, Eigen::Vector3d(2.5, 4, 1.35));
}

TEST(RoomJson, WhatIsAssumedOrReconstructedIsSaid) {
  json file = sample_room();
  file.erase("patch_m");
  file["surfaces"]["desk"] = {{"reconstruct_srgb", {0.5, 0.4, 0.3}}};
  file["surfaces"]["floor"] = {{"file", "paints.csv"}, {"name", "b"}};
  const Room room = read(file);
  EXPECT_EQ(room.patch_m, 0.25);
  EXPECT_TRUE(surface(room, "desk").reconstructed);
  EXPECT_FALSE(surface(room, "floor").reconstructed);
  EXPECT_THAT(all_notes(room), HasSubstr("patch_m"));
  EXPECT_THAT(all_notes(room), HasSubstr("/surfaces/desk"));
  EXPECT_THAT(all_notes(room), HasSubstr("percent"));
}

TEST(RoomJson, ShortCurvesAreCompletedOnTheClosedFormGridOnly) {
  json file = sample_room();
  file["surfaces"]["floor"] = {{"nm", {420, 700}}, {"values", {0.2, 0.3}}};
  const Room room = read_room(write_file("room.json", file.dump()), spectra::kClosedFormGrid);
  EXPECT_EQ(surface(room, "floor").reflectance.values[0], 0.2);
  EXPECT_THAT(all_notes(room), HasSubstr("/surfaces/floor"));
  EXPECT_EQ(faults_in(file).size(), 1);
}

// What touches does not overlap: walls, the ceiling, another box, the frame of a window.
TEST(RoomJson, FurnitureMayTouch) {
  json file = sample_room();
  file["furniture"] = json::parse(R"([
    { "name": "desk", "box_m": { "min": [0, 1, 0], "max": [1, 2, 0.75] } },
    { "name": "on it", "box_m": { "min": [0, 1, 0.75], "max": [1, 2, 2.7] } },
    { "name": "beside", "box_m": { "min": [1, 1, 0], "max": [2, 2, 1] } },
    { "name": "turned", "box_m": { "min": [3, 2.5, 0], "max": [4, 3.5, 1] }, "rotate_z_deg": 45 }
  ])");
  for (const std::string name : {"on it", "beside", "turned"}) file["surfaces"][name] = 0.5;
  EXPECT_THAT(faults_in(file), testing::IsEmpty());
}

// A square of side 1 turned by 45 degrees reaches 0.707 from its centre; at 0.5 it stood within.
// 2.001 - 2 is a little less than 0.001.
TEST(RoomJson, AMillimetreIsLongEnoughWhereSubtractionRounds) {
  json room = sample_room();
  room["plan_m"] = {{0, 0}, {5, 0}, {5, 4}, {2.001, 4}, {2.0, 4.0}, {0, 4}};
  room["wall_names"] = {"south", "east", "north", "sliver", "northwest", "west"};
  room["furniture"][0]["box_m"] = {{"min", {1, 1, 2}}, {"max", {2, 2, 2.001}}};
  room["view"]["eye_m"] = {2.5, 0.001, 1.2};
  EXPECT_NO_THROW((void)read(room));
  room["plan_m"][3][0] = 2.0009;
  EXPECT_THROW((void)read(room), spectra::InputError);
}

TEST(RoomJson, RotatedFootprintMustFit) {
  json file = sample_room();
  file["furniture"][0]["box_m"] = {{"min", {0, 1, 0}}, {"max", {1, 2, 0.75}}};
  EXPECT_THAT(faults_in(file), testing::IsEmpty());
  file["furniture"][0]["rotate_z_deg"] = 45;
  ASSERT_EQ(faults_in(file).size(), 1);
  EXPECT_EQ(faults_in(file)[0].pointer, "/furniture/0");
}

TEST(RoomJson, ReflexCornerIsOutsideAPanelAndABox) {
  json file = sample_room();
  file["plan_m"] = {{0, 0}, {5, 0}, {5, 2}, {2.2, 2}, {2.2, 4}, {0, 4}};
  file["wall_names"] = {"south", "east", "inner", "in", "north", "west"};
  file["receivers"] = json::array();
  file.erase("view");
  ASSERT_EQ(faults_in(file).size(), 1);  // the panel reaches from x 1.9 to 3.1, y 1.7 to 2.3
  EXPECT_EQ(faults_in(file)[0].pointer, "/lights/0/panel");
  file["lights"][0]["panel"]["center_m"] = {1.6, 2};
  EXPECT_THAT(faults_in(file), testing::IsEmpty());
}

TEST(RoomJson, SunBehindEveryOpeningAddsNothingAndIsSaid) {
  json file = sample_room();
  file["lights"].push_back(json::parse(R"({ "name": "sun",
    "sun": { "azimuth_deg": 10, "altitude_deg": 30 }, "spectrum": { "illuminant": "D55" },
    "illuminance_lx": 1000 })"));
  EXPECT_THAT(all_notes(read(file)), HasSubstr("/lights/2/sun"));
  file["lights"] = json::array({file["lights"][2]});
  file["surfaces"]["window"] = 0.1;
  ASSERT_EQ(faults_in(file).size(), 1);
  EXPECT_THAT(faults_in(file)[0].problem, HasSubstr("behind all openings"));
}

TEST(RoomJson, FiveFaultsAreReportedTogetherInTheOrderOfTheFile) {
  const std::string path = std::string(TEST_DATA) + "/bad/five_faults.json";
  const auto faults = faults_of([&] { (void)read_room(path); });
  ASSERT_EQ(faults.size(), 5);
  for (std::size_t i = 1; i < 5; ++i) EXPECT_LE(faults[i - 1].line, faults[i].line);
}

TEST(RoomJson, EverySampleRoomIsRead) {
  int rooms = 0;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::string(SOURCE_DIR) + "/scenes/rooms")) {
    if (entry.path().extension() != ".json") continue;
    EXPECT_NO_THROW((void)read_room(entry.path())) << entry.path();
    ++rooms;
  }
  EXPECT_GE(rooms, 6);
}

TEST(RoomJson, MissingFileIsAFileError) {
  EXPECT_THROW((void)read_room(testing::TempDir() + "no such room.json"), spectra::FileError);
  EXPECT_THROW((void)read_room(testing::TempDir()), spectra::FileError);
}

}  // namespace
}  // namespace scenes
