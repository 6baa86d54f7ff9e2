// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/suspension/studies/beam_axle.h"

namespace linkwright::suspension {
namespace {

using study::Scene;
/// A scene is for looking at: so many values of each input at most.
constexpr std::size_t max_scene_heaves = 61, max_scene_rolls = 41;
constexpr double drawn_width_by_diameter = 0.3;  ///< of tyres, for the drawing only

/// Some of the values, with both ends and the one next to zero.
std::vector<std::size_t> some_of(const std::vector<double>& values, std::size_t most) {
  std::vector<std::size_t> out;
  const std::size_t step = (values.size() + most - 1) / most, middle = next_to_zero(values);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (i % step == 0 || i + 1 == values.size() || i == middle) out.push_back(i);
  return out;
}

/// Draws a rigid axle over chosen rows of its grid.
class AxleDrawing {
 public:
  AxleDrawing(Scene& scene, const BeamAxlePlan& plan, std::vector<const BeamAxleRow*> rows)
      : scene_(scene), plan_(plan), rows_(std::move(rows)) {}

  void draw(const BeamAxleStudy& s) {
    wheels();
    for (std::size_t i = 0; i < s.axle.rods.size(); ++i) {
      const AxleRod& r = s.axle.rods[i];
      const int body = fixed(r.name + ", body", r.body), beam = joint(r.name + ", beam", r.beam);
      bar(r.name, {body, beam});
      if (i < s.handles.size() && !s.handles[i].empty()) {
        scene_.handles.push_back({.key = s.handles[i] + ".body_m", .point = body});
        scene_.handles.push_back({.key = s.handles[i] + ".beam_m", .point = beam});
      }
    }
    for (const AxleArm& a : s.axle.arms) {
      std::vector<int> points;
      for (std::size_t k = 0; k < a.body.size(); ++k)
        points.push_back(
            fixed(a.name + ", body" + (a.body.size() > 1 ? " " + std::to_string(k + 1) : ""), a.body[k]));
      for (std::size_t k = 0; k < a.beam.size(); ++k)
        points.push_back(
            joint(a.name + ", beam" + (a.beam.size() > 1 ? " " + std::to_string(k + 1) : ""), a.beam[k]));
      scene_.bodies.push_back({a.name, std::move(points), Scene::BodyStyle::plate});
    }
    for (std::size_t w = 0; w < s.axle.watts.size(); ++w) watt(s.axle.watts[w], w);
    for (const AxleGuide& g : s.axle.guides) joint(g.name, g.beam);
    for (const AxleBallJoint& b : s.axle.ball_joints) {
      scene_.bodies.push_back({b.name, {joint(b.name, b.at), beam_middle_}, Scene::BodyStyle::bar});
    }
    for (const NamedShaft& n : s.shafts) {
      const int body = fixed(n.name + ", body", n.shaft.body), beam = moving(n.name + ", beam", n.shaft.beam);
      scene_.joints.push_back({n.name + ", beam", beam, Scene::JointStyle::pivot});
      scene_.bodies.push_back({n.name, {body, beam}, Scene::BodyStyle::axis});
    }
    roll_centre();
  }

 private:
  template <class Place>
  int point(std::string name, Place&& place) {
    Scene::Point out{std::move(name), {}, {}};
    for (const BeamAxleRow* row : rows_) {
      const Vec3 at = row->position.status == Status::done ? place(*row) : Vec3{nan, nan, nan};
      out.x.push_back(at.x);
      out.y.push_back(at.y);
      out.z.push_back(at.z);
    }
    scene_.points.push_back(std::move(out));
    return static_cast<int>(scene_.points.size()) - 1;
  }
  int fixed(const std::string& name, const Vec3& at) {
    scene_.points.push_back({name, {at.x}, {at.y}, {at.z}});
    const int index = static_cast<int>(scene_.points.size()) - 1;
    scene_.joints.push_back({name, index, Scene::JointStyle::ground_pivot});
    return index;
  }
  int moving(std::string name, const Vec3& reference) {
    return point(std::move(name),
                 [&](const BeamAxleRow& r) { return on_beam(plan_, r.position.place, reference); });
  }
  /// A joint on the beam, and the bracket from it to the line of the beam.
  int joint(const std::string& name, const Vec3& reference) {
    const int at = moving(name, reference);
    scene_.joints.push_back({name, at, Scene::JointStyle::pivot});
    const Vec3 &left = plan_.axle.left.centre, &right = plan_.axle.right.centre;
    const double share = std::clamp((reference.y - right.y) / (left.y - right.y), 0.0, 1.0);
    bar("beam", {at, moving("", right + share * (left - right))});
    return at;
  }
  void bar(std::string name, std::vector<int> points) {
    scene_.bodies.push_back({std::move(name), std::move(points), Scene::BodyStyle::bar});
  }

  void wheels() {
    std::array<int, 2> centres{};
    for (const Side side : {Side::left, Side::right}) {
      const std::size_t i = side == Side::left ? 0 : 1;
      const CornerWheel& wheel = i == 0 ? plan_.axle.left : plan_.axle.right;
      const std::string name(name_of(side));
      centres[i] = moving(name + " wheel centre", wheel.centre);
      const int outboard = moving("", wheel.centre + 0.1 * plan_.axes[i]);
      scene_.discs.push_back({name + " wheel", centres[i], outboard, wheel.tyre_diameter / 2,
                              drawn_width_by_diameter * wheel.tyre_diameter});
      const int contact = point(name + " contact point", [&](const BeamAxleRow& r) {
        return i == 0 ? r.parameters.left.contact : r.parameters.right.contact;
      });
      scene_.joints.push_back({name + " contact point", contact, Scene::JointStyle::tracer});
      scene_.traces.push_back({contact, "path of the " + name + " contact point", false});
    }
    scene_.handles.push_back({.key = "mechanism.wheel.centre_m", .point = centres[0]});
    beam_middle_ = moving("", plan_.centre);
    if (plan_.twist)
      twist(centres);
    else
      bar("beam", {centres[0], centres[1]});
  }

  /// Both arms, and the cross member between them at the height of its shear centre.
  void twist(const std::array<int, 2>& centres) {
    const AxleTwist& t = *plan_.axle.twist;
    std::array<int, 2> ends{};
    for (std::size_t side = 0; side < 2; ++side) {
      const std::string name = side == 0 ? "left" : "right";
      const int pivot = moving(name + " pivot", t.pivots[side]);
      scene_.joints.push_back({name + " pivot", pivot, Scene::JointStyle::ground_pivot});
      ends[side] = moving("", {t.shear_centre.x, t.pivots[side].y, t.shear_centre.z});
      bar(name + " arm", {pivot, ends[side], centres[side]});
    }
    const int middle = moving(t.name + ", shear centre", t.shear_centre);
    scene_.joints.push_back({t.name + ", shear centre", middle, Scene::JointStyle::tracer});
    bar("cross member", {ends[0], middle, ends[1]});
    scene_.handles.push_back({.key = "mechanism.twist_beam.pivot_m", .point = ends[0] - 1});
    scene_.handles.push_back({.key = "mechanism.twist_beam.shear_centre_m", .point = middle});
  }

  void watt(const AxleWatt& w, std::size_t index) {
    const int pivot =
        w.pivot_on_beam ? joint(w.name + ", pivot", w.pivot) : fixed(w.name + ", pivot", w.pivot);
    std::array<int, 2> ends{};
    for (std::size_t k = 0; k < 2; ++k) {
      const std::string number = std::to_string(k + 1);
      ends[k] = point(w.name + ", crank " + number,
                      [&](const BeamAxleRow& r) { return crank_end(plan_, r.position.place, index, k); });
      scene_.joints.push_back({w.name + ", crank " + number, ends[k], Scene::JointStyle::pivot});
      const std::string far = w.name + ", end " + number;
      bar(w.name + ", rod " + number,
          {ends[k], w.pivot_on_beam ? fixed(far, w.ends[k]) : joint(far, w.ends[k])});
    }
    scene_.bodies.push_back({w.name + ", bellcrank", {ends[0], pivot, ends[1]}, Scene::BodyStyle::bar});
  }

  void roll_centre() {
    const int at = point("roll centre", [](const BeamAxleRow& r) {
      return r.parameters.roll_centre.value_or(Vec3{nan, nan, nan});
    });
    scene_.joints.push_back({"roll centre", at, Scene::JointStyle::tracer});
  }

  Scene& scene_;
  const BeamAxlePlan& plan_;
  std::vector<const BeamAxleRow*> rows_;
  int beam_middle_ = 0;
};

}  // namespace

study::Scene beam_axle_scene(const BeamAxleStudy& s, const BeamAxlePlan& plan,
                             const std::vector<BeamAxleRow>& rows) {
  Scene scene;
  scene.name = "heave";
  scene.title = "heave and roll";
  scene.input_key = "heave_m";
  scene.input_label = "heave";
  std::vector<const BeamAxleRow*> chosen;
  const auto heaves = some_of(s.heaves, max_scene_heaves), rolls = some_of(s.rolls, max_scene_rolls);
  for (const std::size_t h : heaves) scene.input.push_back(s.heaves[h]);
  for (const std::size_t r : rolls)
    for (const std::size_t h : heaves) chosen.push_back(&rows[r * s.heaves.size() + h]);
  if (s.rolls.size() > 1 || s.rolls[0] != 0) {
    scene.second_key = "roll_rad";
    scene.second_label = "roll";
    for (const std::size_t r : rolls) scene.second.push_back(s.rolls[r]);
  }
  const auto reached = [](const BeamAxleRow* r) { return r->position.status == Status::done; };
  if (!std::all_of(chosen.begin(), chosen.end(), reached))
    for (const BeamAxleRow* r : chosen) scene.status.emplace_back(to_string(r->position.status));
  AxleDrawing(scene, plan, std::move(chosen)).draw(s);
  return scene;
}

}  // namespace linkwright::suspension
