// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/example_scene.h"

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <optional>
#include <utility>

#include "linkwright/app/catalogue.h"
#include "linkwright/app/result_json.h"
#include "linkwright/app/view.h"
#include "linkwright/core/check.h"
#include "linkwright/core/looks.h"
#include "linkwright/core/run_context.h"
#include "linkwright/report/view_data.h"
#include "linkwright/study/study.h"

namespace linkwright::app {
namespace {

constexpr std::int64_t min_steps = 500;  // half a second or so of the slowest searches

Value first_scene(const Example& example, const std::string& folder) {
  Diagnostics diagnostics;
  const Value document = study::read_text(example.text, study::Syntax::toml, example.name, diagnostics);
  const std::optional<study::Study> study =
      study::prepare(document, example.name, folder, catalogue(), diagnostics);
  if (!study) return {};
  // A study that has nothing to show by then runs for longer.
  for (std::int64_t steps = min_steps;; steps *= 10) {
    const LooksAllowed allowed(steps);
    RunContext context;
    context.set_threads(1);
    const study::Result shown = presented(*study, study::run_study(*study, context));
    if (!shown.scenes.empty()) {
      const Value view = report::view_data(report_input(*study, shown, {}, {}));
      return view.find("scenes")->as_array().front();
    }
    if (allowed.made() <= steps) return {};
  }
}

}  // namespace

Value example_scene(const Example& example, const std::string& folder) {
  for (const EmbeddedFile& file : example.beside) {
    std::ofstream stream(std::filesystem::path(folder) / file.path, std::ios::binary);
    stream << file.text;
    LINKWRIGHT_REQUIRE(stream.flush().good(), "cannot write {} to '{}'", file.path, folder);
  }
  Value out = Value::object();
  out["name"] = example.name;
  out["title"] = example.title;
  out["text"] = example.text;
  out["scene"] = first_scene(example, folder);
  return out;
}

}  // namespace linkwright::app
