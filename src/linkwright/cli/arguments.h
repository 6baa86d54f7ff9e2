#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace linkwright::cli {

/// The command line, taken apart.
struct Arguments {
  enum class Command { nothing, run, check, make, schema, catalogue, reproduce };
  Command command = Command::nothing;

  std::string study;  ///< run, check: the file
  std::string kind;   ///< make, schema
  std::string file;   ///< make: empty = named after the kind, "-" = standard output

  std::string table;  ///< reproduce: id, beginning of ids or "all"; empty = list them

  std::string out;
  std::optional<std::int64_t> seed;
  int threads = 0;
  std::vector<std::string> set;
  std::optional<double> time_limit;  ///< s
  bool resume = false;
  bool json = false;
  bool renamed = false;  ///< of catalogue

  std::string text;   ///< for nothing: what to print (help, version or what is wrong)
  int exit_code = 0;  ///< for nothing
};

/// Never throws for what users write: a wrong command line comes back as `nothing` with exit code 2 and a
/// text.
Arguments parse_arguments(int argc, const char* const* argv);

}  // namespace linkwright::cli
