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
}  // namespace pybind11

// Conversions between C++ and Python. All of it needs Python's lock.
namespace linkwright::python {

/// None, bool, int, float, str, lists and tuples, mappings with names as keys, and numbers and arrays of
/// NumPy. Throws pybind11::type_error, with the path of the key, for anything else.
Value to_value(const pybind11::handle& object, std::string_view path = {});
/// The same back: dicts keep the order of their members, null is None.
pybind11::object to_python(const Value& value);

/// The numbers as an array that shows them where they are, read-only, and keeps their owner alive.
pybind11::array shown(std::span<const double> numbers, std::shared_ptr<const void> owner);

/// Raises linkwright.StudyError: `diagnostics` of the exception, and as its text one line each.
[[noreturn]] void raise_study_error(const Diagnostics& diagnostics);

/// Does work in a thread of its own while Python's lock is free. Every 50 ms `look` is called in this thread,
/// with the lock, after Python has handled its signals. When either raises, `stop` is called, and what was
/// raised continues once the work has ended.
void work_beside_python(const std::function<void()>& work, const std::function<void()>& look,
                        const std::function<void()>& stop);

}  // namespace linkwright::python
