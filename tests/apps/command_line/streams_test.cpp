// What nobody can hear must not stop the work, and data that nobody gets must not count as given.
#include <gtest/gtest.h>

#include "tests/apps/program.h"

namespace apps::test {
namespace {

/// With redirections of the shell's, which replace standard output or standard error.
int exit_code(const std::string& arguments, const std::string& redirections) {
  const std::string command = "exec >/dev/null 2>/dev/null; cd '" SOURCE_DIR "' && '" ROOMHUE "' " +
                              arguments + " " + redirections;
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

struct Call {
  const char* name;
  std::string arguments;  ///< OUT stands for a folder or file to write
  int exit_code = 0;
  bool data = true;  ///< on standard output
};

class Streams : public testing::TestWithParam<Call> {
 protected:
  [[nodiscard]] std::string arguments() const {
    std::string text = GetParam().arguments;
    const std::size_t at = text.find("OUT");
    if (at != std::string::npos) text.replace(at, 3, "'" + (folder_ / "out").string() + "'");
    return text;
  }

  TemporaryFolder folder_;
};

TEST_P(Streams, TalkThatCannotBeHeardChangesNoExitCode) {
  for (const char* redirection : {"2>&-", "2>/dev/full"}) {
    EXPECT_EQ(exit_code(arguments(), redirection), GetParam().exit_code) << redirection;
  }
}

TEST_P(Streams, DataThatCannotBeWrittenAreAFileError) {
  if (!GetParam().data) return;
  for (const char* redirection : {">&-", ">/dev/full", ">/dev/full 2>&-"}) {
    EXPECT_EQ(exit_code(arguments(), redirection), 4) << redirection;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Roomhue, Streams,
    testing::Values(
        Call{"version", "--version"}, Call{"help", "--help"}, Call{"rank_help", "rank --help"},
        Call{"usage", "paint", 2, false}, Call{"no_file", "check no.json", 4, false},
        Call{"bad_file", "check tests/data/bad/five_faults.json", 3, false},
        Call{"check", "check scenes/rooms/box.json"},
        Call{"check_json", "check scenes/rooms/box.json --json"},
        Call{"solve", "solve scenes/rooms/box.json --patch-m 1.4 --out OUT"},
        Call{"shift", "shift scenes/rooms/box.json --patch-m 1.4 --out OUT"},
        Call{"rank", "rank scenes/rooms/box.json --patch-m 1.4 --out OUT"},
        Call{"atlas", "atlas scenes/rooms/box.json --patch-m 1.4 --out OUT"},
        Call{"compare", "compare scenes/rooms/colour/cornell_cyan.json --patch-m 0.5 --out OUT"},
        Call{"inverse", "inverse scenes/rooms/box.json --patch-m 1.4 --out OUT"},
        Call{"appearance", "appearance tests/data/ciecam02_vectors.csv --json --out OUT"},
        Call{"cube", "cube scenes/rooms/closed_form/cube.json --json --out OUT"},
        Call{"brick", "brick scenes/rooms/closed_form/brick.json --json --out OUT"},
        Call{"shader", "shader"}, Call{"shader_json", "shader --json"},
        Call{"batch", "batch scenes/rooms/closed_form --out OUT", 6}),
    [](const auto& call) { return std::string(call.param.name); });

}  // namespace
}  // namespace apps::test
