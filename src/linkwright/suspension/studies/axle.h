// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "linkwright/study/bind.h"
#include "linkwright/study/kind.h"
#include "linkwright/suspension/studies/corner.h"
#include "linkwright/suspension/studies/other_axle.h"
#include "linkwright/suspension/studies/values.h"
#include "linkwright/suspension/wheel/axle.h"

// The tables `[vehicle]` and `[axle]`, by which an analysis of a wheel suspension covers the whole axle.
namespace linkwright::suspension {

/// The keys of `[vehicle]` that all axles have.
template <class Visitor>
void layout_fields(Visitor&& visit, AxlePlace& axle, VehicleLayout& layout) {
  visit(field::entry("axle", "where this axle is"), axle);
  const auto length = [](std::string_view key, std::string_view summary) {
    return field::length(key, summary).between(0.01, 1e3).required();
  };
  visit(length("wheelbase", "between the axles"), layout.wheelbase);
  visit(length("centre_height", "mass centre above the ground"), layout.centre_height);
  const auto share = [](std::string_view key, std::string_view summary) {
    return field::entry(key, summary).between(0, 1);
  };
  visit(share("front_brake_share", "of the braking force"), layout.front_brake_share);
  visit(share("axle_drive_share", "of the driving force at this axle"), layout.axle_drive_share);
}

/// `[vehicle]`.
struct VehicleForm {
  AxlePlace axle = AxlePlace::front;
  VehicleLayout layout;
  std::optional<double> front_overhang, width;  ///< of the body, m
  std::optional<OtherAxleForm> other_axle;
};
template <class Visitor>
void fields(Visitor&& visit, VehicleForm& v) {
  layout_fields(visit, v.axle, v.layout);
  visit(field::length("front_overhang", "of the body ahead of the front axle, for the turning circle")
            .between(0, 1e3),
        v.front_overhang);
  visit(field::length("width", "of the body, for the turning circle between walls").between(0.01, 1e3),
        v.width);
  visit(field::entry("other_axle", "the other axle of the vehicle: roll axis, pitch centre, anti features"),
        v.other_axle);
}

/// `[axle.grid]`.
struct AxleGridForm {
  std::optional<LengthValues> heave;
  std::optional<AngleValues> roll;
  std::optional<LengthValues> rack;
};
template <class Visitor>
void fields(Visitor&& visit, AxleGridForm& g) {
  visit(field::entry("heave", "changes of the mean height of the contacts; default: none"), g.heave);
  visit(field::entry("roll", "angles by which the body leans to the left; default: upright"), g.roll);
  visit(field::entry("rack", "displacements of the rack; default: centred"), g.rack);
}

/// `[axle]`: both wheels.
struct AxleForm {
  std::optional<AngleValues> roll;
  std::optional<LengthValues> opposite;
  std::optional<LengthValues> single;
  std::optional<LengthValues> rack;
  std::optional<AxleGridForm> grid;
  std::optional<double> rack_per_turn;
};
template <class Visitor>
void fields(Visitor&& visit, AxleForm& a) {
  visit(field::entry("roll", "angles by which the body leans to the left over a plane road"), a.roll);
  visit(field::entry("opposite", "travels of the left wheel, the right one travelling oppositely"),
        a.opposite);
  visit(field::entry("single", "travels of the left wheel alone"), a.single);
  visit(field::entry("rack", "displacements of the rack, the wheels at their reference height"), a.rack);
  visit(field::entry("grid", "every heave with every roll and every rack displacement"), a.grid);
  visit(field::length("rack_per_turn",
                      "C factor: rack travel by a turn of the steering wheel, for the steering ratio")
            .between(1e-4, 10),
        a.rack_per_turn);
}

/// Both wheels of an axle.
struct AxleDescription {
  CornerDescription left, right;
  bool symmetric = true;  ///< one is the mirror image of the other
};
/// The axle of a wheel suspension with the other wheel, or with its mirror image where there is none.
AxleDescription axle_of(const CornerDescription& one, const std::optional<CornerDescription>& other);

/// Checks what was read against the suspension; problems go to the reader. Values are replaced by their list.
void complete_axle(study::ObjectReader& document, AxleForm& axle, const Suspension& suspension);
/// True if the positions of complete_axle() have room in memory; an error at the reader if not.
bool fits_memory(study::ObjectReader& document, const AxleForm& axle);

/// Columns of the first table, whose rows are `wheels`: anti features of the axle in its vehicle, with a
/// diagram. Facts give those of the row `stated`, whose position their names end with.
void add_anti_features(study::Result& result, const VehicleForm& vehicle,
                       std::span<const WheelParameters> wheels, std::size_t stated, const Sentence& position);
/// Reports the first row of an axle that has no position.
void remark_lost(study::Result& result, std::span<const AxleRow> rows, std::string_view what);
/// The tables `roll`, `single`, `steer` and `grid` with diagrams and facts; rows so far, with the status,
/// when the run is to stop.
void add_axle(study::Result& result, const AxleDescription& both, const AxleForm& axle,
              const std::optional<VehicleForm>& vehicle, const RunContext& context);

}  // namespace linkwright::suspension
