# SPDX-License-Identifier: BSD-3-Clause
"""Studies in Python give what the command line gives: bits, messages, files."""

import concurrent.futures
import copy
import gc
import json
import math
import multiprocessing
import pathlib
import pickle
import tempfile
import threading
import unittest

import numpy

import linkwright
import program

FOUR_BAR = program.EXAMPLES / "studies" / "fourbar-reactions.toml"
# One of each domain, searches with seeds, tables with names and with missing numbers, studies that read other files.
COMPARED = ["studies/fourbar-reactions", "studies/jansen-leg", "studies/fourbar-18-points", "studies/andrews-squeezer",
            "studies/balance-four-bar-case-3-masses", "studies/kane-beam", "studies/clearance-four-bar-design-2",
            "suspension/sweep", "suspension/bump-steer", "robots/packing-line", "robots/small-motor"]


class WithFolder(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)


class ResultsOfTheCommandLine(WithFolder):
    def test_numbers_texts_and_files_are_the_same(self):
        for name in COMPARED:
            with self.subTest(name):
                file = program.EXAMPLES / f"{name}.toml"
                theirs, ours = self.folder / "theirs" / name, self.folder / "ours" / name
                ours.mkdir(parents=True)
                code, _, _ = program.call("run", file, "--out", theirs)
                result = linkwright.read(file).run()
                self.assertEqual(code, result.exit_code)

                document = json.loads((theirs / "result.json").read_text())
                again = result.to_dict()
                self.assertEqual(set(document.pop("run")), set(again.pop("run")))
                self.assertEqual(document, again)
                self.assertEqual(document["answer"]["headline"], result.headline)
                self.assertEqual(document["answer"]["verdict"], result.verdict)
                self.assertEqual(document["answer"]["reasons"], result.reasons)
                self.assertEqual(document["status"], result.status)
                self.assertEqual([f["text"] for f in document["answer"]["facts"]], [f.text for f in result.facts])
                self.assertEqual([c["passed"] for c in document["checks"]], [c.passed for c in result.checks])

                self.assertEqual({t["name"] for t in document["tables"]}, set(result.tables))
                for table in result.tables.values():
                    text = (theirs / f"{table.name}.csv").read_bytes().decode()
                    self.assertEqual(text, table.to_csv())
                    for key, numbers in program.columns(text).items():
                        numpy.testing.assert_array_equal(table[key], numbers)

                result.save(ours)
                self.assertEqual(self.files(theirs), self.files(ours))
                for design in theirs.glob("designs/*.toml"):
                    self.assertEqual(design.read_text(), (ours / "designs" / design.name).read_text())

    @staticmethod
    def files(folder):
        """All but what only a run of the command line that can be resumed keeps."""
        return sorted(str(path.relative_to(folder)) for path in folder.rglob("*")
                      if path.is_file() and path.name != "checkpoint.jsonl")

    def test_designs_are_studies_to_continue_with(self):
        study = linkwright.example("fourbar-18-points")
        best = study.run().solutions[0]
        self.assertAlmostEqual(best.objectives["path_error_sum_sq_m2"], 0.00902888, delta=5e-9)
        self.assertGreater(best.parameters["crank_m"], 0)
        motion = best.study.run()
        self.assertTrue(best.study.kind.startswith("analysis/"))
        self.assertEqual("done", motion.status)

    def test_number_of_threads_changes_nothing(self):
        study = linkwright.example("path-gates")
        one, two = study.run(threads=1), study.run(threads=2)
        for name, table in one.tables.items():
            for key in table:
                numpy.testing.assert_array_equal(table[key], two.tables[name][key])

    def test_time_limit_keeps_the_best(self):
        result = linkwright.example("fourbar-18-points-free-timing-20").run(time_limit=0.3)
        self.assertEqual("deadline", result.status)
        self.assertLess(result.seconds, 1.5)


class Reports(WithFolder):
    def test_report_is_one_file_and_is_shown_in_a_notebook(self):
        result = linkwright.read(FOUR_BAR).run()
        result.report(self.folder / "r.html")
        text = (self.folder / "r.html").read_text()
        self.assertTrue(text.startswith("<!"))
        self.assertIn(f"linkwright run {FOUR_BAR}", text)
        self.assertRegex(result._repr_html_(), r'^<iframe [^>]*srcdoc="&lt;!')

    def test_what_cannot_be_written_is_said(self):
        result = linkwright.read(FOUR_BAR).run()
        (self.folder / "file").write_text("")
        with self.assertRaisesRegex(OSError, "cannot be"):
            result.save(self.folder / "file")
        with self.assertRaisesRegex(OSError, "cannot be written"):
            result.report(self.folder / "no" / "r.html")


class Tables(unittest.TestCase):
    def setUp(self):
        self.result = linkwright.read(FOUR_BAR).run()
        self.table = self.result.tables["sweep"]

    def test_columns_are_the_numbers_of_the_program(self):
        key = next(iter(self.table))
        a, b = self.table[key], linkwright.Result(self.result._run, self.result.study).tables["sweep"][key]
        self.assertEqual(a.__array_interface__["data"], b.__array_interface__["data"])
        self.assertTrue(numpy.shares_memory(a, b))
        self.assertIsNotNone(a.base)
        self.assertFalse(a.flags.writeable)
        self.assertFalse(a.flags.owndata)
        with self.assertRaises(ValueError):
            a[0] = 1
        with self.assertRaises(ValueError):
            a.flags.writeable = True

    def test_columns_outlive_their_result(self):
        key = "O1_drive_torque_N_m" if "O1_drive_torque_N_m" in self.table else list(self.table)[-1]
        column, kept = self.table[key], self.table[key].copy()
        del self.table, self.result
        gc.collect()
        junk = [linkwright.read(FOUR_BAR).run() for _ in range(3)]
        numpy.testing.assert_array_equal(column, kept)
        self.assertEqual(3, len(junk))

    def test_a_table_is_a_mapping(self):
        self.assertEqual(set(self.table), set(self.table.columns))
        self.assertEqual(201, self.table.rows)
        self.assertEqual(["done"] * 201, self.table.status)
        self.assertEqual({"rad"}, {self.table.units[key] for key in self.table if key.endswith("_rad")})
        self.assertIn("rad", self.table.labels[next(iter(self.table))])
        with self.assertRaises(KeyError):
            self.table["crank_angle_furlong"]

    def test_units_are_those_of_the_output(self):
        turned = linkwright.read(FOUR_BAR).changed({"output.units": ["deg"]}).run().tables["sweep"]
        key = next(key for key in self.table if key.endswith("angle_rad"))
        numpy.testing.assert_allclose(numpy.radians(turned[key.replace("_rad", "_deg")]), self.table[key], rtol=1e-15)

    def test_pandas(self):
        try:
            import pandas  # noqa: F401
        except ImportError:
            self.skipTest("pandas is not installed")
        frame = self.table.to_pandas()
        self.assertEqual([*self.table, "status"], list(frame.columns))
        for key in self.table:
            numpy.testing.assert_array_equal(frame[key], self.table[key])


class Sources(WithFolder):
    def test_text_dict_file_and_json_are_one_study(self):
        text = FOUR_BAR.read_text()
        studies = [linkwright.read(FOUR_BAR), linkwright.Study(text), linkwright.Study(FOUR_BAR)]
        studies.append(linkwright.Study(studies[0].to_dict()))
        studies.append(linkwright.Study(json.dumps(studies[0].to_dict())))
        studies.append(linkwright.Study(studies[0].to_toml()))
        studies[0].save(self.folder / "again.toml")
        studies.append(linkwright.read(self.folder / "again.toml"))
        for study in studies[1:]:
            self.assertEqual(studies[0].canonical(), study.canonical())

    def test_numbers_of_numpy_are_numbers(self):
        study = linkwright.example("arc-5-points-timed")
        points = study.get("target.points_m")
        given = study.changed({"target.points_m": numpy.array(points), "optimiser.seeds.first": numpy.int64(3)})
        self.assertEqual(points, given.get("target.points_m"))
        self.assertIs(int, type(given.get("optimiser.seeds.first")))
        for wrong in (object(), {1: 2}, {"a": [1, {2}]}, 1j, 2**70):
            with self.assertRaises((TypeError, ValueError)):
                study.set("target.points_m", wrong)

    def test_nesting_has_a_limit(self):
        class Deep:
            def tolist(self):
                return self

        def nested(levels):
            value = 1
            for _ in range(levels):
                value = [value]
            return value

        circle, ring = {}, []
        circle["a"] = {"b": circle}
        ring.append(ring)
        study = linkwright.example("hoeken")
        for wrong in (circle, {"a": ring}, {"a": nested(50000)}, {"a": nested(65)}, {"a": Deep()}):
            for take in (linkwright.Study, lambda value: study.set("a", value)):
                with self.assertRaisesRegex(ValueError, "a: tables and arrays are nested more than 64 deep"):
                    take(wrong)
        with self.assertRaisesRegex(ValueError, "a: tables and arrays are nested more than 64 deep"):
            linkwright.minimise(lambda x: x.sum(axis=1), [0], [1], a=ring)
        study.set("a", nested(63))
        self.assertEqual(nested(63), linkwright.Study({"a": nested(63)}).get("a"))
        # No way around it by what is put into what is there already.
        with self.assertRaisesRegex(linkwright.StudyError, "is not the path of a key"):
            study.set("a" + "[0]" * 64, nested(63))

    def test_templates_of_all_kinds_are_without_errors(self):
        for kind in linkwright.catalogue():
            study = linkwright.template(kind.name)
            self.assertEqual([], [str(d) for d in study.check() if d.severity == "error"])
            self.assertEqual(kind.name, study.kind)
            self.assertEqual("object", linkwright.schema(kind.name)["type"])

    def test_examples_bring_the_files_that_they_read(self):
        result = linkwright.example("bump-steer").run()
        gc.collect()
        self.assertEqual("passed", result.verdict)
        self.assertEqual("passed", result.solutions[0].study.run().verdict)
        self.assertEqual("passed", result.study.run().verdict)
        self.assertGreater(len(linkwright.examples()), 50)
        self.assertIn("jansen_leg", [s.name for s in linkwright.samples()])

    def test_names_that_lead_nowhere(self):
        for ask in (lambda: linkwright.example("no such thing"), lambda: linkwright.example("four"),
                    lambda: linkwright.schema("no/kind")):
            with self.assertRaises(LookupError):
                ask()
        with self.assertRaises(linkwright.StudyError):
            linkwright.template("no such kind")
        with self.assertRaisesRegex(ValueError, r"linkwright.read\('four.toml'\)"):
            linkwright.Study("four.toml")


class Errors(WithFolder):
    def lines(self, *arguments):
        code, _, said = program.call("run", *arguments, folder=self.folder)
        self.assertEqual(2, code)
        return [line for line in said.splitlines() if not line.endswith(" errors")]

    def test_messages_of_the_command_line(self):
        text = FOUR_BAR.read_text()
        damaged = [text.replace("crank_", "crnk_"), text.replace("[mechanism]", "[mechanism"), "", "x = 1", text + "\nunknown = 2\n",
                   text.replace("schema", "shema"), "{}", "{"]
        for i, wrong in enumerate(damaged):
            with self.subTest(i):
                file = self.folder / f"{i}.toml"
                file.write_text(wrong)
                for read in (lambda: linkwright.read(file), lambda: linkwright.Study(wrong, name=str(file))):
                    with self.assertRaises(linkwright.StudyError) as caught:
                        read().run()
                    self.assertEqual(self.lines(file), str(caught.exception).splitlines())
        file = self.folder / "missing.toml"
        with self.assertRaises(linkwright.StudyError) as caught:
            linkwright.read(file)
        self.assertEqual(self.lines(file), str(caught.exception).splitlines())

    def test_check_says_where(self):
        study = linkwright.Study(FOUR_BAR.read_text().replace("crank_", "crnk_"), name="mine")
        found = study.check()
        self.assertTrue(any(d.message == "unknown key" and d.line > 0 and d.column > 0 and d.key for d in found))
        self.assertTrue(str(found[0]).startswith("mine:"))
        with self.assertRaises(linkwright.StudyError) as caught:
            study.run()
        self.assertEqual([str(d) for d in found], [str(d) for d in caught.exception.diagnostics])
        self.assertEqual([], linkwright.read(FOUR_BAR).check())

    def test_changes_are_those_of_set_on_the_command_line(self):
        study = linkwright.read(FOUR_BAR)
        study.set("sweep.crank_angle.samples", 13)
        study.set("environment.gravity_m_per_s2", 1.62)
        out = self.folder / "out"
        program.call("run", FOUR_BAR, "--out", out, "--set", "sweep.crank_angle.samples=13", "--set",
                     "environment.gravity_m_per_s2=1.62")
        self.assertEqual((out / "sweep.csv").read_bytes().decode(), study.run().tables["sweep"].to_csv())

        copy = study.changed({"sweep.crank_angle.samples": 7})
        self.assertEqual((13, 7), (study.get("sweep.crank_angle.samples"), copy.get("sweep.crank_angle.samples")))
        with self.assertRaises(KeyError):
            study.get("sweep.nothing")
        for path, value, said in [("sweep.crank_angle.samples", "many", 'set("sweep.crank_angle.samples", "many"): error'),
                                  ("title.x", 1, "'x' is not in a table"), ("a..b", 1, "is not the path of a key")]:
            with self.assertRaises(linkwright.StudyError) as caught:
                study.changed({path: value}).run()
            self.assertIn(said, str(caught.exception))


def crossing(study):
    """Run in another process: the result, or what was raised."""
    return study.run()


class Pickles(WithFolder):
    def again(self, what):
        return pickle.loads(pickle.dumps(what))

    def test_studies_are_the_same_with_their_messages(self):
        file = self.folder / "wrong.toml"
        file.write_text(FOUR_BAR.read_text().replace("crank_", "crnk_"))
        study = linkwright.read(file)
        study.set("sweep.crank_angle.samples", "many")
        same = self.again(study)
        self.assertEqual(study.to_dict(), same.to_dict())
        self.assertEqual([str(d) for d in study.check()], [str(d) for d in same.check()])
        self.assertTrue(any(":" in str(d).split(" ")[0] for d in same.check()))

    def test_files_of_examples_go_with_them(self):
        study = linkwright.example("bump-steer")
        text = pickle.dumps(study)
        headline = study.run().headline
        del study
        gc.collect()
        result = self.again(pickle.loads(text).run())
        self.assertEqual(headline, result.headline)
        self.assertEqual("passed", result.solutions[0].study.run().verdict)

    def test_results_have_all_numbers(self):
        result = linkwright.example("fourbar-18-points").run()
        same = self.again(self.again(result))
        for name in ("headline", "status", "verdict", "reasons", "exit_code", "seconds", "facts", "checks", "statistics"):
            self.assertEqual(getattr(result, name), getattr(same, name), name)
        self.assertEqual(result.to_json(), same.to_json())
        self.assertEqual(list(result.tables), list(same.tables))
        for name, table in result.tables.items():
            self.assertEqual(table.to_csv(), same.tables[name].to_csv())
            self.assertEqual((table.units, table.labels), (same.tables[name].units, same.tables[name].labels))
        self.assertEqual(result.solutions[0].parameters, same.solutions[0].parameters)
        self.assertIn("<linkwright.Result", repr(same))
        with self.assertRaisesRegex(RuntimeError, "where the study was run"):
            same.save(self.folder)
        copy.deepcopy(result).report(self.folder / "r.html")

    def test_workers_give_results_and_messages(self):
        good = linkwright.read(FOUR_BAR)
        wrong = good.changed({"mechanism.branch": "opn"})
        with concurrent.futures.ProcessPoolExecutor(1, multiprocessing.get_context("spawn")) as pool:
            self.assertEqual(good.run().tables["sweep"].to_csv(), pool.submit(crossing, good).result().tables["sweep"].to_csv())
            with self.assertRaises(linkwright.StudyError) as here:
                wrong.run()
            with self.assertRaises(linkwright.StudyError) as there:
                pool.submit(crossing, wrong).result()
        self.assertEqual(str(here.exception), str(there.exception))
        self.assertEqual([d.key for d in here.exception.diagnostics], [d.key for d in there.exception.diagnostics])


class Many(unittest.TestCase):
    def test_many_at_once_are_as_one_by_one(self):
        study = linkwright.read(FOUR_BAR)
        speeds = [float(100 * i) for i in range(1, 21)]
        studies = [study.changed({"drive.speed_rpm": speed}) for speed in speeds]
        seen = []
        results = linkwright.run_many(studies, threads=2, progress=lambda done, all: seen.append((done, all)))
        self.assertEqual((20, 20), seen[-1])
        for alone, result in zip(studies, results):
            self.assertEqual(alone.run().tables["sweep"].to_csv(), result.tables["sweep"].to_csv())
        self.assertEqual([], linkwright.run_many([]))
        with self.assertRaises(ValueError):
            linkwright.run_many(studies, threads=0)

    def test_one_wrong_study_stops_all_before_they_begin(self):
        study = linkwright.read(FOUR_BAR)
        with self.assertRaises(linkwright.StudyError):
            linkwright.run_many([study, study.changed({"mechanism.branch": "opn"})])

    def test_python_threads_may_run_studies(self):
        csv = linkwright.read(FOUR_BAR).run().tables["sweep"].to_csv()
        found = []
        threads = [threading.Thread(target=lambda: found.append(linkwright.read(FOUR_BAR).run().tables["sweep"].to_csv()))
                   for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual([csv] * 8, found)
        self.assertFalse(math.isnan(linkwright.read(FOUR_BAR).run().seconds))


if __name__ == "__main__":
    unittest.main()
