#include <OpenEXR/ImfDeepFrameBuffer.h>
#include <OpenEXR/ImfDeepScanLineInputPart.h>
#include <OpenEXR/ImfDeepScanLineOutputPart.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStandardAttributes.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gmock/gmock.h>

#include <cmath>

#include "appearance/spectra/relighting.h"
#include "tests/apps/relight_fixture.h"
#include "tests/support/hdr_picture.h"

namespace apps::test {
namespace {

using Eigen::Vector3d;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

Vector3d pixel(const ReadExr& picture, std::size_t k, std::size_t level = 0) {
  const auto at = [&](const char* channel) {
    return sample(picture.header, picture.levels[level], channel, k);
  };
  return {at("R"), at("G"), at("B")};
}

// The picture is made of known reflectances, so that what it must become is known too.
TEST_F(Relight, TheProjectsPictureBecomesThatOfTheOtherLight) {
  const spectra::BilinearSet& set = spectra::bilinear_set("granier-iso");
  support::write_exr(support::hdr_picture(set, kSky), in.string());
  ASSERT_EQ(relight().exit_code, 0);
  const support::HdrPicture wanted = support::hdr_picture(set, kYellow);
  const ReadExr relit = read_exr(out.string());
  double range = 0;
  for (std::size_t k = 0; k < wanted.alpha.size(); ++k) {
    const Vector3d want{wanted.rgb[0][k], wanted.rgb[1][k], wanted.rgb[2][k]};
    // Halves have 11 bits: 5e-4 of the pixel on the way in, times up to 3 by the change of light.
    EXPECT_LT((pixel(relit, k) - want).cwiseAbs().maxCoeff(), 2e-3 * want.cwiseAbs().maxCoeff());
    range = std::max(range, want.maxCoeff() / wanted.rgb[1].back());
  }
  EXPECT_GT(range, 100);
}

// Lights of [Granier2004] 7.2; the values are those of tests/appearance/spectra/relighting_test.
TEST_F(Relight, FloatsAgreeWithTheProductToFloatAccuracy) {
  write_pixels({{0.2, 0.2, 0.2}, {0.4, 0.9, 1.0}, {0.6, 0.1, 0.1}, {0, 0, 0}});
  const std::vector<Vector3d> bilinear{
      {0.3952010889440369, 0.20913416734351092, 0.01681264185754162},
      {1, 0.9, 0.1},
      {0.9843925718314916, 0.14757534079528525, -0.0017220878546574565},
      {0, 0, 0}};
  const std::vector<Vector3d> classical{
      {0.5, 0.2, 0.02}, {1, 0.9, 0.1}, {1.5, 0.1, 0.01}, {0, 0, 0}};
  for (const bool is_classical : {false, true}) {
    ASSERT_EQ(relight(kLights + (is_classical ? "--classical" : "--set granier-iso")).exit_code, 0);
    const ReadExr relit = read_exr(out.string());
    for (std::size_t k = 0; k < bilinear.size(); ++k) {
      const Vector3d& want = is_classical ? classical[k] : bilinear[k];
      EXPECT_LT((pixel(relit, k) - want).cwiseAbs().maxCoeff(), 5e-7) << k;  // a few ulp of 1
    }
  }
}

struct Format {
  const char* name;
  Imf::PixelType rgb = Imf::HALF;
  Imf::Compression compression = Imf::ZIP_COMPRESSION;
  Imf::LineOrder order = Imf::INCREASING_Y;
  bool tiled = false;
  Imf::LevelMode levels = Imf::ONE_LEVEL;
};

class Formats : public Relight, public ::testing::WithParamInterface<Format> {};

/// Odd sizes, a window away from the origin, channels of every type, an attribute of its own.
Imf::Header header_of(const Format& format) {
  const Imath::Box2i window({-7, 5}, {93, 71});
  Imf::Header header(Imath::Box2i({0, 0}, {99, 99}), window);
  header.compression() = format.compression;
  header.lineOrder() = format.order;
  header.insert("owner", Imf::StringAttribute("nobody"));
  Imf::addWhiteLuminance(header, 80);
  for (const char* name : {"R", "G", "B"}) {
    header.channels().insert(name, Imf::Channel(format.rgb));
  }
  header.channels().insert("A", Imf::Channel(Imf::HALF));
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  header.channels().insert("id", Imf::Channel(Imf::UINT));
  header.channels().insert("glow.R", Imf::Channel(Imf::HALF));
  if (format.tiled) header.setTileDescription(Imf::TileDescription(32, 24, format.levels));
  return header;
}

TEST_P(Formats, OnlyColoursChange) {
  const Imf::Header header = header_of(GetParam());
  write_exr(in.string(), header, [](const std::string& channel, std::size_t k) {
    return static_cast<double>((k * 37 + channel.size() * 11 + channel[0]) % 255) / 32;
  });
  ASSERT_EQ(relight("--from 0.4,0.9,1.0 --to 1.0,0.9,0.5").exit_code, 0);
  const ReadExr before = read_exr(in.string()), after = read_exr(out.string());

  for (auto it = before.header.begin(); it != before.header.end(); ++it) {
    ASSERT_TRUE(after.header.find(it.name()) != after.header.end()) << it.name();
  }
  EXPECT_TRUE(after.header.channels() == before.header.channels());
  EXPECT_EQ(after.header.dataWindow(), before.header.dataWindow());
  EXPECT_EQ(after.header.displayWindow(), before.header.displayWindow());
  EXPECT_EQ(after.header.compression(), before.header.compression());
  EXPECT_EQ(after.header.lineOrder(), before.header.lineOrder());
  EXPECT_EQ(after.header.hasTileDescription(), before.header.hasTileDescription());
  EXPECT_EQ(after.header.typedAttribute<Imf::StringAttribute>("owner").value(), "nobody");
  EXPECT_EQ(Imf::whiteLuminance(after.header), 80);

  const Eigen::Matrix3d m =
      spectra::relighting_matrix(spectra::bilinear_set("granier-iso"), kSky, {1, 0.9, 0.5});
  const double accuracy = GetParam().rgb == Imf::HALF ? 5e-4 : 5e-7;  // roundings of 8 and below
  ASSERT_EQ(after.levels.size(), before.levels.size());
  for (std::size_t level = 0; level < before.levels.size(); ++level) {
    for (const char* name : {"A", "Z", "id", "glow.R"}) {
      EXPECT_EQ(after.levels[level].at(name), before.levels[level].at(name)) << name;
    }
    const std::size_t pixels = before.levels[level].at("A").size() / 2;
    for (std::size_t k = 0; k < pixels; ++k) {
      const Vector3d want = m * pixel(before, k, level);
      ASSERT_LT((pixel(after, k, level) - want).cwiseAbs().maxCoeff(),
                accuracy * std::max(1.0, 3 * want.cwiseAbs().maxCoeff()))
          << level << ' ' << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Relight, Formats,
    ::testing::Values(Format{.name = "half_zip"}, Format{.name = "float_zip", .rgb = Imf::FLOAT},
                      Format{.name = "half_piz", .compression = Imf::PIZ_COMPRESSION},
                      Format{.name = "plain_from_below",
                             .compression = Imf::NO_COMPRESSION,
                             .order = Imf::DECREASING_Y},
                      Format{.name = "tiles", .tiled = true},
                      Format{.name = "float_tiles_from_below",
                             .rgb = Imf::FLOAT,
                             .order = Imf::DECREASING_Y,
                             .tiled = true},
                      Format{.name = "mipmap", .tiled = true, .levels = Imf::MIPMAP_LEVELS},
                      Format{.name = "ripmap",
                             .order = Imf::RANDOM_Y,
                             .tiled = true,
                             .levels = Imf::RIPMAP_LEVELS}),
    [](const auto& format) { return format.param.name; });

// 2.9 million pixels of 6 bytes do not fit into the 16 MiB that are held at a time.
TEST_F(Relight, APictureLargerThanOneBlockHasTheSameBytesForOneAndTwoThreads) {
  Imf::Header header(1024, 2816);
  header.compression() = Imf::NO_COMPRESSION;
  for (const char* name : {"R", "G", "B"}) header.channels().insert(name, Imf::Channel(Imf::HALF));
  write_exr(in.string(), header,
            [](const std::string&, std::size_t k) { return static_cast<double>(k % 1021) / 16; });
  ASSERT_EQ(relight(kLights + "--threads 1").exit_code, 0);
  const std::string one = read_text(out);
  const ProgramRun run = relight(kLights + "--threads 2 --json");
  EXPECT_TRUE(one == read_text(out));
  // Greys: r = k, (g, b) = k too; the last pixel proves that the last block was relit.
  const ReadExr relit = read_exr(out.string());
  const std::size_t last = 1024 * 2816 - 1;
  const double grey = static_cast<double>(last % 1021) / 16;
  EXPECT_NEAR(pixel(relit, last)[0], grey * 0.3952010889440369 / 0.2, 5e-4 * 2 * grey);
  const auto data = nlohmann::json::parse(run.out);
  EXPECT_EQ(data["pixels"], 1024 * 2816);
  EXPECT_NEAR(data["channels"][1]["before"]["mean"].get<double>(), 510.0 / 16, 0.01);
}

TEST_F(Relight, NegativePixelsAreCountedAndNotClamped) {
  write_pixels({{0.6, 0.1, 0.1}, {0.2, 0.2, 0.2}, {0.6, 0.1, 0.1}, {0.1, 0.1, 0.6}});
  const ProgramRun run = relight(kLights + "--json");
  ASSERT_EQ(run.exit_code, 0);
  const auto data = nlohmann::json::parse(run.out);
  EXPECT_EQ(data["negative"]["pixels"], 2);
  EXPECT_EQ(data["negative"]["share"], 0.5);
  EXPECT_EQ(data["channels"][2]["after"]["negative"], 2);
  EXPECT_NEAR(data["channels"][2]["after"]["min"].get<double>(), -0.00172208785, 1e-7);
  EXPECT_EQ(data["channels"][0]["after"]["negative"], 0);
  EXPECT_LT(pixel(read_exr(out.string()), 0)[2], 0);
  EXPECT_THAT(relight().out, HasSubstr("2 of them with a negative component (50 %)"));
}

TEST_F(Relight, PixelsThatAreNoNumbersAreCountedAndStay) {
  const double inf = INFINITY;
  write_pixels({{0.2, 0.2, 0.2}, {NAN, 0.5, 1}, {inf, 2, 3}, {1, 2, -inf}, {0.2, 0.2, 0.2}});
  const ProgramRun run = relight(kLights + "--json");
  ASSERT_EQ(run.exit_code, 0);
  const auto data = nlohmann::json::parse(run.out);
  EXPECT_EQ(data["not_finite"], 3);
  EXPECT_EQ(data["overflowed"], 0);
  EXPECT_NEAR(data["channels"][0]["before"]["mean"].get<double>(), 0.2, 1e-7);
  EXPECT_NEAR(data["channels"][0]["after"]["max"].get<double>(), 0.39520109, 1e-7);
  const ReadExr relit = read_exr(out.string());
  EXPECT_TRUE(std::isnan(pixel(relit, 1)[0]));
  EXPECT_EQ(pixel(relit, 1)[1], 0.5);
  EXPECT_EQ(pixel(relit, 2), Vector3d(inf, 2, 3));
  EXPECT_EQ(pixel(relit, 3), Vector3d(1, 2, -inf));
  EXPECT_NEAR(pixel(relit, 4)[0], 0.39520109, 1e-7);
  EXPECT_THAT(relight().out, HasSubstr("3 pixels are no finite numbers"));
}

TEST_F(Relight, PixelsTooBrightForHalfAreCounted) {
  write_pixels({{60000, 60000, 60000}, {1, 1, 1}}, Imf::HALF);  // 2.5 times as red: 150000
  const ProgramRun run = relight(kLights + "--classical");
  EXPECT_THAT(run.out, HasSubstr("1 pixels are too bright"));
  EXPECT_TRUE(std::isinf(pixel(read_exr(out.string()), 0)[0]));
}

TEST_F(Relight, InPlaceGivesTheSameFile) {
  write_pixels({{0.6, 0.1, 0.1}, {0.2, 0.2, 0.2}});
  ASSERT_EQ(relight().exit_code, 0);
  ASSERT_EQ(roomhue("relight " + in.string() + " " + in.string() + kLights).exit_code, 0);
  EXPECT_TRUE(read_text(in) == read_text(out));
  EXPECT_THAT(names_in(folder.path()), ElementsAre("in.exr", "out.exr"));
}

/// Of the only pixel of a deep part with a channel Z.
Imf::DeepFrameBuffer deep_slices(unsigned int& count, float*& samples) {
  Imf::DeepFrameBuffer slices;
  slices.insertSampleCountSlice(
      Imf::Slice(Imf::UINT, reinterpret_cast<char*>(&count), sizeof(count), sizeof(count)));
  slices.insert("Z", Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(&samples), sizeof(float*),
                                    sizeof(float*), sizeof(float)));
  return slices;
}

/// A flat part named "beauty" and a deep one, "smoke", of two samples in its only pixel.
void write_parts(const std::string& path) {
  std::vector<Imf::Header> headers(2, Imf::Header(1, 1));
  headers[0].setName("beauty");
  headers[0].setType(Imf::SCANLINEIMAGE);
  for (const char* name : {"R", "G", "B"}) {
    headers[0].channels().insert(name, Imf::Channel(Imf::FLOAT));
  }
  headers[1].setName("smoke");
  headers[1].setType(Imf::DEEPSCANLINE);
  headers[1].compression() = Imf::ZIPS_COMPRESSION;
  headers[1].channels().insert("Z", Imf::Channel(Imf::FLOAT));
  Imf::MultiPartOutputFile file(path.c_str(), headers.data(), 2);

  Planes planes = painted(headers[0], headers[0].dataWindow(),
                          [](const std::string&, std::size_t) { return 0.2; });
  Imf::OutputPart flat(file, 0);
  flat.setFrameBuffer(slices_of(headers[0], headers[0].dataWindow(), planes));
  flat.writePixels();

  unsigned int count = 2;
  std::array<float, 2> depths{1.5F, 2.5F};
  float* samples = depths.data();
  Imf::DeepScanLineOutputPart deep(file, 1);
  deep.setFrameBuffer(deep_slices(count, samples));
  deep.writePixels(1);
}

TEST_F(Relight, PartsWithoutColoursAreCopied) {
  write_parts(in.string());
  const ProgramRun run = relight(kLights + "--json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("smoke is copied as it is"));
  const auto data = nlohmann::json::parse(run.out);
  EXPECT_EQ(data["parts"][0]["relit"], true);
  EXPECT_EQ(data["parts"][1]["relit"], false);

  Imf::MultiPartInputFile file(out.c_str());
  ASSERT_EQ(file.parts(), 2);
  Imf::InputPart flat(file, 0);
  Planes planes = planes_for(flat.header(), flat.header().dataWindow());
  flat.setFrameBuffer(slices_of(flat.header(), flat.header().dataWindow(), planes));
  flat.readPixels(0);
  EXPECT_NEAR(sample(flat.header(), planes, "R", 0), 0.39520109, 1e-7);

  Imf::DeepScanLineInputPart deep(file, 1);
  unsigned int count = 0;
  std::array<float, 2> depths{};
  float* samples = depths.data();
  deep.setFrameBuffer(deep_slices(count, samples));
  deep.readPixelSampleCounts(0);
  deep.readPixels(0);
  EXPECT_EQ(count, 2U);
  EXPECT_EQ(depths, (std::array{1.5F, 2.5F}));
}

}  // namespace
}  // namespace apps::test
