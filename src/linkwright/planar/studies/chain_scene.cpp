// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/chain_scene.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/chains/sketch.h"

namespace linkwright::planar {
namespace {

using study::Scene;
using Point = math::Vec2;

constexpr int columns = 5, rows = 4;
constexpr double gap = 1.1;  // between figures, in bars
constexpr double bar = 0.1;  // m: drawings have no size of their own

struct Extent {
  Point low{infinity, infinity}, high{-infinity, -infinity};
  double width() const { return high.x - low.x; }
  double height() const { return high.y - low.y; }
};

Extent extent_of(const ChainSketch& drawn) {
  Extent out;
  for (const Point& p : drawn.joints) {
    out.low = {std::min(out.low.x, p.x), std::min(out.low.y, p.y)};
    out.high = {std::max(out.high.x, p.x), std::max(out.high.y, p.y)};
  }
  return out;
}

double length(const Point& a) { return std::hypot(a.x, a.y); }

// Draws one figure into a sheet.
class FigureDrawer {
 public:
  FigureDrawer(Scene& scene, const ChainFigure& figure, const ChainSketch& drawn, const Point& place)
      : scene_(scene),
        figure_(figure),
        graph_(figure.chain->graph),
        joints_(joints_of(graph_)),
        first_(static_cast<int>(scene.points.size())) {
    const Point low = extent_of(drawn).low;
    for (std::size_t j = 0; j < joints_.size(); ++j)
      add_point(fmt::format("{} joint {}-{}", figure.name, joints_[j][0] + 1, joints_[j][1] + 1),
                drawn.joints[j] - low + place);
    links(drawn);
    for (int j = 0; j < std::ssize(joints_); ++j)
      if ((figure.marking.sliders >> j & 1) != 0) slider(drawn, j);
    if (figure.marking.gear) gears(*figure.marking.gear);
    if (figure.marking.driver) driver(drawn);
    pins(drawn);
  }

 private:
  int add_point(std::string name, const Point& p) {
    scene_.points.push_back({std::move(name), {bar * p.x}, {bar * p.y}});
    return static_cast<int>(scene_.points.size()) - 1;
  }
  Point place(int joint) const {
    const Scene::Point& p = scene_.points[at(first_ + joint)];
    return {p.x[0] / bar, p.y[0] / bar};
  }
  bool is_ground(int link) const { return figure_.marking.ground == link; }
  // The link of a joint that is not the given one.
  int other(int joint, int link) const {
    const JointEnds& ends = joints_[at(joint)];
    return ends[0] == link ? ends[1] : ends[0];
  }

  void links(const ChainSketch& drawn) {
    for (int link = 0; link < graph_.links; ++link) {
      Scene::Body body{fmt::format("link {}", link + 1), {}, Scene::BodyStyle::bar};
      for (const int j : drawn.links[at(link)]) body.points.push_back(first_ + j);
      if (is_ground(link)) {
        body.name = "ground";
        body.style = Scene::BodyStyle::ground;
        if (body.points.size() > 2) body.points.push_back(body.points.front());
      } else if (body.points.size() > 2) {
        body.style = Scene::BodyStyle::plate;
      }
      scene_.bodies.push_back(std::move(body));
    }
  }

  // The guide belongs to the ground or to the smaller number; it lies along a side of its link.
  void slider(const ChainSketch& drawn, int joint) {
    const int owner = is_ground(joints_[at(joint)][1]) ? joints_[at(joint)][1] : joints_[at(joint)][0];
    const std::vector<int>& around = drawn.links[at(owner)];
    const auto self = std::find(around.begin(), around.end(), joint);
    const int beside = self + 1 == around.end() ? around.front() : *(self + 1);
    const Point centre = place(joint), towards = place(beside) - centre;
    const Point along = slide_direction(joint, 1 / length(towards) * towards), across = perpendicular(along);
    const std::string name = fmt::format("slide {}-{}", owner + 1, other(joint, owner) + 1);
    Scene::Body block{name, {}, Scene::BodyStyle::plate};
    for (const auto& [u, v] : {std::pair{-1, -1}, std::pair{1, -1}, std::pair{1, 1}, std::pair{-1, 1}})
      block.points.push_back(add_point(name, centre + 0.16 * u * along + 0.09 * v * across));
    const int from = add_point(name, centre - 0.4 * along), to = add_point(name, centre + 0.4 * along);
    scene_.bodies.push_back({"guide of " + name, {from, to}, Scene::BodyStyle::guide});
    scene_.bodies.push_back(std::move(block));
  }

  // Slides of one link cross each other: parallel ones would let it slip through both.
  Point slide_direction(int joint, Point along) {
    const JointEnds& ends = joints_[at(joint)];
    const auto shares_link = [&](int before) {
      const JointEnds& others = joints_[at(before)];
      return std::find_first_of(ends.begin(), ends.end(), others.begin(), others.end()) != ends.end();
    };
    for (const auto& [before, direction] : slides_)
      if (shares_link(before) && std::abs(cross(direction, along)) < 0.3) along = perpendicular(along);
    slides_.emplace_back(joint, along);
    return along;
  }

  int joint_between(int a, int b) const {
    const JointEnds ends{std::min(a, b), std::max(a, b)};
    return static_cast<int>(std::lower_bound(joints_.begin(), joints_.end(), ends) - joints_.begin());
  }

  // Pitch circles about the pins of both links on the carrier.
  void gears(const GearPair& gear) {
    const int first = joint_between(gear.carrier, gear.first),
              second = joint_between(gear.carrier, gear.second);
    const Point a = place(first), b = place(second);
    const int mesh = add_point("mesh", 0.5 * (a + b));
    scene_.circles.push_back({fmt::format("gear of link {}", gear.first + 1), first_ + first, mesh});
    scene_.circles.push_back({fmt::format("gear of link {}", gear.second + 1), first_ + second, mesh});
  }

  // A small circle about the driven joint, its mark on the driven link.
  void driver(const ChainSketch& drawn) {
    const int joint = *figure_.marking.driver, link = other(joint, *figure_.marking.ground);
    const std::vector<int>& around = drawn.links[at(link)];
    const auto self = std::find(around.begin(), around.end(), joint);
    const Point centre = place(joint),
                towards = place(self + 1 == around.end() ? around.front() : *(self + 1)) - centre;
    const int rim = add_point("driver", centre + 0.3 / length(towards) * towards);
    scene_.circles.push_back({"driven joint", first_ + joint, rim});
  }

  // The uppermost joint carries the name, the left one of several.
  void pins(const ChainSketch& drawn) {
    const auto top =
        std::max_element(drawn.joints.begin(), drawn.joints.end(),
                         [](const Point& a, const Point& b) { return a.y - 0.3 * a.x < b.y - 0.3 * b.x; });
    for (int j = 0; j < std::ssize(joints_); ++j) {
      const bool named = j == top - drawn.joints.begin();
      const bool fixed = is_ground(joints_[at(j)][0]) || is_ground(joints_[at(j)][1]);
      if (!named && (figure_.marking.sliders >> j & 1) != 0) continue;
      scene_.joints.push_back({named ? figure_.name : std::string(), first_ + j,
                               fixed && (figure_.marking.sliders >> j & 1) == 0
                                   ? Scene::JointStyle::ground_pivot
                                   : Scene::JointStyle::pivot});
    }
  }

  Scene& scene_;
  const ChainFigure& figure_;
  const ChainGraph& graph_;
  const std::vector<JointEnds> joints_;
  int first_;                                  // index of the point of the first joint
  std::vector<std::pair<int, Point>> slides_;  // joints that slide, and along which directions
};

Scene sheet(std::span<const ChainFigure> figures, std::size_t number, std::size_t sheets) {
  Scene out;
  out.name = fmt::format("sheet-{}", number);
  out.title = sheets == 1 ? say("Sketches") : say("Sketches {} of {}", number, sheets);
  out.input_key = "position_rad";
  out.input_label = "drawn position";
  out.input = {0};
  std::vector<ChainSketch> drawn;
  double width = 0, height = 0;
  for (const ChainFigure& figure : figures) {
    drawn.push_back(sketch(figure.chain->graph, figure.marking.ground));
    const Extent size = extent_of(drawn.back());
    width = std::max(width, size.width() + gap), height = std::max(height, size.height() + gap);
  }
  for (std::size_t k = 0; k < figures.size(); ++k) {
    const auto column = static_cast<double>(k % columns), row = static_cast<double>(k / columns);
    FigureDrawer(out, figures[k], drawn[k], {width * column, -height * row});
  }
  return out;
}

}  // namespace

std::vector<Scene> chain_sheets(std::span<const ChainFigure> figures) {
  constexpr std::size_t on_sheet = columns * rows;
  const std::size_t sheets = (figures.size() + on_sheet - 1) / on_sheet;
  std::vector<Scene> out;
  for (std::size_t k = 0; k < sheets; ++k)
    out.push_back(sheet(figures.subspan(k * on_sheet, std::min(on_sheet, figures.size() - k * on_sheet)),
                        k + 1, sheets));
  return out;
}

}  // namespace linkwright::planar
