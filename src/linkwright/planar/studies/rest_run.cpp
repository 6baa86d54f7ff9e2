// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/planar/simulation/static_forces.h"
#include "linkwright/planar/studies/linkage_scene.h"
#include "linkwright/planar/studies/rest.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

class RestReport {
 public:
  RestReport(const RestStudy& study, RunContext& context)
      : s_(study),
        context_(context),
        free_(study.search.free),
        rotary_(study.plan.rotary[free_]),
        key_(input_key(s_.linkage, s_.plan, free_)),
        label_(input_label(s_.linkage, s_.plan, free_)),
        name_(input_joint(s_.linkage, free_).name) {}

  study::Result make() {
    found_ = rest_positions(s_.linkage, s_.plan, s_.search, &context_);
    result_.status = found_.status;
    if (found_.ranges.empty()) {
      result_.headline = found_.status == Status::no_assembly ? "The linkage assembles nowhere in the range."
                                                              : "Stopped before a rest position was found.";
      return std::move(result_);
    }
    const bool loses = std::any_of(s_.linkage.joints.begin(), s_.linkage.joints.end(), loses_power);
    has_bands_ = loses && s_.plan.inputs() == 1;
    if (has_bands_) bands_ = rest_bands(s_.linkage, s_.plan, found_, &context_);
    if (s_.unloaded) paths_ = load_paths(s_.linkage, *s_.unloaded, s_.plan, s_.search, found_);
    position_table();
    if (!bands_.empty()) band_table();
    range_tables();
    path_tables();
    draw();
    facts();
    headline();
    return std::move(result_);
  }

 private:
  Measured place(double value, int digits = 6) const {
    return study::angle_or_length(value, rotary_, digits);
  }
  Measured force_text(double value, int digits = 5) const {
    return study::torque_or_force(value, rotary_, digits);
  }
  std::string force_key() const { return rotary_ ? "torque_N_m" : "force_N"; }
  std::string force_label() const {
    return fmt::format("{} of weight, springs and loads on {}", rotary_ ? "torque (N m)" : "force (N)",
                       name_);
  }
  // The name of a range where there are several: its number.
  static std::string numbered(std::string_view name, std::size_t range) {
    return range == 0 ? std::string(name) : fmt::format("{}_{}", name, range + 1);
  }

  template <class Number>
  std::vector<double> of_positions(const Number& number) const {
    std::vector<double> out;
    for (const RestPosition& p : found_.positions) out.push_back(static_cast<double>(number(p)));
    return out;
  }

  // True if it is pressed on the stop of a pin.
  bool is_on_pin(const RestPosition& p) const {
    return p.stop >= 0 &&
           s_.linkage.joints[at(s_.linkage.stops[at(p.stop)].joint)].type == JointType::revolute;
  }

  void position_table() {
    Table table{.name = "rest"};
    for (const RestPosition& p : found_.positions) table.names.emplace_back(name_of(p.kind));
    const auto add = [&](std::string key, std::string label, const auto& number) {
      table.add(std::move(key), std::move(label), of_positions(number));
    };
    add(key_, label_, [](const RestPosition& p) { return p.value; });
    add("stable", "1 if stable", [](const RestPosition& p) { return p.kind == RestKind::stable; });
    add(rotary_ ? "stiffness_N_m_per_rad" : "stiffness_N_per_m",
        fmt::format("stiffness ({})", rotary_ ? "N m/rad" : "N/m"),
        [](const RestPosition& p) { return p.stiffness; });
    add(rotary_ ? "inertia_kg_m2" : "mass_kg", rotary_ ? "reduced inertia (kg m2)" : "reduced mass (kg)",
        [](const RestPosition& p) { return p.mass; });
    add("frequency_Hz", "natural frequency (Hz)", [](const RestPosition& p) { return p.frequency(); });
    add("damping_ratio", "damping ratio", [](const RestPosition& p) { return p.damping_ratio(); });
    add("potential_energy_J", "potential energy of weight, springs and struts (J)",
        [](const RestPosition& p) { return p.potential; });
    add(force_key(), force_label(), [](const RestPosition& p) { return p.force; });
    if (std::any_of(found_.positions.begin(), found_.positions.end(),
                    [](const RestPosition& p) { return p.stop >= 0; })) {
      add("stop_torque_N_m", "torque of the stop (N m)",
          [this](const RestPosition& p) { return is_on_pin(p) ? p.stop_effort : nan; });
      add("stop_force_N", "force of the stop, of a pin at its arm (N)", [this](const RestPosition& p) {
        if (p.stop < 0) return nan;
        const double arm = is_on_pin(p) ? s_.linkage.stops[at(p.stop)].arm : 1;
        return arm > 0 ? p.stop_effort / arm : nan;
      });
    }
    add("range", "number of the range", [](const RestPosition& p) { return p.range + 1; });
    result_.tables.push_back(std::move(table));
  }

  void band_table() {
    std::vector<double> from, to, range;
    for (const RestBand& b : bands_) {
      from.push_back(b.from);
      to.push_back(b.to);
      range.push_back(static_cast<double>(b.range + 1));
    }
    const std::string unit = rotary_ ? "rad" : "m";
    Table table{.name = "bands"};
    table.add("from_" + unit, fmt::format("{}: friction holds from ({})", name_, unit), std::move(from));
    table.add("to_" + unit, fmt::format("{}: friction holds up to ({})", name_, unit), std::move(to));
    table.add("range", "number of the range", std::move(range));
    result_.tables.push_back(std::move(table));
  }

  // Beyond what loads of practice are, the curve only flattens the rest.
  void path_tables() {
    constexpr double most = 20;
    for (std::size_t r = 0; r < paths_.size(); ++r) {
      const LoadPath& path = paths_[r];
      Table table{.name = numbered("load_path", r)};
      std::vector<double> value, factor, stable;
      for (std::size_t i = 0; i < path.value.size(); ++i) {
        if (!(std::abs(path.factor[i]) <= most)) continue;
        value.push_back(path.value[i]);
        factor.push_back(path.factor[i]);
        stable.push_back(path.stable[i]);
      }
      if (value.empty()) continue;
      table.add(key_, label_, std::move(value));
      table.add("load_factor", fmt::format("multiple of {} with which it rests there", s_.load),
                std::move(factor));
      table.add("stable", "1 if stable", std::move(stable));
      result_.tables.push_back(std::move(table));
      const std::string where = paths_.size() == 1 ? std::string() : fmt::format(", range {}", r + 1);
      const study::AddPlot plot{result_, {.table = numbered("load_path", r), .x = key_}};
      plot(numbered("load-path", r), fmt::format("Multiple of {} with which it rests{}", s_.load, where),
           {"load_factor"});
    }
  }

  void path_facts(const study::AddFact& fact) const {
    int count = 0;
    for (const LoadPath& path : paths_)
      for (const LoadPath::Way& way : path.ways) {
        const std::string label = fmt::format("as the load grows {}", ++count);
        const Sentence start = say("from {} without {} to {}", place(way.from, 8), s_.load, place(way.to, 8));
        const Measured share = plain_number(way.factor, 6);
        fact(label, way.snaps    ? say("{}, where it snaps with {} of the load", start, share)
                    : way.leaves ? say("{}, the end of the range, with {} of the load", start, share)
                                 : say("{} with all of it", start));
      }
  }

  void range_tables() {
    for (std::size_t r = 0; r < found_.ranges.size(); ++r) {
      const RestRange& range = found_.ranges[r];
      Table table{.name = numbered("forces", r)};
      table.add(key_, label_, range.value);
      table.add(force_key(), force_label(), range.force);
      table.add("potential_energy_J", "potential energy of weight, springs and struts (J)", range.potential);
      result_.tables.push_back(std::move(table));
      const std::string where = found_.ranges.size() == 1 ? std::string() : fmt::format(", range {}", r + 1);
      const study::AddPlot plot{result_, {.table = numbered("forces", r), .x = key_}};
      plot(numbered("force", r),
           fmt::format("{} of weight, springs and loads{}", rotary_ ? "Torque" : "Force", where),
           {force_key()});
      plot(numbered("potential-energy", r), "Potential energy" + where, {"potential_energy_J"});
    }
  }

  // The linkage in each rest position, with its joint forces.
  void draw() {
    StaticForces placed(s_.linkage, s_.plan, {free_});
    std::optional<LinkageAssembly> assembly;
    if (!s_.plan.closed_form()) {
      const std::vector<double>& values = found_.ranges.front().value;
      assembly.emplace(s_.plan, InputReach{{values.front()}, {values.back()}});
    }
    LinkageForces forces;
    std::vector<LinkageRecord> records;
    std::vector<InputMotion> inputs;
    for (const double value : s_.search.inputs) inputs.push_back({value, 0, 0});
    const auto record = [&](double value, const std::vector<double>& modes) {
      inputs[free_].value = value;
      LinkageMotion& motion = placed.motion;
      if (s_.plan.closed_form()) motion.modes = modes;
      if (assembly) {
        assembly->place(inputs, motion);
        if (motion.status == Status::done) solve_velocity(s_.plan, inputs, motion);
        if (motion.status == Status::done) solve_acceleration(s_.plan, inputs, motion);
      } else {
        solve_motion(s_.plan, inputs, motion);
      }
      solve_forces(s_.linkage, s_.plan, motion, 0, inputs[0].value, forces);
      records.push_back(record_of(s_.linkage, s_.plan, motion, &forces, value));
    };
    for (const RestPosition& p : found_.positions) record(p.value, found_.ranges[p.range].modes);
    if (found_.positions.empty()) {
      const RestRange& range = found_.ranges.front();
      record(range.value[range.value.size() / 2], range.modes);
    }
    result_.scenes.push_back(linkage_scene(s_.linkage, s_.plan, records, s_.traces, key_,
                                           name_ + (rotary_ ? " angle" : " displacement")));
  }

  Sentence words(const RestPosition& p) const {
    switch (p.kind) {
      case RestKind::stable:
        if (!(p.mass > 0)) return say("stable, stiffness {}", stiffness(p));
        return p.damping > 0
                   ? say("stable, {}, damping ratio {}, stiffness {}", measured("Hz", p.frequency(), 5),
                         plain_number(p.damping_ratio(), 4), stiffness(p))
                   : say("stable, {}, stiffness {}", measured("Hz", p.frequency(), 5), stiffness(p));
      case RestKind::unstable:
        return say("unstable, stiffness {}", stiffness(p));
      case RestKind::marginal:
        return "marginal: the force touches zero there and has the same sign on both sides";
      case RestKind::at_end:
      case RestKind::flutter:
        break;
    }
    if (p.stop >= 0) {
      const JointStop& stop = s_.linkage.stops[at(p.stop)];
      const LinkageJoint& joint = s_.linkage.joints[at(stop.joint)];
      const bool pin = is_on_pin(p);
      const Measured effort = study::torque_or_force(p.stop_effort, pin, 6);
      return pin && stop.arm > 0 ? say("pressed with {}, {} at its arm, on the stop of {}", effort,
                                       study::torque_or_force(p.stop_effort / stop.arm, false, 8), joint.name)
                                 : say("pressed with {} on the stop of {}", effort, joint.name);
    }
    return say("pressed with {} against the end of the range", force_text(std::abs(p.force)));
  }
  Measured stiffness(const RestPosition& p) const {
    return measured(rotary_ ? "N_m_per_rad" : "N_per_m", p.stiffness, 5);
  }

  void facts() {
    const study::AddFact fact{result_.facts};
    const study::AddWarning warn{result_.diagnostics};
    for (std::size_t i = 0; i < found_.positions.size(); ++i) {
      const RestPosition& p = found_.positions[i];
      const bool many = found_.ranges.size() > 1;
      fact(fmt::format("rest position {}{}", i + 1, many ? fmt::format(", range {}", p.range + 1) : ""),
           say("{}: {}", place(p.value), words(p)));
    }
    for (std::size_t r = 0; r < found_.ranges.size(); ++r) {
      const RestRange& range = found_.ranges[r];
      Sentence text = range.full_turn
                          ? say("{} turns fully", name_)
                          : say("{} to {}", place(range.from).spelled(), place(range.to).spelled());
      if (found_.ranges.size() > 1 && s_.search.all_modes)
        text += say("; {}", mode_text(s_.plan, range.modes));
      fact(found_.ranges.size() == 1 ? std::string("range") : fmt::format("range {}", r + 1), text);
      if (range.dead_below || range.dead_above)
        warn(
            say("the range ends at {}, a dead point of {}: the linkage moves on in its other assembly mode",
                place(range.dead_below ? range.from : range.to), name_),
            "rest positions beyond it are found with another joint as the free one, or with modes = \"all\"");
    }
    path_facts(fact);
    for (const RestBand& b : bands_)
      fact(bands_.size() == 1 ? std::string("held by friction")
                              : fmt::format("held by friction {}", &b - bands_.data() + 1),
           say("from {} to {}, wherever it is left there", place(b.from, 8), place(b.to, 8)));
    report_assumed_masses(s_.linkage, result_);
    for (const LinkageJoint& j : s_.linkage.joints)
      if (!has_bands_ && loses_power(j)) {
        warn(say("the friction of '{}' is left out: with it the linkage rests in bands about these positions",
                 j.name));
        break;
      }
    const auto stable = std::count_if(found_.positions.begin(), found_.positions.end(),
                                      [](const RestPosition& p) { return p.kind == RestKind::stable; });
    result_.statistics["rest_positions"] = static_cast<double>(found_.positions.size());
    result_.statistics["stable"] = static_cast<double>(stable);
  }

  void headline() {
    const bool balanced = std::all_of(found_.ranges.begin(), found_.ranges.end(),
                                      [](const RestRange& range) { return range.balanced; });
    if (balanced) {
      result_.headline = "The linkage is balanced: it rests in every position.";
      return;
    }
    if (found_.positions.empty()) {
      const RestRange& range = found_.ranges.front();
      const auto [least, most] = std::minmax_element(range.force.begin(), range.force.end());
      result_.headline = say("Nothing rests from {} to {}: the {} goes from {} to {}.",
                             place(range.value.front()).spelled(), place(range.value.back()).spelled(),
                             rotary_ ? "torque" : "force", force_text(*least), force_text(*most));
      study::AddWarning{result_.diagnostics}("no rest position was found", "add a stop, or a spring");
      return;
    }
    Sentence stable, ends;
    std::size_t count = 0;
    for (const RestPosition& p : found_.positions) {
      if (p.kind == RestKind::at_end) ends += say("{}{}", ends.empty() ? "" : " and ", place(p.value));
      if (p.kind != RestKind::stable || ++count > 4) continue;
      stable +=
          say("{}{}", stable.empty() ? "" : ", ",
              std::isnan(p.frequency()) ? Sentence(place(p.value))
                                        : say("{} with {}", place(p.value), measured("Hz", p.frequency())));
    }
    if (stable.empty() && ends.empty())
      result_.headline =
          say("No rest position is stable; there are {} of other kinds.", found_.positions.size());
    else if (stable.empty())
      result_.headline = say("{} rests at the ends of its range alone, at {}.", name_, ends);
    else
      result_.headline = say("{} rests stably at {}{}{}.", name_, stable, count > 4 ? " and more" : "",
                             ends.empty() ? Sentence() : say(", and at the ends of its range at {}", ends));
  }

  const RestStudy& s_;
  RunContext& context_;
  const std::size_t free_;
  const bool rotary_;
  const std::string key_, label_, name_;
  RestPositions found_;
  std::vector<RestBand> bands_;  // of a linkage with one input and friction
  bool has_bands_ = false;
  std::vector<LoadPath> paths_;  // of the load, one a range
  study::Result result_;
};

}  // namespace

study::Result run_rest(const RestStudy& study, RunContext& context) {
  return RestReport(study, context).make();
}

}  // namespace linkwright::planar
