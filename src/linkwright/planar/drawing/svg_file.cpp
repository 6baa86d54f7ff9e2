// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/drawing/detail/svg_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/drawing/detail/fault.h"
#include "linkwright/planar/drawing/detail/svg_path.h"
#include "linkwright/planar/drawing/detail/xml_tags.h"

namespace linkwright::planar::drawing {
namespace {

using Point = std::complex<double>;

constexpr std::size_t most_curve_steps_of_a_file = 24;
constexpr std::size_t deepest = 100'000;  // elements within each other
constexpr double pixel = 25.4 / 96;       // mm

constexpr std::array<std::string_view, 7> shapes{"path", "line",   "polyline", "polygon",
                                                 "rect", "circle", "ellipse"};
/// Elements whose contents are not drawn where they are written.
constexpr std::array<std::string_view, 7> stores{"defs",   "symbol",  "clipPath", "mask",
                                                 "marker", "pattern", "metadata"};
constexpr std::array<std::string_view, 3> others_that_draw{"use", "text", "image"};

template <std::size_t count>
bool is_among(std::string_view word, const std::array<std::string_view, count>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// The map x' = a x + c y + e, y' = b x + d y + f.
struct PlaneMap {
  double a = 1, b = 0, c = 0, d = 1, e = 0, f = 0;
  Point operator()(Point p) const {
    return {a * p.real() + c * p.imag() + e, b * p.real() + d * p.imag() + f};
  }
};

/// The map of `inner`, followed by that of `outer`.
PlaneMap operator*(const PlaneMap& outer, const PlaneMap& inner) {
  return {outer.a * inner.a + outer.c * inner.b,           outer.b * inner.a + outer.d * inner.b,
          outer.a * inner.c + outer.c * inner.d,           outer.b * inner.c + outer.d * inner.d,
          outer.a * inner.e + outer.c * inner.f + outer.e, outer.b * inner.e + outer.d * inner.f + outer.f};
}

PlaneMap translation(double x, double y) { return {1, 0, 0, 1, x, y}; }
PlaneMap rotation(double degrees) {
  const double c = std::cos(degrees * pi / 180), s = std::sin(degrees * pi / 180);
  return {c, s, -s, c, 0, 0};
}

/// An element in messages.
std::string name_of_tag(const XmlTag& tag) {
  return fmt::format("<{}> in line {}", shown(tag.name, 40), tag.line);
}

/// One function of the attribute transform; none where its name or the count of its numbers is wrong.
std::optional<PlaneMap> transform_named(std::string_view name, const std::vector<double>& n) {
  const std::size_t count = n.size();
  if (name == "matrix" && count == 6) return PlaneMap{n[0], n[1], n[2], n[3], n[4], n[5]};
  if (name == "translate" && (count == 1 || count == 2)) return translation(n[0], count == 2 ? n[1] : 0);
  if (name == "scale" && (count == 1 || count == 2)) return PlaneMap{n[0], 0, 0, n[count - 1], 0, 0};
  if (name == "rotate" && count == 1) return rotation(n[0]);
  if (name == "rotate" && count == 3)
    return translation(n[1], n[2]) * rotation(n[0]) * translation(-n[1], -n[2]);
  if (name == "skewX" && count == 1) return PlaneMap{1, 0, std::tan(n[0] * pi / 180), 1, 0, 0};
  if (name == "skewY" && count == 1) return PlaneMap{1, std::tan(n[0] * pi / 180), 0, 1, 0, 0};
  return std::nullopt;
}

/// True if a style sheet of an element sets this property, and to `value` where that is given.
bool style_sets(std::string_view style, std::string_view property, std::string_view value = {}) {
  while (!style.empty()) {
    const std::size_t end = style.find(';');
    const std::string_view rule = style.substr(0, end);
    const std::size_t colon = rule.find(':');
    if (colon != rule.npos && trimmed(rule.substr(0, colon)) == property &&
        (value.empty() || trimmed(rule.substr(colon + 1)).starts_with(value)))
      return true;
    style.remove_prefix(end == style.npos ? style.size() : end + 1);
  }
  return false;
}

PlaneMap transform_of(const XmlTag& tag) {
  const std::string written = tag.value("transform").value_or("");
  const std::string_view text = trimmed(written);
  if (style_sets(tag.value("style").value_or(""), "transform") ||
      (!text.empty() && tag.value("transform-origin")))
    throw Fault{tag.line, name_of_tag(tag) + " has a transform of its style sheet, which is not applied here",
                "write it as an attribute, for example transform=\"rotate(30)\", or save the file as plain "
                "SVG"};
  PlaneMap out;
  if (text == "none") return out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t open = text.find('(', at), close = text.find(')', at);
    std::optional<PlaneMap> found;
    if (open < close && close != text.npos) {
      const std::string name(trimmed(text.substr(at, open - at)));
      found = transform_named(
          name,
          numbers_in(text.substr(open + 1, close - open - 1),
                     fmt::format("the transform {} of {}", shown(name, 20), name_of_tag(tag)), tag.line));
    }
    if (!found)
      throw Fault{
          tag.line,
          fmt::format("the transform '{}' of {} cannot be read", shown(text.substr(at), 30),
                      name_of_tag(tag)),
          "transforms are matrix with 6 numbers, translate and scale with 1 or 2, rotate with 1 or 3, "
          "skewX and skewY with 1"};
    out = out * *found;
    at = close + 1;
    while (at < text.size() && (is_blank(text[at]) || text[at] == ',')) ++at;
  }
  return out;
}

/// A length as it is written.
struct WrittenLength {
  double value = 0;
  std::optional<double> unit;  ///< mm; none where it is in px or without a unit
};

bool is_percentage(const XmlTag& tag, std::string_view key) {
  const std::string text = tag.value(key).value_or("");
  return trimmed(text).ends_with('%');
}

/// The length of an attribute; none where it is not given.
std::optional<WrittenLength> written_length(const XmlTag& tag, std::string_view key) {
  const std::string written = tag.value(key).value_or("");
  const std::string_view text = trimmed(written);
  if (text.empty() || text == "auto") return std::nullopt;
  std::size_t end = text.size();
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  while (end > 0 && is_letter(text[end - 1])) --end;
  std::string unit(text.substr(end));
  for (char& c : unit)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  constexpr std::array<std::pair<std::string_view, double>, 6> units{
      {{"mm", 1}, {"cm", 10}, {"in", 25.4}, {"pt", 25.4 / 72}, {"pc", 25.4 / 6}, {"q", 0.25}}};
  const auto found =
      std::find_if(units.begin(), units.end(), [&](const auto& known) { return known.first == unit; });
  const bool known_unit = found != units.end() || unit.empty() || unit == "px";
  std::vector<double> numbers;
  // A list of numbers, or something else in front of a unit, is no length.
  if (known_unit && text.substr(0, end).find_first_not_of("+-.0123456789eE \t\r\n") == text.npos) try {
      numbers = numbers_in(text.substr(0, end), std::string(key), tag.line);
    } catch (const Fault&) {
      numbers.clear();
    }
  if (numbers.size() != 1)
    throw Fault{tag.line,
                fmt::format("{} = '{}' of {} is not a length", key, shown(text, 30), name_of_tag(tag)),
                "lengths are numbers, alone or with px, mm, cm, in, pt, pc or Q; percentages have to be "
                "converted"};
  WrittenLength out{.value = numbers[0], .unit = {}};
  if (found != units.end()) out.unit = found->second;
  return out;
}

/// The map of a viewBox to an area of this size, of which a missing side follows the other one; none without
/// a viewBox.
std::optional<PlaneMap> fitted(const XmlTag& tag, std::optional<double> width, std::optional<double> height) {
  const std::optional<std::string> text = tag.value("viewBox");
  if (!text || (!width && !height)) return std::nullopt;
  const std::vector<double> box =
      numbers_in(*text, fmt::format("the viewBox of {}", name_of_tag(tag)), tag.line);
  if (box.size() != 4 || !(box[2] > 0) || !(box[3] > 0))
    throw Fault{tag.line,
                fmt::format("the viewBox '{}' of {} is not four numbers with a positive width and height",
                            shown(*text, 30), name_of_tag(tag)),
                "write the left and the upper edge, the width and the height, for example viewBox=\"0 0 210 "
                "297\", or remove it"};
  const double w = box[2], h = box[3];
  const double across = width.value_or(height.value_or(0) * w / h) / w,
               down = height.value_or(width.value_or(0) * h / w) / h;
  const PlaneMap to_corner = translation(-box[0], -box[1]);
  const std::string aspect = tag.value("preserveAspectRatio").value_or("");
  if (aspect.find("none") != aspect.npos) return PlaneMap{across, 0, 0, down, 0, 0} * to_corner;
  const double scale = aspect.find("slice") != aspect.npos ? std::max(across, down) : std::min(across, down);
  const auto share = [&](const char* least, const char* most) {
    return aspect.find(least) != aspect.npos ? 0 : aspect.find(most) != aspect.npos ? 1 : 0.5;
  };
  return PlaneMap{scale,
                  0,
                  0,
                  scale,
                  share("xMin", "xMax") * w * (across - scale),
                  share("YMin", "YMax") * h * (down - scale)} *
         to_corner;
}

/// The page: its scale, and the user units of 1 mm in lengths that have a unit.
struct Page {
  PlaneMap map;
  double per_millimetre = 1;
  bool has_unit = false;
};

/// The page of the outermost <svg>.
Page page_of(const XmlTag& tag) {
  const auto side = [&](const char* key) -> std::optional<double> {
    if (is_percentage(tag, key)) return std::nullopt;
    const std::optional<WrittenLength> found = written_length(tag, key);
    if (!found || !found->unit || !(found->value > 0)) return std::nullopt;
    return found->value * *found->unit;
  };
  const std::optional<double> width = side("width"), height = side("height");
  if (!width && !height) return {};
  const PlaneMap map = fitted(tag, width, height).value_or(PlaneMap{pixel, 0, 0, pixel, 0, 0});
  return {{map.a, 0, 0, map.d, 0, 0}, 1 / pixel, true};
}

/// A coordinate or radius of an element in user units.
std::optional<double> user_length(const XmlTag& tag, std::string_view key, const Page& page) {
  const std::optional<WrittenLength> found = written_length(tag, key);
  if (!found) return std::nullopt;
  return found->value * (found->unit ? *found->unit * page.per_millimetre : 1);
}

/// Commands of a shape, made as path data would make them.
class ShapeCommands {
 public:
  void add(char letter, const std::array<double, 7>& numbers) { commands_.push_back({letter, numbers}); }
  void arc(double rx, double ry, double x, double y) { add('A', {rx, ry, 0, 0, 1, x, y}); }
  std::vector<PathCommand> take() { return std::move(commands_); }

 private:
  std::vector<PathCommand> commands_;
};

/// A rectangle; a radius that is not given is the other one, and none is larger than half of its side.
std::vector<PathCommand> rounded_box(double x, double y, double width, double height,
                                     std::optional<double> first, std::optional<double> second) {
  ShapeCommands out;
  if (!(width > 0 && height > 0)) return {};
  const double rx = std::clamp(first.value_or(second.value_or(0)), 0.0, width / 2),
               ry = std::clamp(second.value_or(first.value_or(0)), 0.0, height / 2);
  const double right = x + width, bottom = y + height;
  if (!(rx > 0 && ry > 0)) {
    out.add('M', {x, y}), out.add('H', {right}), out.add('V', {bottom}), out.add('H', {x}), out.add('Z', {});
    return out.take();
  }
  out.add('M', {x + rx, y}), out.add('H', {right - rx}), out.arc(rx, ry, right, y + ry);
  out.add('V', {bottom - ry}), out.arc(rx, ry, right - rx, bottom), out.add('H', {x + rx});
  out.arc(rx, ry, x, bottom - ry), out.add('V', {y + ry}), out.arc(rx, ry, x + rx, y), out.add('Z', {});
  return out.take();
}

/// An ellipse of four arcs, from its point on the positive x axis on.
std::vector<PathCommand> whole_ellipse(double cx, double cy, double rx, double ry) {
  ShapeCommands out;
  if (!(rx > 0 && ry > 0)) return {};
  out.add('M', {cx + rx, cy}), out.arc(rx, ry, cx, cy + ry), out.arc(rx, ry, cx - rx, cy);
  out.arc(rx, ry, cx, cy - ry), out.arc(rx, ry, cx + rx, cy), out.add('Z', {});
  return out.take();
}

std::vector<PathCommand> corners_of(const XmlTag& tag) {
  const std::vector<double> numbers =
      numbers_in(tag.value("points").value_or(""), "points of " + name_of_tag(tag), tag.line);
  if (numbers.size() % 2 != 0)
    throw Fault{tag.line,
                fmt::format("{} has {} numbers, which are not pairs of coordinates", name_of_tag(tag),
                            numbers.size()),
                "copy its attribute points once more: a number is missing, or there is one too many"};
  ShapeCommands out;
  for (std::size_t i = 0; i < numbers.size(); i += 2)
    out.add(i == 0 ? 'M' : 'L', {numbers[i], numbers[i + 1]});
  if (tag.name == "polygon" && !numbers.empty()) out.add('Z', {});
  return out.take();
}

/// The commands of a shape; none of one that is not drawn.
std::vector<PathCommand> commands_of(const XmlTag& tag, const Page& page) {
  const auto at = [&](const char* key) { return user_length(tag, key, page).value_or(0); };
  if (tag.name == "path") {
    const std::string data = tag.value("d").value_or("");
    if (trimmed(data).empty() || trimmed(data) == "none") return {};
    return path_commands(data, name_of_tag(tag) + ": ", tag.line);
  }
  if (tag.name == "line") {
    ShapeCommands out;
    out.add('M', {at("x1"), at("y1")}), out.add('L', {at("x2"), at("y2")});
    return out.take();
  }
  if (tag.name == "rect")
    return rounded_box(at("x"), at("y"), at("width"), at("height"), user_length(tag, "rx", page),
                       user_length(tag, "ry", page));
  if (tag.name == "circle") return whole_ellipse(at("cx"), at("cy"), at("r"), at("r"));
  if (tag.name == "ellipse") {
    const std::optional<double> rx = user_length(tag, "rx", page), ry = user_length(tag, "ry", page);
    return whole_ellipse(at("cx"), at("cy"), rx.value_or(ry.value_or(0)), ry.value_or(rx.value_or(0)));
  }
  return corners_of(tag);
}

/// An element with what its children inherit: their map to mm, and if they are drawn.
struct Level {
  std::string_view name;
  int line = 0;
  PlaneMap map;
  bool drawn = true;
  std::string layer = {};
};

struct Shape {
  std::vector<PathCommand> commands;
  PlaneMap map;
  std::string name, layer;
  Point centre{};     ///< of a circle, before the map
  double radius = 0;  ///< likewise; 0: another shape
};

/// The name of a group: the one that Inkscape shows, else its id.
std::string layer_of(const XmlTag& tag) {
  for (const char* key : {"inkscape:label", "id"})
    if (const std::optional<std::string> name = tag.value(key); name && !name->empty())
      return shown(*name, 60);
  return {};
}

/// Goes through the elements of a file.
class SvgReader {
 public:
  std::vector<Line> read(std::string_view text) {
    XmlTags tags(text);
    for (XmlTag tag; tags.next(tag);) {
      if (tag.kind == TagKind::end)
        end(tag);
      else
        begin(tag);
    }
    const auto cut =
        std::find_if(open_.begin(), open_.end(), [](const Level& level) { return level.name == "svg"; });
    if (cut != open_.end())
      throw Fault{cut->line,
                  fmt::format("the file ends before </svg>, which closes <svg> in line {}", cut->line),
                  "copy or save the file once more: its end is missing"};
    if (shapes_.empty()) throw nothing_drawn();
    std::size_t curves = 0;
    for (const Shape& shape : shapes_) curves += curves_in(shape.commands);
    const std::size_t steps = curve_steps(curves, most_curve_steps_of_a_file);
    std::vector<Line> all;
    for (const Shape& shape : shapes_) add_lines(shape, steps, all);
    return all;
  }
  bool has_unit() const { return page_.has_unit; }

 private:
  void end(const XmlTag& tag) {
    if (!open_.empty() && open_.back().name == tag.name) {
      open_.pop_back();
      return;
    }
    const std::string begun =
        open_.empty() ? "an element that does not begin"
                      : fmt::format("<{}> in line {}", shown(open_.back().name, 40), open_.back().line);
    throw Fault{tag.line, fmt::format("</{}> in line {} ends {}", shown(tag.name, 40), tag.line, begun),
                "save the file again: an element in it is not closed"};
  }

  void begin(const XmlTag& tag) {
    if (tag.name == "svg" && open_.empty()) page_ = page_of(tag);
    const Level level = level_of(tag);
    if (level.drawn && is_among(tag.name, shapes)) {
      std::vector<PathCommand> commands = commands_of(tag, page_);
      if (commands.empty()) return;
      Shape& shape =
          shapes_.emplace_back(Shape{std::move(commands), level.map, name_of_tag(tag), level.layer});
      if (tag.name != "circle") return;
      shape.centre = {user_length(tag, "cx", page_).value_or(0), user_length(tag, "cy", page_).value_or(0)};
      shape.radius = user_length(tag, "r", page_).value_or(0);
    } else if (level.drawn && is_among(tag.name, others_that_draw)) {
      others_.insert(fmt::format("<{}>", tag.name));
    }
    if (tag.kind != TagKind::begin) return;
    if (open_.size() == deepest)
      throw Fault{tag.line, fmt::format("{} lies within more than {} elements", name_of_tag(tag), deepest),
                  "ungroup the drawing, and save the file again"};
    open_.push_back(level);
  }

  Level level_of(const XmlTag& tag) const {
    const bool hidden = is_among(tag.name, stores) || tag.value("display") == "none" ||
                        style_sets(tag.value("style").value_or(""), "display", "none");
    Level out{.name = tag.name, .line = tag.line, .map = {}};
    if (!open_.empty()) out.layer = open_.back().layer;
    if (tag.name == "g")
      if (std::string name = layer_of(tag); !name.empty()) out.layer = std::move(name);
    out.drawn = !hidden && (open_.empty() || open_.back().drawn);
    if (!out.drawn) return out;
    out.map = (open_.empty() ? page_.map : open_.back().map) * transform_of(tag);
    if (tag.name != "svg" || open_.empty()) return out;
    // A drawing within the drawing.
    const auto side = [&](const char* key) {
      return is_percentage(tag, key) ? std::nullopt : user_length(tag, key, page_);
    };
    const PlaneMap inner = fitted(tag, side("width"), side("height")).value_or(PlaneMap{});
    out.map = out.map * translation(side("x").value_or(0), side("y").value_or(0)) * inner;
    return out;
  }

  /// The lines that a shape draws, in mm with the y axis upwards.
  static void add_lines(const Shape& shape, std::size_t steps, std::vector<Line>& out) {
    std::vector<Line> lines = path_lines(shape.commands, steps);
    for (std::size_t k = 0; k < lines.size(); ++k) {
      for (Point& p : lines[k].points) p = std::conj(shape.map(p));
      lines[k].layer = shape.layer;
      lines[k].centre = std::conj(shape.map(shape.centre));
      lines[k].radius = std::abs(std::conj(shape.map(shape.centre + shape.radius)) - lines[k].centre);
      lines[k].name = lines.size() > 1 ? fmt::format("part {} of {}", k + 1, shape.name) : shape.name;
      out.push_back(std::move(lines[k]));
    }
  }

  Fault nothing_drawn() const {
    std::string names;
    for (const std::string_view shape : shapes)
      names += fmt::format("{}<{}>", names.empty() ? "" : ", ", shape);
    const std::string only = others_.empty() ? "" : fmt::format(", only {}", fmt::join(others_, ", "));
    return {
        0, fmt::format("the SVG file draws none of {}{}", names, only),
        "convert texts and clones to paths in the drawing program (\"Object to path\", \"Unlink clone\"), "
        "and save the file again"};
  }

  std::vector<Level> open_;
  std::vector<Shape> shapes_;
  std::set<std::string> others_;
  Page page_;
};

}  // namespace

std::vector<Line> svg_file_lines(std::string_view text, bool& has_unit) {
  SvgReader reader;
  std::vector<Line> out = reader.read(text);
  has_unit = reader.has_unit();
  return out;
}

Line svg_file_line(std::string_view text, bool& has_unit) {
  return one_line(svg_file_lines(text, has_unit), "the SVG file",
                  "delete the others, or join them end to end, or keep one path");
}

}  // namespace linkwright::planar::drawing
