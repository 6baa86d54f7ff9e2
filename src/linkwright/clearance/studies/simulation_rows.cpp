// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/studies/simulation_rows.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/studies/simulation.h"

namespace linkwright::clearance {

using planar::InputMotion;

namespace {

// Direction of a vector in the frame of a body.
double angle_in(const planar::LinkagePlan& plan, const planar::LinkageMotion& motion, int body,
                std::complex<double> vector) {
  return math::angle_difference(std::arg(vector),
                                math::angle_of(planar::body_state(plan, motion, body).direction));
}

}  // namespace

ClearanceRows::ClearanceRows(const ClearanceStudy& study, ClearanceRecording& out,
                             std::function<bool(RecordedRow&&)> keep)
    : s_(study), out_(out), keep_(std::move(keep)) {
  out_.columns = planar::driven_columns(s_.linkage, s_.plan, s_.quantities, s_.traces, s_.drives);
}

// ---- columns of a linkage whose joints are others ---------------------------------------------------------

// The value of a column of the linkage without clearance in the one with clearance. The drives of its own
// inputs are columns of the other.
ClearanceRows::Value ClearanceRows::value_of(const planar::LinkageColumn& column,
                                             const planar::Linkage& linkage, const planar::LinkagePlan& plan,
                                             std::span<const planar::LinkageColumn> own) const {
  for (std::size_t k = 0; k < s_.pins(); ++k) {
    const std::string key = identifier(s_.pin_name(k));
    if (column.key == key + "_x_N")
      return [k](const planar::LinkageInstant&, const RecordedRow& r) { return r.pins[k].force.x; };
    if (column.key == key + "_y_N")
      return [k](const planar::LinkageInstant&, const RecordedRow& r) { return r.pins[k].force.y; };
    if (column.key == key + "_N")
      return [k](const planar::LinkageInstant&, const RecordedRow& r) { return norm(r.pins[k].force); };
  }
  for (std::size_t k = s_.drives.size(); k < plan.inputs(); ++k)
    if (planar::input_key(linkage, plan, k) == column.key)
      return [k](const planar::LinkageInstant& i, const RecordedRow&) { return i.inputs[k].value; };
  const auto found = std::find_if(own.begin(), own.end(), [&](const auto& o) { return o.key == column.key; });
  if (found == own.end()) return {};
  return [v = found->value](const planar::LinkageInstant& i, const RecordedRow&) { return v(i); };
}

ClearanceRows::Stage ClearanceRows::stage(const planar::Linkage& linkage,
                                          const planar::LinkagePlan& plan) const {
  Stage out{&linkage, &plan};
  const std::vector<planar::LinkageColumn> own =
      planar::linkage_columns(linkage, plan, s_.quantities, s_.traces);
  for (const planar::LinkageColumn& c : out_.columns) out.values.push_back(value_of(c, linkage, plan, own));
  for (const planar::LinkageJoint& j : s_.linkage.joints)
    out.joints.push_back(planar::joint_index(linkage, j.name));
  for (std::size_t k = 0; k < s_.pins(); ++k) out.joints[at(s_.joint_of(k))] = -1;
  return out;
}

void ClearanceRows::expect(const ClearedLinkage& linkage, std::span<const JointClearance> clearances) {
  cleared_ = &linkage;
  for (const JointClearance& c : clearances) clearances_.push_back(c.clearance);
  continuous_ = stage(linkage.linkage, linkage.plan);
}

void ClearanceRows::expect(const OpenLinkage& linkage) {
  open_ = &linkage;
  contact_ = stage(linkage.linkage, linkage.plan);
  pressed_ = linkage.linkage;
  for (const OpenLinkage::Pin& pin : linkage.pins)
    for (const planar::BodyPoint& side : {pin.first, pin.second}) {
      planar::LinkageBody& body = pressed_.bodies[at(side.body)];
      pressed_.forces.emplace_back();
      pressed_.forces.back().point = {side.body, static_cast<int>(body.points.size())};
      body.points.push_back({"contact of " + pin.name, {0, 0}});
    }
}

void ClearanceRows::choose_columns() {
  std::vector<bool> known(out_.columns.size(), true);
  for (const std::optional<Stage>* stage : {&continuous_, &contact_})
    for (std::size_t c = 0; *stage && c < known.size(); ++c) known[c] = known[c] && (*stage)->values[c];
  const auto keep_known = [&](auto& list) {
    std::size_t c = 0;
    std::erase_if(list, [&](const auto&) { return !known[c++]; });
  };
  keep_known(out_.columns);
  for (std::optional<Stage>* stage : {&continuous_, &contact_})
    if (*stage) keep_known((*stage)->values);
}

// ---- rows -------------------------------------------------------------------------------------------------

bool ClearanceRows::add(const JointClearanceRow& c) {
  const planar::SimulationInstant& i = c.instant;
  RecordedRow row{.time = i.time,
                  .status = i.status,
                  .kinetic = i.kinetic,
                  .potential = i.potential,
                  .work = i.work,
                  .drift = i.drift};
  planar::solve_forces(cleared_->linkage, cleared_->plan, i, forces_);
  for (std::size_t k = 0; k < c.joints.size(); ++k) {
    const ClearanceState& state = c.joints[k];
    const planar::LinkageJoint& joint = s_.linkage.joints[at(s_.joint_of(k))];
    // The link points from the first body to the second, the eccentricity from the bush to the pin.
    const bool pin_first = s_.pin_side(k) == PinSide::first;
    // std::polar has no value for negative lengths.
    const std::complex<double> e =
        (pin_first ? -clearances_[k] : clearances_[k]) * std::polar(1.0, state.angle);
    // The pin of the bar at its carrier has the number of the joint.
    const bool by_first = cleared_->bars[k].carrier == joint.first.body;
    const math::Vec2 f = forces_.joints[at(s_.joint_of(k))].force;
    row.pins.push_back({.eccentricity = e,
                        .rate = std::complex<double>(0, state.rate) * e,
                        .bush_angle = angle_in(cleared_->plan, *i.motion,
                                               pin_first ? joint.second.body : joint.first.body, e),
                        .normal = state.tension,
                        .contact = state.tension > 0,
                        .angle = state.angle,
                        .angle_rate = state.rate,
                        .angle_acceleration = state.acceleration,
                        .force = by_first ? f : -f});
  }
  return finish(std::move(row), *continuous_, i.inputs, *i.motion);
}

PinInstant ClearanceRows::pin_in_contact(const ContactRow& c, std::size_t k) {
  const ContactState& state = c.joints[k];
  const OpenLinkage::Pin& pin = open_->pins[k];
  const bool pin_first = s_.contacts[k].pin == PinSide::first;
  const math::Vec2 e = math::vec(state.eccentricity);
  const math::Vec2 n = norm(e) > 0 ? (1 / norm(e)) * e : math::Vec2{1, 0};
  const math::Vec2 on_pin = -state.normal * n - state.friction * perpendicular(n);
  const math::Vec2 where =
      planar::point_motion(open_->linkage, open_->plan, *c.motion, pin_first ? pin.first : pin.second)
          .position +
      (s_.contacts[k].bush_radius - s_.contacts[k].clearance) * n;
  const math::Vec2 on_second = pin_first ? -on_pin : on_pin;
  const std::size_t first_force = s_.linkage.forces.size();
  for (std::size_t side = 0; side < 2; ++side) {
    planar::PointForce& force = pressed_.forces[first_force + 2 * k + side];
    force.force = number(side == 0 ? -on_second : on_second);
    const planar::PartState<double> frame = planar::body_state(open_->plan, *c.motion, force.point.body);
    pressed_.bodies[at(force.point.body)].points[at(force.point.point)].at =
        number(rotate_inverse(frame.direction, where - frame.origin));
  }
  // The clearance link, had it stayed: the vector between the points from the first body to the second.
  const std::complex<double> way = pin_first ? -state.eccentricity : state.eccentricity;
  return {.eccentricity = state.eccentricity,
          .rate = state.rate,
          .bush_angle = angle_in(open_->plan, *c.motion, pin_first ? pin.second.body : pin.first.body,
                                 state.eccentricity),
          .depth = state.depth,
          .normal = state.normal,
          .friction = state.friction,
          .contact = state.contact,
          .angle = std::arg(way),
          .force = on_second};
}

bool ClearanceRows::add(const ContactRow& c) {
  RecordedRow row{.time = c.time,
                  .kinetic = c.kinetic,
                  .potential = c.potential,
                  .elastic = c.elastic,
                  .dissipated = c.dissipated,
                  .work = c.work,
                  .drift = c.drift};
  for (std::size_t k = 0; k < c.joints.size(); ++k) row.pins.push_back(pin_in_contact(c, k));
  if (s_.quantities.dynamic())
    planar::solve_forces(pressed_, open_->plan, *c.motion, c.time, c.inputs[0].value, forces_);
  return finish(std::move(row), *contact_, c.inputs, *c.motion);
}

// Completes a row: values and what the drawing needs.
bool ClearanceRows::finish(RecordedRow row, const Stage& stage, std::span<const InputMotion> inputs,
                           const planar::LinkageMotion& motion) {
  const planar::LinkageInstant instant{row.time, {inputs.begin(), inputs.end()}, &motion, &forces_};
  for (const Value& value : stage.values)
    row.values.push_back(row.status == Status::done ? value(instant, row) : nan);
  row.inputs.assign(inputs.begin(), inputs.begin() + static_cast<std::ptrdiff_t>(s_.drives.size()));
  row.record.status = row.status;
  row.record.input = row.time;
  for (int b = 0; b < static_cast<int>(s_.linkage.bodies.size()); ++b)
    row.record.bodies.push_back(planar::body_state(*stage.plan, motion, b));
  if (forces_.status == Status::done && !forces_.joints.empty()) {
    for (const int j : stage.joints)
      row.record.joints.push_back(j < 0 ? planar::JointReaction() : forces_.joints[at(j)]);
    for (std::size_t k = 0; k < s_.pins(); ++k)
      row.record.joints[at(s_.joint_of(k))].force = row.pins[k].force;
    row.record.drives.assign(forces_.drives.begin(),
                             forces_.drives.begin() + static_cast<std::ptrdiff_t>(s_.drives.size()));
  }
  return keep_(std::move(row));
}

}  // namespace linkwright::clearance
