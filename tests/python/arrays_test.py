# SPDX-License-Identifier: BSD-3-Clause
"""Functions of arrays: against formulas of their own, against studies, and what happens to their memory."""

import gc
import unittest

import numpy

import linkwright
from linkwright import parallel, planar, suspension

LINKAGE = planar.FourBar(0.6, 0.1, 0.4, 0.32)
# Boskovic 2018, Table 2.2 (original mechanism)
MASSES = planar.FourBarMasses(planar.LinkMass(0.36, 4.13e-4, 0.05), planar.LinkMass(1.296, 1.87e-2, 0.2),
                              planar.LinkMass(1.046, 9.85e-3, 0.16))


class FourBars(unittest.TestCase):
    def test_positions_close_the_loop(self):
        angle = numpy.linspace(-7, 7, 1001)
        for branch, sign in (("open", 1), ("crossed", -1)):
            linkage = planar.FourBar(0.6, 0.1, 0.4, 0.32, 0.17, -0.08, 1.2, -0.4, 0.3, branch)
            rows = planar.FourBarSweep(rates=False, forces=False, shaking=False).run(linkage, angle)
            a = 0.1 * numpy.exp(1j * (angle + 0.3))
            coupler = rows["coupler_x"] + 1j * rows["coupler_y"]
            rocker = rows["rocker_x"] + 1j * rows["rocker_y"]
            b0 = 0.6 * numpy.exp(0.3j)
            numpy.testing.assert_allclose(a + 0.4 * coupler, b0 + 0.32 * rocker, atol=1e-15)
            self.assertTrue((sign * numpy.imag((a + 0.4 * coupler - a) * numpy.conj(b0 - a)) > 0).all())
            c = 1.2 - 0.4j + a + (0.17 - 0.08j) * coupler
            points = planar.coupler_points(linkage, angle)
            numpy.testing.assert_allclose(points, numpy.column_stack([c.real, c.imag]), atol=2e-15)

    def test_reactions_are_those_of_the_study(self):
        study = linkwright.example("fourbar-reactions")
        table = study.run().tables["sweep"]
        rows = planar.FourBarSweep().run(LINKAGE, table["O1_angle_rad"], crank_speed=table["crank_speed_rad_per_s"],
                                         masses=MASSES, gravity=study.canonical()["environment"]["gravity_m_per_s2"])
        for row, column in {"ground_on_crank_x": "O1_x_N", "ground_on_crank_y": "O1_y_N", "crank_on_coupler_x": "O2_x_N",
                            "drive_torque": "O1_drive_torque_N_m", "shaking_force_y": "shaking_force_y_N",
                            "shaking_moment": "shaking_moment_N_m", "rocker_acceleration": "rocker_acceleration_rad_per_s2"}.items():
            with self.subTest(row):
                scale = numpy.abs(table[column]).max()
                numpy.testing.assert_allclose(rows[row], table[column], atol=1e-12 * scale)

    def test_drive_gives_what_the_masses_gain(self):
        # Without gravity the work of the motor over a whole turn is nothing.
        angle = numpy.linspace(0, 2 * numpy.pi, 4096, endpoint=False)
        torque = planar.FourBarSweep().run(LINKAGE, angle, crank_speed=31.4, masses=MASSES)["drive_torque"]
        self.assertLess(abs(torque.mean()), 1e-13 * numpy.abs(torque).max())

    def test_where_it_does_not_assemble(self):
        rows = planar.FourBarSweep().run(planar.FourBar(1, 1, 0.3, 0.3), [0.1, numpy.pi], crank_speed=1, masses=MASSES)
        self.assertEqual([True, False], list(rows.done))
        self.assertEqual(["done", "no_assembly"], [rows.status(0), rows.status(1)])
        self.assertTrue(numpy.isnan(rows["coupler_x"][1]))
        self.assertTrue(numpy.isnan(planar.coupler_points(planar.FourBar(1, 1, 0.3, 0.3), numpy.pi)).all())
        with self.assertRaises(IndexError):
            rows.status(2)

    def test_rows_are_not_copied_and_not_overwritten(self):
        sweep = planar.FourBarSweep()
        first = sweep.run(LINKAGE, numpy.linspace(0, 1, 100))
        a, b = first["crank_x"], first["crank_x"]
        self.assertTrue(numpy.shares_memory(a, b))
        self.assertFalse(a.flags.writeable or a.flags.owndata)
        kept = a.copy()
        second = sweep.run(LINKAGE, numpy.linspace(3, 4, 100))
        numpy.testing.assert_array_equal(a, kept)
        self.assertFalse(numpy.shares_memory(a, second["crank_x"]))
        # Once nobody looks any more the same memory is taken again.
        place = second["crank_x"].__array_interface__["data"]
        del second, first, b
        gc.collect()
        self.assertEqual(place, sweep.run(LINKAGE, numpy.linspace(3, 4, 100))["crank_x"].__array_interface__["data"])
        numpy.testing.assert_array_equal(a, kept)

    def test_only_what_is_wanted(self):
        rows = planar.FourBarSweep(directions=False, forces=False, shaking=False).run(LINKAGE, 0.3, crank_speed=2.0)
        self.assertEqual(["coupler_speed", "rocker_speed", "coupler_acceleration", "rocker_acceleration"], list(rows))
        self.assertEqual(1, rows.samples)
        with self.assertRaises(KeyError):
            rows["drive_torque"]

    def test_wrong_arguments(self):
        sweep = planar.FourBarSweep()
        for linkage, angle, more in [(planar.FourBar(0, 1, 1, 1), 0, {}), (LINKAGE, numpy.nan, {}), (LINKAGE, [[1, 2]], {}),
                                     (LINKAGE, [1, 2, 3], {"crank_speed": [1, 2]}), (planar.FourBar(1, 1, 1, 1, branch="x"), 0, {}),
                                     (LINKAGE, 0, {"masses": planar.FourBarMasses(planar.LinkMass(-1))})]:
            with self.assertRaises(ValueError):
                sweep.run(linkage, angle, **more)
        with self.assertRaises((TypeError, ValueError)):
            sweep.run(LINKAGE, "a turn")


class Linkages(unittest.TestCase):
    def test_points_and_forces_are_those_of_the_study(self):
        for name in ("jansen-leg", "watt-1-six-bar", "engine-slider-crank", "fourbar-reactions"):
            with self.subTest(name):
                study = linkwright.example(name)
                table = study.run().tables["sweep"]
                sweep = planar.LinkageSweep(study, forces=True)
                joint = sweep.inputs[0]
                angle = table[next(key for key in table if key.startswith(f"{joint}_angle"))]
                speed = table["crank_speed_rad_per_s"]
                rows = sweep.run(angle, rate=speed)
                self.assertTrue(rows.done.all())
                torque = table[f"{joint}_drive_torque_N_m"]
                numpy.testing.assert_allclose(rows[f"{joint}.drive"], torque, atol=1e-11 * numpy.abs(torque).max())
        leg = planar.LinkageSweep(linkwright.example("jansen-leg"))
        table = linkwright.example("jansen-leg").run().tables["sweep"]
        foot = leg.run(table["O_angle_rad"]).point("foot plate.foot")
        numpy.testing.assert_allclose(foot[:, 0], table["foot_plate_foot_x_m"], atol=1e-13)
        numpy.testing.assert_allclose(foot[:, 1], table["foot_plate_foot_y_m"], atol=1e-13)
        fixed = leg.run([0.0, 1.0]).point("ground.G")
        numpy.testing.assert_array_equal(fixed[0], fixed[1])

    def test_several_inputs_go_by_name(self):
        sweep = planar.LinkageSweep(linkwright.example("pantograph"))
        first, second = sweep.inputs
        rows = sweep.run({first: [0.6, 0.7], second: [-0.9, -0.9]}, rate={first: 1.0, second: 0.0})
        self.assertEqual(2, rows.samples)
        for wrong in ({first: [1.0]}, {first: [1.0], second: [1.0], "x": 1.0}, [0.6, 0.7]):
            with self.assertRaises(ValueError):
                sweep.run(wrong)
        with self.assertRaises(KeyError):
            rows.point("nothing.there")

    def test_what_is_not_an_analysis_of_a_linkage(self):
        for name in ("fourbar-18-points", "double-pendulum", "packing-line"):
            with self.assertRaises(ValueError):
                planar.LinkageSweep(linkwright.example(name))
        with self.assertRaises(linkwright.StudyError):
            planar.LinkageSweep(linkwright.example("jansen-leg").changed({"mechanism.sample": "jansen_arm"}))


class Suspensions(unittest.TestCase):
    def test_numbers_are_those_of_the_study(self):
        study = linkwright.example("strut-suspension-sweep")
        table = study.run().tables["sweep"]
        travel, rack = numpy.unique(table["travel_m"]), numpy.unique(table["rack_m"])
        rows = suspension.WheelSuspension(study).sweep(travel, rack)
        for key in table:
            if key in rows:
                numpy.testing.assert_array_equal(rows[key], table[key])
        self.assertIn("toe_rad", rows)
        some = suspension.WheelSuspension(study).sweep(travel, quantities=["camber_rad"])
        self.assertEqual(["travel_m", "rack_m", "camber_rad"], list(some))

    def test_wrong_arguments(self):
        corner = suspension.WheelSuspension(linkwright.example("strut-suspension-sweep"))
        for travel in ([], [0.1, 0.0], [numpy.nan], [[0.0, 0.1]]):
            with self.assertRaises(ValueError):
                corner.sweep(travel)
        with self.assertRaises(KeyError):
            corner.sweep(0.0, quantities=["toe"])
        with self.assertRaises(ValueError):
            suspension.WheelSuspension(linkwright.example("hoeken"))
        self.assertFalse(corner.sweep([0.0, 3.0]).done.all())


class Robots(unittest.TestCase):
    def setUp(self):
        random = numpy.random.default_rng(1)
        self.delta = parallel.delta(0.2, 0.045, 0.25, 0.5)
        self.places = random.uniform([-0.15, -0.15, -0.6], [0.15, 0.15, -0.45], (1000, 3))

    def test_rods_keep_their_length(self):
        angles = parallel.inverse(self.delta, self.places)
        self.assertEqual((1000, 3), angles.shape)
        for leg, azimuth in enumerate(2 * numpy.pi / 3 * numpy.arange(3)):
            out = numpy.array([numpy.cos(azimuth), numpy.sin(azimuth), 0])
            alpha = angles[:, leg, None]
            elbow = (0.2 + 0.25 * numpy.cos(alpha)) * out - 0.25 * numpy.sin(alpha) * numpy.array([0, 0, 1])
            rod = self.places + 0.045 * out - elbow
            numpy.testing.assert_allclose(numpy.linalg.norm(rod, axis=1), 0.5, atol=1e-15)

    def test_direct_leads_back(self):
        angles = parallel.inverse(self.delta, self.places)
        numpy.testing.assert_allclose(parallel.direct(self.delta, angles, assembly=-1), self.places, atol=1e-13)

    def test_out_of_reach_is_missing(self):
        self.assertTrue(numpy.isnan(parallel.inverse(self.delta, [0, 0, -2.0])).all())
        self.assertTrue(numpy.isnan(parallel.direct(parallel.delta(0.9, 0.1, 0.2, 0.3), [0.0, 0, 0], assembly=-1)).all())

    def test_other_robots(self):
        five = parallel.five_bar((-0.1, 0, 0.2, 0.3), (0.1, 0, 0.2, 0.3))
        place = numpy.array([[0.05, 0.35, 0.0]])
        for mode in ((1, 1), (-1, 1), (1, -1), (-1, -1)):
            angles = parallel.inverse(five, place, mode=mode)
            found = [parallel.direct(five, angles, assembly=sign) for sign in (1, -1)]
            self.assertLess(min(numpy.abs(f - place).max() for f in found), 1e-14)
        hexa = parallel.hexa(0.3, 0.05, 0.1, 0.4, 0.2, 0.6)
        turn = numpy.array([[[0, -1.0, 0], [1, 0, 0], [0, 0, 1]]])
        level = parallel.inverse(hexa, [0, 0, -0.5])
        self.assertEqual((1, 6), level.shape)
        self.assertGreater(numpy.abs(parallel.inverse(hexa, [0, 0, -0.5], 0.1 * turn + 0.9 * numpy.eye(3)) - level).max(), 1e-3)
        with self.assertRaises(ValueError):
            parallel.direct(hexa, level, assembly=1)

    def test_wrong_arguments(self):
        for ask in (lambda: parallel.delta(0.2, 0.045, -0.25, 0.5), lambda: parallel.inverse(self.delta, [[1.0, 2.0]]),
                    lambda: parallel.inverse(self.delta, [0, 0, -0.5], mode=[1, 2, 1]),
                    lambda: parallel.inverse(self.delta, self.places, numpy.eye(3)),
                    lambda: parallel.direct(self.delta, [0.1, 0.2], assembly=-1)):
            with self.assertRaises(ValueError):
                ask()


if __name__ == "__main__":
    unittest.main()
