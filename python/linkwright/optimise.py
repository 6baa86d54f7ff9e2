# SPDX-License-Identifier: BSD-3-Clause
"""The population methods, for objectives written in Python."""

from __future__ import annotations

import math
import operator
from collections.abc import Callable
from typing import Any, NamedTuple, Optional

import numpy
from numpy.typing import ArrayLike

from . import _linkwright


class Minimum(NamedTuple):
    """What a minimisation found."""

    x: numpy.ndarray  # the best candidate, also when the run was interrupted
    cost: float
    violation: float  # 0 = feasible
    evaluations: int
    generations: int
    status: str  # "done", "infeasible", "deadline" or "cancelled"
    stop_reason: str  # for people
    history: numpy.ndarray  # (generations, 2): evaluations so far, and the best cost by then; every second, fourth, ...
    # generation of more than 65 536


def methods() -> dict[str, str]:
    """{name: what it is} of the methods that `minimise` knows."""
    return _linkwright.methods()


def minimise(objective: Callable[[numpy.ndarray], Any], lower: ArrayLike, upper: ArrayLike, method: str = "recommended", *,
             seed: int = 1, time_limit: Optional[float] = None,
             progress: Optional[Callable[[int, float], Any]] = None, **options: Any) -> Minimum:
    """Minimises a function of d unknowns between bounds, without derivatives.

    objective: gets an array (n, d), a candidate a row, and returns n costs; or a pair of n costs and n violations, the sum of
        what violates constraints, 0 where all are met. A candidate whose cost or violation is NaN or infinite is worse than
        any other; its violation is infinite. n is at most 256.
    method: a name of `methods()`; "recommended" is "jade", which needs no settings; where a narrow valley has to be followed,
        "cma_es" does it in fewer evaluations.
    options: those of the method and of its end, as in the `[optimiser]` of a study: population, generations,
        max_evaluations, target_cost, stagnation, constraints, ...
    seed: from 0 to 2**64 - 1.
    time_limit: in seconds.
    progress: called with (generation, best cost); when it returns False, the run ends with the best so far.

    The same seed gives the same answer. Raises StudyError for options that the method does not have or that are out of range,
    ValueError for seeds, bounds and answers that do not fit; what the objective raises, Ctrl-C included, ends the run.
    """
    if method == "recommended":
        method = "jade"
    *row, evaluations, best = _linkwright.minimise(objective, lower, upper, {"method": method, **options}, _seed(seed),
                                                   _seconds(time_limit), progress)
    return Minimum(*row, numpy.column_stack([evaluations, best]))


def _seed(seed: Any) -> int:
    try:
        number = operator.index(seed)
    except TypeError:
        raise ValueError(f"seed must be a whole number from 0 to 2**64 - 1, got {seed!r}") from None
    if not 0 <= number < 2**64:
        raise ValueError(f"seed must be from 0 to 2**64 - 1, got {number}")
    return number


def _seconds(time_limit: Any) -> Optional[float]:
    if time_limit is None:
        return None
    try:
        seconds = float(time_limit)
    except (TypeError, ValueError):
        seconds = math.nan
    if not seconds > 0:
        raise ValueError(f"time_limit must be a positive number of seconds, got {time_limit!r}")
    return seconds
