// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/pi_joint/design_synthesis.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/core/random.h"
#include "linkwright/math/angles.h"
#include "linkwright/parallel/pi_joint/samples.h"
#include "parallel/pi_joints.h"
#include "parallel/robots.h"
#include "support/message.h"

namespace linkwright::parallel {
namespace {

using math::radians;
using test::number_at;

PiDesignReport designed(const PiRequirements& requirements, int starts = 12) {
  RunContext context;
  return design_pi_joint(requirements, {.starts = starts}, {.seed = 1}, context);
}

PiRequirements reference_requirements() {
  const Value& given = inputs("pi-design");
  return {.half_travel = radians(number_at(given, "half_range_deg")),
          .torque = number_at(given, "T_req_Nm"),
          .force_limit = number_at(given, "F_max_N"),
          .speed = number_at(given, "theta_dot_req"),
          .rate_limit = number_at(given, "d_dot_max"),
          .quantum = number_at(given, "delta_d_m"),
          .resolution = number_at(given, "dtheta_max_rad"),
          .transmission = radians(number_at(given, "mu_min_deg")),
          .stroke = number_at(given, "stroke_max_m"),
          .telescoping = number_at(given, "telescoping_ratio_max")};
}

TEST(PiDesignSynthesis, BestCentreOfThePrototype) {
  for (const auto& [name, half] : {std::pair{"half60", 60.0}, {"half50", 50.0}}) {
    const Value& expected = *computed("pi-best-centre").find(name);
    const double centre = best_centre(pi_prototype(), radians(half));
    const PiRangeValues found = range_values(pi_prototype(), centre, radians(half));
    expect_same(centre, number_at(expected, "theta_c_rad"));
    expect_same(found.min_transmission, number_at(expected, "mu_min_rad"));
    expect_same(centre - radians(half), number_at(expected, "theta_lo_rad"));
    expect_same(centre + radians(half), number_at(expected, "theta_hi_rad"));
    expect_same(found.min_diagonal, number_at(expected, "d_min_m"));
    expect_same(found.greatest_diagonal, number_at(expected, "d_max_m"));
    expect_same(found.stroke(), number_at(expected, "stroke_m"));
    expect_same(found.min_jacobian, number_at(expected, "J_min_m"));
    expect_same(found.greatest_jacobian, number_at(expected, "J_max_m"));
  }
  const Value& expected = computed("pi-best-centre");
  expect_same(range_values(pi_prototype(), radians(-10), radians(50)).min_jacobian,
              number_at(expected, "source_range_J_min_m"));
  expect_same(symmetric_ratio_limit(radians(60), 2), number_at(expected, "k_symmetric_ratio2"));
  expect_same(centred_ratio_limit(radians(60), 2), number_at(expected, "k_centred_ratio2"));
  EXPECT_EQ(symmetric_ratio_limit(radians(10), 10), 1);
}

TEST(PiDesignSynthesis, NoCentreIsBetterThanTheBest) {
  RandomStream random({.seed = 3});
  for (int i = 0; i < 100; ++i) {
    const PiJoint joint{.arm = random.uniform(0.05, 1), .ratio = random.uniform(0.1, i % 4 ? 0.99 : 3)};
    const double half = random.uniform(0.1, 1.4), most = pi / 2 - half;
    const double centre = best_centre(joint, half);
    const double best = range_values(joint, centre, half).min_jacobian;
    ASSERT_LE(std::abs(centre), most);
    const double shorter = std::min(joint.arm, base_length(joint));
    expect_same(best, shorter * std::cos(half), 1e-13);
    expect_same(range_values(joint, centre, half).stroke(), 2 * shorter * std::sin(half), 1e-13);
    for (int k = 0; k <= 2000; ++k)
      ASSERT_LE(range_values(joint, most * (k / 1000.0 - 1), half).min_jacobian, best * (1 + 1e-14));
  }
}

TEST(PiDesignSynthesis, RatioLimitsUseUpTheTelescope) {
  for (double half : {0.4, 0.9, 1.2})
    for (double telescoping : {1.2, 1.8, 2.5}) {
      const PiJoint centred{.arm = 1, .ratio = centred_ratio_limit(half, telescoping)};
      expect_same(range_values(centred, best_centre(centred, half), half).telescoping(), telescoping, 1e-13);
      const PiJoint about_zero{.arm = 1, .ratio = symmetric_ratio_limit(half, telescoping)};
      if (about_zero.ratio < 1)
        expect_same(range_values(about_zero, 0, half).telescoping(), telescoping, 1e-13);
    }
}

TEST(PiDesignSynthesis, DesignOfTheReference) {
  const Value& expected = computed("pi-design");
  const PiDesignReport report = designed(reference_requirements());
  ASSERT_TRUE(report.closed_form.design);
  const PiDesign& closed = *report.closed_form.design;
  expect_same(closed.size, number_at(expected, "objective_m"), 1e-13);
  expect_same(closed.joint.arm, number_at(expected, "a_m"), 1e-13);
  expect_same(closed.joint.ratio, number_at(expected, "k"), 1e-13);
  expect_same(base_length(closed.joint), number_at(expected, "b_m"), 1e-13);
  expect_same(closed.centre, number_at(expected, "theta_c_rad"), 1e-13);
  const PiRangeValues range = range_values(closed.joint, closed.centre, radians(60));
  expect_same(range.min_diagonal, number_at(expected, "d_min_m"), 1e-13);
  expect_same(range.greatest_diagonal, number_at(expected, "d_max_m"), 1e-13);
  expect_same(range.stroke(), number_at(expected, "stroke_m"), 1e-13);
  expect_same(range.min_transmission, number_at(expected, "mu_min_rad"), 1e-13);
  expect_same(range.min_jacobian, number_at(expected, "J_min_m"), 1e-13);
  expect_same(range.greatest_jacobian, number_at(expected, "J_max_m"), 1e-13);

  EXPECT_EQ(report.status, Status::done);
  EXPECT_TRUE(report.closed_form_is_best);
  EXPECT_EQ(report.starts, 13);
  // Two of the random starts end with a step that makes no progress.
  EXPECT_GE(report.reached_best, 10);
  EXPECT_LT(report.stationarity, 1e-9);
  ASSERT_EQ(report.active.size(), 2u);
  EXPECT_EQ(report.active[0].limit, PiLimit::resolution);
  EXPECT_EQ(report.active[1].limit, PiLimit::telescoping);

  // Without the closed form as a result: what the search itself finds.
  RunContext context;
  const PiDesignReport searched = design_pi_joint(reference_requirements(), {.starts = 0}, {}, context);
  EXPECT_NEAR(searched.best.size, closed.size, 1e-6 * closed.size);
}

// The price of a limit, against designs with that limit loosened by a hundredth of a per cent.
TEST(PiDesignSynthesis, PricesTellWhatALimitCosts) {
  PiRequirements r = reference_requirements();
  const PiDesignReport before = designed(r);
  constexpr double share = 1e-4;
  r.resolution *= 1 + share;
  const double finer = 1 - designed(r).best.size / before.best.size;
  r = reference_requirements();
  r.telescoping *= 1 + share;
  const double longer = 1 - designed(r).best.size / before.best.size;
  // Second order in the share.
  EXPECT_NEAR(finer / share, before.active[0].price, 10 * share);
  EXPECT_NEAR(longer / share, before.active[1].price, 10 * share);
}

// For a given ratio and centre the smallest arm is known, so a scan over these two finds the best design
// without derivatives. The least size on the mesh.
double scanned_size(const PiRequirements& r) {
  constexpr int steps = 150;
  const double least = std::max(r.torque / r.force_limit, r.quantum / r.resolution);
  const double most = pi / 2 - r.half_travel - r.end_margin;
  double best = INFINITY;
  for (int i = 1; i <= steps; ++i)
    for (int k = -steps; k <= steps; ++k) {
      const PiJoint unit{.arm = 1, .ratio = static_cast<double>(i) / steps};
      const PiRangeValues v = range_values(unit, most * k / steps, r.half_travel);
      const double arm = least / v.min_jacobian;
      if (arm * v.greatest_jacobian * r.speed <= r.rate_limit && arm * v.stroke() <= r.stroke &&
          v.telescoping() <= r.telescoping && v.min_transmission >= r.transmission)
        best = std::min(best, arm * (1 + unit.ratio));
    }
  return best;
}

PiRequirements random_requirements(RandomStream& random) {
  PiRequirements r{.half_travel = random.uniform(0.2, 1.3)};
  r.torque = random.uniform(1, 10);
  r.force_limit = random.uniform(50, 500);
  const double least = r.torque / r.force_limit;
  if (random.uniform() < 0.5) {
    r.speed = random.uniform(0.2, 3);
    r.rate_limit = r.speed * least * random.uniform(0.8, 6);
  }
  if (random.uniform() < 0.5) r.stroke = least * random.uniform(0.5, 8);
  if (random.uniform() < 0.7) r.telescoping = random.uniform(1.1, 3);
  if (random.uniform() < 0.5) r.transmission = random.uniform(0.05, 0.6);
  return r;
}

// The closed form always meets the requirements, and a search from it never makes it worse; where moving the
// range pays, by up to some per cent, a scan finds no better design than the search.
TEST(PiDesignSynthesis, ClosedFormSearchAndScanOfRandomTasks) {
  RandomStream random({.seed = 11});
  int closed = 0, improved = 0, infeasible = 0;
  double most = 0;
  for (int i = 0; i < 60; ++i) {
    const PiRequirements r = random_requirements(random);
    const PiDesignReport report = designed(r);
    const double scanned = scanned_size(r);
    if (report.status == Status::infeasible) {
      ++infeasible;
      EXPECT_EQ(scanned, INFINITY) << i;
      EXPECT_FALSE(report.closed_form.conflicts.empty());
      EXPECT_GT(report.best.violation, 0);
      EXPECT_TRUE(report.active.empty());
      continue;
    }
    ASSERT_EQ(report.status, Status::done);
    // Feasible to 1e-9, so smaller by something like that at most.
    EXPECT_LE(report.best.size, scanned * (1 + 1e-8)) << i;
    EXPECT_LT(report.stationarity, 1e-5) << i;
    const PiRangeValues v = range_values(report.best.joint, report.best.centre, r.half_travel);
    EXPECT_GE(v.min_jacobian * r.force_limit, r.torque * (1 - 1e-8));
    EXPECT_LE(v.greatest_jacobian * r.speed, r.rate_limit * (1 + 1e-8));
    EXPECT_LE(v.stroke(), r.stroke * (1 + 1e-8));
    EXPECT_LE(v.telescoping(), r.telescoping * (1 + 1e-8));
    EXPECT_GE(v.min_transmission, r.transmission * (1 - 1e-8));
    if (!report.closed_form.design) {
      // Only limits of the ratio can be met by moving the range.
      for (const PiConflict& conflict : report.closed_form.conflicts) EXPECT_TRUE(conflict.of_ratio);
      continue;
    }
    ++closed;
    const double size = report.closed_form.design->size;
    EXPECT_LE(report.best.size, size);
    improved += !report.closed_form_is_best;
    most = std::max(most, 1 - report.best.size / size);
  }
  // All kinds of tasks were among them.
  EXPECT_GT(closed - improved, 5);
  EXPECT_GT(improved, 5);
  EXPECT_GT(infeasible, 5);
  EXPECT_GT(most, 0.01);
  EXPECT_LT(most, 0.05);
}

TEST(PiDesignSynthesis, SaysWhichRequirementsConflict) {
  PiRequirements r = reference_requirements();
  r.stroke = 0.1;
  r.transmission = radians(15);
  const PiDesignReport report = designed(r);
  EXPECT_EQ(report.status, Status::infeasible);
  EXPECT_FALSE(report.closed_form.design);
  EXPECT_FALSE(report.closed_form_is_best);
  ASSERT_EQ(report.closed_form.conflicts.size(), 3u);
  EXPECT_EQ(to_string(words_of(report.closed_form.conflicts[0])),
            "torque asks for a base of at least 61.54 mm, stroke allows at most 57.74 mm");
  EXPECT_EQ(to_string(words_of(report.closed_form.conflicts[1])),
            "resolution asks for a base of at least 63.5 mm, stroke allows at most 57.74 mm");
  EXPECT_EQ(
      to_string(words_of(report.closed_form.conflicts[2])),
      "transmission asks for a ratio of base to arm of at least 0.5176, telescoping allows at most 0.378");
}

// A small travel moved upwards telescopes less: both limits of the ratio can be met.
TEST(PiDesignSynthesis, MovesTheRangeWhereTheBestCentreMeetsNoRequirements) {
  const PiRequirements r{
      .half_travel = 0.25, .torque = 4, .force_limit = 130, .transmission = radians(20), .telescoping = 1.2};
  const PiDesignReport report = designed(r);
  ASSERT_EQ(report.closed_form.conflicts.size(), 1u);
  EXPECT_TRUE(report.closed_form.conflicts[0].of_ratio);
  EXPECT_EQ(report.status, Status::done);
  EXPECT_GT(report.best.centre, best_centre(report.best.joint, r.half_travel));
  // Feasible to 1e-9; the mesh is some per cent wide.
  EXPECT_LE(report.best.size, scanned_size(r) * (1 + 1e-8));
  EXPECT_GT(report.best.size, scanned_size(r) * 0.95);
}

TEST(PiDesignSynthesis, SameBitsForTheSameSeedAndTheBestSoFarWhenCancelled) {
  const PiDesignReport one = designed(reference_requirements()), two = designed(reference_requirements());
  EXPECT_EQ(one.best.size, two.best.size);
  EXPECT_EQ(one.evaluations, two.evaluations);
  RunContext context;
  context.cancel();
  const PiDesignReport cancelled = design_pi_joint(reference_requirements(), {}, {}, context);
  EXPECT_EQ(cancelled.status, Status::cancelled);
  EXPECT_EQ(cancelled.best.violation, 0);
  EXPECT_NEAR(cancelled.best.size, one.best.size, 1e-9);
}

TEST(PiDesignSynthesis, TellsWhatIsWrong) {
  const auto with = [](auto&& change) {
    PiRequirements r = reference_requirements();
    change(r);
    return problem(r).value_or("nothing");
  };
  EXPECT_EQ(with([](PiRequirements&) {}), "nothing");
  EXPECT_EQ(with([](PiRequirements& r) { r.half_travel = 2; }),
            "half travel = 2 rad, allowed: above 0, below pi/2");
  EXPECT_EQ(with([](PiRequirements& r) { r.half_travel = 1.5, r.end_margin = 0.1; }),
            "a half travel of 1.5 rad leaves no margin of 0.1 rad to +-pi/2");
  EXPECT_EQ(with([](PiRequirements& r) { r.torque = -1; }), "torque = -1 N m");
  EXPECT_EQ(with([](PiRequirements& r) { r.force_limit = 0; }), "force limit = 0 N");
  EXPECT_EQ(with([](PiRequirements& r) { r.speed = NAN; }), "speed = nan rad/s");
  EXPECT_EQ(with([](PiRequirements& r) { r.rate_limit = 0; }), "rate limit = 0 m/s");
  EXPECT_EQ(with([](PiRequirements& r) { r.quantum = INFINITY; }), "quantum = inf m");
  EXPECT_EQ(with([](PiRequirements& r) { r.resolution = 0; }), "resolution = 0 rad");
  EXPECT_EQ(with([](PiRequirements& r) { r.transmission = 2; }),
            "transmission angle = 2 rad, allowed: at least 0, below pi/2");
  EXPECT_EQ(with([](PiRequirements& r) { r.stroke = 0; }), "stroke = 0 m");
  EXPECT_EQ(with([](PiRequirements& r) { r.telescoping = 1; }), "telescoping ratio = 1, allowed: above 1");
  EXPECT_EQ(with([](PiRequirements& r) { r.torque = r.quantum = 0; }),
            "neither a torque with a force limit nor a quantum with a resolution is required: the joint "
            "could become arbitrarily small");
  EXPECT_NE(test::message([] { closed_form_design({.half_travel = 1}); }).find("arbitrarily small"),
            std::string::npos);
  EXPECT_NE(test::message([] { designed(reference_requirements(), -1); }).find("design_pi_joint: -1 starts"),
            std::string::npos);
}

}  // namespace
}  // namespace linkwright::parallel
