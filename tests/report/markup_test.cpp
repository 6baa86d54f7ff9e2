// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/markup.h"

#include <gtest/gtest.h>

#include "linkwright/core/numbers.h"

namespace linkwright::report {
namespace {

TEST(Markup, EscapeLeavesNoMarkup) {
  EXPECT_EQ(escape("<b a=\"x\" c='y'>&amp;</b>"),
            "&lt;b a=&quot;x&quot; c=&#39;y&#39;&gt;&amp;amp;&lt;/b&gt;");
  EXPECT_EQ(escape("tab\tline\n\x01"), "tab\tline\n\xEF\xBF\xBD");
}

TEST(Markup, BytesOutsideUtf8AreReplacedOneByOne) {
  EXPECT_EQ(valid_utf8("Bošković ∞ 😀"), "Bošković ∞ 😀");
  EXPECT_EQ(valid_utf8("a\xFFz"), "a\xEF\xBF\xBDz");
  EXPECT_EQ(valid_utf8("\xC3"), "\xEF\xBF\xBD");                                  // cut off
  EXPECT_EQ(valid_utf8("\xC0\xAF"), "\xEF\xBF\xBD\xEF\xBF\xBD");                  // overlong slash
  EXPECT_EQ(valid_utf8("\xED\xA0\x80"), "\xEF\xBF\xBD\xEF\xBF\xBD\xEF\xBF\xBD");  // surrogate
}

TEST(Markup, NumbersForPeople) {
  EXPECT_EQ(number(0.1 + 0.2), "0.3");
  EXPECT_EQ(number(-0.0), "0");
  EXPECT_EQ(number(nan), "–");
  EXPECT_EQ(number(-infinity), "−∞");
}

TEST(Markup, LongFactsBeginWithTheirValue) {
  const FactText brief =
      fact_text(say("{} at {}", newton_metres(5.567), at_place("crank_angle", degrees_of(1))));
  EXPECT_EQ(brief.value, "5.567\u202fN\u202fm at 57.3°");
  EXPECT_EQ(brief.rest, "");
  EXPECT_FALSE(brief.is_long);
  const FactText area = fact_text(
      say("{} x {}, proven free of singularities", millimetres(0.5).sharing_unit(), millimetres(0.2)));
  EXPECT_EQ(area.value, "500 x 200\u202fmm");
  EXPECT_EQ(area.rest, ", proven free of singularities");
  EXPECT_TRUE(area.is_long);
  const FactText order = fact_text("crank (driver) → coupler + rocker (RRR, plus)");
  EXPECT_EQ(order.value, "crank (driver) → coupler + rocker (RRR, plus)");
  EXPECT_TRUE(order.is_long);
}

TEST(Markup, ValuesForPeople) {
  Value value;
  value["type"] = "crank-rocker";
  value["full"] = true;
  value["angles"] = Value(std::vector<double>{1.5, 2});
  EXPECT_EQ(display(value), "type: crank-rocker, full: yes, angles: 1.5, 2");
  EXPECT_EQ(display(Value()), "–");
}

}  // namespace
}  // namespace linkwright::report
