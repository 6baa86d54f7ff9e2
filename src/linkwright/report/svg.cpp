// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/svg.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/report/arrows.h"
#include "linkwright/report/detail/canvas.h"
#include "linkwright/report/detail/svg_arrows.h"
#include "linkwright/report/drawing.h"
#include "linkwright/report/markup.h"
#include "linkwright/report/spatial.h"
#include "linkwright/report/units.h"

namespace linkwright::report {
namespace {

using study::Scene;

// Okabe and Ito's colours, which stay apart for the colour-blind, then darker and lighter ones; bodies take
// them in turn by their roles, as on the page (report.css).
constexpr std::array<std::string_view, 18> body_colours = {
    "#0072B2", "#E69F00", "#009E73", "#CC79A7", "#56B4E9", "#D55E00", "#003F62", "#7E5700", "#00573F",
    "#70435C", "#2F6380", "#753400", "#8CC0DC", "#F4D48C", "#8CD3C0", "#E8C3D7", "#B3DDF5", "#ECB78C"};
constexpr std::string_view trace_colour = "#0072B2";
constexpr std::string_view error_colour = "#D55E00";

constexpr double bar_width = 13;     // px
constexpr double pin_radius = 4.6;   // px
constexpr double symbol_width = 18;  // px, across springs

std::string path_of(const Canvas& canvas, const std::vector<Place>& places, bool closed) {
  std::vector<Place> line;
  for (const Place& p : places) line.push_back({canvas.x(p.x), canvas.y(p.y), p.z});
  return path_data(line, closed);
}

// Coordinates along the sheet that grow to the left, and their names, as the views of a spatial scene have
// them; `sheet` is what the distance of the lines is chosen for (px).
struct Mirrored {
  std::string_view across, up;
  double sheet;
};

void draw_grid(std::string& out, const Canvas& canvas, const SvgOptions& options,
               const Mirrored* mirrored = nullptr) {
  const double sheet = mirrored ? mirrored->sheet : std::max(canvas.width(), canvas.height());
  const double across = mirrored ? -1 : 1;
  const LengthUnit unit = options.length.value_or(length_unit(sheet / canvas.scale() / 2));
  // The lines are at round numbers of the unit that is shown.
  const double step = nice_step(sheet / canvas.scale() * unit.per_metre, 9) / unit.per_metre;
  out += "<g class=\"grid\" stroke=\"#dfe5ea\" stroke-width=\"1\" fill=\"#64727f\" font-size=\"11\">\n";
  const auto from = [step](double w) { return static_cast<long long>(std::ceil(w / step)); };
  for (long long i = from(canvas.world_x(0)); canvas.x(static_cast<double>(i) * step) <= canvas.width();
       ++i) {
    const double x = canvas.x(static_cast<double>(i) * step);
    put(out, "<path d=\"M{0:.2f} 0V{1:.0f}\"/>", x, canvas.height());
    if (x > 30 && x < canvas.width() - (mirrored ? 70 : 30))
      put(out, "<text stroke=\"none\" x=\"{:.2f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", x,
          canvas.height() - 8, number(i == 0 ? 0 : across * static_cast<double>(i) * step * unit.per_metre));
  }
  for (long long i = from(canvas.world_y(canvas.height())); canvas.y(static_cast<double>(i) * step) >= 0;
       ++i) {
    const double y = canvas.y(static_cast<double>(i) * step);
    put(out, "<path d=\"M0 {0:.2f}H{1:.0f}\"/>", y, canvas.width());
    if (y > (mirrored ? 40 : 20) && y < canvas.height() - 30)
      put(out, "<text stroke=\"none\" x=\"6\" y=\"{:.2f}\">{}</text>\n", y - 4,
          number(static_cast<double>(i) * step * unit.per_metre));
  }
  const std::string name = mirrored ? fmt::format("{} ({})", mirrored->across, unit.symbol) : unit.symbol;
  if (mirrored)
    put(out, "<text stroke=\"none\" x=\"6\" y=\"20\">{} ({})</text>\n", mirrored->up, unit.symbol);
  put(out, "<text stroke=\"none\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text></g>\n",
      canvas.width() - 8, canvas.height() - 8, name);
}

void draw_symbol(std::string& out, const Canvas& canvas, const Scene::Body& body,
                 const std::vector<Place>& places) {
  std::string path;
  for (std::size_t i = 1; i < places.size(); ++i)
    for (const auto& line : symbol_lines(body.style, places[i - 1], places[i], symbol_width / canvas.scale()))
      path += path_of(canvas, line, false);
  put(out,
      "<path class=\"body\" d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
      "stroke-linejoin=\"round\"><title>{}</title></path>\n",
      path, ink, body.style == Scene::BodyStyle::guide ? 1.2 : 2.0, escape(body.name));
}

void draw_circles(std::string& out, const Canvas& canvas, const Scene& scene, std::size_t sample) {
  for (const auto& circle : scene.circles) {
    const double r = radius(scene, circle, sample) * canvas.scale();
    if (!(r > 0)) continue;
    const Place c = place(scene, circle.centre, sample), rim = place(scene, circle.rim, sample);
    const double x = canvas.x(c.x), y = canvas.y(c.y), end_x = canvas.x(rim.x), end_y = canvas.y(rim.y);
    put(out,
        "<g class=\"circle\"><title>{}</title><circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"{}\" "
        "fill-opacity=\"0.06\" stroke=\"{}\" stroke-width=\"1.6\"/>",
        escape(circle.name), x, y, r, ink, ink);
    // The mark leaves the middle free for the pin.
    put(out, "<path d=\"M{:.2f} {:.2f}L{:.2f} {:.2f}\" stroke=\"{}\" stroke-width=\"3\"/></g>\n",
        x + 0.72 * (end_x - x), y + 0.72 * (end_y - y), end_x, end_y, ink);
  }
}

void draw_body(std::string& out, const Canvas& canvas, const Scene& scene, const Scene::Body& body,
               std::size_t sample, std::string_view colour) {
  std::vector<Place> places;
  for (const int point : body.points) places.push_back(place(scene, point, sample));
  if (places.size() < 2 ||
      !std::all_of(places.begin(), places.end(), [](const Place& p) { return p.finite(); }))
    return;
  if (is_symbol(body.style)) {
    draw_symbol(out, canvas, body, places);
    return;
  }
  const bool plate = body.style == Scene::BodyStyle::plate && places.size() > 2;
  const std::string path = path_of(canvas, places, plate);
  if (body.run > 0) {
    const CurveLook look = curve_look(static_cast<std::size_t>(body.run));
    put(out,
        "<path class=\"other\" d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.6\" "
        "stroke-dasharray=\"{}\"><title>{}</title></path>\n",
        path, look.colour, look.dash, escape(body.name));
    return;
  }
  put(out, "<g class=\"body\"><title>{}</title>", escape(body.name));
  if (body.style == Scene::BodyStyle::ground) {
    put(out,
        "<path d=\"{}\" fill=\"none\" stroke=\"#64727f\" stroke-width=\"1.2\" stroke-dasharray=\"14 4 2 "
        "4\"/></g>\n",
        path);
    return;
  }
  if (body.style == Scene::BodyStyle::axis) {
    put(out,
        "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.4\" stroke-dasharray=\"14 4 2 "
        "4\"/></g>\n",
        path_of(canvas, beyond(places), false), error_colour);
    return;
  }
  if (body.style == Scene::BodyStyle::gap) {
    const Place &a = places[0], &b = places[1];
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    put(out, "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2.4\" stroke-dasharray=\"6 5\"/>",
        path, error_colour);
    put(out, "<text x=\"{:.2f}\" y=\"{:.2f}\" fill=\"{}\">gap {}</text></g>\n",
        (canvas.x(a.x) + canvas.x(b.x)) / 2 + 8, (canvas.y(a.y) + canvas.y(b.y)) / 2 - 8, error_colour,
        quantity(length, display_unit("_m", length)));
    return;
  }
  if (plate) put(out, "<path d=\"{}\" fill=\"{}\" fill-opacity=\"0.24\"/>", path, colour);
  // A rounded bar with an outline is a thick line under a slightly thinner one.
  const double inside = (bar_width - 2.6) * canvas.thickness();
  for (const auto& [stroke, width] : {std::pair{ink, inside + 2.6}, std::pair{colour, inside}})
    put(out,
        "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.3g}\" stroke-linecap=\"round\" "
        "stroke-linejoin=\"round\"/>",
        path, stroke, width);
  out += "</g>\n";
}

void draw_joint(std::string& out, const Canvas& canvas, const Scene& scene, const Scene::Joint& joint,
                std::size_t sample, bool label) {
  const Place p = place(scene, joint.point, sample);
  if (!p.finite()) return;
  const double x = canvas.x(p.x), y = canvas.y(p.y);
  put(out, "<g class=\"joint\"><title>{}</title>", escape(joint.name));
  if (joint.style == Scene::JointStyle::ground_pivot) {
    put(out,
        "<path d=\"M{:.2f} {:.2f}l-11 18h22z\" fill=\"{}\" stroke=\"{}\" stroke-width=\"1.6\" "
        "stroke-linejoin=\"round\"/>",
        x, y, paper, ink);
    put(out, "<path d=\"M{:.2f} {:.2f}h36", x - 18, y + 18);
    for (int i = 0; i < 6; ++i) put(out, "M{:.2f} {:.2f}l-6 7", x - 12 + 6 * i, y + 18);
    put(out, "\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.4\"/>", ink);
  }
  if (joint.style == Scene::JointStyle::tracer)
    put(out, "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"5\" fill=\"{}\" stroke=\"{}\" stroke-width=\"1.6\"/>",
        x, y, error_colour, paper);
  else
    put(out, "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"1.6\"/>",
        x, y, pin_radius * std::max(0.45, canvas.thickness()), paper, ink);
  if (label)
    put(out,
        "<text x=\"{:.2f}\" y=\"{:.2f}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"4\" paint-order=\"stroke\" "
        "font-size=\"13\" "
        "font-style=\"italic\">{}</text>",
        x + 11, y - 9, ink, paper, escape(joint.name));
  out += "</g>\n";
}

// Median of the first sides of bars and plates (m); infinite without any.
double usual_length(const Scene& scene, std::size_t sample) {
  std::vector<double> lengths;
  for (const auto& body : scene.bodies) {
    if (body.style != Scene::BodyStyle::bar && body.style != Scene::BodyStyle::plate) continue;
    if (body.points.size() < 2) continue;
    const Place a = place(scene, body.points[0], sample), b = place(scene, body.points[1], sample);
    if (a.finite() && b.finite()) lengths.push_back(std::hypot(b.x - a.x, b.y - a.y, b.z - a.z));
  }
  if (lengths.empty()) return infinity;
  std::nth_element(lengths.begin(), lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2),
                   lengths.end());
  return lengths[lengths.size() / 2];
}

// Plates lie under the traces, bars above them, so that traces and pins stay in sight.
void draw_bodies(std::string& out, const Canvas& canvas, const Scene& scene, std::size_t sample,
                 bool plates) {
  const std::vector<std::size_t> colours = role_numbers(scene);
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const auto& body = scene.bodies[i];
    const std::string_view fill = body_colours[colours[i] % body_colours.size()];
    if ((body.style == Scene::BodyStyle::plate) == plates) draw_body(out, canvas, scene, body, sample, fill);
  }
}

void draw_traces(std::string& out, const Canvas& canvas, const Scene& scene) {
  for (const auto& trace : scene.traces) {
    std::vector<Place> places;
    for (std::size_t i = 0; i < scene.samples(); ++i)
      places.push_back(assembled(scene, i) ? place(scene, trace.point, i) : Place{nan, nan});
    put(out,
        "<path class=\"trace\" d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" "
        "stroke-linejoin=\"round\"><title>{}</title></path>\n",
        path_of(canvas, places, trace.closed),
        scene.runs.empty() ? trace_colour : curve_look(static_cast<std::size_t>(trace.run)).colour,
        trace.run > 0 ? 1.4 : 2.0, escape(trace.name));
  }
}

// Draws the names of the mechanisms that are drawn over each other.
void draw_runs(std::string& out, const Scene& scene) {
  double y = 20;
  for (std::size_t run = 0; run < scene.runs.size(); ++run) {
    const CurveLook look = curve_look(run);
    put(out,
        "<path d=\"M12 {:.0f}h30\" stroke=\"{}\" stroke-width=\"{}\" stroke-dasharray=\"{}\"/>"
        "<text x=\"50\" y=\"{:.0f}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"4\" paint-order=\"stroke\" "
        "font-size=\"13\">{}</text>\n",
        y - 4, look.colour, run > 0 ? 1.6 : 4.0, look.dash, y, ink, paper, escape(scene.runs[run]));
    y += 18;
  }
}

void draw_targets(std::string& out, const Canvas& canvas, const Scene& scene, double whisker_scale) {
  for (const auto& target : scene.targets) {
    put(out, "<g class=\"target\"><title>{}</title>", escape(target.name));
    for (std::size_t i = 0; i < std::min(target.x.size(), target.y.size()); ++i) {
      const Place wanted{target.x[i], target.y[i]};
      if (!wanted.finite()) continue;
      const double x = canvas.x(wanted.x), y = canvas.y(wanted.y);
      if (i < target.achieved_x.size() && i < target.achieved_y.size()) {
        const Place end{wanted.x + whisker_scale * (target.achieved_x[i] - wanted.x),
                        wanted.y + whisker_scale * (target.achieved_y[i] - wanted.y)};
        if (end.finite())
          put(out, "<path d=\"M{:.2f} {:.2f}L{:.2f} {:.2f}\" stroke=\"{}\" stroke-width=\"2\"/>", x, y,
              canvas.x(end.x), canvas.y(end.y), error_colour);
      }
      put(out,
          "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"3.6\" fill=\"{}\" stroke=\"{}\" stroke-width=\"1.5\"/>", x,
          y, paper, ink);
    }
    if (const study::Extreme w = worst(target); w.value > 0)
      put(out,
          "<circle class=\"worst\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"9\" fill=\"none\" stroke=\"{}\" "
          "stroke-width=\"1.6\" stroke-dasharray=\"3 2\"/>",
          canvas.x(target.x[w.row]), canvas.y(target.y[w.row]), error_colour);
    out += "</g>\n";
  }
}

// Names of joints of which several may lie behind each other: one that would cover another moves down.
class Labels {
 public:
  void write(std::string& out, double x, double y, std::string_view text) {
    const double width = 7.5 * static_cast<double>(text.size());
    const auto taken = [&](const Taken& t) {
      return std::abs(t.y - y) < 13 && x < t.x + t.width && t.x < x + width;
    };
    while (std::any_of(taken_.begin(), taken_.end(), taken)) y += 13;
    taken_.push_back({x, y, width});
    put(out,
        "<text x=\"{:.2f}\" y=\"{:.2f}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"3\" "
        "paint-order=\"stroke\" font-size=\"12\" font-style=\"italic\">{}</text>",
        x, y, ink, paper, escape(text));
  }

 private:
  struct Taken {
    double x, y, width;
  };
  std::vector<Taken> taken_;
};

// Joints of a spatial scene have signs without a direction: ground joints are filled squares.
void draw_spatial_joints(std::string& out, const Canvas& canvas, const Scene& scene, std::size_t sample,
                         bool label) {
  Labels labels;
  for (const auto& joint : scene.joints) {
    const Place p = place(scene, joint.point, sample);
    if (!p.finite()) continue;
    const double x = canvas.x(p.x), y = canvas.y(p.y);
    put(out, "<g class=\"joint\"><title>{}</title>", escape(joint.name));
    if (joint.style == Scene::JointStyle::ground_pivot)
      put(out, "<path d=\"M{:.2f} {:.2f}h8v8h-8z\" fill=\"{}\"/>", x - 4, y - 4, ink);
    else
      put(out,
          "<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"3.6\" fill=\"{}\" stroke=\"{}\" stroke-width=\"1.4\"/>", x,
          y, joint.style == Scene::JointStyle::tracer ? error_colour : paper, ink);
    if (label) labels.write(out, x + 7, y - 6, joint.name);
    out += "</g>\n";
  }
}

void draw_wheels(std::string& out, const Canvas& canvas, const Scene& scene, std::size_t sample) {
  for (const auto& disc : scene.discs) {
    const std::string outline = path_of(canvas, wheel_outline(scene, disc, sample), true);
    if (outline.empty()) continue;
    put(out,
        "<g class=\"wheel\"><title>{}</title><path d=\"{}\" fill=\"{}\" fill-opacity=\"0.08\" stroke=\"{}\" "
        "stroke-width=\"1.3\"/>",
        escape(disc.name), outline, ink, ink);
    // The plane of the wheel, and the rim towards the eye.
    put(out,
        "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.2\" stroke-dasharray=\"14 3 2 "
        "3\"/></g>\n",
        path_of(canvas, wheel_circle(scene, disc, sample, 1, 0, 48), true), trace_colour);
  }
}

std::vector<ShownArrows> shown_arrows(const Scene& scene, const SvgOptions& options) {
  std::vector<ShownArrows> out;
  for (const auto& [wanted, quantity] : {std::pair{options.forces, Scene::Quantity::force},
                                         std::pair{options.velocities, Scene::Quantity::velocity},
                                         std::pair{options.accelerations, Scene::Quantity::acceleration}})
    if (wanted) out.push_back({quantity, arrow_scale(scene, quantity)});
  return out;
}

void add_tips(Box& box, const Scene& scene, std::size_t sample, const std::vector<ShownArrows>& shown) {
  for (const auto& [quantity, scale] : shown)
    for (const auto& vector : scene.vectors)
      if (const Place end = tip(scene, vector, sample, scale); vector.quantity == quantity)
        box.add(end.x, end.y);
}

void open_document(std::string& out, double width, double height, std::string_view title) {
  put(out,
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
      "{1:.0f}\" role=\"img\" "
      "font-family=\"system-ui, sans-serif\"><title>{2}</title>\n"
      "<rect class=\"paper\" width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"{3}\"/>\n",
      width, height, escape(title), paper);
}

std::string nothing(const Scene& scene, const SvgOptions& options) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"120\" viewBox=\"0 0 {0:.0f} "
      "120\" role=\"img\" "
      "font-family=\"sans-serif\"><title>{1}</title><text x=\"24\" y=\"64\" font-size=\"15\">Nothing to "
      "draw: the mechanism "
      "assembles at no input.</text></svg>\n",
      options.width, escape(to_string(scene.title)));
}

void draw_ghosts(std::string& out, const Canvas& canvas, const Scene& scene, int count) {
  for (int i = 0; i < count; ++i) {
    const std::size_t ghost = scene.samples() * static_cast<std::size_t>(i) / static_cast<std::size_t>(count);
    out += "<g class=\"ghost\" opacity=\"0.13\">\n";
    for (const bool plates : {true, false}) draw_bodies(out, canvas, scene, ghost, plates);
    out += "</g>\n";
  }
}

// Three views of one scale: the side right of the rear view, at the same height, and the top below it.
std::string views_of(const Scene& scene, std::size_t sample, const SvgOptions& options) {
  constexpr double edge = 46, gap = 1;  // px
  const std::vector<ShownArrows> shown = shown_arrows(scene, options);
  std::array<Scene, 3> seen;
  std::array<Box, 3> boxes;
  for (std::size_t k = 0; k < 3; ++k) {
    seen[k] = seen_from(scene, viewpoints[k]);
    boxes[k] = bounds(seen[k]);
    if (boxes[k].empty()) return nothing(scene, options);
    add_tips(boxes[k], seen[k], sample, shown);
  }
  auto& [rear, side, top] = boxes;
  rear.x_min = top.x_min = std::min(rear.x_min, top.x_min);
  rear.x_max = top.x_max = std::max(rear.x_max, top.x_max);
  rear.y_min = side.y_min = std::min(rear.y_min, side.y_min);
  rear.y_max = side.y_max = std::max(rear.y_max, side.y_max);
  // A scene that is flat in one direction still needs some room in it.
  const double least = 0.2 * extent(scene) + 1e-12;
  const auto room = [least](double length) { return std::max(length, least); };
  const double left = room(rear.width()), right = room(side.width());
  const double upper = room(rear.height()), lower = room(top.height());
  const double scale = std::min((options.width - 4 * edge - gap) / (left + right),
                                (1.5 * options.max_height - 4 * edge - gap) / (upper + lower));
  // The room that the scale leaves over goes to both columns.
  const double spare = (options.width - gap - 4 * edge - scale * (left + right)) / 2;
  const double widths[] = {left * scale + 2 * edge + spare, right * scale + 2 * edge + spare};
  const double heights[] = {std::ceil(upper * scale + 2 * edge), std::ceil(lower * scale + 2 * edge)};
  std::string out;
  open_document(out, options.width, heights[0] + gap + heights[1], to_string(scene.title));
  for (std::size_t k = 0; k < 3; ++k) {
    const double width = widths[k == 1], height = heights[k == 2];
    Canvas canvas(boxes[k], scale, width, height);
    canvas.fit_bars(usual_length(scene, sample), 0.55);
    put(out, "<svg class=\"view\" x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\">\n",
        k == 1 ? widths[0] + gap : 0, k == 2 ? heights[0] + gap : 0, width, height);
    const Mirrored names{k == 1 ? "x" : "y", k == 2 ? "x" : "z", options.width};
    if (options.grid) draw_grid(out, canvas, options, &names);
    draw_ghosts(out, canvas, seen[k], options.ghosts);
    draw_wheels(out, canvas, seen[k], sample);
    draw_bodies(out, canvas, seen[k], sample, true);
    if (options.traces) draw_traces(out, canvas, seen[k]);
    draw_bodies(out, canvas, seen[k], sample, false);
    // More joints than this have no room for their names, which stay as titles.
    constexpr std::size_t crowded = 12;
    draw_spatial_joints(out, canvas, seen[k], sample, options.labels && scene.joints.size() <= crowded);
    for (const ShownArrows& arrows : shown)
      draw_vectors(out, canvas, seen[k], sample, arrows, options.labels);
    if (k == 0) draw_runs(out, scene);
    put(out,
        "<rect x=\"0.5\" y=\"0.5\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"#c3ccd4\"/>"
        "<text x=\"{:.1f}\" y=\"20\" fill=\"{}\" stroke=\"{}\" stroke-width=\"4\" paint-order=\"stroke\" "
        "font-size=\"13\" text-anchor=\"end\">{}</text></svg>\n",
        width - 1, height - 1, width - 10, ink, paper, viewpoints[k].name);
  }
  // The corner that is left gives the scale of the arrows.
  put(out, "<svg x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\">\n", widths[0] + gap,
      heights[0] + gap, widths[1], heights[1]);
  draw_key(out, Canvas(top, scale, widths[1], heights[1]), seen[0], shown);
  out += "</svg></svg>\n";
  return out;
}

}  // namespace

std::string svg(const study::Scene& scene, const SvgOptions& options) {
  LINKWRIGHT_REQUIRE(!options.sample || *options.sample < scene.samples(),
                     "sample {} of a scene with {} samples", *options.sample, scene.samples());
  const std::size_t sample = options.sample.value_or(reference_sample(scene));
  if (!scene.second.empty()) {
    SvgOptions within = options;
    if (scene.samples() > 0) within.sample = sample % scene.input.size();
    return svg(row_of(scene, scene.input.empty() ? 0 : sample / scene.input.size()), within);
  }
  if (scene.spatial()) return views_of(scene, sample, options);
  const std::vector<ShownArrows> shown = shown_arrows(scene, options);
  Box box = bounds(scene);
  add_tips(box, scene, sample, shown);
  if (box.empty()) return nothing(scene, options);
  Canvas canvas(box, options);
  canvas.fit_bars(usual_length(scene, sample));
  std::string out;
  open_document(out, canvas.width(), canvas.height(), to_string(scene.title));
  if (options.grid) draw_grid(out, canvas, options);
  draw_ghosts(out, canvas, scene, options.ghosts);
  draw_circles(out, canvas, scene, sample);
  draw_bodies(out, canvas, scene, sample, true);
  if (options.traces) draw_traces(out, canvas, scene);
  draw_bodies(out, canvas, scene, sample, false);
  for (const auto& joint : scene.joints) draw_joint(out, canvas, scene, joint, sample, options.labels);
  if (options.targets) draw_targets(out, canvas, scene, options.whisker_scale);
  for (const ShownArrows& arrows : shown) draw_vectors(out, canvas, scene, sample, arrows, options.labels);
  if (options.forces) draw_moments(out, canvas, scene, sample, options.labels);
  draw_runs(out, scene);
  draw_key(out, canvas, scene, shown);
  out += "</svg>\n";
  return out;
}

}  // namespace linkwright::report
