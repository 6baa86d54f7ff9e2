// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/clearance/open_linkage.h"

#include <fmt/core.h>

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>
#include <optional>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/limits.h"

namespace linkwright::clearance {
namespace {

using planar::InputMotion, planar::JointType, planar::Linkage, planar::LinkageJoint, planar::LinkageMotion,
    planar::LinkagePlan, planar::PartState;

// Takes the joints out and keeps the numbers of the drives right.
void take_out(Linkage& l, std::span<const int> joints) {
  std::vector<int> number(l.joints.size());
  std::vector<LinkageJoint> left;
  for (std::size_t j = 0; j < l.joints.size(); ++j) {
    number[j] = static_cast<int>(left.size());
    if (std::find(joints.begin(), joints.end(), static_cast<int>(j)) == joints.end())
      left.push_back(l.joints[j]);
  }
  l.joints = std::move(left);
  for (int& d : l.driven) d = number[at(d)];
}

// A body of every cluster that hangs on nothing.
std::vector<int> loose_bodies(const Linkage& l) {
  std::vector<int> root(l.bodies.size());
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](int b) {
    while (root[at(b)] != b) b = root[at(b)];
    return b;
  };
  for (const LinkageJoint& j : l.joints) {
    if (j.type == JointType::gear) continue;  // turns, but does not hold
    const int a = find(j.first.body), b = find(j.second.body);
    root[at(std::max(a, b))] = std::min(a, b);
  }
  std::vector<int> out;
  for (std::size_t b = 1; b < root.size(); ++b)
    if (root[b] == static_cast<int>(b)) out.push_back(static_cast<int>(b));
  return out;
}

// Two massless blocks and a pin, all driven, between the ground and a body.
// Copies of the pose and of the name: both are in the list of bodies, which grows.
void guide(Linkage& l, int body, math::Pose pose) {
  const std::string name = l.bodies[at(body)].name;
  const int origin = static_cast<int>(l.bodies[0].points.size());
  l.bodies[0].points.push_back({"guide of " + name, {0, 0}});
  const int own = static_cast<int>(l.bodies[at(body)].points.size());
  l.bodies[at(body)].points.push_back({"guided", {0, 0}});
  const auto block = [&](const std::string& block_name, double x, double y) {
    l.bodies.push_back({.name = block_name + name,
                        .points = {{"at", {0, 0}}},
                        .mass = planar::BodyMass{},
                        .start = math::Pose{x, y, 0}});
    return static_cast<int>(l.bodies.size()) - 1;
  };
  const auto join = [&](LinkageJoint joint) {
    l.driven.push_back(static_cast<int>(l.joints.size()));
    l.joints.push_back(std::move(joint));
  };
  const int along = block("block along x of ", pose.x, 0);
  const int across = block("block along y of ", pose.x, pose.y);
  join({.name = "x of " + name, .type = JointType::prismatic, .first = {0, origin}, .second = {along, 0}});
  join({.name = "y of " + name,
        .type = JointType::prismatic,
        .first = {along, 0},
        .second = {across, 0},
        .slide_first = pi / 2,
        .slide_second = pi / 2});
  join({.name = "angle of " + name, .first = {across, 0}, .second = {body, own}});
}

// Adds `count` drives at joints that have none, so that the linkage can be planned; the best of all choices.
std::optional<LinkagePlan> choose_drives(Linkage& l, int count, std::string& problem) {
  constexpr int max_plans = 20'000;
  std::vector<int> candidates;
  for (std::size_t j = 0; j < l.joints.size(); ++j) {
    const bool has_coordinate =
        l.joints[j].type == JointType::revolute || l.joints[j].type == JointType::prismatic;
    if (has_coordinate && !has_friction(l.joints[j]) &&
        std::find(l.driven.begin(), l.driven.end(), static_cast<int>(j)) == l.driven.end())
      candidates.push_back(static_cast<int>(j));
  }
  if (count < 0 || at(count) > candidates.size()) return std::nullopt;
  std::vector<bool> chosen(candidates.size(), false);
  std::fill(chosen.begin(), chosen.begin() + count, true);
  const std::vector<int> before = l.driven;
  std::optional<LinkagePlan> best;
  std::vector<int> best_driven;
  int best_score = -1;
  for (int tried = 0; tried < max_plans; ++tried) {
    l.driven = before;
    for (std::size_t k = 0; k < candidates.size(); ++k)
      if (chosen[k]) l.driven.push_back(candidates[k]);
    planar::PlanResult result = planar::plan_linkage(l);
    if (!result.problems.empty()) problem = to_string(result.problems.front().message);
    if (result.problems.empty()) {
      int score = 0;
      for (const planar::Group& g : result.plan.groups)
        score += g.as<planar::Driver>() ? 100 : g.as<planar::GeneralGroup>() ? 0 : 1;
      if (score > best_score) {
        best_score = score;
        best = std::move(result.plan);
        best_driven = l.driven;
      }
    }
    if (!std::prev_permutation(chosen.begin(), chosen.end())) break;
  }
  if (best) l.driven = best_driven;
  return best;
}

// Coordinate of a driven joint at given poses.
double coordinate(const Linkage& l, const LinkageJoint& j) {
  const auto pose = [&](int body) { return body == 0 ? math::Pose{} : *l.bodies[at(body)].start; };
  const math::Pose first = pose(j.first.body), second = pose(j.second.body);
  if (j.type == JointType::revolute) return math::wrap_angle(second.angle - first.angle);
  const auto point = [&](const math::Pose& p, const planar::BodyPoint& b) {
    return math::transform(p, place_of(l, b));
  };
  const std::complex<double> way = point(second, j.second) - point(first, j.first);
  return (way * std::polar(1.0, -first.angle - j.slide_first)).real();
}

}  // namespace

void require_free_pins(const Linkage& l, std::span<const int> joints) {
  for (std::size_t k = 0; k < joints.size(); ++k) {
    LINKWRIGHT_REQUIRE(joints[k] >= 0 && at(joints[k]) < l.joints.size(), "there is no joint {} among {}",
                       joints[k], l.joints.size());
    const LinkageJoint& j = l.joints[at(joints[k])];
    LINKWRIGHT_REQUIRE(j.type == JointType::revolute && !has_friction(j) &&
                           std::find(l.driven.begin(), l.driven.end(), joints[k]) == l.driven.end(),
                       "joint '{}' must be a revolute joint without drive and friction", j.name);
    LINKWRIGHT_REQUIRE(std::count(joints.begin(), joints.end(), joints[k]) == 1, "joint '{}' is given twice",
                       j.name);
  }
}

OpenLinkage open_linkage(const Linkage& linkage, std::span<const int> joints,
                         std::span<const double> inputs) {
  require_free_pins(linkage, joints);
  LINKWRIGHT_REQUIRE(inputs.size() == linkage.driven.size(), "the linkage has {} inputs, got {}",
                     linkage.driven.size(), inputs.size());
  OpenLinkage out;
  const planar::PlanResult whole = planar::plan_linkage(linkage);
  if (!whole.problems.empty()) {
    out.status = Status::infeasible;
    out.message = to_string(whole.problems.front().message);
    return out;
  }
  LinkageMotion motion(whole.plan);
  std::vector<InputMotion> still;
  for (const double value : inputs) still.push_back({value, 0, 0});
  planar::solve_position(whole.plan, still, motion);
  if (motion.status != Status::done) {
    out.status = motion.status;
    out.message = "without clearance the start does not work: " +
                  to_string(planar::assembly_gap_text(whole.plan, motion, 0, inputs.empty() ? 0 : inputs[0]));
    return out;
  }
  out.linkage = linkage;
  Linkage& l = out.linkage;
  l.modes.clear();  // pairs change; places at the start give the modes
  for (std::size_t b = 1; b < l.bodies.size(); ++b) {
    const PartState<double> s = planar::body_state(whole.plan, motion, static_cast<int>(b));
    l.bodies[b].start = math::Pose{s.origin.x, s.origin.y, math::angle_of(s.direction)};
  }
  for (const int j : joints) {
    const LinkageJoint& pin = linkage.joints[at(j)];
    out.pins.push_back({pin.name, pin.first, pin.second});
  }
  take_out(l, joints);
  const std::vector<int> loose = loose_bodies(l);
  for (const int body : loose) guide(l, body, *l.bodies[at(body)].start);
  const int added = static_cast<int>(2 * joints.size()) - static_cast<int>(3 * loose.size());
  std::string problem;
  std::optional<LinkagePlan> plan = choose_drives(l, added, problem);
  if (!plan) {
    out.status = Status::infeasible;
    out.message =
        "without the clearance joints no joint coordinates are left that place all bodies: " + problem;
    return out;
  }
  out.plan = std::move(*plan);
  out.start.assign(inputs.begin(), inputs.end());
  for (std::size_t k = inputs.size(); k < l.driven.size(); ++k)
    out.start.push_back(coordinate(l, l.joints[at(l.driven[k])]));
  return out;
}

PinGap pin_gap(const OpenLinkage& open, const LinkageMotion& motion, std::size_t pin) {
  const auto point = [&](const planar::BodyPoint& p) {
    return planar::point_motion(open.linkage, open.plan, motion, p);
  };
  const planar::PointMotion a = point(open.pins[pin].first), b = point(open.pins[pin].second);
  return {math::number(b.position - a.position), math::number(b.velocity - a.velocity)};
}

Status place_pins(const OpenLinkage& open, std::span<const PinGap> gaps, std::vector<InputMotion>& inputs,
                  std::size_t original_inputs) {
  const auto n = static_cast<Eigen::Index>(2 * gaps.size());
  const auto first = original_inputs;
  LINKWRIGHT_REQUIRE(gaps.size() == open.pins.size() && inputs.size() == open.plan.inputs() &&
                         inputs.size() == first + 2 * gaps.size(),
                     "{} gaps, {} pins, {} inputs", gaps.size(), open.pins.size(), inputs.size());
  LinkageMotion motion(open.plan);
  Eigen::MatrixXd jacobian(n, n);
  Eigen::VectorXd right(n);
  const auto residual = [&](bool of_rates) {
    for (std::size_t k = 0; k < gaps.size(); ++k) {
      const PinGap gap = pin_gap(open, motion, k);
      const std::complex<double> off = of_rates ? gaps[k].rate - gap.rate : gaps[k].way - gap.way;
      right[static_cast<Eigen::Index>(2 * k)] = off.real();
      right[static_cast<Eigen::Index>(2 * k + 1)] = off.imag();
    }
  };
  const auto differentiate = [&] {
    std::vector<InputMotion> unit = inputs;
    for (InputMotion& u : unit) u.rate = 0;
    for (Eigen::Index c = 0; c < n; ++c) {
      unit[first + static_cast<std::size_t>(c)].rate = 1;
      planar::solve_velocity(open.plan, unit, motion);
      unit[first + static_cast<std::size_t>(c)].rate = 0;
      for (std::size_t k = 0; k < gaps.size(); ++k) {
        const std::complex<double> rate = pin_gap(open, motion, k).rate;
        jacobian(static_cast<Eigen::Index>(2 * k), c) = rate.real();
        jacobian(static_cast<Eigen::Index>(2 * k + 1), c) = rate.imag();
      }
    }
  };
  const double tolerance = 1e-15 * open.plan.size;
  bool placed = false;
  for (int iteration = 0; iteration < 50; ++iteration) {
    planar::solve_position(open.plan, inputs, motion);
    if (motion.status != Status::done) return motion.status;
    differentiate();
    residual(false);
    const double off = right.lpNorm<Eigen::Infinity>();
    if (off <= tolerance || (placed && iteration > 10)) break;
    placed = off <= 100 * tolerance;
    const Eigen::VectorXd step = jacobian.partialPivLu().solve(right);
    if (!step.allFinite()) return Status::singular;
    for (Eigen::Index c = 0; c < n; ++c) inputs[first + static_cast<std::size_t>(c)].value += step[c];
    if (iteration == 49 && !placed) return Status::not_converged;
  }
  for (std::size_t c = first; c < inputs.size(); ++c) inputs[c].rate = 0;
  planar::solve_velocity(open.plan, inputs, motion);
  residual(true);
  const Eigen::VectorXd rates = jacobian.partialPivLu().solve(right);
  if (!rates.allFinite()) return Status::singular;
  for (Eigen::Index c = 0; c < n; ++c) inputs[first + static_cast<std::size_t>(c)].rate = rates[c];
  return Status::done;
}

}  // namespace linkwright::clearance
