// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "linkwright/core/field.h"

// The types that the members of a field list can have; shared by reading, writing and schema.
namespace linkwright::study {

struct FieldProbe {
  template <class T>
  void operator()(const Field&, T&) const {}
};

/// A struct with a field list: `fields(visitor, object)` is found by argument-dependent lookup.
template <class T>
concept HasFields = std::is_class_v<T> && requires(T& object, FieldProbe probe) {
  fields(probe, object);
};

/// A type that files write in a form of its own, by functions that argument-dependent lookup finds (`Found`
/// is ObjectReader::Found):
///
///     bool read_value(ObjectReader& reader, const Found& found, const Field& field, T& member);
///     Value write_value(const T& member);  // in SI units
///     Value schema_value(const Field& field, const T& member);
template <class T>
concept HasOwnForm = std::is_class_v<T> && requires(const T& object) {
  write_value(object);
};

/// An enumeration with `names(E)`.
template <class T>
concept HasNames = std::is_enum_v<T> && requires {
  names(T{});
};

template <class T>
inline constexpr bool is_optional = false;
template <class T>
inline constexpr bool is_optional<std::optional<T>> = true;

template <class T>
inline constexpr bool is_vector = false;
template <class T>
inline constexpr bool is_vector<std::vector<T>> = true;

/// Values under names that the user gives: a table with free keys.
template <class T>
inline constexpr bool is_named = false;
template <class T>
inline constexpr bool is_named<std::vector<std::pair<std::string, T>>> = true;

template <class T>
inline constexpr bool is_number_array = false;
template <std::size_t N>
inline constexpr bool is_number_array<std::array<double, N>> = true;

template <class T>
inline constexpr bool is_variant = false;
template <class... T>
inline constexpr bool is_variant<std::variant<T...>> = true;

/// The words of an enumeration.
template <HasNames E>
constexpr auto words_of() {
  constexpr auto all = names(E{});
  std::array<Word, all.size()> words;
  for (std::size_t i = 0; i < all.size(); ++i) words[i] = {all[i].name, all[i].summary};
  return words;
}

/// The name of an array of T in messages.
template <class T>
constexpr std::string_view expected_elements() {
  if constexpr (std::is_arithmetic_v<T>)
    return "an array of numbers";
  else if constexpr (is_number_array<T>)
    return std::tuple_size_v<T> == 2 ? "an array of points [x, y]" : "an array of points [x, y, z]";
  else if constexpr (HasFields<T>)
    return "an array of tables";
  else
    return "an array of words";
}

}  // namespace linkwright::study
