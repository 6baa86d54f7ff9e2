#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that every unit has all its files: src/linkwright/<module>/[<folder>/]x.h has
tests/<module>/[<folder>/]x_test.cpp, every source and test is listed in the CMakeLists.txt of its module, and what
src/linkwright/<name>.h includes, the public headers, includes nothing else of the library.

    tools/check_mirror.py [ROOT]
"""

import re
import sys
from pathlib import PurePosixPath

import repository

# Headers without a test of their own name, and why. An entry that no header needs any more is a finding.
NO_TEST = {
    "app/ranks.h": "an interface; tests/app/shared_run_test.cpp gives one of its own, tests/cli/ranks_test.cpp uses that of MPI",
    "pagmo/part.h": "what the program loads of pagmo; tests/cli/plug_ins_test.cpp runs it",
    "core/field.h": "declarations; read, written and described by study/bind_test.cpp",
    "core/numbers.h": "named constants",
    "core/tolerance.h": "named constants",
    "suspension/direct/detail/synthesis_model.h": "part of direct_synthesis, tested in direct_synthesis_test.cpp",
    "planar/type_synthesis/detail/machine_descent.h": "part of refine, every aim of which is followed in refine_test.cpp",
    "planar/type_synthesis/detail/machine_list.h": "part of search, whose lists and merged answers search_test.cpp compares",
    "planar/type_synthesis/detail/program_kernel.h": "part of curve, compiled for numbers and for registers, compared in curve_test.cpp",
    "planar/type_synthesis/detail/search_state.h": "part of search, saved and loaded in search_test.cpp",
    "suspension/corner/detail/constraints_kernel.h": "part of constraints, compiled for numbers and for dual numbers; both are tested",
    "suspension/corner/detail/list_collector.h": "part of hard_point_list, tested in hard_point_list_test.cpp",
    "suspension/corner/detail/list_columns.h": "part of hard_point_list, tested in hard_point_list_test.cpp",
    "suspension/corner/detail/list_json.h": "part of hard_point_list, tested in hard_point_list_write_test.cpp",
    "suspension/corner/detail/list_lines.h": "part of hard_point_list, tested in hard_point_list_test.cpp",
    "suspension/corner/detail/list_names.h": "names of points, tested in corner_test.cpp with the studies that read them",
    "suspension/corner/detail/list_property.h": "part of hard_point_list, tested in hard_point_list_test.cpp",
    "suspension/corner/detail/points_kernel.h": "part of constraints, likewise",
    "suspension/corner/detail/rockers_kernel.h": "part of constraints, likewise",
    "parallel/dexterity/detail/kernel.h": "part of dexterity, compiled for numbers and for registers, compared by its test",
    "parallel/dexterity/detail/synthesis_search.h": "part of dexterity_synthesis, tested in dexterity_synthesis_test.cpp",
    "planar/cam/detail/contour.h": "part of disc_cam, tested in disc_cam_test.cpp and cam_follower_test.cpp",
    "planar/cam/detail/finding_words.h": "part of programme, compared by the messages of its studies",
    "planar/drawing/detail/dxf_curves.h": "part of drawing, tested in drawing_test.cpp",
    "planar/drawing/detail/dxf_file.h": "part of drawing, tested in drawing_test.cpp",
    "planar/drawing/detail/fault.h": "part of drawing, tested in drawing_test.cpp",
    "planar/drawing/detail/lines.h": "part of drawing, tested in drawing_test.cpp",
    "planar/drawing/detail/svg_file.h": "part of drawing, tested in drawing_test.cpp",
    "planar/drawing/detail/svg_path.h": "part of drawing, tested in drawing_test.cpp",
    "planar/drawing/detail/xml_tags.h": "part of drawing, tested in drawing_test.cpp",
    "planar/sketch/detail/sketch_draft.h": "part of sketch, tested in sketch_test.cpp",
    "planar/sketch/detail/sketch_points.h": "part of sketch, tested in sketch_test.cpp",
    "planar/studies/any_machine_layouts.h": "part of the studies of planar.any, tested in any_machine_test.cpp",
    "planar/path/local_fit.h": "plain data; tested with the fitters that give it",
    "planar/path/search.h": "part of the syntheses of four-bars and slider-cranks, tested in both",
    "planar/studies/environment.h": "one number, tested with the studies that hold it",
    "parallel/pi_joint/kernel.h": "part of pi_joint, compiled for numbers and for dual numbers; both are tested",
    "parallel/robot/detail/legs_kernel.h": "part of position, compiled for numbers and for batches; both are tested",
    "clearance/studies/simulation_rows.h": "part of clearance_study, tested in clearance_study_test.cpp",
    "flexible/joint_kernel.h": "part of chain and chain_equations, tested in both",
    "suspension/corner/detail/wheel_kernel.h": "part of wheel, likewise",
    "suspension/wheel/detail/parameters_kernel.h": "part of wheel_parameters, likewise",
    "math/detail/ode_pairs.h": "coefficients; their orders are measured in ode_test.cpp",
    "math/ode_stepper.h": "part of ode, tested in ode_test.cpp",
    "math/detail/ode_vectors.h": "part of ode, used by every step of ode_test.cpp",
    "python/arrays.h": "arrays of Python, tested from there in python/arrays_test.py",
    "python/bindings.h": "called when Python imports the module",
    "python/rows.h": "plain data; tested from Python in python/arrays_test.py",
    "python/study_source.h": "studies of Python, tested from there in python/studies_test.py",
    "python/values.h": "what crosses the border to Python, tested from there in python/studies_test.py",
    "serve/connection.h": "part of the server; its times and limits are tested in server_test.cpp",
    "serve/listener.h": "part of the server; its threads and refusals are tested in server_test.cpp",
    "serve/page.h": "the bytes of a page, asked for in server_test.cpp and opened by web/tests/workbench.mjs",
    "report/detail/canvas.h": "part of svg, tested in svg_test.cpp",
    "report/detail/svg_arrows.h": "part of svg, tested in svg_test.cpp",
    "study/bind_output_units.h": "part of display_units, tested in display_units_test.cpp",
    "study/kind.h": "plain data; every kind's own test fills and runs it",
    "study/result.h": "plain data; written by the tests of results and reports",
    "study/scene.h": "plain data; drawn by the tests of the report",
    "study/bind_schema.h": "part of bind, tested in bind_test.cpp",
    "study/detail/bind_words.h": "part of bind, tested in bind_test.cpp",
    "study/bind_traits.h": "part of bind, tested in bind_test.cpp",
    "study/bind_write.h": "part of bind, tested in bind_test.cpp",
    "study/read_syntax.h": "part of read, tested in read_test.cpp",
    "optimise/detail/differential_evolution_base.h": "shared part of both forms, tested through them",
    "planar/path/detail/target_kernel.h": "part of both objectives, compiled once per instruction set and compared by their tests",
    "optimise/population_methods.h": "choices of studies; read and run by the tests of path and balancing studies",
    "planar/function/detail/six_bar_synthesis.h": "the search of both six-bar generators, tested through them",
    "planar/function/six_bar.h": "plain data and how it is assessed, tested with both six-bar generators",
    "planar/studies/published_four_bars.h": "published numbers; compared in planar/reproductions_test.cpp",
    "optimise/detail/firefly_base.h": "shared part of the forms of the firefly algorithm, tested through them",
    "optimise/detail/swarm_base.h": "shared part of fireflies and cuckoos, tested through them",
    "planar/linkage/detail/curve_equations.h": "part of linkage_curve, tested in linkage_curve_test.cpp",
    "planar/linkage/detail/form_parts.h": "parts of a form, tested in form_test.cpp",
    "planar/four_bar/detail/sweep_kernel.h": "part of sweep, compiled once per instruction set and compared by its test",
    "planar/linkage/detail/plan_draft.h": "stages of a plan, tested in plan_test.cpp",
    "planar/linkage/detail/joint_rows.h": "part of linkage_general and linkage_curve, tested in both",
    "planar/serial_arm/samples.h": "published numbers; run by the tests of serial arms and their balancing",
    "suspension/corner/point_box.h": "plain data; used by the tests of links to be found",
    "math/lanes.h": "what path_tracker.h needs of a scalar; tested by path_tracker_test.cpp",
    "planar/exact/detail/follow_kernel.h": "part of follow, compiled once per instruction set and compared by its test",
    "planar/exact/detail/monodromy.h": "finds the start sets; tested by nine_point_starts_test.cpp and five_points_test.cpp",
    "planar/path/curve_overlay.h": "shared part of both kinds of starts, tested with them",
    "planar/studies/path.h": "the study of any path mechanism, tested with those of four-bars and slider-cranks",
    "planar/studies/linkage_rows.h": "part of linkage studies, tested in linkage_test.cpp",
    "suspension/studies/seven_pose_tables.h": "part of indirect studies, tested in indirect_test.cpp",
    "planar/simulation/detail/simulation_run.h": "part of simulation, tested in simulation_test.cpp",
}


def listed(cmake_lists):
    """File names that a CMakeLists.txt mentions outside comments."""
    if not cmake_lists.is_file():
        return None
    text = re.sub(r"#.*", "", cmake_lists.read_text(encoding="utf-8"))
    return set(re.findall(r"[\w./-]+\.(?:cpp|h)\b", text))


def check_public_headers(root):
    """The headers straight under src/linkwright are the entry headers: what they include is public and installed."""
    headers = repository.public_headers(root)
    public = {path.relative_to(root / "src").as_posix() for path in headers}
    for path in headers:
        for _, _, other in repository.includes(path) if path.is_file() else ():
            if other in public and not (root / "src" / other).is_file():
                yield f"{path.relative_to(root).as_posix()}: includes {other}, which is gone"
            elif other.startswith("linkwright/") and other not in public:
                yield (f"{path.relative_to(root).as_posix()}: is public and includes {other}, which no header straight under "
                       "src/linkwright includes")


def check(root, no_test=None):
    no_test = NO_TEST if no_test is None else no_test
    findings = []
    excused = set()
    for path in repository.files(root):
        where = PurePosixPath(path.relative_to(root).as_posix())
        parts = where.parts
        if where.suffix == ".h" and parts[:2] == ("src", "linkwright") and len(parts) > 3:
            key = "/".join(parts[2:])
            test = PurePosixPath("tests", *(p for p in parts[2:-1] if p != "detail"), f"{where.stem}_test.cpp")
            if (root / test).is_file():
                continue
            if key in no_test:
                excused.add(key)
            else:
                findings.append(f"{where}: has no {test}")
        elif (where.suffix == ".cpp" and parts[:2] == ("src", "linkwright") and len(parts) > 3 or
              where.name.endswith("_test.cpp") and parts[0] == "tests" and len(parts) > 2):
            module = where.parents[len(parts) - (4 if parts[0] == "src" else 3)]
            names = listed(root / module / "CMakeLists.txt")
            if names is None:
                findings.append(f"{where}: {module} has no CMakeLists.txt")
            elif str(where.relative_to(module)) not in names:
                findings.append(f"{where}: is not listed in {module}/CMakeLists.txt, so it is not built")
    findings += check_public_headers(root)
    for key in sorted(set(no_test) - excused):
        findings.append(f"tools/check_mirror.py: '{key}' needs no exception (it has a test, or is gone)")
    return findings


if __name__ == "__main__":
    sys.exit(repository.main(check))
