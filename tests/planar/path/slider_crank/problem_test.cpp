// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/path/slider_crank/problem.h"

#include <gmock/gmock.h>

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/motion.h"
#include "planar/slider_crank_path_cases.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::ThrowsMessage;
using SP = SliderParameter;
using Complex = std::complex<double>;

SliderCrankMechanism random_mechanism(RandomStream& r, bool turning) {
  SliderCrankMechanism m;
  SliderCrankForm& f = m.parameters;
  f.crank = r.uniform(0.2, 1);
  f.offset = r.uniform(-0.6, 0.6);
  f.rod = turning ? f.crank + std::abs(f.offset) + r.uniform(0.05, 2) : r.uniform(0.2, 1.5);
  f.guide_angle = r.uniform(-4, 8);
  f.pivot_x = r.uniform(-1, 1), f.pivot_y = r.uniform(-1, 1);
  f.rod_u = r.uniform(-1, 1), f.rod_v = r.uniform(-1, 1);
  m.branch = r.bits() % 2 ? SliderSide::forward : SliderSide::backward;
  return m;
}

// Tables 4.2 and 4.3: the five printed designs, evaluated. Figures of an independent program, to 1e-8.
TEST(SliderPathProblem, PublishedDesignsHaveTheComputedErrorsAndStrokes) {
  const SliderPathProblem p = printed_eighteen_slider_points();
  for (const char* id : {"T4.2", "T4.3-1", "T4.3-2", "T4.3-3", "T4.3-4"}) {
    const Value& entry = path_case(id);
    const SliderCrankMechanism m = slider_crank(at(entry, "inputs.design"));
    const auto angles = angles_of(p, number_at(entry, "inputs.design.theta2_first_rad"));
    const SliderPathDesign d = measure(p, m, 1, angles);
    EXPECT_NEAR(d.error, number_at(entry, "computed.sse_m2"), 1e-10) << id;
    EXPECT_NEAR(d.stroke, number_at(entry, "computed.stroke_full_turn_m"), 1e-8) << id;
    EXPECT_NEAR(rotation_margin(m.parameters), number_at(entry, "computed.rotation_margin_m"), 1e-8) << id;
    double low = 1e9, high = -1e9;
    for (const double angle : angles) {
      const double way = slider_crank_pose(m, angle).displacement;
      low = std::min(low, way), high = std::max(high, way);
    }
    EXPECT_NEAR(high - low, number_at(entry, "computed.stroke_sampled_m"), 1e-8) << id;
    // The printed "stroke" is the abscissa of the tracing point at the first crank angle.
    const double abscissa = slider_crank_pose(m, angles[0]).point.real();
    EXPECT_NEAR(abscissa, number_at(entry, "computed.xC_first_point_m"), 1e-8) << id;
    EXPECT_NEAR(abscissa, number_at(entry, "published.stroke_m"), 1e-5) << id;
    EXPECT_GT(std::abs(d.stroke - number_at(entry, "published.stroke_m")), 0.2) << id;
    EXPECT_THAT(d.violations, IsEmpty()) << id;  // printed angles lie outside 0..2 pi, by whole turns
  }
}

TEST(SliderPathProblem, StoredBestDesignsEvaluateToTheirStoredErrors) {
  SliderPathProblem p = printed_eighteen_slider_points();
  for (const char* id : {"SC18-timed-global-optimum", "SC18-free-timing"}) {
    p.timing = id == std::string_view("SC18-free-timing") ? Timing::free : Timing::increments;
    const Value& design = at(path_case(id), "computed.designs").as_array()[0];
    const SliderPathDesign d = measure(p, slider_crank(design), 1, numbers(at(design, "theta2_rad")));
    EXPECT_NEAR(d.error, number_at(design, "sse_m2"), 1e-8 * d.error + 1e-12) << id;
    EXPECT_NEAR(d.stroke, number_at(design, "stroke_full_turn_m"), 1e-7) << id;
    EXPECT_THAT(d.violations, IsEmpty()) << id;
  }
}

// The linkage that the analysis of planar.slider_crank solves is another route to the same positions.
TEST(SliderPathProblem, PosesAreThoseOfTheLinkage) {
  RandomStream r({.seed = 4});
  for (int i = 0; i < 60; ++i) {
    const SliderCrankMechanism m = random_mechanism(r, true);
    const SliderCrankForm& f = m.parameters;
    const Linkage l = planar::slider_crank(m);
    const PlanResult planned = plan_linkage(l);
    ASSERT_TRUE(planned.problems.empty());
    LinkageMotion motion(planned.plan);
    for (int k = 0; k < 12; ++k) {
      const double angle = r.uniform(-7, 7);
      solve_position(planned.plan, std::vector<InputMotion>{{angle, 0, 0}}, motion);
      const SliderCrankPose pose = slider_crank_pose(m, angle);
      const Complex point = number(point_motion(planned.plan, motion, 2, {f.rod_u, f.rod_v}).position);
      const Complex slider = number(point_motion(planned.plan, motion, 3, 0).position);
      // The square root of the radicand loses digits where the rod is nearly square to the guide.
      const double sharp = 1e-14 / std::max(1e-3, std::cos(pose.pressure_angle));
      EXPECT_NEAR(std::abs(pose.point - point), 0, sharp);
      EXPECT_NEAR(std::abs(pose.slider - slider), 0, sharp);
      const Complex guide = std::polar(1.0, f.guide_angle);
      EXPECT_NEAR(
          std::abs(Complex(f.pivot_x, f.pivot_y) + guide * Complex(pose.displacement, f.offset) - slider), 0,
          2 * sharp);
    }
  }
}

TEST(SliderPathProblem, TheOtherSideIsTheGuideTurnedByHalfATurn) {
  RandomStream r({.seed = 5});
  for (int i = 0; i < 100; ++i) {
    SliderCrankMechanism m = random_mechanism(r, true);
    m.branch = SliderSide::backward;
    const SliderCrankMechanism forward = forward_form(m);
    EXPECT_EQ(forward.branch, SliderSide::forward);
    EXPECT_EQ(forward.parameters.offset, -m.parameters.offset);
    EXPECT_TRUE(same_linkage(m, forward));
    const double angle = r.uniform(0, 7);
    EXPECT_NEAR(std::abs(slider_crank_pose(m, angle).point - slider_crank_pose(forward, angle).point), 0,
                1e-13);
    SliderCrankMechanism other = forward;
    other.parameters.offset += 0.01;
    EXPECT_FALSE(same_linkage(m, other));
  }
}

// Points of the cognate's curve lie on the original's: at the crank angle that is the original's rod angle
// plus that of the point.
TEST(SliderPathProblem, TheCognateTracesTheSameCurve) {
  RandomStream r({.seed = 6});
  int compared = 0;
  for (int i = 0; i < 100; ++i) {
    const SliderCrankMechanism m = random_mechanism(r, i % 2 == 0);
    const double arm = std::atan2(m.parameters.rod_v, m.parameters.rod_u);
    for (int k = 0; k < 20; ++k) {
      const double angle = r.uniform(0, 2 * pi);
      const SliderCrankPose pose = slider_crank_pose(m, angle);
      if (pose.status != Status::done) continue;
      const SliderCrankMechanism cognate = slider_crank_cognate(m, angle);
      const SliderCrankPose other = slider_crank_pose(cognate, pose.rod_angle + arm);
      // Its rod lies square to its guide where the original's crank does.
      if (other.pressure_angle > 1.55) continue;
      EXPECT_NEAR(std::abs(other.point - pose.point), 0, 1e-12);
      ++compared;
    }
    // The cognate of the cognate is the original.
    const SliderCrankPose pose = slider_crank_pose(m, 0.3);
    if (pose.status != Status::done) continue;
    const SliderCrankMechanism back =
        slider_crank_cognate(slider_crank_cognate(m, 0.3), pose.rod_angle + arm);
    EXPECT_TRUE(same_linkage(back, m));
  }
  EXPECT_GT(compared, 1000);
  SliderCrankMechanism none = random_mechanism(r, true);
  none.parameters.rod_u = none.parameters.rod_v = 0;
  EXPECT_THAT([&] { slider_crank_cognate(none, 0); },
              ThrowsMessage<ContractError>(HasSubstr("the tracing point is the crank pin")));
}

TEST(SliderPathProblem, TellsWhatIsViolated) {
  const auto reasons = [](const SliderPathDesign& d) {
    std::vector<std::string> out;
    for (const auto& v : d.violations) out.push_back(v.reason);
    return out;
  };
  SliderPathProblem p = printed_eighteen_slider_points();
  const auto angles = angles_of(p, 0.2);
  SliderCrankMechanism m;
  m.parameters = {.crank = 0.4, .rod = 0.5, .offset = 0.2, .rod_u = 0.3};
  EXPECT_THAT(reasons(measure(p, m, 1, angles)), ElementsAre("no_assembly", "crank_rotates_fully"));
  EXPECT_EQ(measure(p, m, 1, angles).error, infinity);
  EXPECT_TRUE(std::isnan(stroke(m.parameters)));
  m.parameters.rod = 0.8;
  EXPECT_THAT(reasons(measure(p, m, 1, angles)), IsEmpty());
  p.max_pressure_angle = math::radians(45);  // the rod reaches asin(0.6 / 0.8) = 48.6 degrees
  p.stroke = {0, 0.8};
  EXPECT_THAT(reasons(measure(p, m, 1, angles)), ElementsAre("pressure_angle", "stroke"));
  EXPECT_NEAR(math::degrees(greatest_pressure_angle(m.parameters)), 48.590377890729, 1e-9);
  p.stroke = {0.9, 2};
  p.max_pressure_angle = math::radians(50);
  EXPECT_THAT(reasons(measure(p, m, 1, angles)), ElementsAre("stroke"));
  p.stroke = {0, infinity};
  p.bounds[index(SP::pivot_x)] = {0.1, 1};
  EXPECT_THAT(reasons(measure(p, m, 1, angles)), ElementsAre("bounds"));
  p.bounds[index(SP::pivot_x)] = {0, 1};
  EXPECT_THAT(measure(p, m, 1, angles).active_bounds, ElementsAre("pivot_x"));
  // An arc: the pressure angle between its ends counts, not that of a full turn.
  SliderPathProblem arc = p;
  arc.crank_rotates_fully = arc.closed = false;
  arc.max_pressure_angle = math::radians(20);
  std::vector<double> short_arc;
  for (std::size_t k = 0; k < arc.x.size(); ++k)
    short_arc.push_back(0.1 + 0.02 * static_cast<double>(k));  // sine of the rod from 0.2 to 0
  EXPECT_THAT(reasons(measure(arc, m, 1, short_arc)), IsEmpty());
  for (double& a : short_arc) a += 0.7;
  EXPECT_THAT(reasons(measure(arc, m, 1, short_arc)), IsEmpty());
  m.parameters.offset = -0.2;
  EXPECT_THAT(reasons(measure(arc, m, 1, short_arc)), ElementsAre("pressure_angle"));
}

TEST(SliderPathProblem, OrderOfFreeTiming) {
  SliderPathProblem p = printed_eighteen_slider_points();
  p.timing = Timing::free;
  const SliderCrankMechanism m = slider_crank(at(path_case("T4.2"), "inputs.design"));
  auto angles = angles_of(p, 0);
  EXPECT_THAT(measure(p, m, 1, angles).violations, IsEmpty());
  EXPECT_EQ(measure(p, m, -1, angles).violations.at(0).reason, "order");
  std::swap(angles[3], angles[4]);
  EXPECT_EQ(measure(p, m, 1, angles).violations.at(0).reason, "order");
}

TEST(SliderPathProblem, CandidatesAreUnwrapped) {
  SliderPathProblem p = printed_eighteen_slider_points();
  p.timing = Timing::free;
  std::vector<double> x = {0.3, 0.6, 0.4, 1, 0.5, 0.1, 0, 0};
  for (std::size_t k = 0; k < 18; ++k) x.push_back(std::fmod(5 + 0.3 * static_cast<double>(k), 2 * pi));
  const SliderPathDesign d = design_of(p, SliderSide::forward, 1, x);
  EXPECT_NEAR(d.angles.back(), 5 + 0.3 * 17, 1e-12);
  EXPECT_THAT(d.violations, IsEmpty());
  const auto variables = path_population_problem(p, SliderSide::forward, 1).variables;
  EXPECT_EQ(variables.size(), 26u);
  EXPECT_EQ(variables[2].name, "point_distance_m");
  EXPECT_EQ(variables[8].name, "crank_angle_1_rad");
}

TEST(SliderPathProblem, RefusesWhatIsNoProblem) {
  const auto refused = [](auto&& change) {
    SliderPathProblem p = printed_eighteen_slider_points();
    change(p);
    try {
      require_valid(p);
    } catch (const ContractError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_THAT(refused([](auto& p) { p.x.resize(2), p.y.resize(2); }), HasSubstr("at least 3 points"));
  EXPECT_THAT(refused([](auto& p) { p.angles.pop_back(); }), HasSubstr("17 angles for 18 points"));
  EXPECT_THAT(refused([](auto& p) { p.bounds[1] = {0, 0}; }), HasSubstr("bounds of rod are 0 to 0"));
  EXPECT_THAT(refused([](auto& p) { p.max_pressure_angle = 2; }), HasSubstr("greatest pressure angle"));
  EXPECT_THAT(refused([](auto& p) { p.stroke = {2, 1}; }), HasSubstr("stroke is limited to 2 to 1"));
  EXPECT_THAT(refused([](auto& p) { p.crank_rotates_fully = false, p.stroke.upper = 1; }),
              HasSubstr("the crank need not rotate fully"));
  EXPECT_EQ(refused([](auto& p) { p.timing = Timing::free, p.angles.clear(); }), "none");
}

}  // namespace
}  // namespace linkwright::planar
