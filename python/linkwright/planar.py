# SPDX-License-Identifier: BSD-3-Clause
"""Planar linkages as functions of arrays: what would be called a million times. SI units and radians, as in C++."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Optional

import numpy
from numpy.typing import ArrayLike

from . import _linkwright
from .rows import Rows
from .studies import Study

__all__ = ["FourBar", "FourBarMasses", "FourBarSweep", "LinkMass", "LinkageRows", "LinkageSweep", "coupler_points"]


@dataclass(frozen=True)
class FourBar:
    """Four-bar O-A-B-B0 with a point C on its coupler (m, rad). O = (pivot_x, pivot_y); B0 = O + ground e^(i frame_angle);
    C = A + (coupler_u + i coupler_v) e^(i coupler angle). branch: "open", B to the left of A->B0, or "crossed"."""

    ground: float
    crank: float
    coupler: float
    rocker: float
    coupler_u: float = 0.0
    coupler_v: float = 0.0
    pivot_x: float = 0.0
    pivot_y: float = 0.0
    frame_angle: float = 0.0
    branch: str = "open"


@dataclass(frozen=True)
class LinkMass:
    """Mass (kg) of a link, moment of inertia about its mass centre (kg m2), and where that is: distance from the link's own
    joint (m) and angle from the link line (rad, counter-clockwise)."""

    mass: float = 0.0
    inertia: float = 0.0
    centre_distance: float = 0.0
    centre_angle: float = 0.0


@dataclass(frozen=True)
class FourBarMasses:
    """Own joints: O of the crank (line O->A), A of the coupler (A->B), B0 of the rocker (B0->B)."""

    crank: LinkMass = field(default_factory=LinkMass)
    coupler: LinkMass = field(default_factory=LinkMass)
    rocker: LinkMass = field(default_factory=LinkMass)


class FourBarSweep:
    """Positions, rates and reactions of a four-bar at many crank angles, by the SIMD kernels of the program.

    What is not wanted is not computed:
    directions: crank_x, crank_y, coupler_x, ..., transmission_sine: unit vectors of the links in the global frame
    rates: coupler_speed, rocker_speed (rad/s), coupler_acceleration, rocker_acceleration (rad/s2)
    forces: ground_on_crank_x, ..., crank_on_coupler, rocker_on_coupler, ground_on_rocker (N)
    shaking: drive_torque (N m), shaking_force_x, _y (N), shaking_moment, shaking_moment_with_drive (N m)

    Use one again and again: its memory is taken again once nothing refers to the rows of the last run.
    """

    def __init__(self, *, directions: bool = True, rates: bool = True, forces: bool = True, shaking: bool = True):
        self._sweep = _linkwright.FourBarSweep(directions, rates, forces, shaking)

    def run(self, linkage: FourBar, crank_angle: ArrayLike, *, crank_speed: ArrayLike = 0.0,
            crank_acceleration: ArrayLike = 0.0, masses: Optional[FourBarMasses] = None, gravity: float = 0.0) -> Rows:
        """crank_angle: rad from the ground link; speed (rad/s) and acceleration (rad/s2): one for all angles, or as many.
        masses: None = massless. gravity: m/s2 along -y. Raises ValueError for lengths and masses out of range and for numbers
        that are not finite."""
        return Rows(self._sweep.run(linkage, crank_angle, crank_speed, crank_acceleration, masses, gravity))


def coupler_points(linkage: FourBar, crank_angle: ArrayLike) -> numpy.ndarray:
    """The point C at many crank angles (rad): an array (n, 2) in metres, NaN where the linkage does not assemble."""
    return _linkwright.coupler_points(linkage, crank_angle)


class LinkageRows(Rows):
    """Rows of a linkage: "crank.x", "crank.direction_x", "crank.speed", ...; with forces "joint.force_x", "joint.drive", ..."""

    def point(self, name: str) -> numpy.ndarray:
        """Places of a point "body.point": an array (n, 2) in metres. KeyError when the linkage has no such point."""
        return self._rows.point(name)


class LinkageSweep:
    """Positions, rates and joint forces of any linkage at many inputs. Its mechanism is that of a study: an analysis of a
    planar.linkage, planar.four_bar or planar.slider_crank.

    rates: velocities and accelerations. forces: joint forces, drives and shaking force; they need rates and all masses.

    Raises StudyError when the study has errors, ValueError when it is of another kind or masses are missing.
    """

    def __init__(self, study: Study, *, rates: bool = True, forces: bool = False):
        self._sweep = _linkwright.LinkageSweep(study._source, rates, forces)

    @property
    def inputs(self) -> list[str]:
        """The driven joints, in the order in which `run` takes them."""
        return self._sweep.inputs()

    @property
    def points(self) -> list[str]:
        """All points, "body.point"."""
        return self._sweep.points()

    def run(self, value, *, rate=0.0, acceleration=0.0) -> LinkageRows:
        """value, rate, acceleration of the inputs (rad or m, per second): of a linkage with one input arrays of samples, of
        others a mapping {joint: array}. Rates and accelerations may be one number for all samples."""
        return LinkageRows(self._sweep.run(*(self._per_input(given) for given in (value, rate, acceleration))))

    def _per_input(self, given):
        names = self.inputs
        if isinstance(given, Mapping):
            wrong = sorted(set(given) ^ set(names))
            if wrong:
                raise ValueError(f"the linkage has the inputs {', '.join(names)}; check {', '.join(wrong)}")
            return [numpy.asarray(given[name], dtype=float) for name in names]
        if len(names) != 1 and numpy.ndim(given) > 0:
            raise ValueError(f"the linkage has the inputs {', '.join(names)}: give a mapping {{joint: array}}")
        return [numpy.asarray(given, dtype=float)] * len(names)
