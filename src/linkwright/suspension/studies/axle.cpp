// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/axle.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/study/memory.h"
#include "linkwright/study/remarks.h"

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
  void add_values(std::string key, std::string label) {
    std::vector<double> column;
    for (const AxleRow& r : rows_) column.push_back(r.value);
    table_.add(std::move(key), std::move(label), std::move(column));
  }
  Table take() { return std::move(table_); }

 private:
  Table table_;
  std::span<const AxleRow> rows_;
};

Table roll_table(std::span<const AxleRow> rows) {
  using P = AxleParameters;
  Rows out("roll", rows);
  out.add_values("roll_rad", "roll of the body to the left (rad)");
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
  return out.take();
}

Table steer_table(std::span<const AxleRow> rows, const AxleParameters& straight, const AxleForm& form,
                  const std::optional<VehicleForm>& vehicle) {
  using P = AxleParameters;
  Rows out("steer", rows);
  out.add_values("rack_m", "rack, to the left (m)");
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
  if (form.rack_per_turn)
    out.add("steering_ratio", "steering ratio, steering wheel by mean steer angle", [&](const P& p) {
      if (!p.steering_left || !p.steering_right) return WheelParameters::missing;
      return steering_ratio((p.steering_left->steer_by_rack + p.steering_right->steer_by_rack) / 2,
                            *form.rack_per_turn);
    });
  of_left("left_brake_arm_m", "left brake moment arm, outboard brake (m)", &SteeringParameters::brake_arm);
  of_left("left_drive_arm_m", "left drive moment arm (m)", &SteeringParameters::drive_arm);
  of_left("left_lateral_arm_m", "left lateral force moment arm (m)", &SteeringParameters::lateral_arm);
  of_left("left_load_arm_m", "left wheel load moment arm, jacking (m/rad)", &SteeringParameters::load_arm);
  of_left("left_contact_rise_by_rack", "left rise of the contact by rack (m/m)",
          &SteeringParameters::contact_rise_by_rack);
  if (vehicle) {
    const auto ackermann_of = [&](const P& p) {
      return axle_ackermann(straight, p, vehicle->layout.wheelbase, straight.track);
    };
    out.add("ackermann_percent", "Ackermann (%), track at the contacts", [&](const P& p) {
      const auto a = ackermann_of(p);
      return a ? a->percent : WheelParameters::missing;
    });
    out.add("ackermann_error_rad", "inner steer angle less the ideal one (rad)", [&](const P& p) {
      const auto a = ackermann_of(p);
      return a ? a->error : WheelParameters::missing;
    });
  }
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

void complete_axle(study::ObjectReader& document, AxleForm& axle, const Suspension& suspension) {
  auto table = document.table("axle");
  if (std::abs(suspension.wheel.centre.y) < 1e-9)
    table->error("roll", "the wheel centre lies in the middle of the vehicle: there is no axle",
                 "give the points in the vehicle's frame, y = 0 in its middle");
  if (axle.roll)
    if (auto roll = table->table("roll"))
      if (auto values = values_of(*roll, *axle.roll, "deg"))
        axle.roll = listed<AngleValues>(*std::move(values));
  if (axle.opposite)
    if (auto opposite = table->table("opposite"))
      if (auto values = values_of(*opposite, *axle.opposite, "mm"))
        axle.opposite = listed<LengthValues>(*std::move(values));
  if (axle.rack) {
    if (!is_steered(suspension))
      table->error("rack", "no link is moved by the rack",
                   "write moved_by = \"rack\" in the tie rod's table");
    if (auto rack = table->table("rack"))
      if (auto values = values_of(*rack, *axle.rack, "mm"))
        axle.rack = listed<LengthValues>(*std::move(values));
  }
}

bool fits_memory(study::ObjectReader& document, const AxleForm& axle) {
  const double columns = 20, bytes = sizeof(AxleRow) + study::table_bytes(1, columns);
  auto table = document.table("axle");
  const auto fits = [&](std::string_view key, const std::optional<std::vector<double>>& values) {
    const std::size_t rows = values ? values->size() : 0;
    return study::require_memory(*table, key, bytes * static_cast<double>(rows),
                                 fmt::format("{} positions of the axle", rows), "take fewer values");
  };
  return (!axle.roll || fits("roll", axle.roll->values)) &&
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

void add_axle(study::Result& result, const Suspension& suspension, const AxleForm& form,
              const std::optional<VehicleForm>& vehicle, const RunContext& context) {
  const AxlePlan plan = prepare_axle(suspension);
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
    result.tables.push_back(roll_table(rows));
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
  if (form.rack) {
    const auto rows = swept(AxleMotion::rack, *form.rack->values);
    result.tables.push_back(steer_table(rows, straight, form, vehicle));
    const study::AddPlot plot{result, {.table = "steer", .x = "rack_m"}};
    plot("steer-angles", "Steer angles over rack", {"left_steer_rad", "right_steer_rad"});
    plot("ackermann", "Ackermann over rack", {"ackermann_percent"});
    plot("lever-arms", "Moment arms of the left wheel about its steering axis",
         {"left_brake_arm_m", "left_drive_arm_m", "left_lateral_arm_m", "left_load_arm_m"});
    remark_lost(result, rows, "rack (m)");
    if (form.rack_per_turn && straight.steering_left && straight.steering_right)
      fact("steering ratio, rack centred",
           plain_number(
               steering_ratio(
                   (straight.steering_left->steer_by_rack + straight.steering_right->steer_by_rack) / 2,
                   *form.rack_per_turn))
               .fixed(2));
  }
}

}  // namespace linkwright::suspension
