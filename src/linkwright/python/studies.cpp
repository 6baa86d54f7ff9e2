// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/core.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "linkwright/app/catalogue.h"
#include "linkwright/app/examples.h"
#include "linkwright/app/result_json.h"
#include "linkwright/app/run.h"
#include "linkwright/app/view.h"
#include "linkwright/app/write_whole.h"
#include "linkwright/core/units.h"
#include "linkwright/python/arrays.h"
#include "linkwright/python/bindings.h"
#include "linkwright/python/study_source.h"
#include "linkwright/python/values.h"
#include "linkwright/study/answer.h"
#include "linkwright/study/design.h"
#include "linkwright/study/overrides.h"
#include "linkwright/study/study.h"
#include "linkwright/study/write.h"

namespace linkwright::python {
namespace py = pybind11;
namespace fs = std::filesystem;
namespace {

using RunPtr = std::shared_ptr<const FinishedRun>;

/// A table of a result, which it keeps alive.
struct ShownTable {
  std::shared_ptr<const void> owner;
  const Table* table = nullptr;

  const Column& column(const std::string& key) const {
    if (const Column* found = table->find(key)) return *found;
    throw py::key_error(key);
  }
};

std::string unit_of(const Column& column) {
  const auto parts = split_unit(column.key);
  return parts ? readable_unit(parts->unit->suffix) : std::string();
}

// 1. Reading and changing

StudySource read_source(const std::string& text, const std::string& name, const fs::path& folder) {
  Diagnostics diagnostics;
  StudySource source{study::read_text(text, study::syntax_of({}, text), name, diagnostics), name, folder};
  if (has_errors(diagnostics)) raise_study_error(diagnostics);
  return source;
}

StudySource read_source_file(const fs::path& file) {
  Diagnostics diagnostics;
  StudySource source{study::read_file(file, diagnostics), file.string(), file.parent_path(), true};
  if (has_errors(diagnostics)) raise_study_error(diagnostics);
  return source;
}

void change(StudySource& source, const std::string& key, const py::object& value) {
  Diagnostics diagnostics;
  study::Override change{{}, key, to_value(value, key)};
  change.origin = fmt::format("set(\"{}\", {})", key, study::to_json(change.value));
  const auto steps = study::parse_path(key);
  if (!steps)
    diagnostics.push_back({Diagnostic::Severity::error,
                           change.origin,
                           {},
                           {},
                           fmt::format("'{}' is not the path of a key", key),
                           "write it like mechanism.link[0].name"});
  else if (Value document = source.document; study::apply_override(document, change, diagnostics))
    source.document = std::move(document);
  if (has_errors(diagnostics)) raise_study_error(diagnostics);
  source.changes.push_back(std::move(change));
}

py::object value_at(const Value& document, const std::string& key) {
  const auto steps = study::parse_path(key);
  const Value* at = steps ? &document : nullptr;
  for (std::size_t i = 0; at && i < steps->size(); ++i) {
    at = at->find((*steps)[i].key);
    for (const std::size_t index : (*steps)[i].indices)
      at = at && at->is_array() && index < at->as_array().size() ? &at->as_array()[index] : nullptr;
  }
  if (!at) throw py::key_error(key);
  return to_python(*at);
}

study::Study ready(const StudySource& source, Diagnostics& diagnostics) {
  auto study = prepared(source, diagnostics);
  if (!study) raise_study_error(diagnostics);
  return std::move(*study);
}

// 2. Running

void limit(RunContext& context, int threads, std::optional<double> seconds) {
  context.set_threads(threads);
  if (seconds) context.set_time_limit(std::chrono::duration<double>(*seconds));
}

/// The last report of a run on its progress, handed from the threads of the run to that of Python.
class LastProgress {
 public:
  void take(const Progress& progress) {
    const std::lock_guard lock(mutex_);
    stage_ = progress.stage;
    fraction_ = progress.fraction, best_ = progress.best;
    fresh_ = true;
  }
  /// Calls `report(stage, fraction, best)` when there is something new; false when that returned False.
  bool give(const py::object& report) {
    std::string stage;
    double fraction = 0, best = 0;
    {
      const std::lock_guard lock(mutex_);
      if (!fresh_) return true;
      fresh_ = false;
      stage = stage_, fraction = fraction_, best = best_;
    }
    return !report(stage, fraction, best).is(py::bool_(false));
  }

 private:
  std::mutex mutex_;
  std::string stage_;
  double fraction_ = 0, best_ = 0;
  bool fresh_ = false;
};

RunPtr run(const StudySource& source, const py::object& progress, std::optional<double> seconds,
           int threads) {
  Diagnostics remarks;
  study::Study study = ready(source, remarks);
  RunContext context;
  limit(context, threads, seconds);
  LastProgress last;
  if (!progress.is_none()) context.set_progress([&](const Progress& p) { last.take(p); });
  const auto look = [&] {
    if (!progress.is_none() && !last.give(progress)) context.cancel();
  };
  RunPtr out;
  work_beside_python([&] { out = finished(source, std::move(study), remarks, context); }, look,
                     [&] { context.cancel(); });
  look();
  return out;
}

/// Several studies, `at_once` at a time, each in `threads` threads. Results are in the order of the studies,
/// None for those that were not begun because `progress(done, all)` returned False.
std::vector<RunPtr> run_many(const std::vector<StudySource>& sources, const py::object& progress,
                             std::optional<double> seconds, int at_once, int threads) {
  struct Job {
    study::Study study;
    Diagnostics remarks;
    RunContext context;
    RunPtr out;
  };
  if (at_once < 1) throw py::value_error(fmt::format("threads must be at least 1, got {}", at_once));
  std::vector<std::unique_ptr<Job>> jobs;
  for (const StudySource& source : sources) {
    jobs.push_back(std::make_unique<Job>());
    jobs.back()->study = ready(source, jobs.back()->remarks);
    jobs.back()->context.set_threads(threads);
  }
  std::atomic<std::size_t> next{0}, done{0};
  std::atomic<bool> stopped{false};
  std::mutex mutex;
  std::exception_ptr failed;
  const auto stop = [&] {
    stopped = true;
    for (const auto& job : jobs) job->context.cancel();
  };
  const auto work = [&] {
    try {
      for (std::size_t i = next++; i < jobs.size() && !stopped; i = next++) {
        Job& job = *jobs[i];
        if (seconds) job.context.set_time_limit(std::chrono::duration<double>(*seconds));
        job.out = finished(sources[i], std::move(job.study), job.remarks, job.context);
        ++done;
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      failed = std::current_exception();
      stop();
    }
  };
  std::size_t reported = 0;
  const auto look = [&] {
    if (progress.is_none() || reported == done) return;
    reported = done;
    if (progress(reported, jobs.size()).is(py::bool_(false))) stop();
  };
  const auto all = [&] {
    std::vector<std::thread> others;
    for (int i = 1; i < at_once; ++i) others.emplace_back(work);
    work();
    for (std::thread& thread : others) thread.join();
    if (failed) std::rethrow_exception(failed);
  };
  work_beside_python(all, look, stop);
  look();
  std::vector<RunPtr> out;
  for (const auto& job : jobs) out.push_back(job->out);
  return out;
}

// 3. Results

std::string json_of(const FinishedRun& run) {
  return study::to_json_readable(app::result_json(run.study, run.shown, run.outcome.record));
}

std::string report_of(const FinishedRun& run) { return app::report_text(run.study, run.shown, run.outcome); }

[[noreturn]] void raise_os_error(const std::string& message) {
  PyErr_SetString(PyExc_OSError, message.c_str());
  throw py::error_already_set();
}

void write_report(const FinishedRun& run, const fs::path& file) {
  std::string problem;
  {
    const Unlocked unlocked;
    problem = app::write_whole(file, report_of(run));
  }
  if (!problem.empty()) raise_os_error(fmt::format("{}: cannot be written: {}", file.string(), problem));
}

std::vector<std::string> save(const FinishedRun& run, const fs::path& folder, std::size_t max_table) {
  Diagnostics problems;
  std::vector<std::string> out;
  {
    const Unlocked unlocked;
    app::RunOutcome outcome = run.outcome;
    outcome.max_rows = max_table;
    if (app::prepare_folder(folder, problems))
      for (const fs::path& file : app::write_results(run.study, outcome, folder, problems))
        out.push_back(file.string());
  }
  if (!problems.empty()) raise_os_error(to_string(problems.front()));
  return out;
}

py::dict numbers_of(const std::vector<study::Parameter>& parameters) {
  py::dict out;
  for (const study::Parameter& p : parameters) out[py::str(p.key)] = p.value;
  return out;
}

std::vector<std::string> texts_of(const std::vector<Sentence>& sentences) {
  std::vector<std::string> out;
  for (const Sentence& sentence : sentences) out.push_back(to_string(sentence));
  return out;
}

/// (label, parameters, objectives, classification, defects, source or None) of each solution.
py::list solutions_of(const FinishedRun& run) {
  py::list out;
  const auto or_empty = [](const Value& value, py::object empty) {
    return value.is_null() ? empty : to_python(value);
  };
  for (std::size_t i = 0; i < run.shown.solutions.size(); ++i) {
    const study::Solution& s = run.shown.solutions[i];
    const Value& document = run.outcome.result.solutions[i].study;
    const std::string name = study::design_name(s, i + 1) + ".toml";
    out.append(
        py::make_tuple(to_string(s.label), numbers_of(s.parameters), or_empty(s.objectives, py::dict()),
                       or_empty(s.classification, py::dict()), texts_of(s.defects),
                       document.is_null() ? py::object(py::none())
                                          : py::cast(StudySource{document, name, run.study.common.folder})));
  }
  return out;
}

py::list facts_of(const FinishedRun& run) {
  py::list out;
  for (const study::Fact& fact : run.shown.facts) {
    const auto number = fact.value();
    out.append(py::make_tuple(to_string(fact.label), to_string(fact.text),
                              number ? py::cast(number->value()) : py::none(),
                              number ? number->unit_words() : std::string(), name_of(fact.verdict)));
  }
  return out;
}

py::list checks_of(const FinishedRun& run) {
  py::list out;
  for (const study::Check& c : run.shown.checks)
    out.append(py::make_tuple(c.quantity, c.value, c.limit, c.passed, c.at, c.message));
  return out;
}

// 4. State that is pickled

/// Calls `visit` with every position in a document, in the order of its values.
void visit_positions(Value& value, const std::function<void(Position&)>& visit) {
  visit(value.position);
  if (value.is_array()) {
    for (Value& element : value.as_array()) visit_positions(element, visit);
  } else if (value.is_object()) {
    for (Value::Member& member : value.as_object()) {
      visit(member.key_position);
      visit_positions(member.value, visit);
    }
  }
}

py::tuple state_of(const StudySource& source) {
  std::vector<int> positions;  // so that messages name the same lines
  Value document = source.document;
  visit_positions(document, [&](Position& p) { positions.insert(positions.end(), {p.line, p.column}); });
  py::list changes;
  for (const study::Override& change : source.changes)
    changes.append(py::make_tuple(change.origin, change.key, to_python(change.value)));
  return py::make_tuple(to_python(document), positions, source.file, source.folder.string(), source.from_file,
                        changes);
}

StudySource source_of(const py::tuple& state) {
  StudySource source{to_value(state[0].cast<py::object>()), state[2].cast<std::string>(),
                     state[3].cast<std::string>(), state[4].cast<bool>()};
  const auto positions = state[1].cast<std::vector<int>>();
  std::size_t next = 0;
  visit_positions(source.document, [&](Position& p) {
    p = {positions.at(next), positions.at(next + 1)};
    next += 2;
  });
  for (const py::handle change : state[5].cast<py::list>()) {
    const auto row = change.cast<py::tuple>();
    source.changes.push_back(
        {row[0].cast<std::string>(), row[1].cast<std::string>(), to_value(row[2].cast<py::object>())});
  }
  return source;
}

py::tuple state_of(const Diagnostic& d) {
  return py::make_tuple(d.severity == Diagnostic::Severity::error, d.file, d.position.line, d.position.column,
                        d.key, to_string(d.message), to_string(d.hint));
}

Diagnostic diagnostic_of(const py::tuple& state) {
  return {state[0].cast<bool>() ? Diagnostic::Severity::error : Diagnostic::Severity::warning,
          state[1].cast<std::string>(),
          {state[2].cast<int>(), state[3].cast<int>()},
          state[4].cast<std::string>(),
          state[5].cast<std::string>(),
          state[6].cast<std::string>()};
}

py::tuple state_of(const ShownTable& shown_table) {
  const Table& table = *shown_table.table;
  py::list columns;
  for (const Column& column : table.columns)
    columns.append(py::make_tuple(column.key, column.label, shown(column.values, shown_table.owner)));
  return py::make_tuple(table.name, table.names, columns, table.status);
}

ShownTable table_of(const py::tuple& state) {
  auto table = std::make_shared<Table>(Table{state[0].cast<std::string>(),
                                             state[1].cast<std::vector<std::string>>(),
                                             {},
                                             state[3].cast<std::vector<std::string>>()});
  for (const py::handle column : state[2].cast<py::list>()) {
    const auto row = column.cast<py::tuple>();
    const auto array = row[2].cast<Array>();
    const std::span<const double> values = samples(array, "values");
    table->add(row[0].cast<std::string>(), row[1].cast<std::string>(), {values.begin(), values.end()});
  }
  const Table* at = table.get();
  return {std::move(table), at};
}

// 5. What there is to begin with

py::list examples_like(const std::string& text) {
  py::list out;
  for (const app::Example* example : app::find_examples(text)) {
    py::dict beside;
    for (const app::EmbeddedFile& file : example->beside) beside[py::str(std::string(file.path))] = file.text;
    out.append(py::make_tuple(example->name, example->title, example->group, example->text, beside));
  }
  return out;
}

py::tuple template_of(const std::string& kind) {
  Diagnostics diagnostics;
  const study::Kind* found = app::find_kind(kind, app::catalogue(), diagnostics);
  if (!found) raise_study_error(diagnostics);
  return py::make_tuple(study::name_of(*found), found->example);
}

void bind_sources(py::module_& module) {
  py::class_<Diagnostic>(module, "Diagnostic",
                         "One thing that is wrong with a study, or remarkable about it.")
      .def_property_readonly(
          "severity",
          [](const Diagnostic& d) { return d.severity == Diagnostic::Severity::error ? "error" : "warning"; },
          "'error' or 'warning'")
      .def_readonly("file", &Diagnostic::file, "name of the file or of the change; may be empty")
      .def_property_readonly(
          "line", [](const Diagnostic& d) { return d.position.line; }, "from 1; 0 = unknown")
      .def_property_readonly(
          "column", [](const Diagnostic& d) { return d.position.column; }, "in characters, from 1")
      .def_readonly("key", &Diagnostic::key, "path of the key: 'mechanism.parameters.crank_m'")
      .def_property_readonly(
          "message", [](const Diagnostic& d) { return to_string(d.message); },
          "what was found, and what is allowed")
      .def_property_readonly(
          "hint", [](const Diagnostic& d) { return to_string(d.hint); }, "how to fix it; may be empty")
      .def("__str__", [](const Diagnostic& d) { return to_string(d); })
      .def("__repr__", [](const Diagnostic& d) { return "<" + to_string(d) + ">"; })
      .def(py::pickle([](const Diagnostic& d) { return state_of(d); }, &diagnostic_of));

  py::class_<StudySource>(module, "Source")
      .def_readonly("file", &StudySource::file)
      .def("copy", [](const StudySource& s) { return s; })
      .def("in_folder",
           [](const StudySource& s, const fs::path& folder) {
             StudySource out = s;
             out.folder = folder;
             return out;
           })
      .def("set", &change)
      .def("get", [](const StudySource& s, const std::string& key) { return value_at(s.document, key); })
      .def("check",
           [](const StudySource& s) {
             Diagnostics diagnostics;
             prepared(s, diagnostics);
             return diagnostics;
           })
      .def("document", [](const StudySource& s) { return to_python(s.document); })
      .def("canonical",
           [](const StudySource& s) {
             Diagnostics diagnostics;
             return to_python(ready(s, diagnostics).canonical);
           })
      .def("kind",
           [](const StudySource& s) {
             Diagnostics diagnostics;
             return study::name_of(*ready(s, diagnostics).kind);
           })
      .def("toml", [](const StudySource& s) { return study::to_toml(s.document); })
      .def("run", &run)
      .def(py::pickle([](const StudySource& s) { return state_of(s); }, &source_of));
  module.def("read_text", &read_source);
  module.def("read_file", &read_source_file);
  module.def("from_dict", [](const py::object& document, const std::string& name, const fs::path& folder) {
    return StudySource{to_value(document), name, folder};
  });
  module.def("run_many", &run_many);
}

void bind_results(py::module_& module) {
  py::class_<FinishedRun, std::shared_ptr<FinishedRun>>(module, "Run")
      .def_property_readonly("headline", [](const FinishedRun& r) { return to_string(r.shown.headline); })
      .def_property_readonly("status", [](const FinishedRun& r) { return to_string(r.shown.status); })
      .def_property_readonly("verdict",
                             [](const FinishedRun& r) { return name_of(study::answer_of(r.shown).verdict); })
      .def_property_readonly("reasons",
                             [](const FinishedRun& r) { return study::answer_of(r.shown).reasons; })
      .def_property_readonly("exit_code", [](const FinishedRun& r) { return app::exit_code(r.shown); })
      .def_property_readonly("seconds", [](const FinishedRun& r) { return r.outcome.record.seconds; })
      .def_property_readonly("title", [](const FinishedRun& r) { return study::title_of(r.study); })
      .def_property_readonly("diagnostics", [](const FinishedRun& r) { return r.shown.diagnostics; })
      .def_property_readonly("facts", &facts_of)
      .def_property_readonly("checks", &checks_of)
      .def_property_readonly("solutions", &solutions_of)
      .def_property_readonly("statistics",
                             [](const FinishedRun& r) {
                               return r.shown.statistics.is_null() ? py::object(py::dict())
                                                                   : to_python(r.shown.statistics);
                             })
      .def_property_readonly("files",
                             [](const FinishedRun& r) {
                               py::dict out;
                               for (const study::ResultFile& file : r.outcome.result.files)
                                 out[py::str(file.name)] = file.text;
                               return out;
                             })
      .def_property_readonly("tables",
                             [](const std::shared_ptr<FinishedRun>& r) {
                               std::vector<ShownTable> out;
                               for (const Table& table : r->shown.tables) out.push_back({r, &table});
                               return out;
                             })
      .def_property_readonly("json", py::cpp_function(&json_of, py::call_guard<Unlocked>()))
      .def("report", &report_of, py::call_guard<Unlocked>())
      .def("write_report", &write_report)
      .def("save", &save);

  py::class_<ShownTable>(module, "Table")
      .def_property_readonly("name", [](const ShownTable& t) { return t.table->name; })
      .def_property_readonly("rows", [](const ShownTable& t) { return t.table->rows(); })
      .def_property_readonly("names", [](const ShownTable& t) { return t.table->names; })
      .def_property_readonly("status",
                             [](const ShownTable& t) {
                               return t.table->status.empty()
                                          ? std::vector<std::string>(t.table->rows(), "done")
                                          : t.table->status;
                             })
      .def("keys",
           [](const ShownTable& t) {
             std::vector<std::string> out;
             for (const Column& column : t.table->columns) out.push_back(column.key);
             return out;
           })
      .def("unit", [](const ShownTable& t, const std::string& key) { return unit_of(t.column(key)); })
      .def("label", [](const ShownTable& t, const std::string& key) { return t.column(key).label; })
      .def("column",
           [](const ShownTable& t, const std::string& key) { return shown(t.column(key).values, t.owner); })
      .def("csv", [](const ShownTable& t) { return to_csv(*t.table); })
      .def(py::pickle([](const ShownTable& t) { return state_of(t); }, &table_of));
}

}  // namespace

void bind_studies(py::module_& module) {
  bind_sources(module);
  bind_results(module);
  module.def("examples", &examples_like);
  module.def("template", &template_of);
  module.def("catalogue", [] { return to_python(app::catalogue_document()); });
  module.def("schema", [](const std::string& kind) { return to_python(app::schema_document(kind)); });
}

}  // namespace linkwright::python
