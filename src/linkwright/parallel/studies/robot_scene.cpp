// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/parallel/studies/robot_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "linkwright/core/numbers.h"

namespace linkwright::parallel {
namespace {

using study::Scene;
/// Half the distance of a DELTA's twin rods, by the arm: for the drawing only.
constexpr double twin_rods_by_arm = 0.12;

class RobotDrawing {
 public:
  RobotDrawing(Scene& scene, const Robot& robot, const Drives& drives, std::span<const RobotSample> samples)
      : scene_(scene), robot_(robot), drives_(drives), samples_(samples) {}

  void all() {
    const bool spatial = robot_.freedom != Freedom::plane_translation;
    const int tool = point("platform point", [](const RobotSample& s) { return s.pose.position; });
    std::vector<int> base, platform;
    for (int i = 0; i < robot_.legs(); ++i) leg(i, base, platform);
    if (spatial) {
      scene_.bodies.push_back({"base", base, Scene::BodyStyle::plate});
      scene_.bodies.push_back({"platform", platform, Scene::BodyStyle::plate});
    } else {
      for (const int at : platform)
        if (norm(robot_.leg[0].platform) > 0)
          scene_.bodies.push_back({"platform", {at, tool}, Scene::BodyStyle::bar});
    }
    scene_.joints.push_back({"platform point", tool, Scene::JointStyle::tracer});
    scene_.traces.push_back({tool, "path of the platform point", false});
    velocity(tool);
  }

 private:
  template <class Place>
  int point(std::string name, Place&& place) {
    Scene::Point out{std::move(name), {}, {}};
    for (const RobotSample& s : samples_) {
      const Vec3 at = s.status == Status::done ? place(s) : Vec3{nan, nan, nan};
      out.x.push_back(at.x);
      out.y.push_back(at.y);
      if (robot_.freedom != Freedom::plane_translation) out.z.push_back(at.z);
    }
    scene_.points.push_back(std::move(out));
    return static_cast<int>(scene_.points.size()) - 1;
  }
  int fixed(std::string name, const Vec3& at) {
    Scene::Point out{std::move(name), {at.x}, {at.y}};
    if (robot_.freedom != Freedom::plane_translation) out.z = {at.z};
    scene_.points.push_back(std::move(out));
    return static_cast<int>(scene_.points.size()) - 1;
  }
  void bar(std::string name, int from, int to, Scene::BodyStyle style = Scene::BodyStyle::bar) {
    scene_.bodies.push_back({std::move(name), {from, to}, style});
  }

  void leg(int i, std::vector<int>& base, std::vector<int>& platform) {
    const Leg& leg = robot_.leg[i];
    const auto named = [&](const char* text) { return fmt::format("{} {}", text, i + 1); };
    const int pivot = fixed(named("pivot"), leg.base);
    const auto at_elbow = [leg, i](const RobotSample& s) { return elbow(leg, s.angle[i]); };
    const int end = point(named("elbow"), at_elbow);
    base.push_back(pivot);
    scene_.joints.push_back({named("pivot"), pivot, Scene::JointStyle::ground_pivot});
    bar(named("arm"), pivot, end);
    int joint = -1;
    const auto at_joint = [this, i](const RobotSample& s) { return platform_joint(robot_, i, s.pose); };
    if (robot_.freedom == Freedom::space_translation) {
      const Vec3 half = twin_rods_by_arm * leg.arm * cross(leg.ahead, leg.aside);
      std::array<int, 2> from, to;
      for (int k = 0; k < 2; ++k) {
        const Vec3 shift = (k ? -1.0 : 1.0) * half;
        from[k] = point("", [=](const RobotSample& s) { return at_elbow(s) + shift; });
        to[k] = point("", [=](const RobotSample& s) { return at_joint(s) + shift; });
        bar(named("rod"), from[k], to[k]);
        platform.push_back(to[k]);
      }
      bar(named("elbow bar"), from[0], from[1]);
      joint = point("", at_joint);
    } else {
      joint = point(named("platform joint"), at_joint);
      bar(named("rod"), end, joint);
      platform.push_back(joint);
      scene_.joints.push_back({"", joint, Scene::JointStyle::pivot});
    }
    scene_.joints.push_back({"", end, Scene::JointStyle::pivot});
    if (drives_[i].type == DriveType::pi_joint) parallelogram(i, pivot, end);
    handles(i, pivot, end, joint);
  }

  // Handles of one leg, by its own numbers or by those that all legs share. The rod is dragged at the elbow:
  // the study prescribes the platform's position elsewhere.
  void handles(int i, int pivot, int end, int joint) {
    using Measure = Scene::Handle::Measure;
    const bool planar = robot_.freedom == Freedom::plane_translation;
    const std::string leg = fmt::format("mechanism.leg[{}].", i);
    for (const std::string& of : {leg, std::string("mechanism.")}) {
      scene_.handles.push_back(
          {.key = of + "arm_m", .measure = Measure::length, .point = end, .from = pivot, .held = !planar});
      scene_.handles.push_back(
          {.key = of + "rod_m", .measure = Measure::length, .point = end, .from = joint});
    }
    scene_.handles.push_back({.key = leg + "base_m", .point = pivot});
    if (robot_.freedom == Freedom::space_translation)
      scene_.handles.push_back(
          {.key = "mechanism.base_radius_m", .measure = Measure::length, .point = pivot, .held = true});
  }

  /// Adds a Pi-joint: the second pivot lies in the direction of theta = 90 deg.
  void parallelogram(int i, int pivot, int end) {
    const Leg& leg = robot_.leg[i];
    const Drive& drive = drives_[i];
    const auto named = [&](const char* text) { return fmt::format("{} {}", text, i + 1); };
    const Vec3 up =
        drive.mirror * (std::cos(drive.mounting) * leg.aside - std::sin(drive.mounting) * leg.ahead);
    const Vec3 shift = drive.ratio * leg.arm * up;
    const int second = fixed(named("second pivot"), leg.base + shift);
    const int corner = point(named("end of the screw"),
                             [=](const RobotSample& s) { return elbow(leg, s.angle[i]) + shift; });
    scene_.joints.push_back({"", second, Scene::JointStyle::ground_pivot});
    bar(named("base link"), pivot, second);
    bar(named("second arm"), second, corner);
    bar(named("coupler"), end, corner);
    bar(named("screw"), pivot, corner, Scene::BodyStyle::damper);
  }

  void velocity(int tool) {
    const bool moves = std::any_of(samples_.begin(), samples_.end(),
                                   [](const RobotSample& s) { return norm(s.velocity) > 0; });
    if (!moves) return;
    Scene::Vector out{"velocity of the platform point", Scene::Quantity::velocity, "m/s", tool, {}, {}, "v"};
    for (const RobotSample& s : samples_) {
      const Vec3 v = s.status == Status::done ? s.velocity : Vec3{nan, nan, nan};
      out.x.push_back(v.x);
      out.y.push_back(v.y);
      if (robot_.freedom != Freedom::plane_translation) out.z.push_back(v.z);
    }
    scene_.vectors.push_back(std::move(out));
  }

  Scene& scene_;
  const Robot& robot_;
  const Drives& drives_;
  std::span<const RobotSample> samples_;
};

}  // namespace

study::Scene robot_scene(const Robot& robot, const Drives& drives, const SceneInput& input,
                         std::span<const double> values, std::span<const RobotSample> samples) {
  Scene scene = scene_over(input, values, samples);
  RobotDrawing(scene, robot, drives, samples).all();
  return scene;
}

void add_places(Scene& scene, const Robot& robot, std::span<const ToolPlace> places) {
  for (const auto& [name, key, at] : places) {
    const int there = static_cast<int>(scene.points.size());
    scene.points.push_back({name, {at[0]}, {at[1]}});
    if (robot.freedom != Freedom::plane_translation) scene.points.back().z = {at[2]};
    scene.joints.push_back({name, there, Scene::JointStyle::pivot});
    scene.handles.push_back({.key = key, .point = there});
  }
}

}  // namespace linkwright::parallel
