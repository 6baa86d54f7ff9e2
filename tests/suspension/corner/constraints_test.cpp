// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "linkwright/suspension/corner/position.h"
#include "linkwright/suspension/corner/suspension.h"
#include "support/message.h"
#include "suspension/suspensions.h"

namespace linkwright::suspension {
namespace {

TEST(CornerConstraints, ReferenceIsAssembled) {
  for (const CornerSample& sample : corner_samples()) {
    const CornerPlan plan = prepare_suspension(sample.suspension);
    CornerEquations at;
    evaluate(plan, {{sample.suspension.wheel.centre, {}}, 0}, 0, Driver::contact_z, 0, at);
    // Rounding of points of about 1 m.
    for (int i = 0; i < plan.unknowns; ++i) EXPECT_NEAR(at.residual[i], 0, 5e-16) << sample.name << i;
    EXPECT_NEAR(worst_misfit(plan, {{sample.suspension.wheel.centre, {}}, 0}, 0).gap, 0, 5e-16);
  }
}

TEST(CornerConstraints, DerivativesWithASteeringLinkage) {
  constexpr double h = 1e-6;
  for (const bool unequal : {false, true})
    for (const char* name : {"2RS-US", "RS-SP-US", "5US", "interconnected"}) {
      Suspension suspension = with_steering_linkage(corner_sample(name).suspension, unequal);
      if (!suspension.steering_linkage) continue;
      SCOPED_TRACE(name);
      const CornerPlan plan = prepare_suspension(suspension);
      const CornerPlace place{
          {plan.wheel.centre + Vec3{0.02, -0.01, 0.03}, math::turn_about({0.1, -0.2, 0.15})}, 0};
      CornerEquations at, more, less;
      evaluate(plan, place, 0.04, Driver::contact_z, 0, at);
      evaluate(plan, place, 0.04 + h, Driver::contact_z, 0, more);
      evaluate(plan, place, 0.04 - h, Driver::contact_z, 0, less);
      for (int i = 0; i < plan.unknowns; ++i)
        EXPECT_NEAR(at.by_rack[i], (more.residual[i] - less.residual[i]) / (2 * h), 1e-9) << i;
    }
}

// Exact derivatives against central differences, at a place off the reference and off assembly, with the
// spring on carrier and links, both sides, hinges moved by the rack.
TEST(CornerConstraints, DerivativesAgainstDifferences) {
  constexpr double h = 1e-6;
  // Truncation h^2 times third derivatives of about 10 /m2, and rounding 1e-16 / h.
  constexpr double close = 1e-9;
  for (const CornerSample& sample : corner_samples())
    for (bool all_on_rack : {false, true})
      for (Driver driver : {Driver::wheel_centre_z, Driver::contact_z, Driver::spring}) {
        Suspension suspension = sample.suspension;
        if (all_on_rack) {
          suspension = mirrored(suspension);
          for (CornerLink& link : suspension.links) link.moved_by_rack = true;
          if (suspension.links[0].type == LinkType::US) {
            const auto& rod = suspension.links[0];
            suspension.spring =
                CornerSpring{{0, -0.4, 0.6}, rod.body[0] + 0.6 * (rod.carrier[0] - rod.body[0]), 0};
          } else if (suspension.links[0].type == LinkType::SR) {
            suspension.spring = CornerSpring{{0, -0.4, 0.6}, {0.2, -0.5, 0.1}, 0};
          }
        }
        if (driver == Driver::spring && !suspension.spring) continue;
        SCOPED_TRACE(sample.name + " " + std::string(name_of(driver)));
        const CornerPlan plan = prepare_suspension(suspension);
        const Mat3 turned = math::turn_about({0.1, -0.2, 0.15});
        const CornerPlace place{{suspension.wheel.centre + Vec3{0.02, -0.01, 0.03}, turned}, 0.2};
        const double rack = 0.013;
        CornerEquations at, more, less;
        evaluate(plan, place, rack, driver, 0, at);
        for (int j = 0; j <= plan.unknowns; ++j) {
          const auto shifted = [&](double by, CornerEquations& out) {
            CornerPlace to = place;
            double q = rack;
            const Vec3 along{j % 3 == 0 ? by : 0, j % 3 == 1 ? by : 0, j % 3 == 2 ? by : 0};
            if (j == plan.unknowns)
              q += by;
            else if (j < 3)
              to.carrier.centre += along;
            else if (j < 6)
              to.carrier.rotation = math::turn_about(along) * turned;
            else
              to.arm += by;
            evaluate(plan, to, q, driver, 0, out);
          };
          shifted(h, more);
          shifted(-h, less);
          for (int i = 0; i < plan.unknowns; ++i)
            EXPECT_NEAR(j == plan.unknowns ? at.by_rack[i] : at.jacobian[i][j],
                        (more.residual[i] - less.residual[i]) / (2 * h), close)
                << "equation " << i << ", unknown " << j;
        }
      }
}

TEST(CornerConstraints, DriverRateIsTheLastRow) {
  const CornerPlan plan = prepare_suspension(corner_sample("2RS-US").suspension);
  const CornerPlace place{{plan.wheel.centre, math::turn_about({0.02, 0.03, -0.1})}, 0};
  CornerEquations at;
  evaluate(plan, place, 0.01, Driver::spring, 0.002, at);
  EXPECT_NEAR(driver_value(plan, place, 0.01, Driver::spring) - 0.002, at.residual[5], 1e-18);
  const double rate = driver_rate(plan, place, 0.01, Driver::spring, {{1, 2, 3}, {4, 5, 6}, 0}, 7);
  double sum = 7 * at.by_rack[5];
  for (int j = 0; j < 6; ++j) sum += (j + 1) * at.jacobian[5][j];
  EXPECT_NEAR(rate, sum, 1e-14);
}

TEST(CornerConstraints, WorstMisfitNamesTheLink) {
  Suspension suspension = corner_sample("5US").suspension;
  const auto& rod = suspension.links[3];
  suspension.links[3].length = norm(rod.carrier[0] - rod.body[0]) - 0.002;
  const CornerPlan plan = prepare_suspension(suspension);
  const Misfit worst = worst_misfit(plan, {{plan.wheel.centre, {}}, 0}, 0);
  EXPECT_EQ(worst.link, 3);
  EXPECT_NEAR(worst.gap, 0.002, 1e-15);
}

TEST(CornerConstraints, Contract) {
  Suspension suspension = corner_sample("5US").suspension;
  suspension.links.pop_back();
  EXPECT_THAT(test::message([&] { prepare_suspension(suspension); }),
              ::testing::HasSubstr("2 degrees of freedom remain"));
  suspension = corner_sample("5US").suspension;
  suspension.wheel.tyre_diameter = -1;
  EXPECT_THAT(test::message([&] { prepare_suspension(suspension); }),
              ::testing::HasSubstr(
                  "1 problems, the first: error: wheel: tyre diameter -1 m, needs a positive number"));
  suspension = corner_sample("interconnected").suspension;
  const CornerPlan plan = prepare_suspension(suspension);
  EXPECT_THAT(test::message([&] { driver_value(plan, {}, 0, Driver::spring); }),
              ::testing::HasSubstr("the driver is the spring, and the suspension has none"));
}

}  // namespace
}  // namespace linkwright::suspension
