#include <cstdio>
#include <optional>

#include "linkwright/studies.h"

constexpr const char* text = R"(schema = 1
kind   = "analysis"
title  = "Straight line of a Hoeken linkage"

[mechanism]
type   = "planar.linkage"
sample = "hoeken"
)";

int main() {
  using namespace linkwright;
  Diagnostics problems;
  const Value document = study::read_text(text, study::syntax_of({}, text), "study", problems);
  std::optional<study::Study> study;
  if (!has_errors(problems)) study = study::prepare(document, "study", {}, app::catalogue(), problems);
  for (const Diagnostic& problem : problems) std::printf("%s\n", to_string(problem).c_str());
  if (!study) return 2;
  RunContext context;
  const study::Result result = study::run_study(*study, context);
  std::printf("%s\n", to_string(result.headline).c_str());
  for (const Table& table : result.tables)
    std::printf("%s: %zu columns\n", table.name.c_str(), table.columns.size());
}
