#include "linkwright/report/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/report/arrows.h"
#include "linkwright/report/drawing.h"
#include "linkwright/report/markup.h"

namespace linkwright::report {
namespace {

using study::Scene;

// Okabe and Ito's colours, which stay apart for the colour-blind; bodies take them in turn.
constexpr std::array<std::string_view, 6> body_colours = {"#0072B2", "#E69F00", "#009E73",
                                                          "#CC79A7", "#56B4E9", "#D55E00"};
constexpr std::string_view ink = "#1d2935";
constexpr std::string_view paper = "#ffffff";
constexpr std::string_view trace_colour = "#0072B2";
constexpr std::string_view error_colour = "#D55E00";

constexpr double margin = 64;        // px: room for ground hatching, labels and axis numbers
constexpr double bar_width = 13;     // px
constexpr double pin_radius = 4.6;   // px
constexpr double symbol_width = 18;  // px, across springs
constexpr double arc_radius = 30;    // px, of couples

// Shapes tell the quantities apart without their colours: one filled head, one open head, two open heads on
// dashes.
struct ArrowLook {
  std::string_view colour;
  double width;  // px
  std::string_view dashes;
};
ArrowLook look(Scene::Quantity quantity) {
  switch (quantity) {
    case Scene::Quantity::force:
      return {"#B8442E", 3, ""};
    case Scene::Quantity::velocity:
      return {"#00734F", 2.2, ""};
    case Scene::Quantity::acceleration:
      return {"#8A3D7F", 2.2, "6 3"};
  }
  return {ink, 2, ""};
}

// World (m, y up) to picture (px, y down).
class Canvas {
 public:
  Canvas(const Box& box, const SvgOptions& options) {
    const double size = std::max({box.width(), box.height(), 1e-12});
    // A scene that is flat in one direction still needs some room in it.
    const double width = std::max(box.width(), 0.2 * size), height = std::max(box.height(), 0.2 * size);
    scale_ = std::min((options.width - 2 * margin) / width, (options.max_height - 2 * margin) / height);
    width_ = options.width;
    height_ = std::ceil(height * scale_ + 2 * margin);
    centre_x_ = (box.x_min + box.x_max) / 2;
    centre_y_ = (box.y_min + box.y_max) / 2;
  }
  double x(double world) const { return width_ / 2 + (world - centre_x_) * scale_; }
  double y(double world) const { return height_ / 2 - (world - centre_y_) * scale_; }
  double world_x(double pixel) const { return centre_x_ + (pixel - width_ / 2) / scale_; }
  double world_y(double pixel) const { return centre_y_ - (pixel - height_ / 2) / scale_; }
  double width() const { return width_; }
  double height() const { return height_; }
  double scale() const { return scale_; }
  /// Times the usual width: bars are thinner where they are short, so that chains of many can be told apart.
  double thickness() const { return thickness_; }
  void fit_bars(double length) { thickness_ = std::clamp(length * scale_ / 40, 0.22, 1.0); }

 private:
  double scale_, width_, height_, centre_x_, centre_y_, thickness_ = 1;
};

template <class... Args>
void put(std::string& out, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Args>(args)...);
}

std::string path_of(const Canvas& canvas, const std::vector<Place>& places, bool closed) {
  std::string path;
  bool pen_down = false, whole = true;
  for (const Place& p : places) {
    if (!p.finite()) {
      pen_down = whole = false;
      continue;
    }
    put(path, "{}{:.2f} {:.2f}", pen_down ? 'L' : 'M', canvas.x(p.x), canvas.y(p.y));
    pen_down = true;
  }
  if (closed && whole && !path.empty()) path += 'Z';
  return path;
}

void draw_grid(std::string& out, const Canvas& canvas) {
  const double step = nice_step(std::max(canvas.width(), canvas.height()) / canvas.scale(), 9);
  const LengthUnit unit = length_unit(std::max(canvas.width(), canvas.height()) / canvas.scale() / 2);
  out += "<g class=\"grid\" stroke=\"#dfe5ea\" stroke-width=\"1\" fill=\"#64727f\" font-size=\"11\">\n";
  const auto from = [step](double w) { return static_cast<long long>(std::ceil(w / step)); };
  for (long long i = from(canvas.world_x(0)); canvas.x(static_cast<double>(i) * step) <= canvas.width();
       ++i) {
    const double x = canvas.x(static_cast<double>(i) * step);
    put(out, "<path d=\"M{0:.2f} 0V{1:.0f}\"/>", x, canvas.height());
    if (x > 30 && x < canvas.width() - 30)
      put(out, "<text stroke=\"none\" x=\"{:.2f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>\n", x,
          canvas.height() - 8, number(static_cast<double>(i) * step * unit.per_metre));
  }
  for (long long i = from(canvas.world_y(canvas.height())); canvas.y(static_cast<double>(i) * step) >= 0;
       ++i) {
    const double y = canvas.y(static_cast<double>(i) * step);
    put(out, "<path d=\"M0 {0:.2f}H{1:.0f}\"/>", y, canvas.width());
    if (y > 20 && y < canvas.height() - 30)
      put(out, "<text stroke=\"none\" x=\"6\" y=\"{:.2f}\">{}</text>\n", y - 4,
          number(static_cast<double>(i) * step * unit.per_metre));
  }
  put(out, "<text stroke=\"none\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{}</text></g>\n",
      canvas.width() - 8, canvas.height() - 8, unit.symbol);
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
  put(out, "<g class=\"body\"><title>{}</title>", escape(body.name));
  if (body.style == Scene::BodyStyle::ground) {
    put(out,
        "<path d=\"{}\" fill=\"none\" stroke=\"#64727f\" stroke-width=\"1.2\" stroke-dasharray=\"14 4 2 "
        "4\"/></g>\n",
        path);
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
    if (a.finite() && b.finite()) lengths.push_back(std::hypot(b.x - a.x, b.y - a.y));
  }
  if (lengths.empty()) return std::numeric_limits<double>::infinity();
  std::nth_element(lengths.begin(), lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2),
                   lengths.end());
  return lengths[lengths.size() / 2];
}

// Plates lie under the traces, bars above them, so that traces and pins stay in sight.
void draw_bodies(std::string& out, const Canvas& canvas, const Scene& scene, std::size_t sample,
                 bool plates) {
  std::size_t colour = 0;
  for (const auto& body : scene.bodies) {
    const std::string_view fill = body_colours[colour % body_colours.size()];
    if (body.style != Scene::BodyStyle::ground) ++colour;
    if ((body.style == Scene::BodyStyle::plate) == plates) draw_body(out, canvas, scene, body, sample, fill);
  }
}

void draw_traces(std::string& out, const Canvas& canvas, const Scene& scene) {
  for (const auto& trace : scene.traces) {
    std::vector<Place> places;
    for (std::size_t i = 0; i < scene.samples(); ++i) places.push_back(place(scene, trace.point, i));
    put(out,
        "<path class=\"trace\" d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\" "
        "stroke-linejoin=\"round\"><title>{}</title></path>\n",
        path_of(canvas, places, trace.closed), trace_colour, escape(trace.name));
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
    if (const Worst w = worst(target); w.distance > 0)
      put(out,
          "<circle class=\"worst\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"9\" fill=\"none\" stroke=\"{}\" "
          "stroke-width=\"1.6\" stroke-dasharray=\"3 2\"/>",
          canvas.x(target.x[w.index]), canvas.y(target.y[w.index]), error_colour);
    out += "</g>\n";
  }
}

// The head of an arrow that ends at (x, y), `angle` from the x axis of the picture.
std::string head_of(Scene::Quantity quantity, double x, double y, double angle, double size) {
  const auto wings = [&](double back) {
    const double cx = x - back * std::cos(angle), cy = y - back * std::sin(angle);
    const auto wing = [&](double side) {
      return std::pair{cx - size * std::cos(angle + side), cy - size * std::sin(angle + side)};
    };
    const auto a = wing(0.36), b = wing(-0.36);
    return fmt::format("M{:.2f} {:.2f}L{:.2f} {:.2f}L{:.2f} {:.2f}", a.first, a.second, cx, cy, b.first,
                       b.second);
  };
  if (quantity == Scene::Quantity::force) return wings(0) + "Z";
  if (quantity == Scene::Quantity::velocity) return wings(0);
  return wings(0) + wings(0.6 * size);
}

void draw_arrow(std::string& out, Scene::Quantity quantity, double x, double y, double end_x, double end_y,
                std::string_view title, std::string_view text) {
  const double length = std::hypot(end_x - x, end_y - y), angle = std::atan2(end_y - y, end_x - x);
  if (!(length > 0.5)) return;
  const ArrowLook style = look(quantity);
  const double size = std::min(13.0, std::max(5.0, 0.6 * length));
  const bool filled = quantity == Scene::Quantity::force;
  // The shaft ends inside the filled head, so that the head keeps its point.
  const double end = filled ? std::max(0.0, length - 0.8 * size) : length;
  const std::string shaft =
      fmt::format("M{:.2f} {:.2f}L{:.2f} {:.2f}", x, y, x + end * std::cos(angle), y + end * std::sin(angle));
  const std::string head = head_of(quantity, end_x, end_y, angle, size);
  put(out, "<g class=\"arrow {}\" fill=\"none\" stroke-linejoin=\"round\"><title>{}</title>",
      quantity_name(quantity), escape(title));
  put(out, "<path d=\"{}{}\" stroke=\"{}\" stroke-width=\"{}\"/>", shaft, head, paper, style.width + 3);
  put(out, "<path d=\"{}\" stroke=\"{}\" stroke-width=\"{}\" stroke-dasharray=\"{}\"/>", shaft, style.colour,
      style.width, style.dashes.empty() ? "none" : style.dashes);
  put(out, "<path d=\"{}\" stroke=\"{}\" stroke-width=\"{}\" fill=\"{}\"/>", head, style.colour,
      filled ? 1 : style.width, filled ? style.colour : "none");
  if (!text.empty())
    put(out,
        "<text x=\"{:.2f}\" y=\"{:.2f}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"4\" paint-order=\"stroke\" "
        "font-size=\"13\" text-anchor=\"{}\">{}</text>",
        end_x + 10 * std::cos(angle), end_y + 10 * std::sin(angle) + 4.5, style.colour, paper,
        std::cos(angle) < -0.3  ? "end"
        : std::cos(angle) < 0.3 ? "middle"
                                : "start",
        escape(text));
  out += "</g>\n";
}

void draw_vectors(std::string& out, const Canvas& canvas, const Scene& scene, std::size_t sample,
                  Scene::Quantity quantity, bool labels) {
  const ArrowScale scale = arrow_scale(scene, quantity);
  if (scale.metres_per_unit == 0) return;
  for (const auto& vector : scene.vectors) {
    if (vector.quantity != quantity) continue;
    const Place from = place(scene, vector.point, sample), end = tip(scene, vector, sample, scale);
    if (end.finite())
      draw_arrow(
          out, quantity, canvas.x(from.x), canvas.y(from.y), canvas.x(end.x), canvas.y(end.y),
          fmt::format("{}: {} {}", vector.name, number(components(vector, sample).size(), 5), vector.unit),
          labels ? vector.symbol : std::string());
  }
}

// An arc from the top: its length tells the size, its sense the sign.
void draw_arc(std::string& out, double x, double y, double r, double turn) {
  const std::string_view colour = look(Scene::Quantity::force).colour;
  // In the picture y points down: counter-clockwise is a falling angle.
  const double start = -std::numbers::pi / 2, end = start - turn;
  const double end_x = x + r * std::cos(end), end_y = y + r * std::sin(end);
  const double direction = end - std::copysign(std::numbers::pi / 2, turn);
  const std::string arc =
      fmt::format("M{:.2f} {:.2f}A{:.2f} {:.2f} 0 {} {} {:.2f} {:.2f}", x, y - r, r, r,
                  std::abs(turn) > std::numbers::pi ? 1 : 0, turn > 0 ? 0 : 1, end_x, end_y);
  put(out, "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"6\"/>", arc, paper);
  put(out, "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2.6\"/>", arc, colour);
  put(out, "<path d=\"{}\" fill=\"{}\"/>",
      head_of(Scene::Quantity::force, end_x + 5 * std::cos(direction), end_y + 5 * std::sin(direction),
              direction, 12),
      colour);
}

void draw_moments(std::string& out, const Canvas& canvas, const Scene& scene, std::size_t sample,
                  bool labels) {
  const double most = largest_moment(scene);
  for (auto moment = scene.moments.begin(); moment != scene.moments.end(); ++moment) {
    const Place centre = place(scene, moment->point, sample);
    const double v = value(*moment, sample);
    if (!centre.finite() || !std::isfinite(v) || v == 0) continue;
    // Several couples about one point lie one outside the other.
    const auto before = std::count_if(scene.moments.begin(), moment,
                                      [&](const Scene::Moment& m) { return m.point == moment->point; });
    const double r = arc_radius + 10 * static_cast<double>(before);
    const double x = canvas.x(centre.x), y = canvas.y(centre.y);
    put(out, "<g class=\"moment\"><title>{}: {} {}</title>", escape(moment->name), number(v, 5),
        escape(moment->unit));
    draw_arc(out, x, y, r, arc_turn(v / most));
    if (labels && !moment->symbol.empty())
      put(out,
          "<text x=\"{:.2f}\" y=\"{:.2f}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"4\" "
          "paint-order=\"stroke\" font-size=\"13\" text-anchor=\"middle\">{}</text>",
          x, y - r - 7, look(Scene::Quantity::force).colour, paper, escape(moment->symbol));
    out += "</g>\n";
  }
}

// What an arrow of the length shown is worth, one line a quantity, at the top left.
void draw_key(std::string& out, const Canvas& canvas, const Scene& scene,
              const std::vector<Scene::Quantity>& shown) {
  double y = 24;
  const auto line = [&](double length, const std::string& text, auto&& sign) {
    put(out,
        "<g class=\"key\"><rect x=\"34\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"24\" fill=\"{}\" "
        "fill-opacity=\"0.88\"/>",
        y - 12, length + 26 + 7.2 * static_cast<double>(text.size()), paper);
    sign();
    put(out, "<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\" font-size=\"13\">{}</text></g>\n", 50 + length,
        y + 4.5, ink, escape(text));
    y += 24;
  };
  for (const Scene::Quantity quantity : shown) {
    const ArrowScale scale = arrow_scale(scene, quantity);
    if (scale.metres_per_unit == 0) continue;
    const double length = scale.key_value * scale.metres_per_unit * canvas.scale();
    const std::string text =
        fmt::format("{} {} {}", quantity_name(quantity), number(scale.key_value), scale.unit);
    line(length, text, [&] { draw_arrow(out, quantity, 40, y, 40 + length, y, text, {}); });
  }
  const double most = largest_moment(scene);
  if (most > 0 && std::find(shown.begin(), shown.end(), Scene::Quantity::force) != shown.end())
    line(20, fmt::format("full arc {} {}", number(most, 4), scene.moments.front().unit),
         [&] { draw_arc(out, 50, y, 9, arc_turn(0.75)); });
}

}  // namespace

std::string svg(const study::Scene& scene, const SvgOptions& options) {
  LINKWRIGHT_REQUIRE(!options.sample || *options.sample < scene.samples(),
                     "sample {} of a scene with {} samples", *options.sample, scene.samples());
  const std::size_t sample = options.sample.value_or(reference_sample(scene));
  std::vector<Scene::Quantity> shown;
  if (options.forces) shown.push_back(Scene::Quantity::force);
  if (options.velocities) shown.push_back(Scene::Quantity::velocity);
  if (options.accelerations) shown.push_back(Scene::Quantity::acceleration);
  Box box = bounds(scene);
  for (const Scene::Quantity quantity : shown) {
    const ArrowScale scale = arrow_scale(scene, quantity);
    for (const auto& vector : scene.vectors)
      if (const Place end = tip(scene, vector, sample, scale); vector.quantity == quantity)
        box.add(end.x, end.y);
  }
  std::string out;
  if (box.empty()) {
    put(out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"120\" viewBox=\"0 0 {0:.0f} "
        "120\" role=\"img\" "
        "font-family=\"sans-serif\"><title>{1}</title><text x=\"24\" y=\"64\" font-size=\"15\">Nothing to "
        "draw: the mechanism "
        "assembles at no input.</text></svg>\n",
        options.width, escape(scene.title));
    return out;
  }
  Canvas canvas(box, options);
  canvas.fit_bars(usual_length(scene, sample));
  put(out,
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" height=\"{1:.0f}\" viewBox=\"0 0 {0:.0f} "
      "{1:.0f}\" role=\"img\" "
      "font-family=\"system-ui, sans-serif\"><title>{2}</title>\n"
      "<rect class=\"paper\" width=\"{0:.0f}\" height=\"{1:.0f}\" fill=\"{3}\"/>\n",
      canvas.width(), canvas.height(), escape(scene.title), paper);
  if (options.grid) draw_grid(out, canvas);
  for (int i = 0; i < options.ghosts; ++i) {
    const std::size_t ghost =
        scene.samples() * static_cast<std::size_t>(i) / static_cast<std::size_t>(options.ghosts);
    out += "<g class=\"ghost\" opacity=\"0.13\">\n";
    for (const bool plates : {true, false}) draw_bodies(out, canvas, scene, ghost, plates);
    out += "</g>\n";
  }
  draw_circles(out, canvas, scene, sample);
  draw_bodies(out, canvas, scene, sample, true);
  if (options.traces) draw_traces(out, canvas, scene);
  draw_bodies(out, canvas, scene, sample, false);
  for (const auto& joint : scene.joints) draw_joint(out, canvas, scene, joint, sample, options.labels);
  if (options.targets) draw_targets(out, canvas, scene, options.whisker_scale);
  for (const Scene::Quantity quantity : shown)
    draw_vectors(out, canvas, scene, sample, quantity, options.labels);
  if (options.forces) draw_moments(out, canvas, scene, sample, options.labels);
  draw_key(out, canvas, scene, shown);
  out += "</svg>\n";
  return out;
}

}  // namespace linkwright::report
