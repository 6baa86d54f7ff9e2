// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/simulation/balance.h"
#include "linkwright/planar/simulation/coordinates.h"
#include "linkwright/planar/studies/linkage_scene.h"
#include "linkwright/planar/studies/simulation.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

class SimulationRunner {
 public:
  SimulationRunner(const LinkageSimulationStudy& s, RunContext& context) : s_(s), context_(context) {
    columns_ = driven_columns(s.linkage, s.plan, s.quantities, s.traces, s.drives);
    for (std::size_t j = 0; j < s.linkage.joints.size(); ++j)
      if (has_friction(s.linkage.joints[j])) rubbing_.push_back(j);
    senses_.resize(rubbing_.size());
  }

  study::Result run() {
    integrate();
    finish_table();
    friction_table();
    stop_table();
    result_.scenes.push_back(linkage_scene(s_.linkage, s_.plan, recorded_, s_.traces, "time_s", "time"));
    plots();
    facts();
    headline();
    return std::move(result_);
  }

 private:
  bool is_free(std::size_t k) const { return !s_.drives[k].law; }

  void integrate() {
    std::vector<double> times;
    for (int i = 0; i < s_.samples; ++i)
      times.push_back(i + 1 == s_.samples ? s_.to : s_.from + (s_.to - s_.from) * i / (s_.samples - 1));
    inputs_.resize(3 * s_.plan.inputs());
    values_.resize(columns_.size());
    const SimulationOutput row = [&](const SimulationInstant& now) { return add(now); };
    const auto route = s_.route == SimulationRoute::free_joints ? simulate : simulate_all_coordinates;
    report_ = route(s_.linkage, s_.plan, s_.drives, times, s_.options, row, &context_);
    result_.status = report_.status;
  }

  bool add(const SimulationInstant& now) {
    const bool dynamic = s_.quantities.dynamic() && now.status == Status::done;
    if (dynamic) solve_forces(s_.linkage, s_.plan, now, forces_);
    const Status status = dynamic ? forces_.status : now.status;
    times_.push_back(now.time);
    statuses_.push_back(status);
    for (std::size_t k = 0; k < now.inputs.size(); ++k) {
      inputs_[3 * k].push_back(now.inputs[k].value);
      inputs_[3 * k + 1].push_back(now.inputs[k].rate);
      inputs_[3 * k + 2].push_back(now.inputs[k].acceleration);
    }
    kinetic_.push_back(now.kinetic);
    potential_.push_back(now.potential);
    work_.push_back(now.work);
    loss_.push_back(now.friction_loss);
    for (std::size_t i = 0; i < rubbing_.size() && !now.friction_senses.empty(); ++i)
      senses_[i].push_back(now.friction_senses[rubbing_[i]]);
    drift_.push_back(now.drift);
    const LinkageInstant instant{now.time, {now.inputs.begin(), now.inputs.end()}, now.motion, &forces_};
    for (std::size_t c = 0; c < columns_.size(); ++c)
      values_[c].push_back(now.status == Status::done ? columns_[c].value(instant) : nan);
    recorded_.push_back(record_of(s_.linkage, s_.plan, *now.motion, dynamic ? &forces_ : nullptr, now.time));
    if (now.status == Status::done) closure_ = std::max(closure_, now.motion->closure_residual);
    return true;
  }

  void finish_table() {
    Table table{.name = "motion"};
    table.add("time_s", "time (s)", times_);
    add_input_columns(table, s_.linkage, s_.plan, inputs_);
    table.add("kinetic_energy_J", "kinetic energy (J)", kinetic_);
    table.add("potential_energy_J", "potential energy of weight and springs (J)", potential_);
    table.add("work_J", "work of drives and loads (J)", work_);
    table.add("energy_drift_J", "energy drift (J)", drift_);
    if (!rubbing_.empty()) table.add("friction_loss_J", "energy taken by friction (J)", loss_);
    for (std::size_t i = 0; i < rubbing_.size(); ++i) {
      const std::string& name = s_.linkage.joints[rubbing_[i]].name;
      table.add(identifier(name) + "_friction_state", name + " friction state (1, -1 slides, 0 sticks)",
                senses_[i]);
    }
    for (std::size_t c = 0; c < columns_.size(); ++c) {
      unwrap(columns_[c], values_[c]);
      table.add(columns_[c].key, columns_[c].label, std::move(values_[c]));
    }
    for (const Status s : statuses_) table.status.emplace_back(to_string(s));
    result_.tables.push_back(std::move(table));
  }

  // The changes of the joints with friction, in their order.
  void friction_table() {
    if (report_.friction_events.empty()) return;
    Table table{.name = "friction"};
    std::vector<double> times, angles, displacements, states;
    for (const FrictionEvent& e : report_.friction_events) {
      const LinkageJoint& j = s_.linkage.joints[at(e.joint)];
      const bool pin = j.type == JointType::revolute;
      table.names.push_back(fmt::format("{} {}", j.name, name_of(e.change)));
      times.push_back(e.time);
      angles.push_back(pin ? e.value : nan);
      displacements.push_back(pin ? nan : e.value);
      states.push_back(e.sense);
    }
    table.add("time_s", "time (s)", times);
    table.add("joint_angle_rad", "joint angle (rad)", angles);
    table.add("joint_displacement_m", "joint displacement (m)", displacements);
    table.add("friction_state", "friction state from then on (1, -1 slides, 0 sticks)", states);
    result_.tables.push_back(std::move(table));
  }

  // The events of the stops, in their order.
  void stop_table() {
    if (report_.stop_events.empty()) return;
    Table table{.name = "stops"};
    const auto add = [&](const char* key, const char* label, const auto& number) {
      std::vector<double> values;
      for (const StopEvent& e : report_.stop_events) {
        const JointStop& stop = s_.linkage.stops[e.stop];
        const bool pin = s_.linkage.joints[at(stop.joint)].type == JointType::revolute;
        values.push_back(number(e, stop.side, pin));
      }
      table.add(key, label, values);
    };
    for (const StopEvent& e : report_.stop_events)
      table.names.push_back(fmt::format("{} {}", stop_name(s_.linkage, e.stop), name_of(e.change)));
    add("time_s", "time (s)", [](const StopEvent& e, double, bool) { return e.time; });
    add("joint_speed_before_rad_per_s", "joint speed before (rad/s)",
        [](const StopEvent& e, double side, bool pin) { return pin ? side * e.before : nan; });
    add("joint_speed_after_rad_per_s", "joint speed after (rad/s)",
        [](const StopEvent& e, double side, bool pin) { return pin ? side * e.after : nan; });
    add("slide_speed_before_m_per_s", "slide speed before (m/s)",
        [](const StopEvent& e, double side, bool pin) { return pin ? nan : side * e.before; });
    add("slide_speed_after_m_per_s", "slide speed after (m/s)",
        [](const StopEvent& e, double side, bool pin) { return pin ? nan : side * e.after; });
    add("energy_lost_J", "energy lost in the impact (J)",
        [](const StopEvent& e, double, bool) { return e.energy_lost; });
    result_.tables.push_back(std::move(table));
  }

  void plots() {
    const study::AddPlot plot{result_, {.table = "motion", .x = "time_s", .scene = "motion"}};
    const Linkage& l = s_.linkage;
    for (const bool rotary : {true, false}) {
      std::vector<std::string> values, rates;
      for (std::size_t k = 0; k < s_.plan.inputs() && values.size() < 8; ++k)
        if (s_.plan.rotary[k] == rotary) {
          values.push_back(input_key(l, s_.plan, k));
          rates.push_back(identifier(input_joint(l, k).name) +
                          (rotary ? "_joint_speed_rad_per_s" : "_joint_speed_m_per_s"));
        }
      plot(rotary ? "joint-angles" : "joint-displacements", rotary ? "Joint angles" : "Joint displacements",
           values);
      plot(rotary ? "joint-speeds" : "slide-speeds", rotary ? "Joint speeds" : "Slide speeds", rates);
    }
    std::vector<std::string> energies{"kinetic_energy_J", "potential_energy_J", "work_J"};
    if (!rubbing_.empty()) energies.emplace_back("friction_loss_J");
    plot("energies", "Energies", energies);
    plot("energy-audit", "Energy audit: imbalance", {"energy_drift_J"});
    std::vector<std::string> drives, forces, sizes, paths, angles;
    for (std::size_t k = 0; k < s_.plan.inputs() && drives.size() < 6; ++k)
      if (s_.plan.rotary[k]) drives.push_back(identifier(input_joint(l, k).name) + "_drive_torque_N_m");
    for (std::size_t k = 0; k < s_.plan.inputs() && forces.size() < 6; ++k)
      if (!s_.plan.rotary[k]) forces.push_back(identifier(input_joint(l, k).name) + "_drive_force_N");
    for (const LinkageJoint& j : l.joints)
      if (!has_teeth(j.type) && sizes.size() < 8) sizes.push_back(identifier(j.name) + "_N");
    for (const LinkageColumn& c : columns_)
      if (c.angle && angles.size() < 8) angles.push_back(c.key);
    for (const BodyPoint& t : s_.traces) {
      const LinkageBody& b = l.bodies[at(t.body)];
      const std::string key = identifier(b.name) + "_" + identifier(b.points[at(t.point)].name);
      if (!result_.tables[0].find(key + "_x_m")) continue;
      paths.push_back(key + "_x_m");
      paths.push_back(key + "_y_m");
    }
    plot("torque", "Drive torque", drives);
    plot("drive-force", "Drive force", forces);
    plot("angles", "Angles of the bodies", angles);
    plot("reactions", "Joint forces", sizes);
    plot("paths", "Paths of the traced points", paths, study::Plot::Style::polar);
  }

  Measured place(std::size_t k, double value) const { return input_place(s_.linkage, s_.plan, k, value, 6); }
  study::EnergyBalance balance() const { return {report_.largest_drift, report_.peak_energy}; }

  void facts() {
    using Verdict = study::Fact::Verdict;
    const study::AddFact fact{result_.facts};
    const study::AddWarning warn{result_.diagnostics};
    std::size_t free = 0;
    for (std::size_t k = 0; k < s_.drives.size(); ++k) free += is_free(k);
    fact("degrees of freedom",
         say("{}, {} free and {} driven", mobility(s_.linkage), free, s_.drives.size() - free));
    report_assumed_masses(s_.linkage, result_);
    if (!times_.empty()) {
      const bool poor = balance().poor();
      fact("energy balance", balance().text(), poor ? Verdict::bad : Verdict::good);
      if (poor)
        warn("the energies do not balance: " + balance().text(),
             "take a smaller rtol; loads that jump need it");
      fact("closure residual", metres(closure_, 2));
    }
    fact("integration",
         say("{} steps, {} evaluations of the equations of motion", report_.steps, report_.evaluations));
    if (!times_.empty() && in_unstable_balance(s_.linkage, s_.plan, s_.drives, s_.from))
      warn(
          "the linkage starts at rest in unstable balance: rounding decides when it leaves it and to which "
          "side",
          "start it a little beside the balance, or with a small speed");
    if (!rubbing_.empty() && !loss_.empty()) fact("energy taken by friction", measured("J", loss_.back(), 4));
    if (report_.friction_event_count > 0) {
      const FrictionEvent& first = report_.friction_events.front();
      fact("changes of friction", say("{}; the first: {} {} at {}", report_.friction_event_count,
                                      s_.linkage.joints[at(first.joint)].name, name_of(first.change),
                                      at_place("time", seconds(first.time))));
    }
    stop_facts();
    if (const FrictionRests& rests = report_.rests; rests.count > 0) {
      const Sentence first = say("from {} to {}", at_place("from", seconds(rests.first_from, 6)),
                                 at_place("to", seconds(rests.first_to, 6)));
      fact("held by friction", rests.count == 1 ? say("{}, {} in all", first, seconds(rests.total))
                                                : say("{} times, {} in all; the first {}", rests.count,
                                                      seconds(rests.total), first));
    }
    if (!report_.passages.empty()) {
      const ChangePassage& first = report_.passages.front();
      fact("change points",
           say("{}, the first at {} with {} at {} ({} groups); taken: {}", report_.passage_count,
               at_place("time", seconds(first.time)), input_joint(s_.linkage, 0).name, place(0, first.value),
               first.groups.size(), name_of(s_.options.at_change_point)));
      if (s_.options.at_change_point == AtChangePoint::smooth)
        warn(say("the linkage went through {} change points, where it can continue in either assembly mode: "
                 "it went on smoothly",
                 report_.passage_count),
             "simulation.at_change_point = \"stop\" or \"keep_sign\" chooses otherwise");
    }
    if (!times_.empty()) {
      const auto [low, high] = std::minmax_element(inputs_[0].begin(), inputs_[0].end());
      warn_of_held_loads(s_.linkage, s_.plan, *low, *high, warn);
    }
    if (report_.status == Status::at_rest) {
      fact("at rest", report_.message, Verdict::plain);
    } else if (!report_.message.empty()) {
      const bool dead = report_.status == Status::limit_reached && s_.route == SimulationRoute::free_joints &&
                        s_.options.at_change_point != AtChangePoint::stop;
      warn(report_.message,
           dead ? "simulation.route = \"all_coordinates\" passes it, and so does another free joint" : "");
    }
  }

  void stop_facts() {
    if (report_.stop_events.empty()) return;
    const study::AddFact fact{result_.facts};
    const StopEvent& first = report_.stop_events.front();
    fact("changes of stops",
         say("{}; the first: {} {} at {}", report_.stop_event_count, stop_name(s_.linkage, first.stop),
             name_of(first.change), at_place("time", seconds(first.time))));
    double lost = 0;
    for (const StopEvent& e : report_.stop_events) lost += e.energy_lost;
    if (lost > 0) fact("energy lost in impacts", measured("J", lost, 4));
  }

  void headline() {
    if (times_.empty()) {
      result_.headline = "The linkage does not start: " + report_.message + ".";
      return;
    }
    // Time and values are those of the last row, which may be before the instant at which the motion ends.
    Sentence text;
    for (std::size_t k = 0; k < s_.plan.inputs(); ++k)
      if (is_free(k))
        text += say("{}{} goes from {} to {}", text.empty() ? "" : ", ", input_joint(s_.linkage, k).name,
                    place(k, inputs_[3 * k].front()), place(k, inputs_[3 * k].back()));
    result_.headline =
        say("In {} {}; energies balance {}.", seconds(times_.back() - s_.from), text, balance().text());
    if (report_.status == Status::at_rest)
      result_.headline += say(" Then {}.", report_.message);
    else if (report_.status != Status::done)
      result_.headline += say(" It ends before {}: {}.", seconds(s_.to, 6), to_string(report_.status));
  }

  const LinkageSimulationStudy& s_;
  RunContext& context_;
  std::vector<LinkageColumn> columns_;
  std::vector<double> times_, kinetic_, potential_, work_, loss_, drift_;
  std::vector<std::size_t> rubbing_;         // joints with friction
  std::vector<std::vector<double>> senses_;  // their states, one row a joint
  std::vector<std::vector<double>> inputs_, values_;
  std::vector<Status> statuses_;
  std::vector<LinkageRecord> recorded_;
  LinkageForces forces_;
  double closure_ = 0;
  SimulationReport report_;
  study::Result result_;
};

}  // namespace

std::vector<LinkageColumn> driven_columns(const Linkage& l, const LinkagePlan& plan,
                                          const LinkageQuantities& quantities,
                                          const std::vector<BodyPoint>& traces,
                                          std::span<const InputDrive> drives) {
  std::vector<LinkageColumn> columns = linkage_columns(l, plan, quantities, traces);
  std::erase_if(columns, [&](const LinkageColumn& c) {
    for (std::size_t k = 0; k < drives.size(); ++k)
      if (!drives[k].law && c.key.starts_with(identifier(input_joint(l, k).name) + "_drive_")) return true;
    return false;
  });
  return columns;
}

void add_input_columns(Table& table, const Linkage& l, const LinkagePlan& plan,
                       const std::vector<std::vector<double>>& values) {
  for (std::size_t k = 0; k < plan.inputs(); ++k) {
    const bool rotary = plan.rotary[k];
    const std::string& name = input_joint(l, k).name;
    const char *rate = rotary ? "rad_per_s" : "m_per_s", *unit = rotary ? "rad/s" : "m/s";
    table.add(input_key(l, plan, k), input_label(l, plan, k), values[3 * k]);
    table.add(fmt::format("{}_joint_speed_{}", identifier(name), rate),
              fmt::format("{} joint speed ({})", name, unit), values[3 * k + 1]);
    table.add(fmt::format("{}_joint_acceleration_{}2", identifier(name), rate),
              fmt::format("{} joint acceleration ({}2)", name, unit), values[3 * k + 2]);
  }
}

study::Result run_linkage_simulation(const LinkageSimulationStudy& study, RunContext& context) {
  return SimulationRunner(study, context).run();
}

}  // namespace linkwright::planar
