// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>

#include "linkwright/core/platform/sockets.h"

namespace linkwright::serve {

/// Time between two looks whether the server ends.
inline constexpr std::chrono::milliseconds glance{100};

/// One connection. Everything that is read or written together has a time, so that clients which send for
/// ever, or hardly at all, do not hold their thread.
class Connection {
 public:
  using Clock = std::chrono::steady_clock;

  /// Takes the socket, whose request must have come at `end`; nothing waits any longer once `ending` is true.
  Connection(platform::Socket socket, Clock::time_point end, const std::atomic<bool>& ending)
      : socket_(socket), ending_(ending), end_(end) {}
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  /// Sets the time for what follows, counted from now.
  void within(std::chrono::seconds patience) { end_ = Clock::now() + patience; }
  /// Data are left unread; they would reset the connection before the answer has arrived.
  void leave_unread() { unread_ = true; }
  /// True when nobody waits for an answer any longer, or the server ends.
  bool gone() const { return ending_ || platform::incoming(socket_) == platform::Incoming::end; }

  /// Bytes that were read; 0 at the end, negative where reading failed or took too long.
  long read(char* to, std::size_t size);
  /// Bytes that were taken; negative where writing failed or took too long.
  long write(const char* from, std::size_t size);

 private:
  bool wait(platform::Direction direction, Clock::time_point end) const;

  const platform::Socket socket_;
  const std::atomic<bool>& ending_;
  Clock::time_point end_;
  bool unread_ = false;
};

}  // namespace linkwright::serve
