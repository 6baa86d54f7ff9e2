// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/looks.h"

#include <atomic>

#include "linkwright/core/check.h"

namespace linkwright {
namespace {

std::atomic<bool> counting{false};
std::atomic<std::int64_t> left{0};

}  // namespace

LooksAllowed::LooksAllowed(std::int64_t looks) : allowed_(looks) {
  LINKWRIGHT_REQUIRE(looks >= 0, "{} looks", looks);
  LINKWRIGHT_REQUIRE(!counting.load(), "looks are being counted already");
  left.store(looks);
  counting.store(true);
}

LooksAllowed::~LooksAllowed() { counting.store(false); }

std::int64_t LooksAllowed::made() const { return allowed_ - left.load(); }

Status counted_look(Status status) noexcept {
  // Without a test this is one read of what nobody writes.
  if (!counting.load(std::memory_order_relaxed)) return status;
  return left.fetch_sub(1, std::memory_order_relaxed) > 0 ? status : Status::cancelled;
}

}  // namespace linkwright
