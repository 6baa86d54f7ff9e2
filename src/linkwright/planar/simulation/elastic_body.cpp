// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/simulation/elastic_body.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/linkage/detail/load_formula.h"
#include "linkwright/planar/linkage/plan.h"

namespace linkwright::planar {
namespace {

constexpr int max_segments = 64;

bool positive(double x) { return x > 0 && std::isfinite(x); }
bool not_negative(double x) { return x >= 0 && std::isfinite(x); }

class Builder {
 public:
  Builder(const Linkage& rigid, std::span<const ElasticBody> bodies) : rigid_(rigid), given_(bodies) {}

  ElasticLinkage run(std::span<const InputMotion> inputs) {
    PlanResult planned = plan_linkage(rigid_);
    if (has_errors(planned.problems)) return refused(std::move(planned.problems));
    LINKWRIGHT_REQUIRE(inputs.size() == planned.plan.inputs(), "the linkage has {} drives, got {} inputs",
                       planned.plan.inputs(), inputs.size());
    for (std::size_t e = 0; e < given_.size(); ++e) read(e);
    if (!out_.problems.empty()) return refused(std::move(out_.problems));
    LinkageMotion motion(planned.plan);
    solve_motion(planned.plan, inputs, motion);
    if (motion.status != Status::done) {
      out_.status = motion.status;
      return std::move(out_);
    }
    out_.linkage = rigid_;
    start(planned.plan, motion);
    for (ElasticPieces& p : out_.pieces) cut(p);
    move_joints_and_loads();
    if (!out_.problems.empty()) return refused(std::move(out_.problems));
    for (const ElasticPieces& p : out_.pieces) drive(p, planned.plan, motion);
    planned = plan_linkage(out_.linkage);
    if (has_errors(planned.problems)) return refused(std::move(planned.problems));
    out_.plan = std::move(planned.plan);
    return std::move(out_);
  }

 private:
  ElasticLinkage refused(Diagnostics problems) {
    ElasticLinkage nothing;
    nothing.status = Status::infeasible;
    nothing.problems = std::move(problems);
    return nothing;
  }
  void error(const ElasticBody& b, std::string message, std::string hint) {
    const bool named = b.body >= 0 && at(b.body) < rigid_.bodies.size();
    const std::string key =
        "elastic_body." + (named ? rigid_.bodies[at(b.body)].name : std::to_string(b.body));
    out_.problems.push_back({Diagnostic::Severity::error, {}, {}, key, std::move(message), std::move(hint)});
  }
  std::complex<double> point(const BodyPoint& p) const { return place_of(rigid_, p); }

  // ---- what is given ------------------------------------------------------------------------------------

  void read(std::size_t e) {
    ElasticBody beam = given_[e];
    if (beam.body < 0 || at(beam.body) >= rigid_.bodies.size())
      return error(beam, fmt::format("body number {} does not exist", beam.body), {});
    if (beam.body == 0) return error(beam, "the ground cannot be flexible", "name a moving body");
    for (std::size_t k = 0; k < e; ++k)
      if (given_[k].body == beam.body) return error(beam, "is given twice", "once a body is enough");
    const std::size_t before = out_.problems.size();
    numbers(beam);
    if (out_.problems.size() == before) ends(beam);
    if (out_.problems.size() > before) return;
    const auto& points = rigid_.bodies[at(beam.body)].points;
    ElasticPieces pieces;
    pieces.beam = beam;
    pieces.length = std::abs(points[at(beam.to)].at - points[at(beam.from)].at);
    out_.pieces.push_back(std::move(pieces));
  }
  void numbers(const ElasticBody& b) {
    if (!(positive(b.elastic_modulus) && positive(b.second_moment) && positive(b.area) &&
          positive(b.density)))
      error(b,
            fmt::format("elastic modulus {} Pa, second moment of area {} m4, area {} m2 and density {} kg/m3 "
                        "must be finite and above 0",
                        b.elastic_modulus, b.second_moment, b.area, b.density),
            {});
    if (b.segments < 1 || b.segments > max_segments)
      error(b, fmt::format("{} segments: 1 to {} are allowed", b.segments, max_segments),
            "4 to 8 are enough for the first frequencies");
    if (!(not_negative(b.damping) && not_negative(b.fibre_distance)))
      error(b,
            fmt::format("damping {} s and fibre distance {} m must be finite and not negative", b.damping,
                        b.fibre_distance),
            {});
  }
  void ends(ElasticBody& b) {
    const auto& points = rigid_.bodies[at(b.body)].points;
    const double small = 1e-9 * size_of(rigid_);
    const auto apart = [&](int p, int q) { return std::abs(points[at(p)].at - points[at(q)].at) > small; };
    for (const int p : {b.from, b.to})
      if (p < -1 || p >= static_cast<int>(points.size()))
        return error(b, fmt::format("point number {} does not exist", p), {});
    for (const LinkageJoint& j : rigid_.joints)
      if (j.type == JointType::gear &&
          (j.first.body == b.body || j.second.body == b.body || j.carrier == b.body))
        return error(b, fmt::format("gear '{}' sits on it", j.name),
                     "put a rigid body between it and the beam");
    const auto joint_ends = ends_at_joints(b.body);
    if (b.from < 0 || b.to < 0) {
      for (const auto& [joint, p] : joint_ends)
        if (b.from < 0 && (b.to < 0 || apart(p, b.to)))
          b.from = p;
        else if (b.to < 0 && apart(p, b.from))
          b.to = p;
      if (b.from < 0 || b.to < 0)
        return error(b, "has its joints in one place, so that it is not known where the beam goes",
                     "name the points where it begins and ends");
    }
    if (!apart(b.from, b.to))
      return error(b, "has no length: its ends lie in one point", "name two points that lie apart");
    for (const auto& [joint, p] : joint_ends) {
      const LinkageJoint& j = rigid_.joints[at(joint)];
      if (j.type != JointType::revolute && j.type != JointType::fixed)
        error(b, fmt::format("joint '{}' is neither a pin nor a weld", j.name),
              "put a rigid body between it and the beam");
      else if (apart(p, b.from) && apart(p, b.to))
        error(b, fmt::format("joint '{}' sits away from the ends of the beam", j.name),
              "a beam is held at its two ends: make it of two bodies that are welded there");
    }
  }
  // Joints of a body that is on no gear, each with its point.
  std::vector<std::pair<int, int>> ends_at_joints(int body) const {
    std::vector<std::pair<int, int>> found;
    for (std::size_t k = 0; k < rigid_.joints.size(); ++k)
      for (const BodyPoint& end : {rigid_.joints[k].first, rigid_.joints[k].second})
        if (end.body == body) found.emplace_back(static_cast<int>(k), end.point);
    return found;
  }

  // ---- the pieces ---------------------------------------------------------------------------------------

  // Every body gets a start, so that assembly modes need not be given in terms of the pieces.
  void start(const LinkagePlan& plan, const LinkageMotion& motion) {
    for (std::size_t b = 1; b < rigid_.bodies.size(); ++b) {
      const PartState<double> s = body_state(plan, motion, static_cast<int>(b));
      out_.linkage.bodies[b].start = math::Pose{s.origin.x, s.origin.y, angle_of(s.direction)};
    }
    std::erase_if(out_.linkage.modes, [&](const DyadMode& m) { return bends(m.first) || bends(m.second); });
  }
  const ElasticPieces* pieces_of(int body) const {
    for (const ElasticPieces& p : out_.pieces)
      if (p.beam.body == body) return &p;
    return nullptr;
  }
  bool bends(int body) const { return pieces_of(body) != nullptr; }

  int nearest_piece(const ElasticPieces& p, std::complex<double> place) const {
    const auto& points = rigid_.bodies[at(p.beam.body)].points;
    const std::complex<double> from = points[at(p.beam.from)].at, way = points[at(p.beam.to)].at - from;
    const double along = ((place - from) / way).real() * p.beam.segments;
    return static_cast<int>(std::clamp(std::round(along), 0.0, static_cast<double>(p.beam.segments)));
  }

  void cut(ElasticPieces& p) {
    const ElasticBody& beam = p.beam;
    const LinkageBody whole = rigid_.bodies[at(beam.body)];
    const int n = beam.segments;
    const std::complex<double> from = whole.points[at(beam.from)].at,
                               cell = (whole.points[at(beam.to)].at - from) / static_cast<double>(n);
    const double l = p.length / n;
    Linkage& out = out_.linkage;
    for (int i = 0; i <= n; ++i) {
      LinkageBody piece;
      piece.name = i == 0 ? whole.name : fmt::format("{} piece {}", whole.name, i + 1);
      piece.start = out.bodies[at(beam.body)].start;
      const double low = std::max(0.0, i - 0.5), high = std::min<double>(n, i + 0.5);
      const double mass = beam.density * beam.area * l * (high - low), long_by = l * (high - low);
      piece.mass = BodyMass{mass, mass * long_by * long_by / 12, from + cell * (low + high) / 2.0};
      for (const LinkagePoint& point : whole.points)
        if (nearest_piece(p, point.at) == i) piece.points.push_back(point);
      for (const AttachedMass& m : whole.attached)
        if (nearest_piece(p, m.at) == i) piece.attached.push_back(m);
      p.nodes.push_back(from + cell * static_cast<double>(i));
      p.bodies.push_back(i == 0 ? beam.body : static_cast<int>(out.bodies.size()));
      if (i == 0)
        out.bodies[at(beam.body)] = std::move(piece);
      else
        out.bodies.push_back(std::move(piece));
    }
    const double stiffness = beam.elastic_modulus * beam.second_moment / l;
    for (int i = 0; i < n; ++i) {
      LinkageJoint joint;
      joint.name = fmt::format("{} bend {}", whole.name, i + 1);
      const auto end = [&](int body) {
        auto& points = out.bodies[at(body)].points;
        points.push_back({joint.name, from + cell * (i + 0.5)});
        return BodyPoint{body, static_cast<int>(points.size()) - 1};
      };
      joint.first = end(p.bodies[at(i)]);
      joint.second = end(p.bodies[at(i + 1)]);
      p.springs.push_back(static_cast<int>(out.torsion_springs.size()));
      out.torsion_springs.push_back(
          {joint.name, joint.first.body, joint.second.body, stiffness, 0, beam.damping * stiffness});
      p.joints.push_back(static_cast<int>(out.joints.size()));
      out.joints.push_back(std::move(joint));
    }
  }

  // ---- what held the body before ------------------------------------------------------------------------

  void move(BodyPoint& p) const {
    const ElasticPieces* pieces = pieces_of(p.body);
    if (!pieces) return;
    const LinkagePoint& old = rigid_.bodies[at(p.body)].points[at(p.point)];
    p.body = pieces->bodies[at(nearest_piece(*pieces, old.at))];
    p.point = point_index(out_.linkage.bodies[at(p.body)], old.name);
  }
  // The bodies that a torque acts between: the pieces at the joint that joins them.
  void move(int& first, int& second, const std::string& what) {
    const ElasticPieces *a = pieces_of(first), *b = pieces_of(second);
    if (!a && !b) return;
    for (std::size_t k = 0; k < rigid_.joints.size(); ++k) {
      const LinkageJoint &j = rigid_.joints[k], &now = out_.linkage.joints[k];
      if (j.first.body == first && j.second.body == second) {
        first = now.first.body, second = now.second.body;
        return;
      }
      if (j.first.body == second && j.second.body == first) {
        first = now.second.body, second = now.first.body;
        return;
      }
    }
    error((a ? a : b)->beam,
          what + " acts on it, but not at a joint: it is not known where it bends the beam",
          "let it act at a joint, or use forces at points");
  }
  void move_joints_and_loads() {
    Linkage& out = out_.linkage;
    for (std::size_t k = 0; k < rigid_.joints.size(); ++k) {
      move(out.joints[k].first);
      move(out.joints[k].second);
    }
    for (LinearSpring& s : out.springs) {
      move(s.first);
      move(s.second);
    }
    for (PointForce& f : out.forces) move(f.point);
    for (Strut& s : out.struts) {
      move(s.first);
      move(s.second);
    }
    for (std::size_t k = 0; k < rigid_.torsion_springs.size(); ++k)
      move(out.torsion_springs[k].first, out.torsion_springs[k].second,
           "torsion spring '" + out.torsion_springs[k].name + "'");
    for (BodyTorque& t : out.torques) move(t.from, t.body, "torque '" + t.name + "'");
    for_formulas(out, [this](auto& load) {
      auto moved = std::make_shared<LoadFormula>(*load.formula);
      for (LoadQuantity& q : moved->quantities) {
        if (q.kind == LoadQuantity::Kind::turning) {
          move(q.second.body, q.first.body, "torque '" + load.name + "'");
        } else {
          move(q.first);
          move(q.second);
        }
      }
      load.formula = std::move(moved);
    });
  }

  // ---- the inputs that are added ------------------------------------------------------------------------

  // The outer joint of the dyad that the body is in by itself; else -1.
  int outer_joint(const ElasticBody& beam, const LinkagePlan& plan) const {
    const int part = plan.bodies[at(beam.body)].part;
    if (std::count_if(plan.bodies.begin(), plan.bodies.end(),
                      [&](const BodyOnPart& b) { return b.part == part; }) != 1)
      return -1;
    const Group& group = plan.groups[at(plan.group_of_part[at(part)])];
    if (!group.as<Dyad>()) return -1;
    const int joint = group.joints[group.parts[0] == part ? 0 : 2].joint;
    // The plan may pair other links at a pin of several links than the model.
    const bool of_model = joint >= 0 && (rigid_.joints[at(joint)].first.body == beam.body ||
                                         rigid_.joints[at(joint)].second.body == beam.body);
    return of_model ? joint : -1;
  }
  void drive(const ElasticPieces& p, const LinkagePlan& plan, const LinkageMotion& motion) {
    std::size_t first = 0, last = p.joints.size();
    const int outer = outer_joint(p.beam, plan);
    if (outer >= 0) {
      const LinkageJoint &old = rigid_.joints[at(outer)], &now = out_.linkage.joints[at(outer)];
      const int held = old.first.body == p.beam.body ? now.first.body : now.second.body;
      held == p.bodies.front() ? --last : ++first;
      const PartState<double> a = body_state(plan, motion, old.first.body),
                              b = body_state(plan, motion, old.second.body);
      out_.linkage.driven.push_back(outer);
      out_.free.push_back({{}, angle_of(rotate_inverse(a.direction, b.direction)), b.speed - a.speed});
    }
    for (std::size_t i = first; i < last; ++i) {
      out_.linkage.driven.push_back(p.joints[i]);
      out_.free.push_back({});
    }
  }

  const Linkage& rigid_;
  std::span<const ElasticBody> given_;
  ElasticLinkage out_;
};

}  // namespace

ElasticLinkage with_elastic_bodies(const Linkage& linkage, std::span<const ElasticBody> bodies,
                                   std::span<const InputMotion> inputs) {
  return Builder(linkage, bodies).run(inputs);
}

BentBody bent_body(const ElasticLinkage& elastic, const ElasticPieces& pieces, const LinkageMotion& motion,
                   const LinkageForces* forces) {
  BentBody out;
  const std::size_t n = pieces.joints.size();
  const auto place_of = [&](std::size_t i, std::complex<double> there) {
    return point_motion(elastic.plan, motion, pieces.bodies[i], there).position;
  };
  const math::Vec2 first = place_of(0, pieces.nodes[0]), way = place_of(n, pieces.nodes[n]) - first;
  const double length = norm(way);
  const auto from_line = [&](std::size_t i, std::complex<double> there) {
    return cross(way, place_of(i, there) - first) / length;
  };
  for (std::size_t i = 0; i <= n; ++i) {
    out.deflections.push_back(i % n == 0 ? 0 : from_line(i, pieces.nodes[i]));
    if (std::abs(out.deflections[i]) > std::abs(out.largest)) out.largest = out.deflections[i];
  }
  // The middle of an odd number of cells is the joint of two pieces.
  out.middle = from_line(n / 2, (pieces.nodes[0] + pieces.nodes[n]) / 2.0);

  const math::Vec2 along = math::vec((pieces.nodes[n] - pieces.nodes[0]) / pieces.length);
  const ElasticBody& beam = pieces.beam;
  double worst = -1;
  for (std::size_t i = 0; i < n; ++i) {
    const TorsionSpring& s = elastic.linkage.torsion_springs[at(pieces.springs[i])];
    const PartState<double> a = body_state(elastic.plan, motion, s.first),
                            b = body_state(elastic.plan, motion, s.second);
    const double moment =
        s.stiffness * angle_of(rotate_inverse(a.direction, b.direction)) + s.damping * (b.speed - a.speed);
    out.moments.push_back(moment);
    const double bending = std::abs(moment) * beam.fibre_distance / beam.second_moment;
    out.bending_stress = std::max(out.bending_stress, bending);
    // Without a fibre distance and forces the section with the largest moment is the worst, too.
    double measure = beam.fibre_distance > 0 || forces ? bending : std::abs(moment), stress = bending;
    if (forces) {
      const math::Vec2 mean = rotate(a.direction + b.direction, along);
      const double pull = -dot(forces->joints[at(pieces.joints[i])].force, mean) / norm(mean);
      out.normal_forces.push_back(pull);
      stress += std::abs(pull) / beam.area;
      measure = stress;
    }
    if (measure <= worst) continue;
    worst = measure;
    out.stress = stress;
    out.spring = static_cast<int>(i);
  }
  out.place = (out.spring + 0.5) * pieces.length / static_cast<double>(n);
  return out;
}

SegmentErrors segment_errors(int segments) {
  LINKWRIGHT_REQUIRE(segments >= 1, "{} segments", segments);
  double even = 0, rising = 0;
  for (int i = 0; i < segments; ++i) {
    const double x = (i + 0.5) / segments;  // fraction of the length
    even = std::max(even, 4 * x * (1 - x));
    rising = std::max(rising, 1.5 * std::sqrt(3.0) * x * (1 - x * x));
  }
  const double n = segments, s = std::sin(pi / (2 * n)), full = n * n / (pi * pi);
  return {.moment = std::max(1 - even, 1 - rising),
          .frequency = 1 - full * 4 * s * s / std::sqrt(1 - 2 * s * s / 3)};
}

bool too_few_segments(int segments) {
  constexpr double much_moment = 0.1, much_frequency = 0.05;
  const SegmentErrors e = segment_errors(segments);
  return e.moment > much_moment || e.frequency > much_frequency;
}

int enough_segments() {
  int n = max_segments;
  while (n > 1 && !too_few_segments(n - 1)) --n;
  return n;
}

double first_frequency(const ElasticBody& b, double length) {
  return std::pow(pi / length, 2) * std::sqrt(b.elastic_modulus * b.second_moment / (b.density * b.area));
}
double highest_frequency(const ElasticBody& b, double length) {
  return std::pow(b.segments / length, 2) *
         std::sqrt(48 * b.elastic_modulus * b.second_moment / (b.density * b.area));
}

}  // namespace linkwright::planar
