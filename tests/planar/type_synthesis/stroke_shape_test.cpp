// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/type_synthesis/stroke_shape.h"

#include <gtest/gtest.h>

#include "planar/type_synthesis_cases.h"

namespace linkwright::planar {
namespace {

StrokeShape shape_of_case(const char* name) {
  return stroke_shape_of(sampled_stroke(test::stroke_of(test::stroke_case(name))));
}

TEST(StrokeShapes, FindCrossings) {
  EXPECT_EQ(shape_of_case("figure_eight").crossings, 1);
  EXPECT_EQ(shape_of_case("superellipse").crossings, 0);
  EXPECT_EQ(shape_of_case("letter_s").crossings, 0);
}

// The letter Y: down the first arm, down the leg, up again, and up the second arm.
TEST(StrokeShapes, FindWhatIsTracedTwice) {
  const Stroke y{.points = {{-1, 2}, {0, 1}, {0, 0}, {0, 1}, {1, 2}}};
  const StrokeShape shape = stroke_shape_of(sampled_stroke(y));
  EXPECT_NEAR(shape.retraced, 2 / (2 + 2 * std::sqrt(2.0)), 0.03);
  for (const char* name : {"superellipse", "square", "letter_u", "spiral"})
    EXPECT_LT(shape_of_case(name).retraced, 0.02) << name;
}

TEST(StrokeShapes, KnowLinesAndCircles) {
  const Stroke line{.points = {{0, 0}, {1, 2}, {2, 4}, {1, 2}}, .closed = true};
  EXPECT_TRUE(stroke_shape_of(sampled_stroke(line)).straight);
  Stroke arc;
  for (int k = 0; k <= 40; ++k) arc.points.push_back(5.0 + std::polar(0.3, 0.05 * k));
  const SampledStroke sampled = sampled_stroke(arc);
  const StrokeShape shape = stroke_shape_of(sampled);
  EXPECT_TRUE(shape.circle);
  EXPECT_FALSE(shape.straight);
  EXPECT_NEAR(shape.circle_radius * sampled.size, 0.3, 1e-3);
  for (const std::string& name : test::stroke_names()) {
    EXPECT_FALSE(shape_of_case(name.c_str()).circle) << name;
    EXPECT_FALSE(shape_of_case(name.c_str()).straight) << name;
  }
}

}  // namespace
}  // namespace linkwright::planar
