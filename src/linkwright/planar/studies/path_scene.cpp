#include "linkwright/planar/studies/path_scene.h"

#include <cmath>
#include <complex>
#include <utility>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/math/angles.h"
#include "linkwright/planar/four_bar/classify.h"
#include "linkwright/planar/studies/path_reached.h"

namespace linkwright::planar {
namespace {

bool assembled(const FourBarPosition& pose) { return pose.status != Status::no_assembly; }

// The linkage at the given crank angles, without targets.
study::Scene linkage_over(const FourBar& linkage, std::vector<double> crank_angles) {
  enum { O1, O4, O2, O3, C };  // order of the points
  study::Scene scene;
  scene.input_key = "crank_angle_rad";
  scene.input_label = "crank angle";
  scene.input = std::move(crank_angles);
  scene.points = {{"O1", {}, {}}, {"O4", {}, {}}, {"O2", {}, {}}, {"O3", {}, {}}, {"C", {}, {}}};
  const auto put = [&](int point, std::complex<double> at, bool there) {
    scene.points[static_cast<std::size_t>(point)].x.push_back(there ? at.real() : nan);
    scene.points[static_cast<std::size_t>(point)].y.push_back(there ? at.imag() : nan);
  };
  put(O1, crank_pivot(linkage), true);
  put(O4, rocker_pivot(linkage), true);
  for (const double angle : scene.input) {
    const FourBarPosition pose = position(linkage, angle);
    put(O2, pose.crank_pin, true);
    put(O3, pose.coupler_pin, assembled(pose));
    put(C, pose.coupler_point, assembled(pose));
    scene.status.emplace_back(to_string(pose.status));
  }
  using Body = study::Scene::BodyStyle;
  scene.bodies = {{"ground", {O1, O4}, Body::ground},
                  {"crank", {O1, O2}, Body::bar},
                  {"coupler", {O2, O3, C}, Body::plate},
                  {"rocker", {O4, O3}, Body::bar}};
  using Joint = study::Scene::JointStyle;
  scene.joints = {{"O1", O1, Joint::ground_pivot},
                  {"O4", O4, Joint::ground_pivot},
                  {"O2", O2, Joint::pivot},
                  {"O3", O3, Joint::pivot},
                  {"C", C, Joint::tracer}};
  scene.traces = {{C, "coupler curve", classify(linkage).crank_rotates_fully}};
  return scene;
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

study::Scene path_scene(const PathProblem& problem, const PathDesign& design, std::string name,
                        Sentence title, int samples) {
  study::Scene scene = linkage_over(design.linkage, shown_angles(design, samples));
  scene.name = std::move(name);
  scene.title = std::move(title);
  add_targets(scene, problem, design.angles, path_errors(problem, design));
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

}  // namespace linkwright::planar
