// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/interruption.h"

#include <gtest/gtest.h>

#include <chrono>

namespace linkwright {
namespace {

TEST(Interruption, GoesOnUntilTheRunIsToStop) {
  EXPECT_NO_THROW(throw_if_interrupted(nullptr));
  RunContext context;
  EXPECT_NO_THROW(throw_if_interrupted(context));
  context.cancel();
  try {
    throw_if_interrupted(context);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Interrupted& i) {
    EXPECT_EQ(i.status(), Status::cancelled);
    EXPECT_STREQ(i.what(), "the run was interrupted");
  }
  RunContext late;
  late.set_time_limit(std::chrono::seconds(0));
  try {
    throw_if_interrupted(&late);
    ADD_FAILURE() << "nothing was thrown";
  } catch (const Interrupted& i) {
    EXPECT_EQ(i.status(), Status::deadline);
  }
}

}  // namespace
}  // namespace linkwright
