// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/belt_run.h"
#include "linkwright/planar/linkage/detail/form_parts.h"

namespace linkwright::planar {
namespace {

// The same by the radii of the pitch circles.
double ratio_of_radii(const JointForm& f, InternalWheel internal, FormNames& names) {
  const std::vector<double>& radii = *f.pitch_radii;
  if (radii.size() != 2 || !(radii[0] > 0 && radii[1] > 0)) {
    names.problem("pitch_radii", fmt::format("gear '{}' has no two pitch radii above 0", f.name),
                  "write two, that of the first wheel first");
    return 1;
  }
  if (internal == InternalWheel::none) return -radii[0] / radii[1];
  const bool first_is_ring = internal == InternalWheel::first;
  if (!(radii[first_is_ring ? 0 : 1] > radii[first_is_ring ? 1 : 0]))
    names.problem(
        "internal",
        fmt::format("internal wheel '{}' is not larger than its pinion", first_is_ring ? f.first : f.second),
        "the ring has the larger radius: swap `internal`");
  return radii[0] / radii[1];
}

// An axis: pins in one place, with the bodies that they join.
struct PinAxis {
  std::vector<BodyPoint> points;

  const BodyPoint* on(int body) const {
    const auto found =
        std::find_if(points.begin(), points.end(), [&](const BodyPoint& p) { return p.body == body; });
    return found == points.end() ? nullptr : &*found;
  }
};
bool same_pin_place(const Linkage& l, const BodyPoint& p, const BodyPoint& q) {
  return p.body == q.body && std::abs(place_of(l, p) - place_of(l, q)) <= 1e-9 * size_of(l);
}
std::vector<PinAxis> axes_of(const Linkage& l) {
  std::vector<PinAxis> axes;
  for (const LinkageJoint& j : l.joints) {
    if (j.type != JointType::revolute) continue;
    PinAxis now{{j.first, j.second}};
    std::erase_if(axes, [&](const PinAxis& axis) {
      const bool here = std::any_of(axis.points.begin(), axis.points.end(), [&](const BodyPoint& p) {
        return same_pin_place(l, p, j.first) || same_pin_place(l, p, j.second);
      });
      if (here) now.points.insert(now.points.end(), axis.points.begin(), axis.points.end());
      return here;
    });
    axes.push_back(std::move(now));
  }
  return axes;
}

// The wheels of a gear with the axes of all pins. A wheel turns about any pin of its body, or about the one
// at its centre where the form names that.
struct Wheels {
  const Linkage& l;
  const JointForm& form;
  const LinkageJoint& gear;
  std::vector<PinAxis> axes;

  // The first point of a Geneva drive is its pin, not an axis.
  bool first_named() const { return !gear.geneva && body_index(l, form.first) < 0; }
  bool second_named() const { return body_index(l, form.second) < 0; }
  bool turns_on(const BodyPoint& wheel, bool named, const PinAxis& axis) const {
    return std::any_of(axis.points.begin(), axis.points.end(), [&](const BodyPoint& p) {
      return p.body == wheel.body && (!named || same_pin_place(l, p, wheel));
    });
  }
  // The distance of both axes on a body (m); nothing where it does not hold both.
  std::optional<double> distance_on(int body) const {
    for (const PinAxis& a : axes)
      for (const PinAxis& b : axes) {
        const BodyPoint *first = a.on(body), *second = b.on(body);
        if (&a != &b && first && second && turns_on(gear.first, first_named(), a) &&
            turns_on(gear.second, second_named(), b))
          return std::abs(place_of(l, *first) - place_of(l, *second));
      }
    return std::nullopt;
  }
};

// The body on which both wheels have a pin, each an axis of its own.
int carrier_of(const Wheels& wheels, FormNames& names) {
  const Linkage& l = wheels.l;
  std::vector<int> found;
  for (int body = 0; body < static_cast<int>(l.bodies.size()); ++body)
    if (body != wheels.gear.first.body && body != wheels.gear.second.body && wheels.distance_on(body))
      found.push_back(body);
  const bool bodies_alone = !wheels.first_named() && !wheels.second_named();
  if (bodies_alone && (found.empty() || found.front() == 0)) return 0;
  const auto name = [&](std::size_t k) { return l.bodies[static_cast<std::size_t>(found[k])].name; };
  if (found.empty())
    names.problem("carrier",
                  fmt::format("no body carries both '{}' and '{}'", wheels.form.first, wheels.form.second),
                  "name the `carrier`, or join both wheels to one body by pins");
  else if (found.size() > 1)
    names.problem("carrier", fmt::format("both '{}' and '{}' carry the wheels", name(0), name(1)),
                  "name one as `carrier`");
  return found.empty() ? 0 : found.front();
}

// The pressure angle at which teeth of a module work on the distance of the centres.
double working_angle(const Wheels& wheels, FormNames& names) {
  const JointForm& f = wheels.form;
  const double angle = wheels.gear.pressure_angle;
  const std::optional<double> distance = wheels.distance_on(wheels.gear.carrier);
  if (!f.module || !f.teeth || f.teeth->size() != 2 || !distance) return angle;
  const int first = f.teeth->front(), second = f.teeth->back(),
            sum = f.internal.value_or(InternalWheel::none) == InternalWheel::none ? first + second
                                                                                  : std::abs(first - second);
  const double cosine = *f.module * sum / 2 * std::cos(angle) / *distance;
  // Teeth are shifted by some percent of the distance, seldom by more.
  constexpr double shifted = 0.05;
  const double reference = *f.module * sum / 2;
  if (cosine <= 1 && std::abs(*distance / reference - 1) > shifted)
    names.problem(
        "module_mm",
        fmt::format("the centres of gear '{}' are {:.6g} mm apart, {:.3g} % off the {:.6g} mm of its "
                    "teeth, which then press at {:.4g} deg",
                    f.name, *distance * 1e3, std::abs(*distance / reference - 1) * 100, reference * 1e3,
                    std::acos(cosine) * 180 / pi),
        "check the numbers of teeth, the module and the centres", true);
  if (cosine <= 1) return std::acos(cosine);
  names.problem(
      "module_mm",
      fmt::format(
          "wheels of {} and {} teeth, module {:.6g}, need {:.6g} mm, the centres are {:.6g} mm apart: the "
          "teeth would overlap",
          first, second, *f.module * 1e3, *f.module * sum / 2 * 1e3, *distance * 1e3),
      fmt::format("move the centres, or take module {:.3g}", 2e3 * *distance / sum));
  return angle;
}

// Pitch circles touch where the centres of their wheels keep their distance.
void check_pitch_radii(const Wheels& wheels, FormNames& names) {
  const auto& radii = wheels.form.pitch_radii;
  const std::optional<double> distance = wheels.distance_on(wheels.gear.carrier);
  if (!radii || radii->size() != 2 || !distance) return;
  const bool external = wheels.form.internal.value_or(InternalWheel::none) == InternalWheel::none;
  const double needed = external ? radii->front() + radii->back() : std::abs(radii->front() - radii->back());
  if (std::abs(needed - *distance) > 1e-6 * needed)
    names.problem("pitch_radii",
                  fmt::format("the pitch circles of gear '{}' touch at {:.6g} mm, its centres are {:.6g} mm "
                              "apart",
                              wheels.form.name, needed * 1e3, *distance * 1e3),
                  "move the centres, or change the radii; teeth or ratio take any distance");
}

// The centres of the wheels of a belt on a body that carries all of them; empty where it does not.
std::vector<std::complex<double>> centres_on(const Linkage& l, const std::vector<PinAxis>& axes,
                                             const Belt& belt, int body) {
  std::vector<std::complex<double>> out;
  for (const BeltWheel& wheel : belt.wheels)
    for (const PinAxis& axis : axes) {
      const BodyPoint *own = axis.on(wheel.centre.body), *there = axis.on(body);
      if (body == wheel.centre.body || !own || !there || !same_pin_place(l, *own, wheel.centre)) continue;
      out.push_back(place_of(l, *there));
      break;
    }
  if (out.size() != belt.wheels.size()) out.clear();
  return out;
}

std::vector<double> signed_radii(const Belt& belt) {
  std::vector<double> out;
  for (const BeltWheel& wheel : belt.wheels) out.push_back(wheel.side * wheel.radius);
  return out;
}

// A closed belt runs round its wheels once: left of it where they are listed counter-clockwise, else right.
void orient(Belt& belt, const std::vector<std::complex<double>>& centres) {
  if (!belt.closed || belt.wheels.size() < 3) return;
  const auto once = [&] { return std::abs(belt_run(centres, signed_radii(belt), true).turns); };
  const auto turn_over = [&] {
    for (BeltWheel& wheel : belt.wheels) wheel.side = -wheel.side;
  };
  if (std::abs(once() - 1) < 1e-6) return;
  turn_over();
  if (std::abs(once() - 1) > 1e-6) turn_over();
}

void check_run(const BeltForm& f, const Belt& belt, const std::vector<std::complex<double>>& centres,
               FormNames& names) {
  const std::size_t n = belt.wheels.size();
  const std::vector<double> radii = signed_radii(belt);
  for (std::size_t i = 0; i + (belt.closed ? 0 : 1) < n; ++i) {
    const std::size_t next = (i + 1) % n;
    const double distance = std::abs(centres[next] - centres[i]);
    if (distance > std::abs(radii[next] - radii[i])) continue;
    return names.problem(
        "wheels",
        fmt::format("wheels of belt '{}' overlap: distance {:.6g} mm, radii {:.6g} and {:.6g} "
                    "mm",
                    f.name, distance * 1e3, std::abs(radii[i]) * 1e3, std::abs(radii[next]) * 1e3),
        "move them apart; crossed belts need more than the sum");
  }
  const double length = belt_run(centres, radii, belt.closed).length;
  if (f.length && std::abs(*f.length - length) > 1e-6 * length)
    names.problem("length_mm",
                  fmt::format("belt '{}' is {:.7g} mm long over its wheels, not {:.7g} mm", f.name,
                              length * 1e3, *f.length * 1e3),
                  "move a wheel, or leave the length out");
}

}  // namespace

double ratio_of(const JointForm& f, FormNames& names) {
  const InternalWheel internal = f.internal.value_or(InternalWheel::none);
  if (f.pitch_radii && (f.teeth || f.ratio || f.ratio_curve))
    names.problem("pitch_radii",
                  fmt::format("gear '{}' has {} and pitch radii", f.name,
                              f.teeth   ? "teeth"
                              : f.ratio ? "ratio"
                                        : "a ratio curve"),
                  "leave one");
  if (f.pitch_radii) return ratio_of_radii(f, internal, names);
  if (f.teeth && f.ratio)
    names.problem("ratio", fmt::format("gear '{}' has teeth and ratio", f.name), "leave one");
  if (f.ratio_curve && (f.teeth || f.ratio))
    names.problem("ratio_curve",
                  fmt::format("gear '{}' has {} and a ratio curve", f.name, f.teeth ? "teeth" : "ratio"),
                  "leave one");
  if (!f.teeth) {
    if (internal != InternalWheel::none)
      names.problem(
          "internal", fmt::format("gear '{}' has a ring but no teeth", f.name),
          "write the teeth or the pitch radii of both wheels; a ratio of a ring is positive by itself");
    return f.ratio.value_or(1);
  }
  if (f.teeth->size() != 2 || f.teeth->front() < 1 || f.teeth->back() < 1) {
    names.problem("teeth", fmt::format("gear '{}' has {} numbers of teeth", f.name, f.teeth->size()),
                  "write two, that of the first wheel first");
    return 1;
  }
  const int first = f.teeth->front(), second = f.teeth->back();
  if (internal == InternalWheel::none) return -static_cast<double>(first) / second;
  const bool first_is_ring = internal == InternalWheel::first;
  const int ring = first_is_ring ? first : second, pinion = first_is_ring ? second : first;
  if (ring <= pinion)
    names.problem("internal",
                  fmt::format("internal wheel '{}' has {} teeth, its pinion {}",
                              first_is_ring ? f.first : f.second, ring, pinion),
                  "the ring needs more: swap `internal`");
  return static_cast<double>(first) / second;
}

void measure_rack(const Linkage& l, const JointForm& f, bool drawn, LinkageJoint& rack, FormNames& names) {
  if (!drawn) {
    if (!f.radius)
      names.problem("radius_mm", fmt::format("the pinion of rack '{}' has no radius", f.name),
                    "give it, negative where the centre lies to the right of the direction of the rack");
    rack.radius = f.radius.value_or(1);
    return;
  }
  const std::complex<double> apart =
      (place_of(l, rack.first) - place_of(l, rack.second)) * std::polar(1.0, -rack.slide_second);
  rack.radius = apart.imag();
  if (f.radius && std::abs(std::abs(*f.radius) - std::abs(apart.imag())) > 1e-6 * std::abs(*f.radius))
    names.problem(
        "radius_mm",
        fmt::format("the pinion of rack '{}' has a radius of {:.6g} mm and is drawn {:.6g} mm from the "
                    "pitch line",
                    f.name, std::abs(*f.radius) * 1e3, std::abs(apart.imag()) * 1e3),
        "move the point of the rack or the pinion, or leave the radius out");
  if (apart.imag() != 0) rack.phase += apart.real() / apart.imag();
}

Belt belt_of(const BeltForm& f, FormNames& names) {
  Belt belt{.name = f.name, .closed = f.closed, .tension = f.tension};
  for (const BeltWheelForm& w : f.wheels) {
    BeltWheel wheel{names.point("wheels", w.at), w.radius, w.side == BeltSide::inside ? 1.0 : -1.0};
    if (w.teeth && !f.pitch)
      names.problem("wheels", fmt::format("belt '{}' has teeth but no pitch", f.name),
                    "give the pitch of the chain, or radii");
    else if (w.teeth)
      wheel.radius = *w.teeth * *f.pitch / full_turn;  // a turn moves as many links as the wheel has teeth
    belt.wheels.push_back(wheel);
  }
  if (belt.wheels.size() < 2)
    names.problem("wheels", fmt::format("belt '{}' has {} wheels", f.name, belt.wheels.size()),
                  "it runs over two or more");
  if (f.carrier) belt.carrier = names.body("carrier", *f.carrier);
  return belt;
}

void complete_belt(const Linkage& l, const BeltForm& f, bool drawn, Belt& belt, FormNames& names) {
  const std::vector<PinAxis> axes = axes_of(l);
  std::vector<std::complex<double>> centres;
  for (int body = 0; body < static_cast<int>(l.bodies.size()) && belt.closed && belt.carrier < 0; ++body)
    if (!centres_on(l, axes, belt, body).empty()) belt.carrier = body;
  if (belt.carrier >= 0) {
    centres = centres_on(l, axes, belt, belt.carrier);
    if (centres.empty())
      return names.problem("carrier",
                           fmt::format("'{}' does not carry all wheels of belt '{}'", *f.carrier, f.name),
                           "join each wheel to it by a pin at its centre");
  } else if (drawn) {
    for (const BeltWheel& wheel : belt.wheels) centres.push_back(place_of(l, wheel.centre));
  }
  if (belt.tension && belt.carrier < 0)
    names.problem("tension_N", fmt::format("the tension of '{}' follows from its loads", f.name),
                  "leave it out: only a closed belt on one carrier has a tension of its own");
  if (centres.empty()) return;
  orient(belt, centres);
  check_run(f, belt, centres, names);
}

void complete_gear(const Linkage& l, const JointForm& form, LinkageJoint& gear, FormNames& names) {
  const Wheels wheels{l, form, gear, axes_of(l)};
  if (!form.carrier) gear.carrier = carrier_of(wheels, names);
  gear.pressure_angle = working_angle(wheels, names);
  check_pitch_radii(wheels, names);
}

}  // namespace linkwright::planar
