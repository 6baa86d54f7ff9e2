#pragma once

#include <span>

#include "linkwright/planar/linkage_limits.h"
#include "linkwright/planar/linkage_modes.h"

namespace linkwright::planar {

struct TraceSearch {
  int stations = 24;   ///< places of the input, evenly apart
  int look_every = 4;  ///< stations apart at which assembly modes are searched
  ModeSearch modes;    ///< how
};

/// The ranges of a linkage with general groups, whose modes cannot be listed: assembly modes are searched at
/// some values of the input, and each is followed both ways to its limits (ModeCurve). What no search meets
/// is missing, the more likely the shorter its range is.
///
/// Of the ends: `limit`, where the rates grow without bound (the determinant of a group passes zero and the
/// range turns back), found to rounding; `change_point`, where the determinant passes zero
/// and the rates stay finite; `groups` names the one whose determinant (or sine) is nearest to zero. `modes`
/// of a general group is the sign of its determinant along the range. When the interval is a full turn of a
/// periodic input, ranges may run over several turns until they close.
InputLimits trace_limits(const LinkagePlan& plan, std::span<const double> inputs, int input, double from,
                         double to, const TraceSearch& search = {});

}  // namespace linkwright::planar
