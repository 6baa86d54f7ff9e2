// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/serve/connection.h"

#include <algorithm>

namespace linkwright::serve {
using platform::Direction;
using std::chrono::milliseconds;
using std::chrono::seconds;

Connection::~Connection() {
  platform::end_sending(socket_);
  const auto end = Clock::now() + (unread_ ? seconds(2) : seconds(0));
  char rest[16384];
  do {
    while (platform::receive_at_once(socket_, rest, sizeof rest) > 0 && Clock::now() < end) continue;
  } while (Clock::now() < end && wait(Direction::to_read, end) &&
           platform::incoming(socket_) == platform::Incoming::data);
  platform::close(socket_);
}

long Connection::read(char* to, std::size_t size) {
  if (!wait(Direction::to_read, end_)) return -1;
  return platform::receive(socket_, to, size);
}

long Connection::write(const char* from, std::size_t size) {
  if (!wait(Direction::to_write, end_)) return -1;
  return platform::send_at_once(socket_, from, size);
}

bool Connection::wait(Direction direction, Clock::time_point end) const {
  while (!ending_) {
    const auto left = std::max(std::chrono::duration_cast<milliseconds>(end - Clock::now()), milliseconds(0));
    const platform::Waited waited = platform::wait_for(socket_, direction, std::min(left, glance));
    if (waited == platform::Waited::ready) return true;
    if (waited == platform::Waited::failed || left == milliseconds(0)) return false;
  }
  return false;
}

}  // namespace linkwright::serve
