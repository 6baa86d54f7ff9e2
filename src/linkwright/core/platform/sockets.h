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

/// The addresses at which a machine reaches itself: 127.0.0.1 and ::1.
enum class Loopback { version4, version6 };
/// Listens at a port of a loopback address, which may be one that a program before has just left; port 0 is
/// any that is free. `waiting`: connections that wait to be accepted. Negative, with errno, where it fails.
Socket listen(Loopback address, int port, int waiting);
/// The port at which a socket listens; 0 if it does not.
int port_of(Socket socket);
/// The next connection, which sends what it is given without delay; negative where none waits.
Socket accept_at_once(Socket socket);

}  // namespace linkwright::platform
