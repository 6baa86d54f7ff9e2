// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/quality.h"

#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/four_bar/four_bar.h"
#include "linkwright/planar/linkage/kernel.h"
#include "linkwright/planar/linkage/motion.h"
#include "linkwright/planar/linkage/samples.h"
#include "tests/planar/linkage_cases.h"

namespace linkwright::planar {
namespace {

void move(const LinkagePlan& p, double value, double rate, double acceleration, LinkageMotion& m) {
  const std::vector<InputMotion> in{{value, rate, acceleration}};
  solve_motion(p, in, m);
  ASSERT_EQ(m.status, Status::done);
}

TEST(LinkageQuality, TransmissionAngleIsThatOfTheFourBar) {
  const FourBar four_bar{.ground = 0.6, .crank = 0.1, .coupler = 0.4, .rocker = 0.32};
  const LinkagePlan p = planned(four_bar_linkage(0.6, 0.1, 0.4, 0.32));
  LinkageMotion m(p);
  for (int i = 0; i < 40; ++i) {
    move(p, 0.17 * i, 1, 0, m);
    // Rounding of the directions.
    EXPECT_NEAR(transmission_angle(p, m, 1), position(four_bar, 0.17 * i).transmission_angle, 1e-14);
  }
  EXPECT_EQ(transmission_angle(p, m, 0), pi / 2);
  const TransmissionAngles extremes = transmission_angles(four_bar);
  const std::vector<TransmissionRange> r =
      transmission_ranges(p, std::vector<double>{0}, 0, -1, 2 * pi - 1, 73, m);
  ASSERT_EQ(r.size(), 1u);
  EXPECT_EQ(r[0].group, 1u);
  EXPECT_NEAR(r[0].minimum, extremes.minimum, 1e-14);
  // The maximum is a kink at a right angle: known as well as the input.
  EXPECT_NEAR(r[0].maximum, extremes.maximum, 1e-7);
  EXPECT_EQ(r[0].missing, 0u);
}

TEST(LinkageQuality, PressureAnglesOfSlides) {
  // Rod of 0.15 on a crank of 0.05: tan of the rod's slope against the slide is the pressure angle.
  const LinkagePlan p = planned(slider_crank_sample().linkage);
  LinkageMotion m(p);
  move(p, 1.1, 1, 0, m);
  EXPECT_NEAR(pressure_angle(p, m, 1), std::asin(0.05 * std::sin(1.1) / 0.15), 1e-14);
  const std::vector<TransmissionRange> r = transmission_ranges(p, std::vector<double>{0}, 0, 0, pi, 31, m);
  EXPECT_NEAR(r[0].minimum, std::acos(0.05 / 0.15), 1e-14);
  EXPECT_NEAR(r[0].minimum_at, pi / 2, 1e-6);
  // A sleeve without offset is pushed at a right angle.
  Linkage l = grounded({{"O", {0, 0}}, {"B0", {0.14, 0}}});
  add_bar(l, "crank", "O", "A", 0.05);
  add_bar(l, "rod", "A", "end", 0.2);
  add_body(l, "sleeve", {{"B0", {0, 0}}});
  add_pin(l, "O", "ground.O", "crank.O");
  add_pin(l, "A", "crank.A", "rod.A");
  add_slide(l, "sleeve", "rod.A", "sleeve.B0");
  add_pin(l, "B0", "ground.B0", "sleeve.B0");
  add_drive(l, "O");
  const LinkagePlan q = planned(l);
  LinkageMotion n(q);
  move(q, 0.8, 1, 0, n);
  EXPECT_NEAR(transmission_angle(q, n, 1), pi / 2, 1e-14);
}

TEST(LinkageQuality, JointMotionIsItsOwnDerivative) {
  const double h = 1e-5;
  for (const LinkageSample& s : {whitworth_sample(), inverted_slider_crank_sample(), scotch_yoke_sample(),
                                 offset_slider_crank_sample()}) {
    SCOPED_TRACE(s.name);
    const LinkagePlan p = planned(s.linkage);
    LinkageMotion m(p);
    for (int joint = 0; joint < static_cast<int>(s.linkage.joints.size()); ++joint) {
      const auto at = [&](double dt) {
        move(p, 0.7 + 2 * dt + 1.5 * dt * dt, 2 + 3 * dt, 3, m);
        return joint_motion(s.linkage, p, m, joint);
      };
      const JointMotion a = at(-h), b = at(h), c = at(0);
      // Error h^2 times third derivatives, rounding over h.
      EXPECT_NEAR(std::remainder(b.value - a.value, 2 * pi) / (2 * h), c.rate, 1e-6) << joint;
      EXPECT_NEAR((b.rate - a.rate) / (2 * h), c.acceleration, 1e-6) << joint;
    }
    const JointMotion drive = joint_motion(s.linkage, p, m, s.linkage.driven[0]);
    EXPECT_NEAR(drive.value, 0.7, 1e-15);
    EXPECT_NEAR(drive.rate, 2, 1e-15);
  }
}

TEST(LinkageQuality, AdvantageIsTheRatioOfForces) {
  // A force on the slider and the torque that the drive needs to hold it: virtual work, by the reactions.
  LinkageSample s = offset_slider_crank_sample();
  for (LinkageBody& b : s.linkage.bodies) b.mass = BodyMass{};
  const std::complex<double> push = std::polar(100.0, 0.25 + pi);
  s.linkage.forces.push_back({"push", point_named(s.linkage, "slider.B"), push, false, {}});
  const LinkagePlan p = planned(s.linkage);
  LinkageMotion m(p);
  LinkageForces f;
  for (int i = 0; i < 12; ++i) {
    const std::vector<InputMotion> in{{0.4 + 0.5 * i, 0, 0}};
    solve_motion(p, in, m);
    solve_forces(s.linkage, p, m, 0, 0, f);
    const Advantage a = advantage(s.linkage, p, 0, joint_index(s.linkage, "guide"), m);
    EXPECT_NEAR(f.drives[0], 100 * a.rate_ratio, 1e-12);
    EXPECT_NEAR(f.drives[0] * a.force_ratio, 100, 1e-10);
  }
}

TEST(LinkageQuality, ThreeInstantCentresLieOnALine) {
  for (const Linkage& l : {jansen_leg(), whitworth_sample().linkage}) {
    const LinkagePlan p = planned(l);
    LinkageMotion m(p);
    move(p, 0.9, 1, 0, m);
    const int n = static_cast<int>(l.bodies.size());
    const std::vector<InstantCentre> all = instant_centres(p, m);
    ASSERT_EQ(all.size(), static_cast<std::size_t>(n * (n - 1) / 2));
    int lines = 0;
    for (int i = 0; i < n; ++i)
      for (int j = i + 1; j < n; ++j)
        for (int k = j + 1; k < n; ++k) {
          const InstantCentre a = instant_centre(p, m, i, j), b = instant_centre(p, m, j, k),
                              c = instant_centre(p, m, i, k);
          if (a.kind != InstantCentre::Kind::point || b.kind != a.kind || c.kind != a.kind) continue;
          ++lines;
          const math::Vec2 u = b.position - a.position, v = c.position - a.position;
          // Rounding of the positions over the shortest of the sides.
          EXPECT_NEAR(cross(u, v) / (norm(u) * norm(v) + 1e-6), 0, 1e-9);
        }
    EXPECT_GE(lines, 5);
  }
}

TEST(LinkageQuality, CentresOfPinsAndSlidesAreWhereTheyAre) {
  const LinkageSample s = slider_crank_sample();
  const LinkagePlan p = planned(s.linkage);
  LinkageMotion m(p);
  move(p, 0.9, 1, 0, m);
  const int crank = 1, rod = 2, slider = 3;
  const InstantCentre pin = instant_centre(p, m, crank, rod);
  ASSERT_EQ(pin.kind, InstantCentre::Kind::point);
  EXPECT_NEAR(pin.position.x, 0.05 * std::cos(0.9), 1e-15);
  EXPECT_NEAR(pin.position.y, 0.05 * std::sin(0.9), 1e-15);
  const InstantCentre slide = instant_centre(p, m, 0, slider);
  ASSERT_EQ(slide.kind, InstantCentre::Kind::at_infinity);
  EXPECT_NEAR(std::abs(slide.direction.y), 1, 1e-15);
  // The rod turns about the point over the slider pin, in line with the crank.
  const InstantCentre pole = instant_centre(p, m, 0, rod);
  EXPECT_NEAR(pole.position.y, pole.position.x * std::tan(0.9), 1e-14);
  EXPECT_NEAR(pole.position.x, joint_motion(s.linkage, p, m, joint_index(s.linkage, "guide")).value, 1e-14);
  EXPECT_EQ(instant_centre(p, m, 0, 0).kind, InstantCentre::Kind::undetermined);
}

TEST(LinkageQuality, CentrodesOfAnEllipticTrammelAreCircles) {
  // Cardan's circles: the moving one, of diameter L, rolls inside the fixed one, of twice the diameter.
  const double length = 0.3;
  Linkage l = grounded({{"O", {0, 0}}});
  add_body(l, "block_x", {{"A", {0, 0}}});
  add_body(l, "block_y", {{"B", {0, 0}}});
  add_bar(l, "beam", "A", "B", length);
  add_slide(l, "x", "ground.O", "block_x.A", 0);
  add_slide(l, "y", "ground.O", "block_y.B", pi / 2, pi / 2);
  add_pin(l, "A", "block_x.A", "beam.A");
  add_pin(l, "B", "beam.B", "block_y.B");
  add_drive(l, "x");
  set_mode(l, "beam", "block_y", AssemblyMode::plus);
  const LinkagePlan p = planned(l);
  LinkageMotion m(p);
  const Table t = centrodes(p, std::vector<double>{0}, 0, 0.05, 0.25, 9, 3, 0, m);
  ASSERT_EQ(t.rows(), 9u);
  for (std::size_t i = 0; i < 9; ++i) {
    EXPECT_EQ(t.status[i], "done");
    EXPECT_NEAR(std::hypot(t.find("fixed_x_m")->values[i], t.find("fixed_y_m")->values[i]), length, 1e-14);
    EXPECT_NEAR(std::hypot(t.find("moving_x_m")->values[i] - length / 2, t.find("moving_y_m")->values[i]),
                length / 2, 1e-14);
  }
  EXPECT_EQ(t.columns[0].key, "input_m");
  // Each point of the moving circle runs along a straight line: it is the inflection circle.
  const std::vector<InputMotion> in{{0.12, 0.3, 0.7}};
  solve_motion(p, in, m);
  const PoleGeometry g = pole_geometry(p, m, 3);
  ASSERT_TRUE(g.turns);
  EXPECT_NEAR(g.circle_radius, length / 2, 1e-14);
  EXPECT_NEAR(g.inflection_pole.x, 0, 1e-14);
  EXPECT_NEAR(g.inflection_pole.y, 0, 1e-14);
}

TEST(LinkageQuality, InflectionCircleHoldsThePointsWithoutCurvature) {
  const LinkagePlan p = planned(four_bar_linkage(0.6, 0.1, 0.4, 0.32));
  LinkageMotion m(p);
  move(p, 1.3, 2, 5, m);
  // Bodies that no pin joins: coupler and ground, rocker and crank.
  for (const auto& [body, reference] : {std::pair{2, 0}, std::pair{3, 1}}) {
    const PoleGeometry g = pole_geometry(p, m, body, reference);
    const PartState<double> base = body_state(p, m, reference),
                            s = relative_motion(base, body_state(p, m, body));
    for (int i = 1; i < 8; ++i) {
      const math::Vec2 start = g.pole - g.circle_centre;
      const math::Vec2 x = g.circle_centre + rotate(math::unit(0.7 * i), start);
      const math::Vec2 r = rotate_inverse(base.direction, x - base.origin);
      const PointMotion point{r, velocity_at(s, r), acceleration_at(s, r)};
      EXPECT_NEAR(path_curvature(point) * g.circle_radius, 0, 1e-11);
    }
    const math::Vec2 still = rotate_inverse(base.direction, g.acceleration_pole - base.origin);
    EXPECT_NEAR(norm(acceleration_at(s, still)), 0, 1e-12);
  }
  // A point that runs round a pivot has the curvature of its circle.
  EXPECT_NEAR(path_curvature(point_motion(p, m, 1, {0.1, 0})), 10, 1e-12);
  EXPECT_NEAR(std::abs(path_curvature(point_motion(p, m, 3, {0.32, 0}))), 1 / 0.32, 1e-11);
}

}  // namespace
}  // namespace linkwright::planar
