// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// What libc++ 13, which comes with Debian's emscripten, lacks of C++20 and this project uses; included before
// every source.
#include <charconv>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <type_traits>

namespace std {

template <class To, class From>
requires(sizeof(To) == sizeof(From) && is_trivially_copyable_v<To> &&
         is_trivially_copyable_v<From>) constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}

/// A number as the standard's from_chars reads it: no space, no "+", no "0x" before it; the point is ".". The
/// C library of WebAssembly has but the one locale, so strtod rounds the same text to the same double.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  const auto digits = [&](const char* at) {
    while (at != last && *at >= '0' && *at <= '9') ++at;
    return at;
  };
  const char* at = first;
  if (at != last && *at == '-') ++at;
  const auto word = [&](const char* name) {
    const char* p = at;
    for (; *name != '\0'; ++name, ++p)
      if (p == last || (*p | 0x20) != *name) return at;
    return p;
  };
  const char* stop = at;
  if (const char* whole = word("infinity"); whole != at) {
    stop = whole;
  } else if (const char* three = word("inf"); three != at) {
    stop = three;
  } else if (const char* none = word("nan"); none != at) {
    stop = none;
  } else {
    const char* after = digits(at);
    bool some = after != at;
    stop = after;
    if (after != last && *after == '.') {
      const char* fraction = digits(after + 1);
      some = some || fraction != after + 1;
      stop = fraction;
    }
    if (!some) return {first, errc::invalid_argument};
    if (stop != last && (*stop | 0x20) == 'e') {
      const char* power = stop + 1;
      if (power != last && (*power == '-' || *power == '+')) ++power;
      if (const char* end = digits(power); end != power) stop = end;
    }
  }
  // strtod wants an end, which a view of a text does not have.
  char near[64];
  const auto length = static_cast<size_t>(stop - first);
  char* copy = length < sizeof near ? near : static_cast<char*>(malloc(length + 1));
  if (copy == nullptr) return {first, errc::not_enough_memory};
  memcpy(copy, first, length);
  copy[length] = '\0';
  const double read = strtod(copy, nullptr);
  if (copy != near) free(copy);
  const bool named = (*at | 0x20) == 'i' || (*at | 0x20) == 'n';
  if (!named && (read > 1.7976931348623157e308 || read < -1.7976931348623157e308))
    return {stop, errc::result_out_of_range};
  value = read;
  return {stop, errc{}};
}

}  // namespace std
