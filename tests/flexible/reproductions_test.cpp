// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/reproductions.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>

#include "linkwright/flexible/samples.h"
#include "support/reproduced.h"

namespace linkwright::flexible {
namespace {

using ::testing::HasSubstr;

std::vector<study::Comparison> rows(std::string_view id) { return test::rows_of(reproductions(), id); }

TEST(FlexibleReproductions, HaveIdsTitlesSourcesAndNotes) { test::expect_complete(reproductions()); }

TEST(FlexibleReproductions, SpinUp) {
  const auto table = rows("boskovic-2018-spin-up");
  ASSERT_EQ(table.size(), 9u);
  for (const study::Comparison& r : table) EXPECT_FALSE(r.note.empty()) << r.item;
  // Curves without numbers are not reproduced.
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(table[i].verdict, "not reproduced");
    EXPECT_TRUE(std::isnan(table[i].published));
  }
  // The linearised equations lag by 0.1737 m for each rad/s, whatever the speed.
  EXPECT_THAT(table[2].note, HasSubstr("the printed equations give 0.69"));
  EXPECT_THAT(table[5].note, HasSubstr("the printed equations give 2.7"));
  // 3.89771 in units of w_s = sqrt(E I / (rho A L^4)).
  EXPECT_NEAR(table[6].ours, 3.89771 * spin_up_beam().frequency_scale(), 1e-5);
  EXPECT_NEAR(table[7].ours, 8.5797, 1e-4);
  EXPECT_NEAR(table[8].ours, 21.6400, 2e-4);
  EXPECT_THAT(table[8].note, HasSubstr("(3.49) as printed gives 5.7"));
}

TEST(FlexibleReproductions, Torque) {
  const auto table = rows("boskovic-2018-torque");
  ASSERT_EQ(table.size(), 4u);
  // First minimum of the continuum, and of the printed equations.
  const double continuum[] = {0.13405, 0.26674, 0.52282, 0.75860};
  const char* printed[] = {"0.1343", "0.2686", "0.5373", "0.8059"};
  for (std::size_t i = 0; i < 4; ++i) {
    // Error of 8 divisions and steps of 2 ms.
    EXPECT_NEAR(table[i].ours, continuum[i], 3e-5) << table[i].item;
    EXPECT_THAT(table[i].note, HasSubstr(std::string("the printed equations give ") + printed[i]));
  }
}

}  // namespace
}  // namespace linkwright::flexible
