// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/cam/disc_cam.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "linkwright/core/check.h"
#include "planar/cams.h"

namespace linkwright::planar {
namespace {

using namespace linkwright::planar::test;
using math::Motion;

CamState state_at(const DiscCam& cam, const ProgrammeCurve& curve, double angle) {
  return cam_state(cam, curve(angle), angle);
}

// Places of extremes were found as zeros of derivatives with thirty digits; the published ones have six to
// eight.
TEST(DiscCam, TranslatingRollerHasThePublishedFigures) {
  const Value& wanted = computed_cam("cam-translating-roller");
  const DiscCam cam = roller_cam();
  const ProgrammeCurve curve = rise_only();
  const CamExtremes found = cam_extremes(cam, curve);
  EXPECT_NEAR(found.greatest_pressure.value / degree, number_at(wanted, "greatest_pressure_angle_deg"), 1e-9);
  EXPECT_NEAR(found.greatest_pressure.angle / degree, 57.6062742515809, 1e-9);
  EXPECT_NEAR(found.least_pressure.value / degree, number_at(wanted, "least_pressure_angle_deg"), 1e-9);
  EXPECT_NEAR(found.least_convex_pitch->value * 1e3, number_at(wanted, "least_convex_pitch_radius_mm"), 1e-9);
  EXPECT_NEAR(found.least_convex_pitch->angle / degree, 84.1673856977423, 1e-9);
  EXPECT_TRUE(found.undercut.empty());
  EXPECT_FALSE(found.gouge);
  for (const Value& row : at(wanted, "rows").as_array()) {
    const std::vector<double> r = numbers(row);
    const CamState s = state_at(cam, curve, r[0] * degree);
    EXPECT_NEAR(s.pressure_angle / degree, r[4], 1e-9) << r[0];
    EXPECT_NEAR(1e3 / s.pitch_curvature, r[5], 1e-7) << r[0];
    EXPECT_NEAR(s.profile.x * 1e3, r[6], 1e-9) << r[0];
    EXPECT_NEAR(s.profile.y * 1e3, r[7], 1e-9) << r[0];
  }
  // The wrong side of the offset.
  EXPECT_NEAR(cam_extremes(roller_cam(-0.008), curve).greatest_pressure.value / degree,
              number_at(computed_cam("cam-translating-roller-other-offset"), "greatest_pressure_angle_deg"),
              1e-6);
}

TEST(DiscCam, TranslatingFlatHasThePublishedFigures) {
  const Value& wanted = computed_cam("cam-translating-flat");
  const DiscCam cam{.face = FollowerFace::flat, .base_radius = number_at(wanted, "base_radius_mm") / 1e3};
  const CamExtremes found = cam_extremes(cam, rise_only());
  EXPECT_NEAR(found.least_convex_profile->value, 0.005, 1e-14);
  EXPECT_NEAR(found.least_convex_profile->angle / degree, 87.6064147395139, 1e-9);
  EXPECT_NEAR(found.greatest_contact->value * 1e3, number_at(wanted, "face_half_width_mm"), 1e-11);
  EXPECT_NEAR(found.greatest_contact->angle, 60 * degree, 1e-10);
}

TEST(DiscCam, HarmonicFlatCamIsACircle) {
  const DiscCam cam{.face = FollowerFace::flat, .base_radius = 0.025};
  const ProgrammeCurve curve({.segments = {{CamLaw::harmonic, pi, 0.05, {}}, {CamLaw::harmonic, pi, 0, {}}}});
  for (int k = 0; k < 24; ++k) {
    const CamState s = state_at(cam, curve, k * 15 * degree);
    EXPECT_NEAR(s.profile_radius, 0.05, 1e-15);
    // Its centre is 25 mm off, where the follower is highest after half a turn.
    EXPECT_NEAR(std::hypot(s.profile.x, s.profile.y + 0.025), 0.05, 1e-15) << k;
  }
  const CamExtremes found = cam_extremes(cam, curve);
  EXPECT_NEAR(found.greatest_contact->value - found.least_contact->value, 0.05, 1e-14);
}

TEST(DiscCam, OscillatingRollerHasThePublishedFigures) {
  const Value& wanted = computed_cam("cam-oscillating-roller");
  const DiscCam cam = oscillating_roller();
  const ProgrammeCurve curve = oscillating_programme();
  EXPECT_NEAR(base_position(cam) / degree, number_at(wanted, "psi_0_deg"), 1e-12);
  const CamExtremes found = cam_extremes(cam, curve);
  EXPECT_NEAR(found.greatest_pressure.value / degree, number_at(wanted, "greatest_pressure_angle_deg"), 1e-9);
  EXPECT_NEAR(found.greatest_pressure.angle / degree, number_at(wanted, "at_deg"), 1e-8);
  EXPECT_NEAR(found.least_pressure.value / degree, number_at(wanted, "least_pressure_angle_deg"), 1e-9);
  EXPECT_NEAR(found.least_pressure.angle / degree, number_at(wanted, "at_least_deg"), 1e-8);
  EXPECT_NEAR(found.least_convex_pitch->value * 1e3, 40, 1e-9);
  EXPECT_FALSE(found.least_concave_pitch);
  for (const Value& row : at(wanted, "rows").as_array()) {
    const std::vector<double> r = numbers(row);
    const CamState s = state_at(cam, curve, r[0] * degree);
    EXPECT_NEAR(s.pressure_angle / degree, r[2], 1e-9) << r[0];
    EXPECT_NEAR(1e3 / s.pitch_curvature, r[3], 1e-6) << r[0];
    EXPECT_NEAR(s.profile.x * 1e3, r[4], 1e-9) << r[0];
    EXPECT_NEAR(s.profile.y * 1e3, r[5], 1e-9) << r[0];
  }
}

TEST(DiscCam, OscillatingFlatHasThePublishedFigures) {
  const Value& wanted = computed_cam("cam-oscillating-flat");
  const DiscCam cam = oscillating_flat();
  const ProgrammeCurve curve = flat_programme();
  const CamExtremes found = cam_extremes(cam, curve);
  EXPECT_NEAR(found.least_convex_profile->value * 1e3, number_at(wanted, "least_radius_of_curvature_mm"),
              1e-9);
  EXPECT_NEAR(found.least_convex_profile->angle / degree, number_at(wanted, "at_deg"), 1e-8);
  const std::vector<double> contact = numbers(at(wanted, "contact_from_pivot_mm"));
  EXPECT_NEAR(found.least_contact->value * 1e3, contact[0], 1e-6);
  EXPECT_NEAR(found.greatest_contact->value * 1e3, contact[1], 1e-6);
  for (const Value& row : at(wanted, "rows").as_array()) {
    const std::vector<double> r = numbers(row);
    const CamState s = state_at(cam, curve, r[0] * degree);
    EXPECT_NEAR(s.contact * 1e3, r[1], 1e-9) << r[0];
    EXPECT_NEAR(s.profile_radius * 1e3, r[2], 1e-9) << r[0];
    EXPECT_NEAR(s.profile.x * 1e3, r[3], 1e-9) << r[0];
    EXPECT_NEAR(s.profile.y * 1e3, r[4], 1e-9) << r[0];
  }
}

struct Sample {
  DiscCam cam;
  ProgrammeCurve curve;
};
std::vector<Sample> samples() {
  const ProgrammeCurve lift = rise_dwell_return(CamLaw::cycloidal, CamLaw::polynomial_4567, 0.02);
  std::vector<Sample> out = {{roller_cam(), lift},
                             {{.face = FollowerFace::knife, .base_radius = 0.05, .offset = -0.006}, lift},
                             {{.face = FollowerFace::flat, .base_radius = 0.05}, lift},
                             {oscillating_roller(), oscillating_programme()},
                             {oscillating_flat(), flat_programme()}};
  for (std::size_t k = 0, n = out.size(); k < n; ++k) {
    out.push_back(out[k]);
    out.back().cam.is_clockwise = true;
  }
  return out;
}

// A second route: the tangent and the curvature of the profile by differences of its points.
TEST(DiscCam, NormalAndRadiusAreThoseOfTheProfile) {
  for (const Sample& sample : samples())
    for (const double angle : {0.2, 0.7, 1.1, 1.7, 2.5, 3.4, 4.0, 4.6}) {
      const double h = 1e-4;
      const CamState s = state_at(sample.cam, sample.curve, angle);
      const math::Vec2 low = state_at(sample.cam, sample.curve, angle - h).profile,
                       high = state_at(sample.cam, sample.curve, angle + h).profile;
      const math::Vec2 rate = 1 / (2 * h) * (high - low), bend = 1 / (h * h) * (high + low - 2.0 * s.profile);
      EXPECT_NEAR(norm(s.normal), 1, 1e-14);
      EXPECT_NEAR(dot(rate, s.normal) / norm(rate), 0, 1e-6) << angle;
      // The centre of curvature of convex parts lies against the outward normal.
      const double curvature = -dot(bend, s.normal) / dot(rate, rate);
      EXPECT_NEAR(curvature * s.profile_radius, 1, 1e-4) << angle;
    }
}

// A second route: the follower's contact in the fixed frame moves by the velocities of the rigid bodies. The
// parts along the normal are equal, since the bodies touch.
TEST(DiscCam, BodiesTouchWithoutPenetrating) {
  for (const Sample& sample : samples())
    for (const double angle : {0.2, 0.9, 1.5, 3.4, 4.2}) {
      const CamState s = state_at(sample.cam, sample.curve, angle);
      const double sense = sample.cam.sense();
      const math::Vec2 turned = math::unit(sense * angle), point = rotate(turned, s.profile),
                       normal = rotate(turned, s.normal);
      const math::Vec2 of_cam = sense * perpendicular(point);
      const double rate = sample.curve(angle).rate;
      // A rising oscillating follower turns clockwise.
      const math::Vec2 of_follower = sample.cam.motion == FollowerMotion::translating
                                         ? math::Vec2{0, rate}
                                         : -rate * perpendicular(point - math::Vec2{sample.cam.pivot, 0});
      EXPECT_NEAR(dot(normal, of_cam), dot(normal, of_follower), 1e-15) << angle;
      // The lever of the contact force is the same product by unit of the programme.
      if (std::abs(rate) > 1e-6) {
        EXPECT_NEAR(s.lever * rate, dot(normal, of_follower), 1e-15) << angle;
      }
    }
}

TEST(DiscCam, MirrorImageOfAClockwiseCamHasItsOffsetOnTheOtherSide) {
  const ProgrammeCurve curve = rise_dwell_return(CamLaw::cycloidal, CamLaw::modified_sine, 0.02);
  DiscCam mirrored = roller_cam(-0.008);
  mirrored.is_clockwise = true;
  for (const double angle : {0.3, 1.2, 2.9, 3.6}) {
    const CamState a = state_at(roller_cam(), curve, angle), b = state_at(mirrored, curve, angle);
    EXPECT_NEAR(a.profile.x, -b.profile.x, 1e-16);
    EXPECT_NEAR(a.profile.y, b.profile.y, 1e-16);
    EXPECT_NEAR(a.pressure_angle, b.pressure_angle, 1e-14);
    EXPECT_NEAR(a.pitch_curvature, b.pitch_curvature, 1e-12);
  }
}

TEST(DiscCam, UndercutEndsWhereTheRadiusIsThatOfTheRoller) {
  // A short rise on a small base circle.
  const ProgrammeCurve curve({.segments = {{CamLaw::cycloidal, 40 * degree, 0.02, {}},
                                           {CamLaw::cycloidal, 40 * degree, 0, {}},
                                           {CamLaw::dwell, 280 * degree, 0, {}}}});
  const DiscCam cam{.base_radius = 0.014, .roller_radius = 0.022};
  const CamExtremes found = cam_extremes(cam, curve);
  ASSERT_EQ(found.undercut.size(), 2u);
  // Two thousand samples give 11.55 mm.
  EXPECT_NEAR(found.least_convex_pitch->value, 0.01155, 5e-6);
  for (const CamRange& r : found.undercut)
    for (const double edge : {r.from, r.to})
      EXPECT_NEAR(state_at(cam, curve, edge).pitch_curvature * 0.022, 1, 1e-9);
  EXPECT_NEAR(found.undercut[0].from + found.undercut[1].to, 80 * degree, 1e-9);
  DiscCam small = cam;
  small.roller_radius = found.least_convex_pitch->value * 0.5;
  small.base_radius = 0.036 - small.roller_radius;  // the same prime circle
  EXPECT_TRUE(cam_extremes(small, curve).undercut.empty());
}

// Between two lobes the roller is wider than the valley, though no curvature is too sharp for it.
TEST(DiscCam, GougeIsFoundAcrossAValley) {
  const double share = 24 * degree;
  const ProgrammeCurve curve({.segments = {{CamLaw::dwell, 160 * degree, 0, {}},
                                           {CamLaw::polynomial_345, 10 * degree, -0.004, {}},
                                           {CamLaw::polynomial_345, 10 * degree, 0, {}},
                                           {CamLaw::dwell, pi - share + share, 0, {}}}});
  const DiscCam cam{.base_radius = 0.04, .roller_radius = 0.02};
  const CamExtremes found = cam_extremes(cam, curve);
  ASSERT_TRUE(found.gouge || !found.undercut.empty());
  // The distance of the roller's centre from the profile at the place that is told.
  if (found.gouge) {
    const math::Vec2 centre = state_at(cam, curve, found.gouge->angle).pitch,
                     other = state_at(cam, curve, found.gouge->other).profile;
    EXPECT_NEAR(norm(centre - other), 0.02 - found.gouge->depth, 1e-12);
  }
}

TEST(DiscCam, CutterLeavesTheProfile) {
  const CamState s = state_at(roller_cam(), rise_only(), 1.0);
  const math::Vec2 same = cutter_centre(s, 0.01);
  EXPECT_NEAR(norm(same - s.pitch), 0, 1e-16);
  EXPECT_NEAR(norm(cutter_centre(s, 0.03) - s.profile), 0.03, 1e-16);
}

TEST(DiscCam, ProblemsAreTold) {
  const ProgrammeCurve curve = rise_only();
  EXPECT_EQ(problem(roller_cam(0.06), curve)->issue, CamIssue::offset_too_large);
  DiscCam cam = oscillating_roller();
  cam.arm = 0.2;
  EXPECT_EQ(problem(cam, oscillating_programme())->issue, CamIssue::no_triangle);
  const ProgrammeCurve steep({.segments = {{CamLaw::cycloidal, 140 * degree, 15 * degree, {}},
                                           {CamLaw::cycloidal, 15 * degree, 0, {}},
                                           {CamLaw::dwell, 205 * degree, 0, {}}}});
  const auto turning = problem(oscillating_flat(), steep);
  ASSERT_TRUE(turning);
  EXPECT_EQ(turning->issue, CamIssue::face_turns_with_cam);
  EXPECT_NEAR(turning->angle, 147.5 * degree, 1e-6);
  EXPECT_EQ(
      problem(oscillating_roller(),
              ProgrammeCurve({.segments = {{CamLaw::harmonic, pi, 2.8, {}}, {CamLaw::harmonic, pi, 0, {}}}}))
          ->issue,
      CamIssue::arm_passes_line);
  EXPECT_EQ(problem(roller_cam(), ProgrammeCurve({.segments = {{CamLaw::harmonic, pi, -0.06, {}},
                                                               {CamLaw::harmonic, pi, 0, {}}}}))
                ->issue,
            CamIssue::passes_centre);
  EXPECT_THROW(cam_extremes(roller_cam(0.06), curve), ContractError);
}

}  // namespace
}  // namespace linkwright::planar
