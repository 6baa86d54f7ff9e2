// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/methods.h"

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/check.h"

namespace linkwright::optimise {

namespace {

template <class Options>
concept TakesSeveralObjectives = requires(std::span<const Variable> variables, const Options& options,
                                          const Seed& seed) {
  make_optimiser(variables, options, seed, std::size_t{2});
};

/// "firefly, cuckoo_search or ..."
std::string those_that_take_several() {
  std::vector<std::string_view> found;
  for (const EnumName<Method>& entry : names(Method{}))
    if (takes_several_objectives(entry.value)) found.push_back(entry.name);
  return fmt::format("{} or {}", fmt::join(found.begin(), found.end() - 1, ", "), found.back());
}

}  // namespace

bool takes_several_objectives(Method method) {
  return visit_method(OptimiserOptions{.method = method},
                      []<class Options>(const Options&) { return TakesSeveralObjectives<Options>; });
}

std::unique_ptr<Optimiser> make_optimiser(std::span<const Variable> variables,
                                          const OptimiserOptions& options, const Seed& seed,
                                          std::size_t objectives) {
  return visit_method(options, [&]<class Options>(const Options& o) -> std::unique_ptr<Optimiser> {
    if constexpr (TakesSeveralObjectives<Options>) {
      return make_optimiser(variables, o, seed, objectives);
    } else {
      LINKWRIGHT_REQUIRE(objectives == 1,
                         "{}: minimises one objective; with several use {}, or combine "
                         "them, see combine.h",
                         name_of(options.method), those_that_take_several());
      return make_optimiser(variables, o, seed);
    }
  });
}

int generations(const OptimiserOptions& options) {
  return visit_method(options, [](const auto& o) { return o.generations; });
}

}  // namespace linkwright::optimise
