// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/clearance/studies/design.h"
#include "linkwright/clearance/studies/simulation.h"
#include "linkwright/core/numbers.h"
#include "linkwright/core/units.h"
#include "linkwright/planar/linkage/build.h"
#include "linkwright/planar/studies/linkage.h"

namespace linkwright::clearance {
namespace {

// The linkage as any other of the program: drawn, and written into tables, from the same points.
ClearanceStudy as_linkage(const DesignMeasures& d) {
  const planar::FourBar& f = d.model.linkage;
  ClearanceStudy out;
  planar::Linkage& l = out.linkage;
  l = planar::grounded({{"O2", planar::crank_pivot(f)}, {"O4", planar::rocker_pivot(f)}});
  planar::add_bar(l, "crank", "O2", "A", f.crank);
  planar::add_body(l, "coupler", {{"A", {0, 0}}, {"B", {f.coupler, 0}}, {"P", {f.coupler_u, f.coupler_v}}});
  planar::add_bar(l, "rocker", "O4", "B", f.rocker);
  planar::add_pin(l, "O2", "ground.O2", "crank.O2");
  const int loose = planar::add_pin(l, "A", "crank.A", "coupler.A");
  planar::add_pin(l, "B", "coupler.B", "rocker.B");
  planar::add_pin(l, "O4", "ground.O4", "rocker.O4");
  planar::add_drive(l, "O2");
  planar::set_mode(
      l, "coupler", "rocker",
      f.branch == planar::Branch::open ? planar::AssemblyMode::plus : planar::AssemblyMode::minus);
  l.bodies[1].mass = planar::BodyMass{};  // its motion is prescribed
  l.bodies[2].mass = d.model.coupler;
  l.bodies[3].mass = d.model.rocker;
  l.gravity = d.model.gravity;
  out.plan = planar::plan_linkage(l).plan;
  out.traces = planar::points_named(l, {"coupler.P"});
  out.continuous.push_back({.clearance = {.joint = loose, .clearance = d.model.clearance}});
  return out;
}

}  // namespace

double phase_of(const ClearanceDesignStudy& s, const DesignRow& r) {
  return s.phase() + std::remainder(r.link.angle - r.crank - s.phase(), full_turn);
}

Table design_points(const ClearanceDesignStudy& s, const DesignMeasures& d, const DesignMeasures* before) {
  Table table{.name = "points"};
  std::vector<double> number, x, y, distance;
  for (std::size_t k = 0; k < d.reached.size(); ++k) {
    number.push_back(static_cast<double>(k + 1));
    const bool there = std::isfinite(d.reached[k].real());
    x.push_back(there ? d.reached[k].real() : nan);
    y.push_back(there ? d.reached[k].imag() : nan);
    distance.push_back(std::hypot(x[k] - s.path.x[k], y[k] - s.path.y[k]));
    table.status.emplace_back(there ? "done" : "no_assembly");
  }
  table.add("point", "point", number);
  table.add("crank_angle_rad", "crank angle (rad)", d.presumed.crank_angles);
  table.add("target_x_m", "target x (m)", s.path.x);
  table.add("target_y_m", "target y (m)", s.path.y);
  table.add("x_m", "reached x (m)", x);
  table.add("y_m", "reached y (m)", y);
  table.add("distance_m", "distance (m)", distance);
  if (before) {
    std::vector<double> bx, by, bd;
    for (std::size_t k = 0; k < before->reached.size(); ++k) {
      const bool there = std::isfinite(before->reached[k].real());
      bx.push_back(there ? before->reached[k].real() : nan);
      by.push_back(there ? before->reached[k].imag() : nan);
      bd.push_back(std::hypot(bx[k] - s.path.x[k], by[k] - s.path.y[k]));
    }
    table.add("reference_x_m", s.reference_label + " x (m)", bx);
    table.add("reference_y_m", s.reference_label + " y (m)", by);
    table.add("reference_distance_m", s.reference_label + " distance (m)", bd);
  }
  return table;
}

Table design_turn(const ClearanceDesignStudy& s, const DesignMeasures& d, std::string name) {
  Table table;
  table.name = std::move(name);
  const auto add = [&](const char* key, const char* label, auto&& of) {
    std::vector<double> values;
    for (const DesignRow& r : d.rows) values.push_back(of(r));
    table.add(key, label, std::move(values));
  };
  add("crank_angle_rad", "crank angle (rad)", [](const DesignRow& r) { return r.crank; });
  if (s.has_masses()) add("time_s", "time (s)", [](const DesignRow& r) { return r.time; });
  add("contact_angle_rad", "direction of the clearance link (rad)",
      [](const DesignRow& r) { return r.link.angle; });
  add("wanted_contact_angle_rad", "wanted direction (rad)",
      [&](const DesignRow& r) { return r.crank + s.phase(); });
  add("phase_rad", "phase of the clearance link (rad)", [&](const DesignRow& r) { return phase_of(s, r); });
  add("wanted_phase_rad", "wanted phase (rad)", [&](const DesignRow&) { return s.phase(); });
  if (s.has_masses()) {
    add("link_speed_rad_per_s", "speed of the clearance link (rad/s)",
        [](const DesignRow& r) { return r.link.rate; });
    add("tension_N", "tension, positive in contact (N)",
        [](const DesignRow& r) { return r.instant.tension; });
    add("drive_torque_N_m", "drive torque (N m)", [](const DesignRow& r) { return r.instant.drive_torque; });
  }
  add("coupler_angle_rad", "coupler angle (rad)",
      [](const DesignRow& r) { return r.instant.position.coupler_angle; });
  add("rocker_angle_rad", "rocker angle (rad)",
      [](const DesignRow& r) { return r.instant.position.rocker_angle; });
  add("point_x_m", "tracing point x (m)", [](const DesignRow& r) { return r.instant.position.point.real(); });
  add("point_y_m", "tracing point y (m)", [](const DesignRow& r) { return r.instant.position.point.imag(); });
  for (const DesignRow& r : d.rows) table.status.emplace_back(to_string(r.instant.status));
  return table;
}

std::vector<Table> design_linkage_tables(const ClearanceDesignStudy& s, const DesignMeasures& d) {
  const ClearanceStudy drawn = as_linkage(d);
  Table points{.name = "linkage-points"}, bodies{.name = "linkage-masses"}, start{.name = "linkage-start"};
  std::vector<double> x, y, mass, u, v, inertia;
  for (const planar::LinkageBody& b : drawn.linkage.bodies) {
    for (const planar::LinkagePoint& p : b.points) {
      points.names.push_back(b.name + "." + p.name);
      x.push_back(p.at.real());
      y.push_back(p.at.imag());
    }
    if (!b.mass) continue;
    bodies.names.push_back(b.name);
    mass.push_back(b.mass->mass);
    u.push_back(b.mass->centre.real());
    v.push_back(b.mass->centre.imag());
    inertia.push_back(b.mass->inertia);
  }
  points.add("x_m", "x in the frame of the body (m)", x);
  points.add("y_m", "y (m)", y);
  bodies.add("mass_kg", "mass (kg)", mass);
  bodies.add("centre_x_m", "mass centre x in the frame of the body (m)", u);
  bodies.add("centre_y_m", "mass centre y (m)", v);
  bodies.add("inertia_kg_m2", "inertia (kg m2)", inertia);
  const DesignRow first = d.rows.empty() ? DesignRow{} : d.rows[0];
  start.add("speed_rad_per_s", "speed of the crank (rad/s)", {s.mass.crank.speed});
  start.add("crank_angle_rad", "crank angle at the start (rad)", {s.mass.crank.angle});
  start.add("clearance_m", "clearance (m)", {d.model.clearance});
  start.add("start_angle_rad", "direction of the clearance link then (rad)", {first.link.angle});
  start.add("start_rate_rad_per_s", "its speed (rad/s)", {first.link.rate});
  start.add("turn_s", "time of a turn (s)", {full_turn / std::abs(s.mass.crank.speed)});
  return {std::move(points), std::move(bodies), std::move(start)};
}

Value design_study(const ClearanceDesignStudy& s, const DesignMeasures& d) {
  ClearanceStudy drawn = as_linkage(d);
  planar::Linkage& l = drawn.linkage;
  if (!s.has_masses())
    for (planar::LinkageBody& body : l.bodies) body.mass.reset();
  const auto damp = [&](const char* name, int body, double damping) {
    if (damping > 0) l.torsion_springs.push_back({.name = name, .second = body, .damping = damping});
  };
  damp("coupler damping", 2, d.model.coupler_damping);
  damp("rocker damping", 3, d.model.rocker_damping);
  Value out;
  out["kind"] = s.has_masses() ? "simulation" : "analysis";
  planar::write_linkage({.linkage = l, .traces = drawn.traces}, out);
  Value& mechanism = out["mechanism"];
  mechanism.as_object().insert(mechanism.as_object().begin(), {"type", "clearance.linkage"});
  // The usual properties of a linkage of pins are left out.
  const auto keep = [](Value& table, std::span<const std::string_view> keys) {
    std::erase_if(table.as_object(), [&](const Value::Member& m) {
      return std::find(keys.begin(), keys.end(), m.key) == keys.end();
    });
  };
  constexpr std::array<std::string_view, 5> said{"type", "body", "joint", "assembly", "torsion_spring"};
  constexpr std::array<std::string_view, 3> of_pin{"name", "first", "second"};
  keep(mechanism, said);
  for (Value& joint : mechanism["joint"].as_array()) keep(joint, of_pin);
  const double start = d.rows.front().crank;
  Value drive, pin;
  drive["joint"] = "O2";
  pin["joint"] = "A";
  pin["clearance_m"] = d.model.clearance;
  if (!s.has_masses()) {
    // The largest deviation of the tracing point, with the pin anywhere in its bush.
    Value turn;
    turn["joint"] = "O2";
    turn["from_rad"] = start;
    turn["to_rad"] = d.rows.back().crank;
    turn["samples"] = static_cast<std::int64_t>(d.rows.size());
    out["sweep"]["type"] = "grid";
    out["sweep"]["input"].push_back(std::move(turn));
  } else {
    drive["law"] = "constant_speed";
    drive["from_rad"] = start;
    drive["speed_rad_per_s"] = s.mass.crank.speed;
    pin["model"] = "continuous";
    pin["start_angle_rad"] = d.rows.front().link.angle;
    pin["start_rate_rad_per_s"] = d.rows.front().link.rate;
    pin[si_key("damping", Dimension::damping_angular)] = d.model.link_damping;
    out["simulation"]["to_s"] = full_turn / std::abs(s.mass.crank.speed);
    out["simulation"]["samples"] = s.samples;
  }
  out["drive"].push_back(std::move(drive));
  out["clearance"].push_back(std::move(pin));
  return out;
}

study::Scene design_scene(const ClearanceDesignStudy& s, const DesignMeasures& d) {
  ClearanceStudy drawn = as_linkage(d);
  drawn.scene_samples = s.samples;
  ClearanceRecording recording;
  const std::complex<double> o2 = planar::crank_pivot(d.model.linkage),
                             o4 = planar::rocker_pivot(d.model.linkage);
  for (const DesignRow& r : d.rows) {
    RecordedRow& row = recording.rows.emplace_back();
    const ClearancePosition& p = r.instant.position;
    row.time = r.time;
    row.record.status = row.status = r.instant.status;
    row.record.input = r.crank;
    row.pins.emplace_back();
    row.pins.back().eccentricity = p.pin - p.bush;
    // Without rates: what has speeds is drawn from the masses' motion below.
    const auto body = [&](std::complex<double> origin, double angle) {
      planar::PartState<double> out{};
      out.origin = math::vec(origin);
      out.direction = math::unit(angle);
      return out;
    };
    row.record.bodies = {body({0, 0}, 0), body(o2, r.crank), body(p.bush, p.coupler_angle),
                         body(o4, p.rocker_angle)};
    if (!s.has_masses()) continue;
    // The frame of the coupler moves so that the tracing point, the only point asked for, is right.
    planar::PartState<double>& coupler = row.record.bodies[2];
    const std::complex<double> arm = p.point - p.bush, i{0, 1};
    coupler.velocity = math::vec(r.instant.bush_velocity);
    coupler.speed = r.instant.coupler_rate;
    coupler.angular_acceleration = r.instant.coupler_acceleration;
    coupler.acceleration = math::vec(r.instant.point_acceleration - i * coupler.angular_acceleration * arm +
                                     coupler.speed * coupler.speed * arm);
    const auto force = [](std::complex<double> f) {
      planar::JointReaction out;
      out.force = math::vec(f);
      return out;
    };
    row.record.joints = {force(r.instant.pin_force), force(r.instant.pin_force),
                         force(-r.instant.joint_force), force(r.instant.pivot_force)};
    row.record.drives = {r.instant.drive_torque};
  }
  study::Scene scene = clearance_scene(drawn, recording, "crank_angle_rad", "crank angle");
  if (!s.has_masses()) scene.vectors.clear();
  if (s.has_path()) {
    study::Scene::Target target;
    target.name = "target points";
    target.x = s.path.x;
    target.y = s.path.y;
    for (const std::complex<double>& z : d.reached) {
      target.achieved_x.push_back(std::isfinite(z.real()) ? z.real() : nan);
      target.achieved_y.push_back(std::isfinite(z.imag()) ? z.imag() : nan);
    }
    target.achieved_input = d.presumed.crank_angles;
    target.closed = s.closed;
    scene.targets.push_back(std::move(target));
  }
  return scene;
}

}  // namespace linkwright::clearance
