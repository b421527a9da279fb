#include "apps/pictures/line_chart.h"

#include <gmock/gmock.h>

#include <cstdio>
#include <limits>
#include <string>

namespace apps::test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
    ++count;
  }
  return count;
}

Chart chart_of(const std::vector<ChartLine>& lines) {
  return {.title = "a chart", .x_label = "time, s", .y_label = "error", .lines = lines};
}

TEST(ChartPage, ValuesThatALogarithmCannotShowAreLeftOut) {
  const double infinity = std::numeric_limits<double>::infinity();
  const std::string one = chart_page("page", {chart_of({{"line", {{1, 1}}}})}, {});
  const std::string same = chart_page(
      "page", {chart_of({{"line", {{1, 1}, {0, 1}, {1, -1}, {infinity, 1}, {1, 0}}}})}, {});
  EXPECT_EQ(one, same);
  EXPECT_THAT(chart_page("page", {chart_of({{"line", {{0, 0}}}})}, {}), Not(HasSubstr("nan")));
}

// Ten times right and ten times down on the same scale: 10^1 to 10^2 is as wide as 10^2 to 10^3.
TEST(ChartPage, EqualRatiosAreEqualLengths) {
  const std::string svg =
      chart_page("page", {chart_of({{"line", {{10, 1}, {100, 1}, {1000, 1}}}})}, {});
  const std::size_t line = svg.find("stroke-width='1.8'");
  const std::size_t begin = svg.rfind("<path d='M ", line);
  double x[3] = {}, y[3] = {};
  ASSERT_EQ(std::sscanf(svg.c_str() + begin, "<path d='M %lf %lf L %lf %lf L %lf %lf", &x[0], &y[0],
                        &x[1], &y[1], &x[2], &y[2]),
            6);
  EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.11);  // rounded to tenths
  EXPECT_GT(x[1], x[0] + 100);
  EXPECT_EQ(y[0], y[2]);
}

TEST(ChartPage, ALineLooksAlikeInAllChartsAndUnlikeTheOthers) {
  const ChartLine a{"a", {{1, 1}}}, b{"b", {{1, 1}}};
  const std::string svg = chart_page("page", {chart_of({a, b}), chart_of({b})}, {});
  EXPECT_EQ(count_of(svg, "stroke='#0072B2' stroke-width='1.8'"), 2U);  // its line and its legend
  EXPECT_EQ(count_of(svg, "stroke='#D55E00' stroke-width='1.8'"), 4U);
}

TEST(ChartPage, MarksAreHollowAndTextIsEscaped) {
  const std::string svg = chart_page(
      "a < b", {chart_of({{"x & y", {{.x = 1, .y = 1, .label = "<1>", .hollow = true}}}})},
      {"note"});
  EXPECT_THAT(svg, HasSubstr("a &lt; b"));
  EXPECT_THAT(svg, HasSubstr("x &amp; y"));
  EXPECT_THAT(svg, HasSubstr("&lt;1&gt;"));
  EXPECT_THAT(svg, HasSubstr("fill='white' stroke='#0072B2'"));
  EXPECT_THAT(svg, HasSubstr(">note</text>"));
}

}  // namespace
}  // namespace apps::test
