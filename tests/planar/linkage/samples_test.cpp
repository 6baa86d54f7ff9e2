// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/samples.h"

#include <gmock/gmock.h>

#include <cmath>
#include <set>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/general.h"
#include "planar/linkages.h"
#include "support/message.h"
#include "support/published.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;

// Calls `look(share, plan, motion)` at `count` + 1 positions from one end of the sample to the other.
template <class Look>
void sweep(const LinkageSample& s, int count, Look&& look) {
  const LinkagePlan p = planned(s.linkage);
  LinkageMotion m(p);
  double last = 0;
  for (int i = 0; i <= count; ++i) {
    const double share = static_cast<double>(i) / count;
    ASSERT_NO_FATAL_FAILURE(go_to(s, p, last, share, m));
    last = share;
    solve_motion(p, inputs_at(s, share, s.speed), m);
    ASSERT_EQ(m.status, Status::done) << s.name << " at share " << share;
    look(share, p, m);
  }
}

TEST(LinkageSamples, AreComplete) {
  std::set<std::string> seen;
  for (const LinkageSample& s : linkage_samples()) {
    SCOPED_TRACE(s.name);
    EXPECT_TRUE(seen.insert(s.name).second);
    EXPECT_FALSE(s.summary.empty());
    EXPECT_FALSE(s.traces.empty());
    EXPECT_EQ(s.from.size(), s.linkage.driven.size());
    EXPECT_EQ(s.to.size(), s.linkage.driven.size());
    EXPECT_EQ(mobility(s.linkage), static_cast<int>(s.linkage.driven.size()));
    EXPECT_EQ(&linkage_sample(s.name), &s);
    const LinkagePlan p = planned(s.linkage);
    EXPECT_TRUE(p.has_masses);
    for (const Group& g : p.groups) {
      EXPECT_TRUE(!traits_of(g).has_modes || g.mode_given) << g.name;
      const GeneralGroup* general = g.as<GeneralGroup>();
      EXPECT_TRUE(!general || !general->start.empty()) << g.name;
    }
  }
  EXPECT_GE(seen.size(), 22u);
  EXPECT_THAT(test::message([] { linkage_sample("perpetuum_mobile"); }),
              ::testing::HasSubstr("there is no sample 'perpetuum_mobile'"));
  EXPECT_THAT(test::message([] { arm_sample(0); }),
              ::testing::HasSubstr("an arm has at least 1 link, got 0"));
  EXPECT_THAT(test::message([] { four_bar_chain_sample(0); }),
              ::testing::HasSubstr("a chain has at least 1 loop, got 0"));
}

TEST(LinkageSamples, FallIntoTheGroupsTheirNamesPromise) {
  const auto groups = [](std::string_view name) {
    std::vector<std::string_view> out;
    for (const Group& g : planned(linkage_sample(name).linkage).groups) out.push_back(traits_of(g).name);
    return out;
  };
  const auto driver = "driver", gear = "gear", rrr = "RRR", rrp = "RRP", rpr = "RPR", rpp = "RPP",
             general = "general";
  using ::testing::ElementsAre;
  EXPECT_THAT(groups("four_bar"), ElementsAre(driver, rrr));
  EXPECT_THAT(groups("slider_crank"), ElementsAre(driver, rrp));
  EXPECT_THAT(groups("inverted_slider_crank"), ElementsAre(driver, rpr));
  EXPECT_THAT(groups("scotch_yoke"), ElementsAre(driver, rpp));
  EXPECT_THAT(groups("whitworth"), ElementsAre(driver, rpr, rrp));
  EXPECT_THAT(groups("toggle_press"), ElementsAre(driver, rrr, rrp));
  for (const char* name : {"watt_1", "watt_2", "stephenson_3", "klann_leg"})
    EXPECT_THAT(groups(name), ElementsAre(driver, rrr, rrr)) << name;
  for (const char* name : {"jansen_leg", "peaucellier", "andrews_squeezer"})
    EXPECT_THAT(groups(name), ElementsAre(driver, rrr, rrr, rrr)) << name;
  EXPECT_THAT(groups("stephenson_2"), ElementsAre(driver, general));
  EXPECT_THAT(groups("triad"), ElementsAre(driver, general));
  EXPECT_THAT(groups("geared_five_bar"), ElementsAre(driver, gear, rrr));
  EXPECT_THAT(groups("arm"), ElementsAre(driver, driver, driver));
}

// All joints closed to the rounding of a few operations; angles are unit vectors, so slides stay parallel.
TEST(LinkageSamples, CloseEveryJointOverTheirWholeRange) {
  for (const LinkageSample& s : linkage_samples()) {
    SCOPED_TRACE(s.name);
    double worst = 0, told = 0;
    const double size = planned(s.linkage).size;
    sweep(s, 360, [&](double, const LinkagePlan& p, const LinkageMotion& m) {
      worst = std::max(worst, open_joints(s.linkage, p, m));
      told = std::max(told, m.closure_residual);
    });
    EXPECT_LE(worst, 1e-13 * std::max(size, 1.0));
    EXPECT_LE(told, 1e-13 * std::max(size, 1.0));
  }
}

// The two ends of a turn are one place.
TEST(LinkageSamples, ComeBackAfterATurn) {
  for (const LinkageSample& s : linkage_samples()) {
    if (std::abs(s.to[0] - s.from[0] - 2 * pi) > 1e-12) continue;
    SCOPED_TRACE(s.name);
    math::Vec2 start{0, 0}, end{0, 0};
    sweep(s, 90, [&](double share, const LinkagePlan& p, const LinkageMotion& m) {
      if (share == 0) start = place_of(s.linkage, p, m, s.traces[0]);
      if (share == 1) end = place_of(s.linkage, p, m, s.traces[0]);
    });
    EXPECT_LE(norm(end - start), 1e-13 * std::max(1.0, size_of(s.linkage)));
  }
}

TEST(ScotchYoke, MovesAsTheCosine) {
  const LinkageSample& s = linkage_sample("scotch_yoke");
  sweep(s, 360, [&](double share, const LinkagePlan& p, const LinkageMotion& m) {
    const double angle = 2 * pi * share;
    const PointMotion end = point_motion(p, m, body_index(s.linkage, "yoke"), {0.12, 0});
    EXPECT_NEAR(end.position.x, 0.12 + 0.05 * std::cos(angle), 1e-15);
    EXPECT_NEAR(end.position.y, 0, 1e-16);
    EXPECT_NEAR(end.velocity.x, -0.05 * s.speed * std::sin(angle), 1e-14);
    EXPECT_NEAR(end.acceleration.x, -0.05 * s.speed * s.speed * std::cos(angle), 1e-13);
  });
}

// |O P| |O pen| = arm^2 - side^2 = 0.0675 m2, and P runs on a circle of radius 0.1 m through O: the line is
// at x = 0.0675 / 0.2.
TEST(Peaucellier, DrawsAStraightLine) {
  const LinkageSample& s = linkage_sample("peaucellier");
  double low = 0, high = 0;
  sweep(s, 720, [&](double, const LinkagePlan& p, const LinkageMotion& m) {
    const math::Vec2 pen = place_of(s.linkage, p, m, "side 3.pen");
    EXPECT_NEAR(pen.x, 0.3375, 1e-13);
    low = std::min(low, pen.y), high = std::max(high, pen.y);
  });
  EXPECT_NEAR(high, 0.3375 * std::tan(0.65), 1e-13);  // the pen lies on the line from O through P
  EXPECT_NEAR(low, -high, 1e-13);
}

// A, the pen and B0 see each other under a right angle (Thales: B is the middle of A and the pen, and as far
// from B0), so the height of the pen is (2 - c) sqrt((20 + 4 c) / (5 - 4 c)) crank lengths for c = cos of the
// crank angle: exactly 4 at 90, 180 and 270 deg. Between them its largest value, at c = -5/8, is
// sqrt(16.078125): a deviation of 0.24 % of the straight stroke of four crank lengths.
TEST(Hoeken, IsStraightOverHalfATurn) {
  const LinkageSample& s = linkage_sample("hoeken");
  double low = 1e9, high = -1e9, left = 1e9, right = -1e9;
  sweep(s, 720, [&](double share, const LinkagePlan& p, const LinkageMotion& m) {
    const math::Vec2 pen = 10.0 * place_of(s.linkage, p, m, "coupler.pen");
    const double c = std::cos(2 * pi * share);
    EXPECT_NEAR(pen.y, (2 - c) * std::sqrt((20 + 4 * c) / (5 - 4 * c)), 1e-13);
    if (share < 0.25 || share > 0.75) return;
    low = std::min(low, pen.y), high = std::max(high, pen.y);
    left = std::min(left, pen.x), right = std::max(right, pen.x);
  });
  EXPECT_NEAR(low, 4, 1e-13);
  EXPECT_NEAR(high, std::sqrt(16.078125), 1e-5);  // sampled every half degree
  EXPECT_NEAR(right, 4, 1e-13);
  EXPECT_NEAR(right - left, 4.0, 0.4);
}

// In units of a twentieth metre: ground 4, cranks 5, coupler 2. The middle of the coupler is at height 4 in
// the middle and where a crank stands upright; between, it keeps to 0.3 % of the line's length of 4.
TEST(Chebyshev, IsStraightBetweenUprightCranks) {
  const LinkageSample& s = linkage_sample("chebyshev");
  const LinkagePlan p = planned(s.linkage);
  LinkageMotion m(p);
  const auto pen = [&](double angle) {
    const std::vector<InputMotion> in{{angle, 1, 0}};
    solve_motion(p, in, m);
    EXPECT_EQ(m.status, Status::done);
    return 20.0 * place_of(s.linkage, p, m, "coupler.pen");
  };
  EXPECT_NEAR(pen(std::atan2(4, 3)).y, 4, 1e-13);
  EXPECT_NEAR(pen(std::atan2(4, 3)).x, 2, 1e-13);
  EXPECT_NEAR(pen(pi / 2).y, 4, 1e-13);
  EXPECT_NEAR(pen(pi / 2).x, 0, 1e-13);
  double low = 1e9, high = -1e9;
  for (int i = 0; i <= 400; ++i) {
    const math::Vec2 here = pen(0.66 + (pi / 2 - 0.66) * i / 400);
    low = std::min(low, here.y), high = std::max(high, here.y);
  }
  EXPECT_GE(low, 4 - 0.012);
  EXPECT_LE(high, 4 + 0.012);
}

// The pen is twice as far from O as the tracer, on the same line, for any two inputs.
TEST(Pantograph, CopiesTwiceAsLarge) {
  const LinkageSample& s = linkage_sample("pantograph");
  const LinkagePlan p = planned(s.linkage);
  LinkageMotion m(p);
  for (double a = -3; a < 3; a += 0.4)
    for (double b = -2.8; b < -0.2; b += 0.2) {
      const std::vector<InputMotion> in{{a, 1, 0}, {b, -2, 0}};
      solve_motion(p, in, m);
      ASSERT_EQ(m.status, Status::done);
      const PointMotion tracer = point_motion(p, m, body_index(s.linkage, "inner"), {0.15, 0}),
                        pen = point_motion(p, m, body_index(s.linkage, "outer"), {0.3, 0});
      EXPECT_LE(norm(pen.position - 2.0 * tracer.position), 1e-15);
      // The sine of the parallelogram's angle is above 0.19: rounding times ten.
      EXPECT_LE(norm(pen.velocity - 2.0 * tracer.velocity), 1e-14);
    }
}

TEST(GearedFiveBar, KeepsTheRatio) {
  const LinkageSample& s = linkage_sample("geared_five_bar");
  sweep(s, 90, [&](double share, const LinkagePlan& p, const LinkageMotion& m) {
    const PartState<double> second = body_state(p, m, body_index(s.linkage, "second crank"));
    EXPECT_NEAR(second.speed, -2 * s.speed, 1e-14);
    EXPECT_LE(norm(second.direction - math::unit(0.4 - 2 * 2 * pi * share)), 1e-14);
  });
}

// Lowest and highest place of a traced point, and how long a stretch of the turn it is within `band` of the
// lowest.
struct Gait {
  double low = 1e9, high = -1e9, left = 1e9, right = -1e9, grounded = 0;
};
Gait gait(const LinkageSample& s, double band) {
  Gait g;
  std::vector<double> heights;
  sweep(s, 720, [&](double, const LinkagePlan& p, const LinkageMotion& m) {
    const math::Vec2 foot = place_of(s.linkage, p, m, s.traces[0]);
    heights.push_back(foot.y);
    g.low = std::min(g.low, foot.y), g.high = std::max(g.high, foot.y);
    g.left = std::min(g.left, foot.x), g.right = std::max(g.right, foot.x);
  });
  for (double y : heights) g.grounded += y < g.low + band ? 1.0 / static_cast<double>(heights.size()) : 0;
  return g;
}

// The designer states a stride of 1.000 and a step of 52.3 % of it; his coordinates have three decimals, and
// the stride is counted over the half turn on the ground.
TEST(KlannLeg, WalksAsStated) {
  const LinkageSample& s = linkage_sample("klann_leg");
  double left = 1e9, right = -1e9;
  const LinkagePlan p = planned(s.linkage);
  LinkageMotion m(p);
  for (int i = 0; i <= 180; ++i) {
    const std::vector<InputMotion> in{{pi + pi * i / 180, 1, 0}};
    solve_motion(p, in, m);
    const math::Vec2 foot = place_of(s.linkage, p, m, "leg.foot");
    left = std::min(left, foot.x), right = std::max(right, foot.x);
  }
  EXPECT_NEAR(right - left, 1.0, 0.01);
  const Gait g = gait(s, 0.06);
  EXPECT_NEAR(g.high - g.low, 0.523, 0.01);
  EXPECT_GT(g.grounded, 0.45);
}

TEST(JansenLeg, KeepsItsFootLevelHalfTheTime) {
  const Gait g = gait(linkage_sample("jansen_leg"), 0.02);
  // In units of 1 cm the foot's path is 68 long and 22 high.
  EXPECT_NEAR(g.right - g.left, 0.679, 0.001);
  EXPECT_NEAR(g.high - g.low, 0.2245, 0.001);
  EXPECT_GT(g.grounded, 0.4);
}

TEST(TogglePress, MultipliesTheForceNearTheEndOfItsStroke) {
  const LinkageSample& s = linkage_sample("toggle_press");
  double worst = 0, load = 0;
  const LinkagePlan p = planned(s.linkage);
  LinkageMotion m(p);
  LinkageForces f;
  for (int i = 0; i < 720; ++i) {
    const std::vector<InputMotion> in{{2 * pi * i / 720, 1e-3, 0}};  // slowly: no inertia to speak of
    solve_motion(p, in, m);
    solve_forces(s.linkage, p, m, 0, in[0].value, f);
    worst = std::max(worst, std::abs(f.drives[0]));
    load = std::max(load, f.loads[0].force.y);
  }
  EXPECT_GT(load, 15e3);
  EXPECT_LT(worst, 0.25 * load * 0.04);  // relative to the force that the crank alone would need
}

TEST(FourBarChain, KeepsItsRockersParallel) {
  for (int loops : {1, 4, 40}) {
    const LinkageSample s = four_bar_chain_sample(loops);
    EXPECT_EQ(s.linkage.bodies.size(), static_cast<std::size_t>(2 * loops + 2));
    sweep(s, 36, [&](double, const LinkagePlan& p, const LinkageMotion& m) {
      const PartState<double> first = body_state(p, m, 1),
                              last =
                                  body_state(p, m, body_index(s.linkage, "rocker " + std::to_string(loops)));
      EXPECT_LE(norm(last.direction - first.direction), 1e-14 * loops);
      EXPECT_NEAR(last.speed, first.speed, 1e-13 * loops);
    });
  }
}

// Test set for initial value problem solvers: consistent start of the Andrews problem.
TEST(AndrewsSqueezer, StartsAsPublished) {
  using linkwright::test::number_at;
  const Value& c = linkwright::test::published_case("multibody-benchmarks.json", "A03-andrews-squeezer");
  const auto text = [&](const Value& v) { return std::stod(v.as_string()); };
  const auto& q = linkwright::test::at(c, "inputs.start.q0_rad").as_array();
  const LinkageSample& s = linkage_sample("andrews_squeezer");
  const LinkagePlan p = planned(s.linkage);
  LinkageMotion m(p);
  LinkageForces f;
  std::vector<InputMotion> in{{text(q[0]), 0, 0}};
  // The drive torque is affine in the crank's acceleration: find the one that needs no drive.
  const auto torque = [&](double acceleration) {
    in[0].acceleration = acceleration;
    solve_motion(p, in, m);
    solve_forces(s.linkage, p, m, 0, 0, f);
    return f.drives[0];
  };
  const double at_rest = torque(0), slope = (torque(1e4) - at_rest) / 1e4;
  const double dd_beta = -at_rest / slope;
  EXPECT_NEAR(torque(dd_beta), 0, 1e-14);
  const auto body = [&](const char* name) { return body_state(p, m, body_index(s.linkage, name)); };
  const auto angle = [&](const char* name) { return angle_of(body(name).direction); };
  EXPECT_NEAR(angle("K2") - angle("K1"), text(q[1]), 1e-13);
  EXPECT_NEAR(angle("K3"), text(q[2]), 1e-13);
  EXPECT_NEAR(angle("K5"), text(q[4]), 1e-13);
  EXPECT_NEAR(angle("K4") - angle("K5"), text(q[3]), 1e-13);
  EXPECT_NEAR(angle("K7"), text(q[6]), 1e-13);
  EXPECT_NEAR(angle("K6") - angle("K7"), text(q[5]), 1e-13);
  const double published_beta = text(linkwright::test::at(c, "inputs.start.dd_beta0")),
               published_theta = text(linkwright::test::at(c, "inputs.start.dd_theta0"));
  EXPECT_NEAR(dd_beta, published_beta, 1e-10 * published_beta);
  EXPECT_NEAR(body("K2").angular_acceleration - body("K1").angular_acceleration, published_theta,
              1e-10 * published_beta);
  // The published multipliers are the force in the loop over B: K3 on K2 would carry them at E, and the same
  // equations at the other loops do not vanish because the spring pulls on K3 and the crank is driven.
  const double lambda1 = text(linkwright::test::at(c, "inputs.start.lambda1_0")),
               lambda2 = text(linkwright::test::at(c, "inputs.start.lambda2_0"));
  const JointReaction& e2 = f.joints[index(joint_index(s.linkage, "E2"))];
  EXPECT_NEAR(std::abs(e2.force.x), std::abs(lambda1), 1e-9 * lambda1);
  EXPECT_NEAR(std::abs(e2.force.y), std::abs(lambda2), 1e-9 * lambda1);
}

}  // namespace
}  // namespace linkwright::planar
