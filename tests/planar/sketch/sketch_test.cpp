// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/sketch/sketch.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <random>
#include <string>
#include <vector>

#include "planar/studies.h"

namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;

constexpr double tolerance = 1e-5;  // m

DrawnShape line(std::vector<std::complex<double>> mm, std::string layer = "0", bool closed = false) {
  DrawnShape out{.points = std::move(mm), .closed = closed, .layer = std::move(layer), .name = "LINE"};
  for (auto& p : out.points) p *= 1e-3;
  return out;
}
DrawnShape circle(std::complex<double> mm, std::string layer = "0") {
  return {.points = {}, .centre = 1e-3 * mm, .radius = 2e-3, .layer = std::move(layer), .name = "CIRCLE"};
}

std::size_t bodies(const Sketch& sketch, SketchBodyType type) {
  return static_cast<std::size_t>(std::count_if(sketch.bodies.begin(), sketch.bodies.end(),
                                                [&](const SketchBody& body) { return body.type == type; }));
}

const SketchJoint& driven_joint(const Sketch& sketch) { return sketch.joints.at(sketch.drives.at(0).joint); }

std::string completed_study(Sketch sketch) {
  complete(sketch);
  return sketch_study(sketch, "test");
}

const std::vector<DrawnShape> four_bar = {line({{0, 0}, {40, 90}}), line({{40, 90}, {180, 140}}),
                                          line({{180, 140}, {220, 0}}), line({{0, 0}, {220, 0}}, "ground")};

TEST(Sketches, FourBar) {
  Sketch sketch = sketched_linkage(four_bar, tolerance);
  EXPECT_EQ(sketch.bodies.size(), 4U);
  EXPECT_EQ(sketch.bodies[0].type, SketchBodyType::ground);
  EXPECT_EQ(count(sketch, JointType::revolute), 4U);
  EXPECT_EQ(count(sketch, JointType::prismatic), 0U);
  EXPECT_EQ(mobility(sketch), 1);
  EXPECT_TRUE(sketch.questions.empty());
  complete(sketch);
  ASSERT_EQ(sketch.questions.size(), 1U);
  EXPECT_THAT(sketch.questions[0].text, HasSubstr("which pin is driven?"));
  EXPECT_EQ(driven_joint(sketch).name, "A");  // of the crank of 98.5 mm, the rocker has 145.6 mm
}

TEST(Sketches, OrderOfTheDrawingDoesNotMatter) {
  const std::string text = completed_study(sketched_linkage(four_bar, tolerance));
  std::mt19937 random(1);
  for (int times = 0; times < 20; ++times) {
    std::vector<DrawnShape> shapes = four_bar;
    std::shuffle(shapes.begin(), shapes.end(), random);
    for (DrawnShape& shape : shapes)
      if (random() % 2 == 0) std::reverse(shape.points.begin(), shape.points.end());
    EXPECT_EQ(completed_study(sketched_linkage(shapes, tolerance)), text);
  }
}

TEST(Sketches, SliderCrankWithASmallGap) {
  const std::vector<DrawnShape> shapes = {line({{0, 0}, {50, 0.004}}), line({{50, 0}, {200, 0}}),
                                          circle({0, 0}, "ground"), line({{150, 0}, {260, 0}}, "slide")};
  const Sketch sketch = sketched_linkage(shapes, tolerance);
  EXPECT_EQ(sketch.bodies.size(), 4U);
  EXPECT_EQ(count(sketch, JointType::revolute), 3U);
  ASSERT_EQ(count(sketch, JointType::prismatic), 1U);
  EXPECT_EQ(mobility(sketch), 1);
  EXPECT_TRUE(sketch.questions.empty());
  const SketchJoint& slide = sketch.joints.back();
  EXPECT_EQ(sketch.bodies[slide.first].type, SketchBodyType::ground);
  EXPECT_EQ(sketch.bodies[slide.second].type, SketchBodyType::block);
  EXPECT_EQ(slide.direction, 0);
  // A gap of 0.02 mm lies between the tolerance and ten times the tolerance.
  std::vector<DrawnShape> wider = shapes;
  wider[0] = line({{0, 0}, {50, 0.02}});
  const Sketch asked = sketched_linkage(wider, tolerance);
  ASSERT_EQ(asked.questions.size(), 1U);
  EXPECT_EQ(asked.questions[0].text,
            "the ends at (50, 0) mm and (50, 0.02) mm are 0.02 mm apart: are they one point?");
  EXPECT_EQ(mobility(asked), 1);
  // Without a body at the drawing's ground, the slide makes one.
  const Sketch alone = sketched_linkage({shapes[1], shapes[3]}, tolerance);
  EXPECT_EQ(alone.bodies[0].type, SketchBodyType::ground);
  EXPECT_EQ(alone.bodies.size(), 3U);
}

TEST(Sketches, TernaryPlateWithAPinOnAnEdge) {
  const std::vector<DrawnShape> shapes = {line({{0, 0}, {100, 0}, {60, 70}}, "0", true), circle({60, 70}),
                                          line({{60, 70}, {60, 200}}), circle({50, 0}),
                                          line({{50, 0}, {50, -80}})};
  Sketch sketch = sketched_linkage(shapes, tolerance);
  EXPECT_EQ(sketch.bodies.size(), 3U);
  EXPECT_EQ(bodies(sketch, SketchBodyType::plate), 1U);
  EXPECT_EQ(bodies(sketch, SketchBodyType::bar), 2U);
  ASSERT_EQ(sketch.joints.size(), 2U);
  EXPECT_EQ(sketch.points[sketch.joints[0].point].at, std::complex<double>(0.05, 0));
  EXPECT_TRUE(sketch.questions.empty());
  complete(sketch);
  ASSERT_EQ(sketch.questions.size(), 2U);
  EXPECT_EQ(sketch.questions[0].text, "no layer is called ground: which points are fixed?");
  EXPECT_EQ(mobility(sketch), 1);
  // Three lines on a layer of their own are the same plate.
  std::vector<DrawnShape> lines = {line({{0, 0}, {100, 0}}, "plate"), line({{60, 70}, {100, 0}}, "plate"),
                                   line({{60, 70}, {0, 0}}, "plate")};
  lines.insert(lines.end(), shapes.begin() + 1, shapes.end());
  const Sketch same = sketched_linkage(lines, tolerance);
  EXPECT_EQ(same.bodies.size(), 3U);
  EXPECT_EQ(bodies(same, SketchBodyType::plate), 1U);
  EXPECT_EQ(same.joints.size(), 2U);
}

TEST(Sketches, AnEndOnTheMiddleOfALineIsAskedAbout) {
  const Sketch sketch = sketched_linkage({line({{0, 0}, {100, 0}}), line({{50, 0}, {50, 80}})}, tolerance);
  EXPECT_EQ(sketch.bodies.size(), 2U);
  EXPECT_EQ(count(sketch, JointType::fixed), 1U);
  ASSERT_EQ(sketch.questions.size(), 1U);
  EXPECT_THAT(sketch.questions[0].text,
              HasSubstr("the line that ends at (50, 0) mm ends on the middle of another line"));
  EXPECT_EQ(sketch.questions[0].assumed, "a weld");
  // With a circle it is a pin.
  const Sketch pinned =
      sketched_linkage({line({{0, 0}, {100, 0}}), line({{50, 0}, {50, 80}}), circle({50, 0})}, tolerance);
  EXPECT_EQ(count(pinned, JointType::revolute), 1U);
  EXPECT_TRUE(pinned.questions.empty());
}

TEST(Sketches, LayersSayWhatLinesAre) {
  std::vector<DrawnShape> shapes = four_bar;
  shapes.push_back(circle({220, 0}, "Drive"));
  shapes.push_back(circle({110, 115}, "trace"));
  shapes.push_back(line({{-50, -50}, {300, -50}}, "construction"));
  shapes.push_back(circle({0, 0}, "belt 1"));
  Sketch sketch = sketched_linkage(shapes, tolerance);
  EXPECT_EQ(sketch.bodies.size(), 4U);
  ASSERT_EQ(sketch.traced.size(), 1U);
  EXPECT_EQ(sketch.points[sketch.traced[0]].at, std::complex<double>(0.11, 0.115));
  ASSERT_EQ(sketch.left_out.size(), 1U);
  EXPECT_THAT(sketch.left_out[0], HasSubstr("no closed belt runs around (0, 0) mm"));
  complete(sketch);
  EXPECT_TRUE(sketch.questions.empty());
  EXPECT_EQ(sketch.points[driven_joint(sketch).point].at, std::complex<double>(0.22, 0));
}

TEST(Sketches, PolylinesAreBarsBetweenTheirCorners) {
  const Sketch sketch = sketched_linkage({line({{0, 0}, {40, 90}, {180, 140}, {220, 0}})}, tolerance);
  EXPECT_EQ(bodies(sketch, SketchBodyType::bar), 3U);
  EXPECT_EQ(count(sketch, JointType::revolute), 2U);
  ASSERT_EQ(sketch.questions.size(), 1U);
  // An arc is one bar: its points are no corners.
  std::vector<std::complex<double>> arc;
  for (int k = 0; k <= 24; ++k) arc.push_back(std::polar(50.0, 0.06 * k));
  EXPECT_EQ(sketched_linkage({line(arc)}, tolerance).bodies.size(), 1U);
}

TEST(Sketches, StudiesOfSketchesRun) {
  for (const std::vector<DrawnShape>& shapes :
       {four_bar,
        {line({{0, 0}, {30, 40}}), line({{30, 40}, {200, 0}}), circle({0, 0}, "ground"),
         line({{150, 0}, {260, 0}}, "slide")}}) {
    EXPECT_EQ(test::run_text(completed_study(sketched_linkage(shapes, tolerance))).status, Status::done);
  }
}

/// A circle on a layer of wheels, in mm.
DrawnShape wheel(std::complex<double> centre, double radius, std::string layer = "gear") {
  DrawnShape out = circle(centre, std::move(layer));
  out.radius = 1e-3 * radius;
  return out;
}

TEST(Sketches, WheelsThatTouchAreGears) {
  // A sun of 20 mm, a planet of 30 mm and a fixed ring of 80 mm: the arm turns with a fifth of the sun's
  // speed.
  const Sketch train = sketched_linkage(
      {circle({0, 0}, "ground"), line({{0, 0}, {50, 0}}), wheel({0, 0}, 20), wheel({50, 0}, 30),
       wheel({0, 0}, 80, "gear ground"), circle({0, 0}, "drive"), circle({50, 0}, "trace")},
      tolerance);
  EXPECT_EQ(train.bodies.size(), 4U);
  EXPECT_EQ(bodies(train, SketchBodyType::wheel), 2U);
  EXPECT_EQ(count(train, JointType::revolute), 3U);
  ASSERT_EQ(train.gears.size(), 2U);
  EXPECT_EQ(mobility(train), 1);
  const study::Result result = test::run_text(completed_study(train));
  ASSERT_EQ(result.status, Status::done);
  const double sun = test::column(result, "sweep", "wheel_A_speed_rad_per_s").at(7),
               arm = test::column(result, "sweep", "AB_speed_rad_per_s").at(7),
               planet = test::column(result, "sweep", "wheel_B_speed_rad_per_s").at(7);
  EXPECT_NEAR(arm / sun, 0.2, 1e-12);
  EXPECT_NEAR(planet / sun, -1.0 / 3, 1e-12);
}

TEST(Sketches, AWheelTurnsWithTheBarAtItsCentreThatDoesNotCarryIt) {
  // A sector of 120 mm on a rocker drives a pinion of 30 mm.
  const std::vector<DrawnShape> shapes = {circle({0, 0}, "ground"),    circle({150, 0}, "ground"),
                                          line({{0, 0}, {-60, 100}}),  line({{-60, 100}, {-160, 0}}),
                                          circle({-160, 0}, "ground"), wheel({0, 0}, 120),
                                          wheel({150, 0}, 30)};
  Sketch sketch = sketched_linkage(shapes, tolerance);
  ASSERT_EQ(sketch.gears.size(), 1U);
  EXPECT_EQ(sketch.bodies[sketch.gears[0].bodies[0]].type, SketchBodyType::bar);
  EXPECT_EQ(sketch.bodies[sketch.gears[0].bodies[1]].type, SketchBodyType::wheel);
  EXPECT_DOUBLE_EQ(sketch.gears[0].ratio, -4);
  // What is not quite right is said.
  std::vector<DrawnShape> apart = shapes;
  apart.back().radius -= 3e-5;
  sketch = sketched_linkage(apart, tolerance);
  EXPECT_EQ(sketch.gears.size(), 1U);
  ASSERT_EQ(sketch.questions.size(), 1U);
  EXPECT_EQ(sketch.questions[0].text,
            "the wheels around (0, 0) mm and (150, 0) mm miss each other by 0.03 mm: do they mesh?");
  apart.back().radius -= 1e-3;
  sketch = sketched_linkage(apart, tolerance);
  EXPECT_TRUE(sketch.gears.empty());
  ASSERT_EQ(sketch.left_out.size(), 2U);
  EXPECT_EQ(sketch.left_out[0], "the wheel around (0, 0) mm touches no other wheel, and is left out");
  sketch = sketched_linkage({line({{0, 0}, {0, 90}}), wheel({0, 0}, 120), wheel({150, 0}, 30)}, tolerance);
  ASSERT_EQ(sketch.left_out.size(), 1U);
  EXPECT_EQ(sketch.left_out[0],
            "the wheels around (0, 0) mm and (150, 0) mm touch, but no link or ground has points at both "
            "centres");
}

TEST(Sketches, StrandsAroundCirclesAreBelts) {
  const double radius = 20, apart = 200;
  const std::vector<DrawnShape> pulleys = {circle({0, 0}, "ground"), circle({apart, 0}, "ground"),
                                           wheel({0, 0}, radius, "belt"), wheel({apart, 0}, radius, "belt")};
  const auto turns = [&](const std::vector<DrawnShape>& strands) {
    std::vector<DrawnShape> shapes = pulleys;
    shapes.insert(shapes.end(), strands.begin(), strands.end());
    const Sketch sketch = sketched_linkage(shapes, tolerance);
    EXPECT_EQ(sketch.belts.size(), 1U);
    EXPECT_EQ(mobility(sketch), 1);
    const study::Result result = test::run_text(completed_study(sketch));
    EXPECT_EQ(result.status, Status::done);
    return test::column(result, "sweep", "wheel_B_speed_rad_per_s").at(5) /
           test::column(result, "sweep", "wheel_A_speed_rad_per_s").at(5);
  };
  EXPECT_NEAR(
      turns({line({{0, radius}, {apart, radius}}, "belt"), line({{apart, -radius}, {0, -radius}}, "belt")}),
      1, 1e-12);
  // Crossed: the strands touch both circles from other sides.
  const double sine = 2 * radius / apart, cosine = std::sqrt(1 - sine * sine);
  const std::complex<double> out(radius * sine, radius * cosine);
  EXPECT_NEAR(
      turns({line({out, apart - out}, "belt"), line({std::conj(out), apart - std::conj(out)}, "belt")}), -1,
      1e-12);
  // Without one strand there is no belt.
  std::vector<DrawnShape> open = pulleys;
  open.push_back(line({{0, radius}, {apart, radius}}, "belt"));
  open.push_back(line({{0, 70}, {apart, 70}}, "belt"));
  const Sketch sketch = sketched_linkage(open, tolerance);
  EXPECT_TRUE(sketch.belts.empty());
  ASSERT_EQ(sketch.left_out.size(), 3U);
  EXPECT_THAT(sketch.left_out[0], HasSubstr("does not touch two circles"));
}

TEST(Sketches, SeveralDrivesMakeAGrid) {
  // A five-bar with two cranks.
  const std::vector<DrawnShape> shapes = {
      line({{0, 0}, {0, 40}}),     line({{0, 40}, {50, 110}}),         line({{50, 110}, {100, 40}}),
      line({{100, 40}, {100, 0}}), line({{0, 0}, {100, 0}}, "ground"), circle({0, 0}, "drive"),
      circle({100, 0}, "drive")};
  Sketch sketch = sketched_linkage(shapes, tolerance);
  EXPECT_EQ(mobility(sketch), 2);
  const study::Result result = test::run_text(completed_study(sketch));
  EXPECT_EQ(test::table(result, "sweep").rows(), 361U);  // 19 positions of each crank
}

}  // namespace
}  // namespace linkwright::planar
