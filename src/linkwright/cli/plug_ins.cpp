// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/cli/plug_ins.h"

#include <fmt/core.h>

#include <filesystem>
#include <system_error>

#include "linkwright/core/platform/processes.h"

namespace linkwright::cli {
namespace fs = std::filesystem;

void* load_plug_in(const std::string& name, std::string& problem) {
  std::error_code error;
  const fs::path folder = platform::program_file().parent_path();
  for (const char* libraries : {"../lib", "../lib/" LINKWRIGHT_MULTIARCH}) {
    const fs::path file = folder / libraries / "linkwright" / name;
    if (fs::exists(file, error)) return platform::load_library(file, problem);
  }
  problem = fmt::format("{} is not there", (folder.parent_path() / "lib/linkwright" / name).string());
  return nullptr;
}

}  // namespace linkwright::cli
