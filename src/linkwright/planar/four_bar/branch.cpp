#include "linkwright/planar/four_bar/branch.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <span>

#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/build.h"

namespace linkwright::planar {
namespace {

std::complex<double> complex_of(const Vec<double>& v) { return {v.x, v.y}; }

}  // namespace

Linkage linkage_of(const FourBar& f, const FourBarMasses* masses, double gravity) {
  Linkage l = grounded({{"O1", crank_pivot(f)}, {"O4", rocker_pivot(f)}});
  add_bar(l, "crank", "O1", "O2", f.crank);
  add_bar(l, "coupler", "O2", "O3", f.coupler);
  add_bar(l, "rocker", "O4", "O3", f.rocker);
  add_pin(l, "O1", "ground.O1", "crank.O1");
  add_pin(l, "O2", "crank.O2", "coupler.O2");
  add_pin(l, "O3", "rocker.O3", "coupler.O3");
  add_pin(l, "O4", "ground.O4", "rocker.O4");
  add_drive(l, "O1");
  set_mode(l, "coupler", "rocker", f.branch == Branch::open ? AssemblyMode::plus : AssemblyMode::minus);
  l.gravity = {0, -gravity};
  if (masses) {
    std::size_t body = 1;
    for (const LinkMass* m : {&masses->crank, &masses->coupler, &masses->rocker})
      l.bodies[body++].mass = BodyMass{m->mass, m->inertia, std::polar(m->centre_distance, m->centre_angle)};
  }
  return l;
}

FourBarBranch::FourBarBranch(const FourBar& four_bar, std::optional<FourBarMasses> masses, double gravity,
                             double from, double to, AtChangePoint at_change_point)
    : four_bar_(four_bar),
      masses_(std::move(masses)),
      gravity_(gravity),
      at_change_point_(at_change_point),
      linkage_(linkage_of(four_bar, masses_ ? &*masses_ : nullptr, gravity)) {
  PlanResult planned = plan_linkage(linkage_);
  if (!planned.problems.empty()) return;
  plan_ = std::move(planned.plan);
  modes_ = LinkageMotion(plan_).modes;
  const double start = four_bar.frame_angle + from, end = four_bar.frame_angle + to;
  BranchPath path = branch_path(plan_, std::span(&start, 1), 0, modes_, std::min(start, end),
                                std::max(start, end), at_change_point);
  if (path.status != Status::done) return;
  path_ = std::move(path);
  if (change_points().empty()) path_.reset();
}

// The change points along the branch, its ends among them, and whole turns away from them.
bool FourBarBranch::meets_at(double input) const {
  const auto here = [&](const RangeEnd& e) {
    return e.kind == EndKind::change_point && std::abs(std::remainder(input - e.value, 2 * pi)) < 1e-6;
  };
  return here(path_->low) || here(path_->high) ||
         std::any_of(path_->change_points.begin(), path_->change_points.end(), here);
}

std::vector<double> FourBarBranch::change_points() const {
  std::vector<double> out;
  const auto add = [&](const RangeEnd& e) {
    if (e.kind != EndKind::change_point) return;
    const double angle = math::wrap_angle(e.value - four_bar_.frame_angle);
    if (std::none_of(out.begin(), out.end(),
                     [&](double known) { return std::abs(math::wrap_angle(known - angle)) < 1e-6; }))
      out.push_back(angle);
  };
  if (!path_) return out;
  add(path_->low), add(path_->high);
  for (const RangeEnd& e : path_->change_points) add(e);
  std::sort(out.begin(), out.end());
  return out;
}

bool FourBarBranch::limits(const InputMotion& input, FourBarInstant& out) const {
  LinkageMotion motion(plan_);
  LinkageForces forces;
  const bool kink = at_change_point_ == AtChangePoint::keep_sign;
  if (!limit_at_change(plan_, *path_, input.value, input, motion, masses_ && !kink ? &linkage_ : nullptr,
                       forces))
    return false;
  const PartState<double> coupler = body_state(plan_, motion, 2), rocker = body_state(plan_, motion, 3);
  const auto direction = [](const PartState<double>& s) { return complex_of(s.direction); };
  const std::complex<double> frame = std::polar(1.0, four_bar_.frame_angle);
  FourBarPosition& pose = out.pose;
  pose.status = Status::done;
  pose.coupler_pin = complex_of(rocker.origin) + four_bar_.rocker * direction(rocker);
  pose.coupler_point = complex_of(coupler.origin) +
                       std::complex<double>(four_bar_.coupler_u, four_bar_.coupler_v) * direction(coupler);
  pose.coupler_angle = std::arg(direction(coupler) / frame);
  pose.rocker_angle = std::arg(direction(rocker) / frame);
  const double sine = cross(coupler.direction, rocker.direction);
  pose.transmission_angle = std::atan2(std::abs(sine), std::abs(dot(coupler.direction, rocker.direction)));
  FourBarRates& rates = out.rates;
  rates.coupler_direction = direction(coupler);
  rates.rocker_direction = direction(rocker);
  rates.transmission_sine = sine;
  rates.status = kink ? Status::singular : Status::done;
  out.forces.status = rates.status;
  if (kink) return true;
  rates.coupler_speed = coupler.speed, rates.coupler_acceleration = coupler.angular_acceleration;
  rates.rocker_speed = rocker.speed, rates.rocker_acceleration = rocker.angular_acceleration;
  if (!masses_) return true;
  FourBarReactions& f = out.forces;
  f.status = forces.status;
  f.ground_on_crank = complex_of(forces.joints[0].force);
  f.crank_on_coupler = complex_of(forces.joints[1].force);
  f.rocker_on_coupler = complex_of(forces.joints[2].force);
  f.ground_on_rocker = complex_of(forces.joints[3].force);
  f.drive_torque = forces.drives[0];
  f.shaking_force = -(f.ground_on_crank + f.ground_on_rocker);
  f.shaking_moment = -four_bar_.ground * (std::conj(frame) * f.ground_on_rocker).imag();
  f.shaking_moment_with_drive = f.shaking_moment - f.drive_torque;
  return true;
}

FourBarInstant FourBarBranch::at(double angle, double speed, double acceleration) const {
  FourBarInstant out;
  FourBar here = four_bar_;
  const InputMotion input{four_bar_.frame_angle + angle, speed, acceleration};
  bool beyond = false;
  if (path_) {
    std::vector<double> modes = modes_;
    beyond = modes_at(*path_, input.value, modes) != Status::done;
    if (modes != modes_) here.branch = other(here.branch);
  }
  out.pose = position(here, angle);
  out.rates = rates(here, angle, speed, acceleration);
  if (beyond) {
    const std::complex<double> pin = out.pose.crank_pin;
    out.pose = {};
    out.pose.crank_pin = pin;
    out.rates.coupler_direction = out.rates.rocker_direction = {nan, nan};
    out.rates.transmission_sine = nan;
    out.rates.coupler_speed = out.rates.coupler_acceleration = nan;
    out.rates.rocker_speed = out.rates.rocker_acceleration = nan;
    out.pose.status = out.rates.status = out.forces.status = Status::limit_reached;
    return out;
  }
  if (path_ && out.rates.status == Status::singular && meets_at(input.value))
    out.change_point = limits(input, out);
  if (out.change_point) return out;
  if (masses_)
    out.forces = reactions(here, *masses_, out.rates, gravity_);
  else
    out.forces.status = out.rates.status;
  return out;
}

}  // namespace linkwright::planar
