// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/plot_svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "tests/report/sample_result.h"
#include "tests/report/well_formed.h"

namespace linkwright::report {
namespace {

using study::Plot;
using test::count;
using ::testing::HasSubstr;
using ::testing::Not;

// A force that rotates fully a circle of 300 N about (100 N, 0), once.
Table turning() {
  Table table{.name = "sweep"};
  std::vector<double> angle, x, y;
  for (int i = 0; i <= 36; ++i) {
    angle.push_back(i * pi / 18);
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

// A force that swings between -10 N and 10 N, but for one impact at 50 s.
Table with_impact(double impact) {
  Table table{.name = "sweep"};
  std::vector<double> time, force;
  for (int i = 0; i <= 100; ++i) {
    time.push_back(i);
    force.push_back(i == 50 ? impact : 10 * std::sin(0.3 * i));
  }
  table.add("time_s", "time (s)", time);
  table.add("force_N", "force (N)", force);
  return table;
}

Plot over_time() {
  Plot out = plot(Plot::Style::line, {"force_N"});
  out.x = "time_s";
  return out;
}

TEST(PlotSvg, AnImpactDoesNotOwnTheAxis) {
  const std::string picture = plot_svg(over_time(), with_impact(-1241));
  EXPECT_THAT(picture, HasSubstr(">peak -1241 N at 50 s is outside</text>"));
  // The swings fill the diagram, and the impact leaves it.
  double low = 0, high = infinity;
  for (const auto& [x, y] : corners(picture))
    if (y < 1000) low = std::max(low, y), high = std::min(high, y);
  EXPECT_GT(low - high, 150);
  EXPECT_EQ(count(picture, "<svg "), 2U);
  const auto inner = picture.find("<svg ", 1), curve = picture.find("class=\"curve\"");
  EXPECT_LT(inner, curve) << "what is outside of the axes is not seen";
}

TEST(PlotSvg, ACommonLargeValueStays) {
  const std::string picture = plot_svg(over_time(), with_impact(-40));
  EXPECT_THAT(picture, Not(HasSubstr("is outside")));
  EXPECT_EQ(count(picture, "<svg "), 1U);
}

TEST(PlotSvg, PolarDiagramsHaveEqualAxesAndTheirOrigin) {
  const std::string picture = plot_svg(plot(Plot::Style::polar, {"O1_x_N", "O1_y_N"}), turning());
  EXPECT_EQ(test::fault_of_xml(picture), "");
  EXPECT_THAT(picture, HasSubstr("class=\"origin\""));
  EXPECT_THAT(picture, HasSubstr(">O1, ground on crank</text>"));
  EXPECT_THAT(picture, HasSubstr("text-anchor=\"middle\" font-size=\"12\">x (N)</text>"));
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
  EXPECT_THAT(picture, HasSubstr(">crank angle (°)</text>"));
  const std::size_t at = picture.find("class=\"curve\"");
  const std::string path = picture.substr(at, picture.find("fill", at) - at);
  EXPECT_EQ(std::count(path.begin(), path.end(), 'M'), 2);
}

TEST(PlotSvg, CurvesHaveTheirShapeWithFewPoints) {
  Table table{.name = "sweep"};
  std::vector<double> angles, waves;
  for (int i = 0; i <= 2000; ++i) {
    angles.push_back(i * pi / 1000);
    waves.push_back(std::sin(i * pi / 1000));
  }
  table.add("crank_angle_rad", "crank angle (rad)", angles);
  table.add("wave", "wave", waves);
  const auto points = corners(plot_svg(plot(Plot::Style::line, {"wave"}), table));
  EXPECT_LT(points.size(), 120u);
  // Half a wave up, one down: the picture's own coordinates say where it begins and how high it is.
  const double x = points.front().first, width = points.back().first - x;
  const auto [top, bottom] = std::minmax_element(
      points.begin(), points.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const double middle = points.front().second, height = (bottom->second - top->second) / 2;
  for (const auto& p : points)
    EXPECT_NEAR(p.second, middle - height * std::sin(2 * pi * (p.first - x) / width), 0.15);
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
  EXPECT_THAT(picture, HasSubstr("text-anchor=\"end\">10000</text>"));
}

// Costs of problems that are solved exactly: squares of rounding errors.
TEST(PlotSvg, LogarithmicAxesEndWhereValuesAreRounding) {
  for (const double size : {1.0, 1e-28}) {
    Table table{.name = "sweep"};
    table.add("crank_angle_rad", "x", {1, 2, 3, 4});
    table.add("cost", "cost", {size, size * 1e-6, size * 1e-16, size * 1e-31});
    Plot p = plot(Plot::Style::line, {"cost"});
    p.logarithmic_y = true;
    const std::string picture = plot_svg(p, table);
    EXPECT_EQ(test::fault_of_xml(picture), "");
    const auto points = corners(picture);
    ASSERT_EQ(points.size(), 4u);
    EXPECT_NEAR(10 * (points[1].second - points[0].second), 6 * (points[2].second - points[1].second), 1.5);
    EXPECT_NEAR(points[3].second, points[2].second, 0.15);
    EXPECT_THAT(picture, HasSubstr("zero up to rounding"));
  }
}

TEST(PlotSvg, AnglesAndShortLengthsAreShownAsInTheViewer) {
  Table table = turning();
  std::vector<double> way, angle;
  for (int i = 0; i <= 36; ++i) {
    way.push_back(0.002 * i);
    angle.push_back(-i * pi / 36);
  }
  table.add("way_m", "way (m)", way);
  table.add("lag_rad", "lag (rad)", angle);
  const std::string line = plot_svg(plot(Plot::Style::line, {"way_m"}), table);
  for (const char* text : {">crank angle (°)</text>", ">270</text>", ">way (mm)</text>", ">60</text>"})
    EXPECT_THAT(line, HasSubstr(text));
  const std::string two = plot_svg(plot(Plot::Style::line, {"lag_rad", "crank_angle_rad"}), table);
  for (const char* text : {">(°)</text>", ">lag (°)</text>", ">-180</text>"})
    EXPECT_THAT(two, HasSubstr(text));
  EXPECT_THAT(plot_svg(plot(Plot::Style::histogram, {"lag_rad"}), table),
              HasSubstr("text-anchor=\"middle\" font-size=\"12\">lag (°)</text>"));
  EXPECT_THAT(plot_svg(plot(Plot::Style::polar, {"way_m", "way_m"}), table),
              HasSubstr("text-anchor=\"middle\" font-size=\"12\">x (mm)</text>"));
  table.add("share_x", "share x", way);
  EXPECT_THAT(plot_svg(plot(Plot::Style::polar, {"share_x", "share_x"}), table),
              HasSubstr("text-anchor=\"middle\" font-size=\"12\">x</text>"));
}

TEST(PlotSvg, CurvesWithALegendDifferInColourOrDash) {
  Table table = turning();
  std::vector<std::string> keys;
  for (int k = 0; k < 8; ++k) {
    keys.push_back("way" + std::to_string(k));
    table.add(keys.back(), keys.back(), std::vector<double>(37, k));
  }
  const std::regex look("class=\"curve\"[^>]* stroke=\"([^\"]*)\"[^>]*stroke-dasharray=\"([^\"]*)\"");
  const auto looks = [&](const std::string& picture) {
    std::set<std::string> out;
    for (std::sregex_iterator c(picture.begin(), picture.end(), look), end; c != end; ++c)
      out.insert((*c)[1].str() + "/" + (*c)[2].str());
    return out.size();
  };
  EXPECT_EQ(looks(plot_svg(plot(Plot::Style::line, {keys.begin(), keys.begin() + 6}), table)), 6u);
  const std::string bundle = plot_svg(plot(Plot::Style::line, keys), table);
  EXPECT_EQ(looks(bundle), 7u);  // six with a name, and the pale ones
  EXPECT_THAT(bundle, HasSubstr(">2 more curves, way6 to way7</text>"));
  for (const auto& key : keys) EXPECT_THAT(bundle, HasSubstr("<title>" + key + "</title>"));
}

TEST(PlotSvg, UprightDiagramsHaveTheirInputUpwards) {
  Plot asked = plot(Plot::Style::line, {"O1_y_N"});
  const std::string level = plot_svg(asked, turning());
  asked.upright = true;
  const std::string upright = plot_svg(asked, turning());
  const std::string_view across = "text-anchor=\"middle\" font-size=\"12\">crank angle (°)</text>";
  EXPECT_THAT(level, HasSubstr("y=\"250\" " + std::string(across)));
  EXPECT_THAT(upright, HasSubstr("rotate(-90)\" " + std::string(across)));
  // The first row stands at the bottom.
  std::smatch first;
  const std::regex start("class=\"curve\" d=\"M([0-9.]+) ([0-9.]+)");
  ASSERT_TRUE(std::regex_search(upright, first, start));
  EXPECT_GT(std::stod(first[2]), 330);
}

TEST(PlotSvg, APathIsDrawnWithoutTheOrigin) {
  Table table = turning();
  table.add("pen_x_m", "pen x (m)", std::vector<double>(37, 5));
  std::vector<double> y;
  for (int k = 0; k < 37; ++k) y.push_back(3 + 0.01 * k);
  table.add("pen_y_m", "pen y (m)", std::move(y));
  EXPECT_THAT(plot_svg(plot(Plot::Style::polar, {"pen_x_m", "pen_y_m"}), table),
              Not(HasSubstr("class=\"origin\"")));
  EXPECT_THAT(plot_svg(plot(Plot::Style::polar, {"O1_x_N", "O1_y_N"}), table), HasSubstr("class=\"origin\""));
}

TEST(PlotSvg, HistogramsAndPointsAreDrawn) {
  EXPECT_EQ(test::fault_of_xml(plot_svg(plot(Plot::Style::points, {"O1_y_N"}), turning())), "");
  const std::string bars = plot_svg(plot(Plot::Style::histogram, {"O1_x_N"}), turning());
  EXPECT_EQ(test::fault_of_xml(bars), "");
  EXPECT_EQ(corners(bars).size(), 19u);  // six bars for 37 values; three corners in a line are two
  EXPECT_THAT(bars, HasSubstr(">count</text>"));
}

TEST(PlotSvg, HistogramsOfEachLieOverEachOther) {
  const study::Result result = test::sample_compared();
  const std::string bars = plot_svg(result.plots.at(2), *result.table("draws-of-each"));
  EXPECT_EQ(test::fault_of_xml(bars), "");
  for (const char* name : {">short</text>", ">middle</text>", ">long</text>", ">length (mm)</text>"})
    EXPECT_THAT(bars, HasSubstr(name));
  EXPECT_THAT(bars, HasSubstr("stroke=\"#D55E00\" stroke-width=\"1.8\" stroke-dasharray=\"8 4\""));
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

Table grid() {
  Table table;
  table.name = "grid";
  table.add("travel_mm", "travel (mm)", {0, 1, 2, 0, 1, 2});
  table.add("rack_mm", "rack (mm)", {30, 30, 30, -30, -30, -30});
  table.add("toe_deg", "toe (deg)", {1, 2, 3, -1, nan, -3});
  table.add("low_deg", "", {nan, nan, nan, -2, -2, -2});
  table.add("high_deg", "", {nan, nan, nan, -1, -1, nan});
  return table;
}

study::Plot grouped() {
  study::Plot plot;
  plot.title = "Toe";
  plot.table = "grid";
  plot.x = "travel_mm";
  plot.y = {"toe_deg"};
  plot.group = "rack_mm";
  return plot;
}

TEST(PlotSvg, GroupsAreOneCurveEach) {
  const std::string picture = plot_svg(grouped(), grid());
  EXPECT_EQ(test::fault_of_xml(picture), "");
  EXPECT_EQ(count(picture, "class=\"curve\""), 2u);
  // In rising order, in the unit of the table.
  const std::size_t first = picture.find(">rack -30 mm</text>"), second = picture.find(">rack 30 mm</text>");
  ASSERT_NE(first, std::string::npos);
  ASSERT_NE(second, std::string::npos);
  EXPECT_LT(first, second);
  EXPECT_THAT(picture, HasSubstr("text-anchor=\"middle\" font-size=\"12\">toe (°)</text>"));
  study::Plot two = grouped();
  two.y.push_back("low_deg");
  EXPECT_THAT(plot_svg(two, grid()), HasSubstr(">toe (°), rack -30 mm</text>"));
  two.group = "missing";
  EXPECT_EQ(count(plot_svg(two, grid()), "class=\"curve\""), 2u);
}

TEST(PlotSvg, ManyGroupsHaveOneLineOfLegend) {
  Table table;
  std::vector<double> x, g, y;
  for (int k = 0; k < 9; ++k)
    for (int i = 0; i < 2; ++i) {
      x.push_back(i);
      g.push_back(k);
      y.push_back(k + i);
    }
  table.add("travel_mm", "travel (mm)", x);
  table.add("rack_mm", "rack (mm)", g);
  table.add("toe_deg", "toe (deg)", y);
  EXPECT_THAT(plot_svg(grouped(), table), HasSubstr(">9 curves, rack 0 mm to rack 8 mm</text>"));
}

TEST(PlotSvg, BandsAndBaselinesLieBehind) {
  study::Plot plot = grouped();
  plot.bands = {{"low_deg", "high_deg", "target <toe>"}, {"gone", "high_deg", "gone"}};
  Table before = grid();
  before.name = "as built";
  for (double& v : before.columns[2].values) v += 20;
  const std::string picture = plot_svg(plot, grid(), &before);
  EXPECT_EQ(test::fault_of_xml(picture), "");
  EXPECT_EQ(count(picture, "class=\"band\""), 1u);
  EXPECT_THAT(picture, HasSubstr(">target &lt;toe&gt;</text>"));
  EXPECT_EQ(count(picture, "class=\"baseline\""), 2u);
  EXPECT_THAT(picture, HasSubstr("<title>as built: rack -30 mm</title>"));
  EXPECT_THAT(picture, HasSubstr(">as built</text>"));
  EXPECT_LT(picture.find("class=\"band\""), picture.find("class=\"baseline\""));
  EXPECT_LT(picture.find("class=\"baseline\""), picture.find("class=\"curve\""));
  // The axis reaches to the baseline; the last row of the band has no upper edge, so that it has two corners
  // on each side.
  EXPECT_THAT(picture, HasSubstr("text-anchor=\"end\">20</text>"));
  const std::size_t at = picture.find("class=\"band\" d=\"");
  const std::string path = picture.substr(at, picture.find('Z', at) - at);
  EXPECT_EQ(count(path, "L"), 3u);
  EXPECT_THAT(picture, Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace linkwright::report
