// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/coefficients.h"

#include <array>

#include "linkwright/core/check.h"

namespace linkwright::suspension {
namespace {

bool across_the_vehicle(LoadCase load) {
  return load == LoadCase::lateral || load == LoadCase::aligning_torque ||
         load == LoadCase::overturning_torque;
}

WheelLoad times(double factor, const WheelLoad& load) { return {factor * load.force, factor * load.moment}; }

}  // namespace

WheelLoad unit_load(const Compliance& compliance, LoadCase load) {
  const double outboard = compliance.side == Side::left ? 1 : -1;
  const Vec3 &centre = compliance.centre, &contact = compliance.contact;
  const Vec3 axis = wheel_axis(compliance.side, compliance.angles.toe, compliance.angles.camber);
  const auto wheel_free = [&](const Vec3& force) {
    WheelLoad out = load_at(centre, contact, force);
    out.moment = out.moment - dot(out.moment, axis) * axis;
    return out;
  };
  switch (load) {
    case LoadCase::lateral:
      return load_at(centre, contact, {0, outboard, 0});
    case LoadCase::brake_outboard:
      return load_at(centre, contact, {-1, 0, 0});
    case LoadCase::brake_inboard:
      return wheel_free({-1, 0, 0});
    case LoadCase::drive_inboard:
      return wheel_free({1, 0, 0});
    case LoadCase::drive_outboard:
      return load_at(centre, contact, {1, 0, 0});
    case LoadCase::longitudinal_at_centre:
      return {{1, 0, 0}, {}};
    case LoadCase::vertical:
      return load_at(centre, contact, {0, 0, 1});
    case LoadCase::vertical_at_centre:
      return {{0, 0, 1}, {}};
    case LoadCase::aligning_torque:
      return {{}, {0, 0, outboard}};
    case LoadCase::overturning_torque:
      return {{}, {-outboard, 0, 0}};
  }
  return {};
}

ComplianceCoefficients compliance_coefficients(const Compliance& compliance) {
  const double outboard = compliance.side == Side::left ? 1 : -1;
  const auto by = [&](LoadCase load) { return respond(compliance, unit_load(compliance, load)); };
  ComplianceCoefficients out{.support = compliance.support};
  const ElasticResponse lateral = by(LoadCase::lateral);
  out.lateral_steer = lateral.toe;
  out.lateral_camber = lateral.camber;
  out.lateral_at_contact = outboard * lateral.contact_shift.y;
  out.lateral_at_centre = outboard * lateral.shift.y;
  const ElasticResponse outboard_brake = by(LoadCase::brake_outboard);
  out.longitudinal_at_contact = -outboard_brake.contact_shift.x;
  out.brake_outboard_steer = outboard_brake.toe;
  out.brake_outboard_camber = outboard_brake.camber;
  out.brake_wind_up = angle_rates(compliance.side, compliance.angles, outboard_brake.turn).carrier_pitch;
  const ElasticResponse inboard_brake = by(LoadCase::brake_inboard);
  out.brake_inboard_steer = inboard_brake.toe;
  out.brake_inboard_camber = inboard_brake.camber;
  const ElasticResponse drive = by(LoadCase::drive_inboard);
  out.drive_steer = drive.toe;
  out.drive_camber = drive.camber;
  const ElasticResponse along = by(LoadCase::longitudinal_at_centre);
  out.longitudinal_at_centre = along.shift.x;
  out.longitudinal_steer = along.toe;
  const ElasticResponse aligning = by(LoadCase::aligning_torque);
  out.aligning_steer = aligning.toe;
  out.aligning_camber = aligning.camber;
  out.overturning_camber = by(LoadCase::overturning_torque).camber;
  out.vertical_at_contact = by(LoadCase::vertical).contact_shift.z;
  const Matrix6& c = compliance.at_centre;
  // Rounding of a held direction is no compliance; a billion N/m is beyond any wheel.
  const auto stiffness = [&](int i) { return c[i][i] > 1e-15 ? 1 / c[i][i] : rigid; };
  out.centre_stiffness = {stiffness(0), stiffness(1), stiffness(2)};
  return out;
}

AxleCompliance axle_compliance(const Compliance& left, const Compliance& right, double rack_stiffness) {
  for (const Compliance* one : {&left, &right})
    LINKWRIGHT_REQUIRE(one->status == Status::done, "the compliance is {}: {}", to_string(one->status),
                       one->reason);
  LINKWRIGHT_REQUIRE(left.side == Side::left && right.side == Side::right,
                     "the first wheel is {}, the second {}", name_of(left.side), name_of(right.side));
  LINKWRIGHT_REQUIRE(rack_stiffness > 0, "rack stiffness {} N/m: positive, infinite for a held rack",
                     rack_stiffness);
  AxleCompliance out{.left = left, .right = right};
  // The rack is free at its stiffness: its shift by a load is, by reciprocity, the wheel's motion by the rack
  // over all that resists the rack.
  std::array<double, 12> by_rack{};
  for (int i = 0; i < 6; ++i) {
    by_rack[i] = left.by_rack[i];
    by_rack[6 + i] = right.by_rack[i];
    for (int j = 0; j < 6; ++j) {
      out.at_centres[i][j] = left.at_centre[i][j];
      out.at_centres[6 + i][6 + j] = right.at_centre[i][j];
    }
  }
  const double resistance = rack_stiffness + left.rack_stiffness + right.rack_stiffness;
  for (int i = 0; i < 12; ++i) {
    out.rack[i] = by_rack[i] / resistance;
    for (int j = 0; j < 12; ++j) out.at_centres[i][j] += by_rack[i] * by_rack[j] / resistance;
  }
  return out;
}

AxleResponse respond(const AxleCompliance& axle, const WheelLoad& left, const WheelLoad& right) {
  const std::array<double, 12> load{left.force.x,  left.force.y,   left.force.z,   left.moment.x,
                                    left.moment.y, left.moment.z,  right.force.x,  right.force.y,
                                    right.force.z, right.moment.x, right.moment.y, right.moment.z};
  AxleResponse out;
  for (int i = 0; i < 12; ++i) out.rack += axle.rack[i] * load[i];
  out.left = respond(axle.left, left, out.rack);
  out.right = respond(axle.right, right, out.rack);
  // The steer angle about +z is -toe on the left and +toe on the right.
  out.steer = (out.right.toe - out.left.toe) / 2;
  out.toe_difference = out.left.toe - out.right.toe;
  return out;
}

AxleResponse respond(const AxleCompliance& axle, LoadCase load, Pairing pairing) {
  const bool same = (pairing == Pairing::parallel) != across_the_vehicle(load);
  return respond(axle, unit_load(axle.left, load), times(same ? 1 : -1, unit_load(axle.right, load)));
}

}  // namespace linkwright::suspension
