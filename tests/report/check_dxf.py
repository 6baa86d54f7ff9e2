# SPDX-License-Identifier: BSD-3-Clause
"""Reads a drawing of the sample scene with ezdxf and checks its version, layers, scale and entities."""
import math
import sys

import ezdxf

drawing = ezdxf.readfile(sys.argv[1])
auditor = drawing.audit()
assert not auditor.errors, [error.message for error in auditor.errors]
assert drawing.dxfversion == "AC1009", drawing.dxfversion
layers = {layer.dxf.name for layer in drawing.layers}
assert {"GROUND", "LINKS", "JOINTS", "TRACE", "TARGETS"} <= layers, layers

space = drawing.modelspace()
lines = list(space.query('LINE[layer=="LINKS"]'))
lengths = sorted((line.dxf.start - line.dxf.end).magnitude for line in lines)
# Crank and rocker of Boskovic 2018, Table 4.1, column 6, in millimetres; coordinates carry nine digits.
for found, expected in zip(lengths, (419.7, 582.4)):
    assert math.isclose(found, expected, abs_tol=1e-4), (found, expected)
assert len(lines) == 2, len(lines)
(plate,) = space.query('POLYLINE[layer=="LINKS"]')
assert plate.is_closed and len(plate) == 3
(trace,) = space.query('POLYLINE[layer=="TRACE"]')
assert trace.is_closed and len(trace) == 361
assert len(space.query('CIRCLE[layer=="JOINTS"]')) == 5
assert sorted(text.dxf.text for text in space.query("TEXT")) == ["A", "B", "B0", "C", "O"]
points = list(space.query('POINT[layer=="TARGETS"]'))
assert len(points) == 18
assert math.isclose(points[0].dxf.location.x, 500) and math.isclose(points[0].dxf.location.y, 1100)
print("ok")
