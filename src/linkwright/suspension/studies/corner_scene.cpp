// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/suspension/studies/corner_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/math/vector3.h"
#include "linkwright/suspension/corner/detail/steering_kernel.h"
#include "linkwright/suspension/indirect/link_poses.h"

namespace linkwright::suspension {
namespace {

using study::Scene;
constexpr double tyre_width_by_diameter = 0.3;  ///< for the drawing only

class Drawing {
 public:
  Drawing(Scene& scene, const Suspension& suspension, const CornerGrid& grid)
      : scene_(scene), suspension_(suspension), grid_(grid) {
    const bool indirect = suspension.spring && !acts_directly(*suspension.spring);
    if (indirect || !suspension.rockers.empty() || !suspension.elements.empty())
      plan_ = prepare_suspension(suspension);
  }

  /// One wheel with its links. `other` is the mirrored wheel at opposite rack displacements.
  void wheel(bool other) {
    other_ = other;
    label_ = std::string(name_of((suspension_.side == Side::left) != other ? Side::left : Side::right));
    source_.clear();
    for (std::size_t rack = 0; rack < grid_.racks.size(); ++rack)
      for (std::size_t travel = 0; travel < grid_.travels.size(); ++travel)
        source_.push_back((other ? opposite(rack) : rack) * grid_.travels.size() + travel);
    centre_ = point(named("wheel centre"), [](const CornerPosition& p) { return p.place.carrier.centre; });
    handle("mechanism.wheel.centre_m", centre_);
    for (std::size_t i = 0; i < suspension_.links.size(); ++i) add(suspension_.links[i], i);
    for (const Coupler& c : suspension_.couplers) add(c);
    for (std::size_t i = 0; i < suspension_.rockers.size(); ++i) add_rocker(i);
    if (suspension_.spring) add_spring(*suspension_.spring);
    for (std::size_t i = 0; i < suspension_.elements.size(); ++i) add_element(i);
    const Vec3 axis = wheel_axis(suspension_.side, suspension_.wheel.toe, suspension_.wheel.camber);
    const int outboard = point("", [axis](const CornerPosition& p) {
      return p.place.carrier.centre + 0.1 * (p.place.carrier.rotation * axis);
    });
    const double diameter = suspension_.wheel.tyre_diameter;
    scene_.discs.push_back(
        {named("wheel"), centre_, outboard, diameter / 2, tyre_width_by_diameter * diameter});
    const int contact =
        at_sample(named("contact point"), [&](std::size_t i) { return grid_.wheels[i].contact; });
    scene_.joints.push_back({named("contact point"), contact, Scene::JointStyle::tracer});
    scene_.traces.push_back({contact, "path of the " + named("contact point"), false});
    steering_axis();
    if (grid_.half_shaft) half_shaft(*grid_.half_shaft);
    for (std::size_t i = 0; i < grid_.boxes.size() && !other; ++i)
      box(numbered("box", i, grid_.boxes.size()), grid_.boxes[i]);
    if (!other && suspension_.steering_linkage) steering_linkage(*suspension_.steering_linkage);
  }

  /// True if the other wheel has, at every rack displacement, the mirror image of a position of this one.
  bool has_opposite() const {
    if (suspension_.steering_linkage && !is_symmetric()) return false;
    return std::all_of(grid_.racks.begin(), grid_.racks.end(), [&](double r) {
      return std::any_of(grid_.racks.begin(), grid_.racks.end(), [&](double s) { return s == -r; });
    });
  }

  /// True if the steering linkage moves to the right as it moves to the left.
  bool is_symmetric() const {
    const Vec3 at = suspension_.steering_linkage->pitman_joint;
    return std::all_of(grid_.racks.begin(), grid_.racks.end(), [&](double rack) {
      const Vec3 one = kernel::steered_point(suspension_, at, rack),
                 other = kernel::steered_point(suspension_, math::mirrored(at), -rack);
      return norm(one - math::mirrored(other)) < 1e-9;
    });
  }

  void roll_centre() {
    other_ = false;
    source_.clear();
    for (std::size_t i = 0; i < grid_.positions.size(); ++i) source_.push_back(i);
    // At a rack displacement the wheels differ, and its place is that of both: it is drawn where they agree.
    const int at = at_sample("roll centre", [&](std::size_t i) {
      const WheelParameters& w = grid_.wheels[i];
      const bool centred = grid_.racks[i / grid_.travels.size()] == 0;
      return centred ? Vec3{w.contact.x, 0, w.contact.z + w.roll_centre_height} : Vec3{nan, nan, nan};
    });
    scene_.joints.push_back({"roll centre", at, Scene::JointStyle::tracer});
  }

 private:
  std::size_t opposite(std::size_t rack) const {
    const auto at = std::find(grid_.racks.begin(), grid_.racks.end(), -grid_.racks[rack]);
    return static_cast<std::size_t>(at - grid_.racks.begin());
  }
  std::string named(std::string text) const { return label_ + " " + text; }

  template <class Place>
  int at_sample(std::string name, Place&& place) {
    Scene::Point out{std::move(name), {}, {}};
    for (const std::size_t i : source_) {
      Vec3 at{nan, nan, nan};
      if (grid_.positions[i].status == Status::done) at = place(i);
      if (other_) at = math::mirrored(at);
      out.x.push_back(at.x);
      out.y.push_back(at.y);
      out.z.push_back(at.z);
    }
    const auto still = [](std::vector<double>& v) {
      if (std::all_of(v.begin(), v.end(), [&](double x) { return x == v[0]; })) v.resize(1);
    };
    const auto moves = [](const std::vector<double>& v) {
      return std::any_of(v.begin(), v.end(), [&](double x) { return x != v[0]; });
    };
    if (!out.x.empty() && !moves(out.x) && !moves(out.y) && !moves(out.z))
      still(out.x), still(out.y), still(out.z);
    scene_.points.push_back(std::move(out));
    return static_cast<int>(scene_.points.size()) - 1;
  }
  template <class Place>
  int point(std::string name, Place&& place) {
    return at_sample(std::move(name), [&](std::size_t i) { return place(grid_.positions[i]); });
  }
  int body_point(std::string name, const CornerLink& link, const Vec3& at) {
    return point(std::move(name), [=, this, moved = link.moved_by_rack](const CornerPosition& p) {
      return moved ? kernel::steered_point(suspension_, at, p.input.rack) : at;
    });
  }
  int carrier_point(std::string name, const Vec3& at) {
    const Vec3 centre = suspension_.wheel.centre;
    return point(std::move(name),
                 [=](const CornerPosition& p) { return place(p.place.carrier, at, centre); });
  }

  static std::string numbered(std::string text, std::size_t i, std::size_t count) {
    return count > 1 ? text + " " + std::to_string(i + 1) : text;
  }

  /// Adds a handle to the wheel that the study gives, not to the mirrored one.
  void handle(std::string key, int point) {
    if (!other_) scene_.handles.push_back({.key = std::move(key), .point = point});
  }
  void handle(std::size_t link, const char* list, std::size_t i, std::size_t count, int point) {
    const std::string key = fmt::format("mechanism.link[{}].{}", link, list);
    handle(count > 1 ? fmt::format("{}[{}]", key, i) : key, point);
  }

  void add(const CornerLink& link, std::size_t index) {
    std::vector<int> body, carrier;
    for (std::size_t i = 0; i < link.body.size(); ++i) {
      const std::string name = named(link.name + numbered(", body", i, link.body.size()));
      body.push_back(body_point(name, link, link.body[i]));
      scene_.joints.push_back({name, body.back(), Scene::JointStyle::ground_pivot});
      handle(index, "body_m", i, link.body.size(), body.back());
    }
    for (std::size_t i = 0; i < link.carrier.size(); ++i) {
      const std::string name = named(link.name + numbered(", carrier", i, link.carrier.size()));
      carrier.push_back(carrier_point(name, link.carrier[i]));
      scene_.joints.push_back({name, carrier.back(), Scene::JointStyle::pivot});
      handle(index, "carrier_m", i, link.carrier.size(), carrier.back());
    }
    const std::string name = named(link.name);
    const auto body_of = [&](std::vector<int> points, Scene::BodyStyle style) {
      scene_.bodies.push_back({name, std::move(points), style});
    };
    if (link.type == LinkType::SP)
      body_of({body[0], carrier[0]}, Scene::BodyStyle::damper);
    else if (carrier.empty())  // joints without a link: the arm is the carrier itself
      body_of(
          body.size() > 1 ? std::vector<int>{body[0], body[1], centre_} : std::vector<int>{body[0], centre_},
          body.size() > 1 ? Scene::BodyStyle::plate : Scene::BodyStyle::bar);
    else if (body.size() + carrier.size() == 2)
      body_of({body[0], carrier[0]}, Scene::BodyStyle::bar);
    else if (body.size() == 2 && carrier.size() == 2)
      body_of({body[0], body[1], carrier[1], carrier[0]}, Scene::BodyStyle::plate);
    else if (body.size() == 2)
      body_of({body[0], body[1], carrier[0]}, Scene::BodyStyle::plate);
    else
      body_of({body[0], carrier[0], carrier[1]}, Scene::BodyStyle::plate);
    // The carrier: from its joints to the wheel centre.
    for (const int at : carrier)
      scene_.bodies.push_back({named("carrier"), {at, centre_}, Scene::BodyStyle::bar});
  }

  void add(const Coupler& c) {
    const CornerLink& second = suspension_.links[static_cast<std::size_t>(c.second)];
    const int from = point(named(c.name + " 1"), [&](const CornerPosition& p) {
      return coupler_begin(suspension_, c, p.place, p.input.rack);
    });
    const int to =
        point(named(c.name + " 2"), [&](const CornerPosition& p) { return link_point(second, p, c.point); });
    for (const int at : {from, to})
      scene_.joints.push_back(
          {scene_.points[static_cast<std::size_t>(at)].name, at, Scene::JointStyle::pivot});
    scene_.bodies.push_back({named(c.name), {from, to}, Scene::BodyStyle::bar});
  }

  /// The position of a point fixed to a link: the frames of three of its points then and now.
  Vec3 link_point(const CornerLink& link, const CornerPosition& p, const Vec3& at) const {
    const Vec3 centre = suspension_.wheel.centre;
    std::vector<Vec3> then, now;
    for (const Vec3& b : link.body) {
      then.push_back(b);
      now.push_back(link.moved_by_rack ? kernel::steered_point(suspension_, b, p.input.rack) : b);
    }
    for (const Vec3& c : link.carrier) then.push_back(c), now.push_back(place(p.place.carrier, c, centre));
    const auto frame = [](const std::vector<Vec3>& q) {
      const Vec3 x = unit(q[1] - q[0]), z = unit(cross(x, q[2] - q[0]));
      return std::array{x, cross(z, x), z};
    };
    const auto from = frame(then), to = frame(now);
    const Vec3 d = at - then[0];
    return now[0] + dot(d, from[0]) * to[0] + dot(d, from[1]) * to[1] + dot(d, from[2]) * to[2];
  }

  /// A point of a part, as the plan of the suspension has it.
  int part_point(std::string name, const PartPoint& at) {
    return point(std::move(name),
                 [=, this](const CornerPosition& p) { return place_of(plan_, at, p.place, p.input.rack); });
  }
  /// Its counterpart at the other wheel, which has the same position.
  int mirrored_point(std::string name, const PartPoint& at) {
    return point(std::move(name), [=, this](const CornerPosition& p) {
      return math::mirrored(place_of(plan_, at, p.place, p.input.rack));
    });
  }
  /// A point on a rocker is joined to its axis.
  int joined(std::string name, const PartPoint& at) {
    const int made = part_point(std::move(name), at);
    if (at.part.kind == PartKind::rocker) {
      const auto [first, second] = axes_.at(static_cast<std::size_t>(at.part.index));
      scene_.bodies.push_back({named(suspension_.rockers[static_cast<std::size_t>(at.part.index)].name),
                               {first, second, made},
                               Scene::BodyStyle::plate});
    }
    return made;
  }

  void add_rocker(std::size_t index) {
    const Rocker& rocker = suspension_.rockers[index];
    const RockerConstants& constants = plan_.rockers[index];
    if (index == 0) axes_.clear();
    std::array<int, 2> axis{};
    for (std::size_t k = 0; k < 2; ++k) {
      const std::string name = named(rocker.name + numbered(", axis", k, 2));
      const Vec3 at = rocker.axis[k];
      axis[k] = point(name, [=](const CornerPosition&) { return at; });
      scene_.joints.push_back({name, axis[k], Scene::JointStyle::ground_pivot});
    }
    axes_.push_back(axis);
    const int outer = joined(named(rocker.name + ", end of the rod"), constants.driver),
              inner = joined(named(rocker.name + ", rod"),
                             {{PartKind::rocker, static_cast<int>(index)}, constants.rod, {}, {}});
    for (const int at : {outer, inner})
      scene_.joints.push_back(
          {scene_.points[static_cast<std::size_t>(at)].name, at, Scene::JointStyle::pivot});
    scene_.bodies.push_back({named(rocker.name + ", rod"), {outer, inner}, Scene::BodyStyle::bar});
  }

  void add_element(std::size_t index) {
    const CornerElement& element = suspension_.elements[index];
    if (element.turn) return;
    const PartPoint& moving = plan_.elements[index].second;
    const int first = element.across ? mirrored_point(named(element.name + " 1"), moving)
                                     : joined(named(element.name + " 1"), plan_.elements[index].first),
              second = joined(named(element.name + " 2"), plan_.elements[index].second);
    scene_.bodies.push_back({named(element.name),
                             {first, second},
                             element.across ? Scene::BodyStyle::spring : Scene::BodyStyle::damper});
  }

  void add_spring(const CornerSpring& spring) {
    if (!acts_directly(spring)) {
      const int first = joined(named("spring, body"), plan_.spring->first),
                second = joined(named("spring, moving end"), plan_.spring->second);
      scene_.bodies.push_back({named("spring"), {first, second}, Scene::BodyStyle::spring});
      handle("mechanism.spring.body_m", first);
      handle("mechanism.spring.moving_m", second);
      return;
    }
    const Vec3 centre = suspension_.wheel.centre;
    const int top = point(named("spring, body"), [&](const CornerPosition&) { return spring.body; });
    const int bottom = point(named("spring, moving end"), [&](const CornerPosition& p) {
      if (spring.link < 0) return place(p.place.carrier, spring.moving, centre);
      const CornerLink& link = suspension_.links[static_cast<std::size_t>(spring.link)];
      if (link.type == LinkType::US || link.type == LinkType::SS)
        return spring_end(suspension_, p.place, p.input.rack);
      return link_point(link, p, spring.moving);
    });
    scene_.bodies.push_back({named("spring"), {top, bottom}, Scene::BodyStyle::spring});
    handle("mechanism.spring.body_m", top);
    handle("mechanism.spring.moving_m", bottom);
  }

  void half_shaft(const HalfShaft& shaft) {
    const int inner =
                  point(named("half-shaft, inner joint"), [&](const CornerPosition&) { return shaft.inner; }),
              outer = carrier_point(named("half-shaft, outer joint"), shaft.outer);
    for (const int at : {inner, outer})
      scene_.joints.push_back(
          {scene_.points[static_cast<std::size_t>(at)].name, at, Scene::JointStyle::pivot});
    scene_.bodies.push_back({named("half-shaft"), {inner, outer}, Scene::BodyStyle::bar});
  }

  /// A box by its faces at the bottom and at the top, and the edges between them.
  void box(const std::string& name, const Box& at) {
    std::array<std::vector<int>, 2> faces;
    for (const bool top : {false, true})
      for (const auto& [right, front] :
           {std::pair{false, false}, {false, true}, {true, true}, {true, false}}) {
        const Vec3 corner{front ? at.upper.x : at.lower.x, right ? at.lower.y : at.upper.y,
                          top ? at.upper.z : at.lower.z};
        faces[top].push_back(point("", [corner](const CornerPosition&) { return corner; }));
      }
    for (const std::vector<int>& face : faces) scene_.bodies.push_back({name, face, Scene::BodyStyle::plate});
    for (std::size_t k = 0; k < 4; ++k)
      scene_.bodies.push_back({name, {faces[0][k], faces[1][k]}, Scene::BodyStyle::bar});
  }

  void steering_linkage(const SteeringLinkage& linkage) {
    const auto fixed = [&](const char* name, const Vec3& at) {
      const int made = point(name, [at](const CornerPosition&) { return at; });
      scene_.joints.push_back({name, made, Scene::JointStyle::ground_pivot});
      return made;
    };
    const auto moved = [&](const char* name, const Vec3& at) {
      const int made = point(name, [at, this](const CornerPosition& p) {
        return kernel::steered_point(suspension_, at, p.input.rack);
      });
      scene_.joints.push_back({name, made, Scene::JointStyle::pivot});
      return made;
    };
    const int pitman = fixed("Pitman arm, pivot", linkage.pitman_pivot),
              idler = fixed("idler arm, pivot", linkage.idler_pivot),
              first = moved("Pitman arm, joint", linkage.pitman_joint),
              second = moved("idler arm, joint", linkage.idler_joint);
    scene_.bodies.push_back({"Pitman arm", {pitman, first}, Scene::BodyStyle::bar});
    scene_.bodies.push_back({"idler arm", {idler, second}, Scene::BodyStyle::bar});
    scene_.bodies.push_back({"centre link", {first, second}, Scene::BodyStyle::bar});
  }

  void steering_axis() {
    const auto axis = [&](std::size_t i) { return steering_axis_of(grid_.wheels[i], grid_.lock); };
    if (std::none_of(source_.begin(), source_.end(), axis)) return;
    const double size = suspension_.wheel.tyre_diameter;
    const int ground = at_sample(named("steering axis at the ground"), [&](std::size_t i) {
      return axis(i) ? axis(i)->ground : Vec3{nan, nan, nan};
    });
    const int top = at_sample("", [&](std::size_t i) {
      return axis(i) ? axis(i)->ground + size * axis(i)->direction : Vec3{nan, nan, nan};
    });
    scene_.joints.push_back({named("steering axis at the ground"), ground, Scene::JointStyle::tracer});
    scene_.bodies.push_back({named("steering axis"), {ground, top}, Scene::BodyStyle::axis});
  }

  Scene& scene_;
  const Suspension& suspension_;
  CornerPlan plan_;  ///< where there are rockers or elements
  const CornerGrid& grid_;
  std::vector<std::array<int, 2>> axes_;  ///< points of the axes of the rockers
  bool other_ = false;
  std::string label_;
  int centre_ = 0;
  std::vector<std::size_t> source_;
};

}  // namespace

study::Scene corner_scene(const Suspension& suspension, std::string name, std::string title,
                          const CornerGrid& grid) {
  Scene scene;
  scene.name = std::move(name);
  scene.title = std::move(title);
  scene.input_key = "travel_m";
  scene.input_label = "travel";
  scene.input.assign(grid.travels.begin(), grid.travels.end());
  if (grid.racks.size() > 1 || (grid.racks.size() == 1 && grid.racks[0] != 0)) {
    scene.second_key = "rack_m";
    scene.second_label = "rack";
    scene.second.assign(grid.racks.begin(), grid.racks.end());
  }
  bool all = true;
  for (const CornerPosition& p : grid.positions) {
    scene.status.emplace_back(to_string(p.status));
    all = all && p.status == Status::done;
  }
  if (all) scene.status.clear();
  Drawing drawing(scene, suspension, grid);
  drawing.wheel(false);
  if (suspension.wheel.centre.y != 0 && drawing.has_opposite()) {
    drawing.wheel(true);
    drawing.roll_centre();
  }
  return scene;
}

}  // namespace linkwright::suspension
