// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/core/platform/sockets.h"

#include <gtest/gtest.h>
#include <sys/socket.h>

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

// Both are seen in the options of the socket.
TEST(Sockets, ListenAtAPortThatWasJustLeft) {
  const Socket socket = ::socket(AF_INET, SOCK_STREAM, 0);
  ASSERT_GE(socket, 0);
  reuse_address(socket);
  int on = 0;
  socklen_t size = sizeof on;
  ASSERT_EQ(::getsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, &size), 0);
  EXPECT_EQ(on, 1);
  listen(socket, 4);
  ASSERT_EQ(::getsockopt(socket, SOL_SOCKET, SO_ACCEPTCONN, &on, &size), 0);
  EXPECT_EQ(on, 1);
  close(socket);
}

}  // namespace
}  // namespace linkwright::platform
