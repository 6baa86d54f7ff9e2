// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "linkwright/core/tolerance.h"
#include "linkwright/planar/linkage/detail/pair_rows.h"
#include "linkwright/planar/linkage/detail/plan_draft.h"

namespace linkwright::planar {
namespace {

PartState<double> start_of(const PlanDraft& d, int part) {
  const math::Pose& pose = *d.start[at(part)];
  return {{pose.x, pose.y}, math::unit(pose.angle), {0, 0}, 0, {0, 0}, 0};
}

// The constant of a strand is what the start poses give.
void measure(const PlanDraft& d, StrandPair& run) {
  const int a = run.first.part, b = run.second.part;
  std::vector<PartState<double>> parts(d.parts());
  parts[at(a)] = start_of(d, a), parts[at(b)] = start_of(d, b);
  run.constant = 0;
  run.reference = angle_of(strand_line(run, parts).along);
  run.constant = pair_row(run, parts, [&](int part) { return d.start[at(part)]->angle; }).residual;
}

template <class Kind>
void add_pair(PlanDraft& d, int joint, int strand, const Kind& kind, std::vector<int> parts, std::string key,
              std::string name) {
  PartPair& added = d.pairs.emplace_back();
  added.pair.joint = joint;
  added.pair.strand = strand;
  added.pair.kind.emplace<Kind>(kind);
  added.parts = std::move(parts);
  added.key = std::move(key);
  added.name = std::move(name);
}

void add_strand(PlanDraft& d, int belt, int from, bool has_equation) {
  const Belt& b = d.linkage.belts[at(belt)];
  const BeltWheel &first = b.wheels[at(from)], &second = b.wheels[at(from + 1) % b.wheels.size()];
  PlanStrand strand{.belt = belt,
                    .first = first.centre.body,
                    .second = second.centre.body,
                    .preloaded = b.closed && b.carrier >= 0,
                    .run = {.first = on_part(d, first.centre, 0),
                            .second = on_part(d, second.centre, 0),
                            .first_radius = first.side * first.radius,
                            .second_radius = second.side * second.radius}};
  StrandPair& run = strand.run;
  const int number = static_cast<int>(d.plan().strands.size());
  const std::string key = "belt." + b.name;
  if (strand.preloaded && has_equation) {
    LinkageJoint gear{.ratio = run.first_radius / run.second_radius, .carrier = b.carrier};
    gear.first.body = strand.first, gear.second.body = strand.second;
    d.gears.push_back({-1,
                       run.first.part,
                       run.second.part,
                       d.plan().bodies[at(b.carrier)].part,
                       gear_phase(d, gear),
                       gear.ratio,
                       {strand.first, strand.second, b.carrier},
                       key,
                       b.name,
                       number});
  } else if (!strand.preloaded && (!d.start[at(run.first.part)] || !d.start[at(run.second.part)])) {
    d.error(key, fmt::format("the length of '{}' is not known", b.name),
            "draw the linkage (drawn = true), or give the bodies of its wheels a start");
  } else if (!strand.preloaded) {
    measure(d, run);
    if (std::isnan(run.constant))
      d.error(key, fmt::format("wheels of belt '{}' overlap", b.name),
              "move them apart; crossed belts need more than the sum of both radii");
    add_pair(d, -1, number, run, {run.first.part, run.second.part}, key, b.name);
  }
  d.plan().strands.push_back(std::move(strand));
}

// The part that a pair moves alone, on one joint: a wheel on a pin at its centre, or a rack on a slide.
bool moves_alone(const PlanDraft& d, const PartPair& pair, int part, const PartJoint& joint) {
  const PartPoint& here = joint.first.part == part ? joint.first : joint.second;
  const auto at_centre = [&](const PartPoint& centre) {
    return !joint.slide && centre.part == part &&
           norm(here.at - centre.at) <= 10 * tolerance::closure * d.plan().size;
  };
  if (const auto* rack = std::get_if<RackPair>(&pair.pair.kind))
    return at_centre(rack->pinion) || (joint.slide && rack->rack.part == part);
  if (const auto* curve = std::get_if<CurvePair>(&pair.pair.kind))
    return !joint.slide && curve->second == part && curve->first != part && curve->carrier != part;
  if (const auto* cam = std::get_if<CamPair>(&pair.pair.kind))
    return joint.joint == cam->joint && joint.slide == cam->slide;
  if (std::holds_alternative<SlotPair>(pair.pair.kind)) return false;
  const auto& strand = std::get<StrandPair>(pair.pair.kind);
  return (at_centre(strand.first) && strand.first_radius != 0) ||
         (at_centre(strand.second) && strand.second_radius != 0);
}

// The free joint of a part to a known one on which a pair moves it; null where there is none.
PartJoint* moved_joint(PlanDraft& d, const PartPair& pair, int part) {
  if (!std::holds_alternative<CamPair>(pair.pair.kind)) {
    PartJoint* joint = to_known(d, part);
    return joint && moves_alone(d, pair, part, *joint) ? joint : nullptr;
  }
  // The follower may have other joints to known parts than the one that its cam moves.
  for (PartJoint& joint : d.joints)
    if (!joint.used && joint.input < 0 && (joint.first.part == part || joint.second.part == part) &&
        moves_alone(d, pair, part, joint))
      return &joint;
  return nullptr;
}

}  // namespace

void add_rack(PlanDraft& d, int joint) {
  const LinkageJoint& j = d.model(joint);
  RackPair rack{.pinion = on_part(d, j.first, 0),
                .rack = on_part(d, j.second, j.slide_second),
                .radius = j.radius,
                .phase = j.phase,
                .tangent = std::tan(j.pressure_angle)};
  if (rack.pinion.part == rack.rack.part)
    return d.error("joint." + j.name,
                   fmt::format("joins '{}' and '{}', which are welded together: a redundant constraint",
                               d.body_name(j.first.body), d.body_name(j.second.body)),
                   "leave the joint or the weld out");
  // The phase is between bodies; parts may be turned against them.
  rack.phase +=
      angle_of(d.plan().bodies[at(j.second.body)].turn) - angle_of(d.plan().bodies[at(j.first.body)].turn);
  add_pair(d, joint, -1, rack, {rack.pinion.part, rack.rack.part}, "joint." + j.name, j.name);
}

void add_slot(PlanDraft& d, int joint) {
  const LinkageJoint& j = d.model(joint);
  const BodyOnPart& body = d.plan().bodies[at(j.first.body)];
  const SlotPair slot{.slot = {body.part, body.origin, body.turn},
                      .pin = on_part(d, j.second, 0),
                      .track = std::make_shared<const SlotTrack>(*j.slot)};
  if (slot.slot.part == slot.pin.part)
    return d.error("joint." + j.name,
                   fmt::format("joins '{}' and '{}', which are welded together: a redundant constraint",
                               d.body_name(j.first.body), d.body_name(j.second.body)),
                   "leave the joint or the weld out");
  add_pair(d, joint, -1, slot, {slot.slot.part, slot.pin.part}, "joint." + j.name, j.name);
}

namespace {

// The smooth curve through the angles, of degree 5; or of degree 3 where that one turns back between two
// rows. Nothing if both do.
std::optional<math::PiecewisePolynomial> smooth_curve(const RatioCurve& rows, bool around) {
  constexpr int looks = 20;  // between two rows
  for (const math::SplineDegree degree : {math::SplineDegree::quintic, math::SplineDegree::cubic}) {
    math::PiecewisePolynomial curve = math::interpolating_spline(
        rows.first, rows.second, degree, around ? math::SplineEnds::periodic : math::SplineEnds::natural);
    const double sense = rows.second.back() - rows.second.front();
    bool rises = true;
    for (std::size_t i = 0; i + 1 < rows.first.size(); ++i)
      for (int k = 0; k <= looks; ++k) {
        const double angle = rows.first[i] + (rows.first[i + 1] - rows.first[i]) * k / looks;
        rises = rises && math::evaluate(curve, angle)[1] * sense > 0;
      }
    if (rises) return curve;
  }
  return std::nullopt;
}

}  // namespace

void add_curve(PlanDraft& d, int joint) {
  constexpr double typed = 1e-6;  // rad, by which rows miss whole turns
  const LinkageJoint& j = d.model(joint);
  const RatioCurve& rows = *j.curve;
  const std::string key = "joint." + j.name;
  const auto offset = [&](int body) { return angle_of(d.plan().bodies[at(body)].turn); };
  const double turn = rows.first.back() - rows.first.front(),
               turned = (rows.second.back() - rows.second.front()) / full_turn;
  CurvePair pair{.first = d.plan().bodies[at(j.first.body)].part,
                 .second = d.plan().bodies[at(j.second.body)].part,
                 .carrier = d.plan().bodies[at(j.carrier)].part,
                 .first_offset = offset(j.first.body) - offset(j.carrier),
                 .second_offset = offset(j.second.body) - offset(j.carrier) - j.phase,
                 .around = std::abs(turn - full_turn) <= typed,
                 .scale = d.plan().size};
  if (pair.around && std::abs(turned - std::round(turned)) * full_turn > typed)
    return d.error(key,
                   fmt::format("'{}' turns by {:.6g} turns for one of '{}': the wheels do not come back",
                               d.body_name(j.second.body), turned, d.body_name(j.first.body)),
                   "a curve over a whole turn ends a whole number of turns on");
  std::optional<math::PiecewisePolynomial> curve = smooth_curve(rows, pair.around);
  if (!curve)
    return d.error(key, "a smooth curve through the rows of its ratio curve turns back between them",
                   "give more rows where the ratio changes fast");
  pair.curve = std::move(*curve);
  add_pair(d, joint, -1, pair, {pair.first, pair.second, pair.carrier}, key, j.name);
}

namespace {

// The axis on which a part turns on another one, as a place of each; the first of several.
struct PlacedAxis {
  math::Vec2 on_first, on_second;
};
std::optional<PlacedAxis> axis_between(const PlanDraft& d, int first, int second) {
  for (const PartJoint& joint : d.joints) {
    if (joint.slide) continue;
    if (joint.first.part == first && joint.second.part == second)
      return PlacedAxis{joint.first.at, joint.second.at};
    if (joint.first.part == second && joint.second.part == first)
      return PlacedAxis{joint.second.at, joint.first.at};
  }
  return std::nullopt;
}

}  // namespace

void add_geneva(PlanDraft& d, int joint) {
  constexpr double typed = 1e-4;  // in distances of the axes, by which a radius that is typed may miss
  const LinkageJoint& j = d.model(joint);
  const Geneva& g = *j.geneva;
  const std::string key = "joint." + j.name;
  const auto offset = [&](int body) { return angle_of(d.plan().bodies[at(body)].turn); };
  CurvePair pair{.first = d.plan().bodies[at(j.first.body)].part,
                 .second = d.plan().bodies[at(j.second.body)].part,
                 .carrier = d.plan().bodies[at(j.carrier)].part,
                 .around = true,
                 .geneva = g.slots,
                 .pin = on_part(d, j.first, 0),
                 .scale = d.plan().size};
  const auto crank = axis_between(d, pair.first, pair.carrier),
             wheel = axis_between(d, pair.second, pair.carrier);
  if (!crank || !wheel)
    return d.error(
        key,
        fmt::format("'{}' has no pin on '{}'", d.body_name(crank ? j.second.body : j.first.body),
                    d.body_name(j.carrier)),
        "the crank and the wheel of a Geneva drive turn on one body: join both to it, and name it as "
        "`carrier`");
  const math::Vec2 arm = pair.pin.at - crank->on_first;
  const math::Vec2 to_crank = crank->on_second - wheel->on_second;  // in the frame of the carrier
  const double distance = norm(to_crank), radius = geneva_crank(g.slots, distance);
  if (!(std::abs(norm(arm) - radius) <= typed * distance))
    return d.error(
        key,
        fmt::format("the pin of '{}' is {:.8g} mm from its axis: it would not enter {} slots along them",
                    d.body_name(j.first.body), norm(arm) * 1e3, g.slots.count),
        fmt::format("the axes are {:.8g} mm apart, which takes a radius of {:.8g} mm", distance * 1e3,
                    radius * 1e3));
  // The crank angle counts from where the pin lies between the axes, or beyond the crank's axis of an
  // internal wheel.
  const double line = angle_of(g.slots.internal ? to_crank : -to_crank), slot = angle_of(to_crank);
  pair.first_offset = angle_of(arm) - line;
  const double wheel_offset = offset(j.second.body) - offset(j.carrier);
  if (g.slot) {
    // A slot points at the pin where the crank angle is 0.
    pair.second_offset = wheel_offset - (slot - offset(j.carrier)) + *g.slot;
  } else {
    const double drawn = offset(j.carrier) - offset(j.first.body) + pair.first_offset;
    pair.second_offset = geneva_motion(g.slots, math::wrap_angle(drawn))[0] + wheel_offset;
    pair.first_offset += math::wrap_angle(drawn) - drawn;
  }
  add_pair(d, joint, -1, pair, {pair.first, pair.second, pair.carrier}, key, j.name);
}

void add_belts(PlanDraft& d) {
  for (int k = 0; k < static_cast<int>(d.linkage.belts.size()); ++k) {
    const Belt& b = d.linkage.belts[at(k)];
    if (b.closed && b.carrier < 0 && b.wheels.size() == 2) {
      const auto wheel = [&](std::size_t i) {
        const BodyPoint& p = b.wheels[i].centre;
        return d.body_name(p.body) + "." + d.linkage.bodies[at(p.body)].points[at(p.point)].name;
      };
      d.error("belt." + b.name,
              fmt::format("belt '{}' cannot stay tight: no body holds both '{}' and '{}', whose distance "
                          "changes",
                          b.name, wheel(0), wheel(1)),
              "join both wheels to one body by pins, add an idler on a spring, or write a rope");
      continue;
    }
    const int wheels = static_cast<int>(b.wheels.size()), strands = b.closed ? wheels : wheels - 1;
    for (int i = 0; i < strands; ++i) add_strand(d, k, i, !(b.carrier >= 0 && i + 1 == strands));
  }
}

bool find_follower(PlanDraft& d) {
  for (PartPair& pair : d.pairs) {
    const auto known = [&](int p) { return d.known[at(p)]; };
    const auto unknown = std::find_if_not(pair.parts.begin(), pair.parts.end(), known);
    if (pair.used || unknown == pair.parts.end() ||
        std::any_of(pair.parts.begin(), pair.parts.end(), [&](int p) { return p != *unknown && !known(p); }))
      continue;
    const int part = *unknown;
    PartJoint* joint = moved_joint(d, pair, part);
    if (!joint) continue;
    joint->used = pair.used = true;
    const int base = joint->first.part == part ? joint->second.part : joint->first.part;
    place_group(
        d, {.kind = Follower{}, .parts = {part}, .joints = {chained(*joint, base)}, .pairs = {pair.pair}});
    return true;
  }
  return false;
}

void check_left_pairs(PlanDraft& d) {
  for (const PartPair& pair : d.pairs) {
    if (pair.used ||
        !std::all_of(pair.parts.begin(), pair.parts.end(), [&](int p) { return d.known[at(p)]; }))
      continue;
    const char* what = pair.pair.cam >= 0                                 ? "the cam"
                       : pair.pair.joint < 0                              ? "the rope"
                       : d.model(pair.pair.joint).type == JointType::rack ? "the rack"
                       : d.model(pair.pair.joint).slot                    ? "the slot"
                       : d.model(pair.pair.joint).geneva                  ? "the Geneva drive"
                                                                          : "the gear";
    if (pair.pair.strand >= 0 && d.linkage.belts[at(d.plan().strands[at(pair.pair.strand)].belt)].closed)
      d.error(
          pair.key,
          fmt::format("belt '{}' cannot stay tight: the distances of its wheels change, and nothing takes "
                      "up its length",
                      pair.name),
          "add an idler on a lever with a spring, hold all wheels on one body, or write a rope");
    else
      d.error(pair.key,
              fmt::format("a redundant constraint: '{}' and '{}' are placed without {} already",
                          d.plan().parts[at(pair.parts[0])], d.plan().parts[at(pair.parts[1])], what),
              fmt::format("leave {} or a drive out", what));
  }
}

}  // namespace linkwright::planar
