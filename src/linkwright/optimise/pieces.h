// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "linkwright/core/checkpoint.h"
#include "linkwright/core/run_context.h"
#include "linkwright/core/value.h"
#include "linkwright/math/function_ref.h"

namespace linkwright::optimise {

/// The end of a loop over pieces of work.
struct PieceLoop {
  Status status = Status::done;  ///< done, deadline or cancelled
  /// One a piece, also of those taken from the checkpoint; pieces that had not begun when the run was
  /// interrupted are left out.
  std::vector<bool> ran;
};

/// Does work that falls into pieces which know nothing of each other (seeds, trials, blocks of samples):
/// body(i) for i in [0, count), on RunContext::threads() threads. Progress is reported under the name
/// `stage`. The body returns the cost that its piece came to (for the progress; infinite if none), writes its
/// results to a place of its own and heeds the run context itself. The first piece is always done.
PieceLoop for_each_piece(std::size_t count, RunContext& context, std::string_view stage,
                         math::FunctionRef<double(std::size_t index)> body);

/// The same with a checkpoint, if the run context has one: pieces that it holds under their name(i) are not
/// done again; what a body saves meanwhile has names below it. `save(i)` turns what piece i came to into a
/// value, null if it was interrupted and is to be done again. `restore(i, value)` puts it back to the place
/// of index i and returns the cost as the body does; it throws CheckpointError for a value that it cannot
/// use. All pieces that an earlier run has saved are restored before the first one is done, those of runs
/// that share the loop when this one has done its own (Checkpoint::own_piece). Throws LeftToOthers when
/// another run puts them together.
PieceLoop for_each_piece(std::size_t count, RunContext& context, std::string_view stage,
                         math::FunctionRef<std::string(std::size_t index)> name,
                         math::FunctionRef<double(std::size_t index)> body,
                         math::FunctionRef<Value(std::size_t index)> save,
                         math::FunctionRef<double(std::size_t index, const Value& value)> restore);

}  // namespace linkwright::optimise
