// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "linkwright/parameter_study/sensitivity.h"
#include "linkwright/study/bind.h"
#include "linkwright/study/kind.h"

// A study run again and again with some of its keys changed: what its file holds, how it is read, run and
// reported.
namespace linkwright::parameter_study {

enum class Spacing { linear, logarithmic };
constexpr std::array<EnumName<Spacing>, 2> names(Spacing) {
  return {{{Spacing::linear, "linear", "equal steps"},
           {Spacing::logarithmic, "logarithmic", "equal ratios; min and max above 0"}}};
}

/// Numbers, words, true and false, as they are written: [20, 25], ["open", "crossed"].
struct PlainList {
  std::vector<Value> values;
};
bool read_value(study::ObjectReader& reader, const study::ObjectReader::Found& found, const Field& field,
                PlainList& member);
Value write_value(const PlainList& member);
Value schema_value(const Field& field, const PlainList& member);

/// Rows of them.
struct PlainRows {
  std::vector<PlainList> rows;
};
bool read_value(study::ObjectReader& reader, const study::ObjectReader::Found& found, const Field& field,
                PlainRows& member);
Value write_value(const PlainRows& member);
Value schema_value(const Field& field, const PlainRows& member);

/// A key of the study that is changed: over a range, or through a list of numbers or words.
struct Parameter {
  std::string key;  ///< its path, with its unit: "mechanism.crank_mm", "link[0].length_mm"
  std::optional<double> min, max;
  std::optional<PlainList> values;  ///< instead
  std::optional<int> steps;
  Spacing spacing = Spacing::linear;
  std::string label;  ///< empty = the path

  /// Words or other values of `values` or of a list of trials, where they are not all numbers.
  std::vector<Value> words;
};
template <class Visitor>
void fields(Visitor&& visit, Parameter& p) {
  visit(field::entry("key", "what is changed, as for --set: mechanism.crank_mm, mechanism.link[0].length_mm")
            .required(),
        p.key);
  visit(field::entry("min", "least value, in the unit of the key"), p.min);
  visit(field::entry("max", "greatest value"), p.max);
  visit(field::entry("values", "numbers or words instead of min and max"), p.values);
  visit(field::entry("steps", "values of a grid; default 11").between(1, 1e6), p.steps);
  visit(field::entry("spacing", "of the values between min and max"), p.spacing);
  visit(field::entry("label", "name in tables and diagrams; default: the key"), p.label);
}

/// A number of each result.
struct Measure {
  study::CheckRequest request;  ///< quantity and row
  std::string name;             ///< name of its column; empty = made of the quantity
};

struct GridSampling {};
template <class Visitor>
void fields(Visitor&&, GridSampling&) {}
constexpr Word choice_word(const GridSampling&) {
  return {"grid", "all combinations of the values of the parameters"};
}

struct LatinHypercubeSampling {
  int samples = 100;
  std::uint64_t seed = 1;
};
template <class Visitor>
void fields(Visitor&& visit, LatinHypercubeSampling& s) {
  visit(field::entry("samples", "trials").between(1, 1e6), s.samples);
  visit(field::entry("seed", "of the random numbers"), s.seed);
}
constexpr Word choice_word(const LatinHypercubeSampling&) {
  return {"latin_hypercube", "each parameter falls once into each of as many intervals as there are trials"};
}

struct SobolSampling {
  int samples = 128;
};
template <class Visitor>
void fields(Visitor&& visit, SobolSampling& s) {
  visit(field::entry("samples", "trials; powers of 2 fill space best").between(1, 1e6), s.samples);
}
constexpr Word choice_word(const SobolSampling&) { return {"sobol", "a sequence that fills space evenly"}; }

struct ListSampling {
  std::optional<std::string> file;
  std::optional<PlainRows> trials;
};
template <class Visitor>
void fields(Visitor&& visit, ListSampling& s) {
  visit(field::entry("file", "CSV whose columns are called as the keys of the parameters"), s.file);
  visit(field::entry("trials", "or rows of values, in the order of the parameters"), s.trials);
}
constexpr Word choice_word(const ListSampling&) { return {"list", "the trials of a CSV file or a list"}; }

struct MorrisSampling {
  int trajectories = 20;
  int levels = 4;
  std::uint64_t seed = 1;
};
template <class Visitor>
void fields(Visitor&& visit, MorrisSampling& s) {
  visit(field::entry("trajectories", "paths on which each parameter is changed once").between(2, 1e5),
        s.trajectories);
  visit(field::entry("levels", "values of each parameter, an even number").between(2, 100), s.levels);
  visit(field::entry("seed", "of the random numbers"), s.seed);
}
constexpr Word choice_word(const MorrisSampling&) {
  return {"morris", "elementary effects: which of many parameters matter, in few trials"};
}

struct SaltelliSampling {
  int samples = 256;
  std::uint64_t seed = 1;
};
template <class Visitor>
void fields(Visitor&& visit, SaltelliSampling& s) {
  visit(field::entry("samples", "rows; each takes as many trials as there are parameters and two more")
            .between(2, 1e6),
        s.samples);
  visit(field::entry("seed", "of the confidence intervals"), s.seed);
}
constexpr Word choice_word(const SaltelliSampling&) {
  return {"sobol_indices", "shares of the variance that each parameter has alone and together with others"};
}

using Sampling = std::variant<GridSampling, LatinHypercubeSampling, SobolSampling, ListSampling,
                              MorrisSampling, SaltelliSampling>;

struct ParameterStudy {
  Value study;                   ///< the whole study that is run, as it is written
  std::string name;              ///< name of its file, for messages
  std::filesystem::path folder;  ///< folder in which the file names given in it start
  std::vector<Parameter> parameters;
  Sampling sampling;
  std::vector<Measure> measures;
  /// The values of each trial, a trial after the other: numbers in the units of the keys; of words their
  /// place in the list of their parameter, 0, 1, ...
  Points trials;

  bool listed() const { return std::holds_alternative<ListSampling>(sampling); }
};

/// "sweep": a study over some of its keys. `kinds` (which must outlive it): the kinds of study that it runs.
study::Kind sweep_kind(std::span<const study::Kind> kinds);

/// The value of a key in a trial.
Value value_of(const ParameterStudy& study, std::size_t trial, std::size_t parameter);
/// The study of one trial.
Value document_of(const ParameterStudy& study, std::size_t trial);

/// The results of the trials; a trial without a status was not made.
struct TrialResults {
  std::vector<std::vector<double>> measured;  ///< trials of each measure, in the units of the quantities
  std::vector<std::string> status;
  std::vector<std::string> problem;  ///< says why a trial is no valid study; empty = it is one
};

/// Adds tables, diagrams and facts; `as_given`: the measures of the study without changes.
void report_trials(const ParameterStudy& study, const TrialResults& results,
                   const std::vector<double>& as_given, study::Result& result);

study::Result run_parameter_study(const ParameterStudy& study, std::span<const study::Kind> kinds,
                                  RunContext& context);

}  // namespace linkwright::parameter_study
