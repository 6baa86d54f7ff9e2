#include "linkwright/planar/linkage_reactions.h"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "linkwright/planar/four_bar_reactions.h"
#include "linkwright/planar/linkage_build.h"
#include "linkwright/planar/linkage_samples.h"

namespace linkwright::planar {
namespace {

constexpr double pi = std::numbers::pi;

std::vector<LinkageSample> all_samples() {
  return {four_bar_sample(),
          slider_crank_sample(),
          offset_slider_crank_sample(),
          inverted_slider_crank_sample(),
          scotch_yoke_sample(),
          whitworth_sample()};
}

LinkagePlan planned(const Linkage& l, PlanRoute route = PlanRoute::along_groups) {
  PlanResult r = plan(l, route);
  for (const Diagnostic& d : r.problems) ADD_FAILURE() << to_string(d);
  return r.plan;
}

TEST(LinkageReactions, AgreeWithAllEquationsAtOnceForEverySample) {
  for (const LinkageSample& sample : all_samples()) {
    SCOPED_TRACE(sample.name);
    const LinkagePlan along = planned(sample.linkage),
                      at_once = planned(sample.linkage, PlanRoute::all_at_once);
    LinkageMotion m(along), n(at_once);
    LinkageForces f, g;
    for (int i = 0; i < 72; ++i) {
      const double share = (i + 0.5) / 72;
      std::vector<InputMotion> inputs;
      for (std::size_t k = 0; k < sample.from.size(); ++k)
        inputs.push_back({sample.from[k] + share * (sample.to[k] - sample.from[k]), sample.speed, 3.0});
      solve_motion(along, inputs, m);
      ASSERT_EQ(m.status, Status::done) << "at share " << share << " group " << m.failed_group;
      EXPECT_LE(m.closure_residual, 1e-15 * 64);
      n.parts = m.parts;
      solve_position(at_once, inputs, n);
      solve_velocity(at_once, inputs, n);
      solve_acceleration(at_once, inputs, n);
      ASSERT_EQ(n.status, Status::done);
      for (std::size_t p = 0; p < m.parts.size(); ++p) {
        EXPECT_NEAR(m.parts[p].speed, n.parts[p].speed, 1e-11 * sample.speed);
        EXPECT_NEAR(m.parts[p].angular_acceleration, n.parts[p].angular_acceleration,
                    1e-9 * sample.speed * sample.speed);
      }
      solve_forces(sample.linkage, along, m, 0, 0, f);
      solve_forces(sample.linkage, at_once, n, 0, 0, g);
      double largest = 0;
      for (const JointReaction& r : f.joints) largest = std::max(largest, norm(r.force));
      for (std::size_t j = 0; j < f.joints.size(); ++j) {
        EXPECT_NEAR(f.joints[j].force.x, g.joints[j].force.x, 1e-10 * largest) << j;
        EXPECT_NEAR(f.joints[j].force.y, g.joints[j].force.y, 1e-10 * largest) << j;
        EXPECT_NEAR(f.joints[j].moment, g.joints[j].moment, 1e-10 * largest) << j;
      }
      EXPECT_NEAR(f.drives[0], g.drives[0], 1e-10 * largest);
      EXPECT_NEAR(f.drive_power + f.weight_power + f.load_power, f.kinetic_power,
                  1e-11 * largest * sample.speed);
    }
  }
}

TEST(LinkageMotionTest, RatesAreDerivatives) {
  for (const LinkageSample& sample : all_samples()) {
    SCOPED_TRACE(sample.name);
    const LinkagePlan p = planned(sample.linkage);
    LinkageMotion m(p);
    const double h = 1e-5;
    for (int i = 0; i < 24; ++i) {
      const double t = sample.from[0] + (sample.to[0] - sample.from[0]) * (i + 0.3) / 24;
      const auto state = [&](double dt) {
        const std::vector<InputMotion> in{{t + 2 * dt + 1.5 * dt * dt, 2 + 3 * dt, 3}};
        solve_motion(p, in, m);
        return m.parts;
      };
      const auto a = state(-h), b = state(h), c = state(0);
      for (std::size_t k = 1; k < c.size(); ++k) {
        EXPECT_NEAR((b[k].origin.x - a[k].origin.x) / (2 * h), c[k].velocity.x, 1e-7);
        EXPECT_NEAR((b[k].origin.y - a[k].origin.y) / (2 * h), c[k].velocity.y, 1e-7);
        EXPECT_NEAR((b[k].velocity.x - a[k].velocity.x) / (2 * h), c[k].acceleration.x, 1e-6);
        EXPECT_NEAR((b[k].velocity.y - a[k].velocity.y) / (2 * h), c[k].acceleration.y, 1e-6);
        EXPECT_NEAR(cross(a[k].direction, b[k].direction) / (2 * h), c[k].speed, 1e-7);
        EXPECT_NEAR((b[k].speed - a[k].speed) / (2 * h), c[k].angular_acceleration, 1e-6);
      }
    }
  }
}

}  // namespace
}  // namespace linkwright::planar
