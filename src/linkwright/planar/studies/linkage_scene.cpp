// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/linkage_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <string_view>
#include <tuple>
#include <variant>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/link_mass.h"
#include "linkwright/planar/linkage/columns.h"
#include "linkwright/planar/linkage/detail/cam_follower.h"
#include "linkwright/planar/linkage/detail/pair_rows.h"
#include "linkwright/planar/linkage/kernel.h"
#include "linkwright/planar/linkage/open_pose.h"

namespace linkwright::planar {
namespace {

// Corners of the convex hull in order; two points when all lie on a line.
std::vector<int> hull(const std::vector<LinkagePoint>& points) {
  std::vector<int> order(points.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  const auto where = [&](int i) { return math::vec(points[at(i)].at); };
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::pair(where(a).x, where(a).y) < std::pair(where(b).x, where(b).y);
  });
  order.erase(
      std::unique(order.begin(), order.end(), [&](int a, int b) { return norm(where(a) - where(b)) == 0; }),
      order.end());
  if (order.size() < 3) return order;
  double size = 0;
  for (int i : order) size = std::max(size, norm(where(i) - where(order[0])));
  const auto half = [&](auto from, auto to) {
    std::vector<int> out;
    for (auto i = from; i != to; ++i) {
      while (out.size() >= 2 && cross(where(out.back()) - where(out[out.size() - 2]),
                                      where(*i) - where(out.back())) <= 1e-9 * size * size)
        out.pop_back();
      out.push_back(*i);
    }
    return out;
  };
  std::vector<int> lower = half(order.begin(), order.end()), upper = half(order.rbegin(), order.rend());
  lower.pop_back();
  upper.pop_back();
  lower.insert(lower.end(), upper.begin(), upper.end());
  return lower;
}

class Artist {
 public:
  Artist(const Linkage& l, const LinkagePlan& plan, const std::vector<LinkageRecord>& records)
      : l_(l), plan_(plan), records_(records) {}

  study::Scene draw(const std::vector<BodyPoint>& traces, std::string key, std::string label) {
    scene_.name = "motion";
    scene_.input_key = std::move(key);
    scene_.input_label = std::move(label);
    for (const LinkageRecord& r : records_) {
      scene_.input.push_back(r.input);
      scene_.status.emplace_back(to_string(r.status));
    }
    points();
    bodies();
    joints();
    wheels();
    belts();
    cams();
    slots();
    springs();
    masses();
    gaps();
    for (const BodyPoint& t : traces) trace(t);
    forces();
    handles();
    return std::move(scene_);
  }

 private:
  using Style = study::Scene::BodyStyle;
  bool moves(int body) const { return plan_.bodies[at(body)].part != 0; }

  // A point that is given per record, or once for a fixed body.
  int add_point(std::string name, int body, const std::function<math::Vec2(const LinkageRecord&)>& where) {
    study::Scene::Point p{std::move(name), {}, {}};
    for (const LinkageRecord& r : records_) {
      const math::Vec2 v = r.bodies.empty() ? math::Vec2{nan, nan} : where(r);
      if (!moves(body) && std::isnan(v.x)) continue;
      p.x.push_back(v.x);
      p.y.push_back(v.y);
      if (!moves(body)) break;
    }
    scene_.points.push_back(std::move(p));
    return static_cast<int>(scene_.points.size()) - 1;
  }
  int add_point(std::string name, int body, std::complex<double> there) {
    return add_point(std::move(name), body,
                     [=](const LinkageRecord& r) { return point_on(r.bodies[at(body)], math::vec(there)); });
  }
  int point(const BodyPoint& p) const { return first_[at(p.body)] + p.point; }

  void points() {
    for (int b = 0; b < static_cast<int>(l_.bodies.size()); ++b) {
      first_.push_back(static_cast<int>(scene_.points.size()));
      for (const LinkagePoint& p : l_.bodies[at(b)].points) add_point(p.name, b, p.at);
    }
  }

  void bodies() {
    for (int b = 0; b < static_cast<int>(l_.bodies.size()); ++b) {
      const LinkageBody& body = l_.bodies[at(b)];
      if (body.points.empty()) continue;
      std::vector<int> corners;
      if (b == 0) {
        for (std::size_t i = 0; i < body.points.size(); ++i) corners.push_back(static_cast<int>(i));
      } else {
        corners = hull(body.points);
      }
      if (b != 0 && corners.size() < 2) {
        block(b, body.points[0].at);
        continue;
      }
      for (int& c : corners) c += first_[at(b)];
      const Style style = b == 0 ? Style::ground : corners.size() > 2 ? Style::plate : Style::bar;
      scene_.bodies.push_back({body.name, std::move(corners), style});
    }
  }
  // A body of one point, drawn as a block along its slide.
  void block(int b, std::complex<double> centre) {
    double direction = 0;
    for (const LinkageJoint& j : l_.joints)
      if (j.type == JointType::prismatic) {
        if (j.second.body == b) direction = j.slide_second;
        if (j.first.body == b) direction = j.slide_first;
      }
    const std::complex<double> e = std::polar(1.0, direction), n = std::complex<double>(0, 1) * e;
    const double a = 0.06 * plan_.size, h = 0.035 * plan_.size;
    std::vector<int> corners;
    for (const auto& [x, y] : {std::pair{-a, -h}, std::pair{a, -h}, std::pair{a, h}, std::pair{-a, h}})
      corners.push_back(add_point("", b, centre + x * e + y * n));
    scene_.bodies.push_back({l_.bodies[at(b)].name, std::move(corners), Style::plate});
  }

  void joints() {
    using Joint = study::Scene::JointStyle;
    for (const LinkageJoint& j : l_.joints) {
      if (j.type == JointType::revolute) {
        const bool ground = !moves(j.first.body) || !moves(j.second.body);
        scene_.joints.push_back({j.name, point(moves(j.first.body) ? j.second : j.first),
                                 ground ? Joint::ground_pivot : Joint::pivot});
      } else if (j.type == JointType::pin_in_slot) {
        scene_.joints.push_back({j.name, point(j.second), Joint::pivot});
        j.slot ? curved_guide(j) : guide(j);
      } else if (j.type == JointType::prismatic && (!moves(j.first.body) || !moves(j.second.body))) {
        guide(j);
      } else if (j.type == JointType::rack) {
        circle(j.name + " pinion", j.first.body, place_of(l_, j.first), std::abs(j.radius));
        guide(j);
      }
    }
  }
  // The middle line of a curved slot, on its body.
  void curved_guide(const LinkageJoint& j) {
    constexpr int corners = 37;
    std::vector<int> line;
    for (const math::Vec2& p : SlotTrack(*j.slot).points(corners))
      line.push_back(add_point("", j.first.body, number(p)));
    if (j.slot->is_closed()) line.push_back(line.front());
    scene_.bodies.push_back({j.name + " slot", std::move(line), Style::guide});
  }
  // The pitch circle of a wheel, or the way of a belt over it.
  void circle(std::string name, int body, std::complex<double> centre, double radius) {
    const int middle = add_point("", body, centre);
    scene_.circles.push_back({std::move(name), middle, add_point("", body, centre + radius)});
  }
  // The pitch circles of gears, as far as their wheels have pins that show the radii.
  void wheels() {
    for (const Group& g : plan_.groups)
      for (const PlanGear& gear : g.gears) {
        if (!gear.mesh) continue;
        const LinkageJoint& j = l_.joints[at(gear.joint)];
        for (const auto& [body, wheel, radius] :
             {std::tuple{j.first.body, &gear.mesh->first, gear.mesh->first_radius},
              std::tuple{j.second.body, &gear.mesh->second, gear.mesh->second_radius}}) {
          const BodyOnPart& on = plan_.bodies[at(body)];
          circle(fmt::format("{} of {}", j.name, l_.bodies[at(body)].name), body,
                 number(rotate_inverse(on.turn, wheel->at - on.origin)), std::abs(radius));
        }
      }
  }
  // The wheels of belts, and their strands from wheel to wheel.
  void belts() {
    for (const Belt& belt : l_.belts)
      for (const BeltWheel& wheel : belt.wheels)
        if (wheel.radius > 0)
          circle(fmt::format("{} on {}", belt.name, l_.bodies[at(wheel.centre.body)].name), wheel.centre.body,
                 place_of(l_, wheel.centre), wheel.radius);
    std::vector<int> wheel(l_.belts.size(), 0);
    for (const PlanStrand& strand : plan_.strands) {
      const Belt& belt = l_.belts[at(strand.belt)];
      const std::size_t from = at(wheel[at(strand.belt)]++), to = (from + 1) % belt.wheels.size();
      const auto line = [&belt, from, to, this](const LinkageRecord& r) {
        const auto centre = [&](const BeltWheel& w) {
          return point_on(r.bodies[at(w.centre.body)], math::vec(place_of(l_, w.centre)));
        };
        const BeltWheel &a = belt.wheels[from], &b = belt.wheels[to];
        return strand_line(centre(a), a.side * a.radius, centre(b), b.side * b.radius);
      };
      const int moving = moves(strand.first) ? strand.first : strand.second;
      const int a = add_point("", moving, [&](const LinkageRecord&r) { return line(r).first; }),
                b = add_point("", moving, [&](const LinkageRecord&r) { return line(r).second; });
      scene_.bodies.push_back({belt.name, {a, b}, Style::guide});
    }
  }
  // The slots of Geneva wheels, from where the pin enters to where it turns back.
  void slots() {
    const auto first = std::find_if(records_.begin(), records_.end(),
                                    [](const LinkageRecord& r) { return !r.bodies.empty(); });
    if (first == records_.end()) return;
    for (const Group& g : plan_.groups)
      for (const PlanPair& pair : g.pairs)
        if (const auto* curve = std::get_if<CurvePair>(&pair.kind); curve && curve->geneva && curve->mesh)
          wheel_slots(*curve, l_.joints[at(pair.joint)], *first);
  }
  void wheel_slots(const CurvePair& pair, const LinkageJoint& j, const LinkageRecord& r) {
    const int wheel = j.second.body;
    const auto on_body = [&](int body, const PartPoint& p) {
      const BodyOnPart& on = plan_.bodies[at(body)];
      return rotate_inverse(on.turn, p.at - on.origin);
    };
    const math::Vec2 axis = on_body(wheel, pair.mesh->second);
    const math::Vec2 to_crank =
        point_on(r.bodies[at(j.first.body)], on_body(j.first.body, pair.mesh->first)) -
        point_on(r.bodies[at(wheel)], axis);
    const BodyOnPart &carrier = plan_.bodies[at(j.carrier)], &on = plan_.bodies[at(wheel)];
    // In the frame of the wheel when a slot lies along the line of the axes.
    const double along = angle_of(rotate_inverse(
                             rotate(r.bodies[at(j.carrier)].direction, conjugate(carrier.turn)), to_crank)) +
                         pair.second_offset - angle_of(on.turn);
    const GenevaSlots& slots = *pair.geneva;
    const double distance = norm(to_crank), crank = geneva_crank(slots, distance),
                 entry = distance * std::cos(pi / slots.count),
                 end = slots.internal ? distance + crank : distance - crank;
    for (int k = 0; k < slots.count; ++k) {
      const math::Vec2 direction = math::unit(along + full_turn * k / slots.count);
      const int a = add_point("", wheel, number(axis + entry * direction)),
                b = add_point("", wheel, number(axis + end * direction));
      scene_.bodies.push_back({fmt::format("slot {} of {}", k + 1, j.name), {a, b}, Style::guide});
    }
  }
  // The contours of cams, on their bodies, and what runs on them.
  void cams() {
    std::vector<double> offsets;
    for (const CamPair& pair : plan_.cams) offsets.push_back(pair.offset);
    for (std::size_t k = 0; k < l_.cams.size(); ++k) {
      const int cam = static_cast<int>(k);
      CamFollower follower(l_, cam, offsets);
      disc(k, l_.cams[k], follower, plan_.cams[k].roller, "");
      if (l_.cams[k].form != CamForm::conjugate) continue;
      const Linkage other = with_second_roller(l_, cam);
      CamFollower second(other, cam, offsets);
      disc(k, other.cams[k], second, plan_.cams[k].second_roller, " second disc");
    }
  }
  void disc(std::size_t k, const LinkageCam& cam, CamFollower& follower, double roller, const char* of) {
    constexpr int corners = 180;
    const CamPair& pair = plan_.cams[k];
    const double whole = pair.programme.breaks().back();
    const BodyOnPart& on = plan_.bodies[at(pair.cam_body)];
    const math::Vec2 centre = rotate_inverse(on.turn, pair.cam.at - on.origin),
                     turned = math::unit(pair.sense * pair.phase);
    const bool is_groove = cam.form == CamForm::groove;
    std::vector<int> inner, outer;
    double low = 0, high = 0;
    for (int c = 0; c < corners; ++c) {
      const double angle = whole * c / corners;
      const CamState state = follower.contour(pair.offset, pair.programme(angle), angle);
      const auto corner = [&](const math::Vec2& place) {
        return add_point("", pair.cam_body, number(centre + rotate(turned, place)));
      };
      inner.push_back(corner(state.profile));
      if (is_groove) outer.push_back(corner(state.pitch + roller * state.normal));
      if (pair.is_flat && std::isfinite(state.contact))
        low = std::min(low, state.contact), high = std::max(high, state.contact);
    }
    if (is_groove) scene_.bodies.push_back({cam.name + " outer flank", std::move(outer), Style::plate});
    if (cam.programme.is_sector) inner.push_back(add_point("", pair.cam_body, number(centre)));
    scene_.bodies.push_back({cam.name + of, std::move(inner), Style::plate});
    const std::complex<double> touch = place_of(l_, cam.contact);
    if (roller > 0) circle(cam.name + of + " roller", cam.contact.body, touch, roller);
    if (!pair.is_flat) return;
    const double margin = 0.05 * (high - low) + 0.02 * plan_.size;
    const std::complex<double> along = std::polar(1.0, cam.face_direction);
    const int left = add_point("", cam.contact.body, touch + (low - margin) * along),
              right = add_point("", cam.contact.body, touch + (high + margin) * along);
    scene_.bodies.push_back({cam.name + " face", {left, right}, Style::bar});
  }
  void contact_forces() {
    for (std::size_t k = 0; k < l_.cams.size(); ++k) {
      const LinkageCam& cam = l_.cams[k];
      study::Scene::Vector v{
          .name = fmt::format("contact of {}, {} on {}", cam.name, l_.bodies[at(plan_.cams[k].cam_body)].name,
                              l_.bodies[at(cam.contact.body)].name),
          .quantity = study::Scene::Quantity::force,
          .unit = "N",
          .point = add_point("", cam.contact.body,
                             [k](const LinkageRecord& r) {
                               return k < r.cams.size() ? r.cams[k].point : math::Vec2{nan, nan};
                             }),
          .symbol = cam.name};
      for (const LinkageRecord& r : records_) {
        const math::Vec2 f = k < r.cams.size() ? r.cams[k].force * r.cams[k].normal : math::Vec2{nan, nan};
        v.x.push_back(f.x), v.y.push_back(f.y);
      }
      scene_.vectors.push_back(std::move(v));
    }
  }
  // The line of a slide, as long as what runs on it needs.
  void guide(const LinkageJoint& j) {
    const bool on_first =
        j.type != JointType::rack && (!moves(j.first.body) || j.type == JointType::pin_in_slot);
    const BodyPoint &base = on_first ? j.first : j.second, &runner = on_first ? j.second : j.first;
    const std::complex<double> start = place_of(l_, base);
    const math::Vec2 along = math::unit(on_first ? j.slide_first : j.slide_second);
    double low = 0, high = 0;
    bool any = false;
    for (const LinkageRecord& r : records_) {
      if (r.bodies.empty()) continue;
      const PartState<double>& s = r.bodies[at(base.body)];
      const math::Vec2 there = point_on(r.bodies[at(runner.body)], math::vec(place_of(l_, runner)));
      const double way = dot(along, rotate_inverse(s.direction, there - s.origin) - math::vec(start));
      if (std::isnan(way)) continue;
      low = any ? std::min(low, way) : way;
      high = any ? std::max(high, way) : way;
      any = true;
    }
    const double margin = 0.08 * plan_.size;
    const auto end = [&](double way) { return add_point("", base.body, start + number(way * along)); };
    const int a = end(low - margin), b = end(high + margin);
    scene_.bodies.push_back(
        {j.name + (j.type == JointType::rack ? " pitch line" : " guide"), {a, b}, Style::guide});
  }

  void springs() {
    for (const LinearSpring& s : l_.springs)
      scene_.bodies.push_back(
          {s.name, {point(s.first), point(s.second)}, s.stiffness > 0 ? Style::spring : Style::damper});
    for (const Strut& s : l_.struts)
      scene_.bodies.push_back(
          {s.name, {point(s.first), point(s.second)}, s.cylinder ? Style::damper : Style::spring});
  }

  int point_named(int body, std::string_view name) const {
    return body < 0 ? -1 : point_index(l_.bodies[at(body)], name);
  }
  /// True if a drive turns a body against the ground.
  bool driven(int body) const {
    return std::any_of(l_.driven.begin(), l_.driven.end(), [&](int k) {
      const LinkageJoint& j = l_.joints[at(k)];
      return (j.first.body == body && j.second.body == 0) || (j.second.body == body && j.first.body == 0);
    });
  }

  // Handles of four-bars and slider-cranks by their parameters: by the names that their bodies and points
  // have.
  void parameter_handles() {
    using Measure = study::Scene::Handle::Measure;
    struct Parameter {
      const char *key, *body, *point;
      Measure measure;
      const char* from = "";
    };
    constexpr Parameter parameters[] = {
        {"crank_m", "crank", "O2", Measure::length, "O1"},
        {"coupler_m", "coupler", "O3", Measure::length, "O2"},
        {"rocker_m", "rocker", "O3", Measure::length, "O4"},
        {"ground_m", "ground", "O4", Measure::length, "O1"},
        {"frame_angle_rad", "ground", "O4", Measure::angle, "O1"},
        {"pivot_x_m", "ground", "O1", Measure::x},
        {"pivot_y_m", "ground", "O1", Measure::y},
        {"coupler_u_m", "coupler", "C", Measure::x, "O3"},
        {"coupler_v_m", "coupler", "C", Measure::y, "O3"},
        {"crank_m", "crank", "A", Measure::length, "O"},
        {"rod_m", "rod", "B", Measure::length, "A"},
        {"offset_m", "slider", "B", Measure::y},
        {"pivot_x_m", "ground", "O", Measure::x},
        {"pivot_y_m", "ground", "O", Measure::y},
        {"rod_u_m", "rod", "C", Measure::x, "B"},
        {"rod_v_m", "rod", "C", Measure::y, "B"},
    };
    for (const Parameter& p : parameters) {
      const int body = body_index(l_, p.body), there = point_named(body, p.point);
      const int other = point_named(body, p.from);
      if (there < 0 || (*p.from && other < 0)) continue;
      study::Scene::Handle handle{.key = fmt::format("mechanism.parameters.{}", p.key),
                                  .measure = p.measure,
                                  .point = first_[at(body)] + there};
      if (p.measure == Measure::length || p.measure == Measure::angle) {
        handle.from = first_[at(body)] + other;
        handle.held = p.measure == Measure::length && driven(body);
      } else if (body != 0) {
        // Along the line of the link, or along the guide.
        const auto& points = l_.bodies[at(body)].points;
        handle.frame = *p.from ? turned_frame(body, std::arg(points[at(other)].at)) : guide_frame();
        if (handle.frame < 0) continue;
      }
      scene_.handles.push_back(std::move(handle));
    }
  }
  /// The frame of a body, turned in it; index of the new frame.
  int turned_frame(int body, double angle) {
    study::Scene::Frame frame = scene_.frames[at(body)];
    for (double& a : frame.angle) a += angle;
    scene_.frames.push_back(std::move(frame));
    return static_cast<int>(scene_.frames.size()) - 1;
  }
  /// Index of the frame of a slider-crank's guide, in which the offset is measured; -1 = there is none.
  int guide_frame() {
    const int pivot = point_named(0, "O"), joint = joint_index(l_, "guide");
    if (pivot < 0 || joint < 0) return -1;
    const std::complex<double> origin = l_.bodies[0].points[at(pivot)].at;
    scene_.frames.push_back({{origin.real()}, {origin.imag()}, {l_.joints[at(joint)].slide_first}});
    return static_cast<int>(scene_.frames.size()) - 1;
  }

  // Every point of a body, in the frame of the body. What a study does not say by these keys is left out
  // where the scene is shown.
  void handles() {
    for (int b = 0; b < static_cast<int>(l_.bodies.size()); ++b) {
      study::Scene::Frame frame;
      for (const LinkageRecord& r : records_) {
        if (r.bodies.empty() && !moves(b)) continue;
        const math::Vec2 none{nan, nan};
        const math::Vec2 origin = r.bodies.empty() ? none : r.bodies[at(b)].origin;
        const math::Vec2 direction = r.bodies.empty() ? none : r.bodies[at(b)].direction;
        frame.x.push_back(origin.x);
        frame.y.push_back(origin.y);
        frame.angle.push_back(std::atan2(direction.y, direction.x));
        if (!moves(b)) break;
      }
      scene_.frames.push_back(std::move(frame));
      const auto& points = l_.bodies[at(b)].points;
      for (std::size_t i = 0; i < points.size(); ++i)
        scene_.handles.push_back({.key = fmt::format("mechanism.body[{}].points_m.{}", b, points[i].name),
                                  .frame = b,
                                  .point = first_[at(b)] + static_cast<int>(i)});
    }
    parameter_handles();
  }

  // Draws the gaps of loops that do not close, a line for each group that fails somewhere.
  void gaps() {
    std::vector<int> open;
    for (const LinkageRecord& r : records_)
      if (r.open_group >= 0 && std::find(open.begin(), open.end(), r.open_group) == open.end())
        open.push_back(r.open_group);
    for (const int group : open) {
      std::vector<int> ends;
      for (const std::size_t end : {0u, 1u}) {
        study::Scene::Point p;
        for (const LinkageRecord& r : records_) {
          const math::Vec2 v = r.open_group == group ? r.gap[end] : math::Vec2{nan, nan};
          p.x.push_back(v.x), p.y.push_back(v.y);
        }
        ends.push_back(static_cast<int>(scene_.points.size()));
        scene_.points.push_back(std::move(p));
      }
      scene_.bodies.push_back(
          {fmt::format("{} cannot close", plan_.groups[at(group)].name), std::move(ends), Style::gap});
    }
  }

  // Counterweights and payloads.
  void masses() {
    for (int b = 1; b < static_cast<int>(l_.bodies.size()); ++b) {
      const LinkageBody& body = l_.bodies[at(b)];
      for (std::size_t k = 0; k < body.attached.size(); ++k) {
        const AttachedMass& m = body.attached[k];
        if (!(m.mass > 0)) continue;
        const std::string name =
            fmt::format("{}, {:.4g} kg", m.name.empty() ? "mass on " + body.name : m.name, m.mass);
        const int centre = add_point("", b, m.at);
        scene_.circles.push_back({name, centre, add_point("", b, m.at + drawn_radius(m.mass))});
        scene_.handles.push_back(
            {.key = fmt::format("mechanism.body[{}].attached[{}].at_m", b, k), .frame = b, .point = centre});
        if (!body.points.empty()) scene_.bodies.push_back({name, {first_[at(b)], centre}, Style::bar});
      }
    }
  }

  void trace(const BodyPoint& t) {
    const LinkageBody& body = l_.bodies[at(t.body)];
    const std::string name = body.points[at(t.point)].name;
    // The pin that is there already has the name.
    const auto here = [&](const BodyPoint& p) { return p.body == t.body && p.point == t.point; };
    const bool pinned = std::any_of(l_.joints.begin(), l_.joints.end(), [&](const LinkageJoint& j) {
      return j.type == JointType::revolute && j.name == name && (here(j.first) || here(j.second));
    });
    if (!pinned) scene_.joints.push_back({name, point(t), study::Scene::JointStyle::tracer});
    const study::Scene::Point& p = scene_.points[at(point(t))];
    const bool closed =
        p.x.size() > 2 && std::hypot(p.x.front() - p.x.back(), p.y.front() - p.y.back()) < 1e-9 * plan_.size;
    scene_.traces.push_back({point(t), "path of " + body.name + "." + name, closed});
    study::Scene::Vector v{.name = "velocity of " + body.name + "." + name,
                           .quantity = study::Scene::Quantity::velocity,
                           .unit = "m/s",
                           .point = point(t)};
    study::Scene::Vector a{.name = "acceleration of " + body.name + "." + name,
                           .quantity = study::Scene::Quantity::acceleration,
                           .unit = "m/s2",
                           .point = point(t)};
    for (const LinkageRecord& r : records_) {
      math::Vec2 speed{nan, nan}, change{nan, nan};
      if (!r.bodies.empty()) {
        const PartState<double>& s = r.bodies[at(t.body)];
        const math::Vec2 there = point_on(s, math::vec(body.points[at(t.point)].at));
        speed = velocity_at(s, there);
        change = acceleration_at(s, there);
      }
      v.x.push_back(speed.x), v.y.push_back(speed.y);
      a.x.push_back(change.x), a.y.push_back(change.y);
    }
    scene_.vectors.push_back(std::move(v));
    scene_.vectors.push_back(std::move(a));
  }

  void forces() {
    const bool any = std::any_of(records_.begin(), records_.end(),
                                 [](const LinkageRecord& r) { return !r.joints.empty(); });
    if (!any) return;
    for (std::size_t j = 0; j < l_.joints.size(); ++j) {
      const LinkageJoint& joint = l_.joints[j];
      if (has_teeth(joint.type)) continue;
      study::Scene::Vector v{
          .name = fmt::format("force at {}, {} on {}", joint.name, l_.bodies[at(joint.first.body)].name,
                              l_.bodies[at(joint.second.body)].name),
          .quantity = study::Scene::Quantity::force,
          .unit = "N",
          .point = point(joint.second),
          .symbol = joint.name};
      for (const LinkageRecord& r : records_) {
        const math::Vec2 f = r.joints.empty() ? math::Vec2{nan, nan} : r.joints[j].force;
        v.x.push_back(f.x), v.y.push_back(f.y);
      }
      scene_.vectors.push_back(std::move(v));
    }
    contact_forces();
    loads();
    shaking_force();
    for (std::size_t k = 0; k < l_.driven.size(); ++k) {
      const LinkageJoint& joint = l_.joints[at(l_.driven[k])];
      if (joint.type != JointType::revolute) continue;
      study::Scene::Moment m{
          .name = "drive torque at " + joint.name, .unit = "N m", .point = point(joint.second)};
      double largest = 0, force = 0;
      for (const LinkageRecord& r : records_) {
        m.value.push_back(r.drives.empty() ? nan : r.drives[k]);
        if (!r.drives.empty()) largest = std::max(largest, std::abs(r.drives[k]));
        for (const JointReaction& joint_force : r.joints) force = std::max(force, norm(joint_force.force));
      }
      // A free joint has no drive: what is left of its torque is rounding.
      if (!(largest > 1e-9 * force * plan_.size)) continue;
      scene_.moments.push_back(std::move(m));
    }
  }

  void loads() {
    const auto load = [](const LinkageRecord& r, std::size_t k) {
      return k < r.loads.size() ? r.loads[k] : AppliedLoad{.force = {nan, nan}, .torque = nan};
    };
    for (std::size_t k = 0; k < l_.forces.size(); ++k) {
      const PointForce& f = l_.forces[k];
      study::Scene::Vector v{.name = fmt::format("{}, load on {}", f.name, l_.bodies[at(f.point.body)].name),
                             .quantity = study::Scene::Quantity::force,
                             .unit = "N",
                             .point = point(f.point),
                             .symbol = f.name};
      for (const LinkageRecord& r : records_) {
        const math::Vec2 force = load(r, k).force;
        v.x.push_back(force.x), v.y.push_back(force.y);
      }
      scene_.vectors.push_back(std::move(v));
    }
    for (std::size_t k = 0; k < l_.torques.size(); ++k) {
      const BodyTorque& t = l_.torques[k];
      const LinkageBody& body = l_.bodies[at(t.body)];
      if (body.points.empty()) continue;
      study::Scene::Moment m{.name = fmt::format("{}, load on {}", t.name, body.name),
                             .unit = "N m",
                             .point = first_[at(t.body)],
                             .symbol = t.name};
      for (const LinkageRecord& r : records_) m.value.push_back(load(r, l_.forces.size() + k).torque);
      scene_.moments.push_back(std::move(m));
    }
  }

  // In the middle of the joints of the ground: where its line of action lies the shaking moment says.
  void shaking_force() {
    std::complex<double> sum;
    double count = 0;
    for (const LinkageJoint& j : l_.joints)
      for (const BodyPoint& p : {j.first, j.second})
        if (p.body == 0 && j.type != JointType::gear) sum += l_.bodies[0].points[at(p.point)].at, ++count;
    if (count == 0) return;
    study::Scene::Vector v{.name = "shaking force on the ground",
                           .quantity = study::Scene::Quantity::force,
                           .unit = "N",
                           .point = add_point("frame", 0, sum / count),
                           .symbol = "F shaking"};
    for (const LinkageRecord& r : records_) {
      v.x.push_back(r.joints.empty() ? nan : r.shaking_force.x);
      v.y.push_back(r.joints.empty() ? nan : r.shaking_force.y);
    }
    scene_.vectors.push_back(std::move(v));
  }

  const Linkage& l_;
  const LinkagePlan& plan_;
  const std::vector<LinkageRecord>& records_;
  study::Scene scene_;
  std::vector<int> first_;
};

}  // namespace

void add_mass_centres(study::Scene& scene, const Linkage& linkage, const LinkagePlan& plan,
                      const std::vector<LinkageRecord>& records) {
  for (std::size_t b = 1; b < linkage.bodies.size(); ++b) {
    const LinkageBody& body = linkage.bodies[b];
    if (!body.mass || !(body.mass->mass > 0) || plan.bodies[b].part == 0) continue;
    const auto add_point = [&](std::complex<double> there) {
      study::Scene::Point p;
      for (const LinkageRecord& r : records) {
        const math::Vec2 v =
            r.bodies.empty() ? math::Vec2{nan, nan} : point_on(r.bodies[b], math::vec(there));
        p.x.push_back(v.x), p.y.push_back(v.y);
      }
      scene.points.push_back(std::move(p));
      return static_cast<int>(scene.points.size()) - 1;
    };
    const std::complex<double> centre = body.mass->centre;
    const int drawn = add_point(centre);
    scene.circles.push_back({fmt::format("mass centre of {}, {:.4g} kg", body.name, body.mass->mass), drawn,
                             add_point(centre + drawn_radius(body.mass->mass))});
    scene.handles.push_back(
        {.key = fmt::format("mechanism.body[{}].centre_m", b), .frame = static_cast<int>(b), .point = drawn});
  }
}

study::Scene linkage_scene(const Linkage& linkage, const LinkagePlan& plan,
                           const std::vector<LinkageRecord>& records, const std::vector<BodyPoint>& traces,
                           std::string input_key, std::string input_label) {
  return Artist(linkage, plan, records).draw(traces, std::move(input_key), std::move(input_label));
}

void warn_of_held_loads(const Linkage& l, const LinkagePlan& plan, double low, double high,
                        const study::AddWarning& warn) {
  if (plan.rotary.empty()) return;
  for (const std::string& name : loads_held(l, plan.rotary[0], low, high))
    warn(say("the table of '{}' ends within the motion, from {} to {} of {}: beyond it the load keeps its "
             "last value",
             name, input_place(l, plan, 0, low, 6), input_place(l, plan, 0, high, 6), input_joint(l, 0).name),
         "period repeats a table; one of whole turns repeats by itself");
}

}  // namespace linkwright::planar
