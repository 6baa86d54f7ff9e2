// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <variant>

#include "linkwright/core/units.h"
#include "linkwright/core/value.h"
#include "linkwright/study/bind_traits.h"

// From structs to documents, by the field lists that bind.h reads them with: SI units, canonical keys.
namespace linkwright::study {

/// The visitor that writes members into a table.
class ObjectWriter {
 public:
  /// `object` becomes a table if it is null, and must be one otherwise.
  explicit ObjectWriter(Value& object) : object_(&object) {
    if (object.is_null()) object = Value::object();
  }

  template <class T>
  void operator()(const Field& field, const T& member) {
    if constexpr (is_optional<T>) {
      if (member) (*this)(field, *member);
    } else if constexpr (is_variant<T>) {
      std::visit(
          [&](auto options) {
            (*object_)[field.key] = Value(choice_word(options).name);
            fields(*this, options);
          },
          member);
    } else {
      (*object_)[field.inherits_unit ? std::string(field.key) : si_key(field.key, field.dimension)] =
          to_value(member);
    }
  }

  /// A value as documents hold it.
  template <class T>
  static Value to_value(const T& member) {
    if constexpr (HasOwnForm<T>) {
      return write_value(member);
    } else if constexpr (std::is_same_v<T, Range>) {
      if (member.fixed()) return Value(member.lower);
      Value range;
      range["min"] = member.lower;
      range["max"] = member.upper;
      return range;
    } else if constexpr (std::is_integral_v<T> && !std::is_same_v<T, bool>) {
      return Value(static_cast<std::int64_t>(member));
    } else if constexpr (HasNames<T>) {
      return Value(linkwright::name_of(member));
    } else if constexpr (is_named<T>) {
      Value object = Value::object();
      for (const auto& [name, element] : member) object[name] = to_value(element);
      return object;
    } else if constexpr (is_number_array<T> || is_vector<T>) {
      Value::Array array;
      array.reserve(member.size());
      for (const auto& element : member) array.push_back(to_value(element));
      return Value(std::move(array));
    } else if constexpr (HasFields<T>) {
      Value object;
      ObjectWriter writer(object);
      T copy = member;  // field lists take what they list by reference
      fields(writer, copy);
      return object;
    } else {
      return Value(member);
    }
  }

 private:
  Value* object_;
};

/// A struct as a table.
template <HasFields T>
Value write_fields(const T& object) {
  return ObjectWriter::to_value(object);
}

}  // namespace linkwright::study
