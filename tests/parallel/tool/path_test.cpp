// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/tool/path.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/study.h"
#include "support/message.h"

namespace linkwright::parallel {
namespace {

using ::testing::HasSubstr;

template <class T>
T read(const std::string& text, std::string& messages) {
  Diagnostics diagnostics;
  const Value document = study::read_text(text, study::Syntax::toml, "f", diagnostics);
  study::DocumentReader reader(document, "f", diagnostics);
  T out;
  reader.root().read(out);
  reader.finish();
  messages += test::lines_of(diagnostics);
  return out;
}

constexpr const char* every_step = R"(
law = "cycloidal"
blend = true
corner_mm = 5

[[step]]
type = "line"
to_mm = [100, 0, -500]
rotation_deg = [0, 0, 90]
speed_mm_per_s = 250

[[step]]
type = "arc"
through_mm = [50, 50, -500]
to_m = [0, 0, -0.5]

[[step]]
type = "circle"
centre_mm = [0, 10, 0]
axis = [0, 0, 2]
angle_deg = -360

[[step]]
type = "pick_and_place"
to_mm = [305, 0, -500]
height_mm = 25
corner = 0.8
back = true
dwell_ms = 20
back_dwell_ms = 30

[[step]]
type = "dwell"
duration_s = 0.1

[[step]]
type = "table"
times_ms = [0, 100]
points_mm = [[0, 0, -500], [10, 0, -500]]
rotations_deg = [[0, 0, 90], [0, 0, 180]]
)";

TEST(ToolPath, IsReadWithUnitsAndWrittenBackTheSame) {
  std::string messages;
  const auto path = read<ToolPath>(every_step, messages);
  EXPECT_EQ(messages, "");
  EXPECT_EQ(path.law, TimeLaw::cycloidal);
  EXPECT_TRUE(path.blend);
  EXPECT_EQ(path.corner, 0.005);
  ASSERT_EQ(path.steps.size(), 6);
  const auto& line = std::get<ToolLine>(path.steps[0].form);
  EXPECT_EQ(line.to, (Coordinates{0.1, 0, -0.5}));
  EXPECT_EQ(line.rotation, (Coordinates{0, 0, pi / 2}));
  EXPECT_EQ(line.speed, 0.25);
  const auto& arc = std::get<ToolArc>(path.steps[1].form);
  EXPECT_EQ(arc.through, (Coordinates{0.05, 0.05, -0.5}));
  EXPECT_FALSE(arc.rotation || arc.speed);
  const auto& circle = std::get<ToolCircle>(path.steps[2].form);
  EXPECT_EQ(circle.angle, -2 * pi);
  EXPECT_EQ(circle.axis, (Coordinates{0, 0, 2}));
  const auto& gate = std::get<PickAndPlace>(path.steps[3].form);
  EXPECT_EQ(gate.height, 0.025);
  EXPECT_EQ(gate.corner, 0.8);
  EXPECT_EQ(gate.up, (Coordinates{0, 0, 1}));
  EXPECT_TRUE(gate.back);
  EXPECT_EQ(gate.dwell, 0.02);
  EXPECT_EQ(gate.back_dwell, 0.03);
  EXPECT_EQ(std::get<ToolDwell>(path.steps[4].form).duration, 0.1);
  const auto& table = std::get<ToolTable>(path.steps[5].form);
  EXPECT_EQ(table.times, (std::vector<double>{0, 0.1}));
  EXPECT_EQ(table.points[1], (Coordinates{0.01, 0, -0.5}));
  EXPECT_EQ(table.rotations[1], (Coordinates{0, 0, pi}));

  const Value written = study::write_fields(path);
  const Value* steps = written.find("step");
  ASSERT_NE(steps, nullptr);
  EXPECT_EQ(steps->as_array()[3].find("type")->as_string(), "pick_and_place");
  EXPECT_EQ(steps->as_array()[3].find("dwell_s")->as_number(), 0.02);
  EXPECT_EQ(steps->as_array()[1].find("speed_m_per_s"), nullptr);
  EXPECT_EQ(study::schema_fields<ToolPath>().find("properties") != nullptr, true);

  const auto limits = read<ToolLimits>(
      "speed_mm_per_s = 4000\nacceleration_m_per_s2 = 100\nangular_speed_rpm = 30\n", messages);
  EXPECT_EQ(messages, "");
  EXPECT_EQ(limits.speed, 4);
  EXPECT_EQ(limits.acceleration, 100);
  EXPECT_DOUBLE_EQ(limits.angular_speed, pi);
}

TEST(ToolPath, FilesAreToldWhatIsWrong) {
  const auto message = [](const std::string& text) {
    std::string messages;
    read<ToolPath>(text, messages);
    return messages;
  };
  EXPECT_THAT(message("law = \"s_curve\"\nstep = []\n"),
              HasSubstr("law: is 's_curve', must be one of: double_s, polynomial_345, cycloidal"));
  EXPECT_THAT(message("blend = true\n"), HasSubstr("step: this key is missing"));
  EXPECT_THAT(
      message("[[step]]\ntype = \"lien\"\nto_m = [0, 0, 0]\n"),
      HasSubstr("is 'lien', must be one of: line, arc, circle, pick_and_place, dwell, table; did you mean "
                "'line'?"));
  EXPECT_THAT(message("[[step]]\ntype = \"line\"\nto_deg = [0, 0, 0]\n"),
              HasSubstr("is a length, but 'deg' is not a unit of it"));
  EXPECT_THAT(
      message("[[step]]\ntype = \"pick_and_place\"\nto_m = [0, 0, 0]\nheight_mm = 25\ncorner = 1.5\n"),
      HasSubstr("step[0].corner: is 1.5, must be at most 1"));
  EXPECT_THAT(message("[[step]]\ntype = \"dwell\"\nduration_s = -1\n"),
              HasSubstr("step[0].duration_s: is -1 s, must be at least 0 s"));
}

TEST(ToolPath, StepsAreNamedByNumberAndKind) {
  std::string messages;
  const auto path = read<ToolPath>(every_step, messages);
  EXPECT_EQ(step_name(path, 0), "step 1 (line)");
  EXPECT_EQ(step_name(path, 3), "step 4 (pick_and_place)");
}

TEST(ToolPath, LimitsMustBePositive) {
  EXPECT_FALSE(problem(ToolLimits{}));
  const auto message = [](ToolLimits limits) { return problem(limits)->message; };
  EXPECT_EQ(message({.speed = 0}), "the limit speed is 0 m/s, must be more than 0 and finite");
  EXPECT_EQ(message({.acceleration = -1}),
            "the limit acceleration is -1 m/s2, must be more than 0 and finite");
  EXPECT_EQ(message({.jerk = INFINITY}), "the limit jerk is inf m/s3, must be more than 0 and finite");
  EXPECT_EQ(message({.angular_speed = NAN}),
            "the limit angular_speed is nan rad/s, must be more than 0 and finite");
  EXPECT_EQ(message({.angular_acceleration = 0}),
            "the limit angular_acceleration is 0 rad/s2, must be more than 0 and finite");
  EXPECT_EQ(message({.angular_jerk = 0}),
            "the limit angular_jerk is 0 rad/s3, must be more than 0 and finite");
  EXPECT_EQ(problem(ToolLimits{.jerk = 0})->key, "jerk");
}

}  // namespace
}  // namespace linkwright::parallel
