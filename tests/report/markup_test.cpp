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
