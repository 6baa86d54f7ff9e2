// SPDX-License-Identifier: BSD-3-Clause

// Any run that a page sends is refused with one line that says why, or it is a run with a name and with files
// that stay in their folder; the guards of the head take any bytes.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "fuzz/require.h"
#include "linkwright/serve/guard.h"
#include "linkwright/serve/run_request.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace linkwright;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  FUZZ_REQUIRE(serve::same_secret(bytes, std::string(bytes)));
  FUZZ_REQUIRE(!serve::has_token(bytes, "a secret that no input has"));
  if (serve::is_own_host(bytes, 8080)) FUZZ_REQUIRE(bytes.size() <= sizeof "127.0.0.1:8080");
  FUZZ_REQUIRE(!serve::is_own_origin(bytes, bytes));

  std::string problem;
  const auto request = serve::read_run_request(bytes, problem);
  FUZZ_REQUIRE(request.has_value() == problem.empty());
  if (!request) {
    for (const char c : problem) FUZZ_REQUIRE(static_cast<unsigned char>(c) >= ' ');
    return 0;
  }
  const std::string_view tab = serve::tab_of(request->run);
  FUZZ_REQUIRE(!tab.empty() && tab.size() <= 64);
  FUZZ_REQUIRE(request->seconds >= 0);
  for (const auto& [name, text] : request->files) {
    const std::filesystem::path folder = "/folder";
    FUZZ_REQUIRE((folder / name).lexically_normal().parent_path() == folder);
  }
  return 0;
}
