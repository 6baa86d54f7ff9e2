// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/platform/sockets.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>

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

Socket listen(Loopback address, int port, int waiting) {
  sockaddr_in6 at6 = {};
  at6.sin6_family = AF_INET6;
  at6.sin6_port = htons(static_cast<std::uint16_t>(port));
  at6.sin6_addr = in6addr_loopback;
  sockaddr_in at4 = {};
  at4.sin_family = AF_INET;
  at4.sin_port = at6.sin6_port;
  at4.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  const bool version4 = address == Loopback::version4;
  const auto* const at =
      version4 ? reinterpret_cast<const sockaddr*>(&at4) : reinterpret_cast<const sockaddr*>(&at6);

  const Socket socket = ::socket(at->sa_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (socket < 0) return socket;
  // Not SO_REUSEPORT, which lets a second program listen at the same port.
  const int yes = 1;
  ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  if (::bind(socket, at, version4 ? sizeof at4 : sizeof at6) == 0 && ::listen(socket, waiting) == 0)
    return socket;
  const int why = errno;
  ::close(socket);
  errno = why;
  return -1;
}

int port_of(Socket socket) {
  sockaddr_in6 at = {};  // its port stands where that of sockaddr_in does
  socklen_t size = sizeof at;
  return ::getsockname(socket, reinterpret_cast<sockaddr*>(&at), &size) == 0 ? ntohs(at.sin6_port) : 0;
}

Socket accept_at_once(Socket socket) {
  const Socket connection = ::accept4(socket, nullptr, nullptr, SOCK_CLOEXEC);
  const int yes = 1;
  if (connection >= 0) ::setsockopt(connection, IPPROTO_TCP, TCP_NODELAY, &yes, sizeof yes);
  return connection;
}

}  // namespace linkwright::platform
