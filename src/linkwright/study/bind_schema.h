// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <initializer_list>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "linkwright/core/units.h"
#include "linkwright/core/value.h"
#include "linkwright/study/bind_write.h"

// JSON Schema (2020-12) of structs, by the field lists that bind.h reads them with.
namespace linkwright::study {

/// The dimension of the unit in the key of a field: nothing where an outer field holds the unit.
Dimension key_dimension(const Field& field);

/// The visitor that describes the members of a table. Members hold their defaults while they are visited.
class SchemaWriter {
 public:
  template <class T>
  void operator()(const Field& field, const T& member) {
    if constexpr (is_variant<T>) {
      choice(field, member, true);
    } else if constexpr (is_optional<T>) {
      if constexpr (is_variant<typename T::value_type>)
        choice(field, typename T::value_type{}, false);
      else
        property(field, of(field, member));
    } else {
      Value schema = of(field, member);
      if constexpr (!HasFields<T> && !HasOwnForm<T>) {
        if (!field.is_required) schema["default"] = ObjectWriter::to_value(member);
      }
      property(field, std::move(schema));
    }
  }

  /// A member that no field list holds: its key (with its units) gets the given schema.
  void property(const Field& field, Value schema);

  /// The table described so far; other keys are not allowed.
  Value finish() &&;

 private:
  /// Schema of one value.
  template <class T>
  static Value of(const Field& field, const T& member);
  static Value number(const Field& field, std::string_view type);
  static Value range(const Field& field);
  static Value words(std::span<const Word> words);
  static Value array(Value items, std::size_t count);

  /// `has_default`: without the key, `member` holds; else the whole choice may be absent.
  template <class... Options>
  void choice(const Field& field, const std::variant<Options...>& member, bool has_default);
  /// `chosen`: the option holds where the key is absent.
  void alternative(const Field& field, const Word& word, SchemaWriter options, bool chosen,
                   Value::Array& alternatives);

  Value properties_ = Value::object();
  Value patterns_ = Value::object();
  Value::Array required_;
  Value::Array one_of_units_;
  std::vector<Value::Array> choices_;  // options of each choice
};

/// Schema of a table that is read by the field list of T.
template <HasFields T>
Value schema_fields() {
  SchemaWriter writer;
  T defaults{};
  fields(writer, defaults);
  return std::move(writer).finish();
}

/// Schema of an array of what `items` describes.
Value schema_array(Value items);
/// Schema of any number.
Value schema_number();
/// Schema of a value that may be any of these.
Value schema_any_of(Value::Array alternatives);

// ---------------------------------------------------------------------------------------------------------------

template <class T>
Value SchemaWriter::of(const Field& field, const T& member) {
  if constexpr (HasOwnForm<T>) {
    return schema_value(field, member);
  } else if constexpr (is_optional<T>) {
    return of(field, typename T::value_type{});
  } else if constexpr (std::is_same_v<T, bool>) {
    Value schema;
    schema["type"] = "boolean";
    return schema;
  } else if constexpr (std::is_same_v<T, std::string>) {
    Value schema;
    schema["type"] = "string";
    return schema;
  } else if constexpr (std::is_same_v<T, Range>) {
    return range(field);
  } else if constexpr (std::is_arithmetic_v<T>) {
    return number(field, std::is_integral_v<T> ? "integer" : "number");
  } else if constexpr (HasNames<T>) {
    return words(words_of<T>());
  } else if constexpr (is_number_array<T>) {
    return array(number(field, "number"), member.size());
  } else if constexpr (is_named<T>) {
    Value schema;
    schema["type"] = "object";
    schema["additionalProperties"] = of(field, typename T::value_type::second_type{});
    return schema;
  } else if constexpr (is_vector<T>) {
    return array(of(field, typename T::value_type{}), 0);
  } else {
    return schema_fields<T>();
  }
}

template <class... Options>
void SchemaWriter::choice(const Field& field, const std::variant<Options...>& member, bool has_default) {
  Value::Array alternatives;
  const auto add = [&](auto options) {
    SchemaWriter writer;
    const Word word = choice_word(options);
    fields(writer, options);
    const bool chosen =
        has_default && !field.is_required && std::holds_alternative<decltype(options)>(member);
    alternative(field, word, std::move(writer), chosen, alternatives);
  };
  (add(Options{}), ...);
  if (!has_default && !field.is_required) {
    Value absent;
    absent["not"]["required"].push_back(Value(field.key));
    alternatives.push_back(std::move(absent));
  }
  choices_.push_back(std::move(alternatives));
  Value schema;
  schema["type"] = "string";
  if (has_default && !field.is_required)
    schema["default"] =
        std::visit([](const auto& options) { return Value(choice_word(options).name); }, member);
  property(field, std::move(schema));
}

}  // namespace linkwright::study
