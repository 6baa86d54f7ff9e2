// SPDX-License-Identifier: BSD-3-Clause

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/assembly.h"
#include "linkwright/planar/linkage/limits.h"
#include "linkwright/planar/linkage/modes.h"
#include "linkwright/planar/linkage/quality.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/study/remarks.h"

namespace linkwright::planar {
namespace {

double value_at(const InputSamples& axis, int i) {
  return axis.from + (axis.to - axis.from) * i / (axis.samples - 1);
}

void modes_table(const LinkageStudy& s, const std::vector<double>& inputs, study::Result& result) {
  const AssemblyModes all = assembly_modes(s.plan, inputs);
  Table table{.name = "assembly_modes"};
  const auto add = [&](const std::string& key, const std::string& label, auto&& value) {
    std::vector<double> values;
    for (const AssembledMode& m : all.found) values.push_back(value(m));
    table.add(key, label, std::move(values));
  };
  for (std::size_t g = 0; g < s.plan.groups.size(); ++g)
    if (traits_of(s.plan.groups[g]).has_modes)
      add(group_key(s.plan.groups[g].name) + "_mode", s.plan.groups[g].name + " mode (1 = plus)",
          [g](const AssembledMode& m) { return m.modes[g]; });
  for (std::size_t p = 1; p < s.plan.parts.size(); ++p) {
    const std::string key = group_key(s.plan.parts[p]), &name = s.plan.parts[p];
    add(key + "_x_m", name + " origin x (m)", [p](const AssembledMode& m) { return m.parts[p].origin.x; });
    add(key + "_y_m", name + " origin y (m)", [p](const AssembledMode& m) { return m.parts[p].origin.y; });
    add(key + "_angle_rad", name + " angle (rad)",
        [p](const AssembledMode& m) { return angle_of(m.parts[p].direction); });
  }
  table.status.assign(all.found.size(), "done");
  result.facts.push_back({"assembly modes at the first position", all.text});
  result.tables.push_back(std::move(table));
}
void advantage_table(const LinkageStudy& s, const InputSamples& axis, LinkageAssembly& assembly,
                     LinkageMotion& motion, study::Result& result) {
  const int joint = joint_index(s.linkage, s.quality.output_joint);
  Table table{.name = "advantage"};
  std::vector<double> input, rate, force;
  for (int i = 0; i < axis.samples; ++i) {
    input.push_back(value_at(axis, i));
    assembly.place(std::vector<InputMotion>{{input.back(), 0, 0}}, motion);
    const Advantage a = advantage(s.linkage, s.plan, 0, joint, motion);
    rate.push_back(a.rate_ratio);
    force.push_back(std::isfinite(a.force_ratio) ? a.force_ratio : nan);
    table.status.emplace_back(to_string(motion.status));
  }
  table.add(input_key(s.linkage, s.plan, 0), input_label(s.linkage, s.plan, 0), std::move(input));
  table.add("rate_ratio", "rate of " + s.quality.output_joint + " over that of the input", std::move(rate));
  table.add("mechanical_advantage", "force at " + s.quality.output_joint + " over that of the drive",
            std::move(force));
  result.plots.push_back({.name = "rate-ratio",
                          .title = "Rate ratio of " + s.quality.output_joint,
                          .table = "advantage",
                          .x = input_key(s.linkage, s.plan, 0),
                          .y = {"rate_ratio"},
                          .scene = "motion"});
  result.tables.push_back(std::move(table));
}
void centres_table(const LinkageStudy& s, const InputSamples& axis, LinkageAssembly& assembly,
                   LinkageMotion& motion, study::Result& result) {
  Table table{.name = "instant_centres"};
  std::vector<double> input;
  std::vector<std::vector<double>> x, y;
  std::vector<std::string> pairs;
  for (int i = 0; i < axis.samples; ++i) {
    input.push_back(value_at(axis, i));
    const std::vector<InputMotion> in{{input.back(), 1, 0}};
    assembly.place(in, motion);
    solve_velocity(s.plan, in, motion);
    table.status.emplace_back(to_string(motion.status));
    const std::vector<InstantCentre> all = instant_centres(s.plan, motion);
    x.resize(all.size()), y.resize(all.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
      const bool there = motion.status == Status::done && all[k].kind == InstantCentre::Kind::point;
      x[k].push_back(there ? all[k].position.x : nan);
      y[k].push_back(there ? all[k].position.y : nan);
      if (i == 0)
        pairs.push_back(identifier(s.linkage.bodies[at(all[k].first)].name) + "_" +
                        identifier(s.linkage.bodies[at(all[k].second)].name));
    }
  }
  table.add(input_key(s.linkage, s.plan, 0), input_label(s.linkage, s.plan, 0), std::move(input));
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    table.add(pairs[k] + "_x_m", pairs[k] + " instant centre x (m)", std::move(x[k]));
    table.add(pairs[k] + "_y_m", pairs[k] + " instant centre y (m)", std::move(y[k]));
  }
  result.tables.push_back(std::move(table));
}

// Lists the inputs at which the output is at rest along the branch of the study.
void dead_centres_table(const LinkageStudy& s, const InputSamples& axis,
                        const std::optional<BranchPath>& branch, study::Result& result) {
  if (!s.plan.closed_form()) return;
  const std::vector<double> inputs{axis.from};
  const BranchPath path = branch ? *branch
                                 : branch_path(s.plan, inputs, 0, LinkageMotion(s.plan).modes,
                                               std::min(axis.from, axis.to), std::max(axis.from, axis.to));
  const int joint = joint_index(s.linkage, s.quality.output_joint);
  const std::vector<DeadCentre> centres = dead_centres(s.linkage, s.plan, inputs, 0, path, joint);
  Table table{.name = "dead_centres"};
  std::vector<double> input, coordinate;
  Sentence text;
  for (const DeadCentre& c : centres) {
    input.push_back(c.input);
    coordinate.push_back(c.coordinate);
    table.status.emplace_back("done");
    text += (text.empty() ? "at " : ", ") + Sentence(study::angle_or_length(c.input, s.plan.rotary[0], 6));
  }
  const bool slide = s.linkage.joints[at(joint)].type == JointType::prismatic ||
                     s.linkage.joints[at(joint)].type == JointType::pin_in_slot;
  table.add(input_key(s.linkage, s.plan, 0), input_label(s.linkage, s.plan, 0), std::move(input));
  table.add(identifier(s.quality.output_joint) + (slide ? "_displacement_m" : "_angle_rad"),
            s.quality.output_joint + (slide ? " displacement (m)" : " angle (rad)"), std::move(coordinate));
  const study::AddFact fact{result.facts};
  fact("dead centres of " + s.quality.output_joint, text.empty() ? Sentence("none") : text).number =
      count_of(static_cast<double>(centres.size()));
  result.tables.push_back(std::move(table));
}

}  // namespace

void add_limits(const LinkageStudy& s, const InputLimits& limits, study::Result& result) {
  Table table{.name = "ranges"};
  const std::string unit = limits.rotary ? "rad" : "m";
  std::vector<double> circuit, from, to, turns;
  for (const InputRange& r : limits.ranges) {
    circuit.push_back(r.circuit);
    from.push_back(r.from.value);
    to.push_back(r.to.value);
    turns.push_back(r.full_turn);
    table.status.emplace_back("done");
  }
  table.add("circuit", "circuit", std::move(circuit));
  table.add("from_" + unit, "input from (" + unit + ")", std::move(from));
  table.add("to_" + unit, "input to (" + unit + ")", std::move(to));
  table.add("full_turn", "rotates fully (1 = yes)", std::move(turns));
  for (std::size_t g = 0; g < s.plan.groups.size(); ++g) {
    if (!traits_of(s.plan.groups[g]).has_modes) continue;
    std::vector<double> mode;
    for (const InputRange& r : limits.ranges) mode.push_back(r.modes[g]);
    table.add(group_key(s.plan.groups[g].name) + "_mode", s.plan.groups[g].name + " mode (1 = plus)",
              std::move(mode));
  }
  result.tables.push_back(std::move(table));
}

void add_quality(const LinkageStudy& s, const std::optional<BranchPath>& branch, study::Result& result) {
  const InputSamples& axis = std::get<InputGrid>(s.sweep).inputs[0];
  const std::vector<double> inputs{axis.from};
  LinkageAssembly assembly(s.plan, {{std::min(axis.from, axis.to)}, {std::max(axis.from, axis.to)}},
                           s.at_change_point);
  LinkageMotion motion(s.plan);
  if (!s.quality.output_joint.empty()) {
    advantage_table(s, axis, assembly, motion, result);
    dead_centres_table(s, axis, branch, result);
  }
  // Centrodes are followed from the first position.
  assembly.place(std::vector<InputMotion>{{axis.from, 0, 0}}, motion);
  for (const std::string& body : s.quality.centrodes) {
    Table table = centrodes(s.plan, inputs, 0, axis.from, axis.to, at(axis.samples),
                            body_index(s.linkage, body), 0, motion);
    table.name = "centrodes-" + identifier(body);
    result.plots.push_back({.name = table.name,
                            .title = "Fixed centrode of " + body,
                            .table = table.name,
                            .x = table.columns[0].key,
                            .y = {"fixed_x_m", "fixed_y_m"},
                            .style = study::Plot::Style::polar});
    result.tables.push_back(std::move(table));
  }
  if (s.quality.instant_centres) centres_table(s, axis, assembly, motion, result);
  if (s.quality.assembly_modes) modes_table(s, inputs, result);
}

}  // namespace linkwright::planar
