# SPDX-License-Identifier: BSD-3-Clause
"""Treats an installed program as an unlucky user and a tired machine do.

    attacks.py PROGRAM

Read-only results, full disks, too little memory, signals while it waits, and a shard that was copied over another: each
ends with its own exit code and words, and leaves no file behind that was written in part.
"""

import os
import pathlib
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

PROGRAM = pathlib.Path(sys.argv.pop(1)).resolve()
STUDY = "hoeken"


def limited(what, amount):
    """Sets a limit of the system in the child before it becomes the program."""
    return lambda: resource.setrlimit(what, (amount, amount))


class Attacks(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.call("examples", "--copy", STUDY)

    def start(self, *arguments, **options):
        process = subprocess.Popen([PROGRAM, *map(str, arguments)], cwd=self.folder, text=True, stdin=subprocess.PIPE,
                                   stdout=subprocess.PIPE, stderr=subprocess.PIPE, **options)
        self.addCleanup(process.communicate)
        self.addCleanup(process.kill)
        return process

    def call(self, *arguments, code=0, **options):
        process = self.start(*arguments, **options)
        out, err = process.communicate(timeout=100)
        self.assertEqual(code, process.returncode, out + err)
        return out + err

    def nothing_partial(self):
        self.assertEqual([], list(self.folder.rglob("*.part")))

    def test_a_read_only_result_is_kept(self):
        self.call("run", f"{STUDY}.toml", "--out", "out", "--quiet")
        kept = self.folder / "out/result.json"
        before = kept.read_bytes()
        kept.chmod(0o444)
        self.assertIn("result.json", self.call("run", f"{STUDY}.toml", "--out", "out", "--set", "title='another'", code=3))
        self.assertEqual(before, kept.read_bytes())
        self.nothing_partial()

    def test_files_that_may_not_grow(self):
        said = self.call("run", f"{STUDY}.toml", "--out", "out", code=3, preexec_fn=limited(resource.RLIMIT_FSIZE, 20000))
        self.assertNotIn("internal error", said)
        self.nothing_partial()
        self.call("run", f"{STUDY}.toml", "--out", "out", "--quiet")

    def test_a_full_disk(self):
        with open("/dev/full", "w", encoding="utf-8") as full:
            process = subprocess.run([PROGRAM, "run", f"{STUDY}.toml", "--json"], cwd=self.folder, text=True, stdout=full,
                                     stderr=subprocess.PIPE, check=False)
        self.assertEqual((3, "standard output: error: cannot be written: No space left on device\n"), (process.returncode, process.stderr))

    def test_too_little_memory(self):
        said = self.call("run", f"{STUDY}.toml", "--set", 'sweep.input=[{joint="O",from_deg=0,to_deg=360,samples=100000}]', code=5,
                         preexec_fn=limited(resource.RLIMIT_AS, 200 << 20))
        self.assertIn("the memory that may be used is not enough", said)
        self.nothing_partial()

    def ends_at(self, process, sent):
        time.sleep(0.7)  # until it waits
        begin = time.perf_counter()
        process.send_signal(sent)
        process.communicate(timeout=30)
        self.assertLess(time.perf_counter() - begin, 10)

    def test_control_c_ends_the_wait_for_text(self):
        self.ends_at(self.start("run", "-"), signal.SIGINT)

    def test_a_server_ends_although_it_reads_what_never_comes(self):
        os.mkfifo(self.folder / "never.toml")
        self.ends_at(self.start("serve", "never.toml"), signal.SIGTERM)

    def test_a_shard_that_was_copied_over_another(self):
        self.call("examples", "--copy", "tolerances-hoeken")
        for shard in ("1/2", "2/2"):
            self.call("run", "tolerances-hoeken.toml", "--shard", shard, "--out", "out", "--quiet")
        shutil.copy(self.folder / "out/shard-1-of-2.jsonl", self.folder / "out/shard-2-of-2.jsonl")
        said = self.call("merge", "out", code=2)
        self.assertIn("shard-2-of-2.jsonl: error: holds another shard than its name says; run shard 2/2 again", said)


if __name__ == "__main__":
    unittest.main()
