// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/linkage/linkage.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include "linkwright/planar/cam/detail/finding_words.h"

namespace linkwright::planar {
namespace {

bool finite(std::complex<double> z) { return std::isfinite(z.real()) && std::isfinite(z.imag()); }

class Checker {
 public:
  explicit Checker(const Linkage& linkage) : l_(linkage) {}

  Diagnostics run() {
    if (l_.bodies.empty()) {
      error("body", "the linkage has no bodies, not even a ground", "the first body is the ground");
      return std::move(found_);
    }
    names();
    for (const LinkageBody& b : l_.bodies) body(b);
    for (const LinkageJoint& j : l_.joints) joint(j);
    for (const Belt& b : l_.belts) belt(b);
    for (const LinkageCam& c : l_.cams) cam(c);
    drives();
    loads();
    if (!finite(l_.gravity)) error("environment.gravity", "is not finite", {});
    if (!finite(l_.moment_centre)) error("moment_centre", "is not finite", {});
    if (found_.empty()) zero_lengths();
    return std::move(found_);
  }

 private:
  void error(std::string key, std::string message, std::string hint) {
    found_.push_back(
        {Diagnostic::Severity::error, {}, {}, std::move(key), std::move(message), std::move(hint)});
  }
  bool has(const BodyPoint& p) const {
    return p.body >= 0 && p.body < static_cast<int>(l_.bodies.size()) && p.point >= 0 &&
           p.point < static_cast<int>(l_.bodies[static_cast<std::size_t>(p.body)].points.size());
  }
  bool has_body(int body) const { return body >= 0 && body < static_cast<int>(l_.bodies.size()); }

  template <class Items>
  void twice(const Items& items, const char* kind) {
    std::set<std::string> seen;
    for (const auto& item : items) {
      if (item.name.empty()) error(kind, "has no name", "give every one a name of its own");
      if (!seen.insert(item.name).second && !item.name.empty())
        error(fmt::format("{}.{}", kind, item.name), fmt::format("the name '{}' is given twice", item.name),
              "give every one a name of its own");
    }
  }
  void names() {
    twice(l_.bodies, "body");
    twice(l_.joints, "joint");
    twice(l_.springs, "spring");
    twice(l_.torsion_springs, "torsion_spring");
    twice(l_.forces, "force");
    twice(l_.torques, "torque");
    twice(l_.struts, "strut");
    twice(l_.belts, "belt");
    twice(l_.cams, "cam");
    for (const LinkageBody& b : l_.bodies) twice(b.points, ("body." + b.name + ".point").c_str());
  }
  void body(const LinkageBody& b) {
    const std::string key = "body." + b.name;
    for (const LinkagePoint& p : b.points)
      if (!finite(p.at)) error(key + ".point." + p.name, "its coordinates are not finite", {});
    const auto joints = std::count_if(l_.joints.begin(), l_.joints.end(), [&](const LinkageJoint& j) {
      const LinkageBody* bodies = l_.bodies.data();
      return bodies + j.first.body == &b || bodies + j.second.body == &b;
    });
    if (b.stiffness > 0 && joints != 2)
      error(key, fmt::format("has an axial stiffness, and {} joints", joints),
            "a bar has two; give the joints their compliance_m_per_N instead");
    if (b.mass && !(b.mass->mass >= 0 && b.mass->inertia >= 0 &&
                    std::isfinite(b.mass->mass + b.mass->inertia) && finite(b.mass->centre)))
      error(key + ".mass",
            fmt::format("mass {} and inertia {} must be finite and not negative", b.mass->mass,
                        b.mass->inertia),
            {});
    for (const AttachedMass& m : b.attached)
      if (!(m.mass >= 0 && std::isfinite(m.mass) && finite(m.at)))
        error(key + ".attached." + m.name, fmt::format("mass {} must be finite and not negative", m.mass),
              {});
  }
  void joint(const LinkageJoint& j) {
    const std::string key = "joint." + j.name;
    const bool gear = j.type == JointType::gear, rack = j.type == JointType::rack;
    if (gear ? !has_body(j.first.body) || !has_body(j.second.body) || !has_body(j.carrier)
             : !has(j.first) || !has(j.second)) {
      error(key, "refers to a body or point that does not exist", {});
      return;
    }
    if (j.first.body == j.second.body)
      error(key, fmt::format("joins body '{}' to itself", name(j.first.body)), "a joint needs two bodies");
    if (!std::isfinite(j.slide_first + j.slide_second + j.ratio + j.phase))
      error(key, "its angles and ratio must be finite", {});
    if (!(j.friction >= 0 && j.pin_radius >= 0 && j.guide_length >= 0 &&
          std::isfinite(j.friction + j.pin_radius + j.guide_length)))
      error(key, "friction, pin radius and guide length must be finite and not negative", {});
    else if (has_friction(j) && (gear || rack || j.type == JointType::fixed))
      error(key, fmt::format("a {} joint has no friction", words_[static_cast<std::size_t>(j.type)]), {});
    else if ((std::max(j.friction, j.friction_static) > 0 || !j.friction_values.empty()) &&
             j.type == JointType::revolute && j.pin_radius == 0)
      error(key, "has friction but no pin radius: its torque would be zero",
            "give the radius of the pin, or a friction torque");
    if (!(j.friction_static >= 0 && j.friction_effort >= 0 && j.friction_speed >= 0 &&
          std::isfinite(j.friction_static + j.friction_effort + j.friction_speed)))
      error(key, "friction at rest, its effort and its speed must be finite and not negative", {});
    else if (j.friction_static > 0 && j.friction_static < j.friction)
      error(key,
            fmt::format("its friction at rest, {}, is below its friction in motion, {}", j.friction_static,
                        j.friction),
            "friction_static is the larger of the two");
    else if (j.friction_speed > 0 && j.friction_static == 0)
      error(key, "its friction falls with the speed, but has no value at rest", "give friction_static");
    if (!j.friction_values.empty() || !j.friction_speeds.empty()) friction_table(key, j);
    if (rack && !(std::isfinite(j.radius) && j.radius != 0))
      error(key, fmt::format("its pinion has the radius {}", j.radius),
            "give the distance of its centre from the pitch line, negative to the right of its direction");
    if ((gear || rack) && !(j.pressure_angle >= 0 && j.pressure_angle < 1.5))
      error(key, fmt::format("a pressure angle of {} rad is none of teeth", j.pressure_angle),
            "write 20 deg, as most gears have, or 0 for the tangential force alone");
    if (j.type == JointType::screw)
      error(key, "a screw of a model is a prismatic joint with its thread", "set its type to prismatic");
    if (j.type == JointType::geneva)
      error(key, "a Geneva drive of a model is a gear with its slots", "set its type to gear");
    if (j.screw) screw(key, *j.screw);
    if (j.slot) slot(key, j);
    if (gear && j.geneva && !(j.geneva->slots.count >= 3 && j.geneva->slots.count <= 1000))
      error(key, fmt::format("its wheel has {} slots", j.geneva->slots.count), "give 3 or more, 4 as usual");
    if (gear && !(j.efficiency > 0 && j.efficiency <= 1))
      error(key, fmt::format("an efficiency of {}", j.efficiency),
            "it is more than 0, up to 1 without losses");
    if (!gear && j.efficiency != 1) error(key, "only a gear has an efficiency", "leave it out");
    if (gear && j.curve) ratio_curve(key, *j.curve);
    if (gear && j.ratio == 0)
      error(key, "its ratio is 0", "a gear at rest is a `fixed` joint to its carrier");
  }
  void screw(const std::string& key, const Screw& s) {
    if (!(s.lead > 0 && std::isfinite(s.lead)))
      error(key, fmt::format("the lead of its screw is {}", s.lead), "give the displacement for a turn");
    if (!(s.friction >= 0 && s.pitch_diameter >= 0 && s.spindle_inertia >= 0 && s.flank_angle >= 0 &&
          s.flank_angle < pi && std::isfinite(s.friction + s.pitch_diameter + s.spindle_inertia)))
      error(key, "friction, diameter, flank angle and inertia of its screw must be finite and not negative",
            {});
    else if (s.friction > 0 && s.pitch_diameter == 0)
      error(key, "its screw has friction but no pitch diameter: its torque would be that of none",
            "give the pitch diameter of the thread");
  }
  void ratio_curve(const std::string& key, const RatioCurve& curve) {
    const std::size_t n = curve.first.size();
    if (n < 3 || curve.second.size() != n)
      return error(key, fmt::format("its ratio curve has {} and {} angles", n, curve.second.size()),
                   "give at least three, and as many of both");
    for (std::size_t i = 0; i < n; ++i)
      if (!std::isfinite(curve.first[i] + curve.second[i]))
        return error(key, "its ratio curve holds numbers that are not finite", {});
    const double sense = curve.second.back() - curve.second.front();
    for (std::size_t i = 0; i + 1 < n; ++i)
      if (!(curve.first[i] < curve.first[i + 1] && sense * (curve.second[i + 1] - curve.second[i]) > 0))
        return error(key, fmt::format("its ratio curve turns back behind row {}", i + 1),
                     "the first angles rise, the second ones all rise or all fall");
    if (curve.first.back() - curve.first.front() > full_turn * (1 + 1e-9))
      error(key, "its ratio curve is longer than a turn of the first wheel", "give one turn, or a sector");
  }
  void belt(const Belt& b) {
    const std::string key = "belt." + b.name;
    if (b.wheels.size() < 2)
      error(key, fmt::format("belt '{}' has {} wheels", b.name, b.wheels.size()), "it runs over two or more");
    for (const BeltWheel& wheel : b.wheels) {
      if (!has(wheel.centre)) error(key, "refers to a body or point that does not exist", {});
      if (!(wheel.radius >= 0 && std::isfinite(wheel.radius)) || std::abs(wheel.side) != 1)
        error(key, "the radii of its wheels must be finite and not negative", {});
    }
    const auto point = [](const BeltWheel& wheel) { return wheel.radius == 0; };
    if (b.closed && std::any_of(b.wheels.begin(), b.wheels.end(), point))
      error(key, fmt::format("closed belt '{}' has a wheel of radius 0", b.name),
            "give every wheel its radius, or write closed = false for a rope");
    if (b.carrier >= 0 && !has_body(b.carrier))
      error(key, "refers to a body or point that does not exist", {});
    if (b.tension && !(*b.tension >= 0 && std::isfinite(*b.tension)))
      error(key, "its tension must be finite and not negative", {});
  }
  bool has_joint(int joint) const { return joint >= 0 && joint < static_cast<int>(l_.joints.size()); }
  void conjugate(const std::string& key, const LinkageCam& c) {
    if (c.face != FollowerFace::roller)
      error(key, fmt::format("a {} follower has no conjugate cam", name_of(c.face)), "take rollers");
    if (!has(c.second_contact) || c.second_contact.body != c.contact.body)
      error(key, fmt::format("the rollers of cam '{}' are not on one body", c.name),
            "name two points of the follower as contact and second_contact");
    else if (c.second_contact.point == c.contact.point)
      error(key, fmt::format("both rollers of cam '{}' lie at one point", c.name),
            "give the second roller a place of its own, across the centre of the cam from the first");
    if (!(c.second_roller_radius > 0 && std::isfinite(c.second_roller_radius)))
      error(key, fmt::format("the second roller of cam '{}' has no radius", c.name),
            "give second_roller_radius_mm");
  }
  void cam(const LinkageCam& c) {
    const std::string key = "cam." + c.name;
    if (!has_joint(c.turns) || !has_joint(c.moves) || !has(c.contact))
      return error(key, "refers to a joint or point that does not exist", {});
    const LinkageJoint &turns = l_.joints[static_cast<std::size_t>(c.turns)],
                       &moves = l_.joints[static_cast<std::size_t>(c.moves)];
    if (turns.type != JointType::revolute)
      error(key, fmt::format("joint '{}', on which the cam turns, is not a pin", turns.name),
            "name the pin of the cam");
    if (moves.type != JointType::revolute && moves.type != JointType::prismatic)
      error(key, fmt::format("joint '{}', which the cam moves, is neither a pin nor a slide", moves.name),
            "name the pin or the slide of the follower");
    if (c.turns == c.moves)
      error(key, fmt::format("joint '{}' would move itself", turns.name),
            "`turns` is the pin of the cam, `moves` the joint of its follower");
    if (c.face == FollowerFace::roller && !(c.roller_radius > 0 && std::isfinite(c.roller_radius)))
      error(key, fmt::format("the roller of cam '{}' has no radius", c.name),
            "give it, or write follower = \"knife\" for an edge");
    if (c.form == CamForm::groove && c.face != FollowerFace::roller)
      error(key, fmt::format("a {} follower does not run in a groove", name_of(c.face)), "take a roller");
    if (c.form == CamForm::conjugate) conjugate(key, c);
    if (c.base_radius && !(*c.base_radius > 0 && std::isfinite(*c.base_radius)))
      error(key, fmt::format("the base circle has the radius {}", *c.base_radius), "give a positive radius");
    if (!std::isfinite(c.phase + c.face_direction)) error(key, "its angles are not finite", {});
    const bool rotary = moves.type == JointType::revolute;
    for (const ProgrammeFinding& f : findings(c.programme)) {
      if (f.severity != ProgrammeSeverity::error) continue;
      const FindingWords words = words_for(f, rotary);
      error(key, words.message, words.hint);
    }
  }
  void drives() {
    std::set<int> seen;
    for (int d : l_.driven) {
      if (d < 0 || d >= static_cast<int>(l_.joints.size())) {
        error("drive", fmt::format("joint number {} does not exist", d), {});
        continue;
      }
      const LinkageJoint& j = l_.joints[static_cast<std::size_t>(d)];
      if (!seen.insert(d).second)
        error("drive", fmt::format("joint '{}' has two drives", j.name), "one [[drive]] a joint is enough");
      if (j.type != JointType::revolute && j.type != JointType::prismatic)
        error("drive",
              fmt::format("joint '{}' is of type {}: only revolute and prismatic joints take a drive", j.name,
                          words_[static_cast<std::size_t>(j.type)]),
              {});
    }
  }
  void friction_table(const std::string& key, const LinkageJoint& j) {
    const std::vector<double>&v = j.friction_speeds, &mu = j.friction_values;
    if (v.size() < 2 || v.size() != mu.size())
      return error(
          key, fmt::format("its table of friction has {} speeds and {} coefficients", v.size(), mu.size()),
          "give at least two, and as many of both");
    if (v.front() != 0 || std::adjacent_find(v.begin(), v.end(), std::greater_equal<>()) != v.end())
      error(key, "the speeds of its table of friction do not rise from 0 on", "sort them, and begin with 0");
    if (std::any_of(mu.begin(), mu.end(), [](double m) { return !(m >= 0 && std::isfinite(m)); }) ||
        !std::isfinite(v.back()))
      error(key, "its table of friction holds numbers that are negative or not finite", {});
    if (j.friction > 0 || j.friction_speed > 0)
      error(key, "it has a table and a curve of friction", "leave one out");
    if (j.friction_static > 0 && j.friction_static < mu.front())
      error(key,
            fmt::format("its friction at rest, {}, is below the first of its table, {}", j.friction_static,
                        mu.front()),
            "friction_static is the larger of the two");
  }
  void factor(const std::string& key, const LoadFactor& f) {
    if (f.against == LoadArgument::constant) return;
    if (f.argument.size() < 2 || f.argument.size() != f.factor.size())
      error(key, fmt::format("its table has {} arguments and {} factors", f.argument.size(), f.factor.size()),
            "give at least two, and as many of both");
    else if (std::adjacent_find(f.argument.begin(), f.argument.end(), std::greater_equal<>()) !=
             f.argument.end())
      error(key, "the arguments of its table do not rise", "sort them, each once");
    if (f.period && !(*f.period == 0 || (std::isfinite(*f.period) && !f.argument.empty() &&
                                         *f.period >= (1 - 1e-9) * (f.argument.back() - f.argument.front()))))
      error(key, fmt::format("its period {} is shorter than its table", *f.period),
            "give the change of the argument after which the table repeats, or 0 for never");
    for (std::size_t i = 0; i < std::min(f.argument.size(), f.factor.size()); ++i)
      if (!std::isfinite(f.argument[i] + f.factor[i])) {
        error(key, "its table holds numbers that are not finite", {});
        break;
      }
  }
  void loads() {
    for (const LinearSpring& s : l_.springs) {
      const std::string key = "spring." + s.name;
      if (!has(s.first) || !has(s.second))
        error(key, "refers to a body or point that does not exist", {});
      else if (s.first.body == s.second.body)
        error(key, fmt::format("both ends are on body '{}'", name(s.first.body)), "it would do nothing");
      if (!(s.stiffness >= 0 && s.damping >= 0 && s.free_length >= 0 &&
            std::isfinite(s.stiffness + s.damping + s.free_length)))
        error(key, "stiffness, damping and free length must be finite and not negative", {});
    }
    for (const TorsionSpring& s : l_.torsion_springs) {
      const std::string key = "torsion_spring." + s.name;
      if (!has_body(s.first) || !has_body(s.second))
        error(key, "refers to a body that does not exist", {});
      else if (s.first == s.second)
        error(key, fmt::format("both ends are on body '{}'", name(s.first)), "it would do nothing");
      if (!(s.stiffness >= 0 && s.damping >= 0 && std::isfinite(s.stiffness + s.damping + s.free_angle)))
        error(key, "stiffness and damping must be finite and not negative, the free angle finite", {});
    }
    for (const PointForce& f : l_.forces) {
      if (!has(f.point)) error("force." + f.name, "refers to a body or point that does not exist", {});
      if (!finite(f.force)) error("force." + f.name, "is not finite", {});
      if (f.factor.against == LoadArgument::speed)
        error("force." + f.name, "a force turns nothing: its table cannot go by speed", "give a torque");
      if (f.factor.against == LoadArgument::length)
        error("force." + f.name, "a force on one point has no length: its table cannot go by it",
              "give a strut, between two points");
      factor("force." + f.name, f.factor);
    }
    for (const BodyTorque& t : l_.torques) {
      const std::string key = "torque." + t.name;
      if (!has_body(t.body) || !has_body(t.from))
        error(key, "refers to a body that does not exist", {});
      else if (t.body == t.from)
        error(key, fmt::format("body '{}' exerts it on itself", name(t.body)), {});
      if (!std::isfinite(t.torque)) error(key, "is not finite", {});
      if (t.factor.against == LoadArgument::x || t.factor.against == LoadArgument::y)
        error(key, "a torque has no point: its table cannot go by x or y", "use input or time");
      if (t.factor.against == LoadArgument::length)
        error(key, "a torque has no length: its table cannot go by it", "use input or time");
      factor(key, t.factor);
    }
    for (const Strut& s : l_.struts) strut(s);
    stops();
  }
  void slot(const std::string& key, const LinkageJoint& j) {
    const CurvedSlot& s = *j.slot;
    if (j.type != JointType::pin_in_slot)
      error(key, "has the curve of a slot, and is not a pin in a slot", {});
    if (has_friction(j) || j.friction_static > 0)
      error(key, "friction in a curved slot is not computed", "leave its friction out");
    if (s.radius > 0) {
      if (!(std::isfinite(s.radius + s.from + s.to) && finite(s.centre)) || s.from == s.to ||
          std::abs(s.to - s.from) > full_turn * (1 + 1e-12))
        error(key, "the arc of its slot has no length, or is longer than a turn",
              "give two directions that differ by at most 360 deg");
      return;
    }
    const std::size_t n = s.points.size();
    if (n < 3)
      return error(key, fmt::format("the curve of its slot has {} points", n), "give at least 3, or an arc");
    const std::size_t corners = s.closed ? n : n - 2;
    for (std::size_t i = 0; i < n; ++i) {
      const bool last = i + 1 == n;
      if (!finite(s.points[i]) || ((!last || s.closed) && s.points[i] == s.points[(i + 1) % n]))
        return error(key,
                     fmt::format("point {} of its slot is not finite, or is the same as the next one", i + 1),
                     "leave it out");
    }
    constexpr double sharpest = 75 * pi / 180;
    for (std::size_t c = 0; c < corners; ++c) {
      const std::complex<double> a = s.points[c], b = s.points[(c + 1) % n], d = s.points[(c + 2) % n];
      const double turn = std::abs(std::arg((d - b) / (b - a)));
      if (turn > sharpest)
        return error(key,
                     fmt::format("its slot turns by {:.3g} deg at point {}: a corner", turn * 180 / pi,
                                 (c + 1) % n + 1),
                     "give more points where it turns, so that a smooth curve follows them");
    }
  }
  void stops() {
    for (std::size_t k = 0; k < l_.stops.size(); ++k) {
      const JointStop& s = l_.stops[k];
      if (s.joint < 0 || s.joint >= static_cast<int>(l_.joints.size())) {
        error("stop", "refers to a joint that does not exist", {});
        continue;
      }
      const LinkageJoint& j = l_.joints[static_cast<std::size_t>(s.joint)];
      const std::string key = "joint." + j.name;
      if (j.slot) error(key, "a curved slot has no stops but its ends", "shorten its curve");
      if (j.type != JointType::revolute && j.type != JointType::prismatic && j.type != JointType::pin_in_slot)
        error(key, fmt::format("it is a {} joint and has a stop", name_of(j.type)),
              "pins, slides and slots have stops");
      if (!(std::abs(s.side) == 1 && s.restitution >= 0 && s.restitution <= 1 && s.damping >= 0 &&
            s.arm >= 0 && std::isfinite(s.limit + s.damping + s.arm)) ||
          (s.stiffness && !(*s.stiffness > 0 && std::isfinite(*s.stiffness))))
        error(key, "the numbers of its stop are out of range",
              "restitution is 0 to 1, the stiffness positive, the others finite and not negative");
      for (std::size_t i = 0; i < k; ++i) {
        const JointStop& other = l_.stops[i];
        if (other.joint != s.joint) continue;
        if (other.side == s.side)
          error(key, fmt::format("it has two {} stops", s.side > 0 ? "lower" : "upper"), "leave one");
        else if (!((s.limit - other.limit) * s.side < 0))
          error(key, "its lower stop is not below its upper one", "exchange at_least and at_most");
      }
    }
  }
  void strut(const Strut& s) {
    const std::string key = "strut." + s.name;
    if (!has(s.first) || !has(s.second))
      error(key, "refers to a body or point that does not exist", {});
    else if (s.first.body == s.second.body)
      error(key, fmt::format("both ends are on body '{}'", name(s.first.body)), "it would do nothing");
    if (!std::isfinite(s.force)) error(key, "is not finite", {});
    if (s.factor.against == LoadArgument::x || s.factor.against == LoadArgument::y)
      error(key, "a strut has two points: its table cannot go by x or y", "use length, speed, input or time");
    factor(key, s.factor);
    if (s.factor.against == LoadArgument::length && s.factor.period.value_or(0) != 0)
      error(key, "its table goes by length, which does not repeat", "leave the period out");
    if (s.gas) {
      const GasSpring& g = *s.gas;
      if (!(g.extended_force > 0 && g.stroke > 0 && g.progression >= 1 &&
            std::isfinite(g.extended_force + g.extended_length + g.progression)))
        error(key, "force, stroke and progression of its gas spring must be finite, positive and 1 at least",
              {});
      else if (!(g.stroke < g.extended_length))
        error(key,
              fmt::format("its stroke of {:.6g} mm is as long as its extended length of {:.6g} mm",
                          g.stroke * 1e3, g.extended_length * 1e3),
              "the extended length is measured from eye to eye");
    }
    if (s.cylinder) {
      const Cylinder& c = *s.cylinder;
      if (!(c.bore > 0 && c.rod >= 0 && std::isfinite(c.bore + c.pressure + c.back_pressure)))
        error(key, "diameters and pressures of its cylinder must be finite, and the bore positive", {});
      else if (!(c.rod < c.bore))
        error(key,
              fmt::format("its rod of {:.6g} mm does not fit into its bore of {:.6g} mm", c.rod * 1e3,
                          c.bore * 1e3),
              "the rod is thinner than the bore");
    }
  }
  // Two pins of a body in one place make a link without length, unless other joints of the body lie apart.
  void zero_lengths() {
    const double small = 1e-9 * size_of(l_);
    for (int b = 1; b < static_cast<int>(l_.bodies.size()); ++b) {
      std::vector<std::pair<std::complex<double>, const LinkageJoint*>> pins;
      bool other = false, all_driven = true,
           clutch = false;  // shafts on one axis, with a clutch between them
      for (const LinkageJoint& j : l_.joints)
        for (const BodyPoint& end : {j.first, j.second})
          if (end.body == b) {
            if (j.type == JointType::revolute)
              pins.emplace_back(at(end), &j);
            else
              other = true;
            all_driven = all_driven && std::find(l_.driven.begin(), l_.driven.end(),
                                                 static_cast<int>(&j - l_.joints.data())) != l_.driven.end();
            clutch = clutch || j.friction_effort > 0;
          }
      if (other || (all_driven && clutch) || pins.size() < 2) continue;
      if (std::all_of(pins.begin(), pins.end(),
                      [&](const auto& p) { return std::abs(p.first - pins[0].first) <= small; }))
        error("body." + name(b),
              fmt::format("has no length: its joints {} and {} lie in one point", pins[0].second->name,
                          pins[1].second->name),
              "move one of the points, or leave the body out");
    }
  }
  std::complex<double> at(const BodyPoint& p) const { return place_of(l_, p); }
  const std::string& name(int body) const { return l_.bodies[static_cast<std::size_t>(body)].name; }

  static constexpr std::array<std::string_view, 8> words_{"revolute", "prismatic", "pin_in_slot", "fixed",
                                                          "gear",     "rack",      "screw",       "geneva"};
  const Linkage& l_;
  Diagnostics found_;
};

template <class Items>
int index_of(const Items& items, std::string_view name) {
  for (std::size_t i = 0; i < items.size(); ++i)
    if (items[i].name == name) return static_cast<int>(i);
  return -1;
}

}  // namespace

int body_index(const Linkage& linkage, std::string_view name) { return index_of(linkage.bodies, name); }
int point_index(const LinkageBody& body, std::string_view name) { return index_of(body.points, name); }
int joint_index(const Linkage& linkage, std::string_view name) { return index_of(linkage.joints, name); }

double size_of(const Linkage& linkage) {
  std::vector<std::vector<std::complex<double>>> used(linkage.bodies.size());
  for (const LinkageJoint& j : linkage.joints) {
    if (j.type == JointType::gear) continue;
    for (const BodyPoint& end : {j.first, j.second})
      used[static_cast<std::size_t>(end.body)].push_back(place_of(linkage, end));
  }
  for (const LinkageCam& c : linkage.cams)
    used[static_cast<std::size_t>(c.contact.body)].push_back(place_of(linkage, c.contact));
  double size = 0;
  for (const LinkageCam& c : linkage.cams) size = std::max(size, c.base_radius.value_or(0) + c.roller());
  for (const auto& points : used)
    for (std::size_t i = 0; i < points.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) size = std::max(size, std::abs(points[i] - points[k]));
  return size > 0 ? size : 1;
}

std::complex<double> place_of(const Linkage& linkage, const BodyPoint& point) {
  return linkage.bodies[static_cast<std::size_t>(point.body)]
      .points[static_cast<std::size_t>(point.point)]
      .at;
}

std::string first_rolling_pair(const Linkage& linkage) {
  for (const LinkageJoint& j : linkage.joints) {
    if (j.type == JointType::rack) return fmt::format("rack '{}'", j.name);
    if (j.type == JointType::gear && j.curve) return fmt::format("gear '{}' with a ratio curve", j.name);
    if (j.slot) return fmt::format("curved slot '{}'", j.name);
    if (j.type == JointType::gear && j.geneva) return fmt::format("Geneva drive '{}'", j.name);
  }
  if (!linkage.cams.empty()) return fmt::format("cam '{}'", linkage.cams[0].name);
  return linkage.belts.empty() ? std::string() : fmt::format("belt '{}'", linkage.belts[0].name);
}

std::string stop_name(const Linkage& linkage, std::size_t stop) {
  const JointStop& s = linkage.stops[stop];
  return linkage.joints[static_cast<std::size_t>(s.joint)].name +
         (s.side > 0 ? " lower stop" : " upper stop");
}

Diagnostics check(const Linkage& linkage) { return Checker(linkage).run(); }

double period_of(const LoadFactor& f, bool turns) {
  if (f.period) return *f.period;
  if (f.against != LoadArgument::input || !turns || f.argument.size() < 2) return 0;
  // Tables are typed with a few digits.
  constexpr double same_turn = 1e-3;
  const double held = f.argument.back() - f.argument.front(),
               whole = full_turn * std::round(held / full_turn);
  return whole > 0 && std::abs(held - whole) <= same_turn * full_turn ? whole : 0;
}

std::vector<std::string> loads_held(const Linkage& l, bool turns, double low, double high) {
  const double rounding = 1e-9 * std::max({1.0, std::abs(low), std::abs(high)});
  std::vector<std::string> out;
  const auto look = [&](const auto& load) {
    const LoadFactor& f = load.factor;
    if (f.against == LoadArgument::input && !f.argument.empty() && period_of(f, turns) == 0 &&
        (low < f.argument.front() - rounding || high > f.argument.back() + rounding))
      out.push_back(load.name);
  };
  std::for_each(l.forces.begin(), l.forces.end(), look);
  std::for_each(l.torques.begin(), l.torques.end(), look);
  std::for_each(l.struts.begin(), l.struts.end(), look);
  return out;
}

}  // namespace linkwright::planar
