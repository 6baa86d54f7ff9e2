# SPDX-License-Identifier: BSD-3-Clause
"""From a drawn motion to machines that trace it."""

from __future__ import annotations

from typing import Optional, Sequence

import numpy
from numpy.typing import ArrayLike

from .studies import Result, Study

__all__ = ["draw", "draw_study"]


def draw_study(points: ArrayLike, *, closed: Optional[bool] = None, seconds: Optional[float] = None,
               evaluations: Optional[int] = None, most_links: int = 8, families: Optional[Sequence[str]] = None,
               tolerance: Optional[float] = None, crank_angles: Optional[ArrayLike] = None,
               body_angles: Optional[ArrayLike] = None, orientation_length: Optional[float] = None,
               least_pair_angle: float = 20.0, shortest_link: float = 0.05, longest_link: float = 10.0,
               ground_box: Optional[ArrayLike] = None, ground_pivots: Optional[ArrayLike] = None, crank_turns: bool = True,
               max_solutions: int = 12, seed: int = 1) -> Study:
    """The study that `draw` runs: "synthesis" of "planar.any" for "path_points", or for "poses" where body_angles are given.

    points: the stroke in metres: an array (n, 2), or n complex numbers; at least 5.
    closed: whether the last point is followed by the first; None: only where it repeats it.
    seconds: time of the search, 10 when evaluations are not given. evaluations: number of curves instead, for the same result
    on every machine with the same instruction set and any number of threads.
    most_links: 4 to 10. families: "four_bar", "slider_crank", "inverted_slider", "geared_five_bar", "watt_1", "stephenson_1",
    "stephenson_2", "stephenson_3", "eight_bar", "ten_bar"; None: all.
    tolerance: metres; distances of the curve from the stroke up to this one count as none. crank_angles: one for each point, in
    degrees, rising or falling; their differences are the rotations of the crank, in either sense. None: any.
    body_angles: one for each point, in degrees: the rotation of a body whose origin is there. The points then are poses, 3 to 96, and
    nothing is asked between them. orientation_length: metres that an error of a radian counts as; None: the size of the stroke.
    least_pair_angle: degrees, over the whole turn of the crank. shortest_link, longest_link: in sizes of the stroke, which are
    its root mean square distance from its mean.
    ground_box: [[least x, greatest x], [least y, greatest y]] in metres, around all pivots on the ground. ground_pivots: an array
    (n, 2) in metres, at each row of which the machine has a pivot on the ground.
    crank_turns: False lets the drive of an open stroke, or of open poses, rock over the range that it needs.

    Raises ValueError for points or angles of another shape.
    """
    stroke = numpy.asarray(points)
    if numpy.iscomplexobj(stroke):
        stroke = numpy.stack([stroke.real, stroke.imag], axis=-1)
    stroke = stroke.astype(float)
    if stroke.ndim != 2 or stroke.shape[1] != 2:
        raise ValueError(f"points must be an array (n, 2) or complex numbers, got the shape {stroke.shape}")
    target = {"type": "path_points", "points_m": stroke.tolist()}
    if closed is not None:
        target["closed"] = bool(closed)
    if body_angles is not None:
        angles = numpy.asarray(body_angles, dtype=float)
        if angles.shape != (len(stroke),):
            raise ValueError(f"body_angles must be an array ({len(stroke)},), got the shape {angles.shape}")
        target = {"type": "poses", "pose": [{"x_m": x, "y_m": y, "angle_deg": turn}
                                            for (x, y), turn in zip(stroke.tolist(), angles.tolist())]}
        if orientation_length is not None:
            target["orientation_length_m"] = float(orientation_length)
        if closed is not None:
            target["closed"] = bool(closed)
    if tolerance is not None:
        target["tolerance_m"] = float(tolerance)
    if crank_angles is not None:
        target["timing"] = {"mode": "given", "angles_deg": numpy.asarray(crank_angles, dtype=float).tolist()}
    mechanism = {"type": "planar.any", "most_links": most_links}
    if families is not None:
        mechanism["families"] = list(families)
    optimiser = {"seeds": {"first": seed, "count": 1}, "max_solutions": max_solutions}
    if seconds is not None:
        optimiser["seconds"] = float(seconds)
    if evaluations is not None:
        optimiser["evaluations"] = int(evaluations)
    limits = {"least_pair_angle_deg": least_pair_angle, "shortest_link": shortest_link, "longest_link": longest_link}
    if ground_box is not None:
        (left, right), (bottom, top) = numpy.asarray(ground_box, dtype=float).tolist()
        limits["ground_box_m"] = {"x": [left, right], "y": [bottom, top]}
    if ground_pivots is not None:
        limits["ground_pivots_m"] = numpy.asarray(ground_pivots, dtype=float).tolist()
    if not crank_turns:
        limits["crank_turns"] = False
    return Study({"schema": 1, "kind": "synthesis", "title": "Drawn motion", "mechanism": mechanism, "target": target,
                  "limits": limits, "optimiser": optimiser})


def draw(points: ArrayLike, **options) -> Result:
    """Machines of many types that trace a stroke, best first in `solutions`; each has a study of its own (`Solution.study`).

    points and options are those of `draw_study`: closed, seconds or evaluations, most_links, families, tolerance,
    crank_angles, body_angles, orientation_length, least_pair_angle, shortest_link, longest_link, ground_box, ground_pivots,
    crank_turns, max_solutions, seed.

    Raises ValueError for points of another shape and StudyError for a stroke or limits that the study does not take.
    """
    return draw_study(points, **options).run()
