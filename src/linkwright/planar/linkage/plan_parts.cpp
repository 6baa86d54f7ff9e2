// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <complex>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/planar/linkage/detail/plan_draft.h"

namespace linkwright::planar {
namespace {

struct PoseOnRoot {
  math::Vec2 origin{0, 0}, turn{1, 0};
};

math::Vec2 point_of_body(const PlanDraft& d, const BodyPoint& p) { return math::vec(place_of(d.linkage, p)); }

// Bodies joined by welds become one part, in the frame of the first of them.
void weld_bodies(PlanDraft& d) {
  const int n = static_cast<int>(d.linkage.bodies.size());
  std::vector<int> root(at(n));
  std::iota(root.begin(), root.end(), 0);
  std::vector<PoseOnRoot> pose(at(n));
  for (int k = 0; k < static_cast<int>(d.linkage.joints.size()); ++k) {
    const LinkageJoint& j = d.model(k);
    if (j.type != JointType::fixed) continue;
    const int a = j.first.body, b = j.second.body;
    if (root[at(a)] == root[at(b)]) {
      d.error("joint." + j.name,
              fmt::format("welds '{}' and '{}', which are welded together already: a redundant constraint",
                          d.body_name(a), d.body_name(b)),
              "leave it out");
      return;
    }
    // Frame of b in the frame of a, then in that of a's root; all of b's part moves over.
    const math::Vec2 turn_ba = math::unit(j.slide_first - j.slide_second);
    const math::Vec2 origin_ba = point_of_body(d, j.first) - rotate(turn_ba, point_of_body(d, j.second));
    const PoseOnRoot &ra = pose[at(a)], rb = pose[at(b)];
    const PoseOnRoot b_in_root{ra.origin + rotate(ra.turn, origin_ba),
                               renormalised(rotate(ra.turn, turn_ba))};
    const math::Vec2 old_turn = rotate(b_in_root.turn, conjugate(rb.turn));
    const math::Vec2 old_origin = b_in_root.origin - rotate(old_turn, rb.origin);
    const int from = root[at(b)], to = root[at(a)];
    for (int i = 0; i < n; ++i)
      if (root[at(i)] == from) {
        pose[at(i)] = {old_origin + rotate(old_turn, pose[at(i)].origin),
                       renormalised(rotate(old_turn, pose[at(i)].turn))};
        root[at(i)] = to;
      }
  }
  // The frame of a part is that of its lowest body; the ground is always part 0.
  std::vector<int> part_of_root(at(n), -1);
  d.plan().bodies.resize(at(n));
  std::vector<int> lowest;
  for (int i = 0; i < n; ++i) {
    int& part = part_of_root[at(root[at(i)])];
    if (part < 0) {
      part = static_cast<int>(d.plan().parts.size());
      d.plan().parts.push_back(d.body_name(i));
      lowest.push_back(i);
    } else {
      d.plan().parts[at(part)] += " + " + d.body_name(i);
    }
    const PoseOnRoot& base = pose[at(lowest[at(part)])];
    BodyOnPart& b = d.plan().bodies[at(i)];
    b.part = part;
    b.turn = rotate(conjugate(base.turn), pose[at(i)].turn);
    b.origin = rotate_inverse(base.turn, pose[at(i)].origin - base.origin);
    b.same_frame = lowest[at(part)] == i;
    if (b.same_frame) b.origin = {0, 0}, b.turn = {1, 0};
  }
  d.start.assign(d.plan().parts.size(), std::nullopt);
  d.start[0] = math::Pose{};
  for (int i = 1; i < n; ++i) {
    const BodyOnPart& b = d.plan().bodies[at(i)];
    if (b.part == 0 || d.start[at(b.part)] || !d.linkage.bodies[at(i)].start) continue;
    const math::Pose& s = *d.linkage.bodies[at(i)].start;
    const math::Vec2 direction = rotate(math::unit(s.angle), conjugate(b.turn));
    const math::Vec2 origin = math::Vec2{s.x, s.y} - rotate(direction, b.origin);
    d.start[at(b.part)] = math::Pose{origin.x, origin.y, angle_of(direction)};
  }
}

void join_parts(PlanDraft& d) {
  for (int k = 0; k < static_cast<int>(d.linkage.joints.size()); ++k) {
    const LinkageJoint& j = d.model(k);
    if (j.type == JointType::fixed) continue;
    const auto driven = std::find(d.linkage.driven.begin(), d.linkage.driven.end(), k);
    const int input =
        driven == d.linkage.driven.end() ? -1 : static_cast<int>(driven - d.linkage.driven.begin());
    if (j.type == JointType::gear && (j.curve || j.geneva)) {
      if (j.curve) add_curve(d, k);
      continue;
    }
    if (j.type == JointType::gear) {
      d.gears.push_back({k,
                         d.plan().bodies[at(j.first.body)].part,
                         d.plan().bodies[at(j.second.body)].part,
                         d.plan().bodies[at(j.carrier)].part,
                         gear_phase(d, j),
                         j.ratio,
                         {j.first.body, j.second.body, j.carrier},
                         "joint." + j.name,
                         j.name});
      continue;
    }
    if (j.type == JointType::rack) {
      add_rack(d, k);
      continue;
    }
    if (j.slot) {
      add_slot(d, k);
      continue;
    }
    // The direction of a pin is the x axis of its body, from which a drive counts.
    const bool turns = j.type == JointType::revolute;
    const PartPoint first = on_part(d, j.first, turns ? 0 : j.slide_first),
                    second = on_part(d, j.second, turns ? 0 : j.slide_second);
    if (first.part == second.part) {
      d.error("joint." + j.name,
              fmt::format("joins '{}' and '{}', which are welded together: a redundant constraint",
                          d.body_name(j.first.body), d.body_name(j.second.body)),
              "leave the joint or the weld out");
      continue;
    }
    if (j.type != JointType::pin_in_slot) {
      d.joints.push_back({first, second, j.type == JointType::prismatic, k, input});
      continue;
    }
    // A block without mass runs in the slot of the first body and carries the pin of the second.
    const int block = static_cast<int>(d.plan().parts.size());
    d.plan().parts.push_back("block of " + j.name);
    std::optional<math::Pose> start;
    if (d.start[at(first.part)] && d.start[at(second.part)]) {
      const math::Pose& pin = *d.start[at(second.part)];
      const std::complex<double> there = math::transform(pin, number(second.at));
      start =
          math::Pose{there.real(), there.imag(), d.start[at(first.part)]->angle + angle_of(first.direction)};
    }
    d.start.push_back(start);
    d.joints.push_back({first, {block, {0, 0}, {1, 0}}, true, -1, -1});
    d.joints.push_back({{block, {0, 0}, {1, 0}}, second, false, k, -1});
  }
  for (int k = 0; k < static_cast<int>(d.linkage.joints.size()); ++k)
    if (d.model(k).type == JointType::gear && d.model(k).geneva) add_geneva(d, k);
  add_belts(d);
  if (d.good()) add_cams(d);
  for (int k : d.linkage.driven) d.plan().rotary.push_back(d.model(k).type == JointType::revolute);
}

void find_masses(PlanDraft& d) {
  d.plan().masses = part_masses(d.linkage, d.plan().bodies, d.plan().parts.size());
  for (int i = 1; i < static_cast<int>(d.linkage.bodies.size()); ++i)
    if (!d.linkage.bodies[at(i)].mass && d.plan().bodies[at(i)].part != 0)
      d.plan().massless.push_back(d.linkage.bodies[at(i)].name);
  d.plan().has_masses = d.plan().massless.empty();
}

}  // namespace

PartPoint on_part(const PlanDraft& d, const BodyPoint& p, double direction) {
  const BodyOnPart& b = d.plan().bodies[at(p.body)];
  return {b.part, b.origin + rotate(b.turn, point_of_body(d, p)), rotate(b.turn, math::unit(direction))};
}

// Gears couple the frames of bodies; parts may be turned against them.
double gear_phase(const PlanDraft& d, const LinkageJoint& j) {
  const auto offset = [&](int body) { return angle_of(d.plan().bodies[at(body)].turn); };
  const double carrier = offset(j.carrier);
  return j.phase - (offset(j.second.body) - carrier) + j.ratio * (offset(j.first.body) - carrier);
}

void find_parts(PlanDraft& d) {
  weld_bodies(d);
  if (d.good()) join_parts(d);
  if (d.good()) find_masses(d);
}

}  // namespace linkwright::planar
