#include "linkwright/report/brief.h"

#include <gtest/gtest.h>

#include <string>

namespace linkwright::report {
namespace {

std::string head(std::string_view text) { return std::string(brief(text).head); }

TEST(Brief, ShortFactsStayWhole) {
  const Brief whole = brief("25.4 deg");
  EXPECT_EQ(whole.head, "25.4 deg");
  EXPECT_EQ(whole.rest, "");
  EXPECT_EQ(brief("").head, "");
  // Letters are counted, not bytes.
  const std::string forty = "8.6° of µµµµµ rod + lower rocker at 192°";
  ASSERT_GT(forty.size(), longest_head);
  EXPECT_EQ(brief(forty).rest, "");
}

TEST(Brief, EndsBeforePunctuation) {
  EXPECT_EQ(head("12.68 MPa at 0.4616 s, 150 mm from A; bending alone 12.66 MPa"),
            "12.68 MPa at 0.4616 s, 150 mm from A");
  EXPECT_EQ(head("within 1.5e-06 J (8.3e-09 of the peak energy 179.4 J)"), "within 1.5e-06 J");
  EXPECT_EQ(head("neutral: small departures neither grow nor die out, as without damping"), "neutral");
  EXPECT_EQ(head("0.000428 s, less than the 0.000436 s between rows: plots miss peaks"), "0.000428 s");
  EXPECT_EQ(head("crank (driver) → rod + lower rocker (RRR, minus) → leg + upper rocker (RRR, plus)"),
            "crank (driver) → rod + lower rocker");
}

TEST(Brief, ClosesItsBrackets) {
  EXPECT_EQ(head("19.5 % of the limit (drive 1, step 1 (pick_and_place) at 0.095428 s)"),
            "19.5 % of the limit");
}

TEST(Brief, KeepsCoordinatesTogether) {
  EXPECT_EQ(head("503.08 x 228.32 mm, at 0, 322.53 mm, proven free of singularities"),
            "503.08 x 228.32 mm, at 0, 322.53 mm");
  EXPECT_EQ(head("34.4° of outer + link at 56.3408°, -34.3775°"), "34.4° of outer + link");
}

TEST(Brief, EndsBeforeAPlaceWhereThereIsNoPunctuation) {
  EXPECT_EQ(head("assembles from -101.5 to -36.9 deg and from 36.9 to 101.5 deg"),
            "assembles from -101.5 to -36.9 deg");
  EXPECT_EQ(head("pin A separated from its bush at 0.153847 s, O2 at 88.15 deg"),
            "pin A separated from its bush");
}

TEST(Brief, EndsAtAWordAnyway) {
  EXPECT_EQ(head("none that was tried came anywhere near what was wanted"),
            "none that was tried came anywhere near");
  const std::string word(60, 'a');
  EXPECT_EQ(brief(word).head, word);
}

TEST(Brief, BothPartsAreTheText) {
  const std::string text = "kept: minimum tension 2.008 N, at a crank angle of 55.0°";
  const Brief parts = brief(text);
  EXPECT_EQ(parts.head, "kept: minimum tension 2.008 N");
  EXPECT_EQ(std::string(parts.head) + std::string(parts.rest), text);
}

}  // namespace
}  // namespace linkwright::report
