// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/serial_pi_arm_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/zero.h"
#include "linkwright/parallel/studies/drive_use.h"
#include "linkwright/parallel/studies/serial_pi_arm_scene.h"
#include "linkwright/study/remarks.h"

namespace linkwright::parallel {
namespace {

/// A scene is for looking at: so many samples at most.
constexpr std::size_t max_arm_samples = 1200;

math::Vec2 plane(const Vec3& v) { return {v.x, v.y}; }

/// One instant of the motion.
struct ArmInstant {
  double time = 0;
  ToolState tool;
  SerialAngles angles;
  SerialRates rates;
  SerialDrives drives;
  SerialQuality quality;
  SerialLoads loads;
  bool reached() const { return angles.status == Status::done; }
};

ArmInstant instant(const SerialAnalysis& s, double time) {
  const SerialPiArm& arm = s.description.arm;
  const MotionForm& form = s.motion->form;
  ArmInstant out;
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

/// The demands of an instant; none out of reach.
void demands_of(const SerialAnalysis& s, const ArmInstant& at, std::vector<Demand>& out) {
  out.clear();
  if (!at.reached() || at.rates.status != Status::done) return;
  const SerialDescription& d = s.description;
  const SerialLimits& limits = s.limits;
  for (int i = 0; i < 2; ++i) out.push_back(travel_demand(i, d.arm.drive[i], at.drives.drive[i]));
  out.push_back(index_demand(Asked::conditioning, 1 / at.quality.condition, limits.conditioning));
  const double elbow = elbow_angle(at.angles.angle);
  if (limits.min_elbow || limits.largest_elbow)
    out.push_back(angle_demand(Asked::elbow, elbow, elbow, limits.min_elbow.value_or(0),
                               limits.largest_elbow.value_or(pi)));
  for (int i = 0; i < 2 && limits.drive_transmission > 0; ++i)
    out.push_back(index_demand(Asked::drive_transmission, at.drives.drive[i].transmission,
                               limits.drive_transmission, i));
  for (int i = 0; i < 2 && d.motors_known; ++i)
    add_drive_demands(out, i, d.motors[i], at.loads.drive_speed[i], at.loads.drive_effort[i]);
}

/// Judges the path by its distance from the first pivot, which no step of the tool changes by more than its
/// own length; the time up to which the arm gets.
double judge_way(PathJudge& judge, const SerialAnalysis& s) {
  constexpr double shortest = 1e-9;  // m: closer to the edge of reach nothing is proven
  const ToolMotion& motion = s.motion->motion;
  const SerialPiArm& arm = s.description.arm;
  const double far = arm.arm[0] + arm.arm[1], near = std::abs(arm.arm[0] - arm.arm[1]);
  // Positive: inside the ring that the arms reach, by so much (m).
  const auto margin = [&](double t) {
    const Vec3 p = motion(t).position;
    const double r = std::hypot(p.x - arm.base.x - arm.offset.x, p.y - arm.base.y - arm.offset.y);
    return std::min(far - r, r - near);
  };
  const std::vector<double> breaks = motion.breaks();
  std::vector<std::array<double, 2>> open;
  for (std::size_t k = 0; k + 1 < breaks.size(); ++k) {
    open.assign(1, {breaks[k], breaks[k + 1]});
    while (!open.empty()) {
      const auto [from, to] = open.back();
      open.pop_back();
      const double middle = from + (to - from) / 2;
      const double way = std::max(motion.way(from, middle).shift, motion.way(middle, to).shift);
      if (margin(middle) > way) continue;
      if (2 * way > shortest) {
        open.push_back({middle, to});
        open.push_back({from, middle});
        continue;
      }
      double beyond = to, begin = middle;
      for (double step = to - from; margin(beyond) > 0 && beyond < breaks[k + 1] && step < 1e3 * (to - from);
           step *= 2)
        beyond = std::min(breaks[k + 1], beyond + step);
      const bool leaves = margin(beyond) < -shortest || margin(middle) < -shortest;
      if (margin(from) > 0 && margin(beyond) < 0) begin = math::zero_between(margin, from, beyond);
      Sentence text =
          say("{}: the arms are in line: the tool cannot move along them", motion.where_exactly(begin));
      SerialAngles worst;
      double worst_time = begin;
      constexpr int steps = 32;
      for (std::size_t piece = k; piece + 1 < breaks.size(); ++piece)
        for (int n = 0; n <= steps; ++n) {
          const double t = breaks[piece] + (breaks[piece + 1] - breaks[piece]) * n / steps;
          if (t < begin) continue;
          const SerialAngles at = inverse(arm, plane(motion(t).position), s.description.mode);
          if (at.status == Status::done || !(std::abs(at.shortfall) > std::abs(worst.shortfall))) continue;
          worst = at;
          worst_time = t;
        }
      if (worst.status != Status::done)
        text += say("; at worst {} ({})", reason(worst), motion.where(worst_time));
      judge.fail(Severity::impossible, begin,
                 leaves || worst.status != Status::done ? Status::no_assembly : Status::singular, text);
      return begin;
    }
  }
  return motion.duration();
}

bool has_forces(const SerialAnalysis& s) {
  return s.masses || s.motion->form.force[0] != 0 || s.motion->form.force[1] != 0;
}

/// All instants as a table, out of reach NaN.
Table motion_table(const SerialDescription& d, const std::vector<ArmInstant>& instants, bool forces) {
  using enum Dimension;
  Table table{.name = "motion"};
  const auto add = [&](const Quantity& what, bool always, auto&& value) {
    std::vector<double> values;
    for (const ArmInstant& i : instants) values.push_back(always || i.reached() ? value(i) : nan);
    table.add(what, std::move(values));
  };
  add({"time", "time", time}, true, [](const ArmInstant& i) { return i.time; });
  add({"x", "x", length}, true, [](const ArmInstant& i) { return i.tool.position.x; });
  add({"y", "y", length}, true, [](const ArmInstant& i) { return i.tool.position.y; });
  add({"tool_speed", "speed of the tool", speed}, true,
      [](const ArmInstant& i) { return norm(i.tool.velocity); });
  add({"tool_acceleration", "acceleration of the tool", acceleration}, true,
      [](const ArmInstant& i) { return norm(i.tool.acceleration); });
  std::vector<std::vector<DriveMotion>> drives;
  for (const ArmInstant& i : instants) {
    drives.emplace_back();
    for (std::size_t k = 0; k < 2 && i.reached(); ++k)
      drives.back().push_back({i.angles.angle[k], i.rates.speed[k], i.drives.drive[k], i.loads.drive_speed[k],
                               i.loads.arm_torque[k], i.loads.drive_effort[k], i.loads.drive_power[k]});
  }
  add_drive_columns(table, d.arm.drive, d.motors, drives, d.motors_known, forces);
  add({"local_conditioning", "local conditioning index"}, false,
      [](const ArmInstant& i) { return 1 / i.quality.condition; });
  add({"elbow", "angle between the arms", angle}, false,
      [](const ArmInstant& i) { return elbow_angle(i.angles.angle); });
  if (std::any_of(instants.begin(), instants.end(), [](const ArmInstant& i) { return !i.reached(); }))
    for (const ArmInstant& i : instants) table.status.emplace_back(to_string(i.angles.status));
  return table;
}

}  // namespace

Table empty_motion_table(const SerialAnalysis& s) { return motion_table(s.description, {}, has_forces(s)); }

void add_serial_motion(study::Result& result, const SerialAnalysis& s, RunContext& context) {
  const MotionStudy& study = *s.motion;
  const SerialDescription& d = s.description;
  const auto samples = study.motion.samples(study.form.interval);
  std::vector<ArmInstant> instants;
  instants.reserve(samples.size());
  for (const auto& sample : samples) {
    if (instants.size() % 256 == 0 && context.interruption() != Status::done) break;
    instants.push_back(instant(s, sample.time));
  }
  PathJudge judge(study.motion, d.arm.drive);
  const double gets_to = judge_way(judge, s);
  const Status judged = judge.judge(
      [&](double time, std::vector<Demand>& out) { demands_of(s, instant(s, time), out); }, gets_to, context);
  if (judged != Status::done) result.status = judged;
  if (instants.size() < samples.size()) result.status = context.interruption();
  if (instants.empty()) {
    result.headline = "Interrupted before the first instant.";
    return;
  }
  const bool forces = has_forces(s);
  result.tables.push_back(motion_table(d, instants, forces));
  const auto uses = judge.uses();
  if (!uses.empty()) result.tables.push_back(uses_table(uses));
  const study::AddPlot plot{result, {.table = "motion", .x = "time_s", .scene = "motion"}};
  plot("tool-speed", "Speed of the tool", {"tool_speed_m_per_s"});
  plot("tool-acceleration", "Acceleration of the tool", {"tool_acceleration_m_per_s2"});
  add_drive_plots(plot, d.arm.drive);
  plot("conditioning", "Conditioning", {"local_conditioning"});

  const study::AddFact fact{result.facts};
  fact("duration of the path", seconds(study.motion.duration()));
  if (const auto* p = judge.peak(Asked::conditioning))
    fact("minimum local conditioning index",
         say("{} ({})", plain_number(p->demand.value).fixed(3), study.motion.where(p->time)));
  if (gets_to < study.motion.duration())
    fact("judged up to", say("{}: the arm gets no farther", study.motion.where_exactly(gets_to)));
  add_verdict(result, judge, study.motion, instants.back().time,
              instants.size() == samples.size() && judged == Status::done);
  if (!d.motors_known) fact("limits of the drives", "none are known: speeds and forces are not judged");
  if (!s.masses) fact("masses", "none are given: forces are those of the process alone");

  std::vector<SerialSample> drawn;
  std::vector<double> times;
  const std::size_t stride = (instants.size() + max_arm_samples - 1) / max_arm_samples;
  for (std::size_t i = 0; i < instants.size(); ++i) {
    if (i % stride != 0 && i + 1 != instants.size()) continue;
    const ArmInstant& at = instants[i];
    drawn.push_back({at.angles.status, at.angles.angle, plane(at.tool.velocity)});
    times.push_back(at.time);
  }
  result.scenes.push_back(
      serial_arm_scene(d.arm, {"motion", "motion along the path", "time_s", "time"}, times, drawn));
}

}  // namespace linkwright::parallel
