// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/exact/detail/certificate.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "linkwright/planar/exact/detail/nine_point_starts.h"
#include "linkwright/planar/exact/detail/wide_number.h"
#include "planar/exact_cases.h"

namespace linkwright::planar {
namespace {

using Fine = ComplexFourBar<math::DoubleDouble>;

const StartSet<NinePoints>& known_classes() {
  RunContext context;
  static const auto starts = nine_point_starts(test::starts_folder(), context);
  return *starts;
}

double distance_of(const math::Complex<math::DoubleDouble>& a, const ComplexNumber& b) {
  const auto off = a - math::Complex<math::DoubleDouble>(b);
  return std::sqrt(static_cast<double>(math::norm(off)));
}

// A point beside a root by a thousandth is refused, or the ball holds the root that twice the digits give;
// the same nearer by.
TEST(Certificate, HoldsTheRootOrIsRefused) {
  const ExactNinePoints p = widened(known_classes().base);
  RandomStream random({.seed = 13});
  int certified = 0;
  for (int trial = 0; trial < 10'000; ++trial) {
    const auto& root = known_classes().points[static_cast<std::size_t>(trial) % 1442];
    const double beside = trial % 4 == 0 ? 1e-9 : trial % 4 == 1 ? 1e-6 : 1e-3;
    ComplexFourBar<> z = root;
    for (auto& value : z) value = value + beside * std::sqrt(squared_size(root)) * random_complex(random);
    const auto ball = certify(p, z);
    if (!ball) continue;
    ++certified;
    Fine exact = widened(root);
    polish(NinePoints(), p, exact, 1e-26);
    for (std::size_t i = 0; i < z.size(); ++i) EXPECT_LE(distance_of(exact[i], z[i]), ball->radius[i]);
  }
  EXPECT_GT(certified, 2000);  // points beside it by a billionth, nearly all
  EXPECT_LT(certified, 7500);
}

TEST(Certificate, IsGivenToGoodSolutionsAndNarrow) {
  const ExactNinePoints p = widened(known_classes().base);
  int certified = 0;
  for (std::size_t i = 0; i < 200; ++i) {
    const auto& z = known_classes().points[i];
    const auto ball = certify(p, z);
    certified += ball.has_value();
    Fine fine = widened(z);
    polish(NinePoints(), p, fine, 1e-26);
    const auto narrow = certify(p, fine);
    ASSERT_TRUE(narrow);
    for (const double radius : narrow->radius) EXPECT_LT(radius, 1e-18 * (1 + std::sqrt(squared_size(z))));
    const CertifiedIdentity identity = certified_identity(fine, *narrow);
    EXPECT_LE(std::sqrt(math::norm(identity.identity - NinePoints::identity(z))),
              identity.radius + 1e-9 * (1 + std::sqrt(math::norm(identity.identity))));
  }
  EXPECT_GT(certified, 190);
}

TEST(Certificate, FourfoldDigitsNarrowItFurther) {
  const ExactNinePoints p = widened(known_classes().base);
  std::array<math::Complex<WideNumber>, NinePoints::data> data;
  for (std::size_t i = 0; i < data.size(); ++i) data[i] = math::Complex<WideNumber>(known_classes().base[i]);
  for (std::size_t i = 0; i < 5; ++i) {
    const auto& z = known_classes().points[i];
    Fine fine = widened(z);
    polish(NinePoints(), p, fine, 1e-26);
    ComplexFourBar<WideNumber> wide;
    for (std::size_t k = 0; k < z.size(); ++k) wide[k] = math::Complex<WideNumber>(z[k]);
    EXPECT_LT(polish(NinePoints(), data, wide, 1e-50), 1e-50);
    const auto ball = certify(p, wide), wider = certify(p, fine);
    ASSERT_TRUE(ball && wider);
    for (std::size_t k = 0; k < z.size(); ++k) {
      EXPECT_LT(ball->radius[k], 1e-45 * std::sqrt(squared_size(z)));
      // The root is in both, so their middles are no further from each other than the sum of the radii.
      EXPECT_LE(std::abs(static_cast<double>(wide[k].re - WideNumber(fine[k].re))),
                ball->radius[k] + wider->radius[k]);
    }
    const CertifiedIdentity identity = certified_identity(wide, *ball);
    EXPECT_LT(identity.radius, 1e-14 * (1 + std::sqrt(math::norm(identity.identity))));
  }
}

TEST(Certificate, IsNotGivenWhereSolutionsMeet) {
  // Pins in one place: each equation has a double root there.
  ComplexFourBar<> z = known_classes().points[0];
  z[pin_y] = z[pin_x], z[pin_Y] = z[pin_X], z[pivot_b] = z[pivot_a], z[pivot_B] = z[pivot_A];
  const ExactNinePoints p = widened(known_classes().base);
  EXPECT_FALSE(certify(p, z));
  EXPECT_FALSE(prove_class(p, widened(z), false, false));
}

}  // namespace
}  // namespace linkwright::planar
