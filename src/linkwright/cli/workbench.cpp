#include "linkwright/cli/workbench.h"

#include <fmt/core.h>

#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

#include "linkwright/cli/terminal.h"
#include "linkwright/core/diagnostic.h"
#include "linkwright/core/run_context.h"
#include "linkwright/serve/server.h"
#include "linkwright/study/read.h"

namespace linkwright::cli {

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
  std::fflush(stdout);
  if (arguments.open)
    if (problem = open_on_desktop(server->address()); !problem.empty())
      fmt::print(stderr, "the page was not opened: {}; open the address in a browser\n", problem);
  while (!context.interrupted()) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  server.reset();
  fmt::print("\nthe workbench has ended\n");
  return 0;
}

}  // namespace linkwright::cli
