// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "linkwright/core/units.h"
#include "linkwright/optimise/statistics.h"
#include "linkwright/parameter_study/sensitivity.h"
#include "linkwright/parameter_study/studies/sweep.h"
#include "linkwright/study/overrides.h"
#include "linkwright/study/remarks.h"

namespace linkwright::parameter_study {
namespace {

constexpr const char* trials_table = "trials";
constexpr std::size_t max_curves = 21;  // largest number of curves in one diagram
constexpr std::size_t max_clouds = 12;  // diagrams of dots
constexpr std::size_t max_named = 3;    // parameters of a trial in a fact
constexpr std::size_t resamples = 200;  // for confidence intervals

/// A column in the making: its words, the last ones most telling, and its unit.
struct Heading {
  std::vector<std::string> words;
  std::string unit;    ///< suffix; empty = a plain number
  std::string label;   ///< given by the user; empty = the words
  std::string tail;    ///< end of its name: "_max"
  std::string before;  ///< words for people before the column's name: "greatest"

  std::string name(std::size_t depth) const {
    const std::size_t first = words.size() - std::min(depth, words.size());
    return fmt::format("{}{}",
                       fmt::join(words.begin() + static_cast<std::ptrdiff_t>(first), words.end(), "_"), tail);
  }
};

/// The SI unit of what a unit suffix measures.
std::string si_unit(const std::string& unit) {
  const auto key = split_unit("x_" + unit);
  return key ? std::string(units(key->dimension).front().suffix) : std::string();
}
double in_si(double value, const std::string& unit) {
  return unit.empty() ? value : split_unit("x_" + unit)->unit->to_si(value);
}

Heading heading_of(const Parameter& p) {
  Heading h;
  const auto path = study::parse_path(p.key);
  for (const study::KeyStep& step : path.value()) {
    std::string word = step.key;
    if (const auto key = split_unit(word)) {
      h.unit = key->unit->suffix;
      word = key->base;
    }
    for (const std::size_t index : step.indices) word += fmt::format("_{}", index);
    h.words.push_back(std::move(word));
  }
  h.label = p.label;
  return h;
}

/// "sweep.toe_deg.max" -> sweep, toe_max in deg.
Heading heading_of(const Measure& m) {
  Heading h;
  std::string_view rest = m.request.quantity;
  while (true) {
    const std::string_view part = rest.substr(0, rest.find('.'));
    std::string word(part);
    if (const auto key = split_unit(part)) {
      h.unit = key->unit->suffix;
      word = key->base;
    }
    h.words.push_back(std::move(word));
    if (part.size() == rest.size()) break;
    rest.remove_prefix(part.size() + 1);
  }
  if (h.words.size() == 3) {
    static const std::map<std::string, std::string> said{{"min", "least "},
                                                         {"max", "greatest "},
                                                         {"mean", "mean "},
                                                         {"rms", "root mean square "},
                                                         {"first", "first "},
                                                         {"last", "last "},
                                                         {"max_abs", "greatest size of "}};
    if (const auto found = said.find(h.words[2]); found != said.end()) h.before = found->second;
    h.tail = "_" + h.words[2];
    h.words.pop_back();
  }
  if (!m.name.empty()) h.words = {m.name}, h.tail.clear(), h.before.clear();
  return h;
}

/// Names as short as they can be told apart, numbered where words do not suffice.
std::vector<std::string> names_of(const std::vector<Heading>& headings) {
  std::vector<std::string> names;
  for (const Heading& h : headings) {
    std::size_t depth = 1;
    const auto clashes = [&](const std::string& name) {
      return std::count_if(headings.begin(), headings.end(),
                           [&](const Heading& other) { return other.name(depth) == name; }) > 1;
    };
    while (depth < h.words.size() && clashes(h.name(depth))) ++depth;
    std::string name = h.name(depth);
    for (int number = 2; std::find(names.begin(), names.end(), name) != names.end(); ++number)
      name = fmt::format("{}_{}", h.name(depth), number);
    names.push_back(std::move(name));
  }
  return names;
}

/// A value in the unit in which it is given.
Measured with_unit(double value, const std::string& unit) {
  if (unit.empty()) return plain_number(value);
  const Measured number = measured(unit, in_si(value, unit));
  return unit == "deg" ? number : number.spelled();
}

std::string spaced(std::string text) {
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string word_text(const Value& value) {
  return value.is_string() ? value.as_string()
         : value.is_bool() ? (value.as_bool() ? "true" : "false")
                           : fmt::format("{:.6g}", value.as_number());
}

class Reporter {
 public:
  Reporter(const ParameterStudy& s, const TrialResults& results, study::Result& result)
      : s_(s), results_(results), result_(result) {
    for (const Parameter& p : s.parameters) headings_.push_back(heading_of(p));
    for (const Measure& m : s.measures) headings_.push_back(heading_of(m));
    names_ = names_of(headings_);
    for (std::size_t k = 0; k < headings_.size(); ++k) {
      const std::string unit = si_unit(headings_[k].unit);
      keys_.push_back(names_[k] + (unit.empty() ? "" : "_" + unit));
      const Heading& h = headings_[k];
      const bool said = !h.before.empty() && names_[k].ends_with(h.tail);
      const std::string words =
          said ? h.before + names_[k].substr(0, names_[k].size() - h.tail.size()) : names_[k];
      titles_.push_back(h.label.empty() ? spaced(words) : h.label);
      labels_.push_back(titles_[k] + (unit.empty() ? "" : fmt::format(" ({})", readable_unit(unit))));
    }
  }

  void report(const std::vector<double>& as_given) {
    add_trials();
    add_summary(as_given);
    add_facts();
    if (const auto* morris = std::get_if<MorrisSampling>(&s_.sampling))
      add_effects(*morris);
    else if (const auto* saltelli = std::get_if<SaltelliSampling>(&s_.sampling))
      add_indices(*saltelli);
    if (std::holds_alternative<GridSampling>(s_.sampling))
      add_grid_diagrams();
    else
      add_clouds();
    warn();
  }

 private:
  std::size_t parameters() const { return s_.parameters.size(); }
  std::size_t measures() const { return s_.measures.size(); }
  const std::string& key_of(std::size_t measure) const { return keys_[parameters() + measure]; }
  const std::string& title_of(std::size_t measure) const { return titles_[parameters() + measure]; }
  const std::string& unit_of(std::size_t measure) const { return headings_[parameters() + measure].unit; }

  void add_trials() {
    Table table{.name = trials_table};
    for (std::size_t j = 0; j < parameters(); ++j) {
      const std::vector<Value>& words = s_.parameters[j].words;
      Column& column = table.add(keys_[j], labels_[j]);
      for (std::size_t i = 0; i < s_.trials.count(); ++i)
        column.values.push_back(words.empty() ? in_si(s_.trials.at(i, j), headings_[j].unit)
                                              : s_.trials.at(i, j) + 1);
      if (words.empty()) continue;
      std::string said;
      for (std::size_t w = 0; w < words.size(); ++w)
        said += fmt::format("{}{} = {}", w == 0 ? "" : ", ", w + 1, word_text(words[w]));
      column.label += " (" + said + ")";
    }
    for (std::size_t k = 0; k < measures(); ++k) {
      Column& column = table.add(key_of(k), labels_[parameters() + k]);
      for (const double value : results_.measured[k]) column.values.push_back(in_si(value, unit_of(k)));
    }
    for (const std::string& status : results_.status)
      table.status.push_back(status.empty() ? std::string("not tried") : status);
    result_.tables.push_back(std::move(table));
  }

  /// One row a figure, one column a measure.
  void add_summary(const std::vector<double>& as_given) {
    Table table{
        .name = "summary",
        .names = {"as given", "least", "10 %", "median", "90 %", "greatest", "mean", "standard deviation"}};
    for (std::size_t k = 0; k < measures(); ++k) {
      std::vector<double> sorted;
      for (const double value : results_.measured[k])
        if (!std::isnan(value)) sorted.push_back(in_si(value, unit_of(k)));
      std::sort(sorted.begin(), sorted.end());
      const auto n = static_cast<double>(sorted.size());
      double mean = sorted.empty() ? nan : 0, squares = 0;
      for (const double x : sorted) mean += x / n;
      for (const double x : sorted) squares += (x - mean) * (x - mean);
      std::vector<double> values{in_si(as_given[k], unit_of(k))};
      for (const double p : {0.0, 0.1, 0.5, 0.9, 1.0}) values.push_back(optimise::quantile(sorted, p));
      values.push_back(mean);
      values.push_back(n > 1 ? std::sqrt(squares / (n - 1)) : nan);
      table.add(key_of(k), labels_[parameters() + k], std::move(values));
    }
    result_.tables.push_back(std::move(table));
  }

  /// "at coupler 350 mm, branch open", or "in trial 17" where that would be long.
  Sentence place(std::size_t trial) const {
    if (parameters() > max_named)
      return say("in trial {}", at_place("trial", count_of(static_cast<double>(trial + 1))));
    Sentence text = "at ";
    for (std::size_t j = 0; j < parameters(); ++j) {
      const Parameter& p = s_.parameters[j];
      const double value = s_.trials.at(trial, j);
      text += say("{}{} ", j == 0 ? "" : ", ", titles_[j]);
      text += p.words.empty() ? Sentence(at_place(names_[j], with_unit(value, headings_[j].unit)))
                              : word_text(p.words[static_cast<std::size_t>(value)]);
    }
    return text;
  }
  Measured measured_value(std::size_t k, double value) const { return with_unit(value, unit_of(k)); }

  void add_facts() {
    const study::AddFact fact{result_.facts};
    const auto done = static_cast<std::size_t>(
        std::count(results_.status.begin(), results_.status.end(), to_string(Status::done)));
    const std::size_t all = s_.trials.count();
    fact("trials", done == all ? say("{}", all) : say("{} of {} done", done, all));
    Sentence headline;
    for (std::size_t k = 0; k < measures(); ++k) {
      const std::vector<double>& values = results_.measured[k];
      std::size_t least = all, greatest = all;
      for (std::size_t i = 0; i < all; ++i) {
        if (std::isnan(values[i])) continue;
        if (least == all || values[i] < values[least]) least = i;
        if (greatest == all || values[i] > values[greatest]) greatest = i;
      }
      if (least == all) {
        fact(title_of(k), "no trial has it", study::Fact::Verdict::bad);
        continue;
      }
      if (values[least] == values[greatest]) {
        fact(title_of(k), say("{} in all trials", measured_value(k, values[least])));
      } else {
        fact(title_of(k) + ", smallest", say("{} {}", measured_value(k, values[least]), place(least)));
        fact(title_of(k) + ", largest", say("{} {}", measured_value(k, values[greatest]), place(greatest)));
      }
      if (headline.empty())
        headline =
            say("Over {} trial{}, {} is {}{}.", done, done == 1 ? "" : "s", title_of(k),
                measured_value(k, values[least]),
                values[least] == values[greatest] ? Sentence()
                                                  : say(" to {}", measured_value(k, values[greatest])));
    }
    result_.headline = headline.empty() ? "No trial has a measure." : headline;
    if (headline.empty() && result_.status == Status::done) result_.status = Status::infeasible;
  }

  bool all_tried() const {
    return std::none_of(results_.status.begin(), results_.status.end(),
                        [](const std::string& status) { return status.empty(); });
  }

  Table parameter_table(std::string name) const {
    return {.name = std::move(name),
            .names = {titles_.begin(), titles_.begin() + static_cast<std::ptrdiff_t>(parameters())}};
  }
  /// A column of the sensitivity of a measure, in its unit or without.
  void add_sensitivity(Table& table, std::size_t k, std::string_view what, std::string_view label,
                       std::vector<double> values, bool with_unit) const {
    const std::string unit = with_unit ? si_unit(unit_of(k)) : std::string();
    for (double& value : values)
      if (with_unit) value = in_si(value, unit_of(k));
    const auto key = split_unit(key_of(k));
    table.add(fmt::format("{}_{}{}", key ? std::string(key->base) : key_of(k), what,
                          unit.empty() ? "" : "_" + unit),
              fmt::format("{}, {}{}", title_of(k), label,
                          unit.empty() ? "" : fmt::format(" ({})", readable_unit(unit))),
              std::move(values));
  }

  /// The parameter that moves a measure most, as a fact.
  void add_strongest(std::size_t k, const std::vector<double>& strength, bool share) {
    const auto strongest = std::max_element(strength.begin(), strength.end(),
                                            [](double a, double b) { return std::isnan(a) || a < b; });
    if (strongest == strength.end() || !(*strongest > 0)) return;
    const std::string& parameter = titles_[static_cast<std::size_t>(strongest - strength.begin())];
    study::AddFact{result_.facts}(
        "moves " + title_of(k) + " most",
        share ? say("{}: {} of the variance", parameter, plain_number(*strongest, 3))
              : say("{}: {} over its range, on average", parameter, measured_value(k, *strongest)));
  }

  void add_effects(const MorrisSampling& sampling) {
    if (!all_tried()) return;
    const Points points = morris_trajectories(static_cast<std::size_t>(sampling.trajectories), parameters(),
                                              static_cast<std::size_t>(sampling.levels), sampling.seed);
    Table table = parameter_table("sensitivity");
    for (std::size_t k = 0; k < measures(); ++k) {
      std::vector<double> mean_abs, mean, sd;
      for (const ElementaryEffects& e : elementary_effects(points, results_.measured[k])) {
        mean_abs.push_back(e.mean_abs);
        mean.push_back(e.mean);
        sd.push_back(e.sd);
      }
      add_strongest(k, mean_abs, false);
      add_sensitivity(table, k, "mu_star", "mean size of its change over the range (mu*)", mean_abs, true);
      add_sensitivity(table, k, "mu", "mean change (mu)", mean, true);
      add_sensitivity(table, k, "sigma", "scatter of the changes (sigma)", sd, true);
    }
    result_.tables.push_back(std::move(table));
  }

  void add_indices(const SaltelliSampling& sampling) {
    if (!all_tried()) return;
    Table table = parameter_table("sensitivity");
    for (std::size_t k = 0; k < measures(); ++k) {
      const SobolDecomposition d =
          sobol_indices(results_.measured[k], parameters(), resamples, sampling.seed);
      std::vector<double> first, total, first_margin, total_margin;
      for (const SobolIndices& index : d.parameters) {
        first.push_back(index.first);
        total.push_back(index.total);
        first_margin.push_back(index.first_margin);
        total_margin.push_back(index.total_margin);
      }
      add_strongest(k, total, true);
      add_sensitivity(table, k, "first", "share of the variance alone", first, false);
      add_sensitivity(table, k, "first_margin", "... within", first_margin, false);
      add_sensitivity(table, k, "total", "share with interactions", total, false);
      add_sensitivity(table, k, "total_margin", "... within", total_margin, false);
      if (d.used < static_cast<std::size_t>(sampling.samples))
        study::AddWarning{result_.diagnostics}(
            fmt::format("{}: {} of {} samples are left out, because one of their trials has no value",
                        title_of(k), static_cast<std::size_t>(sampling.samples) - d.used, sampling.samples),
            "narrow the ranges to where every trial has one");
    }
    result_.tables.push_back(std::move(table));
  }

  std::size_t levels(std::size_t j) const {
    std::set<double> values;
    for (std::size_t i = 0; i < s_.trials.count(); ++i) values.insert(s_.trials.at(i, j));
    return values.size();
  }

  void add_grid_diagrams() {
    // The longest parameter runs along the axis, the others make curves.
    std::size_t along = 0;
    for (std::size_t j = 1; j < parameters(); ++j)
      if (levels(j) > levels(along) && s_.parameters[j].words.empty()) along = j;
    if (parameters() > 2 || !s_.parameters[along].words.empty()) return add_clouds();
    for (std::size_t k = 0; k < measures(); ++k) {
      study::Plot plot{.name = fmt::format("measure-{}", k + 1),
                       .title = fmt::format("{} over {}", title_of(k), titles_[along]),
                       .table = trials_table,
                       .x = keys_[along],
                       .y = {key_of(k)}};
      if (parameters() == 2) {
        const std::size_t other = 1 - along;
        if (levels(other) > max_curves)
          plot.style = study::Plot::Style::points;
        else
          plot.group = keys_[other];
        for (const Value& word : s_.parameters[other].words) plot.group_names.push_back(word_text(word));
        plot.title += " and " + titles_[other];
      }
      result_.plots.push_back(std::move(plot));
      if (parameters() == 2) add_map(k);
    }
  }

  /// Maps have equal axes: for two lengths, two angles ..., of ranges of one size.
  void add_map(std::size_t k) {
    const Parameter &x = s_.parameters[0], &y = s_.parameters[1];
    const bool ranges = x.min && y.min && x.spacing == Spacing::linear && y.spacing == Spacing::linear;
    if (!ranges || si_unit(headings_[0].unit) != si_unit(headings_[1].unit) || levels(0) < 3 || levels(1) < 3)
      return;
    const double width = in_si(*x.max, headings_[0].unit) - in_si(*x.min, headings_[0].unit);
    const double height = in_si(*y.max, headings_[1].unit) - in_si(*y.min, headings_[1].unit);
    if (width > 3 * height || height > 3 * width) return;
    result_.plots.push_back({.name = fmt::format("map-{}", k + 1),
                             .title = title_of(k),
                             .table = trials_table,
                             .x = keys_[0],
                             .y = {keys_[1], key_of(k)},
                             .style = study::Plot::Style::map});
  }

  void add_clouds() {
    std::size_t drawn = 0;
    for (std::size_t k = 0; k < measures(); ++k)
      for (std::size_t j = 0; j < parameters() && drawn < max_clouds; ++j, ++drawn)
        result_.plots.push_back({.name = fmt::format("measure-{}-over-{}", k + 1, j + 1),
                                 .title = fmt::format("{} over {}", title_of(k), titles_[j]),
                                 .table = trials_table,
                                 .x = keys_[j],
                                 .y = {key_of(k)},
                                 .style = study::Plot::Style::points});
    for (std::size_t k = 0; k < measures(); ++k)
      result_.plots.push_back({.name = fmt::format("spread-{}", k + 1),
                               .title = "Spread of " + title_of(k),
                               .table = trials_table,
                               .x = {},
                               .y = {key_of(k)},
                               .style = study::Plot::Style::histogram});
  }

  void warn() {
    const study::AddWarning warning{result_.diagnostics};
    std::map<std::string, std::size_t> counts;
    for (const std::string& status : results_.status) ++counts[status];
    if (counts.contains(""))
      warning(fmt::format("interrupted: {} of {} trials were made", s_.trials.count() - counts[""],
                          s_.trials.count()));
    const auto first = std::find_if(results_.problem.begin(), results_.problem.end(),
                                    [](const std::string& problem) { return !problem.empty(); });
    if (first != results_.problem.end()) {
      const auto i = static_cast<std::size_t>(first - results_.problem.begin());
      warning(say("{} of {} trials are studies with errors; the first {}: {}",
                  std::count_if(results_.problem.begin(), results_.problem.end(),
                                [](const std::string& problem) { return !problem.empty(); }),
                  s_.trials.count(), place(i), *first));
    }
    std::string others;
    for (const auto& [status, count] : counts)
      if (!status.empty() && status != to_string(Status::done) && status != "invalid")
        others += fmt::format("{}{} {}", others.empty() ? "" : ", ", count, status);
    if (!others.empty()) warning(fmt::format("not all trials came to their end: {}", others));
  }

  const ParameterStudy& s_;
  const TrialResults& results_;
  study::Result& result_;
  std::vector<Heading> headings_;  // headings of the parameters, then of the measures
  std::vector<std::string> names_, keys_, titles_, labels_;
};

}  // namespace

void report_trials(const ParameterStudy& s, const TrialResults& results, const std::vector<double>& as_given,
                   study::Result& result) {
  Reporter(s, results, result).report(as_given);
}

}  // namespace linkwright::parameter_study
