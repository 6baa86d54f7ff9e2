// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/drawing/detail/dxf_file.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <complex>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/drawing/detail/dxf_curves.h"
#include "linkwright/planar/drawing/detail/fault.h"

namespace linkwright::planar::drawing {
namespace {

using Point = std::complex<double>;

constexpr std::size_t most_points_a_turn = 96;
constexpr const char* damaged = "save the drawing again as an ASCII DXF: the file is damaged or cut off";
constexpr const char* flatten =
    "draw the curve in the xy plane, or flatten the drawing in the CAD program, and save it again";
constexpr const char* convert = "convert the curve to a polyline in the CAD program, and save it again";

/// A group code with its value, and the line of the value in the file.
struct Group {
  int code = 0;
  std::string_view value;
  int line = 0;
};

/// An entity: a range of groups. Vertices follow their polyline.
struct Entity {
  std::string_view type;
  int line = 0;
  std::vector<Group> groups;
  std::vector<Entity> vertices;
};

/// Takes lines off a text, whatever ends them.
class LineReader {
 public:
  explicit LineReader(std::string_view text) : text_(text) {}
  bool next(std::string_view& line) {
    if (at_ > text_.size()) return false;
    const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
    line = text_.substr(at_, end - at_);
    const bool two = text_.substr(end, 2) == "\r\n";
    at_ = end + (two ? 2 : 1);
    ++number_;
    return true;
  }
  int number() const { return number_; }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
  int number_ = 0;
};

/// The whole number that fills a text; none for another text.
std::optional<int> whole_number(std::string_view text) {
  text = trimmed(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  int value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || stop != text.data() + text.size()) return std::nullopt;
  return value;
}

/// Group codes and values, two lines each, up to the end of the drawing.
std::vector<Group> groups_of(std::string_view text) {
  if (text.starts_with("AutoCAD Binary DXF"))
    throw Fault{0, "this is a binary DXF file",
                "save the drawing as an ASCII DXF; any version from R12 on is read"};
  LineReader lines(text);
  std::vector<Group> out;
  for (std::string_view first, second; lines.next(first);) {
    if (out.empty() && trimmed(first).empty()) continue;
    const int at = lines.number();
    if (!lines.next(second)) break;
    const std::optional<int> code = whole_number(first);
    if (!code)
      throw Fault{at, fmt::format("'{}' stands where a group code belongs", shown(trimmed(first), 20)),
                  damaged};
    if (*code == 0 && trimmed(second) == "EOF") break;
    out.push_back({*code, trimmed(second), at + 1});
  }
  return out;
}

/// The first group of a section; none in a file without it.
std::optional<std::size_t> start_of_section(const std::vector<Group>& groups, std::string_view name) {
  for (std::size_t i = 1; i < groups.size(); ++i)
    if (groups[i].code == 2 && groups[i].value == name && groups[i - 1].value == "SECTION") return i + 1;
  return std::nullopt;
}

/// The entities of a section, vertices with their polyline. A file of entities alone has no sections: all of
/// it is ENTITIES.
std::vector<Entity> entities_of(const std::vector<Group>& groups, std::string_view section) {
  const std::optional<std::size_t> start = start_of_section(groups, section);
  if (!start && section != "ENTITIES") return {};
  std::vector<Entity> out;
  Entity* entity = nullptr;
  Entity ignored;
  for (std::size_t i = start.value_or(0); i < groups.size(); ++i) {
    const Group& group = groups[i];
    if (group.code == 0 && group.value == "ENDSEC") return out;
    if (group.code != 0) {
      if (entity) entity->groups.push_back(group);
      continue;
    }
    if (group.value == "VERTEX" && !out.empty() && out.back().type == "POLYLINE") {
      entity = &out.back().vertices.emplace_back(Entity{group.value, group.line, {}, {}});
    } else if (group.value == "SEQEND" || group.value == "SECTION") {
      entity = &ignored;
    } else {
      entity = &out.emplace_back(Entity{group.value, group.line, {}, {}});
    }
  }
  if (start)
    throw Fault{groups.back().line, fmt::format("the DXF file ends within its section {}", section), damaged};
  return out;
}

std::string name_of_entity(const Entity& entity) {
  return fmt::format("{} in line {}", shown(entity.type, 20), entity.line);
}

double value_of(const Group& group) {
  std::string_view text = group.value;
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || stop != text.data() + text.size() || !std::isfinite(value))
    throw Fault{group.line, fmt::format("'{}' is not a number", shown(group.value, 20)), damaged};
  return value;
}

std::vector<double> numbers_of(const Entity& entity, int code) {
  std::vector<double> out;
  for (const Group& group : entity.groups)
    if (group.code == code) out.push_back(value_of(group));
  return out;
}

std::optional<double> number_if(const Entity& entity, int code) {
  for (const Group& group : entity.groups)
    if (group.code == code) return value_of(group);
  return std::nullopt;
}
double number_or(const Entity& entity, int code, double otherwise) {
  return number_if(entity, code).value_or(otherwise);
}
double number_of(const Entity& entity, int code) {
  const std::optional<double> found = number_if(entity, code);
  if (!found)
    throw Fault{entity.line, fmt::format("{} has no group {}", name_of_entity(entity), code), damaged};
  return *found;
}
Point place_at(const Entity& entity, int code) {
  const double x = number_of(entity, code);
  return {x, number_of(entity, code + 10)};
}

std::string layer_of(const Entity& entity) {
  for (const Group& group : entity.groups)
    if (group.code == 8) return shown(group.value, 60);
  return "0";
}

/// A bit of the flags of an entity.
bool has_flag(const Entity& entity, unsigned flag) {
  const double flags = number_or(entity, 70, 0);
  return flags > 0 && flags < 65536 && (static_cast<unsigned>(flags) & flag) != 0;
}

/// True for an entity whose plane is seen from below.
bool is_below(const Entity& entity) {
  const double x = number_or(entity, 210, 0), y = number_or(entity, 220, 0), z = number_or(entity, 230, 1);
  if (std::hypot(x, y) > 1e-6 * std::abs(z))
    throw Fault{entity.line,
                fmt::format("{} lies in an inclined plane, whose normal is {}, {}, {}",
                            name_of_entity(entity), x, y, z),
                flatten};
  return z < 0;
}

/// Refuses an entity whose points have different heights.
void require_flat(const Entity& entity, const std::vector<double>& heights,
                  const std::vector<Point>& points) {
  if (heights.empty() || points.empty()) return;
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  double size = 0;
  for (const Point& p : points)
    size = std::max({size, std::abs(p.real() - points[0].real()), std::abs(p.imag() - points[0].imag())});
  if (*high - *low > 1e-6 * size)
    throw Fault{entity.line,
                fmt::format("{} is in space: its z goes from {} to {}", name_of_entity(entity), *low, *high),
                flatten};
}

struct Vertex {
  Point at;
  double bulge = 0;
};

/// Vertices with the arcs between them.
Line line_through(const std::vector<Vertex>& vertices, bool closed, std::size_t per_turn) {
  Line out{.points = {}, .closed = closed, .name = {}};
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const Vertex& a = vertices[i];
    if (closed || i + 1 < vertices.size())
      add_bulge(a.at, vertices[(i + 1) % vertices.size()].at, a.bulge, per_turn, out.points);
    else
      out.points.push_back(a.at);
  }
  return out;
}

Line light_polyline(const Entity& entity, std::size_t per_turn) {
  std::vector<Vertex> vertices;
  for (const Group& group : entity.groups) {
    if (group.code == 10)
      vertices.push_back({value_of(group)});
    else if (group.code == 20 && !vertices.empty())
      vertices.back().at.imag(value_of(group));
    else if (group.code == 42 && !vertices.empty())
      vertices.back().bulge = value_of(group);
  }
  return line_through(vertices, has_flag(entity, 1), per_turn);
}

Line old_polyline(const Entity& entity, std::size_t per_turn) {
  if (has_flag(entity, 16 | 64))
    throw Fault{entity.line, name_of_entity(entity) + " is a mesh, which is not a line", flatten};
  std::vector<Vertex> vertices;
  std::vector<double> heights;
  std::vector<Point> points;
  for (const Entity& vertex : entity.vertices) {
    if (has_flag(vertex, 16)) continue;  // points of the frame of a fitted spline are not on the curve
    vertices.push_back({place_at(vertex, 10), number_or(vertex, 42, 0)});
    points.push_back(vertices.back().at);
    heights.push_back(number_or(vertex, 30, 0));
  }
  require_flat(entity, heights, points);
  return line_through(vertices, has_flag(entity, 1), per_turn);
}

/// The angle from one direction to another, counterclockwise, more than 0 and at most a turn.
double span_from(double from, double to) {
  if (std::abs(std::abs(to - from) - full_turn) < 1e-4) return full_turn;  // 2 pi, written with a few digits
  const double span = std::fmod(to - from, full_turn);
  return span > 1e-9 ? span : span + full_turn;
}

double radius_of(const Entity& entity) {
  const double radius = number_of(entity, 40);
  if (!(radius > 0))
    throw Fault{entity.line, fmt::format("{} has the radius {}", name_of_entity(entity), radius),
                "delete it, or give it a positive radius"};
  return radius;
}

Line circular_arc(const Entity& entity, std::size_t per_turn) {
  Line out;
  const double from = number_of(entity, 50) * pi / 180, to = number_of(entity, 51) * pi / 180;
  const Point centre = place_at(entity, 10);
  const double radius = radius_of(entity);
  add_ellipse(centre, radius, {0, radius}, from, span_from(from, to), per_turn, out.points);
  return out;
}

Line whole_circle(const Entity& entity, std::size_t per_turn) {
  Line out{.points = {}, .closed = true, .name = {}};
  const Point centre = place_at(entity, 10);
  const double radius = radius_of(entity);
  add_ellipse(centre, radius, {0, radius}, 0, full_turn, per_turn, out.points);
  out.points.pop_back();
  out.centre = centre;
  out.radius = radius;
  return out;
}

/// An ellipse, whose axes are given in the plane of the drawing; seen from below it runs the other way.
Line ellipse_of(const Entity& entity, std::size_t per_turn) {
  const Point major = place_at(entity, 11), centre = place_at(entity, 10);
  const double ratio = (is_below(entity) ? -1 : 1) * number_of(entity, 40);
  require_flat(entity, {0, number_or(entity, 31, 0)}, {0.0, major});
  const double from = number_or(entity, 41, 0), span = span_from(from, number_or(entity, 42, full_turn));
  Line out;
  add_ellipse(centre, major, ratio * Point(0, 1) * major, from, span, per_turn, out.points);
  if (span == full_turn) out.points.pop_back(), out.closed = true;
  return out;
}

Line spline_of(const Entity& entity, std::size_t steps) {
  const std::vector<double> x = numbers_of(entity, 10), y = numbers_of(entity, 20);
  if (x.empty())
    throw Fault{entity.line,
                fmt::format("{} has no control points{}", name_of_entity(entity),
                            numbers_of(entity, 11).empty() ? "" : ", only fit points"),
                convert};
  DrawnSpline read{number_of(entity, 71), numbers_of(entity, 40), {}, numbers_of(entity, 41)};
  for (std::size_t i = 0; i < x.size(); ++i) read.control.emplace_back(x[i], i < y.size() ? y[i] : nan);
  if (read.weights.empty()) read.weights.assign(x.size(), 1.0);
  if (const std::string fault = spline_fault(read); !fault.empty())
    throw Fault{entity.line, fmt::format("{} has {}", name_of_entity(entity), fault), convert};
  require_flat(entity, numbers_of(entity, 30), read.control);
  return {.points = spline_points(read, steps), .closed = false, .name = {}};
}

Line straight(const Entity& entity) {
  Line out{.points = {place_at(entity, 10), place_at(entity, 11)}, .closed = false, .name = {}};
  require_flat(entity, {number_or(entity, 30, 0), number_or(entity, 31, 0)}, out.points);
  return out;
}

/// The line of an entity; none of one that draws none.
std::optional<Line> line_of(const Entity& entity, std::size_t per_turn) {
  const auto seen = [&](Line line) {
    if (!is_below(entity)) return line;
    for (Point& p : line.points) p = -std::conj(p);
    line.centre = -std::conj(line.centre);
    return line;
  };
  if (entity.type == "LINE") return straight(entity);
  if (entity.type == "LWPOLYLINE") return seen(light_polyline(entity, per_turn));
  if (entity.type == "POLYLINE") return seen(old_polyline(entity, per_turn));
  if (entity.type == "ARC") return seen(circular_arc(entity, per_turn));
  if (entity.type == "CIRCLE") return seen(whole_circle(entity, per_turn));
  if (entity.type == "ELLIPSE") return ellipse_of(entity, per_turn);
  if (entity.type == "SPLINE") return spline_of(entity, std::max<std::size_t>(1, per_turn / 4));
  return std::nullopt;
}

/// mm of the drawing's unit; none where it names none, as $INSUNITS 0 does.
std::optional<double> unit_of_drawing(const std::vector<Group>& groups) {
  constexpr std::array<std::pair<int, double>, 17> units{{{1, 25.4},
                                                          {2, 304.8},
                                                          {3, 1609344},
                                                          {4, 1},
                                                          {5, 10},
                                                          {6, 1000},
                                                          {7, 1e6},
                                                          {8, 25.4e-6},
                                                          {9, 0.0254},
                                                          {10, 914.4},
                                                          {11, 1e-7},
                                                          {12, 1e-6},
                                                          {13, 1e-3},
                                                          {14, 100},
                                                          {15, 1e4},
                                                          {16, 1e5},
                                                          {21, 1200000.0 / 3937}}};
  for (std::size_t i = 0; i + 1 < groups.size(); ++i) {
    if (groups[i].code != 9 || groups[i].value != "$INSUNITS") continue;
    const Group& group = groups[i + 1];
    const std::optional<int> number = whole_number(group.value);
    if (number == 0) return std::nullopt;
    for (const auto& [known, millimetres] : units)
      if (number == known) return millimetres;
    throw Fault{group.line, fmt::format("the unit $INSUNITS '{}' is not known here", shown(group.value, 20)),
                "save the drawing in millimetres, which are $INSUNITS 4"};
  }
  return std::nullopt;
}

/// Says that a drawing has no entity that is read; `others` are its entities with their first lines.
Fault no_entity(const std::map<std::string_view, int>& others) {
  std::vector<std::pair<int, std::string_view>> listed;
  for (const auto& [type, line] : others) listed.emplace_back(line, type);
  std::sort(listed.begin(), listed.end());
  std::string names;
  for (std::size_t i = 0; i < std::min<std::size_t>(4, listed.size()); ++i)
    names += fmt::format("{}{} in line {}", i == 0 ? ", only " : ", ", shown(listed[i].second, 20),
                         listed[i].first);
  return {0,
          fmt::format("the DXF drawing has no polyline, line, arc, circle, ellipse or spline{}",
                      names.empty() ? ": it has no entities at all" : names),
          others.count("INSERT") > 0
              ? "explode the blocks in the CAD program (INSERT is a block), and save the drawing again"
              : "draw the path as a polyline, line, arc, circle, ellipse or spline of the model"};
}

/// What is drawn once and inserted in several places.
struct Block {
  Point base;
  std::vector<Entity> entities;
};

std::string_view text_or(const Entity& entity, int code, std::string_view otherwise) {
  for (const Group& group : entity.groups)
    if (group.code == code) return group.value;
  return otherwise;
}

std::map<std::string_view, Block> blocks_of(const std::vector<Group>& groups) {
  std::map<std::string_view, Block> out;
  Block* block = nullptr;
  for (Entity& entity : entities_of(groups, "BLOCKS")) {
    if (entity.type == "BLOCK") {
      block = &out[text_or(entity, 2, "")];
      *block = {{number_or(entity, 10, 0), number_or(entity, 20, 0)}, {}};
    } else if (entity.type == "ENDBLK") {
      block = nullptr;
    } else if (block) {
      block->entities.push_back(std::move(entity));
    }
  }
  return out;
}

/// The map p' = direct p + mirrored conj(p) + shift.
struct InsertMap {
  Point direct = 1, mirrored = 0, shift = 0;
  Point operator()(Point p) const { return direct * p + mirrored * std::conj(p) + shift; }
};

/// The map of `inner`, followed by that of `outer`.
InsertMap operator*(const InsertMap& outer, const InsertMap& inner) {
  return {outer.direct * inner.direct + outer.mirrored * std::conj(inner.mirrored),
          outer.direct * inner.mirrored + outer.mirrored * std::conj(inner.direct), outer(inner.shift)};
}

/// The map of a block by an INSERT, of the copy in a column and a row.
InsertMap map_of(const Entity& insert, const Block& block, int column, int row) {
  const double x = number_or(insert, 41, 1), y = number_or(insert, 42, 1);
  const Point turn = std::polar(1.0, number_or(insert, 50, 0) * pi / 180);
  const Point copy(column * number_or(insert, 44, 0), row * number_or(insert, 45, 0));
  const InsertMap scaled{turn * ((x + y) / 2), turn * ((x - y) / 2), place_at(insert, 10) + turn * copy};
  const InsertMap seen = is_below(insert) ? InsertMap{0, -1, 0} : InsertMap{};
  return seen * scaled * InsertMap{1, 0, -block.base};
}

/// The lines of the entities of a drawing, with those of the blocks that it inserts.
class DxfLines {
 public:
  DxfLines(std::map<std::string_view, Block> blocks, std::size_t per_turn)
      : blocks_(std::move(blocks)), per_turn_(per_turn) {}

  /// Entities of a block on the layer 0 lie on the layer of its INSERT.
  void add(const std::vector<Entity>& entities, const InsertMap& map, const std::string& layer, int depth) {
    for (const Entity& entity : entities) {
      const std::string own = layer_of(entity), on = own == "0" && depth > 0 ? layer : own;
      if (entity.type == "INSERT" && blocks_.count(text_or(entity, 2, "")) > 0) {
        insert(entity, map, on, depth);
        continue;
      }
      std::optional<Line> line = line_of(entity, per_turn_);
      if (!line) {
        others.emplace(entity.type, entity.line);
        continue;
      }
      if (depth > 0) count(entity);
      for (Point& p : line->points) {
        p = map(p);
        if (!std::isfinite(p.real()) || !std::isfinite(p.imag()))
          throw Fault{entity.line, name_of_entity(entity) + " lies too far away to be drawn",
                      "check the unit of the drawing and the scale of its blocks"};
      }
      line->centre = map(line->centre);
      const bool round = map.direct == 0.0 || std::abs(map.mirrored) <= 1e-12 * std::abs(map.direct);
      line->radius = round ? line->radius * (std::abs(map.direct) + std::abs(map.mirrored)) : 0;
      line->name = name_of_entity(entity);
      line->layer = on;
      lines.push_back(std::move(*line));
    }
  }

  std::vector<Line> lines;
  std::map<std::string_view, int> others;  ///< entities that draw no line, with their first lines

 private:
  static constexpr int deepest = 8;
  static constexpr std::size_t most_inserted = 20'000;

  /// Blocks within blocks grow beyond all bounds in a small file.
  void count(const Entity& entity) {
    if (++inserted_ > most_inserted)
      throw Fault{entity.line,
                  fmt::format("the blocks of the drawing draw more than {} lines", most_inserted),
                  "delete what is not part of the path or linkage"};
  }

  void insert(const Entity& entity, const InsertMap& map, const std::string& layer, int depth) {
    if (depth == deepest)
      throw Fault{entity.line, fmt::format("more than {} blocks lie within each other", deepest),
                  "explode the blocks in the CAD program, and save the drawing again"};
    const Block& block = blocks_.at(text_or(entity, 2, ""));
    const double columns = number_or(entity, 70, 1), rows = number_or(entity, 71, 1);
    if (!(columns * rows <= 1000))
      throw Fault{entity.line, fmt::format("{} has more than 1000 copies", name_of_entity(entity)),
                  "delete what is not part of the path or linkage"};
    for (int column = 0; column < std::max(1.0, columns); ++column)
      for (int row = 0; row < std::max(1.0, rows); ++row) {
        count(entity);
        add(block.entities, map * map_of(entity, block, column, row), layer, depth + 1);
      }
  }

  std::map<std::string_view, Block> blocks_;
  std::size_t per_turn_, inserted_ = 0;
};

/// Entities that are seen: group 67 marks the sheets that are printed, group 60 what is hidden.
void keep_seen(std::vector<Entity>& entities) {
  std::erase_if(entities, [](const Entity& entity) {
    return number_or(entity, 67, 0) == 1 || number_or(entity, 60, 0) == 1;
  });
}

}  // namespace

std::vector<Line> dxf_file_lines(std::string_view text, bool& has_unit) {
  const std::vector<Group> groups = groups_of(text);
  const std::optional<double> unit = unit_of_drawing(groups);
  has_unit = unit.has_value();
  std::vector<Entity> entities = entities_of(groups, "ENTITIES");
  keep_seen(entities);
  std::map<std::string_view, Block> blocks = blocks_of(groups);
  std::size_t curves = 0;
  const auto count = [&](const std::vector<Entity>& list) {
    for (const Entity& entity : list) curves += 1 + entity.groups.size() / 4 + entity.vertices.size();
  };
  count(entities);
  for (auto& [name, block] : blocks) {
    keep_seen(block.entities);
    count(block.entities);
  }
  DxfLines out(std::move(blocks), curve_steps(curves, most_points_a_turn));
  out.add(entities, {unit.value_or(1), 0, 0}, "0", 0);
  if (out.lines.empty()) throw no_entity(out.others);
  return std::move(out.lines);
}

Line dxf_file_line(std::string_view text, bool& has_unit) {
  return one_line(dxf_file_lines(text, has_unit), "the DXF drawing",
                  "delete the others, or join the ends of the lines in the CAD program");
}

}  // namespace linkwright::planar::drawing
