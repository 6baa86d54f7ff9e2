// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/planar/studies/any_search_tables.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/planar/type_synthesis/title.h"
#include "linkwright/study/remarks.h"
#include "linkwright/study/run_seeds.h"

namespace linkwright::planar {
namespace {

void add_families(const TypeSearchAnswer& answer, const SearchError& by, study::Result& result) {
  Table table{.name = "families"};
  std::vector<double> error, outside, polished, hops, grown, curves, atlas;
  for (const FamilyReport& f : answer.families) {
    table.names.emplace_back(name_of(f.family));
    error.push_back(std::isfinite(f.error) ? f.error * by.scale : nan);
    const auto left = std::find_if(answer.outside.begin(), answer.outside.end(), [&](const FoundMachine& m) {
      return m.machine.shape.program->family == f.family;
    });
    outside.push_back(left == answer.outside.end() ? nan : left->measures.error * by.scale);
    polished.push_back(static_cast<double>(f.polished)), hops.push_back(static_cast<double>(f.hops));
    grown.push_back(static_cast<double>(f.grown)), curves.push_back(static_cast<double>(f.curves));
    atlas.push_back(static_cast<double>(f.atlas_entries));
  }
  table.add(std::string(by.key),
            fmt::format("root mean square error of the best machine within the limits ({})", by.unit),
            std::move(error));
  table.add(fmt::format("outside_limits_error_rms_{}", by.unit),
            fmt::format("that of the best machine outside the limits, where none is within ({})", by.unit),
            std::move(outside));
  table.add("polished", "shapes of the atlas that were polished", std::move(polished));
  table.add("hops", "trials from machines found before", std::move(hops));
  table.add("grown", "trials from machines of fewer links", std::move(grown));
  table.add("curves", "curves that were computed", std::move(curves));
  table.add("atlas_entries", "shapes of the atlas", std::move(atlas));
  result.tables.push_back(std::move(table));
}

void add_progress(const TypeSearchAnswer& answer, const SearchError& by, study::Result& result) {
  if (answer.progress.empty()) return;
  Table table{.name = "progress"};
  std::vector<double> curves, best;
  for (const TypeSearchPoint& p : answer.progress) {
    table.names.emplace_back(name_of(p.family));
    curves.push_back(static_cast<double>(p.curves));
    best.push_back(p.error * by.scale);
  }
  table.add("curves", "curves that were computed", std::move(curves));
  table.add(std::string(by.key),
            fmt::format("root mean square error of a new best machine of its family ({})", by.unit),
            std::move(best));
  result.tables.push_back(std::move(table));
  result.plots.push_back({.name = "progress",
                          .title = "New best machines during the search",
                          .table = "progress",
                          .x = "curves",
                          .y = {std::string(by.key)},
                          .style = study::Plot::Style::points,
                          .logarithmic_y = true});
}

}  // namespace

void add_search_tables(const TypeSearchAnswer& answer, const SearchError& error, study::Result& result) {
  add_families(answer, error, result);
  add_progress(answer, error, result);
  const auto sum = [&](std::int64_t FamilyReport::*part) {
    std::int64_t out = 0;
    for (const FamilyReport& f : answer.families) out += f.*part;
    return out;
  };
  result.statistics["machines"] = answer.machines.size();
  result.statistics["families"] = answer.families.size();
  result.statistics["polished"] = sum(&FamilyReport::polished);
  result.statistics["hops"] = sum(&FamilyReport::hops);
  result.statistics["grown"] = sum(&FamilyReport::grown);
  result.statistics["evaluations"] = answer.curves;
  result.statistics["atlas_entries"] = sum(&FamilyReport::atlas_entries);
}

const FoundMachine* nearest_outside(const TypeSearchAnswer& answer) {
  const auto nearest = std::min_element(
      answer.outside.begin(), answer.outside.end(),
      [](const FoundMachine& a, const FoundMachine& b) { return a.measures.error < b.measures.error; });
  return nearest == answer.outside.end() ? nullptr : &*nearest;
}

void report_none_found(const TypeSearchAnswer& answer, const Measured& error_of_nearest,
                       study::Result& result) {
  result.headline = study::is_interrupted(answer.status) ? "Stopped before a machine was found."
                                                         : "No machine within the limits was found.";
  const FoundMachine* nearest = nearest_outside(answer);
  if (!nearest) return;
  std::string why;
  for (const auto& word : names(MachineDefect{}))
    if (word.value == nearest->measures.defect) why = word.summary;
  study::AddWarning{result.diagnostics}(
      "limits",
      say("the nearest machine, {}, has a root mean square error of {}, but {}",
          short_name_of(*nearest->machine.shape.program), error_of_nearest, why),
      "search longer, allow more links, or relax the limits");
}

void add_link_lengths(const Linkage& linkage, study::Solution& solution) {
  for (std::size_t i = 1; i < linkage.bodies.size(); ++i) {
    const LinkageBody& body = linkage.bodies[i];
    for (std::size_t k = 1; k < body.points.size(); ++k)
      solution.parameters.push_back(
          {fmt::format("{}_{}{}_m", body.name, body.points[0].name, body.points[k].name),
           fmt::format("{}, from {} to {}", body.name, body.points[0].name, body.points[k].name),
           std::abs(body.points[k].at - body.points[0].at), -infinity, infinity});
  }
}

}  // namespace linkwright::planar
