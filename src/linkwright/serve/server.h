// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

/// The workbench as a page that the program itself serves, to the browsers of this machine alone, with the
/// program for an engine.
namespace linkwright::serve {

struct ServerOptions {
  std::filesystem::path study;  ///< the file that the page opens; empty = none
  int port = 0;                 ///< 0 = any that is free
};

/// Bodies of requests are no larger than this.
inline constexpr std::size_t largest_body = std::size_t{16} << 20;
/// Runs at a time, of all tabs.
inline constexpr std::size_t max_runs = 8;

/// Listens from its start to its end at 127.0.0.1 and, where the machine has it, at ::1.
class Server {
 public:
  /// nullptr, with the reason in `problem`, where it cannot listen: the port is taken, or the program was
  /// built without what it needs.
  static std::unique_ptr<Server> start(const ServerOptions& options, std::string& problem);
  ~Server();  ///< ends all runs and waits for them
  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

  int port() const;
  /// The token that all requests but the one for the page must carry.
  const std::string& token() const;
  /// Address of the page, with the token in its fragment, which browsers do not send.
  std::string address() const;

 private:
  struct Parts;
  explicit Server(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> parts_;
};

}  // namespace linkwright::serve
