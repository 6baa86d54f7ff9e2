// SPDX-License-Identifier: BSD-3-Clause

// Reading any bytes as a tool's points in time ends with a table or with diagnostics, and a table that was
// read is a step that can be laid out from its first point.
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "linkwright/parallel/tool/layout.h"
#include "linkwright/parallel/tool/table.h"
#include "require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace linkwright;
  using namespace linkwright::parallel;
  Diagnostics diagnostics;
  const auto table = read_tool_table({reinterpret_cast<const char*>(data), size}, "input", diagnostics);
  FUZZ_REQUIRE(table.has_value() != has_errors(diagnostics));
  if (!table) return 0;
  const auto& [x, y, z] = table->points.front();
  Pose start{{x, y, z}, {}};
  if (!table->rotations.empty()) {
    const auto& [a, b, c] = table->rotations.front();
    start.rotation = math::turn_about({a, b, c});
  }
  const ToolPath path{.steps = {{*table}}};
  const ToolLayout layout = lay_out(path, start);
  FUZZ_REQUIRE(!layout.problem && layout.runs.size() == 1);
  return 0;
}
