// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/mass_balancing.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/balancing/mass_redistribution.h"
#include "linkwright/planar/studies/four_bar_balancing.h"
#include "linkwright/planar/studies/linkage.h"
#include "linkwright/planar/studies/serial_arm.h"

namespace linkwright::planar {
// Numbers of a mass that may be designed.
enum class MassPart { mass, inertia, distance, angle, x, y };

// A mass on a link: its own, or one attached to it. Its place is polar (distance and angle from the link
// line) or given by x and y, in the frame of the link.
struct MassHolder {
  std::size_t link = 0;
  bool attached = false;
  bool polar = true;
  std::string name;
  std::array<double, 6> numbers{};  // by Part, SI
  // The study's design variable for each of the six numbers.
  std::array<std::optional<std::size_t>, 6> designed{};

  std::complex<double> place() const {
    return polar ? std::polar(1.0, numbers[3]) * numbers[2] : std::complex<double>(numbers[4], numbers[5]);
  }
  BaseParameters base() const {
    const std::complex<double> at = place();
    return {numbers[0], numbers[0] * at, numbers[1] + numbers[0] * std::norm(at)};
  }
};

namespace {

// The place of a mass's number: [owner] under "mass" by name, under "body" or "link" by number; own numbers,
// then attached masses by number.
struct Found {
  std::string owner_key;
  std::size_t owner_number = 0;
  std::optional<std::size_t> attached;
  MassPart part = MassPart::mass;
};
std::optional<Found> find_mass(const std::vector<study::DesignedStep>& steps, std::string_view type) {
  if (steps.size() < 4 || steps[0].key != "mechanism") return std::nullopt;
  Found out;
  if (type == "planar.four_bar" || type == "planar.slider_crank") {
    if (steps[1].key != "mass") return std::nullopt;
    out.owner_key = steps[2].key;
  } else {
    if (steps[1].key != (type == "planar.linkage" ? "body" : "link") || !steps[2].element)
      return std::nullopt;
    out.owner_number = *steps[2].element;
  }
  std::size_t at = 3;
  if (steps[at].key == "attached" && steps.size() > at + 2 && steps[at + 1].element) {
    out.attached = steps[at + 1].element;
    at += 2;
  }
  const std::string base = study::base_of(steps[at].key);
  const bool component = steps.size() == at + 2 && steps[at + 1].element.has_value();
  if (base == "mass")
    out.part = MassPart::mass;
  else if (base == "inertia" && !out.attached)
    out.part = MassPart::inertia;
  else if (base == (out.attached ? "distance" : "centre_distance"))
    out.part = MassPart::distance;
  else if (base == (out.attached ? "angle" : "centre_angle"))
    out.part = MassPart::angle;
  else if (base == (out.attached ? "at" : "centre") && component)
    out.part = steps[at + 1].element == std::size_t{0} ? MassPart::x : MassPart::y;
  else
    return std::nullopt;
  return out;
}

}  // namespace

class MassStudy {
 public:
  LinearForces forces;
  std::vector<MassHolder> holders;
  std::vector<study::DesignVariable> numbers;

  std::vector<BaseParameters> bases(std::span<const double> x) const {
    std::vector<BaseParameters> out(forces.links.size());
    for (MassHolder h : holders) {
      for (std::size_t p = 0; p < h.designed.size(); ++p)
        if (h.designed[p]) h.numbers[p] = si(*h.designed[p], x[*h.designed[p]]);
      const BaseParameters own = h.base();
      out[h.link].mass += own.mass;
      out[h.link].moment += own.moment;
      out[h.link].inertia += own.inertia;
    }
    return out;
  }
  double si(std::size_t number, double value) const {
    const study::DesignVariable& n = numbers[number];
    return n.unit.unit ? n.unit.unit->to_si(value) : value;
  }
  double from_si(std::size_t number, double value) const {
    const study::DesignVariable& n = numbers[number];
    return n.unit.unit ? n.unit.unit->from_si(value) : value;
  }
};

namespace {

class Maker {
 public:
  Maker(const BalancingStudy& s, std::string& why) : s_(s), why_(why) {}

  std::shared_ptr<const MassStudy> make() {
    out_->numbers = s_.designed.numbers;
    for (std::size_t j = 0; j < out_->numbers.size(); ++j) {
      const auto found =
          find_mass(study::steps_to(s_.designed.tables, out_->numbers[j].place), s_.mechanism->type);
      if (!found) {
        why_ = fmt::format("'{}' is not a mass", out_->numbers[j].key);
        return nullptr;
      }
      found_.push_back(*found);
    }
    Diagnostics problems;
    study::DocumentReader reader(s_.designed.tables, {}, problems);
    study::ObjectReader root = reader.root();
    bool good = true;
    if (s_.mechanism->type == std::string_view("planar.four_bar"))
      good = four_bar(root);
    else if (s_.mechanism->type == std::string_view("planar.serial_arm"))
      good = arm(read_serial_arm_study(root, {}));
    else
      good = linkage(root);
    out_->forces.closes = closes(s_);
    if (good && out_->forces.status != Status::done) {
      why_ = "the motion has no answer everywhere";
      good = false;
    }
    return good ? out_ : nullptr;
  }

 private:
  MassHolder& add(std::size_t link, std::string name, const LinkMass& m) {
    out_->holders.push_back({.link = link, .name = std::move(name)});
    out_->holders.back().numbers = {m.mass, m.inertia, m.centre_distance, m.centre_angle, 0, 0};
    return out_->holders.back();
  }
  MassHolder& add(std::size_t link, std::string name, const PointMass& m) {
    MassHolder& h = add(link, std::move(name), LinkMass{m.mass, 0, 0, 0});
    h.attached = true;
    h.numbers[2] = m.distance;
    h.numbers[3] = m.angle;
    return h;
  }
  // Finds the numbers of the study that belong to an owner, by name or by number.
  template <class Owns>
  void bind(MassHolder& h, std::optional<std::size_t> attached, Owns&& owns) {
    for (std::size_t j = 0; j < found_.size(); ++j)
      if (owns(found_[j]) && found_[j].attached == attached)
        h.designed[static_cast<std::size_t>(found_[j].part)] = j;
  }

  bool four_bar(study::ObjectReader& root) {
    const auto study = read_linkage_study(root, {}, LinkageType::four_bar, nullptr);
    const auto gravity = study ? weight_along_y(study->linkage) : std::nullopt;
    if (!gravity) {
      why_ = study ? "the weight does not act along -y" : "the mechanism cannot be read";
      return false;
    }
    std::vector<double> angles, speeds, accelerations;
    for (const auto& row : rows_of(*study).inputs) {
      angles.push_back(row[0].value);
      speeds.push_back(row[0].rate);
      accelerations.push_back(row[0].acceleration);
    }
    const FourBarMasses& m = *study->four_bar->masses;
    out_->forces = linear_forces({study->four_bar->linkage, m}, *gravity,
                                 {.value = angles, .rate = speeds, .acceleration = accelerations});
    const std::array<std::pair<const char*, const LinkMass*>, 3> own = {
        {{"crank", &m.crank}, {"coupler", &m.coupler}, {"rocker", &m.rocker}}};
    for (std::size_t k = 0; k < own.size(); ++k)
      bind(add(k, own[k].first, *own[k].second), std::nullopt,
           [&](const Found& f) { return f.owner_key == own[k].first; });
    return true;
  }

  bool arm(const SerialArmStudy& s) {
    SerialArm arm = serial_arm(s.mechanism);
    for (std::size_t k = 0; k < arm.links.size(); ++k) {
      const auto owns = [k](const Found& f) { return f.owner_number == k; };
      const Value& entry = s_.designed.tables.find("mechanism")->find("link")->as_array()[k];
      MassHolder& own = add(k, s.mechanism.links[k].name, arm.links[k].body);
      bind(own, std::nullopt, owns);
      if (own.designed[0] && !has(entry, "inertia")) return uniform(own.name);
      std::vector<PointMass> stay;
      for (std::size_t a = 0; a < arm.links[k].attached.size(); ++a) {
        MassHolder& h =
            add(k, fmt::format("{} mass {}", s.mechanism.links[k].name, a + 1), arm.links[k].attached[a]);
        bind(h, a, owns);
        if (is_open(h)) continue;
        stay.push_back(arm.links[k].attached[a]);
        out_->holders.pop_back();
      }
      arm.links[k].attached = stay;
    }
    out_->forces = linear_forces(arm, arm_motion(s), s.environment.gravity);
    // Torques go by the names of the links.
    for (std::size_t k = 0; k < arm.links.size(); ++k)
      for (LinearComponent& c : out_->forces.components)
        for (const char* key : {"_torque_absolute_N_m", "_torque_joint_N_m"})
          if (c.name == out_->forces.links[k] + key) c.name = s.mechanism.links[k].name + key;
    return true;
  }

  bool linkage(study::ObjectReader& root) {
    const bool slider_crank = s_.mechanism->type == std::string_view("planar.slider_crank");
    const auto study = read_linkage_study(
        root, {}, slider_crank ? LinkageType::slider_crank : LinkageType::linkage, nullptr);
    if (!study) {
      why_ = "the mechanism cannot be read";
      return false;
    }
    for (const LinkageJoint& j : study->linkage.joints)
      if (has_friction(j)) {
        why_ = fmt::format("joint '{}' has friction, which is not linear in the masses", j.name);
        return false;
      }
    for (const LinkageJoint& j : study->linkage.joints)
      if (j.efficiency < 1) {
        why_ = fmt::format("gear '{}' has losses, which are not linear in the masses", j.name);
        return false;
      }
    Linkage l = study->linkage;
    const Value* mass = s_.designed.tables.find("mechanism")->find("mass");
    std::vector<int> bodies;
    for (std::size_t b = 1; b < l.bodies.size(); ++b) {
      LinkageBody& body = l.bodies[b];
      const auto owns = [&](const Found& f) {
        return slider_crank ? f.owner_key == body.name : f.owner_number == b;
      };
      if (std::none_of(found_.begin(), found_.end(), owns)) continue;
      const std::size_t link = bodies.size();
      bodies.push_back(static_cast<int>(b));
      const Value& entry = slider_crank ? *mass->find(body.name)
                                        : s_.designed.tables.find("mechanism")->find("body")->as_array()[b];
      LinkMass own_mass{body.mass->mass, body.mass->inertia, std::abs(body.mass->centre),
                        std::arg(body.mass->centre)};
      MassHolder& own = add(link, body.name, own_mass);
      own.polar = slider_crank;
      own.numbers[4] = body.mass->centre.real();
      own.numbers[5] = body.mass->centre.imag();
      bind(own, std::nullopt, owns);
      if (own.designed[0] && !has(entry, "inertia")) return uniform(body.name);
      for (std::size_t a = 0; a < body.attached.size(); ++a) {
        AttachedMass& m = body.attached[a];
        MassHolder& h = add(link, m.name.empty() ? fmt::format("{} mass {}", body.name, a + 1) : m.name,
                            PointMass{m.mass, std::abs(m.at), std::arg(m.at)});
        h.polar = slider_crank;
        h.numbers[4] = m.at.real();
        h.numbers[5] = m.at.imag();
        bind(h, a, owns);
        if (is_open(h)) {
          m.mass = 0;          // comes as a holder
          if (slider_crank) {  // the file's polar place: its distance may be negative
            const Value& at = entry.find("attached")->as_array()[a];
            h.numbers[2] = number(at, "distance", h.numbers[2]);
            h.numbers[3] = number(at, "angle", 0);
          }
        } else {
          out_->holders.pop_back();
        }
      }
    }
    PlanResult planned = plan_linkage(l);
    for (const LinkageJoint& j : l.joints)
      if (j.type == JointType::rack && j.pressure_angle > 0) {
        why_ =
            fmt::format("rack '{}' has a pressure angle, whose forces are not linear in the masses", j.name);
        return false;
      }
    for (const Group& g : planned.plan.groups)
      for (const PlanGear& gear : g.gears)
        if (gear.mesh && gear.mesh->tangent > 0) {
          why_ = fmt::format("gear '{}' has a pressure angle, whose forces are not linear in the masses",
                             l.joints[static_cast<std::size_t>(gear.joint)].name);
          return false;
        }
    for (const LinkageJoint& j : l.joints)
      if (j.curve && j.pressure_angle > 0) {
        why_ =
            fmt::format("gear '{}' has a pressure angle, whose forces are not linear in the masses", j.name);
        return false;
      }
    const LinkageRows rows = rows_of(*study);
    std::vector<InputMotion> inputs;
    for (const auto& row : rows.inputs) inputs.insert(inputs.end(), row.begin(), row.end());
    out_->forces = linear_forces(l, planned.plan, bodies, inputs, rows.time);
    return true;
  }

  static bool has(const Value& table, std::string_view base) {
    return std::any_of(table.as_object().begin(), table.as_object().end(),
                       [&](const Value::Member& m) { return study::base_of(m.key) == base; });
  }
  static double number(const Value& table, std::string_view base, double otherwise) {
    for (const Value::Member& m : table.as_object()) {
      const auto unit = split_unit(m.key);
      if (unit && unit->base == base && m.value.is_number()) return unit->unit->to_si(m.value.as_number());
    }
    return otherwise;
  }
  static bool is_open(const MassHolder& h) {
    return std::any_of(h.designed.begin(), h.designed.end(), [](const auto& d) { return d.has_value(); });
  }
  bool uniform(const std::string& name) {
    why_ = fmt::format("the inertia of '{}' follows from its mass; give it as a number", name);
    return false;
  }

  const BalancingStudy& s_;
  std::string& why_;
  std::vector<Found> found_;
  std::shared_ptr<MassStudy> out_ = std::make_shared<MassStudy>();
};

// A component, or the magnitude of two.
bool has_quantity(const LinearForces& forces, const std::string& name) {
  const auto component = [&](const std::string& of) {
    return std::any_of(forces.components.begin(), forces.components.end(),
                       [&](const LinearComponent& c) { return c.name == of; });
  };
  return component(name) || (name.ends_with("_N") && component(name.substr(0, name.size() - 2) + "_x_N"));
}

/// Open links and counterweights of a study, or why it is no cone programme.
std::optional<MassBalancing> programme(const MassStudy& s, const BalancingProblem& p, std::string& why) {
  MassBalancing out;
  out.forces = s.forces;
  const auto range = [&](const MassHolder& h, MassPart part) {
    const auto k = static_cast<std::size_t>(part);
    if (!h.designed[k]) return Range{h.numbers[k], h.numbers[k]};
    const study::DesignVariable& n = s.numbers[*h.designed[k]];
    return Range{s.si(*h.designed[k], n.lower), s.si(*h.designed[k], n.upper)};
  };
  const auto whole_turn = [](const Range& r) { return r.upper - r.lower >= 2 * pi * (1 - 1e-9); };
  for (const MassHolder& h : s.holders) {
    if (std::none_of(h.designed.begin(), h.designed.end(), [](const auto& d) { return d.has_value(); })) {
      // A link with counterweights keeps its own mass: as an open link without freedom its base is constant.
      continue;
    }
    if (range(h, MassPart::mass).upper <= 0) {
      why = fmt::format("'{}' has no mass", h.name);
      return std::nullopt;
    }
    const Range angle = h.polar ? range(h, MassPart::angle) : Range{0, 0};
    if (h.polar && !angle.fixed() && !whole_turn(angle)) {
      why = fmt::format("the angle of '{}' is limited; only a fixed one or a full turn is convex", h.name);
      return std::nullopt;
    }
    if (h.attached) {
      Counterweight w{.name = h.name, .link = h.link, .mass = range(h, MassPart::mass)};
      if (h.polar) {
        w.radius = range(h, MassPart::distance);
        if (angle.fixed()) w.angle = angle.lower;
        if (w.radius.upper <= 0 && w.radius.lower < 0) {  // behind the joint
          w.radius = {-w.radius.upper, -w.radius.lower};
          if (w.angle) w.angle = *w.angle + pi;
        }
        if (w.radius.lower < 0) {
          why = fmt::format("the distance of '{}' may be on both sides of the joint", h.name);
          return std::nullopt;
        }
      } else {
        w.rectangle = {range(h, MassPart::x), range(h, MassPart::y)};
      }
      out.counterweights.push_back(std::move(w));
      continue;
    }
    if (!h.polar && (h.designed[4] || h.designed[5])) {
      why = fmt::format("the mass centre of '{}' is free in a rectangle, not in a disc about the joint",
                        h.name);
      return std::nullopt;
    }
    const Range distance =
        h.polar ? range(h, MassPart::distance) : Range{std::abs(h.place()), std::abs(h.place())};
    if (angle.fixed() && distance.upper > 0) {
      why = fmt::format("the mass centre of '{}' lies in one direction; only a full turn is convex", h.name);
      return std::nullopt;
    }
    out.links.push_back({.link = h.link,
                         .mass = range(h, MassPart::mass),
                         .centre_distance = distance,
                         .inertia = range(h, MassPart::inertia)});
  }
  if (!p.task.constraints.empty()) {
    why = "constraints beyond caps on the objectives are not part of the cone programme";
    return std::nullopt;
  }
  for (std::size_t k = 0; k < p.task.objectives.size(); ++k) {
    const BalancingGoal& o = p.task.objectives[k];
    if (!properties(o.measure).norm) {
      why = fmt::format("{} is not convex", name_of(o.measure));
      return std::nullopt;
    }
    if (!has_quantity(s.forces, o.quantity)) {
      why = fmt::format("'{}' is not linear in the masses", o.quantity);
      return std::nullopt;
    }
    out.objectives.push_back(
        {.quantity = o.quantity, .measure = o.measure, .weight = 1, .reference = p.references[k]});
  }
  return out;
}

}  // namespace

std::shared_ptr<const MassStudy> mass_study(const BalancingStudy& study, std::string& why) {
  return Maker(study, why).make();
}

std::function<Table(std::span<const double> x)> mass_table(std::shared_ptr<const MassStudy> masses,
                                                           const std::vector<std::string>& columns) {
  for (const std::string& key : columns)
    if (!has_quantity(masses->forces, key)) return nullptr;
  return [masses, columns](std::span<const double> x) {
    const std::vector<BaseParameters> bases = masses->bases(x);
    Table table{.name = "sweep", .columns{}, .status{}};
    for (const std::string& key : columns)
      if (!table.find(key)) table.add(key, key, values(masses->forces, key, bases));
    return table;
  };
}

ExactBalancing exact_balancing(std::shared_ptr<const MassStudy> masses, const BalancingProblem& problem,
                               std::string& why) {
  const auto made = programme(*masses, problem, why);
  if (!made) return nullptr;
  return [masses, made = *made](const BalancingQuestion& q, RunContext& context) {
    MassBalancing b = made;
    b.cost = q.goal == optimise::SmoothGoal::largest ? ForceCost::largest : ForceCost::sum;
    for (std::size_t k = 0; k < b.objectives.size(); ++k) {
      b.objectives[k].weight = q.weights[k];
      if (std::isfinite(q.caps[k])) b.objectives[k].at_most = q.caps[k] * *b.objectives[k].reference;
    }
    const BalancedMasses answer = balance(b, context);
    BalancedDesign design;
    if (answer.status != Status::done) return design;
    design.x.resize(masses->numbers.size());
    std::size_t weight = 0;  // counterweights come in the order of the holders
    const auto put = [&](const MassHolder& h, MassPart part, double value) {
      const auto& j = h.designed[static_cast<std::size_t>(part)];
      if (!j) return;
      const study::DesignVariable& n = masses->numbers[*j];
      double x = masses->from_si(*j, value);
      if (part == MassPart::angle) {  // into the bounds
        const double turn = masses->from_si(*j, 2 * pi);
        x -= turn * std::floor((x - n.lower) / turn);
      }
      design.x[*j] = std::clamp(x, n.lower, n.upper);
    };
    for (const MassHolder& h : masses->holders) {
      if (std::none_of(h.designed.begin(), h.designed.end(), [](const auto& d) { return d.has_value(); }))
        continue;
      if (h.attached) {
        const PointMass& m = answer.counterweights[weight++].mass;
        put(h, MassPart::mass, m.mass);
        const auto& d = h.designed[static_cast<std::size_t>(MassPart::distance)];
        const bool behind = d && masses->numbers[*d].upper <= 0 && masses->numbers[*d].lower < 0;
        put(h, MassPart::distance, behind ? -m.distance : m.distance);
        put(h, MassPart::angle, m.angle);
        put(h, MassPart::x, m.distance * std::cos(m.angle));
        put(h, MassPart::y, m.distance * std::sin(m.angle));
      } else {
        const LinkMass& m = answer.links[h.link];
        put(h, MassPart::mass, m.mass);
        put(h, MassPart::inertia, m.inertia);
        put(h, MassPart::distance, m.centre_distance);
        put(h, MassPart::angle, m.centre_angle);
      }
    }
    for (const ActiveBound& a : answer.active)
      design.active.push_back(fmt::format("{} at {:.6g} ({:+.3g} for 1 % more)", a.name, a.limit,
                                          a.price * std::abs(a.limit) / 100));
    if (answer.global()) design.proof = fmt::format("global optimum, duality gap {:.1g}", answer.gap);
    return design;
  };
}

}  // namespace linkwright::planar
