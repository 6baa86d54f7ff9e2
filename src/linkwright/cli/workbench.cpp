// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/workbench.h"

#include <fmt/core.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>
#include <thread>

#include "linkwright/cli/terminal.h"
#include "linkwright/core/diagnostic.h"
#include "linkwright/core/platform/files.h"
#include "linkwright/core/run_context.h"
#include "linkwright/serve/server.h"
#include "linkwright/study/study.h"

namespace linkwright::cli {
namespace fs = std::filesystem;
namespace {

/// A page that only this user can read and that leads to the address: everybody on the machine sees in the
/// list of processes what a browser is started with, and the address is the key.
class Door {
 public:
  explicit Door(const std::string& address) {
    const char* runtime = std::getenv("XDG_RUNTIME_DIR");  // this user's own, and gone after the session
    std::error_code error;
    fs::path parent = runtime && *runtime ? fs::path(runtime) : fs::path();
    if (!fs::is_directory(parent, error)) parent = fs::temp_directory_path(error);
    folder_ = platform::make_private_folder(parent, error);
    if (error) return;
    std::ofstream page(file());
    page << fmt::format(
        "<!doctype html><meta charset=\"utf-8\"><title>Linkwright</title>"
        "<meta http-equiv=\"refresh\" content=\"0;url={0}\"><a href=\"{0}\">the workbench</a>\n",
        address);
    if (page.close(); !page) {
      fs::remove_all(folder_, error);
      folder_.clear();
    }
  }
  ~Door() {
    std::error_code error;
    if (!folder_.empty()) fs::remove_all(folder_, error);
  }
  Door(const Door&) = delete;
  Door& operator=(const Door&) = delete;

  /// Empty = it could not be made.
  std::string file() const { return folder_.empty() ? std::string() : (folder_ / "workbench.html").string(); }

 private:
  fs::path folder_;
};

}  // namespace

int serve_workbench(const Arguments& arguments) {
  RunContext context;
  const Interruptible guard(context);
  // Errors in the study are shown in the page; a file that cannot be read is none to open.
  Diagnostics diagnostics;
  if (!arguments.study.empty()) study::load_file(arguments.study, diagnostics);
  if (has_errors(diagnostics)) {
    print_diagnostics(diagnostics);
    return bad_input;
  }
  std::string problem;
  auto server = serve::Server::start({arguments.study, arguments.port}, problem);
  if (!server) {
    fmt::print(stderr, "linkwright serve: {}\n", problem);
    return bad_input;
  }
  fmt::print("open {}\nCtrl-C ends the workbench; the address is for you alone\n", server->address());
  flush_output();
  std::optional<Door> door;
  if (arguments.open) {
    door.emplace(server->address());
    problem = door->file().empty() ? std::string("there is no folder for a page of your own")
                                   : open_on_desktop(door->file());
    if (!problem.empty())
      fmt::print(stderr, "the page was not opened: {}; open the address in a browser\n", problem);
  }
  while (!context.interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  server.reset();
  fmt::print("\nthe workbench has ended\n");
  return 0;
}

}  // namespace linkwright::cli
