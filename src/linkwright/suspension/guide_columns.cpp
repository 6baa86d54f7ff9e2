#include "linkwright/suspension/guide_columns.h"

#include <algorithm>
#include <array>

namespace linkwright::suspension {
namespace {

using Row = GuideRow;
constexpr double missing = WheelParameters::missing;

/// A number of the steering axis.
template <double SteeringAxis::*member>
double of_axis(const Row& r) {
  return r.axis ? r.axis->*member : missing;
}
template <double WheelParameters::*member>
double of_wheel(const Row& r) {
  return r.wheel.*member;
}
bool there(const Row& r) { return r.position.status == Status::done; }
template <double WheelAngles::*member>
double of_angles(const Row& r) {
  return there(r) ? r.wheel.angles.*member : missing;
}
template <double Vec3::*member>
double of_centre(const Row& r) {
  return there(r) ? r.position.place.carrier.centre.*member : missing;
}
template <double Vec3::*member>
double of_contact(const Row& r) {
  return there(r) ? r.wheel.contact.*member : missing;
}

using W = WheelParameters;
using A = SteeringAxis;
constexpr std::array columns{
    GuideColumn{"centre_x_m", "wheel centre x (m)", "carrier", of_centre<&Vec3::x>},
    GuideColumn{"centre_y_m", "wheel centre y (m)", "carrier", of_centre<&Vec3::y>},
    GuideColumn{"centre_z_m", "wheel centre z (m)", "carrier", of_centre<&Vec3::z>},
    GuideColumn{"toe_rad", "toe (rad)", "toe", of_angles<&WheelAngles::toe>},
    GuideColumn{"camber_rad", "camber (rad)", "camber", of_angles<&WheelAngles::camber>},
    GuideColumn{"spin_rad", "spin of the carrier (rad)", "spin", of_angles<&WheelAngles::spin>},
    GuideColumn{"contact_x_m", "contact point x (m)", "contact", of_contact<&Vec3::x>},
    GuideColumn{"contact_y_m", "contact point y (m)", "contact", of_contact<&Vec3::y>},
    GuideColumn{"contact_z_m", "contact point z (m)", "contact", of_contact<&Vec3::z>},
    GuideColumn{"half_track_change_m", "half-track change (m)", "track", of_wheel<&W::half_track_change>},
    GuideColumn{"wheelbase_change_m", "wheelbase change at the contact point (m)", "wheelbase",
                of_wheel<&W::wheelbase_change>},
    GuideColumn{"recession_m", "wheel centre forward (m)", "wheelbase", of_wheel<&W::recession>},
    GuideColumn{"toe_by_travel_rad_per_m", "bump steer, toe by travel (rad/m)", "gains",
                of_wheel<&W::toe_by_travel>},
    GuideColumn{"camber_by_travel_rad_per_m", "camber by travel (rad/m)", "gains",
                of_wheel<&W::camber_by_travel>},
    GuideColumn{"roll_centre_height_m", "roll-centre height, kinematic (m)", "roll_centre",
                of_wheel<&W::roll_centre_height>},
    GuideColumn{"roll_centre_height_geometric_m", "roll-centre height, contact point free of spin (m)",
                "roll_centre", of_wheel<&W::roll_centre_height_geometric>},
    GuideColumn{"front_centre_y_m", "instant centre seen along x, y (m)", "instant_centres",
                [](const Row& r) { return r.wheel.front_centre[0]; }},
    GuideColumn{"front_centre_z_m", "instant centre seen along x, z (m)", "instant_centres",
                [](const Row& r) { return r.wheel.front_centre[1]; }},
    GuideColumn{"front_swing_arm_m", "front-view swing arm (m)", "instant_centres",
                of_wheel<&W::front_swing_arm>},
    GuideColumn{"side_centre_x_m", "instant centre seen along y, x (m)", "instant_centres",
                [](const Row& r) { return r.wheel.side_centre[0]; }},
    GuideColumn{"side_centre_z_m", "instant centre seen along y, z (m)", "instant_centres",
                [](const Row& r) { return r.wheel.side_centre[1]; }},
    GuideColumn{"side_swing_arm_m", "side-view swing arm (m)", "instant_centres",
                of_wheel<&W::side_swing_arm>},
    GuideColumn{"side_swing_angle_rad", "side-view swing arm above the ground (rad)", "instant_centres",
                of_wheel<&W::side_swing_angle>},
    GuideColumn{"support_tangent", "support tangent, torque on the carrier", "support",
                of_wheel<&W::support_tangent>},
    GuideColumn{"support_tangent_free", "support tangent, torque on the body", "support",
                of_wheel<&W::support_tangent_free>},
    GuideColumn{"spring_length_m", "spring length (m)", "spring", of_wheel<&W::spring_length>},
    GuideColumn{"motion_ratio", "spring compression by wheel travel", "spring", of_wheel<&W::motion_ratio>},
    GuideColumn{"caster_rad", "caster (rad)", "steering_axis", of_axis<&A::caster>},
    GuideColumn{"kingpin_inclination_rad", "kingpin inclination (rad)", "steering_axis",
                of_axis<&A::inclination>},
    GuideColumn{"trail_m", "trail along x (m)", "steering_axis", of_axis<&A::trail>},
    GuideColumn{"scrub_radius_m", "scrub radius along y (m)", "steering_axis", of_axis<&A::scrub>},
    GuideColumn{"wheel_trail_m", "trail along the wheel (m)", "steering_axis", of_axis<&A::wheel_trail>},
    GuideColumn{"wheel_scrub_radius_m", "scrub radius across the wheel (m)", "steering_axis",
                of_axis<&A::wheel_scrub>},
    GuideColumn{"caster_offset_m", "caster offset at the wheel centre (m)", "steering_axis",
                of_axis<&A::caster_offset>},
    GuideColumn{"kingpin_offset_m", "kingpin offset at the wheel centre (m)", "steering_axis",
                of_axis<&A::kingpin_offset>},
    GuideColumn{"toe_by_rack_rad_per_m", "toe by rack (rad/m)", "steering", of_wheel<&W::toe_by_rack>},
};

}  // namespace

std::span<const GuideColumn> guide_columns() { return columns; }

const GuideColumn* guide_column(std::string_view key) {
  const auto at =
      std::find_if(columns.begin(), columns.end(), [&](const GuideColumn& c) { return c.key == key; });
  return at == columns.end() ? nullptr : &*at;
}

const SteeringAxis* steering_axis_of(const WheelParameters& wheel, Driver lock) {
  const auto& axis = lock == Driver::spring ? wheel.axis_at_spring : wheel.axis_at_height;
  return axis && lock != Driver::contact_z ? &*axis : nullptr;
}

}  // namespace linkwright::suspension
