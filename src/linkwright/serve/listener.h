// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "linkwright/core/platform/sockets.h"
#include "linkwright/serve/connection.h"

namespace linkwright::serve {

/// Accepts connections at a socket that listens, and answers them in threads of its own. A connection that
/// comes when too many wait is refused by the thread that accepts.
class Listener {
 public:
  using Answer = std::function<void(Connection&)>;

  /// Takes the socket.
  Listener(platform::Socket socket, Answer answer);
  ~Listener();  ///< ends all connections and waits for their threads
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

 private:
  struct Waiting {
    platform::Socket socket;
    Connection::Clock::time_point arrived;
  };

  void accept();
  void work();

  const platform::Socket socket_;
  const Answer answer_;
  std::atomic<bool> ending_{false};
  std::mutex mutex_;
  std::condition_variable came_;
  std::deque<Waiting> waiting_;
  std::vector<std::thread> threads_;
};

}  // namespace linkwright::serve
