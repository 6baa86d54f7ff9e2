"""Toe, camber and roll centre of a wheel over its travel, and its bump steer by two routes."""

import numpy

import linkwright
from linkwright import suspension

study = linkwright.example("strut-suspension-sweep")
travel = numpy.arange(-60, 61, 20) * 1e-3
wheel = suspension.WheelSuspension(study).sweep(travel)

print(" travel      toe   camber   roll centre")
for z, toe, camber, height in zip(travel, wheel["toe_rad"], wheel["camber_rad"], wheel["roll_centre_height_m"]):
    print(f"{z * 1e3:4.0f} mm {numpy.degrees(toe):8.3f} {numpy.degrees(camber):8.3f} deg {height * 1e3:8.1f} mm")
assert wheel.done.all()

# Bump steer at the reference is a rate of the program; the slope of toe over travel agrees with it.
middle = len(travel) // 2
fine = suspension.WheelSuspension(study).sweep([-1e-4, 0.0, 1e-4], quantities=["toe_rad", "toe_by_travel_rad_per_m"])
slope = (fine["toe_rad"][2] - fine["toe_rad"][0]) / 2e-4
rate = fine["toe_by_travel_rad_per_m"][1]
print(f"bump steer: {numpy.degrees(rate) / 10:.3f} deg per 100 mm")
assert abs(slope - rate) < 1e-5
