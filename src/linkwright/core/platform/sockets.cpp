// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/platform/sockets.h"

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>

namespace linkwright::platform {

Waited wait_for(Socket socket, Direction direction, std::chrono::milliseconds most) {
  pollfd asked{socket, static_cast<short>(direction == Direction::to_read ? POLLIN : POLLOUT), 0};
  const int count = ::poll(&asked, 1, static_cast<int>(most.count()));
  if (count > 0) return Waited::ready;
  return count == 0 || errno == EINTR ? Waited::not_yet : Waited::failed;
}

Incoming incoming(Socket socket) {
  char next;
  const ssize_t count = ::recv(socket, &next, 1, MSG_PEEK | MSG_DONTWAIT);
  if (count == 0) return Incoming::end;
  return count > 0 ? Incoming::data : Incoming::nothing;
}

long receive(Socket socket, char* to, std::size_t size) { return ::recv(socket, to, size, 0); }

long receive_at_once(Socket socket, char* to, std::size_t size) {
  return ::recv(socket, to, size, MSG_DONTWAIT);
}

long send_at_once(Socket socket, const char* from, std::size_t size) {
  return ::send(socket, from, size, MSG_NOSIGNAL | MSG_DONTWAIT);
}

void end_sending(Socket socket) { ::shutdown(socket, SHUT_WR); }

void close(Socket socket) { ::close(socket); }

void reuse_address(Socket socket) {
  const int yes = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
}

void listen(Socket socket, int waiting) { ::listen(socket, waiting); }

}  // namespace linkwright::platform
