// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <cstddef>

namespace linkwright::platform {

/// A connection, or what listens for them.
using Socket = int;

enum class Direction { to_read, to_write };
enum class Waited { ready, not_yet, failed };
/// Waits until something can be read or written, at most so long; `not_yet` may come earlier.
Waited wait_for(Socket socket, Direction direction, std::chrono::milliseconds most);

/// The state of the input of a socket, found without reading it.
enum class Incoming { data, nothing, end };
Incoming incoming(Socket socket);

/// Bytes that were read; 0 at the end, negative where reading failed, or, `at_once`, would have to wait.
long receive(Socket socket, char* to, std::size_t size);
long receive_at_once(Socket socket, char* to, std::size_t size);
/// Bytes that were taken; negative where sending failed or would have to wait.
long send_at_once(Socket socket, const char* from, std::size_t size);

void end_sending(Socket socket);
void close(Socket socket);

/// Lets a program listen at a port that one before it has just left.
void reuse_address(Socket socket);
/// Listens; `waiting`: connections that wait to be accepted.
void listen(Socket socket, int waiting);

}  // namespace linkwright::platform
