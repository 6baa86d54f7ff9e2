// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/structure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "linkwright/suspension/corner/suspension.h"
#include "support/message.h"
#include "suspension/suspensions.h"

namespace linkwright::suspension {
namespace {

using ::testing::ElementsAre;

TEST(Structure, ReadsAndWritesNames) {
  EXPECT_EQ(parse_structure("SR-3US").structure,
            (Structure{LinkType::SR, LinkType::US, LinkType::US, LinkType::US}));
  EXPECT_EQ(parse_structure("R").structure, Structure{LinkType::R});
  EXPECT_EQ(structure_name(parse_structure("3SS-SP").structure), "SP-3US");
  for (const Structure& one : basic_structures())
    EXPECT_EQ(parse_structure(structure_name(one)).structure, one);
}

TEST(Structure, NamesMistakesOfAName) {
  EXPECT_EQ(parse_structure("SR-3KX").problem,
            "'KX' in 'SR-3KX' is not a link type; there are R, RR, S, RS, SR, SP, US, SS");
  EXPECT_EQ(parse_structure("9US").problem, "'9US' in '9US': a count lies between 1 and 5");
  EXPECT_EQ(parse_structure("SR--US").problem,
            "'SR--US' has nothing between its '-': write link types such as SR-3US");
  EXPECT_EQ(parse_structure("").problem, "'' has nothing between its '-': write link types such as SR-3US");
  EXPECT_FALSE(parse_structure("3").problem.empty());
  EXPECT_TRUE(parse_structure("3").structure.empty());
}

TEST(Structure, TwelveBasicMechanisms) {
  const Value& reference = published("ch3-basic-mechanisms");
  std::vector<std::string> names;
  for (const Structure& one : basic_structures()) {
    names.push_back(structure_name(one));
    EXPECT_EQ(mobility(one), 1) << names.back();
  }
  std::vector<std::string> expected;
  for (const Value& name : test::at(reference, "computed.names").as_array())
    expected.push_back(name.as_string());
  EXPECT_EQ(names, expected);
  for (const auto& member : test::at(reference, "inputs.constraints_per_connection").as_object())
    EXPECT_EQ(constraints(parse_structure(member.key).structure.at(0)), member.value.as_integer())
        << member.key;
}

TEST(Structure, DesignParameters) {
  int sum = 0;
  for (LinkType type : parse_structure("5US").structure) sum += design_parameters(type);
  EXPECT_EQ(sum, 30);  // the unknowns of the first published example
  EXPECT_EQ(design_parameters(LinkType::RR), 8);
}

TEST(Structure, WrongCountsAreToldWithTheirSum) {
  Suspension suspension = corner_sample("2RS-US").suspension;
  suspension.links.pop_back();
  Diagnostics found = check_structure(suspension);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].message,
            "the links constrain 4 of the carrier's 6 degrees of freedom (2 RS: 4), 5 must be constrained");
  EXPECT_EQ(found[0].hint, "the wheel would have 2 degrees of freedom: add links");

  suspension = corner_sample("5US").suspension;
  suspension.links.push_back(suspension.links[0]);
  suspension.links.back().name = "sixth rod";
  found = check_structure(suspension);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].message,
            "the links constrain 6 of the carrier's 6 degrees of freedom (6 US: 6), 5 must be constrained");
  EXPECT_EQ(
      found[0].hint,
      "redundant links need elastic joints: rigid ones would lock, or close for special dimensions only");
}

TEST(Structure, EqualLinksLoseRank) {
  Suspension suspension = corner_sample("5US").suspension;
  suspension.links[4] = suspension.links[3];
  suspension.links[4].name = "double";
  const Diagnostics found = check_structure(suspension);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].severity, Diagnostic::Severity::error);
  EXPECT_THAT(to_string(found[0].message),
              ::testing::StartsWith(
                  "the ball joints of 'upper front rod' and 'double' at the carrier are in one place: "
                  "the count is right, yet the links do not constrain the carrier when the height of "
                  "the wheel centre is fixed: turning about y"));
}

TEST(Structure, NamesTheGeometricCauseBeforeTheFreedom) {
  const auto found = [](const Suspension& suspension) {
    return linkwright::test::lines_of(check_structure(suspension));
  };
  Suspension suspension = corner_sample("2RS-US").suspension;
  suspension.links[1].carrier = suspension.links[0].carrier;
  EXPECT_THAT(
      found(suspension),
      ::testing::HasSubstr("the ball joints of 'lower wishbone' and 'upper wishbone' at the carrier are in "
                           "one place: the count is right, yet"));
  EXPECT_THAT(found(suspension),
              ::testing::HasSubstr("; set them apart, so that one of them resists this motion"));
  // Ball joints apart, rods in one line.
  suspension = corner_sample("5US").suspension;
  const Vec3 along = suspension.links[3].carrier[0] - suspension.links[3].body[0];
  suspension.links[4].body[0] = suspension.links[3].body[0] - 0.1 * along;
  suspension.links[4].carrier[0] = suspension.links[3].carrier[0] - 0.1 * along;
  EXPECT_THAT(found(suspension),
              ::testing::ContainsRegex("error: links: the rods of '[^']+' and '[^']+' lie in one line: "));
  // Both wishbones and the tie rod in the plane z = 0.
  suspension = corner_sample("2RS-US").suspension;
  for (CornerLink& link : suspension.links)
    for (auto* points : {&link.body, &link.carrier})
      for (Vec3& p : *points) p.z = 0;
  suspension.spring.reset();
  EXPECT_THAT(found(suspension),
              ::testing::HasSubstr("the links 'lower wishbone', 'upper wishbone', 'tie rod' lie in "
                                   "one plane: the count is right, yet"));
  // A rod of no length, a spring of no length.
  suspension = corner_sample("2RS-US").suspension;
  suspension.links[2].body = suspension.links[2].carrier;
  EXPECT_THAT(found(suspension),
              ::testing::HasSubstr("body and carrier point are the same: a link needs a length"));
  suspension = corner_sample("2RS-US").suspension;
  suspension.spring->body = suspension.spring->moving;
  EXPECT_THAT(found(suspension), ::testing::HasSubstr("spring: both ends are the same point"));
}

TEST(Structure, TrailingLinkWithALateralHingeHardlyHoldsPitch) {
  Suspension suspension = corner_sample("SR-3US").suspension;
  suspension.links[0].carrier = {{0.05, 0.6, -0.09}, {0.05, 0.7, -0.09}};
  const Diagnostics found = check_structure(suspension);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].severity, Diagnostic::Severity::warning);
  EXPECT_THAT(to_string(found[0].message),
              ::testing::StartsWith("the links hardly constrain the carrier when the height of the "
                                    "wheel centre is fixed: turning about y"));
}

}  // namespace
}  // namespace linkwright::suspension
