"""Joint forces and drive torque of a four-bar over one turn of its crank, checked by the power of the motor."""

import numpy

from linkwright import planar

linkage = planar.FourBar(ground=0.4, crank=0.1, coupler=0.35, rocker=0.25)
masses = planar.FourBarMasses(
    crank=planar.LinkMass(mass=0.3, inertia=2.5e-4, centre_distance=0.05),
    coupler=planar.LinkMass(mass=0.9, inertia=9.2e-3, centre_distance=0.175),
    rocker=planar.LinkMass(mass=0.6, inertia=3.1e-3, centre_distance=0.125))
speed = 300 * 2 * numpy.pi / 60

angle = numpy.linspace(0, 2 * numpy.pi, 3600, endpoint=False)
rows = planar.FourBarSweep().run(linkage, angle, crank_speed=speed, masses=masses, gravity=9.81)
force = numpy.hypot(rows["ground_on_crank_x"], rows["ground_on_crank_y"])
torque = rows["drive_torque"]
print(f"300 rpm: {force.max():.1f} N in the crank pivot at {numpy.degrees(angle[force.argmax()]):.0f} deg, "
      f"{numpy.abs(torque).max():.2f} N m on the crank")

# Over a whole turn the masses gain nothing: what the motor puts in, it gets back.
power = torque * speed
given, taken = power[power > 0].sum(), -power[power < 0].sum()
print(f"over a turn the motor gives {given / len(angle) * 0.2:.3f} J and takes {taken / len(angle) * 0.2:.3f} J")
assert abs(given - taken) < 1e-12 * given
