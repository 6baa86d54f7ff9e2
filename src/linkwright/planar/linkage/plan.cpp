#include "linkwright/planar/linkage/plan.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "linkwright/core/check.h"
#include "linkwright/planar/linkage/kernel.h"

namespace linkwright::planar {
namespace {

using Index = std::size_t;
Index at(int i) { return static_cast<Index>(i); }
Vec<double> conj(const Vec<double>& a) { return {a.x, -a.y}; }

// "a", "a and b", "a, b and c", each in quotes.
std::string listed(const std::vector<std::string>& names) {
  std::string out;
  for (Index i = 0; i < names.size(); ++i)
    out += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + ("'" + names[i] + "'");
  return out;
}

PlanLink closed_form_link(const Vec<double>& vector) {
  PlanLink link;
  link.vector = vector;
  link.square = dot(vector, vector);
  link.length = std::sqrt(link.square);
  if (link.square > 0) link.inverse = (1 / link.square) * conj(vector);
  return link;
}

// The dyad of three joints in the order of the chain, the pin first where one end is a slide.
Dyad dyad_of(const PlanJoint& j1, const PlanJoint& j2, const PlanJoint& j3) {
  Dyad d;
  if (j2.slide)
    d.type = j3.slide ? DyadType::rpp : DyadType::rpr;
  else
    d.type = j1.slide ? DyadType::prp : j3.slide ? DyadType::rrp : DyadType::rrr;
  Vec<double> first = j2.before.at - j1.after.at, second = j2.after.at - j3.before.at;
  if (d.type == DyadType::rpr) {
    first = rotate_inverse(j2.before.direction, first);
    second = rotate_inverse(j2.after.direction, second);
  }
  d.first = closed_form_link(first);
  d.second = closed_form_link(second);
  if (d.type == DyadType::rrr) d.per_length = 1 / (d.first.length * d.second.length);
  if (d.type == DyadType::rrp) d.per_length = 1 / d.first.length;
  return d;
}

class Planner {
 public:
  explicit Planner(const Linkage& linkage) : l_(linkage) {}

  PlanResult run(PlanRoute route) {
    result_.problems = check(l_);
    if (!result_.problems.empty()) return std::move(result_);
    plan().size = size_of(l_);
    weld();
    if (result_.problems.empty()) links();
    if (!result_.problems.empty()) return std::move(result_);
    masses();
    known_.assign(parts(), false);
    known_[0] = true;
    plan().group_of_part.assign(parts(), -1);
    affine_.assign(parts(), std::nullopt);
    affine_[0] = Affine{0, std::vector<double>(l_.driven.size(), 0.0)};
    while (drive() || gear() || dyad() || triangle() || general()) {
    }
    diagnose();
    if (result_.problems.empty()) modes();
    if (result_.problems.empty()) drawn_inputs();
    if (result_.problems.empty() && route == PlanRoute::all_at_once) merge();
    return std::move(result_);
  }

 private:
  // A joint between two parts as the model has it, before it gets its place in a chain.
  struct Link {
    PartPoint first, second;
    bool slide = false;
    int joint = -1;  // -1: the slide of a pin in a slot
    int input = -1;
    bool used = false;
  };
  struct GearLink {
    int joint = 0, turning = 0, turned = 0, carrier = 0;
    double phase = 0;
    bool used = false;
  };
  struct Affine {
    double angle;
    std::vector<double> gains;
  };
  struct OnRoot {
    Vec<double> origin{0, 0}, turn{1, 0};
  };

  LinkagePlan& plan() { return result_.plan; }
  Index parts() { return plan().parts.size(); }
  void error(std::string key, std::string message, std::string hint) {
    result_.problems.push_back(
        {Diagnostic::Severity::error, {}, {}, std::move(key), std::move(message), std::move(hint)});
  }
  const LinkageJoint& joint(int j) const { return l_.joints[at(j)]; }
  const std::string& body_name(int b) const { return l_.bodies[at(b)].name; }
  Vec<double> point(const BodyPoint& p) const { return vec(l_.bodies[at(p.body)].points[at(p.point)].at); }

  // Bodies joined by welds become one part, in the frame of the first of them.
  void weld() {
    const int n = static_cast<int>(l_.bodies.size());
    std::vector<int> root(at(n));
    std::iota(root.begin(), root.end(), 0);
    std::vector<OnRoot> pose(at(n));
    for (int k = 0; k < static_cast<int>(l_.joints.size()); ++k) {
      const LinkageJoint& j = joint(k);
      if (j.type != JointType::fixed) continue;
      const int a = j.first.body, b = j.second.body;
      if (root[at(a)] == root[at(b)]) {
        error("joint." + j.name,
              fmt::format("welds '{}' and '{}', which are welded together already: a redundant constraint",
                          body_name(a), body_name(b)),
              "leave it out");
        return;
      }
      // Frame of b in the frame of a, then in that of a's root; all of b's part moves over.
      const Vec<double> turn_ba = unit(j.slide_first - j.slide_second);
      const Vec<double> origin_ba = point(j.first) - rotate(turn_ba, point(j.second));
      const OnRoot &ra = pose[at(a)], rb = pose[at(b)];
      const OnRoot b_in_root{ra.origin + rotate(ra.turn, origin_ba), renormalised(rotate(ra.turn, turn_ba))};
      const Vec<double> old_turn = rotate(b_in_root.turn, conj(rb.turn));
      const Vec<double> old_origin = b_in_root.origin - rotate(old_turn, rb.origin);
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
    plan().bodies.resize(at(n));
    std::vector<int> lowest;
    for (int i = 0; i < n; ++i) {
      int& part = part_of_root[at(root[at(i)])];
      if (part < 0) {
        part = static_cast<int>(plan().parts.size());
        plan().parts.push_back(body_name(i));
        lowest.push_back(i);
      } else {
        plan().parts[at(part)] += " + " + body_name(i);
      }
      const OnRoot& base = pose[at(lowest[at(part)])];
      BodyOnPart& b = plan().bodies[at(i)];
      b.part = part;
      b.turn = rotate(conj(base.turn), pose[at(i)].turn);
      b.origin = rotate_inverse(base.turn, pose[at(i)].origin - base.origin);
      b.same_frame = lowest[at(part)] == i;
      if (b.same_frame) b.origin = {0, 0}, b.turn = {1, 0};
    }
    start_.assign(plan().parts.size(), std::nullopt);
    start_[0] = math::Pose{};
    for (int i = 1; i < n; ++i) {
      const BodyOnPart& b = plan().bodies[at(i)];
      if (b.part == 0 || start_[at(b.part)] || !l_.bodies[at(i)].start) continue;
      const math::Pose& s = *l_.bodies[at(i)].start;
      const Vec<double> direction = rotate(unit(s.angle), conj(b.turn));
      const Vec<double> origin = Vec<double>{s.x, s.y} - rotate(direction, b.origin);
      start_[at(b.part)] = math::Pose{origin.x, origin.y, angle_of(direction)};
    }
  }

  PartPoint on_part(const BodyPoint& p, double slide) const {
    const BodyOnPart& b = result_.plan.bodies[at(p.body)];
    return {b.part, b.origin + rotate(b.turn, point(p)), rotate(b.turn, unit(slide))};
  }

  void links() {
    for (int k = 0; k < static_cast<int>(l_.joints.size()); ++k) {
      const LinkageJoint& j = joint(k);
      if (j.type == JointType::fixed) continue;
      const auto driven = std::find(l_.driven.begin(), l_.driven.end(), k);
      const int input = driven == l_.driven.end() ? -1 : static_cast<int>(driven - l_.driven.begin());
      if (j.type == JointType::gear) {
        gears_.push_back({k, plan().bodies[at(j.first.body)].part, plan().bodies[at(j.second.body)].part,
                          plan().bodies[at(j.carrier)].part, gear_phase(j)});
        continue;
      }
      // The direction of a pin is the x axis of its body, from which a drive counts.
      const bool turns = j.type == JointType::revolute;
      const PartPoint first = on_part(j.first, turns ? 0 : j.slide_first),
                      second = on_part(j.second, turns ? 0 : j.slide_second);
      if (first.part == second.part) {
        error("joint." + j.name,
              fmt::format("joins '{}' and '{}', which are welded together: a redundant constraint",
                          body_name(j.first.body), body_name(j.second.body)),
              "leave the joint or the weld out");
        continue;
      }
      if (j.type != JointType::pin_in_slot) {
        links_.push_back({first, second, j.type == JointType::prismatic, k, input});
        continue;
      }
      // A block without mass runs in the slot of the first body and carries the pin of the second.
      const int block = static_cast<int>(plan().parts.size());
      plan().parts.push_back("block of " + j.name);
      std::optional<math::Pose> start;
      if (start_[at(first.part)] && start_[at(second.part)]) {
        const math::Pose& pin = *start_[at(second.part)];
        const std::complex<double> there = math::transform(pin, number(second.at));
        start =
            math::Pose{there.real(), there.imag(), start_[at(first.part)]->angle + angle_of(first.direction)};
      }
      start_.push_back(start);
      links_.push_back({first, {block, {0, 0}, {1, 0}}, true, -1, -1});
      links_.push_back({{block, {0, 0}, {1, 0}}, second, false, k, -1});
    }
    for (int d : l_.driven) plan().rotary.push_back(joint(d).type == JointType::revolute);
  }
  // Gears couple the frames of bodies; parts may be turned against them.
  double gear_phase(const LinkageJoint& j) const {
    const auto offset = [&](int body) { return angle_of(result_.plan.bodies[at(body)].turn); };
    const double carrier = offset(j.carrier);
    return j.phase - (offset(j.second.body) - carrier) + j.ratio * (offset(j.first.body) - carrier);
  }

  void masses() {
    plan().masses = part_masses(l_, plan().bodies, plan().parts.size());
    for (int i = 1; i < static_cast<int>(l_.bodies.size()); ++i)
      if (!l_.bodies[at(i)].mass && plan().bodies[at(i)].part != 0)
        plan().massless.push_back(l_.bodies[at(i)].name);
    plan().has_masses = plan().massless.empty();
  }

  PlanJoint chained(const Link& link, int before) const {
    const bool reversed = link.first.part != before;
    return {link.slide,
            reversed,
            link.joint,
            link.input,
            reversed ? link.second : link.first,
            reversed ? link.first : link.second};
  }
  void place(Group group) {
    std::vector<std::string> names;
    for (int p : group.parts) {
      known_[at(p)] = true;
      plan().group_of_part[at(p)] = static_cast<int>(plan().groups.size());
      names.push_back(plan().parts[at(p)]);
    }
    for (const std::string& n : names) group.name += (group.name.empty() ? "" : " + ") + n;
    plan().groups.push_back(std::move(group));
  }

  bool drive() {
    for (Link& link : links_) {
      if (link.used || link.input < 0 || known_[at(link.first.part)] == known_[at(link.second.part)])
        continue;
      const bool from_first = known_[at(link.first.part)];
      const int base = from_first ? link.first.part : link.second.part;
      Group g{.kind = Driver{}};
      g.joints = {chained(link, base)};
      g.parts = {g.joints[0].after.part};
      if (affine_[at(base)]) {
        Affine a = *affine_[at(base)];
        a.angle += angle_of(g.joints[0].before.direction) - angle_of(g.joints[0].after.direction);
        if (!link.slide) a.gains[at(link.input)] += from_first ? 1 : -1;
        affine_[at(g.parts[0])] = std::move(a);
      }
      link.used = true;
      place(std::move(g));
      return true;
    }
    return false;
  }

  bool gear() {
    for (GearLink& gl : gears_) {
      if (gl.used || !affine_[at(gl.carrier)] || known_[at(gl.turned)] == known_[at(gl.turning)]) continue;
      const bool backwards = known_[at(gl.turned)];
      const int turning = backwards ? gl.turned : gl.turning, turned = backwards ? gl.turning : gl.turned;
      if (!affine_[at(turning)]) continue;
      for (Link& link : links_) {
        const bool first = link.first.part == turned;
        if (link.used || link.slide || link.input >= 0 || (!first && link.second.part != turned)) continue;
        const int base = first ? link.second.part : link.first.part;
        if (!known_[at(base)]) continue;
        const double ratio = joint(gl.joint).ratio;
        Gear gear{.ratio = backwards ? 1 / ratio : ratio,
                  .turning = turning,
                  .carrier = gl.carrier,
                  .joint = gl.joint,
                  .backwards = backwards};
        const Affine &a = *affine_[at(turning)], &c = *affine_[at(gl.carrier)];
        gear.angle =
            gear.ratio * a.angle + (1 - gear.ratio) * c.angle + (backwards ? -gl.phase / ratio : gl.phase);
        for (Index i = 0; i < a.gains.size(); ++i)
          gear.gains.push_back(gear.ratio * a.gains[i] + (1 - gear.ratio) * c.gains[i]);
        affine_[at(turned)] = Affine{gear.angle, gear.gains};
        link.used = gl.used = true;
        place({.kind = std::move(gear), .parts = {turned}, .joints = {chained(link, base)}});
        return true;
      }
    }
    return false;
  }

  // The first free link of a part to a known one; drives and gears stay out of dyads.
  Link* to_known(int part) {
    for (Link& link : links_) {
      if (link.used || link.input >= 0) continue;
      if (link.first.part == part && known_[at(link.second.part)]) return &link;
      if (link.second.part == part && known_[at(link.first.part)]) return &link;
    }
    return nullptr;
  }
  bool geared(int part) const {
    return std::any_of(gears_.begin(), gears_.end(),
                       [&](const GearLink& g) { return !g.used && (g.turned == part || g.turning == part); });
  }

  bool dyad() {
    for (Link& inner : links_) {
      if (inner.used || inner.input >= 0) continue;
      int i = inner.first.part, k = inner.second.part;
      if (known_[at(i)] || known_[at(k)] || geared(i) || geared(k)) continue;
      if (i > k) std::swap(i, k);
      Link *outer1 = to_known(i), *outer3 = to_known(k);
      if (!outer1 || !outer3) continue;
      const int slides = outer1->slide + inner.slide + outer3->slide;
      if (slides == 3) continue;  // no pin: nothing holds the way of the two together
      // Order of the chain: the pin first where one end is a slide.
      if (outer1->slide && !outer3->slide) std::swap(i, k), std::swap(outer1, outer3);
      const auto other = [](const Link& link, int part) {
        return link.first.part == part ? link.second.part : link.first.part;
      };
      const PlanJoint j1 = chained(*outer1, other(*outer1, i)), j2 = chained(inner, i),
                      j3 = chained(*outer3, k);
      outer1->used = inner.used = outer3->used = true;
      place({.kind = dyad_of(j1, j2, j3), .parts = {i, k}, .joints = {j1, j2, j3}});
      return true;
    }
    return false;
  }

  // Two bodies with a drive between them, pinned to a known part and to an arm on another known pin.
  bool triangle() {
    for (Link& inner : links_) {
      if (inner.used || inner.input < 0) continue;
      for (const bool swapped : {false, true}) {
        const int x = swapped ? inner.second.part : inner.first.part,
                  y = swapped ? inner.first.part : inner.second.part;
        Link* foot = known_[at(x)] || known_[at(y)] || geared(x) || geared(y) ? nullptr : to_known(x);
        if (!foot || foot->slide) continue;
        for (Link& tip : links_) {
          if (tip.used || tip.slide || tip.input >= 0 || (tip.first.part != y && tip.second.part != y))
            continue;
          const int z = tip.first.part == y ? tip.second.part : tip.first.part;
          Link* base = z == x || known_[at(z)] || geared(z) ? nullptr : to_known(z);
          if (!base || base->slide) continue;
          std::vector<bool> chosen(parts(), false);
          chosen[at(x)] = chosen[at(y)] = chosen[at(z)] = true;
          if (equations(chosen) != 9) continue;
          const int known = foot->first.part == x ? foot->second.part : foot->first.part;
          const PlanJoint j3 = chained(tip, y), j4 = chained(*base, z);
          foot->used = inner.used = tip.used = base->used = true;
          place({.kind = Triangle{closed_form_link(j3.after.at - j4.before.at)},
                 .parts = {x, y, z},
                 .joints = {chained(*foot, known), chained(inner, x), j3, j4}});
          return true;
        }
      }
    }
    return false;
  }

  // Equations of the links that run inside `chosen` and to known parts, or -1 when a gear is among them.
  int equations(const std::vector<bool>& chosen) const {
    int count = 0;
    for (const Link& link : links_) {
      if (link.used) continue;
      const bool a = chosen[at(link.first.part)], b = chosen[at(link.second.part)];
      if ((a && (b || known_[at(link.second.part)])) || (b && known_[at(link.first.part)]))
        count += link.input >= 0 ? 3 : 2;
    }
    for (const GearLink& g : gears_)
      if (!g.used && (chosen[at(g.turned)] || chosen[at(g.turning)])) return -1;
    return count;
  }
  bool linked(int part, const std::vector<bool>& chosen) const {
    return std::any_of(links_.begin(), links_.end(), [&](const Link& link) {
      return !link.used && ((link.first.part == part && chosen[at(link.second.part)]) ||
                            (link.second.part == part && chosen[at(link.first.part)]));
    });
  }
  // Smallest connected set of unknown parts with as many equations as unknowns, grown from its lowest part.
  bool grow(std::vector<int>& set, std::vector<bool>& chosen, Index size, int& tries) {
    if (set.size() == size) return equations(chosen) == 3 * static_cast<int>(size);
    for (int p = set.front() + 1; p < static_cast<int>(parts()); ++p) {
      if (known_[at(p)] || chosen[at(p)] || !linked(p, chosen) || --tries < 0) continue;
      set.push_back(p);
      chosen[at(p)] = true;
      if (grow(set, chosen, size, tries)) return true;
      set.pop_back();
      chosen[at(p)] = false;
    }
    return false;
  }
  bool general() {
    std::vector<int> unknown;
    for (int p = 0; p < static_cast<int>(parts()); ++p)
      if (!known_[at(p)]) unknown.push_back(p);
    int tries = 200000;  // the whole rest is tried in any case
    for (Index size = 1; size <= unknown.size(); ++size) {
      for (int first : unknown) {
        std::vector<int> set{first};
        std::vector<bool> chosen(parts(), false);
        chosen[at(first)] = true;
        if (size == unknown.size() && first == unknown.front()) {
          set = unknown;
          for (int p : unknown) chosen[at(p)] = true;
          if (equations(chosen) != 3 * static_cast<int>(size)) continue;
        } else if (!grow(set, chosen, size, tries)) {
          continue;
        }
        place_general(set, chosen);
        return true;
      }
    }
    return false;
  }
  void place_general(std::vector<int> set, const std::vector<bool>& chosen) {
    std::sort(set.begin(), set.end());
    Group g{.kind = GeneralGroup{}, .parts = set};
    for (Link& link : links_) {
      const bool a = chosen[at(link.first.part)], b = chosen[at(link.second.part)];
      if (link.used || !((a && (b || known_[at(link.second.part)])) || (b && known_[at(link.first.part)])))
        continue;
      g.joints.push_back(chained(link, link.first.part));
      link.used = true;
    }
    std::vector<math::Pose>& start = std::get<GeneralGroup>(g.kind).start;
    for (int p : set)
      if (start_[at(p)]) start.push_back(*start_[at(p)]);
    if (start.size() != set.size()) start.clear();
    place(std::move(g));
  }

  void diagnose() {
    std::vector<int> unknown;
    for (int p = 0; p < static_cast<int>(parts()); ++p)
      if (!known_[at(p)]) unknown.push_back(p);
    for (const Link& link : links_) {
      if (link.used || !known_[at(link.first.part)] || !known_[at(link.second.part)]) continue;
      const int k = link.joint >= 0 ? link.joint : slot_of(link);
      const LinkageJoint& j = joint(k);
      if (link.input >= 0)
        error(
            "drive",
            fmt::format("two drives on one freedom: '{}' and '{}', which joint '{}' would drive, are placed "
                        "by other drives already",
                        body_name(j.first.body), body_name(j.second.body), j.name),
            fmt::format("the linkage has {} degree(s) of freedom and {} drive(s): remove one drive",
                        mobility(l_), l_.driven.size()));
      else
        error("joint." + j.name,
              fmt::format("a redundant constraint: '{}' and '{}' are placed by other joints already, so the "
                          "joint fits by chance only",
                          body_name(j.first.body), body_name(j.second.body)),
              "leave the joint out, or one of the links beside it");
    }
    for (const GearLink& g : gears_) {
      if (g.used) continue;
      const LinkageJoint& j = joint(g.joint);
      if (known_[at(g.turned)] && known_[at(g.turning)])
        error("joint." + j.name,
              fmt::format("a redundant constraint: '{}' and '{}' are placed without the gear already",
                          body_name(j.first.body), body_name(j.second.body)),
              "leave the gear or a drive out");
      else
        error("joint." + j.name,
              fmt::format("the gear between '{}' and '{}' on '{}' cannot be followed from the drives",
                          body_name(j.first.body), body_name(j.second.body), body_name(j.carrier)),
              "one of the two must be turned by drives and gears alone, so must the carrier, and the other "
              "must have a pin on a placed body");
    }
    if (unknown.empty()) return;
    loose(unknown);
  }
  int slot_of(const Link& slide) const {
    for (const Link& link : links_)
      if (!link.slide && link.first.part == slide.second.part) return link.joint;
    return 0;
  }
  std::string driven_names() const {
    std::vector<std::string> names;
    for (int d : l_.driven) names.push_back(joint(d).name);
    return listed(names);
  }
  // Why parts stay without a place.
  void loose(const std::vector<int>& unknown) {
    const auto names = [&](const std::vector<int>& of) {
      std::vector<std::string> out;
      for (int p : of) out.push_back(result_.plan.parts[at(p)]);
      return listed(out);
    };
    // Components of the unknown parts; known parts are walls.
    std::vector<bool> seen(parts(), false);
    for (int p : unknown) {
      if (seen[at(p)]) continue;
      std::vector<int> component{p};
      seen[at(p)] = true;
      bool held = false;
      for (Index i = 0; i < component.size(); ++i)
        for (const Link& link : links_)
          for (const auto& [here, there] :
               {std::pair{link.first.part, link.second.part}, std::pair{link.second.part, link.first.part}})
            if (here == component[i]) {
              if (known_[at(there)]) {
                held = true;
              } else if (!seen[at(there)]) {
                seen[at(there)] = true;
                component.push_back(there);
              }
            }
      std::sort(component.begin(), component.end());
      std::vector<bool> chosen(parts(), false);
      for (int c : component) chosen[at(c)] = true;
      const int rows = equations(chosen);
      const int free = 3 * static_cast<int>(component.size()) - std::max(rows, 0);
      const std::string key = "body." + plan().parts[at(component[0])];
      if (!held && component.size() == 1)
        error(key, fmt::format("{} is not joined to anything", names(component)),
              "join it to another body, or leave it out");
      else if (!held)
        error(key, fmt::format("{} are joined to each other but not to the ground", names(component)),
              "join one of them to the ground or to a body that stands on it");
      else if (rows < 0)
        continue;  // the gear has been named
      else if (free > 0)
        error(key,
              fmt::format("{} keep{} {} degree{} of freedom without a drive", names(component),
                          component.size() == 1 ? "s" : "", free, free == 1 ? "" : "s"),
              fmt::format("the linkage has {} degree(s) of freedom and {} drive(s): drive one more joint, or "
                          "add a joint",
                          mobility(l_), l_.driven.size()));
      else if (free < 0 && l_.driven.size() > 1 && mobility(l_) < static_cast<int>(l_.driven.size()))
        error("drive",
              fmt::format("two drives on one freedom: with the drives of {} nothing is left to place {}",
                          driven_names(), names(component)),
              fmt::format("the linkage has {} degree(s) of freedom and {} drive(s): remove one drive",
                          mobility(l_), l_.driven.size()));
      else if (free < 0)
        error(key,
              fmt::format("{} {} {} constraint{} too many: a rigid or overdetermined structure",
                          names(component), component.size() == 1 ? "has" : "have", -free,
                          free == -1 ? "" : "s"),
              "leave out a joint or a drive");
      else
        error(key,
              fmt::format("{} {} constrained too much in one place and too little in another",
                          names(component), component.size() == 1 ? "is" : "are"),
              "look for a triangle of links that cannot move");
    }
  }

  // One general group in the place of all others.
  void merge() {
    LINKWRIGHT_REQUIRE(gears_.empty(), "a linkage with {} gear(s) cannot be solved all at once",
                       gears_.size());
    plan().groups.clear();
    for (Link& link : links_) link.used = false;
    std::vector<bool> chosen(parts(), true);
    chosen[0] = false;
    known_.assign(parts(), false);
    known_[0] = true;
    std::vector<int> all(parts() - 1);
    std::iota(all.begin(), all.end(), 1);
    place_general(std::move(all), chosen);
  }

  // Signs of the assembly modes: what the model names, else what the start poses show, else plus.
  void modes() {
    std::vector<bool> used(l_.modes.size(), false);
    for (Group& g : plan().groups) {
      if (!traits_of(g).has_modes) continue;
      if (const auto shown = shown_mode(g)) g.mode = *shown, g.mode_given = true;
      for (Index i = 0; i < l_.modes.size(); ++i) {
        const DyadMode& m = l_.modes[i];
        const int a = part_of(m.first), b = part_of(m.second);
        const bool driven = g.as<Triangle>();
        const int first = driven && (a == g.parts[1] || b == g.parts[1]) ? g.parts[1] : g.parts[0],
                  second = g.parts.back();
        const bool straight = a == first && (b == second || (a == b && is_block(second)));
        const bool swapped = (a == second && b == first) || (a == b && a == second && is_block(first));
        if (!straight && !swapped) continue;
        used[i] = true;
        // The sign of RRP goes with the direction of its guide, the others with the order of the two parts.
        const Dyad* dyad = g.as<Dyad>();
        g.mode = sign(m.mode) * (swapped && !(dyad && dyad->type == DyadType::rrp) ? -1 : 1);
        g.mode_given = true;
      }
    }
    for (Index i = 0; i < l_.modes.size(); ++i)
      if (!used[i]) {
        std::string dyads;
        for (const Group& g : plan().groups)
          if (traits_of(g).has_modes) dyads += (dyads.empty() ? "" : ", ") + g.name;
        error("assembly",
              fmt::format("'{}' and '{}' are no pair with two assembly modes",
                          name_or_number(l_.modes[i].first), name_or_number(l_.modes[i].second)),
              dyads.empty() ? "this linkage has no such pair" : "these are: " + dyads);
      }
  }
  // What the driven joints stand at in the start poses.
  void drawn_inputs() {
    std::vector<double> values(l_.driven.size());
    for (const Link& link : links_) {
      if (link.input < 0) continue;
      const auto &first = start_[at(link.first.part)], &second = start_[at(link.second.part)];
      if (!first || !second) return;
      const Vec<double> along = rotate(unit(first->angle), link.first.direction),
                        other = rotate(unit(second->angle), link.second.direction),
                        way = vec(math::transform(*second, number(link.second.at))) -
                              vec(math::transform(*first, number(link.first.at)));
      values[at(link.input)] = link.slide ? dot(along, way) : angle_of(rotate_inverse(along, other));
    }
    plan().drawn_inputs = std::move(values);
  }
  std::string name_or_number(int body) const {
    return body >= 0 && body < static_cast<int>(l_.bodies.size()) ? body_name(body) : std::to_string(body);
  }
  int part_of(int body) {
    return body >= 0 && body < static_cast<int>(l_.bodies.size()) ? plan().bodies[at(body)].part : -2;
  }
  bool is_block(int part) { return plan().parts[at(part)].starts_with("block of "); }
  std::optional<double> shown_mode(const Group& g) const {
    for (const PlanJoint& j : g.joints)
      if (!start_[at(j.before.part)] || !start_[at(j.after.part)]) return {};
    const auto there = [&](const PartPoint& p) {
      return vec(math::transform(*start_[at(p.part)], number(p.at)));
    };
    const auto along = [&](const PartPoint& p) {
      return rotate(unit(start_[at(p.part)]->angle), p.direction);
    };
    return mode_side(g, there, along) < 0 ? -1.0 : 1.0;
  }

  const Linkage& l_;
  PlanResult result_;
  std::vector<std::optional<math::Pose>> start_;  // one a part
  std::vector<Link> links_;
  std::vector<GearLink> gears_;
  std::vector<bool> known_;
  std::vector<std::optional<Affine>> affine_;
};

}  // namespace

bool LinkagePlan::closed_form() const {
  return std::none_of(groups.begin(), groups.end(), [](const Group& g) { return !traits_of(g).closed_form; });
}

std::vector<PartMass> part_masses(const Linkage& linkage, std::span<const BodyOnPart> bodies,
                                  std::size_t parts) {
  std::vector<PartMass> masses(parts);
  for (Index i = 1; i < linkage.bodies.size(); ++i) {
    const LinkageBody& body = linkage.bodies[i];
    const BodyOnPart& on = bodies[i];
    PartMass& m = masses[static_cast<Index>(on.part)];
    const auto add = [&](double mass, double inertia, const Vec<double>& centre) {
      const Vec<double> c = on.origin + rotate(on.turn, centre);
      m.mass += mass;
      m.moment = m.moment + mass * c;
      m.inertia += inertia + mass * dot(c, c);
    };
    if (body.mass) add(body.mass->mass, body.mass->inertia, vec(body.mass->centre));
    for (const AttachedMass& a : body.attached) add(a.mass, 0, vec(a.at));
  }
  return masses;
}

int mobility(const Linkage& linkage) {
  int freedoms = 3 * (static_cast<int>(linkage.bodies.size()) - 1);
  for (const LinkageJoint& j : linkage.joints)
    freedoms -= j.type == JointType::fixed                                      ? 3
                : j.type == JointType::pin_in_slot || j.type == JointType::gear ? 1
                                                                                : 2;
  return freedoms;
}

PlanResult plan(const Linkage& linkage, PlanRoute route) { return Planner(linkage).run(route); }

}  // namespace linkwright::planar
