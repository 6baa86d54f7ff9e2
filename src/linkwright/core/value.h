// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace linkwright {

/// The position of a value in the text it was read from; line 0 = not from a text.
struct Position {
  int line = 0;    ///< counted from 1
  int column = 0;  ///< counted from 1, in characters
};

/// A tree of plain data: what study files are read into and what results are written from. Objects keep the
/// order of their members. NaN is written as null.
class Value {
 public:
  /// Values in their order.
  using Array = std::vector<Value>;
  struct Member;
  /// Members in their order.
  using Object = std::vector<Member>;

  /// A null value.
  Value();
  /// A null value.
  Value(std::nullptr_t);
  /// A boolean. @param value contents
  Value(bool value);
  /// An integer. @param value contents
  Value(int value);
  /// An integer. @param value contents
  Value(std::int64_t value);
  /// An integer, below 2^63. @param value contents
  Value(std::size_t value);
  /// A number; NaN is written as null. @param value contents
  Value(double value);
  /// A string, not null. @param value contents
  Value(const char* value);
  /// A string. @param value contents
  Value(std::string_view value);
  /// A string. @param value contents
  Value(std::string value);
  /// An array. @param value contents
  Value(Array value);
  /// An object. @param value contents
  Value(Object value);
  /// An array of numbers. @param values contents
  Value(const std::vector<double>& values);
  /// Frees the tree.
  ~Value();
  /// Copies the tree.
  Value(const Value&);
  /// Takes the tree.
  Value(Value&&) noexcept;
  /// Copies the tree. @returns this
  Value& operator=(const Value&);
  /// Takes the tree. @returns this
  Value& operator=(Value&&) noexcept;

  /// @returns an empty array
  static Value array() { return Value(Array()); }
  /// @returns an empty object
  static Value object();

  /// @returns true if this is null
  bool is_null() const { return std::holds_alternative<std::monostate>(data_); }
  /// @returns true if this is a boolean
  bool is_bool() const { return std::holds_alternative<bool>(data_); }
  /// @returns true if this is an integer
  bool is_integer() const { return std::holds_alternative<std::int64_t>(data_); }
  /// @returns true if this is a number, integers included
  bool is_number() const { return is_integer() || std::holds_alternative<double>(data_); }
  /// @returns true if this is a string
  bool is_string() const { return std::holds_alternative<std::string>(data_); }
  /// @returns true if this is an array
  bool is_array() const { return std::holds_alternative<Array>(data_); }
  /// @returns true if this is an object
  bool is_object() const { return std::holds_alternative<Object>(data_); }
  /// @returns "null", "boolean", "integer", "number", "string", "array" or "table"
  std::string_view type_name() const;

  /// @returns the boolean
  /// @throws ContractError if this is another type
  bool as_bool() const;
  /// @returns the integer
  /// @throws ContractError if this is another type, a number with a point included
  std::int64_t as_integer() const;
  /// @returns the number, of an integer too
  /// @throws ContractError if this is another type
  double as_number() const;
  /// @returns the string
  /// @throws ContractError if this is another type
  const std::string& as_string() const;
  /// @returns the items
  /// @throws ContractError if this is another type
  const Array& as_array() const;
  /// @returns the items, to be changed
  /// @throws ContractError if this is another type
  Array& as_array();
  /// @returns the members
  /// @throws ContractError if this is another type
  const Object& as_object() const;
  /// @returns the members, to be changed
  /// @throws ContractError if this is another type
  Object& as_object();

  /// @param key key of a member
  /// @returns its value; nullptr when this is no object or has no such member
  const Value* find(std::string_view key) const;
  /// @param key key of a member
  /// @returns its value, to be changed; nullptr when this is no object or has no such member
  Value* find(std::string_view key);
  /// A member of an object, which is made if it is absent; a null value becomes an object.
  /// @param key key of the member
  /// @returns its value, to be changed
  /// @throws ContractError if this is neither an object nor null
  Value& operator[](std::string_view key);
  /// Appends to an array; a null value becomes an array.
  /// @param value item to append
  /// @throws ContractError if this is neither an array nor null
  void push_back(Value value);

  Position position;  ///< position of the value itself
  /// @returns true if the data are equal; positions do not count, and an integer equals the same number
  friend bool operator==(const Value& a, const Value& b);

 private:
  std::variant<std::monostate, bool, std::int64_t, double, std::string, Array, Object> data_;
};

/// A key and its value.
struct Value::Member {
  std::string key;             ///< key as it is written, with its unit
  Value value;                 ///< its value
  Position key_position = {};  ///< position of the key
  /// @returns true if key and value are equal; positions do not count
  friend bool operator==(const Member& a, const Member& b) { return a.key == b.key && a.value == b.value; }
};

}  // namespace linkwright
