// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string_view>

#include "linkwright/core/diagnostic.h"
#include "linkwright/core/value.h"

namespace pybind11 {
class object;
class handle;
class array;
class gil_scoped_release;
}  // namespace pybind11

// Conversions between C++ and Python. All of it needs Python's lock.
namespace linkwright::python {

/// None, bool, int, float, str, lists and tuples, mappings with names as keys, and numbers and arrays of
/// NumPy. Throws pybind11::type_error, with the path of the key, for anything else, and
/// pybind11::value_error where it is nested deeper than a study may be, as what contains itself is.
Value to_value(const pybind11::handle& object, std::string_view path = {}, int depth = 0);
/// The same back: dicts keep the order of their members, null is None.
pybind11::object to_python(const Value& value);

/// The numbers as an array that shows them where they are, read-only, and keeps their owner alive.
pybind11::array shown(std::span<const double> numbers, std::shared_ptr<const void> owner);

/// Raises linkwright.StudyError: `diagnostics` of the exception, and as its text one line each.
[[noreturn]] void raise_study_error(const Diagnostics& diagnostics);

/// Work that is under way in a thread of Python. At exit Python calls `end_work`, which calls `stop` of all
/// work and waits until none is left: a thread that took the lock of an interpreter that has ended would
/// abort the process.
class UnderWay {
 public:
  /// Raises SystemExit, which ends the thread, when Python is at its end.
  explicit UnderWay(std::function<void()> stop);
  ~UnderWay();
  UnderWay(const UnderWay&) = delete;
  UnderWay& operator=(const UnderWay&) = delete;

  const std::function<void()> stop;
};
void end_work();
/// In the child of a fork, the threads whose work was under way do not exist.
void forget_work();
/// Raises SystemExit when `end_work` has been called.
void throw_if_python_ends();

/// Python's lock is free while this lives, for work that takes a moment; it is kept when Python is at its
/// end.
class Unlocked {
 public:
  Unlocked();
  ~Unlocked();
  Unlocked(const Unlocked&) = delete;
  Unlocked& operator=(const Unlocked&) = delete;

 private:
  std::unique_ptr<UnderWay> work_;
  std::unique_ptr<pybind11::gil_scoped_release> unlocked_;
};

/// Does work in a thread of its own while Python's lock is free. Every 50 ms `look` is called in this thread,
/// with the lock, after Python has handled its signals. When either raises, `stop` is called, and what was
/// raised continues once the work has ended. When Python ends meanwhile, `stop` is called and SystemExit
/// raised.
void work_beside_python(const std::function<void()>& work, const std::function<void()>& look,
                        const std::function<void()>& stop);

}  // namespace linkwright::python
