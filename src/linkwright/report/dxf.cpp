// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/dxf.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "linkwright/core/check.h"
#include "linkwright/report/drawing.h"
#include "linkwright/report/spatial.h"

namespace linkwright::report {
namespace {

using study::Scene;

constexpr double millimetres = 1000;

// Group codes and values, one a line (AutoCAD R12 Customization Manual, chapter 11).
class Writer {
 public:
  explicit Writer(bool spatial) : spatial_(spatial) {}
  void text(int code, std::string_view value) {
    fmt::format_to(std::back_inserter(out_), "{:>3}\n{}\n", code, value);
  }
  void integer(int code, int value) {
    fmt::format_to(std::back_inserter(out_), "{:>3}\n{:>6}\n", code, value);
  }
  void real(int code, double value) {
    fmt::format_to(std::back_inserter(out_), "{:>3}\n{:.9g}\n", code, value);
  }
  /// A place in metres as group codes first, first + 10, first + 20, in millimetres.
  void at(int first, const Place& p) {
    real(first, p.x * millimetres);
    real(first + 10, p.y * millimetres);
    real(first + 20, p.z * millimetres);
  }
  void entity(std::string_view type, std::string_view layer) {
    text(0, type);
    text(8, layer);
  }
  void line(std::string_view layer, const Place& a, const Place& b) {
    entity("LINE", layer);
    at(10, a);
    at(11, b);
  }
  void circle(std::string_view layer, const Place& centre, double radius) {
    entity("CIRCLE", layer);
    at(10, centre);
    real(40, radius * millimetres);
  }
  void polyline(std::string_view layer, const std::vector<Place>& places, bool closed) {
    entity("POLYLINE", layer);
    integer(66, 1);
    at(10, {0, 0});
    // 8 and 32: a polyline in space and its vertices.
    integer(70, (closed ? 1 : 0) + (spatial_ ? 8 : 0));
    for (const Place& p : places) {
      entity("VERTEX", layer);
      at(10, p);
      if (spatial_) integer(70, 32);
    }
    entity("SEQEND", layer);
  }
  std::string take() { return std::move(out_); }

 private:
  std::string out_;
  bool spatial_;
};

// R12 text is one line of ASCII; anything else would be read in an unknown code page.
std::string plain(std::string_view name) {
  std::string out;
  for (const char c : name) out += c >= 0x20 && c < 0x7F ? c : '?';
  return out;
}

bool has_axes(const Scene& scene) {
  return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                     [](const Scene::Body& b) { return b.style == Scene::BodyStyle::axis; });
}

void write_header(Writer& w, const Scene& scene, const Box& box) {
  w.text(999, "linkwright: units are millimetres, scale 1:1");
  w.text(0, "SECTION");
  w.text(2, "HEADER");
  w.text(9, "$ACADVER");
  w.text(1, "AC1009");
  if (!box.empty()) {
    double z_min = 0, z_max = 0;
    if (scene.spatial()) {
      const Box side = bounds(seen_from(scene, viewpoints[0]));
      z_min = side.y_min;
      z_max = side.y_max;
    }
    w.text(9, "$EXTMIN");
    w.at(10, {box.x_min, box.y_min, z_min});
    w.text(9, "$EXTMAX");
    w.at(10, {box.x_max, box.y_max, z_max});
  }
  w.text(0, "ENDSEC");
  struct Layer {
    std::string_view name;
    int colour;
    std::string_view line_type;
  };
  std::vector<Layer> layers = {{"GROUND", 8, "DASHDOT"},
                               {"LINKS", 5, "CONTINUOUS"},
                               {"JOINTS", 7, "CONTINUOUS"},
                               {"TRACE", 3, "CONTINUOUS"},
                               {"TARGETS", 1, "CONTINUOUS"}};
  if (has_axes(scene)) layers.push_back({"AXES", 1, "DASHDOT"});
  if (!scene.discs.empty()) layers.push_back({"WHEELS", 8, "CONTINUOUS"});
  w.text(0, "SECTION");
  w.text(2, "TABLES");
  w.text(0, "TABLE");
  w.text(2, "LTYPE");
  w.integer(70, 2);
  w.text(0, "LTYPE");
  w.text(2, "CONTINUOUS");
  w.integer(70, 0);
  w.text(3, "Solid line");
  w.integer(72, 65);
  w.integer(73, 0);
  w.real(40, 0);
  w.text(0, "LTYPE");
  w.text(2, "DASHDOT");
  w.integer(70, 0);
  w.text(3, "Dash dot __ . __ .");
  w.integer(72, 65);
  w.integer(73, 4);
  w.real(40, 10);
  for (const double dash : {6.0, -2.0, 0.0, -2.0}) w.real(49, dash);
  w.text(0, "ENDTAB");
  w.text(0, "TABLE");
  w.text(2, "LAYER");
  w.integer(70, static_cast<int>(layers.size()));
  for (const Layer& layer : layers) {
    w.text(0, "LAYER");
    w.text(2, layer.name);
    w.integer(70, 0);
    w.integer(62, layer.colour);
    w.text(6, layer.line_type);
  }
  w.text(0, "ENDTAB");
  w.text(0, "ENDSEC");
}

void write_body(Writer& w, const Scene& scene, const Scene::Body& body, std::size_t sample,
                const DxfLayers& layers, double symbol) {
  if (body.style == Scene::BodyStyle::gap || body.run > 0) return;
  const bool ground = body.style == Scene::BodyStyle::ground || body.style == Scene::BodyStyle::guide;
  if (!(ground ? layers.ground : layers.links)) return;
  const std::string_view layer = ground ? "GROUND" : "LINKS";
  std::vector<Place> places;
  for (const int point : body.points) places.push_back(place(scene, point, sample));
  if (!std::all_of(places.begin(), places.end(), [](const Place& p) { return p.finite(); })) return;
  if (body.style == Scene::BodyStyle::axis) {
    places = beyond(places);
    for (std::size_t i = 1; i < places.size(); ++i) w.line("AXES", places[i - 1], places[i]);
    return;
  }
  if (body.style == Scene::BodyStyle::plate && places.size() > 2) {
    w.polyline(layer, places, true);
    return;
  }
  const bool spatial = scene.spatial();
  for (std::size_t i = 1; i < places.size(); ++i) {
    if (spatial && body.style == Scene::BodyStyle::spring)
      w.polyline(layer, helix(places[i - 1], places[i], 6 * symbol), false);
    else if (is_symbol(body.style) && !spatial)
      for (const auto& line : symbol_lines(body.style, places[i - 1], places[i], 3 * symbol))
        w.polyline(layer, line, false);
    else
      w.line(layer, places[i - 1], places[i]);
  }
}

// The parts of a trace that exist, each as one polyline.
void write_trace(Writer& w, const Scene& scene, const Scene::Trace& trace) {
  std::vector<Place> run;
  bool whole = true;
  const auto flush = [&](bool closed) {
    if (run.size() > 1) w.polyline("TRACE", run, closed);
    run.clear();
  };
  for (std::size_t i = 0; i < scene.samples(); ++i) {
    const Place p = place(scene, trace.point, i);
    if (p.finite() && assembled(scene, i)) {
      run.push_back(p);
    } else {
      whole = false;
      flush(false);
    }
  }
  flush(trace.closed && whole);
}

}  // namespace

std::string dxf(const study::Scene& scene, const DxfOptions& options) {
  LINKWRIGHT_REQUIRE(!options.sample || *options.sample < scene.samples(),
                     "sample {} of a scene with {} samples", *options.sample, scene.samples());
  const std::size_t sample = options.sample.value_or(reference_sample(scene));
  if (!scene.second.empty()) {
    DxfOptions within = options;
    if (scene.samples() > 0) within.sample = sample % scene.input.size();
    return dxf(row_of(scene, scene.input.empty() ? 0 : sample / scene.input.size()), within);
  }
  const bool spatial = scene.spatial();
  const Box box = bounds(scene);
  // Symbols are drawn at a size that can be seen in the whole drawing.
  const double symbol = box.empty() ? 1e-3 : std::max(extent(scene), 1e-6) / 100;
  Writer w(spatial);
  write_header(w, scene, box);
  w.text(0, "SECTION");
  w.text(2, "ENTITIES");
  for (const auto& body : scene.bodies) write_body(w, scene, body, sample, options.layers, symbol);
  if (options.layers.links && spatial)
    for (const auto& disc : scene.discs) {
      for (const double side : {-0.5, 0.0, 0.5})
        if (const auto rim = wheel_circle(scene, disc, sample, 1, side * disc.width, 72); !rim.empty())
          w.polyline("WHEELS", rim, true);
    }
  if (options.layers.links && !spatial)
    for (const auto& circle : scene.circles) {
      const double r = radius(scene, circle, sample);
      if (r > 0) w.circle("LINKS", place(scene, circle.centre, sample), r);
    }
  for (const auto& joint : scene.joints) {
    const Place p = place(scene, joint.point, sample);
    const bool ground = joint.style == Scene::JointStyle::ground_pivot;
    if (!p.finite()) continue;
    if (options.layers.joints) {
      if (spatial) {
        w.entity("POINT", "JOINTS");
        w.at(10, p);
      } else {
        w.circle("JOINTS", p, symbol);
      }
      w.entity("TEXT", "JOINTS");
      w.at(10, {p.x + 1.5 * symbol, p.y + 1.5 * symbol, p.z});
      w.real(40, 2 * symbol * millimetres);
      w.text(1, plain(joint.name));
    }
    if (ground && options.layers.ground && !spatial)
      w.polyline("GROUND", {p, {p.x - 2 * symbol, p.y - 3 * symbol}, {p.x + 2 * symbol, p.y - 3 * symbol}},
                 true);
  }
  if (options.layers.trace)
    for (const auto& trace : scene.traces)
      if (trace.run == 0) write_trace(w, scene, trace);
  if (options.layers.targets && !spatial) {
    for (const auto& target : scene.targets) {
      for (std::size_t i = 0; i < std::min(target.x.size(), target.y.size()); ++i) {
        const Place p{target.x[i], target.y[i]};
        if (!p.finite()) continue;
        w.entity("POINT", "TARGETS");
        w.at(10, p);
        w.circle("TARGETS", p, symbol / 2);
      }
    }
  }
  w.text(0, "ENDSEC");
  w.text(0, "EOF");
  return w.take();
}

}  // namespace linkwright::report
