// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/smooth_branch.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "linkwright/core/numbers.h"

namespace linkwright::planar {

ChangeZone::Weights ChangeZone::interpolation(double x) {
  Weights out;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    out[i] = 1;
    for (std::size_t k = 0; k < nodes.size(); ++k)
      if (k != i) out[i] *= (x - nodes[k]) / (nodes[i] - nodes[k]);
  }
  return out;
}

SmoothBranch::SmoothBranch(const LinkagePlan& plan, double value, std::span<const double> modes) {
  const double unit = plan.rotary[0] ? 1 : plan.size;
  const double reach = plan.rotary[0] ? 4 * pi : 4 * plan.size;
  path_ =
      branch_path(plan, std::span(&value, 1), 0, modes, value - reach, value + reach, AtChangePoint::smooth);
  half_width_ = ChangeZone::width * unit;
  if (path_.change_points.empty()) return;
  // Nodes stay clear of what comes next.
  double gap = path_.period > 0
                   ? path_.change_points.front().value + path_.period - path_.change_points.back().value
                   : infinity;
  for (std::size_t i = 0; i < path_.change_points.size(); ++i) {
    const double here = path_.change_points[i].value;
    if (i > 0) gap = std::min(gap, here - path_.change_points[i - 1].value);
    if (path_.period == 0) gap = std::min({gap, here - path_.low.value, path_.high.value - here});
  }
  if (gap > 0) half_width_ = std::min(half_width_, gap / 6);
}

template <class Distance>
SmoothBranch::Near SmoothBranch::best(double value, Distance&& distance) const {
  Near out;
  double least = infinity;
  const bool repeats = path_.period > 0;
  const double turn = repeats ? std::floor((value - path_.start) / path_.period) : 0;
  for (const RangeEnd& end : path_.change_points)
    for (int k = repeats ? -1 : 0; k <= (repeats ? 1 : 0); ++k) {
      const double there = end.value + (turn + k) * path_.period;
      if (const double d = distance(there); d < least) least = d, out = {there, &end};
    }
  return out;
}
SmoothBranch::Near SmoothBranch::nearest(double value) const {
  return best(value, [&](double there) { return std::abs(there - value); });
}
SmoothBranch::Near SmoothBranch::next(double value, double sense) const {
  return best(value, [&](double there) {
    const double way = (there - value) * sense;
    return way > 0 ? way : infinity;
  });
}

namespace {

// Numbers at the nodes, interpolated to the middle. A pole there shows in its residue.
class Limit {
 public:
  explicit Limit(std::size_t count) : sum_(count), residue_(count), scale_(count) {}
  void add(std::size_t node, std::span<const double> values) {
    const double weight = weights_[node], x = ChangeZone::nodes[node];
    for (std::size_t i = 0; i < values.size(); ++i) {
      sum_[i] += weight * values[i];
      residue_[i] += weight * x * values[i];
      scale_[i] += std::abs(weight * x * values[i]);
    }
  }
  std::span<const double> values() const { return sum_; }
  // True if number i has a pole; the rounding error of a small number, beside the largest of all, is none.
  bool has_pole(std::size_t i) const {
    const double largest = *std::max_element(scale_.begin(), scale_.end());
    return !(std::abs(residue_[i]) <= std::max(1e-5 * scale_[i], 1e-10 * largest));
  }

 private:
  ChangeZone::Weights weights_ = ChangeZone::interpolation(0);
  std::vector<double> sum_, residue_, scale_;
};

// The numbers of forces, in one order for reading and writing.
template <class Visit>
void each_number(LinkageForces& f, Visit&& visit) {
  for (JointReaction& r : f.joints)
    visit(r.point.x), visit(r.point.y), visit(r.force.x), visit(r.force.y), visit(r.moment);
  for (double& d : f.drives) visit(d);
  visit(f.shaking_force.x), visit(f.shaking_force.y);
  visit(f.shaking_moment), visit(f.shaking_moment_with_drive);
  visit(f.drive_power), visit(f.load_power), visit(f.weight_power), visit(f.kinetic_power);
}

}  // namespace

bool limit_at_change(const LinkagePlan& plan, const BranchPath& path, double value, const InputMotion& input,
                     LinkageMotion& motion, const Linkage* linkage, LinkageForces& forces) {
  const double beside = ChangeZone::width * (plan.rotary[0] ? 1 : plan.size) / 8;
  std::vector<double> modes(plan.groups.size());
  double start = value - beside;
  if (modes_at(path, start, modes) != Status::done &&
      modes_at(path, start = value + beside, modes) != Status::done)
    return false;
  const SmoothBranch branch(plan, start, modes);
  if (branch.path().status != Status::done || !branch.has_change_points()) return false;
  const double centre = branch.nearest(value).value;
  if (std::abs(centre - value) > 1e-3 * beside) return false;
  // In the middle rounding leaves room for nodes twice as near as those of the zone: of a deltoid's speeds
  // they know ten digits instead of seven.
  const double half_width = branch.half_width() / 2;
  const std::size_t parts = plan.parts.size();
  Limit places(10 * parts);
  std::optional<Limit> loads;
  bool loaded = linkage != nullptr;
  std::vector<double> numbers;
  for (std::size_t i = 0; i < ChangeZone::nodes.size(); ++i) {
    InputMotion there = input;
    there.value = centre + ChangeZone::nodes[i] * half_width;
    branch.set_modes(there.value, motion);
    solve_motion(plan, std::span(&there, 1), motion);
    if (motion.status != Status::done) {
      motion.status = Status::singular;
      return false;
    }
    numbers.clear();
    for (const PartState<double>& s : motion.parts)
      numbers.insert(numbers.end(),
                     {s.origin.x, s.origin.y, s.direction.x, s.direction.y, s.velocity.x, s.velocity.y,
                      s.speed, s.acceleration.x, s.acceleration.y, s.angular_acceleration});
    places.add(i, numbers);
    if (!loaded) continue;
    solve_forces(*linkage, plan, motion, 0, there.value, forces);
    loaded = forces.status == Status::done;
    numbers.clear();
    each_number(forces, [&](double& v) { numbers.push_back(v); });
    if (!loads) loads.emplace(numbers.size());
    loads->add(i, numbers);
  }
  for (std::size_t p = 1; p < parts; ++p) {
    const double* v = &places.values()[10 * p];
    PartState<double>& s = motion.parts[p];
    const math::Vec2 direction{v[2], v[3]};
    s = {{v[0], v[1]}, (1 / norm(direction)) * direction, {v[4], v[5]}, v[6], {v[7], v[8]}, v[9]};
  }
  for (GroupState<double>& g : motion.groups) g.sine = 0;
  count_turns(plan, std::span(&input, 1), motion);
  motion.status = Status::done;
  motion.failed_group = -1;
  if (!linkage) return true;
  std::size_t next = 0;
  forces.status = loaded ? Status::done : Status::singular;
  each_number(forces, [&](double& v) {
    const std::size_t i = next++;
    const bool finite = loaded && !loads->has_pole(i);
    v = finite ? loads->values()[i] : nan;
    if (!finite) forces.status = Status::singular;
  });
  return true;
}

}  // namespace linkwright::planar
