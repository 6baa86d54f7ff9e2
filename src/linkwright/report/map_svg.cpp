// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/map_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/report/colour_scale.h"
#include "linkwright/report/detail/canvas.h"
#include "linkwright/report/drawing.h"
#include "linkwright/report/groups.h"
#include "linkwright/report/markup.h"
#include "linkwright/report/units.h"
#include "linkwright/study/extremes.h"

namespace linkwright::report {
namespace {

constexpr double sheet_width = 640, left_margin = 74, right_margin = 16, top_margin = 8;  // px
constexpr double map_gap = 16, map_head = 24, map_foot = 44, bar_height = 12,
                 bar = 62;          // px, between and below the maps
constexpr double max_height = 420;  // px, of one map
constexpr std::size_t max_maps = 12, max_columns = 3;
constexpr double same = 1e-6;  // share of the range: coordinates that are closer differ by rounding
constexpr std::string_view no_value = "#e9edf0";

struct Cell {
  double i = 0, j = 0;  // along x and y, whole numbers
  double value = 0;     // NaN = none
};

struct Map {
  std::string label;
  std::vector<Cell> cells;  // row by row, along x
};

// One coordinate of the grid.
struct Axis {
  double low = 0, high = 0, pitch = 0;
  double index(double v) const { return std::round((v - low) / pitch); }
  double from() const { return low - pitch / 2; }
  double size() const { return high - low + pitch; }
};

// pitch = 0 when all places are the same.
Axis axis_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  Axis out{values.front(), values.back(), 0};
  const double least = same * (out.high - out.low);
  for (std::size_t i = 1; i < values.size(); ++i)
    if (const double step = values[i] - values[i - 1]; step > least && (out.pitch == 0 || step < out.pitch))
      out.pitch = step;
  return out;
}

struct Maps {
  Axis x, y;
  std::vector<Map> maps;
  double low = infinity;  // least of all values; above `high` when there is none
  double high = -low;
  bool missing = false;    // true if a cell has no value
  std::size_t groups = 0;  // number of all groups; `maps` may be a choice of them
  DisplayUnit unit;        // unit of both coordinates
  DisplayUnit value_unit;
};

Maps maps_of(const study::Plot& plot, const Table& table) {
  Maps out;
  if (plot.y.size() != 2) return out;
  const Column *x = table.find(plot.x), *y = table.find(plot.y[0]), *values = table.find(plot.y[1]);
  if (!x || !y || !values) return out;
  const std::size_t rows = std::min({x->values.size(), y->values.size(), values->values.size()});
  const auto stands = [&](std::size_t row) {
    return row < rows && std::isfinite(x->values[row]) && std::isfinite(y->values[row]);
  };
  out.unit = display_unit(plot.x, std::max(study::largest_size(x->values), study::largest_size(y->values)));
  out.value_unit = display_unit(plot.y[1], study::largest_size(values->values));
  std::vector<double> xs, ys;
  for (std::size_t row = 0; row < rows; ++row)
    if (stands(row)) {
      xs.push_back(x->values[row] * out.unit.factor);
      ys.push_back(y->values[row] * out.unit.factor);
    }
  if (xs.empty()) return out;
  out.x = axis_of(std::move(xs));
  out.y = axis_of(std::move(ys));
  // A single line of places has square cells; a single place, one of some size.
  const double other = std::max(out.x.pitch, out.y.pitch);
  const double some = other > 0 ? other : std::max({std::abs(out.x.low), std::abs(out.y.low), 1e-3}) / 10;
  for (Axis* axis : {&out.x, &out.y})
    if (axis->pitch == 0) axis->pitch = some;

  const auto value_at = [&](std::size_t row) {
    const double shown = values->values[row] * out.value_unit.factor;
    const double v = plot.logarithmic_y ? std::log10(shown) : shown;
    return std::isfinite(v) ? v : nan;
  };
  const std::vector<Group> groups = groups_of(plot, table);
  out.groups = groups.size();
  const std::size_t drawn = std::min(groups.size(), max_maps);
  for (std::size_t k = 0; k < drawn; ++k) {
    const Group& group = groups[drawn == groups.size() ? k : k * (groups.size() - 1) / (drawn - 1)];
    Map map{group.label, {}};
    // From the last row on, so that of several values at one place the last is the one that stays.
    for (auto row = group.rows.rbegin(); row != group.rows.rend(); ++row)
      if (stands(*row))
        map.cells.push_back({out.x.index(x->values[*row] * out.unit.factor),
                             out.y.index(y->values[*row] * out.unit.factor), value_at(*row)});
    std::stable_sort(map.cells.begin(), map.cells.end(),
                     [](const Cell& a, const Cell& b) { return a.j != b.j ? a.j < b.j : a.i < b.i; });
    map.cells.erase(std::unique(map.cells.begin(), map.cells.end(),
                                [](const Cell& a, const Cell& b) { return a.j == b.j && a.i == b.i; }),
                    map.cells.end());
    for (const Cell& cell : map.cells) {
      out.missing = out.missing || std::isnan(cell.value);
      out.low = std::min(out.low, cell.value);  // NaN changes nothing
      out.high = std::max(out.high, cell.value);
    }
    out.maps.push_back(std::move(map));
  }
  return out;
}

// The arrangement of the maps: as many a row as fill the last row best, all of the same size and scale.
struct Layout {
  std::size_t columns = 1, rows = 1;
  double scale = 1;  // px per unit
  double map_width = 0, map_height = 0;
  double height() const {
    return top_margin + static_cast<double>(rows) * (map_head + map_height) + map_foot;
  }
};

Layout layout_of(const Maps& maps) {
  Layout out;
  const std::size_t n = maps.maps.size();
  out.rows = (n + max_columns - 1) / max_columns;
  out.columns = (n + out.rows - 1) / out.rows;
  const double room =
      (sheet_width - left_margin - right_margin - map_gap * static_cast<double>(out.columns - 1)) /
      static_cast<double>(out.columns);
  out.scale = std::min(room / maps.x.size(), max_height / maps.y.size());
  out.map_width = maps.x.size() * out.scale;
  out.map_height = maps.y.size() * out.scale;
  return out;
}

// One map with its upper left corner at (px, py).
struct Frame {
  const Maps& maps;
  const Layout& layout;
  double px, py;
  double x(double v) const { return px + (v - maps.x.from()) * layout.scale; }
  double y(double v) const { return py + layout.map_height - (v - maps.y.from()) * layout.scale; }
};

// Cells of one colour side by side are one rectangle, and all of one colour are one path.
void draw_cells(std::string& out, const Frame& frame, const Map& map) {
  const Maps& maps = frame.maps;
  std::array<std::string, colour_classes + 1> paths;  // the last of places without a value
  const auto look = [&](const Cell& c) {
    return std::isnan(c.value) ? colour_classes : colour_class(c.value, maps.low, maps.high);
  };
  const double w = maps.x.pitch * frame.layout.scale, h = maps.y.pitch * frame.layout.scale;
  const auto& cells = map.cells;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Cell& first = cells[i];
    const int colour = look(first);
    while (i + 1 < cells.size() && cells[i + 1].j == first.j && cells[i + 1].i == cells[i].i + 1 &&
           look(cells[i + 1]) == colour)
      ++i;
    const double from = frame.px + first.i * w, to = frame.px + (cells[i].i + 1) * w;
    put(paths[static_cast<std::size_t>(colour)], "M{:.1f} {:.1f}H{:.1f}v{:.1f}H{:.1f}z", from,
        frame.py + frame.layout.map_height - first.j * h, to, -h, from);
  }
  out += "<g class=\"cells\" shape-rendering=\"crispEdges\">\n";
  for (int k = 0; k <= colour_classes; ++k)
    if (const std::string& path = paths[static_cast<std::size_t>(k)]; !path.empty())
      put(out, "<path d=\"{}\" fill=\"{}\"/>\n", path, k < colour_classes ? class_colour(k) : no_value);
  out += "</g>\n";
}

void draw_axes(std::string& out, const Frame& frame, bool outer_left, bool outer_bottom) {
  const Maps& maps = frame.maps;
  const double bottom = frame.py + frame.layout.map_height, end = frame.px + frame.layout.map_width;
  // The same step along both: steps grow by 2.5 at most, so that it is 44 px long or more.
  const double step = nice_step(110 / frame.layout.scale, 1);
  std::string lines, texts;
  for (const double v : ticks(maps.x.from(), maps.x.from() + maps.x.size(), step)) {
    put(lines, "M{:.1f} {:.1f}v4", frame.x(v), bottom);
    if (outer_bottom)
      put(texts, "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>", frame.x(v), bottom + 16,
          number(v));
  }
  for (const double v : ticks(maps.y.from(), maps.y.from() + maps.y.size(), step)) {
    put(lines, "M{:.1f} {:.1f}h-4", frame.px, frame.y(v));
    if (outer_left)
      put(texts, "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>", frame.px - 7,
          frame.y(v) + 4, number(v));
  }
  put(out,
      "<path d=\"M{0:.1f} {1:.1f}H{2:.1f}V{3:.1f}H{0:.1f}z{4}\" stroke=\"#8fa0ae\" fill=\"none\"/>"
      "<g fill=\"#526170\" font-size=\"11\">{5}</g>\n",
      frame.px, frame.py, end, bottom, lines, texts);
}

void draw_bar(std::string& out, const Maps& maps, const Column& values, bool logarithmic, double y) {
  const double length = maps.missing ? 380 : sheet_width - left_margin - right_margin,
               each = length / colour_classes;
  out += "<g class=\"scale\" shape-rendering=\"crispEdges\">";
  for (int k = 0; k < colour_classes; ++k)
    put(out, "<path d=\"M{:.1f} {:.1f}h{:.1f}v{}h-{:.1f}z\" fill=\"{}\"/>", left_margin + k * each, y, each,
        bar_height, each, class_colour(maps.high > maps.low ? k : colour_classes - 1));
  out += "</g>\n<g fill=\"#526170\" font-size=\"11\">";
  // The ends have their numbers always, so that the range is known, round numbers are between them.
  const double span = maps.high - maps.low;
  const auto named = [&](double share, const char* anchor, double value, int digits) {
    put(out, "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>", left_margin + share * length,
        y + bar_height + 14, anchor, number(logarithmic ? std::pow(10, value) : value, digits));
  };
  if (span > 0) {
    named(0, "start", maps.low, 3);
    named(1, "end", maps.high, 3);
    const double step = nice_step(span, 5);
    for (const double v : ticks(maps.low, maps.high, logarithmic ? std::max(1.0, step) : step))
      if (const double share = (v - maps.low) / span; share > 0.14 && share < 0.86)
        named(share, "middle", v, 6);
  } else {
    named(0.5, "middle", maps.low, 6);
  }
  put(out, "<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" font-size=\"12\">{}</text>",
      left_margin + length / 2, y + bar_height + 32, escape(label_with(values, maps.value_unit)));
  if (maps.missing)
    put(out,
        "<rect x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"24\" height=\"{2}\" fill=\"{3}\"/>"
        "<text x=\"{4:.1f}\" y=\"{5:.1f}\">no value</text>",
        left_margin + length + 28, y, bar_height, no_value, left_margin + length + 58, y + bar_height - 2);
  out += "</g>\n";
}

}  // namespace

std::string map_svg(const study::Plot& plot, const Table& table) {
  const Maps maps = maps_of(plot, table);
  const bool empty = !(maps.low <= maps.high);
  const Layout layout = empty ? Layout() : layout_of(maps);
  const double height = empty ? 60 : layout.height() + bar;
  std::string out;
  put(out,
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
      "{1:.0f}\" role=\"img\" font-family=\"system-ui, sans-serif\"><title>{2}</title>"
      "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"#ffffff\"/>\n",
      sheet_width, height, escape(plot.title));
  if (empty) {
    out += "<text x=\"24\" y=\"36\" font-size=\"14\">No values.</text></svg>\n";
    return out;
  }
  const double all = static_cast<double>(layout.columns) * (layout.map_width + map_gap) - map_gap;
  const double begin = left_margin + (sheet_width - left_margin - right_margin - all) / 2;
  for (std::size_t k = 0; k < maps.maps.size(); ++k) {
    const std::size_t row = k / layout.columns, column = k % layout.columns;
    const Frame frame{maps, layout, begin + static_cast<double>(column) * (layout.map_width + map_gap),
                      top_margin + map_head + static_cast<double>(row) * (map_head + layout.map_height)};
    const std::string& label = maps.maps[k].label;
    put(out,
        "<g class=\"map\"><text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\" font-size=\"12\" "
        "fill=\"#1d2935\">{}</text>\n",
        frame.px + layout.map_width / 2, frame.py - 7, escape(label));
    draw_cells(out, frame, maps.maps[k]);
    draw_axes(out, frame, column == 0, k + layout.columns >= maps.maps.size());
    out += "</g>\n";
  }
  const double bottom = layout.height() - map_foot;
  put(out,
      "<g fill=\"#526170\" font-size=\"12\"><text x=\"{:.1f}\" y=\"{:.1f}\" "
      "text-anchor=\"middle\">{}{}</text>",
      begin + all / 2, bottom + 34, escape(label_with(*table.find(plot.x), maps.unit)),
      maps.maps.size() < maps.groups ? fmt::format("; {} of {} maps", maps.maps.size(), maps.groups) : "");
  put(out, "<text transform=\"translate({:.1f},{:.1f}) rotate(-90)\" text-anchor=\"middle\">{}</text></g>\n",
      begin - 58, (top_margin + bottom) / 2, escape(label_with(*table.find(plot.y[0]), maps.unit)));
  draw_bar(out, maps, *table.find(plot.y[1]), plot.logarithmic_y, layout.height() + 2);
  out += "</svg>\n";
  return out;
}

}  // namespace linkwright::report
