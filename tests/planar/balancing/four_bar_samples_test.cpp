// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "linkwright/planar/balancing/four_bar.h"
#include "planar/balancing_cases.h"
#include "support/message.h"

namespace linkwright::planar {
namespace {

using test::dynamics_case;

TEST(FourBarBalancingSamples, AreThoseOfTheReference) {
  EXPECT_EQ(four_bar_numbers(balancing_original()),
            test::numbers_of(*dynamics_case("fourbar-initial-samples").find("inputs")));
  ASSERT_EQ(published_balancings().size(), 5u);
  for (const PublishedBalancing& p : published_balancings()) {
    const std::string name(p.name), algorithm = name == "sp-fa" ? "" : "-H-CS-FA";
    EXPECT_EQ(four_bar_numbers(p.published),
              test::numbers_of(*dynamics_case("published-" + name + algorithm).find("inputs")))
        << name;
    const Value& best = dynamics_case("best-known-" + name + "-rms-minimax_pub");
    for (std::size_t j = 0; j < four_bar_number_count; ++j) {
      const Value& range = test::at(best, fmt::format("inputs.bounds.{}", test::design_keys[j]));
      EXPECT_EQ(p.problem.bounds[j],
                (Range{range.as_array()[0].as_number(), range.as_array()[1].as_number()}))
          << name << " " << test::design_keys[j];
    }
    const auto& objectives = test::at(best, "computed.objectives").as_array();
    ASSERT_EQ(p.problem.objectives.size(), objectives.size()) << name;
    for (std::size_t k = 0; k < objectives.size(); ++k)
      EXPECT_EQ(p.problem.objectives[k].component, test::component(objectives[k].as_string())) << name;
  }
}

TEST(FourBarBalancingSamples, AreFoundByName) {
  EXPECT_EQ(published_balancing("case3x").name, "case3x");
  EXPECT_THAT(test::message([] { published_balancing("case4"); }),
              ::testing::HasSubstr("no published balancing is named case4"));
}

}  // namespace
}  // namespace linkwright::planar
