// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/corner/plausibility.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "linkwright/suspension/corner/suspension.h"
#include "support/message.h"
#include "tests/suspension/synthesis_cases.h"

namespace linkwright::suspension {
namespace {

using linkwright::test::lines_of;
using ::testing::AllOf;
using ::testing::HasSubstr;

/// All lengths of a suspension by a factor.
Suspension enlarged(const Suspension& suspension, double factor, bool tyre) {
  Suspension out = suspension;
  out.wheel.centre = factor * suspension.wheel.centre;
  if (tyre) out.wheel.tyre_diameter *= factor;
  for (CornerLink& link : out.links)
    for (auto* points : {&link.body, &link.carrier})
      for (Vec3& p : *points) p = factor * p;
  for (Coupler& c : out.couplers) c.point = factor * c.point;
  if (out.spring) {
    out.spring->body = factor * out.spring->body;
    out.spring->moving = factor * out.spring->moving;
  }
  return out;
}

TEST(Plausibility, CornersThatAreMeantPassInSilence) {
  for (const CornerSample& sample : corner_samples()) {
    if (sample.suspension.wheel.centre.y == 0) continue;  // counted from the wheel centre: reported below
    EXPECT_EQ(lines_of(implausible(sample.suspension)), "") << sample.name;
    EXPECT_EQ(lines_of(implausible(mirrored(sample.suspension))), "") << sample.name;
    // A model car, a lorry.
    EXPECT_EQ(lines_of(implausible(enlarged(sample.suspension, 0.1, true))), "") << sample.name;
    EXPECT_EQ(lines_of(implausible(enlarged(sample.suspension, 3, true))), "") << sample.name;
  }
  for (const char* id : {"ex1-forward", "ex2-forward", "ex3-forward", "ex4-forward"})
    EXPECT_EQ(lines_of(implausible(test::published_example(id).targets)), "") << id;
}

TEST(Plausibility, ATyreOfAnotherUnitIsTold) {
  Suspension suspension = corner_sample("2RS-US").suspension;
  suspension.wheel.tyre_diameter = 640;  // 640 in tyre_diameter_m: a radius of 210 tracks
  EXPECT_THAT(lines_of(implausible(suspension)),
              AllOf(HasSubstr("error: wheel: the tyre's radius is 320 m, the joints lie "),
                    HasSubstr("and the track is 1.52 m; check tyre_diameter")));
  suspension.wheel.tyre_diameter = 0.00064;
  EXPECT_THAT(lines_of(implausible(suspension)), HasSubstr("error: wheel: the tyre's radius is 0.32 mm"));
  suspension.wheel.tyre_diameter = 6.4;  // cm for mm
  EXPECT_THAT(lines_of(implausible(suspension)), HasSubstr("warning: wheel: the tyre's radius is 3.2 m"));
}

TEST(Plausibility, PointsOfAnotherUnitAreTold) {
  const Suspension& suspension = corner_sample("2RS-US").suspension;
  EXPECT_THAT(lines_of(implausible(enlarged(suspension, 1000, true))),
              AllOf(HasSubstr("error: hard_points: the farthest point of the suspension lies 443"),
                    HasSubstr("are these millimetres in keys of metres?")));
  EXPECT_THAT(lines_of(implausible(enlarged(suspension, 0.001, true))),
              AllOf(HasSubstr("error: hard_points: the farthest point of the suspension lies 0.44"),
                    HasSubstr("are these metres in keys of millimetres?")));
  // One point of a list.
  Suspension one = suspension;
  one.links[2].body[0] = 1000 * one.links[2].body[0];
  EXPECT_THAT(lines_of(implausible(one)), AllOf(HasSubstr("error: link.tie rod: body point lies 4"),
                                                HasSubstr("check the unit in the key")));
  one = suspension;
  one.links[0].body[1] = 0.001 * one.links[0].body[1];
  EXPECT_THAT(
      lines_of(implausible(one)),
      AllOf(HasSubstr("warning: link.lower wishbone: body point 2 lies 0.4"), HasSubstr("from the origin")));
}

TEST(Plausibility, AxesThatChangePlacesAreTold) {
  Suspension suspension = corner_sample("2RS-US").suspension;
  const auto turned = [](const Vec3& p) { return Vec3{p.y, p.x, p.z}; };
  suspension.wheel.centre = turned(suspension.wheel.centre);
  for (CornerLink& link : suspension.links)
    for (auto* points : {&link.body, &link.carrier})
      for (Vec3& p : *points) p = turned(p);
  EXPECT_THAT(
      lines_of(implausible(suspension)),
      AllOf(
          HasSubstr("warning: wheel: the wheel centre lies at y = 0 mm, in the middle of the vehicle, but at "
                    "x = 760 mm: do the axes change places?"),
          HasSubstr("[mechanism.hard_points] x = ")));
  // Counted from the wheel centre.
  suspension = corner_sample("2RS-US").suspension;
  suspension.wheel.centre = {0, 0, 0};
  for (CornerLink& link : suspension.links)
    for (auto* points : {&link.body, &link.carrier})
      for (Vec3& p : *points) p = p - Vec3{0, 0.76, 0};
  suspension.spring.reset();
  EXPECT_THAT(lines_of(implausible(suspension)),
              AllOf(HasSubstr("warning: wheel: the wheel centre lies at y = 0 mm"), HasSubstr("has no track"),
                    HasSubstr("origin_mm")));
  // Outboard: y counted from somewhere else.
  suspension = corner_sample("2RS-US").suspension;
  for (CornerLink& link : suspension.links)
    for (auto* points : {&link.body, &link.carrier})
      for (Vec3& p : *points) p.y = 2 * 0.76 - p.y;
  suspension.spring.reset();
  EXPECT_THAT(lines_of(implausible(suspension)),
              HasSubstr("the joints at the body lie outboard of the wheel centre"));
}

TEST(Plausibility, EndsThatChangePlacesAreTold) {
  Suspension suspension = corner_sample("2RS-US").suspension;
  std::swap(suspension.links[2].body, suspension.links[2].carrier);
  EXPECT_THAT(lines_of(implausible(suspension)),
              AllOf(HasSubstr("warning: link.tie rod: its end at the body lies 285 mm outboard"),
                    HasSubstr(" of its end at the carrier: are the ends swapped?; body is the end at the "
                              "vehicle's body")));
  EXPECT_THAT(lines_of(implausible(mirrored(suspension))),
              HasSubstr("warning: link.tie rod: its end at the body"));
  // The points of a wishbone from the ball joint on.
  suspension = corner_sample("2RS-US").suspension;
  std::swap(suspension.links[0].body[0], suspension.links[0].carrier[0]);
  EXPECT_THAT(lines_of(implausible(suspension)),
              HasSubstr("warning: link.lower wishbone: its end at the body lies"));
  // The same for a link of the other type.
  suspension = corner_sample("2RS-US").suspension;
  std::swap(suspension.links[0].body, suspension.links[0].carrier);
  suspension.links[0].type = LinkType::SR;
  EXPECT_THAT(
      lines_of(implausible(suspension)),
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
