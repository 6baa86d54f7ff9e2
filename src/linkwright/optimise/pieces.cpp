// SPDX-License-Identifier: BSD-3-Clause
#include "linkwright/optimise/pieces.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>

#include "linkwright/core/check.h"
#include "linkwright/core/numbers.h"
#include "linkwright/optimise/parallel.h"

namespace linkwright::optimise {
namespace {

PieceLoop do_pieces(std::size_t count, RunContext& context, std::string_view stage, Checkpoint* checkpoint,
                    math::FunctionRef<std::string(std::size_t)> name,
                    math::FunctionRef<double(std::size_t)> body, math::FunctionRef<Value(std::size_t)> save,
                    math::FunctionRef<double(std::size_t, const Value&)> restore) {
  LINKWRIGHT_REQUIRE(count >= 1, "needs at least one piece, got {}", count);
  std::vector<char> ran(count, 0);  // not bits: written by several threads
  std::atomic<double> best{infinity};
  const auto restore_kept = [&] {
    for (std::size_t i = 0; i < count; ++i)
      if (ran[i] == 0)
        if (const Value value = checkpoint->find(name(i)); !value.is_null()) {
          best = std::min(best.load(), restore(i, value));
          ran[i] = 1;
        }
  };
  if (checkpoint) restore_kept();

  std::mutex handing;        // guards these
  std::size_t next = 0;      // pieces before it are done, or somebody is at them
  std::size_t begun = 0;     // by this run and not yet done
  bool shared = checkpoint;  // the checkpoint says which pieces are this run's
  const std::string loop = checkpoint ? name(0) : std::string();
  const auto take = [&] {
    const std::lock_guard lock(handing);
    while (next < count) {
      const std::size_t piece = shared ? checkpoint->own_piece(loop, next, count) : next;
      next = std::min(piece, count - 1) + 1;
      if (piece >= count) break;
      if (ran[piece] != 0) continue;
      ++begun;
      return piece;
    }
    return count;
  };
  const auto finish = [&](std::size_t piece) {
    const std::lock_guard lock(handing);
    ran[piece] = 1;
    --begun;
    return static_cast<double>(next - begun) / static_cast<double>(count);
  };
  const auto do_one = [&](std::size_t) {
    const std::size_t i = take();
    if (i == count || (i > 0 && context.interrupted())) return;
    const double cost = body(i);
    if (checkpoint)
      if (const Value value = save(i); !value.is_null()) checkpoint->keep(name(i), value);
    double least = best.load();
    while (cost < least && !best.compare_exchange_weak(least, cost)) {
    }
    const double now = best.load();
    context.report({.stage = stage, .fraction = finish(i), .best = std::isfinite(now) ? now : nan});
  };
  const auto incomplete = [&] { return std::find(ran.begin(), ran.end(), 0) != ran.end(); };
  parallel_for(count, context.threads(), do_one);
  if (checkpoint && incomplete()) {
    checkpoint->rejoin(loop);
    restore_kept();
    // Pieces that another run took and did not finish are done here.
    shared = false;
    next = begun = 0;
    if (incomplete() && !context.interrupted()) parallel_for(count, context.threads(), do_one);
  }
  return {context.interruption(), std::vector<bool>(ran.begin(), ran.end())};
}

}  // namespace

PieceLoop for_each_piece(std::size_t count, RunContext& context, std::string_view stage,
                         math::FunctionRef<double(std::size_t)> body) {
  return do_pieces(
      count, context, stage, nullptr, [](std::size_t) { return std::string(); }, body,
      [](std::size_t) { return Value(); }, [](std::size_t, const Value&) { return 0.0; });
}

PieceLoop for_each_piece(std::size_t count, RunContext& context, std::string_view stage,
                         math::FunctionRef<std::string(std::size_t)> name,
                         math::FunctionRef<double(std::size_t)> body,
                         math::FunctionRef<Value(std::size_t)> save,
                         math::FunctionRef<double(std::size_t, const Value&)> restore) {
  return do_pieces(count, context, stage, context.checkpoint(), name, body, save, restore);
}

}  // namespace linkwright::optimise
