// SPDX-License-Identifier: BSD-3-Clause
#include "tests/report/sample_spatial.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"

namespace linkwright::report::test {
namespace {

using Vec = Eigen::Vector3d;
constexpr double wheel_radius = 0.302, wheel_width = 0.205;

// Place at given distances from three others, on the side to which (b - a) x (c - a) points times `side`.
Vec trilaterate(const Vec& a, double ra, const Vec& b, double rb, const Vec& c, double rc, double side) {
  const Vec ex = (b - a).normalized();
  const double i = ex.dot(c - a), d = (b - a).norm();
  const Vec ey = (c - a - i * ex).normalized();
  const double j = ey.dot(c - a);
  const double x = (ra * ra - rb * rb + d * d) / (2 * d);
  const double y = (ra * ra - rc * rc + i * i + j * j) / (2 * j) - i / j * x;
  return a + x * ex + y * ey + side * std::sqrt(ra * ra - x * x - y * y) * ex.cross(ey);
}

struct Wishbones {
  Vec lower_front{0.21, 0.38, -0.1}, lower_rear{-0.19, 0.39, -0.095}, lower{0.01, 0.72, -0.125};
  Vec upper_front{0.12, 0.45, 0.175}, upper_rear{-0.16, 0.455, 0.165}, upper{-0.02, 0.68, 0.195};
  Vec tie_in{-0.14, 0.36, -0.04}, tie_out{-0.13, 0.69, -0.05};
  Vec centre{0, 0.76, 0.02}, axis{0, 0.62, 0.0224};
  Vec spring_top{0.02, 0.5, 0.36}, spring_foot{0.012, 0.6, -0.112};
};

struct WishbonePose {
  Vec lower, upper, tie_in, tie_out, centre, axis, contact, spring_foot;
  bool assembled() const { return (upper + tie_out).allFinite(); }
};

double side_of(const Vec& a, const Vec& b, const Vec& c, const Vec& p) {
  return std::copysign(1.0, (b - a).cross(c - a).dot(p - a));
}

Vec follow(const Vec& a, const Vec& ao, const Vec& b, const Vec& bo, const Vec& c, const Vec& co,
           const Vec& po) {
  return trilaterate(a, (po - ao).norm(), b, (po - bo).norm(), c, (po - co).norm(), side_of(ao, bo, co, po));
}

// The pose for an angle of the lower arm about its hinge.
WishbonePose pose(const Wishbones& w, double angle, double rack) {
  WishbonePose p;
  const Eigen::AngleAxisd turn(angle, (w.lower_front - w.lower_rear).normalized());
  const auto on_arm = [&](const Vec& v) { return Vec(w.lower_rear + turn * (v - w.lower_rear)); };
  p.lower = on_arm(w.lower);
  p.spring_foot = on_arm(w.spring_foot);
  p.upper = follow(w.upper_front, w.upper_front, w.upper_rear, w.upper_rear, p.lower, w.lower, w.upper);
  p.tie_in = w.tie_in + Vec(0, rack, 0);
  p.tie_out =
      trilaterate(p.lower, (w.tie_out - w.lower).norm(), p.upper, (w.tie_out - w.upper).norm(), p.tie_in,
                  (w.tie_out - w.tie_in).norm(), side_of(w.lower, w.upper, w.tie_in, w.tie_out));
  const auto on_carrier = [&](const Vec& v) {
    // The side of a place near the plane of the three joints would be uncertain: take it by coordinates.
    const auto frame = [](const Vec& a, const Vec& b, const Vec& c) {
      Eigen::Matrix3d m;
      m.col(0) = (b - a).normalized();
      m.col(2) = m.col(0).cross(c - a).normalized();
      m.col(1) = m.col(2).cross(m.col(0));
      return m;
    };
    const Vec local = frame(w.lower, w.upper, w.tie_out).transpose() * (v - w.lower);
    return Vec(p.lower + frame(p.lower, p.upper, p.tie_out) * local);
  };
  p.centre = on_carrier(w.centre);
  p.axis = on_carrier(w.axis);
  const Vec along = (p.axis - p.centre).normalized();
  p.contact = p.centre - wheel_radius * (Vec(0, 0, 1) - along.z() * along).normalized();
  return p;
}

// The pose in which the wheel centre has risen by `travel`.
WishbonePose at_travel(const Wishbones& w, double travel, double rack) {
  double low = -0.6, high = 0.6;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (pose(w, middle, rack).centre.z() < w.centre.z() + travel ? low : high) = middle;
  }
  return pose(w, (low + high) / 2, rack);
}

struct Grid {
  std::vector<double> travel, rack;
  Grid() {
    for (int i = -20; i <= 20; ++i) travel.push_back(0.004 * i);
    for (int k = -2; k <= 2; ++k) rack.push_back(0.02 * k);
  }
};

Table table_of(const Wishbones& w, const std::string& name) {
  const Grid grid;
  std::vector<double> travels, racks, toes, cambers, lowest, highest;
  for (const double rack : grid.rack)
    for (const double travel : grid.travel) {
      const WishbonePose p = at_travel(w, travel, rack);
      const Vec inward = (p.axis - p.centre).normalized();
      travels.push_back(travel);
      racks.push_back(rack);
      toes.push_back(std::atan2(-inward.x(), -inward.y()));
      cambers.push_back(std::asin(inward.z()));
      const double wanted = rack == 0 ? -0.02 * travel : nan;
      lowest.push_back(wanted - 0.002);
      highest.push_back(wanted + 0.002);
    }
  Table table;
  table.name = name;
  table.add("travel_m", "wheel travel (m)", travels);
  table.add("rack_m", "rack (m)", racks);
  table.add("toe_rad", "toe (rad)", toes);
  table.add("camber_rad", "camber (rad)", cambers);
  table.add("toe_lowest_rad", "lowest toe (rad)", lowest);
  table.add("toe_highest_rad", "highest toe (rad)", highest);
  return table;
}

}  // namespace

study::Result sample_spatial() {
  using Body = study::Scene::BodyStyle;
  using Joint = study::Scene::JointStyle;
  using Quantity = study::Scene::Quantity;
  using Style = study::Plot::Style;
  enum { LF, LR, L, UF, UR, U, TI, TO, C, A, W, ST, SF };
  const Wishbones w;
  const Grid grid;
  study::Scene scene;
  scene.name = "wheel";
  scene.title = "Double wishbone, left wheel";
  scene.input_key = "travel_m";
  scene.input_label = "wheel travel";
  scene.input = grid.travel;
  scene.second_key = "rack_m";
  scene.second_label = "rack";
  scene.second = grid.rack;
  const char* names[] = {"LF", "LR", "L", "UF", "UR", "U", "TI", "TO", "C", "axis", "W", "ST", "SF"};
  for (const char* name : names) scene.points.push_back({name, {}, {}, {}});
  const auto put = [&](int point, const Vec& v) {
    auto& p = scene.points[static_cast<std::size_t>(point)];
    p.x.push_back(v.x());
    p.y.push_back(v.y());
    p.z.push_back(v.z());
  };
  put(LF, w.lower_front);
  put(LR, w.lower_rear);
  put(UF, w.upper_front);
  put(UR, w.upper_rear);
  put(ST, w.spring_top);
  std::vector<double> side_force;
  for (const double rack : grid.rack)
    for (const double travel : grid.travel) {
      const WishbonePose p = at_travel(w, travel, rack);
      scene.status.push_back(p.assembled() ? "done" : "no_assembly");
      put(L, p.lower);
      put(U, p.upper);
      put(TI, p.tie_in);
      put(TO, p.tie_out);
      put(C, p.centre);
      put(A, p.axis);
      put(W, p.contact);
      put(SF, p.spring_foot);
      side_force.push_back(20000 * rack);
    }
  scene.bodies = {{"lower arm", {LF, L, LR}, Body::plate}, {"upper arm", {UF, U, UR}, Body::plate},
                  {"tie rod", {TI, TO}, Body::bar},        {"wheel carrier", {L, U, TO, C}, Body::plate},
                  {"spring", {SF, ST}, Body::spring},      {"damper", {SF, ST}, Body::damper},
                  {"lower hinge", {LF, LR}, Body::ground}, {"upper hinge", {UF, UR}, Body::ground},
                  {"steering axis", {L, U}, Body::axis}};
  scene.joints = {{"LF", LF, Joint::ground_pivot}, {"LR", LR, Joint::ground_pivot},
                  {"UF", UF, Joint::ground_pivot}, {"UR", UR, Joint::ground_pivot},
                  {"L", L, Joint::pivot},          {"U", U, Joint::pivot},
                  {"TI", TI, Joint::pivot},        {"TO", TO, Joint::pivot},
                  {"ST", ST, Joint::ground_pivot}, {"W", W, Joint::tracer}};
  scene.traces = {{W, "contact point"}, {C, "wheel centre"}};
  scene.discs = {{"left wheel", C, A, wheel_radius, wheel_width}};
  scene.vectors = {{"tyre force", Quantity::force, "N", W, {0}, side_force, "F", {4000}},
                   {"velocity of the wheel centre", Quantity::velocity, "m/s", C, {0}, {0.02}, "v", {0.4}}};

  study::Result result;
  result.headline = "Toe stays within its band over the whole travel";
  Wishbones higher = w;
  higher.tie_in.z() += 0.012;
  result.tables = {table_of(w, "wheel parameters"), table_of(higher, "wheel parameters before")};
  study::Plot toe{.name = "toe",
                  .title = "Toe over travel",
                  .table = "wheel parameters",
                  .x = "travel_m",
                  .y = {"toe_rad"},
                  .style = Style::line,
                  .logarithmic_y = false,
                  .scene = "wheel",
                  .group = "rack_m",
                  .bands = {{"toe_lowest_rad", "toe_highest_rad", "target toe"}},
                  .baseline = "wheel parameters before"};
  study::Plot camber = toe;
  camber.name = "camber";
  camber.title = "Camber over travel";
  camber.y = {"camber_rad"};
  camber.bands = {};
  camber.baseline = {};
  study::Plot steer = camber;
  steer.name = "steer";
  steer.title = "Toe over rack";
  steer.x = "rack_m";
  steer.y = {"toe_rad"};
  steer.group = "travel_m";
  toe.upright = true;
  result.plots = {toe, camber, steer};
  result.scenes = {scene};
  return result;
}

}  // namespace linkwright::report::test
