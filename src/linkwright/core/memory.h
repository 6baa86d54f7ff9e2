// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace linkwright {

/// Memory that what one study asks for may take (bytes): half of what the machine has, or the megabytes (1e6)
/// that the environment variable LINKWRIGHT_MEMORY_MB gives, or what `MemoryLimit` has set.
double memory_limit();

/// Says why `bytes` are too many for `what` ("1000000000 nodes"), with both numbers; nothing when they are
/// not. A reader of studies says it at the key that makes the size, before anything is allocated.
std::optional<std::string> memory_problem(double bytes, std::string_view what);

/// The other remedy besides asking for less; behind a hint.
inline constexpr std::string_view memory_hint =
    "or allow more with the environment variable LINKWRIGHT_MEMORY_MB";

/// A size in words: "1.5 GB", "640 MB", "12 kB", powers of ten.
std::string byte_text(double bytes);

/// Another limit while it lives, for tests and for programs that know better; one at a time, and not while
/// another thread reads studies.
class MemoryLimit {
 public:
  explicit MemoryLimit(double bytes);
  ~MemoryLimit();
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  double before_;
};

}  // namespace linkwright
