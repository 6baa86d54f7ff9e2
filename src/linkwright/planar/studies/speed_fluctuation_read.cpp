#include <fmt/core.h>

#include <algorithm>

#include "linkwright/planar/linkage/branch.h"
#include "linkwright/planar/studies/speed_fluctuation.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"

namespace linkwright::planar {

template <class Visitor>
void fields(Visitor&& visit, SpeedFluctuationSetup& s) {
  visit(Field{.key = "mean_speed",
              .summary = "of the input, a turn over its time; negative: backwards",
              .dimension = Dimension::speed_angular,
              .minimum = -1e6,
              .maximum = 1e6,
              .required = true},
        s.mean_speed);
  visit(linkage_fields::angle("start", "of the input where the cycle begins"), s.start);
  visit(Field{.key = "fluctuation",
              .summary = "wanted (largest - least) / mean of the speed; a flywheel makes it so",
              .minimum = 1e-6,
              .maximum = 1},
        s.fluctuation);
  visit(Field{.key = "samples", .summary = "of the cycle", .minimum = 16, .maximum = 100000}, s.samples);
}

namespace {

study::Prepared prepare(study::ObjectReader& document, LinkageType type) {
  study::Prepared prepared;
  SpeedFluctuationStudy s;
  auto description = read_linkage(document, type, true);
  if (auto table = document.table(Field{.key = "speed_fluctuation", .summary = {}, .required = true})) {
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
      if (load.factor.against == LoadArgument::time)
        document.error("mechanism",
                       fmt::format("{} '{}' goes by time, which a cycle does not have", list, load.name),
                       "let it go by input");
  };
  by_time("force", l.forces);
  by_time("torque", l.torques);
  Value drive;
  if (!l.driven.empty()) drive["joint"] = input_joint(l, 0).name;
  write_linkage(*description, prepared.canonical);
  prepared.canonical["drive"] = Value(Value::Array{std::move(drive)});
  prepared.canonical["speed_fluctuation"] = study::write_fields(s.setup);
  s.has_motor = std::any_of(l.torques.begin(), l.torques.end(),
                            [](const BodyTorque& t) { return t.factor.against == LoadArgument::speed; });
  s.linkage = std::move(description->linkage);
  s.plan = std::move(description->plan);
  s.traces = std::move(description->traces);
  prepared.run = [s = std::move(s)](RunContext& context) { return run_speed_fluctuation(s, context); };
  return prepared;
}

study::Kind kind_of(LinkageType type) {
  study::Kind kind;
  kind.kind = "speed_fluctuation";
  kind.schema = [type](study::SchemaWriter& document) {
    describe_linkage(document, type);
    study::SchemaWriter drive;
    drive(Field{.key = "joint", .summary = "joint of the input"}, std::string());
    document.property(Field{.key = "drive", .summary = "the input that turns"},
                      study::schema_array(std::move(drive).finish()));
    document.property(Field{.key = "speed_fluctuation",
                            .summary = "the cycle and the coefficient of speed fluctuation that it may have",
                            .required = true},
                      study::schema_fields<SpeedFluctuationSetup>());
  };
  kind.prepare = [type](study::ObjectReader& document, const study::Common&) {
    return prepare(document, type);
  };
  return kind;
}

}  // namespace

study::Kind linkage_speed_fluctuation_kind() {
  study::Kind kind = kind_of(LinkageType::linkage);
  kind.mechanism = "planar.linkage";
  kind.summary =
      "speed fluctuation of a planar linkage whose input rotates fully: reduced inertia, flywheel, cycle "
      "with a motor";
  kind.example = R"(# linkwright study: flywheel and motor of a planar linkage
schema = 1
kind   = "speed_fluctuation"
title  = "Flywheel of my press"

[mechanism]
type = "planar.linkage"

# The first body is the ground. Points are in the frame of the body.
[[mechanism.body]]
name      = "ground"
points_mm = { O = [0, 0] }

[[mechanism.body]]
name          = "crank"
points_mm     = { O = [0, 0], A = [40, 0] }
mass_kg       = 6.0                 # inertia and centre: those of a uniform bar unless given
inertia_kg_m2 = 0.1

[[mechanism.body]]
name      = "rod"
points_mm = { A = [0, 0], B = [200, 0] }
mass_kg   = 4.0

[[mechanism.body]]
name      = "ram"
points_mm = { B = [0, 0] }
mass_kg   = 8.0

[[mechanism.joint]]
name   = "O"
first  = "ground.O"
second = "crank.O"

[[mechanism.joint]]
name   = "A"
first  = "crank.A"
second = "rod.A"

[[mechanism.joint]]
name   = "B"
first  = "rod.B"
second = "ram.B"

[[mechanism.joint]]
name   = "guide"
type   = "prismatic"
first  = "ground.O"
second = "ram.B"

[[mechanism.assembly]]
bodies = ["rod", "ram"]
mode   = "plus"

# The press works over the last part of the stroke: a factor over the input angle, in rad.
[[mechanism.force]]
name     = "press"
point    = "ram.B"
force_N  = [-2000, 0]
against  = "input"
argument = [0.0, 5.0, 5.2, 6.2, 6.2831853]
factor   = [0.0, 0.0, 1.0, 1.0, 0.0]

# The motor: torque over the speed of the crank, in rad/s. Leave it out to size the flywheel alone.
[[mechanism.torque]]
name       = "motor"
body       = "crank"
torque_N_m = 400.0
against    = "speed"
argument   = [0.0, 15.0, 20.0]
factor     = [0.9, 1.0, 0.0]

[[drive]]
joint = "O"

[speed_fluctuation]
mean_speed_rpm = 180.0
fluctuation    = 0.05
)";
  return kind;
}

study::Kind slider_crank_speed_fluctuation_kind() {
  study::Kind kind = kind_of(LinkageType::slider_crank);
  kind.mechanism = "planar.slider_crank";
  kind.summary = "speed fluctuation of a slider-crank that rotates fully: reduced inertia and flywheel";
  kind.example = R"(# linkwright study: how evenly a slider-crank runs
schema = 1
kind   = "speed_fluctuation"
title  = "Flywheel of my engine"

[mechanism]
type   = "planar.slider_crank"
branch = "forward"                  # forward | backward

[mechanism.parameters]
crank_mm        = 50.0
rod_mm          = 150.0
guide_angle_deg = 90.0

[mechanism.mass]
slider_kg = 0.4

[mechanism.mass.crank]
mass_kg            = 0.9
inertia_kg_m2      = 1.2e-3         # about the mass centre
centre_distance_mm = 10.0           # from O

[mechanism.mass.rod]
mass_kg            = 0.5
inertia_kg_m2      = 1.5e-3
centre_distance_mm = 50.0           # from A

[speed_fluctuation]
mean_speed_rpm = 600.0
fluctuation    = 0.02
)";
  return kind;
}

}  // namespace linkwright::planar
