"""A four-bar whose coupler point draws a flat arch, tied to the crank angle; and how it moves."""

import numpy

import linkwright

study = linkwright.Study("""
schema = 1
kind   = "synthesis"
title  = "Four-bar for a flat arch"

[mechanism]
type = "planar.four_bar"

[target]
type     = "path_points"
closed   = false
timing   = { mode = "equal_steps", step_deg = 20.0 }
points_m = [[0.0, 0.0], [0.3, 0.15], [0.6, 0.2], [0.9, 0.15], [1.2, 0.0]]

[[constraint]]
type = "crank_rotates_fully"

[optimiser]
method = "recommended"
seeds  = { first = 1, count = 10 }
""")

result = study.run(time_limit=60)
print(result.headline)
for solution in result.solutions[:3]:
    error = solution.objectives["path_error_sum_sq_m2"]
    print(f"  {solution.label}: crank {solution.parameters['crank_m']:.3f} m, sum of squares {error:.2e} m2")

best = result.solutions[0]
motion = best.study.run().tables["sweep"]
print(f"its coupler turns through {numpy.degrees(numpy.ptp(motion['coupler_angle_rad'])):.1f} deg")
assert best.objectives["path_error_sum_sq_m2"] < 1e-4
