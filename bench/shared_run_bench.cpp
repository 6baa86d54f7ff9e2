// SPDX-License-Identifier: BSD-3-Clause
#include <benchmark/benchmark.h>

#include <filesystem>
#include <string>

#include "linkwright/app/shared_run.h"

// The work of rank 0 for each piece of a study that another rank does: with the time of a piece, it says how
// many ranks one rank can serve.
namespace linkwright::app {
namespace {

/// The message of another rank is given by hand, the answer is thrown away.
class OneRank final : public Ranks {
 public:
  int rank() const override { return 0; }
  int count() const override { return 2; }
  void send(int, std::string message, Urgency) override { benchmark::DoNotOptimize(message.data()); }
  void set_receiver(std::function<void(int, std::string_view)> receive) override {
    receive_ = std::move(receive);
  }
  void leave() override {}
  void give(std::string_view message) { receive_(1, message); }

 private:
  std::function<void(int, std::string_view)> receive_;
};

struct RankZero {
  OneRank ranks;
  RunContext context;
  CheckpointOwner study = {"linkwright 9.8.7", std::string(64, 'a')};
  CheckpointFile file{std::filesystem::temp_directory_path() / "linkwright-bench.jsonl", study};
  LeadingRank leading{ranks, file, study, RanksBegin::with_what_was_kept, context};
  ~RankZero() {
    ranks.give("e");
    file.discard();
  }
};

/// Receives what a piece came to: so many doubles.
void BM_keep(benchmark::State& state) {
  RankZero zero;
  const std::vector<double> numbers(static_cast<std::size_t>(state.range(0)), 1.25);
  Value value;
  value["numbers"] = pack_numbers(numbers);
  std::int64_t piece = 0, bytes = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const std::string message = "k" + checkpoint_line("seed " + std::to_string(++piece % 1000), value);
    bytes += static_cast<std::int64_t>(message.size());
    state.ResumeTiming();
    zero.ranks.give(message);
  }
  state.SetBytesProcessed(bytes);
}
BENCHMARK(BM_keep)->Arg(10)->Arg(100)->Arg(1000);

/// Hands out pieces, about 30 each time of a loop of 1000 and one each time at its end.
void BM_hand_out(benchmark::State& state) {
  RankZero zero;
  std::int64_t loop = 0;
  for (auto _ : state) zero.ranks.give("a1000 loop " + std::to_string(loop++ / 40));
}
BENCHMARK(BM_hand_out);

}  // namespace
}  // namespace linkwright::app
