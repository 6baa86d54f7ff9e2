// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <concepts>
#include <memory>
#include <type_traits>
#include <utility>

namespace linkwright::math {

template <class Signature>
class FunctionRef;

/// Refers to a callable without owning it: two pointers, no allocation. For parameters only; what it refers
/// to must live until the call has returned, which a lambda written in the argument list does.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
 public:
  /// Refers to a callable; implicit, so that a lambda is passed directly.
  /// @param callable function or object with a call operator, which must live until the last call
  template <class F>
  requires(!std::same_as<std::remove_cvref_t<F>, FunctionRef> &&
           std::is_invocable_r_v<Result, F&, Arguments...>)
      FunctionRef(F&& callable) {  // implicit on purpose: a lambda is passed directly
    using Callable = std::remove_reference_t<F>;
    if constexpr (std::is_function_v<Callable>) {
      target_.function = reinterpret_cast<void (*)()>(std::addressof(callable));
      call_ = [](Target target, Arguments... arguments) -> Result {
        return reinterpret_cast<Callable*>(target.function)(std::forward<Arguments>(arguments)...);
      };
    } else {
      target_.object = const_cast<void*>(static_cast<const void*>(std::addressof(callable)));
      call_ = [](Target target, Arguments... arguments) -> Result {
        return (*static_cast<Callable*>(target.object))(std::forward<Arguments>(arguments)...);
      };
    }
  }

  /// Calls what it refers to.
  /// @param arguments passed on
  /// @returns result of the call
  Result operator()(Arguments... arguments) const {
    return call_(target_, std::forward<Arguments>(arguments)...);
  }

 private:
  union Target {
    void* object;
    void (*function)();
  };
  Target target_;
  Result (*call_)(Target, Arguments...);
};

}  // namespace linkwright::math
