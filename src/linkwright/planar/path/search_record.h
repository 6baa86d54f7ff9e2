#pragma once

#include <cstdint>
#include <functional>
#include <string_view>
#include <vector>

#include "linkwright/core/status.h"
#include "linkwright/core/value.h"
#include "linkwright/planar/path/four_bar/synthesis.h"

// A finished seed of a path synthesis as checkpoints keep it, whatever the mechanism.
namespace linkwright::planar {

/// What a seed came to, but for its designs, which are kept as numbers.
struct SearchRecord {
  Status status = Status::done;  ///< done or infeasible
  std::int64_t evaluations = 0;
  std::vector<SearchPoint> history;
};

Value kept(const SearchRecord& record, const std::vector<std::vector<double>>& designs);

/// The record, with the same bits; the numbers of its designs are handed over one after the other. Throws
/// CheckpointError, naming `what`, for everything that `kept` cannot have made.
SearchRecord restored(const Value& value, std::string_view what,
                      const std::function<void(const std::vector<double>&)>& design);

/// Throws CheckpointError, naming `what`, unless a design has so many numbers.
void require_numbers(const std::vector<double>& design, std::size_t count, std::string_view what);

/// What a number of a kept design may be: 1 or -1, a length of a link, a coordinate (m), an angle (rad).
bool is_kept_sign(double x);
bool is_kept_length(double x);
bool is_kept_place(double x);
bool is_kept_angle(double x);

}  // namespace linkwright::planar
