// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/packed.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/study/write.h"

namespace linkwright::report {
namespace {

// The viewer reads these very bytes back (web/tests/packed.test.ts).
TEST(Packed, IsRawDeflateInBase64) {
  EXPECT_EQ(packed("linkwrightlinkwrightlinkwright"), "y8nMyy4vykzPKMnBwgIA");
  EXPECT_EQ(packed(""), "AwA=");
}

std::string hex(const std::string& bytes) {
  std::string out;
  for (const char c : bytes) {
    constexpr const char* digits = "0123456789abcdef";
    out += digits[static_cast<unsigned char>(c) >> 4];
    out += digits[static_cast<unsigned char>(c) & 15];
  }
  return out;
}

TEST(Packed, DecimalsAreWholesAndTheirDifferences) {
  NumberPack pack;
  EXPECT_EQ(pack.take(R"({"a":[0.0,0.5,1.0,1.5,2.0,2.5,3.0,3.5],"b":1})", ","), R"({"a":{"":0},"b":1})");
  EXPECT_EQ(pack.index(), "[[8,2,1]]");
  EXPECT_EQ(hex(pack.bytes()), "000a000000000000" + std::string(48, '0'));
}

TEST(Packed, MissingNumbersAndNegativeOnes) {
  NumberPack pack;
  EXPECT_EQ(pack.take("[-0.25, null, 7.0, -3.0, 7.0, -3.0, 7.0, -3.0]", ", "), R"({"":0})");
  EXPECT_EQ(pack.index(), "[[8,0,2]]");
  // -25 -> 49, the least of 32 bits -> all ones, 700 -> 1400, -300 -> 599.
  EXPECT_EQ(hex(pack.bytes()),
            "31ff785778577857"
            "00ff050205020502"
            "00ff000000000000"
            "00ff000000000000");
}

TEST(Packed, OtherNumbersAreDoubles) {
  NumberPack pack;
  EXPECT_EQ(pack.take("[0.1,0.1,0.1,0.1,0.1,0.1,0.1,1e-300]", ","), R"({"":0})");
  EXPECT_EQ(pack.index(), "[[8,1,null]]");
  EXPECT_EQ(pack.bytes().size(), 64u);
}

TEST(Packed, ListsThatAreAlikeAreKeptOnce) {
  NumberPack pack;
  const std::string list = "[1.0,2.0,3.0,4.0,5.0,6.0,7.0,8.0]";
  EXPECT_EQ(pack.take(list, ","), R"({"":0})");
  EXPECT_EQ(pack.take("[" + list + ",[1.0,2.0,3.0,4.0,5.0,6.0,7.0,9.0]," + list + "]", ","),
            R"([{"":0},{"":1},{"":0}])");
  EXPECT_EQ(pack.bytes().size(), 64u);
}

TEST(Packed, WhatWouldNotComeBackStays) {
  for (const char* text : {
           "[1.0,2.0,3.0,4.0,5.0,6.0,7.0]",                  // short
           "[1,2,3,4,5,6,7,8]",                              // integers
           "[1.0,2.0,3.0,4.0,5.0,6.0,7.0,8.00]",             // a digit more
           "[1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0]",       // another separator
           R"(["[1.0,2.0,3.0,4.0,5.0,6.0,7.0,8.0]","\"["])"  // text
       }) {
    NumberPack pack;
    EXPECT_EQ(pack.take(text, ","), text);
    EXPECT_EQ(pack.index(), "[]");
  }
}

// -0 and 0 are equal, but not the same text.
TEST(Packed, MinusZeroIsNoWholeNumber) {
  NumberPack pack;
  EXPECT_EQ(pack.take("[-0.0,0.0,0.0,0.0,0.0,0.0,0.0,0.0]", ","), R"({"":0})");
  EXPECT_EQ(pack.index(), "[[8,0,null]]");
}

}  // namespace
}  // namespace linkwright::report
