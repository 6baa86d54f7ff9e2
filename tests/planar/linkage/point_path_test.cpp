// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/point_path.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/numbers.h"

namespace linkwright::planar {
namespace {

using math::Vec2;
using testing::HasSubstr;

PointPath all_steps() {
  PointPath p;
  p.steps.push_back({PathLine{{1, 0}, {}, {2.0, {}}}});
  p.steps.push_back({PathArc{{2, 1}, {1, 2}, 0.5, {{}, 3.0}}});
  p.steps.push_back({PathDwell{0.25}});
  p.steps.push_back({PathCurve{{{0, 2.5}, {-1, 2}, {-1, 1}}, {}, {1.5, {}}}});
  p.steps.push_back(
      {PathTable{{}, {3, 3.5, 4, 5}, {{-1, 1}, {-0.5, 0.5}, {0, 0.4}, {0, 0}}, {0.5, 0.4, 0.2, 0}}});
  return p;
}

// Rates against differences of places, with the length as the integral of the speed.
TEST(PointPath, RatesAreThoseOfItsPlaces) {
  for (const PathLaw law : {PathLaw::polynomial_345, PathLaw::cycloidal, PathLaw::constant_speed}) {
    PointPath p = all_steps();
    p.law = law;
    ASSERT_FALSE(problem(p, {0, 0}));
    const PointPathMotion path(p, {0, 0}, 0);
    const std::vector<double> breaks = path.breaks();
    ASSERT_EQ(breaks.size(), 6u);
    constexpr double h = 1e-4;
    for (std::size_t i = 0; i + 1 < breaks.size(); ++i)
      for (const double share : {0.21, 0.5, 0.83}) {
        const double t = breaks[i] + share * (breaks[i + 1] - breaks[i]);
        const PathState a = path(t - h), m = path(t), b = path(t + h);
        EXPECT_EQ(m.step, static_cast<int>(i));
        const Vec2 v = 1 / (2 * h) * (b.position - a.position);
        const Vec2 acc = 1 / (h * h) * (b.position - m.position - (m.position - a.position));
        EXPECT_NEAR(norm(v - m.velocity), 0, 1e-6) << i;
        EXPECT_NEAR(norm(acc - m.acceleration), 0, 1e-5) << i;
        EXPECT_NEAR((b.angle - a.angle) / (2 * h), m.speed, 1e-6);
        EXPECT_NEAR((b.angle - 2 * m.angle + a.angle) / (h * h), m.angular_acceleration, 1e-5);
        EXPECT_NEAR((b.length - a.length) / (2 * h), norm(m.velocity), 1e-6);
      }
  }
}

TEST(PointPath, MeetsItsPlaces) {
  const PointPathMotion path(all_steps(), {0, 0}, 0);
  const std::vector<double> t = path.breaks();
  EXPECT_NEAR(norm(path(t[1]).position - Vec2{1, 0}), 0, 1e-15);
  EXPECT_NEAR(norm(path((t[1] + t[2]) / 2).position - Vec2{2, 1}), 0, 1e-15);  // half of the half circle
  EXPECT_NEAR(path(t[2]).length, 1 + pi, 1e-14);
  EXPECT_NEAR(t[2] - t[1], pi * 15 / 8 / 3, 1e-14);  // its largest speed is 3 m/s
  EXPECT_NEAR(norm(path(t[3] - 0.1).velocity), 0, 0);
  EXPECT_NEAR(norm(path(t[4]).position - Vec2{-1, 1}), 0, 1e-14);
  EXPECT_NEAR(norm(path(t[5]).position), 0, 1e-14);
  EXPECT_NEAR(path(t[5]).angle, 0, 1e-14);
  EXPECT_NEAR(path(t[3]).angle, 0.5, 1e-15);
  EXPECT_EQ(path.share(0), 0);
  EXPECT_NEAR(path.share(path.duration()), 1, 1e-12);
}

// A circle by its places: the spline's length and its curvature.
TEST(PointPath, CurveThroughACircleIsNearlyOne) {
  PathCurve curve;
  for (int i = 1; i <= 48; ++i) curve.points.push_back({std::cos(i * pi / 24), std::sin(i * pi / 24)});
  curve.points.back() = {1, 0};
  curve.pace.speed = 1;
  const PointPathMotion path({{{curve}}, PathLaw::constant_speed}, {1, 0}, 0);
  EXPECT_NEAR(path.length(), full_turn, 1e-6);
  for (const double t : {0.3, 2.0, 5.9}) {
    const PathState s = path(t);
    EXPECT_NEAR(norm(s.velocity), 1, 1e-12);
    EXPECT_NEAR(norm(s.acceleration), 1, 1e-3);
    EXPECT_NEAR(norm(s.position), 1, 1e-6);
  }
}

std::string trouble(PathStep step, bool alone = true) {
  PointPath p;
  if (!alone) p.steps.push_back({PathLine{{1, 1}, {}, {1.0, {}}}});
  p.steps.push_back(std::move(step));
  const auto wrong = problem(p, {0, 0});
  return wrong ? wrong->message + "; " + wrong->hint : "";
}

TEST(PointPath, SaysWhatIsWrong) {
  EXPECT_EQ(trouble({PathLine{{1, 0}, {}, {}}}),
            "step 1 (line): has no duration; give duration_s, or speed_mm_per_s for its largest speed");
  EXPECT_EQ(trouble({PathLine{{1, 0}, {}, {1.0, 1.0}}}),
            "step 1 (line): has a duration and a speed; leave one out");
  EXPECT_EQ(trouble({PathLine{{0, 0}, 1.0, {{}, 1.0}}}),
            "step 1 (line): has a speed, but its end is where it begins; give duration_s instead");
  EXPECT_EQ(trouble({PathArc{{1, 0}, {2, 0}, {}, {1.0, {}}}}),
            "step 1 (arc): has its three places on a straight line; give a place on the arc between both "
            "ends, or a line");
  EXPECT_EQ(trouble({PathCurve{{{1, 0}}, {}, {1.0, {}}}}),
            "step 1 (curve): needs two or more places after its beginning; write a line for a single one");
  EXPECT_EQ(trouble({PathCurve{{{1, 0}, {1, 0}}, {}, {1.0, {}}}}),
            "step 1 (curve): has place 2 twice in a row; leave one out");
  EXPECT_EQ(trouble({PathTable{{}, {0, 1}, {{0, 0}}, {}}}),
            "step 1 (table): has 1 places for 2 times; give one place for each time");
  EXPECT_THAT(trouble({PathTable{{}, {1, 0}, {{0, 0}, {1, 0}}, {}}}), HasSubstr("step 1 (table): "));
  EXPECT_EQ(
      trouble({PathTable{{}, {0, 1}, {{0, 0}, {1, 0}}, {}}}, false),
      "step 2 (table): begins at (0, 0) mm, the step before it ends at (1000, 1000) mm; begin the table "
      "there, or add a line to its first place");
  PathTable moving{{}, {0, 1, 2}, {{1, 1}, {1, 0}, {2, 0}}, {}};
  moving.ends = math::TableEnds::natural;
  EXPECT_THAT(trouble({moving}, false), HasSubstr("moves at its ends"));
}

}  // namespace
}  // namespace linkwright::planar
