// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/linkage_drives.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/dynamics.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/extremes.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

using Verdict = study::Fact::Verdict;

bool has_limits(const LinkageDriveLimits& l) {
  return l.lowest || l.highest || l.speed || l.acceleration || l.effort;
}

Dimension rate_dimension(bool rotary, int order) {
  return study::motion_fields::dimension(rotary ? study::JointKind::rotary : study::JointKind::linear, order);
}
Dimension effort_dimension(bool rotary) { return rotary ? Dimension::torque : Dimension::force; }

// Times of the rows: those of a sweep over time, or of one input at its speed.
std::vector<double> times_of(const LinkageStudy& s, const DriveHistory& h) {
  if (over_time(s)) return h.time;
  std::vector<double> out;
  for (const double value : h.value[0])
    out.push_back(std::abs((value - h.value[0].front()) / s.drives[0].rate));
  return out;
}

Sentence place_of_row(const LinkageStudy& s, const DriveHistory& h, std::size_t row) {
  if (over_time(s)) return at_place("time", seconds(h.time[row]));
  return input_place(s.linkage, s.plan, 0, h.value[0][row], 6);
}

struct LimitUse {
  std::string what;
  std::size_t drive = 0;
  Dimension dimension = Dimension::none;
  double value = 0, limit = 0, share = 0;
  std::size_t row = 0;
  bool of_range = false;
};

// The limits of a drive with the most that is asked of each.
std::vector<LimitUse> limit_uses(const LinkageStudy& s, const DriveHistory& h, std::size_t k) {
  const LinkageDriveLimits& limits = s.drives[k].limits;
  const bool rotary = s.plan.rotary[k];
  const std::string& name = input_joint(s.linkage, k).name;
  std::vector<LimitUse> out;
  const auto size = [&](const char* what, const std::optional<double>& limit,
                        const std::vector<double>& values, Dimension dimension) {
    if (!limit || values.empty()) return;
    const study::Extreme most = study::largest(values);
    if (!most.any()) return;
    out.push_back({fmt::format("{} of {}", what, name), k, dimension, std::abs(most.value), *limit,
                   std::abs(most.value) / *limit, most.row});
  };
  const auto end = [&](const char* what, const std::optional<double>& limit, double sense) {
    if (!limit) return;
    study::Extreme most;
    for (std::size_t r = 0; r < h.value[k].size(); ++r) most.greatest(sense * h.value[k][r], r);
    if (!most.any()) return;
    out.push_back({fmt::format("{} value of {}", what, name), k, rate_dimension(rotary, 0),
                   sense * most.value, *limit, nan, most.row, true});
  };
  end("least", limits.lowest, -1);
  end("greatest", limits.highest, 1);
  size("speed", limits.speed, h.rate[k], rate_dimension(rotary, 1));
  size("acceleration", limits.acceleration, h.acceleration[k], rate_dimension(rotary, 2));
  if (s.quantities.drive)
    size(rotary ? "torque" : "force", limits.effort, h.effort[k], effort_dimension(rotary));
  return out;
}

bool is_kept(const LimitUse& use) {
  const double rounding = 1e-12 * std::abs(use.limit);
  if (!use.of_range) return use.value <= use.limit + rounding;
  return use.what.starts_with("least") ? use.value >= use.limit - rounding
                                       : use.value <= use.limit + rounding;
}

void add_limit_uses(const LinkageStudy& s, const DriveHistory& h, study::Result& result) {
  const study::AddFact fact{result.facts};
  const study::AddWarning warn{result.diagnostics};
  Table table{.name = "drive_limits"};
  std::vector<double> share, place;
  bool any = false, all_kept = true;
  std::optional<LimitUse> most;
  for (std::size_t k = 0; k < s.drives.size(); ++k) {
    if (!has_limits(s.drives[k].limits)) continue;
    any = true;
    for (const LimitUse& use : limit_uses(s, h, k)) {
      table.names.push_back(use.what);
      share.push_back(use.share);
      place.push_back(over_time(s) ? h.time[use.row] : h.value[0][use.row]);
      if (!use.of_range && (!most || use.share > most->share)) most = use;
      if (is_kept(use)) continue;
      all_kept = false;
      const Sentence text =
          say("{} is {} at {}, the limit is {}", use.what, s.units.measured(use.value, use.dimension),
              place_of_row(s, h, use.row), s.units.measured(use.limit, use.dimension));
      warn("drive", text,
           use.of_range ? "move the path or the sweep, or take a drive with more travel"
                        : "run more slowly, or take a stronger drive");
      study::Trouble trouble{.what = use.what, .why = text};
      if (over_time(s)) trouble.where = {{"time_s", h.time[use.row]}};
      if (!use.of_range) trouble.share = use.share;
      result.troubles.push_back(std::move(trouble));
    }
  }
  if (!any || table.names.empty()) return;
  table.add("share", "share of the limit", std::move(share));
  if (over_time(s))
    table.add({"time", "time", Dimension::time}, std::move(place));
  else
    table.add(input_key(s.linkage, s.plan, 0), input_label(s.linkage, s.plan, 0), std::move(place));
  result.tables.push_back(std::move(table));
  Sentence text = all_kept ? Sentence("kept") : Sentence("not kept");
  if (most)
    text += say("; {} reaches {} of its limit at {}", most->what, percent(most->share),
                place_of_row(s, h, most->row));
  fact("limits of the drives", text, all_kept ? Verdict::good : Verdict::bad);
}

// Peaks and root mean squares of the drives of a path.
void add_drive_facts(const LinkageStudy& s, const DriveHistory& h, study::Result& result) {
  const study::AddFact fact{result.facts};
  for (std::size_t k = 0; k < s.drives.size(); ++k) {
    const bool rotary = s.plan.rotary[k];
    const std::string& name = input_joint(s.linkage, k).name;
    const study::Extreme speed = study::largest(h.rate[k]);
    if (speed.any() && s.quantities.rates)
      fact(fmt::format("largest speed of {}", name),
           say("{} at {}", s.units.measured(std::abs(speed.value), rate_dimension(rotary, 1)),
               place_of_row(s, h, speed.row)));
    if (!s.quantities.drive) continue;
    fact(fmt::format("{} of {}, root mean square", rotary ? "torque" : "force", name),
         study::torque_or_force(rms_over(h.time, h.effort[k]), rotary, 5));
    std::vector<double> power;
    for (std::size_t r = 0; r < h.time.size(); ++r) power.push_back(h.effort[k][r] * h.rate[k][r]);
    const study::Extreme peak = study::largest(power);
    if (peak.any())
      fact(fmt::format("largest power of {}", name),
           say("{} at {}, root mean square {}", measured("W", std::abs(peak.value)),
               place_of_row(s, h, peak.row), measured("W", rms_over(h.time, power))));
  }
}

struct MotorChoice {
  const Motor* motor = nullptr;
  MotorUse use;
};

void add_motor_plane(const LinkageStudy& s, std::size_t k, const std::vector<double>& times,
                     const MotorChoice& choice, study::Result& result) {
  const std::string& joint = input_joint(s.linkage, k).name;
  const std::string name = "motor_" + identifier(joint);
  Table table{.name = name};
  const std::size_t n = times.size();
  table.add({"time", "time", Dimension::time}, times);
  table.add({"motor_speed", "speed of the motor", Dimension::speed_angular}, choice.use.speed);
  table.add({"motor_torque", "torque of the motor", Dimension::torque}, choice.use.torque);
  const auto level = [&](const char* key, const char* words, double value) {
    table.add({key, words, Dimension::torque}, std::vector<double>(n, value));
  };
  level("rated_from", "rated torque, backward", -choice.motor->rated_torque);
  level("rated_to", "rated torque", choice.motor->rated_torque);
  level("peak_from", "peak torque, backward", -choice.motor->peak_torque);
  level("peak_to", "peak torque", choice.motor->peak_torque);
  result.tables.push_back(std::move(table));
  study::Plot plot;
  plot.name = "motor-" + identifier(joint);
  plot.title = fmt::format("Torque over speed of '{}' at {}, gear ratio {:.4g}", choice.motor->name, joint,
                           choice.use.gear_ratio);
  plot.table = name;
  plot.x = "motor_speed_rad_per_s";
  plot.y = {"motor_torque_N_m"};
  plot.style = study::Plot::Style::points;
  plot.bands = {{"rated_from_N_m", "rated_to_N_m", "rated torque"},
                {"peak_from_N_m", "peak_to_N_m", "peak torque"}};
  result.plots.push_back(std::move(plot));
}

Sentence motor_text(const MotorChoice& c) {
  Sentence text =
      say("'{}' with gear ratio {}: {} of its rated torque, {} of its peak torque, {} of its speed",
          c.motor->name, plain_number(c.use.gear_ratio), percent(c.use.rms_torque / c.motor->rated_torque, 3),
          percent(c.use.peak_torque / c.motor->peak_torque, 3),
          percent(c.use.peak_speed / c.motor->max_speed, 3));
  if (std::isfinite(c.use.inertia_ratio))
    text += say(", inertia ratio {}", plain_number(c.use.inertia_ratio, 3));
  return text;
}

void add_motors(const LinkageStudy& s, const DriveHistory& h, study::Result& result) {
  const study::AddFact fact{result.facts};
  const std::vector<double> times = times_of(s, h);
  Table table{.name = "motors"};
  std::vector<double> ratio, rms, rms_share, peak, peak_share, speed, speed_share, inertia, fits;
  for (std::size_t k = 0; k < s.drives.size(); ++k) {
    const std::string& joint = input_joint(s.linkage, k).name;
    const MotorLoad load{times, h.effort[k], h.rate[k], h.acceleration[k], h.inertia[k]};
    std::optional<MotorChoice> first, nearest;
    int tried = 0;
    for (const Motor& motor : s.motors) {
      if ((motor.lead > 0) == s.plan.rotary[k]) continue;
      for (const double gear : motor.gear_ratio) {
        const MotorChoice choice{&motor, motor_use(motor, gear, load)};
        ++tried;
        table.names.push_back(fmt::format("{} at {}, gear ratio {:.6g}", motor.name, joint, gear));
        ratio.push_back(gear);
        rms.push_back(choice.use.rms_torque), rms_share.push_back(choice.use.rms_torque / motor.rated_torque);
        peak.push_back(choice.use.peak_torque);
        peak_share.push_back(choice.use.peak_torque / motor.peak_torque);
        speed.push_back(choice.use.peak_speed),
            speed_share.push_back(choice.use.peak_speed / motor.max_speed);
        inertia.push_back(choice.use.inertia_ratio);
        fits.push_back(choice.use.fits() ? 1 : 0);
        if (!first && choice.use.fits()) first = choice;
        if (!nearest || choice.use.share < nearest->use.share) nearest = choice;
      }
    }
    const std::string label = fmt::format("motor of {}", joint);
    if (first)
      fact(label, motor_text(*first), Verdict::good);
    else if (nearest)
      fact(label, say("none of {} suffices; the nearest is {}", tried, motor_text(*nearest)), Verdict::bad);
    else
      fact(label,
           s.plan.rotary[k] ? "no motor of the list turns a joint: all have a lead"
                            : "no motor of the list moves a slide: none has a lead",
           Verdict::bad);
    if (nearest) add_motor_plane(s, k, times, first ? *first : *nearest, result);
  }
  table.add("gear_ratio", "gear ratio", std::move(ratio));
  table.add({"rms_torque", "torque of the motor, root mean square", Dimension::torque}, std::move(rms));
  table.add("rms_share", "share of the rated torque", std::move(rms_share));
  table.add({"peak_torque", "largest torque of the motor", Dimension::torque}, std::move(peak));
  table.add("peak_share", "share of the peak torque", std::move(peak_share));
  table.add({"peak_speed", "largest speed of the motor", Dimension::speed_angular}, std::move(speed));
  table.add("speed_share", "share of the speed", std::move(speed_share));
  table.add("inertia_ratio", "inertia of the load over that of the motor", std::move(inertia));
  table.add("fits", "1 = the motor suffices", std::move(fits));
  if (!table.names.empty()) result.tables.push_back(std::move(table));
}

}  // namespace

bool is_motion_in_time(const LinkageStudy& s) {
  return over_time(s) || (s.drives.size() == 1 && s.drives[0].rate != 0 && s.drives[0].acceleration == 0);
}

std::vector<Motor> read_motors(study::ObjectReader& document, const LinkageStudy& s) {
  std::vector<Motor> out;
  auto tables = document.tables("motor");
  for (study::ObjectReader& table : tables) {
    Motor motor;
    table.read(motor);
    if (motor.gear_ratio.empty())
      table.error("gear_ratio", "the list is empty", "give one ratio or more, or leave the key out");
    if (motor.peak_torque > 0 && motor.peak_torque < motor.rated_torque)
      table.error("peak_torque",
                  fmt::format("the peak torque of '{}' is {:.4g} N m, its rated torque {:.4g} N m",
                              motor.name, motor.peak_torque, motor.rated_torque),
                  "the peak torque is the larger of the two");
    out.push_back(std::move(motor));
  }
  if (tables.empty() || document.document().has_errors()) return out;
  if (!is_motion_in_time(s))
    tables[0].error("name",
                    s.drives.size() == 1
                        ? "a motor is chosen for a motion in time; the drive has no constant speed"
                        : fmt::format("a motor is chosen for a motion in time; a grid over {} inputs is none",
                                      s.drives.size()),
                    "give the drive a speed, laws over time, or a [path]");
  else if (!s.quantities.drive)
    tables[0].error("name", "a motor is chosen by the forces of the drives, which are left out",
                    "give the masses, and `drive` among the quantities");
  return out;
}

void describe_motors(study::SchemaWriter& document) {
  document.property(field::entry("motor",
                                 "motors of a catalogue, of which each drive takes the first that "
                                 "suffices"),
                    study::schema_array(study::schema_fields<Motor>()));
}

void DriveHistory::add(const LinkageStudy& s, const LinkageInstant& now, bool forces, LinkageMotion& motion) {
  const std::size_t n = s.plan.inputs();
  value.resize(n), rate.resize(n), acceleration.resize(n), effort.resize(n), inertia.resize(n);
  time.push_back(now.time);
  for (std::size_t k = 0; k < n; ++k) {
    value[k].push_back(now.inputs[k].value);
    rate[k].push_back(now.inputs[k].rate);
    acceleration[k].push_back(now.inputs[k].acceleration);
    effort[k].push_back(forces ? now.forces->drives[k] : 0);
  }
  if (s.motors.empty()) return;
  std::vector<InputMotion> unit(now.inputs.begin(), now.inputs.end());
  for (InputMotion& u : unit) u.rate = u.acceleration = 0;
  for (std::size_t k = 0; k < n; ++k) {
    unit[k].rate = 1;
    solve_velocity(s.plan, unit, motion);
    inertia[k].push_back(2 * kinetic_energy(s.plan, motion));
    unit[k].rate = 0;
  }
}

void add_drives(const LinkageStudy& s, const DriveHistory& h, study::Result& result) {
  if (h.time.empty()) return;
  if (s.path) add_drive_facts(s, h, result);
  add_limit_uses(s, h, result);
  if (!s.motors.empty()) add_motors(s, h, result);
}

}  // namespace linkwright::planar
