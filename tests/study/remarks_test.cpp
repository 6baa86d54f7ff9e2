#include "linkwright/study/remarks.h"

#include <gtest/gtest.h>

namespace linkwright::study {
namespace {

TEST(Remarks, GoToTheResult) {
  Result result;
  const AddFact fact{result.facts};
  const AddWarning warn{result.diagnostics};
  fact("circuits", "2");
  fact("energy balance", "1e-3", Fact::Verdict::bad);
  warn("the linkage is near a dead point");
  warn("drive", "is weak", "take a stronger one");
  ASSERT_EQ(result.facts.size(), 2u);
  EXPECT_EQ(result.facts[0].label, "circuits");
  EXPECT_EQ(result.facts[0].verdict, Fact::Verdict::plain);
  EXPECT_EQ(result.facts[1].verdict, Fact::Verdict::bad);
  ASSERT_EQ(result.diagnostics.size(), 2u);
  EXPECT_EQ(to_string(result.diagnostics[0]), "warning: the linkage is near a dead point");
  EXPECT_EQ(result.diagnostics[1].severity, Diagnostic::Severity::warning);
  EXPECT_EQ(result.diagnostics[1].key, "drive");
  EXPECT_EQ(result.diagnostics[1].hint, "take a stronger one");
}

TEST(Remarks, LengthsHaveTheUnitOfTheirSize) {
  EXPECT_EQ(metres(1.25), "1.25 m");
  EXPECT_EQ(metres(0.0125), "12.5 mm");
  EXPECT_EQ(metres(3.14e-6), "3.14 µm");
}

}  // namespace
}  // namespace linkwright::study
