// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/core/tolerance.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/linkage/detail/plan_draft.h"

// Drives of pins, slides and gears are linear in the angles of the parts. All of them make one system, which
// is reduced with exact fractions, so that an angle is known as soon as it is determined, whatever the order.
namespace linkwright::planar {
namespace {

using Fraction = boost::multiprecision::cpp_rational;
using Whole = boost::multiprecision::cpp_int;

// The simplest fraction that is rounded to a number: the first convergent of its continued fraction that is.
Fraction fraction_of(double number) {
  Fraction rest(std::abs(number));
  Whole p0 = 0, p = 1, q0 = 1, q = 0;
  while (true) {
    const Whole whole = numerator(rest) / denominator(rest);
    p0 = std::exchange(p, whole * p + p0);
    q0 = std::exchange(q, whole * q + q0);
    if (rest == whole || p.convert_to<double>() / q.convert_to<double>() == std::abs(number))
      return number < 0 ? -Fraction(p, q) : Fraction(p, q);
    rest = 1 / (rest - whole);
  }
}

// The sum of `parts` times the angles of the parts is the sum of `gains` times the inputs + `angle`.
struct AngleRelation {
  std::vector<Fraction> parts, gains;
  double angle = 0;

  void subtract(const AngleRelation& other, const Fraction& times) {
    for (std::size_t p = 0; p < parts.size(); ++p) parts[p] -= times * other.parts[p];
    for (std::size_t i = 0; i < gains.size(); ++i) gains[i] -= times * other.gains[i];
    angle -= times.convert_to<double>() * other.angle;
  }
  bool turns_nothing() const {
    return std::all_of(gains.begin(), gains.end(), [](const Fraction& gain) { return gain == 0; });
  }
};

AngleRelation empty_relation(const PlanDraft& d) {
  return {std::vector<Fraction>(d.parts()), std::vector<Fraction>(d.linkage.driven.size())};
}
AngleRelation relation_of(const PlanDraft& d, const PartGear& gear) {
  const Fraction ratio = fraction_of(gear.ratio);
  AngleRelation out = empty_relation(d);
  out.parts[at(gear.second)] += 1;
  out.parts[at(gear.first)] -= ratio;
  out.parts[at(gear.carrier)] -= 1 - ratio;
  out.parts[0] = 0;
  out.angle = gear.phase;
  return out;
}
// A slide, or a driven pin.
AngleRelation relation_of(const PlanDraft& d, const PartJoint& joint) {
  AngleRelation out = empty_relation(d);
  out.parts[at(joint.second.part)] += 1;
  out.parts[at(joint.first.part)] -= 1;
  out.parts[0] = 0;
  if (!joint.slide) out.gains[at(joint.input)] = 1;
  out.angle = angle_of(joint.first.direction) - angle_of(joint.second.direction);
  return out;
}

// Relations, reduced so that each has a part of its own, which no other has.
class AngleSystem {
 public:
  // Parts of `later` are those of relations without any other part.
  explicit AngleSystem(const std::vector<bool>& later) : later_(later) {}

  // Adds a relation and returns true. Returns false if the parts of the others leave none of it; `relation`
  // is then what remains.
  bool add(AngleRelation& relation) {
    for (const auto& [part, row] : rows_) relation.subtract(row, Fraction(relation.parts[at(part)]));
    int own = -1;
    for (int p = static_cast<int>(later_.size()); p-- > 0;)
      if (relation.parts[at(p)] != 0 && (own < 0 || later_[at(own)] || !later_[at(p)])) own = p;
    if (own < 0) return false;
    const Fraction unit = relation.parts[at(own)];
    AngleRelation row = relation;
    row.subtract(relation, 1 - 1 / unit);
    for (auto& [part, other] : rows_) other.subtract(row, Fraction(other.parts[at(own)]));
    rows_.emplace_back(own, std::move(row));
    return true;
  }
  // The angle of a part by the inputs and the angles of the later ones; null if it is not determined.
  const AngleRelation* of(int part) const {
    for (const auto& [own, row] : rows_) {
      if (own != part) continue;
      for (std::size_t p = 0; p < later_.size(); ++p)
        if (p != at(part) && !later_[p] && row.parts[p] != 0) return nullptr;
      return &row;
    }
    return nullptr;
  }

 private:
  const std::vector<bool>& later_;
  std::vector<std::pair<int, AngleRelation>> rows_;
};

// The relations of known angles, slides, drives, and of the gears that `takes` says.
template <class Takes>
AngleSystem system_of(const PlanDraft& d, const Takes& takes) {
  AngleSystem out(d.known);
  const auto add = [&](AngleRelation relation) { out.add(relation); };
  for (std::size_t p = 1; p < d.parts(); ++p) {
    if (!d.angles[p]) continue;
    AngleRelation known = empty_relation(d);
    known.parts[p] = 1;
    known.angle = d.angles[p]->angle;
    for (std::size_t i = 0; i < known.gains.size(); ++i) known.gains[i] = fraction_of(d.angles[p]->gains[i]);
    add(std::move(known));
  }
  for (const PartJoint& joint : d.joints)
    if (joint.slide || joint.input >= 0) add(relation_of(d, joint));
  for (const PartGear& gear : d.gears)
    if (takes(gear)) add(relation_of(d, gear));
  return out;
}

constexpr int most_teeth = 4000;

int turns_of(const std::vector<AngleShare>& shares) {
  constexpr double whole = 1e-9;
  for (int turns = 1; turns <= most_teeth; ++turns)
    if (std::all_of(shares.begin(), shares.end(), [&](const AngleShare& s) {
          return std::abs(turns * s.share - std::round(turns * s.share)) <= whole;
        }))
      return turns;
  return 0;
}

DrivenAngle angle_of_part(int part, const AngleRelation& relation) {
  DrivenAngle out{.angle = relation.angle};
  for (const Fraction& gain : relation.gains) out.gains.push_back(gain.convert_to<double>());
  for (int p = 1; p < static_cast<int>(relation.parts.size()); ++p)
    if (p != part && relation.parts[at(p)] != 0)
      out.shares.push_back({p, -relation.parts[at(p)].convert_to<double>()});
  out.turns = turns_of(out.shares);
  return out;
}

void name_ratio(PlanDraft& d, const PartGear& gear) {
  d.error(gear.key,
          fmt::format("the ratio {} is none of wheels with up to {} teeth, which a gear in a loop needs",
                      gear.ratio, most_teeth),
          "write the ratio with all its digits, or teeth");
}

// Parts whose angles gears and driven pins between them and known parts determine, grown from one gear.
class TrainSearch {
 public:
  TrainSearch(PlanDraft& d, const AngleSystem& system) : d_(d), system_(system) {}

  // Looks for the train around a gear: its own wheel alone, or with all other parts that are needed.
  bool find(const PartGear& gear, bool grows) {
    parts_.clear();
    if (!take({gear.first, gear.second, gear.carrier}) || parts_.empty()) return false;
    if (!grows) return parts_.size() == 1 && complete();
    while (!complete())
      if (!grow()) return false;
    return true;
  }
  // Places what has been found.
  void place() {
    Group g{.parts = parts_};
    GearTrain train;
    const AngleSystem own = system_of(d_, [&](const PartGear& gear) {
      return gear.used || std::find(gears_.begin(), gears_.end(), &gear) != gears_.end();
    });
    for (const int p : parts_) train.angles.push_back(angle_of_part(p, *own.of(p)));
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      PartJoint& pin = *pins_[i];
      g.joints.push_back(chained(pin, pin.first.part == parts_[i] ? pin.second.part : pin.first.part));
      pin.used = true;
      if (train.angles[i].shares.empty()) d_.angles[at(parts_[i])] = train.angles[i];
    }
    for (PartGear* gear : gears_) {
      for (const DrivenAngle& angle : train.angles)
        if (angle.turns == 0) name_ratio(d_, *gear);
      g.gears.push_back(gear_of_group(d_, *gear, false));
      gear->used = true;
    }
    g.kind = std::move(train);
    place_group(d_, std::move(g));
  }

 private:
  bool has(int part) const { return std::find(parts_.begin(), parts_.end(), part) != parts_.end(); }
  // Takes parts that have no place yet; false if an angle of theirs is not determined.
  bool take(std::initializer_list<int> parts) {
    std::vector<int> taken;
    for (const int p : parts) {
      if (d_.known[at(p)] || has(p)) continue;
      if (!system_.of(p)) return false;
      if (std::find(taken.begin(), taken.end(), p) == taken.end()) taken.push_back(p);
    }
    parts_.insert(parts_.end(), taken.begin(), taken.end());
    return true;
  }
  // Adds the parts of a gear or of a pin beside those that are there.
  bool grow() {
    const std::size_t before = parts_.size();
    for (const PartGear& gear : d_.gears) {
      if (gear.used || !(has(gear.first) || has(gear.second) || has(gear.carrier))) continue;
      if (take({gear.first, gear.second, gear.carrier}) && parts_.size() > before) return true;
    }
    for (const PartJoint& joint : d_.joints) {
      if (joint.used || joint.slide || !(has(joint.first.part) || has(joint.second.part))) continue;
      if (take({joint.first.part, joint.second.part}) && parts_.size() > before) return true;
    }
    return false;
  }
  // One pin for each part, in an order in which the other side is known; a driven one where there is a
  // choice.
  bool find_pins() {
    pins_.clear();
    std::vector<bool> placed = d_.known;
    const auto pin_to_placed = [&](int part) -> PartJoint* {
      PartJoint* found = nullptr;
      for (PartJoint& joint : d_.joints) {
        const bool joins = (joint.first.part == part && placed[at(joint.second.part)]) ||
                           (joint.second.part == part && placed[at(joint.first.part)]);
        if (!joint.used && !joint.slide && joins && (!found || (found->input < 0 && joint.input >= 0)))
          found = &joint;
      }
      return found;
    };
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      std::size_t next = i;
      PartJoint* pin = nullptr;
      while (next < parts_.size() && !(pin = pin_to_placed(parts_[next]))) ++next;
      if (!pin) return false;
      std::rotate(parts_.begin() + static_cast<std::ptrdiff_t>(i),
                  parts_.begin() + static_cast<std::ptrdiff_t>(next),
                  parts_.begin() + static_cast<std::ptrdiff_t>(next) + 1);
      pins_.push_back(pin);
      placed[at(parts_[i])] = true;
    }
    return true;
  }
  // True if the gears and driven pins of the parts determine all of their angles.
  bool complete() {
    gears_.clear();
    if (!find_pins()) return false;
    AngleSystem own(d_.known);
    std::size_t count = 0;
    const auto counts = [&](AngleRelation relation) {
      for (std::size_t p = 0; p < d_.parts(); ++p)
        if (d_.known[p]) relation.parts[p] = 0;
      return own.add(relation);
    };
    for (const PartJoint* pin : pins_)
      if (pin->input >= 0 && counts(relation_of(d_, *pin))) ++count;
    std::vector<bool> chosen(d_.parts(), false);
    for (const int p : parts_) chosen[at(p)] = true;
    for (PartGear& gear : d_.gears)
      if (holds_chosen(d_, gear, chosen) && counts(relation_of(d_, gear))) gears_.push_back(&gear), ++count;
    return count == parts_.size();
  }

  PlanDraft& d_;
  const AngleSystem& system_;
  std::vector<int> parts_;
  std::vector<PartJoint*> pins_;  // one a part
  std::vector<PartGear*> gears_;
};

}  // namespace

bool find_train(PlanDraft& d) {
  if (std::all_of(d.gears.begin(), d.gears.end(), [](const PartGear& gear) { return gear.used; }))
    return false;
  const AngleSystem system = system_of(d, [](const PartGear&) { return true; });
  TrainSearch search(d, system);
  for (const bool grows : {false, true})
    for (const PartGear& gear : d.gears)
      if (!gear.used && search.find(gear, grows)) {
        search.place();
        return true;
      }
  return false;
}

PlanGear gear_of_group(PlanDraft& d, const PartGear& gear, bool in_loop) {
  PlanGear out{.joint = gear.joint, .part = gear.second, .angle = {.angle = gear.phase}};
  out.strand = gear.strand;
  out.angle.shares = {{gear.first, gear.ratio}, {gear.carrier, 1 - gear.ratio}};
  out.angle.turns = turns_of(out.angle.shares);
  if (in_loop && out.angle.turns == 0) name_ratio(d, gear);
  return out;
}

void check_left_gears(PlanDraft& d) {
  AngleSystem system = system_of(d, [](const PartGear& gear) { return gear.used; });
  for (const PartGear& gear : d.gears) {
    const auto body = [&](int which) { return d.body_name(gear.bodies[at(which)]); };
    // A gear between parts without a place is not to blame: these parts are named.
    if (gear.used || !d.known[at(gear.first)] || !d.known[at(gear.second)] || !d.known[at(gear.carrier)])
      continue;
    AngleRelation rest = relation_of(d, gear);
    const std::string& key = gear.key;
    if (!system.add(rest) && rest.turns_nothing()) {
      const double apart = math::wrap_angle(rest.angle);
      if (std::abs(apart) <= 1e-9 && gear.joint >= 0)
        d.plan().redundant_gears.push_back(gear.joint);
      else if (std::abs(apart) <= 1e-9)
        d.error(key, fmt::format("belt '{}' repeats what gears and other belts say", gear.name),
                "leave it out: its tension is not determined without stiffness");
      else
        d.error(
            key,
            fmt::format("the other gears turn '{}' to an angle that is {:.6g} deg less than this one says",
                        body(1), math::degrees(apart)),
            "change its phase by as much, or leave the gear out");
      continue;
    }
    std::set<std::string> wheels;
    std::size_t gears = 0;
    for (const PartGear& other : d.gears)
      if (other.carrier == gear.carrier) {
        ++gears;
        wheels.insert({d.body_name(other.bodies[0]), d.body_name(other.bodies[1])});
      }
    if (gears < 2)
      d.error(key,
              fmt::format("a redundant constraint: '{}' and '{}' are placed without the gear already",
                          body(0), body(1)),
              "leave the gear or a drive out");
    else
      d.error(key,
              fmt::format("wheels {} with carrier '{}' cannot turn: {} gears for {} angles",
                          fmt::join(wheels, ", "), body(2), gears, gears - 1),
              fmt::format("leave out '{}' or a drive", gear.name));
  }
}

}  // namespace linkwright::planar
