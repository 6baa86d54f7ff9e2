// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "linkwright/study/bind.h"
#include "linkwright/study/kind.h"
#include "linkwright/study/remarks.h"
#include "linkwright/suspension/dependent/beam_parameters.h"
#include "linkwright/suspension/wheel/axle.h"

// The other axle of a vehicle: what the axes of the whole vehicle and its anti features need of it.
namespace linkwright::suspension {

/// `[vehicle.other_axle]`: the study of the axle, or its numbers.
struct OtherAxleForm {
  std::optional<std::string> file;
  std::optional<double> roll_centre_height, support_angle, drive_support_angle;
};
template <class Visitor>
void fields(Visitor&& visit, OtherAxleForm& o) {
  visit(field::entry("file", "study of the axle, of a corner or a beam axle, instead of the numbers"),
        o.file);
  visit(field::length("roll_centre_height", "above the road").between(-10, 10), o.roll_centre_height);
  const auto angle = [](std::string_view key, std::string_view summary) {
    return field::angle(key, summary).between(-1.5, 1.5);
  };
  visit(angle("support_angle",
              "of the line from its contact points to its instant centre in side view above the ground, > 0: "
              "it rises towards the middle of the vehicle"),
        o.support_angle);
  visit(angle("drive_support_angle",
              "of the line along which driving forces support the body, likewise; default: not known"),
        o.drive_support_angle);
}

/// Fills in the numbers of the other axle at its reference from its study, if there is one, with outboard
/// brakes and inboard drive at a corner and the parts that its study names at a beam axle; problems go to the
/// reader of
/// `[vehicle]`.
void complete_other_axle(study::ObjectReader& vehicle, const study::Common& common, AxlePlace here,
                         OtherAxleForm& other);

/// The axes of the vehicle.
///
/// @param here this axle
/// @param place where this axle is
/// @param other the other one, completed
VehicleAxes axes_with(const AxleCentre& here, AxlePlace place, const OtherAxleForm& other, double wheelbase);

/// Facts of the other axle: its roll centre and its anti features.
void add_other_axle_facts(const study::AddFact& fact, const OtherAxleForm& other, AxlePlace here,
                          const VehicleLayout& layout);

}  // namespace linkwright::suspension
