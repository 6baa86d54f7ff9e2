// SPDX-License-Identifier: BSD-3-Clause
#include <gmock/gmock.h>

#include <string>

#include "planar/studies.h"

// The tables that a study of a linkage asks for beyond its own.
namespace linkwright::planar {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string of_sample(const std::string& sample, const std::string& lines) {
  return "schema = 1\nkind = \"analysis\"\n[mechanism]\ntype = \"planar.linkage\"\nsample = \"" + sample +
         "\"\n" + lines;
}

std::string warnings_of(const std::string& text) {
  std::string messages, out;
  const auto study = test::prepare(text, messages);
  EXPECT_TRUE(study) << messages;
  return messages;
}

TEST(LinkageQualityStudy, SaysWhatAGroupWithoutClosedFormDoesNotTell) {
  const std::string text = of_sample(
      "triad",
      "[quality]\noutput_joint = \"E0\"\n[output]\nquantities = [\"position\", \"transmission_angle\"]\n");
  const std::string messages = warnings_of(text);
  EXPECT_THAT(messages, HasSubstr("dead centres of 'E0' are left out: "));
  EXPECT_THAT(messages, HasSubstr("has no closed form, in which they are found"));
  EXPECT_THAT(messages, HasSubstr("there is no transmission angle of "));
  EXPECT_THAT(warnings_of(of_sample("hoeken",
                                    "[quality]\noutput_joint = \"B0\"\n[output]\nquantities = "
                                    "[\"position\", \"transmission_angle\"]\n")),
              IsEmpty());
}

}  // namespace
}  // namespace linkwright::planar
