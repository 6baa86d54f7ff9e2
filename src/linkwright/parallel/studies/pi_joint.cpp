// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/pi_joint.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/parallel/pi_joint/singularities.h"
#include "linkwright/parallel/studies/templates.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/bind_schema.h"
#include "linkwright/study/bind_write.h"
#include "linkwright/study/remarks.h"

namespace linkwright::parallel {
namespace {

constexpr double right = pi / 2;

/// In it people give resolutions.
constexpr Unit milliradian{"mrad", 1, 1e3};

/// Base, arms, coupler and diagonal over the angle.
study::Scene scene_of(const PiJoint& joint, std::span<const double> angles) {
  study::Scene scene;
  scene.name = "travel";
  scene.title = "Pi-joint over its angle";
  scene.input_key = "angle_rad";
  scene.input_label = "angle of the arms";
  scene.input.assign(angles.begin(), angles.end());
  const double b = base_length(joint);
  study::Scene::Point lower{"C", {}, {}}, upper{"A", {}, {}};
  for (const double angle : angles) {
    lower.x.push_back(joint.arm * std::cos(angle));
    lower.y.push_back(joint.arm * std::sin(angle));
    upper.x.push_back(lower.x.back());
    upper.y.push_back(lower.y.back() + b);
  }
  scene.points = {{"O", {0}, {0}}, {"B", {0}, {b}}, std::move(lower), std::move(upper)};
  using Body = study::Scene::BodyStyle;
  scene.bodies = {{"base", {0, 1}, Body::ground},
                  {"lower arm", {0, 2}, Body::bar},
                  {"upper arm", {1, 3}, Body::bar},
                  {"coupler", {2, 3}, Body::bar},
                  {"screw", {0, 3}, Body::damper}};
  using Joint = study::Scene::JointStyle;
  scene.joints = {{"O", 0, Joint::ground_pivot},
                  {"B", 1, Joint::ground_pivot},
                  {"C", 2, Joint::pivot},
                  {"A", 3, Joint::pivot}};
  scene.traces = {{3, "path of the coupler", false}};
  scene.handles = {{.key = "mechanism.arm_m",
                    .measure = study::Scene::Handle::Measure::length,
                    .point = 2,
                    .from = 0,
                    .held = true}};
  return scene;
}

Table curves_table(const PiAnalysis& s, const std::vector<PiCurvePoint>& points) {
  Table table{.name = "curves"};
  const auto add = [&](const char* key, const char* label, auto&& value) {
    std::vector<double> values;
    for (const PiCurvePoint& p : points) values.push_back(value(p));
    table.add(key, label, std::move(values));
  };
  add("angle_rad", "angle of the arms (rad)", [](const PiCurvePoint& p) { return p.angle; });
  add("diagonal_m", "diagonal (m)", [](const PiCurvePoint& p) { return p.diagonal; });
  add("jacobian_m", "rate of the diagonal by the angle (m)",
      [](const PiCurvePoint& p) { return p.jacobian; });
  add("inverse_jacobian_rad_per_m", "angle by the diagonal (rad/m)",
      [](const PiCurvePoint& p) { return p.inverse_jacobian; });
  add("diagonal_direction_rad", "direction of the diagonal (rad)",
      [](const PiCurvePoint& p) { return p.angles.diagonal_direction; });
  add("transmission_angle_rad", "angle between diagonal and arm (rad)",
      [](const PiCurvePoint& p) { return p.angles.transmission; });
  add("base_angle_rad", "angle between diagonal and base (rad)",
      [](const PiCurvePoint& p) { return p.angles.base; });
  if (s.equipment.drive) {
    add("torque_N_m", "largest torque at the output (N m)",
        [](const PiCurvePoint& p) { return p.output.torque; });
    add("speed_rad_per_s", "largest speed of the output (rad/s)",
        [](const PiCurvePoint& p) { return p.output.speed; });
    add("resolution_rad", "turn of the output for a step (rad)",
        [](const PiCurvePoint& p) { return p.output.resolution; });
  }
  if (s.equipment.bars)
    add("stiffness_N_m_per_rad", "stiffness at the output (N m/rad)",
        [](const PiCurvePoint& p) { return p.stiffness; });
  if (s.equipment.masses) {
    add("inertia_kg_m2", "inertia at the output (kg m2)", [](const PiCurvePoint& p) { return p.inertia; });
    add("holding_torque_N_m", "torque that holds it at rest (N m)",
        [](const PiCurvePoint& p) { return p.holding_torque; });
    add("holding_force_N", "force of the diagonal that holds it at rest (N)",
        [](const PiCurvePoint& p) { return p.holding_force; });
  }
  return table;
}

void add_plots(study::Result& result) {
  const study::AddPlot plot{result, {.table = "curves", .x = "angle_rad", .scene = "travel"}};
  plot("diagonal", "Diagonal", {"diagonal_m"});
  plot("jacobian", "Rate of the diagonal by the angle", {"jacobian_m"});
  plot("angles", "Angles of the diagonal",
       {"diagonal_direction_rad", "transmission_angle_rad", "base_angle_rad"});
  plot("torque", "Largest torque at the output", {"torque_N_m"});
  plot("speed", "Largest speed of the output", {"speed_rad_per_s"});
  plot("resolution", "Turn of the output for a step of the drive", {"resolution_rad"});
  plot("stiffness", "Stiffness at the output", {"stiffness_N_m_per_rad"});
  plot("inertia", "Inertia at the output", {"inertia_kg_m2"});
  plot("holding-force", "Force of the diagonal at rest", {"holding_force_N"});
}

/// Reports which bars the samples can distinguish.
void add_calibration(study::Result& result, const PiAnalysis& s) {
  const study::AddFact fact{result.facts};
  std::vector<PiStiffnessSample> samples;
  const CalibrationForm& c = *s.calibration;
  for (std::size_t i = 0; i < c.angles.size(); ++i) samples.push_back({c.angles[i], c.stiffnesses[i]});
  const double share = s.equipment.share;
  Table table{.name = "calibration"};
  std::vector<double> diagonal, arm, coupler, error, condition;
  const auto finite = [](double k) { return std::isfinite(k) ? k : std::nan(""); };
  const auto fit = [&](const char* name, const PiBarsSought& sought) {
    const int count = sought.diagonal + sought.arm + sought.coupler;
    if (static_cast<int>(samples.size()) < count) return;
    const PiStiffnessFit found = fit_bars(s.joint, samples, sought, {}, share);
    table.names.emplace_back(name);
    table.status.emplace_back(to_string(found.status));
    diagonal.push_back(finite(found.bars.diagonal));
    arm.push_back(finite(found.bars.arm));
    coupler.push_back(finite(found.bars.coupler));
    error.push_back(100 * found.error);
    condition.push_back(finite(found.condition));
  };
  fit("diagonal alone", {.diagonal = true});
  fit("diagonal and arms", {.diagonal = true, .arm = true});
  fit("diagonal, arms and coupler", {.diagonal = true, .arm = true, .coupler = true});
  table.add("diagonal_N_per_m", "stiffness of the diagonal (N/m), empty: not seen to yield", diagonal);
  table.add("arm_N_per_m", "stiffness of each arm (N/m)", arm);
  table.add("coupler_N_per_m", "stiffness of the coupler (N/m)", coupler);
  table.add("error_percent", "relative error of the compliance, rms (%)", error);
  table.add("condition", "growth of relative errors", condition);
  fact("diagonal that fits the measurements",
       say("{}, rms {}", measured("N_per_m", diagonal[0]), percent(error[0] / 100, 2)));
  result.tables.push_back(std::move(table));
}

std::optional<PiAnalysis> read_analysis(study::ObjectReader& document, const study::Common& common,
                                        Value& canonical) {
  PiAnalysis s;
  PiJointForm form;
  auto mechanism = document.table(field::entry("mechanism").required());
  if (mechanism) mechanism->read(form);
  PiSweepForm sweep{};
  auto range = document.table(field::entry("sweep").required());
  if (range) range->read(sweep);
  std::optional<PiMasses> masses;
  document(field::entry("masses"), masses);
  PiLoadForm load;
  document(field::entry("load"), load);
  document(field::entry("calibration"), s.calibration);
  if (!mechanism || !range || document.document().has_errors()) return std::nullopt;
  s.joint = {form.arm, form.ratio};
  if (const auto wrong = problem(s.joint)) {
    mechanism->error("arm", *wrong);
    return std::nullopt;
  }
  if (!(sweep.from < sweep.to && sweep.from >= -right && sweep.to <= right)) {
    range->error(sweep.from < sweep.to ? "from" : "to",
                 "the angle must rise from above -90 deg to below 90 deg");
    return std::nullopt;
  }
  const int samples = common.output.samples;
  for (int i = 0; i < samples; ++i)
    s.angles.push_back(sweep.from + (sweep.to - sweep.from) * i / (samples - 1));
  if (form.drive) {
    auto table = mechanism->table("drive");
    PiDrive drive{.screw = {form.drive->lead.value_or(0), form.drive->efficiency}};
    if (form.drive->force_limit) drive.force_limit = *form.drive->force_limit;
    if (form.drive->rate_limit) drive.rate_limit = *form.drive->rate_limit;
    if (form.drive->motor) {
      auto motor = table->table("motor");
      const auto read = motor_of(*motor, *form.drive->motor);
      if (!read) return std::nullopt;
      drive.motor = *read;
    }
    if (const auto wrong = problem(drive)) {
      table->error("motor", *wrong);
      return std::nullopt;
    }
    s.equipment.drive = drive;
  }
  if (form.stiffness) {
    PiBars bars;
    if (form.stiffness->arm) bars.arm = *form.stiffness->arm;
    if (form.stiffness->coupler) bars.coupler = *form.stiffness->coupler;
    if (form.stiffness->diagonal) bars.diagonal = *form.stiffness->diagonal;
    s.equipment.bars = bars;
    s.equipment.share = form.stiffness->share;
  }
  if (masses) {
    s.equipment.masses = *masses;
    s.equipment.masses->lead = s.equipment.drive ? s.equipment.drive->screw.lead : 0;
    s.equipment.load = {load.gravity[0], load.gravity[1], load.torque};
    if (const auto wrong = problem(*s.equipment.masses)) {
      document.error("masses", *wrong);
      return std::nullopt;
    }
  }
  if (s.calibration) {
    auto table = document.table("calibration");
    if (s.calibration->angles.size() != s.calibration->stiffnesses.size() || s.calibration->angles.empty()) {
      table->error("stiffnesses",
                   fmt::format("{} of them for {} angles", s.calibration->stiffnesses.size(),
                               s.calibration->angles.size()),
                   "one for each angle");
      return std::nullopt;
    }
    for (const double angle : s.calibration->angles)
      if (!(std::abs(angle) < right)) {
        table->error("angles", "must lie between -90 and 90 deg");
        return std::nullopt;
      }
    canonical["calibration"] = study::write_fields(*s.calibration);
  }
  canonical["mechanism"] = study::write_fields(form);
  canonical["sweep"] = study::write_fields(sweep);
  if (masses) canonical["masses"] = study::write_fields(*masses);
  if (document.has("load")) canonical["load"] = study::write_fields(load);
  return s;
}

}  // namespace

PiRequirements requirements_of(const PiLimitsForm& form) {
  PiRequirements r;
  const auto take = [](double& to, const std::optional<double>& from) {
    if (from) to = *from;
  };
  take(r.torque, form.torque);
  take(r.force_limit, form.force_limit);
  take(r.speed, form.speed);
  take(r.rate_limit, form.rate_limit);
  take(r.quantum, form.quantum);
  take(r.resolution, form.resolution);
  take(r.transmission, form.transmission);
  take(r.stroke, form.stroke);
  take(r.telescoping, form.telescoping);
  take(r.end_margin, form.end_margin);
  return r;
}

study::Result run_pi_analysis(const PiAnalysis& s, RunContext&) {
  study::Result result;
  const study::AddFact fact{result.facts};
  const auto points = pi_curves(s.joint, s.equipment, s.angles);
  result.tables.push_back(curves_table(s, points));
  add_plots(result);
  const auto range = range_values(s.joint, 0.5 * (s.angles.front() + s.angles.back()),
                                  0.5 * (s.angles.back() - s.angles.front()));
  fact("base and coupler", millimetres(base_length(s.joint)));
  fact("diagonal", say("{} to {}", millimetres(range.min_diagonal), millimetres(range.greatest_diagonal)));
  fact("stroke", millimetres(range.stroke()));
  fact("longest to shortest diagonal", plain_number(range.telescoping()).fixed(4));
  fact("least angle between diagonal and arm", degrees_of(range.min_transmission));
  const double half = 0.5 * (s.angles.back() - s.angles.front());
  fact("best centre for this travel", degrees_of(best_centre(s.joint, half)));
  const auto least = [&](auto&& value) {
    double out = value(points.front());
    for (const PiCurvePoint& p : points) out = std::min(out, value(p));
    return out;
  };
  if (s.equipment.drive) {
    fact("least torque at the output",
         newton_metres(least([](const PiCurvePoint& p) { return p.output.torque; })));
    fact("least top speed",
         measured("rad_per_s", least([](const PiCurvePoint& p) { return p.output.speed; })));
    fact("coarsest resolution",
         measured(milliradian, -least([](const PiCurvePoint& p) { return -p.output.resolution; })));
    fact("screw", self_locking(s.equipment.drive->screw) ? "self-locking" : "can be driven back by the load");
  }
  if (s.equipment.bars)
    fact("minimum stiffness",
         measured("N_m_per_rad", least([](const PiCurvePoint& p) { return p.stiffness; })));
  for (const PiSingularPosition& p : singular_positions(s.joint))
    fact("singular", say("{} at {}, diagonal {}", name_of(p.kind), at_place("angle", degrees_of(p.angle)),
                         millimetres(p.diagonal)));
  if (s.calibration) add_calibration(result, s);
  result.scenes.push_back(scene_of(s.joint, s.angles));
  result.headline = say("Pi-joint of {} with k = {}: the diagonal runs {} over {} to {}.",
                        millimetres(s.joint.arm), plain_number(s.joint.ratio), millimetres(range.stroke()),
                        degrees_of(s.angles.front()), degrees_of(s.angles.back()));
  return result;
}

study::Result run_pi_design(const PiRequirements& r, const study::Seeds& seeds, RunContext& context) {
  study::Result result;
  const study::AddFact fact{result.facts};
  const PiDesignReport report =
      design_pi_joint(r, {}, {.seed = static_cast<std::uint64_t>(seeds.first)}, context);
  result.status = report.status;
  for (const PiConflict& conflict : report.closed_form.conflicts) fact("conflict", words_of(conflict));
  const PiDesign& best = report.best;
  const PiRangeValues range = range_values(best.joint, best.centre, r.half_travel);
  study::Solution solution{.label = "smallest Pi-joint"};
  const auto parameter = [&](const char* key, const char* label, double value) {
    solution.parameters.push_back({key, label, value, 0, infinity});
  };
  parameter("arm_m", "arm (m)", best.joint.arm);
  parameter("ratio", "ratio of base and arm", best.joint.ratio);
  solution.parameters.push_back({"centre_rad", "centre of the range (rad)", best.centre, -right, right});
  parameter("base_m", "base and coupler (m)", base_length(best.joint));
  solution.objectives["size_m"] = best.size;
  solution.objectives["violation"] = best.violation;
  solution.classification = Value::object();
  solution.scene = "travel";
  if (report.status != Status::done) solution.defects = {to_string(report.status)};
  Value& found = solution.study["mechanism"];
  found["type"] = "parallel.pi_joint";
  found["arm_m"] = best.joint.arm;
  found["ratio"] = best.joint.ratio;
  solution.study["sweep"] = study::write_fields(PiSweepForm{std::max(best.centre - r.half_travel, -right),
                                                            std::min(best.centre + r.half_travel, right)});
  result.solutions.push_back(std::move(solution));

  Table limits{.name = "requirements"};
  std::vector<double> value, least, most, price;
  const auto row = [&](const char* name, PiLimit limit, double has, double low, double high) {
    if (!std::isfinite(low) && !std::isfinite(high)) return;
    limits.names.emplace_back(name);
    value.push_back(has);
    least.push_back(std::isfinite(low) ? low : nan);
    most.push_back(std::isfinite(high) ? high : nan);
    const auto found = std::find_if(report.active.begin(), report.active.end(),
                                    [&](const PiActiveLimit& a) { return a.limit == limit; });
    price.push_back(found == report.active.end() ? 0 : found->price);
  };
  if (r.torque > 0 && std::isfinite(r.force_limit))
    row("torque (N m)", PiLimit::torque, range.min_jacobian * r.force_limit, r.torque, nan);
  if (r.quantum > 0 && std::isfinite(r.resolution))
    row("resolution (rad)", PiLimit::resolution, r.quantum / range.min_jacobian, nan, r.resolution);
  if (r.speed > 0 && std::isfinite(r.rate_limit))
    row("rate of the diagonal (m/s)", PiLimit::speed, range.greatest_jacobian * r.speed, nan, r.rate_limit);
  if (r.transmission > 0)
    row("transmission angle (rad)", PiLimit::transmission, range.min_transmission, r.transmission, nan);
  row("stroke (m)", PiLimit::stroke, range.stroke(), nan, r.stroke);
  row("telescoping ratio", PiLimit::telescoping, range.telescoping(), nan, r.telescoping);
  row("end of the range (rad)", PiLimit::ends, std::abs(best.centre) + r.half_travel, nan,
      right - r.end_margin);
  limits.add("value", "value (SI units)", value);
  limits.add("at_least", "at least", least);
  limits.add("at_most", "at most", most);
  limits.add("price", "relative size saved per relative relaxation", price);
  result.tables.push_back(std::move(limits));

  fact("arm, base", say("{}, {}", millimetres(best.joint.arm), millimetres(base_length(best.joint))));
  fact("range of the angle",
       say("{} to {}", degrees_of(best.centre - r.half_travel), degrees_of(best.centre + r.half_travel)));
  fact("diagonal", say("{} to {}", millimetres(range.min_diagonal), millimetres(range.greatest_diagonal)));
  for (const PiActiveLimit& active : report.active)
    fact("held back by", say("{} (price {})", name_of(active.limit), plain_number(active.price, 3)));
  fact("closed form", report.closed_form.design ? say("{}{}", millimetres(report.closed_form.design->size),
                                                      report.closed_form_is_best ? ", the best there is" : "")
                                                : "none: requirements are in conflict");
  fact("local searches that reached it", say("{} of {}", report.reached_best, report.starts));
  result.statistics["evaluations"] = static_cast<std::int64_t>(report.evaluations);
  result.statistics["starts"] = static_cast<std::int64_t>(report.starts);
  result.statistics["reached_best"] = static_cast<std::int64_t>(report.reached_best);
  std::vector<double> angles;
  for (int i = 0; i <= 180; ++i) angles.push_back(best.centre + r.half_travel * (i / 90.0 - 1));
  PiAnalysis analysis{.joint = best.joint, .angles = angles};
  result.tables.push_back(curves_table(analysis, pi_curves(best.joint, {}, angles)));
  const study::AddPlot plot{result, {.table = "curves", .x = "angle_rad", .scene = "travel"}};
  plot("diagonal_m", "Diagonal", {"diagonal_m"});
  plot("jacobian_m", "Rate of the diagonal by the angle", {"jacobian_m"});
  result.scenes.push_back(scene_of(best.joint, angles));
  result.headline =
      report.status == Status::done
          ? say("Smallest Pi-joint: arm {}, k = {}, centre {} (a + b = {}).", millimetres(best.joint.arm),
                plain_number(best.joint.ratio).fixed(4), degrees_of(best.centre), millimetres(best.size))
      : report.status == Status::infeasible
          ? say("No Pi-joint meets all requirements; the nearest misses one by {}.",
                percent(best.violation, 3))
          : say("Interrupted: best so far a + b = {}.", millimetres(best.size));
  return result;
}

study::Kind pi_analysis_kind() {
  study::Kind kind;
  kind.kind = "analysis";
  kind.mechanism = "parallel.pi_joint";
  kind.summary = "active Pi-joint over its angle: diagonal, torque, speed, resolution, stiffness, weight";
  kind.example = templates::analysis_pi_joint();
  kind.schema = [](study::SchemaWriter& document) {
    document.property(field::entry("mechanism", "the joint").required(), study::schema_fields<PiJointForm>());
    document.property(field::entry("sweep", "range of the angle").required(),
                      study::schema_fields<PiSweepForm>());
    document.property(field::entry("masses", "of its parts"), study::schema_fields<PiMasses>());
    document.property(field::entry("load", "at the output, and gravity"), study::schema_fields<PiLoadForm>());
    document.property(field::entry("calibration", "stiffness that was measured: the bars that fit it"),
                      study::schema_fields<CalibrationForm>());
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common& common) {
    study::Prepared prepared;
    if (auto s = read_analysis(document, common, prepared.canonical))
      prepared.run = [s = *std::move(s)](RunContext& context) { return run_pi_analysis(s, context); };
    return prepared;
  };
  return kind;
}

study::Kind pi_design_kind() {
  study::Kind kind;
  kind.kind = "synthesis";
  kind.mechanism = "parallel.pi_joint";
  kind.target = "requirements";
  kind.seeded = true;
  kind.summary = "smallest Pi-joint that gives a torque, speed and resolution over a range of its angle";
  kind.example = templates::synthesis_pi_joint_requirements();
  kind.schema = [](study::SchemaWriter& document) {
    document.property(field::entry("mechanism", "what is designed").required(),
                      study::SchemaWriter().finish());
    document.property(field::entry("target", "what the joint must do").required(),
                      study::schema_fields<RequirementsForm>());
    document.property(field::entry("optimiser", "seeds"), study::SchemaWriter().finish());
  };
  kind.prepare = [](study::ObjectReader& document, const study::Common& common) {
    study::Prepared prepared;
    document.table(field::entry("mechanism").required());
    document.table("optimiser");
    RequirementsForm form;
    auto target = document.table(field::entry("target").required());
    if (target) target->read(form);
    if (!target || document.document().has_errors()) return prepared;
    PiRequirements requirements = requirements_of(form);
    requirements.half_travel = form.half_travel;
    if (const auto wrong = problem(requirements)) {
      target->error("half_travel", *wrong);
      return prepared;
    }
    prepared.canonical["target"] = study::write_fields(form);
    prepared.run = [requirements, seeds = common.seeds](RunContext& context) {
      return run_pi_design(requirements, seeds, context);
    };
    return prepared;
  };
  return kind;
}

}  // namespace linkwright::parallel
