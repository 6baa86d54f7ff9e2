# SPDX-License-Identifier: BSD-3-Clause
"""From a drawn motion to machines that trace it."""

import unittest

import numpy

import linkwright

angle = numpy.linspace(0, 2 * numpy.pi, 48, endpoint=False)
superellipse = numpy.column_stack([numpy.sign(numpy.cos(angle)) * abs(numpy.cos(angle)) ** 0.5,
                                   0.7 * numpy.sign(numpy.sin(angle)) * abs(numpy.sin(angle)) ** 0.5]) * 0.1


class Draw(unittest.TestCase):
    def test_gives_machines_best_first(self):
        result = linkwright.draw(superellipse, closed=True, evaluations=60_000, most_links=6)
        errors = [solution.objectives["path_error_rms_m"] for solution in result.solutions]
        self.assertGreater(len(errors), 1)
        self.assertEqual(sorted(errors), errors)
        self.assertLess(errors[0], 0.005)
        self.assertIn("links", result.headline)

    def test_a_machine_is_a_study_that_runs(self):
        result = linkwright.draw(superellipse, closed=True, evaluations=30_000, families=["four_bar"])
        motion = result.solutions[0].study.run()
        self.assertEqual("done", motion.status)

    def test_points_may_be_complex(self):
        a = linkwright.draw_study(superellipse, closed=True)
        b = linkwright.draw_study(superellipse[:, 0] + 1j * superellipse[:, 1], closed=True)
        self.assertEqual(a.to_toml(), b.to_toml())

    def test_poses_are_points_with_angles(self):
        points = [[0, 0], [0.03, 0.005], [0.062, 0.024], [0.088, 0.052], [0.104, 0.088], [0.11, 0.126]]
        result = linkwright.draw(points, body_angles=[0, 0, 8, 25, 52, 90], evaluations=60_000, most_links=6)
        self.assertLess(result.solutions[0].objectives["pose_error_rms_m"], 0.005)
        with self.assertRaisesRegex(ValueError, "body_angles"):
            linkwright.draw_study(points, body_angles=[0, 1])

    def test_the_drive_of_an_open_stroke_may_rock(self):
        stroke = [[0, 0], [0.008, 0.03], [0.03, 0.052], [0.06, 0.06], [0.2, 0.06], [0.4, 0.06]]
        result = linkwright.draw(stroke, crank_turns=False, evaluations=20_000, most_links=4)
        self.assertGreater(result.tables["machines"]["drive_from_rad"].size, 0)
        with self.assertRaisesRegex(linkwright.StudyError, "the stroke is closed"):
            linkwright.draw(superellipse, closed=True, crank_turns=False)

    def test_says_what_is_wrong(self):
        with self.assertRaisesRegex(ValueError, r"array \(n, 2\).*\(3,\)"):
            linkwright.draw([1.0, 2.0, 3.0])
        with self.assertRaisesRegex(linkwright.StudyError, "at least 5"):
            linkwright.draw([[0, 0], [1, 0], [1, 1]])
        with self.assertRaisesRegex(linkwright.StudyError, "four_bar"):
            linkwright.draw(superellipse, families=["fourbar"])


if __name__ == "__main__":
    unittest.main()
