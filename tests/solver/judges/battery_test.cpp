#include "solver/judges/battery.h"

#include <gtest/gtest.h>

#include <limits>

namespace solver {
namespace {

class Battery : public testing::TestWithParam<CheckGroup> {};

INSTANTIATE_TEST_SUITE_P(Groups, Battery, testing::ValuesIn(battery()), [](const auto& group) {
  std::string name = group.param.name;
  for (char& c : name) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  return name;
});

// The tolerances are those that users see; each is reasoned at its case.
TEST_P(Battery, EngineMeetsItsFormulas) {
  const std::vector<Check> checks = GetParam().run();
  EXPECT_FALSE(checks.empty());
  for (const Check& c : checks) {
    EXPECT_TRUE(c.passed()) << c.name << ", " << c.quantity << ": expected " << c.expected
                            << ", computed " << c.computed << ", error " << c.relative_error();
    EXPECT_GT(std::abs(c.expected), 0) << c.name;
    EXPECT_LE(c.tolerance, 1e-4) << c.name;
  }
}

TEST(Check, WrongValueFailsAndSoDoesNone) {
  const Check right{"case", "quantity", -2, -2.0000001, 1e-6};
  EXPECT_TRUE(right.passed());
  for (const double wrong : {2.0, -2.00001, 0.0, std::numeric_limits<double>::infinity(),
                             std::numeric_limits<double>::quiet_NaN()}) {
    Check check = right;
    check.computed = wrong;
    EXPECT_FALSE(check.passed()) << wrong;
  }
}

}  // namespace
}  // namespace solver
