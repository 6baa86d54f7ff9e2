// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/platform/sockets.h"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstdint>
#include <string>

namespace linkwright::platform {
namespace {
using std::chrono::milliseconds;

TEST(Sockets, SayWhatIsThereWithoutReadingIt) {
  int ends[2];
  ASSERT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  const Socket here = ends[0], there = ends[1];
  char got[8];
  EXPECT_EQ(incoming(here), Incoming::nothing);
  EXPECT_EQ(wait_for(here, Direction::to_read, milliseconds(1)), Waited::not_yet);
  EXPECT_EQ(wait_for(here, Direction::to_write, milliseconds(1)), Waited::ready);
  EXPECT_LT(receive_at_once(here, got, sizeof got), 0);

  EXPECT_EQ(send_at_once(there, "abc", 3), 3);
  EXPECT_EQ(wait_for(here, Direction::to_read, milliseconds(1000)), Waited::ready);
  EXPECT_EQ(incoming(here), Incoming::data);
  EXPECT_EQ(receive(here, got, 2), 2);
  EXPECT_EQ(receive_at_once(here, got + 2, 6), 1);
  EXPECT_EQ(std::string(got, 3), "abc");

  end_sending(there);
  EXPECT_EQ(incoming(here), Incoming::end);
  EXPECT_EQ(receive(here, got, sizeof got), 0);
  close(there);
  EXPECT_LT(send_at_once(here, "abc", 3), 0);  // and no signal
  close(here);
}

// A second program must not take the port, and whoever comes is handed over once.
TEST(Sockets, ListenAtALoopbackAddress) {
  const Socket listening = listen(Loopback::version4, 0, 4);
  ASSERT_GE(listening, 0);
  int on = 0;
  socklen_t size = sizeof on;
  ASSERT_EQ(::getsockopt(listening, SOL_SOCKET, SO_REUSEADDR, &on, &size), 0);
  EXPECT_EQ(on, 1);
  const int port = port_of(listening);
  ASSERT_GT(port, 0);
  errno = 0;
  EXPECT_LT(listen(Loopback::version4, port, 4), 0);
  EXPECT_EQ(errno, EADDRINUSE);
  EXPECT_LT(accept_at_once(listening), 0);

  const Socket there = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in to = {};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port));
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(::connect(there, reinterpret_cast<const sockaddr*>(&to), sizeof to), 0);
  EXPECT_EQ(wait_for(listening, Direction::to_read, milliseconds(1000)), Waited::ready);
  const Socket here = accept_at_once(listening);
  ASSERT_GE(here, 0);
  EXPECT_EQ(send_at_once(here, "abc", 3), 3);
  char got[3];
  EXPECT_EQ(receive(there, got, sizeof got), 3);
  for (const Socket socket : {here, there, listening}) close(socket);
}

}  // namespace
}  // namespace linkwright::platform
