// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/sketch/detail/sketch_points.h"
#include "linkwright/planar/sketch/sketch.h"

namespace linkwright::planar {
namespace {

/// Points of the two lowest free ends, else of the two lowest pins.
std::vector<std::size_t> lowest(const Sketch& sketch) {
  std::vector<std::size_t> joints_at(sketch.points.size()), free_ends, pins;
  for (const SketchJoint& joint : sketch.joints) ++joints_at[joint.point];
  for (std::size_t point = 0; point < sketch.points.size(); ++point) {
    if (joints_at[point] > 0) {
      pins.push_back(point);
      continue;
    }
    for (const SketchBody& body : sketch.bodies)
      if (body.type == SketchBodyType::bar &&
          std::find(body.points.begin(), body.points.end(), point) != body.points.end())
        free_ends.push_back(point);
  }
  std::vector<std::size_t>& chosen = free_ends.size() >= 2 ? free_ends : pins;
  std::stable_sort(chosen.begin(), chosen.end(), [&](std::size_t a, std::size_t b) {
    return sketch.points[a].at.imag() < sketch.points[b].at.imag();
  });
  chosen.resize(std::min<std::size_t>(2, chosen.size()));
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

void fix(Sketch& sketch, const std::vector<std::size_t>& points) {
  sketch.bodies.insert(sketch.bodies.begin(), {SketchBodyType::ground, {}, points});
  for (SketchJoint& joint : sketch.joints) ++joint.first, ++joint.second;
  for (SketchGear& gear : sketch.gears)
    for (std::size_t& body : gear.bodies) ++body;
  for (SketchBelt& belt : sketch.belts)
    for (SketchPulley& pulley : belt.pulleys) ++pulley.body;
  std::vector<SketchJoint> pins;
  for (const std::size_t point : points)
    for (std::size_t body = 1; body < sketch.bodies.size(); ++body) {
      const auto& of_body = sketch.bodies[body].points;
      if (std::find(of_body.begin(), of_body.end(), point) == of_body.end()) continue;
      pins.push_back({JointType::revolute, {}, 0, body, point, 0});
      break;
    }
  sketch.joints.insert(sketch.joints.begin(), pins.begin(), pins.end());
  sketching::name_sketch(sketch);
}

/// The greatest distance of two points of a body, or the diameter of a wheel.
double size_of(const Sketch& sketch, std::size_t index) {
  const SketchBody& body = sketch.bodies[index];
  double size = 0;
  for (const std::size_t a : body.points)
    for (const std::size_t b : body.points)
      size = std::max(size, std::abs(sketch.points[a].at - sketch.points[b].at));
  for (const SketchGear& gear : sketch.gears)
    for (std::size_t side = 0; side < 2; ++side)
      if (gear.bodies[side] == index) size = std::max(size, 2 * gear.radii[side]);
  for (const SketchBelt& belt : sketch.belts)
    for (const SketchPulley& pulley : belt.pulleys)
      if (pulley.body == index) size = std::max(size, 2 * pulley.radius);
  return size;
}

/// The joint of a driven point: of a wheel that turns there, else the first that moves.
std::optional<std::size_t> joint_at(Sketch& sketch, std::size_t point) {
  std::vector<std::size_t> joints;
  for (std::size_t k = 0; k < sketch.joints.size(); ++k)
    if (sketch.joints[k].point == point && sketch.joints[k].type != JointType::fixed) joints.push_back(k);
  if (joints.empty()) return std::nullopt;
  const auto wheel = std::find_if(joints.begin(), joints.end(), [&](std::size_t k) {
    return sketch.bodies[sketch.joints[k].second].type == SketchBodyType::wheel;
  });
  const std::size_t chosen = wheel == joints.end() ? joints.front() : *wheel;
  if (joints.size() > 1)
    sketch.questions.push_back({fmt::format("{} joints lie at the driven point {}: which is driven?",
                                            joints.size(), sketch.points[point].name),
                                sketch.joints[chosen].name});
  return chosen;
}

}  // namespace

void complete(Sketch& sketch, const SketchAnswers& answers) {
  const auto points_of = [&](const std::vector<std::string>& names) {
    std::vector<std::size_t> out;
    for (const std::string& name : names) out.push_back(sketching::point_named(sketch, name).value());
    std::sort(out.begin(), out.end());
    out.erase(std::unique(out.begin(), out.end()), out.end());
    return out;
  };
  const bool has_ground = !sketch.bodies.empty() && sketch.bodies[0].type == SketchBodyType::ground;
  if (!has_ground && !answers.ground.empty()) {
    fix(sketch, points_of(answers.ground));
  } else if (!has_ground) {
    const std::vector<std::size_t> points = lowest(sketch);
    std::string names;
    for (const std::size_t point : points)
      names += fmt::format("{}{}", names.empty() ? "" : " and ", sketch.points[point].name);
    fix(sketch, points);
    sketch.questions.push_back({"no layer is called ground: which points are fixed?", names});
  }
  if (!answers.driven.empty()) sketch.driven = points_of(answers.driven), sketch.drives.clear();
  for (const std::size_t point : sketch.driven)
    if (const auto joint = joint_at(sketch, point)) sketch.drives.push_back({*joint, 0});
  if (!sketch.drives.empty()) return;
  const auto moves = [&](const SketchJoint& joint) {
    return joint.first == 0 && joint.type != JointType::fixed;
  };
  std::size_t chosen = sketch.joints.size();
  // The shortest bar at the ground turns most easily; a slide is driven where nothing turns.
  double shortest = infinity;
  for (const JointType type : {JointType::revolute, JointType::prismatic})
    for (std::size_t k = 0; k < sketch.joints.size() && (type == JointType::revolute || shortest == infinity);
         ++k) {
      const SketchJoint& joint = sketch.joints[k];
      if (!moves(joint) || joint.type != type) continue;
      const double size = size_of(sketch, joint.second);
      if (chosen < sketch.joints.size() && !(size < shortest)) continue;
      chosen = k;
      shortest = size;
    }
  const std::string assumed =
      chosen < sketch.joints.size()
          ? fmt::format("{}, the joint of the shortest bar at the ground", sketch.joints[chosen].name)
          : "none";
  sketch.questions.push_back({"no circle lies on a layer called drive: which pin is driven?", assumed});
  if (chosen < sketch.joints.size()) sketch.drives = {{chosen, 0}};
}

namespace {

double mm(double metres) { return std::round(metres * 1e9) / 1e6 + 0.0; }

std::string point_name(const Sketch& sketch, std::size_t body, std::size_t point) {
  return fmt::format("\"{}.{}\"", sketch.bodies[body].name, sketch.points[point].name);
}

std::string text_of_bodies(const Sketch& sketch) {
  std::string out;
  for (const SketchBody& body : sketch.bodies) {
    std::string points;
    for (const std::size_t point : body.points) {
      const SketchPoint& p = sketch.points[point];
      points += fmt::format("{}{} = [{}, {}]", points.empty() ? "" : ", ", p.name, mm(p.at.real()),
                            mm(p.at.imag()));
    }
    out += fmt::format("\n[[mechanism.body]]\nname      = \"{}\"\npoints_mm = {{ {} }}\n", body.name, points);
  }
  return out;
}

std::string text_of_joints(const Sketch& sketch) {
  std::string out;
  for (const SketchJoint& joint : sketch.joints) {
    out += fmt::format("\n[[mechanism.joint]]\nname   = \"{}\"\n", joint.name);
    if (joint.type != JointType::revolute) out += fmt::format("type   = \"{}\"\n", name_of(joint.type));
    out += fmt::format("first  = {}\nsecond = {}\n", point_name(sketch, joint.first, joint.point),
                       point_name(sketch, joint.second, joint.point));
    if (joint.type == JointType::prismatic)
      out += fmt::format("direction_deg = {}\n", std::round(joint.direction * 180 / pi * 1e9) / 1e9 + 0.0);
  }
  return out;
}

std::string text_of_gears(const Sketch& sketch) {
  std::string out;
  for (const SketchGear& gear : sketch.gears) {
    out +=
        fmt::format("\n[[mechanism.joint]]\nname   = \"{}\"\ntype   = \"gear\"\nfirst  = {}\nsecond = {}\n",
                    gear.name, point_name(sketch, gear.bodies[0], gear.points[0]),
                    point_name(sketch, gear.bodies[1], gear.points[1]));
    if (!(gear.radii[0] > 0)) {
      out += fmt::format("ratio  = {}\n", gear.ratio);
      continue;
    }
    out += fmt::format("pitch_radii_mm = [{}, {}]\n", mm(gear.radii[0]), mm(gear.radii[1]));
    if (gear.ratio > 0)
      out += fmt::format("internal = \"{}\"\n", gear.radii[0] > gear.radii[1] ? "first" : "second");
  }
  return out;
}

std::string text_of_belts(const Sketch& sketch) {
  std::string out;
  for (const SketchBelt& belt : sketch.belts) {
    out += fmt::format("\n[[mechanism.belt]]\nname   = \"{}\"\nwheels = [", belt.name);
    for (const SketchPulley& pulley : belt.pulleys)
      out +=
          fmt::format("\n  {{ at = {}, radius_mm = {}{} }},", point_name(sketch, pulley.body, pulley.point),
                      mm(pulley.radius), pulley.is_outside ? ", side = \"outside\"" : "");
    out += "\n]\n";
  }
  return out;
}

/// The drives, and the range over which they move: of a single one that in which the linkage assembles, of
/// several a turn of each.
std::string text_of_drives(const Sketch& sketch) {
  if (sketch.drives.empty()) return {};
  std::string out;
  double size = 0;
  for (std::size_t body = 0; body < sketch.bodies.size(); ++body)
    size = std::max(size, size_of(sketch, body));
  std::string inputs;
  for (const SketchDrive& drive : sketch.drives) {
    const SketchJoint& joint = sketch.joints[drive.joint];
    const bool turns = joint.type == JointType::revolute;
    const double speed = drive.speed != 0 ? drive.speed * (turns ? 30 / pi : 1000) : 10;
    out += fmt::format("\n[[drive]]\njoint     = \"{}\"\n{} = {}\n", joint.name,
                       turns ? "speed_rpm" : "speed_mm_per_s", std::round(speed * 1e6) / 1e6);
    inputs += fmt::format("\n[[sweep.input]]\njoint    = \"{}\"\n", joint.name);
    inputs += turns ? std::string("from_deg = -180\nto_deg   = 180\n")
                    : fmt::format("from_mm  = {}\nto_mm    = {}\n", -mm(size), mm(size));
    inputs += fmt::format("samples  = {}\n", sketch.drives.size() > 1 ? 19 : 361);
  }
  out += "\n# The range around the drawing.\n[sweep]\ntype  = \"grid\"\n";
  if (sketch.drives.size() == 1) out += "range = \"assembled\"\n";
  return out + inputs;
}

/// A sentence as a comment of a file: without line breaks, which the name of a layer may have.
std::string comment(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ') c = ' ';
  return "# " + text + "\n";
}

}  // namespace

std::string sketch_study(const Sketch& sketch, const std::string& title) {
  std::string out = comment("linkwright study: " + title);
  for (const SketchQuestion& question : sketch.questions)
    out += comment(fmt::format("Open question: {} Assumed: {}.", question.text, question.assumed));
  for (const std::string& sentence : sketch.left_out) out += comment("Not read: " + sentence + ".");
  out += "schema = 1\nkind   = \"analysis\"\n\n[mechanism]\ntype  = \"planar.linkage\"\ndrawn = true\n";
  out += text_of_bodies(sketch) + text_of_joints(sketch) + text_of_gears(sketch) + text_of_belts(sketch) +
         text_of_drives(sketch);
  for (const std::size_t point : sketch.traced)
    for (std::size_t body = 0; body < sketch.bodies.size(); ++body) {
      const SketchBody& b = sketch.bodies[body];
      if (b.type == SketchBodyType::ground ||
          std::find(b.points.begin(), b.points.end(), point) == b.points.end())
        continue;
      out += fmt::format("\n[[trace]]\npoint = {}\n", point_name(sketch, body, point));
      break;
    }
  return out;
}

}  // namespace linkwright::planar
