// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/serve/listener.h"

#include <chrono>
#include <cstddef>
#include <string_view>
#include <utility>

namespace linkwright::serve {
namespace {
// Threads that answer; more than there are runs, so that some are always free.
constexpr std::size_t answering = 12;
constexpr std::size_t max_waiting = 64;  // connections that wait for one of them; others are refused
constexpr std::chrono::seconds head_patience{5};
constexpr std::string_view refusal =
    "HTTP/1.1 503 Service Unavailable\r\nConnection: close\r\nContent-Length: 0\r\n\r\n";
}  // namespace

Listener::Listener(platform::Socket socket, Answer answer) : socket_(socket), answer_(std::move(answer)) {
  for (std::size_t i = 0; i < answering; ++i) threads_.emplace_back([this] { work(); });
  threads_.emplace_back([this] { accept(); });
}

Listener::~Listener() {
  {
    const std::lock_guard lock(mutex_);
    ending_ = true;
  }
  came_.notify_all();
  for (std::thread& thread : threads_) thread.join();
  platform::close(socket_);
}

void Listener::accept() {
  while (!ending_) {
    if (platform::wait_for(socket_, platform::Direction::to_read, glance) != platform::Waited::ready)
      continue;
    const platform::Socket socket = platform::accept_at_once(socket_);
    if (socket < 0) {  // the client has left, or there are too many open files
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      continue;
    }
    const auto now = Connection::Clock::now();
    std::unique_lock lock(mutex_);
    if (waiting_.size() < max_waiting) {
      waiting_.push_back({socket, now});
      came_.notify_one();
      continue;
    }
    lock.unlock();
    const Connection refused(socket, now, ending_);
    platform::send_at_once(socket, refusal.data(), refusal.size());
  }
}

void Listener::work() {
  for (std::unique_lock lock(mutex_);;) {
    came_.wait(lock, [this] { return ending_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    const Waiting next = waiting_.front();
    waiting_.pop_front();
    lock.unlock();
    {
      Connection connection(next.socket, next.arrived + head_patience, ending_);
      answer_(connection);
    }
    lock.lock();
  }
}

}  // namespace linkwright::serve
