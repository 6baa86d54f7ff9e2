// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace linkwright::app {

/// The time at which a message leaves: at once, or some 20 ms later together with others, which costs the
/// work less.
enum class Urgency { at_once, can_wait };

/// The runs of one study that a launcher has started together: ranks 0, 1, ... count - 1, each of which sends
/// messages to any other one. A plug-in over MPI (src/linkwright/mpi) gives them; tests have their own.
class Ranks {
 public:
  Ranks() = default;
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;
  /// Waits until all that was sent has arrived and all ranks have come here.
  virtual ~Ranks() = default;

  virtual int rank() const = 0;
  virtual int count() const = 0;

  /// Sends and does not wait. What one rank sends to another one arrives in the order of sending. Usable from
  /// any thread.
  virtual void send(int to, std::string message, Urgency urgency = Urgency::at_once) = 0;

  /// Receives all messages from here on, one after the other, on a thread of its own; what came before waits
  /// for it. An empty function receives no more: messages are dropped, and none is being received.
  virtual void set_receiver(std::function<void(int from, std::string_view message)> receive) = 0;

  /// This rank needs the others no more: parting, which takes a while, begins while it does other work. What
  /// is sent after it is lost.
  virtual void leave() = 0;
};

/// The function that the plug-in exports as `linkwright_join_ranks`: joins the ranks that were started
/// together, once in a process. Where the launcher has given rank and count, it returns at once and joins
/// them meanwhile; where it has not (count 0), it returns when they are known. Ranks that cannot be joined
/// end the process.
using JoinRanks = Ranks*(int rank, int count);

}  // namespace linkwright::app
