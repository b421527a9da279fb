// roomhue picture: its files against each other, and what it refuses.
#include <OpenEXR/ImfStringAttribute.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include <cmath>

#include "appearance/display.h"
#include "appearance/spectra/spectrum.h"
#include "appearance/spectra/tristimulus.h"
#include "tests/apps/exr_files.h"
#include "tests/apps/program.h"

namespace apps::test {
namespace {

using testing::HasSubstr;

constexpr int kWidth = 48, kHeight = 36;

/// One picture of the office from the door, taken once.
const TemporaryFolder& office() {
  static const TemporaryFolder folder;
  static const ProgramRun run = roomhue(
      "picture scenes/rooms/office.json --view door --size 48x36 --bits 16 --threads 1 --out " +
      folder.path().string());
  EXPECT_EQ(run.exit_code, 0) << run.err;
  return folder;
}

struct Exr {
  explicit Exr(const fs::path& path) : file(path.c_str()), header(file.header()) {
    planes = planes_for(header, header.dataWindow());
    file.setFrameBuffer(slices_of(header, header.dataWindow(), planes));
    file.readPixels(0, kHeight - 1);
  }

  [[nodiscard]] double at(const std::string& channel, std::size_t pixel) const {
    return sample(header, planes, channel, pixel);
  }

  Imf::InputFile file;
  Imf::Header header;
  Planes planes;
};

std::string channel_of(int band) { return "S0." + std::to_string(400 + 10 * band) + ",000000nm"; }

/// X, Y, Z in cd m^-2 of a pixel's spectrum.
spectra::Xyz xyz_of(const Exr& exr, std::size_t pixel) {
  spectra::Spectrum radiance = spectra::constant(spectra::kTransportGrid, 0);
  for (int b = 0; b < 31; ++b) radiance.values[b] = exr.at(channel_of(b), pixel);
  return spectra::absolute_xyz(radiance);
}

struct Png {
  explicit Png(const fs::path& path) : bytes(read_text(path)) {
    for (std::size_t at = 8; at + 8 < bytes.size();) {
      const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(bytes[at + k]); };
      const std::size_t size = byte(0) << 24U | byte(1) << 16U | byte(2) << 8U | byte(3);
      chunks[bytes.substr(at + 4, 4)] = bytes.substr(at + 8, size);
      at += 12 + size;
    }
  }

  /// r, g, b as numbers from 0 to 65535, as they stand in a file of 16 bits.
  [[nodiscard]] std::vector<int> samples() const {
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    std::pair<const std::string*, std::size_t> source{&bytes, 0};
    png_set_read_fn(png, &source, [](png_structp p, png_bytep data, std::size_t n) {
      auto& [text, at] =
          *static_cast<std::pair<const std::string*, std::size_t>*>(png_get_io_ptr(p));
      text->copy(reinterpret_cast<char*>(data), n, at);
      at += n;
    });
    png_read_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
    std::vector<int> all;
    for (int y = 0; y < kHeight; ++y) {
      const png_bytep row = png_get_rows(png, info)[y];
      for (int k = 0; k < 3 * kWidth; ++k) all.push_back(row[2 * k] << 8 | row[2 * k + 1]);
    }
    png_destroy_read_struct(&png, &info, nullptr);
    return all;
  }

  std::string bytes;
  std::map<std::string, std::string> chunks;
};

TEST(PictureCommand, SpectralPictureIsInTheLayoutThatItSays) {
  const Exr exr(office() / "room.exr");
  int channels = 0;
  for (auto it = exr.header.channels().begin(); it != exr.header.channels().end(); ++it) ++channels;
  EXPECT_EQ(channels, 34);
  const auto text = [&](const char* name) {
    return exr.header.typedAttribute<Imf::StringAttribute>(name).value();
  };
  EXPECT_EQ(text("spectralLayoutVersion"), "1.0");
  EXPECT_EQ(text("emissiveUnits"), "W.m^-2.sr^-1");
  EXPECT_THAT(text("comments"), HasSubstr("per nm"));
  EXPECT_EQ(text("roomSha256").size(), 64U);
  EXPECT_THAT(text("software"), HasSubstr("roomhue"));
  const std::size_t pixel = 20 * kWidth + 30;
  const spectra::Xyz xyz = xyz_of(exr, pixel);
  const Eigen::Vector3d rgb = appearance::linear_srgb_of({xyz.x, xyz.y, xyz.z});
  EXPECT_NEAR(exr.at("R", pixel), rgb[0], 1e-5 * rgb[0]);
  EXPECT_NEAR(exr.at("B", pixel), rgb[2], 1e-5 * rgb[0]);
}

// Half-way between two samples of 16 bits the floats of the spectra decide: so off by one at most.
TEST(PictureCommand, SeenPictureAndPhotographFollowFromTheSpectraAlone) {
  const Exr exr(office() / "room.exr");
  const nlohmann::json run = read_json(office() / "run.json");
  const auto& view = run.at("viewing");
  const auto& white = view.at("white_XYZ");
  const appearance::ViewingConditions conditions{
      .white = {white[0], white[1], white[2]},
      .adapting_luminance_cd_m2 = view.at("L_A_cd_m2"),
      .background_y = view.at("Y_b"),
      .surround = {view.at("F"), view.at("c"), view.at("N_c")}};
  const appearance::Display display(conditions);
  const double white_cd_m2 = view.at("white_luminance_cd_m2");
  const double exposure = run.at("picture").at("photograph").at("exposure_per_cd_m2");
  EXPECT_NEAR(exposure * view.at("illuminance_lx").get<double>() / M_PI, 0.8, 1e-12);
  const std::vector<int> seen = Png(office() / "seen.png").samples(),
                         photo = Png(office() / "photograph.png").samples();
  for (std::size_t p = 0; p < kWidth * kHeight; ++p) {
    const spectra::Xyz xyz = xyz_of(exr, p);
    const Eigen::Vector3d shown = display.show(spectra::relative_xyz(xyz, white_cd_m2)).srgb;
    const Eigen::Vector3d film = appearance::srgb_encoded(
        appearance::desaturated(exposure * appearance::linear_srgb_of({xyz.x, xyz.y, xyz.z}))
            .linear);
    for (std::size_t c = 0; c < 3; ++c) {
      const auto k = static_cast<Eigen::Index>(c);
      ASSERT_NEAR(seen[3 * p + c], 65535 * shown[k], 1) << "pixel " << p;
      ASSERT_NEAR(photo[3 * p + c], 65535 * film[k], 1) << "pixel " << p;
    }
  }
}

TEST(PictureCommand, PngSaysWhatItsColoursAre) {
  const Png png(office() / "seen.png");
  EXPECT_EQ(png.chunks.at("IHDR")[8], 16);
  EXPECT_EQ(png.chunks.at("sRGB"), std::string(1, '\0'));
  EXPECT_EQ(png.chunks.at("gAMA"), std::string("\0\0\xb1\x8f", 4));  // 45455
  EXPECT_EQ(png.chunks.at("cHRM").size(), 32U);
}

TEST(PictureCommand, LuminanceIsThatOfTheSpectra) {
  const Exr exr(office() / "room.exr"), luminance(office() / "luminance.exr");
  for (std::size_t p = 0; p < kWidth * kHeight; p += 7) {
    const double y = xyz_of(exr, p).y;
    EXPECT_NEAR(luminance.at("Y", p), y, 1e-5 * y);
  }
}

TEST(PictureCommand, ThreadsChangeNoBit) {
  const TemporaryFolder folder;
  const ProgramRun run = roomhue(
      "picture scenes/rooms/office.json --view door --size 48x36 --bits 16 --threads 2 --out " +
      folder.path().string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const char* name :
       {"room.exr", "photograph.png", "seen.png", "illuminance.png", "luminance.exr"}) {
    EXPECT_TRUE(read_text(folder / name) == read_text(office() / name)) << name;
  }
}

TEST(PictureCommand, PaintIsSeenAndHalvesAreNear) {
  const TemporaryFolder folder;
  const ProgramRun run = roomhue(
      "picture scenes/rooms/office.json --view door --size 48x36 --draft --half "
      "--paint south=100 --out " +
      folder.path().string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(read_json(folder / "run.json").at("paints").at("south"), "100");
  const Exr painted(folder / "room.exr"), before(office() / "room.exr");
  EXPECT_EQ(painted.header.channels().findChannel("R")->type, Imf::HALF);
  const std::size_t wall = 8 * kWidth + 5;
  EXPECT_GT(std::abs(painted.at(channel_of(20), wall) / before.at(channel_of(20), wall) - 1), 0.1);
}

// The middle panel is the swatch; the right one is seen.png, the left one the room as it is.
TEST(PictureCommand, BestPaintsAreThoseOfRankAndStandBesideNow) {
  const TemporaryFolder folder, ranked;
  const ProgramRun run = roomhue(
      "picture scenes/rooms/office.json --view door --size 48x36 --draft --bits 16 --best "
      "--contact-sheet 3 --out " +
      folder.path().string());
  ASSERT_EQ(run.exit_code, 0) << run.err;
  ASSERT_EQ(roomhue("rank scenes/rooms/office.json --resolve-top 0 --top 3 --out " +
                    ranked.path().string())
                .exit_code,
            0);
  const auto rows = read_cells(ranked / "ranking.csv");
  const nlohmann::json best = read_json(folder / "run.json").at("best_paints");
  ASSERT_EQ(best.size(), 3U);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(best[k].at("paints")[0], rows[k + 1][1]);
    EXPECT_NEAR(best[k].at("distance").get<double>(), std::stod(rows[k + 1][2]), 1e-9);
  }
  const auto width_of_png = [&](const char* name) {
    const std::string head = Png(folder / name).chunks.at("IHDR");
    return static_cast<unsigned char>(head[2]) << 8 | static_cast<unsigned char>(head[3]);
  };
  EXPECT_EQ(width_of_png("before_after.png"), 48 + 12 + 48 + 4 * 6);
  EXPECT_EQ(width_of_png("contact_sheet.png"), 2 * 48 + 3 * 6);
}

struct Refusal {
  std::string options;
  int exit_code;
  std::string says;
};

class PictureRefusal : public testing::TestWithParam<Refusal> {};

INSTANTIATE_TEST_SUITE_P(
    Options, PictureRefusal,
    testing::Values(
        Refusal{"--size 0x0", 2, "each from 1 to"}, Refusal{"--size 12", 2, "WIDTHxHEIGHT"},
        Refusal{"--size -5x10", 2, "each from 1 to"}, Refusal{"--size 10x10x10", 2, "WIDTHxHEIGHT"},
        Refusal{"--size 900000x900000", 3, "GiB"}, Refusal{"--fov-deg 180", 2, "fov-deg"},
        Refusal{"--fov-deg nan", 2, "fov-deg"}, Refusal{"--best --paint south=100", 2, "excludes"},
        Refusal{"--contact-sheet 0", 2, "contact-sheet"}, Refusal{"--headroom 0.5", 2, "headroom"},
        Refusal{"--bits 12", 2, "bits"},
        Refusal{"--view cellar", 3, "has no view \"cellar\"; take \"door\" or \"shelf\""},
        Refusal{"--paint south=999", 3, "no paint \"999\""},
        Refusal{"--paint roof=100", 3, "paints no group \"roof\"; take \"south\""},
        Refusal{"--paint 100", 3, "is no GROUP=PAINT"},
        Refusal{"--paint roof=1 --paint south=999", 3, "no paint \"999\""}));

TEST_P(PictureRefusal, SaysWhatIsWrongAndWritesNothing) {
  const TemporaryFolder folder;
  const ProgramRun run = roomhue("picture scenes/rooms/office.json --out " +
                                 (folder / "out").string() + " " + GetParam().options);
  EXPECT_EQ(run.exit_code, GetParam().exit_code) << run.err;
  EXPECT_THAT(run.err, HasSubstr(GetParam().says));
  EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(PictureCommand, RefusesEyesInFurnitureAndOutside) {
  const TemporaryFolder folder;
  for (const auto& eye : {nlohmann::json{2, 1.8, 0.5}, nlohmann::json{-1, 2, 1.5}}) {
    nlohmann::json room = read_json(fs::path(SOURCE_DIR) / "scenes/rooms/office.json");
    room["views"]["door"]["eye_m"] = eye;
    write_text(folder / "room.json", room.dump());
    const ProgramRun run = roomhue("picture " + (folder / "room.json").string() +
                                   " --view door --out " + (folder / "out").string());
    EXPECT_EQ(run.exit_code, 3);
    EXPECT_THAT(run.err, HasSubstr("/views/door/eye_m: the eye is outside the room, on a surface "
                                   "or in furniture"));
  }
}

}  // namespace
}  // namespace apps::test
