// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/columns.h"

#include <gmock/gmock.h>

#include "planar/linkages.h"

namespace linkwright::planar {
namespace {

using namespace test;

TEST(LinkageColumns, AreThoseOfTheQuantities) {
  const LinkageSample s = slider_crank_sample();
  const LinkagePlan p = planned(s.linkage);
  const auto keys = [&](const std::vector<std::string>& listed) {
    std::vector<std::string> out;
    for (const LinkageColumn& c : linkage_columns(s.linkage, p, chosen_quantities(listed), {}))
      out.push_back(c.key);
    return out;
  };
  EXPECT_THAT(keys({"drive"}), ::testing::ElementsAre("O_drive_torque_N_m", "closure_residual_m"));
  EXPECT_THAT(keys({"transmission_angle"}),
              ::testing::ElementsAre("rod_slider_transmission_angle_rad", "closure_residual_m"));
  EXPECT_THAT(keys({"position"}),
              ::testing::IsSupersetOf({"rod_angle_rad", "slider_x_m", "guide_displacement_m"}));
  // Each quantity has its own columns, and all of them are those of an empty list.
  std::size_t sum = 1;
  for (const Word& w : linkage_quantity_words()) sum += keys({std::string(w.name)}).size() - 1;
  EXPECT_EQ(keys({}).size(), sum);
}

TEST(LinkageColumns, HoldValuesOfAnInstant) {
  const LinkageSample s = slider_crank_sample();
  const LinkagePlan p = planned(s.linkage);
  LinkageMotion m(p);
  LinkageInstant now{.inputs = {{0.5, 2, 0}}, .motion = &m};
  solve_motion(p, now.inputs, m);
  for (const LinkageColumn& c : linkage_columns(s.linkage, p, chosen_quantities({"position", "rates"}), {})) {
    if (c.key == "crank_angle_rad") {
      EXPECT_NEAR(c.value(now), 0.5, 1e-15);
    } else if (c.key == "crank_speed_rad_per_s") {
      EXPECT_NEAR(c.value(now), 2, 1e-15);
    } else if (c.key == "guide_displacement_m") {
      EXPECT_EQ(c.value(now), place_of(s.linkage, p, m, "slider.B").x);
    }
  }
  EXPECT_EQ(input_key(s.linkage, p, 0), "O_angle_rad");
  EXPECT_EQ(input_label(s.linkage, p, 0), "O angle (rad)");
  EXPECT_EQ(identifier("link 1-a"), "link_1_a");
}

}  // namespace
}  // namespace linkwright::planar
