// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/beam_form.h"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <type_traits>

namespace linkwright::flexible {
namespace {

TEST(BeamForm, HoldsEveryNumberOfABeamOnce) {
  Beam beam;
  std::set<std::string> keys;
  std::set<const void*> members;
  const auto visit = [&](const Field& field, auto& member) {
    EXPECT_TRUE(keys.insert(std::string(field.key)).second) << field.key;
    EXPECT_TRUE(members.insert(&member).second) << field.key;
    // Nothing can be negative; what a link cannot be without must be given.
    if constexpr (std::is_same_v<std::decay_t<decltype(member)>, double>) {
      EXPECT_GE(field.minimum, 0) << field.key;
      EXPECT_EQ(field.is_required, field.minimum > 0) << field.key;
    }
  };
  beam_fields::link(visit, beam);
  beam_fields::tip(visit, beam);
  beam_fields::hub(visit, beam);
  EXPECT_EQ(keys.size(), 18u);
  EXPECT_TRUE(beam_fields::fibre_distance.exclusive_minimum);
  EXPECT_FALSE(beam_fields::fibre_distance.is_required);
}

}  // namespace
}  // namespace linkwright::flexible
