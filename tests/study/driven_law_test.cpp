// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/study/driven_law.h"

#include <gmock/gmock.h>

#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/study.h"
#include "support/message.h"

namespace linkwright::study {
namespace {

using ::testing::HasSubstr;

// Tables that hold the motion of one joint.
struct RotaryEntry {
  RotaryLaw law;
};
template <class Visitor>
void fields(Visitor&& visit, RotaryEntry& e) {
  visit(field::entry("law", "motion").required(), e.law);
}
struct LinearEntry {
  LinearLaw law;
};
template <class Visitor>
void fields(Visitor&& visit, LinearEntry& e) {
  visit(field::entry("law", "motion").required(), e.law);
}

template <class Entry>
Entry read(const std::string& text, std::string& messages) {
  Diagnostics diagnostics;
  const Value document = read_text(text, Syntax::toml, "f", diagnostics);
  DocumentReader reader(document, "f", diagnostics);
  Entry entry;
  reader.root().read(entry);
  reader.finish();
  messages += test::lines_of(diagnostics);
  return entry;
}

TEST(DrivenLaw, IsReadWithTheUnitsOfItsJoint) {
  std::string messages;
  const auto turn =
      read<RotaryEntry>("law = \"cycloidal\"\nfrom_deg = 90\nto_rad = 0\nduration_ms = 500\n", messages);
  const auto slide = read<LinearEntry>(
      "law = \"cycloidal\"\nfrom_mm = 90\nto_m = 0\nstart_s = 1\nduration_s = 0.5\n", messages);
  EXPECT_EQ(messages, "");
  const auto a = std::get<math::CycloidalMotion>(motion_law(turn.law));
  EXPECT_EQ(a.from, pi / 2);
  EXPECT_EQ(a.duration, 0.5);
  EXPECT_EQ(std::get<math::CycloidalMotion>(motion_law(slide.law)).from, 0.09);
  const auto even = read<RotaryEntry>("law = \"constant_speed\"\nspeed_rpm = 30\n", messages);
  EXPECT_DOUBLE_EQ(math::MotionCurve(motion_law(even.law))(1).value, pi);
  const auto table = read<LinearEntry>(
      "law = \"table\"\ntimes_s = [0, 1, 2]\nvalues_mm = [0, 5, 0]\nends = \"periodic\"\n", messages);
  EXPECT_NEAR(math::MotionCurve(motion_law(table.law))(3).value, 0.005, 1e-17);
  const auto polynomial = read<RotaryEntry>(
      "law = \"polynomial\"\nfrom_deg = 0\nto_deg = 180\nduration_s = 1\nend_speed_rpm = 30\n"
      "start_jerk_deg_per_s3 = 180\n",
      messages);
  EXPECT_EQ(messages, "");
  EXPECT_EQ(std::get<math::EndConditions>(motion_law(polynomial.law)).start_jerk, pi);
  // A written law reads back to the same.
  const Value written = write_fields(polynomial);
  EXPECT_DOUBLE_EQ(written.find("end_speed_rad_per_s")->as_number(), pi);
  EXPECT_EQ(written.find("start_acceleration_rad_per_s2"), nullptr);
  EXPECT_EQ(schema_fields<LinearEntry>().find("anyOf") != nullptr ||
                schema_fields<LinearEntry>().find("oneOf") != nullptr,
            true);
}

TEST(DrivenLaw, MessagesOfBadInput) {
  const auto message = [](const std::string& text) {
    std::string messages;
    read<RotaryEntry>(text, messages);
    return messages;
  };
  EXPECT_THAT(message("law = \"cyclodial\"\n"),
              HasSubstr("is 'cyclodial', must be one of: constant_speed, cycloidal, polynomial_345, "
                        "polynomial, table, harmonic; did you mean 'cycloidal'?"));
  EXPECT_THAT(message("law = \"constant_speed\"\nspeed_m_per_s = 2\n"),
              HasSubstr("is an angular speed, but 'm_per_s' is not a unit of it"));
  EXPECT_THAT(message("law = \"cycloidal\"\nfrom_deg = 0\nto_deg = 1\nduration_s = 0\n"),
              HasSubstr("duration_s: is 0 s, must be at least 1e-09 s"));
  EXPECT_THAT(message("law = \"harmonic\"\namplitude_deg = 3\nfrequency_Hz = -1\n"),
              HasSubstr("frequency_Hz: is -1 Hz, must be at least 0 Hz"));
}

}  // namespace
}  // namespace linkwright::study
