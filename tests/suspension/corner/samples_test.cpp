// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "linkwright/suspension/corner/structure.h"
#include "linkwright/suspension/corner/suspension.h"
#include "support/message.h"
#include "suspension/suspensions.h"

namespace linkwright::suspension {
namespace {

void expect_same(const Suspension& a, const Suspension& b) {
  EXPECT_EQ(a.wheel.centre, b.wheel.centre);
  // Degrees to radians: a rounding.
  EXPECT_NEAR(a.wheel.toe, b.wheel.toe, 1e-17);
  EXPECT_NEAR(a.wheel.camber, b.wheel.camber, 1e-17);
  EXPECT_EQ(a.wheel.tyre_diameter, b.wheel.tyre_diameter);
  ASSERT_EQ(a.links.size(), b.links.size());
  for (std::size_t i = 0; i < a.links.size(); ++i) {
    EXPECT_EQ(a.links[i].type, b.links[i].type);
    EXPECT_EQ(a.links[i].body, b.links[i].body);
    EXPECT_EQ(a.links[i].carrier, b.links[i].carrier);
    EXPECT_EQ(a.links[i].moved_by_rack, b.links[i].moved_by_rack);
  }
  EXPECT_EQ(a.rack_direction, b.rack_direction);
  ASSERT_EQ(a.couplers.size(), b.couplers.size());
  for (std::size_t i = 0; i < a.couplers.size(); ++i) {
    EXPECT_EQ(a.couplers[i].fraction, b.couplers[i].fraction);
    EXPECT_EQ(a.couplers[i].point, b.couplers[i].point);
  }
  ASSERT_EQ(a.spring.has_value(), b.spring.has_value());
  if (a.spring) {
    EXPECT_EQ(a.spring->body, b.spring->body);
    EXPECT_EQ(a.spring->moving, b.spring->moving);
    EXPECT_EQ(a.spring->link, b.spring->link);
  }
}

TEST(CornerSamples, AreThePublishedOnes) {
  const std::map<std::string, std::string> examples{{"front_5US", "ex1-forward"},
                                                    {"strut_SP-3US", "ex2-forward"},
                                                    {"interconnected", "ex3-forward"},
                                                    {"rear_5US", "ex4-forward"}};
  ASSERT_EQ(corner_samples().size(), 16u);
  for (const CornerSample& sample : corner_samples()) {
    SCOPED_TRACE(sample.name);
    const auto example = examples.find(sample.name);
    const std::string id = example == examples.end() ? "mechanism-" + sample.name : example->second;
    expect_same(sample.suspension, corner_from(test::at(published(id), "inputs.mechanism")));
    EXPECT_FALSE(sample.summary.empty());
  }
}

TEST(CornerSamples, AreNamedByTheirStructureAndMove) {
  const auto samples = corner_samples();
  const auto basic = basic_structures();
  for (std::size_t i = 0; i < basic.size(); ++i)
    EXPECT_EQ(samples[i].name, structure_name(structure_of(samples[i].suspension)));
  for (const CornerSample& sample : samples) {
    const Diagnostics found = check_structure(sample.suspension);
    for (const Diagnostic& one : found) ADD_FAILURE() << sample.name << ": " << to_string(one);
  }
}

TEST(CornerSamples, UnknownName) {
  EXPECT_THAT(test::message([] { corner_sample("6US"); }),
              ::testing::StartsWith("corner_sample: no sample '6US'; there are R, RR-US, S-2US"));
}

}  // namespace
}  // namespace linkwright::suspension
