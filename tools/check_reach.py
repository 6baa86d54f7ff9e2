#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that every public function is called by the program, or stands in a list that says who else wants it.

    tools/check_reach.py [ROOT]

A function counts as reached when its name stands in a source other than the header that declares it, besides its own
definition, which a source of the same folder has. Overloads of one name count as one.
"""

import re
import sys

import repository

DECLARATION = re.compile(r"^(?:\[\[nodiscard\]\] )?(?:inline |constexpr )*(?!using|return|struct|class|enum|template|namespace|friend|static|"
                         r"extern|typedef|public|private|else|case|throw|delete|visit)[A-Za-z_][\w:<>,&* ]*[ &*>](\w+)\(", re.M)
WORD = re.compile(r"\w+")

# Public functions that the program does not call, with their users. An entry that is called, or gone, is a finding.
LIBRARY = "for users of the library"
ROUTE = "a second route that tests compare with"
SAMPLE = "a published case that tests and benchmarks run"
KERNEL = "tests and benchmarks name or run every kernel"
REASONS = {
    "clearance/force_phase_errors": ROUTE,
    "clearance/poincare_section": LIBRARY,
    "clearance/published_mass_problem": SAMPLE,
    "core/runnable": KERNEL,
    "flexible/kane_beam": SAMPLE,
    "flexible/reference_frequencies": ROUTE,
    "flexible/reference_shape": ROUTE,
    "flexible/residual_vibration": LIBRARY,
    "flexible/tip_deflection": LIBRARY,
    "math/central_gradient": ROUTE,
    "math/check_jacobian": ROUTE,
    "math/compose": LIBRARY,
    "optimise/pagmo_algorithm": LIBRARY,
    "optimise/pagmo_problem": LIBRARY,
    "parallel/angle_motion": LIBRARY,
    "parallel/area_of": LIBRARY,
    "parallel/available_torque": LIBRARY,
    "parallel/dexterity_benchmark_with_pi_joints": SAMPLE,
    "parallel/direct_dynamics": ROUTE,
    "parallel/directions_over_sphere": LIBRARY,
    "parallel/pose_check_kernel_name": KERNEL,
    "parallel/split_error": ROUTE,
    "parallel/straight_between": LIBRARY,
    "parallel/symmetric_ratio_limit": SAMPLE,
    "planar/add_weld": LIBRARY,
    "planar/arm_counterweights": LIBRARY,
    "planar/arm_problem": LIBRARY,
    "planar/four_bar_sweep_kernel_name": KERNEL,
    "planar/joint_reaction": LIBRARY,
    "planar/kernel_name": KERNEL,
    "planar/pair_machines": LIBRARY,
    "planar/path_curvature": LIBRARY,
    "planar/pole_geometry": LIBRARY,
    "planar/reactions_newton_euler": ROUTE,
    "planar/reactions_redundant": ROUTE,
    "planar/rms_of_steps": LIBRARY,
    "planar/slider_path_kernel_name": KERNEL,
    "planar/sweep_kernel_name": KERNEL,
    "planar/transmission_ranges": LIBRARY,
    "planar/two_link_arm": SAMPLE,
    "planar/two_link_motion": SAMPLE,
    "planar/with_counterweights": LIBRARY,
    "suspension/basic_structures": SAMPLE,
    "suspension/design_parameters": LIBRARY,
    "suspension/elastic_rods": LIBRARY,
    "suspension/input_derivatives": ROUTE,
    "suspension/link_problem": LIBRARY,
    "suspension/parse_structure": ROUTE,
    "suspension/read_hard_points": LIBRARY,
    "suspension/roll_gains": LIBRARY,
    "suspension/rs_dyad": ROUTE,
}


def declared(text):
    """Names of functions that a header declares at namespace scope (no indentation)."""
    text = re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.S)
    return {m[1] for m in DECLARATION.finditer(text)} - {"operator", "names", "fields"}


def check(root, reasons=None):
    reasons = REASONS if reasons is None else reasons
    source = root / "src" / "linkwright"
    words, functions = {}, {}
    for path in repository.files(root):
        if source not in path.parents or path.suffix not in (".h", ".cpp"):
            continue
        where = path.relative_to(source).as_posix()
        text = repository.text_of(path)
        code = re.sub(r"/\*.*?\*/|//[^\n]*", "", text, flags=re.S)
        words[where] = {}
        for word in WORD.findall(code):
            words[where][word] = words[where].get(word, 0) + 1
        if path.suffix == ".h" and "/studies/" not in where and "/detail/" not in where and where.count("/"):
            for name in declared(text):
                functions.setdefault(f"{where.split('/')[0]}/{name}", []).append(where)
    findings, unreached = [], set()
    for key, headers in sorted(functions.items()):
        name = key.split("/")[1]
        calls = 0
        for where, counts in words.items():
            count = counts.get(name, 0)
            if where in headers:
                continue
            definitions = 0
            if any(where.rpartition("/")[0] == header.rpartition("/")[0] for header in headers):
                text = (source / where).read_text(encoding="utf-8")
                definitions = len(re.findall(rf"^\S[^\n=]*\b{name}\((?![^\n]*;$)", text, re.M))
            calls += max(0, count - definitions)
        # Templates and inline functions may be used by the header that defines them.
        inside = sum(words[h].get(name, 0) for h in headers)
        if calls == 0 and inside <= len(headers):
            unreached.add(key)
            if key not in reasons:
                findings.append(f"src/linkwright/{headers[0]}: nothing calls {name}(); call it, move it to the tests, delete it, "
                                "or say in tools/check_reach.py who wants it")
    for key in sorted(set(reasons) - unreached):
        findings.append(f"tools/check_reach.py: '{key}' needs no reason (it is called, or gone)")
    return findings


if __name__ == "__main__":
    sys.exit(repository.main(check))
