// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/step.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "linkwright/report/flat_parts.h"

namespace linkwright::report {
namespace {

constexpr double step_scale = 1000;

// Entities of ISO 10303-42 (geometry and topology), numbered as they are written.
class StepWriter {
 public:
  int add(std::string_view entity) {
    fmt::format_to(std::back_inserter(out_), "#{}={};\n", ++last_, entity);
    return last_;
  }
  int point(const Place& p) {
    return add(fmt::format("CARTESIAN_POINT('',({},{},{}))", real(p.x), real(p.y), real(p.z)));
  }
  int direction(double x, double y, double z) {
    return add(fmt::format("DIRECTION('',({},{},{}))", real(x), real(y), real(z)));
  }
  /// Axes at a point with their z upwards, or downwards.
  int axes(const Place& at, double up = 1) { return axes(at, direction(0, 0, up), direction(1, 0, 0)); }
  int axes(const Place& at, int z, int x) {
    return add(fmt::format("AXIS2_PLACEMENT_3D('',#{},#{},#{})", point(at), z, x));
  }
  int vertex(const Place& p) { return add(fmt::format("VERTEX_POINT('',#{})", point(p))); }
  /// A straight edge from one vertex to another.
  int line(const Place& a, int from, const Place& b, int to) {
    const double x = b.x - a.x, y = b.y - a.y, z = b.z - a.z, length = std::sqrt(x * x + y * y + z * z);
    const int vector = add(fmt::format("VECTOR('',#{},1.)", direction(x / length, y / length, z / length)));
    const int curve = add(fmt::format("LINE('',#{},#{})", point(a), vector));
    return add(fmt::format("EDGE_CURVE('',#{},#{},#{},.T.)", from, to, curve));
  }
  /// An edge along a circle, counter-clockwise seen from above.
  int arc(const Place& centre, double radius, int from, int to) {
    const int curve = add(fmt::format("CIRCLE('',#{},{})", axes(centre), real(radius)));
    return add(fmt::format("EDGE_CURVE('',#{},#{},#{},.T.)", from, to, curve));
  }
  int oriented(int edge, bool forward) {
    return add(fmt::format("ORIENTED_EDGE('',*,*,#{},.{}.)", edge, forward ? 'T' : 'F'));
  }
  int loop(const std::vector<int>& oriented_edges) {
    return add(fmt::format("EDGE_LOOP('',({}))", list(oriented_edges)));
  }
  int bound(int loop, bool outer) {
    return add(fmt::format("FACE_{}BOUND('',#{},.T.)", outer ? "OUTER_" : "", loop));
  }
  int face(const std::vector<int>& bounds, int surface, bool same_sense) {
    return add(fmt::format("ADVANCED_FACE('',({}),#{},.{}.)", list(bounds), surface, same_sense ? 'T' : 'F'));
  }
  int plane(int axes) { return add(fmt::format("PLANE('',#{})", axes)); }
  int cylinder(const Place& centre, double radius) {
    return add(fmt::format("CYLINDRICAL_SURFACE('',#{},{})", axes(centre), real(radius)));
  }
  int solid(const std::vector<int>& faces, std::string_view name) {
    const int shell = add(fmt::format("CLOSED_SHELL('',({}))", list(faces)));
    return add(fmt::format("MANIFOLD_SOLID_BREP('{}',#{})", text(name), shell));
  }
  static std::string list(const std::vector<int>& ids) {
    std::string out;
    for (const int id : ids) out += fmt::format("{}#{}", out.empty() ? "" : ",", id);
    return out;
  }
  /// A text of the file: ASCII, with two apostrophes for one; other characters become question marks.
  static std::string text(std::string_view name) {
    std::string out;
    for (const char c : name)
      out += c == '\'' ? "''" : std::string(1, c >= 0x20 && c < 0x7F && c != '\\' ? c : '?');
    return out;
  }
  /// A number of the file, which has a decimal point.
  static std::string real(double value) {
    std::string out = fmt::format("{:.10G}", value + 0.0);
    if (out.find_first_of(".E") == std::string::npos) out += '.';
    if (const std::size_t e = out.find('E'); e != std::string::npos && out.find('.') == std::string::npos)
      out.insert(e, ".");
    return out;
  }
  const std::string& written() const { return out_; }

 private:
  std::string out_;
  int last_ = 0;
};

/// A closed outline of lines and arcs, or a whole circle, with its edges at the bottom and the top.
struct Ring {
  std::vector<int> bottom, top;  ///< edges, counter-clockwise seen from above
  std::vector<int> faces;        ///< of the wall between them
};

Place lifted(Place p, double z) { return {p.x, p.y, z}; }

/// A circle as a ring; its wall is seen from outside, or from inside for a hole.
Ring circle_ring(StepWriter& w, const Place& centre, double radius, double low, double high, bool hole) {
  const Place a{centre.x + radius, centre.y, low}, b = lifted(a, high);
  const int bottom_vertex = w.vertex(a), top_vertex = w.vertex(b);
  const int bottom = w.arc(lifted(centre, low), radius, bottom_vertex, bottom_vertex),
            top = w.arc(lifted(centre, high), radius, top_vertex, top_vertex),
            seam = w.line(a, bottom_vertex, b, top_vertex);
  const int loop = w.loop(
      {w.oriented(bottom, !hole), w.oriented(seam, true), w.oriented(top, hole), w.oriented(seam, false)});
  const int wall = w.face({w.bound(loop, true)}, w.cylinder(lifted(centre, low), radius), !hole);
  return {{bottom}, {top}, {wall}};
}

/// The outline of a part: lines between arcs about its corners.
Ring outline_ring(StepWriter& w, const FlatPart& part, double radius, double low, double high) {
  const std::size_t n = part.corners.size();
  std::vector<Place> nodes;  // ends of the lines: two for each side
  std::vector<Place> normals;
  const auto corner = [&](std::size_t i) {
    const Place& p = part.corners[i % n];
    return Place{p.x * step_scale, p.y * step_scale};
  };
  for (std::size_t i = 0; i < n; ++i) {
    const Place a = corner(i), b = corner(i + 1);
    const double length = std::hypot(b.x - a.x, b.y - a.y);
    const Place normal{(b.y - a.y) / length, (a.x - b.x) / length};
    normals.push_back(normal);
    nodes.push_back({a.x + radius * normal.x, a.y + radius * normal.y, low});
    nodes.push_back({b.x + radius * normal.x, b.y + radius * normal.y, low});
  }
  std::vector<int> lower, upper, upright;
  for (const Place& p : nodes) {
    lower.push_back(w.vertex(p));
    upper.push_back(w.vertex(lifted(p, high)));
    upright.push_back(w.line(p, lower.back(), lifted(p, high), upper.back()));
  }
  Ring out;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::size_t next = (i + 1) % nodes.size();
    const bool straight = i % 2 == 0;
    const Place centre = corner(i / 2 + 1);
    out.bottom.push_back(straight ? w.line(nodes[i], lower[i], nodes[next], lower[next])
                                  : w.arc(lifted(centre, low), radius, lower[i], lower[next]));
    out.top.push_back(straight
                          ? w.line(lifted(nodes[i], high), upper[i], lifted(nodes[next], high), upper[next])
                          : w.arc(lifted(centre, high), radius, upper[i], upper[next]));
    const int loop = w.loop({w.oriented(out.bottom[i], true), w.oriented(upright[next], true),
                             w.oriented(out.top[i], false), w.oriented(upright[i], false)});
    int surface = 0;
    if (straight) {
      const Place& normal = normals[i / 2];
      surface = w.plane(w.axes(nodes[i], w.direction(normal.x, normal.y, 0), w.direction(0, 0, 1)));
    } else {
      surface = w.cylinder(lifted(centre, low), radius);
    }
    out.faces.push_back(w.face({w.bound(loop, true)}, surface, true));
  }
  return out;
}

/// A solid between two heights from its outline and holes.
int prism(StepWriter& w, const Ring& outline, const std::vector<Ring>& holes, double low, double high,
          std::string_view name) {
  std::vector<int> faces = outline.faces;
  const auto lid = [&](std::vector<int> Ring::*edges, double height, bool up) {
    std::vector<int> bounds;
    const auto add = [&](const Ring& ring, bool outer) {
      std::vector<int> oriented;
      const std::vector<int>& all = ring.*edges;
      const bool forward = up == outer;
      for (std::size_t i = 0; i < all.size(); ++i)
        oriented.push_back(w.oriented(forward ? all[i] : all[all.size() - 1 - i], forward));
      bounds.push_back(w.bound(w.loop(oriented), outer));
    };
    add(outline, true);
    for (const Ring& hole : holes) add(hole, false);
    faces.push_back(w.face(bounds, w.plane(w.axes({0, 0, height}, up ? 1 : -1)), true));
  };
  lid(&Ring::bottom, low, false);
  lid(&Ring::top, high, true);
  for (const Ring& hole : holes) faces.insert(faces.end(), hole.faces.begin(), hole.faces.end());
  return w.solid(faces, name);
}

std::vector<int> solids_of(StepWriter& w, const FlatMechanism& mechanism) {
  const double thickness = mechanism.thickness * step_scale, pin_radius = mechanism.pin_radius * step_scale;
  std::vector<int> out;
  for (const FlatPart& part : mechanism.parts) {
    const double low = part.layer * thickness, high = low + thickness, radius = part.radius * step_scale;
    const auto scaled = [](const Place& p) { return Place{p.x * step_scale, p.y * step_scale}; };
    const Ring outline = part.corners.size() == 1
                             ? circle_ring(w, scaled(part.corners[0]), radius, low, high, false)
                             : outline_ring(w, part, radius, low, high);
    std::vector<Ring> holes;
    for (const Place& hole : part.holes)
      holes.push_back(circle_ring(w, scaled(hole), pin_radius, low, high, true));
    out.push_back(prism(w, outline, holes, low, high, part.name));
  }
  for (const FlatPin& pin : mechanism.pins) {
    const double low = pin.first * thickness, high = (pin.last + 1) * thickness;
    const Place centre{pin.at.x * step_scale, pin.at.y * step_scale};
    const Ring outline = circle_ring(w, centre, pin_radius, low, high, false);
    out.push_back(prism(w, outline, {}, low, high, "pin " + pin.name));
  }
  return out;
}

/// The product and its units, as ISO 10303-41 wants them around a shape.
void write_product(StepWriter& w, const std::vector<int>& solids, std::string_view name) {
  const int context = w.add("APPLICATION_CONTEXT('automotive design')");
  w.add(fmt::format("APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,#{})",
                    context));
  const int product_context = w.add(fmt::format("PRODUCT_CONTEXT('',#{},'mechanical')", context));
  const int product =
      w.add(fmt::format("PRODUCT('{0}','{0}','',(#{1}))", StepWriter::text(name), product_context));
  const int formation = w.add(fmt::format("PRODUCT_DEFINITION_FORMATION('','',#{})", product));
  const int definition_context =
      w.add(fmt::format("PRODUCT_DEFINITION_CONTEXT('part definition',#{},'design')", context));
  const int definition =
      w.add(fmt::format("PRODUCT_DEFINITION('design','',#{},#{})", formation, definition_context));
  const int shape = w.add(fmt::format("PRODUCT_DEFINITION_SHAPE('','',#{})", definition));
  const int length = w.add("(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
  const int angle = w.add("(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
  const int solid_angle = w.add("(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
  const int accuracy = w.add(fmt::format(
      "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-6),#{},'distance_accuracy_value','')", length));
  const int units =
      w.add(fmt::format("(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#{}))"
                        "GLOBAL_UNIT_ASSIGNED_CONTEXT((#{},#{},#{}))REPRESENTATION_CONTEXT('',''))",
                        accuracy, length, angle, solid_angle));
  std::vector<int> items = {w.axes({0, 0, 0})};
  items.insert(items.end(), solids.begin(), solids.end());
  const int representation =
      w.add(fmt::format("ADVANCED_BREP_SHAPE_REPRESENTATION('',({}),#{})", StepWriter::list(items), units));
  w.add(fmt::format("SHAPE_DEFINITION_REPRESENTATION(#{},#{})", shape, representation));
}

}  // namespace

std::string step(const study::Scene& scene, const study::PartSizes& sizes) {
  std::size_t sample = 0;
  while (sample < scene.samples() && !assembled(scene, sample)) ++sample;
  if (sample == scene.samples()) return {};
  const FlatMechanism mechanism = flat_parts(scene, sample, sizes);
  if (mechanism.parts.empty()) return {};
  StepWriter w;
  write_product(w, solids_of(w, mechanism), scene.name);
  std::string notes;
  for (const std::string& pin : mechanism.crossed)
    notes += fmt::format(",'pin {}, which it does not join'", StepWriter::text(pin));
  return fmt::format(
      "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('flat links of a planar mechanism'{}),'2;1');\n"
      "FILE_NAME('{}.step','',(''),(''),'linkwright','linkwright','');\n"
      "FILE_SCHEMA(('AUTOMOTIVE_DESIGN {{ 1 0 10303 214 1 1 1 1 }}'));\nENDSEC;\nDATA;\n{}ENDSEC;\n"
      "END-ISO-10303-21;\n",
      notes, StepWriter::text(scene.name), w.written());
}

}  // namespace linkwright::report
