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
  int line = 0;
  int column = 0;
};

/// A tree of plain data: what study files are read into and what results are written from. Objects keep the
/// order of their members. NaN is written as null.
class Value {
 public:
  using Array = std::vector<Value>;
  struct Member;
  using Object = std::vector<Member>;

  Value();
  Value(std::nullptr_t);
  Value(bool value);
  Value(int value);
  Value(std::int64_t value);
  Value(std::size_t value);
  Value(double value);
  Value(const char* value);
  Value(std::string_view value);
  Value(std::string value);
  Value(Array value);
  Value(Object value);
  Value(const std::vector<double>& values);
  ~Value();
  Value(const Value&);
  Value(Value&&) noexcept;
  Value& operator=(const Value&);
  Value& operator=(Value&&) noexcept;

  static Value array() { return Value(Array()); }
  static Value object();

  bool is_null() const { return std::holds_alternative<std::monostate>(data_); }
  bool is_bool() const { return std::holds_alternative<bool>(data_); }
  bool is_integer() const { return std::holds_alternative<std::int64_t>(data_); }
  bool is_number() const { return is_integer() || std::holds_alternative<double>(data_); }
  bool is_string() const { return std::holds_alternative<std::string>(data_); }
  bool is_array() const { return std::holds_alternative<Array>(data_); }
  bool is_object() const { return std::holds_alternative<Object>(data_); }
  /// "null", "boolean", "integer", "number", "string", "array" or "table".
  std::string_view type_name() const;

  /// Contents; each throws ContractError when the value is of another type.
  bool as_bool() const;
  std::int64_t as_integer() const;
  double as_number() const;
  const std::string& as_string() const;
  const Array& as_array() const;
  Array& as_array();
  const Object& as_object() const;
  Object& as_object();

  /// Member of an object, nullptr when this is no object or has no such member.
  const Value* find(std::string_view key) const;
  Value* find(std::string_view key);
  /// Member of an object, made if absent; a null value becomes an object.
  Value& operator[](std::string_view key);
  /// Appends to an array; a null value becomes an array.
  void push_back(Value value);

  Position position;                                       ///< position of the value itself
  friend bool operator==(const Value& a, const Value& b);  ///< data only, positions do not count

 private:
  std::variant<std::monostate, bool, std::int64_t, double, std::string, Array, Object> data_;
};

struct Value::Member {
  std::string key;
  Value value;
  Position key_position = {};
  friend bool operator==(const Member& a, const Member& b) { return a.key == b.key && a.value == b.value; }
};

}  // namespace linkwright
