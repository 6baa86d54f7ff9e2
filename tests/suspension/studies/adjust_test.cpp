// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/adjust.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/suspension/corner/design_numbers.h"
#include "linkwright/suspension/wheel/parameters.h"
#include "suspension/pushrod_corner.h"
#include "suspension/pushrod_study.h"

namespace linkwright::suspension {
namespace {

using test::problems_of;
using test::pushrod_study;
using test::run_text;
using ::testing::HasSubstr;

constexpr double degree = pi / 180;
const std::string sleeve =
    "[[adjust.adjuster]]\nname = \"sleeve\"\nnumber = \"tie rod.length\"\nper_turn_mm = 1.5\n";
const std::string shims =
    "[[adjust.adjuster]]\nname = \"front shim\"\nnumber = \"upper wishbone.body_1_y\"\nper_turn_mm = 1\n"
    "[[adjust.adjuster]]\nname = \"rear shim\"\nnumber = \"upper wishbone.body_2_y\"\nper_turn_mm = 1\n";

double turns(const study::Result& result, const char* name) {
  return test::named(*result.table("adjustment"), name, "turns");
}

/// The wheel of a corner whose links were changed, at the height of its drawing.
WheelParameters standing(const Suspension& changed) {
  const CornerPlan plan = prepare_suspension(changed);
  const CornerPosition at = reference_position(plan, Driver::wheel_centre_z);
  EXPECT_EQ(at.status, Status::done);
  return wheel_parameters(plan, at);
}

TEST(Adjust, TurnsOfTheTieRodSetToe) {
  const study::Result result = run_text(pushrod_study + "[adjust]\ntoe_deg = 0.4\n" + sleeve);
  ASSERT_EQ(result.status, Status::done);
  Suspension made = pushrod_corner();
  made.links[2].length =
      norm(made.links[2].carrier[0] - made.links[2].body[0]) + 1.5e-3 * turns(result, "sleeve");
  EXPECT_NEAR(standing(made).angles.toe, 0.4 * degree, 1e-12);
  EXPECT_GT(std::abs(turns(result, "sleeve")), 0.1);
  // By a turn: the difference of two settings.
  const double length = *made.links[2].length;
  const auto toe = [&](double more) {
    made.links[2].length = length + more * 1.5e-3;
    return standing(made).angles.toe;
  };
  EXPECT_NEAR(test::named(*result.table("adjustment"), "sleeve", "toe_by_turn_rad"),
              (toe(0.01) - toe(-0.01)) / 0.02, 1e-8);
}

TEST(Adjust, ShimsSetCamberAndCasterWithTheWishboneAsItIsMade) {
  const study::Result result =
      run_text(pushrod_study + "[adjust]\ntoe_deg = 0.1\ncamber_deg = -1\ncaster_deg = 6\n" + sleeve + shims);
  ASSERT_TRUE(result.table("adjustment"));
  Suspension made = as_built(pushrod_corner());
  *made.links[2].length += 1.5e-3 * turns(result, "sleeve");
  made.links[1].body[0].y += 1e-3 * turns(result, "front shim");
  made.links[1].body[1].y += 1e-3 * turns(result, "rear shim");
  const WheelParameters found = standing(made);
  EXPECT_NEAR(found.angles.toe, 0.1 * degree, 1e-11);
  EXPECT_NEAR(found.angles.camber, -1 * degree, 1e-11);
  ASSERT_TRUE(found.axis_at_spring);
  EXPECT_NEAR(found.axis_at_spring->caster, 6 * degree, 1e-9);
}

TEST(Adjust, SeveralAdjustersOfOneAngleTurnTheLeast) {
  const std::string same =
      "[[adjust.adjuster]]\nname = \"other sleeve\"\nnumber = \"tie rod.length\"\nper_turn_mm = 3\n";
  const study::Result result = run_text(pushrod_study + "[adjust]\ntoe_deg = 0.4\n" + sleeve + same);
  // The least sum of squares: turns in the ratio of their effects.
  EXPECT_NEAR(turns(result, "other sleeve"), 2 * turns(result, "sleeve"), 1e-9);
}

TEST(Adjust, TellsWhatCannotBeSet) {
  const auto said = [](const std::string& lines) {
    std::string out;
    for (const Diagnostic& d : run_text(pushrod_study + lines).diagnostics)
      out += to_string(d.message) + "\n";
    return out;
  };
  EXPECT_THAT(said("[adjust]\ntoe_deg = 0.1\ncamber_deg = -1\n" + sleeve),
              HasSubstr("the adjusters do not set toe, camber apart\n"));
  EXPECT_THAT(said("[adjust]\ntoe_deg = 2\n" + sleeve + "most_turns = 1\n"), HasSubstr("sleeve needs "));
  const auto problem = [](const std::string& lines) { return problems_of(pushrod_study + lines); };
  EXPECT_THAT(problem("[adjust]\n" + sleeve), HasSubstr("adjust.toe: nothing is wanted"));
  EXPECT_THAT(
      problem("[adjust]\ntoe_deg = 0\n[[adjust.adjuster]]\nname = \"a\"\nnumber = \"tie rod.lenght\"\n"
              "per_turn_mm = 1\n"),
      HasSubstr("adjust.adjuster[0].number: there is no number 'tie rod.lenght'; did you mean "
                "'tie rod.length'?"));
}

}  // namespace
}  // namespace linkwright::suspension
