// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <span>
#include <string>

#include "linkwright/core/checkpoint.h"
#include "linkwright/core/table.h"
#include "support/memory_checkpoint.h"
#include "support/message.h"
#include "support/study_text.h"

// Studies that go on from a checkpoint.
namespace linkwright::test {

/// Everything that a result says, doubles by their bits.
inline std::string all_of(const study::Result& r) {
  std::string out = std::string(to_string(r.status)) + "\n" + to_string(r.headline) + "\n";
  const auto number = [&](double v) { out += pack_numbers({&v, 1}).as_string() + " "; };
  for (const study::Fact& f : r.facts) out += to_string(f.label + ": " + f.text) + "\n";
  for (const study::Solution& s : r.solutions) {
    out += to_string(s.label) + "\n";
    for (const Sentence& defect : s.defects) out += to_string(defect) + "\n";
    for (const study::Parameter& p : s.parameters) out += p.key + " ", number(p.value);
  }
  for (const Table& t : r.tables) {
    out += "\n" + t.name + "\n";
    for (const Column& c : t.columns) {
      out += c.key + " ";
      for (const double v : c.values) number(v);
    }
    for (const auto* words : {&t.names, &t.status})
      for (const std::string& word : *words) out += word + " ";
  }
  for (const study::Change& c : r.changes) out += c.label + " ", number(c.before), number(c.after);
  return out + lines_of(r.diagnostics);
}

/// Runs a study that keeps its seeds "seed 1", ..., "seed N"; then again from all that it has kept, and from
/// its first seed alone: each with the same bits. Values that are damaged are refused, not believed.
inline void expect_resumed_alike(std::span<const study::Kind> kinds, const std::string& text, int seeds) {
  std::string messages;
  const auto prepared = prepare(kinds, text, messages);
  ASSERT_TRUE(prepared) << messages;
  const auto run = [&](Checkpoint& checkpoint) {
    RunContext context;
    context.set_threads(2);
    context.set_checkpoint(&checkpoint);
    return study::run_study(*prepared, context);
  };
  test::MemoryCheckpoint kept;
  const study::Result whole = run(kept);
  const std::string said = all_of(whole);
  for (int seed = 1; seed <= seeds; ++seed)
    ASSERT_TRUE(kept.entries.contains("seed " + std::to_string(seed))) << to_string(whole.headline);
  const auto compare = [&](const study::Result& again) {
    EXPECT_EQ(all_of(again), said);
    EXPECT_EQ(again.statistics, whole.statistics);
    EXPECT_EQ(again.log, whole.log);
  };
  const auto before = kept.entries;
  int runs = 0;
  kept.kept = [&](std::string_view) { ++runs; };
  compare(run(kept));
  EXPECT_EQ(runs, 0) << "a seed was run again";
  kept.kept = nullptr;
  std::erase_if(kept.entries, [](const auto& entry) { return entry.first != "seed 1"; });
  compare(run(kept));
  // Values saved by another study, or that are no seed at all.
  for (const char* what : {"status", "evaluations"}) {
    kept.entries = before;
    Value& seed = kept.entries["seed 1"];
    std::erase_if(seed.as_object(), [&](const Value::Member& m) { return m.key == what; });
    if (before.at("seed 1").find(what)) {
      EXPECT_THROW(run(kept), CheckpointError) << what;
    }
  }
  kept.entries = before;
  kept.entries["seed 1"] = Value(3);
  EXPECT_THROW(run(kept), CheckpointError);
}

}  // namespace linkwright::test
