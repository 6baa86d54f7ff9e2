// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/serial_pi_arm_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "linkwright/core/numbers.h"

namespace linkwright::parallel {
namespace {

using math::Vec2;
using study::Scene;

class ArmDrawing {
 public:
  ArmDrawing(Scene& scene, const SerialPiArm& arm, std::span<const SerialSample> samples)
      : scene_(scene), arm_(arm), samples_(samples) {}

  void all() {
    const int first = fixed("pivot 1", arm_.base);
    const int first_up = fixed("second pivot 1", arm_.base + up(0));
    const auto [elbow, corner] = joint(0, first, first_up);
    // The frame of the second joint is mounted on the coupler of the first.
    const int second_up =
        point("second pivot 2", [this](const SerialSample& s) { return end(0, s) + up(1); });
    scene_.bodies.push_back({"coupler 1", {elbow, corner, second_up}, Scene::BodyStyle::plate});
    const auto [wrist, tip] = joint(1, elbow, second_up);
    const int tool = point("tool point", [this](const SerialSample& s) { return direct(arm_, s.angle); });
    scene_.bodies.push_back({"coupler 2", {wrist, tip, tool}, Scene::BodyStyle::plate});
    scene_.joints.push_back({"", first, Scene::JointStyle::ground_pivot});
    scene_.joints.push_back({"", first_up, Scene::JointStyle::ground_pivot});
    for (const int at : {elbow, corner, second_up, wrist, tip})
      scene_.joints.push_back({"", at, Scene::JointStyle::pivot});
    scene_.joints.push_back({"tool point", tool, Scene::JointStyle::tracer});
    scene_.traces.push_back({tool, "path of the tool point", false});
    velocity(tool);
    scene_.handles.push_back({.key = "mechanism.base_m", .point = first});
  }

 private:
  /// End of an arm.
  Vec2 end(std::size_t k, const SerialSample& s) const {
    Vec2 out = arm_.base;
    for (std::size_t i = 0; i <= k; ++i) out += arm_.arm[i] * math::unit(s.angle[i]);
    return out;
  }
  /// From the first to the second pivot of a joint: the direction of theta = 90 deg.
  Vec2 up(std::size_t k) const {
    const Drive& drive = arm_.drive[k];
    const double length = drive.mirror * drive.ratio * arm_.arm[k];
    return length * perpendicular(math::unit(drive.mounting));
  }

  template <class Place>
  int point(std::string name, Place&& place) {
    Scene::Point out{std::move(name), {}, {}};
    for (const SerialSample& s : samples_) {
      const Vec2 at = s.status == Status::done ? place(s) : Vec2{nan, nan};
      out.x.push_back(at.x);
      out.y.push_back(at.y);
    }
    scene_.points.push_back(std::move(out));
    return static_cast<int>(scene_.points.size()) - 1;
  }
  int fixed(std::string name, const Vec2& at) {
    scene_.points.push_back({std::move(name), {at.x}, {at.y}});
    return static_cast<int>(scene_.points.size()) - 1;
  }

  /// Arms and screw on two pivots: where both arms end.
  std::pair<int, int> joint(std::size_t k, int pivot, int second) {
    const auto named = [&](const char* text) { return fmt::format("{} {}", text, k + 1); };
    const auto bar = [&](const char* name, int from, int to, Scene::BodyStyle style = Scene::BodyStyle::bar) {
      scene_.bodies.push_back({named(name), {from, to}, style});
    };
    const int elbow = point(named("elbow"), [this, k](const SerialSample& s) { return end(k, s); });
    const int corner =
        point(named("end of the screw"), [this, k](const SerialSample& s) { return end(k, s) + up(k); });
    bar("base link", pivot, second);
    bar("arm", pivot, elbow);
    scene_.handles.push_back({.key = fmt::format("mechanism.arms_m[{}]", k),
                              .measure = Scene::Handle::Measure::length,
                              .point = elbow,
                              .from = pivot,
                              .held = true});
    bar("second arm", second, corner);
    if (arm_.drive[k].type == DriveType::pi_joint) bar("screw", pivot, corner, Scene::BodyStyle::damper);
    return {elbow, corner};
  }

  void velocity(int tool) {
    if (std::none_of(samples_.begin(), samples_.end(),
                     [](const SerialSample& s) { return norm(s.velocity) > 0; }))
      return;
    Scene::Vector out{"velocity of the tool point", Scene::Quantity::velocity, "m/s", tool, {}, {}, "v"};
    for (const SerialSample& s : samples_) {
      out.x.push_back(s.status == Status::done ? s.velocity.x : nan);
      out.y.push_back(s.status == Status::done ? s.velocity.y : nan);
    }
    scene_.vectors.push_back(std::move(out));
  }

  Scene& scene_;
  const SerialPiArm& arm_;
  std::span<const SerialSample> samples_;
};

}  // namespace

study::Scene serial_arm_scene(const SerialPiArm& arm, const SceneInput& input, std::span<const double> values,
                              std::span<const SerialSample> samples) {
  Scene scene = scene_over(input, values, samples);
  ArmDrawing(scene, arm, samples).all();
  return scene;
}

}  // namespace linkwright::parallel
