// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/looks.h"

#include <gtest/gtest.h>

#include "linkwright/core/check.h"
#include "linkwright/core/interruption.h"

namespace linkwright {
namespace {

TEST(Looks, ThoseThatAreNotAllowedCancel) {
  const RunContext context;
  {
    const LooksAllowed looks(2);
    EXPECT_EQ(context.interruption(), Status::done);
    EXPECT_FALSE(context.interrupted());
    EXPECT_EQ(looks.made(), 2);
    EXPECT_EQ(context.interruption(), Status::cancelled);
    EXPECT_THROW(throw_if_interrupted(context), Interrupted);
    EXPECT_EQ(looks.made(), 4);
    EXPECT_THROW(LooksAllowed(1), ContractError);
  }
  EXPECT_EQ(context.interruption(), Status::done);
  EXPECT_THROW(LooksAllowed(-1), ContractError);
}

TEST(Looks, ARunThatIsToStopAnywaySaysWhy) {
  RunContext late;
  late.set_time_limit(std::chrono::seconds(0));
  const LooksAllowed looks(1);
  EXPECT_EQ(late.interruption(), Status::deadline);
}

}  // namespace
}  // namespace linkwright
