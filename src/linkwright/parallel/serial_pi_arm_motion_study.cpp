#include "linkwright/parallel/serial_pi_arm_motion_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "linkwright/math/angles.h"
#include "linkwright/parallel/drive_use_study.h"
#include "linkwright/parallel/serial_pi_arm_scene.h"

namespace linkwright::parallel {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
/// A scene is for looking at: so many samples at most.
constexpr std::size_t most_scene_samples = 1200;

Vector2 plane(const Vec3& v) { return {v.x, v.y}; }

/// One instant of the motion.
struct Instant {
  double time = 0;
  ToolState tool;
  SerialAngles angles;
  SerialRates rates;
  SerialDrives drives;
  SerialQuality quality;
  SerialLoads loads;
  bool reached() const { return angles.status == Status::done; }
};

Instant instant(const SerialAnalysis& s, double time) {
  const SerialPiArm& arm = s.description.arm;
  const MotionForm& form = s.motion->form;
  Instant out;
  out.time = time;
  out.tool = s.motion->motion(time);
  out.angles = inverse(arm, plane(out.tool.position), s.description.mode);
  if (!out.reached()) return out;
  out.rates = arm_rates(arm, out.angles.angle, plane(out.tool.velocity), plane(out.tool.acceleration));
  out.drives = drives_at(arm, out.angles.angle);
  out.quality = quality(arm, out.angles.angle);
  out.loads = inverse_dynamics(arm, s.masses.value_or(SerialArmMasses{}), out.angles.angle, out.rates.speed,
                               out.rates.acceleration, {form.force[0], form.force[1]});
  return out;
}

void look(PathJudge& judge, const SerialAnalysis& s, const Instant& at) {
  const SerialDescription& d = s.description;
  const SerialLimits& limits = s.limits;
  const auto fail = [&](const char* kind, Status status, const std::string& why) {
    judge.fail(kind, at.time, status, why);
  };
  if (!at.reached()) {
    fail("reach", at.angles.status, reason(at.angles));
    return;
  }
  if (at.rates.status != Status::done)
    fail("singular", Status::singular, "the arms are in line: the tool cannot move along them");
  for (int i = 0; i < 2; ++i) judge.travel(at.time, i, d.arm.drive[i], at.drives.drive[i]);
  const double lci = 1 / at.quality.condition, elbow = elbow_angle(at.angles.angle);
  if (lci < limits.conditioning)
    fail("conditioning", Status::limit_reached,
         fmt::format("local conditioning index {:.3f}, at least {:.3f} is asked for", lci,
                     limits.conditioning));
  if ((limits.least_elbow && elbow < *limits.least_elbow) ||
      (limits.largest_elbow && elbow > *limits.largest_elbow))
    fail("elbow", Status::limit_reached,
         fmt::format("the arms stand at {:.2f} deg, beyond the limits", math::degrees(elbow)));
  for (int i = 0; i < 2; ++i) judge.transmission(at.time, i, at.drives.drive[i], limits.drive_transmission);
  for (int i = 0; i < 2 && d.motors_known; ++i)
    judge.limits(at.time, i, d.arm.drive[i], d.motors[i], at.loads.drive_speed[i], at.loads.drive_effort[i]);
}

/// All instants as a table, out of reach NaN.
Table motion_table(const SerialDescription& d, const std::vector<Instant>& instants, bool forces) {
  Table table{.name = "motion"};
  const auto add = [&](const char* key, const char* label, bool always, auto&& value) {
    std::vector<double> values;
    for (const Instant& i : instants) values.push_back(always || i.reached() ? value(i) : nan);
    table.add(key, label, std::move(values));
  };
  add("time_s", "time (s)", true, [](const Instant& i) { return i.time; });
  add("x_m", "x (m)", true, [](const Instant& i) { return i.tool.position.x; });
  add("y_m", "y (m)", true, [](const Instant& i) { return i.tool.position.y; });
  add("tool_speed_m_per_s", "speed of the tool (m/s)", true,
      [](const Instant& i) { return norm(i.tool.velocity); });
  add("tool_acceleration_m_per_s2", "acceleration of the tool (m/s2)", true,
      [](const Instant& i) { return norm(i.tool.acceleration); });
  std::vector<std::vector<DriveMotion>> drives;
  for (const Instant& i : instants) {
    drives.emplace_back();
    for (std::size_t k = 0; k < 2 && i.reached(); ++k)
      drives.back().push_back({i.angles.angle[k], i.rates.speed[k], i.drives.drive[k], i.loads.drive_speed[k],
                               i.loads.arm_torque[k], i.loads.drive_effort[k], i.loads.drive_power[k]});
  }
  add_drive_columns(table, d.arm.drive, d.motors, drives, d.motors_known, forces);
  add("local_conditioning", "local conditioning index", false,
      [](const Instant& i) { return 1 / i.quality.condition; });
  add("elbow_rad", "angle between the arms (rad)", false,
      [](const Instant& i) { return elbow_angle(i.angles.angle); });
  if (std::any_of(instants.begin(), instants.end(), [](const Instant& i) { return !i.reached(); }))
    for (const Instant& i : instants) table.status.emplace_back(to_string(i.angles.status));
  return table;
}

}  // namespace

void add_serial_motion(study::Result& result, const SerialAnalysis& s, RunContext& context) {
  const MotionStudy& study = *s.motion;
  const SerialDescription& d = s.description;
  const auto samples = study.motion.samples(study.form.interval);
  PathJudge judge(study.motion);
  std::vector<Instant> instants;
  instants.reserve(samples.size());
  for (const auto& sample : samples) {
    if (instants.size() % 256 == 0 && context.interruption() != Status::done) break;
    instants.push_back(instant(s, sample.time));
    look(judge, s, instants.back());
  }
  if (instants.size() < samples.size()) result.status = context.interruption();
  if (instants.empty()) {
    result.headline = "Interrupted before the first instant.";
    return;
  }
  const bool forces = s.masses.has_value() || study.form.force[0] != 0 || study.form.force[1] != 0;
  const Table table = motion_table(d, instants, forces);
  result.tables.push_back(table);
  if (!judge.uses().empty()) result.tables.push_back(uses_table(judge.uses()));
  result.plots.push_back(motion_plot("tool-speed", "Speed of the tool", {"tool_speed_m_per_s"}));
  result.plots.push_back(
      motion_plot("tool-acceleration", "Acceleration of the tool", {"tool_acceleration_m_per_s2"}));
  add_drive_plots(result, table, d.arm.drive);
  result.plots.push_back(motion_plot("conditioning", "Conditioning", {"local_conditioning"}));

  const auto fact = [&](std::string label, std::string text) {
    result.facts.push_back({std::move(label), std::move(text)});
  };
  fact("duration of the path", fmt::format("{:.4g} s", study.motion.duration()));
  const Instant* worst = nullptr;
  for (const Instant& i : instants)
    if (i.reached() && (!worst || i.quality.condition > worst->quality.condition)) worst = &i;
  if (worst)
    fact("least local conditioning index",
         fmt::format("{:.3f} ({})", 1 / worst->quality.condition, study.motion.where(worst->time)));
  add_verdict(result, judge, study.motion, instants.back().time, instants.size() == samples.size());
  if (!d.motors_known) fact("limits of the drives", "none are known: speeds and forces are not judged");
  if (!s.masses) fact("masses", "none are given: forces are those of the process alone");

  std::vector<SerialSample> drawn;
  std::vector<double> times;
  const std::size_t stride = (instants.size() + most_scene_samples - 1) / most_scene_samples;
  for (std::size_t i = 0; i < instants.size(); ++i) {
    if (i % stride != 0 && i + 1 != instants.size()) continue;
    const Instant& at = instants[i];
    drawn.push_back({at.angles.status, at.angles.angle, plane(at.tool.velocity)});
    times.push_back(at.time);
  }
  result.scenes.push_back(
      serial_arm_scene(d.arm, {"motion", "motion along the path", "time_s", "time"}, times, drawn));
}

}  // namespace linkwright::parallel
