// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/axle.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "linkwright/study/memory.h"
#include "linkwright/study/remarks.h"
#include "linkwright/suspension/corner/detail/steering_kernel.h"

namespace linkwright::suspension {
namespace {

bool is_steered(const Suspension& suspension) {
  return std::any_of(suspension.links.begin(), suspension.links.end(),
                     [](const CornerLink& l) { return l.moved_by_rack; });
}

/// Columns of rows that are there, NaN for the others.
class Rows {
 public:
  Rows(std::string name, std::span<const AxleRow> rows) : table_{.name = std::move(name)}, rows_(rows) {
    if (std::any_of(rows.begin(), rows.end(),
                    [](const AxleRow& r) { return r.position.status != Status::done; }))
      for (const AxleRow& r : rows) table_.status.emplace_back(to_string(r.position.status));
  }
  template <class Value>
  void add(std::string key, std::string label, Value&& value) {
    std::vector<double> column;
    for (const AxleRow& r : rows_)
      column.push_back(r.position.status == Status::done ? value(r.parameters) : WheelParameters::missing);
    table_.add(std::move(key), std::move(label), std::move(column));
  }
  void add_input(std::string key, std::string label, std::vector<double> values) {
    table_.add(std::move(key), std::move(label), std::move(values));
  }
  /// A column of a function of the value that was swept.
  template <class Value>
  void add_by_value(std::string key, std::string label, Value&& value) {
    std::vector<double> column;
    for (const AxleRow& r : rows_) column.push_back(value(r.value));
    add_input(std::move(key), std::move(label), std::move(column));
  }
  void add_values(std::string key, std::string label) {
    add_by_value(std::move(key), std::move(label), [](double value) { return value; });
  }
  Table take() { return std::move(table_); }

 private:
  Table table_;
  std::span<const AxleRow> rows_;
};

/// Columns that both wheels and their axle have at any position.
void add_axle_columns(Rows& out) {
  using P = AxleParameters;
  out.add("track_m", "track (m)", [](const P& p) { return p.track; });
  out.add("roll_centre_height_m", "roll-centre height above the road (m)",
          [](const P& p) { return p.roll_centre_height; });
  out.add("roll_centre_offset_m", "roll centre left of the middle of the track (m)",
          [](const P& p) { return p.roll_centre_offset; });
  out.add("steer_rad", "mean steer angle, to the left (rad)", [](const P& p) { return p.steer; });
  out.add("left_toe_rad", "left toe (rad)", [](const P& p) { return p.left.angles.toe; });
  out.add("right_toe_rad", "right toe (rad)", [](const P& p) { return p.right.angles.toe; });
  out.add("left_camber_rad", "left camber against the body (rad)",
          [](const P& p) { return p.left.angles.camber; });
  out.add("right_camber_rad", "right camber against the body (rad)",
          [](const P& p) { return p.right.angles.camber; });
  out.add("left_road_camber_rad", "left camber against the road (rad)",
          [](const P& p) { return p.road_camber_left; });
  out.add("right_road_camber_rad", "right camber against the road (rad)",
          [](const P& p) { return p.road_camber_right; });
  out.add("roll_steer", "roll steer, mean steer by roll (rad/rad)", [](const P& p) { return p.roll_steer; });
  out.add("left_roll_camber", "left camber against the road by roll (rad/rad)",
          [](const P& p) { return p.roll_camber_left; });
  out.add("right_roll_camber", "right camber against the road by roll (rad/rad)",
          [](const P& p) { return p.roll_camber_right; });
}

Table axle_table(std::string name, std::string key, std::string label, std::span<const AxleRow> rows) {
  Rows out(std::move(name), rows);
  out.add_values(std::move(key), std::move(label));
  add_axle_columns(out);
  return out.take();
}

/// A front axle that steers, straight ahead: its steering axes at the ground, the springs held or the contact
/// heights of a suspension without.
class SteeredAxle {
 public:
  SteeredAxle(const AxleParameters& straight, const VehicleForm& vehicle)
      : straight_(straight), vehicle_(vehicle) {
    const SteeringAxis *left = axis_of(straight.left), *right = axis_of(straight.right);
    if (left && right) axes_ = left->ground.y - right->ground.y;
  }

  /// Ackermann by the distance of the contacts, or of the steering axes.
  std::optional<AxleAckermann> by_contacts(const AxleParameters& p) const { return at(p, straight_.track); }
  std::optional<AxleAckermann> by_axes(const AxleParameters& p) const {
    return axes_ > 0 ? at(p, axes_) : std::nullopt;
  }

  /// The turning circles; NaN straight ahead, for a rear axle and without steering axes.
  TurningCircle circle(const AxleParameters& p) const {
    const auto turn = by_axes(p);
    if (!turn || vehicle_.axle != AxlePlace::front)
      return {WheelParameters::missing, WheelParameters::missing};
    const bool to_the_left = p.steer_left > straight_.steer_left;
    const SteeringAxis* outer = axis_of(to_the_left ? p.right : p.left);
    return turning_circle(turn->outer, vehicle_.layout.wheelbase, axes_,
                          outer ? outer->wheel_scrub : WheelParameters::missing,
                          vehicle_.front_overhang.value_or(nan), vehicle_.width.value_or(nan));
  }

 private:
  static const SteeringAxis* axis_of(const WheelParameters& wheel) {
    for (const auto* axis : {&wheel.axis_at_spring, &wheel.axis_at_contact})
      if (*axis) return &**axis;
    return nullptr;
  }
  std::optional<AxleAckermann> at(const AxleParameters& p, double distance) const {
    return axle_ackermann(straight_, p, vehicle_.layout.wheelbase, distance);
  }

  const AxleParameters& straight_;
  const VehicleForm& vehicle_;
  double axes_ = WheelParameters::missing;
};

/// Travel of the rack by a turn of the steering wheel, or of the Pitman arm's joint (m); nothing if unknown.
std::optional<double> rack_per_turn(const AxleForm& form, const Suspension& suspension) {
  const auto& linkage = suspension.steering_linkage;
  if (form.rack_per_turn || !linkage || !(linkage->box_ratio > 0)) return form.rack_per_turn;
  return 2 * pi * kernel::pitman_length(*linkage) / linkage->box_ratio;
}

/// The angles of both arms of a steering linkage.
void add_arm_angles(Rows& out, const SteeringLinkage& linkage) {
  const auto add = [&](std::string key, std::string label, double kernel::CentreLink<double>::*angle) {
    out.add_by_value(std::move(key), std::move(label),
                     [&, angle](double rack) { return kernel::centre_link(linkage, rack).*angle; });
  };
  add("pitman_angle_rad", "turn of the Pitman arm (rad)", &kernel::CentreLink<double>::pitman);
  add("idler_angle_rad", "turn of the idler arm (rad)", &kernel::CentreLink<double>::idler);
}

Table steer_table(std::span<const AxleRow> rows, const AxleParameters& straight, const AxleForm& form,
                  const std::optional<VehicleForm>& vehicle, const Suspension& suspension) {
  using P = AxleParameters;
  Rows out("steer", rows);
  out.add_values("rack_m", "rack, to the left (m)");
  if (suspension.steering_linkage) add_arm_angles(out, *suspension.steering_linkage);
  const std::optional<double> per_turn = rack_per_turn(form, suspension);
  out.add("left_steer_rad", "left steer angle (rad)", [](const P& p) { return p.steer_left; });
  out.add("right_steer_rad", "right steer angle (rad)", [](const P& p) { return p.steer_right; });
  out.add("left_camber_rad", "left camber (rad)", [](const P& p) { return p.left.angles.camber; });
  out.add("right_camber_rad", "right camber (rad)", [](const P& p) { return p.right.angles.camber; });
  const auto of_left = [&](std::string key, std::string label, double SteeringParameters::*member) {
    out.add(std::move(key), std::move(label), [=](const P& p) {
      return p.steering_left ? *p.steering_left.*member : WheelParameters::missing;
    });
  };
  of_left("left_steer_by_rack_rad_per_m", "left steer angle by rack (rad/m)",
          &SteeringParameters::steer_by_rack);
  if (per_turn)
    out.add("steering_ratio", "steering ratio, steering wheel by mean steer angle", [&](const P& p) {
      if (!p.steering_left || !p.steering_right) return WheelParameters::missing;
      return steering_ratio((p.steering_left->steer_by_rack + p.steering_right->steer_by_rack) / 2,
                            *per_turn);
    });
  of_left("left_brake_arm_m", "left brake moment arm, outboard brake (m)", &SteeringParameters::brake_arm);
  of_left("left_drive_arm_m", "left drive moment arm (m)", &SteeringParameters::drive_arm);
  of_left("left_lateral_arm_m", "left lateral force moment arm (m)", &SteeringParameters::lateral_arm);
  of_left("left_load_arm_m", "left wheel load moment arm, jacking (m/rad)", &SteeringParameters::load_arm);
  of_left("left_contact_rise_by_rack", "left rise of the contact by rack (m/m)",
          &SteeringParameters::contact_rise_by_rack);
  if (vehicle) {
    const SteeredAxle steered(straight, *vehicle);
    const auto number = [](const std::optional<AxleAckermann>& a, double AxleAckermann::*member) {
      return a ? *a.*member : WheelParameters::missing;
    };
    out.add("ackermann_percent", "Ackermann (%), track at the contacts",
            [&](const P& p) { return number(steered.by_contacts(p), &AxleAckermann::percent); });
    out.add("ackermann_error_rad", "inner steer angle less the ideal one (rad)",
            [&](const P& p) { return number(steered.by_contacts(p), &AxleAckermann::error); });
    out.add("ackermann_axes_percent", "Ackermann (%), distance of the steering axes at the ground",
            [&](const P& p) { return number(steered.by_axes(p), &AxleAckermann::percent); });
    out.add("ackermann_axes_error_rad", "inner steer angle less the ideal one, steering axes (rad)",
            [&](const P& p) { return number(steered.by_axes(p), &AxleAckermann::error); });
    out.add("toe_out_on_turn_rad", "toe-out on turn, inner less outer steer angle (rad)", [&](const P& p) {
      const auto a = steered.by_contacts(p);
      return a ? a->inner - a->outer : WheelParameters::missing;
    });
    if (vehicle->axle == AxlePlace::front) {
      out.add("turning_circle_m", "turning circle, kerb to kerb (m)",
              [&](const P& p) { return steered.circle(p).kerb_to_kerb; });
      if (vehicle->front_overhang && vehicle->width)
        out.add("turning_circle_walls_m", "turning circle, wall to wall (m)",
                [&](const P& p) { return steered.circle(p).wall_to_wall; });
    }
  }
  return out.take();
}

/// The steer angles at both ends of the rack, and the turning circles of the nearer end.
void add_lock_facts(study::Result& result, std::span<const AxleRow> rows, const AxleParameters& straight,
                    const std::optional<VehicleForm>& vehicle) {
  const study::AddFact fact{result.facts};
  TurningCircle widest{WheelParameters::missing, WheelParameters::missing};
  for (const bool first : {true, false}) {
    const AxleRow& end = first ? rows.front() : rows.back();
    if (end.position.status != Status::done || end.value == 0 || (end.value < 0) != first) continue;
    const AxleParameters& p = end.parameters;
    const double left = p.steer_left - straight.steer_left, right = p.steer_right - straight.steer_right;
    if (!(left * right > 0)) continue;
    const bool to_the_left = left > 0;
    fact(say("lock angles, turning {} (rack {})", to_the_left ? "left" : "right", millimetres(end.value)),
         say("inner {}, outer {}", degrees_of(std::abs(to_the_left ? left : right)).fixed(2),
             degrees_of(std::abs(to_the_left ? right : left)).fixed(2)));
    if (!vehicle) continue;
    const TurningCircle circle = SteeredAxle(straight, *vehicle).circle(p);
    if (!(circle.kerb_to_kerb <= widest.kerb_to_kerb)) widest = circle;
  }
  if (std::isfinite(widest.kerb_to_kerb))
    fact("turning circle, kerb to kerb", metres(widest.kerb_to_kerb, 4));
  if (std::isfinite(widest.wall_to_wall))
    fact("turning circle, wall to wall", metres(widest.wall_to_wall, 4));
}

Table grid_table(const AxleGrid& grid) {
  using P = AxleParameters;
  Rows out("axle_grid", grid.rows);
  out.add_input("heave_m", "heave, change of the mean height of the contacts (m)", grid.heave);
  out.add_input("roll_rad", "roll of the body to the left (rad)", grid.roll);
  out.add_input("rack_m", "rack, to the left (m)", grid.rack);
  out.add("left_steer_rad", "left steer angle (rad)", [](const P& p) { return p.steer_left; });
  out.add("right_steer_rad", "right steer angle (rad)", [](const P& p) { return p.steer_right; });
  add_axle_columns(out);
  return out.take();
}

}  // namespace

void remark_lost(study::Result& result, std::span<const AxleRow> rows, std::string_view what) {
  for (const AxleRow& r : rows)
    if (r.position.status != Status::done) {
      study::AddWarning{result.diagnostics}(
          "axle",
          fmt::format("{} {:.6g}: {}: {}", what, r.value, to_string(r.position.status), r.position.reason),
          {});
      return;  // the first one says why
    }
}

AxleDescription axle_of(const CornerDescription& one, const std::optional<CornerDescription>& other) {
  AxleDescription out{one, one, !other};
  CornerDescription& second = one.suspension.side == Side::left ? out.right : out.left;
  if (other)
    second = *other;
  else
    second.suspension = mirrored(one.suspension);
  return out;
}

void complete_axle(study::ObjectReader& document, AxleForm& axle, const Suspension& suspension) {
  auto table = document.table("axle");
  if (std::abs(suspension.wheel.centre.y) < 1e-9)
    table->error("roll", "the wheel centre lies in the middle of the vehicle: there is no axle",
                 "give the points in the vehicle's frame, y = 0 in its middle");
  const auto list = [](study::ObjectReader& of, const char* key, auto& input, const char* unit) {
    if (!input) return;
    if (auto read = of.table(key))
      if (auto values = values_of(*read, *input, unit))
        input = listed<std::decay_t<decltype(*input)>>(*std::move(values));
  };
  const auto steered = [&](study::ObjectReader& of) {
    if (!is_steered(suspension))
      of.error("rack", "no link is moved by the rack", "write moved_by = \"rack\" in the tie rod's table");
  };
  list(*table, "roll", axle.roll, "deg");
  list(*table, "opposite", axle.opposite, "mm");
  list(*table, "single", axle.single, "mm");
  if (axle.rack) steered(*table);
  list(*table, "rack", axle.rack, "mm");
  if (!axle.grid) return;
  auto grid = table->table("grid");
  list(*grid, "heave", axle.grid->heave, "mm");
  list(*grid, "roll", axle.grid->roll, "deg");
  if (axle.grid->rack) steered(*grid);
  list(*grid, "rack", axle.grid->rack, "mm");
}

bool fits_memory(study::ObjectReader& document, const AxleForm& axle) {
  const double columns = 20, bytes = sizeof(AxleRow) + study::table_bytes(1, columns);
  auto table = document.table("axle");
  const auto fits = [&](std::string_view key, const std::optional<std::vector<double>>& values) {
    const std::size_t rows = values ? values->size() : 0;
    return study::require_memory(*table, key, bytes * static_cast<double>(rows),
                                 fmt::format("{} positions of the axle", rows), "take fewer values");
  };
  if (axle.grid) {
    const auto count = [](const auto& input) {
      return input && input->values ? static_cast<double>(input->values->size()) : 1.0;
    };
    const double rows = count(axle.grid->heave) * count(axle.grid->roll) * count(axle.grid->rack);
    if (!study::require_memory(*table, "grid", bytes * rows, fmt::format("{} positions of the axle", rows),
                               "take fewer values"))
      return false;
  }
  return (!axle.single || fits("single", axle.single->values)) &&
         (!axle.roll || fits("roll", axle.roll->values)) &&
         (!axle.opposite || fits("opposite", axle.opposite->values)) &&
         (!axle.rack || fits("rack", axle.rack->values));
}

void add_anti_features(study::Result& result, const VehicleForm& vehicle,
                       std::span<const WheelParameters> wheels, std::size_t stated,
                       const Sentence& position) {
  const bool front = vehicle.axle == AxlePlace::front;
  std::array<std::vector<double>, 4> columns;
  for (const WheelParameters& w : wheels) {
    AntiFeatures a{WheelParameters::missing, WheelParameters::missing, WheelParameters::missing,
                   WheelParameters::missing};
    if (w.status == Status::done) a = anti_features(w, vehicle.axle, vehicle.layout);
    columns[0].push_back(a.outboard_brake);
    columns[1].push_back(a.inboard_brake);
    columns[2].push_back(a.inboard_drive);
    columns[3].push_back(a.outboard_brake_by_arms);
  }
  Table& sweep = result.tables.front();
  const std::string brake = front ? "anti_dive" : "anti_lift",
                    drive = front ? "anti_lift_drive" : "anti_squat";
  const std::string brake_label = front ? "anti-dive" : "anti-lift",
                    drive_label = front ? "anti-lift under drive" : "anti-squat";
  const study::AddFact fact{result.facts};
  const auto state = [&](const std::string& name, const std::vector<double>& values) {
    if (stated < values.size() && std::isfinite(values[stated]))
      fact(name + position, percent(values[stated] / 100).fixed(2));
  };
  state(brake_label + ", outboard brake", columns[0]);
  state(brake_label + ", outboard brake, by arm planes", columns[3]);
  state(brake_label + ", inboard brake", columns[1]);
  state(drive_label + ", inboard drive", columns[2]);
  const bool planes =
      std::any_of(columns[3].begin(), columns[3].end(), [](double v) { return std::isfinite(v); });
  sweep.add(brake + "_outboard_percent", brake_label + ", outboard brake (%)", std::move(columns[0]));
  sweep.add(brake + "_inboard_percent", brake_label + ", inboard brake (%)", std::move(columns[1]));
  sweep.add(drive + "_percent", drive_label + ", inboard drive (%)", std::move(columns[2]));
  if (planes)
    sweep.add("arm_" + brake + "_outboard_percent", brake_label + ", outboard brake, by arm planes (%)",
              std::move(columns[3]));
  if (vehicle.other_axle) {
    std::array<std::vector<double>, 3> axes;
    for (const WheelParameters& w : wheels) {
      VehicleAxes a{.roll_axis_inclination = WheelParameters::missing};
      if (w.status == Status::done)
        a = axes_with({w.roll_centre_height, front ? w.anti_pitch_tangent : -w.anti_pitch_tangent},
                      vehicle.axle, *vehicle.other_axle, vehicle.layout.wheelbase);
      axes[0].push_back(a.roll_axis_inclination);
      axes[1].push_back(a.pitch_centre_behind);
      axes[2].push_back(a.pitch_centre_height);
    }
    if (stated < wheels.size() && std::isfinite(axes[0][stated])) {
      fact("inclination of the vehicle's roll axis, rising forward" + position,
           degrees_of(axes[0][stated]).fixed(3));
      if (std::isfinite(axes[1][stated]))
        fact("pitch centre in braking" + position,
             say("{} behind the front axle, {} above the road", millimetres(axes[1][stated]),
                 millimetres(axes[2][stated])));
    }
    add_other_axle_facts(fact, *vehicle.other_axle, vehicle.axle, vehicle.layout);
    sweep.add("vehicle_roll_axis_inclination_rad",
              "inclination of the vehicle's roll axis, rising forward (rad)", std::move(axes[0]));
    sweep.add("pitch_centre_behind_m", "pitch centre in braking, behind the front axle (m)",
              std::move(axes[1]));
    sweep.add("pitch_centre_height_m", "pitch centre in braking, above the road (m)", std::move(axes[2]));
  }
  study::AddPlot plot{result, {.table = sweep.name, .x = "travel_m"}};
  if (sweep.find("rack_m")) {
    const auto& racks = sweep.find("rack_m")->values;
    if (std::any_of(racks.begin(), racks.end(), [&](double r) { return r != racks.front(); }))
      plot.like.group = "rack_m";
  }
  plot("anti-features",
       front ? "Anti-dive and anti-lift over travel" : "Anti-lift and anti-squat over travel",
       {brake + "_outboard_percent", brake + "_inboard_percent", drive + "_percent"});
}

void add_axle(study::Result& result, const AxleDescription& both, const AxleForm& form,
              const std::optional<VehicleForm>& vehicle, const RunContext& context) {
  const AxlePlan plan = prepare_axle(both.left.suspension, both.right.suspension);
  const AxlePosition reference = reference_position(plan);
  if (reference.status != Status::done) return;  // the sweep says why
  const AxleParameters straight = axle_parameters(plan, reference);
  const study::AddFact fact{result.facts};
  const auto swept = [&](AxleMotion motion, std::span<const double> values) {
    auto rows = sweep_axle(plan, motion, values, {}, &context);
    if (rows.size() < values.size()) result.status = context.interruption();
    return rows;
  };
  if (form.roll) {
    const auto rows = swept(AxleMotion::roll, *form.roll->values);
    result.tables.push_back(axle_table("roll", "roll_rad", "roll of the body to the left (rad)", rows));
    const study::AddPlot plot{result, {.table = "roll", .x = "roll_rad"}};
    plot("roll-steer", "Steer and toe over roll", {"steer_rad", "left_toe_rad", "right_toe_rad"});
    plot("roll-camber", "Camber against the road over roll",
         {"left_road_camber_rad", "right_road_camber_rad"});
    plot("roll-centre-roll", "Roll centre over roll: height, and offset to the left",
         {"roll_centre_height_m", "roll_centre_offset_m"});
    remark_lost(result, rows, "roll (rad)");
    static constexpr Unit angle_by_angle{"deg_per_deg"};
    fact("roll steer (mean steer by roll)", measured(angle_by_angle, straight.roll_steer).fixed(4));
    fact("camber against the road by roll, left",
         measured(angle_by_angle, straight.roll_camber_left).fixed(4));
  }
  if (form.single) {
    const auto rows = swept(AxleMotion::single, *form.single->values);
    result.tables.push_back(axle_table("single", "travel_m", "travel of the left wheel alone (m)", rows));
    const study::AddPlot plot{result, {.table = "single", .x = "travel_m"}};
    plot("single-toe", "Toe over the travel of the left wheel alone", {"left_toe_rad", "right_toe_rad"});
    plot("single-roll-centre", "Roll centre over the travel of the left wheel alone",
         {"roll_centre_height_m", "roll_centre_offset_m"});
    remark_lost(result, rows, "travel of the left wheel (m)");
  }
  if (form.rack) {
    const auto rows = swept(AxleMotion::rack, *form.rack->values);
    result.tables.push_back(steer_table(rows, straight, form, vehicle, both.left.suspension));
    const study::AddPlot plot{result, {.table = "steer", .x = "rack_m"}};
    plot("steer-angles", "Steer angles over rack", {"left_steer_rad", "right_steer_rad"});
    plot("ackermann", "Ackermann over rack", {"ackermann_percent"});
    plot("lever-arms", "Moment arms of the left wheel about its steering axis",
         {"left_brake_arm_m", "left_drive_arm_m", "left_lateral_arm_m", "left_load_arm_m"});
    remark_lost(result, rows, "rack (m)");
    const std::optional<double> per_turn = rack_per_turn(form, both.left.suspension);
    if (per_turn && straight.steering_left && straight.steering_right)
      fact("steering ratio, rack centred",
           plain_number(
               steering_ratio(
                   (straight.steering_left->steer_by_rack + straight.steering_right->steer_by_rack) / 2,
                   *per_turn))
               .fixed(2));
    if (!rows.empty()) add_lock_facts(result, rows, straight, vehicle);
  }
  if (form.grid) {
    static const std::vector<double> still{0};
    const auto values = [](const auto& input) -> const std::vector<double>& {
      return input ? *input->values : still;
    };
    const std::vector<double>&heaves = values(form.grid->heave), &rolls = values(form.grid->roll),
          &racks = values(form.grid->rack);
    const AxleGrid grid = solve_axle_grid(plan, heaves, rolls, racks, &context);
    if (grid.rows.size() < heaves.size() * rolls.size() * racks.size())
      result.status = context.interruption();
    result.tables.push_back(grid_table(grid));
    remark_lost(result, grid.rows, "roll (rad)");
  }
}

}  // namespace linkwright::suspension
