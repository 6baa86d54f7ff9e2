// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include "linkwright/core/value.h"

namespace linkwright {

/// The form in which a document holds its long lists of numbers: as any other value, or apart from it, for
/// readers that take numbers in their binary form. A list apart is `{"": [first, count]}` in the document;
/// NaN stands for what would be null.
class NumberLists {
 public:
  static constexpr std::size_t shortest = 8;

  NumberLists() = default;  ///< in the document
  explicit NumberLists(std::vector<double>& numbers)
      : apart_(&numbers) {}  ///< appended to `numbers`, which must outlive this
  bool apart() const { return apart_ != nullptr; }

  Value operator()(const std::vector<double>& values) const {
    if (!apart_ || values.size() < shortest) return Value(values);
    Value place = Value::object();
    place[""] = Value(Value::Array{Value(apart_->size()), Value(values.size())});
    apart_->insert(apart_->end(), values.begin(), values.end());
    return place;
  }

 private:
  std::vector<double>* apart_ = nullptr;
};

}  // namespace linkwright
