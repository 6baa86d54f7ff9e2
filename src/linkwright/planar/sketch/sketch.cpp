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
#include "linkwright/planar/sketch/detail/sketch_draft.h"

namespace linkwright::planar {
namespace {

using sketching::distance, sketching::DrawnWheel, sketching::least_corner, sketching::left_below,
    sketching::Nodes, sketching::pieces_of, sketching::Place, sketching::Segment, sketching::shown_place,
    sketching::turn_at;

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

/// The reading of one drawing, rule by rule.
class Reader {
 public:
  Reader(const std::vector<DrawnShape>& shapes, double tolerance, std::optional<SketchEnd> ends)
      : d_{.tolerance = tolerance}, ends_(ends) {
    for (const DrawnShape& shape : shapes) take(shape);
    find_triangles();
    for (const auto& [layer, lines] : loose_)
      for (const Segment& line : lines)
        bodies_.push_back({SketchBodyType::bar, {line.from, line.to}, {line}});
    sort_bodies();
  }

  Sketch read() {
    if (bodies_.empty() && d_.wheels.empty() && d_.pulleys.empty()) return std::move(d_.out);
    std::vector<Place> places;
    for (const auto* wheels : {&d_.wheels, &d_.pulleys})
      for (const DrawnWheel& wheel : *wheels) places.push_back(wheel.centre);
    for (const Outline& body : bodies_) places.insert(places.end(), body.corners.begin(), body.corners.end());
    for (const auto* more : {&circles_, &ground_circles_, &ground_corners_, &driven_, &traced_})
      places.insert(places.end(), more->begin(), more->end());
    if (places.size() > most_sketch_places) {
      d_.out.left_out = {
          fmt::format("the drawing has {} ends, corners and circles of links; at most {} are read",
                      places.size(), most_sketch_places)};
      return std::move(d_.out);
    }
    for (const Place& p : places) d_.nodes.add(p);
    d_.nodes.join(d_.tolerance, d_.out.questions);
    add_bodies();
    attach_circles();
    attach_ends();
    add_slides();
    sketching::add_gears(d_);
    sketching::add_belts(d_);
    add_pins();
    mark(driven_, d_.out.driven, "drive");
    mark(traced_, d_.out.traced, "trace");
    name_everything();
    return std::move(d_.out);
  }

 private:
  void take(const DrawnShape& shape) {
    const Role role = role_of(shape.layer);
    if (role == Role::construction) return;
    if (role == Role::belt) {
      if (shape.radius > 0)
        d_.pulleys.push_back({shape.centre, shape.radius, shape.layer});
      else
        for (const Segment& piece : pieces_of(shape)) d_.strands.push_back(piece);
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
      d_.out.left_out.push_back(fmt::format("{} on the layer {} is not a circle; a circle marks the point",
                                            shape.name, shape.layer));
    } else if (shape.closed && shape.points.size() > 2) {
      take_plate(shape);
    } else {
      take_bars(shape);
    }
  }

  void take_wheel(const DrawnShape& shape) {
    if (shape.radius > 0)
      d_.wheels.push_back({shape.centre, shape.radius, shape.layer});
    else
      d_.out.left_out.push_back(
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
      if (std::abs(piece.to - piece.from) > 10 * d_.tolerance)
        loose_[shape.layer].push_back(piece);
      else
        d_.out.left_out.push_back(fmt::format("{} is shorter than ten times the tolerance", shape.name));
    if (pieces.size() > 1)
      d_.out.questions.push_back(
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
    const auto meet = [&](Place a, Place b) { return std::abs(a - b) <= d_.tolerance; };
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
    d_.members.resize(d_.nodes.places().size());
    if (has_ground_) d_.add_body(SketchBodyType::ground, {});
    for (const Place& p : ground_circles_) d_.join(0, d_.nodes.at(p));
    for (const Place& p : ground_corners_) d_.join(0, d_.nodes.at(p));
    for (const Outline& body : bodies_) {
      const std::size_t index = d_.add_body(body.type, body.edges);
      for (const Place& p : body.corners) d_.join(index, d_.nodes.at(p));
    }
  }

  bool on_edge(std::size_t body, Place at) const {
    return std::any_of(d_.edges[body].begin(), d_.edges[body].end(), [&](const Segment& edge) {
      return edge.straight && distance(at, edge.from, edge.to) <= d_.tolerance;
    });
  }

  /// A circle on a line is a pin or a hole of that body.
  void attach_circles() {
    std::set<std::size_t> at;
    for (const auto* places : {&circles_, &ground_circles_, &driven_, &traced_})
      for (const Place& p : *places) at.insert(d_.nodes.at(p));
    for (const std::size_t node : at)
      for (std::size_t body = 0; body < d_.out.bodies.size(); ++body)
        if (on_edge(body, d_.nodes.places()[node])) d_.join(body, node);
  }

  /// An end on the middle of another line: a pin at the ground, else a weld, about which there is a question.
  void attach_ends() {
    for (std::size_t node = 0; node < d_.members.size(); ++node) {
      const std::vector<std::size_t> ends = d_.members[node];
      if (ends.empty()) continue;
      const Place at = d_.nodes.places()[node];
      const bool on_ground = std::any_of(ground_.begin(), ground_.end(), [&](const Segment& line) {
        return distance(at, line.from, line.to) <= d_.tolerance;
      });
      if (on_ground) d_.join(0, node);
      for (std::size_t body = 0; body < d_.out.bodies.size(); ++body) {
        if (d_.has(node, body) || !on_edge(body, at)) continue;
        if (ends_ == SketchEnd::nothing) continue;
        if (ends_ == SketchEnd::pin) {
          d_.join(body, node);
          continue;
        }
        if (!ends_)
          d_.out.questions.push_back(
              {fmt::format("the line that ends at {} ends on the middle of another line, "
                           "where no circle is drawn: is it a pin, a weld or nothing?",
                           shown_place(at)),
               "a weld"});
        d_.welds.push_back({JointType::fixed, {}, body, ends.front(), node, 0});
      }
    }
    for (const SketchJoint& weld : d_.welds) d_.welded[weld.point].push_back(weld.first);
  }

  /// A line of the layer "slide" through a point: a block turns about the point and slides on the line, which
  /// belongs to the body that has a point at one of its ends, else to the ground.
  void add_slides() {
    for (const Segment& line : slides_) {
      std::vector<std::size_t> sliding;
      constexpr std::size_t none = -1;
      std::size_t owner = none;
      for (std::size_t node = 0; node < d_.members.size(); ++node) {
        const Place at = d_.nodes.places()[node];
        const auto moving =
            std::find_if(d_.members[node].begin(), d_.members[node].end(), [&](std::size_t body) {
              return d_.out.bodies[body].type == SketchBodyType::bar ||
                     d_.out.bodies[body].type == SketchBodyType::plate;
            });
        if (moving == d_.members[node].end() || distance(at, line.from, line.to) > d_.tolerance) continue;
        const bool at_end =
            std::abs(at - line.from) <= d_.tolerance || std::abs(at - line.to) <= d_.tolerance;
        if (at_end && owner == none)
          owner = *moving;
        else
          sliding.push_back(node);
      }
      if (sliding.empty() && owner != none) {
        // The line begins at the pin that slides.
        for (std::size_t node = 0; node < d_.members.size(); ++node)
          if (d_.has(node, owner) && distance(d_.nodes.places()[node], line.from, line.to) <= d_.tolerance)
            sliding.push_back(node);
        owner = none;
      }
      if (sliding.empty()) {
        d_.out.left_out.push_back(fmt::format("the slide from {} to {} passes through no pin or end",
                                              shown_place(line.from), shown_place(line.to)));
        continue;
      }
      if (sliding.size() > 1)
        d_.out.questions.push_back(
            {fmt::format("the slide from {} to {} passes through {} points: which slide?",
                         shown_place(line.from), shown_place(line.to), sliding.size()),
             "each has a block"});
      if (owner == none) owner = d_.ground();
      for (const std::size_t node : sliding) {
        const std::size_t block = d_.add_body(SketchBodyType::block, {});
        d_.join(block, node);
        double direction = std::arg(line.to - line.from);
        if (direction <= -pi / 2 || direction > pi / 2) direction = std::arg(line.from - line.to);
        d_.out.joints.push_back({JointType::prismatic, {}, owner, block, node, direction});
        d_.slide_owners[node].push_back(owner);
      }
    }
  }

  /// One pin for each neighbouring pair of the bodies that meet at a point; a wheel turns about the first.
  void add_pins() {
    std::vector<SketchJoint> pins;
    for (std::size_t node = 0; node < d_.members.size(); ++node) {
      std::vector<std::size_t> bodies = d_.members[node];
      std::sort(bodies.begin(), bodies.end());
      for (std::size_t i = 1; i < bodies.size(); ++i)
        pins.push_back({JointType::revolute,
                        {},
                        d_.out.bodies[bodies[i]].type == SketchBodyType::wheel ? bodies[0] : bodies[i - 1],
                        bodies[i],
                        node,
                        0});
    }
    d_.out.joints.insert(d_.out.joints.begin(), pins.begin(), pins.end());
    d_.out.joints.insert(d_.out.joints.end(), d_.welds.begin(), d_.welds.end());
  }

  void mark(const std::vector<Place>& places, std::vector<std::size_t>& out, const char* layer) {
    for (const Place& p : places) {
      const std::size_t node = d_.nodes.at(p);
      if (d_.members[node].empty())
        d_.out.left_out.push_back(
            fmt::format("the circle at {} on the layer {} lies on no link", shown_place(p), layer));
      else
        out.push_back(node);
    }
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
  }

  /// Points from left to right have letters; bodies are named by their points, joints after theirs.
  void name_everything() {
    std::vector<std::size_t> index(d_.members.size());
    for (std::size_t node = 0; node < d_.members.size(); ++node) {
      index[node] = d_.out.points.size();
      const bool used = !d_.members[node].empty();
      if (!used) continue;
      d_.out.points.push_back({sketching::letter_of(d_.out.points.size()), d_.nodes.places()[node]});
      std::set<std::size_t> bodies(d_.members[node].begin(), d_.members[node].end());
      for (const auto* more : {&d_.slide_owners, &d_.welded})
        if (const auto found = more->find(node); found != more->end())
          bodies.insert(found->second.begin(), found->second.end());
      for (const std::size_t body : bodies) d_.out.bodies[body].points.push_back(index[node]);
    }
    for (SketchJoint& joint : d_.out.joints) joint.point = index[joint.point];
    for (SketchGear& gear : d_.out.gears)
      for (std::size_t& point : gear.points) point = index[point];
    for (SketchBelt& belt : d_.out.belts)
      for (SketchPulley& pulley : belt.pulleys) pulley.point = index[pulley.point];
    for (auto* marks : {&d_.out.driven, &d_.out.traced})
      for (std::size_t& point : *marks) point = index[point];
    sketching::name_sketch(d_.out);
  }

  sketching::SketchDraft d_;
  std::optional<SketchEnd> ends_;
  std::vector<Outline> bodies_;
  std::map<std::string, std::vector<Segment>> loose_;  ///< lines by their layer
  std::vector<Segment> slides_, ground_;
  std::vector<Place> circles_, ground_circles_, ground_corners_, driven_, traced_;
  bool has_ground_ = false;
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
  for (const SketchBelt& belt : sketch.belts) out -= static_cast<int>(belt.pulleys.size()) - 1;
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
