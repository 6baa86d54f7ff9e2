#include "linkwright/suspension/indirect_synthesis.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/message.h"
#include "tests/suspension/synthesis_cases.h"

namespace linkwright::suspension {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;

IndirectTask whole(const test::Example& e, std::uint64_t seed) {
  IndirectTask task{.targets = e.targets};
  RandomStream random({seed, 31});
  for (const GuideLink& link : e.links) task.links.push_back(test::random_task(link, 0.15, random));
  for (const Coupler& c : e.guide.couplers)
    task.couplers.push_back({.name = "coupler",
                             .first = c.first,
                             .second = c.second,
                             .least_offset = 0.1,
                             .point = box_around(c.point, 0.15)});
  return task;
}

TEST(IndirectSynthesis, WholeMechanismsOfTheSource) {
  for (const char* id : {"ex1-forward", "ex2-forward", "ex3-forward", "ex4-forward"}) {
    const test::Example e = test::example(id);
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      const IndirectSynthesis found = synthesise(whole(e, seed), {}, seed);
      ASSERT_EQ(found.status, Status::done)
          << id << " seed " << seed << " " << (found.findings.empty() ? "" : to_string(found.findings[0]));
      EXPECT_LT(found.largest, 1e-8);
      for (std::size_t j = 0; j < e.links.size(); ++j)
        EXPECT_LT(largest_distance(found.guide.links[j], e.links[j]), 1e-4)
            << id << " seed " << seed << " link " << j;
    }
  }
}

TEST(IndirectSynthesis, CouplerIsFoundToTheNanometre) {
  const test::Example e = test::example("ex3-forward");
  const CouplerTask task{.second = 2, .least_offset = 0.1, .point = box_around({0.23, 0.6, -0.07}, 0.15)};
  const CouplerFit fit = fit_coupler(e.targets, e.links, task);
  EXPECT_EQ(fit.status, Status::done);
  EXPECT_NEAR(fit.offset, 0.176, 1e-8);  // errors of the positions, 1e-15 m, times a condition of 1e6
  EXPECT_LT(norm(fit.coupler.point - Vec3{0.2, 0.628, -0.058}), 1e-8);
  EXPECT_LT(fit.rms, 1e-13);
}

TEST(IndirectSynthesis, CouplerKeepsToItsBox) {
  const test::Example e = test::example("ex3-forward");
  const CouplerTask task{.second = 2, .least_offset = 0.1, .point = box_around({0.3, 0.7, -0.07}, 0.1)};
  const CouplerFit fit = fit_coupler(e.targets, e.links, task);
  EXPECT_EQ(fit.status, Status::not_converged);
  EXPECT_GT(fit.rms, 1e-7);
  EXPECT_GE(fit.coupler.point.x, 0.25);
  EXPECT_GE(fit.coupler.point.y, 0.65);
}

TEST(IndirectSynthesis, TooFewPositionsAreTold) {
  test::Example e = test::example("ex1-forward");
  e.targets.poses.resize(6);
  const IndirectSynthesis found = synthesise(whole(e, 1), {}, 1);
  EXPECT_EQ(found.fewest, 7);
  ASSERT_FALSE(found.findings.empty());
  EXPECT_EQ(
      to_string(found.findings[0]),
      "warning: target: 6 positions, the reference included, leave a family of exact solutions; 7 positions "
      "determine the links");
}

TEST(IndirectSynthesis, OneLinkIsNotTakenTwice) {
  const test::Example e = test::example("ex1-forward");
  IndirectTask task = whole(e, 1);
  task.links[1] = task.links[0];  // the same boxes again: they hold one link only
  const IndirectSynthesis found = synthesise(task, {.starts = 20}, 1);
  EXPECT_NE(found.status, Status::done);
  EXPECT_GT(found.links[1].duplicates, 0);
}

TEST(IndirectSynthesis, RefusesCouplersItCannotPlace) {
  const test::Example e = test::example("ex3-forward");
  const auto told = [&](const CouplerTask& task) {
    return message([&] { fit_coupler(e.targets, e.links, task); });
  };
  EXPECT_THAT(told({.name = "c", .first = 0, .second = 1}),
              HasSubstr("coupler 'c': link 1 is of type KS, needs SR"));
  EXPECT_THAT(told({.name = "c", .first = 0, .second = 5}), HasSubstr("coupler 'c': link 5 of 3"));
  EXPECT_THAT(told({.name = "c", .second = 2, .least_offset = 1}),
              HasSubstr("coupler 'c': offset of at least 1 m on a link of 0.286"));
}

}  // namespace
}  // namespace linkwright::suspension
