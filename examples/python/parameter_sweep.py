"""How the drive torque of a four-bar grows with its speed: studies of one mechanism, run two at a time."""

import numpy

import linkwright

study = linkwright.template("analysis/planar.four_bar")
speeds = numpy.arange(50.0, 651.0, 50.0)  # rpm
studies = [study.changed({"drive.speed_rpm": speed}) for speed in speeds]
results = linkwright.run_many(studies, threads=2)

torques = numpy.array([numpy.abs(result.tables["sweep"]["O1_drive_torque_N_m"]).max() for result in results])
for speed, torque in zip(speeds, torques):
    print(f"{speed:4.0f} rpm {torque:8.3f} N m {'#' * int(40 * torque / torques.max())}")

# Inertia grows with the square of the speed, weight does not: a parabola in the fast half.
fit = numpy.polyfit(speeds[6:] ** 2, torques[6:], 1)
rest = numpy.abs(numpy.polyval(fit, speeds[6:] ** 2) - torques[6:]).max()
print(f"torque = {fit[1]:.3f} N m + {fit[0] * 1e6:.3f} N m (n / 1000 rpm)^2, to {rest:.3f} N m")
assert rest < 0.02 * torques.max()
