// SPDX-License-Identifier: BSD-3-Clause
#include <string>

#include "linkwright/serve/server.h"

// Replaces the server when the program is built without it.
namespace linkwright::serve {

struct Server::Parts {};

std::unique_ptr<Server> Server::start(const ServerOptions&, std::string& problem) {
  problem = "this program was built without the server of the workbench (LINKWRIGHT_SERVE=OFF)";
  return nullptr;
}
Server::~Server() = default;
int Server::port() const { return 0; }
const std::string& Server::token() const {
  static const std::string none;
  return none;
}
std::string Server::address() const { return {}; }

}  // namespace linkwright::serve
