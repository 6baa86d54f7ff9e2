// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/open_linkage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "clearance/contact_cases.h"
#include "linkwright/planar/linkage/samples.h"
#include "support/message.h"

namespace linkwright::clearance {
namespace {

std::vector<int> joints(const planar::Linkage& l, std::initializer_list<const char*> names) {
  std::vector<int> out;
  for (const char* name : names) out.push_back(planar::joint_index(l, name));
  return out;
}

TEST(OpenLinkage, KeepsClosedFormsAndStartsClosed) {
  ClearanceFourBar model = published_four_bar("gamma-design2-table3-g9.81-w20");
  const planar::Linkage l = as_linkage(model);
  for (const std::vector<int>& pins :
       {joints(l, {"A"}), joints(l, {"B"}), joints(l, {"O4"}), joints(l, {"A", "B"}), joints(l, {"B", "O4"}),
        joints(l, {"A", "B", "O4"})}) {
    const OpenLinkage open = open_linkage(l, pins, std::vector{0.7});
    ASSERT_EQ(open.status, Status::done) << open.message;
    EXPECT_TRUE(open.plan.closed_form());
    EXPECT_EQ(open.plan.inputs(), 1 + 2 * pins.size());
    for (const planar::Group& g : open.plan.groups) EXPECT_TRUE(g.as<planar::Driver>());
    planar::LinkageMotion motion(open.plan);
    std::vector<planar::InputMotion> inputs;
    for (const double value : open.start) inputs.push_back({value, 0, 0});
    planar::solve_motion(open.plan, inputs, motion);
    for (std::size_t k = 0; k < pins.size(); ++k) EXPECT_LT(std::abs(pin_gap(open, motion, k).way), 1e-15);

    // Wanted gaps come out, with their rates; the crank is left as it is.
    inputs[0].rate = 3;
    std::vector<PinGap> gaps;
    for (std::size_t k = 0; k < pins.size(); ++k)
      gaps.push_back({std::polar(1e-3, 1.0 + static_cast<double>(k)), std::polar(0.2, 2.0)});
    ASSERT_EQ(place_pins(open, gaps, inputs, 1), Status::done);
    planar::solve_motion(open.plan, inputs, motion);
    for (std::size_t k = 0; k < pins.size(); ++k) {
      const PinGap gap = pin_gap(open, motion, k);
      EXPECT_LT(std::abs(gap.way - gaps[k].way), 1e-15);
      EXPECT_LT(std::abs(gap.rate - gaps[k].rate), 1e-14);
    }
    EXPECT_EQ(inputs[0].value, 0.7);
    EXPECT_EQ(inputs[0].rate, 3);
  }
}

TEST(OpenLinkage, SliderCrankAndLeg) {
  const planar::Linkage l = contact_slider_crank();
  for (const char* pin : {"A", "B"}) {
    const OpenLinkage open = open_linkage(l, joints(l, {pin}), std::vector{1.0});
    ASSERT_EQ(open.status, Status::done) << open.message;
    EXPECT_TRUE(open.plan.closed_form());
  }
  const planar::LinkageSample leg = planar::jansen_leg_sample();
  int opened = 0;
  for (std::size_t j = 0; j < leg.linkage.joints.size(); ++j) {
    if (static_cast<int>(j) == leg.linkage.driven[0]) continue;
    const int joint = static_cast<int>(j);
    const OpenLinkage open = open_linkage(leg.linkage, std::span(&joint, 1), leg.from);
    if (leg.linkage.joints[j].name == "G lower") {  // leaves a rocker that has both of its pins in one point
      EXPECT_EQ(open.status, Status::infeasible);
      EXPECT_THAT(open.message,
                  ::testing::HasSubstr("without the clearance joints no joint coordinates are left"));
      EXPECT_THAT(open.message, ::testing::HasSubstr("has no length"));
      continue;
    }
    ASSERT_EQ(open.status, Status::done) << open.message;
    EXPECT_TRUE(open.plan.closed_form()) << leg.linkage.joints[j].name;
    ++opened;
  }
  EXPECT_EQ(opened, 8);
}

TEST(OpenLinkage, SaysWhatDoesNotWork) {
  ClearanceFourBar model = published_four_bar("gamma-design2-table3-g9.81-w20");
  planar::Linkage l = as_linkage(model);
  EXPECT_THAT(test::message([&] { open_linkage(l, joints(l, {"O2"}), std::vector{0.0}); }),
              ::testing::HasSubstr("joint 'O2' must be a revolute joint without drive and friction"));
  EXPECT_THAT(test::message([&] {
                open_linkage(l, joints(l, {"A", "A"}), std::vector{0.0});
              }),
              ::testing::HasSubstr("joint 'A' is given twice"));
  EXPECT_THAT(test::message([&] { open_linkage(l, joints(l, {"A"}), {}); }),
              ::testing::HasSubstr("the linkage has 1 inputs, got 0"));
  model.linkage.coupler = 0.01;
  l = as_linkage(model);
  const OpenLinkage none = open_linkage(l, joints(l, {"A"}), std::vector{0.0});
  EXPECT_EQ(none.status, Status::no_assembly);
  EXPECT_THAT(none.message, ::testing::HasSubstr("without clearance the start does not work"));
}

}  // namespace
}  // namespace linkwright::clearance
