// SPDX-License-Identifier: BSD-3-Clause

// The reliability of the search for all four-bars through nine points, over random targets:
//
//   exact_statistics [TARGETS [FIRST [KINDS]]]
//
// solves so many targets (200) of each of the first KINDS kinds (5), numbers from FIRST (0) on, and prints a
// table in Markdown, with every target that is not complete by its number. A target takes some tenths of a
// second on two threads.

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "planar/exact_targets.h"

namespace {

using namespace linkwright;
using namespace linkwright::planar;
using test::NinePointTarget;

struct Figures {
  int complete = 0, uncertified = 0, others = 0, drawn = 0;
  long long lost_at_first = 0, lost = 0;
  std::vector<int> real;
  std::vector<std::string> remarks;
};

Figures figures(NinePointTarget kind, std::uint32_t first, std::uint32_t count) {
  Figures out;
  for (std::uint32_t number = first; number < first + count; ++number) {
    const test::RandomTarget target = test::random_target(kind, number);
    RunContext context;
    const NinePointSolutions found =
        solve_nine_points(target.points, {.cache = user_cache_folder()}, context);
    out.lost_at_first += found.first_lost;
    out.lost += found.lost;
    out.real.push_back(found.real);
    if (found.completeness == Completeness::complete) {
      ++out.complete;
    } else {
      ++(found.completeness == Completeness::complete_uncertified ? out.uncertified : out.others);
      out.remarks.push_back(fmt::format("{}: {}, {} classes, {} certified, {} infinite, {} singular, {} lost",
                                        number, name_of(found.completeness), found.classes.size(),
                                        found.certified, found.infinite, found.singular, found.lost));
    }
    if (target.drawn_by && test::has(found, *target.drawn_by, target.points[0])) {
      ++out.drawn;
    } else if (target.drawn_by) {
      out.remarks.push_back(
          fmt::format("{}: the four-bar that drew the points is not among the real ones", number));
    }
  }
  std::sort(out.real.begin(), out.real.end());
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  const auto number = [&](int k, int otherwise) {
    return static_cast<std::uint32_t>(argc > k ? std::atoi(argv[k]) : otherwise);
  };
  const std::uint32_t count = number(1, 200), first = number(2, 0);
  std::uint32_t kinds = number(3, 5);
  fmt::print(
      "| targets | 1442 classes, each certified | 1442, some uncertified | fewer | real classes: least, "
      "median, most | "
      "paths lost at first | in the end | found the four-bar that drew them "
      "|\n|---|---|---|---|---|---|---|---|\n");
  std::vector<std::string> remarks;
  for (const auto& [kind, name] :
       {std::pair{NinePointTarget::scattered, "scattered"},
        std::pair{NinePointTarget::curve, "on a smooth closed curve"},
        std::pair{NinePointTarget::crank_rocker, "on the curve of a crank-rocker"},
        std::pair{NinePointTarget::curve_spread, "spread on a smooth closed curve"},
        std::pair{NinePointTarget::crank_rocker_spread, "spread on the curve of a crank-rocker"}}) {
    if (kinds-- == 0) break;
    const Figures f = figures(kind, first, count);
    fmt::print("| {}, {} | {} | {} | {} | {}, {}, {} | {} ({:.1e} a path) | {} | {} |\n", count, name,
               f.complete, f.uncertified, f.others, f.real.front(), f.real[f.real.size() / 2], f.real.back(),
               f.lost_at_first, static_cast<double>(f.lost_at_first) / (1442.0 * count), f.lost,
               kind == NinePointTarget::crank_rocker || kind == NinePointTarget::crank_rocker_spread
                   ? std::to_string(f.drawn)
                   : "-");
    std::fflush(stdout);
    for (const std::string& remark : f.remarks) remarks.push_back(fmt::format("{}, {}", name, remark));
  }
  for (const std::string& remark : remarks) fmt::print("\n{}", remark);
  fmt::print("\n");
}
