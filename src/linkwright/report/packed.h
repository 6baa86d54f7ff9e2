// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

/// The small form in which a report carries its data. The viewer unpacks it (web/src/packed.ts).
namespace linkwright::report {

/// RFC 1951 without header, in base64: for a DecompressionStream("deflate-raw").
std::string packed(std::string_view bytes);

/// Takes long lists of numbers out of JSON texts and keeps them as bytes that compress well: whole
/// multiples of a power of ten in four bytes where that gives the same numbers, else doubles in eight; of
/// both the differences of the order, 0 to 4, that leaves the least. Nothing is rounded.
class NumberPack {
 public:
  /// The text with each list of at least `shortest` numbers or nulls replaced by {"":i}, where i counts the
  /// different lists; `separator` separates the numbers. A list that to_json() would not write in the
  /// same way, such as one of integers, stays.
  std::string take(std::string_view json, std::string_view separator);

  /// JSON: [count, order of differences, decimals] of each list; null decimals = doubles.
  const std::string& index() const { return index_; }
  /// The bytes of the lists: of each list the first byte of every number, then the second ...; lowest bytes
  /// first. Differences are 2 d or, below zero, -2 d - 1.
  const std::string& bytes() const { return bytes_; }

  static constexpr std::size_t shortest = 8;

 private:
  std::size_t add(const std::vector<double>& numbers);

  std::map<std::vector<std::uint64_t>, std::size_t> known_;  ///< lists by their bits
  std::string index_ = "[]";
  std::string bytes_;
};

}  // namespace linkwright::report
