"""An objective of one's own: a four-bar whose coupler point goes straight at an even pace over a third of the turn."""

import numpy

import linkwright
from linkwright import planar

angle = numpy.linspace(2 * numpy.pi / 3, 4 * numpy.pi / 3, 41)  # of the crank, from the ground link


def linkage(x):
    coupler, rocker, u, v = x
    return planar.FourBar(2.0, 1.0, coupler, rocker, u, v)


def objective(designs):
    """Largest distance from the best straight line at an even pace, over its length; the crank has to rotate fully."""
    cost, violation = [], []
    for x in designs:
        coupler, rocker = x[:2]
        violation.append(max(0.0, 3.0 - coupler - rocker) + max(0.0, abs(coupler - rocker) - 1.0))
        path = planar.coupler_points(linkage(x), angle) @ [1, 1j]
        even = numpy.polyval(numpy.polyfit(angle, path, 1), angle)
        cost.append(numpy.abs(path - even).max() / abs(even[-1] - even[0]))
    return cost, violation


best = linkwright.minimise(objective, lower=[1.2, 1.2, -2, -4], upper=[4, 4, 6, 4], method="cma_es", seed=1, generations=400)
print(f"coupler {best.x[0]:.4f}, rocker {best.x[1]:.4f}, point ({best.x[2]:.4f}, {best.x[3]:.4f})")
print(f"straight and even to {best.cost:.2%} of the stroke after {best.evaluations} evaluations ({best.stop_reason})")
hoeken = objective(numpy.array([[2.5, 2.5, 5.0, 0.0]]))[0][0]
print(f"Hoeken's four-bar: {hoeken:.2%}")
assert best.violation == 0 and best.cost < hoeken
