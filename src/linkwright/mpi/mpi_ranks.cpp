// SPDX-License-Identifier: BSD-3-Clause
#include <mpi.h>

#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <deque>
#include <functional>
#include <list>
#include <mutex>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include "linkwright/app/ranks.h"

// A plug-in, so that the program starts without MPI where it is not asked for. All calls of MPI come from one
// thread, which is all that any MPI allows; it sleeps between its looks, because waiting inside MPI takes a
// whole processor from the work.
namespace linkwright::mpi {
namespace {

// A look takes some 0.1 ms from the work on a virtual machine, most of it for the timer. Rank 0 is asked for
// pieces at any time; the others hear only what they have asked for, and that it is over.
constexpr std::chrono::microseconds shortest_sleep(50), longest_sleep_of_first(2000),
    longest_sleep_of_others(20000);

class MpiRanks final : public app::Ranks {
 public:
  MpiRanks(int rank, int count) : rank_(rank), count_(count), thread_([this] { serve(); }) {
    if (count > 0) return;
    std::unique_lock lock(mutex_);
    changes_.wait(lock, [&] { return joined_; });
  }

  ~MpiRanks() override {
    MpiRanks::leave();
    thread_.join();
  }

  int rank() const override { return rank_; }
  int count() const override { return count_; }

  void send(int to, std::string message, app::Urgency urgency) override {
    const std::lock_guard lock(mutex_);
    outgoing_.push_back({to, std::move(message), MPI_REQUEST_NULL});
    if (urgency == app::Urgency::at_once) wake();
  }

  void set_receiver(std::function<void(int, std::string_view)> receive) override {
    {
      const std::lock_guard lock(receiving_);
      receive_ = std::move(receive);
      drop_ = !receive_;
    }
    const std::lock_guard lock(mutex_);
    wake();
  }

  void leave() override {
    const std::lock_guard lock(mutex_);
    leaving_ = true;
    wake();
  }

 private:
  struct Message {
    int rank;
    std::string text;
    MPI_Request request;
  };

  void serve() {
    join();
    MPI_Request all_here = MPI_REQUEST_NULL;
    bool arrived = false;
    auto pause = shortest_sleep;
    while (true) {
      take_in();
      hand_over();
      send_on();
      if (!arrived && is_leaving() && being_sent_.empty()) {
        arrived = true;
        MPI_Ibarrier(MPI_COMM_WORLD, &all_here);
      }
      if (arrived) {
        int done = 0;
        MPI_Test(&all_here, &done, MPI_STATUS_IGNORE);
        if (done != 0) break;
      }
      pause = sleep(std::min(2 * pause, rank_ == 0 ? longest_sleep_of_first : longest_sleep_of_others));
    }
    MPI_Finalize();
  }

  /// Until it is woken, or so long; returns how long it sleeps the next time.
  std::chrono::microseconds sleep(std::chrono::microseconds longest) {
    std::unique_lock lock(mutex_);
    changes_.wait_for(lock, longest, [&] { return woken_; });
    return std::exchange(woken_, false) ? shortest_sleep : longest;
  }

  /// Call with the lock held: urgent messages are handled at once, and answers are polled often.
  void wake() {
    woken_ = true;
    changes_.notify_all();
  }

  void join() {
    int given = 0, rank = 0, count = 1;
    // An error of MPI ends all ranks, which is its own practice; a checkpoint on the disk can be resumed.
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &count);
    const std::lock_guard lock(mutex_);
    if (count_ == 0) {
      rank_ = rank;
      count_ = count;
    } else if (rank != rank_ || count != count_) {
      std::fprintf(stderr, "linkwright: the launcher says rank %d of %d, but MPI rank %d of %d\n", rank_,
                   count_, rank, count);
      MPI_Abort(MPI_COMM_WORLD, 70);
    }
    joined_ = true;
    changes_.notify_all();
  }

  bool is_leaving() {
    const std::lock_guard lock(mutex_);
    return leaving_ && outgoing_.empty();
  }

  /// Receives what has come.
  void take_in() {
    for (int there = 1; there != 0;) {
      MPI_Status status;
      MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
      if (there == 0) break;
      int size = 0;
      MPI_Get_count(&status, MPI_BYTE, &size);
      std::string text(static_cast<std::size_t>(size), '\0');
      MPI_Recv(text.data(), size, MPI_BYTE, status.MPI_SOURCE, status.MPI_TAG, MPI_COMM_WORLD,
               MPI_STATUS_IGNORE);
      incoming_.push_back({status.MPI_SOURCE, std::move(text), MPI_REQUEST_NULL});
    }
  }

  /// Gives what was received to the receiver, if there is one.
  void hand_over() {
    const std::lock_guard lock(receiving_);
    if (!receive_ && !drop_) return;
    for (; !incoming_.empty(); incoming_.pop_front())
      if (receive_) receive_(incoming_.front().rank, incoming_.front().text);
  }

  /// Begins to send what was given for it, and forgets what has been sent.
  void send_on() {
    std::deque<Message> begun;
    {
      const std::lock_guard lock(mutex_);
      begun.swap(outgoing_);
    }
    for (Message& message : begun) {
      Message& m = being_sent_.emplace_back(std::move(message));
      MPI_Isend(m.text.data(), static_cast<int>(m.text.size()), MPI_BYTE, m.rank, 0, MPI_COMM_WORLD,
                &m.request);
    }
    being_sent_.remove_if([](Message& m) {
      int done = 0;
      MPI_Test(&m.request, &done, MPI_STATUS_IGNORE);
      return done != 0;
    });
  }

  int rank_, count_;  // are known before anybody asks
  std::mutex mutex_;  // guards these
  std::condition_variable changes_;
  bool joined_ = false, leaving_ = false, woken_ = false;
  std::deque<Message> outgoing_;
  std::mutex receiving_;  // is held while a message is received, and guards these
  std::function<void(int, std::string_view)> receive_;
  bool drop_ = false;
  // Used by the thread alone.
  std::deque<Message> incoming_;
  std::list<Message> being_sent_;  // their texts must not move
  std::thread thread_;             // last, as it uses all of them
};

}  // namespace
}  // namespace linkwright::mpi

extern "C" __attribute__((visibility("default"))) linkwright::app::Ranks* linkwright_join_ranks(int rank,
                                                                                                int count) {
  return new linkwright::mpi::MpiRanks(rank, count);
}
