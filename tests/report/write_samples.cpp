// SPDX-License-Identifier: BSD-3-Clause

// Writes what the report tests outside C++ look at: write_samples DIR makes DIR/report.html,
// DIR/simulation.html, DIR/units.html with DIR/units.csv, DIR/spatial.html, DIR/maps.html, DIR/diagrams.html,
// DIR/nowhere.html,
// DIR/hostile.html, DIR/empty.html, DIR/scene.dxf, DIR/scene.svg, and DIR/report.json with the tables of the
// first report as CSV.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/core/units.h"
#include "linkwright/report/dxf.h"
#include "linkwright/report/html.h"
#include "linkwright/report/svg.h"
#include "tests/report/sample_result.h"
#include "tests/report/sample_spatial.h"

namespace {

void write(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace

int main(int count, char** arguments) {
  using namespace linkwright;
  using namespace linkwright::report;
  if (count != 2) return 2;
  const std::filesystem::path folder = arguments[1];
  std::filesystem::create_directories(folder);

  study::Result result = report::test::sample_result();
  ReportInput input{.result = result,
                    .study_toml = report::test::sample_study(),
                    .title = "Four-bar through 18 points of a closed path",
                    .source = "Boskovic 2018, Eq. (4.27)-(4.30)",
                    .tool = "linkwright 0.1.0",
                    .command = "linkwright run fourbar-18-points.toml --out out/fourbar-18",
                    .result_json = report::test::sample_json(result)};
  write(folder / "report.html", html(input));
  write(folder / "report.json", input.result_json);
  for (const Table& table : result.tables) write(folder / (table.name + ".csv"), to_csv(table));
  write(folder / "scene.svg", svg(result.scenes.front()));
  write(folder / "scene.dxf", dxf(result.scenes.front()));

  const study::Result simulation = report::test::sample_simulation();
  write(folder / "simulation.html", html({.result = simulation,
                                          .study_toml = {},
                                          .title = "Slider-crank for two seconds",
                                          .source = {},
                                          .tool = "linkwright 0.1.0",
                                          .command = {},
                                          .result_json = report::test::sample_json(simulation)}));

  study::DisplayUnits units;
  for (const char* key : {"length_mm", "angle_deg", "speed_rpm"}) units.choose(*split_unit(key));
  units.follow();
  write(folder / "units.html", html({.result = result,
                                     .units = units,
                                     .study_toml = {},
                                     .title = "Four-bar in mm, deg and rpm",
                                     .source = {},
                                     .tool = "linkwright 0.1.0",
                                     .command = {},
                                     .result_json = report::test::sample_json(result)}));
  write(folder / "units.csv", to_csv(study::in_units(result.tables.front(), units)));

  const study::Result maps = report::test::sample_maps();
  write(folder / "maps.html", html({.result = maps,
                                    .study_toml = {},
                                    .title = "Workspace of a robot",
                                    .source = {},
                                    .tool = "linkwright 0.1.0",
                                    .command = {},
                                    .result_json = report::test::sample_json(maps)}));

  const study::Result diagrams = report::test::sample_diagrams();
  write(folder / "diagrams.html", html({.result = diagrams,
                                        .study_toml = {},
                                        .title = "Diagrams over a turn",
                                        .source = {},
                                        .tool = "linkwright 0.1.0",
                                        .command = {},
                                        .result_json = report::test::sample_json(diagrams)}));

  const study::Result compared = report::test::sample_compared();
  write(folder / "compared.html", html({.result = compared,
                                        .study_toml = {},
                                        .title = "short | middle | long",
                                        .source = {},
                                        .tool = "linkwright 0.1.0",
                                        .command = {},
                                        .result_json = report::test::sample_json(compared)}));

  study::Result nowhere = report::test::sample_diagrams();
  nowhere.status = Status::no_assembly;
  nowhere.diagnostics.push_back({.severity = Diagnostic::Severity::warning,
                                 .file = {},
                                 .position = {},
                                 .key = {},
                                 .message = "361 of 361 positions do not assemble",
                                 .hint = "the rocker is too short"});
  for (auto& point : nowhere.scenes[0].points)
    point.x = point.y = std::vector<double>(nowhere.scenes[0].input.size(), linkwright::nan);
  for (Table& table : nowhere.tables)
    for (std::size_t i = 1; i < table.columns.size(); ++i)
      std::fill(table.columns[i].values.begin(), table.columns[i].values.end(), linkwright::nan);
  write(folder / "nowhere.html", html({.result = nowhere,
                                       .study_toml = {},
                                       .title = "Rocker too short",
                                       .source = {},
                                       .tool = "linkwright 0.1.0",
                                       .command = {},
                                       .result_json = report::test::sample_json(nowhere)}));

  const study::Result spatial = report::test::sample_spatial();
  write(folder / "spatial.html", html({.result = spatial,
                                       .study_toml = {},
                                       .title = "Double wishbone over travel and rack",
                                       .source = {},
                                       .tool = "linkwright 0.1.0",
                                       .command = {},
                                       .result_json = report::test::sample_json(spatial)}));
  write(folder / "spatial.svg", svg(spatial.scenes.front()));
  write(folder / "spatial.dxf", dxf(spatial.scenes.front()));

  study::Result broken = report::test::sample_result();
  broken.headline = broken.facts[0].label = broken.facts[0].text = report::test::hostile;
  broken.solutions[0].label = broken.scenes[0].title = report::test::hostile;
  broken.solutions[0].parameters[0].label = broken.scenes[0].joints[0].name =
      broken.scenes[0].bodies[1].name = report::test::hostile;
  broken.scenes[0].vectors = {{report::test::hostile,
                               study::Scene::Quantity::force,
                               report::test::hostile,
                               0,
                               {1},
                               {1},
                               report::test::hostile}};
  broken.scenes[0].moments = {{report::test::hostile, report::test::hostile, 0, {1}, report::test::hostile}};
  broken.tables[0].columns[0].label = broken.comparisons[0].note = broken.checks[0].quantity =
      report::test::hostile;
  broken.diagnostics[0].message = report::test::hostile;
  broken.log.as_array()[0]["status"] = report::test::hostile;
  write(folder / "hostile.html", html({.result = broken,
                                       .study_toml = report::test::hostile,
                                       .title = report::test::hostile,
                                       .source = report::test::hostile,
                                       .tool = report::test::hostile,
                                       .command = report::test::hostile,
                                       .result_json = report::test::sample_json(broken)}));

  study::Result nothing;
  nothing.status = Status::no_assembly;
  nothing.headline = "The links do not reach each other";
  write(folder / "empty.html", html({.result = nothing,
                                     .study_toml = {},
                                     .title = "Nothing",
                                     .source = {},
                                     .tool = "linkwright 0.1.0",
                                     .command = {},
                                     .result_json = {}}));
  return 0;
}
