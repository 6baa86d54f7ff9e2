// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/planar/linkage/stop.h"
#include "linkwright/planar/studies/linkage_scene.h"
#include "linkwright/planar/studies/rest.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

double frequency_of(std::complex<double> vibration) { return std::abs(vibration) / full_turn; }
double damping_ratio_of(std::complex<double> vibration) {
  return vibration.real() == 0 ? 0 : -vibration.real() / std::abs(vibration);
}

// The report of several free joints.
class ConfigurationReport {
 public:
  ConfigurationReport(const RestStudy& study, RunContext& context) : s_(study), context_(context) {}

  study::Result make() {
    found_ = rest_configurations(s_.linkage, s_.plan, *s_.grid, &context_);
    result_.status = found_.status;
    table();
    draw();
    facts();
    headline();
    return std::move(result_);
  }

 private:
  std::size_t input(std::size_t j) const { return s_.grid->free[j]; }
  std::size_t count() const { return s_.grid->free.size(); }

  void table() {
    Table table{.name = "rest"};
    for (const RestConfiguration& c : found_.found) table.names.emplace_back(name_of(c.kind));
    const auto add = [&](std::string key, std::string label, const auto& number) {
      std::vector<double> values;
      for (const RestConfiguration& c : found_.found) values.push_back(number(c));
      table.add(std::move(key), std::move(label), std::move(values));
    };
    for (std::size_t j = 0; j < count(); ++j)
      add(input_key(s_.linkage, s_.plan, input(j)), input_label(s_.linkage, s_.plan, input(j)),
          [j](const RestConfiguration& c) { return c.values[j]; });
    add("stable", "1 if stable",
        [](const RestConfiguration& c) { return c.kind == RestKind::stable ? 1.0 : 0.0; });
    for (std::size_t m = 0; m < count(); ++m) {
      const auto of = [m](auto number) {
        return [m, number](const RestConfiguration& c) {
          return m < c.vibrations.size() ? number(c.vibrations[m]) : nan;
        };
      };
      add(fmt::format("vibration_{}_frequency_Hz", m + 1), fmt::format("natural frequency {} (Hz)", m + 1),
          of(frequency_of));
      add(fmt::format("vibration_{}_damping_ratio", m + 1), fmt::format("damping ratio {}", m + 1),
          of(damping_ratio_of));
    }
    add("potential_energy_J", "potential energy of weight, springs and struts (J)",
        [](const RestConfiguration& c) { return c.potential; });
    for (std::size_t k = 0; k < s_.linkage.stops.size(); ++k) {
      if (s_.linkage.stops[k].stiffness) continue;
      const std::string name = stop_name(s_.linkage, k);
      add(identifier(name) + (is_on_pin(k) ? "_torque_N_m" : "_force_N"),
          name + (is_on_pin(k) ? " torque (N m)" : " force (N)"),
          [k](const RestConfiguration& c) { return c.stops[k]; });
    }
    result_.tables.push_back(std::move(table));
  }

  bool is_on_pin(std::size_t stop) const {
    return s_.linkage.joints[at(s_.linkage.stops[stop].joint)].type == JointType::revolute;
  }

  void draw() {
    LinkageMotion motion(s_.plan);
    LinkageForces forces;
    std::vector<LinkageRecord> records;
    std::vector<InputMotion> inputs;
    for (const double value : s_.grid->inputs) inputs.push_back({value, 0, 0});
    for (std::size_t i = 0; i < found_.found.size(); ++i) {
      for (std::size_t j = 0; j < count(); ++j) inputs[input(j)].value = found_.found[i].values[j];
      motion.stops.clear();
      solve_motion(s_.plan, inputs, motion);
      std::vector<double> efforts = found_.found[i].stops;
      for (std::size_t k = 0; k < efforts.size(); ++k)
        if (s_.linkage.stops[k].stiffness) efforts[k] = stop_effort(s_.linkage, s_.plan, motion, k);
      motion.stops = std::move(efforts);
      solve_forces(s_.linkage, s_.plan, motion, 0, inputs[0].value, forces);
      records.push_back(record_of(s_.linkage, s_.plan, motion, &forces, static_cast<double>(i + 1)));
    }
    if (!records.empty())
      result_.scenes.push_back(
          linkage_scene(s_.linkage, s_.plan, records, s_.traces, "rest_position", "rest position"));
  }

  Sentence place(const RestConfiguration& c) const {
    Sentence out;
    for (std::size_t j = 0; j < count(); ++j)
      out += say("{}{} {}", j ? ", " : "", input_joint(s_.linkage, input(j)).name,
                 study::angle_or_length(c.values[j], s_.plan.rotary[input(j)], 6));
    return out;
  }
  Sentence frequencies(const RestConfiguration& c) const {
    Sentence out;
    for (const std::complex<double> v : c.vibrations) {
      out += say("{}{}", out.empty() ? "" : ", ", measured("Hz", frequency_of(v), 5));
      if (damping_ratio_of(v) > 1e-9)
        out += say(" with the damping ratio {}", plain_number(damping_ratio_of(v)));
    }
    return out;
  }

  void facts() {
    const study::AddFact fact{result_.facts};
    for (std::size_t i = 0; i < found_.found.size(); ++i) {
      const RestConfiguration& c = found_.found[i];
      Sentence text = say("{}: {}", place(c), name_of(c.kind));
      if (c.kind == RestKind::stable && !c.vibrations.empty()) text += say(", {}", frequencies(c));
      for (std::size_t k = 0; k < c.stops.size(); ++k)
        if (c.stops[k] > 0)
          text += say(", {} pushes with {}", stop_name(s_.linkage, k),
                      study::torque_or_force(c.stops[k], is_on_pin(k), 5));
      fact(fmt::format("rest position {}", i + 1), text);
    }
    fact("search",
         say("{} starts of Newton's method, which cannot say that it has found all", found_.starts));
    report_assumed_masses(s_.linkage, result_);
    const study::AddWarning warn{result_.diagnostics};
    for (const RestConfiguration& c : found_.found)
      if (c.kind == RestKind::flutter) {
        warn(say("at {} small motions swing and grow: flutter, by loads that turn with their bodies",
                 place(c)));
        break;
      }
    for (const LinkageJoint& j : s_.linkage.joints)
      if (loses_power(j)) {
        warn(say("the friction of '{}' is left out: with it the linkage rests in bands about these positions",
                 j.name));
        break;
      }
    result_.statistics["rest_positions"] = static_cast<double>(found_.found.size());
    result_.statistics["stable"] = static_cast<double>(stable());
  }
  std::ptrdiff_t stable() const { return std::count_if(found_.found.begin(), found_.found.end(), stays); }
  // Pressed on stops in all free joints it stays as well.
  static bool stays(const RestConfiguration& c) {
    return c.kind == RestKind::stable || c.kind == RestKind::at_end;
  }

  void headline() {
    if (found_.found.empty()) {
      result_.headline = found_.status == Status::no_assembly
                             ? Sentence("The linkage assembles at no start of the search.")
                             : say("No rest position was found from {} starts.", found_.starts);
      return;
    }
    const auto first = std::find_if(found_.found.begin(), found_.found.end(), stays);
    result_.headline = first == found_.found.end()
                           ? say("None of {} rest positions is stable.", found_.found.size())
                           : say("{} of {} rest positions {} stable, the lowest at {}.", stable(),
                                 found_.found.size(), stable() == 1 ? "is" : "are", place(*first));
  }

  const RestStudy& s_;
  RunContext& context_;
  RestConfigurations found_;
  study::Result result_;
};

}  // namespace

study::Result run_rest_configurations(const RestStudy& study, RunContext& context) {
  return ConfigurationReport(study, context).make();
}

}  // namespace linkwright::planar
