// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/memory.h"

#include <fmt/core.h>

#include <array>
#include <charconv>
#include <cstdlib>

#include "linkwright/core/check.h"
#include "linkwright/core/platform/machine.h"

namespace linkwright {
namespace {

constexpr double share = 0.5;          // share of the machine's memory that may be used
constexpr double where_unknown = 4e9;  // bytes, on a machine that does not say

double given = 0;  // by MemoryLimit; 0: none

// The limit that the environment gives; 0 when it gives none, or no usable number.
double from_environment() {
  const char* text = std::getenv("LINKWRIGHT_MEMORY_MB");
  if (!text) return 0;
  double megabytes = 0;
  const std::string_view whole(text);
  const auto [end, error] = std::from_chars(whole.data(), whole.data() + whole.size(), megabytes);
  const bool good = error == std::errc() && end == whole.data() + whole.size() && megabytes > 0;
  return good ? 1e6 * megabytes : 0;
}

double of_machine() {
  const double all = platform::memory();
  return all > 0 ? share * all : where_unknown;
}

}  // namespace

double memory_limit() {
  if (given > 0) return given;
  if (const double asked = from_environment(); asked > 0) return asked;
  static const double machine = of_machine();
  return machine;
}

std::string byte_text(double bytes) {
  struct Unit {
    double size;
    const char* name;
  };
  constexpr std::array units{Unit{1e15, "PB"}, Unit{1e12, "TB"}, Unit{1e9, "GB"}, Unit{1e6, "MB"},
                             Unit{1e3, "kB"}};
  for (const Unit& unit : units)
    if (bytes >= unit.size) return fmt::format("{:.3g} {}", bytes / unit.size, unit.name);
  return fmt::format("{:.0f} bytes", bytes);
}

std::optional<std::string> memory_problem(double bytes, std::string_view what) {
  const double limit = memory_limit();
  if (bytes <= limit) return std::nullopt;
  return fmt::format("{} would take {} of memory, at most {} may be taken", what, byte_text(bytes),
                     byte_text(limit));
}

MemoryLimit::MemoryLimit(double bytes) : before_(given) {
  LINKWRIGHT_REQUIRE(bytes > 0, "a limit of {} bytes", bytes);
  given = bytes;
}

MemoryLimit::~MemoryLimit() { given = before_; }

}  // namespace linkwright
