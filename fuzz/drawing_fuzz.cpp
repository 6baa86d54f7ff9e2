// SPDX-License-Identifier: BSD-3-Clause

// Reading any bytes as a drawing ends with a line of finite points or with one diagnostic, and what is drawn
// is read as a linkage with a study.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "linkwright/planar/drawing/drawing.h"
#include "linkwright/planar/sketch/sketch.h"
#include "require.h"

namespace {

void read_as_linkage(std::string_view text) {
  using namespace linkwright;
  using namespace linkwright::planar;
  Diagnostics diagnostics;
  const auto drawing = read_shapes(text, "input", diagnostics);
  FUZZ_REQUIRE(drawing.has_value() != has_errors(diagnostics));
  if (!drawing) return;
  Sketch sketch = sketched_linkage(drawing->shapes, 1e-5);
  if (sketch.bodies.empty()) return;
  const std::size_t driven = complete(sketch);
  for (const SketchJoint& joint : sketch.joints)
    FUZZ_REQUIRE(joint.first < sketch.bodies.size() && joint.second < sketch.bodies.size() &&
                 joint.first != joint.second && joint.point < sketch.points.size());
  FUZZ_REQUIRE(!sketch_study(sketch, driven, "input").empty());
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
