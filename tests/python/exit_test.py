# SPDX-License-Identifier: BSD-3-Clause
"""Python ends in peace while threads of its own are still at work."""

import os
import subprocess
import sys
import time
import unittest

AT_WORK = """
import os, sys, threading, time
import numpy
import linkwright

def again(work):
    begun = threading.Event()
    def loop():
        while True:
            begun.set()
            work()
    threading.Thread(target=loop, daemon=True).start()
    begun.wait()

def long_study():
    study = linkwright.example("fourbar-18-points-free-timing-20")
    study.set("optimiser.seeds.count", 200)
    return study

def sphere(x):
    return (x**2).sum(axis=1)

"""

WORK = {
    "run": "again(long_study().run)",
    "run_many": "again(lambda: linkwright.run_many([long_study() for _ in range(4)], threads=2))",
    "minimise": "again(lambda: linkwright.minimise(sphere, [-1] * 10, [1] * 10, generations=10**6))",
    "to_json": "again(linkwright.example('hoeken').run().to_json)",
    "arrays": "robot = linkwright.parallel.delta(base_radius=0.2, platform_radius=0.05, arm=0.2, rod=0.4)\n"
              "again(lambda: linkwright.parallel.inverse(robot, numpy.full((1000000, 3), [0, 0, -0.4])))",
}


class Exit(unittest.TestCase):
    def ends(self, text):
        """What a program of Python prints that ends with 0."""
        done = subprocess.run([sys.executable, "-c", AT_WORK + text], capture_output=True, text=True, timeout=100, check=False)
        self.assertEqual((0, ""), (done.returncode, done.stderr))
        return done.stdout

    def test_work_of_daemon_threads_ends_with_python(self):
        for name, work in WORK.items():
            with self.subTest(name):
                begin = time.perf_counter()
                for pause in (0, 0.1, 0.3):
                    self.ends(f"{work}\ntime.sleep({pause})\n")
                self.assertLess(time.perf_counter() - begin, 60)  # seconds out of minutes

    def test_the_child_of_a_fork_does_not_wait_for_the_threads_of_its_parent(self):
        if not hasattr(os, "fork"):
            self.skipTest("there is no fork here")
        self.ends(WORK["run"] + "\ntime.sleep(0.2)\nchild = os.fork()\n"
                                "if child: assert os.waitpid(child, 0)[1] == 0\n")

    def test_what_is_called_at_exit_finds_its_results(self):
        printed = self.ends("import atexit\nresult = linkwright.example('hoeken').run()\n"
                            "atexit.register(lambda: print(len(result.to_json()) > 1000))\n")
        self.assertEqual("True\n", printed)


if __name__ == "__main__":
    unittest.main()
