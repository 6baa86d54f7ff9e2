// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/design_numbers.h"

#include <gtest/gtest.h>

#include <set>

#include "linkwright/core/check.h"
#include "linkwright/suspension/corner/suspension.h"

namespace linkwright::suspension {
namespace {

TEST(DesignNumbers, EveryHardPointOnceAndWithANameOfItsOwn) {
  for (const CornerSample& sample : corner_samples()) {
    Suspension suspension = sample.suspension;
    for (CornerLink& link : suspension.links)
      if (link.type == LinkType::US) link.length = norm(link.carrier[0] - link.body[0]);
    std::set<std::string> labels;
    std::set<const double*> places;
    for (const DesignNumber& number : hard_points(suspension)) {
      EXPECT_TRUE(labels.insert(label(suspension, number)).second) << label(suspension, number);
      EXPECT_TRUE(places.insert(&design_value(suspension, number)).second);
    }
    std::size_t count = 6 + 4 * suspension.couplers.size();
    if (!suspension.spring) count -= 6;
    for (const CornerLink& link : suspension.links)
      count += 3 * (link.body.size() + link.carrier.size()) + (link.length ? 1 : 0);
    EXPECT_EQ(labels.size(), count) << sample.name;
  }
}

TEST(DesignNumbers, AreCalledByLinkPointAndAxis) {
  Suspension suspension = corner_sample("2RS-US").suspension;
  suspension.links[0].name = "lower arm";
  EXPECT_EQ(label(suspension, {DesignKind::body, 0, 1, 2}), "lower arm.body_2_z");
  EXPECT_EQ(label(suspension, {DesignKind::carrier, 0, 0, 0}), "lower arm.carrier_x");
  EXPECT_EQ(label(suspension, {DesignKind::body, 2, 0, 1}), "tie rod.body_y");
  EXPECT_EQ(label(suspension, {DesignKind::spring_moving, 0, 0, 2}), "spring.moving_z");
  EXPECT_EQ(label(suspension, {DesignKind::wheel_toe}), "wheel.toe");
  design_value(suspension, {DesignKind::body, 2, 0, 1}) = 0.5;
  EXPECT_EQ(suspension.links[2].body[0].y, 0.5);
}

TEST(DesignNumbers, ThatACornerDoesNotHaveAreRefused) {
  const Suspension suspension = corner_sample("5US").suspension;
  const auto message = [&](const DesignNumber& number) -> std::string {
    try {
      design_value(suspension, number);
    } catch (const ContractError& error) {
      return error.what();
    }
    return {};
  };
  EXPECT_NE(message({DesignKind::length, 1}).find("the suspension has no number length, index 1"),
            std::string::npos);
  EXPECT_NE(message({DesignKind::body, 5}).find("no number body, index 5"), std::string::npos);
  EXPECT_NE(message({DesignKind::body, 0, 1}).find("no number body, index 0, point 1"), std::string::npos);
  EXPECT_NE(message({DesignKind::carrier, 0, 0, 3}).find("no number carrier, index 0, point 0, axis 3"),
            std::string::npos);
  EXPECT_NE(message({DesignKind::coupler_point, 0}).find("coupler_point"), std::string::npos);
}

}  // namespace
}  // namespace linkwright::suspension
