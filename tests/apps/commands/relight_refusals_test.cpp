#include <OpenEXR/ImfOutputFile.h>
#include <gmock/gmock.h>

#include <cstring>

#include "tests/apps/relight_fixture.h"
#include "tests/support/hdr_picture.h"

namespace apps::test {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Refused : Relight {
  /// Ends with the code, says `what`, and leaves only the input.
  void expect(int exit_code, const std::string& what, const std::string& options = kLights) const {
    const auto names = names_in(folder.path());
    const ProgramRun run = relight(options);
    EXPECT_EQ(run.exit_code, exit_code) << run.err;
    EXPECT_THAT(run.err, HasSubstr(what));
    EXPECT_EQ(run.out, "");
    EXPECT_EQ(names_in(folder.path()), names);
  }
};

TEST_F(Refused, AMissingFile) { expect(4, "in.exr: cannot be read: No such file"); }

TEST_F(Refused, AFolder) {
  fs::create_directory(in);
  expect(4, "it is a folder");
}

TEST_F(Refused, AnythingThatIsNoOpenExr) {
  write_text(in, "P6 1 1 255 abc");
  expect(3, "in.exr: is no OpenEXR file");
  write_text(in, "");
  expect(3, "in.exr: is empty");
}

TEST_F(Refused, APictureCutOff) {
  const spectra::BilinearSet& set = spectra::bilinear_set("granier-iso");
  support::write_exr(support::hdr_picture(set, kSky), in.string());
  const std::string whole = read_text(in);
  for (const std::size_t kept : {whole.size() - 1, whole.size() / 2, std::size_t{400}}) {
    write_text(in, whole.substr(0, kept));
    expect(3, "in.exr: ");
  }
}

TEST_F(Refused, BytesGoneBad) {
  const spectra::BilinearSet& set = spectra::bilinear_set("granier-iso");
  support::write_exr(support::hdr_picture(set, kSky), in.string());
  std::string bytes = read_text(in);
  for (std::size_t k = bytes.size() / 2; k < bytes.size() / 2 + 64; ++k) bytes[k] ^= 0x55;
  write_text(in, bytes);
  expect(3, "in.exr: ");
}

/// A picture of one chunk, black, whose pixels are cut off by some bytes, as its own size says.
std::string one_chunk(const std::string& path, Imf::Compression compression, int cut) {
  Imf::Header header(64, 1);
  header.compression() = compression;
  for (const char* name : {"R", "G", "B"}) header.channels().insert(name, Imf::Channel(Imf::HALF));
  std::vector<char> black(64 * 2 * 3);
  Imf::FrameBuffer slices;
  for (const char* name : {"R", "G", "B"}) {
    slices.insert(name, Imf::Slice(Imf::HALF, black.data(), 2, 128));
  }
  {
    Imf::OutputFile file(path.c_str(), header);
    file.setFrameBuffer(slices);
    file.writePixels(1);
  }
  std::string bytes = read_text(path);
  // The chunk begins where the only entry of the table of offsets says, 8 bytes before it.
  for (std::size_t at = 0; at + 16 < bytes.size(); ++at) {
    std::int64_t offset = 0;
    std::int32_t size = 0;
    std::memcpy(&offset, &bytes[at], sizeof offset);
    if (offset != static_cast<std::int64_t>(at) + 8) continue;
    std::memcpy(&size, &bytes[at + 12], sizeof size);
    if (at + 16 + static_cast<std::size_t>(size) != bytes.size()) continue;
    size = cut < 0 ? 0 : size - cut;
    std::memcpy(&bytes[at + 12], &size, sizeof size);
    return bytes.substr(0, at + 16 + static_cast<std::size_t>(size));
  }
  return "";
}

TEST_F(Refused, ChunksShorterThanTheirPixels) {
  write_text(in, one_chunk(in.string(), Imf::NO_COMPRESSION, 0));
  EXPECT_EQ(relight(kLights).exit_code, 0);
  fs::remove(out);
  write_text(in, one_chunk(in.string(), Imf::NO_COMPRESSION, 2));
  expect(3, "part 0: lines from 0: it holds 382 bytes, its pixels take 384");
  write_text(in, one_chunk(in.string(), Imf::RLE_COMPRESSION, 2));
  expect(3, "its pixels take 384");
  write_text(in, one_chunk(in.string(), Imf::ZIP_COMPRESSION, -1));
  expect(3, "it cannot be unpacked");
  write_text(in, one_chunk(in.string(), Imf::ZIPS_COMPRESSION, 3));
  expect(3, "it cannot be unpacked");
}

/// A header of some hundred bytes must not take gigabytes.
TEST_F(Refused, PicturesThatTheirFileCannotHold) {
  std::string bytes = one_chunk(in.string(), Imf::NO_COMPRESSION, 0);
  const std::int32_t narrow[]{0, 0, 63, 0}, wide[]{0, 0, (1 << 28) - 1, 0};
  for (std::size_t at = 0;
       (at = bytes.find(std::string(reinterpret_cast<const char*>(narrow), sizeof narrow), at)) !=
       bytes.npos;) {
    std::memcpy(&bytes[at], wide, sizeof wide);
  }
  write_text(in, bytes);
  expect(3, "the picture would take 1610612736 bytes");
}

TEST_F(Refused, PicturesWithoutColours) {
  Imf::Header header(2, 2);
  header.channels().insert("Y", Imf::Channel(Imf::HALF));
  header.channels().insert("Z", Imf::Channel(Imf::FLOAT));
  write_exr(in.string(), header, [](const std::string&, std::size_t) { return 1; });
  expect(3, "there are Y, Z");
}

TEST_F(Refused, WholeNumbers) {
  write_pixels({{1, 2, 3}}, Imf::UINT);
  expect(3, "in.exr: G: holds whole numbers; give half or float");
}

TEST_F(Refused, AnIllConditionedLight) {
  write_pixels({{1, 2, 3}});
  expect(3, "condition number 1.24e+07", "--from 85,4,22 --to 1,1,1");
  expect(3, "condition number inf", "--from 0,1,1 --to 1,1,1 --classical");
}

TEST_F(Refused, ATargetThatCannotBeWritten) {
  write_pixels({{1, 2, 3}});
  fs::create_directory(out);
  expect(4, "out.exr: cannot be written");
}

TEST_F(Refused, ADiskThatIsFull) {
  const spectra::BilinearSet& set = spectra::bilinear_set("granier-iso");
  support::write_exr(support::hdr_picture(set, kSky), in.string());
  const std::string command = "trap '' XFSZ; ulimit -f 40; '" ROOMHUE "' relight " + in.string() +
                              " " + out.string() + kLights + ">/dev/null 2>&1";
  EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 4);
  EXPECT_THAT(names_in(folder.path()), ElementsAre("in.exr"));
}

}  // namespace
}  // namespace apps::test
