// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/compliance.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "linkwright/math/angles.h"
#include "linkwright/study/remarks.h"
#include "linkwright/suspension/compliance/spring_law.h"
#include "linkwright/suspension/compliance/statics.h"
#include "linkwright/suspension/corner/position.h"
#include "linkwright/suspension/studies/axle.h"

namespace linkwright::suspension {
namespace {

int link_index(const Suspension& suspension, const std::string& name) {
  for (std::size_t i = 0; i < suspension.links.size(); ++i)
    if (suspension.links[i].name == name) return static_cast<int>(i);
  return -1;
}

bool is_rod(LinkType type) { return type == LinkType::US || type == LinkType::SS; }

/// A curve that begins at 0 is continued by its image.
ForceCurve curve_of(const std::vector<double>& displacement, const std::vector<double>& force) {
  ForceCurve out{displacement, force};
  if (out.compression.empty() || out.force.size() != out.compression.size() || out.compression[0] != 0 ||
      out.force[0] != 0)
    return out;
  for (std::size_t i = 1; i < force.size(); ++i) {
    out.compression.insert(out.compression.begin(), -displacement[i]);
    out.force.insert(out.force.begin(), -force[i]);
  }
  return out;
}
ForceCurve curve_of(const BushingCurveForm& form) { return curve_of(form.displacement, form.force); }
ForceCurve curve_of(const BushingMomentCurveForm& form) { return curve_of(form.rotation, form.moment); }

JointStiffness stiffness_of(const JointForm& j) {
  if (j.stiffness)
    return j.end ? ball_joint(*j.stiffness) : JointStiffness{.translation = {*j.stiffness, rigid, rigid}};
  const auto axis = j.axis.value_or(std::array<double, 3>{});
  JointStiffness out =
      bushing(j.axial.value_or(0), j.radial.value_or(0), j.torsional, j.conical, {axis[0], axis[1], axis[2]});
  if (j.axial_curve) out.curves[0] = curve_of(*j.axial_curve);
  if (j.radial_curve) out.curves[1] = out.curves[2] = curve_of(*j.radial_curve);
  if (j.torsional_curve) out.curves[3] = curve_of(*j.torsional_curve);
  if (j.conical_curve) out.curves[4] = out.curves[5] = curve_of(*j.conical_curve);
  if (j.second_radial) out.translation[2] = *j.second_radial;
  if (j.second_conical) out.rotation[2] = *j.second_conical;
  if (j.second_axis) out.across = {(*j.second_axis)[0], (*j.second_axis)[1], (*j.second_axis)[2]};
  return out;
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

/// A coefficient in the unit that chassis engineers read.
struct Coefficient {
  const char* key;    ///< of its column
  const char* label;  ///< with the unit
  double value;
};

std::vector<Coefficient> coefficients(const ComplianceCoefficients& c) {
  const double force = math::degrees(per_kilonewton), moment = math::degrees(per_100_newton_metres),
               shift = 1e3 * per_kilonewton;
  return {
      {"lateral_steer_deg_per_kN", "lateral force steer, toe (deg/kN)", c.lateral_steer * force},
      {"lateral_camber_deg_per_kN", "lateral force camber (deg/kN)", c.lateral_camber * force},
      {"lateral_at_contact_mm_per_kN", "lateral compliance at the contact (mm/kN)",
       c.lateral_at_contact * shift},
      {"lateral_at_centre_mm_per_kN", "lateral compliance at the wheel centre (mm/kN)",
       c.lateral_at_centre * shift},
      {"longitudinal_at_contact_mm_per_kN", "longitudinal compliance at the contact, outboard brake (mm/kN)",
       c.longitudinal_at_contact * shift},
      {"longitudinal_at_centre_mm_per_kN", "longitudinal compliance at the wheel centre (mm/kN)",
       c.longitudinal_at_centre * shift},
      {"longitudinal_steer_deg_per_kN", "longitudinal force steer at the wheel centre, toe (deg/kN)",
       c.longitudinal_steer * force},
      {"brake_outboard_steer_deg_per_kN", "brake steer, outboard brake, toe (deg/kN)",
       c.brake_outboard_steer * force},
      {"brake_inboard_steer_deg_per_kN", "brake steer, inboard brake, toe (deg/kN)",
       c.brake_inboard_steer * force},
      {"brake_outboard_camber_deg_per_kN", "brake camber, outboard brake (deg/kN)",
       c.brake_outboard_camber * force},
      {"brake_inboard_camber_deg_per_kN", "brake camber, inboard brake (deg/kN)",
       c.brake_inboard_camber * force},
      {"brake_wind_up_deg_per_kN", "brake wind-up, outboard brake (deg/kN)", c.brake_wind_up * force},
      {"drive_steer_deg_per_kN", "drive steer, inboard drive, toe (deg/kN)", c.drive_steer * force},
      {"drive_camber_deg_per_kN", "drive camber, inboard drive (deg/kN)", c.drive_camber * force},
      {"aligning_steer_deg_per_100_N_m", "aligning torque steer, toe (deg/100 N m)",
       c.aligning_steer * moment},
      {"aligning_camber_deg_per_100_N_m", "aligning torque camber (deg/100 N m)", c.aligning_camber * moment},
      {"overturning_camber_deg_per_100_N_m", "overturning torque camber (deg/100 N m)",
       c.overturning_camber * moment},
      {"vertical_at_contact_mm_per_kN", "vertical compliance at the contact (mm/kN)",
       c.vertical_at_contact * shift},
      {"stiffness_x_N_per_mm", "stiffness at the wheel centre along x (N/mm)", c.centre_stiffness.x / 1e3},
      {"stiffness_y_N_per_mm", "stiffness at the wheel centre along y (N/mm)", c.centre_stiffness.y / 1e3},
      {"stiffness_z_N_per_mm", "stiffness at the wheel centre along z (N/mm)", c.centre_stiffness.z / 1e3}};
}

Table coefficients_table(const Compliance& compliance) {
  Table table{.name = "compliance"};
  std::vector<double> values;
  for (const Coefficient& c : coefficients(compliance_coefficients(compliance))) {
    table.names.emplace_back(c.label);
    values.push_back(c.value);
  }
  table.add("value", "value, in the unit of its name", std::move(values));
  return table;
}

/// Columns of all coefficients, a row for each compliance; NaN where it has no answer.
void add_coefficients(Table& table, const std::vector<Compliance>& rows) {
  const std::vector<Coefficient> all = coefficients({});
  std::vector<std::vector<double>> values(all.size());
  for (const Compliance& row : rows) {
    const bool done = row.status == Status::done;
    const std::vector<Coefficient> now =
        done ? coefficients(compliance_coefficients(row)) : std::vector<Coefficient>();
    for (std::size_t i = 0; i < all.size(); ++i) values[i].push_back(done ? now[i].value : nan);
  }
  for (std::size_t i = 0; i < all.size(); ++i) table.add(all[i].key, all[i].label, std::move(values[i]));
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

/// What a study needs to load its suspension at the reference.
struct LoadedCorner {
  const CornerDescription& description;
  const ComplianceForm& form;
  CornerPlace place;
  CornerElasticity elasticity;
  std::optional<PointLoad> preload;
  Compliance compliance;  ///< without a load

  LoadedCompliance under(const WheelLoad& load) const {
    return solve_loaded(description.suspension, place, 0, elasticity, *form.support, load, preload);
  }
};

/// Columns of what loads do to a wheel.
void add_responses(Table& table, const std::vector<ElasticResponse>& rows) {
  const auto add = [&](const char* key, const char* label, auto&& value) {
    std::vector<double> column;
    for (const ElasticResponse& r : rows) column.push_back(value(r));
    table.add(key, label, std::move(column));
  };
  add("toe_rad", "change of toe (rad)", [](const auto& r) { return r.toe; });
  add("camber_rad", "change of camber (rad)", [](const auto& r) { return r.camber; });
  add("centre_x_m", "shift of the wheel centre x (m)", [](const auto& r) { return r.shift.x; });
  add("centre_y_m", "shift of the wheel centre y (m)", [](const auto& r) { return r.shift.y; });
  add("centre_z_m", "shift of the wheel centre z (m)", [](const auto& r) { return r.shift.z; });
  add("contact_x_m", "shift of the contact x (m)", [](const auto& r) { return r.contact_shift.x; });
  add("contact_y_m", "shift of the contact y (m)", [](const auto& r) { return r.contact_shift.y; });
  add("contact_z_m", "shift of the contact z (m)", [](const auto& r) { return r.contact_shift.z; });
  add("spring_N", "more compression of the spring (N)", [](const auto& r) { return r.spring_force; });
}

/// Forces in the joints (x, y, z in the vehicle's frame) by a load.
Table load_forces_table(const Suspension& suspension, const ElasticResponse& r, const LoadForm& l,
                        std::size_t number) {
  Table table{.name = fmt::format("load_forces-{}", number)};
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

void add_loads(study::Result& result, const LoadedCorner& corner) {
  const std::vector<LoadForm>& loads = corner.form.loads;
  if (loads.empty()) return;
  const study::AddWarning warn{result.diagnostics};
  Table table{.name = "loads"};
  std::vector<ElasticResponse> responses;
  std::vector<Table> forces;
  for (const LoadForm& l : loads) {
    const LoadedCompliance loaded = corner.under(load_of(corner.compliance, l));
    if (loaded.compliance.status != Status::done) {
      warn("compliance.load", fmt::format("'{}': {}", l.name, loaded.compliance.reason), {});
      continue;
    }
    table.names.push_back(l.name);
    responses.push_back(loaded.response);
    forces.push_back(load_forces_table(corner.description.suspension, loaded.response, l, forces.size() + 1));
  }
  add_responses(table, responses);
  result.tables.push_back(std::move(table));
  result.tables.insert(result.tables.end(), forces.begin(), forces.end());
}

/// Shares of a load, with the coefficients of small further loads.
void add_over_load(study::Result& result, const LoadedCorner& corner, const LoadForm& l, std::size_t number,
                   const RunContext& context) {
  const WheelLoad load = load_of(corner.compliance, l);
  Table table{.name = fmt::format("over_load-{}", number)};
  std::vector<double> shares;
  std::vector<ElasticResponse> responses;
  std::vector<Compliance> rows;
  for (int i = 0; i <= *l.steps && !context.interrupted(); ++i) {
    const double share = static_cast<double>(i) / *l.steps;
    LoadedCompliance loaded = corner.under({share * load.force, share * load.moment});
    if (loaded.compliance.status != Status::done) break;  // told with the whole load
    shares.push_back(share);
    responses.push_back(std::move(loaded.response));
    rows.push_back(std::move(loaded.compliance));
  }
  table.add("share", fmt::format("share of the load '{}'", l.name), std::move(shares));
  add_responses(table, responses);
  add_coefficients(table, rows);
  result.tables.push_back(std::move(table));
  const std::string id = fmt::format("over-load-{}", number);
  study::AddPlot{result, {.table = fmt::format("over_load-{}", number), .x = "share"}}(
      id, fmt::format("Toe and camber by the load '{}'", l.name), {"toe_rad", "camber_rad"});
}

/// The preload where the spring has another length: its force over its share of a load at the contact.
class PreloadOverTravel {
 public:
  PreloadOverTravel(const LoadedCorner& corner, double reference_length)
      : corner_(corner), length_(reference_length) {
    if (corner.preload)
      force_ = spring_share(corner.place, 0, corner.preload->point) * corner.preload->force.z;
  }

  std::optional<PointLoad> at(const CornerPosition& position, const WheelParameters& wheel) const {
    if (!corner_.preload) return {};
    const SpringLaw& law = *corner_.description.spring;
    const double force = force_ + force_of(law, length_ - wheel.spring_length).force - force_of(law, 0).force;
    const Vec3 contact = position.place.carrier.centre +
                         contact_offset(corner_.compliance.side,
                                        corner_.description.suspension.wheel.tyre_diameter, wheel.angles);
    const double share = spring_share(position.place, position.input.rack, contact);
    return PointLoad{contact, {0, 0, force / share}};
  }

 private:
  /// Force of the held spring by an upward newton at the contact.
  double spring_share(const CornerPlace& place, double rack, const Vec3& contact) const {
    const Compliance held = solve_compliance(corner_.description.suspension, place, rack, corner_.elasticity,
                                             Support::spring_held);
    return held.status == Status::done ? respond(held, load_at(held.centre, contact, {0, 0, 1})).spring_force
                                       : nan;
  }

  const LoadedCorner& corner_;
  double length_ = 0, force_ = 0;
};

void add_over_travel(study::Result& result, const LoadedCorner& corner, const SweptCorner& swept,
                     double spring_length, const RunContext& context) {
  const std::size_t count = swept.travels.size() * swept.racks.size();
  if (count < 2) return;
  const PreloadOverTravel preload{corner, spring_length};
  Table table{.name = "compliance_over_travel"};
  std::vector<double> travels, racks;
  std::vector<Compliance> rows;
  for (std::size_t i = 0; i < count && !context.interrupted(); ++i) {
    const CornerPosition& position = swept.positions[i];
    travels.push_back(swept.travels[i % swept.travels.size()]);
    racks.push_back(swept.racks[i / swept.travels.size()]);
    Compliance row{.status = position.status};
    if (position.status == Status::done)
      row = solve_compliance(corner.description.suspension, position.place, position.input.rack,
                             corner.elasticity, *corner.form.support, preload.at(position, swept.wheels[i]));
    rows.push_back(std::move(row));
  }
  table.add("travel_m", "travel (m)", std::move(travels));
  table.add("rack_m", "rack (m)", std::move(racks));
  add_coefficients(table, rows);
  if (std::any_of(rows.begin(), rows.end(), [](const Compliance& c) { return c.status != Status::done; }))
    for (const Compliance& row : rows) table.status.emplace_back(to_string(row.status));
  result.tables.push_back(std::move(table));
  const study::AddPlot plot{
      result,
      {.table = "compliance_over_travel", .x = "travel_m", .group = swept.racks.size() > 1 ? "rack_m" : ""}};
  plot("lateral-steer", "Lateral force steer over travel", {"lateral_steer_deg_per_kN"});
  plot("lateral-camber", "Lateral force camber over travel", {"lateral_camber_deg_per_kN"});
  plot("brake-steer", "Brake steer over travel", {"brake_outboard_steer_deg_per_kN"});
  plot("aligning-steer", "Aligning torque steer over travel", {"aligning_steer_deg_per_100_N_m"});
}

/// Standard cases on both wheels (1 kN or 100 N m each).
Table axle_cases_table(const AxleCompliance& axle) {
  Table table{.name = "axle_compliance"};
  std::array<std::vector<double>, 8> c;
  for (const LoadCase load : told_cases)
    for (const Pairing pairing : {Pairing::parallel, Pairing::opposing}) {
      table.names.push_back(fmt::format("{}, {}", name_of(load), name_of(pairing)));
      const double size = load == LoadCase::aligning_torque ? per_100_newton_metres : per_kilonewton;
      const AxleResponse r = respond(axle, load, pairing);
      const std::array<double, 8> row{r.steer,     r.toe_difference, r.left.toe, r.left.camber,
                                      r.right.toe, r.right.camber,   r.rack,     r.bar};
      for (std::size_t i = 0; i < row.size(); ++i) c[i].push_back(size * row[i]);
    }
  constexpr std::array<std::pair<const char*, const char*>, 8> keys{
      {{"steer_rad", "mean steer angle, to the left (rad)"},
       {"toe_difference_rad", "toe of the left wheel less that of the right one (rad)"},
       {"left_toe_rad", "left wheel: change of toe (rad)"},
       {"left_camber_rad", "left wheel: change of camber (rad)"},
       {"right_toe_rad", "right wheel: change of toe (rad)"},
       {"right_camber_rad", "right wheel: change of camber (rad)"},
       {"rack_m", "shift of the rack, to the left (m)"},
       {"anti_roll_bar_N_m", "moment of the anti-roll bar (N m)"}}};
  for (std::size_t i = 0; i < keys.size(); ++i)
    if (axle.joining.bar > 0 || std::string_view(keys[i].first) != "anti_roll_bar_N_m")
      table.add(keys[i].first, keys[i].second, c[i]);
  return table;
}

Table axle_matrix_table(const AxleCompliance& axle) {
  Table table{.name = "axle_compliance_matrix"};
  constexpr std::array<const char*, 6> shifts{"shift x (m)",        "shift y (m)",
                                              "shift z (m)",        "turn about x (rad)",
                                              "turn about y (rad)", "turn about z (rad)"};
  constexpr std::array<const char*, 6> loads{"force_x",  "force_y",  "force_z",
                                             "moment_x", "moment_y", "moment_z"};
  constexpr std::array<const char*, 6> said{"force x (1 N)",          "force y (1 N)",
                                            "force z (1 N)",          "moment about x (1 N m)",
                                            "moment about y (1 N m)", "moment about z (1 N m)"};
  for (const char* wheel : {"left", "right"})
    for (const char* shift : shifts) table.names.push_back(fmt::format("{}: {}", wheel, shift));
  for (std::size_t j = 0; j < 12; ++j) {
    const char* wheel = j < 6 ? "left" : "right";
    std::vector<double> column;
    for (std::size_t i = 0; i < 12; ++i) column.push_back(axle.at_centres[i][j]);
    table.add(fmt::format("by_{}_{}", wheel, loads[j % 6]), fmt::format("by {} {}", wheel, said[j % 6]),
              std::move(column));
  }
  return table;
}

/// The same joints at the other wheel.
ComplianceForm mirrored(ComplianceForm form) {
  for (JointForm& j : form.joints)
    for (auto* axis : {&j.axis, &j.second_axis})
      if (*axis) (**axis)[1] = -(**axis)[1];
  return form;
}

/// Stiffness of mounts for the shift and turn of what they carry, at the vehicle's origin.
Matrix6 stiffness_of(const std::vector<MountForm>& mounts) {
  Matrix6 out{};
  const auto add = [&](const MountForm& m, double side) {
    const Vec3 at{m.point[0], side * m.point[1], m.point[2]},
        axis = unit(Vec3{m.axis[0], side * m.axis[1], m.axis[2]});
    const auto beside = math::across(axis);
    for (const auto& [along, stiffness] :
         {std::pair{axis, m.axial}, std::pair{beside[0], m.radial}, std::pair{beside[1], m.radial}}) {
      const Vec3 turn = cross(at, along);
      const std::array<double, 6> row{along.x, along.y, along.z, turn.x, turn.y, turn.z};
      for (std::size_t i = 0; i < 6; ++i)
        for (std::size_t j = 0; j < 6; ++j) out[i][j] += stiffness * row[i] * row[j];
    }
  };
  for (const MountForm& m : mounts) {
    add(m, 1);
    if (m.both_sides) add(m, -1);
  }
  return out;
}

/// The droplink of the anti-roll bar at a wheel at the reference, and the twist of the bar by the shift of
/// its end: angles of the arm are those of the mirror image on the right side.
struct DroplinkOfWheel {
  DroplinkEnd end;
  double twist = 0;  ///< rad/m; of mirrored arms the right one has the opposite sign
};
DroplinkOfWheel droplink_of(const CornerDescription& wheel) {
  const Rocker& arm = wheel.suspension.rockers[wheel.springs.anti_roll_bar->rocker];
  const auto& on = arm.driven_by;
  const Vec3 along = unit(on.at - arm.rod), axis = unit(arm.axis[1] - arm.axis[0]);
  const double lever = dot(cross(axis, arm.rod - arm.axis[0]), along);
  // tau = b_l - b_r, and b_r counts left-handed about the axis of its own side.
  return {{on.part.kind == PartKind::link ? static_cast<int>(on.part.index) : -1, on.at, along}, 1 / lever};
}

/// Nothing, with a remark, where a wheel has no reference position, no such link or no answer.
std::optional<Compliance> compliance_of_wheel(study::Result& result, const CornerDescription& wheel,
                                              const ComplianceForm& form) {
  const study::AddWarning warn{result.diagnostics};
  for (const JointForm& j : form.joints)
    if (link_index(wheel.suspension, j.link) < 0) {
      warn("compliance.axle", fmt::format("the other wheel has no link '{}'", j.link),
           "give the links of both wheels the same names");
      return {};
    }
  const CornerPlan plan = prepare_suspension(wheel.suspension);
  const CornerPosition reference = reference_position(plan);
  if (reference.status != Status::done) return {};
  std::optional<PointLoad> preload;
  if (form.preload) preload = PointLoad{plan.contact, {0, 0, *form.preload}};
  CornerElasticity elasticity = elasticity_of(wheel, form);
  const std::vector<std::string>& held = form.axle->on_subframe;
  for (std::size_t i = 0; i < elasticity.links.size() && !form.axle->mounts.empty(); ++i)
    elasticity.links[i].on_subframe =
        held.empty() || std::find(held.begin(), held.end(), wheel.suspension.links[i].name) != held.end();
  if (form.axle->anti_roll_bar) elasticity.droplink = droplink_of(wheel).end;
  Compliance out = solve_compliance(wheel.suspension, reference.place, 0, elasticity, *form.support, preload);
  if (out.status == Status::done) return out;
  warn("compliance.axle", "no compliance of the other wheel: " + out.reason, {});
  return {};
}

/// Checks `[compliance.axle]`; false if there is a problem.
bool check_axle(study::ObjectReader& table, const ComplianceAxleForm& form,
                const CornerDescription& description) {
  bool good = true;
  const auto wrong = [&](std::string_view key, std::string message, std::string hint) {
    table.error(key, std::move(message), std::move(hint));
    good = false;
  };
  const auto& bar = description.springs.anti_roll_bar;
  if (form.anti_roll_bar && !bar)
    wrong("anti_roll_bar", "there is no anti-roll bar", "add [mechanism.anti_roll_bar]");
  else if (form.anti_roll_bar && (bar->post_top || !(bar->stiffness > 0)))
    wrong("anti_roll_bar", bar->post_top ? "the bar is a T bar" : "the bar has no stiffness",
          "it is taken of a U bar with stiffness_N_m_per_rad");
  else if (form.anti_roll_bar &&
           description.suspension.rockers[bar->rocker].driven_by.part.kind == PartKind::rocker)
    wrong("anti_roll_bar", "its droplink is on a rocker, which the elastic joints do not hold",
          "it is taken where the droplink is on the carrier or a link");
  std::vector<std::string_view> known;
  for (const CornerLink& l : description.suspension.links) known.emplace_back(l.name);
  for (const std::string& name : form.on_subframe)
    if (link_index(description.suspension, name) < 0) {
      table.no_such("on_subframe", "link", name, known);
      good = false;
    }
  if (!form.on_subframe.empty() && form.mounts.empty())
    wrong("on_subframe", "the subframe has no mounts", "add [[compliance.axle.mount]]");
  for (const MountForm& m : form.mounts)
    if (!(norm(Vec3{m.axis[0], m.axis[1], m.axis[2]}) > 0))
      wrong("mount", "an axis has no direction", "for example [0, 0, 1]");
  return good;
}

void add_axle_compliance(study::Result& result, const CornerDescription& description,
                         const std::optional<CornerDescription>& other_wheel, const ComplianceForm& form) {
  const AxleDescription both = axle_of(description, other_wheel);
  const bool is_left = description.suspension.side == Side::left;
  const auto left = compliance_of_wheel(result, both.left, is_left ? form : mirrored(form));
  const auto right = compliance_of_wheel(result, both.right, is_left ? mirrored(form) : form);
  if (!left || !right) return;
  AxleJoining joining;
  if (!form.axle->mounts.empty()) joining.subframe = stiffness_of(form.axle->mounts);
  if (form.axle->anti_roll_bar) {
    joining.bar = description.springs.anti_roll_bar->stiffness;
    joining.twist = {droplink_of(both.left).twist, droplink_of(both.right).twist};
  }
  const AxleCompliance axle =
      axle_compliance(*left, *right, form.axle->rack_stiffness.value_or(rigid), joining);
  result.tables.push_back(axle_cases_table(axle));
  result.tables.push_back(axle_matrix_table(axle));
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
    if (j.torsional != 0 && j.torsional_curve)
      wrong("torsional_curve", "stands beside the torsional stiffness", "leave one of them");
    if (j.conical != 0 && j.conical_curve)
      wrong("conical_curve", "stands beside the conical stiffness", "leave one of them");
    if (!j.end &&
        (j.torsional_curve || j.conical_curve || j.second_radial || j.second_conical || j.second_axis))
      wrong("end", "is missing: a bushing is at one end of its link", "write end = \"body\" or \"carrier\"");
    if ((j.second_radial && j.radial_curve) || (j.second_conical && j.conical_curve))
      wrong("second_radial", "stands beside a curve of both directions", "leave one of them");
    const bool axial = j.axial || j.axial_curve, radial = j.radial || j.radial_curve;
    if (j.axial && j.axial_curve)
      wrong("axial_curve", "stands beside the axial stiffness", "leave one of them");
    if (j.radial && j.radial_curve)
      wrong("radial_curve", "stands beside the radial stiffness", "leave one of them");
    if (!j.end && (j.axial_curve || j.radial_curve))
      wrong("end", "is missing: a bushing is at one end of its link", "write end = \"body\" or \"carrier\"");
    if (j.end && j.stiffness.has_value() == (axial || radial))
      wrong("stiffness", j.stiffness ? "of a ball joint and those of a bushing are both given" : "is missing",
            "give stiffness_N_per_mm for a ball joint, or axial_N_per_mm and radial_N_per_mm for a bushing");
    if (j.end && !j.stiffness && axial != radial)
      wrong(axial ? "radial" : "axial", "is missing", "a bushing has both");
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
  if (auto axle = table->table("axle"); axle && form.axle)
    good = check_axle(*axle, *form.axle, description) && good;
  if (!good) return;
  for (const Diagnostic& d : check(suspension, elasticity_of(description, form)))
    table->error("joint", to_string(d.message), to_string(d.hint));
}

void add_compliance(study::Result& result, const CornerDescription& description,
                    const std::optional<CornerDescription>& other_wheel, const ComplianceForm& form,
                    const SweptCorner& swept, const RunContext& context) {
  const Suspension& suspension = description.suspension;
  const CornerPlan plan = prepare_suspension(suspension);
  const CornerPosition reference = reference_position(plan);
  const study::AddWarning warn{result.diagnostics};
  if (reference.status != Status::done)
    return warn("compliance", "no compliance: there is no reference position",
                "see the remarks on positions");
  std::optional<PointLoad> preload;
  if (form.preload) preload = PointLoad{plan.contact, {0, 0, *form.preload}};
  LoadedCorner corner{description, form, reference.place, elasticity_of(description, form), preload, {}};
  corner.compliance =
      solve_compliance(suspension, reference.place, 0, corner.elasticity, *form.support, preload);
  const Compliance& c = corner.compliance;
  if (c.status != Status::done)
    return warn("compliance", "no compliance: " + c.reason, "are all freedoms of the links held once?");
  result.tables.push_back(coefficients_table(c));
  result.tables.push_back(matrix_table(c));
  result.tables.push_back(forces_table(suspension, c));
  add_loads(result, corner);
  for (std::size_t i = 0; i < form.loads.size(); ++i)
    if (form.loads[i].steps) add_over_load(result, corner, form.loads[i], i + 1, context);
  add_over_travel(result, corner, swept, wheel_parameters(plan, reference).spring_length, context);
  if (form.axle) add_axle_compliance(result, description, other_wheel, form);
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
