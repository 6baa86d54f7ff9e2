// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/compliance.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "linkwright/math/angles.h"
#include "linkwright/study/remarks.h"
#include "linkwright/suspension/compliance/statics.h"
#include "linkwright/suspension/corner/position.h"

namespace linkwright::suspension {
namespace {

int link_index(const Suspension& suspension, const std::string& name) {
  for (std::size_t i = 0; i < suspension.links.size(); ++i)
    if (suspension.links[i].name == name) return static_cast<int>(i);
  return -1;
}

bool is_rod(LinkType type) { return type == LinkType::US || type == LinkType::SS; }

JointStiffness stiffness_of(const JointForm& j) {
  if (j.stiffness)
    return j.end ? ball_joint(*j.stiffness) : JointStiffness{.translation = {*j.stiffness, rigid, rigid}};
  const auto axis = j.axis.value_or(std::array<double, 3>{});
  return bushing(j.axial.value_or(0), j.radial.value_or(0), j.torsional, j.conical,
                 {axis[0], axis[1], axis[2]});
}

CornerElasticity elasticity_of(const CornerDescription& description, const ComplianceForm& form) {
  const Suspension& suspension = description.suspension;
  CornerElasticity out{.links = std::vector<LinkElasticity>(suspension.links.size()),
                       .couplers = {},
                       .spring = description.spring ? description.spring->stiffness : 0};
  for (const JointForm& j : form.joints) {
    LinkElasticity& link = out.links[static_cast<std::size_t>(link_index(suspension, j.link))];
    (j.end.value_or(LinkEnd::body) == LinkEnd::body ? link.body : link.carrier).push_back(stiffness_of(j));
  }
  return out;
}

/// "lower wishbone, body 2": several joints at one end are counted.
template <class Joint, class Force>
std::vector<std::string> joint_names(const Suspension& suspension, const std::vector<Joint>& joints,
                                     Force&& force) {
  std::vector<std::string> out;
  const auto same = [&](const JointForce& a, const JointForce& b) {
    return a.link == b.link && a.at_carrier == b.at_carrier;
  };
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const JointForce joint = force(joints[i]);
    int number = 1, count = 0;
    for (std::size_t k = 0; k < joints.size(); ++k)
      if (same(force(joints[k]), joint)) ++count, number += k < i ? 1 : 0;
    const std::string name = suspension.links[static_cast<std::size_t>(joint.link)].name;
    out.push_back(fmt::format("{}, {}{}", name, joint.at_carrier ? "carrier" : "body",
                              count > 1 ? fmt::format(" {}", number) : std::string()));
  }
  return out;
}

/// A coefficient for people.
struct Line {
  const char* name;
  double value;
};

std::vector<Line> lines(const ComplianceCoefficients& c) {
  const double force = math::degrees(per_kilonewton), moment = math::degrees(per_100_newton_metres),
               shift = 1e3 * per_kilonewton;
  return {
      {"lateral force steer, toe (deg/kN)", c.lateral_steer * force},
      {"lateral force camber (deg/kN)", c.lateral_camber * force},
      {"lateral compliance at the contact (mm/kN)", c.lateral_at_contact * shift},
      {"lateral compliance at the wheel centre (mm/kN)", c.lateral_at_centre * shift},
      {"longitudinal compliance at the contact, outboard brake (mm/kN)", c.longitudinal_at_contact * shift},
      {"longitudinal compliance at the wheel centre (mm/kN)", c.longitudinal_at_centre * shift},
      {"longitudinal force steer at the wheel centre, toe (deg/kN)", c.longitudinal_steer * force},
      {"brake steer, outboard brake, toe (deg/kN)", c.brake_outboard_steer * force},
      {"brake steer, inboard brake, toe (deg/kN)", c.brake_inboard_steer * force},
      {"brake camber, outboard brake (deg/kN)", c.brake_outboard_camber * force},
      {"brake camber, inboard brake (deg/kN)", c.brake_inboard_camber * force},
      {"brake wind-up, outboard brake (deg/kN)", c.brake_wind_up * force},
      {"drive steer, inboard drive, toe (deg/kN)", c.drive_steer * force},
      {"drive camber, inboard drive (deg/kN)", c.drive_camber * force},
      {"aligning torque steer, toe (deg/100 N m)", c.aligning_steer * moment},
      {"aligning torque camber (deg/100 N m)", c.aligning_camber * moment},
      {"overturning torque camber (deg/100 N m)", c.overturning_camber * moment},
      {"vertical compliance at the contact (mm/kN)", c.vertical_at_contact * shift},
      {"stiffness at the wheel centre along x (N/mm)", c.centre_stiffness.x / 1e3},
      {"stiffness at the wheel centre along y (N/mm)", c.centre_stiffness.y / 1e3},
      {"stiffness at the wheel centre along z (N/mm)", c.centre_stiffness.z / 1e3}};
}

Table coefficients_table(const Compliance& compliance) {
  Table table{.name = "compliance"};
  std::vector<double> values;
  for (const Line& line : lines(compliance_coefficients(compliance))) {
    table.names.emplace_back(line.name);
    values.push_back(line.value);
  }
  table.add("value", "value, in the unit of its name", std::move(values));
  return table;
}

Table matrix_table(const Compliance& compliance) {
  Table table{.name = "compliance_matrix"};
  table.names = {"shift x (m)",        "shift y (m)",        "shift z (m)",
                 "turn about x (rad)", "turn about y (rad)", "turn about z (rad)"};
  const std::array<std::pair<const char*, const char*>, 6> loads{
      {{"by_force_x", "by force x (1 N)"},
       {"by_force_y", "by force y (1 N)"},
       {"by_force_z", "by force z (1 N)"},
       {"by_moment_x", "by moment about x (1 N m)"},
       {"by_moment_y", "by moment about y (1 N m)"},
       {"by_moment_z", "by moment about z (1 N m)"}}};
  for (std::size_t j = 0; j < 6; ++j) {
    std::vector<double> column;
    for (std::size_t i = 0; i < 6; ++i) column.push_back(compliance.at_centre[i][j]);
    table.add(loads[j].first, loads[j].second, std::move(column));
  }
  return table;
}

constexpr std::array told_cases{LoadCase::lateral, LoadCase::brake_outboard, LoadCase::drive_inboard,
                                LoadCase::vertical, LoadCase::aligning_torque};

/// Sizes of the joint forces by a kilonewton or 100 N m of each standard case.
Table forces_table(const Suspension& suspension, const Compliance& compliance) {
  Table table{.name = "joint_forces"};
  table.names = joint_names(suspension, compliance.joints, [](const JointTransfer& t) { return t.joint; });
  for (const LoadCase load : told_cases) {
    const bool torque = load == LoadCase::aligning_torque;
    const double size = torque ? per_100_newton_metres : per_kilonewton;
    const WheelLoad unit = unit_load(compliance, load);
    const ElasticResponse r = respond(compliance, {size * unit.force, size * unit.moment});
    std::vector<double> column;
    for (const JointForce& j : r.joints) column.push_back(norm(j.force));
    table.add(fmt::format("{}_N", name_of(load)),
              fmt::format("force by {} (N by {})", name_of(load), torque ? "100 N m" : "1 kN"),
              std::move(column));
  }
  return table;
}

WheelLoad load_of(const Compliance& compliance, const LoadForm& l) {
  return load_at(compliance.centre, l.at == LoadPlace::contact ? compliance.contact : compliance.centre,
                 {l.force[0], l.force[1], l.force[2]}, {l.moment[0], l.moment[1], l.moment[2]});
}

Table loads_table(const Compliance& compliance, const std::vector<LoadForm>& loads) {
  Table table{.name = "loads"};
  std::array<std::vector<double>, 9> c;
  for (const LoadForm& l : loads) {
    table.names.push_back(l.name);
    const ElasticResponse r = respond(compliance, load_of(compliance, l));
    const std::array<double, 9> row{r.toe,         r.camber,          r.shift.x,         r.shift.y,
                                    r.shift.z,     r.contact_shift.x, r.contact_shift.y, r.contact_shift.z,
                                    r.spring_force};
    for (std::size_t i = 0; i < row.size(); ++i) c[i].push_back(row[i]);
  }
  constexpr std::array<std::pair<const char*, const char*>, 9> keys{
      {{"toe_rad", "change of toe (rad)"},
       {"camber_rad", "change of camber (rad)"},
       {"centre_x_m", "shift of the wheel centre x (m)"},
       {"centre_y_m", "shift of the wheel centre y (m)"},
       {"centre_z_m", "shift of the wheel centre z (m)"},
       {"contact_x_m", "shift of the contact x (m)"},
       {"contact_y_m", "shift of the contact y (m)"},
       {"contact_z_m", "shift of the contact z (m)"},
       {"spring_N", "more compression of the spring (N)"}}};
  for (std::size_t i = 0; i < keys.size(); ++i) table.add(keys[i].first, keys[i].second, c[i]);
  return table;
}

/// Forces in the joints (x, y, z in the vehicle's frame) for the given loads: one table a load.
Table load_forces_table(const Suspension& suspension, const Compliance& compliance, const LoadForm& l,
                        std::size_t number) {
  Table table{.name = fmt::format("load_forces-{}", number)};
  const ElasticResponse r = respond(compliance, load_of(compliance, l));
  table.names = joint_names(suspension, r.joints, [](const JointForce& j) { return j; });
  std::array<std::vector<double>, 4> c;
  for (const JointForce& j : r.joints) {
    c[0].push_back(j.force.x);
    c[1].push_back(j.force.y);
    c[2].push_back(j.force.z);
    c[3].push_back(norm(j.force));
  }
  table.add("x_N", fmt::format("{}: force x (N)", l.name), c[0]);
  table.add("y_N", fmt::format("{}: force y (N)", l.name), c[1]);
  table.add("z_N", fmt::format("{}: force z (N)", l.name), c[2]);
  table.add("size_N", fmt::format("{}: size (N)", l.name), c[3]);
  return table;
}

}  // namespace

void check_compliance(study::ObjectReader& document, ComplianceForm& form,
                      const CornerDescription& description) {
  const Suspension& suspension = description.suspension;
  auto table = document.table("compliance");
  std::vector<study::ObjectReader> joints = table->tables("joint");
  std::vector<std::string_view> known;
  for (const CornerLink& l : suspension.links) known.emplace_back(l.name);
  bool good = true;
  for (std::size_t i = 0; i < form.joints.size() && i < joints.size(); ++i) {
    const JointForm& j = form.joints[i];
    const auto wrong = [&](std::string_view key, std::string message, std::string hint = {}) {
      joints[i].error(key, std::move(message), std::move(hint));
      good = false;
    };
    const int link = link_index(suspension, j.link);
    if (link < 0) {
      joints[i].no_such("link", "link", j.link, known);
      good = false;
      continue;
    }
    const LinkType type = suspension.links[static_cast<std::size_t>(link)].type;
    if (!j.end && !is_rod(type))
      wrong("end", fmt::format("is missing: '{}' is not a rod", j.link),
            "write end = \"body\" or \"carrier\"");
    if (!j.end && !j.stiffness && is_rod(type))
      wrong("stiffness", "is missing",
            "write stiffness_N_per_mm, or end and axial_N_per_mm, radial_N_per_mm");
    if (j.end && j.stiffness.has_value() == (j.axial.has_value() || j.radial.has_value()))
      wrong("stiffness", j.stiffness ? "of a ball joint and those of a bushing are both given" : "is missing",
            "give stiffness_N_per_mm for a ball joint, or axial_N_per_mm and radial_N_per_mm for a bushing");
    if (j.end && !j.stiffness && j.axial.has_value() != j.radial.has_value())
      wrong(j.axial ? "radial" : "axial", "is missing", "a bushing has both");
  }
  if (!form.support)
    form.support =
        description.spring && acts_directly(*suspension.spring) ? Support::spring : Support::contact_held;
  const bool by_spring = *form.support == Support::spring;
  if (by_spring && !description.spring) {
    table->error("support", "the stiffness of the spring is not known",
                 "write stiffness_N_per_mm in [mechanism.spring]");
    good = false;
  }
  if (*form.support == Support::spring_held && !suspension.spring) {
    table->error("support", "there is no spring to hold", "add [mechanism.spring], or take contact_held");
    good = false;
  }
  if (form.preload && !description.spring) {
    table->error("preload", "needs the spring that carries it",
                 "write stiffness_N_per_mm in [mechanism.spring]");
    good = false;
  }
  if (suspension.spring && !acts_directly(*suspension.spring) &&
      (by_spring || *form.support == Support::spring_held || form.preload)) {
    table->error(by_spring || !form.preload ? "support" : "preload",
                 "the spring acts through a rocker, which the elastic joints do not hold",
                 "take support = \"contact_held\" or \"wheel_centre_held\", without preload");
    good = false;
  }
  if (!good) return;
  for (const Diagnostic& d : check(suspension, elasticity_of(description, form)))
    table->error("joint", to_string(d.message), to_string(d.hint));
}

void add_compliance(study::Result& result, const CornerDescription& description, const ComplianceForm& form) {
  const Suspension& suspension = description.suspension;
  const CornerPlan plan = prepare_suspension(suspension);
  const CornerPosition reference = reference_position(plan);
  const study::AddWarning warn{result.diagnostics};
  if (reference.status != Status::done)
    return warn("compliance", "no compliance: there is no reference position",
                "see the remarks on positions");
  std::optional<PointLoad> preload;
  if (form.preload) preload = PointLoad{plan.contact, {0, 0, *form.preload}};
  const Compliance c = solve_compliance(suspension, reference.place, 0, elasticity_of(description, form),
                                        *form.support, preload);
  if (c.status != Status::done)
    return warn("compliance", "no compliance: " + c.reason, "are all freedoms of the links held once?");
  result.tables.push_back(coefficients_table(c));
  result.tables.push_back(matrix_table(c));
  result.tables.push_back(forces_table(suspension, c));
  if (!form.loads.empty()) result.tables.push_back(loads_table(c, form.loads));
  for (std::size_t i = 0; i < form.loads.size(); ++i)
    result.tables.push_back(load_forces_table(suspension, c, form.loads[i], i + 1));
  const ComplianceCoefficients k = compliance_coefficients(c);
  const std::string held = fmt::format(" ({})", name_of(c.support));
  const auto fact = [&](std::string label, const Unit& unit, double value) {
    result.facts.push_back({std::move(label) + held, measured(unit, value).fixed(4)});
  };
  static constexpr Unit angle_by_force{"deg_per_kN", pi, 180 * per_kilonewton},
      shift_by_force{"mm_per_kN", 1, 1e3 * per_kilonewton},
      angle_by_torque{"deg_per_100_N_m", pi, 180 * per_100_newton_metres};
  fact("lateral force steer", angle_by_force, k.lateral_steer);
  fact("lateral force camber", angle_by_force, k.lateral_camber);
  fact("longitudinal compliance at the wheel centre", shift_by_force, k.longitudinal_at_centre);
  fact("aligning torque steer", angle_by_torque, k.aligning_steer);
}

}  // namespace linkwright::suspension
