// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/synthesis.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/suspension/indirect/corner_deviations.h"
#include "tests/suspension/synthesis_cases.h"

namespace linkwright::suspension {
namespace {

IndirectTask whole(const test::Example& e, std::uint64_t seed) {
  IndirectTask task{.targets = e.targets};
  RandomStream random({seed, 31});
  for (const CornerLink& link : e.links) task.links.push_back(test::random_task(link, 0.15, random));
  for (const Coupler& c : e.suspension.couplers)
    task.couplers.push_back({.name = "coupler",
                             .first = c.first,
                             .second = c.second,
                             .min_offset = 0.1,
                             .point = box_around(c.point, 0.15)});
  return task;
}

TEST(IndirectSynthesis, WholeMechanismsOfTheSource) {
  RunContext context;
  for (const char* id : {"ex1-forward", "ex2-forward", "ex3-forward", "ex4-forward"}) {
    const test::Example e = test::published_example(id);
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      const IndirectSynthesis found = synthesise(whole(e, seed), {}, seed, context);
      ASSERT_EQ(found.status, Status::done)
          << id << " seed " << seed << " " << (found.findings.empty() ? "" : to_string(found.findings[0]));
      EXPECT_LT(found.largest, 1e-8);
      EXPECT_NEAR(constraint_error(found.suspension, e.targets).gap, found.largest, 1e-13);
      for (std::size_t j = 0; j < e.links.size(); ++j)
        EXPECT_LT(largest_distance(found.suspension.links[j], e.links[j]), 1e-4)
            << id << " seed " << seed << " link " << j;
    }
  }
}

TEST(IndirectSynthesis, TooFewPositionsAreTold) {
  RunContext context;
  test::Example e = test::published_example("ex1-forward");
  e.targets.poses.resize(6);
  const IndirectSynthesis found = synthesise(whole(e, 1), {}, 1, context);
  EXPECT_EQ(found.fewest, 7);
  ASSERT_FALSE(found.findings.empty());
  EXPECT_EQ(
      to_string(found.findings[0]),
      "warning: target: 6 positions, the reference included, leave a family of exact solutions; 7 positions "
      "determine the links");
}

TEST(IndirectSynthesis, OneLinkIsNotTakenTwice) {
  RunContext context;
  const test::Example e = test::published_example("ex1-forward");
  IndirectTask task = whole(e, 1);
  task.links[1] = task.links[0];  // the same boxes again: they hold one link only
  const IndirectSynthesis found = synthesise(task, {.link = {.starts = 20}}, 1, context);
  EXPECT_NE(found.status, Status::done);
  EXPECT_GT(found.links[1].duplicates, 0);
}

TEST(IndirectSynthesis, ExactRodsAreStartsWhereOthersFail) {
  // One start finds some rods of the rear suspension and not others; the rods of seven positions are exact.
  const test::Example e = test::published_example("ex4-forward");
  RunContext context;
  int failed = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const IndirectTask task = whole(e, seed);
    for (const LinkTask& link : task.links)
      failed += fit_link(e.targets, link, {.starts = 1}, {}, seed, context).status != Status::done;
    const IndirectSynthesis found = synthesise(task, {.link = {.starts = 1}}, seed, context);
    EXPECT_EQ(found.status, Status::done) << seed;
    EXPECT_LT(found.largest, 5e-8);  // 1e-8 in the mean of squares
  }
  EXPECT_GT(failed, 5);
}

TEST(IndirectSynthesis, HingedArmsAreReported) {
  const test::Example e = test::published_example("mechanism-RS-3US");
  IndirectTask task{.targets = e.targets, .links = {given_link(e.links[1])}, .couplers = {}};
  task.links[0].body[0] = box_around({0.5, 0.5, 0.5}, 0.02);  // no rod is there
  RunContext context;
  const IndirectSynthesis found = synthesise(task, {.link = {.starts = 3}}, 1, context);
  EXPECT_EQ(found.status, Status::not_converged);
  ASSERT_FALSE(found.arms.empty());
  EXPECT_EQ(found.arms[0].type, LinkType::RS);
  EXPECT_LT(norm(found.arms[0].carrier[0] - e.links[0].carrier[0]), 1e-6);
}

TEST(IndirectSynthesis, LinksThatShareACouplerAreFittedTogetherAtLast) {
  test::Example e = test::published_example("ex3-forward");
  for (CarrierTarget& pose : e.targets.poses) {  // five decimals, as the source prints them
    const auto round = [](double& v, double unit) { v = std::round(v / unit) * unit; };
    round(pose.centre.x, 1e-5), round(pose.centre.y, 1e-5);
    round(pose.angles.toe, 1e-5 * M_PI / 180), round(pose.angles.carrier_pitch, 1e-5 * M_PI / 180);
  }
  const IndirectTask task = whole(e, 1);
  RunContext context;
  std::vector<CornerLink> one_by_one;
  for (std::size_t l = 0; l < task.links.size(); ++l)
    one_by_one.push_back(
        fit_link(e.targets, task.links[l], {.starts = 20}, {}, 1, context, static_cast<std::uint32_t>(l))
            .link);
  const CouplerFit coupler = fit_coupler(e.targets, one_by_one, task.couplers[0]);
  const IndirectSynthesis found = synthesise(task, {.link = {.starts = 20}}, 1, context);
  EXPECT_EQ(found.status, Status::not_converged);
  CornerErrors errors(e.targets, task.links, task.couplers);
  std::vector<double> x(errors.unknowns()), rows(errors.rows());
  const auto squares = [&](std::span<const CornerLink> links, const Coupler& c) {
    errors.start_from(links, {&c, 1}, x);
    EXPECT_TRUE(errors.evaluate(x, rows, {}));
    return errors.totals(rows).square;
  };
  const double before = squares(one_by_one, coupler.coupler),
               after = squares(found.suspension.links, found.suspension.couplers[0]);
  EXPECT_LT(after, before * (1 - 1e-3));
  EXPECT_LT(std::sqrt(after / 40), 5e-6);  // half a unit of the last place is 5e-6
  EXPECT_NEAR(found.links[0].rms, errors.link_totals(0, rows).rms(), 1e-12);
  EXPECT_NEAR(found.couplers[0].rms, errors.coupler_totals(0, rows).rms(), 1e-12);
  EXPECT_NEAR(found.couplers[0].offset,
              found.suspension.couplers[0].fraction *
                  norm(found.suspension.links[0].carrier[0] - found.suspension.links[0].body[0]),
              1e-15);
}

TEST(IndirectSynthesis, AGivenRodSettlesTheCarrierPitch) {
  // Section 5.3.5.1: with one rod adopted the others are found one by one from complete positions.
  const test::Example e = test::published_example("ex4-forward");
  RunContext context;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    IndirectTask task = whole(e, seed);
    for (CarrierTarget& pose : task.targets.poses) pose.angles.carrier_pitch = nan;
    task.links[0] = given_link(e.links[0]);
    const IndirectSynthesis found = synthesise(task, {}, seed, context);
    ASSERT_EQ(found.status, Status::done) << seed;
    EXPECT_EQ(found.fewest, 24 / 4.0 + 1);  // six unknowns less
    EXPECT_EQ(found.suspension.links[0].body, e.links[0].body);
    for (std::size_t i = 0; i < e.targets.poses.size(); ++i)
      EXPECT_NEAR(found.targets.poses[i].angles.carrier_pitch, e.targets.poses[i].angles.carrier_pitch,
                  1e-10);
    EXPECT_LT(constraint_error(found.suspension, found.targets).gap, 1e-8);
    const PoseDeviations d = pose_deviations(found.suspension, e.targets);
    EXPECT_LT(d.x.largest, 1e-7);  // errors of 1e-8 m at most, and what the suspension makes of them
    EXPECT_LT(d.carrier_pitch.largest, 1e-6);
  }
}

TEST(IndirectSynthesis, AGivenRodThatDoesNotReachIsTold) {
  const test::Example e = test::published_example("ex4-forward");
  IndirectTask task = whole(e, 1);
  for (CarrierTarget& pose : task.targets.poses) pose.angles.carrier_pitch = nan;
  CornerLink rod = e.links[2];
  rod.carrier[0] = e.targets.wheel.centre + Vec3{0.001, -0.1, 0};
  task.links[2] = given_link(rod);
  RunContext context;
  const IndirectSynthesis found = synthesise(task, {}, 1, context);
  EXPECT_EQ(found.status, Status::infeasible);
  ASSERT_FALSE(found.findings.empty());
  EXPECT_EQ(found.findings[0].key, "link.link 3");
  EXPECT_TRUE(to_string(found.findings[0].message)
                  .starts_with("cannot keep its length at position 8: it misses by 0.0"))
      << to_string(found.findings[0].message);
}

TEST(IndirectSynthesis, LinksAndCarrierPitchesTogether) {
  const test::Example e = test::published_example("ex4-forward");
  IndirectTask task = whole(e, 1);
  for (CarrierTarget& pose : task.targets.poses) pose.angles.carrier_pitch = nan;
  RunContext context;
  const IndirectSynthesis found = synthesise(task, {.carrier_pitch = {.tolerance = 1e-6}}, 1, context);
  EXPECT_EQ(found.status, Status::done);
  EXPECT_EQ(found.fewest, 8.5);
  EXPECT_TRUE(carrier_pitch_is_given(found.targets));
  EXPECT_NEAR(constraint_error(found.suspension, found.targets).gap, found.largest, 1e-12);
}

TEST(IndirectSynthesis, CanBeStopped) {
  const test::Example e = test::published_example("ex4-forward");
  RunContext context;
  context.cancel();
  const IndirectSynthesis found = synthesise(whole(e, 1), {.link = {.tolerance = 1e-30}}, 1, context);
  EXPECT_EQ(found.status, Status::cancelled);
  ASSERT_EQ(found.links.size(), 5u);
  EXPECT_TRUE(std::isfinite(found.links[0].rms));  // the first start always runs
  EXPECT_EQ(found.links[4].status, Status::cancelled);
  EXPECT_EQ(found.suspension.links.size(), 5u);
  const IndirectSynthesis evolved = evolve(whole(e, 1), {}, 1, context);
  EXPECT_EQ(evolved.status, Status::cancelled);
  EXPECT_EQ(evolved.generations, 5);
}

TEST(IndirectSynthesis, TellsItsProgress) {
  const test::Example e = test::published_example("ex1-forward");
  RunContext context;
  std::vector<double> fractions;
  context.set_progress([&](const Progress& p) { fractions.push_back(p.fraction); });
  synthesise(whole(e, 1), {}, 1, context);
  EXPECT_EQ(fractions, (std::vector<double>{0.2, 0.4, 0.6, 0.8, 1}));
  fractions.clear();
  synthesise(whole(e, 1), {.link = {.progress = false}}, 1, context);
  EXPECT_TRUE(fractions.empty());
}

TEST(IndirectSynthesis, DifferentialEvolutionFindsTheSame) {
  const test::Example e = test::published_example("ex1-forward");
  RunContext context;
  const IndirectSynthesis found = evolve(whole(e, 1), {}, 1, context);
  ASSERT_EQ(found.status, Status::done);
  EXPECT_GT(found.generations, 1500);
  EXPECT_LT(found.generations, 2600);
  for (std::size_t l = 0; l < e.links.size(); ++l) {
    EXPECT_EQ(found.links[l].status, Status::done);
    EXPECT_LT(largest_distance(found.suspension.links[l], e.links[l]), 1e-4);
  }
  EXPECT_NEAR(constraint_error(found.suspension, e.targets).gap, found.largest, 1e-13);
}

TEST(IndirectSynthesis, DifferentialEvolutionTakesLinksThatShareACouplerTogether) {
  const test::Example e = test::published_example("ex3-forward");
  IndirectTask task = whole(e, 2);
  task.couplers[0].max_offset = 0.286;
  RunContext context;
  IndirectEvolutionOptions options;
  options.method.method.generations = 300;
  const IndirectSynthesis found = evolve(task, options, 2, context);
  EXPECT_EQ(found.status, Status::not_converged);
  EXPECT_EQ(found.generations, 600);                     // links 1 and 3 with the coupler, link 2
  EXPECT_EQ(found.evaluations, 300 * (5 * 17 + 5 * 6));  // 17 and 6 unknowns
  EXPECT_LT(found.largest, 0.02);
  EXPECT_GE(found.couplers[0].offset, 0.1);
  EXPECT_LE(found.couplers[0].offset, 0.286);
  options.together = true;
  options.method.method.generations = 10;
  EXPECT_EQ(evolve(task, options, 2, context).evaluations, 10 * 5 * 23);
}

}  // namespace
}  // namespace linkwright::suspension
