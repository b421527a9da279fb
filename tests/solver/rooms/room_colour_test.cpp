#include "solver/rooms/room_colour.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <array>

#include "appearance/spectra/photometry.h"
#include "scenes/files/room_json.h"

namespace solver {
namespace {

using Eigen::Vector3d;
using ::testing::HasSubstr;
using ::testing::Throws;
using ::testing::ThrowsMessage;

scenes::Room sample_room(const std::string& name) {
  scenes::Room room =
      scenes::read_room(std::string(SOURCE_DIR) + "/scenes/rooms/" + name + ".json");
  room.patch_m = 0.8;
  return room;
}

/// Every surface keeps its mean reflectance and loses its colour.
scenes::Room grey(scenes::Room room) {
  for (scenes::Surface& s : room.surfaces) {
    s.reflectance.values.setConstant(s.reflectance.values.mean());
  }
  return room;
}

Vector3d vector(const spectra::Xyz& xyz) { return {xyz.x, xyz.y, xyz.z}; }

constexpr std::array kModels{
    "rgb",     "rgb:bt2020",     "bilinear",        "bilinear:srgb", "bilinear:iso:alpha=0.1,0,1",
    "display", "display:acescg", "display:diagonal"};

bool agree(const spectra::Xyz& xyz, const spectra::Spectrum& light) {
  const Vector3d exact = vector(spectra::absolute_xyz(light));
  return (vector(xyz) - exact).norm() < 1e-9 * exact.norm();
}

void expect_projection(const scenes::Room& room, const RoomTransport& t,
                       const RoomSolution& spectral, const ColourSolution& three) {
  ASSERT_TRUE(three.light.radiosity.converged);
  for (std::size_t k = 0; k < spectral.receivers.size(); ++k) {
    const Vector3d xyz =
        three.xyz_from_rgb * Vector3d(three.light.receivers[k].irradiance.matrix());
    EXPECT_TRUE(agree({.x = xyz[0], .y = xyz[1], .z = xyz[2]},
                      {.grid = room.grid, .values = spectral.receivers[k].irradiance}));
  }
  const spectra::ViewedLight seen = viewed_light(room, t, spectral);
  const ViewedColours colours = viewed_colours(room, t, three);
  EXPECT_TRUE(agree(colours.sample, seen.sample));
  EXPECT_TRUE(agree(colours.background, seen.background));
  EXPECT_TRUE(agree(colours.field, seen.field));
  EXPECT_TRUE(agree(colours.white, seen.white));
}

// Grey surfaces scale light: three numbers are then enough, and every model is the projection of
// the spectral solution; to 2e-10 for the printed set, whose digits end there. The second room has
// a sun.
TEST(SolveRoomColour, IsTheProjectionOfTheSpectralSolutionInAGreyRoom) {
  for (const char* name : {"box", "l_room"}) {
    const scenes::Room room = grey(sample_room(name));
    ASSERT_FALSE(room.receivers.empty());
    const RoomTransport t = prepare_transport(room);
    const RadiosityOptions options{.relative_error = 1e-11};
    const RoomSolution spectral = solve_room(room, t, options);
    for (const char* model : kModels) {
      SCOPED_TRACE(fmt::format("{} {}", name, model));
      expect_projection(room, t, spectral,
                        solve_room_colour(room, t, colour_model(model), options));
    }
  }
}

TEST(SolveRoomColour, KeepsTheEnergyOfAColouredRoom) {
  const scenes::Room room = sample_room("office");
  const RoomTransport t = prepare_transport(room);
  for (const char* model : kModels) {
    SCOPED_TRACE(model);
    const ColourSolution solution =
        solve_room_colour(room, t, colour_model(model), {.relative_error = 1e-8});
    EXPECT_TRUE(solution.light.radiosity.converged);
    EXPECT_FALSE(solution.light.radiosity.proven);  // with linear light estimated
    EXPECT_LT(solution.light.energy.relative_defect, 1e-7);
  }
}

// Light of the space's white, once reflected, has the colour of the surface; matrices that were
// fitted to other lights are not among these.
TEST(ColourModel, ReflectsWhiteAsTheSpectrumDoes) {
  for (const char* name : {"rgb", "rgb:bt2020", "bilinear", "bilinear:srgb",
                           "bilinear:iso:alpha=0.1,0,1", "display:diagonal"}) {
    const ColourModel model = colour_model(name);
    const spectra::Spectrum white = spectra::light_on(spectra::kTransportGrid, model.space.white);
    for (const scenes::Surface& s : sample_room("box").surfaces) {
      const spectra::Spectrum reflected{.grid = white.grid,
                                        .values = white.values * s.reflectance.values};
      const Vector3d exact = spectra::rgb_of_light(model.space, reflected);
      const Vector3d product =
          model.reflection(s.reflectance) * spectra::rgb_of_light(model.space, white);
      EXPECT_LT((product - exact).norm(), 1e-9 * spectra::luminous(white)) << name << s.name;
    }
  }
}

TEST(SolveRoomColour, KeepsComponentsApartWhereTheModelDoes) {
  const scenes::Room room = sample_room("box");
  const RoomTransport t = prepare_transport(room);
  EXPECT_EQ(solve_room_colour(room, t, colour_model("rgb")).light.radiosity.method,
            Method::conjugate_gradients);
  EXPECT_EQ(solve_room_colour(room, t, colour_model("bilinear")).light.radiosity.method,
            Method::bicgstab);
}

TEST(SolveRoomColour, SameBitsForOneAndTwoThreads) {
  const scenes::Room room = sample_room("office");
  const auto run = [&](int threads) {
    set_threads(threads);
    return solve_room_colour(room, prepare_transport(room), colour_model("bilinear"));
  };
  const ColourSolution one = run(1), two = run(2);
  EXPECT_TRUE((one.light.radiosity.radiosity == two.light.radiosity.radiosity).all());
}

// Light of 500 nm lies outside sRGB: its red is negative, and stays so.
TEST(SolveRoomColour, CountsNegativeLightAndKeepsIt) {
  scenes::Room room = sample_room("box");
  scenes::Surface& lamp = room.surfaces.back();
  lamp.exitance.values.setZero();
  lamp.exitance.values[10] = 1;
  const ColourSolution solution =
      solve_room_colour(room, prepare_transport(room), colour_model("rgb"));
  const Bands irradiance =
      solution.light.radiosity.irradiance.topRows(prepare_transport(room).mesh.size());
  EXPECT_EQ(solution.negative.irradiance, irradiance.rows());
  EXPECT_LT(solution.negative.lowest, 0);
  EXPECT_LT(irradiance.col(0).maxCoeff(), 0);
  const ColourSolution bright = solve_room_colour(
      sample_room("box"), prepare_transport(sample_room("box")), colour_model("rgb"));
  EXPECT_EQ(bright.negative.irradiance + bright.negative.radiosity, 0);
  EXPECT_EQ(bright.negative.lowest, 0);
}

TEST(ColourModel, NamesAreCompletedByDefaults) {
  EXPECT_EQ(colour_model("rgb").name, "rgb:srgb");
  EXPECT_EQ(colour_model("bilinear").name, "bilinear:granier-iso");
  EXPECT_EQ(colour_model("bilinear:iso:alpha=0,0,1").name, "bilinear:iso:alpha=0,0,1");
  EXPECT_EQ(colour_model("bilinear::alpha=0,0,1").name, "bilinear:granier-iso:alpha=0,0,1");
  EXPECT_EQ(colour_model("display").name, "display:spectral");
}

TEST(ColourModel, RefusesLightLeftInTheReferenceSpace) {
  EXPECT_THAT([] { (void)colour_model("display:reference-light"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("direct light only")));
}

TEST(ColourModel, RefusesUnknownNamesWithTheKnownOnes) {
  EXPECT_THAT([] { (void)colour_model("cmyk"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("bilinear[:SET")));
  EXPECT_THAT([] { (void)colour_model("rgb:cmyk"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("bt2020")));
  EXPECT_THAT([] { (void)colour_model("display:cmyk"); },
              ThrowsMessage<std::invalid_argument>(HasSubstr("diagonal")));
  for (const char* name : {"bilinear:cmyk", "bilinear:iso:beta=0,0,1", "bilinear:iso:alpha=0,0",
                           "bilinear:iso:alpha=0,0,x", "bilinear:iso:alpha=0,0,1,0"}) {
    EXPECT_THAT([&] { (void)colour_model(name); }, Throws<std::invalid_argument>()) << name;
  }
}

}  // namespace
}  // namespace solver
