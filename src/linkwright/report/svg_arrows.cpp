// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/detail/svg_arrows.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/report/detail/canvas.h"
#include "linkwright/report/markup.h"

namespace linkwright::report {
namespace {

using study::Scene;

constexpr double arc_radius = 30;  // px, of couples

// Shapes distinguish the quantities without their colours: one filled head, one open head, two open heads on
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
      linkwright::name_of(quantity), escape(title));
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

// An arc from the top: its length gives the size, its sense the sign.
void draw_arc(std::string& out, double x, double y, double r, double turn) {
  const std::string_view colour = look(Scene::Quantity::force).colour;
  // In the picture y points down: counter-clockwise is a falling angle.
  const double start = -pi / 2, end = start - turn;
  const double end_x = x + r * std::cos(end), end_y = y + r * std::sin(end);
  const double direction = end - std::copysign(pi / 2, turn);
  const std::string arc = fmt::format("M{:.2f} {:.2f}A{:.2f} {:.2f} 0 {} {} {:.2f} {:.2f}", x, y - r, r, r,
                                      std::abs(turn) > pi ? 1 : 0, turn > 0 ? 0 : 1, end_x, end_y);
  put(out, "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"6\"/>", arc, paper);
  put(out, "<path d=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2.6\"/>", arc, colour);
  put(out, "<path d=\"{}\" fill=\"{}\"/>",
      head_of(Scene::Quantity::force, end_x + 5 * std::cos(direction), end_y + 5 * std::sin(direction),
              direction, 12),
      colour);
}

}  // namespace

void draw_vectors(std::string& out, const Canvas& canvas, const Scene& scene, std::size_t sample,
                  const ShownArrows& shown, bool labels) {
  const auto& [quantity, scale] = shown;
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

// Draws the key: the value of an arrow of the length shown, one line a quantity, at the top left.
void draw_key(std::string& out, const Canvas& canvas, const Scene& scene,
              const std::vector<ShownArrows>& shown) {
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
  for (const auto& [quantity, scale] : shown) {
    if (scale.metres_per_unit == 0) continue;
    const double length = scale.key_value * scale.metres_per_unit * canvas.scale();
    const std::string text =
        fmt::format("{} {} {}", linkwright::name_of(quantity), number(scale.key_value), scale.unit);
    line(length, text,
         [&, quantity = quantity] { draw_arrow(out, quantity, 40, y, 40 + length, y, text, {}); });
  }
  const double most = largest_moment(scene);
  if (most > 0 && std::any_of(shown.begin(), shown.end(),
                              [](const ShownArrows& s) { return s.quantity == Scene::Quantity::force; }))
    line(20, fmt::format("full arc {} {}", number(most, 4), scene.moments.front().unit),
         [&] { draw_arc(out, 50, y, 9, arc_turn(0.75)); });
}

}  // namespace linkwright::report
