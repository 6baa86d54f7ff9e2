// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/checkpoint.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>

namespace linkwright {
namespace {

TEST(PackedNumbers, EveryBitComesBack) {
  using Limits = std::numeric_limits<double>;
  const double odd_nan = std::bit_cast<double>(std::uint64_t{0xfff8000000000123});
  const std::vector<double> numbers = {0.0,
                                       -0.0,
                                       0.1,
                                       -1.0 / 3,
                                       Limits::max(),
                                       Limits::denorm_min(),
                                       Limits::infinity(),
                                       -Limits::infinity(),
                                       Limits::quiet_NaN(),
                                       odd_nan};
  const Value packed = pack_numbers(numbers);
  EXPECT_EQ(packed.as_string().substr(0, 48),
            "00000000000000008000000000000000"
            "3fb999999999999a");
  const std::vector<double> back = unpack_numbers(packed, "test");
  ASSERT_EQ(back.size(), numbers.size());
  for (std::size_t i = 0; i < back.size(); ++i)
    EXPECT_EQ(std::bit_cast<std::uint64_t>(back[i]), std::bit_cast<std::uint64_t>(numbers[i])) << i;
  EXPECT_TRUE(unpack_numbers(pack_numbers({}), "test").empty());
}

std::string problem(const Value& packed) {
  try {
    unpack_numbers(packed, "seed 7");
  } catch (const CheckpointError& error) {
    return error.what();
  }
  return "none";
}

TEST(PackedNumbers, SaysWhatIsWrong) {
  EXPECT_EQ(problem(Value(1.5)), "seed 7: expected packed numbers, found number");
  EXPECT_EQ(problem(Value("3fb99999")), "seed 7: packed numbers have 8 digits, must be 16 each");
  EXPECT_EQ(problem(Value("00000000000000003fb999999999999g")), "seed 7: packed number 1 is not hexadecimal");
  // Signs and spaces, which some number readers take.
  EXPECT_EQ(problem(Value("-000000000000001")), "seed 7: packed number 0 is not hexadecimal");
  EXPECT_EQ(problem(Value("              01")), "seed 7: packed number 0 is not hexadecimal");
}

TEST(KeptMembers, AreThereAndInRange) {
  Value table;
  table["count"] = 3;
  table["text"] = "x";
  EXPECT_EQ(load_integer(table, "count", 0, 3, "seed 7"), 3);
  const auto wrong = [&](const Value& from, std::string_view key, std::int64_t most) -> std::string {
    try {
      load_integer(from, key, 0, most, "seed 7");
    } catch (const CheckpointError& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(wrong(table, "count", 2), "seed 7: 'count' is not an integer from 0 to 2");
  EXPECT_EQ(wrong(table, "text", 2), "seed 7: 'text' is not an integer from 0 to 2");
  EXPECT_EQ(wrong(table, "number", 2), "seed 7: has no 'number'");
  EXPECT_EQ(wrong(Value(2), "number", 2), "seed 7: has no 'number'");
}

}  // namespace
}  // namespace linkwright
