// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/map_svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/report/colour_scale.h"
#include "linkwright/report/plot_svg.h"
#include "tests/report/sample_result.h"
#include "tests/report/well_formed.h"

namespace linkwright::report {
namespace {

using study::Plot;
using test::count;
using ::testing::HasSubstr;
using ::testing::Not;

struct Rectangle {
  std::string colour;
  double x, y, width, height;  // px; x and y of the lower left corner
};

std::vector<Rectangle> rectangles(const std::string& picture) {
  std::vector<Rectangle> out;
  const std::regex group("class=\"cells\"[^]*?</g>"), path("<path d=\"([^\"]*)\" fill=\"([^\"]*)\"");
  const std::regex piece("M([-0-9.]+) ([-0-9.]+)H([-0-9.]+)v-([0-9.]+)");
  for (std::sregex_iterator g(picture.begin(), picture.end(), group), end; g != end; ++g) {
    const std::string cells = g->str();
    for (std::sregex_iterator p(cells.begin(), cells.end(), path); p != end; ++p) {
      const std::string d = (*p)[1];
      for (std::sregex_iterator r(d.begin(), d.end(), piece); r != end; ++r) {
        const double x = std::stod((*r)[1]);
        out.push_back({(*p)[2], x, std::stod((*r)[2]), std::stod((*r)[3]) - x, std::stod((*r)[4])});
      }
    }
  }
  return out;
}

Plot plot() {
  return {.name = "p",
          .title = "Title",
          .table = "t",
          .x = "x_m",
          .y = {"y_m", "index"},
          .style = Plot::Style::map};
}

// 4 by 2 places, 0.1 m by 0.2 m apart; the coordinates carry the rounding of sums.
Table grid(std::vector<double> values) {
  Table table{.name = "t"};
  table.add("x_m", "x (m)", {0, 0.1, 0.1 + 0.1, 0.1 + 0.2, 0, 0.1, 0.2, 0.3});
  table.add("y_m", "y (m)", {0, 0, 0, 0, 0.2, 0.2, 0.2, 0.2});
  table.add("index", "transmission index", std::move(values));
  return table;
}

TEST(MapSvg, NeighboursOfOneClassAreOneRectangle) {
  const std::string picture = plot_svg(plot(), grid({0, 0.01, 1, 0, nan, 1, 1, 1}));
  EXPECT_EQ(test::fault_of_xml(picture), "");
  const auto found = rectangles(picture);
  const std::string low = class_colour(0), high = class_colour(colour_classes - 1);
  ASSERT_EQ(found.size(), 5u);  // two and one dark, one and three light, one without a value
  const double cell = found[1].width;
  // Equal axes: cells are twice as high as they are wide. Coordinates are rounded to a tenth of a pixel.
  for (const auto& r : found) EXPECT_NEAR(r.height, 2 * cell, 0.4);
  EXPECT_EQ(found[0].colour, low);
  EXPECT_NEAR(found[0].width, 2 * cell, 0.2);
  EXPECT_EQ(found[1].colour, low);
  EXPECT_NEAR(found[1].x, found[0].x + 3 * cell, 0.2);
  EXPECT_EQ(found[2].colour, high);
  EXPECT_NEAR(found[2].x, found[0].x + 2 * cell, 0.2);
  EXPECT_EQ(found[3].colour, high);
  EXPECT_NEAR(found[3].width, 3 * cell, 0.2);
  EXPECT_NEAR(found[3].y, found[0].y - 2 * cell, 0.4);  // y upwards
  EXPECT_NEAR(found[4].x, found[0].x, 0.01);
  EXPECT_THAT(picture, HasSubstr(">no value</text>"));
  EXPECT_THAT(picture, HasSubstr("text-anchor=\"middle\">x (mm)</text>"));
  EXPECT_THAT(picture, HasSubstr("text-anchor=\"middle\">y (mm)</text>"));
  EXPECT_THAT(picture, HasSubstr(">transmission index</text>"));
  EXPECT_THAT(plot_svg(plot(), grid({0, 0, 0, 0, 1, 1, 1, 1})), Not(HasSubstr(">no value</text>")));
}

TEST(MapSvg, GroupsShareAxesAndColours) {
  Table table{.name = "t"};
  std::vector<double> x, y, z, value;
  for (int k = 0; k < 4; ++k)
    for (int i = 0; i < 3; ++i) {
      x.push_back(0.1 * i);
      y.push_back(0);
      z.push_back(-0.9 + 0.1 * k);
      value.push_back(k);
    }
  table.add("x_m", "x (m)", x);
  table.add("y_m", "y (m)", y);
  table.add("z_m", "z (m)", z);
  table.add("index", "index", value);
  Plot p = plot();
  p.group = "z_m";
  const std::string picture = plot_svg(p, table);
  EXPECT_EQ(test::fault_of_xml(picture), "");
  EXPECT_EQ(count(picture, "class=\"map\""), 4u);
  EXPECT_EQ(count(picture, "class=\"scale\""), 1u);
  for (const char* title : {">z -900 mm<", ">z -800 mm<", ">z -700 mm<", ">z -600 mm<"})
    EXPECT_THAT(picture, HasSubstr(title));
  const auto found = rectangles(picture);
  ASSERT_EQ(found.size(), 4u);
  // Two by two; the colours are those of 0, 1/3, 2/3 and 1 of the whole range.
  EXPECT_EQ(found[0].colour, class_colour(0));
  EXPECT_EQ(found[1].colour, class_colour(colour_classes / 3));
  EXPECT_EQ(found[3].colour, class_colour(colour_classes - 1));
  EXPECT_NEAR(found[0].x, found[2].x, 0.01);
  EXPECT_NEAR(found[0].y, found[1].y, 0.01);
  EXPECT_GT(found[2].y, found[0].y);
}

TEST(MapSvg, OfManyGroupsTwelveAreDrawn) {
  Table table{.name = "t"};
  std::vector<double> zero(40), z, value;
  for (int k = 0; k < 40; ++k) z.push_back(k), value.push_back(k);
  table.add("x_m", "x (m)", zero);
  table.add("y_m", "y (m)", zero);
  table.add("z_m", "z (m)", z);
  table.add("index", "index", value);
  Plot p = plot();
  p.group = "z_m";
  const std::string picture = plot_svg(p, table);
  EXPECT_EQ(count(picture, "class=\"map\""), 12u);
  for (const char* text : {">z 0 m<", ">z 39 m<", ">x (mm); 12 of 40 maps<"})
    EXPECT_THAT(picture, HasSubstr(text));
}

TEST(MapSvg, LogarithmicColoursFollowDecades) {
  Plot p = plot();
  p.logarithmic_y = true;
  const auto found = rectangles(plot_svg(p, grid({1, 1, 1, 1, 100, 100, 1e4, 0})));
  ASSERT_EQ(found.size(), 4u);
  EXPECT_EQ(found[0].colour, class_colour(0));
  EXPECT_EQ(found[1].colour, class_colour(colour_classes / 2));
  EXPECT_EQ(found[2].colour, class_colour(colour_classes - 1));
  EXPECT_THAT(plot_svg(p, grid({1, 1, 1, 1, 100, 100, 1e4, 0})), HasSubstr(">no value</text>"));
}

TEST(MapSvg, ValuesAndPlacesAreInTheUnitsOfTheViewer) {
  Table table = grid({0, 0.1, 0.2, 0.3, 0.4, 0.5, pi / 2, 0});
  table.columns[2].key = "tilt_rad";
  table.columns[2].label = "tilt (rad)";
  for (double& v : table.columns[0].values) v *= 10;  // now up to 3 m, and so both are in metres
  Plot p = plot();
  p.y[1] = "tilt_rad";
  const std::string picture = plot_svg(p, table);
  for (const char* text : {">x (m)</text>", ">y (m)</text>", ">tilt (°)</text>", ">90</text>"})
    EXPECT_THAT(picture, HasSubstr(text));
}

TEST(MapSvg, LastOfSeveralValuesAtAPlaceIsDrawn) {
  Table table{.name = "t"};
  table.add("x_m", "", {0, 0, 1});
  table.add("y_m", "", {0, 0, 0});
  table.add("index", "", {nan, 5, 3});
  const auto found = rectangles(plot_svg(plot(), table));
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].colour, class_colour(0));
  EXPECT_EQ(found[1].colour, class_colour(colour_classes - 1));
  EXPECT_LT(found[1].x, found[0].x);
}

TEST(MapSvg, NothingToDrawSaysSo) {
  Plot gone = plot();
  gone.y = {"y_m", "gone"};
  EXPECT_THAT(plot_svg(gone, grid(std::vector<double>(8, 1))), HasSubstr("No values."));
  gone.y = {"y_m"};
  EXPECT_THAT(plot_svg(gone, grid(std::vector<double>(8, 1))), HasSubstr("No values."));
  EXPECT_THAT(plot_svg(plot(), grid(std::vector<double>(8, nan))), HasSubstr("No values."));
  EXPECT_THAT(plot_svg(plot(), Table()), HasSubstr("No values."));
}

TEST(MapSvg, SinglePlacesAndHostileTextAreHarmless) {
  Table table{.name = "t"};
  table.add("x_m", test::hostile, {0});
  table.add("y_m", test::hostile, {0});
  table.add("index", test::hostile, {7});
  Plot p = plot();
  p.title = test::hostile;
  p.group = "index";
  const std::string picture = plot_svg(p, table);
  EXPECT_EQ(test::fault_of_xml(picture), "");
  EXPECT_THAT(picture, Not(HasSubstr("nan")));
  EXPECT_THAT(picture, Not(HasSubstr("<script")));
  ASSERT_EQ(rectangles(picture).size(), 1u);
  EXPECT_NEAR(rectangles(picture)[0].width, rectangles(picture)[0].height, 0.2);
}

}  // namespace
}  // namespace linkwright::report
