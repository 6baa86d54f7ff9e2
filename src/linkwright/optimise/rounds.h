// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <coroutine>
#include <cstddef>
#include <utility>

namespace linkwright::optimise {

/// The endless loop of a method whose moves follow from one another, written down as published and suspended
/// wherever candidates are to be evaluated:
///
///     Rounds rounds() {
///       for (;;) {      // generations
///         ...
///         co_yield 1;   // one candidate is made; what follows has its answer
///         ...
///         co_yield generation_over;
///       }
///     }
///
/// Nothing may outlive a generation but members of the optimiser: a state restored between two generations
/// then needs no other place to continue from.
class Rounds {
 public:
  static constexpr std::size_t generation_over = 0;

  struct promise_type {
    std::size_t candidates = 0;

    Rounds get_return_object() { return Rounds(Handle::from_promise(*this)); }
    std::suspend_always initial_suspend() const noexcept { return {}; }
    std::suspend_always final_suspend() const noexcept { return {}; }
    std::suspend_always yield_value(std::size_t n) noexcept {
      candidates = n;
      return {};
    }
    void return_void() const noexcept {}
    void unhandled_exception() { throw; }
  };

  Rounds() = default;
  Rounds(Rounds&& other) noexcept : handle_(std::exchange(other.handle_, {})) {}
  Rounds& operator=(Rounds&& other) noexcept {
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Rounds() {
    if (handle_) handle_.destroy();
  }

  /// Continues to the next evaluation: the number of candidates made, or generation_over.
  std::size_t next() {
    handle_.resume();
    return handle_.promise().candidates;
  }

 private:
  using Handle = std::coroutine_handle<promise_type>;
  explicit Rounds(Handle handle) : handle_(handle) {}

  Handle handle_;
};

}  // namespace linkwright::optimise
