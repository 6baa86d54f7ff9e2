# SPDX-License-Identifier: BSD-3-Clause
"""Linkwright: analysis, balancing and synthesis of mechanisms.

    import linkwright

    result = linkwright.example("jansen-leg").run()
    result.headline
    result.tables["motion"].to_pandas()

A study is what the command line reads: a mechanism, a task, how to search, what the answer must satisfy. Its names, units and
results are those of the files. See docs/python.md.
"""

from . import parallel, planar, suspension
from ._linkwright import Diagnostic, version as __version__  # noqa: F401  # part of the module for users
from .drawing import draw, draw_study
from .errors import StudyError
from .optimise import Minimum, methods, minimise
from .studies import (Check, Example, Fact, Kind, Result, Sample, Solution, Study, Table, catalogue, example, examples, read,
                      read_tables, run_many, samples, schema, template)

__all__ = ["Check", "Diagnostic", "Example", "Fact", "Kind", "Minimum", "Result", "Sample", "Solution", "Study", "StudyError",
           "Table", "catalogue", "draw", "draw_study", "example", "examples", "methods", "minimise", "parallel", "planar",
           "read", "read_tables", "run_many", "samples", "schema", "suspension", "template"]
