// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/compliance/coefficients.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <vector>

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

AxleCompliance axle_compliance(const Compliance& left, const Compliance& right, double rack_stiffness,
                               const AxleJoining& joining) {
  for (const Compliance* one : {&left, &right})
    LINKWRIGHT_REQUIRE(one->status == Status::done, "the compliance is {}: {}", to_string(one->status),
                       one->reason);
  LINKWRIGHT_REQUIRE(left.side == Side::left && right.side == Side::right,
                     "the first wheel is {}, the second {}", name_of(left.side), name_of(right.side));
  LINKWRIGHT_REQUIRE(rack_stiffness > 0, "rack stiffness {} N/m: positive, infinite for a held rack",
                     rack_stiffness);
  AxleCompliance out{.left = left, .right = right, .joining = joining};
  const std::array<const Compliance*, 2> wheels{&left, &right};
  for (std::size_t w = 0; w < 2; ++w)
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) out.at_centres[6 * w + i][6 * w + j] = wheels[w]->at_centre[i][j];
  // Unknown are the shifts of rack and subframe, each in balance with both suspensions, and the moment of the
  // bar. By reciprocity the force on a part that moves is the motion of the wheels by it.
  std::vector<std::size_t> moving;
  if (rack_stiffness < rigid) moving.push_back(0);
  if (joining.subframe)
    for (std::size_t i = 1; i < 7; ++i) moving.push_back(i);
  const bool bar = joining.bar > 0;
  const std::size_t grounds = moving.size(), count = grounds + (bar ? 1 : 0);
  if (count == 0) return out;
  const auto size = static_cast<Eigen::Index>(count);
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(size, size), by_loads = Eigen::MatrixXd::Zero(size, 12);
  for (std::size_t w = 0; w < 2; ++w) {
    const Compliance& wheel = *wheels[w];
    const auto first = static_cast<Eigen::Index>(6 * w);
    const double twist = joining.twist[w];
    for (std::size_t r = 0; r < grounds; ++r) {
      const auto row = static_cast<Eigen::Index>(r);
      for (Eigen::Index i = 0; i < 6; ++i)
        by_loads(row, first + i) = moving[r] == 0
                                       ? wheel.by_rack[static_cast<std::size_t>(i)]
                                       : wheel.by_subframe[static_cast<std::size_t>(i)][moving[r] - 1];
      for (std::size_t c = 0; c < grounds; ++c)
        a(row, static_cast<Eigen::Index>(c)) += wheel.ground_stiffness[moving[r]][moving[c]];
      if (bar) {
        a(row, size - 1) += twist * wheel.droplink_by_ground[moving[r]];
        a(size - 1, row) -= twist * wheel.droplink_by_ground[moving[r]];
      }
    }
    if (!bar) continue;
    a(size - 1, size - 1) += twist * twist * wheel.droplink_compliance;
    for (Eigen::Index i = 0; i < 6; ++i)
      by_loads(size - 1, first + i) = twist * wheel.by_droplink[static_cast<std::size_t>(i)];
  }
  for (std::size_t r = 0; r < grounds; ++r)
    for (std::size_t c = 0; c < grounds; ++c)
      if (moving[r] == 0 && moving[c] == 0)
        a(0, 0) += rack_stiffness;
      else if (moving[r] > 0 && moving[c] > 0)
        a(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) +=
            (*joining.subframe)[moving[r] - 1][moving[c] - 1];
  if (bar) a(size - 1, size - 1) += 1 / joining.bar;
  const Eigen::MatrixXd found = a.partialPivLu().solve(by_loads);
  Eigen::MatrixXd sides = by_loads;  // the bar's moment pulls the wheels back
  if (bar) sides.row(size - 1) *= -1;
  const Eigen::MatrixXd more = sides.transpose() * found;
  for (std::size_t j = 0; j < 12; ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    for (std::size_t i = 0; i < 12; ++i) out.at_centres[i][j] += more(static_cast<Eigen::Index>(i), column);
    for (std::size_t r = 0; r < grounds; ++r)
      (moving[r] == 0 ? out.rack[j] : out.subframe[moving[r] - 1][j]) =
          found(static_cast<Eigen::Index>(r), column);
    if (bar) out.bar[j] = found(size - 1, column);
  }
  return out;
}

AxleResponse respond(const AxleCompliance& axle, const WheelLoad& left, const WheelLoad& right) {
  const std::array<double, 12> load{left.force.x,  left.force.y,   left.force.z,   left.moment.x,
                                    left.moment.y, left.moment.z,  right.force.x,  right.force.y,
                                    right.force.z, right.moment.x, right.moment.y, right.moment.z};
  const auto sum = [&](const std::array<double, 12>& row) {
    double out = 0;
    for (std::size_t i = 0; i < 12; ++i) out += row[i] * load[i];
    return out;
  };
  AxleResponse out;
  out.rack = sum(axle.rack);
  for (std::size_t i = 0; i < 6; ++i) out.subframe[i] = sum(axle.subframe[i]);
  out.bar = sum(axle.bar);
  const auto wheel = [&](std::size_t w) {
    ElasticRow inputs{};
    std::copy_n(load.begin() + static_cast<std::ptrdiff_t>(6 * w), 6, inputs.begin());
    inputs[rack_input] = out.rack;
    std::copy(out.subframe.begin(), out.subframe.end(), inputs.begin() + subframe_input);
    inputs[droplink_input] = -axle.joining.twist[w] * out.bar;
    return respond(w == 0 ? axle.left : axle.right, inputs);
  };
  out.left = wheel(0);
  out.right = wheel(1);
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
