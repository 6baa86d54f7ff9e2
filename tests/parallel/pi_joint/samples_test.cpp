// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/pi_joint/samples.h"

#include <gtest/gtest.h>

#include "parallel/pi_joints.h"
#include "parallel/robots.h"

namespace linkwright::parallel {
namespace {

TEST(PiSamples, PrototypeIsSoundAndAsPublished) {
  EXPECT_EQ(problem(pi_prototype()), std::nullopt);
  EXPECT_EQ(problem(pi_prototype_drive()), std::nullopt);
  const Value& given = inputs("pi-prototype-stroke");
  EXPECT_EQ(pi_prototype().arm, test::number_at(given, "a_m"));
  EXPECT_EQ(pi_prototype().ratio, test::number_at(given, "k"));
  expect_same(quantum(pi_prototype_drive()), test::number_at(inputs("pi-prototype-actuator"), "step_m"));
}

}  // namespace
}  // namespace linkwright::parallel
