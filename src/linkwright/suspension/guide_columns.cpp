#include "linkwright/suspension/guide_columns.h"

#include <algorithm>
#include <array>

#include "linkwright/core/units.h"

namespace linkwright::suspension {
namespace {

using enum WheelQuantity;

template <double Vec3::*member>
double of_centre(const GuidePosition& p) {
  return p.place.carrier.centre.*member;
}

constexpr GuideColumn column(std::string_view key, std::string_view label, std::string_view group,
                             WheelQuantity quantity) {
  return {key, label, group, quantity, quantity};
}

constexpr std::array columns{
    GuideColumn{"centre_x_m", "wheel centre x (m)", "carrier", {}, {}, of_centre<&Vec3::x>},
    GuideColumn{"centre_y_m", "wheel centre y (m)", "carrier", {}, {}, of_centre<&Vec3::y>},
    GuideColumn{"centre_z_m", "wheel centre z (m)", "carrier", {}, {}, of_centre<&Vec3::z>},
    column("toe_rad", "toe (rad)", "toe", toe),
    column("camber_rad", "camber (rad)", "camber", camber),
    column("spin_rad", "spin of the carrier (rad)", "spin", spin),
    column("contact_x_m", "contact point x (m)", "contact", contact_x),
    column("contact_y_m", "contact point y (m)", "contact", contact_y),
    column("contact_z_m", "contact point z (m)", "contact", contact_z),
    column("half_track_change_m", "half-track change (m)", "track", half_track_change),
    column("track_m", "track of the symmetric axle (m)", "track", track),
    column("wheelbase_change_m", "wheelbase change at the contact point (m)", "wheelbase", wheelbase_change),
    column("recession_m", "wheel centre forward (m)", "wheelbase", recession),
    column("toe_by_travel_rad_per_m", "bump steer, toe by travel (rad/m)", "gains", toe_by_travel),
    column("camber_by_travel_rad_per_m", "camber by travel (rad/m)", "gains", camber_by_travel),
    column("roll_centre_height_m", "roll-centre height, kinematic (m)", "roll_centre", roll_centre_height),
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
    column("support_tangent", "support tangent, torque on the carrier", "support", support_tangent),
    column("support_tangent_free", "support tangent, torque on the body", "support", support_tangent_free),
    column("spring_length_m", "spring length (m)", "spring", spring_length),
    column("motion_ratio", "spring compression by wheel travel", "spring", motion_ratio),
    GuideColumn{"caster_rad", "caster (rad)", "steering_axis", caster_at_height, caster_at_spring},
    GuideColumn{"kingpin_inclination_rad", "kingpin inclination (rad)", "steering_axis",
                inclination_at_height, inclination_at_spring},
    GuideColumn{"trail_m", "trail along x (m)", "steering_axis", trail_at_height, trail_at_spring},
    GuideColumn{"scrub_radius_m", "scrub radius along y (m)", "steering_axis", scrub_at_height,
                scrub_at_spring},
    GuideColumn{"wheel_trail_m", "trail along the wheel (m)", "steering_axis", wheel_trail_at_height,
                wheel_trail_at_spring},
    GuideColumn{"wheel_scrub_radius_m", "scrub radius across the wheel (m)", "steering_axis",
                wheel_scrub_at_height, wheel_scrub_at_spring},
    GuideColumn{"caster_offset_m", "caster offset at the wheel centre (m)", "steering_axis",
                caster_offset_at_height, caster_offset_at_spring},
    GuideColumn{"kingpin_offset_m", "kingpin offset at the wheel centre (m)", "steering_axis",
                kingpin_offset_at_height, kingpin_offset_at_spring},
    column("toe_by_rack_rad_per_m", "toe by rack (rad/m)", "steering", toe_by_rack),
};

}  // namespace

std::span<const GuideColumn> guide_columns() { return columns; }

const GuideColumn* guide_column(std::string_view base) {
  const auto at = std::find_if(columns.begin(), columns.end(), [&](const GuideColumn& c) {
    const auto parts = split_unit(c.key);
    return base == (parts ? parts->base : c.key);
  });
  return at == columns.end() ? nullptr : &*at;
}

std::string_view words_of(const GuideColumn& column) {
  return column.label.substr(0, column.label.find(" ("));
}

std::optional<WheelQuantity> quantity_of(const GuideColumn& column, Driver lock) {
  return lock == Driver::spring ? column.at_spring : column.at_height;
}

const SteeringAxis* steering_axis_of(const WheelParameters& wheel, Driver lock) {
  const auto& axis = lock == Driver::spring ? wheel.axis_at_spring : wheel.axis_at_height;
  return axis && lock != Driver::contact_z ? &*axis : nullptr;
}

double value_of(const GuideColumn& column, const GuideRow& row) {
  if (row.position.status != Status::done) return WheelParameters::missing;
  const auto quantity = quantity_of(column, row.lock);
  return quantity ? value_of(row.wheel, *quantity) : column.place(row.position);
}

}  // namespace linkwright::suspension
