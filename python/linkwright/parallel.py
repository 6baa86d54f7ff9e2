# SPDX-License-Identifier: BSD-3-Clause
"""Kinematics of parallel robots as functions of arrays. Base axes with z up; metres and radians."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Optional

import numpy
from numpy.typing import ArrayLike

from . import _linkwright

__all__ = ["Robot", "delta", "direct", "five_bar", "hexa", "inverse"]

Robot = _linkwright.Robot


def delta(base_radius: float, platform_radius: float, arm: float, rod: float,
          azimuth: Sequence[float] = (0.0, 2 * math.pi / 3, 4 * math.pi / 3)) -> Robot:
    """Symmetric DELTA with its legs at `azimuth` (rad, counter-clockwise from x, seen from above). Arm angles are positive
    downwards, the platform hangs below. Raises ValueError for dimensions that make no robot."""
    return _linkwright.delta(base_radius, platform_radius, arm, rod, list(azimuth))


def hexa(base_radius: float, base_offset: float, platform_radius: float, platform_angle: float, arm: float,
         rod: float) -> Robot:
    """Symmetric HEXA: pairs of legs at 0, 120 and 240 deg. base_offset: half the distance of a pair's pivots; platform_angle:
    half the angle between a pair's joints, seen from the platform point."""
    return _linkwright.hexa(base_radius, base_offset, platform_radius, platform_angle, arm, rod)


def five_bar(first: Sequence[float], second: Sequence[float]) -> Robot:
    """Five-bar (5R) of two legs, each (base_x, base_y, arm, rod) in metres; arm angles counter-clockwise from x."""
    return _linkwright.five_bar([list(first), list(second)])


def inverse(robot: Robot, position: ArrayLike, rotation: Optional[ArrayLike] = None, *,
            mode: Sequence[int] = ()) -> numpy.ndarray:
    """Arm angles (n, legs) of poses: positions (n, 3) of the platform point, of a HEXA also rotations (n, 3, 3). NaN for legs
    that cannot reach. mode: on which side of the straight leg each elbow is, 1 or -1; none = 1 for all."""
    none = numpy.empty(0)
    return _linkwright.inverse(robot, position, none if rotation is None else rotation, list(mode))


def direct(robot: Robot, angle: ArrayLike, *, assembly: int) -> numpy.ndarray:
    """Positions (n, 3) of the platform point for arm angles (n, legs), of robots that do not turn; NaN where there is none.
    assembly: -1 for a DELTA whose platform hangs below; 1 for a planar robot whose platform is on the left of the line from
    the first to the second elbow. Raises ValueError for a HEXA."""
    return _linkwright.direct(robot, angle, assembly)
