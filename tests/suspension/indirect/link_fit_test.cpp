// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/indirect/link_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "support/message.h"
#include "tests/suspension/synthesis_cases.h"

namespace linkwright::suspension {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;

struct Tally {
  int solved = 0, near = 0;
};

/// Random boxes of 150 mm around the points of a link, as the source has them.
Tally solve_boxes(const test::Example& e, const CornerLink& link, int boxes, double near) {
  Tally tally;
  RunContext context;
  for (int i = 0; i < boxes; ++i) {
    const auto seed = static_cast<std::uint64_t>(i) + 1;
    RandomStream random({seed, 77});
    const LinkTask task = test::random_task(link, 0.15, random);
    const LinkFit fit = fit_link(e.targets, task, {}, {}, seed, context);
    if (fit.status != Status::done) continue;
    EXPECT_LE(fit.rms, 1e-8);
    EXPECT_LE(fit.rms, fit.largest);
    ++tally.solved;
    tally.near += largest_distance(fit.link, link) < near;
  }
  return tally;
}

TEST(LinkFit, LinksOfTheExamplesAreFoundFromEveryBox) {
  // Positions hold 1e-15 m. The least singular values are 2e-4 in examples 1 and 2, 1e-7 in 3 and 4, where a
  // link can still be 1e-7 m off, and up to some 1e-6 m along valleys.
  for (const char* id : {"ex1-forward", "ex2-forward", "ex3-forward", "ex4-forward"}) {
    const test::Example e = test::published_example(id);
    const bool well = id[2] < '3';
    for (const CornerLink& link : e.links) {
      const int boxes = well ? 1000 : 400;
      const Tally tally = solve_boxes(e, link, boxes, well ? 1e-6 : 1e-5);
      EXPECT_EQ(tally.solved, boxes) << id << " " << link.name;
      // A second exact link in a box of examples 3 and 4 is rare, but there are some.
      EXPECT_GE(tally.near, well ? boxes : boxes - 2) << id << " " << link.name;
    }
  }
}

TEST(LinkFit, OtherTypesOfLinks) {
  for (const char* id : {"mechanism-RR-US", "mechanism-2RS-US", "mechanism-RS-SP-US", "mechanism-2SR-US",
                         "mechanism-S-2US", "mechanism-R"}) {
    const test::Example e = test::published_example(id);
    for (const CornerLink& link : e.links) {
      if (link.type == LinkType::US && e.links.size() < 4 && e.targets.poses.size() < 10)
        continue;  // families
      const Tally tally = solve_boxes(e, link, 100, 1e-6);
      EXPECT_EQ(tally.solved, 100) << id << " " << name_of(link.type);
      EXPECT_EQ(tally.near, 100) << id << " " << name_of(link.type);
    }
  }
}

TEST(LinkFit, TheSameSeedGivesTheSameBits) {
  RunContext context;
  const test::Example e = test::published_example("ex4-forward");
  RandomStream random({5});
  const LinkTask task = test::random_task(e.links[0], 0.15, random);
  const LinkFit a = fit_link(e.targets, task, {}, {}, 9, context),
                b = fit_link(e.targets, task, {}, {}, 9, context);
  EXPECT_EQ(a.link.body, b.link.body);
  EXPECT_EQ(a.link.carrier, b.link.carrier);
  EXPECT_EQ(a.evaluations, b.evaluations);
}

TEST(LinkFit, AKnownLinkIsNotFoundAgain) {
  RunContext context;
  const test::Example e = test::published_example("ex1-forward");
  // Boxes that hold links 1 and 2: with the first known, the second is found.
  LinkTask task{.name = "either",
                .body = {{{-0.3, 0.35, -0.15}, {0.3, 0.42, -0.05}}},
                .carrier = {{{-0.02, 0.72, -0.15}, {0.02, 0.75, -0.12}}}};
  for (const int known : {0, 1}) {
    const LinkFit fit = fit_link(e.targets, task, {}, {&e.links[known], 1}, 3, context);
    ASSERT_EQ(fit.status, Status::done);
    EXPECT_LT(largest_distance(fit.link, e.links[1 - known]), 1e-6);
  }
  const LinkFit none = fit_link(e.targets, task, {.starts = 50}, {e.links.data(), 2}, 3, context);
  EXPECT_EQ(none.status, Status::infeasible);
  EXPECT_GT(none.duplicates, 0);
  EXPECT_EQ(none.rms, infinity);
}

TEST(LinkFit, TheBestPlaceOfInexactPositionsStaysInTheBox) {
  RunContext context;
  test::Example e = test::published_example("ex1-forward");
  for (CarrierTarget& pose : e.targets.poses) pose.centre.x += 1e-3 * std::sin(50 * pose.centre.z);
  RandomStream random({6});
  const LinkTask task = test::random_task(e.links[2], 0.05, random);
  const LinkFit fit = fit_link(e.targets, task, {.starts = 20}, {}, 1, context);
  EXPECT_EQ(fit.status, Status::not_converged);
  EXPECT_EQ(fit.starts, 20);
  EXPECT_GT(fit.rms, 1e-6);
  EXPECT_LT(fit.rms, 1e-3);
  EXPECT_GE(fit.link.body[0].x, task.body[0].lower.x);
  EXPECT_LE(fit.link.body[0].x, task.body[0].upper.x);
}

TEST(LinkFit, RoundedTableGivesTheLeastSquaresOptimum) {
  RunContext context;
  // The positions of the printed tables, five decimals, and the optima that an independent program found.
  for (const auto& [forward, table] :
       {std::pair{"ex1-forward", "lsq-table-ex1"}, {"ex2-forward", "lsq-table-ex2"}}) {
    test::Example e = test::published_example(forward);
    e.targets.poses.clear();
    for (const Value& row : test::at(published(forward), "published.rows").as_array()) {
      const std::vector<double> r = test::numbers(row);
      const double degree = M_PI / 180;
      e.targets.poses.push_back({r[2], {r[3], r[4], r[5]}, {r[6] * degree, r[7] * degree, r[8] * degree}});
    }
    std::size_t j = 0;
    for (const Value& wanted : test::at(published(table), "computed.links").as_array()) {
      const CornerLink& link = e.links[j++];
      const LinkTask task{.type = link.type,
                          .body = {box_around(link.body[0], 0.1)},
                          .carrier = {box_around(link.carrier[0], 0.1)},
                          .moved_by_rack = link.moved_by_rack};
      const LinkFit fit = fit_link(e.targets, task, {.starts = 30}, {}, 1, context);
      const double squares = test::number_at(wanted, "sum_of_squares_m2");
      EXPECT_NEAR(fit.rms * fit.rms * 14, squares, 1e-6 * squares);
      EXPECT_LT(norm(fit.link.body[0] - point(test::at(wanted, "body_m"))), 1e-6) << table << j;
      EXPECT_LT(norm(fit.link.carrier[0] - point(test::at(wanted, "carrier_m"))), 1e-6) << table << j;
      const LinkConditioning c = conditioning(e.targets, task, fit.link);
      ASSERT_EQ(c.singular_values.size(), 6u);
      const double least = test::number_at(wanted, "smallest_singular_value");
      EXPECT_NEAR(c.singular_values.back(), least, 1e-3 * least);
    }
  }
}

TEST(LinkFit, CanBeStopped) {
  const test::Example e = test::published_example("ex4-forward");
  RandomStream random({1});
  const LinkTask task = test::random_task(e.links[0], 0.15, random);
  RunContext context;
  context.cancel();
  // Nothing is as exact as that: without the interruption all starts would be made.
  const LinkFit fit = fit_link(e.targets, task, {.tolerance = 1e-30}, {}, 1, context);
  EXPECT_EQ(fit.status, Status::cancelled);
  EXPECT_EQ(fit.starts, 1);
}

TEST(LinkFit, StartsAreTakenFromGivenLinks) {
  const test::Example e = test::published_example("ex4-forward");
  RandomStream random({1});
  const LinkTask task = test::random_task(e.links[0], 0.15, random);
  CornerLink near = e.links[0];
  near.body[0].x += 1e-4;
  RunContext context;
  const std::vector<CornerLink> starts{e.links[1], near};  // the first lies out of the boxes
  const LinkFit fit = fit_link_from(starts, e.targets, task, {}, {}, context);
  EXPECT_EQ(fit.starts, 1);
  EXPECT_EQ(fit.status, Status::done);
  EXPECT_LT(largest_distance(fit.link, e.links[0]), 1e-5);
  EXPECT_EQ(fit_link_from({starts.data(), 1}, e.targets, task, {}, {}, context).status, Status::infeasible);
}

TEST(LinkFit, ConditioningTellsTheWeakDirection) {
  RunContext context;
  const test::Example e = test::published_example("ex4-forward");
  const CornerLink& link = e.links[0];
  const LinkTask task{.body = {box_around(link.body[0], 0.1)}, .carrier = {box_around(link.carrier[0], 0.1)}};
  const LinkConditioning c = conditioning(e.targets, task, link);
  // Along it the link moves by a millimetre and its errors hardly change: about 2e-7 of it, and its square.
  CornerLink moved = link;
  moved.body[0] += 1e-3 * c.weakest.body[0];
  moved.carrier[0] += 1e-3 * c.weakest.carrier[0];
  const LinkTask fixed{.body = {{moved.body[0], moved.body[0]}},
                       .carrier = {{moved.carrier[0], moved.carrier[0]}}};
  const LinkFit fit = fit_link(e.targets, fixed, {}, {}, 1, context);
  EXPECT_EQ(fit.starts, 0);
  EXPECT_LT(fit.rms, 1e-8);
  EXPECT_LT(c.singular_values.back(), 1e-6);
  EXPECT_GT(c.singular_values.front(), 0.1);
}

TEST(LinkFit, FewestPositionsArePublishedOnes) {
  const Value& published_counts = test::at(published("limiting-number-of-positions"), "computed");
  const auto expect = [&](const char* key, double found) {
    EXPECT_DOUBLE_EQ(found, test::number_at(published_counts, key)) << key;
  };
  expect("five_US", fewest_positions(30, 5));
  expect("five_US_without_spin", fewest_positions(30, 5, 5));
  expect("SP_3US", fewest_positions(23, 5));
  expect("double_wishbone_2RS_US", fewest_positions(20, 5));
  expect("mcpherson_RS_SP_US", fewest_positions(18, 5));
  expect("single_US", fewest_positions(6, 1));
  expect("single_RS_or_SR", fewest_positions(7, 2));
  expect("single_SP", fewest_positions(5, 2));
  expect("single_RR", fewest_positions(8, 4));
  EXPECT_EQ(fewest_positions(9, 5, 3, true), 4.5);
  EXPECT_EQ(fewest_positions(6, 1, 5), infinity);
}

TEST(LinkFit, RefusesWhatItCannotDo) {
  RunContext context;
  const test::Example e = test::published_example("ex1-forward");
  RandomStream random({1});
  LinkTask task = test::random_task(e.links[0], 0.15, random);
  const auto told = [&](const CarrierTargets& targets) {
    return message([&] { fit_link(targets, task, {}, {}, 1, context); });
  };
  task.type = LinkType::RS;
  EXPECT_THAT(
      told(e.targets),
      HasSubstr("link 'link 1' of type RS needs 2 points on the body and 1 on the carrier, got 1 and 1"));
  task.type = LinkType::US;
  EXPECT_THAT(told({.wheel = e.targets.wheel, .poses = {}}),
              HasSubstr("link 'link 1': no position besides the reference"));
  std::swap(task.body[0].lower, task.body[0].upper);
  EXPECT_THAT(told(e.targets), HasSubstr("link 'link 1': box from "));
}

}  // namespace
}  // namespace linkwright::suspension
