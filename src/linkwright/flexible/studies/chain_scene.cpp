// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/flexible/studies/chain_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "linkwright/study/drawn_scale.h"

namespace linkwright::flexible {
namespace {

// Share of the arm's length that a displacement of the tip is drawn as, at most.
constexpr double seen = 0.05;

double largest_displacement(const Chain& chain, const Simulation& run) {
  double out = 0;
  for (const ChainState& state : run.states) {
    const TipDisplacement d = tip_displacement(chain, state.q);
    out = std::max(out, std::hypot(d.along, d.across));
  }
  return out;
}

}  // namespace

study::Scene chain_scene(const ArmChain& arm, std::span<const std::string> names, const Simulation& run,
                         std::optional<double> scale) {
  using study::Scene;
  const Chain& chain = arm.chain;
  const double size = chain.hub_radius + chain.length();
  const double drawn = scale.value_or(study::drawn_scale(largest_displacement(chain, run), seen * size));
  Scene scene;
  scene.name = "motion";
  scene.title = drawn == 1 ? "bending to scale; dash-dotted: the rigid arm"
                           : say("bending drawn {} x; dash-dotted: the rigid arm", plain_number(drawn, 6));
  scene.input_key = "time_s";
  scene.input_label = "time";

  const std::size_t nodes = chain.cells.size() + 1;
  scene.points.resize(1 + nodes);
  scene.points[0] = {"O", {0}, {0}};
  // Points of the rigid arm: the root of the first link, then the tips of all.
  std::vector<Scene::Point> rigid(1 + arm.links.size());
  rigid[0].name = "rigid root";
  for (std::size_t i = 0; i < arm.links.size(); ++i) {
    scene.points[1 + arm.links[i].tip].name = names[i] + " tip";
    rigid[i + 1].name = names[i] + " tip, rigid";
  }
  scene.points[1].name = "weld";
  scene.points.back().name = "tip";
  Scene::Vector reaction{"hub on " + names[0], Scene::Quantity::force, "N", 1, {}, {}, "hub"};
  Scene::Moment torque{"drive of the hub", "N m", 0, {}};
  for (std::size_t i = 0; i < run.states.size(); ++i) {
    const ChainState& state = run.states[i];
    scene.input.push_back(run.samples[i].time);
    const math::Vec2 hub{std::cos(state.angle), std::sin(state.angle)};
    const auto put = [&](Scene::Point& to, math::Vec2 at) {
      const math::Vec2 p = rotate(hub, at);
      to.x.push_back(p.x);
      to.y.push_back(p.y);
    };
    const ChainShape at = shape(chain, bent(chain, state.q, drawn));
    for (std::size_t k = 0; k < nodes; ++k) put(scene.points[1 + k], at.node[k]);
    const ChainShape straight = shape(chain, bent(chain, state.q, 0));
    put(rigid[0], straight.node[0]);
    for (std::size_t k = 0; k < arm.links.size(); ++k) put(rigid[k + 1], straight.node[arm.links[k].tip]);
    const Sample& sample = run.samples[i];
    const math::Vec2 force = rotate(hub, {sample.reaction_xi, sample.reaction_eta});
    reaction.x.push_back(force.x);
    reaction.y.push_back(force.y);
    torque.value.push_back(sample.torque);
  }
  scene.vectors.push_back(std::move(reaction));
  scene.moments.push_back(std::move(torque));
  const int first_rigid = static_cast<int>(scene.points.size());
  for (Scene::Point& p : rigid) scene.points.push_back(std::move(p));

  if (chain.hub_radius > 0) scene.bodies.push_back({"hub", {0, 1}, Scene::BodyStyle::bar});
  scene.joints.push_back({"O", 0, Scene::JointStyle::ground_pivot});
  for (std::size_t i = 0; i < arm.links.size(); ++i) {
    const ArmChain::Link& link = arm.links[i];
    for (std::size_t k = link.root; k < link.tip; ++k)
      scene.bodies.push_back({names[i], {int(1 + k), int(2 + k)}, Scene::BodyStyle::bar});
    const int root = first_rigid + static_cast<int>(i);
    scene.bodies.push_back({names[i] + ", rigid", {root, root + 1}, Scene::BodyStyle::axis});
    for (const std::string& key :
         {fmt::format("mechanism.link[{}].length_m", i), std::string("mechanism.length_m")})
      scene.handles.push_back({.key = key,
                               .measure = Scene::Handle::Measure::length,
                               .point = root + 1,
                               .from = root,
                               .held = true});
    if (link.hinge)
      scene.joints.push_back({"hinge of " + names[i], int(1 + link.root), Scene::JointStyle::pivot});
  }
  const int tip = static_cast<int>(nodes);
  scene.joints.push_back({"tip", tip, Scene::JointStyle::tracer});
  scene.traces = {{tip, "path of the tip", false},
                  {static_cast<int>(scene.points.size()) - 1, "path of the rigid arm's tip", false}};
  return scene;
}

}  // namespace linkwright::flexible
