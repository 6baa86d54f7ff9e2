// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/masses.h"

#include <gmock/gmock.h>

#include "parallel/studies.h"

namespace linkwright::parallel {
namespace {

using test::problems_of;
using ::testing::HasSubstr;

const std::string head =
    "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"parallel.delta\"\nbase_radius_mm = "
    "200\nplatform_radius_mm = 45\n"
    "arm_mm = 350\nrod_mm = 800\n";
const std::string pose = "[[pose]]\nposition_mm = [0, 0, -800]\n";

TEST(MassesStudy, TellsWhatIsWrong) {
  EXPECT_THAT(problems_of(head + pose + "[masses]\nplatform_mass_kg = 1\n"),
              HasSubstr("masses.rod_mass_kg: this key is missing"));
  EXPECT_THAT(problems_of(head + pose + "[masses]\nplatform_mass_kg = -1\nrod_mass_kg = 1\n"),
              HasSubstr("at least 0 kg"));
  EXPECT_THAT(
      problems_of(head + pose +
                  "[masses]\nplatform_mass_kg = 1\nrod_mass_kg = 1\n[masses.pi_joint]\narm_mass_kg = 1\n"),
      HasSubstr("masses: leg 1: masses of a Pi-joint, but a motor drives it"));
  EXPECT_THAT(problems_of(head + "[mechanism.drive]\ntype = \"pi_joint\"\n" + pose +
                          "[masses]\nplatform_mass_kg = 1\nrod_mass_kg = 1\narm_mass_kg = "
                          "1\n[masses.pi_joint]\narm_mass_kg = 1\n"),
              HasSubstr("keep [masses.pi_joint], or the arm's masses"));
}

}  // namespace
}  // namespace linkwright::parallel
