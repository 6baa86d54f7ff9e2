// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/shard.h"

#include <optional>
#include <utility>

namespace linkwright::app {

bool ShardCheckpoint::take(std::string_view text, Diagnostics& diagnostics) {
  auto lines = read_checkpoint(text, owner_, "what another run has kept", diagnostics);
  if (!lines) return false;
  const std::lock_guard lock(mutex_);
  // Later states of a piece replace earlier ones.
  for (auto& [name, line] : *lines) lines_.insert_or_assign(name, std::move(line));
  return true;
}

Value ShardCheckpoint::find(std::string_view name) const {
  const std::lock_guard lock(mutex_);
  const auto found = lines_.find(name);
  return found == lines_.end() ? Value() : checkpoint_value(found->second);
}

void ShardCheckpoint::keep(std::string_view name, const Value& value) {
  std::string line = checkpoint_line(name, value);
  const std::lock_guard lock(mutex_);
  if (hand_on_) hand_on_(checkpoint_text(owner_, {{std::string(name), line}}));
  lines_.insert_or_assign(std::string(name), std::move(line));
}

std::size_t ShardCheckpoint::own_piece(std::string_view, std::size_t from, std::size_t count) {
  if (shard_.count > 1 && count > 1) {
    const std::lock_guard lock(mutex_);
    if (!std::exchange(leaves_some_, true) && leaves_) leaves_();
  }
  return shard_.own_piece(from, count);
}

void ShardCheckpoint::rejoin(std::string_view) {
  if (shard_.count > 1) throw LeftToOthers();
}

}  // namespace linkwright::app
