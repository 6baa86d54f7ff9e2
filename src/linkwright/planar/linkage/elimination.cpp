// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/elimination.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/band_solve.h"
#include "linkwright/planar/linkage/kernel.h"

namespace linkwright::planar {
namespace {

// Rows are scaled to about one: a pivot below is rounding.
constexpr double no_pivot = 1e-13;

// The direction of a slide, and where the joint acts.
math::Vec2 along_of(const PlanJoint& j, const LinkageMotion& motion) {
  return rotate(motion.parts[at(j.before.part)].direction, j.before.direction);
}
math::Vec2 point_of(const PlanJoint& j, const LinkageMotion& motion) {
  return point_on(motion.parts[at(j.after.part)], j.after.at);
}

}  // namespace

bool LinkageElimination::takes(const LinkagePlan& plan) {
  return std::none_of(plan.groups.begin(), plan.groups.end(),
                      [](const Group& g) { return !g.gears.empty() || !g.pairs.empty(); });
}

LinkageElimination::LinkageElimination(const LinkagePlan& plan, const std::vector<bool>& free)
    : plan_(plan), parts_(plan.parts.size()), joint_of_input_(plan.inputs()) {
  LINKWRIGHT_REQUIRE(takes(plan), "the linkage has gears, racks or belts");
  for (const Group& g : plan.groups)
    for (const PlanJoint& j : g.joints) {
      if (j.input >= 0) joint_of_input_[at(j.input)] = joints_.size();
      joints_.push_back({&j, j.input, j.input >= 0 && !free[at(j.input)], 0});
    }
  double largest = 0;
  for (const PartMass& m : plan.masses) largest = std::max(largest, m.mass);
  if (largest > 0) reference_ = largest;
  for (std::size_t p = 1; p < parts_.size(); ++p) {
    const PartMass& m = plan.masses[p];
    Part& part = parts_[p];
    part.length = plan.size;
    part.mass = m.mass / reference_;
    part.turning = 0;
    if (!(m.mass > 0)) {
      part.turning = m.inertia / (reference_ * plan.size * plan.size);
      part.mass = 0;
      continue;
    }
    part.local = (1 / m.mass) * m.moment;
    // The moment of inertia that rounding leaves of a point mass away from the origin is zero.
    const double inertia = m.inertia - m.mass * dot(part.local, part.local);
    if (inertia > 1e-12 * m.inertia) {
      part.length = std::sqrt(inertia / m.mass);
      part.turning = 1;
    }
  }
  order();
}

// Numbers parts (first) and joints along a breadth-first search from one that is far from the others.
void LinkageElimination::order() {
  const std::size_t parts = parts_.size(), nodes = parts + joints_.size();
  std::vector<std::vector<std::size_t>> neighbours(nodes);
  for (std::size_t j = 0; j < joints_.size(); ++j)
    for (const int p : {joints_[j].joint->before.part, joints_[j].joint->after.part})
      if (p != 0) {
        neighbours[at(p)].push_back(parts + j);
        neighbours[parts + j].push_back(at(p));
      }
  const auto search = [&](std::size_t from) {
    std::vector<bool> seen(nodes, false);
    std::vector<std::size_t> found{from};
    seen[from] = true;
    for (std::size_t i = 0; i < found.size(); ++i) {
      std::vector<std::size_t> next = neighbours[found[i]];
      std::sort(next.begin(), next.end(),
                [&](std::size_t a, std::size_t b) { return neighbours[a].size() < neighbours[b].size(); });
      for (const std::size_t n : next)
        if (!seen[n]) seen[n] = true, found.push_back(n);
    }
    return found;
  };
  std::vector<bool> placed(nodes, false);
  std::size_t place = 0;
  for (std::size_t n = 1; n < nodes; ++n) {
    if (placed[n]) continue;
    for (const std::size_t k : search(search(search(n).back()).back())) {
      placed[k] = true;
      if (k < parts) {
        parts_[k].place = place;
        place += 3;
      } else {
        joints_[k - parts].place = place;
        place += at(joints_[k - parts].rows());
      }
    }
  }
  width_ = 2;
  for (const Row& j : joints_)
    for (const int p : {j.joint->before.part, j.joint->after.part}) {
      if (p == 0) continue;
      const std::size_t a = parts_[at(p)].place, b = j.place;
      width_ = std::max(width_, a < b ? b + at(j.rows()) - 1 - a : a + 2 - b);
    }
  x_.resize(place);
  matrix_.resize(place * math::band_stride(width_));
}

bool LinkageElimination::solve(const LinkageMotion& motion, std::span<const Wrench<double>> needed) {
  motion_ = &motion;
  std::fill(matrix_.begin(), matrix_.end(), 0.0);
  const std::size_t stride = math::band_stride(width_);
  const auto entry = [&](std::size_t i, std::size_t j) -> double& {
    return matrix_[i * stride + j + width_ - i];
  };
  for (std::size_t p = 1; p < parts_.size(); ++p) {
    Part& part = parts_[p];
    const PartState<double>& s = motion.parts[p];
    const math::Vec2 arm = rotate(s.direction, part.local);
    part.centre = s.origin + arm;
    // Rows over the mass of the part (or the reference), turns times its length.
    const double scale = part.mass > 0 ? part.mass * reference_ : reference_;
    const std::size_t c = part.place;
    entry(c, c) = entry(c + 1, c + 1) = part.mass > 0 ? 1 : 0;
    entry(c + 2, c + 2) = part.turning;
    const Wrench<double>& w = needed[p];
    x_[c] = -w.force.x / scale;
    x_[c + 1] = -w.force.y / scale;
    x_[c + 2] = -(w.moment - cross(arm, w.force)) / (scale * part.length);
  }
  for (const Row& j : joints_) {
    const math::Vec2 point = point_of(*j.joint, motion);
    const bool slide = j.joint->slide;
    const math::Vec2 along = slide ? along_of(*j.joint, motion) : math::Vec2{1, 0};
    const int rows = j.rows();
    for (int i = 0; i < rows; ++i) x_[j.place + at(i)] = 0;
    for (const auto& [p, sign] :
         {std::pair{j.joint->after.part, 1.0}, std::pair{j.joint->before.part, -1.0}}) {
      if (p == 0) continue;
      const Part& part = parts_[at(p)];
      const math::Vec2 arm = point - part.centre;
      const double mass = part.mass > 0 ? part.mass : 1;
      const auto put = [&, sign = sign](int i, const math::Vec2& force, double moment) {
        const std::size_t row = j.place + at(i), c = part.place;
        const std::array<double, 3> values{sign * force.x, sign * force.y,
                                           sign * (moment + cross(arm, force)) / part.length};
        for (std::size_t k = 0; k < 3; ++k) {
          entry(row, c + k) += values[k];
          entry(c + k, row) -= values[k] / mass;
        }
      };
      // Rotations as displacements at the size of the linkage.
      if (slide) {
        put(0, perpendicular(along), 0);
        put(1, {0, 0}, plan_.size);
        if (rows == 3) put(2, along, 0);
      } else {
        put(0, {1, 0}, 0);
        put(1, {0, 1}, 0);
        if (rows == 3) put(2, {0, 0}, plan_.size);
      }
    }
  }
  return math::solve_band(matrix_, width_, x_, no_pivot);
}

double LinkageElimination::acceleration(std::size_t input) const {
  const PlanJoint& j = *joints_[joint_of_input_[input]].joint;
  const auto turning = [&](int p) {
    return p == 0 ? 0.0 : x_[parts_[at(p)].place + 2] / parts_[at(p)].length;
  };
  const double sense = j.reversed ? -1 : 1;
  if (!j.slide) return sense * (turning(j.after.part) - turning(j.before.part));
  const math::Vec2 point = point_of(j, *motion_);
  const auto moving = [&](int p) {
    if (p == 0) return math::Vec2{0, 0};
    const Part& part = parts_[at(p)];
    return math::Vec2{x_[part.place], x_[part.place + 1]} + turning(p) * perpendicular(point - part.centre);
  };
  return sense * dot(along_of(j, *motion_), moving(j.after.part) - moving(j.before.part));
}

double LinkageElimination::drive(std::size_t input) const {
  const Row& row = joints_[joint_of_input_[input]];
  const double sense = row.joint->reversed ? -1 : 1;
  return sense * reference_ * x_[row.place + 2] * (row.joint->slide ? 1 : plan_.size);
}

}  // namespace linkwright::planar
