"""A DELTA picks and places: angles of its arms along an arch, and the way back through direct kinematics."""

import numpy

from linkwright import parallel

robot = parallel.delta(base_radius=0.2, platform_radius=0.045, arm=0.25, rod=0.5)
share = numpy.linspace(0, 1, 1001)
start, end, height = numpy.array([-0.15, -0.05, -0.5]), numpy.array([0.15, 0.05, -0.5]), 0.05
way = start + share[:, None] * (end - start)
way[:, 2] += height * numpy.sin(numpy.pi * share)

arms = parallel.inverse(robot, way)
if numpy.isnan(arms).any():
    raise SystemExit(f"out of reach from {share[numpy.isnan(arms).any(axis=1).argmax()]:.0%} of the way")
error = numpy.abs(parallel.direct(robot, arms, assembly=-1) - way).max()
print(f"arms from {numpy.degrees(arms.min()):.1f} to {numpy.degrees(arms.max()):.1f} deg; "
      f"inverse and direct kinematics agree to {error:.0e} m")
assert error < 1e-12

# The reach in a plane, a place each 5 mm.
x, y = numpy.meshgrid(numpy.arange(-0.6, 0.6, 0.005), numpy.arange(-0.6, 0.6, 0.005))
plane = numpy.column_stack([x.ravel(), y.ravel(), numpy.full(x.size, -0.5)])
reached = ~numpy.isnan(parallel.inverse(robot, plane)).any(axis=1)
print(f"at z = -500 mm it reaches {reached.sum() * 25e-6:.3f} m2")
