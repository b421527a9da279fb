#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstring>
#include <random>
#include <sstream>

#include "apps/pictures/bilinear_shader.h"
#include "tests/apps/program.h"

namespace apps::test {
namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;
using ::testing::HasSubstr;
using ::testing::Not;

/// Every line but signature, result and comments is one instruction.
int instructions_in(const std::string& glsl) {
  int count = 0;
  std::istringstream lines(glsl);
  for (std::string line; std::getline(lines, line);) {
    const bool statement = line.starts_with("  ") && line.ends_with(";");
    if (statement && !line.starts_with("  return")) {
      ++count;
      // A vector instruction multiplies once and adds once at most; the value of a vec3 is free.
      const std::string work = line.substr(0, line.find("vec3("));
      EXPECT_LE(std::count(work.begin(), work.end(), '*'), 1) << line;
      EXPECT_LE(std::count(work.begin(), work.end(), '-'), 1) << line;
    }
  }
  return count;
}

// [Granier2004] 7.3 needs 11 instructions more than the classical product; symmetry and coherence
// together leave 6.
TEST(BilinearShader, NeedsSixInstructionsMoreThanTheClassicalProduct) {
  for (const std::string& name : spectra::bilinear_set_names()) {
    const BilinearShader shader = bilinear_shader(spectra::bilinear_set(name));
    EXPECT_EQ(shader.instructions, 7) << name;
    EXPECT_EQ(instructions_in(shader.glsl), 7) << name;
    EXPECT_THAT(shader.glsl, HasSubstr("set " + name + ":"));
  }
}

TEST(BilinearShader, IncoherentSetsTakeThreeMore) {
  spectra::BilinearSet set = spectra::bilinear_set("srgb");
  for (auto& k : set.k) k *= 0.5;
  const BilinearShader shader = bilinear_shader(set);
  EXPECT_EQ(shader.instructions, 10);
  EXPECT_EQ(instructions_in(shader.glsl), 10);
}

TEST(BilinearShader, IsPrintedByTheProgram) {
  const ProgramRun run = roomhue("shader --set srgb --alpha 0,0,1");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto set = spectra::with_alpha(spectra::bilinear_set("srgb"), {0, 0, 1});
  EXPECT_EQ(run.out, bilinear_shader(set).glsl);
  const auto data = nlohmann::json::parse(roomhue("shader --json").out);
  EXPECT_EQ(data["set"], "granier-iso");
  EXPECT_EQ(data["over_classical"], 6);
  EXPECT_EQ(data["glsl"], bilinear_shader(spectra::bilinear_set("granier-iso")).glsl);
}

constexpr int kSide = 64;  // the pairs fill a square picture

struct Pair {
  Vector3f light, reflectance;
};

/// Lights from 0.001 to 1000, reflectances from 0 to 1; some greys, some with a component of 0.
std::vector<Pair> pairs() {
  std::mt19937 draw(5);
  std::uniform_real_distribution<float> unit(0, 1), power(-3, 3);
  std::vector<Pair> all(kSide * kSide);
  for (std::size_t i = 0; i < all.size(); ++i) {
    auto& [light, reflectance] = all[i];
    const float level = std::pow(10.0F, power(draw));
    light = level * Vector3f(unit(draw), unit(draw), unit(draw));
    reflectance = Vector3f(unit(draw), unit(draw), unit(draw));
    if (i % 7 == 0) light = Vector3f::Constant(level);
    if (i % 11 == 0) reflectance[static_cast<int>(i % 3)] = 0;
    if (i % 13 == 0) light[static_cast<int>(i % 3)] = 0;
  }
  return all;
}

/// A list of four numbers per pair, as a texture of floats wants them.
std::string texels(const std::vector<Pair>& all, Vector3f Pair::*colour) {
  std::string text;
  for (const Pair& pair : all) {
    const Vector3f& v = pair.*colour;
    text += fmt::format("{},{},{},0,", v[0], v[1], v[2]);
  }
  return text;
}

/// A page that runs the function on all pairs in one version of WebGL and shows the bits of the
/// results in hexadecimal, or what went wrong.
std::string page(const std::string& glsl, int version, const std::vector<Pair>& all) {
  const std::string vertex =
      version == 1 ? "attribute vec2 at; void main() { gl_Position = vec4(at, 0, 1); }"
                   : "#version 300 es\nin vec2 at;"
                     "void main() { gl_Position = vec4(at, 0, 1); }";
  const std::string head = version == 1 ? "" : "#version 300 es\n";
  const std::string result = version == 1 ? "" : "out vec4 result;\n";
  const std::string fetch = version == 1 ? "texture2D" : "texture";
  const std::string target = version == 1 ? "gl_FragColor" : "result";
  const std::string fragment =
      head + "precision highp float;\nuniform highp sampler2D lights, reflectances;\n" + result +
      glsl + "void main() {\n  vec2 at = gl_FragCoord.xy / " + fmt::format("{}.0", kSide) +
      ";\n  " + target + " = vec4(bilinear(" + fetch + "(lights, at).rgb, " + fetch +
      "(reflectances, at).rgb), 1.0);\n}\n";
  return "<!doctype html><pre id=\"said\">nothing</pre>\n<script>\nconst side = " +
         std::to_string(kSide) + ", version = " + std::to_string(version) + ";\nconst lights = [" +
         texels(all, &Pair::light) + "];\nconst reflectances = [" +
         texels(all, &Pair::reflectance) + "];\nconst vertex = `" + vertex +
         "`;\nconst fragment = `" + fragment + "`;\n" +
         read_text(SOURCE_DIR "/tests/apps/shader_page.js") + "</script>\n";
}

/// What a headless browser shows after running the page, between "results:" and ";".
std::string shown_by_browser(const std::string& html) {
  const TemporaryFolder folder;
  write_text(folder / "page.html", html);
  const std::string browser = fmt::format(
      "timeout 120 chromium-headless-shell --headless --no-sandbox --use-gl=angle "
      "--use-angle=swiftshader --enable-unsafe-swiftshader --disable-quic --no-first-run "
      "--disable-background-networking --disable-component-update --disable-sync "
      "--user-data-dir='{0}/profile' --dump-dom 'file://{0}/page.html' >'{0}/dom' 2>'{0}/said'",
      folder.path().string());
  if (std::system("command -v chromium-headless-shell >/dev/null") != 0) {
    return "no browser: apt-get install chromium-headless-shell";
  }
  const int status = std::system(browser.c_str());
  const std::string dom = read_text(folder / "dom");
  const auto from = dom.find("results:"), to = dom.find(';', from);
  if (status == 0 && to != std::string::npos) return dom.substr(from + 8, to - from - 8);
  return fmt::format("browser status {}: {}\n{}", status, dom.substr(0, dom.find("<script>")),
                     read_text(folder / "said"));
}

struct ShaderCase {
  const char* name;
  int webgl = 1;
  spectra::BilinearSet set;
};

class ShaderInBrowser : public ::testing::TestWithParam<ShaderCase> {};

TEST_P(ShaderInBrowser, AgreesWithTheProductToFloatAccuracy) {
  const auto& [name, webgl, set] = GetParam();
  const std::vector<Pair> all = pairs();
  std::istringstream words(shown_by_browser(page(bilinear_shader(set).glsl, webgl, all)));
  double worst = 0;
  for (const auto& [light, reflectance] : all) {
    Vector3d shaded;
    for (int c = 0; c < 3; ++c) {
      std::uint32_t bits = 0;
      ASSERT_TRUE(words >> std::hex >> bits) << words.str().substr(0, 2000);
      float value = 0;
      std::memcpy(&value, &bits, sizeof(value));
      shaded[c] = static_cast<double>(value);
    }
    if (light == Vector3f::Constant(light[0]) && set.name != "incoherent") {
      const Vector3f classical = light.cwiseProduct(reflectance);
      EXPECT_EQ(shaded.cast<float>(), classical)
          << "white light changes no colour, to the last bit";
    }
    const Vector3d want = spectra::product(set, light.cast<double>(), reflectance.cast<double>());
    const double scale = static_cast<double>(light.maxCoeff() * reflectance.maxCoeff());
    worst = std::max(worst, (shaded - want).cwiseAbs().maxCoeff() / scale);
  }
  // Seven roundings of terms that are at most 2 scale, 6e-8 each.
  EXPECT_LT(worst, 7 * 2 * 6e-8);
  RecordProperty("worst", fmt::format("{:.3g}", worst));
}

spectra::BilinearSet incoherent_set() {
  spectra::BilinearSet set = spectra::bilinear_set("srgb");
  set.name = "incoherent";
  set.k[0] *= 0.5;
  set.k[2] *= 0.75;
  return set;
}

INSTANTIATE_TEST_SUITE_P(
    Sets, ShaderInBrowser,
    ::testing::Values(ShaderCase{"printed_webgl1", 1, spectra::bilinear_set("granier-iso")},
                      ShaderCase{"printed_webgl2", 2, spectra::bilinear_set("granier-iso")},
                      ShaderCase{"acescg_webgl2", 2, spectra::bilinear_set("acescg")},
                      ShaderCase{
                          "all_blue_webgl2", 2,
                          spectra::with_alpha(spectra::bilinear_set("granier-iso"), {0, 0, 1})},
                      ShaderCase{"incoherent_webgl1", 1, incoherent_set()}),
    [](const auto& shader) { return shader.param.name; });

// The test of the test: another product must be told from the right one.
TEST(ShaderInBrowser, AWrongFunctionGivesOtherBits) {
  const std::vector<Pair> all = pairs();
  const std::string classical =
      "vec3 bilinear(vec3 light, vec3 reflectance) { return light * reflectance; }\n";
  const std::string right = bilinear_shader(spectra::bilinear_set("granier-iso")).glsl;
  const std::string said = shown_by_browser(page(classical, 2, all));
  EXPECT_EQ(std::count(said.begin(), said.end(), ' '), 3 * kSide * kSide);
  EXPECT_NE(said, shown_by_browser(page(right, 2, all)));
}

}  // namespace
}  // namespace apps::test
