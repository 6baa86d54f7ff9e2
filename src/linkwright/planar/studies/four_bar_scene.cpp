#include "linkwright/planar/studies/four_bar_scene.h"

#include <fmt/core.h>

#include <cmath>
#include <complex>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/four_bar/classify.h"
#include "linkwright/planar/path/targets.h"

namespace linkwright::planar {
namespace {

// Order of the points of a four_bar_scene; C is there only when the coupler point is drawn.
enum { O, B0, A, B, C };

bool assembled(const FourBarPosition& pose) { return pose.status != Status::no_assembly; }

// A vector that is worked out sample by sample.
template <class Sample, class Value>
study::Scene::Vector arrow(std::string name, study::Scene::Quantity quantity, std::string unit, int point,
                           std::string symbol, const std::vector<Sample>& samples, Value&& value) {
  study::Scene::Vector out{std::move(name), quantity, std::move(unit), point, {}, {}, std::move(symbol)};
  for (const Sample& sample : samples) {
    const std::complex<double> v = value(sample);
    out.x.push_back(v.real());
    out.y.push_back(v.imag());
  }
  return out;
}

}  // namespace

std::vector<double> shown_angles(const PathDesign& design, int samples) {
  LINKWRIGHT_REQUIRE(samples >= 2, "needs at least 2 samples, got {}", samples);
  const FourBarClass type = classify(design.linkage);
  double from = design.angles[0], to = from + design.sense * 2 * pi;
  if (!type.crank_rotates_fully && !type.inputs.empty()) {
    const double first = math::wrap_angle(design.angles[0]);
    AngleInterval held = type.inputs.front();
    double shift = 0;
    for (const AngleInterval& interval : type.inputs)
      for (double turns : {-2 * pi, 0.0, 2 * pi})
        if (first + turns >= interval.from - 1e-9 && first + turns <= interval.to + 1e-9)
          held = interval, shift = turns;
    const double offset = design.angles[0] - (first + shift);
    from = (design.sense > 0 ? held.from : held.to) + offset;
    to = (design.sense > 0 ? held.to : held.from) + offset;
  }
  std::vector<double> out(static_cast<std::size_t>(samples));
  for (int i = 0; i < samples; ++i) out[static_cast<std::size_t>(i)] = from + (to - from) * i / (samples - 1);
  return out;
}

study::Scene four_bar_scene(const FourBar& linkage, std::vector<double> crank_angles, std::string name,
                            std::string title, bool coupler_point, const JointNames& joints) {
  std::vector<FourBarPosition> poses;
  for (const double angle : crank_angles) poses.push_back(position(linkage, angle));
  return four_bar_scene(linkage, std::move(crank_angles), poses, std::move(name), std::move(title),
                        coupler_point, joints);
}

study::Scene four_bar_scene(const FourBar& linkage, std::vector<double> crank_angles,
                            const std::vector<FourBarPosition>& poses, std::string name, std::string title,
                            bool coupler_point, const JointNames& joints) {
  LINKWRIGHT_REQUIRE(poses.size() == crank_angles.size(), "{} poses for {} crank angles", poses.size(),
                     crank_angles.size());
  study::Scene scene;
  scene.name = std::move(name);
  scene.title = std::move(title);
  scene.input_key = "crank_angle_rad";
  scene.input_label = "crank angle";
  scene.input = std::move(crank_angles);
  const std::string o(joints[0]), a(joints[1]), b(joints[2]), b0(joints[3]);
  scene.points = {{o, {}, {}}, {b0, {}, {}}, {a, {}, {}}, {b, {}, {}}, {"C", {}, {}}};
  const auto put = [&](int point, std::complex<double> at, bool there) {
    scene.points[static_cast<std::size_t>(point)].x.push_back(there ? at.real() : nan);
    scene.points[static_cast<std::size_t>(point)].y.push_back(there ? at.imag() : nan);
  };
  put(O, crank_pivot(linkage), true);
  put(B0, rocker_pivot(linkage), true);
  for (const FourBarPosition& pose : poses) {
    put(A, pose.crank_pin, true);
    put(B, pose.coupler_pin, assembled(pose));
    put(C, pose.coupler_point, assembled(pose));
    scene.status.emplace_back(to_string(pose.status));
  }
  using Body = study::Scene::BodyStyle;
  scene.bodies = {{"ground", {O, B0}, Body::ground},
                  {"crank", {O, A}, Body::bar},
                  {"coupler", {A, B}, Body::bar},
                  {"rocker", {B0, B}, Body::bar}};
  using Joint = study::Scene::JointStyle;
  scene.joints = {
      {o, O, Joint::ground_pivot}, {b0, B0, Joint::ground_pivot}, {a, A, Joint::pivot}, {b, B, Joint::pivot}};
  if (coupler_point) {
    scene.bodies[2] = {"coupler", {A, B, C}, Body::plate};
    scene.joints.push_back({"C", C, Joint::tracer});
    scene.traces = {{C, "coupler curve", classify(linkage).crank_rotates_fully}};
  } else {
    scene.points.pop_back();
  }
  return scene;
}

void add_motion_arrows(study::Scene& scene, const FourBar& linkage, const std::vector<FourBarRates>& rates) {
  LINKWRIGHT_REQUIRE(rates.size() == scene.samples(), "{} rates for {} samples", rates.size(),
                     scene.samples());
  using Quantity = study::Scene::Quantity;
  using Complex = std::complex<double>;
  // Velocity or acceleration of the end of an arm that turns about a fixed point.
  const auto turning = [](Quantity quantity, const Complex& arm, double speed, double acceleration) {
    return quantity == Quantity::velocity ? Complex(0, speed) * arm
                                          : Complex(-speed * speed, acceleration) * arm;
  };
  const auto crank_pin = [&](const FourBarRates& r, Quantity q) {
    return turning(q, linkage.crank * r.crank_direction, r.crank_speed, r.crank_acceleration);
  };
  for (const Quantity q : {Quantity::velocity, Quantity::acceleration}) {
    const bool first = q == Quantity::velocity;
    const auto add = [&](int point, auto&& value) {
      const std::string& joint = scene.points[static_cast<std::size_t>(point)].name;
      scene.vectors.push_back(arrow((first ? "velocity of " : "acceleration of ") + joint, q,
                                    first ? "m/s" : "m/s2", point, (first ? "v " : "a ") + joint, rates,
                                    value));
    };
    add(A, [&](const FourBarRates& r) { return crank_pin(r, q); });
    add(B, [&](const FourBarRates& r) {
      return turning(q, linkage.rocker * r.rocker_direction, r.rocker_speed, r.rocker_acceleration);
    });
    if (scene.points.size() > C && scene.points[C].name == "C")
      add(C, [&](const FourBarRates& r) {
        const Complex arm = Complex(linkage.coupler_u, linkage.coupler_v) * r.coupler_direction;
        return crank_pin(r, q) + turning(q, arm, r.coupler_speed, r.coupler_acceleration);
      });
  }
}

void add_joint_forces(study::Scene& scene, const std::vector<FourBarReactions>& forces) {
  LINKWRIGHT_REQUIRE(forces.size() == scene.samples(), "{} forces for {} samples", forces.size(),
                     scene.samples());
  const auto add = [&](const char* pair, int point, std::complex<double> FourBarReactions::*force) {
    const std::string& joint = scene.points[static_cast<std::size_t>(point)].name;
    scene.vectors.push_back(arrow(std::string(pair) + " at " + joint, study::Scene::Quantity::force, "N",
                                  point, "F " + joint, forces,
                                  [&](const FourBarReactions& f) { return f.*force; }));
  };
  add("ground on crank", O, &FourBarReactions::ground_on_crank);
  add("crank on coupler", A, &FourBarReactions::crank_on_coupler);
  add("rocker on coupler", B, &FourBarReactions::rocker_on_coupler);
  add("ground on rocker", B0, &FourBarReactions::ground_on_rocker);
}

void add_mass_centres(study::Scene& scene, const FourBar& linkage, const FourBarMasses& masses) {
  const auto disc = [&](std::string_view link, const LinkMass& mass, auto&& joint, auto&& angle) {
    if (!(mass.mass > 0)) return;
    study::Scene::Point centre{"", {}, {}}, rim{"", {}, {}};
    for (double crank : scene.input) {
      const FourBarPosition pose = position(linkage, crank);
      const double direction = linkage.frame_angle + angle(crank, pose) + mass.centre_angle;
      const std::complex<double> at = joint(pose) + std::polar(mass.centre_distance, direction);
      const std::complex<double> edge = at + std::polar(drawn_radius(mass.mass), direction);
      const bool there = assembled(pose);
      centre.x.push_back(there ? at.real() : nan);
      centre.y.push_back(there ? at.imag() : nan);
      rim.x.push_back(there ? edge.real() : nan);
      rim.y.push_back(there ? edge.imag() : nan);
    }
    scene.circles.push_back({fmt::format("mass centre of {}, {:.4g} kg", link, mass.mass),
                             static_cast<int>(scene.points.size()),
                             static_cast<int>(scene.points.size()) + 1});
    scene.points.push_back(std::move(centre));
    scene.points.push_back(std::move(rim));
  };
  using Pose = FourBarPosition;
  disc(
      "crank", masses.crank, [&](const Pose&) { return crank_pivot(linkage); },
      [](double crank, const Pose&) { return crank; });
  disc(
      "coupler", masses.coupler, [](const Pose& p) { return p.crank_pin; },
      [](double, const Pose& p) { return p.coupler_angle; });
  disc(
      "rocker", masses.rocker, [&](const Pose&) { return rocker_pivot(linkage); },
      [](double, const Pose& p) { return p.rocker_angle; });
}

void add_drive_torque(study::Scene& scene, const std::vector<FourBarReactions>& forces) {
  study::Scene::Moment moment{"drive torque on the crank", "N m", O, {}, "M"};
  for (const FourBarReactions& f : forces) moment.value.push_back(f.drive_torque);
  scene.moments.push_back(std::move(moment));
}

void add_shaking_force(study::Scene& scene, const std::vector<FourBarReactions>& forces) {
  const auto &o = scene.points[O], &b0 = scene.points[B0];
  scene.points.push_back({"frame", {(o.x[0] + b0.x[0]) / 2}, {(o.y[0] + b0.y[0]) / 2}});
  scene.vectors.push_back(arrow("shaking force on the ground", study::Scene::Quantity::force, "N",
                                static_cast<int>(scene.points.size()) - 1, "F shaking", forces,
                                [](const FourBarReactions& f) { return f.shaking_force; }));
}

study::Scene path_scene(const PathProblem& problem, const PathDesign& design, std::string name,
                        std::string title, int samples) {
  study::Scene scene =
      four_bar_scene(design.linkage, shown_angles(design, samples), std::move(name), std::move(title), true);
  const PathErrors errors = path_errors(problem, design);
  if (problem.gate_x.empty()) {
    scene.targets = {
        {"target points", problem.x, problem.y, errors.x, errors.y, design.angles, problem.closed}};
    return scene;
  }
  // Whiskers run to the nearest place of each gate; its posts are marked.
  study::Scene::Target gates{"gates", {}, {}, errors.x, errors.y, design.angles, problem.closed};
  study::Scene::Target posts{"gate posts", {}, {}, {}, {}, {}, false};
  for (std::size_t k = 0; k < problem.x.size(); ++k) {
    const TargetMiss miss = target_offset(problem, k, errors.x[k], errors.y[k]);
    gates.x.push_back(std::isfinite(miss.x) ? errors.x[k] - miss.x : problem.x[k]);
    gates.y.push_back(std::isfinite(miss.y) ? errors.y[k] - miss.y : problem.y[k]);
    for (double side : {-1.0, 1.0}) {
      posts.x.push_back(problem.x[k] + side * problem.gate_x[k]);
      posts.y.push_back(problem.y[k] + side * problem.gate_y[k]);
      posts.achieved_input.push_back(design.angles[k]);
    }
  }
  posts.achieved_x = posts.x;
  posts.achieved_y = posts.y;
  scene.targets = {std::move(gates), std::move(posts)};
  return scene;
}

Table motion_table(const PathDesign& design, std::string name, int samples) {
  Table table;
  table.name = std::move(name);
  const std::vector<double> angles = shown_angles(design, samples);
  std::vector<double> coupler, rocker, transmission, x, y;
  for (double angle : angles) {
    const FourBarPosition pose = position(design.linkage, angle);
    const bool there = assembled(pose);
    coupler.push_back(there ? pose.coupler_angle : nan);
    rocker.push_back(there ? pose.rocker_angle : nan);
    transmission.push_back(there ? pose.transmission_angle : nan);
    x.push_back(there ? pose.coupler_point.real() : nan);
    y.push_back(there ? pose.coupler_point.imag() : nan);
    table.status.emplace_back(to_string(pose.status));
  }
  math::unwrap_angles(coupler);
  math::unwrap_angles(rocker);
  table.add("crank_angle_rad", "crank angle (rad)", angles);
  table.add("coupler_angle_rad", "coupler angle (rad)", std::move(coupler));
  table.add("rocker_angle_rad", "rocker angle (rad)", std::move(rocker));
  table.add("transmission_angle_rad", "transmission angle (rad)", std::move(transmission));
  table.add("coupler_x_m", "coupler point x (m)", std::move(x));
  table.add("coupler_y_m", "coupler point y (m)", std::move(y));
  return table;
}

Table point_table(const PathProblem& problem, const PathDesign& design, std::string name) {
  Table table;
  table.name = std::move(name);
  const PathErrors errors = path_errors(problem, design);
  std::vector<double> number;
  for (std::size_t k = 0; k < problem.x.size(); ++k) {
    number.push_back(static_cast<double>(k + 1));
    table.status.emplace_back(std::isfinite(errors.distance[k]) ? "done" : "no_assembly");
  }
  table.add("point", "point", std::move(number));
  table.add("crank_angle_rad", "crank angle (rad)", design.angles);
  table.add("target_x_m", "target x (m)", problem.x);
  table.add("target_y_m", "target y (m)", problem.y);
  table.add("x_m", "reached x (m)", errors.x);
  table.add("y_m", "reached y (m)", errors.y);
  table.add("distance_m", "distance (m)", errors.distance);
  if (!problem.tolerance.empty()) {
    table.add("tolerance_m", "tolerance (m)", problem.tolerance);
    table.add("excess_m", "distance beyond the tolerance (m)", errors.excess);
  }
  return table;
}

}  // namespace linkwright::planar
