// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <fmt/core.h>
#include <pybind11/numpy.h>

#include <cstddef>
#include <span>
#include <string_view>

namespace linkwright::python {

/// Numbers that Python gives: as they are where they are contiguous and double, else a copy that is.
using Array = pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

/// One number a sample; a plain number is one sample. Raises ValueError for an array of several dimensions.
inline std::span<const double> samples(const Array& array, std::string_view what) {
  if (array.ndim() > 1)
    throw pybind11::value_error(
        fmt::format("{}: one number a sample, not an array of {} dimensions", what, array.ndim()));
  return {array.data(), static_cast<std::size_t>(array.size())};
}

/// Samples of `width` numbers each, one after the other; a single one need not be in a list. Raises
/// ValueError for another shape.
inline std::span<const double> samples_of(const Array& array, std::size_t width, std::string_view what) {
  if (array.ndim() < 1 || array.ndim() > 2 ||
      static_cast<std::size_t>(array.shape(array.ndim() - 1)) != width)
    throw pybind11::value_error(fmt::format("{}: an array (n, {}) is needed", what, width));
  return {array.data(), static_cast<std::size_t>(array.size())};
}

/// New numbers, `width` a sample.
inline pybind11::array_t<double> new_samples(std::size_t count, std::size_t width) {
  return pybind11::array_t<double>(
      {static_cast<pybind11::ssize_t>(count), static_cast<pybind11::ssize_t>(width)});
}

}  // namespace linkwright::python
