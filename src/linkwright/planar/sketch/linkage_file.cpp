// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <complex>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/drawing/detail/fault.h"
#include "linkwright/planar/drawing/detail/xml_tags.h"
#include "linkwright/planar/sketch/detail/sketch_points.h"
#include "linkwright/planar/sketch/sketch.h"

// Files of the program Linkage: https://blog.rectorsquid.com/linkage-mechanism-designer-and-simulator
namespace linkwright::planar {
namespace {

using drawing::Fault, drawing::TagKind, drawing::XmlTag, drawing::XmlTags, sketching::left_below,
    sketching::Place, sketching::shown_place;

constexpr const char* save_again = "save the mechanism again with Linkage: the file is damaged or cut off";
constexpr int mechanism_layer = 16;  // other layers hold drawings and dimensions

/// A point of the file.
struct Connector {
  int line = 0;
  Place at;  ///< m
  bool anchor = false, driven = false, traced = false, slides = false, curved = false;
  double speed = 0;                ///< rad/s
  std::vector<int> limits;         ///< connectors between which it slides
  std::optional<int> fastened_to;  ///< link
};

/// A body of the file.
struct FileLink {
  int line = 0;
  std::vector<int> connectors;
  std::vector<int> fastened;  ///< connectors that move with it
  bool gear = false, actuator = false;
  double speed = 0;                ///< of an actuator: its mean speed (m/s)
  std::optional<int> fastened_to;  ///< another link
};

/// A pair of gears, or two sprockets with a chain, by links and sizes.
struct FileRatio {
  int line = 0;
  bool chain = false;
  std::vector<std::pair<int, double>> links;
};

struct LinkageFile {
  std::map<int, Connector> connectors;
  std::map<int, FileLink> links;
  std::vector<FileRatio> ratios;
  std::string units;
};

/// The words and numbers of a tag.
class Attributes {
 public:
  explicit Attributes(const XmlTag& tag) : tag_(tag) {}

  std::string text(std::string_view key) const { return tag_.value(key).value_or(""); }
  bool flag(std::string_view key) const { return text(key) == "true"; }
  double number(std::string_view key, double otherwise) const {
    const std::string text = this->text(key);
    if (text.empty()) return otherwise;
    double value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || stop != text.data() + text.size() || !(std::abs(value) < 1e9)) refuse(key);
    return value;
  }
  std::optional<int> whole(std::string_view key) const {
    const std::string text = this->text(key);
    if (text.empty()) return std::nullopt;
    int value = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || stop != text.data() + text.size()) refuse(key);
    return value;
  }
  int identifier() const {
    const std::optional<int> id = whole("id");
    if (!id) throw Fault{tag_.line, fmt::format("<{}> has no id", drawing::shown(tag_.name, 20)), save_again};
    return *id;
  }

 private:
  [[noreturn]] void refuse(std::string_view key) const {
    throw Fault{tag_.line,
                fmt::format("{} = '{}' of <{}> is not a number in range", key, drawing::shown(text(key), 20),
                            drawing::shown(tag_.name, 20)),
                save_again};
  }
  const XmlTag& tag_;
};

/// Reads the elements of a file one by one.
class FileReader {
 public:
  LinkageFile read(std::string_view text) {
    XmlTags tags(text);
    XmlTag tag;
    std::vector<std::string> open;
    while (tags.next(tag)) {
      if (tag.kind == TagKind::end) {
        if (!open.empty()) open.pop_back();
        continue;
      }
      if (open.size() == 1) take(tag);
      if (open.size() >= 2) take_part(open[1], tag);
      if (tag.kind == TagKind::begin) open.emplace_back(tag.name);
      if (open.size() > 100)
        throw Fault{tag.line, "more than 100 elements lie within each other", save_again};
    }
    for (auto& [id, connector] : out_.connectors) connector.at *= 1e-3 * scale_;
    for (auto& [id, link] : out_.links) link.speed *= 1e-3 * scale_;
    return std::move(out_);
  }

 private:
  void take(const XmlTag& tag) {
    const Attributes values(tag);
    connector_ = nullptr;
    link_ = nullptr;
    if (tag.name == "program") {
      scale_ = values.number("scalefactor", 1);
      if (scale_ == 0) scale_ = 1;
      out_.units = values.text("units");
    } else if (tag.name == "connector") {
      take_connector(tag.line, values);
    } else if (tag.name == "Link" || tag.name == "element") {
      take_link(tag.line, values);
    }
  }

  static bool is_drawing(const Attributes& values) {
    const int layer = values.whole("layer").value_or(0);
    return (layer != 0 && (layer & mechanism_layer) == 0) || values.flag("measurementelement");
  }

  void take_connector(int line, const Attributes& values) {
    if (is_drawing(values)) return;
    const int id = values.identifier();
    const auto [at, is_new] = out_.connectors.emplace(id, Connector{});
    if (!is_new) throw Fault{line, fmt::format("two connectors have the id {}", id), save_again};
    connector_ = &at->second;
    *connector_ = {.line = line,
                   .at = {values.number("x", 0), values.number("y", 0)},
                   .anchor = values.flag("anchor"),
                   .driven = values.flag("input"),
                   .traced = values.flag("draw"),
                   .slides = values.flag("slider"),
                   .curved = values.number("slideradius", 0) != 0,
                   .speed = values.number("rpm", 15) * pi / 30,
                   .limits = {},
                   .fastened_to = values.whole("fasten")};
    if (!connector_->fastened_to) connector_->fastened_to = values.whole("fastenlink");
  }

  void take_link(int line, const Attributes& values) {
    if (is_drawing(values)) return;
    const int id = values.identifier();
    const auto [at, is_new] = out_.links.emplace(id, FileLink{});
    if (!is_new) throw Fault{line, fmt::format("two links have the id {}", id), save_again};
    link_ = &at->second;
    // An actuator goes out and back once a cycle.
    *link_ = {.line = line,
              .connectors = {},
              .fastened = {},
              .gear = values.flag("gear"),
              .actuator = values.flag("actuator"),
              .speed = 2 * values.number("throw", 0) * values.number("cpm", 15) / 60,
              .fastened_to = values.whole("fastenlink")};
    if (const auto connector = values.whole("fastenconnector")) link_->fastened.push_back(*connector);
  }

  /// An element within a connector, a link or the list of ratios.
  void take_part(const std::string& within, const XmlTag& tag) {
    const Attributes values(tag);
    if (within == "connector" && tag.name == "slidelimit" && connector_)
      connector_->limits.push_back(values.identifier());
    else if ((within == "Link" || within == "element") && link_ && tag.name == "connector")
      link_->connectors.push_back(values.identifier());
    else if ((within == "Link" || within == "element") && link_ && tag.name == "fastenconnector")
      link_->fastened.push_back(values.identifier());
    else if (within == "ratios" && tag.name == "ratio")
      out_.ratios.push_back({tag.line, values.text("type") != "gears", {}});
    else if (within == "ratios" && tag.name == "link" && !out_.ratios.empty())
      out_.ratios.back().links.emplace_back(values.identifier(), values.number("size", 0));
  }

  LinkageFile out_;
  double scale_ = 1;
  Connector* connector_ = nullptr;
  FileLink* link_ = nullptr;
};

/// Builds a sketch from a file.
class Builder {
 public:
  explicit Builder(const LinkageFile& file) : file_(file) {}

  Sketch build() {
    if (file_.connectors.size() > most_sketch_places)
      throw Fault{0,
                  fmt::format("the file has {} connectors; at most {} are read", file_.connectors.size(),
                              most_sketch_places),
                  "leave out what does not move"};
    if (!file_.units.empty() && file_.units != "Millimeters")
      out_.questions.push_back(
          {fmt::format("the file shows its lengths in {}: are its coordinates millimetres, as Linkage keeps "
                       "them?",
                       drawing::shown(file_.units, 20)),
           "they are"});
    number_points();
    unite_links();
    add_bodies();
    for (const auto& [id, link] : file_.links)
      if (link.actuator) add_actuator(id, link);
    for (const auto& [id, connector] : file_.connectors)
      if (connector.slides) add_slide(id, connector);
    add_pins();
    for (const FileRatio& ratio : file_.ratios) add_gears(ratio);
    for (std::size_t body = 0; body < out_.bodies.size(); ++body) {
      auto& points = out_.bodies[body].points;
      for (const auto& [point, bodies] : members_)
        if (std::find(bodies.begin(), bodies.end(), body) != bodies.end()) points.push_back(point);
      for (const auto& [point, owner] : guides_)
        if (owner == body) points.push_back(point);
      std::sort(points.begin(), points.end());
      points.erase(std::unique(points.begin(), points.end()), points.end());
    }
    sketching::name_sketch(out_);
    return std::move(out_);
  }

 private:
  /// Points have letters from left to right.
  void number_points() {
    std::vector<std::pair<Place, int>> sorted;
    for (const auto& [id, connector] : file_.connectors) sorted.emplace_back(connector.at, id);
    std::sort(sorted.begin(), sorted.end(), [](const auto& a, const auto& b) {
      return left_below(a.first, b.first) || (a.first == b.first && a.second < b.second);
    });
    for (const auto& [at, id] : sorted) {
      point_[id] = out_.points.size();
      if (file_.connectors.at(id).traced) out_.traced.push_back(out_.points.size());
      out_.points.push_back({sketching::letter_of(out_.points.size()), at});
    }
  }

  std::size_t point_of(int connector, int line) const {
    const auto found = point_.find(connector);
    if (found == point_.end())
      throw Fault{line, fmt::format("no connector has the id {}", connector), save_again};
    return found->second;
  }

  /// Links that are fastened to each other are one body.
  void unite_links() {
    for (const auto& [id, link] : file_.links) united_[id] = id;
    for (const auto& [id, link] : file_.links)
      if (link.fastened_to && united_.count(*link.fastened_to) > 0)
        united_[root(id)] = root(*link.fastened_to);
  }
  int root(int link) const {
    while (united_.at(link) != link) link = united_.at(link);
    return link;
  }

  /// The ground and a body for each link; a link with two anchors is the ground.
  void add_bodies() {
    out_.bodies.push_back({SketchBodyType::ground, {}, {}});
    std::map<int, int> anchors;
    for (const auto& [id, link] : file_.links)
      for (const int connector : link.connectors) {
        point_of(connector, link.line);
        if (!link.actuator && file_.connectors.at(connector).anchor) ++anchors[root(id)];
      }
    for (const auto& [id, link] : file_.links) {
      if (link.actuator) continue;
      const int whole = root(id);
      if (anchors[whole] > 1) body_[whole] = 0;
      if (body_.count(whole) == 0) {
        body_[whole] = out_.bodies.size();
        out_.bodies.push_back({link.gear && link.connectors.size() < 2 ? SketchBodyType::wheel
                               : link.connectors.size() > 2            ? SketchBodyType::plate
                                                                       : SketchBodyType::bar,
                               {},
                               {}});
      }
      for (const auto* list : {&link.connectors, &link.fastened})
        for (const int connector : *list) join(body_[whole], point_of(connector, link.line));
    }
    for (const auto& [id, connector] : file_.connectors) {
      if (connector.anchor) join(0, point_[id]);
      if (connector.fastened_to && united_.count(*connector.fastened_to) > 0 &&
          !file_.links.at(*connector.fastened_to).actuator)
        join(body_.at(root(*connector.fastened_to)), point_[id]);
    }
  }

  void join(std::size_t body, std::size_t point) {
    auto& bodies = members_[point];
    if (std::find(bodies.begin(), bodies.end(), body) == bodies.end()) bodies.push_back(body);
  }
  bool has(std::size_t point, std::size_t body) const {
    const auto found = members_.find(point);
    return found != members_.end() &&
           std::find(found->second.begin(), found->second.end(), body) != found->second.end();
  }

  /// A barrel at the first end, and a rod at the second that slides in it.
  void add_actuator(int id, const FileLink& link) {
    if (link.connectors.size() != 2) {
      out_.left_out.push_back(fmt::format("the actuator {} in line {} has {} connectors, not 2", id,
                                          link.line, link.connectors.size()));
      return;
    }
    const std::size_t from = point_of(link.connectors[0], link.line),
                      to = point_of(link.connectors[1], link.line);
    const std::size_t barrel = out_.bodies.size(), rod = barrel + 1;
    out_.bodies.push_back({SketchBodyType::bar, {}, {}});
    out_.bodies.push_back({SketchBodyType::block, {}, {}});
    join(barrel, from);
    join(rod, to);
    slide(barrel, rod, to, out_.points[to].at - out_.points[from].at);
    out_.drives.push_back({out_.joints.size() - 1, link.speed});
  }

  void slide(std::size_t owner, std::size_t block, std::size_t point, Place along) {
    double direction = std::arg(along);
    if (direction <= -pi / 2 || direction > pi / 2) direction = std::arg(-along);
    out_.joints.push_back({JointType::prismatic, {}, owner, block, point, direction});
    guides_.emplace_back(point, owner);
  }

  /// A connector that slides has a block on the body of both its limits.
  void add_slide(int id, const Connector& connector) {
    const auto left_out = [&](std::string_view why) {
      out_.left_out.push_back(fmt::format("the slide of the connector at {} in line {} {}",
                                          shown_place(connector.at), connector.line, why));
    };
    if (connector.curved) return left_out("is an arc; draw a link in its place");
    if (connector.limits.size() < 2) return left_out("has no two ends");
    const std::size_t from = point_of(connector.limits[0], connector.line),
                      to = point_of(connector.limits[1], connector.line);
    const auto& ends = members_[from];
    const auto owner =
        std::find_if(ends.begin(), ends.end(), [&](std::size_t body) { return has(to, body); });
    if (owner == ends.end()) return left_out("lies on no link and not on the ground");
    if (from == to || out_.points[from].at == out_.points[to].at) return left_out("has no direction");
    const std::size_t block = out_.bodies.size(), body = *owner;
    out_.bodies.push_back({SketchBodyType::block, {}, {}});
    join(block, point_[id]);
    slide(body, block, point_[id], out_.points[to].at - out_.points[from].at);
  }

  /// One pin less than bodies at each point; wheels turn about the first of them.
  void add_pins() {
    std::vector<SketchJoint> pins;
    std::vector<SketchDrive> turned;
    for (auto& [point, bodies] : members_) {
      std::sort(bodies.begin(), bodies.end());
      for (std::size_t i = 1; i < bodies.size(); ++i)
        pins.push_back(
            {JointType::revolute, {}, bodies[0] == 0 ? bodies[0] : bodies[i - 1], bodies[i], point, 0});
    }
    for (const auto& [id, connector] : file_.connectors) {
      if (!connector.driven) continue;
      const std::size_t point = point_[id];
      const auto pin = std::find_if(pins.begin(), pins.end(),
                                    [&](const SketchJoint& joint) { return joint.point == point; });
      if (pin != pins.end())
        turned.push_back({static_cast<std::size_t>(pin - pins.begin()), connector.speed});
    }
    for (SketchDrive& drive : out_.drives) drive.joint += pins.size();
    out_.drives.insert(out_.drives.begin(), turned.begin(), turned.end());
    out_.joints.insert(out_.joints.begin(), pins.begin(), pins.end());
  }

  void add_gears(const FileRatio& ratio) {
    SketchGear gear;
    bool known = ratio.links.size() == 2;
    for (std::size_t side = 0; known && side < 2; ++side) {
      const auto& [id, size] = ratio.links[side];
      const auto link = file_.links.find(id);
      known =
          link != file_.links.end() && size > 0 && !link->second.connectors.empty() && !link->second.actuator;
      if (!known) break;
      gear.bodies[side] = body_.at(root(id));
      gear.points[side] = point_of(link->second.connectors[0], link->second.line);
    }
    if (!known || gear.bodies[0] == gear.bodies[1]) {
      out_.left_out.push_back(fmt::format("the ratio in line {} names no two wheels", ratio.line));
      return;
    }
    gear.ratio = (ratio.chain ? 1 : -1) * ratio.links[0].second / ratio.links[1].second;
    out_.gears.push_back(gear);
  }

  const LinkageFile& file_;
  Sketch out_;
  std::map<int, std::size_t> point_;                         ///< by connectors
  std::map<int, int> united_;                                ///< links
  std::map<int, std::size_t> body_;                          ///< by united links
  std::map<std::size_t, std::vector<std::size_t>> members_;  ///< bodies by points
  std::vector<std::pair<std::size_t, std::size_t>> guides_;  ///< point and body of slides
};

}  // namespace

bool is_linkage_file(std::string_view text) {
  return text.substr(0, 1000).find("<linkage2") != std::string_view::npos;
}

std::optional<Sketch> read_linkage_file(std::string_view text, const std::string& file,
                                        Diagnostics& diagnostics) {
  try {
    const LinkageFile read = FileReader().read(text);
    Sketch out = Builder(read).build();
    if (out.bodies.size() > 1) return out;
    throw Fault{0, "the file has no link that moves", "save a mechanism with links"};
  } catch (const Fault& fault) {
    diagnostics.push_back({.file = file,
                           .position = {.line = fault.line, .column = fault.line > 0 ? 1 : 0},
                           .message = fault.message,
                           .hint = fault.hint});
  }
  return std::nullopt;
}

}  // namespace linkwright::planar
