// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <cmath>

#include "flexible/beams.h"
#include "linkwright/flexible/chain.h"

namespace linkwright::flexible {
namespace {

TEST(Beam, StiffnessesAndMassesByTheory) {
  // Figures of Boskovic 2018 put together: E I = 566.7096 N m2, m = 1.615045 kg, to their last digit.
  EXPECT_NEAR(spin_up_beam().bending_stiffness(), 566.7096, 5e-5);
  EXPECT_NEAR(spin_up_beam().mass(), 1.615045, 5e-7);
  EXPECT_TRUE(std::isinf(spin_up_beam().shear_stiffness()));
  EXPECT_EQ(spin_up_beam(Theory::euler_bernoulli).rotary_inertia(), 0);
  EXPECT_EQ(spin_up_beam().rotary_inertia(), 2766.7 * 8.2189e-9);
  EXPECT_DOUBLE_EQ(stub().shear_stiffness(), 2.1e11 / 2.6 * 0.01 * 5 / 6);
}

TEST(Beam, TellsWhatIsWrong) {
  EXPECT_EQ(problem(spin_up_beam()), std::nullopt);
  EXPECT_EQ(problem(stub()), std::nullopt);
  Beam beam = spin_up_beam();
  beam.second_moment = 0;
  EXPECT_EQ(problem(beam), "second moment of area = 0 m4: it must be positive");
  beam = spin_up_beam();
  beam.elastic_modulus = -7e10;
  EXPECT_EQ(problem(beam), "modulus of elasticity = -70000000000 Pa: it must be positive");
  beam = spin_up_beam();
  beam.length = NAN;
  EXPECT_EQ(problem(beam), "length = nan m: it must be positive");
  beam = stub();
  beam.shear_coefficient = 0;
  EXPECT_EQ(problem(beam), "shear coefficient = 0: a Timoshenko beam needs a positive one");
  beam.theory = Theory::rayleigh;
  EXPECT_EQ(problem(beam), std::nullopt);
  beam.tip_mass = -0.1;
  EXPECT_EQ(problem(beam), "tip mass = -0.1 kg: it must not be negative");
  beam = stub();
  beam.gravity = INFINITY;
  EXPECT_EQ(problem(beam), "gravity = inf m/s2: it must be finite");
}

}  // namespace
}  // namespace linkwright::flexible
