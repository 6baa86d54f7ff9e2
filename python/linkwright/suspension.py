# SPDX-License-Identifier: BSD-3-Clause
"""Wheel suspensions as functions of arrays. SI units and radians; signs as in the tables of studies."""

from __future__ import annotations

from collections.abc import Sequence

from numpy.typing import ArrayLike

from . import _linkwright
from .rows import Rows
from .studies import Study

__all__ = ["WheelSuspension"]


class WheelSuspension:
    """A wheel suspension made ready for solving: that of a study of kind analysis/suspension.corner.

    Raises StudyError when the study has errors, ValueError when it is of another kind.
    """

    def __init__(self, study: Study):
        self._suspension = _linkwright.WheelSuspension(study._source)

    def sweep(self, travel: ArrayLike, rack: ArrayLike = 0.0, *, quantities: Sequence[str] = ()) -> Rows:
        """Wheel parameters over travel and rack (m, each ascending): rows "travel_m", "rack_m", "toe_rad", "camber_rad", ...,
        with the names and numbers of the table `sweep` of the study, whose coordinate travels. All travels of the first rack
        come first. quantities: the keys that are wanted; none = all. What the suspension does not have or does not reach is
        NaN."""
        return Rows(self._suspension.sweep(travel, rack, list(quantities)))
