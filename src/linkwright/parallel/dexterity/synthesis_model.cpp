// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/dexterity/detail/synthesis_model.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/interruption.h"
#include "linkwright/core/numbers.h"
#include "linkwright/parallel/pi_joint/range.h"
#include "linkwright/parallel/robot/constraint.h"
#include "linkwright/parallel/robot/regular_ball.h"

namespace linkwright::parallel {
namespace {

/// Poses of a part: about a millisecond. A multiple of what registers hold, so that parts change no bits.
constexpr std::size_t part_size = 4096;

void add(std::vector<PoseSet>& parts, const Mat3& rotation, const Vec3& place) {
  if (parts.empty() || parts.back().size() == part_size) {
    parts.emplace_back();
    parts.back().rotation = rotation;
  }
  PoseSet& set = parts.back();
  set.x.push_back(place.x);
  set.y.push_back(place.y);
  set.z.push_back(place.z);
}

/// True if a coordinate of a node is the first, the middle or the last of its row.
bool stands_out(const PrescribedRegion& region, const RegionPoint& point) {
  for (int k = 0; k < coordinates(region.shape); ++k) {
    const auto [lower, upper] = coordinate_range(region, k);
    const int last = region.nodes[k] - 1;
    const auto index = static_cast<int>(std::lround((point.at[k] - lower) / (upper - lower) * last));
    if (index != 0 && index != last / 2 && index != last) return false;
  }
  return true;
}

double min_rate(const PiRequirements& l) {
  return std::max(l.torque / l.force_limit, l.quantum / l.resolution);
}
double max_rate(const PiRequirements& l) { return l.speed > 0 ? l.rate_limit / l.speed : infinity; }

}  // namespace

DexterityModel::DexterityModel(const DexterityTask& task, const RunContext* context)
    : task_(task),
      context_(context),
      dimensions_(static_cast<int>(parallel::dimensions(task.family).size())),
      points_(region_nodes(task.region)) {
  const auto found = problem(task);
  LINKWRIGHT_REQUIRE(!found, "{}", *found);
  legs_ = task.family == RobotFamily::delta ? 3 : task.family == RobotFamily::hexa ? 6 : 2;
  travels_ = std::isfinite(task.limits.arm_travel) || task.pi_joint;
  measures_ = {.length = task.length,
               .output = bound(PoseLimit::output) > 0,
               .constraint = task.family == RobotFamily::delta};
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (stands_out(task.region, points_[i])) few_points_.push_back(i);
  const std::vector<RegionPoint> cells = region_cells(task.region);
  for (const RegionPoint& cell : cells)
    cell_weight_.push_back(cell.weight / static_cast<double>(task.orientations.size()));
  for (const Mat3& rotation : task.orientations) {
    Group group;
    for (const RegionPoint& point : points_) add(group.all, rotation, point.place);
    for (const std::size_t i : few_points_) add(group.few, rotation, points_[i].place);
    for (const RegionPoint& cell : cells) add(group.cells, rotation, cell.place);
    groups_.push_back(std::move(group));
  }
  nodes_ = points_.size() * groups_.size();
  const auto bounded = [&](const DesignRange& range) {
    lower_.push_back(range.lower);
    upper_.push_back(range.upper);
  };
  for (const DesignRange& range : task.dimensions) bounded(range);
  if (travels_) {
    bounded({-pi, pi});
    bounded({-pi, pi});
  }
  if (task.pi_joint) {
    bounded(task.pi_joint->mounting);
    bounded(task.pi_joint->ratio);
  }
}

DexterityModel::At DexterityModel::at(std::size_t node) const {
  const RegionPoint& point = points_[node % points_.size()];
  return {point.place, node / points_.size(), point.at};
}

std::vector<std::size_t> DexterityModel::few() const {
  std::vector<std::size_t> out;
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (const std::size_t i : few_points_) out.push_back(g * points_.size() + i);
  return out;
}

DesignedRobot DexterityModel::designed(std::span<const double> unknowns) const {
  DesignedRobot out = design(task_.family, unknowns.first(dimensions_));
  if (task_.family == RobotFamily::delta) {
    const Vec3 middle = out.offset * out.ahead + middle_of(task_.region);
    if (regular_at(out.robot, {middle}, task_.mode, 1).marks.constraint < 0) out.constraint = -1;
  }
  return out;
}

Extremes DexterityModel::extremes(const DesignedRobot& designed, Work& work, bool few) const {
  Extremes out;
  bool first = true;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    std::size_t before = 0;
    for (const PoseSet& poses : few ? groups_[g].few : groups_[g].all) {
      if (before > 0) throw_if_interrupted(context_);
      measure(designed, task_.mode, measures_, poses, false, work.set);
      for (std::size_t k = 0; k < poses.size(); ++k, first = false) {
        const std::size_t pose = g * points_.size() + (few ? few_points_[before + k] : before + k);
        const auto less = [&](double value, Extreme& extreme) {
          if (first || !(value >= extreme.value)) extreme = {value, pose};
        };
        const auto more = [&](double value, Extreme& extreme) {
          if (first || !(value <= extreme.value)) extreme = {value, pose};
        };
        less(work.set.conditioning[k], out.conditioning);
        if (measures_.constraint) less(work.set.constraint[k], out.constraint);
        for (int i = 0; i < legs_; ++i) {
          less(work.set.input_square[i][k], out.input_square[i]);
          if (measures_.output) less(work.set.output[i][k], out.output[i]);
          more(work.set.side[i][k], out.side[i]);
          const double angle = std::atan2(work.set.sine[i][k], work.set.cosine[i][k]);
          less(angle, out.lowest[i]);
          more(angle, out.highest[i]);
        }
      }
      before += poses.size();
    }
  }
  return out;
}

void DexterityModel::indices(const DesignedRobot& designed, PoseLimit::Kind kind, int leg, Work& work,
                             std::vector<double>& out) const {
  out.clear();
  for (const Group& group : groups_)
    for (const PoseSet& poses : group.all) {
      if (!out.empty()) throw_if_interrupted(context_);
      measure(designed, task_.mode, measures_, poses, false, work.set);
      const SetDexterity& set = work.set;
      const std::vector<double>& from = kind == PoseLimit::conditioning ? set.conditioning
                                        : kind == PoseLimit::constraint ? set.constraint
                                        : kind == PoseLimit::input      ? set.input_square[leg]
                                        : kind == PoseLimit::output     ? set.output[leg]
                                                                        : set.side[leg];
      for (std::size_t k = 0; k < poses.size(); ++k)
        out.push_back(kind == PoseLimit::arm_low || kind == PoseLimit::arm_high
                          ? std::atan2(set.sine[leg][k], set.cosine[leg][k])
                          : from[k]);
    }
}

double DexterityModel::mean(const DesignedRobot& designed, Work& work, std::span<double> by) const {
  double sum = 0;
  std::fill(by.begin(), by.end(), 0.0);
  for (const Group& group : groups_) {
    const double* weight = cell_weight_.data();
    for (const PoseSet& poses : group.cells) {
      if (weight != cell_weight_.data()) throw_if_interrupted(context_);
      measure(designed, task_.mode, measures_, poses, !by.empty(), work.set);
      for (std::size_t k = 0; k < poses.size(); ++k) sum += weight[k] * work.set.conditioning[k];
      for (int j = 0; !by.empty() && j < dimensions_; ++j)
        for (std::size_t k = 0; k < poses.size(); ++k) by[j] += weight[k] * work.set.conditioning_by[j][k];
      weight += poses.size();
    }
  }
  return sum;
}

bool DexterityModel::wants(PoseLimit::Kind kind) const {
  switch (kind) {
    case PoseLimit::output:
      return bound(kind) > 0;
    case PoseLimit::constraint:
      return measures_.constraint;
    case PoseLimit::side_swing:
      return task_.limits.side_swing < pi / 2;
    case PoseLimit::arm_low:
    case PoseLimit::arm_high:
      return travels_;
    case PoseLimit::conditioning:  // at least its sign, that of the assembly
    case PoseLimit::input:
      break;
  }
  return true;
}

double DexterityModel::bound(PoseLimit::Kind kind) const {
  const DexterityLimits& l = task_.limits;
  switch (kind) {
    case PoseLimit::conditioning:
      return l.conditioning;
    case PoseLimit::constraint:
      return std::max(l.constraint, constraint_floor);
    case PoseLimit::input:
      return std::max(l.input, l.transmission);
    case PoseLimit::output:
      return std::max(l.output, l.transmission);
    case PoseLimit::side_swing:
      return std::sin(std::min(l.side_swing, pi / 2));
    default:
      return 0;
  }
}

double DexterityModel::limit(const PoseLimit& which, const PoseDexterity<double>& there,
                             std::span<const double> unknowns, std::span<double> by) const {
  std::fill(by.begin(), by.end(), 0.0);
  const auto row = [&](double factor, const std::array<double, max_dimensions>& from) {
    for (int j = 0; !by.empty() && j < dimensions_; ++j) by[j] = factor * from[j];
  };
  const int i = which.leg;
  const auto angle = [&] { return std::atan2(there.sine[i], there.cosine[i]); };
  switch (which.kind) {
    case PoseLimit::conditioning:
      row(-1, there.conditioning_by);
      return limit(which.kind, {there.conditioning, 0}, unknowns);
    case PoseLimit::constraint:
      row(-1, there.constraint_by);
      return limit(which.kind, {there.constraint, 0}, unknowns);
    case PoseLimit::input:
      row(-1, there.input_square_by[i]);
      return limit(which.kind, {there.input_square[i], 0}, unknowns);
    case PoseLimit::output:
      row(-1, there.output_by[i]);
      return limit(which.kind, {there.output[i], 0}, unknowns);
    case PoseLimit::side_swing:
      row(1, there.side_by[i]);
      return limit(which.kind, {there.side[i], 0}, unknowns);
    case PoseLimit::arm_low:
      row(-1, there.angle_by[i]);
      if (!by.empty()) by[low_angle()] = 1;
      break;
    case PoseLimit::arm_high:
      row(1, there.angle_by[i]);
      if (!by.empty()) by[low_angle() + 1] = -1;
      break;
  }
  return limit(which.kind, {angle(), 0}, unknowns);
}

double DexterityModel::limit(PoseLimit::Kind kind, const Extreme& extreme,
                             std::span<const double> unknowns) const {
  switch (kind) {
    case PoseLimit::input:
      return bound(kind) * bound(kind) - extreme.value;
    case PoseLimit::side_swing:
      return extreme.value - bound(kind);
    case PoseLimit::arm_low:
      return unknowns[low_angle()] - extreme.value;
    case PoseLimit::arm_high:
      return extreme.value - unknowns[low_angle() + 1];
    case PoseLimit::conditioning:
    case PoseLimit::constraint:
    case PoseLimit::output:
      break;
  }
  return bound(kind) - extreme.value;
}

void DexterityModel::whole(std::span<const double> u, std::vector<Whole>& out,
                           std::vector<double>* by) const {
  out.clear();
  if (by) by->clear();
  const auto add = [&](const Whole& limit) -> double* {
    out.push_back(limit);
    if (!by) return nullptr;
    by->resize(by->size() + unknowns(), 0.0);
    return by->data() + by->size() - unknowns();
  };
  const int arm = dimensions_ - 3, rod = dimensions_ - 2, low = low_angle(), high = low + 1;
  if (const double most = task_.limits.size; std::isfinite(most)) {
    const double size = u[arm] + u[rod];
    if (double* row = add({DexterityLimit::size, size, most, false, size / most - 1}))
      row[arm] = row[rod] = 1 / most;
  }
  if (const double most = task_.limits.arm_travel; std::isfinite(most)) {
    const double travel = u[high] - u[low];
    if (double* row = add({DexterityLimit::arm_travel, travel, most, false, travel - most})) {
      row[high] = 1;
      row[low] = -1;
    }
  }
  if (!task_.pi_joint) return;

  const PiRequirements& limits = task_.pi_joint->limits;
  const int mirror = task_.pi_joint->mirror;
  const double first = mirror > 0 ? u[low] - u[mounting()] : u[mounting()] - u[high];
  const double last = mirror > 0 ? u[high] - u[mounting()] : u[mounting()] - u[low];
  const PiRange range = pi_range({u[arm], u[ratio()]}, first, last);
  const auto number = [&](DexterityLimit limit, double value, double bound, bool at_least,
                          const PiRangeNumber& excess) {
    double* row = add({limit, value, bound, at_least, excess.value});
    if (!row) return;
    row[arm] += excess.by[0];
    row[ratio()] += excess.by[1];
    // d first / d low = 1 and d last / d high = 1, or with the mirror -1 and crosswise.
    row[mirror > 0 ? low : high] += mirror * excess.by[2];
    row[mirror > 0 ? high : low] += mirror * excess.by[3];
    row[mounting()] -= mirror * (excess.by[2] + excess.by[3]);
  };
  const double end = pi / 2 - limits.end_margin;
  number(DexterityLimit::pi_low_end, first, -end, true, -end - PiRangeNumber::variable(first, 2));
  number(DexterityLimit::pi_high_end, last, end, false, PiRangeNumber::variable(last, 3) - end);
  if (std::isfinite(limits.telescoping)) {
    const PiRangeNumber telescoping = range.longest / range.shortest;
    number(DexterityLimit::telescoping, telescoping.value, limits.telescoping, false,
           telescoping / limits.telescoping - 1.0);
  }
  if (std::isfinite(limits.stroke)) {
    const PiRangeNumber stroke = range.longest - range.shortest;
    number(DexterityLimit::stroke, stroke.value, limits.stroke, false, stroke / limits.stroke - 1.0);
  }
  if (limits.transmission > 0)
    for (const PiRangeNumber& at_end : {range.transmission_low, range.transmission_high})
      number(DexterityLimit::pi_transmission, std::asin(std::min(1.0, at_end.value)), limits.transmission,
             true, std::sin(limits.transmission) - at_end);
  if (const double least = min_rate(limits); least > 0)
    for (const PiRangeNumber& at_end : {range.rate_low, range.rate_high})
      number(DexterityLimit::pi_rate_least, at_end.value, least, true, 1.0 - at_end / least);
  if (const double most = max_rate(limits); std::isfinite(most))
    number(DexterityLimit::pi_rate_most, range.rate_most.value, most, false, range.rate_most / most - 1.0);
}

DexterityModel::Travel DexterityModel::travel(const Extremes& extremes) const {
  double low = extremes.lowest[0].value, high = extremes.highest[0].value;
  for (int i = 1; i < legs_; ++i) {
    low = std::min(low, extremes.lowest[i].value);
    high = std::max(high, extremes.highest[i].value);
  }
  return {low, high};
}

std::vector<double> DexterityModel::unknowns_of(std::span<const double> x, const Extremes& extremes) const {
  std::vector<double> out(x.begin(), x.begin() + dimensions_);
  if (travels_) {
    const auto [low, high] = travel(extremes);
    out.push_back(low);
    out.push_back(high);
  }
  out.insert(out.end(), x.begin() + dimensions_, x.end());
  return out;
}

std::vector<double> DexterityModel::design_of(std::span<const double> unknowns) const {
  std::vector<double> out(unknowns.begin(), unknowns.begin() + dimensions_);
  out.insert(out.end(), unknowns.begin() + dimensions_ + 2 * travels_, unknowns.end());
  return out;
}

double DexterityModel::cost(std::span<const double> unknowns, const Extremes& extremes, double mean) const {
  switch (task_.goal) {
    case DexterityGoal::mean:
      return -mean;
    case DexterityGoal::size:
      return unknowns[dimensions_ - 3] + unknowns[dimensions_ - 2];
    case DexterityGoal::worst:
      break;
  }
  return -extremes.conditioning.value;
}

double DexterityModel::violation(std::span<const double> x, const Extremes& extremes) const {
  const std::vector<double> unknowns = unknowns_of(x, extremes);
  double sum = 0;
  const auto missed = [&](double g) { sum += g > feasible ? g : 0; };
  if (wants(PoseLimit::conditioning)) missed(limit(PoseLimit::conditioning, extremes.conditioning, unknowns));
  if (wants(PoseLimit::constraint)) missed(limit(PoseLimit::constraint, extremes.constraint, unknowns));
  for (int i = 0; i < legs_; ++i) {
    missed(limit(PoseLimit::input, extremes.input_square[i], unknowns));
    if (wants(PoseLimit::output)) missed(limit(PoseLimit::output, extremes.output[i], unknowns));
    if (wants(PoseLimit::side_swing)) missed(limit(PoseLimit::side_swing, extremes.side[i], unknowns));
  }
  std::vector<Whole> limits;
  whole(unknowns, limits, nullptr);
  for (const Whole& w : limits) missed(w.excess);
  return sum;
}

}  // namespace linkwright::parallel
