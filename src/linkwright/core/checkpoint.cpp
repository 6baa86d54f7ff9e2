// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/checkpoint.h"

#include <fmt/core.h>

#include <bit>
#include <charconv>

namespace linkwright {
namespace {

constexpr std::size_t digits = 16;  // hexadecimal digits of a double

}  // namespace

Value pack_numbers(std::span<const double> numbers) {
  constexpr std::string_view hexadecimal = "0123456789abcdef";
  std::string text;
  text.reserve(digits * numbers.size());
  for (const double number : numbers) {
    const auto bits = std::bit_cast<std::uint64_t>(number);
    for (int shift = 60; shift >= 0; shift -= 4) text += hexadecimal[(bits >> shift) & 0xF];
  }
  return Value(std::move(text));
}

std::vector<double> unpack_numbers(const Value& value, std::string_view what) {
  if (!value.is_string())
    throw CheckpointError(fmt::format("{}: expected packed numbers, found {}", what, value.type_name()));
  const std::string& text = value.as_string();
  if (text.size() % digits != 0)
    throw CheckpointError(
        fmt::format("{}: packed numbers have {} digits, must be {} each", what, text.size(), digits));
  std::vector<double> numbers;
  numbers.reserve(text.size() / digits);
  for (const char* at = text.data(); at != text.data() + text.size(); at += digits) {
    std::uint64_t bits = 0;
    const auto [end, error] = std::from_chars(at, at + digits, bits, 16);
    if (error != std::errc() || end != at + digits)
      throw CheckpointError(fmt::format("{}: packed number {} is not hexadecimal", what, numbers.size()));
    numbers.push_back(std::bit_cast<double>(bits));
  }
  return numbers;
}

const Value& load_member(const Value& table, std::string_view key, std::string_view what) {
  const Value* member = table.find(key);
  if (!member) throw CheckpointError(fmt::format("{}: has no '{}'", what, key));
  return *member;
}

std::int64_t load_integer(const Value& table, std::string_view key, std::int64_t least, std::int64_t most,
                          std::string_view what) {
  const Value& member = load_member(table, key, what);
  if (!member.is_integer() || member.as_integer() < least || member.as_integer() > most)
    throw CheckpointError(fmt::format("{}: '{}' is not an integer from {} to {}", what, key, least, most));
  return member.as_integer();
}

}  // namespace linkwright
