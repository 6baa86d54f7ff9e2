// SPDX-License-Identifier: BSD-3-Clause

// Reading any bytes of a checkpoint ends with what can be used or with one message; also when somebody has
// made owner and checksum fit.
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "fuzz/require.h"
#include "linkwright/app/checkpoint_file.h"
#include "linkwright/app/sha256.h"
#include "linkwright/optimise/methods.h"
#include "linkwright/planar/path/checkpoint.h"
#include "linkwright/planar/path/four_bar/problem.h"
#include "linkwright/study/study.h"

namespace {

using namespace linkwright;

/// A seed that is taken up can be ranked and compared.
void restore_seed(const Value& value) {
  static const planar::PathProblem problem = planar::eighteen_points();
  try {
    planar::PathSynthesis run = planar::restored(value, problem, "seed");
    for (const planar::PathDesign& design : run.designs) FUZZ_REQUIRE(!(design.error < 0));
    planar::rank(run.designs);
    FUZZ_REQUIRE(planar::kept(run).is_object());
  } catch (const CheckpointError&) {
  }
}

/// A state that is taken up leads to candidates in their bounds.
void restore_state(const Value& value) {
  const std::vector<optimise::Variable> variables = {{"x", -1, 2}, {"y", 3, 5}};
  const Value* packed = value.find("optimiser");
  if (!packed) return;
  optimise::OptimiserState state{.generation = 7};
  try {
    state.numbers = unpack_numbers(*packed, "state");
  } catch (const CheckpointError&) {
    return;
  }
  for (const auto& method : names(optimise::Method{})) {
    optimise::OptimiserOptions options{.method = method.value};
    options.differential_evolution.population = options.grey_wolf.population =
        options.self_adaptive_differential_evolution.population = options.particle_swarm.population =
            options.jade.population = options.firefly.population = options.cuckoo_search.population =
                options.hybrid_cuckoo_firefly.population = options.subpopulation_firefly.population = 4;
    const auto optimiser = make_optimiser(variables, options, {});
    if (!optimiser->restore(state)) continue;
    const optimise::PopulationView x = optimiser->ask();
    for (std::size_t i = 0; i < x.size; ++i)
      for (std::size_t j = 0; j < 2; ++j)
        FUZZ_REQUIRE(x(j, i) >= variables[j].lower && x(j, i) <= variables[j].upper);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const app::CheckpointOwner owner = {"linkwright 0", std::string(64, '0')};
  const std::string fitting = "{\"checkpoint\":1,\"tool\":\"linkwright 0\",\"study_sha256\":\"" +
                              owner.study_sha256 + "\",\"bytes\":" + std::to_string(size) + ",\"sha256\":\"" +
                              app::sha256(text) + "\"}\n" + std::string(text);
  for (const std::string_view file : {text, std::string_view(fitting)}) {
    Diagnostics diagnostics;
    const auto lines = app::read_checkpoint(file, owner, "input", diagnostics);
    FUZZ_REQUIRE(lines.has_value() == diagnostics.empty());
    FUZZ_REQUIRE(diagnostics.size() <= 1);
    if (!lines) {
      for (const char c : to_string(diagnostics[0])) FUZZ_REQUIRE(c >= ' ' && c <= '~');
      continue;
    }
    Diagnostics again;
    FUZZ_REQUIRE(app::read_checkpoint(app::checkpoint_text(owner, *lines), owner, "again", again) == lines);
    for (const auto& [name, line] : *lines) {
      const Value table = study::read_text(line, study::Syntax::json, "line", diagnostics);
      FUZZ_REQUIRE(table.find("value") != nullptr);
      restore_seed(*table.find("value"));
      restore_state(*table.find("value"));
    }
  }
  return 0;
}
