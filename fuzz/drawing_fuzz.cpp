// SPDX-License-Identifier: BSD-3-Clause

// Reading any bytes as a drawing ends with a line of finite points or with one diagnostic, and what is drawn
// is read as a linkage with a study; so is a file of the program Linkage.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "linkwright/planar/drawing/drawing.h"
#include "linkwright/planar/sketch/sketch.h"
#include "require.h"

namespace {

void read_as_linkage(std::string_view text) {
  using namespace linkwright;
  using namespace linkwright::planar;
  Diagnostics diagnostics;
  std::optional<Sketch> read;
  if (is_linkage_file(text)) {
    read = read_linkage_file(text, "input", diagnostics);
    FUZZ_REQUIRE(read.has_value() != has_errors(diagnostics));
  } else if (const auto drawing = read_shapes(text, "input", diagnostics)) {
    FUZZ_REQUIRE(!has_errors(diagnostics));
    read = sketched_linkage(drawing->shapes, 1e-5);
  } else {
    FUZZ_REQUIRE(has_errors(diagnostics));
  }
  if (!read || read->bodies.empty()) return;
  Sketch& sketch = *read;
  complete(sketch);
  for (const SketchJoint& joint : sketch.joints)
    FUZZ_REQUIRE(joint.first < sketch.bodies.size() && joint.second < sketch.bodies.size() &&
                 joint.first != joint.second && joint.point < sketch.points.size());
  for (const SketchGear& gear : sketch.gears)
    FUZZ_REQUIRE(gear.bodies[0] < sketch.bodies.size() && gear.bodies[1] < sketch.bodies.size() &&
                 gear.bodies[0] != gear.bodies[1] && gear.points[0] < sketch.points.size() &&
                 gear.points[1] < sketch.points.size());
  for (const SketchDrive& drive : sketch.drives) FUZZ_REQUIRE(drive.joint < sketch.joints.size());
  FUZZ_REQUIRE(!sketch_study(sketch, "input").empty());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace linkwright;
  using namespace linkwright::planar;
  Diagnostics diagnostics;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  read_as_linkage(text);
  const auto line = read_drawing(text, "input", diagnostics);
  FUZZ_REQUIRE(line.has_value() != has_errors(diagnostics));
  FUZZ_REQUIRE(line || diagnostics.size() == 1);
  if (!line) return 0;
  FUZZ_REQUIRE(drawing_format(text) != DrawingFormat::none && line->points.size() > 1);
  for (std::size_t i = 0; i < line->points.size(); ++i) {
    FUZZ_REQUIRE(std::isfinite(line->points[i].real()) && std::isfinite(line->points[i].imag()));
    FUZZ_REQUIRE(i == 0 || line->points[i] != line->points[i - 1]);
  }
  return 0;
}
