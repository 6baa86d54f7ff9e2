// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/plot_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/report/detail/canvas.h"
#include "linkwright/report/drawing.h"
#include "linkwright/report/groups.h"
#include "linkwright/report/map_svg.h"
#include "linkwright/report/markup.h"
#include "linkwright/report/units.h"
#include "linkwright/study/extremes.h"

namespace linkwright::report {
namespace {

using Style = study::Plot::Style;

constexpr double width = 640, left = 74, right = 16, top = 14, foot = 46;  // px
constexpr double line_height = 20;                                         // px, of the legend
constexpr std::size_t max_points = 3000;                                   // a curve; more cannot be seen
constexpr std::size_t max_named_curves = 6;  // more curves are a bundle, of which the first have names
// Share of the largest number: less than this is zero on a logarithmic axis.
constexpr double rounding = 1e-16;
constexpr std::string_view pale = "#8fa0ae", band_colour = "#009E73";

struct Curve {
  std::string label;
  std::vector<Place> points;
};

// "O1 x, ground on crank (N)" names the pair "O1, ground on crank".
std::string name_of_pair(const Column& column) {
  std::string label = column.label.empty() ? column.key.substr(0, column.key.rfind("_x_")) : column.label;
  if (const std::size_t unit = label.rfind(" ("); unit != std::string::npos && label.back() == ')')
    label.resize(unit);
  for (const std::string_view mark : {" x,", " x "})
    if (const std::size_t at = label.find(mark); at != std::string::npos) return label.erase(at, 2);
  if (label.size() > 2 && label.ends_with(" x")) label.resize(label.size() - 2);
  return label;
}

// Units of both axes. All that a diagram draws along one axis has one unit.
struct Shown {
  DisplayUnit x, y;
};

Shown shown_of(const study::Plot& plot, const Table& table) {
  const Column* x = table.find(plot.x);
  double most = 0;
  const auto count = [&](const std::string& key) {
    if (const Column* column = table.find(key)) most = std::max(most, study::largest_size(column->values));
  };
  for (const auto& key : plot.y) count(key);
  for (const auto& band : plot.bands) count(band.lower), count(band.upper);
  Shown out;
  if (x) out.x = display_unit(plot.x, study::largest_size(x->values));
  if (!plot.y.empty()) out.y = display_unit(plot.y.front(), most);
  if (plot.style == Style::polar) out.x = out.y;
  return out;
}

// True if a polar diagram shows paths of points, so that its origin is no special place.
bool is_path(const study::Plot& plot) {
  return std::all_of(plot.y.begin(), plot.y.end(),
                     [](const std::string& key) { return key.ends_with("_m") && !key.ends_with("_N_m"); });
}

std::vector<Curve> curves_of(const study::Plot& plot, const Table& table, const Shown& shown) {
  std::vector<Curve> out;
  const std::vector<Group> groups = groups_of(plot, table);
  const auto add = [&](const std::string& label, const Column* x, const Column* y) {
    if (!x || !y) return;
    const std::size_t end = std::min(x->values.size(), y->values.size());
    for (const Group& group : groups) {
      const std::size_t step = group.rows.size() / max_points + 1;
      const bool alone = plot.style != Style::polar && plot.y.size() == 1;
      Curve curve{group.label.empty() ? label : alone ? group.label : label + ", " + group.label, {}};
      for (std::size_t i = 0; i < group.rows.size(); i += step)
        if (const std::size_t row = group.rows[i]; row < end)
          curve.points.push_back({x->values[row] * shown.x.factor, y->values[row] * shown.y.factor});
      out.push_back(std::move(curve));
    }
  };
  if (plot.style == Style::polar) {
    for (std::size_t i = 0; i + 1 < plot.y.size(); i += 2)
      if (const Column* x = table.find(plot.y[i])) add(name_of_pair(*x), x, table.find(plot.y[i + 1]));
  } else {
    for (const auto& key : plot.y)
      if (const Column* y = table.find(key)) add(label_with(*y, shown.y), table.find(plot.x), y);
  }
  return out;
}

// Replaces values by their decimal logarithms; none is less than that of `rounding` times the largest.
// True when a value was raised to that.
bool take_logarithms(std::initializer_list<std::vector<Curve>*> drawn) {
  double most = 0;
  for (const auto* curves : drawn)
    for (const auto& curve : *curves)
      for (const Place& p : curve.points)
        if (p.finite()) most = std::max(most, p.y);
  const double floor = std::log10(most) + std::log10(rounding);
  bool raised = false;
  for (auto* curves : drawn)
    for (auto& curve : *curves)
      for (Place& p : curve.points) {
        const double power = p.y > 0 ? std::log10(p.y) : nan;
        raised = raised || power < floor;
        p.y = power < floor ? floor : power;
      }
  return raised;
}

// A band as pairs of points, lower and upper edge by turns; NaN interrupts it. Of groups the first in which
// it has values is taken.
Curve band_of(const study::Plot& plot, const study::Plot::Band& band, const Table& table,
              const Shown& shown) {
  const Column *x = table.find(plot.x), *lower = table.find(band.lower), *upper = table.find(band.upper);
  Curve out{band.label, {}};
  if (!x || !lower || !upper) return out;
  const std::size_t end = std::min({x->values.size(), lower->values.size(), upper->values.size()});
  for (const Group& group : groups_of(plot, table)) {
    bool any = false;
    out.points.clear();
    for (const std::size_t row : group.rows) {
      if (row >= end) continue;
      for (const Column* edge : {lower, upper})
        out.points.push_back({x->values[row] * shown.x.factor, edge->values[row] * shown.y.factor});
      any = any || (out.points.back().finite() && out.points[out.points.size() - 2].finite());
    }
    if (any) return out;
  }
  out.points.clear();
  return out;
}

// Counts of the values of all columns, as the outlines of bars: one for each group, over the same bins.
std::vector<Curve> histogram(const study::Plot& plot, const Table& table, const DisplayUnit& unit) {
  std::vector<Curve> out;
  std::vector<std::vector<double>> lists;
  double low = infinity, high = -infinity;
  std::size_t most = 0;
  for (const Group& group : groups_of(plot, table)) {
    Curve& curve = out.emplace_back(Curve{group.label, {}});
    std::vector<double>& values = lists.emplace_back();
    for (const auto& key : plot.y)
      if (const Column* column = table.find(key)) {
        if (group.label.empty()) curve.label = label_with(*column, unit);
        for (const std::size_t row : group.rows)
          if (row < column->values.size() && std::isfinite(column->values[row]))
            values.push_back(column->values[row] * unit.factor);
      }
    for (const double v : values) low = std::min(low, v), high = std::max(high, v);
    most = std::max(most, values.size());
  }
  if (most == 0) return out;
  const double span = high > low ? high - low : 1;
  const auto bins = static_cast<std::size_t>(std::clamp(std::sqrt(static_cast<double>(most)), 1.0, 40.0));
  for (std::size_t k = 0; k < out.size(); ++k) {
    std::vector<double> counts(bins);
    for (const double v : lists[k])
      ++counts[std::min(bins - 1, static_cast<std::size_t>((v - low) / span * static_cast<double>(bins)))];
    for (std::size_t i = 0; i < bins; ++i) {
      const double a = low + span * static_cast<double>(i) / static_cast<double>(bins);
      const double b = low + span * static_cast<double>(i + 1) / static_cast<double>(bins);
      for (const Place& p : {Place{a, 0}, Place{a, counts[i]}, Place{b, counts[i]}, Place{b, 0}})
        out[k].points.push_back(p);
    }
  }
  return out;
}

// The range without rare peaks, when the largest value is more than eight times the 98th percentile of the
// sizes; as in the viewer (zoom.ts). Where almost all values are nothing beside the peaks, the peaks are what
// there is to see.
struct Peak {
  double low = infinity, high = -infinity;  // without the peaks
  double value = 0, at = 0;                 // the largest of them, and where
};

std::optional<Peak> peak_of(const study::Plot& plot, const Table& table, const Shown& shown) {
  constexpr std::size_t fewest = 50;
  const Column* x = table.find(plot.x);
  std::vector<double> sizes;
  Peak out;
  const auto each = [&](auto&& use) {
    for (const auto& key : plot.y)
      if (const Column* y = table.find(key))
        for (std::size_t row = 0; row < y->values.size(); ++row)
          if (std::isfinite(y->values[row])) use(y->values[row] * shown.y.factor, row);
  };
  each([&](double v, std::size_t row) {
    sizes.push_back(std::abs(v));
    if (std::abs(v) <= std::abs(out.value)) return;
    out.value = v;
    out.at = x && row < x->values.size() ? x->values[row] * shown.x.factor : nan;
  });
  if (sizes.size() < fewest) return std::nullopt;
  const auto middle =
      sizes.begin() + static_cast<std::ptrdiff_t>(0.98 * static_cast<double>(sizes.size() - 1));
  std::nth_element(sizes.begin(), middle, sizes.end());
  const double usual = *middle, most = std::abs(out.value);
  if (!(most > 8 * usual) || !(usual > 1e-4 * most)) return std::nullopt;
  each([&](double v, std::size_t) {
    if (std::abs(v) <= 2 * usual) out.low = std::min(out.low, v), out.high = std::max(out.high, v);
  });
  return out;
}

// The plane of the diagram: data to picture (px, y down).
struct Axes {
  Box box;
  double height = 0;
  double inner_width() const { return width - left - right; }
  double inner_height() const { return height - top - foot; }
  double x(double v) const { return left + (v - box.x_min) / box.width() * inner_width(); }
  double y(double v) const { return top + (box.y_max - v) / box.height() * inner_height(); }
};

Axes axes_of(std::initializer_list<const std::vector<Curve>*> drawn, Style style, bool origin, bool upright,
             const std::optional<Peak>& peak) {
  Axes axes;
  axes.height = style == Style::polar || upright ? 420 : 260;
  for (const auto* curves : drawn)
    for (const auto& curve : *curves)
      for (const Place& p : curve.points)
        if (p.finite()) axes.box.add(p.x, p.y);
  if (axes.box.empty()) return axes;
  Box& box = axes.box;
  if (peak) {
    double &low = upright ? box.x_min : box.y_min, &high = upright ? box.x_max : box.y_max;
    low = std::max(low, peak->low), high = std::min(high, peak->high);
  }
  if (origin) box.add(0, 0);
  const auto widen = [](double& low, double& high, double by) { low -= by, high += by; };
  if (style == Style::polar) {
    const double per_pixel =
        std::max({box.width() / axes.inner_width(), box.height() / axes.inner_height(), 1e-300}) * 1.08;
    widen(box.x_min, box.x_max, (per_pixel * axes.inner_width() - box.width()) / 2);
    widen(box.y_min, box.y_max, (per_pixel * axes.inner_height() - box.height()) / 2);
    return axes;
  }
  // A line that is level, up to rounding, still needs some room.
  const auto level = [](double low, double high) {
    const double size = std::max(std::abs(low), std::abs(high));
    return high - low <= 1e-12 * size ? std::max(size, 1.0) / 10 : 0;
  };
  // Margin as a share of the range of what grows upwards, or, in upright diagrams with peaks, across.
  const double air = 0.06;
  widen(box.x_min, box.x_max, level(box.x_min, box.x_max) + (peak && upright ? air * box.width() : 0));
  widen(box.y_min, box.y_max, level(box.y_min, box.y_max) + air * box.height());
  if (style == Style::histogram) box.y_min = 0;
  return axes;
}

// Everything along one axis.
struct Side {
  std::string label;
  bool degrees = false, logarithmic = false;
  double step(double span, double divisions) const {
    if (degrees) return degree_step(span, divisions);
    return logarithmic ? std::max(1.0, nice_step(span, divisions)) : nice_step(span, divisions);
  }
  std::string at(double v) const { return number(logarithmic ? std::pow(10, v) : v); }
};

void draw_axes(std::string& out, const Axes& axes, const Side& across, const Side& up, bool origin) {
  const double bottom = axes.height - foot;
  std::string lines, texts;
  for (const double v : ticks(axes.box.x_min, axes.box.x_max, across.step(axes.box.width(), 6))) {
    put(lines, "M{:.1f} {:.0f}V{:.0f}", axes.x(v), top, bottom);
    put(texts, "<text x=\"{:.1f}\" y=\"{:.0f}\" text-anchor=\"middle\">{}</text>", axes.x(v), bottom + 16,
        across.at(v));
  }
  for (const double v : ticks(axes.box.y_min, axes.box.y_max, up.step(axes.box.height(), 5))) {
    put(lines, "M{:.0f} {:.1f}H{:.0f}", left, axes.y(v), width - right);
    put(texts, "<text x=\"{:.0f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text>", left - 6, axes.y(v) + 4,
        up.at(v));
  }
  put(out, "<path d=\"{}\" stroke=\"#dfe5ea\" fill=\"none\"/><g fill=\"#526170\" font-size=\"11\">{}\n",
      lines, texts);
  put(out, "<text x=\"{:.0f}\" y=\"{:.0f}\" text-anchor=\"middle\" font-size=\"12\">{}</text>",
      (left + width - right) / 2, axes.height - 10, escape(across.label));
  put(out,
      "<text transform=\"translate(14,{:.0f}) rotate(-90)\" text-anchor=\"middle\" "
      "font-size=\"12\">{}</text></g>\n",
      (top + bottom) / 2, escape(up.label));
  if (origin)
    put(out,
        "<path class=\"origin\" d=\"M{0:.1f} {1:.0f}V{2:.0f}M{3:.0f} {4:.1f}H{5:.0f}\" stroke=\"#526170\" "
        "fill=\"none\"/><circle cx=\"{0:.1f}\" cy=\"{4:.1f}\" r=\"4\" stroke=\"#526170\" fill=\"none\"/>\n",
        axes.x(0), top, bottom, left, axes.y(0), width - right);
}

std::string path_of(const Axes& axes, const Curve& curve, bool points) {
  std::vector<Place> line;
  for (const Place& p : curve.points) line.push_back({axes.x(p.x), axes.y(p.y)});
  if (!points) return path_data(line, false);
  std::string path;
  for (const Place& p : line)
    if (p.finite()) put(path, "M{:.1f} {:.1f}h0", p.x, p.y);
  return path;
}

void draw_band(std::string& out, const Axes& axes, const Curve& band) {
  std::string path, back;
  const auto flush = [&] {
    if (!back.empty()) path += back + "Z";
    back.clear();
  };
  for (std::size_t i = 0; i + 1 < band.points.size(); i += 2) {
    const Place &lower = band.points[i], &upper = band.points[i + 1];
    if (!lower.finite() || !upper.finite()) {
      flush();
      continue;
    }
    put(path, "{}{:.1f} {:.1f}", back.empty() ? 'M' : 'L', axes.x(lower.x), axes.y(lower.y));
    back = fmt::format("L{:.1f} {:.1f}", axes.x(upper.x), axes.y(upper.y)) + back;
  }
  flush();
  put(out, "<path class=\"band\" d=\"{}\" fill=\"{}\" fill-opacity=\"0.16\"><title>{}</title></path>\n", path,
      band_colour, escape(band.label));
}

void draw_baseline(std::string& out, const Axes& axes, const Curve& curve, std::string_view name) {
  put(out,
      "<path class=\"baseline\" d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.4\" "
      "stroke-dasharray=\"5 4\"><title>{}</title></path>\n",
      path_of(axes, curve, false), pale, escape(fmt::format("{}: {}", name, curve.label)));
}

void draw_curve(std::string& out, const Axes& axes, const Curve& curve, const CurveLook& look, bool faint,
                bool points) {
  const std::string path = path_of(axes, curve, points);
  put(out,
      "<path class=\"curve\" d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
      "stroke-dasharray=\"{}\" "
      "stroke-linejoin=\"round\" stroke-linecap=\"{}\" stroke-opacity=\"{}\"><title>{}</title></path>\n",
      path, look.colour, points ? 6 : 1.8, points ? "none" : look.dash, points ? "round" : "butt",
      faint ? 0.5 : 1.0, escape(curve.label));
}

/// All that a diagram shows, in its units.
struct Drawing {
  Shown shown;
  std::vector<Curve> curves, bands, before;
  bool raised = false;  // values of nearly zero were raised to the lower edge of a logarithmic axis
  std::optional<Peak> peak;
  std::size_t named = 0;   // the curves that have a name in the legend
  std::string_view faint;  // colour of the others
  bool bundle() const { return curves.size() > max_named_curves; }
};

Drawing drawing_of(const study::Plot& plot, const Table& table, const Table* baseline) {
  const bool counts = plot.style == Style::histogram, polar = plot.style == Style::polar;
  Drawing out{.shown = shown_of(plot, table)};
  out.curves = counts ? histogram(plot, table, out.shown.y) : curves_of(plot, table, out.shown);
  if (plot.style == Style::line || plot.style == Style::points)
    for (const auto& band : plot.bands)
      if (Curve edges = band_of(plot, band, table, out.shown); !edges.points.empty())
        out.bands.push_back(std::move(edges));
  if (baseline && !counts) out.before = curves_of(plot, *baseline, out.shown);
  const std::initializer_list<std::vector<Curve>*> all = {&out.curves, &out.bands, &out.before};
  out.raised = plot.logarithmic_y && !polar && !counts && take_logarithms(all);
  if (plot.upright && !polar && !counts)
    for (auto* drawn : all)
      for (auto& curve : *drawn)
        for (Place& p : curve.points) std::swap(p.x, p.y);
  if (plot.style == Style::line && !plot.logarithmic_y) out.peak = peak_of(plot, table, out.shown);
  // The first curves of a bundle have a name; one that is a family has none but those of its ends.
  out.named = !polar && out.curves.size() == 1 ? 0
              : !out.bundle()                  ? out.curves.size()
              : plot.group.empty()             ? max_named_curves
                                               : 0;
  out.faint = out.named ? pale : curve_look(0).colour;
  return out;
}

struct LegendRow {
  std::string look, text;
};

std::vector<LegendRow> legend_of(const study::Plot& plot, const Drawing& d, const Table* baseline) {
  std::vector<LegendRow> out;
  for (std::size_t i = 0; i < d.named; ++i)
    out.push_back({plot.style == Style::points
                       ? fmt::format("stroke=\"{}\" stroke-width=\"7\" stroke-linecap=\"round\" "
                                     "stroke-dasharray=\"0 17\"",
                                     curve_look(i).colour)
                       : fmt::format("stroke=\"{}\" stroke-width=\"2.4\" stroke-dasharray=\"{}\"",
                                     curve_look(i).colour, curve_look(i).dash),
                   d.curves[i].label});
  if (d.bundle())
    out.push_back({fmt::format("stroke=\"{}\" stroke-width=\"2.4\"", d.faint),
                   fmt::format("{} {}curves, {} to {}", d.curves.size() - d.named, d.named ? "more " : "",
                               d.curves[d.named].label, d.curves.back().label)});
  for (const auto& band : d.bands)
    out.push_back(
        {fmt::format("stroke=\"{}\" stroke-width=\"12\" stroke-opacity=\"0.16\"", band_colour), band.label});
  if (!d.before.empty())
    out.push_back(
        {fmt::format("stroke=\"{}\" stroke-width=\"1.8\" stroke-dasharray=\"5 4\"", pale), baseline->name});
  if (d.raised)
    out.push_back({"stroke=\"none\"",
                   fmt::format("values below {:g} of the largest lie on the lower edge: they are zero up "
                               "to rounding",
                               rounding)});
  const auto with_unit = [](double v, const DisplayUnit& unit) {
    return number(v, 5) + (unit.symbol.empty() ? "" : (unit.symbol == "°" ? "" : " ") + unit.symbol);
  };
  if (d.peak)
    out.push_back(
        {"stroke=\"none\"", fmt::format("peak {} at {} is outside", with_unit(d.peak->value, d.shown.y),
                                        with_unit(d.peak->at, d.shown.x))});
  return out;
}

void draw_legend(std::string& out, const Axes& axes, const std::vector<LegendRow>& legend) {
  for (std::size_t i = 0; i < legend.size(); ++i) {
    const double y = axes.height + line_height * (static_cast<double>(i) + 0.5);
    put(out,
        "<path d=\"M{:.0f} {:.0f}h34\" {}/>"
        "<text x=\"{:.0f}\" y=\"{:.0f}\" font-size=\"12\" fill=\"#1d2935\">{}</text>\n",
        left, y, legend[i].look, left + 42, y + 4, escape(legend[i].text));
  }
}

/// The axes of x and y, as they are labelled.
std::pair<Side, Side> sides_of(const study::Plot& plot, const Table& table, const Drawing& d) {
  const bool counts = plot.style == Style::histogram, polar = plot.style == Style::polar;
  const std::vector<Curve>& curves = d.curves;
  const Shown& shown = d.shown;
  const Column* first = table.find(plot.y.front());
  const Column* x = table.find(plot.x);
  const std::string unit = !shown.y.symbol.empty() ? "(" + shown.y.symbol + ")"
                           : first                 ? unit_of(*first)
                                                   : "";
  const auto along = [&](const char* axis) { return unit.empty() ? axis : fmt::format("{} {}", axis, unit); };
  const std::string x_label = polar    ? along("x")
                              : counts ? (first ? label_with(*first, shown.y) : "")
                              : x      ? label_with(*x, shown.x)
                                       : plot.x;
  const bool one = curves.size() == 1 || (!plot.group.empty() && plot.y.size() == 1 && first);
  const std::string y_label =
      polar    ? along("y")
      : counts ? "count"
      : one ? (curves.size() == 1 && plot.group.empty() ? curves.front().label : label_with(*first, shown.y))
            : unit;
  return {{x_label, shown.x.symbol == "°"},
          {y_label, shown.y.symbol == "°" && !counts, plot.logarithmic_y && !polar}};
}

}  // namespace

std::string plot_svg(const study::Plot& plot, const Table& table, const Table* baseline) {
  if (plot.style == Style::map) return map_svg(plot, table);
  const bool polar = plot.style == Style::polar, origin = polar && !is_path(plot);
  const bool upright = plot.upright && !polar && plot.style != Style::histogram;
  const Drawing d = drawing_of(plot, table, baseline);
  const Axes axes = axes_of({&d.curves, &d.bands, &d.before}, plot.style, origin, upright, d.peak);
  const std::vector<LegendRow> legend = legend_of(plot, d, baseline);
  const bool empty = axes.box.empty();
  const double height =
      empty ? 60 : axes.height + (legend.empty() ? 0 : line_height * static_cast<double>(legend.size()) + 6);
  std::string out;
  put(out,
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
      "{1:.0f}\" role=\"img\" font-family=\"system-ui, sans-serif\"><title>{2}</title>"
      "<rect width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"#ffffff\"/>\n",
      width, height, escape(plot.title));
  if (empty) {
    out += "<text x=\"24\" y=\"36\" font-size=\"14\">No values.</text></svg>\n";
    return out;
  }
  const auto [along_x, along_y] = sides_of(plot, table, d);
  draw_axes(out, axes, upright ? along_y : along_x, upright ? along_x : along_y, origin);
  // Nothing is seen outside of the axes.
  if (d.peak)
    put(out,
        "<svg x=\"{0:.0f}\" y=\"{1:.0f}\" width=\"{2:.0f}\" height=\"{3:.0f}\" viewBox=\"{0:.0f} {1:.0f} "
        "{2:.0f} {3:.0f}\">\n",
        left, top, axes.inner_width(), axes.inner_height());
  for (const auto& band : d.bands) draw_band(out, axes, band);
  for (const auto& curve : d.before) draw_baseline(out, axes, curve, baseline->name);
  for (std::size_t i = 0; i < d.curves.size(); ++i)
    draw_curve(out, axes, d.curves[i],
               i < d.named || !d.bundle() ? curve_look(i) : CurveLook{d.faint, "none"},
               d.bundle() && i >= d.named, plot.style == Style::points);
  if (d.peak) out += "</svg>\n";
  draw_legend(out, axes, legend);
  out += "</svg>\n";
  return out;
}

}  // namespace linkwright::report
