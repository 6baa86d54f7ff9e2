// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/status.h"

#include <gtest/gtest.h>

namespace linkwright {
namespace {

TEST(Status, HasItsNameInFiles) {
  EXPECT_EQ(to_string(Status::done), "done");
  EXPECT_EQ(to_string(Status::no_assembly), "no_assembly");
  EXPECT_EQ(to_string(Status::cancelled), "cancelled");
  EXPECT_EQ(to_string(Status::at_rest), "at_rest");
  EXPECT_EQ(to_string(Status::self_locking), "self_locking");
}

}  // namespace
}  // namespace linkwright
