// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/guide/plausibility.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "linkwright/suspension/guide/samples.h"
#include "support/message.h"
#include "tests/suspension/synthesis_cases.h"

namespace linkwright::suspension {
namespace {

using linkwright::test::lines_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// All lengths of a suspension by a factor.
WheelGuide enlarged(const WheelGuide& guide, double factor, bool tyre) {
  WheelGuide out = guide;
  out.wheel.centre = factor * guide.wheel.centre;
  if (tyre) out.wheel.tyre_diameter *= factor;
  for (GuideLink& link : out.links)
    for (auto* points : {&link.body, &link.carrier})
      for (Vec3& p : *points) p = factor * p;
  for (Coupler& c : out.couplers) c.point = factor * c.point;
  if (out.spring) {
    out.spring->body = factor * out.spring->body;
    out.spring->moving = factor * out.spring->moving;
  }
  return out;
}

TEST(Plausibility, GuidesThatAreMeantPassInSilence) {
  for (const GuideSample& sample : guide_samples()) {
    if (sample.guide.wheel.centre.y == 0) continue;  // counted from the wheel centre: reported below
    EXPECT_EQ(lines_of(implausible(sample.guide)), "") << sample.name;
    EXPECT_EQ(lines_of(implausible(mirrored(sample.guide))), "") << sample.name;
    // A model car, a lorry.
    EXPECT_EQ(lines_of(implausible(enlarged(sample.guide, 0.1, true))), "") << sample.name;
    EXPECT_EQ(lines_of(implausible(enlarged(sample.guide, 3, true))), "") << sample.name;
  }
  for (const char* id : {"ex1-forward", "ex2-forward", "ex3-forward", "ex4-forward"})
    EXPECT_EQ(lines_of(implausible(test::published_example(id).targets)), "") << id;
}

TEST(Plausibility, ATyreOfAnotherUnitIsTold) {
  WheelGuide guide = guide_sample("2RS-US").guide;
  guide.wheel.tyre_diameter = 640;  // 640 in tyre_diameter_m: a radius of 210 tracks
  EXPECT_THAT(lines_of(implausible(guide)),
              AllOf(HasSubstr("error: wheel: the tyre's radius is 320 m, the joints lie "),
                    HasSubstr("and the track is 1.52 m; check tyre_diameter")));
  guide.wheel.tyre_diameter = 0.00064;
  EXPECT_THAT(lines_of(implausible(guide)), HasSubstr("error: wheel: the tyre's radius is 0.32 mm"));
  guide.wheel.tyre_diameter = 6.4;  // cm for mm
  EXPECT_THAT(lines_of(implausible(guide)), HasSubstr("warning: wheel: the tyre's radius is 3.2 m"));
}

TEST(Plausibility, PointsOfAnotherUnitAreTold) {
  const WheelGuide& guide = guide_sample("2RS-US").guide;
  EXPECT_THAT(lines_of(implausible(enlarged(guide, 1000, true))),
              AllOf(HasSubstr("error: hard_points: the farthest point of the suspension lies 443"),
                    HasSubstr("are these millimetres in keys of metres?")));
  EXPECT_THAT(lines_of(implausible(enlarged(guide, 0.001, true))),
              AllOf(HasSubstr("error: hard_points: the farthest point of the suspension lies 0.44"),
                    HasSubstr("are these metres in keys of millimetres?")));
  // One point of a list.
  WheelGuide one = guide;
  one.links[2].body[0] = 1000 * one.links[2].body[0];
  EXPECT_THAT(lines_of(implausible(one)), AllOf(HasSubstr("error: link.tie rod: body point lies 4"),
                                                HasSubstr("check the unit in the key")));
  one = guide;
  one.links[0].body[1] = 0.001 * one.links[0].body[1];
  EXPECT_THAT(
      lines_of(implausible(one)),
      AllOf(HasSubstr("warning: link.lower wishbone: body point 2 lies 0.4"), HasSubstr("from the origin")));
}

TEST(Plausibility, AxesThatChangePlacesAreTold) {
  WheelGuide guide = guide_sample("2RS-US").guide;
  const auto turned = [](const Vec3& p) { return Vec3{p.y, p.x, p.z}; };
  guide.wheel.centre = turned(guide.wheel.centre);
  for (GuideLink& link : guide.links)
    for (auto* points : {&link.body, &link.carrier})
      for (Vec3& p : *points) p = turned(p);
  EXPECT_THAT(
      lines_of(implausible(guide)),
      AllOf(
          HasSubstr("warning: wheel: the wheel centre lies at y = 0 mm, in the middle of the vehicle, but at "
                    "x = 760 mm: do the axes change places?"),
          HasSubstr("[mechanism.hard_points] x = ")));
  // Counted from the wheel centre.
  guide = guide_sample("2RS-US").guide;
  guide.wheel.centre = {0, 0, 0};
  for (GuideLink& link : guide.links)
    for (auto* points : {&link.body, &link.carrier})
      for (Vec3& p : *points) p = p - Vec3{0, 0.76, 0};
  guide.spring.reset();
  EXPECT_THAT(lines_of(implausible(guide)),
              AllOf(HasSubstr("warning: wheel: the wheel centre lies at y = 0 mm"), HasSubstr("has no track"),
                    HasSubstr("origin_mm")));
  // Outboard: y counted from somewhere else.
  guide = guide_sample("2RS-US").guide;
  for (GuideLink& link : guide.links)
    for (auto* points : {&link.body, &link.carrier})
      for (Vec3& p : *points) p.y = 2 * 0.76 - p.y;
  guide.spring.reset();
  EXPECT_THAT(lines_of(implausible(guide)),
              HasSubstr("the joints at the body lie outboard of the wheel centre"));
}

TEST(Plausibility, EndsThatChangePlacesAreTold) {
  WheelGuide guide = guide_sample("2RS-US").guide;
  std::swap(guide.links[2].body, guide.links[2].carrier);
  EXPECT_THAT(lines_of(implausible(guide)),
              AllOf(HasSubstr("warning: link.tie rod: its end at the body lies 285 mm outboard"),
                    HasSubstr(" of its end at the carrier: are the ends swapped?; body is the end at the "
                              "vehicle's body")));
  EXPECT_THAT(lines_of(implausible(mirrored(guide))),
              HasSubstr("warning: link.tie rod: its end at the body"));
  // The points of a wishbone from the ball joint on.
  guide = guide_sample("2RS-US").guide;
  std::swap(guide.links[0].body[0], guide.links[0].carrier[0]);
  EXPECT_THAT(lines_of(implausible(guide)),
              HasSubstr("warning: link.lower wishbone: its end at the body lies"));
  // The same for a link of the other type.
  guide = guide_sample("2RS-US").guide;
  std::swap(guide.links[0].body, guide.links[0].carrier);
  guide.links[0].type = LinkType::SR;
  EXPECT_THAT(
      lines_of(implausible(guide)),
      HasSubstr(" outboard of its end at the carrier, and its ball joint is at the body: are the ends"));
}

TEST(Plausibility, PositionsOfAnotherUnitOrAxisAreTold) {
  const test::Example e = test::published_example("ex1-forward");
  const auto changed = [&](auto&& change) {
    CarrierTargets targets = e.targets;
    for (CarrierTarget& pose : targets.poses) change(pose);
    return lines_of(implausible(targets));
  };
  EXPECT_THAT(changed([](CarrierTarget& p) { p.centre = 1000 * p.centre; }),
              AllOf(HasSubstr("error: pose: position "), HasSubstr("the tyre's diameter is 604 mm")));
  EXPECT_THAT(changed([](CarrierTarget& p) { p.centre = 0.001 * p.centre; }),
              HasSubstr("warning: pose: no position comes nearer than 767"));
  EXPECT_THAT(changed([](CarrierTarget& p) { p.rack *= 1000; }),
              AllOf(HasSubstr("error: pose: position "), HasSubstr("the rack goes 75 m")));
  EXPECT_THAT(changed([](CarrierTarget& p) { std::swap(p.centre.x, p.centre.z); }),
              HasSubstr("warning: pose: the wheel centre moves 400 mm along x"));
}

}  // namespace
}  // namespace linkwright::suspension
