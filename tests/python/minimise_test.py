# SPDX-License-Identifier: BSD-3-Clause
"""Objectives in Python for the population methods."""

import os
import signal
import threading
import time
import unittest

import numpy

import linkwright
from linkwright import minimise


def sphere(x):
    return ((x - 0.25) ** 2).sum(axis=1)


class Minimise(unittest.TestCase):
    def test_every_method_finds_its_way(self):
        for method in ["recommended", *linkwright.methods()]:
            with self.subTest(method):
                found = minimise(sphere, [-1, -1], [1, 1], method, seed=3, max_evaluations=4000)
                self.assertLess(found.cost, 0.01)
                self.assertEqual(found.cost, sphere(found.x[None])[0])
                self.assertLessEqual(found.evaluations, 4000)
                self.assertEqual(("done", 0), (found.status, found.violation))
                self.assertEqual((found.generations, 2), found.history.shape)
                self.assertTrue((numpy.diff(found.history[:, 1]) <= 0).all())

    def test_the_same_seed_gives_the_same_answer(self):
        one, two, other = (minimise(sphere, [-1] * 4, [1] * 4, seed=seed, generations=20) for seed in (5, 5, 6))
        numpy.testing.assert_array_equal(one.x, two.x)
        self.assertFalse((one.x == other.x).all())

    def test_candidates_are_rows_within_the_bounds(self):
        shapes = set()

        def look(x):
            shapes.add(x.shape[1])
            self.assertLessEqual(len(x), 256)
            self.assertTrue(x.flags.c_contiguous)
            self.assertTrue(((x >= [-1, 2, 5]) & (x <= [0, 3, 5])).all())
            x[:] = 0  # an array of its own: what is done to it changes nothing
            return numpy.ones(len(x))

        found = minimise(look, [-1, 2, 5], [0, 3, 5], population=600, generations=3)
        self.assertEqual({3}, shapes)
        self.assertEqual(5, found.x[2])

    def test_constraints(self):
        # The nearest feasible point to the origin is (0.5, 0.5).
        found = minimise(lambda x: ((x**2).sum(axis=1), numpy.maximum(0, 1 - x.sum(axis=1))), [-1, -1], [1, 1], seed=2)
        numpy.testing.assert_allclose(found.x, 0.5, atol=1e-4)
        self.assertEqual(0, found.violation)
        nothing = minimise(lambda x: (x[:, 0], numpy.ones(len(x))), [0], [1], generations=5)
        self.assertEqual("infeasible", nothing.status)

    def test_what_has_no_cost_is_not_feasible(self):
        found = minimise(lambda x: numpy.where(x[:, 0] < 0.5, numpy.nan, x[:, 0]), [0], [1], seed=1)
        self.assertGreaterEqual(found.x[0], 0.5)
        self.assertLess(found.x[0], 0.5001)

    def test_no_finite_candidate_is_worse_than_one_without_a_cost(self):
        # On the left the cost or the violation does not exist; all others violate by 40 or more, in units of the user.
        def objective(missing, of_cost):
            def evaluate(x):
                exists = x[:, 0] > 0.4
                return (numpy.where(exists | (not of_cost), x[:, 0], missing),
                        numpy.where(exists, 100 - 60 * x[:, 0], 0 if of_cost else abs(missing)))
            return evaluate

        for missing in (numpy.nan, numpy.inf, -numpy.inf):
            for of_cost in (True, False):
                for method in linkwright.methods():
                    with self.subTest(missing=missing, of_cost=of_cost, method=method):
                        found = minimise(objective(missing, of_cost), [0], [1], method, seed=2, max_evaluations=2000)
                        self.assertGreater(found.x[0], 0.4)
                        self.assertEqual(100 - 60 * found.x[0], found.violation)
                        self.assertEqual("infeasible", found.status)

    def test_where_no_candidate_has_a_cost_the_problem_is_infeasible(self):
        for method in linkwright.methods():
            with self.subTest(method):
                found = minimise(lambda x: numpy.full(len(x), numpy.nan), [0, 0], [1, 1], method, max_evaluations=500)
                self.assertEqual(("infeasible", numpy.inf), (found.status, found.violation))
                self.assertTrue(((found.x >= 0) & (found.x <= 1)).all())

    def test_seeds_and_time_limits_that_do_not_exist(self):
        for seed, said in ((-1, "seed must be from 0 to 2**64 - 1, got -1"), (2**70, f"got {2**70}"),
                           (1.5, "seed must be a whole number from 0 to 2**64 - 1, got 1.5"), ("3", "got '3'"), (None, "got None")):
            with self.assertRaises(ValueError) as caught:
                minimise(sphere, [-1], [1], seed=seed)
            self.assertIn(said, str(caught.exception))
        self.assertEqual("done", minimise(sphere, [-1], [1], seed=2**64 - 1, generations=3).status)
        for limit in (0, -1, numpy.nan, "soon"):
            with self.assertRaises(ValueError) as caught:
                minimise(sphere, [-1], [1], time_limit=limit)
            self.assertIn("time_limit must be a positive number of seconds", str(caught.exception))

    def test_options_are_those_of_studies(self):
        self.assertIn("target cost", minimise(sphere, [-1], [1], target_cost=1e-3).stop_reason)
        for options, said in [({"popsize": 3}, "popsize: unknown key"), ({"population": 1}, "population: is 1, must be"),
                              ({"method": "jad"}, "did you mean 'jade'?")]:
            with self.assertRaises(linkwright.StudyError) as caught:
                minimise(sphere, [-1], [1], **options)
            self.assertIn(said, str(caught.exception))
            self.assertEqual(1, len(caught.exception.diagnostics))

    def test_answers_that_do_not_fit(self):
        for objective in (lambda x: 1.0, lambda x: x, lambda x: numpy.ones(len(x) + 1), lambda x: "no", lambda x: None,
                          lambda x: (sphere(x),), lambda x: (sphere(x), -numpy.ones(len(x)))):
            with self.assertRaises((TypeError, ValueError)):
                minimise(objective, [-1, -1], [1, 1])
        for lower, upper, said in (([0], [1, 2], "as many lower as upper bounds are needed, got 1 and 2"),
                                   ([1], [0], "the lower one not above the upper one; got 1 and 0"),
                                   ([], [], "at least one unknown is needed"),
                                   ([0], [numpy.inf], "bounds of unknown 0 must be finite"),
                                   ([0, numpy.nan], [1, 1], "bounds of unknown 1 must be finite")):
            with self.assertRaises(ValueError) as caught:
                minimise(sphere, lower, upper)
            self.assertIn(said, str(caught.exception))

    def test_what_the_objective_raises_ends_the_run(self):
        with self.assertRaises(ZeroDivisionError):
            minimise(lambda x: 1 // 0, [0], [1])

    def test_it_can_be_stopped(self):
        found = minimise(sphere, [-1], [1], generations=10**6, progress=lambda generation, best: generation < 7)
        self.assertEqual("cancelled", found.status)
        self.assertLess(found.generations, 10)
        begin = time.perf_counter()
        self.assertEqual("deadline", minimise(sphere, [-1], [1], generations=10**8, time_limit=0.2).status)
        self.assertLess(time.perf_counter() - begin, 1)
        timer = threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        with self.assertRaises(KeyboardInterrupt):
            minimise(sphere, [-1], [1], generations=10**8)

    def test_objectives_may_use_the_sweeps(self):
        from linkwright import planar
        angle = numpy.linspace(0, 2 * numpy.pi, 60)
        target = planar.coupler_points(planar.FourBar(1, 0.4, 0.9, 0.8, 0.5, 0.3), angle)

        def error(x):
            paths = [planar.coupler_points(planar.FourBar(1, 0.4, 0.9, 0.8, u, v), angle) for u, v in x]
            return [numpy.square(path - target).sum() for path in paths]

        found = minimise(error, [0, 0], [1, 1], seed=1)
        numpy.testing.assert_allclose(found.x, [0.5, 0.3], atol=1e-6)


if __name__ == "__main__":
    unittest.main()
