// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/dependent/beam_axle.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "linkwright/core/check.h"
#include "linkwright/math/dense.h"

namespace linkwright::suspension {
namespace {

constexpr double least_length = 1e-6;     ///< m: below, two points are one
constexpr double no_axle_rank = 1e-7;     ///< relative: a singular value below is rounding
constexpr double share_of_weakest = 0.2;  ///< of its largest part, from which a constraint takes part
constexpr Vec3 upward{0, 0, 1};

std::string quoted(const std::string& name) { return "'" + name + "'"; }

/// The vector from the centre of a disc of this radius to its lowest point.
Vec3 lowest_point(const Vec3& axis, double radius) {
  return (-radius / std::sqrt(1 - axis.z * axis.z)) * (upward - axis.z * axis);
}
/// Its change as the axis changes by `swing`.
Vec3 lowest_change(const Vec3& axis, double radius, const Vec3& swing) {
  const double rise = axis.z, flat = std::sqrt(1 - rise * rise);
  return -radius * ((-swing.z / flat) * axis + (-rise / flat) * swing +
                    (rise * swing.z / (flat * flat * flat)) * (upward - rise * axis));
}

/// The turn of half of a beam that twists.
Mat3 twist_turn(const BeamAxlePlan& plan, const BeamPlace& place, std::size_t side) {
  return math::turn_about((side == 0 ? 0.5 : -0.5) * place.cranks[0] * plan.twist->axis);
}
/// A point on half of the beam, from the reference point of the beam in its present direction.
struct HalfPoint {
  Vec3 arm;      ///< m
  Vec3 twisted;  ///< m/rad, its change by the twist
};
HalfPoint half_point(const BeamAxlePlan& plan, const BeamPlace& place, std::size_t side, const Vec3& local) {
  if (!plan.twist) return {place.rotation * local, {}};
  const Vec3 lever = twist_turn(plan, place, side) * (local - plan.twist->shear_centre);
  return {place.rotation * (plan.twist->shear_centre + lever),
          place.rotation * ((side == 0 ? 0.5 : -0.5) * cross(plan.twist->axis, lever))};
}

const CornerWheel& wheel_of(const BeamAxlePlan& plan, std::size_t side) {
  return side == 0 ? plan.axle.left : plan.axle.right;
}

/// A wheel in a place: its centre and its contact, and the derivatives of the contact by the beam's turning.
struct PlacedWheel {
  Vec3 from_centre;  ///< of the beam to that of the wheel, m
  Vec3 centre, contact;
  std::array<Vec3, 3> contact_turned;
  Vec3 centre_twisted, contact_twisted;  ///< m/rad, by the twist of the beam
};

PlacedWheel placed_wheel(const BeamAxlePlan& plan, const BeamPlace& place, std::size_t side) {
  PlacedWheel out;
  const HalfPoint centre = half_point(plan, place, side, plan.wheel_centres[side]);
  out.from_centre = centre.arm;
  out.centre = place.centre + out.from_centre;
  const Vec3 local = plan.twist ? twist_turn(plan, place, side) * plan.axes[side] : plan.axes[side];
  const Vec3 axis = place.rotation * local;
  const double radius = wheel_of(plan, side).tyre_diameter / 2;
  out.contact = out.centre + lowest_point(axis, radius);
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 turn{k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0};
    out.contact_turned[k] = cross(turn, out.from_centre) + lowest_change(axis, radius, cross(turn, axis));
  }
  if (plan.twist) {
    const Vec3 swing = place.rotation * ((side == 0 ? 0.5 : -0.5) * cross(plan.twist->axis, local));
    out.centre_twisted = centre.twisted;
    out.contact_twisted = out.centre_twisted + lowest_change(axis, radius, swing);
  }
  return out;
}

using Row = std::array<double, max_axle_equations>;

void put(Row& row, const Vec3& shift, const Vec3& turn) {
  row = {};
  row[0] = shift.x, row[1] = shift.y, row[2] = shift.z;
  row[3] = turn.x, row[4] = turn.y, row[5] = turn.z;
}

/// Coefficients of the height and of the lateral place of a contact.
Row contact_row(const PlacedWheel& wheel, const Vec3& along) {
  Row row;
  put(row, along,
      {dot(along, wheel.contact_turned[0]), dot(along, wheel.contact_turned[1]),
       dot(along, wheel.contact_turned[2])});
  row[6] = dot(along, wheel.contact_twisted);
  return row;
}

void evaluate_inputs(const BeamAxlePlan& plan, const BeamPlace& place, AxleInputs inputs,
                     const std::array<double, 2>& values, std::size_t first, AxleEquations& out) {
  const std::array<PlacedWheel, 2> wheels{placed_wheel(plan, place, 0), placed_wheel(plan, place, 1)};
  out.label[first] = out.label[first + 1] = -1;
  if (inputs == AxleInputs::heave_roll) {
    const Vec3 &l = wheels[0].contact, &r = wheels[1].contact;
    out.residual[first] = (l.z + r.z) / 2 - (plan.contacts[0].z + plan.contacts[1].z) / 2 - values[0];
    const double c = std::cos(values[1]), s = std::sin(values[1]);
    const Vec3 across{0, -s, c};
    out.residual[first + 1] = dot(across, l - r);
    const Row left = contact_row(wheels[0], upward), right = contact_row(wheels[1], upward);
    const Row left_across = contact_row(wheels[0], across), right_across = contact_row(wheels[1], across);
    for (std::size_t j = 0; j < max_axle_equations; ++j) {
      out.jacobian[first][j] = (left[j] + right[j]) / 2;
      out.jacobian[first + 1][j] = left_across[j] - right_across[j];
    }
    return;
  }
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3& start = plan.wheel_centres[i];
    if (inputs == AxleInputs::contacts) {
      out.residual[first + i] = wheels[i].contact.z - plan.contacts[i].z - values[i];
      out.jacobian[first + i] = contact_row(wheels[i], upward);
    } else {
      out.residual[first + i] = wheels[i].centre.z - (plan.centre.z + start.z) - values[i];
      put(out.jacobian[first + i], upward, cross(wheels[i].from_centre, upward));
      out.jacobian[first + i][6] = wheels[i].centre_twisted.z;
    }
  }
}

/// The matrix of the equations column by column, as the decompositions take it; transposed row by row.
std::vector<double> numbers_of(const AxleEquations& e, std::size_t n, bool transpose) {
  std::vector<double> out;
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) out.push_back(transpose ? e.jacobian[j][i] : e.jacobian[i][j]);
  return out;
}

/// Equations whose turning is measured at the distance of a typical lever, so that all entries are alike.
AxleEquations scaled(const BeamAxlePlan& plan, AxleEquations e) {
  const double lever = std::max(norm(plan.wheel_centres[0]), norm(plan.wheel_centres[1]));
  for (auto& row : e.jacobian)
    for (std::size_t j = 3; j < 6; ++j) row[j] /= lever;
  // A bellcrank's angle has the length of its arm for a lever.
  for (std::size_t w = 0; w + 6 < static_cast<std::size_t>(plan.unknowns); ++w) {
    double square = 0;
    for (const auto& row : e.jacobian) square += row[6 + w] * row[6 + w];
    for (auto& row : e.jacobian)
      if (square > 0) row[6 + w] /= std::sqrt(square);
  }
  return e;
}

std::string motion_in_words(const std::vector<double>& v, bool twists) {
  const auto largest = [&](std::size_t first) {
    std::size_t at = first;
    for (std::size_t k = first; k < first + 3; ++k)
      if (std::abs(v[k]) > std::abs(v[at])) at = k;
    return at;
  };
  const std::size_t shift = largest(0), turn = largest(3);
  const char* axes = "xyz";
  if (v.size() > 6 && std::abs(v[6]) > std::max(std::abs(v[shift]), std::abs(v[turn])))
    return twists ? "twist of the beam" : "turning of a bellcrank";
  if (std::abs(v[shift]) >= std::abs(v[turn])) return fmt::format("shifting along {}", axes[shift]);
  return fmt::format("turning about {}", axes[turn - 3]);
}

/// Checks that need no equations.
AxleFault fault_of_points(const BeamAxle& a) {
  if (!(a.left.centre.y > a.right.centre.y))
    return {fmt::format("the left wheel is at y = {:.6g} mm and the right one at y = {:.6g} mm",
                        a.left.centre.y * 1e3, a.right.centre.y * 1e3),
            "y points to the left: the left wheel has the larger y"};
  const auto short_part = [](const std::string& name, const char* what) {
    return AxleFault{fmt::format("{} of {} are in one place", what, quoted(name)), "check their coordinates"};
  };
  for (const AxleRod& r : a.rods)
    if (norm(r.body - r.beam) < least_length) return short_part(r.name, "both joints");
  for (const AxleArm& arm : a.arms) {
    if (arm.body.size() + arm.beam.size() != 3 || arm.body.empty() || arm.beam.empty())
      return {fmt::format("{} has {} points on the body and {} on the beam", quoted(arm.name),
                          arm.body.size(), arm.beam.size()),
              "an A-arm has two points on the axis of its hinge and one at its ball joint"};
    const std::vector<Vec3>& hinge = arm.body.size() == 2 ? arm.body : arm.beam;
    const Vec3& ball = arm.body.size() == 2 ? arm.beam[0] : arm.body[0];
    if (norm(hinge[1] - hinge[0]) < least_length) return short_part(arm.name, "both points of the hinge");
    if (norm(cross(unit(hinge[1] - hinge[0]), ball - hinge[0])) < least_length)
      return {fmt::format("the ball joint of {} lies on the axis of its hinge", quoted(arm.name)),
              "check their coordinates"};
  }
  for (const AxleWatt& w : a.watts) {
    if (!(norm(w.axis) > 0))
      return {fmt::format("the axis of {} has no direction", quoted(w.name)), "for example axis = [1, 0, 0]"};
    for (std::size_t k = 0; k < 2; ++k) {
      if (norm(cross(unit(w.axis), w.crank[k] - w.pivot)) < least_length)
        return {fmt::format("end {} of the bellcrank of {} lies on its axis", k + 1, quoted(w.name)),
                "check its coordinates"};
      if (norm(w.crank[k] - w.ends[k]) < least_length)
        return short_part(w.name, k == 0 ? "both joints of the first rod" : "both joints of the second rod");
    }
  }
  if (a.twist) {
    const AxleTwist& t = *a.twist;
    if (!(norm(t.axis) > 0))
      return {fmt::format("the axis of {} has no direction", quoted(t.name)), "for example axis = [0, 1, 0]"};
    if (!(t.pivots[0].y > t.pivots[1].y))
      return {fmt::format("the left pivot of {} is at y = {:.6g} mm and the right one at y = {:.6g} mm",
                          quoted(t.name), t.pivots[0].y * 1e3, t.pivots[1].y * 1e3),
              "y points to the left: the left pivot has the larger y"};
  }
  for (const AxleGuide& g : a.guides)
    if (!(norm(g.normal) > 0))
      return {fmt::format("the normal of {} has no direction", quoted(g.name)),
              "for example normal = [0, 1, 0]"};
  return {};
}

BeamAxlePlan plan_of(const BeamAxle& axle) {
  BeamAxlePlan out{.axle = axle};
  out.centre = 0.5 * (axle.left.centre + axle.right.centre);
  const auto from_centre = [&](const Vec3& at) { return at - out.centre; };
  const auto label = [&](const std::string& name) {
    out.labels.push_back(quoted(name));
    return static_cast<int>(out.labels.size()) - 1;
  };
  for (const AxleRod& r : axle.rods)
    out.distances.push_back(
        {r.body, from_centre(r.beam), r.length.value_or(norm(r.body - r.beam)), -1, label(r.name)});
  for (const AxleArm& arm : axle.arms) {
    const int name = label(arm.name);
    for (const Vec3& body : arm.body)
      for (const Vec3& beam : arm.beam)
        out.distances.push_back({body, from_centre(beam), norm(body - beam), -1, name});
  }
  for (std::size_t w = 0; w < axle.watts.size(); ++w) {
    const AxleWatt& watt = axle.watts[w];
    const int name = label(watt.name);
    out.cranks.push_back(
        {watt.pivot_on_beam, watt.pivot_on_beam ? from_centre(watt.pivot) : watt.pivot, unit(watt.axis)});
    for (std::size_t k = 0; k < 2; ++k) {
      const double length = norm(watt.crank[k] - watt.ends[k]);
      if (watt.pivot_on_beam)
        out.distances.push_back(
            {watt.ends[k], from_centre(watt.crank[k]), length, static_cast<int>(w), name});
      else
        out.distances.push_back(
            {watt.crank[k], from_centre(watt.ends[k]), length, static_cast<int>(w), name});
    }
  }
  for (const AxleGuide& g : axle.guides) {
    const Vec3 normal = unit(g.normal);
    out.planes.push_back({from_centre(g.beam), normal, dot(normal, g.beam), label(g.name)});
  }
  for (const AxleBallJoint& b : axle.ball_joints) {
    out.balls.push_back({b.at, from_centre(b.at)});
    out.ball_labels.push_back(label(b.name));
  }
  if (axle.twist)
    out.twist = BeamAxlePlan::Twist{{from_centre(axle.twist->pivots[0]), from_centre(axle.twist->pivots[1])},
                                    from_centre(axle.twist->shear_centre),
                                    unit(axle.twist->axis),
                                    label(axle.twist->name)};
  out.unknowns = 6 + static_cast<int>(axle.watts.size()) + (axle.twist ? 1 : 0);
  out.axes = {wheel_axis(Side::left, axle.left.toe, axle.left.camber),
              wheel_axis(Side::right, axle.right.toe, axle.right.camber)};
  out.wheel_centres = {from_centre(axle.left.centre), from_centre(axle.right.centre)};
  const BeamPlace reference{out.centre, {}, {}};
  out.contacts = {placed_wheel(out, reference, 0).contact, placed_wheel(out, reference, 1).contact};
  return out;
}

std::string count_in_words(const BeamAxle& a) {
  std::string out;
  const auto add = [&](std::size_t count, const char* one, const char* several, std::size_t each) {
    if (count > 0)
      out += fmt::format("{}{} {}: {}", out.empty() ? "" : ", ", count, count == 1 ? one : several,
                         count * each);
  };
  add(a.rods.size(), "rod", "rods", 1);
  add(a.arms.size(), "A-arm", "A-arms", 2);
  add(a.watts.size(), "Watt linkage", "Watt linkages", 1);
  add(a.guides.size(), "guide", "guides", 1);
  add(a.ball_joints.size(), "ball joint", "ball joints", 3);
  add(a.twist ? 1 : 0, "twist beam", "", 4);
  return out.empty() ? "there are none" : out;
}

}  // namespace

int constraints_of(const BeamAxle& axle) {
  return static_cast<int>(axle.rods.size() + 2 * axle.arms.size() + axle.watts.size() + axle.guides.size() +
                          3 * axle.ball_joints.size() + (axle.twist ? 4 : 0));
}

AxleFault check_beam_axle(const BeamAxle& axle) {
  if (AxleFault fault = fault_of_points(axle); !fault.message.empty()) return fault;
  const int count = constraints_of(axle);
  if (count != 4) {
    const std::string counted =
        fmt::format("the links take {} of the six freedoms of the axle ({}); four leave heave and roll",
                    count, count_in_words(axle));
    return count < 4
               ? AxleFault{counted + ": the axle is not located",
                           fmt::format("add {} more, for example {}", 4 - count,
                                       4 - count == 1 ? "a Panhard rod" : "links that guide it lengthwise")}
               : AxleFault{counted + ": the axle is overconstrained",
                           "remove what bushings give way to; a leaf spring counts as a rod from its front "
                           "eye to the beam"};
  }
  const BeamAxlePlan plan = plan_of(axle);
  const BeamPlace reference{plan.centre, {}, {}};
  const WeakestAxleMotion weakest = weakest_motion(plan, reference, AxleInputs::heave_roll);
  if (weakest.singular_value < no_axle_rank)
    return {fmt::format(
                "the links leave the axle free in {} at given heave and roll, since {} constrain it alike",
                weakest.motion, fmt::join(weakest.parts, ", ")),
            weakest.motion == "shifting along y"
                ? "a Panhard rod, a Watt linkage, an A-arm or links that converge "
                  "in plan view locate it laterally"
                : "check the coordinates of these parts"};
  return {};
}

BeamAxlePlan prepare_beam_axle(const BeamAxle& axle) {
  const AxleFault fault = check_beam_axle(axle);
  LINKWRIGHT_REQUIRE(fault.message.empty(), "{}", fault.message);
  return plan_of(axle);
}

void evaluate(const BeamAxlePlan& plan, const BeamPlace& place, AxleInputs inputs,
              const std::array<double, 2>& values, AxleEquations& out) {
  std::size_t row = 0;
  for (const BeamAxlePlan::Distance& d : plan.distances) {
    Vec3 body = d.body, local = d.beam, crank_rate{};
    if (d.watt >= 0) {
      const BeamAxlePlan::Crank& crank = plan.cranks[static_cast<std::size_t>(d.watt)];
      const Mat3 turn = math::turn_about(place.cranks[static_cast<std::size_t>(d.watt)] * crank.axis);
      Vec3& end = crank.on_beam ? local : body;
      const Vec3 arm = turn * (end - crank.pivot);
      end = crank.pivot + arm;
      crank_rate = cross(crank.axis, arm);
      crank_rate = crank.on_beam ? place.rotation * crank_rate : -crank_rate;
    }
    const Vec3 arm = place.rotation * local, along = place.centre + arm - body;
    out.residual[row] = (dot(along, along) - d.length * d.length) / (2 * d.length);
    put(out.jacobian[row], (1 / d.length) * along, (1 / d.length) * cross(arm, along));
    if (d.watt >= 0)
      out.jacobian[row][6 + static_cast<std::size_t>(d.watt)] = dot(along, crank_rate) / d.length;
    out.label[row++] = d.label;
  }
  for (const BeamAxlePlan::Plane& p : plan.planes) {
    const Vec3 arm = place.rotation * p.beam;
    out.residual[row] = dot(p.normal, place.centre + arm) - p.offset;
    put(out.jacobian[row], p.normal, cross(arm, p.normal));
    out.label[row++] = p.label;
  }
  for (std::size_t b = 0; b < plan.balls.size(); ++b) {
    const Vec3 arm = place.rotation * plan.balls[b][1], gap = place.centre + arm - plan.balls[b][0];
    for (int k = 0; k < 3; ++k) {
      const Vec3 along{k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0};
      out.residual[row] = math::component(gap, k);
      put(out.jacobian[row], along, cross(arm, along));
      out.label[row++] = plan.ball_labels[b];
    }
  }
  if (plan.twist) {
    std::array<HalfPoint, 2> at;
    std::array<Vec3, 2> gap;
    for (std::size_t side = 0; side < 2; ++side) {
      at[side] = half_point(plan, place, side, plan.twist->pivots[side]);
      gap[side] = place.centre + at[side].arm - plan.centre - plan.twist->pivots[side];
      for (const Vec3& along : {Vec3{1, 0, 0}, upward}) {
        out.residual[row] = dot(along, gap[side]);
        put(out.jacobian[row], along, cross(at[side].arm, along));
        out.jacobian[row][6] = dot(along, at[side].twisted);
        out.label[row++] = plan.twist->label;
      }
    }
    // Laterally both bushings give way to the growing distance of the pivots alike.
    const Vec3 lateral{0, 1, 0};
    out.residual[row] = (gap[0].y + gap[1].y) / 2;
    put(out.jacobian[row], lateral, cross(0.5 * (at[0].arm + at[1].arm), lateral));
    out.jacobian[row][6] = (at[0].twisted.y + at[1].twisted.y) / 2;
    out.label[row++] = plan.twist->label;
  }
  evaluate_inputs(plan, place, inputs, values, row, out);
}

std::array<double, 2> beam_inputs(const BeamAxlePlan& plan, const BeamPlace& place, AxleInputs inputs) {
  const PlacedWheel left = placed_wheel(plan, place, 0), right = placed_wheel(plan, place, 1);
  if (inputs == AxleInputs::wheel_centres)
    return {left.centre.z - (plan.centre.z + plan.wheel_centres[0].z),
            right.centre.z - (plan.centre.z + plan.wheel_centres[1].z)};
  const double rise_left = left.contact.z - plan.contacts[0].z,
               rise_right = right.contact.z - plan.contacts[1].z;
  if (inputs == AxleInputs::contacts) return {rise_left, rise_right};
  return {(rise_left + rise_right) / 2,
          std::atan2(left.contact.z - right.contact.z, left.contact.y - right.contact.y)};
}

Vec3 on_beam(const BeamAxlePlan& plan, const BeamPlace& place, const Vec3& reference) {
  const std::size_t side = plan.twist && reference.y < plan.axle.twist->shear_centre.y ? 1 : 0;
  return place.centre + half_point(plan, place, side, reference - plan.centre).arm;
}

Mat3 half_rotation(const BeamAxlePlan& plan, const BeamPlace& place, Side side) {
  if (!plan.twist) return place.rotation;
  return place.rotation * twist_turn(plan, place, side == Side::left ? 0 : 1);
}

Vec3 half_turning(const BeamAxlePlan& plan, const BeamPlace& place, const BeamMotion& motion, Side side) {
  if (!plan.twist) return motion.turning;
  return motion.turning +
         (side == Side::left ? 0.5 : -0.5) * motion.cranks[0] * (place.rotation * plan.twist->axis);
}

Vec3 half_velocity(const BeamAxlePlan& plan, const BeamPlace& place, const BeamMotion& motion, Side side,
                   const Vec3& at) {
  const Vec3 velocity = motion.velocity + cross(motion.turning, at - place.centre);
  if (!plan.twist) return velocity;
  const Vec3 shear_centre = place.centre + place.rotation * plan.twist->shear_centre;
  const Vec3 twisting = half_turning(plan, place, motion, side) - motion.turning;
  return velocity + cross(twisting, at - shear_centre);
}

Vec3 crank_end(const BeamAxlePlan& plan, const BeamPlace& place, std::size_t watt, std::size_t end) {
  const AxleWatt& of = plan.axle.watts.at(watt);
  const Mat3 turn = math::turn_about(place.cranks[watt] * plan.cranks[watt].axis);
  const Vec3 at = of.pivot + turn * (of.crank.at(end) - of.pivot);
  return of.pivot_on_beam ? on_beam(plan, place, at) : at;
}

Vec3 contact_point(const BeamAxlePlan& plan, const BeamPlace& place, Side side) {
  return placed_wheel(plan, place, side == Side::left ? 0 : 1).contact;
}

WeakestAxleMotion weakest_motion(const BeamAxlePlan& plan, const BeamPlace& place, AxleInputs inputs) {
  const auto n = static_cast<std::size_t>(plan.unknowns);
  AxleEquations e;
  evaluate(plan, place, inputs, beam_inputs(plan, place, inputs), e);
  e = scaled(plan, e);
  const auto forward = math::singular_vectors(numbers_of(e, n, false), n);
  const auto backward = math::singular_vectors(numbers_of(e, n, true), n);
  WeakestAxleMotion out{forward.values.back() / forward.values.front(), {}, {}};
  const auto last = [n](const std::vector<double>& columns) {
    return std::vector<double>(columns.end() - static_cast<std::ptrdiff_t>(n), columns.end());
  };
  out.motion = motion_in_words(last(forward.right), plan.twist.has_value());
  const std::vector<double> parts = last(backward.right);
  double largest = 0;
  for (std::size_t i = 0; i + 2 < n; ++i) largest = std::max(largest, std::abs(parts[i]));
  for (std::size_t i = 0; i + 2 < n; ++i) {
    const std::string& label = plan.labels[static_cast<std::size_t>(e.label[i])];
    if (std::abs(parts[i]) > share_of_weakest * largest &&
        std::find(out.parts.begin(), out.parts.end(), label) == out.parts.end())
      out.parts.push_back(label);
  }
  return out;
}

}  // namespace linkwright::suspension
