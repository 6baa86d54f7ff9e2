// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <string>

#include "linkwright/planar/linkage/limits.h"
#include "linkwright/planar/linkage/scan.h"
#include "linkwright/planar/studies/speed_fluctuation.h"
#include "linkwright/planar/studies/templates.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::planar {

template <class Visitor>
void fields(Visitor&& visit, SpeedFluctuationSetup& s) {
  visit(field::speed_angular("mean_speed", "of the input, a turn over its time; negative: backwards")
            .required(),
        s.mean_speed);
  visit(field::angle("start", "of the input where the cycle begins"), s.start);
  visit(field::entry("fluctuation", "wanted (largest - least) / mean of the speed; a flywheel makes it so")
            .between(1e-6, 1),
        s.fluctuation);
  visit(field::entry("samples", "of a turn").between(16, 100000), s.samples);
}

namespace {

study::Prepared prepare_fluctuation(study::ObjectReader& document, const study::Common& common,
                                    LinkageType type) {
  study::Prepared prepared;
  SpeedFluctuationStudy s;
  auto description = read_linkage(document, type, true, common.units);
  if (auto table = document.table(field::entry("speed_fluctuation").required())) {
    table->read(s.setup);
    if (s.setup.mean_speed == 0)
      table->error("mean_speed", "a machine at rest has no cycle", "give its speed");
  }
  if (!description) return prepared;
  const Linkage& l = description->linkage;
  if (description->plan.inputs() != 1 || !description->plan.closed_form() || !periodic(description->plan, 0))
    document.error("mechanism",
                   "a speed fluctuation needs one input that turns, in a linkage of pairs with closed forms",
                   "take kind = \"simulation\" for others");
  const auto by_time = [&](const char* list, const auto& loads) {
    for (const auto& load : loads)
      if (goes_by(load, LoadArgument::time))
        document.error("mechanism",
                       fmt::format("{} '{}' goes by time, which a cycle does not have", list, load.name),
                       "let it go by input");
  };
  by_time("force", l.forces);
  by_time("torque", l.torques);
  by_time("strut", l.struts);
  if (const std::string load = load_by_joint(l); !load.empty() && !l.counted_pins.empty())
    document.error(
        "mechanism",
        fmt::format("the formula of '{}' names the angle of a pin, which rises from cycle to cycle", load),
        "let it go by the places of points, x(\"body.point\"), or by a table with against = \"input\"");
  if (!l.stops.empty())
    document.error("mechanism", "the joints of a cycle have no stops",
                   "leave them out, or take kind = \"simulation\"");
  Value drive;
  if (!l.driven.empty()) drive["joint"] = input_joint(l, 0).name;
  write_linkage(*description, prepared.canonical);
  prepared.canonical["drive"] = Value(Value::Array{std::move(drive)});
  prepared.canonical["speed_fluctuation"] = study::write_fields(s.setup);
  s.has_motor = std::any_of(l.torques.begin(), l.torques.end(),
                            [](const BodyTorque& t) { return goes_by(t, LoadArgument::speed); });
  s.linkage = std::move(description->linkage);
  s.plan = std::move(description->plan);
  s.traces = std::move(description->traces);
  prepared.run = [s = std::move(s)](RunContext& context) { return run_speed_fluctuation(s, context); };
  return prepared;
}

study::Kind fluctuation_kind(LinkageType type) {
  study::Kind kind;
  kind.kind = "speed_fluctuation";
  kind.schema = [type](study::SchemaWriter& document) {
    describe_linkage(document, type);
    study::SchemaWriter drive;
    drive(field::entry("joint", "joint of the input"), std::string());
    describe_drives(document, "the input that turns", std::move(drive));
    document.property(field::entry("speed_fluctuation",
                                   "the cycle and the coefficient of speed fluctuation that it may have")
                          .required(),
                      study::schema_fields<SpeedFluctuationSetup>());
  };
  kind.prepare = [type](study::ObjectReader& document, const study::Common& common) {
    return prepare_fluctuation(document, common, type);
  };
  return kind;
}

}  // namespace

study::Kind linkage_speed_fluctuation_kind() {
  study::Kind kind = fluctuation_kind(LinkageType::linkage);
  kind.mechanism = "planar.linkage";
  kind.summary =
      "speed fluctuation of a planar linkage whose input rotates fully: reduced inertia, flywheel, cycle "
      "with a motor";
  kind.example = templates::speed_fluctuation_linkage();
  return kind;
}

study::Kind four_bar_speed_fluctuation_kind() {
  study::Kind kind = fluctuation_kind(LinkageType::four_bar);
  kind.mechanism = "planar.four_bar";
  kind.summary = "speed fluctuation of a four-bar whose crank rotates fully: reduced inertia and flywheel";
  kind.example = templates::speed_fluctuation_four_bar();
  return kind;
}

study::Kind slider_crank_speed_fluctuation_kind() {
  study::Kind kind = fluctuation_kind(LinkageType::slider_crank);
  kind.mechanism = "planar.slider_crank";
  kind.summary = "speed fluctuation of a slider-crank that rotates fully: reduced inertia and flywheel";
  kind.example = templates::speed_fluctuation_slider_crank();
  return kind;
}

}  // namespace linkwright::planar
