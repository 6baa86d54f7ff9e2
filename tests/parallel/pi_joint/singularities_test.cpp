// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/pi_joint/singularities.h"

#include <gtest/gtest.h>

#include <cmath>

#include "linkwright/core/numbers.h"
#include "linkwright/parallel/pi_joint/samples.h"

namespace linkwright::parallel {
namespace {

TEST(PiSingularities, EndsOfTheRangeByName) {
  for (double ratio : {0.4, 0.999, 1.5}) {
    const auto [folded, stretched] = singular_positions({.arm = 1, .ratio = ratio});
    EXPECT_EQ(folded.kind, PiSingularity::type_2);
    EXPECT_EQ(stretched.kind, PiSingularity::type_2);
    EXPECT_DOUBLE_EQ(folded.angle, -pi / 2);
    EXPECT_DOUBLE_EQ(folded.diagonal, std::abs(1 - ratio));
    EXPECT_DOUBLE_EQ(stretched.diagonal, 1 + ratio);
  }
  const auto [folded, stretched] = singular_positions({.arm = 1, .ratio = 1});
  EXPECT_EQ(folded.kind, PiSingularity::type_3);
  EXPECT_EQ(folded.diagonal, 0);
  EXPECT_EQ(stretched.kind, PiSingularity::type_2);
  EXPECT_EQ(name_of(folded.kind), "type_3");
}

TEST(PiSingularities, NoneBetween) {
  for (double ratio : {0.4, 1.0, 1.5})
    for (double at = -1.57; at <= 1.57; at += 0.01)
      EXPECT_EQ(singularity({.arm = 0.2, .ratio = ratio}, at), PiSingularity::none) << ratio << ' ' << at;
}

TEST(PiSingularities, SineOfTheTransmissionAngleMeasuresTheDistance) {
  const PiJoint joint = pi_prototype();
  for (double at = -1.5; at <= 1.5; at += 0.1)
    EXPECT_NEAR(transmission_sine(joint, at), std::sin(angles(joint, at).transmission), 1e-15);
  EXPECT_EQ(transmission_sine(joint, -pi / 2), 0);
  // Never more than k, which is reached at sin(theta) = -k.
  EXPECT_DOUBLE_EQ(transmission_sine(joint, -std::asin(0.4)), 0.4);
  EXPECT_EQ(transmission_sine({.arm = 0.2, .ratio = 1}, -pi / 2), 1);
}

}  // namespace
}  // namespace linkwright::parallel
