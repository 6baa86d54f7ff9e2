// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/defects.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "planar/path_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using ::testing::IsEmpty;

// The defects depend on linkage and angles only; the target points are anywhere.
PathProblem points(std::size_t count, bool closed, Timing timing = Timing::free) {
  PathProblem problem;
  for (std::size_t k = 0; k < count; ++k) {
    problem.x.push_back(std::cos(static_cast<double>(k)));
    problem.y.push_back(std::sin(static_cast<double>(k)));
  }
  problem.closed = closed;
  problem.timing = timing;
  problem.bounds = derive_bounds(problem.x, problem.y);
  return problem;
}

PathDesign design(const FourBar& linkage, std::vector<double> angles, double sense = 1) {
  PathDesign out;
  out.linkage = linkage;
  out.sense = sense;
  out.angles = std::move(angles);
  return out;
}

const FourBar crank_rocker{.ground = 2.2, .crank = 0.75, .coupler = 1.9, .rocker = 1.6};

TEST(Defects, NoneOfTheStoredOptima) {
  for (const char* id : {"P18-timed-global-optimum", "P18-free-timing-mu-min-30"})
    for (const Value& stored : at(path_case(id), "computed.designs").as_array()) {
      PathProblem problem = printed_eighteen_points();
      if (std::string(id) != "P18-timed-global-optimum") problem.timing = Timing::free;
      EXPECT_THAT(defects(problem, measure(problem, four_bar(stored), 1, numbers(at(stored, "theta2_rad")))),
                  IsEmpty())
          << id;
    }
  PathProblem line;
  set_points(line, at(path_case("BM-line6"), "inputs.target_points_m"));
  line.bounds = derive_bounds(line.x, line.y);
  line.closed = false;
  const Value& stored = at(path_case("BM-line6"), "computed.designs").as_array()[0];
  EXPECT_THAT(defects(line, design(four_bar(stored), numbers(at(stored, "theta2_rad")), -1)), IsEmpty());
}

TEST(Defects, PointsWhereItDoesNotAssemble) {
  // At half a turn coupler and rocker would have to span 7, and reach 6.5.
  const FourBar l{.ground = 5, .crank = 2, .coupler = 3, .rocker = 3.5};
  const auto found = defects(points(3, false), design(l, {0.1, 0.2, pi}));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, DefectKind::assembly);
  EXPECT_EQ(found[0].text,
            "does not assemble at point 3 (crank angle 180 deg): coupler and rocker miss by 0.5 m");
}

TEST(Defects, PointsAtAToggle) {
  const FourBar l{.ground = 5, .crank = 2, .coupler = 3, .rocker = 4};
  const auto found = defects(points(3, false), design(l, {pi / 2, 3 * pi / 4, pi}));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, DefectKind::branch);
  EXPECT_EQ(found[0].text, "at a toggle at point 3 (crank angle 180 deg)");
}

TEST(Defects, CircuitsOfANonGrashofLinkage) {
  // Assembles from 16.9 to 54.9 degrees on either side of the ground link, not between.
  const FourBar l{.ground = 1.9, .crank = 2.0, .coupler = 1.2, .rocker = 0.6};
  const auto type = classify(l);
  ASSERT_EQ(type.inputs.size(), 2u);
  const double middle = 0.5 * (type.inputs[1].from + type.inputs[1].to);
  const auto found = defects(points(3, false), design(l, {-middle - 0.05, -middle, middle}));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, DefectKind::circuit);
  EXPECT_EQ(found[0].text,
            "cannot move from point 2 to point 3 without passing crank angles that do not assemble");
  // Within one of the two arcs there is nothing to say, also when the angles are given turns away.
  EXPECT_THAT(defects(points(3, false), design(l, {middle - 0.05, middle, middle + 0.05})), IsEmpty());
  EXPECT_THAT(
      defects(points(3, false), design(l, {middle - 0.05 + 4 * pi, middle + 4 * pi, middle + 0.05 + 4 * pi})),
      IsEmpty());
  // A closed path asks for the way back as well: on round, through the angles that do not assemble.
  const auto closed = defects(points(3, true), design(l, {middle - 0.05, middle, middle + 0.05}));
  ASSERT_EQ(closed.size(), 1u);
  EXPECT_EQ(closed[0].kind, DefectKind::circuit);
  EXPECT_THAT(to_string(closed[0].text), ::testing::HasSubstr("from point 3 to point 1"));
}

// A gap that sampling would miss: 2e-3 rad wide where crank and ground are in line.
TEST(Defects, AThinGapBetweenTwoPoints) {
  // Crank forwards: A and B0 are 1 apart, coupler and rocker differ by a hair more than 1.
  const FourBar l{.ground = 2, .crank = 1, .coupler = 2.5 + 1e-6, .rocker = 1.5};
  const auto inputs = classify(l).inputs;
  ASSERT_EQ(inputs.size(), 1u);
  EXPECT_LT(inputs[0].from, 2e-3);
  const auto found = defects(points(3, false), design(l, {-0.5, -0.1, 0.4}));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].kind, DefectKind::circuit);
}

TEST(Defects, PointsInAnotherOrder) {
  // Downwards, but the sense says upwards: each step is nearly a turn.
  const auto reversed = defects(points(4, true), design(crank_rocker, {2.0, 1.5, 1.0, 0.5}));
  ASSERT_EQ(reversed.size(), 1u);
  EXPECT_EQ(reversed[0].kind, DefectKind::order);
  EXPECT_EQ(reversed[0].text,
            "meets the points in another order: the crank turns 1080 deg in all, 3 of 4 steps run backwards");
  EXPECT_THAT(defects(points(4, true), design(crank_rocker, {2.0, 1.5, 1.0, 0.5}, -1)), IsEmpty());
  // Two points exchanged.
  const auto exchanged = defects(points(4, false), design(crank_rocker, {0.5, 1.5, 1.0, 2.0}));
  ASSERT_EQ(exchanged.size(), 1u);
  EXPECT_THAT(to_string(exchanged[0].text), ::testing::EndsWith("1 of 3 steps run backwards"));
  // Across the seam of the angles nothing is wrong.
  EXPECT_THAT(defects(points(4, true), design(crank_rocker, {5.5, 6.1, 0.4, 2.0})), IsEmpty());
}

TEST(Defects, PrescribedAnglesTellTheirOwnDirection) {
  // A step of -20 degrees is sense +1 of a crank that turns clockwise.
  PathProblem problem = points(18, true, Timing::equal_steps);
  problem.step = -pi / 9;
  for (double sense : {1.0, -1.0}) {
    std::vector<double> angles;
    for (std::size_t k = 0; k < 18; ++k) angles.push_back(0.3 + sense * point_angle(problem, k));
    EXPECT_THAT(defects(problem, design(crank_rocker, angles, sense)), IsEmpty()) << sense;
  }
}

TEST(Defects, SeveralAtOnce) {
  const FourBar l{.ground = 5, .crank = 2, .coupler = 3, .rocker = 3.5};
  const auto found = defects(points(3, true), design(l, {pi, 3.0, 2.9}));
  std::vector<DefectKind> kinds;
  for (const Defect& defect : found) kinds.push_back(defect.kind);
  EXPECT_THAT(kinds, ::testing::ElementsAre(DefectKind::assembly, DefectKind::assembly, DefectKind::assembly,
                                            DefectKind::order));
}

}  // namespace
}  // namespace linkwright::planar
