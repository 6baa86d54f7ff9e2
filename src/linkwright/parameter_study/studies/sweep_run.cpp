// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/checkpoint.h"
#include "linkwright/optimise/pieces.h"
#include "linkwright/parameter_study/studies/sweep.h"
#include "linkwright/study/remarks.h"
#include "linkwright/study/run_seeds.h"
#include "linkwright/study/study.h"

namespace linkwright::parameter_study {
namespace {

// Pieces of at most this number keep checkpoints small where trials are many and short.
constexpr std::size_t max_pieces = 4096;
constexpr std::string_view invalid = "invalid";

/// The trials of a piece: [first, last).
struct Part {
  std::size_t first = 0, last = 0;
};
Part part_of(std::size_t piece, std::size_t trials) {
  const std::size_t size = (trials + max_pieces - 1) / max_pieces;
  return {piece * size, std::min((piece + 1) * size, trials)};
}

/// Runs one trial; false if it was interrupted.
bool run_trial(const ParameterStudy& s, std::span<const study::Kind> kinds, std::size_t i,
               RunContext& context, TrialResults& out) {
  Diagnostics problems;
  const auto study = study::prepare(document_of(s, i), s.name, s.folder, kinds, problems);
  if (!study) {
    out.status[i] = invalid;
    const auto error = std::find_if(problems.begin(), problems.end(), [](const Diagnostic& d) {
      return d.severity == Diagnostic::Severity::error;
    });
    if (error != problems.end())
      out.problem[i] = error->key + (error->key.empty() ? "" : ": ") + to_string(error->message);
    return true;
  }
  RunContext own;
  own.set_part_of(context);
  own.set_threads(context.threads());
  const study::Result result = study::run_study(*study, own);
  if (study::is_interrupted(result.status)) return false;
  out.status[i] = to_string(result.status);
  // A quantity measured on a part of the motion does not hold for the whole.
  if (result.status != Status::done && result.status != Status::at_rest) return true;
  for (std::size_t k = 0; k < s.measures.size(); ++k)
    out.measured[k][i] = study::evaluate(s.measures[k].request, result).value;
  return true;
}

/// A part for the checkpoint: what was measured, trial by trial, and what became of each.
Value kept(const ParameterStudy& s, const TrialResults& results, const Part& part) {
  std::vector<double> numbers;
  Value out, status = Value::array(), problem = Value::array();
  for (std::size_t i = part.first; i < part.last; ++i) {
    for (std::size_t k = 0; k < s.measures.size(); ++k) numbers.push_back(results.measured[k][i]);
    status.push_back(results.status[i]);
    problem.push_back(results.problem[i]);
  }
  out["measured"] = pack_numbers(numbers);
  out["status"] = std::move(status);
  out["problem"] = std::move(problem);
  return out;
}

void restore(const ParameterStudy& s, const Part& part, const Value& value, const std::string& what,
             TrialResults& results) {
  const std::size_t count = part.last - part.first;
  const std::vector<double> numbers = unpack_numbers(load_member(value, "measured", what), what);
  const Value &status = load_member(value, "status", what), &problem = load_member(value, "problem", what);
  const auto texts = [count](const Value& list) {
    return list.is_array() && list.as_array().size() == count &&
           std::all_of(list.as_array().begin(), list.as_array().end(),
                       [](const Value& v) { return v.is_string(); });
  };
  if (numbers.size() != count * s.measures.size() || !texts(status) || !texts(problem))
    throw CheckpointError(fmt::format("{}: is not a part of {} trials", what, count));
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < s.measures.size(); ++k)
      results.measured[k][part.first + i] = numbers[i * s.measures.size() + k];
    results.status[part.first + i] = status.as_array()[i].as_string();
    results.problem[part.first + i] = problem.as_array()[i].as_string();
  }
}

/// The study as it is given, and what of its measures: a misspelt one shall not cost a night.
struct Base {
  study::Result result;
  std::vector<double> measured;
  std::string problem;  ///< a measure that there is not; empty = all are there
};

Base run_base(const ParameterStudy& s, std::span<const study::Kind> kinds, RunContext& context) {
  Base base;
  Diagnostics problems;
  const auto study = study::prepare(s.study, s.name, s.folder, kinds, problems);
  RunContext own;
  own.set_part_of(context);
  own.set_threads(context.threads());
  base.result = study::run_study(*study, own);
  for (const Measure& m : s.measures) {
    const study::Check found = study::evaluate(m.request, base.result);
    base.measured.push_back(found.value);
    if (base.problem.empty() && !found.message.empty() && base.result.status == Status::done)
      base.problem = fmt::format("{}: {}", m.request.quantity, found.message);
  }
  return base;
}

}  // namespace

study::Result run_parameter_study(const ParameterStudy& s, std::span<const study::Kind> kinds,
                                  RunContext& context) {
  Base base = run_base(s, kinds, context);
  study::Result result;
  if (study::is_interrupted(base.result.status)) {
    result.status = base.result.status;
    result.headline = "Interrupted before there was anything to report.";
    return result;
  }
  if (!base.problem.empty()) {
    result.status = Status::infeasible;
    result.headline = "Nothing was tried. " + base.problem;
    return result;
  }
  const std::size_t trials = s.trials.count();
  TrialResults results;
  results.measured.assign(s.measures.size(), std::vector<double>(trials, nan));
  results.status.resize(trials);
  results.problem.resize(trials);
  const std::size_t pieces = (trials + part_of(0, trials).last - 1) / part_of(0, trials).last;
  std::vector<char> complete(pieces, 1);
  const auto name = [&](std::size_t piece) { return fmt::format("trials {}", piece + 1); };
  const optimise::PieceLoop loop = optimise::for_each_piece(
      pieces, context, "trials", name,
      [&](std::size_t piece) {
        const Part part = part_of(piece, trials);
        for (std::size_t i = part.first; i < part.last && complete[piece]; ++i)
          complete[piece] = run_trial(s, kinds, i, context, results);
        return infinity;
      },
      [&](std::size_t piece) { return complete[piece] ? kept(s, results, part_of(piece, trials)) : Value(); },
      [&](std::size_t piece, const Value& value) {
        restore(s, part_of(piece, trials), value, name(piece), results);
        return infinity;
      });
  // An interruption after the last trial was done took nothing away.
  if (std::any_of(results.status.begin(), results.status.end(),
                  [](const std::string& t) { return t.empty(); }))
    result.status = loop.status;
  report_trials(s, results, base.measured, result);
  if (!base.result.scenes.empty()) {
    result.scenes.push_back(std::move(base.result.scenes.front()));
    result.scenes.front().title = "the study as given";
  }
  return result;
}

}  // namespace linkwright::parameter_study
