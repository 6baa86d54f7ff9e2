// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/form.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string_view>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/belt_run.h"
#include "linkwright/planar/linkage/build.h"

namespace linkwright::planar {
namespace {

std::complex<double> number(const Place& p) { return {p[0], p[1]}; }
Place place(std::complex<double> z) { return {z.real(), z.imag()}; }

// Resolves names against the bodies that exist.
class Names {
 public:
  Names(const Linkage& linkage, std::vector<FormProblem>& problems) : l_(linkage), problems_(problems) {}

  bool clean() const { return problems_.empty(); }
  void at(std::string list, std::size_t index) { list_ = std::move(list), index_ = index; }
  int body(const std::string& key, const std::string& name) {
    const int found = body_index(l_, name);
    if (found < 0) {
      std::vector<std::string_view> known;
      for (const LinkageBody& b : l_.bodies) known.push_back(b.name);
      problem(key, fmt::format("there is no body '{}'", name), nearest(name, known));
    }
    return std::max(found, 0);
  }
  BodyPoint point(const std::string& key, const std::string& name) {
    const auto dot = name.rfind('.');
    if (dot == std::string::npos) {
      problem(key, fmt::format("'{}' is not a point", name), "write body.point, as \"crank.A\"");
      return {};
    }
    const std::size_t before = problems_.size();
    const int b = body(key, name.substr(0, dot));
    if (problems_.size() > before) return {};
    const LinkageBody& body = l_.bodies[static_cast<std::size_t>(b)];
    const int p = point_index(body, name.substr(dot + 1));
    if (p < 0) {
      std::vector<std::string_view> known;
      for (const LinkagePoint& q : body.points) known.push_back(q.name);
      problem(key, fmt::format("body '{}' has no point '{}'", body.name, name.substr(dot + 1)),
              nearest(name.substr(dot + 1), known));
    }
    return {b, std::max(p, 0)};
  }
  // The wheel of a gear: a body, or its centre.
  BodyPoint wheel(const std::string& key, const std::string& name) {
    const bool centre = body_index(l_, name) < 0 && name.find('.') != std::string::npos;
    return centre ? point(key, name) : BodyPoint{body(key, name), 0};
  }
  void problem(const std::string& key, std::string message, std::string hint, bool warning = false) {
    problems_.push_back({list_, index_, key, std::move(message), std::move(hint), warning});
  }

 private:
  static std::string nearest(std::string_view name, const std::vector<std::string_view>& known) {
    std::string all;
    for (std::string_view k : known) all += fmt::format("{}{}", all.empty() ? "there are: " : ", ", k);
    return did_you_mean(name, known, all);
  }
  const Linkage& l_;
  std::vector<FormProblem>& problems_;
  std::string list_;
  std::size_t index_ = 0;
};

LoadFactor factor_of(const FactorForm& f) { return {f.against, f.argument, f.factor, f.period}; }
FactorForm form_of(const LoadFactor& f) { return {f.against, f.argument, f.factor, f.period}; }

LinkageBody body_of(const BodyForm& form, bool drawn) {
  LinkageBody body{.name = form.name};
  for (const auto& [name, at] : form.points) body.points.push_back({name, number(at)});
  std::size_t n = 0;
  for (const AttachedMassForm& m : form.attached)
    body.attached.push_back({m.name.empty() ? fmt::format("mass {}", ++n) : m.name, m.mass, number(m.at)});
  if (form.start)
    body.start = math::Pose{form.start->x, form.start->y, form.start->angle};
  else if (drawn)
    body.start = math::Pose{};
  if (form.mass) body.mass = BodyMass{*form.mass, 0, 0};
  return body;
}

// Completes a mass from the joints of the body.
void complete_mass(Linkage& l, std::size_t b, const BodyForm& form) {
  LinkageBody& body = l.bodies[b];
  if (!form.mass) return;
  if (!body.points.empty() && (!form.inertia || !form.centre)) {
    Linkage alone = l;  // bodies may share a name, which is reported elsewhere
    alone.bodies[b].name = "\n";
    set_uniform(alone, "\n", *form.mass);
    body.mass = alone.bodies[b].mass;
    body.mass->assumed = true;
  }
  if (form.inertia) body.mass->inertia = *form.inertia;
  if (form.centre) body.mass->centre = number(*form.centre);
}

}  // namespace

namespace {

// The same by the radii of the pitch circles.
double ratio_of_radii(const JointForm& f, InternalWheel internal, Names& names) {
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

// The speed of the second wheel by that of the first.
double ratio_of(const JointForm& f, Names& names) {
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

// An axis: pins in one place, with the bodies that they join.
struct PinAxis {
  std::vector<BodyPoint> points;

  const BodyPoint* on(int body) const {
    const auto found =
        std::find_if(points.begin(), points.end(), [&](const BodyPoint& p) { return p.body == body; });
    return found == points.end() ? nullptr : &*found;
  }
};
std::complex<double> pin_place(const Linkage& l, const BodyPoint& p) {
  return l.bodies[static_cast<std::size_t>(p.body)].points[static_cast<std::size_t>(p.point)].at;
}
bool same_pin_place(const Linkage& l, const BodyPoint& p, const BodyPoint& q) {
  return p.body == q.body && std::abs(pin_place(l, p) - pin_place(l, q)) <= 1e-9 * size_of(l);
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
          return std::abs(pin_place(l, *first) - pin_place(l, *second));
      }
    return std::nullopt;
  }
};

// The body on which both wheels have a pin, each an axis of its own.
int carrier_of(const Wheels& wheels, Names& names) {
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
double working_angle(const Wheels& wheels, Names& names) {
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
void check_pitch_radii(const Wheels& wheels, Names& names) {
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

// The radius of a pinion, with the side of the pitch line on which its centre lies; and its angle where it is
// beside the point of the rack.
void measure_rack(const Linkage& l, const JointForm& f, bool drawn, LinkageJoint& rack, Names& names) {
  if (!drawn) {
    if (!f.radius)
      names.problem("radius_mm", fmt::format("the pinion of rack '{}' has no radius", f.name),
                    "give it, negative where the centre lies to the right of the direction of the rack");
    rack.radius = f.radius.value_or(1);
    return;
  }
  const std::complex<double> apart =
      (pin_place(l, rack.first) - pin_place(l, rack.second)) * std::polar(1.0, -rack.slide_second);
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

// The centres of the wheels of a belt on a body that carries all of them; empty where it does not.
std::vector<std::complex<double>> centres_on(const Linkage& l, const std::vector<PinAxis>& axes,
                                             const Belt& belt, int body) {
  std::vector<std::complex<double>> out;
  for (const BeltWheel& wheel : belt.wheels)
    for (const PinAxis& axis : axes) {
      const BodyPoint *own = axis.on(wheel.centre.body), *there = axis.on(body);
      if (body == wheel.centre.body || !own || !there || !same_pin_place(l, *own, wheel.centre)) continue;
      out.push_back(pin_place(l, *there));
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
               Names& names) {
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

Belt belt_of(const BeltForm& f, Names& names) {
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

// Finds the body that carries a closed belt, the direction in which it runs, and checks its way.
void complete_belt(const Linkage& l, const BeltForm& f, bool drawn, Belt& belt, Names& names) {
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
    for (const BeltWheel& wheel : belt.wheels) centres.push_back(pin_place(l, wheel.centre));
  }
  if (belt.tension && belt.carrier < 0)
    names.problem("tension_N", fmt::format("the tension of '{}' follows from its loads", f.name),
                  "leave it out: only a closed belt on one carrier has a tension of its own");
  if (centres.empty()) return;
  orient(belt, centres);
  check_run(f, belt, centres, names);
}

// The length of a spring without force, from its pull in the drawn position or where its bodies start.
double free_length_of(const Linkage& l, const SpringForm& f, Names& names) {
  const auto place_at_start = [&](const BodyPoint& p) -> std::optional<std::complex<double>> {
    const std::optional<math::Pose>& start = l.bodies[static_cast<std::size_t>(p.body)].start;
    if (p.body == 0) return pin_place(l, p);
    if (!start) return std::nullopt;
    return std::complex<double>(start->x, start->y) + std::polar(1.0, start->angle) * pin_place(l, p);
  };
  const auto first = place_at_start(l.springs.back().first), second = place_at_start(l.springs.back().second);
  if (f.free_length != 0) {
    names.problem("preload_N", fmt::format("spring '{}' has a preload and a free length", f.name),
                  "leave one");
  } else if (f.stiffness == 0) {
    names.problem("preload_N", fmt::format("spring '{}' has a preload but no stiffness", f.name),
                  "give the stiffness, or a strut with a constant force");
  } else if (!first || !second) {
    names.problem("preload_N",
                  fmt::format("the length at which spring '{}' has its preload is not known", f.name),
                  "draw the linkage (drawn = true), give its bodies a start, or write free_length_mm");
  } else {
    const double length = std::abs(*second - *first), free = length - *f.preload / f.stiffness;
    if (free >= 0) return free;
    names.problem("preload_N",
                  fmt::format("spring '{}' is {:.6g} mm long there and cannot pull with {:.6g} N: its free "
                              "length would be {:.6g} mm",
                              f.name, length * 1e3, *f.preload, free * 1e3),
                  fmt::format("pull with {:.6g} N at most, or take a stiffer spring", f.stiffness * length));
  }
  return 0;
}

// The table of a strut, whose argument has the unit of what it goes by.
LoadFactor table_of(const StrutForm& f, Names& names) {
  struct Argument {
    const std::optional<std::vector<double>>& values;
    const char* key;
    bool fits;
  };
  using enum LoadArgument;
  const Argument all[] = {{f.lengths, "argument_mm", f.against == length || f.against == input},
                          {f.times, "argument_s", f.against == time},
                          {f.speeds, "argument_mm_per_s", f.against == speed},
                          {f.angles, "argument_deg", f.against == input}};
  LoadFactor table{f.against, {}, f.force_table.value_or(std::vector<double>()), f.period};
  const std::string against(name_of(f.against));
  if (f.against == x || f.against == y) {
    names.problem("against", fmt::format("strut '{}' goes by {}, but has two points", f.name, against),
                  "let it go by length, speed, time or input");
    return table;
  }
  if (!f.force_table)
    names.problem("against", fmt::format("strut '{}' goes by {} but has no table", f.name, against),
                  "write force_table_N with the force at each argument");
  std::string fitting;
  bool given = false;
  for (const Argument& a : all) {
    if (a.fits) fitting = fitting.empty() ? a.key : fitting + " or " + a.key;
    if (!a.values) continue;
    if (!a.fits)
      names.problem("argument",
                    fmt::format("strut '{}' goes by {}, which is not in {}", f.name, against, a.key), "");
    given = true;
    table.argument = *a.values;
  }
  if (!given)
    names.problem("against", fmt::format("the table of strut '{}' has no arguments", f.name),
                  "write them as " + fitting);
  return table;
}

Strut strut_of(const StrutForm& f, Names& names) {
  Strut s{.name = f.name, .first = names.point("first", f.first), .second = names.point("second", f.second)};
  const int laws = (f.force ? 1 : 0) + (f.gas ? 1 : 0) + (f.cylinder ? 1 : 0) +
                   (f.force_table || f.against != LoadArgument::constant ? 1 : 0);
  if (laws != 1)
    names.problem("name", fmt::format("strut '{}' has {}", f.name, laws == 0 ? "no force" : "several forces"),
                  "give one of force_N, force_table_N, gas and cylinder");
  s.force = f.force.value_or(1);
  if (f.against != LoadArgument::constant)
    s.factor = table_of(f, names);
  else if (f.force_table)
    names.problem("against",
                  fmt::format("strut '{}' has a table, but it is not said what it goes by", f.name),
                  "write against = \"length\", \"speed\", \"time\" or \"input\"");
  if (f.gas) {
    if (!f.gas->extended_force || !f.gas->extended_length)
      names.problem("gas",
                    fmt::format("gas spring '{}' has no extended {}", f.name,
                                f.gas->extended_force ? "length" : "force"),
                    "write extended_N and extended_mm, its force and length when it is extended");
    s.gas = GasSpring{f.gas->extended_force.value_or(1), f.gas->extended_length.value_or(1), f.gas->stroke,
                      f.gas->progression};
  }
  if (f.cylinder)
    s.cylinder = Cylinder{f.cylinder->bore, f.cylinder->rod, f.cylinder->pressure, f.cylinder->back_pressure};
  return s;
}

StrutForm form_of(const Strut& s, std::string first, std::string second, bool rotary) {
  StrutForm f{.name = s.name, .first = std::move(first), .second = std::move(second)};
  if (s.gas) {
    f.gas = GasSpringForm{s.gas->extended_force, s.gas->extended_length, s.gas->stroke, s.gas->progression};
  } else if (s.cylinder) {
    f.cylinder =
        CylinderForm{s.cylinder->bore, s.cylinder->rod, s.cylinder->pressure, s.cylinder->back_pressure};
  } else if (s.factor.against == LoadArgument::constant) {
    f.force = s.force;
  } else {
    f.against = s.factor.against;
    f.period = s.factor.period;
    f.force_table = s.factor.factor;
    for (double& force : *f.force_table) force *= s.force;
    const bool angle = f.against == LoadArgument::input && rotary;
    (f.against == LoadArgument::time    ? f.times
     : f.against == LoadArgument::speed ? f.speeds
     : angle                            ? f.angles
                                        : f.lengths) = s.factor.argument;
  }
  return f;
}

StopForm form_of(const Linkage& l, const JointStop& s) {
  const LinkageJoint& joint = l.joints[static_cast<std::size_t>(s.joint)];
  const bool pin = joint.type == JointType::revolute;
  StopForm f{.joint = joint.name};
  (s.side > 0 ? pin ? f.at_least_angle : f.at_least_length
   : pin      ? f.at_most_angle
              : f.at_most_length) = s.limit;
  if (s.arm > 0) f.arm = s.arm;
  if (s.stiffness) {
    (pin ? f.stiffness_angular : f.stiffness) = s.stiffness;
    (pin ? f.damping_angular : f.damping) = s.damping;
  } else {
    f.restitution = s.restitution;
  }
  return f;
}

// Friction at rest, of falling curves and without load.
void set_friction(LinkageJoint& j, const JointForm& f, Names& names) {
  if (f.friction_torque && j.type != JointType::revolute)
    names.problem("friction_torque_N_m",
                  fmt::format("joint '{}' is not a pin, and has a friction torque", f.name),
                  "a slide or slot has a friction_force");
  if (f.friction_force && j.type != JointType::prismatic && j.type != JointType::pin_in_slot)
    names.problem("friction_force_N",
                  fmt::format("joint '{}' is not a slide or slot, and has a friction force", f.name),
                  "a pin has a friction_torque");
  if (j.screw && (f.friction_static || f.friction_force || f.stribeck_speed))
    names.problem("friction", fmt::format("screw '{}' has friction of a slide", f.name),
                  "the friction of its thread is `friction` alone");
  if (f.friction_static && *f.friction_static < f.friction)
    names.problem("friction_static",
                  fmt::format("friction_static {} of joint '{}' is below its friction {}", *f.friction_static,
                              f.name, f.friction),
                  "friction_static is the larger of the two");
  if (f.stribeck_speed && !f.friction_static)
    names.problem("stribeck_speed",
                  fmt::format("the friction of joint '{}' falls with the speed from no value", f.name),
                  "give friction_static, the value at rest");
  if (f.friction_fall && !f.stribeck_speed)
    names.problem("friction_fall", fmt::format("joint '{}' has a curve of friction without a speed", f.name),
                  "give stribeck_speed");
  j.friction_static = f.friction_static.value_or(0);
  j.friction_effort = f.friction_torque.value_or(0) + f.friction_force.value_or(0);
  j.friction_speed = f.stribeck_speed.value_or(0);
  j.friction_fall = f.friction_fall.value_or(FrictionFall::stribeck);
}

LinkageJoint joint_of(const JointForm& f, bool drawn, Names& names) {
  LinkageJoint j{.name = f.name, .type = f.type};
  if (f.type == JointType::gear) {
    j.first = names.wheel("first", f.first);
    j.second = names.wheel("second", f.second);
    j.ratio = ratio_of(f, names);
    if (f.carrier) j.carrier = names.body("carrier", *f.carrier);
    if (f.pressure_angle) j.pressure_angle = *f.pressure_angle;
    if (f.ratio_curve) j.curve = RatioCurve{f.ratio_curve->first, f.ratio_curve->second};
    j.efficiency = f.efficiency.value_or(1);
  } else {
    j.first = names.point("first", f.first);
    j.second = names.point("second", f.second);
  }
  if (f.type == JointType::geneva) {
    const InternalWheel internal = f.internal.value_or(InternalWheel::none);
    if (internal == InternalWheel::first)
      names.problem("internal", fmt::format("the pin of Geneva drive '{}' is on its first body", f.name),
                    "write second, where the crank turns within the wheel");
    if (!f.slots)
      names.problem("slots", fmt::format("the wheel of Geneva drive '{}' has no slots", f.name),
                    "give their number, such as slots = 4");
    j.type = JointType::gear;
    j.pressure_angle = 0;
    j.geneva = Geneva{{f.slots.value_or(4), internal == InternalWheel::second}, f.slot_angle};
    if (!drawn && !f.slot_angle) j.geneva->slot = 0;
    if (f.carrier) j.carrier = names.body("carrier", *f.carrier);
  }
  if (f.type == JointType::screw) {
    if (!f.lead)
      names.problem("lead_mm", fmt::format("screw '{}' has no lead", f.name),
                    "give the displacement for one turn of the spindle");
    j.type = JointType::prismatic;
    j.screw = Screw{f.lead.value_or(1),
                    f.pitch_diameter.value_or(0),
                    f.friction,
                    f.flank_angle.value_or(pi / 3),
                    f.spindle_inertia.value_or(0),
                    f.hand == ThreadHand::left};
  }
  j.slide_first = f.direction;
  j.slide_second = f.direction_second.value_or(drawn && (j.type == JointType::prismatic) ? f.direction : 0.0);
  j.phase = f.phase;
  if (f.type == JointType::rack) {
    j.slide_first = 0, j.slide_second = f.direction;
    if (f.pressure_angle) j.pressure_angle = *f.pressure_angle;
  }
  j.friction = j.screw ? 0 : f.friction, j.pin_radius = f.pin_radius, j.guide_length = f.guide_length;
  set_friction(j, f, names);
  return j;
}

// The joint of a name, of one that the file has.
int joint_named(const Linkage& l, const std::string& key, const std::string& name, Names& names) {
  const int found = joint_index(l, name);
  if (found < 0) {
    std::vector<std::string_view> known;
    for (const LinkageJoint& j : l.joints) known.push_back(j.name);
    std::string all;
    for (std::string_view k : known) all += fmt::format("{}{}", all.empty() ? "there are: " : ", ", k);
    names.problem(key, fmt::format("there is no joint '{}'", name), did_you_mean(name, known, all));
  }
  return found;
}

// A cam, whose values are lengths or angles as its follower slides or turns.
struct CamReading {
  const CamMemberForm& form;
  Names& names;
  bool rotary = false;

  std::optional<double> value(std::string_view key, const FollowerValueForm& v) const {
    if (rotary ? v.length : v.angle)
      names.problem(std::string(key),
                    fmt::format("the follower of cam '{}' {}, and has {} in {}", form.name,
                                rotary ? "turns" : "slides", key, rotary ? "mm" : "deg"),
                    fmt::format("write {}_{}", key, rotary ? "deg" : "mm"));
    return rotary ? v.angle : v.length;
  }
  CamSegment segment(const CamSegmentForm& f) const {
    CamSegment s{.law = f.law, .over = f.over, .to = 0, .conditions = {}};
    const std::optional<double> to = value("to", f.to);
    if (f.law == CamLaw::dwell && to)
      names.problem("segment", fmt::format("a dwell of cam '{}' has an end value", form.name),
                    "a dwell stays where the segment before it ends: leave it out");
    if (f.law != CamLaw::dwell && !to)
      names.problem("segment", fmt::format("a segment of cam '{}' has no end value", form.name),
                    rotary ? "write to_deg = 20" : "write to_mm = 20");
    s.to = to.value_or(0);
    SegmentConditions& c = s.conditions;
    c.start_rate = value("start_rate", f.start_rate);
    c.start_acceleration = value("start_acceleration", f.start_acceleration);
    c.start_jerk = value("start_jerk", f.start_jerk);
    c.end_rate = value("end_rate", f.end_rate);
    c.end_acceleration = value("end_acceleration", f.end_acceleration);
    c.end_jerk = value("end_jerk", f.end_jerk);
    const bool has_conditions = c.start_rate || c.start_acceleration || c.start_jerk || c.end_rate ||
                                c.end_acceleration || c.end_jerk;
    if (f.law != CamLaw::polynomial && has_conditions)
      names.problem("segment", fmt::format("the law '{}' has its own conditions at the ends", name_of(f.law)),
                    "write law = \"polynomial\", or leave them out");
    return s;
  }
  CamProgramme programme() const {
    CamProgramme p{.start = value("start", form.start).value_or(0), .is_sector = form.sector};
    for (const CamSegmentForm& s : form.segments) p.segments.push_back(segment(s));
    if (form.table) {
      const auto& [angles, lengths, turned] = *form.table;
      const auto &values = rotary ? turned : lengths, &others = rotary ? lengths : turned;
      if (!values || others || values->size() != angles.size())
        names.problem(
            "table",
            fmt::format("the table of cam '{}' has {} values for {} angles", form.name,
                        values ? values->size() : 0, angles.size()),
            rotary ? "give one of values_deg for each angle" : "give one of values_mm for each angle");
      p.table = CamTable{angles, values.value_or(std::vector<double>())};
    }
    if (p.segments.empty() && !p.table)
      names.problem("segment", fmt::format("cam '{}' has no programme", form.name),
                    "write [[mechanism.cam.segment]] with law, over_deg and to_mm or to_deg");
    if (!form.sector) return p;
    p.angle = 0;
    for (const CamSegment& s : p.segments) p.angle += s.over;
    if (p.table && !p.table->angles.empty()) p.angle = p.table->angles.back();
    return p;
  }
};

LinkageCam cam_of(const Linkage& l, const CamMemberForm& f, Names& names) {
  LinkageCam c{.name = f.name,
               .turns = joint_named(l, "turns", f.turns, names),
               .moves = joint_named(l, "moves", f.moves, names),
               .contact = names.point("contact", f.contact),
               .face = f.follower,
               .roller_radius = f.roller_radius.value_or(0),
               .base_radius = f.base_radius,
               .face_direction = f.face_direction.value_or(0),
               .form = f.form,
               .is_clockwise = f.sense == Rotation::clockwise,
               .phase = f.phase};
  if (f.roller_radius && f.follower != FollowerFace::roller)
    names.problem("roller_radius", fmt::format("a {} follower has no roller", name_of(f.follower)),
                  "leave the radius out");
  if (f.face_direction && f.follower != FollowerFace::flat)
    names.problem("face_direction", fmt::format("a {} follower has no face", name_of(f.follower)),
                  "leave its direction out");
  if (c.moves < 0) return c;
  const CamReading reading{f, names, l.joints[static_cast<std::size_t>(c.moves)].type == JointType::revolute};
  c.programme = reading.programme();
  return c;
}

FollowerValueForm value_form(const std::optional<double>& value, bool rotary) {
  FollowerValueForm out;
  (rotary ? out.angle : out.length) = value;
  return out;
}
CamMemberForm form_of(const LinkageCam& c, const Linkage& l, std::string contact) {
  const bool rotary = l.joints[static_cast<std::size_t>(c.moves)].type == JointType::revolute;
  CamMemberForm f{.name = c.name,
                  .turns = l.joints[static_cast<std::size_t>(c.turns)].name,
                  .moves = l.joints[static_cast<std::size_t>(c.moves)].name,
                  .follower = c.face,
                  .contact = std::move(contact)};
  if (c.face == FollowerFace::roller) f.roller_radius = c.roller_radius;
  if (c.face == FollowerFace::flat) f.face_direction = c.face_direction;
  f.base_radius = c.base_radius;
  f.form = c.form;
  f.sense = c.is_clockwise ? Rotation::clockwise : Rotation::counterclockwise;
  f.phase = c.phase;
  f.start = value_form(c.programme.start, rotary);
  f.sector = c.programme.is_sector;
  for (const CamSegment& s : c.programme.segments) {
    const SegmentConditions& e = s.conditions;
    CamSegmentForm& out = f.segments.emplace_back();
    out.law = s.law, out.over = s.over;
    if (s.law != CamLaw::dwell) out.to = value_form(s.to, rotary);
    out.start_rate = value_form(e.start_rate, rotary), out.end_rate = value_form(e.end_rate, rotary);
    out.start_acceleration = value_form(e.start_acceleration, rotary);
    out.end_acceleration = value_form(e.end_acceleration, rotary);
    out.start_jerk = value_form(e.start_jerk, rotary), out.end_jerk = value_form(e.end_jerk, rotary);
  }
  if (const auto& table = c.programme.table) {
    f.table = CamTableForm{table->angles, {}, {}};
    (rotary ? f.table->follower_angles : f.table->lengths) = table->values;
  }
  return f;
}

// The stops of one entry: a lower one, an upper one, or both.
void add_stops(const StopForm& f, Linkage& l, Names& names) {
  const int joint = joint_named(l, "joint", f.joint, names);
  if (joint < 0) return;
  const bool pin = l.joints[static_cast<std::size_t>(joint)].type == JointType::revolute;
  const auto &least = pin ? f.at_least_angle : f.at_least_length,
             &most = pin ? f.at_most_angle : f.at_most_length;
  if (pin ? f.at_least_length || f.at_most_length : f.at_least_angle || f.at_most_angle)
    return names.problem(
        "joint",
        fmt::format("joint '{}' {}", f.joint,
                    pin ? "turns, and its stop is at a length" : "slides, and its stop is at an angle"),
        pin ? "write at_least_deg or at_most_deg" : "write at_least_mm or at_most_mm");
  if (!least && !most)
    return names.problem("joint", fmt::format("the stop of joint '{}' has no place", f.joint),
                         pin ? "write at_least_deg or at_most_deg" : "write at_least_mm or at_most_mm");
  if (f.arm && !pin)
    return names.problem("arm_mm", fmt::format("joint '{}' slides, and its stop has an arm", f.joint),
                         "leave the arm out");
  if (pin && !f.arm && (f.stiffness || f.damping))
    return names.problem("stiffness_N_per_m",
                         fmt::format("the stop of '{}' has no arm on which its stiffness acts", f.joint),
                         "give arm_mm, or stiffness_N_m_per_rad");
  if (!pin && (f.stiffness_angular || f.damping_angular))
    return names.problem("stiffness_N_m_per_rad",
                         fmt::format("joint '{}' slides, and its stop has a stiffness of a turn", f.joint),
                         "write stiffness_N_per_m");
  const double square = pin ? f.arm.value_or(0) * f.arm.value_or(0) : 1;
  JointStop stop{.joint = joint, .restitution = f.restitution.value_or(0), .arm = f.arm.value_or(0)};
  if (f.stiffness) stop.stiffness = *f.stiffness * square;
  if (f.stiffness_angular) stop.stiffness = *f.stiffness_angular;
  stop.damping = f.damping.value_or(0) * square + f.damping_angular.value_or(0);
  if (stop.stiffness && f.restitution)
    return names.problem("restitution",
                         fmt::format("the stop of '{}' has a stiffness and a restitution", f.joint),
                         "a rigid stop has a restitution, one that gives way has a damping: leave one");
  if (!stop.stiffness && stop.damping > 0)
    return names.problem("damping", fmt::format("the stop of '{}' has a damping but no stiffness", f.joint),
                         "give the stiffness, or the restitution of a rigid stop");
  for (const double side : {1.0, -1.0}) {
    const auto& limit = side > 0 ? least : most;
    if (!limit) continue;
    stop.limit = *limit, stop.side = side;
    l.stops.push_back(stop);
  }
}

// Springs, forces, torques, struts and stops.
void add_loads(const LinkageForm& form, Linkage& l, Names& names) {
  for (std::size_t i = 0; i < form.springs.size(); ++i) {
    const SpringForm& s = form.springs[i];
    names.at("spring", i);
    l.springs.push_back({s.name, names.point("first", s.first), names.point("second", s.second), s.stiffness,
                         s.free_length, s.damping});
    if (s.preload && names.clean()) l.springs.back().free_length = free_length_of(l, s, names);
  }
  for (std::size_t i = 0; i < form.torsion_springs.size(); ++i) {
    const TorsionSpringForm& s = form.torsion_springs[i];
    names.at("torsion_spring", i);
    l.torsion_springs.push_back({s.name, names.body("first", s.first), names.body("second", s.second),
                                 s.stiffness, s.free_angle, s.damping});
  }
  for (std::size_t i = 0; i < form.forces.size(); ++i) {
    const ForceForm& f = form.forces[i];
    names.at("force", i);
    l.forces.push_back(
        {f.name, names.point("point", f.point), number(f.force), f.turns_with_body, factor_of(f.factor)});
  }
  for (std::size_t i = 0; i < form.torques.size(); ++i) {
    const TorqueForm& t = form.torques[i];
    names.at("torque", i);
    l.torques.push_back(
        {t.name, names.body("body", t.body), names.body("from", t.from), t.torque, factor_of(t.factor)});
  }
  for (std::size_t i = 0; i < form.struts.size(); ++i) {
    names.at("strut", i);
    l.struts.push_back(strut_of(form.struts[i], names));
  }
  for (std::size_t i = 0; i < form.stops.size(); ++i) {
    names.at("stop", i);
    add_stops(form.stops[i], l, names);
  }
}

}  // namespace

Linkage linkage_of(const LinkageForm& form, std::vector<FormProblem>& problems) {
  Linkage l;
  for (const BodyForm& b : form.bodies) l.bodies.push_back(body_of(b, form.drawn));
  l.moment_centre = number(form.moment_centre);
  Names names(l, problems);
  if (l.bodies.empty()) {
    names.problem("body", "the linkage has no bodies",
                  "add [[mechanism.body]] tables; the first is the ground");
    return l;
  }
  for (std::size_t i = 0; i < form.joints.size(); ++i) {
    names.at("joint", i);
    l.joints.push_back(joint_of(form.joints[i], form.drawn, names));
  }
  const bool pins_known = problems.empty();
  for (std::size_t i = 0; i < form.joints.size() && pins_known; ++i) {
    names.at("joint", i);
    if (form.joints[i].type == JointType::rack)
      measure_rack(l, form.joints[i], form.drawn, l.joints[i], names);
    if (l.joints[i].type != JointType::gear) continue;
    const Wheels wheels{l, form.joints[i], l.joints[i], axes_of(l)};
    if (!form.joints[i].carrier) l.joints[i].carrier = carrier_of(wheels, names);
    l.joints[i].pressure_angle = working_angle(wheels, names);
    check_pitch_radii(wheels, names);
  }
  for (std::size_t i = 0; i < form.belts.size() && pins_known; ++i) {
    names.at("belt", i);
    const std::size_t before = problems.size();
    Belt belt = belt_of(form.belts[i], names);
    if (problems.size() == before) complete_belt(l, form.belts[i], form.drawn, belt, names);
    l.belts.push_back(std::move(belt));
  }
  for (std::size_t i = 0; i < form.cams.size(); ++i) {
    names.at("cam", i);
    l.cams.push_back(cam_of(l, form.cams[i], names));
  }
  for (std::size_t i = 0; i < form.assembly.size(); ++i) {
    const AssemblyForm& a = form.assembly[i];
    names.at("assembly", i);
    if (a.bodies.empty() || a.bodies.size() > 2) {
      names.problem("bodies", fmt::format("has {} bodies, must have two", a.bodies.size()),
                    "or one, when the other is the block of a slot");
      continue;
    }
    l.modes.push_back(
        {names.body("bodies", a.bodies.front()), names.body("bodies", a.bodies.back()), a.mode});
  }
  add_loads(form, l, names);
  for (std::size_t b = 0; b < form.bodies.size(); ++b) complete_mass(l, b, form.bodies[b]);
  return l;
}

LinkageForm form_of(const Linkage& l) {
  LinkageForm form;
  form.moment_centre = place(l.moment_centre);
  const auto body = [&](int b) { return l.bodies[static_cast<std::size_t>(b)].name; };
  const auto point = [&](const BodyPoint& p) {
    return body(p.body) + "." +
           l.bodies[static_cast<std::size_t>(p.body)].points[static_cast<std::size_t>(p.point)].name;
  };
  for (const LinkageBody& b : l.bodies) {
    BodyForm f{.name = b.name};
    for (const LinkagePoint& p : b.points) f.points.emplace_back(p.name, place(p.at));
    if (b.mass) f.mass = b.mass->mass, f.inertia = b.mass->inertia, f.centre = place(b.mass->centre);
    for (const AttachedMass& m : b.attached) f.attached.push_back({m.name, m.mass, place(m.at)});
    if (b.start) f.start = StartForm{b.start->x, b.start->y, b.start->angle};
    form.bodies.push_back(std::move(f));
  }
  for (const LinkageJoint& j : l.joints) {
    JointForm f{.name = j.name, .type = j.type};
    const bool gear = j.type == JointType::gear;
    f.first = gear && !j.geneva ? body(j.first.body) : point(j.first);
    f.second = gear && !j.geneva ? body(j.second.body) : point(j.second);
    f.direction = j.type == JointType::rack ? j.slide_second : j.slide_first;
    if (j.type == JointType::prismatic || j.type == JointType::fixed) f.direction_second = j.slide_second;
    f.phase = j.phase;
    if (gear) f.ratio = j.ratio, f.carrier = body(j.carrier), f.pressure_angle = j.pressure_angle;
    if (j.efficiency < 1) f.efficiency = j.efficiency;
    if (j.geneva) {
      f.type = JointType::geneva;
      f.slots = j.geneva->slots.count, f.slot_angle = j.geneva->slot;
      if (j.geneva->slots.internal) f.internal = InternalWheel::second;
      f.ratio.reset(), f.pressure_angle.reset();
    }
    if (j.curve) f.ratio_curve = RatioCurveForm{j.curve->first, j.curve->second}, f.ratio.reset();
    if (j.type == JointType::rack) f.radius = j.radius, f.pressure_angle = j.pressure_angle;
    if (j.screw) {
      const Screw& s = *j.screw;
      f.type = JointType::screw;
      f.lead = s.lead, f.flank_angle = s.flank_angle, f.spindle_inertia = s.spindle_inertia;
      if (s.pitch_diameter > 0) f.pitch_diameter = s.pitch_diameter;
      f.hand = s.left_hand ? ThreadHand::left : ThreadHand::right;
    }
    f.friction = j.screw ? j.screw->friction : j.friction, f.pin_radius = j.pin_radius,
    f.guide_length = j.guide_length;
    if (j.friction_static > 0) f.friction_static = j.friction_static;
    if (j.friction_effort > 0)
      (j.type == JointType::revolute ? f.friction_torque : f.friction_force) = j.friction_effort;
    if (j.friction_speed > 0) {
      f.stribeck_speed = j.friction_speed;
      if (j.friction_fall != FrictionFall::stribeck) f.friction_fall = j.friction_fall;
    }
    form.joints.push_back(std::move(f));
  }
  for (const DyadMode& m : l.modes) form.assembly.push_back({{body(m.first), body(m.second)}, m.mode});
  for (const LinearSpring& s : l.springs)
    form.springs.push_back(
        {s.name, point(s.first), point(s.second), s.stiffness, s.free_length, s.damping, {}});
  for (const TorsionSpring& s : l.torsion_springs)
    form.torsion_springs.push_back(
        {s.name, body(s.first), body(s.second), s.stiffness, s.free_angle, s.damping});
  for (const PointForce& f : l.forces)
    form.forces.push_back({f.name, point(f.point), place(f.force), f.turns_with_body, form_of(f.factor)});
  for (const BodyTorque& t : l.torques)
    form.torques.push_back({t.name, body(t.body), body(t.from), t.torque, form_of(t.factor)});
  for (const Belt& b : l.belts) {
    BeltForm f{.name = b.name, .closed = b.closed, .tension = b.tension};
    for (const BeltWheel& w : b.wheels)
      f.wheels.push_back({point(w.centre), w.radius, w.side > 0 ? BeltSide::inside : BeltSide::outside, {}});
    if (b.carrier >= 0) f.carrier = body(b.carrier);
    form.belts.push_back(std::move(f));
  }
  for (const LinkageCam& c : l.cams) form.cams.push_back(form_of(c, l, point(c.contact)));
  const bool rotary =
      !l.driven.empty() && l.joints[static_cast<std::size_t>(l.driven[0])].type == JointType::revolute;
  for (const Strut& s : l.struts) form.struts.push_back(form_of(s, point(s.first), point(s.second), rotary));
  for (const JointStop& s : l.stops) form.stops.push_back(form_of(l, s));
  return form;
}

}  // namespace linkwright::planar
