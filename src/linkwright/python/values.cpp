// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/python/values.h"

#include <fmt/core.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "linkwright/study/study.h"

namespace linkwright::python {
namespace py = pybind11;
namespace {

std::string below(std::string_view path, std::string_view key) {
  return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
}

Value integer(const py::handle& object, std::string_view path) {
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(object.ptr()));
  if (!index) throw py::error_already_set();
  int overflow = 0;
  const long long number = PyLong_AsLongLongAndOverflow(index.ptr(), &overflow);
  if (overflow != 0)
    throw py::value_error(fmt::format("{}: {} does not fit into 64 bits", path, std::string(py::str(index))));
  return Value(static_cast<std::int64_t>(number));
}

Value list(const py::handle& object, std::string_view path, int depth) {
  Value out = Value::array();
  std::size_t i = 0;
  for (const py::handle item : py::reinterpret_borrow<py::iterable>(object))
    out.push_back(to_value(item, fmt::format("{}[{}]", path, i++), depth));
  return out;
}

Value table(const py::handle& object, std::string_view path, int depth) {
  Value out = Value::object();
  for (const py::handle item : object.attr("items")()) {
    const auto pair = py::reinterpret_borrow<py::sequence>(item);
    if (!py::isinstance<py::str>(pair[0]))
      throw py::type_error(fmt::format("{}: keys are str, not {}", path.empty() ? "the study" : path,
                                       Py_TYPE(pair[0].cast<py::object>().ptr())->tp_name));
    const auto key = pair[0].cast<std::string>();
    out[key] = to_value(pair[1].cast<py::object>(), below(path, key), depth);
  }
  return out;
}

/// All work that is under way, and whether Python is at its end. They are read and changed with the lock
/// only.
std::vector<const UnderWay*> under_way;
bool python_ends = false;

PyObject* study_error() {
  // Made once and never freed, as the interpreter may end before the library is unloaded.
  static PyObject* const type =
      py::object(py::module_::import("linkwright.errors").attr("StudyError")).release().ptr();
  return type;
}

}  // namespace

Value to_value(const py::handle& object, std::string_view path, int depth) {
  if (depth > study::deepest_nesting)
    throw py::value_error(fmt::format(
        "{}: {}", path.empty() || path[0] == '[' ? "the study" : path.substr(0, path.find_first_of(".[")),
        study::nested_too_deep()));
  if (object.is_none()) return {};
  if (py::isinstance<py::bool_>(object)) return Value(object.cast<bool>());
  if (py::isinstance<py::str>(object)) return Value(object.cast<std::string>());
  if (py::isinstance<py::float_>(object)) return Value(object.cast<double>());
  // Arrays and numbers of NumPy say what they are in Python's own types.
  if (py::hasattr(object, "tolist")) return to_value(py::object(object.attr("tolist")()), path, depth + 1);
  if (PyIndex_Check(object.ptr())) return integer(object, path);
  if (py::isinstance<py::list>(object) || py::isinstance<py::tuple>(object))
    return list(object, path, depth + 1);
  if (py::hasattr(object, "items")) return table(object, path, depth + 1);
  throw py::type_error(fmt::format("{}: a study holds numbers, texts, lists and tables, not {}",
                                   path.empty() ? "the study" : path, Py_TYPE(object.ptr())->tp_name));
}

py::object to_python(const Value& value) {
  if (value.is_null()) return py::none();
  if (value.is_bool()) return py::bool_(value.as_bool());
  if (value.is_integer()) return py::int_(value.as_integer());
  if (value.is_number()) return py::float_(value.as_number());
  if (value.is_string()) return py::str(value.as_string());
  if (value.is_array()) {
    const Value::Array& items = value.as_array();
    py::list out(items.size());
    for (std::size_t i = 0; i < items.size(); ++i) out[i] = to_python(items[i]);
    return out;
  }
  py::dict out;
  for (const Value::Member& member : value.as_object()) out[py::str(member.key)] = to_python(member.value);
  return out;
}

py::array shown(std::span<const double> numbers, std::shared_ptr<const void> owner) {
  auto kept = std::make_unique<std::shared_ptr<const void>>(std::move(owner));
  const py::capsule base(kept.get(), [](void* p) { delete static_cast<std::shared_ptr<const void>*>(p); });
  kept.release();
  py::array_t<double> out({static_cast<py::ssize_t>(numbers.size())}, {sizeof(double)}, numbers.data(), base);
  py::detail::array_proxy(out.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return out;
}

void raise_study_error(const Diagnostics& diagnostics) {
  py::list list;
  for (const Diagnostic& d : diagnostics) list.append(d);
  const py::object error = py::handle(study_error())(list);
  PyErr_SetObject(study_error(), error.ptr());
  throw py::error_already_set();
}

UnderWay::UnderWay(std::function<void()> end) : stop(std::move(end)) {
  throw_if_python_ends();
  under_way.push_back(this);
}

UnderWay::~UnderWay() { std::erase(under_way, this); }

void end_work() {
  python_ends = true;
  for (const UnderWay* work : under_way) work->stop();
  while (!under_way.empty()) {
    {
      const py::gil_scoped_release unlocked;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  }
}

void forget_work() { under_way.clear(); }

void throw_if_python_ends() {
  if (!python_ends) return;
  PyErr_SetNone(PyExc_SystemExit);
  throw py::error_already_set();
}

Unlocked::Unlocked() {
  if (python_ends) return;
  work_ = std::make_unique<UnderWay>([] {});
  unlocked_ = std::make_unique<py::gil_scoped_release>();
}

Unlocked::~Unlocked() = default;

void work_beside_python(const std::function<void()>& work, const std::function<void()>& look,
                        const std::function<void()>& stop) {
  constexpr auto often = std::chrono::milliseconds(50);
  std::exception_ptr failed, raised;
  const UnderWay under_way(stop);
  {
    const py::gil_scoped_release unlocked;
    std::mutex mutex;
    std::condition_variable ended;
    bool over = false;
    std::thread worker([&] {
      try {
        work();
      } catch (...) {
        failed = std::current_exception();
      }
      const std::lock_guard lock(mutex);
      over = true;
      ended.notify_all();
    });
    std::unique_lock lock(mutex);
    while (!ended.wait_for(lock, often, [&] { return over; })) {
      if (raised) continue;
      lock.unlock();
      {
        const py::gil_scoped_acquire locked;
        try {
          if (PyErr_CheckSignals() != 0) throw py::error_already_set();
          look();
        } catch (...) {
          raised = std::current_exception();
          stop();
        }
      }
      lock.lock();
    }
    lock.unlock();
    worker.join();
  }
  throw_if_python_ends();
  if (raised) std::rethrow_exception(raised);
  if (failed) std::rethrow_exception(failed);
}

}  // namespace linkwright::python
