// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/motion.h"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/math/differences.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/linkage/general.h"
#include "planar/four_bars.h"
#include "planar/linkage_changes.h"
#include "planar/linkages.h"
#include "support/allocations.h"
#include "support/message.h"
#include "support/published.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using ::testing::HasSubstr;

TEST(LinkageMotion, PointsAndJointsByName) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_bar(l, "crank", "O", "A", 2);
  add_pin(l, "main", "ground.O", "crank.O");
  add_drive(l, "main");
  set_uniform(l, "crank", 3);
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  const InputMotion input{pi / 2, 4, 0};
  solve_motion(p, {&input, 1}, m);
  const PointMotion tip = point_motion(l, p, m, "crank.A");
  EXPECT_NEAR(tip.position.y, 2, 1e-15);
  EXPECT_NEAR(tip.velocity.x, -8, 1e-14);
  EXPECT_NEAR(tip.acceleration.y, -32, 1e-13);
  LinkageForces forces;
  solve_forces(l, p, m, 0, input.value, forces);
  // 3 kg on a circle of 1 m at 4 rad/s, and their weight.
  EXPECT_NEAR(joint_reaction(l, forces, "main").force.y, -48 + 3 * 9.81, 1e-12);
  EXPECT_THROW(point_motion(l, p, m, "crank.B"), ContractError);
  EXPECT_THROW(point_motion(l, p, m, "A"), ContractError);
  EXPECT_THROW(joint_reaction(l, forces, "O"), ContractError);
}

// Positions and speeds of all parts as functions of the time, with rates and accelerations as their
// derivatives; the difference quotient sets its own tolerance from its step.
TEST(LinkageMotion, RatesAreDerivatives) {
  for (const LinkageSample& s : linkage_samples()) {
    SCOPED_TRACE(s.name);
    const LinkagePlan p = planned(s.linkage);
    LinkageMotion m(p), n(p);
    const std::size_t parts = p.parts.size() - 1, rows = 7 * parts;
    double last = 0;
    for (const double sense : {1.0, -1.0})
      for (int i = 0; i < 12; ++i) {
        const double share = (i + 0.3) / 12.5;
        ASSERT_NO_FATAL_FAILURE(go_to(s, p, last, share, m));
        last = share;
        const std::vector<InputMotion> start = inputs_at(s, share, sense * 2, 3);
        const std::vector<PartState<double>> places = m.parts;
        const auto motion = [&](std::span<const double> x, std::span<double> r, std::span<double> jacobian) {
          const double t = x[0];
          std::vector<InputMotion> in = start;
          for (InputMotion& k : in)
            k = {k.value + k.rate * t + 0.5 * k.acceleration * t * t, k.rate + k.acceleration * t,
                 k.acceleration};
          n.parts = places;
          solve_motion(p, in, n);
          for (std::size_t k = 0; k < parts; ++k) {
            const PartState<double>& b = n.parts[k + 1];
            const math::Vec2 turning = b.speed * perpendicular(b.direction);
            const double values[] = {b.origin.x,   b.origin.y,   b.direction.x, b.direction.y,
                                     b.velocity.x, b.velocity.y, b.speed};
            const double rates[] = {
                b.velocity.x,     b.velocity.y,          turning.x, turning.y, b.acceleration.x,
                b.acceleration.y, b.angular_acceleration};
            // Shifted beyond what such a value is, so that those that stay zero have a size to compare with.
            const double sizes[] = {3 * p.size, 3 * p.size, 2, 2, 6 * p.size, 6 * p.size, 10};
            for (std::size_t c = 0; c < 7; ++c) {
              r[7 * k + c] = sizes[c] + values[c];
              if (!jacobian.empty()) jacobian[7 * k + c] = rates[c];
            }
          }
          return n.status == Status::done;
        };
        const std::vector<double> now{0}, scale{0.05};
        const math::JacobianCheck check = math::check_jacobian(motion, rows, now, scale);
        EXPECT_TRUE(check.passed) << "share " << share << " row " << check.row << ": " << check.analytic
                                  << " against " << check.numeric << ": off by " << check.deviation << " of "
                                  << check.tolerance;
      }
  }
}

// A linkage that is turned and shifted moves as the original, turned and shifted; so does a mirrored one with
// mirrored inputs.
TEST(LinkageMotion, TurnsShiftsAndMirrorsWithTheLinkage) {
  for (const LinkageSample& s : linkage_samples()) {
    SCOPED_TRACE(s.name);
    const LinkagePlan p = planned(s.linkage);
    for (const Change& change :
         {Change{0.9, {0.3, -0.2}, false}, Change{0, {0, 0}, true}, Change{-2.1, {-0.1, 0.4}, true}}) {
      const LinkageSample changed = apply(change, s);
      const LinkagePlan q = planned(changed.linkage);
      LinkageMotion m(p), n(q);
      for (int i = 0; i <= 24; ++i) {
        const double share = i / 24.0, last = std::max(0, i - 1) / 24.0;
        ASSERT_NO_FATAL_FAILURE(go_to(s, p, last, share, m));
        ASSERT_NO_FATAL_FAILURE(go_to(changed, q, last, share, n));
        const std::vector<InputMotion> in = inputs_at(s, share, s.speed, 2);
        solve_motion(p, in, m);
        solve_motion(q, apply(change, s.linkage, in), n);
        for (const BodyPoint& t : s.traces) {
          const std::complex<double> at = s.linkage.bodies[index(t.body)].points[index(t.point)].at;
          const PointMotion a = point_motion(p, m, t.body, at),
                            b = point_motion(q, n, t.body, change.mirrored ? std::conj(at) : at);
          // Accelerations carry the rounding of the place over the sine of the worst transmission, squared.
          EXPECT_LE(norm(change.point(a.position) - b.position), 1e-13);
          EXPECT_LE(norm(change.vector(a.velocity) - b.velocity), 1e-11 * std::max(1.0, norm(a.velocity)));
          EXPECT_LE(norm(change.vector(a.acceleration) - b.acceleration),
                    1e-9 * std::max(1.0, norm(a.acceleration)));
        }
      }
    }
  }
}

// The other sense of turning: the same places, opposite velocities, the same accelerations.
TEST(LinkageMotion, RunsBackwards) {
  for (const LinkageSample& s : linkage_samples()) {
    SCOPED_TRACE(s.name);
    const LinkagePlan p = planned(s.linkage);
    LinkageMotion m(p), n(p);
    ASSERT_NO_FATAL_FAILURE(go_to(s, p, 0, 0.37, m));
    n.parts = m.parts;
    solve_motion(p, inputs_at(s, 0.37, s.speed), m);
    solve_motion(p, inputs_at(s, 0.37, -s.speed), n);
    for (std::size_t k = 0; k < m.parts.size(); ++k) {
      EXPECT_EQ(m.parts[k].velocity.x, -n.parts[k].velocity.x);
      EXPECT_EQ(m.parts[k].speed, -n.parts[k].speed);
      EXPECT_EQ(m.parts[k].acceleration.y, n.parts[k].acceleration.y);
    }
  }
}

// ---- against the closed forms of single mechanisms

RC_GTEST_PROP(LinkageMotionOfAFourBar, AgreesWithItsClosedForm, ()) {
  const FourBar b = *any_four_bar();
  const double angle = *any_angle(), speed = *between(-5, 5), acceleration = *between(-9, 9);
  const FourBarPosition place = position(b, angle);
  const FourBarRates r = rates(b, angle, speed, acceleration);
  const Linkage l = linkage_of(b);
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  const std::vector<InputMotion> in{{b.frame_angle + angle, speed, acceleration}};
  solve_motion(p, in, m);
  if (m.status == Status::no_assembly) {
    // Links that just meet may be on either side by rounding.
    RC_ASSERT(place.status != Status::done || place.transmission_angle < 1e-5);
    if (place.status == Status::no_assembly)
      RC_ASSERT(std::abs(m.gap - place.gap) <= 1e-12 * (b.ground + b.crank + b.coupler + b.rocker));
    return;
  }
  RC_PRE(place.status == Status::done && std::abs(r.transmission_sine) > 1e-3);
  RC_ASSERT(m.status == Status::done);
  // Rounding grows with the inverse sine once for places and rates, three times for accelerations.
  const double size = b.ground + b.crank + b.coupler + b.rocker + std::abs(b.pivot_x) + std::abs(b.pivot_y),
               s = std::abs(r.transmission_sine), ratio = size / std::min({b.coupler, b.rocker});
  const double near = 1e-14 * ratio / s;
  const PartState<double> coupler = body_state(p, m, 2), rocker = body_state(p, m, 3);
  RC_ASSERT(norm(place_of(l, p, m, "coupler.B") - math::vec(place.coupler_pin)) <= near * size);
  RC_ASSERT(norm(place_of(l, p, m, "coupler.C") - math::vec(place.coupler_point)) <=
            near * (size + std::abs(b.coupler_u) + std::abs(b.coupler_v)));
  RC_ASSERT(norm(coupler.direction - math::vec(r.coupler_direction)) <= near);
  const double fast = 1 + std::max(std::abs(r.coupler_speed), std::abs(r.rocker_speed));
  RC_ASSERT(std::abs(coupler.speed - r.coupler_speed) <= 10 * near * ratio / s * fast);
  RC_ASSERT(std::abs(rocker.speed - r.rocker_speed) <= 10 * near * ratio / s * fast);
  const double hard = fast * fast + std::abs(r.coupler_acceleration) + std::abs(r.rocker_acceleration);
  RC_ASSERT(std::abs(rocker.angular_acceleration - r.rocker_acceleration) <=
            100 * near * ratio * ratio / s / s * hard);
  RC_ASSERT(std::abs(m.groups[1].sine - r.transmission_sine) <= near / s);
}

// Slider-crank with inclined guide at a signed offset (path synthesis of single-degree linkages, Eqs. (4.7)
// to (4.11) with the sign of the stroke kept).
RC_GTEST_PROP(LinkageMotionOfASliderCrank, AgreesWithItsFormula, ()) {
  const double l2 = *log_between(0.1, 2), slack = *between(0.01, 3), h = *between(-1, 1),
               l3 = l2 + std::abs(h) + slack, l4 = *between(0, 2), beta = *any_angle(), delta = *any_angle(),
               theta2 = *any_angle();
  const std::complex<double> a(*between(-1, 1), *between(-1, 1)), i(0, 1), e = std::polar(1.0, delta);
  Linkage l = grounded({{"A", a}, {"guide", a - h * i * e}});
  add_bar(l, "crank", "A", "B", l2);
  add_body(l, "rod", {{"B", {0, 0}}, {"slider", {l3, 0}}, {"C", std::polar(l4, beta)}});
  add_body(l, "slider", {{"pin", {0, 0}}});
  add_pin(l, "A", "ground.A", "crank.A");
  add_pin(l, "B", "crank.B", "rod.B");
  add_pin(l, "pin", "rod.slider", "slider.pin");
  add_slide(l, "guide", "ground.guide", "slider.pin", delta);
  add_drive(l, "A");
  set_mode(l, "rod", "slider", AssemblyMode::plus);
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  const std::vector<InputMotion> in{{theta2, 1, 0}};
  solve_position(p, in, m);
  RC_ASSERT(m.status == Status::done);
  const double theta3 = delta + std::asin(-(h + l2 * std::sin(theta2 - delta)) / l3);
  const std::complex<double> c = a + std::polar(l2, theta2) + std::polar(l4, theta3 + beta),
                             slider = a +
                                      (l2 * std::cos(theta2 - delta) + l3 * std::cos(theta3 - delta)) * e -
                                      h * i * e;
  // asin loses half of its digits towards 1: slack over l3 is at least 0.01 / 4.
  RC_ASSERT(norm(place_of(l, p, m, "rod.C") - math::vec(c)) <= 1e-12);
  RC_ASSERT(norm(place_of(l, p, m, "slider.pin") - math::vec(slider)) <= 1e-12);
}

// ---- published chains of dyads

struct Chain {
  Linkage linkage;
  const char* key;
  const char* point;
};
TEST(LinkageMotion, MeetsThePublishedChains) {
  using linkwright::test::at;
  using linkwright::test::numbers;
  const Value& entry = linkwright::test::published_case("path-synthesis.json", "CHAINS");
  const auto base = [](std::vector<LinkagePoint> ground) {
    Linkage l = grounded(std::move(ground));
    add_bar(l, "crank", "O", "A", 0.5);
    add_pin(l, "O", "ground.O", "crank.O");
    add_drive(l, "O");
    return l;
  };
  const auto four_bar = [&](LinkagePoint pivot) {
    Linkage l = base({{"O", {0, 0}}, {"B0", {1.4, 0}}, std::move(pivot)});
    add_body(l, "coupler", {{"A", {0, 0}}, {"B", {1.3, 0}}, {"C", {0.8, 0.6}}});
    add_body(l, "rocker", {{"B0", {0, 0}}, {"B", {1.0, 0}}, {"D", {0.7, -0.4}}});
    add_pin(l, "A", "crank.A", "coupler.A");
    add_pin(l, "B", "coupler.B", "rocker.B");
    add_pin(l, "B0", "ground.B0", "rocker.B0");
    set_mode(l, "coupler", "rocker", AssemblyMode::plus);
    return l;
  };
  const auto second = [](Linkage& l, const char* from, double a, double b, AssemblyMode mode) {
    add_bar(l, "link", "from", "E", a);
    add_bar(l, "output", "to", "E", b);
    add_pin(l, "from", from, "link.from");
    add_pin(l, "E", "link.E", "output.E");
    add_pin(l, "to", "ground.P", "output.to");
    set_mode(l, "link", "output", mode);
  };
  Linkage plain = four_bar({"P", {0, 1}}), stephenson = four_bar({"P", {2.3, 0.9}}),
          watt = four_bar({"P", {2.6, -0.2}}), five = base({{"O", {0, 0}}, {"D0", {1.2, 0}}}),
          slider = base({{"O", {0, 0}}, {"guide", {0.2, -0.1}}}),
          inverted = base({{"O", {0, 0}}, {"B0", {1.4, 0}}});
  second(stephenson, "coupler.C", 1.4, 1.3, AssemblyMode::minus);
  second(watt, "rocker.D", 1.3, 1.2, AssemblyMode::plus);
  add_bar(five, "second", "D0", "D", 0.7);
  add_bar(five, "left", "A", "P", 1.5);
  add_bar(five, "right", "D", "P", 1.4);
  add_pin(five, "D0", "ground.D0", "second.D0");
  add_pin(five, "A", "crank.A", "left.A");
  add_pin(five, "D", "second.D", "right.D");
  add_pin(five, "P", "left.P", "right.P");
  add_gear(five, "gear", "crank", "second", -2, 0.4);
  set_mode(five, "left", "right", AssemblyMode::plus);
  add_bar(slider, "rod", "A", "C", 1.6);
  add_body(slider, "slider", {{"C", {0, 0}}, {"on line", {0, -0.15}}});
  add_pin(slider, "A", "crank.A", "rod.A");
  add_pin(slider, "C", "rod.C", "slider.C");
  add_slide(slider, "guide", "ground.guide", "slider.on line", 0.25);
  set_mode(slider, "rod", "slider", AssemblyMode::plus);
  add_body(inverted, "carrier", {{"B0", {0, 0}}, {"slide", {0, 0.2}}});
  add_body(inverted, "block", {{"A", {0, 0}}});
  add_pin(inverted, "B0", "ground.B0", "carrier.B0");
  add_slide(inverted, "slide", "carrier.slide", "block.A");
  add_pin(inverted, "A", "crank.A", "block.A");
  set_mode(inverted, "carrier", "block", AssemblyMode::plus);
  const Chain chains[] = {{plain, "fourbar_B", "coupler.B"},
                          {stephenson, "stephenson3_E", "link.E"},
                          {watt, "watt2_H", "link.E"},
                          {five, "geared_fivebar_P", "left.P"},
                          {slider, "slider_crank_C_and_t", "rod.C"}};
  for (const char* degrees : {"30", "140", "255"}) {
    const Value& values = at(entry, std::string("computed.by_crank_angle_deg.") + degrees);
    const std::vector<InputMotion> in{{std::stod(degrees) * pi / 180, 0, 0}};
    for (const Chain& c : chains) {
      const LinkagePlan p = planned(c.linkage);
      LinkageMotion m(p);
      solve_position(p, in, m);
      const std::vector<double> expected = numbers(at(values, c.key));
      const math::Vec2 found = place_of(c.linkage, p, m, c.point);
      EXPECT_NEAR(found.x, expected[0], 1e-10) << c.key << " at " << degrees;
      EXPECT_NEAR(found.y, expected[1], 1e-10) << c.key << " at " << degrees;
    }
    const LinkagePlan p = planned(inverted);
    LinkageMotion m(p);
    solve_position(p, in, m);
    const std::vector<double> expected = numbers(at(values, "inverted_slider_angle_and_t"));
    const PartState<double> carrier = body_state(p, m, 2);
    EXPECT_NEAR(std::remainder(angle_of(carrier.direction) - expected[0], 2 * pi), 0, 1e-10);
    EXPECT_NEAR(dot(carrier.direction, place_of(inverted, p, m, "block.A") - carrier.origin), expected[1],
                1e-10);
  }
}

// ---- what cannot be

TEST(LinkageMotion, TellsWhereItCannotBeAssembled) {
  Linkage l = linkage_of({.ground = 2, .crank = 1, .coupler = 1.2, .rocker = 1.3});
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  const std::vector<InputMotion> far{{pi, 1, 0}}, near{{0.3, 1, 0}};
  solve_motion(p, far, m);
  EXPECT_EQ(m.status, Status::no_assembly);
  EXPECT_EQ(m.failed_group, 1);
  EXPECT_NEAR(m.gap, 3 - 2.5, 1e-14);
  EXPECT_NEAR(place_of(l, p, m, "crank.A").x, -1, 1e-15);  // the good part is kept
  EXPECT_TRUE(std::isnan(body_state(p, m, 2).origin.x));
  EXPECT_TRUE(std::isnan(body_state(p, m, 2).speed));
  LinkageForces f;
  set_uniform_all(l, 1);
  solve_forces(l, planned(l), m, 0, 0, f);
  EXPECT_EQ(f.status, Status::no_assembly);
  EXPECT_TRUE(std::isnan(f.drives[0]));
  solve_motion(p, near, m);
  EXPECT_EQ(m.status, Status::done);
  EXPECT_EQ(m.gap, 0);
}
TEST(LinkageMotion, TellsHowFarASliderOrSleeveIsFromClosing) {
  Linkage rrp = grounded({{"O", {0, 0}}, {"guide", {0, 0.5}}});
  add_bar(rrp, "crank", "O", "A", 0.3);
  add_bar(rrp, "rod", "A", "B", 0.4);
  add_body(rrp, "slider", {{"B", {0, 0}}});
  add_pin(rrp, "O", "ground.O", "crank.O");
  add_pin(rrp, "A", "crank.A", "rod.A");
  add_pin(rrp, "B", "rod.B", "slider.B");
  add_slide(rrp, "guide", "ground.guide", "slider.B");
  add_drive(rrp, "O");
  LinkagePlan p = planned(rrp);
  LinkageMotion m(p);
  const std::vector<InputMotion> down{{-pi / 2, 1, 0}}, up{{pi / 2, 1, 0}};
  solve_motion(p, down, m);
  EXPECT_EQ(m.status, Status::no_assembly);
  EXPECT_NEAR(m.gap, 0.8 - 0.4, 1e-15);
  solve_motion(p, up, m);
  EXPECT_EQ(m.status, Status::done);

  Linkage rpr = grounded({{"O", {0, 0}}, {"B0", {0.35, 0}}});
  add_bar(rpr, "crank", "O", "A", 0.3);
  add_body(rpr, "rod", {{"A", {0, 0}}});
  add_body(rpr, "sleeve", {{"B0", {0, 0}}, {"slide", {0, 0.2}}});
  add_pin(rpr, "O", "ground.O", "crank.O");
  add_pin(rpr, "A", "crank.A", "rod.A");
  add_slide(rpr, "slide", "rod.A", "sleeve.slide");
  add_pin(rpr, "B0", "ground.B0", "sleeve.B0");
  add_drive(rpr, "O");
  p = planned(rpr);
  LinkageMotion n(p);
  const std::vector<InputMotion> zero{{0, 1, 0}};
  solve_motion(p, zero, n);
  EXPECT_EQ(n.status, Status::no_assembly);
  EXPECT_NEAR(n.gap, 0.2 - 0.05, 1e-15);
}
TEST(LinkageMotion, KeepsThePlaceButNoRatesAtADeadPoint) {
  const Linkage l = linkage_of({.ground = 2, .crank = 1, .coupler = 1.5, .rocker = 1.5});
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  const std::vector<InputMotion> fine{{1.0, 1, 0}}, dead{{pi, 1, 0}};
  solve_motion(p, fine, m);
  solve_motion(p, dead, m);
  EXPECT_EQ(m.status, Status::singular);
  EXPECT_NEAR(place_of(l, p, m, "coupler.B").x, 0.5, 1e-7);
  EXPECT_TRUE(std::isnan(body_state(p, m, 2).speed));
  EXPECT_TRUE(std::isnan(body_state(p, m, 2).acceleration.x));
}
TEST(LinkageMotion, RefusesWrongInputs) {
  const LinkageSample& s = linkage_sample("four_bar");
  const LinkagePlan p = planned(s.linkage);
  LinkageMotion m(p);
  const std::vector<InputMotion> none, nan{{std::nan(""), 0, 0}};
  EXPECT_THAT(test::message([&] { solve_position(p, none, m); }),
              HasSubstr("the linkage has 1 inputs, got 0"));
  EXPECT_THAT(test::message([&] { solve_position(p, nan, m); }), HasSubstr("must be finite"));
  const std::vector<double> one{0}, two{0, 1};
  EXPECT_THAT(test::message([&] { follow(p, one, two, m); }),
              HasSubstr("the linkage has 1 inputs, got 1 and 2"));
}

// ---- following general groups

TEST(Follow, ComesBackToTheStart) {
  for (const char* name : {"stephenson_2", "triad"}) {
    SCOPED_TRACE(name);
    const LinkageSample& s = linkage_sample(name);
    const LinkagePlan p = planned(s.linkage);
    LinkageMotion m(p);
    const std::vector<double> from{0}, whole{2 * pi};
    std::vector<InputMotion> start{{0, 1, 0}};
    solve_position(p, start, m);
    const std::vector<PartState<double>> before = m.parts;
    for (const auto& [a, b] : {std::pair{from, whole}, std::pair{whole, from}}) {
      const FollowReport report = follow(p, a, b, m);
      EXPECT_TRUE(report.arrived);
      EXPECT_EQ(report.reached, 1);
      for (std::size_t k = 0; k < before.size(); ++k) {
        EXPECT_LE(norm(m.parts[k].origin - before[k].origin), 1e-13);
        EXPECT_LE(norm(m.parts[k].direction - before[k].direction), 1e-13);
      }
    }
  }
}
// The same places whatever the steps: no step leaps to another branch.
TEST(Follow, DoesNotDependOnTheSteps) {
  for (const char* name : {"stephenson_2", "triad"}) {
    SCOPED_TRACE(name);
    const LinkageSample& s = linkage_sample(name);
    const LinkagePlan p = planned(s.linkage);
    LinkageMotion once(p), often(p);
    const double sign = determinant_sign(*[&] {
      const std::vector<InputMotion> start{{0, 1, 0}};
      solve_position(p, start, often);
      return often.general[1].get();
    }());
    double last = 0;
    for (int i = 1; i <= 360; ++i) {
      ASSERT_NO_FATAL_FAILURE(go_to(s, p, last, i / 360.0, often));
      last = i / 360.0;
      EXPECT_EQ(determinant_sign(*often.general[1]), sign);
      if (i % 60 != 0) continue;
      LinkageMotion fresh(p);
      ASSERT_NO_FATAL_FAILURE(go_to(s, p, 0, last, fresh));
      for (std::size_t k = 0; k < fresh.parts.size(); ++k)
        EXPECT_LE(norm(fresh.parts[k].origin - often.parts[k].origin), 1e-13);
    }
  }
}
// A four-bar that cannot turn, solved all at once: the way ends at its dead point, where coupler and rocker
// are in line: cos = (1 + 4 - 2.5^2) / 4.
TEST(Follow, StopsAtTheLimitOfMotion) {
  Linkage l = linkage_of({.ground = 2, .crank = 1, .coupler = 1.2, .rocker = 1.3});
  const LinkagePlan p = planned(l, PlanRoute::all_at_once), along = planned(l);
  LinkageMotion m(p), start(along);
  const std::vector<InputMotion> first{{0.5, 1, 0}};
  solve_position(along, first, start);
  m.parts = start.parts;
  const std::vector<double> from{0.5}, to{3.0};
  const FollowReport report = follow(p, from, to, m);
  EXPECT_FALSE(report.arrived);
  EXPECT_EQ(m.status, Status::limit_reached);
  EXPECT_NEAR(0.5 + 2.5 * report.reached, std::acos(-1.25 / 4), 1e-6);
  EXPECT_LE(report.reached, (std::acos(-1.25 / 4) - 0.5) / 2.5);
  EXPECT_LE(open_joints(l, p, m), 1e-13);  // stays at the last good place
}
TEST(Follow, TellsThatThereIsNoStart) {
  const LinkageSample& s = linkage_sample("triad");
  Linkage l = s.linkage;
  l.bodies[index(body_index(l, "bar 1"))].points[1].at += 10.0;  // far too long
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  const FollowReport report = follow(p, s.from, s.to, m);
  EXPECT_FALSE(report.arrived);
  EXPECT_EQ(report.reached, 0);
  EXPECT_EQ(m.status, Status::not_converged);
  EXPECT_EQ(m.failed_group, 1);
  EXPECT_GT(m.gap, 1);
}

TEST(LinkageMotion, AllocatesNothingAfterWarmUp) {
  for (const LinkageSample& s : linkage_samples()) {
    SCOPED_TRACE(s.name);
    const LinkagePlan p = planned(s.linkage);
    LinkageMotion m(p);
    LinkageForces f;
    const std::vector<InputMotion> in = inputs_at(s, 0, s.speed, 1);
    const auto once = [&] {
      solve_motion(p, in, m);
      solve_forces(s.linkage, p, m, 0, in[0].value, f);
    };
    once();
    const std::size_t before = test::allocations();
    once();
    EXPECT_EQ(test::allocations(), before);
  }
}

}  // namespace
}  // namespace linkwright::planar
