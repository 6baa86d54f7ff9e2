#include "linkwright/report/plot_svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <regex>
#include <vector>

#include "tests/report/sample_result.h"
#include "tests/report/well_formed.h"

namespace linkwright::report {
namespace {

using study::Plot;
using testing::HasSubstr;
using testing::Not;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

// A force that goes round a circle of 300 N about (100 N, 0), once.
Table turning() {
  Table table{.name = "sweep"};
  std::vector<double> angle, x, y;
  for (int i = 0; i <= 36; ++i) {
    angle.push_back(i * std::numbers::pi / 18);
    x.push_back(100 + 300 * std::cos(angle.back()));
    y.push_back(300 * std::sin(angle.back()));
  }
  table.add("crank_angle_rad", "crank angle (rad)", angle);
  table.add("O1_x_N", "O1 x, ground on crank (N)", x);
  table.add("O1_y_N", "O1 y, ground on crank (N)", y);
  return table;
}

Plot plot(Plot::Style style, std::vector<std::string> y) {
  return {.name = "p",
          .title = "Title",
          .table = "sweep",
          .x = "crank_angle_rad",
          .y = std::move(y),
          .style = style};
}

// Corners of all curves.
std::vector<std::pair<double, double>> corners(const std::string& picture) {
  std::vector<std::pair<double, double>> out;
  const std::regex curve("class=\"curve\" d=\"([^\"]*)\""), corner("[ML]([-0-9.]+) ([-0-9.]+)");
  for (std::sregex_iterator c(picture.begin(), picture.end(), curve), end; c != end; ++c) {
    const std::string path = (*c)[1];
    for (std::sregex_iterator p(path.begin(), path.end(), corner); p != end; ++p)
      out.emplace_back(std::stod((*p)[1]), std::stod((*p)[2]));
  }
  return out;
}

TEST(PlotSvg, PolarDiagramsHaveEqualAxesAndTheirOrigin) {
  const std::string picture = plot_svg(plot(Plot::Style::polar, {"O1_x_N", "O1_y_N"}), turning());
  EXPECT_EQ(test::fault_of_xml(picture), "");
  EXPECT_THAT(picture, HasSubstr("class=\"origin\""));
  EXPECT_THAT(picture, HasSubstr(">O1, ground on crank</text>"));
  EXPECT_THAT(picture, HasSubstr(">x (N)</text>"));
  const auto points = corners(picture);
  ASSERT_EQ(points.size(), 37u);
  // A circle in the picture, too; coordinates are rounded to a tenth of a pixel.
  const double x = (points[0].first + points[18].first) / 2, y = (points[9].second + points[27].second) / 2;
  const double r = std::hypot(points[0].first - x, points[0].second - y);
  EXPECT_GT(r, 100);
  for (const auto& p : points) EXPECT_NEAR(std::hypot(p.first - x, p.second - y), r, 0.15);
}

TEST(PlotSvg, LinesBreakWhereValuesAreMissing) {
  Table table = turning();
  table.columns[1].values[5] = nan;
  const std::string picture = plot_svg(plot(Plot::Style::line, {"O1_x_N"}), table);
  EXPECT_EQ(test::fault_of_xml(picture), "");
  EXPECT_THAT(picture, Not(HasSubstr("nan")));
  EXPECT_EQ(corners(picture).size(), 36u);
  EXPECT_THAT(picture, HasSubstr(">crank angle (rad)</text>"));
  const std::size_t at = picture.find("class=\"curve\"");
  const std::string path = picture.substr(at, picture.find("fill", at) - at);
  EXPECT_EQ(std::count(path.begin(), path.end(), 'M'), 2);
}

TEST(PlotSvg, LogarithmicAxesCountDecades) {
  Table table{.name = "sweep"};
  table.add("crank_angle_rad", "x", {1, 2, 3, 4});
  table.add("cost", "cost", {1, 100, 0, 1e4});
  Plot p = plot(Plot::Style::line, {"cost"});
  p.logarithmic_y = true;
  const std::string picture = plot_svg(p, table);
  const auto points = corners(picture);
  ASSERT_EQ(points.size(), 3u);  // 0 has no logarithm
  EXPECT_NEAR(points[0].second - points[1].second, points[1].second - points[2].second, 0.15);
  EXPECT_THAT(picture, HasSubstr(">10000</text>"));
}

TEST(PlotSvg, HistogramsAndPointsAreDrawn) {
  EXPECT_EQ(test::fault_of_xml(plot_svg(plot(Plot::Style::points, {"O1_y_N"}), turning())), "");
  const std::string bars = plot_svg(plot(Plot::Style::histogram, {"O1_x_N"}), turning());
  EXPECT_EQ(test::fault_of_xml(bars), "");
  EXPECT_EQ(corners(bars).size(), 24u);  // six bars for 37 values
  EXPECT_THAT(bars, HasSubstr(">count</text>"));
}

TEST(PlotSvg, NothingToDrawSaysSo) {
  for (const auto style : {Plot::Style::line, Plot::Style::polar, Plot::Style::histogram}) {
    EXPECT_THAT(plot_svg(plot(style, {"gone", "gone too"}), turning()), HasSubstr("No values."));
    EXPECT_THAT(plot_svg(plot(style, {}), Table()), HasSubstr("No values."));
  }
}

TEST(PlotSvg, SingleValuesAndHostileTextAreHarmless) {
  Table table{.name = "sweep"};
  table.add("crank_angle_rad", test::hostile, {1});
  table.add("a_x_N", test::hostile, {0});
  table.add("a_y_N", test::hostile, {0});
  for (const auto style : {Plot::Style::line, Plot::Style::polar, Plot::Style::histogram}) {
    Plot p = plot(style, {"a_x_N", "a_y_N"});
    p.title = test::hostile;
    const std::string picture = plot_svg(p, table);
    EXPECT_EQ(test::fault_of_xml(picture), "");
    EXPECT_THAT(picture, Not(HasSubstr("nan")));
    EXPECT_THAT(picture, Not(HasSubstr("<script")));
  }
}

// Answers of two searches that differ by rounding: the range is no multiple of anything, however fine.
TEST(PlotSvg, ValuesThatDifferByRoundingEndInAPicture) {
  for (const double size : {1.0, 1e-9, 1e12}) {
    Table table{.name = "front"};
    const double next = std::nextafter(size, 2 * size);
    table.add("a", "a", {size, next});
    table.add("b", "b", {next, size});
    Plot p = plot(Plot::Style::points, {"b"});
    p.table = "front";
    p.x = "a";
    const std::string svg = plot_svg(p, table);
    EXPECT_LT(svg.size(), 20000u);
    EXPECT_THAT(svg, HasSubstr("text-anchor=\"end\""));
  }
}

}  // namespace
}  // namespace linkwright::report
