// SPDX-License-Identifier: BSD-3-Clause
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linkwright/core/run_context.h"
#include "linkwright/python/arrays.h"
#include "linkwright/python/bindings.h"
#include "linkwright/python/rows.h"
#include "linkwright/python/study_source.h"
#include "linkwright/python/values.h"
#include "linkwright/study/bind.h"
#include "linkwright/suspension/studies/sweep.h"
#include "linkwright/suspension/wheel/corner_columns.h"

namespace linkwright::python {
namespace py = pybind11;
namespace {

suspension::SweepStudy sweep_of(const StudySource& source) {
  Diagnostics diagnostics;
  const auto study = prepared(source, diagnostics);
  if (!study) raise_study_error(diagnostics);
  if (study::name_of(*study->kind) != "analysis/suspension.corner")
    throw py::value_error("the study is " + study::name_of(*study->kind) +
                          ", must be analysis/suspension.corner");
  study::DocumentReader reader(source.document, source.file, diagnostics);
  study::ObjectReader root = reader.root();
  Value canonical = Value::object();
  auto out = suspension::read_sweep_study(root, study->common, canonical);
  if (!out) raise_study_error(diagnostics);
  return std::move(*out);
}

/// Finite and ascending, as a grid needs them.
std::vector<double> ascending(const Array& array, std::string_view what) {
  const std::span<const double> values = samples(array, what);
  const bool finite = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  if (values.empty() || !finite ||
      std::adjacent_find(values.begin(), values.end(), std::greater_equal<>()) != values.end())
    throw py::value_error(std::string(what) + ": finite numbers are needed, each larger than the one before");
  return {values.begin(), values.end()};
}

class WheelSuspension {
 public:
  explicit WheelSuspension(const StudySource& source)
      : study_(sweep_of(source)), plan_(suspension::prepare_suspension(study_.description.suspension)) {}

  Rows sweep(const Array& travel, const Array& rack, const std::vector<std::string>& wanted) const {
    const std::vector<double> travels = ascending(travel, "travel"), racks = ascending(rack, "rack");
    std::vector<const suspension::CornerColumn*> columns;
    for (const suspension::CornerColumn& column : suspension::corner_columns())
      if (wanted.empty() || std::find(wanted.begin(), wanted.end(), column.key) != wanted.end())
        columns.push_back(&column);
    for (const std::string& key : wanted)
      if (std::none_of(columns.begin(), columns.end(),
                       [&](const auto* column) { return column->key == key; }))
        throw py::key_error(key);
    RunContext context;
    suspension::GridPositions grid;
    auto table = std::make_shared<Computed>();
    // Ctrl-C ends what takes long.
    work_beside_python(
        [&] {
          grid = suspension::solve_grid(plan_, study_.travel, travels, racks, &context);
          fill(grid, travels, racks, columns, *table);
        },
        [] {}, [&] { context.cancel(); });
    Rows out{table, {}, table->status};
    for (const auto& [key, values] : table->columns) out.rows.emplace_back(key, values);
    return out;
  }

 private:
  struct Computed {
    std::vector<std::pair<std::string, std::vector<double>>> columns;
    std::vector<Status> status;
  };

  void fill(const suspension::GridPositions& grid, const std::vector<double>& travels,
            const std::vector<double>& racks, const std::vector<const suspension::CornerColumn*>& columns,
            Computed& out) const {
    const std::size_t rows = grid.positions.size();
    const auto add = [&](std::string_view key, auto&& value) {
      std::vector<double> values(rows);
      for (std::size_t i = 0; i < rows; ++i) values[i] = value(i);
      out.columns.emplace_back(key, std::move(values));
    };
    add("travel_m", [&](std::size_t i) { return travels[grid.first_travel + i % grid.travels]; });
    add("rack_m", [&](std::size_t i) { return racks[i / grid.travels]; });
    for (const suspension::CornerColumn* column : columns)
      add(column->key, [&](std::size_t i) {
        return suspension::value_of(*column, {grid.positions[i], grid.wheels[i], study_.lock});
      });
    for (const suspension::CornerPosition& position : grid.positions) out.status.push_back(position.status);
  }

  suspension::SweepStudy study_;
  suspension::CornerPlan plan_;
};

}  // namespace

void bind_suspension(py::module_& module) {
  py::class_<WheelSuspension>(module, "WheelSuspension")
      .def(py::init<const StudySource&>())
      .def("sweep", &WheelSuspension::sweep);
}

}  // namespace linkwright::python
