// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/workspace/proven_body.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "linkwright/parallel/robot/constraint.h"

namespace linkwright::parallel {
namespace {

constexpr double slack = 5e-4;  // margin of the indices, as in path_trouble.h
constexpr double edge = 1e-6;   // m: boxes so small at the edge of reach are let be

/// A box about the centre of the body, as shares of its half sizes.
struct Cell {
  Vec3 low, high;
};

/// The point of the cell nearest to the centre (or the axis), if it is in the body: then the body and the
/// cell meet.
Vec3 nearest(const Cell& c) {
  const auto clamp = [](double low, double high) { return std::clamp(0.0, low, high); };
  return {clamp(c.low.x, c.high.x), clamp(c.low.y, c.high.y), clamp(c.low.z, c.high.z)};
}

bool inside(InscribedShape shape, const Vec3& u) {
  const double across = u.x * u.x + u.y * u.y;
  switch (shape) {
    case InscribedShape::cylinder:
      return across <= 1;
    case InscribedShape::ball:
      return across + u.z * u.z <= 1;
    case InscribedShape::box:
      break;
  }
  return true;
}

}  // namespace

BodyProof prove(const TroubleTask& task, const Body& body, const Mat3& rotation, std::int64_t max_looks) {
  const double least = std::max(task.least_constraint, constraint_floor) - slack,
               min_rods = rods_floor - slack;
  const Vec3& h = body.half;
  const auto place = [&](const Vec3& u) { return body.centre + Vec3{h.x * u.x, h.y * u.y, h.z * u.z}; };
  const double flat = h.z > 0 ? 1 : 0;
  BodyProof out;
  // The cell with the least to spare comes first: where something is wrong it is soon found.
  struct Open {
    double spare;
    Cell cell;
    bool operator<(const Open& other) const { return spare > other.spare; }
  };
  std::vector<Open> open;
  // False: the cell holds a place that violates.
  const auto look = [&](const Cell& cell) {
    if (!inside(body.shape, nearest(cell))) return true;
    // A place of the body, and a ball about it that holds the cell.
    Vec3 centre = 0.5 * (cell.low + cell.high);
    if (!inside(body.shape, centre)) centre = nearest(cell);
    const auto reach = [](double low, double middle, double high) {
      return std::max(high - middle, middle - low);
    };
    const double radius = norm(Vec3{h.x * reach(cell.low.x, centre.x, cell.high.x),
                                    h.y * reach(cell.low.y, centre.y, cell.high.y),
                                    h.z * reach(cell.low.z, centre.z, cell.high.z)});
    const RegularAt at = regular_at(task.robot, {place(centre), rotation}, task.mode, task.length);
    ++out.looks;
    if (!at.reached || at.marks != task.home || at.constraint < least || at.rods < min_rods) {
      // Beyond the edge of reach by no more than rounding.
      if (!at.reached && radius < edge && at.reach > -1e-6) return true;
      out.violated = place(centre);
      return false;
    }
    const double spare = std::min(at.constraint - least, at.rods - min_rods);
    const auto change = change_within(task.robot, at, {radius, 0}, task.length);
    if (change ? *change <= spare : radius < edge) return true;
    open.push_back({spare, cell});
    std::push_heap(open.begin(), open.end());
    return true;
  };
  if (!look({{-1, -1, -flat}, {1, 1, flat}})) return out;
  while (!open.empty()) {
    if (out.looks >= max_looks) return out;
    std::pop_heap(open.begin(), open.end());
    const Cell cell = open.back().cell;
    open.pop_back();
    const Vec3 size{h.x * (cell.high.x - cell.low.x), h.y * (cell.high.y - cell.low.y),
                    h.z * (cell.high.z - cell.low.z)};
    Cell first = cell, second = cell;
    if (size.x >= size.y && size.x >= size.z)
      first.high.x = second.low.x = (cell.low.x + cell.high.x) / 2;
    else if (size.y >= size.z)
      first.high.y = second.low.y = (cell.low.y + cell.high.y) / 2;
    else
      first.high.z = second.low.z = (cell.low.z + cell.high.z) / 2;
    if (!look(first) || !look(second)) return out;
  }
  out.proven = true;
  return out;
}

}  // namespace linkwright::parallel
