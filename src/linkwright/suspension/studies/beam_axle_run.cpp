// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/study/extremes.h"
#include "linkwright/study/remarks.h"
#include "linkwright/suspension/corner/hard_points.h"
#include "linkwright/suspension/studies/beam_axle.h"

namespace linkwright::suspension {
namespace {

using P = BeamParameters;
constexpr const char* axle_scene_name = "heave";

/// Axles that have a column.
enum class Has { every, rigid, twisting };
/// A column of the parameters of an axle.
struct BeamColumn {
  const char *key, *label;
  double (*value)(const P&);
  Has axles = Has::every;
};
constexpr BeamColumn beam_columns[] = {
    {"left_travel_m", "travel of the left wheel centre (m)", [](const P& p) { return p.left.travel; }},
    {"right_travel_m", "travel of the right wheel centre (m)", [](const P& p) { return p.right.travel; }},
    {"track_m", "track (m)", [](const P& p) { return p.track; }},
    {"track_change_m", "track change (m)", [](const P& p) { return p.track_change; }},
    {"lateral_shift_m", "lateral shift of the axle, to the left (m)",
     [](const P& p) { return p.lateral_shift; }},
    {"steer_rad", "axle steer, mean of both wheels, to the left (rad)", [](const P& p) { return p.steer; }},
    {"left_toe_rad", "left toe (rad)", [](const P& p) { return p.left.angles.toe; }},
    {"right_toe_rad", "right toe (rad)", [](const P& p) { return p.right.angles.toe; }},
    {"left_camber_rad", "left camber against the body (rad)",
     [](const P& p) { return p.left.angles.camber; }},
    {"right_camber_rad", "right camber against the body (rad)",
     [](const P& p) { return p.right.angles.camber; }},
    {"left_road_camber_rad", "left camber against the road (rad)",
     [](const P& p) { return p.left.road_camber; }},
    {"right_road_camber_rad", "right camber against the road (rad)",
     [](const P& p) { return p.right.road_camber; }},
    {"left_recession_m", "recession of the left wheel centre, rearward (m)",
     [](const P& p) { return p.left.recession; }},
    {"right_recession_m", "recession of the right wheel centre, rearward (m)",
     [](const P& p) { return p.right.recession; }},
    {"pitch_by_heave_rad_per_m", "pitch of the beam by heave, forward at the top (rad/m)",
     [](const P& p) { return p.pitch_by_heave; }},
    {"roll_centre_height_m", "roll-centre height above the road (m)",
     [](const P& p) { return p.roll_centre_height; }},
    {"lateral_force_slope", "slope of the lateral force, vertical by lateral",
     [](const P& p) { return p.lateral_force_slope; }},
    {"roll_steer", "roll steer, axle steer by roll (rad/rad)", [](const P& p) { return p.roll_steer; }},
    {"roll_axis_inclination_rad", "inclination of the roll axis, rising forward (rad)",
     [](const P& p) { return p.roll_axis_inclination; }, Has::rigid},
    {"twist_rad", "twist of the beam, left half forward at the top (rad)", [](const P& p) { return p.twist; },
     Has::twisting},
    {"twist_by_roll", "twist of the beam by roll (rad/rad)", [](const P& p) { return p.twist_by_roll; },
     Has::twisting},
    {"steer_by_heave_rad_per_m", "axle steer by heave (rad/m)", [](const P& p) { return p.steer_by_heave; }},
    {"shift_by_heave", "lateral shift by heave (m/m)", [](const P& p) { return p.shift_by_heave; }},
    {"recession_by_heave", "recession of the wheel centres by heave (m/m)",
     [](const P& p) { return (p.left.recession_rate + p.right.recession_rate) / 2; }},
    {"side_centre_x_m", "instant centre in side view, x (m)", [](const P& p) { return p.side_centre[0]; }},
    {"side_centre_z_m", "instant centre in side view, z (m)", [](const P& p) { return p.side_centre[1]; }},
    {"side_swing_arm_m", "side-view swing arm (m)", [](const P& p) { return p.side_swing_arm; }},
    {"side_swing_angle_rad", "side-view swing arm above the ground (rad)",
     [](const P& p) { return p.side_swing_angle; }},
    {"anti_pitch_tangent", "support angle of the contacts, torque on the beam (tangent)",
     [](const P& p) { return p.anti_pitch_tangent; }},
    {"anti_pitch_tangent_free", "support angle of the contacts, torque on the body (tangent)",
     [](const P& p) { return p.anti_pitch_tangent_free; }},
};

struct AntiNames {
  std::string brake, brake_words, drive, drive_words;
};
AntiNames anti_names(const BeamAxleVehicle& v) {
  const bool front = v.axle == AxlePlace::front;
  return {front ? "anti_dive_percent" : "anti_lift_percent", front ? "anti-dive" : "anti-lift",
          front ? "anti_lift_drive_percent" : "anti_squat_percent",
          front ? "anti-lift under drive" : "anti-squat"};
}
struct AntiPercent {
  double brake, drive;
};
AntiPercent anti_percent(const BeamAxleVehicle& v, const P& p) {
  if (p.status != Status::done) return {nan, nan};
  const BeamAntiFeatures a = anti_features(p, v.axle, v.layout);
  return {v.brakes == AxlePart::beam ? a.brake_on_beam : a.brake_on_body,
          v.differential == AxlePart::beam ? a.drive_on_beam : a.drive_on_body};
}

/// The axes of the vehicle with its other axle; nothing where that is not given.
std::optional<VehicleAxes> axes_of_vehicle(const BeamAxleStudy& s, const P& p) {
  if (!s.vehicle || !s.vehicle->other_axle || p.status != Status::done) return std::nullopt;
  const bool front = s.vehicle->axle == AxlePlace::front;
  const double tangent =
      s.vehicle->brakes == AxlePart::beam ? p.anti_pitch_tangent : p.anti_pitch_tangent_free;
  return axes_with({p.roll_centre_height, front ? tangent : -tangent}, s.vehicle->axle,
                   *s.vehicle->other_axle, s.vehicle->layout.wheelbase);
}

bool is_reached(const BeamAxleRow& row) { return row.position.status == Status::done; }

BeamAxleRow row_of(const BeamAxlePlan& plan, BeamPosition position) {
  BeamAxleRow out{std::move(position), {}};
  if (is_reached(out))
    out.parameters = beam_parameters(plan, out.position);
  else
    out.parameters.status = out.position.status;
  return out;
}

BeamSteer lost_steer() {
  BeamSteer out{.status = Status::no_assembly};
  out.steer = {nan, nan};
  out.angles[0] = out.angles[1] = {nan, nan, nan};
  return out;
}

/// Adds what drag link and track rod make of the wheels.
void add_steer_columns(Table& table, const std::vector<BeamSteer>& steers) {
  const auto add = [&](const char* key, const char* label, auto&& value) {
    std::vector<double> values;
    for (const BeamSteer& b : steers) values.push_back(b.status == Status::done ? value(b) : nan);
    table.add(key, label, std::move(values));
  };
  add("left_steer_rad", "left wheel by the drag link, to the left (rad)",
      [](const BeamSteer& b) { return b.steer[0]; });
  add("right_steer_rad", "right wheel by drag link and track rod, to the left (rad)",
      [](const BeamSteer& b) { return b.steer[1]; });
  add("left_steered_camber_rad", "left camber as steered (rad)",
      [](const BeamSteer& b) { return b.angles[0].camber; });
  add("right_steered_camber_rad", "right camber as steered (rad)",
      [](const BeamSteer& b) { return b.angles[1].camber; });
}

/// The table `steer`: wheels over the angle of the Pitman arm, the axle at its reference.
void add_steering(study::Result& result, const BeamAxleStudy& s, const BeamAxlePlan& plan) {
  const BeamPosition reference = reference_position(plan);
  if (reference.status != Status::done) return;
  std::vector<BeamSteer> steers;
  for (const double pitman : s.pitmans)
    steers.push_back(steer_beam(plan, *s.steering, reference.place, pitman));
  const BeamSteer straight = steer_beam(plan, *s.steering, reference.place, 0);
  Table table{.name = "steer"};
  table.add("pitman_angle_rad", "angle of the Pitman arm (rad)", s.pitmans);
  add_steer_columns(table, steers);
  std::vector<double> toe_out, ackermann_share;
  // The kingpins meet the road in the distance that the ideal angles refer to.
  const Vec3 low = s.steering->kingpin[0], axis = unit(s.steering->kingpin[1] - low);
  const double road = contact_point(plan, reference.place, Side::left).z,
               axes = 2 * (low + ((road - low.z) / axis.z) * axis).y;
  for (const BeamSteer& b : steers) {
    const double left = b.steer[0] - straight.steer[0], right = b.steer[1] - straight.steer[1],
                 inner = std::max(std::abs(left), std::abs(right)),
                 outer = std::min(std::abs(left), std::abs(right));
    const bool to_left = left + right > 0;
    const double in = std::abs(to_left ? left : right), out = std::abs(to_left ? right : left);
    toe_out.push_back(b.status == Status::done ? in - out : nan);
    const bool turned = b.status == Status::done && outer > 1e-6 && s.vehicle && axes > 0 && inner > 0;
    ackermann_share.push_back(turned ? ackermann(in, out, s.vehicle->layout.wheelbase, axes).percent : nan);
  }
  table.add("toe_out_on_turn_rad", "inner less outer steer angle, from straight ahead (rad)",
            std::move(toe_out));
  if (s.vehicle)
    table.add("ackermann_axes_percent", "Ackermann by the kingpins at the ground (%)",
              std::move(ackermann_share));
  if (std::any_of(steers.begin(), steers.end(),
                  [](const BeamSteer& b) { return b.status != Status::done; })) {
    for (const BeamSteer& b : steers) table.status.emplace_back(to_string(b.status));
    const auto lost = std::find_if(steers.begin(), steers.end(),
                                   [](const BeamSteer& b) { return b.status != Status::done; });
    study::AddWarning{result.diagnostics}(
        say("Pitman arm at {}: {}", degrees_of(s.pitmans[static_cast<std::size_t>(lost - steers.begin())]),
            lost->reason),
        "take smaller angles");
  }
  result.tables.push_back(std::move(table));
  const study::AddPlot plot{result, {.table = "steer", .x = "pitman_angle_rad"}};
  plot("steer-angles", "Steer angles over the Pitman arm", {"left_steer_rad", "right_steer_rad"});
  plot("ackermann", "Ackermann over the Pitman arm", {"ackermann_axes_percent"});
}

/// Adds the columns of the parameters to a table that has those of the inputs.
void add_beam_columns(Table& table, const BeamAxleStudy& s, const BeamAxlePlan* plan,
                      const std::vector<BeamAxleRow>& rows) {
  const auto add = [&](std::string key, std::string label, auto&& value) {
    std::vector<double> values;
    for (const BeamAxleRow& r : rows) values.push_back(is_reached(r) ? value(r) : nan);
    table.add(std::move(key), std::move(label), std::move(values));
  };
  for (const BeamColumn& c : beam_columns)
    if (c.axles == Has::every || (c.axles == Has::twisting) == s.axle.twist.has_value())
      add(c.key, c.label, [&](const BeamAxleRow& r) { return c.value(r.parameters); });
  if (!s.axle.twist)
    add("pinion_angle_rad", "pinion angle, nose up (rad)",
        [&](const BeamAxleRow& r) { return s.pinion_angle - r.parameters.pitch; });
  if (s.vehicle) {
    const AntiNames names = anti_names(*s.vehicle);
    add(names.brake, names.brake_words + " (%)",
        [&](const BeamAxleRow& r) { return anti_percent(*s.vehicle, r.parameters).brake; });
    add(names.drive, names.drive_words + " (%)",
        [&](const BeamAxleRow& r) { return anti_percent(*s.vehicle, r.parameters).drive; });
  }
  if (s.vehicle && s.vehicle->other_axle) {
    const auto axes = [&](const BeamAxleRow& r) {
      return axes_of_vehicle(s, r.parameters).value_or(VehicleAxes{.roll_axis_inclination = nan});
    };
    add("vehicle_roll_axis_inclination_rad", "inclination of the vehicle's roll axis, rising forward (rad)",
        [&](const BeamAxleRow& r) { return axes(r).roll_axis_inclination; });
    add("pitch_centre_behind_m", "pitch centre in braking, behind the front axle (m)",
        [&](const BeamAxleRow& r) { return axes(r).pitch_centre_behind; });
    add("pitch_centre_height_m", "pitch centre in braking, above the road (m)",
        [&](const BeamAxleRow& r) { return axes(r).pitch_centre_height; });
  }
  if (s.steering) {
    std::vector<BeamSteer> steers;
    for (const BeamAxleRow& r : rows)
      steers.push_back(plan && is_reached(r) ? steer_beam(*plan, *s.steering, r.position.place, 0)
                                             : lost_steer());
    add_steer_columns(table, steers);
  }
  for (const NamedShaft& n : s.shafts) {
    const std::string key = plain_name(n.name);
    const auto state = [&](const BeamAxleRow& r) {
      return plan ? shaft_state(*plan, r.position.place, n.shaft) : BeamShaftState{};
    };
    add(key + "_body_angle_rad", n.name + ", angle of the joint on the body (rad)",
        [&](const BeamAxleRow& r) { return state(r).body_angle; });
    add(key + "_beam_angle_rad", n.name + ", angle of the joint on the beam (rad)",
        [&](const BeamAxleRow& r) { return state(r).beam_angle; });
    add(key + "_plunge_m", n.name + ", plunge, longer than at the reference (m)",
        [&](const BeamAxleRow& r) { return state(r).plunge; });
  }
  std::vector<double> residuals;
  for (const BeamAxleRow& r : rows) residuals.push_back(r.position.residual);
  table.add("closure_residual_m", "closure residual (m)", std::move(residuals));
  if (!std::all_of(rows.begin(), rows.end(), is_reached))
    for (const BeamAxleRow& r : rows) table.status.emplace_back(to_string(r.position.status));
}

Table grid_of(const BeamAxleStudy& s, const BeamAxlePlan* plan, const std::vector<BeamAxleRow>& rows) {
  Table table{.name = "sweep"};
  std::vector<double> heaves, rolls;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    heaves.push_back(s.heaves[i % s.heaves.size()]);
    rolls.push_back(s.rolls[i / s.heaves.size()]);
  }
  table.add("heave_m", "heave, change of the mean height of the contacts (m)", std::move(heaves));
  table.add("roll_rad", "roll of the body to the left (rad)", std::move(rolls));
  add_beam_columns(table, s, plan, rows);
  return table;
}

void add_axle_plots(study::Result& result, const BeamAxleStudy& s) {
  const bool many_heaves = s.heaves.size() > 1, many_rolls = s.rolls.size() > 1;
  if (many_heaves) {
    study::AddPlot plot{result, {.table = "sweep", .x = "heave_m", .scene = axle_scene_name}};
    if (many_rolls) plot.like.group = "roll_rad";
    plot("roll-centre", "Roll-centre height over heave", {"roll_centre_height_m"});
    plot("axle-shift", "Lateral shift of the axle over heave", {"lateral_shift_m"});
    plot("axle-steer", "Axle steer over heave", {"steer_rad"});
    plot("recession", "Recession of the wheel centres over heave", {"left_recession_m", "right_recession_m"});
    plot("pinion", "Pinion angle over heave", {"pinion_angle_rad"});
    plot("drag-link-steer", "Steer by the drag link over heave", {"left_steer_rad", "right_steer_rad"});
    if (s.vehicle) {
      const AntiNames names = anti_names(*s.vehicle);
      plot("anti-features", fmt::format("{} and {} over heave", names.brake_words, names.drive_words),
           {names.brake, names.drive});
    }
    for (const NamedShaft& n : s.shafts) {
      const std::string key = plain_name(n.name);
      plot(key + "-angles", "Angles of the joints: " + n.name,
           {key + "_body_angle_rad", key + "_beam_angle_rad"});
    }
  }
  if (many_rolls) {
    study::AddPlot plot{result, {.table = "sweep", .x = "roll_rad"}};
    if (many_heaves) plot.like.group = "heave_m";
    plot("roll-steer", "Axle steer over roll", {"steer_rad"});
    plot("roll-centre-roll", "Roll-centre height over roll", {"roll_centre_height_m"});
    plot("drag-link-roll-steer", "Steer by the drag link over roll", {"left_steer_rad", "right_steer_rad"});
    plot("roll-twist", "Twist of the beam over roll", {"twist_rad"});
    plot("roll-shift", "Lateral shift of the axle over roll", {"lateral_shift_m"});
  }
}

void add_axle_facts(study::Result& result, const BeamAxleStudy& s, const BeamAxlePlan& plan,
                    const BeamAxleRow& row, double heave, double roll) {
  if (!is_reached(row) || row.parameters.status != Status::done) return;
  const P& p = row.parameters;
  const Sentence here = heave == 0 && roll == 0
                            ? Sentence()
                            : say(" (heave {}, roll {})", millimetres(heave), degrees_of(roll).fixed(2));
  const study::AddFact fact{result.facts};
  const auto length = [](double v) { return millimetres(v).fixed(2); };
  static constexpr Unit angle_by_angle{"deg_per_deg"};
  fact("roll-centre height" + here, length(p.roll_centre_height));
  fact("roll steer (axle steer by roll)" + here, measured(angle_by_angle, p.roll_steer).fixed(4));
  if (s.axle.twist)
    fact("twist of the beam by roll" + here, measured(angle_by_angle, p.twist_by_roll).fixed(4));
  else
    fact("inclination of the roll axis, rising forward" + here, degrees_of(p.roll_axis_inclination).fixed(3));
  fact("lateral shift by heave" + here, plain_number(p.shift_by_heave).fixed(4));
  if (std::isfinite(p.side_swing_arm))
    fact("side-view swing arm" + here,
         say("{}, {} above the ground", length(p.side_swing_arm), degrees_of(p.side_swing_angle).fixed(3)));
  if (!s.axle.twist && (!s.vehicle || s.vehicle->differential == AxlePart::beam))
    fact("pinion angle by heave, nose up" + here, measured("deg_per_m", -p.pitch_by_heave).fixed(3));
  if (s.vehicle) {
    const AntiNames names = anti_names(*s.vehicle);
    const auto [brake, drive] = anti_percent(*s.vehicle, p);
    fact(say("{}, brakes on the {}", names.brake_words, name_of(s.vehicle->brakes)) + here,
         percent(brake / 100).fixed(2));
    fact(say("{}, differential on the {}", names.drive_words, name_of(s.vehicle->differential)) + here,
         percent(drive / 100).fixed(2));
  }
  if (const auto axes = axes_of_vehicle(s, p)) {
    fact("inclination of the vehicle's roll axis, rising forward" + here,
         degrees_of(axes->roll_axis_inclination).fixed(3));
    if (std::isfinite(axes->pitch_centre_behind))
      fact("pitch centre in braking" + here,
           say("{} behind the front axle, {} above the road", length(axes->pitch_centre_behind),
               length(axes->pitch_centre_height)));
    add_other_axle_facts(fact, *s.vehicle->other_axle, s.vehicle->axle, s.vehicle->layout);
  }
  for (const NamedShaft& n : s.shafts) {
    const BeamShaftState state = shaft_state(plan, row.position.place, n.shaft);
    fact(say("angles of the joints, {}", n.name) + here,
         say("{} on the body, {} on the beam", degrees_of(state.body_angle).fixed(2),
             degrees_of(state.beam_angle).fixed(2)));
  }
}

/// The left wheel centre alone, the right one held at its height.
void add_single(study::Result& result, const BeamAxleStudy& s, const BeamAxlePlan& plan,
                const RunContext& context) {
  std::vector<BeamAxleRow> rows;
  std::vector<double> travels;
  const BeamPosition reference = reference_position(plan);
  if (reference.status != Status::done) return;
  const double right = beam_inputs(plan, reference.place, AxleInputs::wheel_centres)[1];
  for (const double travel : s.singles) {
    if (context.interrupted()) {
      result.status = context.interruption();
      break;
    }
    rows.push_back(row_of(plan, solve_position(plan, {AxleInputs::wheel_centres, travel, right}, reference)));
    travels.push_back(travel);
    const BeamAxleRow& row = rows.back();
    if (!is_reached(row))
      study::AddWarning{result.diagnostics}("sweep.single",
                                            say("travel {} of the left wheel: {}: {}", millimetres(travel, 6),
                                                to_string(row.position.status), row.position.reason),
                                            {});
  }
  Table table{.name = "single"};
  table.add("travel_m", "travel of the left wheel centre alone (m)", std::move(travels));
  std::vector<double> heaves, rolls;
  for (const BeamAxleRow& r : rows) {
    heaves.push_back(is_reached(r) ? r.parameters.heave : nan);
    rolls.push_back(is_reached(r) ? r.parameters.roll : nan);
  }
  table.add("heave_m", "heave, change of the mean height of the contacts (m)", std::move(heaves));
  table.add("roll_rad", "roll of the body to the left (rad)", std::move(rolls));
  add_beam_columns(table, s, &plan, rows);
  result.tables.push_back(std::move(table));
  const study::AddPlot plot{result, {.table = "single", .x = "travel_m"}};
  plot("single-steer", "Axle steer over the travel of the left wheel alone", {"steer_rad"});
  plot("single-camber", "Camber against the body over the travel of the left wheel alone",
       {"left_camber_rad", "right_camber_rad"});
}

std::vector<HardPoint> points_of_axle(const BeamAxleStudy& s) {
  std::vector<HardPoint> out;
  const auto add = [&](const std::string& name, const char* what, const Vec3& at) {
    out.push_back({plain_name(name + " " + what), at});
  };
  add("left wheel", "centre", s.axle.left.centre);
  add("right wheel", "centre", s.axle.right.centre);
  for (const AxleRod& r : s.axle.rods) add(r.name, "body", r.body), add(r.name, "beam", r.beam);
  for (const AxleArm& a : s.axle.arms) {
    for (std::size_t k = 0; k < a.body.size(); ++k)
      add(a.name, a.body.size() == 1 ? "body" : k == 0 ? "body 1" : "body 2", a.body[k]);
    for (std::size_t k = 0; k < a.beam.size(); ++k)
      add(a.name, a.beam.size() == 1 ? "beam" : k == 0 ? "beam 1" : "beam 2", a.beam[k]);
  }
  for (const AxleWatt& w : s.axle.watts) {
    add(w.name, "pivot", w.pivot);
    add(w.name, "crank 1", w.crank[0]), add(w.name, "crank 2", w.crank[1]);
    add(w.name, "end 1", w.ends[0]), add(w.name, "end 2", w.ends[1]);
  }
  for (const AxleGuide& g : s.axle.guides) add(g.name, "beam", g.beam);
  for (const AxleBallJoint& b : s.axle.ball_joints) add(b.name, "point", b.at);
  if (s.axle.twist) {
    add(s.axle.twist->name, "left pivot", s.axle.twist->pivots[0]);
    add(s.axle.twist->name, "right pivot", s.axle.twist->pivots[1]);
    add(s.axle.twist->name, "shear centre", s.axle.twist->shear_centre);
  }
  for (const NamedShaft& n : s.shafts) add(n.name, "body", n.shaft.body), add(n.name, "beam", n.shaft.beam);
  return out;
}

/// "Rigid axle on 3 rods, 1 Watt linkage".
std::string location_of(const BeamAxle& a) {
  if (a.twist) return "Twist-beam axle";
  const auto some = [](std::size_t count, const char* one, const char* several) {
    return count == 0 ? std::string() : fmt::format(", {} {}", count, count == 1 ? one : several);
  };
  const std::string out = some(a.rods.size(), "rod", "rods") + some(a.arms.size(), "A-arm", "A-arms") +
                          some(a.watts.size(), "Watt linkage", "Watt linkages") +
                          some(a.guides.size(), "guide", "guides") +
                          some(a.ball_joints.size(), "ball joint", "ball joints");
  return "Rigid axle on " + out.substr(2);
}

}  // namespace

std::vector<BeamAxleRow> solve_beam_axle_grid(const BeamAxlePlan& plan, const std::vector<double>& heaves,
                                              const std::vector<double>& rolls, const RunContext* context) {
  std::vector<BeamAxleRow> out;
  const BeamPosition reference = reference_position(plan);
  const auto middle = static_cast<std::ptrdiff_t>(next_to_zero(heaves)),
             end = static_cast<std::ptrdiff_t>(heaves.size());
  for (const double roll : rolls) {
    if (context && context->interrupted()) break;
    std::vector<BeamAxleRow> row(heaves.size());
    const auto from = [&](const BeamPosition& start, std::ptrdiff_t i) {
      const auto at = static_cast<std::size_t>(i);
      row[at] = row_of(plan, start.status == Status::done
                                 ? solve_position(plan, {AxleInputs::heave_roll, heaves[at], roll}, start)
                                 : start);
      return is_reached(row[at]);
    };
    const bool begun = from(reference, middle);
    for (const int way : {-1, 1}) {
      BeamPosition near = begun ? row[static_cast<std::size_t>(middle)].position : reference;
      for (std::ptrdiff_t i = middle + way; i >= 0 && i < end; i += way)
        if (from(near, i)) near = row[static_cast<std::size_t>(i)].position;
    }
    out.insert(out.end(), std::make_move_iterator(row.begin()), std::make_move_iterator(row.end()));
  }
  return out;
}

Table beam_axle_table(const BeamAxleStudy& study, const std::vector<BeamAxleRow>& rows) {
  if (rows.empty()) return grid_of(study, nullptr, rows);
  const BeamAxlePlan plan = prepare_beam_axle(study.axle);
  return grid_of(study, &plan, rows);
}

study::Result run_beam_axle_study(const BeamAxleStudy& asked, RunContext& context) {
  study::Result result;
  BeamAxleStudy s = asked;
  const BeamAxlePlan plan = prepare_beam_axle(s.axle);
  const std::vector<BeamAxleRow> rows = solve_beam_axle_grid(plan, s.heaves, s.rolls, &context);
  if (rows.size() < s.heaves.size() * s.rolls.size()) {
    result.status = context.interruption();
    s.rolls.resize(rows.size() / s.heaves.size());
  }
  if (rows.empty()) {
    result.headline = "Interrupted before the first position.";
    return result;
  }
  result.tables.push_back(grid_of(s, &plan, rows));
  result.tables.push_back(hard_point_table(points_of_axle(s)));
  add_axle_plots(result, s);
  study::AddFact{result.facts}("axle", location_of(s.axle));
  const std::size_t heave = next_to_zero(s.heaves), roll = next_to_zero(s.rolls);
  add_axle_facts(result, s, plan, rows[roll * s.heaves.size() + heave], s.heaves[heave], s.rolls[roll]);
  if (!s.singles.empty()) add_single(result, s, plan, context);
  if (!s.pitmans.empty() && s.steering) add_steering(result, s, plan);
  if (s.drawn) result.scenes.push_back(beam_axle_scene(s, plan, rows));

  const study::AddWarning warn{result.diagnostics};
  std::size_t lost = 0;
  double worst = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const BeamPosition& p = rows[i].position;
    if (p.status == Status::done) {
      worst = std::max(worst, p.residual);
      continue;
    }
    if (result.status == Status::done) result.status = p.status;
    if (lost++ < 5)
      warn(say("heave {}, roll {}: {}: {}", millimetres(s.heaves[i % s.heaves.size()], 6),
               degrees_of(s.rolls[i / s.heaves.size()], 6), to_string(p.status), p.reason),
           "take positions within the reach of the links, or longer links");
  }
  if (lost > 5) warn(say("{} more positions are not reached", lost - 5));
  result.headline =
      lost == 0 ? say("{}: all {} positions reached (largest closure residual {}).", location_of(s.axle),
                      rows.size(), metres(worst, 1))
                : say("{}: {} of {} positions are not reached.", location_of(s.axle), lost, rows.size());
  return result;
}

}  // namespace linkwright::suspension
