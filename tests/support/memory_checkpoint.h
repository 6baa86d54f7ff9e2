// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "linkwright/core/checkpoint.h"

namespace linkwright::test {

/// Keeps everything; loops keep their state after every generation unless `pause` is set.
class MemoryCheckpoint final : public Checkpoint {
 public:
  Value find(std::string_view name) const override {
    const std::lock_guard lock(mutex);
    const auto found = entries.find(std::string(name));
    return found == entries.end() ? Value() : found->second;
  }
  void keep(std::string_view name, const Value& value) override {
    const std::lock_guard lock(mutex);
    const std::string below = std::string(name) + "/";
    std::erase_if(entries, [&](const auto& entry) { return entry.first.starts_with(below); });
    entries[std::string(name)] = value;
    if (kept) kept(name);
  }
  std::chrono::duration<double> interval() const override { return pause; }

  std::chrono::duration<double> pause{};
  std::map<std::string, Value> entries;
  std::function<void(std::string_view name)> kept;  ///< called after each keep
  mutable std::mutex mutex;
};

}  // namespace linkwright::test
