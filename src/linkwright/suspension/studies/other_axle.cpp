// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/other_axle.h"

#include <fmt/core.h>

#include <cmath>
#include <filesystem>
#include <string_view>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/study/beside.h"
#include "linkwright/study/study.h"
#include "linkwright/suspension/dependent/beam_position.h"
#include "linkwright/suspension/studies/beam_axle.h"
#include "linkwright/suspension/studies/corner.h"
#include "linkwright/suspension/wheel/parameters.h"

namespace linkwright::suspension {
namespace {

/// Slopes of the lines of support count towards the middle of the vehicle.
double angle_of(double tangent, AxlePlace place) {
  return std::atan(place == AxlePlace::front ? tangent : -tangent);
}

/// Takes the numbers of the axle of a corner and its mirror image; false if it has no reference position.
bool take_corner(const CornerDescription& corner, AxlePlace place, OtherAxleForm& out) {
  const CornerPlan plan = prepare_suspension(corner.suspension);
  const CornerPosition reference = reference_position(plan);
  if (reference.status != Status::done) return false;
  const WheelParameters wheel = wheel_parameters(plan, reference);
  out.roll_centre_height = wheel.roll_centre_height;
  out.support_angle = angle_of(wheel.anti_pitch_tangent, place);
  out.drive_support_angle = angle_of(wheel.anti_pitch_tangent_free, place);
  return std::isfinite(wheel.roll_centre_height) && std::isfinite(*out.support_angle);
}

bool take_beam(const BeamAxleStudy& beam, AxlePlace place, OtherAxleForm& out) {
  const BeamAxlePlan plan = prepare_beam_axle(beam.axle);
  const BeamPosition reference = reference_position(plan);
  if (reference.status != Status::done) return false;
  const BeamParameters p = beam_parameters(plan, reference);
  const auto tangent = [&](AxlePart part) {
    return part == AxlePart::beam ? p.anti_pitch_tangent : p.anti_pitch_tangent_free;
  };
  const BeamAxleVehicle vehicle = beam.vehicle.value_or(BeamAxleVehicle{});
  out.roll_centre_height = p.roll_centre_height;
  out.support_angle = angle_of(tangent(vehicle.brakes), place);
  out.drive_support_angle = angle_of(tangent(vehicle.differential), place);
  return std::isfinite(p.roll_centre_height) && std::isfinite(*out.support_angle);
}

void without(Value& table, std::string_view key) {
  if (table.is_object())
    std::erase_if(table.as_object(), [&](const Value::Member& m) { return m.key == key; });
}

}  // namespace

void complete_other_axle(study::ObjectReader& vehicle, const study::Common& common, AxlePlace here,
                         OtherAxleForm& other) {
  auto table = vehicle.table("other_axle");
  if (!table) return;
  const bool numbers = other.roll_centre_height || other.support_angle || other.drive_support_angle;
  if (!other.file) {
    if (!other.roll_centre_height)
      table->error("roll_centre_height", "is missing", "give it, or file = \"rear.toml\"");
    if (!other.support_angle) table->error("support_angle", "is missing", "give it, or file = \"rear.toml\"");
    return;
  }
  if (numbers) return table->error("file", "stands beside numbers of the axle", "leave one of them");
  Diagnostics problems;
  study::Common there = common;
  const std::filesystem::path path = common.folder / *other.file;
  there.folder = path.parent_path();
  Value document = study::read_file(path, problems);
  bool taken = false, known = false;
  if (!has_errors(problems)) {
    // The axle that is asked for may name this one in turn.
    if (document.is_object())
      for (Value::Member& m : document.as_object())
        if (m.key == "vehicle") without(m.value, "other_axle");
    study::DocumentReader reader(document, *other.file, problems);
    study::ObjectReader root = reader.root();
    std::string type;
    if (auto mechanism = root.table("mechanism")) (*mechanism)(field::entry("type"), type);
    const AxlePlace place = here == AxlePlace::front ? AxlePlace::rear : AxlePlace::front;
    known = type == "suspension.corner" || type == "suspension.beam_axle";
    Value canonical;
    if (type == "suspension.corner") {
      if (const auto corner = read_suspension(root, there, OpenPoints::none))
        taken = take_corner(*corner, place, other);
    } else if (known) {
      if (const auto beam = read_beam_axle_study(root, there, canonical))
        taken = take_beam(*beam, place, other);
    }
  }
  for (const Diagnostic& d : problems)
    if (d.severity == Diagnostic::Severity::error) table->unreadable("file", study::in_file(d));
  if (taken)
    other.file.reset();
  else if (!has_errors(problems))
    table->error("file", fmt::format("'{}' has no {}", *other.file,
                                     known ? "reference position with a roll centre" : "wheel suspension"));
}

VehicleAxes axes_with(const AxleCentre& here, AxlePlace place, const OtherAxleForm& other, double wheelbase) {
  const AxleCentre there{*other.roll_centre_height, std::tan(*other.support_angle)};
  return place == AxlePlace::front ? vehicle_axes(here, there, wheelbase)
                                   : vehicle_axes(there, here, wheelbase);
}

void add_other_axle_facts(const study::AddFact& fact, const OtherAxleForm& other, AxlePlace here,
                          const VehicleLayout& layout) {
  const bool front = here == AxlePlace::rear;
  const std::string axle = front ? "front axle: " : "rear axle: ";
  const double gain = layout.wheelbase / layout.centre_height,
               braking = front ? layout.front_brake_share : 1 - layout.front_brake_share,
               driving = 1 - layout.axle_drive_share;
  fact(axle + "roll-centre height", millimetres(*other.roll_centre_height).fixed(2));
  fact(axle + (front ? "anti-dive" : "anti-lift"),
       percent(gain * braking * std::tan(*other.support_angle)).fixed(2));
  if (other.drive_support_angle && driving > 0)
    fact(axle + (front ? "anti-lift under drive" : "anti-squat"),
         percent(gain * driving * std::tan(*other.drive_support_angle)).fixed(2));
}

}  // namespace linkwright::suspension
