// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/sketch/sketch.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <complex>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/planar/sketch/detail/sketch_points.h"

namespace linkwright::planar {
namespace {

using sketching::distance, sketching::least_corner, sketching::left_below, sketching::Nodes,
    sketching::pieces_of, sketching::Place, sketching::Segment, sketching::shown_place, sketching::turn_at;

/// What the layer of a shape says about it.
enum class Role { link, ground, slide, drive, trace, construction, gear, belt };

Role role_of(const std::string& layer) {
  std::string word;
  for (const char c : layer) word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  constexpr std::array<std::pair<std::string_view, Role>, 8> roles{{{"ground", Role::ground},
                                                                    {"slide", Role::slide},
                                                                    {"drive", Role::drive},
                                                                    {"trace", Role::trace},
                                                                    {"construction", Role::construction},
                                                                    {"defpoints", Role::construction},
                                                                    {"gear", Role::gear},
                                                                    {"belt", Role::belt}}};
  for (const auto& [name, role] : roles)
    if (word.starts_with(name)) return role;
  return Role::link;
}

/// A body with the corners of its outline.
struct Outline {
  SketchBodyType type = SketchBodyType::bar;
  std::vector<Place> corners;
  std::vector<Segment> edges;
};

/// A circle of the layer "gear".
struct DrawnWheel {
  Place centre;
  double radius = 0;
  std::string layer;
  std::size_t node = 0, body = 0;
};

/// The reading of one drawing, rule by rule.
class Reader {
 public:
  Reader(const std::vector<DrawnShape>& shapes, double tolerance, std::optional<SketchEnd> ends)
      : tolerance_(tolerance), ends_(ends) {
    for (const DrawnShape& shape : shapes) take(shape);
    find_triangles();
    for (const auto& [layer, lines] : loose_)
      for (const Segment& line : lines)
        bodies_.push_back({SketchBodyType::bar, {line.from, line.to}, {line}});
    sort_bodies();
  }

  Sketch read() {
    if (bodies_.empty() && wheels_.empty()) return std::move(out_);
    std::vector<Place> places;
    for (const DrawnWheel& wheel : wheels_) places.push_back(wheel.centre);
    for (const Outline& body : bodies_) places.insert(places.end(), body.corners.begin(), body.corners.end());
    for (const auto* more : {&circles_, &ground_circles_, &ground_corners_, &driven_, &traced_})
      places.insert(places.end(), more->begin(), more->end());
    if (places.size() > most_sketch_places) {
      out_.left_out = {
          fmt::format("the drawing has {} ends, corners and circles of links; at most {} are read",
                      places.size(), most_sketch_places)};
      return std::move(out_);
    }
    for (const Place& p : places) nodes_.add(p);
    nodes_.join(tolerance_, out_.questions);
    add_bodies();
    attach_circles();
    attach_ends();
    add_slides();
    add_gears();
    add_pins();
    mark(driven_, out_.driven, "drive");
    mark(traced_, out_.traced, "trace");
    name_everything();
    return std::move(out_);
  }

 private:
  void take(const DrawnShape& shape) {
    const Role role = role_of(shape.layer);
    if (role == Role::construction) return;
    if (role == Role::belt) {
      out_.left_out.push_back(
          fmt::format("{} on the layer {}: belts are not read from drawings; add the belt to the study",
                      shape.name, shape.layer));
    } else if (role == Role::gear) {
      take_wheel(shape);
    } else if (shape.radius > 0) {
      (role == Role::ground  ? ground_circles_
       : role == Role::drive ? driven_
       : role == Role::trace ? traced_
                             : circles_)
          .push_back(shape.centre);
    } else if (role == Role::slide) {
      for (const Segment& piece : pieces_of(shape)) slides_.push_back(piece);
    } else if (role == Role::ground) {
      take_ground(shape);
    } else if (role == Role::drive || role == Role::trace) {
      out_.left_out.push_back(fmt::format("{} on the layer {} is not a circle; a circle marks the point",
                                          shape.name, shape.layer));
    } else if (shape.closed && shape.points.size() > 2) {
      take_plate(shape);
    } else {
      take_bars(shape);
    }
  }

  void take_wheel(const DrawnShape& shape) {
    if (shape.radius > 0)
      wheels_.push_back({shape.centre, shape.radius, shape.layer});
    else
      out_.left_out.push_back(
          fmt::format("{} on the layer {} is not a circle; a circle is a wheel", shape.name, shape.layer));
  }

  void take_ground(const DrawnShape& shape) {
    has_ground_ = true;
    std::vector<Segment> pieces = pieces_of(shape);
    if (shape.closed && shape.points.size() > 2)
      pieces.push_back({shape.points.back(), shape.points.front()});
    for (const Segment& piece : pieces) {
      ground_.push_back(piece);
      ground_corners_.push_back(piece.from);
      ground_corners_.push_back(piece.to);
    }
  }

  void take_plate(const DrawnShape& shape) {
    Outline plate{SketchBodyType::plate, {}, {}};
    const auto& p = shape.points;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Place before = p[(i + p.size() - 1) % p.size()], after = p[(i + 1) % p.size()];
      plate.edges.push_back({p[i], after});
      if (turn_at(before, p[i], after) > least_corner) plate.corners.push_back(p[i]);
    }
    bodies_.push_back(std::move(plate));
  }

  void take_bars(const DrawnShape& shape) {
    const std::vector<Segment> pieces = pieces_of(shape);
    for (const Segment& piece : pieces)
      if (std::abs(piece.to - piece.from) > 10 * tolerance_)
        loose_[shape.layer].push_back(piece);
      else
        out_.left_out.push_back(fmt::format("{} is shorter than ten times the tolerance", shape.name));
    if (pieces.size() > 1)
      out_.questions.push_back(
          {fmt::format("{} has {} corners: is it bars with pins at its corners, or one bent bar?", shape.name,
                       pieces.size() - 1),
           "bars with pins; a bent bar is drawn as a closed polyline"});
  }

  /// Three lines that make a triangle and are alone on their layer are a plate.
  void find_triangles() {
    for (auto it = loose_.begin(); it != loose_.end();) {
      auto& [layer, lines] = *it;
      const std::optional<std::array<Place, 3>> corners =
          layer.empty() || layer == "0" || lines.size() != 3 ? std::nullopt : triangle(lines);
      if (!corners) {
        ++it;
        continue;
      }
      bodies_.push_back({SketchBodyType::plate, {corners->begin(), corners->end()}, lines});
      it = loose_.erase(it);
    }
  }

  std::optional<std::array<Place, 3>> triangle(const std::vector<Segment>& lines) const {
    const auto meet = [&](Place a, Place b) { return std::abs(a - b) <= tolerance_; };
    for (unsigned way = 0; way < 8; ++way) {
      Segment second = lines[way & 1u ? 2 : 1], third = lines[way & 1u ? 1 : 2];
      if (way & 2u) std::swap(second.from, second.to);
      if (way & 4u) std::swap(third.from, third.to);
      if (meet(lines[0].to, second.from) && meet(second.to, third.from) && meet(third.to, lines[0].from))
        return std::array{lines[0].from, lines[0].to, second.to};
    }
    return std::nullopt;
  }

  /// Sorts the bodies by their places, so that the order of the drawing does not matter.
  void sort_bodies() {
    const auto key = [](const Outline& body) {
      std::vector<Place> places = body.corners;
      std::sort(places.begin(), places.end(), left_below);
      std::vector<double> numbers;
      for (const Place& p : places) numbers.insert(numbers.end(), {p.real(), p.imag()});
      return std::pair(body.type, numbers);
    };
    std::sort(bodies_.begin(), bodies_.end(),
              [&](const Outline& a, const Outline& b) { return key(a) < key(b); });
  }

  // Bodies of the sketch: the ground first if there is one, then the outlines in their order.
  void add_bodies() {
    has_ground_ = has_ground_ || !ground_circles_.empty();
    members_.resize(nodes_.places().size());
    if (has_ground_) add_body(SketchBodyType::ground, {});
    for (const Place& p : ground_circles_) join(0, nodes_.at(p));
    for (const Place& p : ground_corners_) join(0, nodes_.at(p));
    for (const Outline& body : bodies_) {
      const std::size_t index = add_body(body.type, body.edges);
      for (const Place& p : body.corners) join(index, nodes_.at(p));
    }
  }

  std::size_t add_body(SketchBodyType type, std::vector<Segment> edges) {
    out_.bodies.push_back({type, {}, {}});
    edges_.push_back(std::move(edges));
    return out_.bodies.size() - 1;
  }

  void join(std::size_t body, std::size_t node) {
    auto& members = members_[node];
    if (std::find(members.begin(), members.end(), body) == members.end()) members.push_back(body);
  }
  bool has(std::size_t node, std::size_t body) const {
    const auto& members = members_[node];
    return std::find(members.begin(), members.end(), body) != members.end();
  }

  bool on_edge(std::size_t body, Place at) const {
    return std::any_of(edges_[body].begin(), edges_[body].end(), [&](const Segment& edge) {
      return edge.straight && distance(at, edge.from, edge.to) <= tolerance_;
    });
  }

  /// A circle on a line is a pin or a hole of that body.
  void attach_circles() {
    std::set<std::size_t> at;
    for (const auto* places : {&circles_, &ground_circles_, &driven_, &traced_})
      for (const Place& p : *places) at.insert(nodes_.at(p));
    for (const std::size_t node : at)
      for (std::size_t body = 0; body < out_.bodies.size(); ++body)
        if (on_edge(body, nodes_.places()[node])) join(body, node);
  }

  /// An end on the middle of another line: a pin at the ground, else a weld, about which there is a question.
  void attach_ends() {
    for (std::size_t node = 0; node < members_.size(); ++node) {
      const std::vector<std::size_t> ends = members_[node];
      if (ends.empty()) continue;
      const Place at = nodes_.places()[node];
      const bool on_ground = std::any_of(ground_.begin(), ground_.end(), [&](const Segment& line) {
        return distance(at, line.from, line.to) <= tolerance_;
      });
      if (on_ground) join(0, node);
      for (std::size_t body = 0; body < out_.bodies.size(); ++body) {
        if (has(node, body) || !on_edge(body, at)) continue;
        if (ends_ == SketchEnd::nothing) continue;
        if (ends_ == SketchEnd::pin) {
          join(body, node);
          continue;
        }
        if (!ends_)
          out_.questions.push_back(
              {fmt::format("the line that ends at {} ends on the middle of another line, "
                           "where no circle is drawn: is it a pin, a weld or nothing?",
                           shown_place(at)),
               "a weld"});
        welds_.push_back({JointType::fixed, {}, body, ends.front(), node, 0});
      }
    }
    for (const SketchJoint& weld : welds_) welded_[weld.point].push_back(weld.first);
  }

  /// A line of the layer "slide" through a point: a block turns about the point and slides on the line, which
  /// belongs to the body that has a point at one of its ends, else to the ground.
  void add_slides() {
    for (const Segment& line : slides_) {
      std::vector<std::size_t> sliding;
      constexpr std::size_t none = -1;
      std::size_t owner = none;
      for (std::size_t node = 0; node < members_.size(); ++node) {
        const Place at = nodes_.places()[node];
        const auto moving = std::find_if(members_[node].begin(), members_[node].end(), [&](std::size_t body) {
          return out_.bodies[body].type == SketchBodyType::bar ||
                 out_.bodies[body].type == SketchBodyType::plate;
        });
        if (moving == members_[node].end() || distance(at, line.from, line.to) > tolerance_) continue;
        const bool at_end = std::abs(at - line.from) <= tolerance_ || std::abs(at - line.to) <= tolerance_;
        if (at_end && owner == none)
          owner = *moving;
        else
          sliding.push_back(node);
      }
      if (sliding.empty() && owner != none) {
        // The line begins at the pin that slides.
        for (std::size_t node = 0; node < members_.size(); ++node)
          if (has(node, owner) && distance(nodes_.places()[node], line.from, line.to) <= tolerance_)
            sliding.push_back(node);
        owner = none;
      }
      if (sliding.empty()) {
        out_.left_out.push_back(fmt::format("the slide from {} to {} passes through no pin or end",
                                            shown_place(line.from), shown_place(line.to)));
        continue;
      }
      if (sliding.size() > 1)
        out_.questions.push_back(
            {fmt::format("the slide from {} to {} passes through {} points: which slide?",
                         shown_place(line.from), shown_place(line.to), sliding.size()),
             "each has a block"});
      if (owner == none) owner = ground();
      for (const std::size_t node : sliding) {
        const std::size_t block = add_body(SketchBodyType::block, {});
        join(block, node);
        double direction = std::arg(line.to - line.from);
        if (direction <= -pi / 2 || direction > pi / 2) direction = std::arg(line.from - line.to);
        out_.joints.push_back({JointType::prismatic, {}, owner, block, node, direction});
        slide_owners_[node].push_back(owner);
      }
    }
  }

  /// Wheels that touch are a pair of gears on the body that has points at both centres. A wheel belongs to
  /// the bar or plate at its centre that carries none of its pairs; without one it is a body of its own, or
  /// the ground on a layer such as "gear ground".
  void add_gears() {
    std::sort(wheels_.begin(), wheels_.end(), [](const DrawnWheel& a, const DrawnWheel& b) {
      return std::tuple(a.centre.real(), a.centre.imag(), a.radius) <
             std::tuple(b.centre.real(), b.centre.imag(), b.radius);
    });
    for (DrawnWheel& wheel : wheels_) wheel.node = nodes_.at(wheel.centre);
    const std::vector<MeshingWheels> pairs = meshing_wheels();
    for (std::size_t i = 0; i < wheels_.size(); ++i) give_body(i, pairs);
    for (const auto& [first, second, internal] : pairs) {
      const DrawnWheel &a = wheels_[first], &b = wheels_[second];
      if (a.body != b.body)
        out_.gears.push_back({{},
                              {a.body, b.body},
                              {a.node, b.node},
                              {a.radius, b.radius},
                              (internal ? 1 : -1) * a.radius / b.radius});
    }
  }

  /// Two wheels whose circles touch, by their indices.
  struct MeshingWheels {
    std::size_t first = 0, second = 0;
    bool internal = false;
  };

  std::vector<MeshingWheels> meshing_wheels() {
    std::vector<MeshingWheels> out;
    std::vector<bool> meshes(wheels_.size());
    for (std::size_t i = 0; i < wheels_.size(); ++i)
      for (std::size_t k = i + 1; k < wheels_.size(); ++k) {
        const DrawnWheel &a = wheels_[i], &b = wheels_[k];
        const double apart = std::abs(a.centre - b.centre);
        const double outside = std::abs(apart - a.radius - b.radius);
        const double inside = std::abs(apart - std::abs(a.radius - b.radius));
        if (a.node == b.node || std::min(outside, inside) > 10 * tolerance_) continue;
        const std::string where =
            fmt::format("the wheels around {} and {}", shown_place(a.centre), shown_place(b.centre));
        meshes[i] = meshes[k] = true;
        if (carriers(a.node, b.node).empty()) {
          out_.left_out.push_back(where + " touch, but no link or ground has points at both centres");
          continue;
        }
        if (std::min(outside, inside) > tolerance_)
          out_.questions.push_back({fmt::format("{} miss each other by {:.3g} mm: do they mesh?", where,
                                                std::min(outside, inside) * 1000),
                                    "they do"});
        out.push_back({i, k, inside < outside});
      }
    for (std::size_t i = 0; i < wheels_.size(); ++i)
      if (!meshes[i])
        out_.left_out.push_back(fmt::format("the wheel around {} touches no other wheel, and is left out",
                                            shown_place(wheels_[i].centre)));
    return out;
  }

  /// The bodies that have points at both nodes.
  std::vector<std::size_t> carriers(std::size_t first, std::size_t second) const {
    std::vector<std::size_t> out;
    for (const std::size_t body : members_[first])
      if (has(second, body)) out.push_back(body);
    return out;
  }

  void give_body(std::size_t index, const std::vector<MeshingWheels>& pairs) {
    DrawnWheel& wheel = wheels_[index];
    std::set<std::size_t> carrying;
    bool meshes = false;
    for (const MeshingWheels& pair : pairs) {
      if (pair.first != index && pair.second != index) continue;
      meshes = true;
      for (const std::size_t body : carriers(wheels_[pair.first].node, wheels_[pair.second].node))
        carrying.insert(body);
    }
    if (!meshes) return;
    const bool fixed = wheel.layer.find("ground") != std::string::npos;
    if (fixed) {
      wheel.body = ground();
      join(wheel.body, wheel.node);
      return;
    }
    const auto same = std::find_if(wheels_.begin(), wheels_.begin() + static_cast<std::ptrdiff_t>(index),
                                   [&](const DrawnWheel& other) {
                                     return other.node == wheel.node && other.layer == wheel.layer &&
                                            wheel.layer.size() > std::string_view("gear").size();
                                   });
    if (same != wheels_.begin() + static_cast<std::ptrdiff_t>(index)) {
      wheel.body = same->body;
      return;
    }
    std::vector<std::size_t> at;
    for (const std::size_t body : members_[wheel.node])
      if (carrying.count(body) == 0 &&
          (out_.bodies[body].type == SketchBodyType::bar || out_.bodies[body].type == SketchBodyType::plate))
        at.push_back(body);
    if (at.size() > 1)
      out_.questions.push_back({fmt::format("{} links meet at the centre {} of a wheel: which turns with it?",
                                            at.size(), shown_place(wheel.centre)),
                                "the first by its place"});
    wheel.body = at.empty() ? add_body(SketchBodyType::wheel, {}) : at.front();
    join(wheel.body, wheel.node);
  }

  /// The ground; made where the drawing has none.
  std::size_t ground() {
    if (out_.bodies.empty() || out_.bodies[0].type != SketchBodyType::ground) {
      // The ground is the first body: all others move up by one.
      out_.bodies.insert(out_.bodies.begin(), {SketchBodyType::ground, {}, {}});
      edges_.insert(edges_.begin(), std::vector<Segment>{});
      for (auto& members : members_)
        for (std::size_t& body : members) ++body;
      for (auto* of_points : {&slide_owners_, &welded_})
        for (auto& [node, bodies] : *of_points)
          for (std::size_t& body : bodies) ++body;
      for (auto* joints : {&out_.joints, &welds_})
        for (SketchJoint& joint : *joints) ++joint.first, ++joint.second;
      for (DrawnWheel& wheel : wheels_) ++wheel.body;
    }
    return 0;
  }

  /// One pin for each neighbouring pair of the bodies that meet at a point; a wheel turns about the first.
  void add_pins() {
    std::vector<SketchJoint> pins;
    for (std::size_t node = 0; node < members_.size(); ++node) {
      std::vector<std::size_t> bodies = members_[node];
      std::sort(bodies.begin(), bodies.end());
      for (std::size_t i = 1; i < bodies.size(); ++i)
        pins.push_back({JointType::revolute,
                        {},
                        out_.bodies[bodies[i]].type == SketchBodyType::wheel ? bodies[0] : bodies[i - 1],
                        bodies[i],
                        node,
                        0});
    }
    out_.joints.insert(out_.joints.begin(), pins.begin(), pins.end());
    out_.joints.insert(out_.joints.end(), welds_.begin(), welds_.end());
  }

  void mark(const std::vector<Place>& places, std::vector<std::size_t>& out, const char* layer) {
    for (const Place& p : places) {
      const std::size_t node = nodes_.at(p);
      if (members_[node].empty())
        out_.left_out.push_back(
            fmt::format("the circle at {} on the layer {} lies on no link", shown_place(p), layer));
      else
        out.push_back(node);
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
  }

  /// Points from left to right have letters; bodies are named by their points, joints after theirs.
  void name_everything() {
    std::vector<std::size_t> index(members_.size());
    for (std::size_t node = 0; node < members_.size(); ++node) {
      index[node] = out_.points.size();
      const bool used = !members_[node].empty();
      if (!used) continue;
      const std::size_t letter = out_.points.size() % 26, round = out_.points.size() / 26;
      std::string name(1, static_cast<char>('A' + letter));
      if (round > 0) name += std::to_string(round + 1);
      out_.points.push_back({name, nodes_.places()[node]});
      std::set<std::size_t> bodies(members_[node].begin(), members_[node].end());
      for (const auto* more : {&slide_owners_, &welded_})
        if (const auto found = more->find(node); found != more->end())
          bodies.insert(found->second.begin(), found->second.end());
      for (const std::size_t body : bodies) out_.bodies[body].points.push_back(index[node]);
    }
    for (SketchJoint& joint : out_.joints) joint.point = index[joint.point];
    for (SketchGear& gear : out_.gears)
      for (std::size_t& point : gear.points) point = index[point];
    for (auto* marks : {&out_.driven, &out_.traced})
      for (std::size_t& point : *marks) point = index[point];
    sketching::name_sketch(out_);
  }

  double tolerance_;
  std::optional<SketchEnd> ends_;
  Sketch out_;
  std::vector<Outline> bodies_;
  std::map<std::string, std::vector<Segment>> loose_;  ///< lines by their layer
  std::vector<Segment> slides_, ground_;
  std::vector<DrawnWheel> wheels_;
  std::vector<Place> circles_, ground_circles_, ground_corners_, driven_, traced_;
  bool has_ground_ = false;
  Nodes nodes_;
  std::vector<std::vector<std::size_t>> members_;  ///< bodies that have a point at each node
  std::vector<std::vector<Segment>> edges_;        ///< of each body
  std::vector<SketchJoint> welds_;
  std::map<std::size_t, std::vector<std::size_t>> slide_owners_, welded_;  ///< bodies by node
};

}  // namespace

std::size_t count(const Sketch& sketch, JointType type) {
  return static_cast<std::size_t>(
      std::count_if(sketch.joints.begin(), sketch.joints.end(),
                    [&](const SketchJoint& joint) { return joint.type == type; }));
}

int mobility(const Sketch& sketch) {
  int out = 3 * (static_cast<int>(sketch.bodies.size()) - 1);
  for (const SketchJoint& joint : sketch.joints) out -= joint.type == JointType::fixed ? 3 : 2;
  return out - static_cast<int>(sketch.gears.size());
}

std::optional<std::string> unknown_point(const Sketch& sketch, const SketchAnswers& answers) {
  for (const auto* list : {&answers.ground, &answers.driven})
    for (const std::string& name : *list)
      if (!sketching::point_named(sketch, name)) return name;
  return std::nullopt;
}

Sketch sketched_linkage(const std::vector<DrawnShape>& shapes, double tolerance,
                        const SketchAnswers& answers) {
  LINKWRIGHT_REQUIRE(tolerance > 0 && std::isfinite(tolerance), "the tolerance is {} m", tolerance);
  return Reader(shapes, tolerance, answers.ends).read();
}

}  // namespace linkwright::planar
