// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>

namespace linkwright {

/// Memory that is used again and again and is not filled before: whoever writes it a block at a time touches
/// each page once. Numbers that nobody wrote are undefined.
template <class T>
class UnfilledArray {
 public:
  /// Makes room; what was written before is lost if there was too little.
  ///
  /// @param count number of elements
  /// @returns the first element
  T* make_room(std::size_t count) {
    if (size_ < count) {
      elements_.reset();  // before the new memory is asked for: never both
      size_ = 0;
      elements_.reset(new T[count]);
      size_ = count;
    }
    return elements_.get();
  }
  /// @returns the first element; null before there was room
  T* data() { return elements_.get(); }
  /// @returns the first element; null before there was room
  const T* data() const { return elements_.get(); }

 private:
  std::unique_ptr<T[]> elements_;
  std::size_t size_ = 0;
};

}  // namespace linkwright
