# SPDX-License-Identifier: BSD-3-Clause
"""Tables of results in files: as JSON and CSV, and as files of NumPy where they are long."""

import json
import pathlib
import tempfile
import unittest

import numpy

import linkwright
import program


class TablesInFiles(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = pathlib.Path(scratch.name)

    def assert_same(self, a, b):
        self.assertEqual(a.keys(), b.keys())
        for key in a:
            self.assertEqual(list(a[key].keys()), list(b[key].keys()), key)
            for column, values in a[key].items():
                other = b[key][column]
                if other.dtype.kind == "S":
                    other = numpy.char.decode(other, "utf-8")
                numpy.testing.assert_array_equal(values, other, f"{key}.{column}")

    def test_long_tables_are_those_of_the_result(self):
        for name in ("studies/fourbar-reactions", "studies/fourbar-18-points", "suspension/sweep"):
            with self.subTest(name):
                result = linkwright.read(program.EXAMPLES / f"{name}.toml").run()
                short, long = self.folder / name / "short", self.folder / name / "long"
                result.save(short)
                files = result.save(long, longest_table=3)
                apart = {table: file for table, file in ((f.stem, f) for f in files) if file.suffix == ".npy"}
                self.assertEqual(set(apart), {t.name for t in result.tables.values() if t.rows > 3})
                self.assertFalse([f for f in files if f.suffix == ".csv" and f.stem in apart])
                self.assert_same(linkwright.read_tables(short), linkwright.read_tables(long))
                for table, file in apart.items():
                    rows = numpy.load(file)
                    self.assertEqual(rows.shape, (result.tables[table].rows,))
                    for key, values in result.tables[table].items():
                        if result.study.canonical().get("output", {}).get("units") in (None, "si"):
                            numpy.testing.assert_array_equal(rows[key], values)
                document = json.loads((long / "result.json").read_text())
                for table in document["tables"]:
                    self.assertEqual("file" in table, table["name"] in apart)
                self.assertLess((long / "report.html").stat().st_size, 2 * (short / "report.html").stat().st_size)

    def test_a_folder_without_a_result(self):
        with self.assertRaises(FileNotFoundError):
            linkwright.read_tables(self.folder)


if __name__ == "__main__":
    unittest.main()
