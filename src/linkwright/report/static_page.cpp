// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/report/static_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <iterator>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/status.h"
#include "linkwright/report/detail/canvas.h"
#include "linkwright/report/drawing.h"
#include "linkwright/report/markup.h"
#include "linkwright/report/plot_svg.h"
#include "linkwright/report/svg.h"
#include "linkwright/report/units.h"
#include "linkwright/study/answer.h"
#include "linkwright/study/extremes.h"
#include "linkwright/study/result_units.h"

namespace linkwright::report {
namespace {

constexpr std::size_t max_table = 40;
constexpr std::size_t max_named_joints = 24;  // more joints than this have no room for their names

// A table of texts; every cell is escaped here and nowhere else.
class Sheet {
 public:
  Sheet(std::string& out, const std::vector<std::string>& head) : out_(out) {
    out_ += "<div class=\"scroll\"><table><thead><tr>";
    for (const auto& cell : head) put(out_, "<th scope=\"col\">{}</th>", escape(cell));
    out_ += "</tr></thead><tbody>\n";
  }
  ~Sheet() { out_ += "</tbody></table></div>\n"; }
  Sheet(const Sheet&) = delete;
  Sheet& operator=(const Sheet&) = delete;
  void row(const std::vector<std::string>& cells) {
    out_ += "<tr>";
    for (const auto& cell : cells) put(out_, "<td>{}</td>", escape(cell));
    out_ += "</tr>\n";
  }

 private:
  std::string& out_;
};

void heading(std::string& out, std::string_view text) { put(out, "<h2>{}</h2>\n", escape(text)); }

void write_banner(std::string& out, const ReportInput& input) {
  const auto& result = input.result;
  const auto failed =
      std::count_if(result.checks.begin(), result.checks.end(), [](const auto& c) { return !c.passed; });
  put(out, "<header class=\"verdict {}\"><div class=\"words\"><h1>{}</h1><p class=\"headline\">{}</p></div>",
      linkwright::name_of(study::answer_of(result).verdict), escape(input.title),
      escape(typeset(study::in_units(result.headline, page_units(input.units)))));
  put(out, "<span>status {}", to_string(result.status));
  if (!result.checks.empty())
    put(out, " · {} of {} checks passed", result.checks.size() - static_cast<std::size_t>(failed),
        result.checks.size());
  out += "</span></header>\n";
}

void write_facts(std::string& out, const study::Result& result, const study::DisplayUnits& units) {
  if (result.facts.empty()) return;
  out += "<dl class=\"facts\">";
  for (const auto& fact : result.facts) {
    const FactText text = fact_text(study::in_units(fact.text, page_units(units)));
    put(out, "<div{}><dt>{}</dt><dd>{}", text.is_long ? " class=\"long\"" : "",
        escape(typeset(study::in_units(fact.label, page_units(units)))), escape(text.value));
    if (!text.rest.empty()) put(out, "<small>{}</small>", escape(text.rest));
    out += "</dd></div>";
  }
  out += "</dl>\n";
}

void write_checks(std::string& out, const study::Result& result) {
  if (result.checks.empty()) return;
  heading(out, "Checks");
  Sheet sheet(out, {"quantity", "at", "value", "limit", "outcome"});
  for (const auto& check : result.checks)
    sheet.row({check.quantity, check.at, check.message.empty() ? number(check.value, 9) : check.message,
               check.limit, check.passed ? "passed" : "failed"});
}

// One of the inputs of a scene.
std::string input_text(std::string_view key, const std::vector<double>& inputs, std::size_t sample,
                       const study::DisplayUnits& units) {
  const study::DisplayUnits::Key shown = units.key(key);
  const double most = shown.convert(study::largest_size(inputs));
  return quantity(shown.convert(inputs[sample]), display_unit(shown.key, most));
}

// The instant for which the arrows of a drawing hold.
std::string shown_at(const study::Scene& scene, const study::DisplayUnits& units) {
  if (scene.samples() == 0) return {};
  const std::size_t sample = reference_sample(scene);
  const std::string text =
      fmt::format("{} {}", scene.input_label,
                  input_text(scene.input_key, scene.input, sample % scene.input.size(), units));
  const std::string second =
      scene.second.empty()
          ? ""
          : fmt::format(", {} {}", scene.second_label,
                        input_text(scene.second_key, scene.second, sample / scene.input.size(), units));
  return fmt::format("{} {}{}", scene.spatial() ? ", at" : ", arrows at", text, second);
}

void write_drawing(std::string& out, const study::Scene& scene, std::size_t index,
                   const study::DisplayUnits& units) {
  const bool spatial = scene.spatial();
  SvgOptions options;
  // Poses and arrows, or poses in three views, are too much.
  options.ghosts = scene.vectors.empty() && scene.moments.empty() && !spatial ? 8 : 0;
  options.length = chosen_length(units);
  options.labels = scene.joints.size() <= max_named_joints;
  // The viewer takes the drawing of a spatial scene for print, and for browsers that cannot draw in space.
  put(out, "<figure class=\"drawing\"{}>{}<figcaption>{}</figcaption></figure>\n",
      spatial ? fmt::format(" data-scene=\"{}\"", index) : "", svg(scene, options),
      escape(typeset(study::in_units(scene.title, page_units(units))) +
             (options.ghosts == 0 ? shown_at(scene, units) : "")));
}

// The first drawing with the key figures beside it.
void write_first(std::string& out, const study::Result& result, const study::DisplayUnits& units) {
  out += "<div class=\"first\">\n";
  if (!result.scenes.empty()) write_drawing(out, result.scenes.front(), 0, units);
  write_facts(out, result, units);
  out += "</div>\n";
}

void write_plots(std::string& out, const study::Result& result) {
  bool first = true;
  for (const auto& plot : result.plots) {
    const Table* table = result.table(plot.table);
    if (!table) continue;
    if (std::exchange(first, false)) {
      heading(out, "Diagrams");
      out += "<div class=\"diagrams\">\n";
    }
    put(out, "<figure class=\"drawing\">{}<figcaption>{}</figcaption></figure>\n",
        plot_svg(plot, *table, result.table(plot.baseline)), escape(plot.title));
  }
  if (!first) out += "</div>\n";
}

std::string bound(double value) { return std::isinf(value) ? "none" : number(value, 9); }

void write_solutions(std::string& out, const study::Result& result) {
  if (result.solutions.empty()) return;
  heading(out, "Solutions");
  {
    Sheet sheet(out, {"solution", "objectives", "classification", "defects"});
    for (const auto& s : result.solutions) {
      Sentence defects;
      for (const Sentence& defect : s.defects) defects += (defects.empty() ? "" : ", ") + defect;
      sheet.row({typeset(s.label), display(s.objectives), display(s.classification),
                 defects.empty() ? "none" : typeset(defects)});
    }
  }
  heading(out, "Parameters of the best solution");
  Sheet sheet(out, {"parameter", "key", "value", "lower bound", "upper bound"});
  for (const auto& p : result.solutions.front().parameters) {
    const bool fixed = p.lower == p.upper;
    sheet.row({p.label, p.key, number(p.value, 12), fixed ? "fixed" : bound(p.lower),
               fixed ? "fixed" : bound(p.upper)});
  }
}

void write_changes(std::string& out, const study::Result& result) {
  if (result.changes.empty()) return;
  heading(out, "Before and after");
  Sheet sheet(out, {"quantity", "measure", "before", "after", "change", "objective"});
  for (const auto& c : result.changes)
    sheet.row({c.label, c.measure, number(c.before, 6), number(c.after, 6),
               std::isfinite(c.percent()) ? fmt::format("{:+.2f} %", c.percent()) : "",
               c.wanted ? "yes" : ""});
}

void write_comparisons(std::string& out, const study::Result& result) {
  if (result.comparisons.empty()) return;
  heading(out, "Published and ours");
  Sheet sheet(out, {"item", "source", "published", "ours", "verdict", "note"});
  for (const auto& c : result.comparisons)
    sheet.row({c.item, c.source, number(c.published, 9), number(c.ours, 9), c.verdict, c.note});
}

void write_object(std::string& out, std::string_view title, const Value& object) {
  if (!object.is_object() || object.as_object().empty()) return;
  heading(out, title);
  Sheet sheet(out, {"quantity", "value"});
  for (const auto& member : object.as_object()) sheet.row({member.key, display(member.value)});
}

void write_log(std::string& out, const Value& log) {
  if (!log.is_array() || log.as_array().empty() || !log.as_array().front().is_object()) return;
  heading(out, "Runs");
  // Histories are long and belong into plots; the columns are the scalars of the first run.
  std::vector<std::string> keys;
  for (const auto& member : log.as_array().front().as_object())
    if (!member.value.is_array() && !member.value.is_object()) keys.push_back(member.key);
  Sheet sheet(out, keys);
  for (const Value& entry : log.as_array()) {
    std::vector<std::string> cells;
    for (const auto& key : keys) {
      const Value* value = entry.find(key);
      cells.push_back(value ? display(*value) : "");
    }
    sheet.row(cells);
  }
}

void write_tables(std::string& out, const study::Result& result) {
  for (const auto& table : result.tables) {
    heading(out, table.name);
    const std::size_t step = std::max<std::size_t>(1, (table.rows() + max_table - 1) / max_table);
    if (step > 1) put(out, "<p class=\"note\">One row in {}, of {} in all.</p>\n", step, table.rows());
    std::vector<std::string> head;
    if (!table.names.empty()) head.emplace_back("name");
    std::vector<DisplayUnit> units;
    for (const auto& column : table.columns) {
      units.push_back(display_unit(column.key, study::largest_size(column.values)));
      head.push_back(label_with(column, units.back()));
    }
    if (!table.status.empty()) head.push_back("status");
    Sheet sheet(out, head);
    for (std::size_t row = 0; row < table.rows(); row += step) {
      std::vector<std::string> cells;
      if (!table.names.empty()) cells.push_back(table.names[row]);
      for (std::size_t i = 0; i < table.columns.size(); ++i) {
        const auto& values = table.columns[i].values;
        cells.push_back(row < values.size() ? number(values[row] * units[i].factor) : "");
      }
      if (!table.status.empty()) cells.push_back(row < table.status.size() ? table.status[row] : "");
      sheet.row(cells);
    }
  }
}

}  // namespace

std::string static_page(const ReportInput& input) {
  std::string out;
  const study::Result result = study::in_units(input.result, input.units);
  write_banner(out, input);
  write_first(out, input.result, input.units);
  write_checks(out, input.result);
  for (std::size_t i = 1; i < input.result.scenes.size(); ++i)
    write_drawing(out, input.result.scenes[i], i, input.units);
  write_plots(out, result);
  write_solutions(out, result);
  write_changes(out, result);
  write_comparisons(out, input.result);
  write_object(out, "Statistics", result.statistics);
  write_log(out, input.result.log);
  if (!input.result.diagnostics.empty()) {
    heading(out, "Remarks");
    out += "<ul>";
    for (const auto& d : input.result.diagnostics) put(out, "<li>{}</li>", escape(to_string(d)));
    out += "</ul>\n";
  }
  write_tables(out, result);
  heading(out, "How to reproduce");
  if (!input.source.empty())
    put(out, "<p class=\"source\">Source of the study: {}</p>\n", escape(input.source));
  if (!input.command.empty()) put(out, "<pre>{}</pre>\n", escape(input.command));
  if (!input.study_toml.empty()) put(out, "<pre class=\"study\">{}</pre>\n", escape(input.study_toml));
  put(out, "<footer>{}</footer>\n", escape(input.tool));
  return out;
}

}  // namespace linkwright::report
