// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/app/shared_run.h"

#include <fmt/core.h>
#include <gmock/gmock.h>

#include <atomic>
#include <deque>
#include <filesystem>
#include <memory>
#include <numeric>
#include <set>

#include "linkwright/optimise/pieces.h"
#include "support/message.h"

namespace linkwright::app {
namespace {

using ::testing::HasSubstr;

/// Ranks in one process.
class Post {
 public:
  explicit Post(int count) : boxes_(static_cast<std::size_t>(count)) {}
  std::unique_ptr<Ranks> join(int rank) { return std::make_unique<Member>(*this, rank); }

 private:
  struct Box {
    std::mutex mutex;
    std::condition_variable_any changes;
    std::deque<std::pair<int, std::string>> messages;
  };
  class Member final : public Ranks {
   public:
    Member(Post& post, int rank) : post_(post), rank_(rank) {
      thread_ = std::jthread([this](const std::stop_token& stop) { deliver(stop); });
    }
    int rank() const override { return rank_; }
    int count() const override { return static_cast<int>(post_.boxes_.size()); }
    void send(int to, std::string message, Urgency) override {
      Box& box = post_.boxes_[static_cast<std::size_t>(to)];
      const std::lock_guard lock(box.mutex);
      box.messages.emplace_back(rank_, std::move(message));
      box.changes.notify_all();
    }
    void set_receiver(std::function<void(int, std::string_view)> receive) override {
      Box& box = own();
      {
        const std::lock_guard one(receiving_);
        const std::lock_guard lock(box.mutex);
        known_ = true;
        receive_ = std::move(receive);
      }
      box.changes.notify_all();
    }
    void leave() override {}

   private:
    Box& own() { return post_.boxes_[static_cast<std::size_t>(rank_)]; }
    void deliver(const std::stop_token& stop) {
      Box& box = own();
      while (true) {
        std::pair<int, std::string> message;
        {
          std::unique_lock lock(box.mutex);
          if (!box.changes.wait(lock, stop, [&] { return known_ && !box.messages.empty(); })) return;
          message = std::move(box.messages.front());
          box.messages.pop_front();
        }
        const std::lock_guard lock(receiving_);
        if (receive_) receive_(message.first, message.second);
      }
    }
    Post& post_;
    const int rank_;
    std::mutex receiving_;
    bool known_ = false;
    std::function<void(int, std::string_view)> receive_;
    std::jthread thread_;
  };
  std::deque<Box> boxes_;
};

constexpr std::size_t most = 200;
constexpr auto at_once = RanksBegin::at_once;
constexpr auto with_what_was_kept = RanksBegin::with_what_was_kept;
const CheckpointOwner one_study = {"linkwright 9.8.7", std::string(64, 'a')};

/// A loop over squares, and which rank has done each of them.
struct Squares {
  explicit Squares(std::size_t count = most) : values(count, -1.0) {}
  void run(RunContext& context, int rank, std::chrono::microseconds work = {}) {
    optimise::for_each_piece(
        values.size(), context, "squares", [](std::size_t i) { return "piece " + std::to_string(i); },
        [&](std::size_t i) {
          std::this_thread::sleep_for(work);
          std::unique_lock lock(mutex);
          ranks.insert(rank);
          ++done;
          arrived.notify_all();
          arrived.wait(lock, [&] { return ranks.size() >= awaited; });
          lock.unlock();
          return values[i] = static_cast<double>(i * i);
        },
        [&](std::size_t i) { return context.interrupted() ? Value() : Value(values[i]); },
        [&](std::size_t i, const Value& value) { return values[i] = value.as_number(); });
  }
  bool complete() const {
    for (std::size_t i = 0; i < values.size(); ++i)
      if (values[i] != static_cast<double>(i * i)) return false;
    return true;
  }
  std::vector<double> values;
  static inline std::mutex mutex;
  static inline std::condition_variable arrived;
  static inline std::set<int> ranks;
  static inline std::size_t awaited = 0;  // ranks that each piece waits for
  static inline int done = 0;
};

class SharedLoop : public ::testing::Test {
 protected:
  SharedLoop() {
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    Squares::ranks.clear();
    Squares::done = 0;
    Squares::awaited = 0;
  }
  ~SharedLoop() override { std::filesystem::remove_all(folder_); }

  /// The other ranks, each a thread that does what follow() of the program does.
  std::vector<std::jthread> others(Post& post, int count, RanksBegin begin, std::size_t pieces = most,
                                   std::chrono::microseconds work = {}, CheckpointOwner of = one_study) {
    std::vector<std::jthread> all;
    for (int rank = 1; rank < count; ++rank)
      all.emplace_back([&post, this, rank, begin, pieces, work, of] {
        const auto ranks = post.join(rank);
        RunContext context;
        context.set_threads(1);
        FollowingRank kept(*ranks, of, begin, context);
        if (kept.begin()) {
          context.set_checkpoint(&kept);
          Squares squares(pieces);
          try {
            squares.run(context, rank, work);
          } catch (const LeftToOthers&) {
            ++left_;
          }
        }
        const Diagnostics problems = kept.finish();
        const std::lock_guard lock(Squares::mutex);
        refused_ += test::lines_of(problems);
      });
    return all;
  }

  std::filesystem::path folder_ = std::filesystem::path(::testing::TempDir()) /
                                  ::testing::UnitTest::GetInstance()->current_test_info()->name();
  std::atomic<int> left_ = 0;
  std::string refused_;
};

TEST_F(SharedLoop, RankZeroHasWhatAllHaveDone) {
  for (const auto& [count, begin] : std::vector<std::pair<int, RanksBegin>>{{1, at_once},
                                                                            {2, at_once},
                                                                            {5, at_once},
                                                                            {1, with_what_was_kept},
                                                                            {2, with_what_was_kept},
                                                                            {5, with_what_was_kept}}) {
    SCOPED_TRACE(fmt::format("{} ranks, {}", count, begin == at_once ? "at once" : "with what was kept"));
    Squares::ranks.clear();
    Squares::done = 0;
    Squares::awaited = static_cast<std::size_t>(count);
    left_ = 0;
    Post post(count);
    auto threads = others(post, count, begin);
    const auto ranks = post.join(0);
    RunContext context;
    context.set_threads(2);
    CheckpointFile file(folder_ / (fmt::format("kept-{}-{}", count, static_cast<int>(begin))), one_study);
    Squares squares;
    {
      LeadingRank leading(*ranks, file, one_study, begin, context);
      context.set_checkpoint(&leading);
      squares.run(context, 0);
    }
    threads.clear();
    EXPECT_TRUE(squares.complete());
    EXPECT_EQ(Squares::done, static_cast<int>(most));  // each once
    EXPECT_EQ(Squares::ranks.size(), static_cast<std::size_t>(count));
    EXPECT_EQ(left_, count - 1);
    EXPECT_EQ(file.size(), most);
  }
}

TEST_F(SharedLoop, TakesUpWhatWasKept) {
  Post post(3);
  CheckpointFile file(folder_ / "kept", one_study);
  for (std::size_t i = 0; i < most; i += 2)
    file.keep("piece " + std::to_string(i), Value(static_cast<double>(i * i)));
  auto threads = others(post, 3, with_what_was_kept);
  const auto ranks = post.join(0);
  RunContext context;
  Squares squares;
  {
    LeadingRank leading(*ranks, file, one_study, with_what_was_kept, context);
    context.set_checkpoint(&leading);
    squares.run(context, 0);
  }
  threads.clear();
  EXPECT_TRUE(squares.complete());
  EXPECT_EQ(Squares::done, static_cast<int>(most / 2));
}

TEST_F(SharedLoop, EndsTheOthersWhenItIsInterrupted) {
  Post post(3);
  CheckpointFile file(folder_ / "kept", one_study);
  auto threads = others(post, 3, with_what_was_kept, 1'000'000, std::chrono::milliseconds(1));
  const auto ranks = post.join(0);
  RunContext context;
  // The clock may not decide: a slow machine does no piece at all in a given time.
  std::jthread user([&context] {
    std::unique_lock lock(Squares::mutex);
    Squares::arrived.wait(lock, [] { return Squares::done >= 20; });
    context.cancel();
  });
  Squares squares(1'000'000);
  {
    LeadingRank leading(*ranks, file, one_study, with_what_was_kept, context);
    context.set_checkpoint(&leading);
    squares.run(context, 0, std::chrono::milliseconds(1));
  }
  threads.clear();
  EXPECT_EQ(context.interruption(), Status::cancelled);
  EXPECT_GE(Squares::done, 20);
  EXPECT_LT(Squares::done, 1'000'000);
}

TEST_F(SharedLoop, DoesWithoutARankThatHasAnotherStudy) {
  for (const RanksBegin begin : {at_once, with_what_was_kept}) {
    Squares::ranks.clear();
    Post post(2);
    CheckpointFile file(folder_ / fmt::format("kept-{}", static_cast<int>(begin)), one_study);
    auto threads = others(post, 2, begin, most, {}, {one_study.tool, std::string(64, 'b')});
    const auto ranks = post.join(0);
    RunContext context;
    Squares squares;
    {
      LeadingRank leading(*ranks, file, one_study, begin, context);
      context.set_checkpoint(&leading);
      squares.run(context, 0);
    }
    threads.clear();
    EXPECT_TRUE(squares.complete());
    EXPECT_EQ(file.size(), most);
    if (begin == with_what_was_kept) {
      EXPECT_EQ(Squares::ranks, std::set<int>{0});
    }
    EXPECT_THAT(refused_, HasSubstr("what rank 0 has sent: error: belongs to another study"));
    refused_.clear();
  }
}

TEST_F(SharedLoop, BeginsBeforeRankZeroIsHeardOf) {
  // 200 pieces, three ranks: a share is a quarter of 66.
  Post post(3);
  const auto second = post.join(2);
  RunContext other;
  FollowingRank kept(*second, one_study, at_once, other);
  ASSERT_TRUE(kept.begin());
  for (std::size_t i = 16; i < 32; ++i) {
    ASSERT_EQ(kept.own_piece("piece 0", 0, most), i);
    kept.keep(fmt::format("piece {}", i), Value(static_cast<double>(i * i)));
  }
  auto first = others(post, 2, at_once);
  std::jthread end([&] { EXPECT_TRUE(kept.finish().empty()); });
  const auto ranks = post.join(0);
  CheckpointFile file(folder_ / "kept", one_study);
  RunContext context;
  Squares squares;
  {
    LeadingRank leading(*ranks, file, one_study, at_once, context);
    end.join();
    context.set_checkpoint(&leading);
    squares.run(context, 0);
  }
  first.clear();
  EXPECT_TRUE(squares.complete());
  EXPECT_EQ(Squares::done, static_cast<int>(most - 16));
}

TEST_F(SharedLoop, DoesItselfWhatARankHasBegunAndNotEnded) {
  Post post(2);
  CheckpointFile file(folder_ / "kept", one_study);
  std::jthread other([&] {
    const auto ranks = post.join(1);
    RunContext context;
    FollowingRank kept(*ranks, one_study, with_what_was_kept, context);
    ASSERT_TRUE(kept.begin());
    EXPECT_LT(kept.own_piece("piece 0", 0, most), most);
    EXPECT_LT(kept.own_piece("piece 0", 0, most), most);
  });
  const auto ranks = post.join(0);
  RunContext context;
  Squares squares;
  {
    LeadingRank leading(*ranks, file, one_study, with_what_was_kept, context);
    other.join();
    context.set_checkpoint(&leading);
    squares.run(context, 0);
  }
  EXPECT_TRUE(squares.complete());
  EXPECT_EQ(Squares::done, static_cast<int>(most));
}

/// The messages that a rank has received, one message after the other.
class Received {
 public:
  explicit Received(Ranks& ranks) : ranks_(ranks) {
    ranks.set_receiver([this](int, std::string_view message) {
      const std::lock_guard lock(mutex_);
      messages_.emplace_back(message);
      changes_.notify_all();
    });
  }
  ~Received() { ranks_.set_receiver({}); }
  std::string next() {
    std::unique_lock lock(mutex_);
    changes_.wait(lock, [&] { return !messages_.empty(); });
    std::string message = std::move(messages_.front());
    messages_.pop_front();
    return message;
  }

 private:
  Ranks& ranks_;
  std::mutex mutex_;
  std::condition_variable changes_;
  std::deque<std::string> messages_;
};

TEST_F(SharedLoop, GivesAsManyPiecesAsAreAskedForAndAnEvenShareInTheEnd) {
  Post post(2);
  const auto ranks = post.join(0), other = post.join(1);
  Received received(*other);
  CheckpointFile file(folder_ / "kept", one_study);
  RunContext context;
  LeadingRank leading(*ranks, file, one_study, with_what_was_kept, context);
  EXPECT_EQ(received.next().front(), 'b');
  std::string given;
  for (int i = 0; i < 10; ++i) {
    other->send(0, "a100 30 piece 0");
    given += received.next() + ",";
  }
  EXPECT_EQ(given, "p0 30,p30 60,p60 80,p80 90,p90 95,p95 97,p97 98,p98 99,p99 100,p100 100,");
  // Pieces that last long enough are given in smaller shares.
  other->send(0, "a100 1 another");
  EXPECT_EQ(received.next(), "p0 12");
  other->send(0, "e");
}

TEST_F(SharedLoop, ShortPiecesAreAskedForBeforeTheyAreNeeded) {
  Post post(2);
  const auto ranks = post.join(0), other = post.join(1);
  Received received(*ranks);
  RunContext context;
  FollowingRank kept(*other, one_study, at_once, context);
  const auto begin = std::chrono::steady_clock::now();
  for (std::size_t i = 0; i < 25; ++i) ASSERT_EQ(kept.own_piece("piece 0", 0, most), i);  // its first share
  const auto last_given = std::chrono::steady_clock::now();
  // 24 pieces in less than 20 ms each: of a machine that is slower, this says nothing.
  if (last_given - begin < std::chrono::milliseconds(24 * 20)) {
    const std::string asked = received.next();
    EXPECT_TRUE(asked.starts_with("a200 ") && asked.ends_with(" piece 0")) << asked;
    EXPECT_NE(asked, "a200 1 piece 0");
    ranks->send(1, "p30 32");
    ASSERT_EQ(kept.own_piece("piece 0", 0, most), 30U);
    EXPECT_EQ(received.next().substr(0, 5), "a200 ");
    ranks->send(1, "p40 200");
    ASSERT_EQ(kept.own_piece("piece 0", 0, most), 31U);
    ASSERT_EQ(kept.own_piece("piece 0", 0, most), 40U);
  }
  ranks->send(1, checkpoint_text(one_study, {}).insert(0, "b"));
  EXPECT_TRUE(kept.finish().empty());
}

TEST_F(SharedLoop, ThatNeverBeginsEndsTheOthers) {
  Post post(3);
  auto threads = others(post, 3, with_what_was_kept);
  const auto ranks = post.join(0);
  end_others(*ranks);
  threads.clear();
  EXPECT_EQ(Squares::done, 0);
}

TEST_F(SharedLoop, IgnoresMessagesThatAreNone) {
  Post post(2);
  const auto other = post.join(1);
  for (const char* text :
       {"", "x", "a", "a 5", "ax piece", "k", "k{}", "k{\"name\":7,\"value\":1}", "k{\"name\":\"x\"}"})
    other->send(0, text);
  other->send(0, "e");
  const auto ranks = post.join(0);
  CheckpointFile file(folder_ / "kept", one_study);
  RunContext context;
  Squares squares;
  {
    LeadingRank leading(*ranks, file, one_study, with_what_was_kept, context);
    context.set_checkpoint(&leading);
    squares.run(context, 0);
  }
  EXPECT_TRUE(squares.complete());
  EXPECT_EQ(file.size(), most);
}

}  // namespace
}  // namespace linkwright::app
