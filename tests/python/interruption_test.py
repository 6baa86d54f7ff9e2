# SPDX-License-Identifier: BSD-3-Clause
"""Runs leave Python's lock free, report their progress and end when they are asked to."""

import os
import signal
import threading
import time
import unittest

import numpy

import linkwright


def long_study():
    """Minutes of search."""
    study = linkwright.example("fourbar-18-points-free-timing-20")
    study.set("optimiser.seeds.count", 200)
    return study


class After:
    """Sends Ctrl-C after a while, and says when it did."""

    def __init__(self, seconds):
        self.timer = threading.Timer(seconds, self.send)
        self.timer.start()

    def send(self):
        self.at = time.perf_counter()
        os.kill(os.getpid(), signal.SIGINT)


class Interruption(unittest.TestCase):
    def ends_at_once(self, run):
        # The message of the exception says nothing of how long it took: the best of three leaves out a busy machine.
        took = []
        for _ in range(3):
            sent = After(0.5)
            with self.assertRaises(KeyboardInterrupt):
                run()
            took.append(time.perf_counter() - sent.at)
        self.assertLess(min(took), 0.3)

    def test_control_c_ends_a_run(self):
        self.ends_at_once(lambda: long_study().run())
        self.assertEqual("passed", linkwright.example("hoeken").run().verdict)  # and the next one is none the worse

    def test_control_c_ends_many_runs(self):
        self.ends_at_once(lambda: linkwright.run_many([long_study() for _ in range(4)], threads=2))

    def test_control_c_ends_a_sweep_of_many_samples(self):
        def again_and_again(run):
            for _ in range(1000):
                run()

        angles = numpy.linspace(0, 1e3, 30_000_000)
        four_bar = linkwright.planar.FourBar(ground=0.3, crank=0.1, coupler=0.25, rocker=0.25)
        sweep = linkwright.planar.FourBarSweep(forces=False, shaking=False)
        self.ends_at_once(lambda: again_and_again(lambda: sweep.run(four_bar, angles)))
        fewer = numpy.linspace(0, 1e3, 3_000_000)
        leg = linkwright.planar.LinkageSweep(linkwright.example("jansen-leg"), rates=False)
        self.ends_at_once(lambda: again_and_again(lambda: leg.run(fewer)))

    def test_other_threads_of_python_continue(self):
        counted = []
        over = threading.Event()

        def count():
            while not over.wait(0.001):
                counted.append(time.perf_counter())

        thread = threading.Thread(target=count)
        thread.start()
        long_study().run(time_limit=1)
        over.set()
        thread.join()
        self.assertGreater(len(counted), 50)
        self.assertLess(max(b - a for a, b in zip(counted, counted[1:])), 0.5)


class Progress(unittest.TestCase):
    def test_it_is_reported_in_the_thread_that_asked(self):
        seen = []
        study = linkwright.example("fourbar-18-points-grey-wolf")
        study.set("optimiser.seeds.count", 10000)
        study.run(lambda *state: seen.append((threading.get_ident(), *state)), time_limit=1)
        self.assertGreater(len(seen), 3)
        for thread, stage, fraction, best in seen:
            self.assertEqual(threading.get_ident(), thread)
            self.assertTrue(stage)
            self.assertTrue(0 <= fraction <= 1)
            self.assertIsInstance(best, float)

    def test_false_ends_the_run_with_the_best_so_far(self):
        begin = time.perf_counter()
        result = long_study().run(lambda stage, fraction, best: False)
        # Seconds out of minutes; a busy machine takes seconds to begin.
        self.assertLess(time.perf_counter() - begin, 30)
        self.assertEqual(("cancelled", "incomplete", 4), (result.status, result.verdict, result.exit_code))

    def test_what_it_raises_ends_the_run(self):
        def fail(stage, fraction, best):
            raise ZeroDivisionError(stage)

        with self.assertRaises(ZeroDivisionError):
            long_study().run(fail)

    def test_many_runs_can_be_stopped(self):
        def enough(done, all):
            return False

        studies = [linkwright.example("hoeken")] + [long_study() for _ in range(3)]
        results = linkwright.run_many(studies, threads=1, progress=enough)
        self.assertEqual("passed", results[0].verdict)
        self.assertIn(None, results)


if __name__ == "__main__":
    unittest.main()
