// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/value.h"

#include "linkwright/core/check.h"

namespace linkwright {

Value::Value() = default;
Value::Value(std::nullptr_t) {}
Value::Value(bool value) : data_(value) {}
Value::Value(int value) : data_(std::int64_t{value}) {}
Value::Value(std::int64_t value) : data_(value) {}
Value::Value(std::size_t value) : data_(static_cast<std::int64_t>(value)) {}
Value::Value(double value) : data_(value) {}
Value::Value(const char* value) : data_(std::string(value)) {}
Value::Value(std::string_view value) : data_(std::string(value)) {}
Value::Value(std::string value) : data_(std::move(value)) {}
Value::Value(Array value) : data_(std::move(value)) {}
Value::Value(Object value) : data_(std::move(value)) {}
Value::Value(const std::vector<double>& values) : data_(Array(values.begin(), values.end())) {}
Value::~Value() = default;
Value::Value(const Value&) = default;
Value::Value(Value&&) noexcept = default;
Value& Value::operator=(const Value&) = default;
Value& Value::operator=(Value&&) noexcept = default;

Value Value::object() { return Value(Object()); }

std::string_view Value::type_name() const {
  constexpr std::string_view names[] = {"null", "boolean", "integer", "number", "string", "array", "table"};
  return names[data_.index()];
}

bool Value::as_bool() const {
  LINKWRIGHT_REQUIRE(is_bool(), "expected a boolean, found {}", type_name());
  return std::get<bool>(data_);
}

std::int64_t Value::as_integer() const {
  LINKWRIGHT_REQUIRE(is_integer(), "expected an integer, found {}", type_name());
  return std::get<std::int64_t>(data_);
}

double Value::as_number() const {
  LINKWRIGHT_REQUIRE(is_number(), "expected a number, found {}", type_name());
  if (is_integer()) return static_cast<double>(std::get<std::int64_t>(data_));
  return std::get<double>(data_);
}

const std::string& Value::as_string() const {
  LINKWRIGHT_REQUIRE(is_string(), "expected a string, found {}", type_name());
  return std::get<std::string>(data_);
}

const Value::Array& Value::as_array() const {
  LINKWRIGHT_REQUIRE(is_array(), "expected an array, found {}", type_name());
  return std::get<Array>(data_);
}

Value::Array& Value::as_array() { return const_cast<Array&>(std::as_const(*this).as_array()); }

const Value::Object& Value::as_object() const {
  LINKWRIGHT_REQUIRE(is_object(), "expected a table, found {}", type_name());
  return std::get<Object>(data_);
}

Value::Object& Value::as_object() { return const_cast<Object&>(std::as_const(*this).as_object()); }

const Value* Value::find(std::string_view key) const {
  if (!is_object()) return nullptr;
  for (const Member& member : std::get<Object>(data_))
    if (member.key == key) return &member.value;
  return nullptr;
}

Value* Value::find(std::string_view key) { return const_cast<Value*>(std::as_const(*this).find(key)); }

Value& Value::operator[](std::string_view key) {
  if (is_null()) data_ = Object();
  if (Value* found = find(key)) return *found;
  Object& members = as_object();
  members.push_back({std::string(key), Value(), {}});
  return members.back().value;
}

void Value::push_back(Value value) {
  if (is_null()) data_ = Array();
  as_array().push_back(std::move(value));
}

bool operator==(const Value& a, const Value& b) {
  if (a.is_number() && b.is_number()) return a.as_number() == b.as_number();
  return a.data_ == b.data_;
}

}  // namespace linkwright
