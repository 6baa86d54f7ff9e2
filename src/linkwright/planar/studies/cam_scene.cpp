// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/planar/studies/cam.h"

namespace linkwright::planar {
namespace {

using study::Scene;
using Place = math::Vec2;

// Corners of the polygon by which a turning cam is drawn, and samples of its animation.
constexpr int corners = 120;
constexpr std::size_t max_frames = 121;

// Draws the cam and its follower in a frame in which the cam has turned by some angle: its own for a drawing
// of the profile, that of the ground for an animation.
class CamDrawing {
 public:
  CamDrawing(const CamStudy& study, const ProgrammeCurve& curve, std::vector<double> angles, bool cam_turns)
      : s_(study), curve_(curve), angles_(std::move(angles)), cam_turns_(cam_turns) {
    for (const double angle : angles_) states_.push_back(cam_state(s_.cam, curve_(angle), angle));
    scene_.name = cam_turns ? "motion" : "profile";
    scene_.title =
        cam_turns ? "Cam and follower" : "Profile, pitch curve and the follower about the resting cam";
    scene_.input_key = "cam_angle_rad";
    scene_.input_label = "cam angle";
    scene_.input = angles_;
  }

  Scene make() {
    const int axis = still("O", {0, 0}), rim = moving("base circle", [this](std::size_t k) {
                                           return on_ground({0, s_.cam.base_radius}, k);
                                         });
    scene_.circles.push_back({"base circle", axis, rim});
    scene_.joints.push_back({"O", axis, Scene::JointStyle::ground_pivot});
    if (cam_turns_) plate();
    if (s_.cam.has_pitch_curve())
      roller();
    else
      face();
    paths();
    return std::move(scene_);
  }

 private:
  // A place that follows the samples, given in the frame of the ground.
  template <class PlaceAt>
  int moving(std::string name, const PlaceAt& at) {
    Scene::Point point{std::move(name), {}, {}};
    for (std::size_t k = 0; k < angles_.size(); ++k) {
      const Place p = shown(at(k), k);
      point.x.push_back(p.x), point.y.push_back(p.y);
    }
    scene_.points.push_back(std::move(point));
    return last();
  }
  int still(std::string name, const Place& p) {
    scene_.points.push_back({std::move(name), {p.x}, {p.y}});
    return last();
  }
  int last() const { return static_cast<int>(scene_.points.size()) - 1; }
  Place turning(std::size_t k) const { return math::unit(s_.cam.sense() * angles_[k]); }
  // A place of the ground as it is drawn.
  Place shown(const Place& p, std::size_t k) const { return cam_turns_ ? p : rotate_inverse(turning(k), p); }
  // A place of the cam in the frame of the ground.
  Place on_ground(const Place& of_cam, std::size_t k) const { return rotate(turning(k), of_cam); }
  double value(std::size_t k) const { return curve_(angles_[k]).value; }
  double size() const { return 2 * s_.cam.prime_radius(); }

  void plate() {
    Scene::Body cam{"cam", {}, Scene::BodyStyle::plate};
    const double whole = curve_.breaks().back();
    for (int c = 0; c < corners; ++c) {
      const double angle = whole * c / corners;
      const Place profile = cam_state(s_.cam, curve_(angle), angle).profile;
      cam.points.push_back(moving("", [&](std::size_t k) { return on_ground(profile, k); }));
    }
    if (s_.programme.is_sector) cam.points.push_back(0);
    scene_.bodies.push_back(std::move(cam));
  }

  void roller() {
    const int centre = moving(s_.cam.roller() > 0 ? "roller" : "edge",
                              [&](std::size_t k) { return on_ground(states_[k].pitch, k); });
    if (s_.cam.roller() > 0) {
      // The roller rolls: its rim has the speed of the profile.
      std::vector<double> turned(angles_.size(), 0);
      for (std::size_t k = 1; k < angles_.size(); ++k)
        turned[k] = turned[k - 1] -
                    s_.cam.sense() * norm(states_[k].profile - states_[k - 1].profile) / s_.cam.roller();
      const int rim = moving("rim", [&](std::size_t k) {
        return on_ground(states_[k].pitch, k) + s_.cam.roller() * math::unit(turned[k]);
      });
      scene_.circles.push_back({"roller", centre, rim});
    }
    scene_.joints.push_back({"B", centre, Scene::JointStyle::pivot});
    if (s_.cam.motion == FollowerMotion::oscillating) {
      const int pivot = pivot_point();
      scene_.bodies.push_back({"follower", {pivot, centre}, Scene::BodyStyle::bar});
      return;
    }
    const int top = moving("stem", [&](std::size_t k) {
      return on_ground(states_[k].pitch, k) + Place{0, size()};
    });
    scene_.bodies.push_back({"follower", {centre, top}, Scene::BodyStyle::bar});
    guide();
  }

  int pivot_point() {
    const int pivot = moving("pivot", [&](std::size_t) { return Place{s_.cam.pivot, 0}; });
    scene_.joints.push_back(
        {"pivot", pivot, cam_turns_ ? Scene::JointStyle::ground_pivot : Scene::JointStyle::pivot});
    return pivot;
  }

  void guide() {
    const double x = s_.cam.offset, y = base_position(s_.cam) + 0.8 * size();
    const double side = 0.06 * size();
    const int low = moving("guide",
                           [&](std::size_t) {
                             return Place{x + side, y - 0.2 * size()};
                           }),
              high = moving("guide end", [&](std::size_t) {
                return Place{x + side, y + 0.2 * size()};
              });
    scene_.bodies.push_back({"guide", {high, low}, Scene::BodyStyle::guide});
  }

  void face() {
    double least = infinity, most = -infinity;
    for (const CamState& s : states_) least = std::min(least, s.contact), most = std::max(most, s.contact);
    const double margin = 0.05 * (most - least) + 0.02 * size();
    if (s_.cam.motion == FollowerMotion::translating) {
      const auto height = [this](std::size_t k) { return s_.cam.base_radius + value(k); };
      const int left = moving("face",
                              [&](std::size_t k) {
                                return Place{least - margin, height(k)};
                              }),
                right = moving("face end",
                               [&](std::size_t k) {
                                 return Place{most + margin, height(k)};
                               }),
                middle = moving("foot",
                                [&](std::size_t k) {
                                  return Place{s_.cam.offset, height(k)};
                                }),
                top = moving("stem", [&](std::size_t k) {
                  return Place{s_.cam.offset, height(k) + size()};
                });
      scene_.bodies.push_back({"face", {left, right}, Scene::BodyStyle::bar});
      scene_.bodies.push_back({"follower", {middle, top}, Scene::BodyStyle::bar});
      guide();
      return;
    }
    const int pivot = pivot_point();
    const auto along = [this](std::size_t k, double distance) {
      const Place arm = math::unit(pi - base_position(s_.cam) - value(k));
      return Place{s_.cam.pivot, 0} + distance * arm - s_.cam.face_offset * perpendicular(arm);
    };
    const int near = moving("face", [&](std::size_t k) { return along(k, 0); }),
              far = moving("face end", [&](std::size_t k) { return along(k, most + margin); });
    scene_.bodies.push_back({"follower", {pivot, near, far}, Scene::BodyStyle::bar});
  }

  void paths() {
    const bool closed = !s_.programme.is_sector && !cam_turns_;
    const int contact = moving("contact", [&](std::size_t k) { return on_ground(states_[k].profile, k); });
    scene_.joints.push_back({"contact", contact, Scene::JointStyle::tracer});
    scene_.traces.push_back({contact, cam_turns_ ? "contact" : "profile", closed});
    if (s_.cam.roller() > 0) {
      const int centre = moving("centre", [&](std::size_t k) { return on_ground(states_[k].pitch, k); });
      scene_.traces.push_back({centre, cam_turns_ ? "roller" : "pitch curve", closed});
    }
    if (s_.cutter_radius && !cam_turns_) {
      const int cutter = moving("cutter", [&](std::size_t k) {
        return on_ground(cutter_centre(states_[k], *s_.cutter_radius), k);
      });
      scene_.traces.push_back({cutter, "cutter", closed});
    }
  }

  const CamStudy& s_;
  const ProgrammeCurve& curve_;
  std::vector<double> angles_;
  bool cam_turns_;
  std::vector<CamState> states_;
  Scene scene_;
};

}  // namespace

std::vector<Scene> cam_scenes(const CamStudy& study, const ProgrammeCurve& curve,
                              const std::vector<double>& angles) {
  std::vector<double> frames;
  const std::size_t stride =
      std::max<std::size_t>(1, (angles.size() - 1 + max_frames - 2) / (max_frames - 1));
  for (std::size_t k = 0; k < angles.size(); k += stride) frames.push_back(angles[k]);
  if (frames.back() != angles.back()) frames.push_back(angles.back());
  return {CamDrawing(study, curve, std::move(frames), true).make(),
          CamDrawing(study, curve, angles, false).make()};
}

}  // namespace linkwright::planar
