#include "scenes/models/honeybee_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/models/room_draft.h"
#include "scenes/shapes/close_shell.h"
#include "tests/scenes/room_files.h"
#include "tests/scenes/shapes/volumes.h"

namespace scenes {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::SizeIs;

json polygon(const json& corners) { return {{"type", "Face3D"}, {"boundary", corners}}; }

json face(const std::string& name, const char* kind, const json& corners,
          const json& boundary = {{"type", "Outdoors"}}) {
  return {{"type", "Face"},
          {"identifier", name},
          {"face_type", kind},
          {"geometry", polygon(corners)},
          {"boundary_condition", boundary},
          {"properties", {{"radiance", json::object()}}}};
}

/// A box from (x, 0, 0) to (x + 4, 3, 2.5), normals out of it.
json box_room(const std::string& id, double x) {
  const double w = x + 4;
  return {{"type", "Room"},
          {"identifier", id},
          {"properties", json::object()},
          {"faces",
           {face(id + "_floor", "Floor", {{x, 0, 0}, {x, 3, 0}, {w, 3, 0}, {w, 0, 0}},
                 {{"type", "Ground"}}),
            face(id + "_roof", "RoofCeiling", {{x, 0, 2.5}, {w, 0, 2.5}, {w, 3, 2.5}, {x, 3, 2.5}}),
            face(id + "_south", "Wall", {{x, 0, 0}, {w, 0, 0}, {w, 0, 2.5}, {x, 0, 2.5}}),
            face(id + "_east", "Wall", {{w, 0, 0}, {w, 3, 0}, {w, 3, 2.5}, {w, 0, 2.5}}),
            face(id + "_north", "Wall", {{w, 3, 0}, {x, 3, 0}, {x, 3, 2.5}, {w, 3, 2.5}}),
            face(id + "_west", "Wall", {{x, 3, 0}, {x, 0, 0}, {x, 0, 2.5}, {x, 3, 2.5}})}}};
}

/// Two rooms side by side, the first with a window.
json sample_model() {
  json model{{"type", "Model"},
             {"identifier", "house"},
             {"units", "Meters"},
             {"properties", {{"radiance", json::object()}}},
             {"rooms", {box_room("a", 0), box_room("b", 4)}}};
  json window = face("window", "Wall", {{1, 0, 1}, {3, 0, 1}, {3, 0, 2}, {1, 0, 2}});
  window["type"] = "Aperture";
  window.erase("face_type");
  model["rooms"][0]["faces"][2]["apertures"].push_back(window);
  return model;
}

BuildingModel model_of(const json& text) {
  return read_honeybee(write_file("model.hbjson", text.dump(1)));
}

std::vector<ShellFace> shell_of(const RoomDraft& draft) {
  std::vector<ShellFace> shell;
  for (const RoomDraft::Face& f : draft.faces) {
    shell.push_back({.frame = {}, .outline = f.outline, .holes = f.holes});
  }
  return shell;
}

double finish(const RoomDraft& draft, const std::string& name) {
  const auto surface = std::ranges::find(draft.surfaces, name, &RoomDraft::Finish::name);
  return surface == draft.surfaces.end() ? NAN : surface->finish.reflectance[0];
}

TEST(Honeybee, RoomIsClosedWithItsVolumeAndWindow) {
  const RoomDraft draft = draft_room(model_of(sample_model()), {"a"});
  std::vector<ShellFace> shell = shell_of(draft);
  EXPECT_TRUE(close_shell(shell).empty());
  EXPECT_NEAR(volume_within(shell), 4 * 3 * 2.5, 1e-12);
  ASSERT_THAT(draft.openings, SizeIs(1));
  EXPECT_NEAR(vector_area_m2(draft.openings[0].outline).norm(), 2, 1e-12);
  EXPECT_TRUE(draft.openings[0].lit);
  EXPECT_NEAR(draft.openings[0].finish.transmittance, 0.64, 1e-12);
  EXPECT_EQ(finish(draft, "a_floor"), 0.2);
  EXPECT_EQ(finish(draft, "a_roof"), 0.8);
  EXPECT_EQ(finish(draft, "a_east"), 0.5);
}

TEST(Honeybee, UnitsAreConverted) {
  json model = sample_model();
  model["units"] = "Feet";
  std::vector<ShellFace> shell = shell_of(draft_room(model_of(model), {"b"}));
  EXPECT_TRUE(close_shell(shell).empty());
  EXPECT_NEAR(volume_within(shell), 30 * std::pow(0.3048, 3), 1e-12);
}

// The object's own modifier, else the room's set, else the global one.
TEST(Honeybee, TheNearestModifierHolds) {
  const auto plastic = [](const std::string& name, double r, double specular) {
    return json{{"type", "Plastic"},  {"identifier", name}, {"r_reflectance", r},
                {"g_reflectance", r}, {"b_reflectance", r}, {"specularity", specular},
                {"roughness", 0}};
  };
  json model = sample_model();
  json& radiance = model["properties"]["radiance"];
  radiance["modifiers"] = {plastic("own", 0.31, 0), plastic("of room", 0.41, 0.1)};
  radiance["modifier_sets"].push_back(
      {{"type", "ModifierSetAbridged"},
       {"identifier", "room set"},
       {"wall_set", {{"interior_modifier", nullptr}, {"exterior_modifier", "of room"}}}});
  radiance["global_modifier_set"] = {
      {"type", "ModifierSet"},
      {"identifier", "global"},
      {"floor_set", {{"interior_modifier", plastic("of all", 0.51, 0)}}}};
  model["rooms"][0]["properties"] = {{"radiance", {{"modifier_set", "room set"}}}};
  model["rooms"][0]["faces"][3]["properties"]["radiance"]["modifier"] = "own";
  const RoomDraft draft = draft_room(model_of(model), {"a"});
  EXPECT_EQ(finish(draft, "a_east"), 0.31);
  EXPECT_NEAR(finish(draft, "a_south"), 0.41 * 0.9, 1e-15);  // the rest is mirrored
  EXPECT_EQ(finish(draft, "a_floor"), 0.51);
  EXPECT_EQ(finish(draft, "a_roof"), 0.8);
  EXPECT_THAT(draft.notes, Contains(HasSubstr("mirrored")));
}

// tn = 0.69757618 is the pane that lets 64 % through.
TEST(Honeybee, TransmissivityIsNotTransmittance) {
  json model = sample_model();
  json& radiance = model["properties"]["radiance"];
  radiance["modifiers"].push_back({{"type", "Glass"},
                                   {"identifier", "pane"},
                                   {"r_transmissivity", 0.9584154328610596},
                                   {"g_transmissivity", 0.9584154328610596},
                                   {"b_transmissivity", 0.9584154328610596}});
  model["rooms"][0]["faces"][2]["apertures"][0]["properties"]["radiance"]["modifier"] = "pane";
  const RoomDraft draft = draft_room(model_of(model), {"a"});
  EXPECT_NEAR(draft.openings.at(0).finish.transmittance, 0.88, 1e-6);
}

TEST(Honeybee, RoomsThatAreOpenToEachOtherJoin) {
  json model = sample_model();
  const auto open = [](const char* other) {
    return json{{"type", "Surface"}, {"boundary_condition_objects", {"x", other}}};
  };
  json& east = model["rooms"][0]["faces"][3];
  json& west = model["rooms"][1]["faces"][5];
  east["face_type"] = west["face_type"] = "AirBoundary";
  east["boundary_condition"] = open("b");
  west["boundary_condition"] = open("a");
  const BuildingModel house = model_of(model);
  std::vector<ShellFace> shell = shell_of(draft_room(house, {"a", "b"}));
  EXPECT_TRUE(close_shell(shell).empty());
  EXPECT_NEAR(volume_within(shell), 60, 1e-12);
  EXPECT_THROW((void)draft_room(house, {"a"}), std::invalid_argument);
}

// A glass door between two rooms: one space with a thin wall in it.
TEST(Honeybee, RoomsJoinThroughGlass) {
  json model = sample_model();
  const auto door = [](const char* other, const json& corners) {
    json part = face("glass door", "Wall", corners,
                     {{"type", "Surface"}, {"boundary_condition_objects", {"x", "y", other}}});
    part["type"] = "Aperture";
    return part;
  };
  model["rooms"][0]["faces"][3]["apertures"].push_back(
      door("b", {{4, 1, 0.5}, {4, 2, 0.5}, {4, 2, 2}, {4, 1, 2}}));
  model["rooms"][1]["faces"][5]["apertures"].push_back(
      door("a", {{4, 2, 0.5}, {4, 1, 0.5}, {4, 1, 2}, {4, 2, 2}}));
  const BuildingModel house = model_of(model);
  const RoomDraft draft = draft_room(house, {"a", "b"});
  std::vector<ShellFace> shell = shell_of(draft);
  for (const ShellFault& fault : close_shell(shell)) ADD_FAILURE() << fault.problem;
  EXPECT_THAT(draft.notes, Contains(HasSubstr("taken as open")));
  EXPECT_THAT(draft_room(house, {"a"}).notes, Contains(HasSubstr("taken as black")));
}

TEST(Honeybee, WindowsOfAnyShapeBecomeConvexPieces) {
  json model = sample_model();
  json& window = model["rooms"][0]["faces"][2]["apertures"][0];
  window["geometry"]["holes"].push_back(
      {{1.5, 0, 1.2}, {2.5, 0, 1.2}, {2.5, 0, 1.8}, {1.5, 0, 1.8}});
  window["geometry"]["boundary"] = {{1, 0, 1}, {4.5, 0, 1}, {4.5, 0, 2}, {1, 0, 2}};
  const RoomDraft draft = draft_room(model_of(model), {"a"});
  double area_m2 = 0;
  for (const RoomDraft::Opening& o : draft.openings) area_m2 += vector_area_m2(o.outline).norm();
  EXPECT_NEAR(area_m2, 3 - 0.6, 1e-12);  // what reaches beyond the wall is left out, and said
  EXPECT_THAT(draft.notes, Contains(HasSubstr("0.5 m2 of \"window\"")));
}

TEST(Honeybee, FaultsHaveTheirPlace) {
  const auto first = [](const json& model) {
    const auto faults = faults_of([&] { (void)model_of(model); });
    return faults.empty() ? spectra::Fault{} : faults.front();
  };
  json model = sample_model();
  EXPECT_THAT(first({{"type", "Room"}, {"identifier", "x"}}).problem, HasSubstr("no Honeybee"));
  model["units"] = "Yards";
  EXPECT_EQ(first(model).pointer, "/units");
  model = sample_model();
  model["rooms"][1]["faces"][0]["geometry"]["boundary"][2] = {1, 2};
  EXPECT_EQ(first(model).pointer, "/rooms/1/faces/0/geometry/boundary/2");
  model = sample_model();
  model["rooms"][1]["faces"][4].erase("geometry");
  EXPECT_EQ(first(model).pointer, "/rooms/1/faces/4");
  model = sample_model();
  model["rooms"][0]["faces"][4]["face_type"] = "Door";
  EXPECT_EQ(first(model).pointer, "/rooms/0/faces/4/face_type");
  model = sample_model();
  model["rooms"][0]["faces"] = 3;
  EXPECT_EQ(first(model).pointer, "/rooms/0/faces");
}

TEST(DraftRoom, ListsTheRoomsThereAre) {
  const BuildingModel house = model_of(sample_model());
  for (const std::vector<std::string>& names : {std::vector<std::string>{}, {"c"}}) {
    try {
      (void)draft_room(house, names);
      ADD_FAILURE();
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), HasSubstr("\"a\", \"b\""));
    }
  }
}

// Any value of the file gone wrong is a fault or harmless, never a crash.
TEST(Honeybee, MutatedModelsAreReadOrRefused) {
  const json model = sample_model();
  const json flat = model.flatten();
  int refused = 0;
  for (const auto& [pointer, value] : flat.items()) {
    for (const json& wrong : {json(nullptr), json("x"), json(-1), json::array(), json::object()}) {
      json mutated = model;
      mutated[json::json_pointer(pointer)] = wrong;
      try {
        const RoomDraft draft = draft_room(model_of(mutated), {"a"});
        std::vector<ShellFace> shell = shell_of(draft);
        (void)shell;
      } catch (const spectra::InputError&) {
        ++refused;
      } catch (const std::invalid_argument&) {
        ++refused;
      }
    }
  }
  EXPECT_GT(refused, 300);
}

}  // namespace
}  // namespace scenes
