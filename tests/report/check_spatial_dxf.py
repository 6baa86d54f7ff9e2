# SPDX-License-Identifier: BSD-3-Clause
"""Reads a drawing of the spatial sample scene with ezdxf and checks its layers, scale and entities."""
import math
import sys

import ezdxf

drawing = ezdxf.readfile(sys.argv[1])
auditor = drawing.audit()
assert not auditor.errors, [error.message for error in auditor.errors]
assert drawing.dxfversion == "AC1009", drawing.dxfversion
assert {"AXES", "WHEELS"} <= {layer.dxf.name for layer in drawing.layers}

space = drawing.modelspace()
(tie_rod,) = [line for line in space.query('LINE[layer=="LINKS"]') if abs(line.dxf.start.x + 140) < 1e-6]
# From (-140, 360, -40) to (-130, 690, -50) mm; coordinates carry nine digits.
assert math.isclose((tie_rod.dxf.start - tie_rod.dxf.end).magnitude, math.sqrt(10**2 + 330**2 + 10**2), abs_tol=1e-4)
(axis,) = space.query('LINE[layer=="AXES"]')
assert math.isclose((axis.dxf.start - axis.dxf.end).magnitude, 1.3 * math.sqrt(30**2 + 40**2 + 320**2), abs_tol=1e-3)
rims = list(space.query('POLYLINE[layer=="WHEELS"]'))
assert len(rims) == 3 and all(rim.is_3d_polyline and rim.is_closed and len(rim) == 72 for rim in rims)
for vertex in rims[1].vertices:
    assert math.isclose((vertex.dxf.location - ezdxf.math.Vec3(0, 760, 20)).magnitude, 302, abs_tol=1e-3)
# The arms, the carrier and the spring.
assert len(space.query('POLYLINE[layer=="LINKS"]')) == 4
assert {round(point.dxf.location.z, 6) for point in space.query('POINT[layer=="JOINTS"]')} >= {-100, 195, 360}
assert not space.query("CIRCLE")
print("ok")
