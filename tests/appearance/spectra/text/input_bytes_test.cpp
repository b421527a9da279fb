#include "appearance/spectra/text/input_bytes.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "appearance/spectra/text/input_error.h"

namespace spectra {
namespace {

using testing::HasSubstr;

class ReadInput : public testing::Test {
 protected:
  ReadInput() {
    std::string name = testing::TempDir() + "roomhue-XXXXXX";
    folder_ = ::mkdtemp(name.data());
  }

  ~ReadInput() override { std::filesystem::remove_all(folder_); }

  static std::string refusal(const std::string& path) {
    try {
      (void)read_input(path, 100, "shorten it");
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  }

  std::string folder_;
};

TEST_F(ReadInput, GivesAllBytes) {
  const std::string bytes("a\0b\r\n\xff", 6);
  std::ofstream(folder_ + "/file", std::ios::binary) << bytes;
  std::filesystem::create_symlink("file", folder_ + "/link");
  EXPECT_EQ(read_input(folder_ + "/file", 100, ""), bytes);
  EXPECT_EQ(read_input(folder_ + "/link", 6, ""), bytes);
  try {
    (void)read_input(folder_ + "/file", 5, "shorten it");
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_EQ(error.faults().at(0).remedy, "shorten it");
  }
}

// A pipe would be waited for, a device might never end.
TEST_F(ReadInput, RefusesWhatIsNoFile) {
  ASSERT_EQ(::mkfifo((folder_ + "/pipe").c_str(), 0600), 0);
  std::filesystem::create_symlink("b", folder_ + "/a");
  std::filesystem::create_symlink("a", folder_ + "/b");
  EXPECT_THAT(refusal(folder_ + "/pipe"), HasSubstr("a pipe"));
  EXPECT_THAT(refusal(folder_ + "/a"), HasSubstr("in a circle"));
  EXPECT_THAT(refusal(folder_), HasSubstr("a folder"));
  EXPECT_THAT(refusal("/dev/zero"), HasSubstr("a device"));
  EXPECT_THAT(refusal(folder_ + "/nothing"), HasSubstr("no such file"));
}

}  // namespace
}  // namespace spectra
