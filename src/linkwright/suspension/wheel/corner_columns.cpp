// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/wheel/corner_columns.h"

#include <algorithm>
#include <array>

#include "linkwright/core/units.h"
#include "linkwright/suspension/corner/position.h"

namespace linkwright::suspension {
namespace {

using enum WheelQuantity;

template <double Vec3::*member>
double of_centre(const CornerPosition& p) {
  return p.place.carrier.centre.*member;
}

constexpr CornerColumn column(std::string_view key, std::string_view label, std::string_view group,
                              WheelQuantity quantity) {
  return {key, label, group, quantity, quantity, quantity};
}
/// One of the steering axis.
constexpr CornerColumn column(std::string_view key, std::string_view label, WheelQuantity at_height,
                              WheelQuantity at_spring, WheelQuantity at_contact) {
  return {key, label, "steering_axis", at_height, at_spring, at_contact};
}

constexpr std::array columns{
    CornerColumn{"centre_x_m", "wheel centre x (m)", "carrier", {}, {}, {}, of_centre<&Vec3::x>},
    CornerColumn{"centre_y_m", "wheel centre y (m)", "carrier", {}, {}, {}, of_centre<&Vec3::y>},
    CornerColumn{"centre_z_m", "wheel centre z (m)", "carrier", {}, {}, {}, of_centre<&Vec3::z>},
    column("toe_rad", "toe (rad)", "toe", toe),
    column("camber_rad", "camber (rad)", "camber", camber),
    column("front_view_camber_rad", "camber seen along x (rad)", "camber", front_view_camber),
    column("carrier_pitch_rad", "carrier pitch (rad)", "carrier_pitch", carrier_pitch),
    column("contact_x_m", "contact point x (m)", "contact", contact_x),
    column("contact_y_m", "contact point y (m)", "contact", contact_y),
    column("contact_z_m", "contact point z (m)", "contact", contact_z),
    column("half_track_change_m", "half-track change (m)", "track", half_track_change),
    column("track_m", "track of the symmetric axle (m)", "track", track),
    column("wheelbase_change_m", "wheelbase change at the contact point (m)", "wheelbase", wheelbase_change),
    column("recession_m", "recession: wheel centre rearward (m)", "wheelbase", recession),
    column("toe_by_travel_rad_per_m", "bump steer, toe by height of the wheel centre (rad/m)", "gains",
           toe_by_travel),
    column("camber_by_travel_rad_per_m", "camber by height of the wheel centre (rad/m)", "gains",
           camber_by_travel),
    column("roll_centre_height_m", "roll-centre height, wheel held by the carrier (m)", "roll_centre",
           roll_centre_height),
    column("roll_centre_height_geometric_m", "roll-centre height, contact point free of spin (m)",
           "roll_centre", roll_centre_height_geometric),
    column("front_centre_y_m", "instant centre seen along x, y (m)", "instant_centres", front_centre_y),
    column("front_centre_z_m", "instant centre seen along x, z (m)", "instant_centres", front_centre_z),
    column("front_swing_arm_m", "front-view swing arm (m)", "instant_centres", front_swing_arm),
    column("side_centre_x_m", "instant centre seen along y, x (m)", "instant_centres", side_centre_x),
    column("side_centre_z_m", "instant centre seen along y, z (m)", "instant_centres", side_centre_z),
    column("side_swing_arm_m", "side-view swing arm (m)", "instant_centres", side_swing_arm),
    column("side_swing_angle_rad", "side-view swing arm above the ground (rad)", "instant_centres",
           side_swing_angle),
    column("anti_pitch_tangent", "anti-pitch tangent (dive, lift, squat), torque on the carrier",
           "anti_pitch", anti_pitch_tangent),
    column("anti_pitch_tangent_free", "anti-pitch tangent (dive, lift, squat), torque on the body",
           "anti_pitch", anti_pitch_tangent_free),
    column("spring_length_m", "spring length (m)", "spring", spring_length),
    column("motion_ratio", "spring compression by height of the wheel centre", "spring", motion_ratio),
    column("caster_rad", "caster (rad)", caster_at_height, caster_at_spring, caster_at_contact),
    column("kingpin_inclination_rad", "kingpin inclination (rad)", inclination_at_height,
           inclination_at_spring, inclination_at_contact),
    column("trail_m", "trail along x (m)", trail_at_height, trail_at_spring, trail_at_contact),
    column("scrub_radius_m", "scrub radius along y (m)", scrub_at_height, scrub_at_spring, scrub_at_contact),
    column("wheel_trail_m", "trail along the wheel (m)", wheel_trail_at_height, wheel_trail_at_spring,
           wheel_trail_at_contact),
    column("wheel_scrub_radius_m", "scrub radius across the wheel (m)", wheel_scrub_at_height,
           wheel_scrub_at_spring, wheel_scrub_at_contact),
    column("caster_offset_m", "caster offset at the wheel centre (m)", caster_offset_at_height,
           caster_offset_at_spring, caster_offset_at_contact),
    column("kingpin_offset_m", "kingpin offset at the wheel centre (m)", kingpin_offset_at_height,
           kingpin_offset_at_spring, kingpin_offset_at_contact),
    column("steering_pitch_m", "pitch of the steering screw (m by radian)", axis_pitch_at_height,
           axis_pitch_at_spring, axis_pitch_at_contact),
    column("toe_by_rack_rad_per_m", "toe by rack, wheel-centre height held (rad/m)", "steering", toe_by_rack),
    column("contact_held_caster_rad", "caster, contact height held (rad)", "contact_axis", caster_at_contact),
    column("contact_held_kingpin_inclination_rad", "kingpin inclination, contact height held (rad)",
           "contact_axis", inclination_at_contact),
    column("contact_held_trail_m", "trail along x, contact height held (m)", "contact_axis",
           trail_at_contact),
    column("contact_held_scrub_radius_m", "scrub radius along y, contact height held (m)", "contact_axis",
           scrub_at_contact),
    column("contact_held_wheel_trail_m", "trail along the wheel, contact height held (m)", "contact_axis",
           wheel_trail_at_contact),
    column("contact_held_wheel_scrub_radius_m", "scrub radius across the wheel, contact height held (m)",
           "contact_axis", wheel_scrub_at_contact),
    column("contact_held_caster_offset_m", "caster offset at the wheel centre, contact height held (m)",
           "contact_axis", caster_offset_at_contact),
    column("contact_held_kingpin_offset_m", "kingpin offset at the wheel centre, contact height held (m)",
           "contact_axis", kingpin_offset_at_contact),
    column("geometric_caster_rad", "caster, through the ball joints (rad)", "geometric_axis",
           geometric_caster),
    column("geometric_kingpin_inclination_rad", "kingpin inclination, through the ball joints (rad)",
           "geometric_axis", geometric_inclination),
    column("geometric_trail_m", "trail along x, through the ball joints (m)", "geometric_axis",
           geometric_trail),
    column("geometric_scrub_radius_m", "scrub radius along y, through the ball joints (m)", "geometric_axis",
           geometric_scrub),
    column("geometric_wheel_trail_m", "trail along the wheel, through the ball joints (m)", "geometric_axis",
           geometric_wheel_trail),
    column("geometric_wheel_scrub_radius_m", "scrub radius across the wheel, through the ball joints (m)",
           "geometric_axis", geometric_wheel_scrub),
    column("geometric_caster_offset_m", "caster offset at the wheel centre, through the ball joints (m)",
           "geometric_axis", geometric_caster_offset),
    column("geometric_kingpin_offset_m", "kingpin offset at the wheel centre, through the ball joints (m)",
           "geometric_axis", geometric_kingpin_offset),
    column("arm_roll_centre_height_m", "roll-centre height by the planes of the arms (m)", "arm_planes",
           arm_roll_centre_height),
    column("arm_front_centre_y_m", "instant centre seen along x by the planes of the arms, y (m)",
           "arm_planes", arm_front_centre_y),
    column("arm_front_centre_z_m", "instant centre seen along x by the planes of the arms, z (m)",
           "arm_planes", arm_front_centre_z),
    column("arm_front_swing_arm_m", "front-view swing arm by the planes of the arms (m)", "arm_planes",
           arm_front_swing_arm),
    column("arm_side_centre_x_m", "instant centre seen along y by the planes of the arms, x (m)",
           "arm_planes", arm_side_centre_x),
    column("arm_side_centre_z_m", "instant centre seen along y by the planes of the arms, z (m)",
           "arm_planes", arm_side_centre_z),
    column("arm_side_swing_arm_m", "side-view swing arm by the planes of the arms (m)", "arm_planes",
           arm_side_swing_arm),
    column("arm_side_swing_angle_rad", "side-view swing arm above the ground by the planes of the arms (rad)",
           "arm_planes", arm_side_swing_angle),
    column("screw_pitch_m", "pitch of the carrier's screw by travel (m by radian)", "screw", screw_pitch),
};

}  // namespace

std::span<const CornerColumn> corner_columns() { return columns; }

const CornerColumn* corner_column(std::string_view base) {
  const auto at = std::find_if(columns.begin(), columns.end(), [&](const CornerColumn& c) {
    const auto parts = split_unit(c.key);
    return base == (parts ? parts->base : c.key);
  });
  return at == columns.end() ? nullptr : &*at;
}

std::string_view words_of(const CornerColumn& column) {
  return column.label.substr(0, column.label.find(" ("));
}

std::optional<WheelQuantity> quantity_of(const CornerColumn& column, Driver lock) {
  return lock == Driver::spring      ? column.at_spring
         : lock == Driver::contact_z ? column.at_contact
                                     : column.at_height;
}

std::string why_missing(const Suspension& suspension, const CornerColumn& column) {
  const std::string_view group = column.group;
  const bool steered = std::any_of(suspension.links.begin(), suspension.links.end(),
                                   [](const CornerLink& l) { return l.moved_by_rack; });
  if (group == "spring" && !suspension.spring) return "there is no spring";
  if ((group == "steering_axis" || group == "steering" || group == "contact_axis") && !steered)
    return "no link is moved by the rack";
  if (group == "geometric_axis") return why_no_axis(suspension);
  if (group == "arm_planes") return why_no_planes(suspension);
  return {};
}

const SteeringAxis* steering_axis_of(const WheelParameters& wheel, Driver lock) {
  const auto& axis = lock == Driver::spring      ? wheel.axis_at_spring
                     : lock == Driver::contact_z ? wheel.axis_at_contact
                                                 : wheel.axis_at_height;
  return axis ? &*axis : nullptr;
}

double value_of(const CornerColumn& column, const CornerRow& row) {
  if (row.position.status != Status::done) return WheelParameters::missing;
  const auto quantity = quantity_of(column, row.lock);
  return quantity ? value_of(row.wheel, *quantity) : column.place(row.position);
}

}  // namespace linkwright::suspension
