# SPDX-License-Identifier: BSD-3-Clause
"""Rows of numbers that a computation has left, one number a sample."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

import numpy


class Rows(Mapping[str, numpy.ndarray]):
    """rows["drive_torque"] is a read-only array that shows the numbers where the program keeps them. What is not determined is
    NaN; `done` and `status` say where, and why."""

    def __init__(self, rows):
        self._rows = rows

    def __getitem__(self, key: str) -> numpy.ndarray:
        return self._rows.row(key)

    def __iter__(self) -> Iterator[str]:
        return iter(self._rows.keys())

    def __len__(self) -> int:
        return len(self._rows.keys())

    @property
    def samples(self) -> int:
        """How many samples there are."""
        return len(self._rows)

    @property
    def done(self) -> numpy.ndarray:
        """Whether each sample is complete."""
        return self._rows.done()

    def status(self, sample: int) -> str:
        """'done', or why a sample is not: 'no_assembly', 'singular', ..."""
        return self._rows.status(sample)

    def __repr__(self):
        return f"<{type(self).__name__}: {self.samples} samples of {', '.join(self)}>"
