// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/tool/layout.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"

namespace linkwright::parallel {
namespace {

const Pose origin{};

std::string message(const ToolPath& path, const Pose& start = origin) {
  const auto bad = lay_out(path, start).problem;
  return bad ? bad->message + (bad->hint.empty() ? "" : "; " + bad->hint) : "no problem";
}
template <class Step>
std::string message_of(const Step& step) {
  return message({.steps = {{ToolDwell{0.1}}, {step}}});
}

TEST(ToolLayout, LinesStopAtCornersUnlessTheyAreRounded) {
  const ToolPath path{
      .steps = {{ToolLine{.to = {1, 0, 0}}}, {ToolLine{.to = {1, 1, 0}}}, {ToolLine{.to = {0, 1, 0}}}}};
  EXPECT_EQ(lay_out(path, origin).runs.size(), 3);
  ToolPath round = path;
  round.corner = 0.2;
  const ToolLayout layout = lay_out(round, origin);
  ASSERT_EQ(layout.runs.size(), 1);
  const auto& parts = layout.runs[0].parts;
  ASSERT_EQ(parts.size(), 5);
  EXPECT_NEAR(parts[0].curve.length, 0.8, 1e-15);
  EXPECT_NEAR(parts[2].curve.length, 0.6, 1e-15);
  EXPECT_EQ(parts[1].step, 0);
  EXPECT_EQ(parts[2].step, 1);
  EXPECT_EQ(layout.end.position, (Vec3{0, 1, 0}));
  // Corners that take all of the line between them leave none.
  round.corner = 0.5;
  EXPECT_EQ(lay_out(round, origin).runs[0].parts.size(), 4);
  // All joints are smooth.
  for (double corner : {0.2, 0.5}) {
    round.corner = corner;
    const auto joined = lay_out(round, origin).runs[0].parts;
    for (std::size_t i = 1; i < joined.size(); ++i) {
      EXPECT_LT(norm(end_of(joined[i - 1].curve) - joined[i].curve.from), 1e-15);
      EXPECT_LT(norm(end_direction(joined[i - 1].curve) - joined[i].curve.tangent), 1e-15);
    }
  }
  // A reversal cannot be rounded.
  EXPECT_EQ(
      lay_out({.steps = {{ToolLine{.to = {1, 0, 0}}}, {ToolLine{.to = {0, 0, 0}}}}, .corner = 0.2}, origin)
          .runs.size(),
      2);
}

TEST(ToolLayout, BlendsWhereTheDirectionGoesOn) {
  ToolPath path{.steps = {{ToolLine{.to = {1, 0, 0}}},
                          {ToolArc{.through = {1 + std::sqrt(0.5), 1 - std::sqrt(0.5), 0}, .to = {2, 1, 0}}},
                          {ToolLine{.to = {2, 2, 0}}},
                          {ToolCircle{.centre = {0, 2, 5}, .angle = 2 * pi}},
                          {ToolLine{.to = {3, 2, 0}}}}};
  EXPECT_EQ(lay_out(path, origin).runs.size(), 5);
  path.blend = true;
  const ToolLayout layout = lay_out(path, origin);
  ASSERT_EQ(layout.runs.size(), 2);
  EXPECT_EQ(layout.runs[0].parts.size(), 4);
  EXPECT_NEAR(layout.runs[0].parts[1].curve.length, pi / 2, 1e-14);
  EXPECT_NEAR(layout.runs[0].parts[3].curve.length, 4 * pi, 1e-14);
  // A step that turns begins and ends at rest; so does a dwell.
  std::get<ToolLine>(path.steps[2].form).rotation = Coordinates{0, 0, 1};
  EXPECT_EQ(lay_out(path, origin).runs.size(), 4);
  // A rotation that the tool has already is no turn.
  std::get<ToolLine>(path.steps[2].form).rotation = Coordinates{0, 0, 0};
  EXPECT_EQ(lay_out(path, origin).runs.size(), 2);
}

TEST(ToolLayout, ArcsGoThroughTheirPointTheShortOrTheLongWay) {
  for (double half : {0.1, 1.0, 1.6, 3.0}) {
    // From angle 0 through `half` to 2 `half` on a tilted circle of radius 0.3.
    const Mat3 tilt = math::turn_about({0.4, -0.7, 0.2});
    const auto on = [&](double a) { return tilt * Vec3{0.3 * std::cos(a), 0.3 * std::sin(a), 0}; };
    const Vec3 a = on(half), b = on(2 * half);
    const auto layout = lay_out({.steps = {{ToolArc{.through = {a.x, a.y, a.z}, .to = {b.x, b.y, b.z}}}}},
                                {.position = on(0)});
    const ToolCurve& curve = layout.runs.at(0).parts.at(0).curve;
    EXPECT_NEAR(curve.angle, 2 * half, 1e-13);
    EXPECT_NEAR(curve.length, 0.6 * half, 1e-13);
    EXPECT_LT(norm(point_at(curve, curve.length / 2).position - a), 1e-14);
    EXPECT_LT(norm(end_of(curve) - b), 1e-14);
  }
}

TEST(ToolLayout, GateRisesAboveTheHigherEnd) {
  const PickAndPlace gate{.to = {0.3, 0, 0.01}, .height = 0.025, .corner = 1, .back = true, .dwell = 0.1};
  const ToolLayout layout = lay_out({.steps = {{gate}}}, origin);
  ASSERT_EQ(layout.runs.size(), 3);
  const auto& parts = layout.runs[0].parts;
  // The lower leg is all corner.
  ASSERT_EQ(parts.size(), 4);
  EXPECT_NEAR(parts[0].curve.length, 0.01, 1e-15);
  EXPECT_NEAR(parts[2].curve.length, 0.25, 1e-15);
  EXPECT_NEAR(parts[2].curve.from.z, 0.035, 1e-15);
  EXPECT_LT(norm(end_of(parts[3].curve) - Vec3{0.3, 0, 0.01}), 1e-16);
  EXPECT_EQ(layout.runs[1].dwell, 0.1);
  EXPECT_EQ(layout.end.position, Vec3{});
  // Up may be any direction, as in the plane of a five-bar.
  const auto flat =
      lay_out({.steps = {{PickAndPlace{.to = {0.1, 0, 0}, .up = {0, 5, 0}, .height = 0.02}}}}, origin);
  EXPECT_NEAR(flat.runs[0].parts[2].curve.from.y, 0.02, 1e-15);
}

TEST(ToolLayout, SaysWhichStepIsWrongAndHowToMendIt) {
  EXPECT_EQ(message({}), "the path has no steps; give at least one");
  EXPECT_EQ(message({.steps = {{ToolDwell{1}}}, .corner = -1}), "corner is -1 m, must be at least 0 m");
  EXPECT_EQ(message({.steps = {{ToolDwell{1}}}}, {.position = {NAN, 0, 0}}), "the start is not finite");

  EXPECT_EQ(
      message_of(ToolLine{.to = {0, 0, 0}}),
      "step 2 (line): the line has no length: the tool is already at (0, 0, 0) m; give another end, another "
      "rotation, or a dwell");
  EXPECT_EQ(message_of(ToolLine{.to = {0, NAN, 0}}), "step 2 (line): to is not finite");
  EXPECT_EQ(message_of(ToolLine{.to = {0, 1, 0}, .rotation = Coordinates{0, 0, INFINITY}}),
            "step 2 (line): rotation is not finite");
  EXPECT_EQ(message_of(ToolLine{.to = {0, 1, 0}, .speed = 0}),
            "step 2 (line): speed is 0 m/s, must be more than 0 and finite");

  EXPECT_EQ(
      message_of(ToolArc{.through = {1, 0, 0}, .to = {2, 0, 0}}),
      "step 2 (arc): the points (0, 0, 0) m, (1, 0, 0) m and (2, 0, 0) m of the arc are on one line; move "
      "the point through which it goes, or take a line");
  EXPECT_EQ(message_of(ToolArc{.through = {1, 0, 0}, .to = {0, 0, 0}}),
            "step 2 (arc): the arc ends where it begins; for a full circle take a circle");
  EXPECT_EQ(message_of(ToolArc{.through = {NAN, 0, 0}, .to = {2, 0, 0}}),
            "step 2 (arc): through is not finite");

  EXPECT_EQ(message_of(ToolCircle{.centre = {0, 0, 3}, .angle = 1}),
            "step 2 (circle): the tool is on the axis, at (0, 0, 0) m; move the centre, or begin elsewhere");
  EXPECT_EQ(message_of(ToolCircle{.centre = {1, 0, 0}, .angle = 0}),
            "step 2 (circle): angle is 0 rad, must be finite and not 0");
  EXPECT_EQ(message_of(ToolCircle{.centre = {1, 0, 0}, .axis = {0, 0, 0}, .angle = 1}),
            "step 2 (circle): axis must be a direction, not 0");
  EXPECT_EQ(message_of(ToolCircle{.centre = {1, NAN, 0}, .angle = 1}),
            "step 2 (circle): centre is not finite");

  EXPECT_EQ(message_of(PickAndPlace{.to = {1, 0, 0}}),
            "step 2 (pick_and_place): height is 0 m, must be more than 0 m");
  EXPECT_EQ(
      message_of(PickAndPlace{.to = {0, 0, 1}, .height = 1}),
      "step 2 (pick_and_place): (0, 0, 0) m and (0, 0, 1) m lie above each other; take a line, or another "
      "direction up");
  EXPECT_EQ(message_of(PickAndPlace{.to = {1, 0, 0}, .height = 1, .corner = 0}),
            "step 2 (pick_and_place): corner is 0, must be more than 0 and at most 1; for sharp corners take "
            "three lines");
  EXPECT_EQ(message_of(PickAndPlace{.to = {1, 0, 0}, .up = {0, 0, 0}, .height = 1}),
            "step 2 (pick_and_place): up must be a direction, not 0");
  EXPECT_EQ(message_of(PickAndPlace{.to = {1, 0, 0}, .height = 1, .dwell = -1}),
            "step 2 (pick_and_place): dwell is -1 s, must be at least 0 s");
  EXPECT_EQ(
      message_of(PickAndPlace{.to = {1, 0, 0}, .height = 1, .back_dwell = 1}),
      "step 2 (pick_and_place): back_dwell is the dwell after the return, but there is no return; set back = "
      "true, or give dwell");
  EXPECT_EQ(message_of(ToolDwell{-1}), "step 2 (dwell): duration is -1 s, must be at least 0 s");
}

TEST(ToolLayout, SaysWhichCornerIsTooLarge) {
  const ToolPath path{
      .steps = {{ToolLine{.to = {1, 0, 0}}}, {ToolLine{.to = {1, 0.05, 0}}}, {ToolLine{.to = {0, 0.05, 0}}}},
      .corner = 0.03};
  EXPECT_EQ(
      message(path),
      "step 2 (line): the line is 0.05 m long, the corners at its ends need 0.06 m of it; make corner at "
      "most 0.025 m");
  ToolPath one = path;
  one.corner = 0.06;
  EXPECT_EQ(
      message(one),
      "step 2 (line): the line is 0.05 m long, the corner at its end needs 0.06 m of it; make corner at "
      "most 0.05 m");
  one.corner = 1.5;
  EXPECT_EQ(
      message(one),
      "step 1 (line): the line is 1 m long, the corner at its end needs 1.5 m of it; make corner at most "
      "1 m");
}

TEST(ToolLayout, SaysWhatIsWrongWithATable) {
  const std::vector<Coordinates> two = {{0, 0, 0}, {1, 0, 0}};
  EXPECT_EQ(message_of(ToolTable{.file = "way.csv"}), "step 2 (table): the file 'way.csv' has not been read");
  EXPECT_EQ(message_of(ToolTable{.times = {0}, .points = {{0, 0, 0}}}),
            "step 2 (table): 1 rows, needs at least 2");
  EXPECT_EQ(message_of(ToolTable{.times = {0, 1, 2}, .points = two}), "step 2 (table): 2 points for 3 times");
  EXPECT_EQ(message_of(ToolTable{.times = {0, 1}, .points = two, .rotations = {{0, 0, 0}}}),
            "step 2 (table): 1 rotations for 2 times; give one for each time, or none");
  EXPECT_EQ(message_of(ToolTable{.times = {0, 0}, .points = two}),
            "step 2 (table): times must increase, but row 2 with 0 s follows 0 s");
  EXPECT_EQ(message_of(ToolTable{.times = {0, INFINITY}, .points = two}),
            "step 2 (table): row 2 is not finite");
  EXPECT_EQ(
      message_of(ToolTable{.times = {0, 1}, .points = {{0.1, 0, 0}, {1, 0, 0}}}),
      "step 2 (table): the first point is (0.1, 0, 0) m, but the tool is at (0, 0, 0) m; put a line to the "
      "first point before it");
  EXPECT_EQ(
      message_of(ToolTable{.times = {0, 1}, .points = two, .rotations = {{0, 0, 1}, {0, 0, 0}}}),
      "step 2 (table): the first rotation is not that of the tool; put a line with this rotation before "
      "it");
}

TEST(ToolLayout, ProblemsKnowTheirStepAndKey) {
  const auto bad = lay_out({.steps = {{ToolDwell{0.1}}, {ToolLine{}}}}, origin).problem;
  EXPECT_EQ(bad->step, 1);
  EXPECT_EQ(bad->key, "to");
}

}  // namespace
}  // namespace linkwright::parallel
