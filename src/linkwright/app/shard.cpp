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

bool ShardCheckpoint::is_left_to_others(std::size_t index) const {
  if (!shard_.leaves(index)) return false;
  const std::lock_guard lock(mutex_);
  if (!std::exchange(leaves_some_, true) && leaves_) leaves_();
  return true;
}

}  // namespace linkwright::app
