#!/usr/bin/env python3
"""Checks that every include and every link goes from a higher floor to a lower one.

    tools/check_layers.py [ROOT]
"""

import fnmatch
import re
import sys

import repository

# Rooms, bottom up. A room uses the floors below its own, never a room of the same floor.
FLOORS = [
    ["core"],
    ["math"],
    ["optimise"],
    ["study"],
    ["planar", "flexible", "suspension", "parallel", "report"],
    ["clearance"],
    ["app"],
    ["cli", "serve"],
]
FLOOR = {room: floor for floor, rooms in enumerate(FLOORS) for room in rooms}
DOMAINS = {"planar", "flexible", "suspension", "parallel", "clearance"}

# What a room may not use although it lies below.
FORBIDDEN = {"report": {"optimise"}, **{domain: {"report"} for domain in DOMAINS}}

# Inside a domain, only these files use these rooms.
SYNTHESIS = ["*_synthesis*", "*balancing*", "path_*", "*_path_*", "tolerances*", "workspace*"]
STUDIES = ["studies*", "*_study*", "scene*", "*_scene*", "reproductions*"]
DOMAIN_FILES = {"optimise": SYNTHESIS + STUDIES, "study": STUDIES}

# Seconds of compile time each: they stay in the sources that need them, away from the headers.
HEAVY = ["toml++/*", "nlohmann/*", "CLI/*", "httplib.h", "pybind11/*", "Eigen/Dense", "Eigen/QR", "Eigen/SVD",
         "pagmo/*"]
# Headers that are there to show one of them, apart from everything else.
SHOWN = {"optimise/pagmo_adapters.h": "pagmo/*"}


def fits(name, patterns):
    return any(fnmatch.fnmatch(name, pattern) for pattern in patterns)


def arrow(user, used):
    """Why room `user` may not use room `used`, or None."""
    if used not in FLOOR:
        return f"room '{used}' stands on no floor (tools/check_layers.py lists them)"
    if user == used:
        return None
    if FLOOR[used] == FLOOR[user]:
        return f"{user} may not use {used}: they share a floor"
    if FLOOR[used] > FLOOR[user]:
        return f"{user} may not use {used}: it lies above"
    if used in FORBIDDEN.get(user, ()):
        return f"{user} may not use {used}"
    return None


def check_source(path, room, where):
    for number, bracket, name in repository.includes(path):
        here = f"{where}:{number}: "
        match = re.match(r"linkwright/([^/]+)/", name)
        if path.suffix == ".h" and name.removeprefix("linkwright/") in SHOWN:
            yield here + f"<{name}> shows a heavy header: include it in sources, not in headers"
        if match:
            used = match[1]
            problem = arrow(room, used)
            if not problem and room in DOMAINS and used in DOMAIN_FILES and not fits(path.name, DOMAIN_FILES[used]):
                problem = f"only {', '.join(DOMAIN_FILES[used])} of a domain use {used}"
            if problem:
                yield here + problem
        elif bracket == '"' and (path.parent / name).exists():
            yield here + f'say "linkwright/{room}/{name}": every include names its room'
        shown = SHOWN.get(f"{room}/{path.name}", "")
        if path.suffix == ".h" and fits(name, HEAVY) and not fits(name, [shown]):
            yield here + f"<{name}> is heavy: include it in sources, not in headers"


def check(root):
    findings = []
    source = root / "src" / "linkwright"
    for path in repository.files(root):
        if source not in path.parents:
            continue
        where = str(path.relative_to(root))
        room = path.relative_to(source).parts[0]
        if room not in FLOOR:
            findings.append(f"{where}: {arrow(room, room)}")
        elif path.suffix in (".h", ".cpp"):
            findings += check_source(path, room, where)
        elif path.name == "CMakeLists.txt":
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                for used in re.findall(r"\blinkwright_(\w+)\b", line.split("#")[0]):
                    if used in FLOOR and (problem := arrow(room, used)):
                        findings.append(f"{where}:{number}: {problem}")
    return findings


if __name__ == "__main__":
    sys.exit(repository.main(check))
