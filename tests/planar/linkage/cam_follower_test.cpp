// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/detail/cam_follower.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <span>
#include <string>
#include <vector>

#include "linkwright/planar/cam/follower_forces.h"
#include "planar/cams.h"
#include "planar/linkages.h"

// Cams as members of linkages, against the closed forms of follower_cases, other routes and differences.
namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using testing::HasSubstr;

constexpr double follower_mass = 1.8, follower_inertia = 0.01, camshaft_speed = 60;

// The programme of another follower whose coordinate counts the other way, or is mirrored.
CamProgramme counted_the_other_way(CamProgramme p) {
  p.start = -p.start;
  for (CamSegment& s : p.segments) s.to = -s.to;
  return p;
}
CamProgramme lift_and_back() {
  return {.segments = {{CamLaw::cycloidal, 120 * degree, 0.02, {}},
                       {CamLaw::dwell, 60 * degree, 0, {}},
                       {CamLaw::polynomial_345, 120 * degree, 0, {}},
                       {CamLaw::dwell, 60 * degree, 0, {}}}};
}
CamProgramme swing_and_return() {
  return {.segments = {{CamLaw::polynomial_345, 110 * degree, 20 * degree, {}},
                       {CamLaw::dwell, 50 * degree, 0, {}},
                       {CamLaw::modified_sine, 120 * degree, 0, {}},
                       {CamLaw::dwell, 80 * degree, 0, {}}}};
}

// A cam at O under a follower as planar/cam has it; with a mirror everything at -x.
struct CamMachine {
  Linkage linkage;
  LinkagePlan plan;
};
CamMachine cam_machine(Linkage l, PlanRoute route = PlanRoute::along_groups) {
  PlanResult r = plan_linkage(l, route);
  EXPECT_TRUE(r.problems.empty()) << (r.problems.empty() ? "" : to_string(r.problems[0].message));
  return {std::move(l), std::move(r.plan)};
}
Linkage linkage_with(const DiscCam& cam, CamProgramme programme, double mirror = 1) {
  const bool is_flat = cam.face == FollowerFace::flat;
  Linkage l = grounded({{"O", {0, 0}}, {"G", {mirror * cam.offset, 0}}, {"P", {mirror * cam.pivot, 0}}});
  add_body(l, "cam", {{"O", {0, 0}}});
  l.bodies[1].mass = BodyMass{0, 0, 0};
  add_pin(l, "shaft", "ground.O", "cam.O");
  LinkageCam c{.name = "cam",
               .turns = 0,
               .moves = 1,
               .contact = {2, 1},
               .face = cam.face,
               .roller_radius = cam.roller_radius,
               .base_radius = cam.base_radius,
               .is_clockwise = (mirror < 0) != cam.is_clockwise};
  if (cam.motion == FollowerMotion::translating) {
    add_body(l, "follower", {{"G", {0, 0}}, {"B", {0, 0}}});
    add_slide(l, "guide", "ground.G", "follower.G", pi / 2, pi / 2);
    l.bodies[2].mass = BodyMass{follower_mass, 0, 0};
    c.programme = std::move(programme);
    // Above the cam, where a second place below it is as near.
    l.bodies[2].start = math::Pose{mirror * cam.offset, cam.prime_radius(), 0};
  } else {
    // The arm points at the angle pi - psi, so that it turns clockwise as psi grows.
    add_body(
        l, "follower",
        {{"P", {0, 0}}, {"B", is_flat ? std::complex<double>(0.03, -mirror * cam.face_offset) : cam.arm}});
    add_pin(l, "pivot", "ground.P", "follower.P");
    l.bodies[2].mass = BodyMass{0, follower_inertia, 0};
    c.programme = mirror > 0 ? counted_the_other_way(std::move(programme)) : std::move(programme);
    l.bodies[2].start =
        math::Pose{mirror * cam.pivot, 0, mirror > 0 ? pi - base_position(cam) : base_position(cam)};
  }
  l.bodies[1].start = math::Pose{};
  l.cams.push_back(std::move(c));
  add_drive(l, "shaft");
  l.gravity = 0;
  return l;
}

struct SolvedCam {
  LinkageMotion motion;
  LinkageForces forces;
};
SolvedCam solve_cam(const CamMachine& m, double angle, double rate, double acceleration = 0) {
  SolvedCam s{LinkageMotion(m.plan), {}};
  const InputMotion input{angle, rate, acceleration};
  solve_motion(m.plan, std::span(&input, 1), s.motion);
  EXPECT_EQ(s.motion.status, Status::done);
  solve_forces(m.linkage, m.plan, s.motion, 0, angle, s.forces);
  return s;
}

struct FollowerCase {
  const char* name;
  DiscCam cam;
  CamProgramme programme;
};
std::vector<FollowerCase> follower_cases() {
  DiscCam knife = roller_cam(0.005);
  knife.face = FollowerFace::knife, knife.roller_radius = 0;
  DiscCam flat{.face = FollowerFace::flat, .base_radius = 0.03, .offset = 0.004};
  DiscCam arm_with_edge = oscillating_roller();
  arm_with_edge.face = FollowerFace::knife, arm_with_edge.roller_radius = 0;
  CamProgramme tilt{.segments = {{CamLaw::cycloidal, 140 * degree, 15 * degree, {}},
                                 {CamLaw::dwell, 40 * degree, 0, {}},
                                 {CamLaw::cycloidal, 140 * degree, 0, {}},
                                 {CamLaw::dwell, 40 * degree, 0, {}}}};
  return {{"roller", roller_cam(), lift_and_back()},
          {"roller to the left", roller_cam(-0.008), lift_and_back()},
          {"knife", knife, lift_and_back()},
          {"flat", flat, lift_and_back()},
          {"arm with roller", oscillating_roller(), swing_and_return()},
          {"arm with edge", arm_with_edge, swing_and_return()},
          {"arm with face", oscillating_flat(), tilt}};
}

// Every follower, both senses and both images, against the closed forms.
TEST(CamFollower, IsThatOfTheClosedForms) {
  for (const FollowerCase& f : follower_cases())
    for (const bool clockwise : {false, true})
      for (const double mirror : {1.0, -1.0}) {
        SCOPED_TRACE(std::string(f.name) + (clockwise ? ", clockwise" : "") +
                     (mirror < 0 ? ", mirrored" : ""));
        DiscCam cam = f.cam;
        cam.is_clockwise = clockwise;
        const ProgrammeCurve curve(f.programme);
        if (problem(cam, curve)) continue;
        const CamMachine m = cam_machine(linkage_with(cam, f.programme, mirror));
        ASSERT_EQ(m.plan.cams.size(), 1u);
        CamFollower follower(m.linkage, 0, {});
        const FollowerLoad load{
            .inertia = cam.motion == FollowerMotion::translating ? follower_mass : follower_inertia,
            .speed = camshaft_speed};
        for (double angle = 0.05; angle < 2 * pi; angle += 0.37) {
          const math::Motion motion = curve(angle);
          const CamState wanted = cam_state(cam, motion, angle);
          const FollowerForces forces = follower_forces(wanted, motion, load);
          const double turned = mirror * cam.sense();
          const SolvedCam s = solve_cam(m, turned * angle, turned * camshaft_speed);
          const CamContact& contact = s.forces.cams[0];
          const double scale = 1 + std::abs(forces.contact);
          EXPECT_NEAR(contact.force, forces.contact, 1e-10 * scale) << angle;
          EXPECT_NEAR(std::abs(contact.lever), wanted.lever, 1e-12);
          EXPECT_NEAR(contact.pressure_angle, wanted.pressure_angle, 1e-11);
          EXPECT_NEAR(s.forces.drives[0] * turned, forces.torque, 1e-10 * scale);
          EXPECT_NEAR(s.forces.drive_power, s.forces.kinetic_power,
                      1e-9 * (1 + std::abs(s.forces.drive_power)));
          // The contact is on the profile, turned with the cam.
          math::Vec2 place = rotate(math::unit(cam.sense() * angle), wanted.profile);
          place.x *= mirror;
          EXPECT_NEAR(norm(contact.point - place), 0, 1e-13);
          // And so is the contour from the rates of the linkage.
          const double sign = m.linkage.cams[0].programme.segments[0].to > 0 ? 1 : -1;
          const CamState found = follower.contour(
              m.plan.cams[0].offset, {sign * motion.value, sign * motion.rate, sign * motion.acceleration, 0},
              angle);
          EXPECT_NEAR(found.lever, wanted.lever, 1e-12);
          EXPECT_NEAR(found.pressure_angle, wanted.pressure_angle, 1e-11);
          EXPECT_NEAR(found.profile.x, mirror * wanted.profile.x, 1e-13);
          EXPECT_NEAR(found.profile.y, wanted.profile.y, 1e-13);
          EXPECT_NEAR(1 / found.profile_radius, 1 / wanted.profile_radius, 1e-9 / cam.prime_radius());
        }
      }
}

// Rates and accelerations against differences, and Newton's method of all bodies at once, for a shaft that
// speeds up.
TEST(CamFollower, RatesAreThoseOfItsPlaces) {
  for (const FollowerCase& f : follower_cases()) {
    SCOPED_TRACE(f.name);
    const CamMachine m = cam_machine(linkage_with(f.cam, f.programme));
    Linkage copy = m.linkage;
    const CamMachine whole = cam_machine(std::move(copy), PlanRoute::all_at_once);
    constexpr double h = 1e-4, rate = 3, acceleration = 5;
    for (double angle = 0.1; angle < 2; angle += 0.4) {
      const auto state = [&](const CamMachine& machine, double t) {
        LinkageMotion motion(machine.plan);
        const InputMotion input{angle + rate * t + acceleration * t * t / 2, rate + acceleration * t,
                                acceleration};
        solve_motion(machine.plan, std::span(&input, 1), motion);
        EXPECT_EQ(motion.status, Status::done);
        return body_state(machine.plan, motion, 2);
      };
      const PartState<double> before = state(m, -h), now = state(m, 0), after = state(m, h);
      EXPECT_NEAR(norm((1 / (2 * h)) * (after.origin - before.origin) - now.velocity), 0, 1e-6);
      EXPECT_NEAR(norm((1 / (2 * h)) * (after.velocity - before.velocity) - now.acceleration), 0, 1e-4);
      EXPECT_NEAR((after.speed - before.speed) / (2 * h), now.angular_acceleration, 1e-4);
      const PartState<double> again = state(whole, 0);
      EXPECT_NEAR(norm(again.origin - now.origin), 0, 1e-13);
      EXPECT_NEAR(norm(again.acceleration - now.acceleration), 0, 1e-10);
      EXPECT_NEAR(again.angular_acceleration, now.angular_acceleration, 1e-10);
      EXPECT_NEAR(solve_cam(whole, angle, rate, acceleration).forces.cams[0].force,
                  solve_cam(m, angle, rate, acceleration).forces.cams[0].force, 1e-10);
    }
  }
}

// A cam at the origin opens a valve over a finger; the programme is that of the valve.
Linkage train_of_a_valve() {
  Linkage l = grounded({{"O", {0, 0}}, {"P", {-0.021, -0.03}}, {"G", {0.02, -0.034}}});
  add_drawn(l, "cam", {{"O", {0, 0}}});
  add_drawn(l, "finger", {{"P", {-0.021, -0.03}}, {"R", {0, -0.026}}, {"T", {0.02, -0.03}}});
  add_drawn(l, "valve", {{"T", {0.02, -0.03}}});
  add_pin(l, "shaft", "ground.O", "cam.O");
  add_pin(l, "pivot", "ground.P", "finger.P");
  add_slide(l, "guide", "ground.G", "valve.T", -pi / 2, -pi / 2);
  add_slot(l, "tip", "valve.T", "finger.T");
  l.bodies[1].mass = BodyMass{0.3, 4e-5, {0.001, 0.002}};
  l.bodies[2].mass = BodyMass{0.06, 1e-5, {0.001, -0.028}};
  l.bodies[3].mass = BodyMass{0.075, 0, {0.02, -0.07}};
  l.cams.push_back({.name = "lobe",
                    .turns = 0,
                    .moves = 2,
                    .contact = {2, 1},
                    .roller_radius = 0.009,
                    .base_radius = 0.017,
                    .phase = 20 * degree,
                    .programme = {.segments = {{CamLaw::dwell, 110 * degree, 0, {}},
                                               {CamLaw::polynomial_4567, 70 * degree, 0.01, {}},
                                               {CamLaw::polynomial_4567, 70 * degree, 0, {}},
                                               {CamLaw::dwell, 110 * degree, 0, {}}}}});
  add_drive(l, "shaft");
  return l;
}

// Newton and Euler for each body: the contact is among what the bodies feel.
TEST(CamFollower, ContactMayBeOnAnotherBodyThanTheMovedOne) {
  for (const PlanRoute route : {PlanRoute::along_groups, PlanRoute::all_at_once}) {
    const CamMachine m = cam_machine(train_of_a_valve(), route);
    const CamPair& pair = m.plan.cams[0];
    const ProgrammeCurve& lift = pair.programme;
    for (double angle = 0.2; angle < 6; angle += 0.3) {
      const SolvedCam s = solve_cam(m, angle, 200, 30);
      const auto body = [&](int b) { return body_state(m.plan, s.motion, b); };
      EXPECT_NEAR(
          body(3).origin.y,
          -pair.offset + m.linkage.bodies[0].points[2].at.imag() + 0.03 - lift(angle + 20 * degree).value,
          1e-13);
      std::vector<Wrench<double>> missing(4, {{0, 0}, 0});  // about the origin
      const auto add = [&](int b, const math::Vec2& force, double moment, const math::Vec2& point) {
        missing[index(b)].force = missing[index(b)].force + force;
        missing[index(b)].moment += moment + cross(point, force);
      };
      for (int b = 1; b < 4; ++b) {
        const BodyMass& mass = *m.linkage.bodies[index(b)].mass;
        const PointMotion centre = point_motion(m.plan, s.motion, b, mass.centre);
        add(b, mass.mass * (math::vec(m.linkage.gravity) - centre.acceleration),
            -mass.inertia * body(b).angular_acceleration, centre.position);
      }
      for (std::size_t j = 0; j < m.linkage.joints.size(); ++j) {
        const JointReaction& r = s.forces.joints[j];
        add(m.linkage.joints[j].second.body, r.force, r.moment, r.point);
        add(m.linkage.joints[j].first.body, -r.force, -r.moment, r.point);
      }
      const CamContact& c = s.forces.cams[0];
      EXPECT_NEAR(norm(c.point - body(2).origin - rotate(body(2).direction, math::Vec2{0, -0.026}) +
                       0.009 * c.normal),
                  0, 1e-13);
      add(2, c.force * c.normal, 0, c.point);
      add(1, -c.force * c.normal, 0, c.point);
      for (int b = 1; b < 4; ++b) {
        EXPECT_NEAR(norm(missing[index(b)].force), 0, 1e-9) << b << " at " << angle;
        EXPECT_NEAR(missing[index(b)].moment, 0, 1e-10) << b << " at " << angle;
      }
      EXPECT_NEAR(s.forces.drive_power + s.forces.weight_power, s.forces.kinetic_power, 1e-8);
    }
  }
}

// The pitch curve as the path of the roller in the frame of the turning cam, by differences.
TEST(CamFollower, ContourIsThePathOfTheFollowerOnTheCam) {
  const CamMachine m = cam_machine(train_of_a_valve());
  CamFollower follower(m.linkage, 0, {});
  const CamPair& pair = m.plan.cams[0];
  const auto pitch = [&](double angle) {
    const SolvedCam s = solve_cam(m, angle - 20 * degree, 0);
    // The frame of a cam whose programme stands at 0.
    return rotate_inverse(math::unit(angle),
                          point_motion(m.plan, s.motion, 2, m.linkage.bodies[2].points[1].at).position);
  };
  constexpr double h = 1e-4;
  for (double angle = 2; angle < 4.4; angle += 0.15) {
    const CamState state = follower.contour(pair.offset, pair.programme(angle), angle);
    const math::Vec2 before = pitch(angle - h), now = pitch(angle), after = pitch(angle + h);
    EXPECT_NEAR(norm(state.pitch - now), 0, 1e-14);
    const math::Vec2 first = (1 / (2 * h)) * (after - before),
                     second = (1 / (h * h)) * (after - now - now + before);
    EXPECT_NEAR(dot(state.normal, first) / norm(first), 0, 1e-7);
    EXPECT_NEAR(
        state.pitch_curvature,
        std::abs(cross(first, second)) / std::pow(norm(first), 3) * (cross(first, second) < 0 ? 1 : -1),
        2e-4 * (1 + std::abs(state.pitch_curvature)));
  }
}

// The follower drives the cam: a group of its own for the shaft, with the same forces.
TEST(CamFollower, MayDriveItsCam) {
  Linkage l = linkage_with(roller_cam(), lift_and_back());
  const CamMachine cam_drives = cam_machine(l);
  l.driven = {1};
  l.bodies[1].start = math::Pose{0, 0, 60 * degree};
  l.bodies[2].start = math::Pose{0.008, base_position(roller_cam()) + 0.01, 0};
  const CamMachine follower_drives = cam_machine(l);
  for (const double angle : {50 * degree, 60 * degree, 75 * degree}) {
    const SolvedCam s = solve_cam(cam_drives, angle, 40, 7);
    const PartState<double> follower = body_state(cam_drives.plan, s.motion, 2);
    SolvedCam back{LinkageMotion(follower_drives.plan), {}};
    const InputMotion input{follower.origin.y, follower.velocity.y, follower.acceleration.y};
    solve_motion(follower_drives.plan, std::span(&input, 1), back.motion);
    ASSERT_EQ(back.motion.status, Status::done);
    const PartState<double> cam = body_state(follower_drives.plan, back.motion, 1);
    EXPECT_NEAR(angle_of(cam.direction), angle, 1e-12);
    EXPECT_NEAR(cam.speed, 40, 1e-10);
    EXPECT_NEAR(cam.angular_acceleration, 7, 1e-8);
  }
}

TEST(CamFollower, SaysWhyThereIsNone) {
  Linkage l = linkage_with(roller_cam(), lift_and_back());
  l.cams[0].base_radius = 0.001, l.cams[0].roller_radius = 0.001;
  EXPECT_THAT(
      planning_problems(l).at(0),
      HasSubstr("the follower of cam 'cam' does not come to its base circle of 1 mm with a roller of 1 "
                "mm"));
  l = linkage_with(roller_cam(), lift_and_back());
  add_drive(l, "guide");
  EXPECT_THAT(planning_problems(l).at(0), HasSubstr("two drives on one degree of freedom"));
}

}  // namespace
}  // namespace linkwright::planar
