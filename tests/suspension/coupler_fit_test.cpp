#include "linkwright/suspension/coupler_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "support/message.h"
#include "tests/suspension/synthesis_cases.h"

namespace linkwright::suspension {
namespace {

using linkwright::test::message;
using ::testing::HasSubstr;

TEST(CouplerFit, IsFoundToTheNanometre) {
  const test::Example e = test::example("ex3-forward");
  const CouplerTask task{.second = 2, .least_offset = 0.1, .point = box_around({0.23, 0.6, -0.07}, 0.15)};
  const CouplerFit fit = fit_coupler(e.targets, e.links, task);
  EXPECT_EQ(fit.status, Status::done);
  EXPECT_NEAR(fit.offset, 0.176, 1e-8);  // errors of the positions, 1e-15 m, times a condition of 1e6
  EXPECT_LT(norm(fit.coupler.point - Vec3{0.2, 0.628, -0.058}), 1e-8);
  EXPECT_LT(fit.rms, 1e-13);
}

TEST(CouplerFit, KeepsToItsBox) {
  const test::Example e = test::example("ex3-forward");
  const CouplerTask task{.second = 2, .least_offset = 0.1, .point = box_around({0.3, 0.7, -0.07}, 0.1)};
  const CouplerFit fit = fit_coupler(e.targets, e.links, task);
  EXPECT_EQ(fit.status, Status::not_converged);
  EXPECT_GT(fit.rms, 1e-7);
  EXPECT_GE(fit.coupler.point.x, 0.25);
  EXPECT_GE(fit.coupler.point.y, 0.65);
}

TEST(CouplerFit, RefusesLinksItCannotJoin) {
  const test::Example e = test::example("ex3-forward");
  const auto told = [&](const CouplerTask& task) {
    return message([&] { fit_coupler(e.targets, e.links, task); });
  };
  EXPECT_THAT(told({.name = "c", .first = 0, .second = 1}),
              HasSubstr("coupler 'c': link 1 is of type KS, needs SR"));
  EXPECT_THAT(told({.name = "c", .first = 0, .second = 5}), HasSubstr("coupler 'c': link 5 of 3"));
  EXPECT_THAT(told({.name = "c", .second = 2, .least_offset = 1}),
              HasSubstr("coupler 'c': offset of at least 1 m and at most inf m on a link of 0.286"));
}

}  // namespace
}  // namespace linkwright::suspension
