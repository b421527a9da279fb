// The stiff and extreme cases of solver/stability.md.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>

#include "tests/support/stability_cases.h"

namespace stability {

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

void PrintTo(const StiffRoom& r, std::ostream* out) { *out << r.name; }

namespace {

template <typename Named>
std::string identifier(const testing::TestParamInfo<Named>& info) {
  std::string name = info.param.name;
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

class ExtremeCase : public testing::TestWithParam<Case> {};

INSTANTIATE_TEST_SUITE_P(Cases, ExtremeCase, testing::ValuesIn(cases()), identifier<Case>);

TEST_P(ExtremeCase, StaysBelowItsLimit) { EXPECT_LT(GetParam().error(), GetParam().limit); }

class StiffRooms : public testing::TestWithParam<StiffRoom> {};

INSTANTIATE_TEST_SUITE_P(Rooms, StiffRooms, testing::ValuesIn(stiff_rooms()),
                         identifier<StiffRoom>);

// Meshes of 499 to 794 patches; finer ones take a few iterations less or more.
TEST_P(StiffRooms, ConvergeWithinTheirIterations) {
  const Iterations i = iterate(GetParam());
  EXPECT_LE(*std::ranges::max_element(i.with_clusters), GetParam().most_iterations);
  EXPECT_LT(i.with_clusters.back(), i.without_clusters.back() / 2);
  EXPECT_LT(i.error, 1e-7);
}

TEST(StabilityPage, NamesEveryCaseAndRoom) {
  std::ifstream file(std::string(SOURCE_DIR) + "/solver/stability.md");
  const std::string page(std::istreambuf_iterator<char>(file), {});
  for (const Case& c : cases()) {
    EXPECT_NE(page.find("| " + c.name + " |"), std::string::npos) << c.name;
  }
  for (const StiffRoom& r : stiff_rooms()) {
    EXPECT_NE(page.find("| " + r.name + " |"), std::string::npos) << r.name;
  }
}

}  // namespace
}  // namespace stability
