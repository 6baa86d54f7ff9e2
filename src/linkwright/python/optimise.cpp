// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "linkwright/core/numbers.h"
#include "linkwright/optimise/minimise.h"
#include "linkwright/optimise/population_methods.h"
#include "linkwright/python/arrays.h"
#include "linkwright/python/bindings.h"
#include "linkwright/python/values.h"
#include "linkwright/study/bind.h"

namespace linkwright::python {
namespace py = pybind11;
namespace {

using Choice = optimise::MethodChoice<optimise::Constraints::feasibility_rules>;

struct Chosen {
  Choice method;
};
template <class Visitor>
void fields(Visitor&& visit, Chosen& c) {
  visit(field::entry("method", "population method").required(), c.method);
}

/// The numbers that an objective returned for so many candidates.
void copy_numbers(const py::handle& given, std::string_view what, std::span<double> out) {
  const Array numbers = Array::ensure(given);
  if (!numbers) {
    PyErr_Clear();
    throw py::type_error(fmt::format("the objective must return an array of {} {}", out.size(), what));
  }
  if (static_cast<std::size_t>(numbers.size()) != out.size() || numbers.ndim() > 2)
    throw py::value_error(fmt::format("the objective must return {} {}, one a row of its argument, got {}",
                                      out.size(), what, numbers.size()));
  std::copy_n(numbers.data(), out.size(), out.begin());
}

/// Costs that Python computes for a part of a population: rows of candidates in, costs out, or a pair of
/// costs and violations. Python's lock is held.
void evaluate(const py::object& objective, const optimise::PopulationView& candidates, std::span<double> cost,
              std::span<double> violation) {
  py::array_t<double> rows = new_samples(candidates.size, candidates.dimension);
  double* to = rows.mutable_data();
  for (std::size_t i = 0; i < candidates.size; ++i)
    for (std::size_t j = 0; j < candidates.dimension; ++j) *to++ = candidates(j, i);
  const py::object answer = objective(rows);
  std::fill(violation.begin(), violation.end(), 0.0);
  if (py::isinstance<py::tuple>(answer)) {
    const auto pair = answer.cast<py::tuple>();
    if (pair.size() != 2)
      throw py::value_error("the objective must return costs, or a pair of costs and violations");
    copy_numbers(pair[0].cast<py::object>(), "costs", cost);
    copy_numbers(pair[1].cast<py::object>(), "violations", violation);
  } else {
    copy_numbers(answer, "costs", cost);
  }
  for (std::size_t i = 0; i < candidates.size; ++i) {
    if (violation[i] < 0)
      throw py::value_error(fmt::format("violations are 0 (feasible) or more, got {}", violation[i]));
    // A candidate without a cost or a violation is worse than any other one. Violations have the units of the
    // user, so that no finite one would do.
    if (!std::isfinite(cost[i]) || !std::isfinite(violation[i])) cost[i] = violation[i] = infinity;
  }
}

optimise::Problem problem_of(const py::object& objective, std::span<const double> lower,
                             std::span<const double> upper) {
  if (lower.size() != upper.size())
    throw py::value_error(
        fmt::format("as many lower as upper bounds are needed, got {} and {}", lower.size(), upper.size()));
  if (lower.empty()) throw py::value_error("at least one unknown is needed, but there are no bounds");
  optimise::Problem problem;
  for (std::size_t j = 0; j < lower.size(); ++j) {
    if (!(std::isfinite(lower[j]) && std::isfinite(upper[j]) && lower[j] <= upper[j]))
      throw py::value_error(fmt::format(
          "bounds of unknown {} must be finite, the lower one not above the upper one; got {} and {}", j,
          lower[j], upper[j]));
    problem.variables.push_back({fmt::format("x{}", j), lower[j], upper[j]});
  }
  problem.evaluate = [&objective](const optimise::PopulationView& candidates, std::span<double> cost,
                                  std::span<double> violation) {
    evaluate(objective, candidates, cost, violation);
  };
  return problem;
}

/// (x, cost, violation, evaluations, generations, status, stop_reason, log)
py::tuple minimise(const py::object& objective, const Array& lower, const Array& upper,
                   const py::dict& method, std::uint64_t seed, std::optional<double> seconds,
                   const py::object& progress) {
  const optimise::Problem problem = problem_of(objective, samples(lower, "lower"), samples(upper, "upper"));
  const Value document = to_value(method);
  Diagnostics diagnostics;
  Chosen chosen;
  {
    study::DocumentReader reader(document, "minimise", diagnostics);
    reader.root().read(chosen);
    if (!reader.has_errors()) reader.finish();  // else the other keys are those of another method
  }
  if (has_errors(diagnostics)) raise_study_error(diagnostics);

  RunContext context;
  context.set_threads(1);  // Python's lock is here
  if (seconds) context.set_time_limit(std::chrono::duration<double>(*seconds));
  const UnderWay under_way([&] { context.cancel(); });
  const optimise::Report report = std::visit(
      [&](const auto& m) {
        auto optimiser = make_optimiser(problem.variables, m.options, {.seed = seed});
        optimise::Problem watched = problem;
        watched.evaluate = [&](const optimise::PopulationView& candidates, std::span<double> cost,
                               std::span<double> violation) {
          problem.evaluate(candidates, cost, violation);
          if (PyErr_CheckSignals() != 0) throw py::error_already_set();
          if (!progress.is_none() && optimiser->generation() > 0 &&
              progress(optimiser->generation(), optimiser->best_cost()).is(py::bool_(false)))
            context.cancel();
        };
        return optimise::minimise(watched, *optimiser, m.options.generations, choice_word(m.options).name,
                                  m.minimise, context);
      },
      chosen.method);
  throw_if_python_ends();
  std::vector<double> evaluations, best;
  for (const optimise::GenerationLog& g : report.log) {
    evaluations.push_back(static_cast<double>(g.evaluations));
    best.push_back(g.best_cost);
  }
  const auto array = [](const std::vector<double>& v) {
    return py::array_t<double>(static_cast<py::ssize_t>(v.size()), v.data());
  };
  return py::make_tuple(array(report.x), report.cost, report.violation, report.evaluations,
                        report.generations, to_string(report.status), report.stop_reason, array(evaluations),
                        array(best));
}

}  // namespace

void bind_optimise(py::module_& module) {
  module.def("minimise", &minimise);
  module.def("methods", [] {
    py::dict out;
    for (const auto& row : names(optimise::Method()))
      if (row.name == name_of(row.value))
        out[py::str(std::string(row.name))] = row.summary;  // not short names
    return out;
  });
}

}  // namespace linkwright::python
