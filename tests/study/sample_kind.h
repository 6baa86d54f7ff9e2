// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "linkwright/core/sentence.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/kind.h"

// A domain small enough to see through: a lever of a length, driven through an angle. Tests of the study line
// run it.
namespace linkwright::study::sample {

enum class Mode { done, no_assembly, wait, fail };
constexpr std::array<EnumName<Mode>, 4> names(Mode) {
  return {{{Mode::done, "done", "runs"},
           {Mode::no_assembly, "no_assembly", "reports a numeric failure"},
           {Mode::wait, "wait", "runs until it is interrupted"},
           {Mode::fail, "fail", "throws"}}};
}

struct Lever {
  Range length{0.1, 1.0};
  Mode mode = Mode::done;
};
template <class Visitor>
void fields(Visitor&& visit, Lever& lever) {
  visit(field::length("length", "of the lever").not_negative().required(), lever.length);
  visit(field::entry("mode", "how the run ends"), lever.mode);
}

struct Angle {
  double to = 1;
};
template <class Visitor>
void fields(Visitor&& visit, Angle& angle) {
  visit(field::angle("to", "last angle").not_negative(), angle.to);
}

inline Result run(const Lever& lever, const Angle& angle, const Common& common, RunContext& context) {
  Result result;
  if (lever.mode == Mode::fail) throw std::runtime_error("the lever broke");
  if (lever.mode == Mode::no_assembly) result.status = Status::no_assembly;
  while (lever.mode == Mode::wait && !context.interrupted())
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  if (lever.mode == Mode::wait) result.status = context.interruption();
  result.headline = "The lever turns";
  result.facts = {{"length", metres(0.4), Fact::Verdict::good}};
  Solution solution;
  solution.label = "lever";
  solution.parameters = {{"length_m", "length", lever.length.upper, lever.length.lower, lever.length.upper}};
  solution.objectives["height_m"] = lever.length.upper * std::sin(angle.to);
  solution.classification["type"] = "lever";
  result.solutions.push_back(solution);
  result.statistics["seeds"] = common.seeds.count;
  Table& table = result.tables.emplace_back();
  table.name = "sweep";
  table.add("angle_rad", "angle (rad)", {0, angle.to / 2, angle.to});
  table.add("height_m", "height (m)", {0, std::nan(""), lever.length.upper * std::sin(angle.to)});
  table.status = {"done", "no_assembly", "done"};
  return result;
}

inline Prepared prepare(ObjectReader& document, const Common& common) {
  Lever lever;
  Angle angle;
  if (auto table = document.table(field::entry("mechanism").required())) table->read(lever);
  if (auto table = document.table("target")) table->read(angle);
  Prepared prepared;
  prepared.canonical["mechanism"] = write_fields(lever);
  prepared.canonical["target"] = write_fields(angle);
  prepared.run = [lever, angle, common](RunContext& context) { return run(lever, angle, common, context); };
  return prepared;
}

inline constexpr const char* example = R"(# linkwright study: a lever
schema = 1
kind = "synthesis"
title = "A lever"

[mechanism]
type = "sample.lever"
length_mm = 400

[target]
type = "angle"
to_deg = 90

[optimiser]
seeds = { first = 1, count = 2 }

[[check]]
quantity = "best.height_mm"
equals = 400
tolerance = 1e-9
)";

inline std::vector<Kind> kinds() {
  Kind lever;
  lever.kind = "synthesis";
  lever.mechanism = "sample.lever";
  lever.target = "angle";
  lever.summary = "Turns a lever.";
  lever.example = example;
  lever.quantities = {{"angle", "of the lever"}, {"height", "of its end"}};
  lever.seeded = true;
  lever.schema = [](SchemaWriter& document) {
    document.property(field::entry("mechanism", "the lever").required(), schema_fields<Lever>());
    document.property(field::entry("target", "where to turn it").required(), schema_fields<Angle>());
  };
  lever.prepare = prepare;
  Kind wheel = lever;
  wheel.kind = "analysis";
  wheel.mechanism = "sample.wheel";
  wheel.target = "";
  wheel.summary = "Turns a wheel.";
  wheel.quantities.clear();
  wheel.seeded = false;
  Kind tip = lever;
  tip.target = "point";
  return {lever, wheel, tip};
}

}  // namespace linkwright::study::sample
