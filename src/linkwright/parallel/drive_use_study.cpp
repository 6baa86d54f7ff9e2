#include "linkwright/parallel/drive_use_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "linkwright/math/angles.h"

namespace linkwright::parallel {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

bool is_pi(const Drive& drive) { return drive.type == DriveType::pi_joint; }

}  // namespace

void PathJudge::fail(std::string kind, double time, Status status, std::string_view why) {
  for (const Failure& f : failures_)
    if (f.kind == kind) return;
  failures_.push_back({std::move(kind), time, status, fmt::format("{}: {}", motion_.where(time), why)});
}

void PathJudge::use(double time, const std::string& what, double value, double limit, std::string_view unit) {
  if (!std::isfinite(limit) || !std::isfinite(value)) return;
  auto found = std::find_if(uses_.begin(), uses_.end(), [&](const DriveUse& u) { return u.what == what; });
  if (found == uses_.end()) found = uses_.insert(uses_.end(), DriveUse{.what = what, .share = -1});
  const double share = limit > 0 ? value / limit : std::numeric_limits<double>::infinity();
  if (share > found->share) *found = {what, share, value, limit, time};
  if (share > 1)
    fail(what, time, Status::limit_reached,
         fmt::format("{} is {:.4g} {}, the limit is {:.4g} {}", what, value, unit, limit, unit));
}

void PathJudge::travel(double time, int i, const Drive& drive, const DriveAt& at) {
  if (at.status == Status::done) return;
  fail(fmt::format("travel {}", i), time, Status::limit_reached,
       fmt::format("{} {} would be at {:.2f} deg, travel {:.2f} to {:.2f} deg",
                   is_pi(drive) ? "Pi-joint" : "arm", i + 1, math::degrees(at.angle),
                   math::degrees(drive.lowest), math::degrees(drive.highest)));
}

void PathJudge::transmission(double time, int i, const DriveAt& at, double least) {
  if (at.transmission < least)
    fail("drive transmission", time, Status::limit_reached,
         fmt::format("sine of the angle between diagonal and arm of Pi-joint {} is {:.3f}, at least {:.3f} "
                     "is asked for",
                     i + 1, at.transmission, least));
}

void PathJudge::limits(double time, int i, const Drive& drive, const PiDrive& motor, double speed,
                       double effort) {
  const bool pi = is_pi(drive), geared = motor.screw.lead > 0;
  const double fastest = geared ? top_rate(motor) : motor.rate_limit;
  use(time, fmt::format("speed of drive {}", i + 1), std::abs(speed), fastest, pi ? "m/s" : "rad/s");
  const PowerFlow flow = effort * speed < 0 ? PowerFlow::load_drives : PowerFlow::motor_drives;
  // Beyond its speed a motor has no force: the speed is told, then.
  const double most =
      !geared || std::abs(speed) > fastest ? motor.force_limit : available_force(motor, speed, flow);
  use(time, fmt::format("{} of drive {}", pi ? "screw force" : "torque", i + 1), std::abs(effort), most,
      pi ? "N" : "N m");
}

Table uses_table(const std::vector<DriveUse>& uses) {
  Table table{.name = "drive_limits"};
  std::vector<double> value, limit, share, time;
  for (const DriveUse& u : uses) {
    table.names.push_back(u.what);
    value.push_back(u.value);
    limit.push_back(u.limit);
    share.push_back(100 * u.share);
    time.push_back(u.time);
  }
  table.add("largest", "largest (SI units)", value);
  table.add("limit", "limit then (SI units)", limit);
  table.add("use_percent", "use (%)", share);
  table.add("time_s", "at (s)", time);
  return table;
}

void add_drive_columns(Table& table, std::span<const Drive> drives, std::span<const PiDrive> motors,
                       const std::vector<std::vector<DriveMotion>>& rows, bool motors_known, bool forces) {
  const auto add = [&](std::string_view key, std::string_view unit, std::string_view label,
                       std::string_view unit_text, auto&& has, auto&& get) {
    for (std::size_t k = 0; k < drives.size(); ++k) {
      if (!has(k)) continue;
      std::vector<double> values;
      values.reserve(rows.size());
      for (const auto& row : rows) values.push_back(row.empty() ? nan : get(row[k], k));
      table.add(fmt::format("{}_{}_{}", key, k + 1, unit), fmt::format("{} {} ({})", label, k + 1, unit_text),
                std::move(values));
    }
  };
  const auto all = [](std::size_t) { return true; };
  const auto pi = [&](std::size_t k) { return is_pi(drives[k]); };
  using M = DriveMotion;
  add("arm_angle", "rad", "arm angle", "rad", all, [](const M& m, std::size_t) { return m.arm_angle; });
  add("pi_angle", "rad", "angle of Pi-joint", "rad", pi, [](const M& m, std::size_t) { return m.at.angle; });
  add("diagonal", "m", "diagonal", "m", pi, [](const M& m, std::size_t) { return m.at.value; });
  add("arm_speed", "rad_per_s", "speed of arm", "rad/s", all,
      [](const M& m, std::size_t) { return m.arm_speed; });
  add("diagonal_rate", "m_per_s", "rate of diagonal", "m/s", pi,
      [](const M& m, std::size_t) { return m.speed; });
  if (!forces) return;
  add("arm_torque", "N_m", "torque at arm", "N m", all, [](const M& m, std::size_t) { return m.arm_torque; });
  add("screw_force", "N", "screw force", "N", pi, [](const M& m, std::size_t) { return m.effort; });
  add("power", "W", "power of drive", "W", all, [](const M& m, std::size_t) { return m.power; });
  const auto motor = [&](std::size_t k) { return motors_known && motors[k].screw.lead > 0; };
  add("motor_speed", "rad_per_s", "speed of motor", "rad/s", motor,
      [&](const M& m, std::size_t k) { return motor_speed_of(motors[k].screw, m.speed); });
  add("motor_torque", "N_m", "torque of motor", "N m", motor,
      [&](const M& m, std::size_t k) { return motor_torque(motors[k].screw, m.effort, m.speed); });
}

study::Plot motion_plot(std::string name, std::string title, std::vector<std::string> columns) {
  return {.name = std::move(name),
          .title = std::move(title),
          .table = "motion",
          .x = "time_s",
          .y = std::move(columns),
          .scene = "motion"};
}

void add_drive_plots(study::Result& result, const Table& motion, std::span<const Drive> drives) {
  const auto plot = [&](const char* name, const char* title, std::string_view key, std::string_view unit,
                        bool of_pi_too = true) {
    std::vector<std::string> columns;
    for (std::size_t k = 0; k < drives.size(); ++k) {
      std::string column = fmt::format("{}_{}_{}", key, k + 1, unit);
      if (motion.find(column) && (of_pi_too || !is_pi(drives[k]))) columns.push_back(std::move(column));
    }
    if (!columns.empty()) result.plots.push_back(motion_plot(name, title, std::move(columns)));
  };
  plot("diagonals", "Diagonals of the Pi-joints", "diagonal", "m");
  plot("diagonal-rates", "Rates of the diagonals", "diagonal_rate", "m_per_s");
  plot("arm-angles", "Arm angles", "arm_angle", "rad", false);
  plot("arm-speeds", "Speeds of the arms", "arm_speed", "rad_per_s", false);
  plot("arm-torques", "Torques at the arms", "arm_torque", "N_m");
  plot("screw-forces", "Screw forces", "screw_force", "N");
  plot("powers", "Powers of the drives", "power", "W");
  plot("motor-torques", "Torques of the motors", "motor_torque", "N_m");
  plot("motor-speeds", "Speeds of the motors", "motor_speed", "rad_per_s");
}

void add_verdict(study::Result& result, const PathJudge& judge, const ToolMotion& motion, double end,
                 bool whole) {
  using Verdict = study::Fact::Verdict;
  for (const DriveUse& u : judge.uses()) {
    // Of all drives the one that is used most; the others are in the table.
    const std::string kind = u.what.substr(0, u.what.find(" of drive"));
    const bool most = std::all_of(judge.uses().begin(), judge.uses().end(), [&](const DriveUse& other) {
      return !other.what.starts_with(kind) || other.share < u.share || &other == &u ||
             (other.share == u.share && &other > &u);
    });
    if (most)
      result.facts.push_back({kind + ", most used",
                              fmt::format("{:.1f} % of the limit ({}, {})", 100 * u.share,
                                          u.what.substr(u.what.find("drive")), motion.where(u.time)),
                              u.share <= 1 ? Verdict::good : Verdict::bad});
  }
  for (const auto& failure : judge.failures()) {
    result.facts.push_back({"fails", failure.text, Verdict::bad});
    if (result.status == Status::done) result.status = failure.status;
  }
  const DriveUse* most = nullptr;
  for (const DriveUse& u : judge.uses())
    if (!most || u.share > most->share) most = &u;
  const std::string tight = most ? fmt::format(" The tightest limit is the {}: {:.0f} % of it is used.",
                                               most->what, 100 * most->share)
                                 : "";
  if (judge.failures().empty()) {
    result.headline = whole ? fmt::format("It works: the path takes {:.4g} s.{}", motion.duration(), tight)
                            : fmt::format("Interrupted after {:.4g} s of the path.", end);
  } else {
    const auto first = std::min_element(judge.failures().begin(), judge.failures().end(),
                                        [](const auto& a, const auto& b) { return a.time < b.time; });
    result.headline = fmt::format("It fails: {}.", first->text);
  }
}

}  // namespace linkwright::parallel
