// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/shared_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cmath>
#include <utility>

namespace linkwright::app {
namespace {

// The first letter of a message says what it is.
constexpr char begin_message = 'b';   // from rank 0: the text of its checkpoint
constexpr char ask_message = 'a';     // to rank 0: "<count> <pieces at least> <loop>"
constexpr char pieces_message = 'p';  // from rank 0: "<first> <last>", the last one excluded
constexpr char keep_message = 'k';    // to rank 0: a line of the checkpoint
constexpr char end_message = 'e';     // either way: no more is done

/// Ranks are given a part of what is left at a time: few messages first, and no long wait for one at the end.
constexpr std::size_t shares = 4;

/// A share of the first loop of a run that begins at once: rank 1 has the first pieces, rank 2 the next ones
/// and so on, and the rest is handed out.
std::size_t share_beforehand(std::size_t count, int ranks) {
  const auto all = static_cast<std::size_t>(ranks);
  return count < all ? 0 : std::max<std::size_t>(1, count / (shares * all));
}

/// The pieces given to a rank last at least this long, and the next are asked for this long before they are
/// needed: an answer takes some milliseconds where all processors are at work.
constexpr std::chrono::duration<double> answer_time(0.02);

/// The longest wait for a rank that has been ordered to end: one that hangs must not hold up the result.
constexpr std::chrono::seconds longest_wait(20);

std::string message_of(char what, std::string_view text = {}) { return std::string(1, what).append(text); }

/// Two numbers, or one and a text, with a blank between.
std::size_t number_before_blank(std::string_view& text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  text.remove_prefix(std::min(text.size(), static_cast<std::size_t>(end - text.data()) + 1));
  return error == std::errc() ? number : 0;
}

}  // namespace

void end_others(Ranks& ranks) {
  for (int other = 1; other < ranks.count(); ++other) ranks.send(other, message_of(end_message));
}

LeadingRank::LeadingRank(Ranks& ranks, CheckpointFile& kept, const CheckpointOwner& owner, RanksBegin begin,
                         RunContext& context)
    : ranks_(ranks),
      kept_(kept),
      context_(context),
      begin_(begin),
      at_work_(static_cast<std::size_t>(ranks.count()), true) {
  at_work_[0] = false;
  CheckpointLines lines;
  for (const std::string& name : kept_.names()) lines.emplace(name, checkpoint_line(name, kept_.find(name)));
  const std::string text = checkpoint_text(owner, lines);
  ranks_.set_receiver([this](int from, std::string_view message) { receive(from, message); });
  for (int other = 1; other < ranks_.count(); ++other) ranks_.send(other, message_of(begin_message, text));
  watch_ = std::thread([this] {
    std::unique_lock lock(mutex_);
    while (!leaving_ && !context_.interrupted()) changes_.wait_for(lock, std::chrono::milliseconds(20));
    stopping_ = true;
    end_others(ranks_);
  });
}

LeadingRank::~LeadingRank() {
  {
    const std::lock_guard lock(mutex_);
    leaving_ = true;
  }
  changes_.notify_all();
  watch_.join();
  wait_for_others();
  ranks_.set_receiver({});
}

std::size_t& LeadingRank::next_of(std::string_view loop, std::size_t count) {
  const bool first = next_.empty();
  const auto [entry, added] = next_.try_emplace(std::string(loop), 0);
  if (first && begin_ == RanksBegin::at_once)
    entry->second = share_beforehand(count, ranks_.count()) * (at_work_.size() - 1);
  return entry->second;
}

void LeadingRank::receive(int from, std::string_view message) {
  const auto sender = static_cast<std::size_t>(from);
  if (message.empty() || sender >= at_work_.size()) return;
  std::string_view text = message.substr(1);
  switch (message.front()) {
    case ask_message: {
      const std::size_t count = number_before_blank(text), least = number_before_blank(text);
      const std::lock_guard lock(mutex_);
      std::size_t& next = next_of(text, count);
      const std::size_t first = std::min(next, count), left = count - first, ranks = at_work_.size();
      // In the end an even share, so that all are done at one time.
      const std::size_t share = std::max(left / (shares * ranks), std::min(least, left / ranks));
      next = std::min(first + std::max<std::size_t>(1, share), count);
      ranks_.send(from, message_of(pieces_message, fmt::format("{} {}", first, next)));
      return;
    }
    case keep_message:
      if (const auto [name, value] = checkpoint_entry(text); !name.empty()) kept_.keep(name, value);
      return;
    case end_message: {
      const std::lock_guard lock(mutex_);
      at_work_[sender] = false;
      changes_.notify_all();
      return;
    }
    default:
      return;
  }
}

std::size_t LeadingRank::own_piece(std::string_view loop, std::size_t from, std::size_t count) {
  const std::lock_guard lock(mutex_);
  std::size_t& next = next_of(loop, count);
  next = std::max(next, from);
  return next < count ? next++ : count;
}

void LeadingRank::wait_for_others() {
  std::unique_lock lock(mutex_);
  const auto ended = [&] { return std::none_of(at_work_.begin(), at_work_.end(), [](bool b) { return b; }); };
  while (!stopping_ && !ended()) changes_.wait_for(lock, std::chrono::milliseconds(20));
  changes_.wait_for(lock, longest_wait, ended);
}

void LeadingRank::rejoin(std::string_view) { wait_for_others(); }

FollowingRank::FollowingRank(Ranks& ranks, const CheckpointOwner& owner, RanksBegin begin,
                             RunContext& context)
    : ranks_(ranks), owner_(owner), begin_(begin), context_(context) {
  ranks_.set_receiver([this](int, std::string_view message) { receive(message); });
}

Diagnostics FollowingRank::finish() {
  std::unique_lock lock(mutex_);
  changes_.wait(lock, [&] { return begun_ || ended_; });
  if (std::exchange(finished_, true)) return problems_;
  lock.unlock();
  ranks_.send(0, message_of(end_message));
  ranks_.set_receiver({});  // waits for what is being received
  return problems_;
}

void FollowingRank::receive(std::string_view message) {
  if (message.empty()) return;
  std::string_view text = message.substr(1);
  const std::lock_guard lock(mutex_);
  switch (message.front()) {
    case begin_message:
      take_up(text);
      break;
    case pieces_message:
      answer_.first = number_before_blank(text);
      answer_.last = number_before_blank(text);
      asking_ = Asking::answered;
      break;
    case end_message:
      ended_ = true;
      context_.cancel();
      break;
    default:
      break;
  }
  changes_.notify_all();
}

bool FollowingRank::begin() {
  std::unique_lock lock(mutex_);
  if (begin_ == RanksBegin::with_what_was_kept) changes_.wait(lock, [&] { return begun_ || ended_; });
  return !ended_;
}

void FollowingRank::take_up(std::string_view kept) {
  auto lines = read_checkpoint(kept, owner_, "what rank 0 has sent", problems_);
  begun_ = lines.has_value();
  if (begun_) {
    if (begin_ == RanksBegin::with_what_was_kept) lines_ = std::move(*lines);
    for (std::string& line : unsent_) ranks_.send(0, std::move(line));
  } else {
    ended_ = true;
    context_.cancel();
  }
  unsent_.clear();
}

Value FollowingRank::find(std::string_view name) const {
  const auto found = lines_.find(name);
  return found == lines_.end() ? Value() : checkpoint_value(found->second);
}

void FollowingRank::keep(std::string_view name, const Value& value) {
  std::string line = message_of(keep_message, checkpoint_line(name, value));
  const std::lock_guard lock(mutex_);
  if (begun_)
    ranks_.send(0, std::move(line), Urgency::can_wait);
  else if (!ended_)
    unsent_.push_back(std::move(line));
}

std::size_t FollowingRank::own_piece(std::string_view loop, std::size_t from, std::size_t count) {
  std::unique_lock lock(mutex_);
  if (!std::exchange(at_work_, true) && begin_ == RanksBegin::at_once) {
    const std::size_t share = share_beforehand(count, ranks_.count());
    own_.last = share * static_cast<std::size_t>(ranks_.rank());
    own_.first = own_.last - share;
  }
  const auto now = std::chrono::steady_clock::now();
  if (given_ == 0) began_ = now;
  const std::chrono::duration<double> piece = (now - began_) / std::max(given_, 1.0);
  const auto ask = [&] {
    if (asking_ != Asking::no) return;
    asking_ = Asking::asked;
    const double least =
        given_ > 0 ? std::min(std::ceil(answer_time / piece), static_cast<double>(count)) : 1;
    ranks_.send(
        0, message_of(ask_message, fmt::format("{} {} {}", count, static_cast<std::size_t>(least), loop)));
  };
  own_.first = std::max(own_.first, from);
  if (own_.first >= own_.last && !ended_) {
    ask();
    changes_.wait(lock, [&] { return asking_ == Asking::answered || ended_; });
    asking_ = Asking::no;
    own_ = answer_;
  }
  if (ended_ || own_.first >= own_.last) return count;
  if (given_ > 0 && static_cast<double>(own_.last - own_.first) * piece < answer_time) ask();
  ++given_;
  return own_.first++;
}

}  // namespace linkwright::app
