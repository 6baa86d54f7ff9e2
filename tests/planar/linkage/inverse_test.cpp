// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/inverse.h"

#include <gmock/gmock.h>

#include <cmath>
#include <complex>
#include <numeric>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/dynamics.h"
#include "planar/linkages.h"
#include "support/published.h"

namespace linkwright::planar {
namespace {

using namespace test;
using math::Vec2;
using std::complex;

constexpr double degrees = pi / 180;

// Boom and stick with pins that turn them.
Linkage arm(double boom_angle, double stick_angle) {
  Linkage l = grounded({{"O", {0, 0}}});
  add_bar(l, "boom", "O", "B", 3.0);
  add_bar(l, "stick", "B", "T", 1.8);
  add_pin(l, "O", "ground.O", "boom.O");
  add_pin(l, "B", "boom.B", "stick.B");
  add_drive(l, "O");
  add_drive(l, "B");
  set_start(l, "boom", 0, boom_angle);
  set_start(l, "stick", std::polar(3.0, boom_angle), stick_angle);
  return l;
}

// The same, moved by two cylinders, as in tests/published.
Linkage excavator(double boom_angle, double stick_angle) {
  Linkage l = grounded({{"O", {0, 0}}, {"D", {0.4, -0.5}}});
  add_body(l, "boom", {{"O", {0, 0}}, {"B", {3, 0}}, {"C", {1.2, 0.35}}, {"E", {1.3, 0.45}}});
  add_body(l, "stick", {{"B", {0, 0}}, {"F", {-0.45, 0.12}}, {"T", {1.8, 0}}});
  for (const char* name : {"barrel 1", "piston 1", "barrel 2", "piston 2"})
    add_body(l, name, {{"P", {0, 0}}});
  add_pin(l, "O", "ground.O", "boom.O");
  add_pin(l, "B", "boom.B", "stick.B");
  add_pin(l, "D", "ground.D", "barrel 1.P");
  add_pin(l, "C", "boom.C", "piston 1.P");
  add_pin(l, "E", "boom.E", "barrel 2.P");
  add_pin(l, "F", "stick.F", "piston 2.P");
  add_slide(l, "boom cylinder", "barrel 1.P", "piston 1.P");
  add_slide(l, "stick cylinder", "barrel 2.P", "piston 2.P");
  add_drive(l, "boom cylinder");
  add_drive(l, "stick cylinder");
  const complex<double> boom = std::polar(1.0, boom_angle), stick = std::polar(1.0, stick_angle);
  const complex<double> d{0.4, -0.5}, c = complex{1.2, 0.35} * boom, e = complex{1.3, 0.45} * boom,
                                      b = 3.0 * boom, f = b + complex{-0.45, 0.12} * stick;
  set_start(l, "boom", 0, boom_angle);
  set_start(l, "stick", b, stick_angle);
  set_start(l, "barrel 1", d, std::arg(c - d));
  set_start(l, "piston 1", c, std::arg(c - d));
  set_start(l, "barrel 2", e, std::arg(f - e));
  set_start(l, "piston 2", f, std::arg(f - e));
  return l;
}

FollowedPoint followed(const Linkage& l, std::string_view name,
                       FollowedCoordinates coordinates = FollowedCoordinates::point) {
  const BodyPoint p = point_named(l, name);
  FollowedPoint out{p.body, l.bodies[index(p.body)].points[index(p.point)].at, coordinates, {}};
  out.drives.resize(drives_of(coordinates));
  std::iota(out.drives.begin(), out.drives.end(), 0u);
  return out;
}

PointPath line_to(Vec2 to, double duration) {
  PointPath path;
  path.steps.push_back({PathLine{{to.x, to.y}, {}, {duration, {}}}});
  return path;
}

std::vector<InputMotion> drawn(const LinkagePlan& plan) {
  std::vector<InputMotion> out;
  for (const double value : plan.drawn_inputs) out.push_back({value, 0, 0});
  return out;
}

PathDrives along(const Linkage& l, const LinkagePlan& plan, const FollowedPoint& point,
                 const PointPathMotion& path, std::vector<double> times) {
  const std::vector<InputMotion> from = drawn(plan);
  const auto start = path_start(plan, point, from, from, path(0));
  EXPECT_TRUE(start);
  const std::vector<std::optional<math::MotionCurve>> laws(plan.inputs());
  return start ? follow_path(l, plan, point, path, laws, *start, times) : PathDrives{};
}

TEST(LinkageInverse, BoomAndStickFollowALineAsInTheReference) {
  Linkage l = excavator(20 * degrees, -60 * degrees);
  without_mass(l);
  l.forces.push_back({"load", point_named(l, "stick.T"), {0, -12000}});
  const LinkagePlan plan = planned(l);
  ASSERT_EQ(plan.drawn_inputs.size(), 2u);
  const FollowedPoint point = followed(l, "stick.T");
  const PointPathMotion path(line_to({2.6, -1.6}, 4), {4.2, -0.5}, 0);
  const PathDrives found = along(l, plan, point, path, {0, 1, 2, 3.3, 4});
  ASSERT_EQ(found.status, Status::done);
  ASSERT_EQ(found.rows.size(), 5u);
  EXPECT_EQ(found.share, 1);
  const Value& rows = at(published_case("planar-machines.json", "boom-and-stick-on-a-line"), "computed.rows");
  LinkageMotion motion(plan);
  LinkageForces forces;
  for (std::size_t i = 0; i < 5; ++i) {
    const std::vector<double> wanted = numbers(rows.as_array()[i]);
    const PathRow& row = found.rows[i];
    solve_motion(plan, row.inputs, motion);
    const Vec2 tip = place_of(l, plan, motion, "stick.T");
    EXPECT_NEAR(tip.x, wanted[1], 1e-14);
    EXPECT_NEAR(tip.y, wanted[2], 1e-14);
    EXPECT_NEAR(angle_of(body_state(plan, motion, body_index(l, "boom")).direction), wanted[3] * degrees,
                1e-13);
    EXPECT_NEAR(angle_of(body_state(plan, motion, body_index(l, "stick")).direction), wanted[4] * degrees,
                1e-13);
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_NEAR(row.inputs[k].value, wanted[5 + k], 1e-10);
      EXPECT_NEAR(row.inputs[k].rate, wanted[7 + k], 1e-7);
    }
    solve_forces(l, plan, motion, row.time, row.inputs[0].value, forces);
    ASSERT_EQ(forces.status, Status::done);
    for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(forces.drives[k], wanted[9 + k], 0.01);
  }
}

// Rates and accelerations against differences of the drives found at neighbouring times, and the power of the
// drives against the change of energy of the moving masses.
TEST(LinkageInverse, RatesAndPowerAgreeWithSecondRoutes) {
  Linkage l = excavator(20 * degrees, -60 * degrees);
  for (std::size_t b = 1; b < l.bodies.size(); ++b)
    l.bodies[b].mass =
        BodyMass{.mass = 40.0 + 10 * static_cast<double>(b), .inertia = 7, .centre = {0.4, 0.1}};
  const LinkagePlan plan = planned(l);
  const FollowedPoint point = followed(l, "stick.T");
  const PointPathMotion path(line_to({2.6, -1.6}, 4), {4.2, -0.5}, 0);
  constexpr double h = 1e-4;
  const PathDrives found = along(l, plan, point, path, {1.1 - h, 1.1, 1.1 + h, 2.7 - h, 2.7, 2.7 + h});
  ASSERT_EQ(found.rows.size(), 6u);
  for (const std::size_t m : {1u, 4u}) {
    double energy[3];
    LinkageMotion motion(plan);
    LinkageForces forces;
    for (std::size_t i = 0; i < 3; ++i) {
      solve_motion(plan, found.rows[m - 1 + i].inputs, motion);
      energy[i] = kinetic_energy(plan, motion) + potential_energy(l, plan, motion);
    }
    solve_motion(plan, found.rows[m].inputs, motion);
    solve_forces(l, plan, motion, 0, 0, forces);
    double power = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      const InputMotion &a = found.rows[m - 1].inputs[k], &q = found.rows[m].inputs[k],
                        &b = found.rows[m + 1].inputs[k];
      EXPECT_NEAR((b.value - a.value) / (2 * h), q.rate, 1e-8);
      EXPECT_NEAR((b.rate - a.rate) / (2 * h), q.acceleration, 1e-8);
      power += forces.drives[k] * q.rate;
    }
    EXPECT_NEAR(power, (energy[2] - energy[0]) / (2 * h), 1e-6 * std::abs(power));
  }
}

TEST(LinkageInverse, PathThatLeavesTheReachEndsWhereTheArmIsStretched) {
  for (const double side : {1.0, -1.0}) {
    const Linkage l = arm(side * 20 * degrees, -side * 60 * degrees);
    const LinkagePlan plan = planned(l);
    const FollowedPoint point = followed(l, "stick.T");
    const PointPathMotion path(line_to({5.2, 0}, 2), {4.2, 0}, 0);
    std::vector<double> times;
    for (int i = 0; i <= 200; ++i) times.push_back(0.01 * i);
    const PathDrives found = along(l, plan, point, path, times);
    EXPECT_EQ(found.status, Status::limit_reached);
    EXPECT_NEAR(
        found.share,
        number_at(published_case("planar-machines.json", "path-leaves-reach"), "computed.reached_share"),
        1e-12);
    EXPECT_NEAR(found.last.position.x, 4.8, 1e-12);
    EXPECT_EQ(to_string(found.reason), "'boom' and 'stick' are stretched");
    // It stays on its side of the stretched position, and comes near it.
    ASSERT_GT(found.rows.size(), 100u);
    EXPECT_GT(found.rows.back().inputs[0].value * side, 0);
    EXPECT_LT(found.rows.back().conditioning, 0.1);
  }
}

// A path that ends at the edge of the reach is whole; its last row has no rates.
TEST(LinkageInverse, PathMayEndWhereTheArmIsStretched) {
  const Linkage l = arm(20 * degrees, -60 * degrees);
  const LinkagePlan plan = planned(l);
  const PointPathMotion path(line_to({4.8, 0}, 1), {4.2, 0}, 0);
  const PathDrives found = along(l, plan, followed(l, "stick.T"), path, {0, 0.5, 1});
  EXPECT_EQ(found.status, Status::done);
  ASSERT_EQ(found.rows.size(), 3u);
  EXPECT_FALSE(found.rows[1].singular);
  EXPECT_TRUE(found.rows[2].singular);
  EXPECT_EQ(found.share, 1);
}

TEST(LinkageInverse, FoldedArmIsNamed) {
  const Linkage l = arm(20 * degrees, 160 * degrees);
  const LinkagePlan plan = planned(l);
  const PointPathMotion path(line_to({0.8, 0}, 1), {2.2, 0}, 0);
  const PathDrives found = along(l, plan, followed(l, "stick.T"), path, {0, 0.25, 0.5, 0.75, 1});
  EXPECT_EQ(found.status, Status::limit_reached);
  EXPECT_NEAR(found.last.position.x, 1.2, 1e-11);
  EXPECT_EQ(to_string(found.reason), "'boom' and 'stick' are folded");
}

// One freedom: x of the piston, on the side where the crank is drawn.
TEST(LinkageInverse, PistonTurnsTheCrankOnTheSideOfTheDrawing) {
  const Value& c = published_case("planar-machines.json", "slider-crank-inverse");
  for (const int side : {0, 1}) {
    Linkage l = grounded({{"O", {0, 0}}});
    add_bar(l, "crank", "O", "A", 0.05);
    add_bar(l, "rod", "A", "B", 0.15);
    add_body(l, "piston", {{"B", {0, 0}}});
    add_pin(l, "O", "ground.O", "crank.O");
    add_pin(l, "A", "crank.A", "rod.A");
    add_pin(l, "B", "rod.B", "piston.B");
    add_slide(l, "guide", "ground.O", "piston.B");
    add_drive(l, "O");
    const complex<double> a = std::polar(0.05, (side ? -1 : 1) * 80 * degrees);
    const double x = a.real() + std::sqrt(0.0225 - a.imag() * a.imag());
    set_start(l, "crank", 0, std::arg(a));
    set_start(l, "rod", a, std::arg(x - a));
    set_start(l, "piston", x, 0);
    const LinkagePlan plan = planned(l);
    const FollowedPoint point = followed(l, "piston.B", FollowedCoordinates::x);
    const PointPathMotion path(line_to({0.21, 0}, 1), {0.18, 0}, 0);
    const PathDrives found = along(l, plan, point, path, {0, 0.2, 0.4, 0.6, 0.8, 1});
    EXPECT_NEAR(found.rows[0].inputs[0].value / degrees, numbers(at(c, "computed.crank_deg"))[side], 1e-11);
    EXPECT_EQ(found.status, Status::limit_reached);
    EXPECT_NEAR(found.last.position.x, numbers(at(c, "computed.singular_at_x_m"))[1], 1e-13);
    EXPECT_NEAR(found.share, 2.0 / 3, 1e-11);
    EXPECT_EQ(to_string(found.reason), "'crank' and 'rod' are stretched");
  }
}

// A platform on three cylinders.
Linkage platform() {
  const complex<double> feet[] = {{0, 0}, {1, 0}, {0.4, 0.9}}, corners[] = {{0, 0}, {0.3, 0}, {0.1, 0.25}};
  const complex<double> home{0.35, 0.25}, turn = std::polar(1.0, 0.1);
  Linkage l = grounded({{"A0", feet[0]}, {"A1", feet[1]}, {"A2", feet[2]}});
  add_body(l, "plate", {{"B0", corners[0]}, {"B1", corners[1]}, {"B2", corners[2]}, {"T", {0.15, 0.1}}});
  set_start(l, "plate", home, 0.1);
  for (int k = 0; k < 3; ++k) {
    const std::string i = std::to_string(k);
    add_body(l, "barrel " + i, {{"A", {0, 0}}});
    add_body(l, "piston " + i, {{"B", {0, 0}}});
    add_pin(l, "A" + i, "ground.A" + i, "barrel " + i + ".A");
    add_pin(l, "B" + i, "piston " + i + ".B", "plate.B" + i);
    add_slide(l, "leg " + i, "barrel " + i + ".A", "piston " + i + ".B");
    add_drive(l, "leg " + i);
    const complex<double> b = home + corners[k] * turn;
    set_start(l, "barrel " + i, feet[k], std::arg(b - feet[k]));
    set_start(l, "piston " + i, b, std::arg(b - feet[k]));
  }
  return l;
}

// A body on three legs is led along a path with its angle; a loop without closed form.
TEST(LinkageInverse, PlatformIsLedWithItsAngle) {
  const Linkage l = platform();
  const LinkagePlan plan = planned(l);
  ASSERT_EQ(plan.inputs(), 3u);
  const std::vector<InputMotion> home = drawn(plan);
  ASSERT_EQ(home.size(), 3u);
  LinkageMotion motion(plan);
  solve_motion(plan, home, motion);
  ASSERT_EQ(motion.status, Status::done);
  const FollowedPoint point = followed(l, "plate.T", FollowedCoordinates::pose);
  const int body = point.body;
  const PointMotion at_home = point_motion(plan, motion, body, point.at);
  const double angle = angle_of(body_state(plan, motion, body).direction);
  PointPath path;
  const Vec2 to = at_home.position + Vec2{0.02 * plan.size, 0.01 * plan.size};
  path.steps.push_back({PathLine{{to.x, to.y}, angle + 0.05, {1.0, {}}}});
  const PointPathMotion led(path, at_home.position, angle);
  const std::vector<std::optional<math::MotionCurve>> laws(3);
  const auto start = path_start(plan, point, home, home, led(0));
  ASSERT_TRUE(start);
  const PathDrives found = follow_path(l, plan, point, led, laws, *start, std::vector{0.0, 0.4, 1.0});
  ASSERT_EQ(found.status, Status::done);
  std::vector<double> a, b;
  for (std::size_t k = 0; k < 3; ++k) a.push_back(home[k].value), b.push_back(found.rows[1].inputs[k].value);
  ASSERT_TRUE(follow(plan, a, b, motion).arrived);
  solve_motion(plan, found.rows[1].inputs, motion);
  const PathState wanted = led(0.4);
  const PointMotion p = point_motion(plan, motion, body, point.at);
  const PartState<double> state = body_state(plan, motion, body);
  EXPECT_NEAR(norm(p.position - wanted.position), 0, 1e-12 * plan.size);
  EXPECT_NEAR(norm(p.velocity - wanted.velocity), 0, 1e-11 * plan.size);
  EXPECT_NEAR(norm(p.acceleration - wanted.acceleration), 0, 1e-10 * plan.size);
  EXPECT_NEAR(angle_of(state.direction), wanted.angle, 1e-12);
  EXPECT_NEAR(state.speed, wanted.speed, 1e-11);
  EXPECT_NEAR(state.angular_acceleration, wanted.angular_acceleration, 1e-10);
}

}  // namespace
}  // namespace linkwright::planar
