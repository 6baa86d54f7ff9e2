#include "linkwright/report/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/check.h"
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

constexpr double margin = 64;       // px: room for ground hatching, labels and axis numbers
constexpr double bar_width = 13;    // px
constexpr double pin_radius = 4.6;  // px

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

 private:
  double scale_, width_, height_, centre_x_, centre_y_;
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

void draw_body(std::string& out, const Canvas& canvas, const Scene& scene, const Scene::Body& body,
               std::size_t sample, std::string_view colour) {
  std::vector<Place> places;
  for (const int point : body.points) places.push_back(place(scene, point, sample));
  if (places.size() < 2 ||
      !std::all_of(places.begin(), places.end(), [](const Place& p) { return p.finite(); }))
    return;
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
  for (const auto& [stroke, width] : {std::pair{ink, bar_width}, std::pair{colour, bar_width - 2.6}})
    put(out,
        "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" stroke-linecap=\"round\" "
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
        x, y, pin_radius, paper, ink);
  if (label)
    put(out,
        "<text x=\"{:.2f}\" y=\"{:.2f}\" fill=\"{}\" stroke=\"{}\" stroke-width=\"4\" paint-order=\"stroke\" "
        "font-size=\"13\" "
        "font-style=\"italic\">{}</text>",
        x + 11, y - 9, ink, paper, escape(joint.name));
  out += "</g>\n";
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

}  // namespace

std::string svg(const study::Scene& scene, const SvgOptions& options) {
  LINKWRIGHT_REQUIRE(!options.sample || *options.sample < scene.samples(),
                     "sample {} of a scene with {} samples", *options.sample, scene.samples());
  const std::size_t sample = options.sample.value_or(reference_sample(scene));
  const Box box = bounds(scene);
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
  const Canvas canvas(box, options);
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
  draw_bodies(out, canvas, scene, sample, true);
  if (options.traces) draw_traces(out, canvas, scene);
  draw_bodies(out, canvas, scene, sample, false);
  for (const auto& joint : scene.joints) draw_joint(out, canvas, scene, joint, sample, options.labels);
  if (options.targets) draw_targets(out, canvas, scene, options.whisker_scale);
  out += "</svg>\n";
  return out;
}

}  // namespace linkwright::report
