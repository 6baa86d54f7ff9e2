# SPDX-License-Identifier: BSD-3-Clause
"""Studies, and what comes out of them."""

from __future__ import annotations

import html
import json
import os
import pathlib
import shutil
import tempfile
import types
import weakref
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any, NamedTuple, Optional, Union

import numpy

from . import _linkwright


class Fact(NamedTuple):
    """One line of the answer. `value` and `unit`: its number, where its text is just that, else None and ''."""

    label: str
    text: str
    value: Optional[float]
    unit: str
    verdict: str  # "plain", "good" or "bad"


class Check(NamedTuple):
    """One `[[check]]` of a study and its outcome. `value` is NaN, and `message` says why, when there is none."""

    quantity: str
    value: float
    limit: str
    passed: bool
    at: str
    message: str


class Solution(NamedTuple):
    """One of the answers of a synthesis, best first."""

    label: str
    parameters: dict
    objectives: dict
    classification: dict
    defects: list
    study: Optional[Study]  # The study of this design, for further work; None = there is none


class Kind(NamedTuple):
    """A kind of study: `template(kind.name)` is one to start from."""

    name: str
    summary: str
    group: str


class Example(NamedTuple):
    """A study that comes with the program: `example(name)`."""

    name: str
    title: str
    group: str


class Sample(NamedTuple):
    """A built-in mechanism: `sample = "name"` in the `[mechanism]` of a study."""

    name: str
    summary: str
    group: str
    mechanisms: list


class _Scratch:
    """A folder for what an example reads; it lives as long as the study, its copies and its results."""

    def __init__(self, files: Mapping[str, str]):
        self.name = tempfile.mkdtemp(prefix="linkwright-")
        weakref.finalize(self, shutil.rmtree, self.name, ignore_errors=True)

        for file, content in files.items():
            pathlib.Path(self.name, file).write_text(content, encoding="utf-8")

    def __reduce__(self):
        return _Scratch, ({file.name: file.read_text(encoding="utf-8") for file in pathlib.Path(self.name).iterdir()},)


class Study:
    """A study: TOML or JSON text, a dict, a file (pathlib.Path), or another study, which is copied.

    folder: where the files that it names are looked for; by default that of its file, else the current one.
    name: what messages call it.

    Raises StudyError when the text cannot be read. What a study asks for is looked at by `check` and `run`.
    """

    def __init__(self, source: Union[str, os.PathLike, Mapping, Study], *, folder: Union[str, os.PathLike, None] = None,
                 name: str = "study"):
        self._kept = None
        folder = "" if folder is None else os.fspath(folder)
        if isinstance(source, _linkwright.Source):
            self._source = source
        elif isinstance(source, Study):
            self._source, self._kept = source._source.copy(), source._kept
        elif isinstance(source, os.PathLike):
            self._source = _linkwright.read_file(os.fspath(source))
        elif isinstance(source, str):
            if "\n" not in source and source.endswith((".toml", ".json")):
                raise ValueError(f"Study() takes the text of a study; linkwright.read({source!r}) reads a file")
            self._source = _linkwright.read_text(source, name, folder)
        else:
            self._source = _linkwright.from_dict(source, name, folder)

    def set(self, path: str, value: Any) -> None:
        """Puts a value at a key: study.set("mechanism.link[0].length_mm", 40.0). Missing tables are made, and the same key
        with another unit goes, as with `--set` of the command line. A dict {"min": 1, "max": 2} is a design variable.

        Raises StudyError when the path leads through something that is not a table, or past the end of a list.
        """
        self._source.set(path, value)

    def get(self, path: str) -> Any:
        """The value at a key as the study gives it; KeyError when it gives none."""
        return self._source.get(path)

    def changed(self, changes: Mapping[str, Any]) -> Study:
        """A copy with other values: study.changed({"sweep.step_deg": 1.0})."""
        copy = Study(self)
        for path, value in changes.items():
            copy.set(path, value)
        return copy

    def copy(self) -> Study:
        """A study of its own with the same document."""
        return Study(self)

    def check(self) -> list[_linkwright.Diagnostic]:
        """All that is wrong (severity "error") or remarkable ("warning"), with its place; empty = nothing."""
        return self._source.check()

    def run(self, progress: Optional[Callable[[str, float, float], Any]] = None, *, time_limit: Optional[float] = None,
            threads: int = 0) -> Result:
        """Runs the study; its numbers are those of the command line to the last bit, whatever the number of threads.

        progress: called with (stage, fraction, best) a few times a second, in this thread; `best` is NaN while nothing was
            found. When it returns False, the run ends with the best so far.
        time_limit: seconds after which it ends with the best so far.
        threads: 0 = all processors.

        Other threads of Python continue meanwhile; Ctrl-C ends the run within a fraction of a second (KeyboardInterrupt).
        Raises StudyError when the study has errors.
        """
        return Result(self._source.run(progress, time_limit, threads), self)

    @property
    def kind(self) -> str:
        """'analysis/planar.linkage'; raises StudyError when the study has errors."""
        return self._source.kind()

    def to_dict(self) -> dict:
        """The study as it was given."""
        return self._source.document()

    def canonical(self) -> dict:
        """The whole study with its defaults, in SI units; raises StudyError when it has errors."""
        return self._source.canonical()

    def to_toml(self) -> str:
        """The study as the text of a file; remarks of the original are not kept."""
        return self._source.toml()

    def save(self, file: Union[str, os.PathLike]) -> None:
        """Writes the study file; `linkwright run FILE` runs it."""
        pathlib.Path(file).write_text(self.to_toml(), encoding="utf-8")

    def __reduce__(self):
        return _study_beside, (self._source, self._kept)

    def __repr__(self):
        document = self.to_dict()
        mechanism = document.get("mechanism")
        type_ = mechanism.get("type", "?") if isinstance(mechanism, dict) else "?"
        return f"<linkwright.Study {document.get('kind', '?')}/{type_}: {document.get('title', self._source.file)}>"


def _study_beside(source, kept):
    """A study whose files are in a folder of our own, if in any."""
    study = Study(source.in_folder(kept.name) if kept else source)
    study._kept = kept
    return study


class Table(Mapping[str, numpy.ndarray]):
    """Columns of a result: table["crank_angle_rad"] is a read-only NumPy array that shows the numbers where the program keeps
    them. Missing numbers are NaN. Keys carry their units, which are SI unless `[output] units` of the study says otherwise.
    """

    def __init__(self, table):
        self._table = table

    @property
    def name(self) -> str:
        """'motion'"""
        return self._table.name

    @property
    def rows(self) -> int:
        """number of rows"""
        return self._table.rows

    @property
    def names(self) -> list[str]:
        """names of the rows; empty = they have none"""
        return self._table.names

    @property
    def status(self) -> list[str]:
        """of each row: 'done', or why it is incomplete"""
        return self._table.status

    def __getitem__(self, key: str) -> numpy.ndarray:
        return self._table.column(key)

    def __iter__(self) -> Iterator[str]:
        return iter(self._table.keys())

    def __len__(self) -> int:
        return len(self._table.keys())

    @property
    def columns(self) -> dict[str, numpy.ndarray]:
        """{key: array}"""
        return dict(self)

    @property
    def units(self) -> dict[str, str]:
        """{key: unit}: 'rad', 'N m'; '' = without unit"""
        return {key: self._table.unit(key) for key in self}

    @property
    def labels(self) -> dict[str, str]:
        """{key: label for people}"""
        return {key: self._table.label(key) for key in self}

    def to_pandas(self):
        """A pandas.DataFrame with these columns and `status` as the last one; rows with names have them as index."""
        import pandas
        frame = pandas.DataFrame(self.columns, index=self.names or None)
        frame["status"] = self.status
        return frame

    def to_csv(self) -> str:
        """The text of the CSV file that the command line writes."""
        return self._table.csv()

    def __repr__(self):
        keys = list(self)
        some = ", ".join(keys if len(keys) <= 6 else [*keys[:5], f"... {len(keys)} columns"])
        return f"<linkwright.Table {self.name}: {self.rows} rows of {some}>"


# What a pickle keeps of a run: all but what reports and drawings are made from.
_PICKLED = ("checks", "diagnostics", "exit_code", "facts", "headline", "json", "reasons", "seconds", "solutions", "statistics",
            "status", "tables", "title", "verdict")


class Result:
    """What a study gave. Numbers are in the units that its `[output]` asks for, SI by default, as in result.json and CSV. It can
    be pickled, for workers of multiprocessing; `report` and `save` are then left to the process that ran the study."""

    def __init__(self, run, study):
        self._run, self._study, self._cache = run, Study(study), {}

    @property
    def study(self) -> Study:
        """the study that was run"""
        return Study(self._study)

    @property
    def headline(self) -> str:
        """the answer in one sentence"""
        return self._run.headline

    @property
    def status(self) -> str:
        """'done', 'deadline', 'cancelled', 'infeasible', ..."""
        return self._run.status

    @property
    def verdict(self) -> str:
        """'passed', 'doubtful', 'incomplete' or 'failed'"""
        return self._run.verdict

    @property
    def reasons(self) -> list[str]:
        """why; empty for 'passed'"""
        return self._run.reasons

    @property
    def exit_code(self) -> int:
        """of the command line: 0 done, 1 a check failed, 3 no answer, 4 cancelled"""
        return self._run.exit_code

    @property
    def seconds(self) -> float:
        """wall-clock time of the run"""
        return self._run.seconds

    @property
    def diagnostics(self) -> list[_linkwright.Diagnostic]:
        """remarks and warnings"""
        return self._run.diagnostics

    def _once(self, name, make):
        if name not in self._cache:
            self._cache[name] = make()
        return self._cache[name]

    @property
    def facts(self) -> list[Fact]:
        """list of Fact"""
        return self._once("facts", lambda: [Fact(*row) for row in self._run.facts])

    @property
    def checks(self) -> list[Check]:
        """list of Check"""
        return self._once("checks", lambda: [Check(*row) for row in self._run.checks])

    @property
    def tables(self) -> dict[str, Table]:
        """{name: Table}"""
        return self._once("tables", lambda: {table.name: Table(table) for table in self._run.tables})

    @property
    def solutions(self) -> list[Solution]:
        """list of Solution, best first; empty for an analysis"""
        return self._once("solutions", lambda: [Solution(*row[:5], self._study_of(row[5])) for row in self._run.solutions])

    @property
    def files(self) -> dict[str, str]:
        """{name: text}: files for other programs, such as lists of hard points; `save` writes them as well"""
        return self._once("files", lambda: dict(self._run.files))

    @property
    def statistics(self) -> dict:
        """dict: evaluations, best, median, success_rate, ...; empty when there are none"""
        return self._once("statistics", lambda: self._run.statistics)

    def _study_of(self, source):
        if source is None:
            return None
        return _study_beside(source, self._study._kept)

    def to_json(self) -> str:
        """The text of result.json, described by `linkwright schema result`."""
        return self._run.json

    def to_dict(self) -> dict:
        """The document of result.json."""
        return json.loads(self.to_json())

    def report(self, file: Union[str, os.PathLike]) -> None:
        """Writes the report: one HTML file that needs no network. Raises OSError when it cannot be written."""
        self._run_here().write_report(os.fspath(file))

    def save(self, folder: Union[str, os.PathLike], *, longest_table: int = 1_000_000) -> list[pathlib.Path]:
        """Writes into a folder what the command line writes: report, result.json, CSV, drawings, designs. Returns the files.
        Tables of more than `longest_table` rows go to files of NumPy, which `read_tables` opens. Raises OSError for what cannot
        be written."""
        return [pathlib.Path(name) for name in self._run_here().save(os.fspath(folder), longest_table)]

    def _run_here(self):
        if not isinstance(self._run, _linkwright.Run):
            raise RuntimeError("a Result that was pickled has no report and no files; make them where the study was run")
        return self._run

    def __copy__(self):
        return Result(self._run, self._study)

    def __deepcopy__(self, memo):
        return Result(self._run, self._study)  # a result does not change

    def __reduce__(self):
        return Result, (types.SimpleNamespace(**{name: getattr(self._run, name) for name in _PICKLED}), self._study)

    def _repr_html_(self) -> Optional[str]:
        if not isinstance(self._run, _linkwright.Run):
            return None
        return (f'<iframe title="{html.escape(self._run.title)}" srcdoc="{html.escape(self._run.report())}" '
                'style="width: 100%; height: 640px; border: 1px solid #ccc" allowfullscreen></iframe>')

    def __repr__(self):
        return f"<linkwright.Result {self.verdict}: {self.headline}>"


def read(file: Union[str, os.PathLike]) -> Study:
    """The study in a TOML or JSON file. Files that it names are looked for beside it."""
    return Study(pathlib.Path(file))


def read_tables(folder: Union[str, os.PathLike]) -> dict[str, dict[str, numpy.ndarray]]:
    """The tables of a result in a folder, as the command line or `Result.save` has written it: by name, and in each its columns by
    their keys. `status`, and `name` where rows have names, are texts; missing numbers are NaN. Long tables are mapped from their
    files, not read: their texts are bytes. Raises OSError where there is no result."""
    folder = pathlib.Path(folder)
    tables = {}
    for table in json.loads((folder / "result.json").read_text(encoding="utf-8"))["tables"]:
        if "file" in table:
            rows = numpy.load(folder / table["file"], mmap_mode="r")
            tables[table["name"]] = {key: rows[key] for key in rows.dtype.names}
            continue
        columns = {"name": numpy.array(table["names"])} if "names" in table else {}
        for column, data in zip(table["columns"], table["data"]):
            columns[column["key"]] = numpy.array(data, dtype=None if column["key"] == "status" else float)
        tables[table["name"]] = columns
    return tables


def run_many(studies: Iterable[Study], *, threads: int = 2, time_limit: Optional[float] = None,
             progress: Optional[Callable[[int, int], Any]] = None) -> list[Optional[Result]]:
    """Runs several studies, `threads` at a time and each in one thread: for sweeps of parameters. Results come in the order of
    the studies.

    time_limit: seconds for each of them.
    progress: called with (done, all) in this thread. When it returns False, the runs end; those that were not begun are None.

    Raises StudyError before the first run when one of them has errors.
    """
    studies = list(studies)
    runs = _linkwright.run_many([study._source for study in studies], progress, time_limit, threads, 1)
    return [Result(run, study) if run is not None else None for run, study in zip(runs, studies)]


def example(name: str) -> Study:
    """A study that comes with the program, by its name or a part of it that no other has: example("jansen-leg")."""
    found = _linkwright.examples(name)
    if len(found) != 1:
        some = ", ".join(row[0] for row in found[:8])
        raise LookupError(f"several examples fit '{name}': {some}" if found else
                          f"there is no example '{name}'; linkwright.examples() lists them")
    name, _, _, text, beside = found[0]
    if not beside:
        return Study(text, name=name + ".toml")
    kept = _Scratch(beside)
    return _study_beside(_linkwright.read_text(text, name + ".toml", kept.name), kept)


def template(kind: str) -> Study:
    """A complete study of a kind, as `linkwright new` writes it: template("synthesis/planar.four_bar/path_points"). The
    beginning or a part of the name is enough where no other kind has it. Raises StudyError when there is no such kind."""
    name, text = _linkwright.template(kind)
    return Study(text, name=name)


def catalogue() -> list[Kind]:
    """All kinds of studies: list of Kind."""
    return [Kind(k["name"], k["summary"], k["group"]) for k in _linkwright.catalogue()["kinds"]]


def examples(text: str = "") -> list[Example]:
    """The examples that are called so, or that all words of the text fit, as `linkwright examples` finds them: list of Example."""
    return [Example(*row[:3]) for row in _linkwright.examples(text)]


def samples() -> list[Sample]:
    """Built-in linkages and wheel suspensions: list of Sample."""
    return [Sample(s["name"], s["summary"], s["group"], s["mechanisms"]) for s in _linkwright.catalogue()["samples"]]


def schema(kind: str) -> dict:
    """The JSON Schema of the studies of a kind, as a dict. Raises LookupError when there is none of that name."""
    found = _linkwright.schema(kind)
    if found is None:
        raise LookupError(f"there is no kind '{kind}'; linkwright.catalogue() lists them")
    return found
