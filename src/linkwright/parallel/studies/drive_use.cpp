// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/drive_use.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "linkwright/core/numbers.h"
#include "linkwright/math/minimum.h"
#include "linkwright/math/zero.h"

namespace linkwright::parallel {
namespace {

constexpr double infinite = infinity;

bool is_pi(const Drive& drive) { return drive.type == DriveType::pi_joint; }

std::string name_of_use(const Demand& d, std::span<const Drive> drives) {
  const bool pi = is_pi(drives[static_cast<std::size_t>(d.drive)]);
  return fmt::format("{} of drive {}",
                     d.asked == Asked::speed ? "speed"
                     : pi                    ? "screw force"
                                             : "torque",
                     d.drive + 1);
}

}  // namespace

Demand travel_demand(int i, const Drive& drive, const DriveAt& at) {
  // A Pi-joint does not turn beyond a right angle.
  constexpr double right = pi / 2;
  const double low = is_pi(drive) ? std::max(drive.lowest, -right) : drive.lowest;
  const double high = is_pi(drive) ? std::min(drive.highest, right) : drive.highest;
  const double below = low - at.angle, above = at.angle - high;
  return {Asked::travel, i, at.angle, below > above ? low : high, std::max(below, above)};
}

Demand index_demand(Asked asked, double value, double least, int drive) {
  return {asked, drive, value, least, least - value};
}

Demand angle_demand(Asked asked, double lowest, double highest, double least, double most) {
  const double below = least - lowest, above = highest - most;
  return below > above ? Demand{asked, -1, lowest, least, below} : Demand{asked, -1, highest, most, above};
}

void add_drive_demands(std::vector<Demand>& out, int i, const PiDrive& motor, double speed, double effort) {
  const bool geared = motor.screw.lead > 0;
  const double fastest = geared ? top_rate(motor) : motor.rate_limit;
  const auto add = [&](Asked asked, double value, double limit) {
    // Unless it is finite, a limit is none.
    if (!std::isfinite(limit) || !std::isfinite(value)) return out.push_back({asked, i, value, limit, -1});
    const double share = limit > 0 ? value / limit : value > 0 ? infinite : 0;
    out.push_back({asked, i, value, limit, share - 1});
  };
  add(Asked::speed, std::abs(speed), fastest);
  const PowerFlow flow = effort * speed < 0 ? PowerFlow::load_drives : PowerFlow::motor_drives;
  // Beyond its speed a motor has no force: the speed is reported, then.
  const double most =
      !geared || std::abs(speed) > fastest ? motor.force_limit : available_force(motor, speed, flow);
  add(Asked::effort, std::abs(effort), most);
}

Status PathJudge::judge(Look look, double end, const RunContext& context) {
  constexpr int steps = 32;  // steps in each stretch
  std::vector<Demand> now;
  std::array<std::vector<Demand>, 3> last;  // at times[k]; empty: the robot is not there
  std::array<double, 3> times{};
  const auto take = [&](const Demand& demand, std::size_t k, double time) {
    if (peaks_.size() <= k) peaks_.resize(k + 1, {.demand = {.excess = -infinite}});
    if (demand.excess > peaks_[k].demand.excess) {
      const double begin = peaks_[k].begin;
      peaks_[k] = {demand, time, begin};
    }
  };
  const auto excess = [&](double time, std::size_t k) {
    look(time, now);
    return k < now.size() ? now[k].excess : nan;
  };
  // The first time up to `to` at which a limit kept at `from` is not kept.
  const auto begins = [&](std::size_t k, double from, double to) {
    const auto at = [&](double t) { return excess(t, k); };
    return at(from) <= 0 && at(to) > 0 ? math::zero_between(at, from, to) : to;
  };
  std::vector<bool> failed;
  const auto note_failure = [&](std::size_t k, double from, double to) {
    if (failed.size() <= k) failed.resize(k + 1);
    if (failed[k]) return;
    failed[k] = true;
    peaks_[k].begin = begins(k, from, to);
  };

  const std::vector<double> breaks = motion_.breaks();
  for (std::size_t piece = 0; piece + 1 < breaks.size() && breaks[piece] < end; ++piece) {
    if (const Status stop = context.interruption(); stop != Status::done) return stop;
    const double from = breaks[piece], to = std::min(breaks[piece + 1], end);
    // Just before where the path cannot continue there is nothing to be asked for.
    const int count = to < breaks[piece + 1] ? steps : steps + 1;
    // On the right of a break the next law counts, on its left the old one.
    const double edge = 1e-9 * (to - from);
    for (int n = 0; n < count; ++n) {
      const double t = n == steps && piece + 2 < breaks.size() ? to - edge : from + (to - from) * n / steps;
      std::rotate(last.begin(), last.begin() + 1, last.end());
      std::rotate(times.begin(), times.begin() + 1, times.end());
      times[2] = t;
      look(t, last[2]);
      for (std::size_t k = 0; k < last[2].size(); ++k) {
        take(last[2][k], k, t);
        const bool before = n > 0 && last[1].size() > k;
        if (last[2][k].excess > 0) note_failure(k, before ? times[1] : t, t);
        // The peak between three steps.
        if (n < 2 || last[0].size() <= k || last[1].size() <= k) continue;
        const double a = last[0][k].excess, b = last[1][k].excess, c = last[2][k].excess;
        if (!(b >= a && b >= c && (b > a || b > c) && std::isfinite(b))) continue;
        // The first 36 of these sections come down to the square root of rounding.
        const double top = math::minimum_about([&](double x) { return -excess(x, k); }, times[0], times[1],
                                               times[2], {.relative = 1e-9, .sections = 40})
                               .at;
        look(top, now);
        if (now.size() <= k) continue;
        take(now[k], k, top);
        if (now[k].excess > 0) note_failure(k, times[0], top);
      }
    }
  }
  return Status::done;
}

const PathJudge::Peak* PathJudge::peak(Asked asked) const {
  const Peak* out = nullptr;
  for (const Peak& p : peaks_)
    if (p.demand.asked == asked && (!out || p.demand.excess > out->demand.excess)) out = &p;
  return out;
}

std::vector<DriveUse> PathJudge::uses() const {
  std::vector<DriveUse> out;
  for (const Peak& p : peaks_) {
    const Demand& d = p.demand;
    if ((d.asked != Asked::speed && d.asked != Asked::effort) || !std::isfinite(d.limit)) continue;
    out.push_back({name_of_use(d, drives_), d.excess + 1, d.value, d.limit, p.time});
  }
  return out;
}

Sentence PathJudge::text(const Peak& peak) const {
  const Demand& d = peak.demand;
  const auto angle = [](double value) { return degrees_of(value).fixed(2).spelled(); };
  const auto index = [&](std::string_view name) {
    return say("{} is {}, at least {} is required", name, plain_number(d.value).fixed(3),
               plain_number(d.limit).fixed(3));
  };
  Sentence what;
  switch (d.asked) {
    case Asked::travel: {
      const Drive& drive = drives_[static_cast<std::size_t>(d.drive)];
      what = say("{} {} would be at {}, travel {} to {}", is_pi(drive) ? "Pi-joint" : "arm",
                 at_place("drive", count_of(d.drive + 1)), angle(d.value), angle(drive.lowest).sharing_unit(),
                 angle(drive.highest));
      break;
    }
    case Asked::swing:
      what = say("a rod leans {} out of the plane of its arm, at most {} is allowed", angle(d.value),
                 angle(d.limit));
      break;
    case Asked::elbow:
      what = say("the angle at an elbow is {}, {} {} is required", angle(d.value),
                 d.value < d.limit ? "at least" : "at most", angle(d.limit));
      break;
    case Asked::speed:
    case Asked::effort: {
      const bool pi = is_pi(drives_[static_cast<std::size_t>(d.drive)]);
      const char* unit = d.asked == Asked::speed ? (pi ? "m_per_s" : "rad_per_s") : (pi ? "N" : "N_m");
      what = say("{} is {}, the limit is {}", name_of_use(d, drives_), measured(unit, d.value),
                 measured(unit, d.limit));
      if (std::isfinite(d.excess)) what += say(", {} of it is required", percent(1 + d.excess).fixed(0));
      break;
    }
    case Asked::transmission:
      what = index("transmission index");
      break;
    case Asked::conditioning:
      what = index("local conditioning index");
      break;
    case Asked::constraint:
      what = index("constraint index");
      break;
    case Asked::drive_transmission:
      what = index(fmt::format("sine of the angle between diagonal and arm of Pi-joint {}", d.drive + 1));
      break;
  }
  return say("{} ({}); it begins in {}", what, motion_.where(peak.time), motion_.where(peak.begin));
}

std::vector<PathJudge::Failure> PathJudge::failures() const {
  std::vector<Failure> out = failures_;
  for (const Peak& p : peaks_) {
    if (!(p.demand.excess > 0)) continue;
    const Asked a = p.demand.asked;
    const Severity severity = a == Asked::travel || a == Asked::swing || a == Asked::elbow ? Severity::stopped
                              : a == Asked::speed || a == Asked::effort ? Severity::too_much
                                                                        : Severity::poor;
    out.push_back({severity, p.begin, p.demand.excess, Status::limit_reached, text(p)});
  }
  std::stable_sort(out.begin(), out.end(), [](const Failure& a, const Failure& b) {
    if (a.severity != b.severity) return a.severity < b.severity;
    return a.severity == Severity::impossible ? a.time < b.time : a.worst > b.worst;
  });
  return out;
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
  using enum Dimension;
  using M = DriveMotion;
  const auto add = [&](const Quantity& what, auto&& has, auto&& get) {
    for (std::size_t k = 0; k < drives.size(); ++k) {
      if (!has(k)) continue;
      std::vector<double> values;
      values.reserve(rows.size());
      for (const auto& row : rows) values.push_back(row.empty() ? nan : get(row[k], k));
      table.add(
          {fmt::format("{}_{}", what.key, k + 1), fmt::format("{} {}", what.words, k + 1), what.dimension},
          std::move(values));
    }
  };
  const auto all = [](std::size_t) { return true; };
  const auto by_pi_joint = [&](std::size_t k) { return is_pi(drives[k]); };
  add({"arm_angle", "arm angle", angle}, all, [](const M& m, std::size_t) { return m.arm_angle; });
  add({"pi_angle", "angle of Pi-joint", angle}, by_pi_joint,
      [](const M& m, std::size_t) { return m.at.angle; });
  add({"diagonal", "diagonal", length}, by_pi_joint, [](const M& m, std::size_t) { return m.at.value; });
  add({"arm_speed", "speed of arm", speed_angular}, all, [](const M& m, std::size_t) { return m.arm_speed; });
  add({"diagonal_rate", "rate of diagonal", speed}, by_pi_joint,
      [](const M& m, std::size_t) { return m.speed; });
  if (!forces) return;
  add({"arm_torque", "torque at arm", torque}, all, [](const M& m, std::size_t) { return m.arm_torque; });
  add({"screw_force", "screw force", force}, by_pi_joint, [](const M& m, std::size_t) { return m.effort; });
  add({"power", "power of drive", power}, all, [](const M& m, std::size_t) { return m.power; });
  const auto motor = [&](std::size_t k) { return motors_known && motors[k].screw.lead > 0; };
  add({"motor_speed", "speed of motor", speed_angular}, motor,
      [&](const M& m, std::size_t k) { return motor_speed_of(motors[k].screw, m.speed); });
  add({"motor_torque", "torque of motor", torque}, motor,
      [&](const M& m, std::size_t k) { return motor_torque(motors[k].screw, m.effort, m.speed); });
}

void add_drive_plots(const study::AddPlot& plot, std::span<const Drive> drives) {
  const auto add = [&](const char* name, const char* title, std::string_view key, std::string_view unit,
                       bool of_pi_too = true) {
    std::vector<std::string> columns;
    for (std::size_t k = 0; k < drives.size(); ++k)
      if (of_pi_too || !is_pi(drives[k])) columns.push_back(fmt::format("{}_{}_{}", key, k + 1, unit));
    plot(name, title, std::move(columns));
  };
  add("diagonals", "Diagonals of the Pi-joints", "diagonal", "m");
  add("diagonal-rates", "Rates of the diagonals", "diagonal_rate", "m_per_s");
  add("arm-angles", "Arm angles", "arm_angle", "rad", false);
  add("arm-speeds", "Speeds of the arms", "arm_speed", "rad_per_s", false);
  add("arm-torques", "Torques at the arms", "arm_torque", "N_m");
  add("screw-forces", "Screw forces", "screw_force", "N");
  add("powers", "Powers of the drives", "power", "W");
  add("motor-torques", "Torques of the motors", "motor_torque", "N_m");
  add("motor-speeds", "Speeds of the motors", "motor_speed", "rad_per_s");
}

void add_verdict(study::Result& result, const PathJudge& judge, const ToolMotion& motion, double end,
                 bool whole) {
  using Verdict = study::Fact::Verdict;
  const std::vector<DriveUse> uses = judge.uses();
  for (const DriveUse& u : uses) {
    // Reports the drive that is used most; the others are in the table.
    const std::string kind = u.what.substr(0, u.what.find(" of drive"));
    const bool most = std::all_of(uses.begin(), uses.end(), [&](const DriveUse& other) {
      return !other.what.starts_with(kind) || other.share < u.share || &other == &u ||
             (other.share == u.share && &other > &u);
    });
    if (most)
      result.facts.push_back({kind + ", most used",
                              say("{} of the limit ({}, {})", percent(u.share).fixed(1),
                                  u.what.substr(u.what.find("drive")), motion.where(u.time)),
                              u.share <= 1 ? Verdict::good : Verdict::bad});
  }
  const auto failures = judge.failures();
  for (const auto& failure : failures) {
    result.facts.push_back({"fails", failure.text, Verdict::bad});
    if (result.status == Status::done) result.status = failure.status;
    // A place that the robot cannot pass is no share of a limit.
    const bool blocked = failure.severity == Severity::impossible || failure.severity == Severity::stopped;
    result.troubles.push_back({.what = std::string(to_string(failure.status)),
                               .where = {{"time_s", failure.time}},
                               .share = blocked ? HUGE_VAL : 1 + failure.worst,
                               .why = failure.text});
  }
  std::stable_sort(result.troubles.begin(), result.troubles.end(), [](const auto& a, const auto& b) {
    return a.where.front().value < b.where.front().value;
  });
  const DriveUse* most = nullptr;
  for (const DriveUse& u : uses)
    if (!most || u.share > most->share) most = &u;
  const Sentence tight = most ? say(" The tightest limit is the {}: {} of it is used.", most->what,
                                    percent(most->share).fixed(0))
                              : Sentence();
  if (failures.empty()) {
    result.headline = whole ? say("It works: the path takes {}.{}", seconds(motion.duration()), tight)
                            : say("Interrupted after {} of the path.", seconds(end));
  } else {
    result.headline = say("It fails: {}.", failures.front().text);
    const auto first = std::min_element(failures.begin(), failures.end(),
                                        [](const auto& a, const auto& b) { return a.time < b.time; });
    if (first->time < failures.front().time)
      result.headline +=
          say(" The first of {} failures begins in {}.", failures.size(), motion.where(first->time));
  }
}

}  // namespace linkwright::parallel
