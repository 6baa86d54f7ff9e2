#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Checks that every include and every link goes from a higher layer to a lower one.

    tools/check_layers.py [ROOT]
"""

import fnmatch
import re
import sys

import repository

# Modules, bottom up. A module uses the layers below its own, never a module of the same layer.
LAYERS = [
    ["core"],
    ["math"],
    ["optimise"],
    ["study", "pagmo"],
    ["planar", "flexible", "suspension", "parallel", "report"],
    ["clearance", "parameter_study"],
    ["app"],
    ["serve"],
    ["cli", "mpi", "wasm", "python"],
]
LAYER = {module: layer for layer, modules in enumerate(LAYERS) for module in modules}
DOMAINS = {"planar", "flexible", "suspension", "parallel", "clearance", "parameter_study"}

# The modules that a module may not use although they lie below.
FORBIDDEN = {"report": {"optimise"}, **{domain: {"report"} for domain in DOMAINS}}

# Inside a domain: its folders, bottom up. A folder uses the ones below its own, never one of the same line. BASE are the
# files beside the folders; above all stand STUDIES and the DOORS, which are the only ones that use the study module.
BASE, STUDIES = "", "studies"
FOLDERS = {
    "planar": [[BASE], ["cam"], ["linkage", "serial_arm", "chains", "drawing"], ["four_bar", "sketch"],
               ["simulation", "path", "balancing", "dyads"], ["function", "exact", "type_synthesis"]],
    "suspension": [["corner"], ["wheel", "indirect"], ["compliance", "dependent"], ["direct"]],
    "parallel": [["pi_joint"], ["robot"], ["tool", "workspace", "assembly_modes", "serial_arm"], ["dexterity"]],
    "clearance": [[BASE]],
    "parameter_study": [[BASE]],
    "flexible": [[BASE]],
}
DOORS = ["studies.*", "reproductions*"]

# Below the studies, what looks for the best uses the optimisers, and so does what works on many cores.
OPTIMISE = ["*synthesis*", "*balancing*", "planar/path/*", "planar/exact/*", "planar/balancing/*", "*tolerances*", "parallel/workspace/*",
            "parameter_study/*", "clearance/sensitivity*"]

# Seconds of compile time each: they stay in the sources that need them, away from the headers.
HEAVY = ["toml++/*", "nlohmann/*", "CLI/*", "boost/asio/*", "boost/beast/*", "pybind11/*", "Eigen/Dense", "Eigen/QR", "Eigen/SVD",
         "pagmo/*"]
# Headers that are there to show one of them, apart from everything else.
SHOWN = {"optimise/pagmo_adapters.h": "pagmo/*", "python/arrays.h": "pybind11/*"}


# The operating system is asked in one place. Its headers, and calls of the global namespace, which are its functions wherever another
# header has let them in:
PLATFORM = "core/platform/"
OF_SYSTEM = ["sys/*", "arpa/*", "net/*", "netinet/*", "linux/*", "mach/*", "unistd.h", "fcntl.h", "poll.h", "signal.h", "csignal", "spawn.h",
             "sched.h", "dlfcn.h", "dirent.h", "pthread.h", "pwd.h", "grp.h", "netdb.h", "termios.h", "semaphore.h", "stdlib.h", "windows.h",
             "winsock2.h", "io.h", "process.h", "direct.h"]
GLOBAL_CALL = re.compile(r"(?:^|[^\w>)\]])(::[a-z]\w*)\(")


def fits(name, patterns):
    return any(fnmatch.fnmatch(name, pattern) for pattern in patterns)


def arrow(user, used):
    """Why module `user` may not use module `used`, or None."""
    if used not in LAYER:
        return f"module '{used}' belongs to no layer (tools/check_layers.py lists them)"
    if user == used:
        return None
    if LAYER[used] == LAYER[user]:
        return f"{user} may not use {used}: they share a layer"
    if LAYER[used] > LAYER[user]:
        return f"{user} may not use {used}: it lies above"
    if used in FORBIDDEN.get(user, ()):
        return f"{user} may not use {used}"
    return None


def folder_of(parts, domain):
    """The folder of a file of a domain, from its path below the domain; None for what stands above the studies."""
    if len(parts) > 1:
        return parts[0]
    return None if fits(parts[0], DOORS) else BASE


def folder_arrow(domain, user, used):
    """Why a file in folder `user` of a domain may not include one in folder `used`, or None."""
    level = {folder: layer for layer, folders in enumerate(FOLDERS[domain]) for folder in folders}
    level[STUDIES], level[None] = len(FOLDERS[domain]), len(FOLDERS[domain]) + 1
    for folder in (user, used):
        if folder not in level:
            return f"folder '{domain}/{folder}' has no place (tools/check_layers.py lists them)"
    if user == used or level[used] < level[user]:
        return None
    name = {None: "what stands above its studies", BASE: f"{domain}/"}
    return (f"{name.get(user, f'{domain}/{user}')} may not use {name.get(used, f'{domain}/{used}')}: "
            + ("they share a layer" if level[used] == level[user] else "it lies above"))


def domain_problem(parts, include):
    """Why a file of a domain, at src/linkwright/`parts`, may not include `include` ('module/...'), or None."""
    domain, *below = parts
    user, (used, *rest) = folder_of(below, domain), include
    if used == domain:
        return folder_arrow(domain, user, folder_of(rest, domain))
    if used == "study" and user not in (STUDIES, None):
        return f"only {domain}/{STUDIES}/ and {', '.join(DOORS)} use study"
    if used == "optimise" and user not in (STUDIES, None) and not fits("/".join(parts), OPTIMISE):
        return f"below the studies, only {', '.join(OPTIMISE)} use optimise"
    if used in FOLDERS and rest[0] == STUDIES and user not in (STUDIES, None):
        return f"only {domain}/{STUDIES}/ uses {used}/{STUDIES}/"
    return None


def check_source(path, module, where, parts):
    for number, bracket, name in repository.includes(path):
        here = f"{where}:{number}: "
        match = re.match(r"linkwright/([^/]+)/", name)
        if path.suffix == ".h" and name.removeprefix("linkwright/") in SHOWN:
            yield here + f"<{name}> shows a heavy header: include it in sources, not in headers"
        if match:
            used = match[1]
            problem = arrow(module, used)
            if not problem and used != module and "/detail/" in name:
                problem = f"only {used} uses what stands in its detail/"
            if not problem and module in FOLDERS:
                problem = domain_problem(parts, name.removeprefix("linkwright/").split("/"))
            if problem:
                yield here + problem
        elif bracket == '"' and (path.parent / name).exists():
            place = "/".join(parts[:-1])
            yield here + f'say "linkwright/{place}/{name}": every include names its module'
        if bracket == "<" and fits(name, OF_SYSTEM) and not "/".join(parts).startswith(PLATFORM):
            yield here + f"<{name}> belongs to the operating system: what it is asked for goes to {PLATFORM}"
        shown = SHOWN.get(f"{module}/{path.name}", "")
        if path.suffix == ".h" and fits(name, HEAVY) and not fits(name, [shown]):
            yield here + f"<{name}> is heavy: include it in sources, not in headers"


def check_calls(path, where):
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        for call in GLOBAL_CALL.findall(line.split("//")[0]):
            yield f"{where}:{number}: {call}() is a function of the operating system: what it is asked for goes to {PLATFORM}"


# The headers beside the modules, for users: the version, all mechanics, and of which modules the others include headers.
TOP = {"version.h": (), "linkwright.h": (), "studies.h": ("app", "study"), **{f"{module}.h": (module,) for module in LAYER}}


def check_top(path, where, name):
    """linkwright.h includes the other headers of its kind; each of these includes headers of its modules."""
    for number, _, used in repository.includes(path):
        of = used.removeprefix("linkwright/")
        if "/" in of if name == "linkwright.h" else not of.startswith(tuple(f"{module}/" for module in TOP[name])):
            yield f"{where}:{number}: {name} may not include {used}"


def check(root):
    findings = []
    source = root / "src" / "linkwright"
    for path in repository.files(root):
        if source not in path.parents:
            continue
        where = str(path.relative_to(root))
        module = path.relative_to(source).parts[0]
        if path.parent == source and module in TOP:
            findings += check_top(path, where, module)
        elif module not in LAYER:
            findings.append(f"{where}: {arrow(module, module)}")
        elif path.suffix in (".h", ".cpp"):
            findings += check_source(path, module, where, path.relative_to(source).parts)
            if not path.relative_to(source).as_posix().startswith(PLATFORM):
                findings += check_calls(path, where)
        elif path.name == "CMakeLists.txt":
            for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
                for used in re.findall(r"\blinkwright_(\w+)\b", line.split("#")[0]):
                    used = used.removesuffix("_" + STUDIES)
                    if used in LAYER and (problem := arrow(module, used)):
                        findings.append(f"{where}:{number}: {problem}")
    return findings


if __name__ == "__main__":
    sys.exit(repository.main(check))
