// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/assembly_modes/platform_proof.h"

#include <gtest/gtest.h>

#include "parallel/platforms.h"

namespace linkwright::parallel {
namespace {

// Joints and a solution of eighths: squares through it are exact, so it solves the platform to the last bit.
struct Exact {
  PlatformLegs legs{};
  PlatformPoint point;
};
Exact exact_platform(bool real) {
  RandomStream random({4714});
  const auto eighths = [&] { return (static_cast<double>(random.below(17)) - 8) / 8; };
  const auto number = [&] {
    const double re = eighths();
    return Complex{re, real ? 0 : eighths()};
  };
  Exact out;
  for (int k = 0; k < 3; ++k)
    for (Six* const joints : {&out.legs.base[k], &out.legs.platform[k]})
      for (int i = 1; i < 6; ++i) {
        const Complex c = number();
        joints->re[i] = c.real(), joints->im[i] = c.imag();
      }
  // n = 1 and e . h = 0 without a division; the greatest number is 1 already.
  out.point = {1, 0, 0, 0, 0, number(), number(), number()};
  out.legs.square = squares_through(out.legs, out.point);
  return out;
}

TEST(PlatformProof, EnclosesAnExactSolution) {
  for (const bool real : {true, false}) {
    const Exact exact = exact_platform(real);
    const PlatformProof at = prove(exact.legs, exact.point);
    ASSERT_TRUE(at.unique);
    EXPECT_TRUE(at.finite);
    EXPECT_EQ(at.real, real);
    EXPECT_EQ(at.complex, !real);
    EXPECT_LT(at.radius, 1e-11);
    for (const double off : {1e-12, 1e-9, 1e-6}) {
      PlatformPoint near = exact.point;
      for (int k = 1; k < 8; ++k) near[k] += off;
      const PlatformProof proof = prove(exact.legs, near);
      ASSERT_TRUE(proof.unique);
      EXPECT_GE(proof.radius, off);  // the distance of the solution
      EXPECT_LT(proof.radius, 2 * off + 1e-11);
      EXPECT_FALSE(apart(near, proof, exact.point, at));
    }
  }
}

TEST(PlatformProof, ProvesNothingAwayFromSolutions) {
  const Exact exact = exact_platform(true);
  PlatformPoint off = exact.point;
  off[6] += 0.5;
  off[2] -= 0.5;
  EXPECT_FALSE(prove(exact.legs, off).unique);
  EXPECT_FALSE(prove(exact.legs, complex_point(1)).unique);
}

TEST(PlatformProof, ProvesNothingWhereThePlatformCanMove) {
  // Six equal parallel rods.
  PlatformLegs legs = placed_platform(1).legs;
  legs.platform = legs.base;
  legs.square = {};
  legs.square.re[0] = 1;
  EXPECT_FALSE(prove(legs, {1, 0, 0, 0, 0, 0, 0, 1}).unique);
}

TEST(PlatformProof, TellsSolutionsOfAGenericPlatformApart) {
  const SolvedPlatform solved = monodromy(1);
  for (const PlatformPoint& x : solved.solutions) {
    const PlatformProof proof = prove(solved.legs, x);
    EXPECT_TRUE(proof.unique && proof.finite && proof.complex && !proof.real);
  }
  const PlatformProof a = prove(solved.legs, solved.solutions[0]),
                      b = prove(solved.legs, solved.solutions[1]);
  EXPECT_TRUE(apart(solved.solutions[0], a, solved.solutions[1], b));
  EXPECT_FALSE(apart(solved.solutions[0], a, solved.solutions[0], a));
  EXPECT_FALSE(apart(solved.solutions[0], a, solved.solutions[1], {}));
}

}  // namespace
}  // namespace linkwright::parallel
