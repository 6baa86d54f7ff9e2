#include "linkwright/optimise/pieces.h"

#include <algorithm>
#include <atomic>
#include <cmath>

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
  std::vector<char> ran(count, 0), left(count, 0);  // not bits: written by several threads
  std::atomic<std::size_t> finished{0};
  std::atomic<double> best{infinity};
  std::size_t own = count;
  if (checkpoint)
    for (std::size_t i = 0; i < count; ++i) {
      const Value value = checkpoint->find(name(i));
      if (!value.is_null()) {
        best = std::min(best.load(), restore(i, value));
        ran[i] = 1;
        ++finished;
      } else if (checkpoint->is_left_to_others(i)) {
        left[i] = 1;
        --own;
      }
    }
  parallel_for(count, context.threads(), [&](std::size_t i) {
    if (ran[i] != 0 || left[i] != 0 || (i > 0 && context.interrupted())) return;
    const double cost = body(i);
    ran[i] = 1;
    if (checkpoint)
      if (const Value value = save(i); !value.is_null()) checkpoint->keep(name(i), value);
    double least = best.load();
    while (cost < least && !best.compare_exchange_weak(least, cost)) {
    }
    const double now = best.load();
    context.report({.stage = stage,
                    .fraction = static_cast<double>(++finished) / static_cast<double>(own),
                    .best = std::isfinite(now) ? now : nan});
  });
  if (own < count) throw LeftToOthers();
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
