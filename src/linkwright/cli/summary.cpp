// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/summary.h"

#include <fmt/core.h>

#include <algorithm>

#include "linkwright/cli/terminal.h"
#include "linkwright/core/status.h"
#include "linkwright/study/answer.h"

namespace linkwright::cli {
namespace {

/// The colour of a status follows from the verdict: what is done with a failed check is no success.
Colour colour_of(study::Verdict verdict) {
  switch (verdict) {
    case study::Verdict::passed:
      return Colour::green;
    case study::Verdict::doubtful:
    case study::Verdict::incomplete:
      return Colour::yellow;
    case study::Verdict::failed:
      break;
  }
  return Colour::red;
}

}  // namespace

std::string summary(std::string_view title, const study::Result& result,
                    const std::vector<std::filesystem::path>& written, bool colours) {
  std::string text;
  const auto line = [&](std::string_view content) { text.append(content).append("\n"); };
  if (!title.empty()) line(paint(title, Colour::bold, colours));
  if (!result.headline.empty()) line("  " + to_string(result.headline));
  std::size_t width = 6;
  for (const study::Fact& fact : result.facts) width = std::max(width, to_string(fact.label).size());
  line(fmt::format("  {:<{}}  {}", "status", width,
                   paint(to_string(result.status), colour_of(study::answer_of(result).verdict), colours)));
  for (const study::Fact& fact : result.facts) {
    const bool bad = fact.verdict == study::Fact::Verdict::bad;
    line(fmt::format(
        "  {:<{}}  {}", to_string(fact.label), width,
        bad ? paint(to_string(fact.text) + "  (!)", Colour::red, colours) : to_string(fact.text)));
  }
  if (!result.checks.empty()) {
    const auto passed = std::count_if(result.checks.begin(), result.checks.end(),
                                      [](const study::Check& c) { return c.passed; });
    line(fmt::format("checks: {} passed, {} failed", passed,
                     static_cast<std::ptrdiff_t>(result.checks.size()) - passed));
    for (const study::Check& check : result.checks) {
      const std::string at = check.at.empty() ? "" : " at " + check.at;
      const std::string value =
          check.message.empty() ? fmt::format(" = {:.9g}", check.value) : ": " + check.message;
      line(fmt::format(
          "  {}  {}{}{}  ({})",
          paint(check.passed ? "passed" : "FAILED", check.passed ? Colour::green : Colour::red, colours),
          check.quantity, at, value, check.limit));
    }
  }
  for (const Diagnostic& d : result.diagnostics) line(painted(d, colours));
  if (written.empty()) return text;
  const std::filesystem::path folder = written.front().parent_path();
  line(fmt::format("results in {}:", folder.string()));
  for (const std::filesystem::path& file : written) line("  " + file.lexically_relative(folder).string());
  for (const std::filesystem::path& file : written)
    if (file.filename() == "report.html") line(paint("open " + file.string(), Colour::bold, colours));
  return text;
}

}  // namespace linkwright::cli
