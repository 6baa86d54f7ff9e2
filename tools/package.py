#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Makes what is handed out, from a folder that CMake has built with Debian's packages:

    tools/package.py BUILD OUT

    linkwright_VERSION_ARCH.deb              program, completions, page of the manual
    linkwright-mpi_VERSION_ARCH.deb          its plug-in by which the ranks of mpirun share a study, if the build has it
    linkwright-dev_VERSION_ARCH.deb          headers, libraries, packages of CMake and pkg-config: mechanics
    linkwright-studies-dev_VERSION_ARCH.deb  the same for study files and reports
    python3-linkwright_VERSION_ARCH.deb      Python module
    linkwright-VERSION-linux-ARCH.tar.xz     the program with all libraries that it needs, to be unpacked anywhere; no root
    linkwright-VERSION-*.whl                 Python module for pip, with its libraries
    workbench.html                           the workbench in one page, if build/wasm has it
    sbom.cdx.json                            what is in them, with versions and licences (CycloneDX 1.5)
    SHA256SUMS

The same build gives the same bytes: files are sorted, owned by root, and as old as the commit.
"""

import argparse
import hashlib
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "python"))
import wheel_backend  # noqa: E402  # of the folder before

VERSION = re.search(r'LINKWRIGHT_VERSION "(.*)"', (ROOT / "src/linkwright/version.h").read_text(encoding="utf-8"))[1]
MAINTAINER = "The Linkwright developers <developers@linkwright.invalid>"
PAGMO = "lib/linkwright/pagmo.so"  # the plug-in that the program loads when it needs pagmo
SUMMARY = "analyses, balances and synthesises mechanisms"
ABOUT = """ Planar linkages, wheel suspensions, parallel robots, joints with clearance
 and flexible arms: positions, forces, drives, limits, balance, and synthesis
 for paths and other targets, with interactive reports."""


def output(*command, **options):
    return subprocess.run([str(word) for word in command], check=True, capture_output=True, text=True, **options).stdout.strip()


def run(*command, **options):
    subprocess.run([str(word) for word in command], check=True, stdout=subprocess.DEVNULL, **options)


def commit_time():
    """Seconds: of SOURCE_DATE_EPOCH, or of the last commit."""
    return os.environ.get("SOURCE_DATE_EPOCH") or output("git", "-C", ROOT, "log", "-1", "--format=%ct")


def install(build, component, prefix):
    run("cmake", "--install", build, "--prefix", prefix, "--component", component)


def owner(file):
    """Name and version of the Debian package that a file belongs to."""
    found = subprocess.run(["dpkg-query", "-S", str(pathlib.Path(file).resolve())], capture_output=True, text=True, check=False).stdout
    return package(found.split(":")[0]) if found else None


def package(name):
    version = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", name], capture_output=True, text=True, check=False).stdout
    return (name, version) if version else None


def build_packages():
    """Debian packages that the program is compiled with, from the one list of them."""
    script = (ROOT / "tools/install-packages.sh").read_text(encoding="utf-8")
    return re.search(r'^packages="([^"]*)"', script, re.M)[1].split()


# --- Debian packages ---------------------------------------------------------------------------------------------------------

def shared_library_packages(*files):
    """What dpkg-shlibdeps says that programs or libraries depend on."""
    with tempfile.TemporaryDirectory() as folder:
        (pathlib.Path(folder) / "debian").mkdir()
        (pathlib.Path(folder) / "debian/control").write_text("Source: linkwright\n\nPackage: linkwright\nArchitecture: any\n", encoding="utf-8")
        said = output("dpkg-shlibdeps", "-O", *(f"-e{file}" for file in files), cwd=folder)
    return said.removeprefix("shlibs:Depends=").split(", ")


def deb(out, name, stage, depends, section, summary=SUMMARY):
    """Packs a folder."""
    architecture = output("dpkg", "--print-architecture")
    documents = stage / "usr/share/doc" / name
    documents.mkdir(parents=True)
    shutil.copy(ROOT / "LICENSE", documents / "copyright")
    control = stage / "DEBIAN"
    control.mkdir()
    size = sum(f.stat().st_size for f in stage.rglob("*") if f.is_file()) // 1024
    lines = [f"Package: {name}", f"Version: {VERSION}", f"Architecture: {architecture}", f"Maintainer: {MAINTAINER}", f"Section: {section}",
             "Priority: optional", f"Installed-Size: {size}", f"Depends: {', '.join(depends)}", f"Description: {summary}", ABOUT]
    (control / "control").write_text("\n".join(lines) + "\n", encoding="utf-8")
    stage.chmod(0o755)
    for path in [stage, *stage.rglob("*")]:
        path.chmod(0o755 if path.is_dir() or path.parent.name == "bin" else 0o644)
        os.utime(path, (int(commit_time()),) * 2)  # dpkg-deb keeps what is older
    file = out / f"{name}_{VERSION}_{architecture}.deb"
    run("dpkg-deb", "--root-owner-group", "-Zxz", "--build", stage, file)
    return file


def program_deb(build, out, work):
    stage = work / "program"
    install(build, "program", stage / "usr")
    run("strip", stage / "usr/bin/linkwright")
    run("strip", "--strip-unneeded", stage / "usr" / PAGMO)
    run("gzip", "-9n", stage / "usr/share/man/man1/linkwright.1")
    return deb(out, "linkwright", stage, shared_library_packages(build / "bin/linkwright", build / PAGMO), "science")


def mpi_deb(build, out, work):
    plug_in = build / "lib/linkwright/mpi.so"
    if not plug_in.is_file():
        return None
    stage = work / "mpi"
    install(build, "mpi", stage / "usr")
    run("strip", "--strip-unneeded", stage / "usr/lib/linkwright/mpi.so")
    depends = [f"linkwright (= {VERSION})", "openmpi-bin", *shared_library_packages(plug_in)]
    return deb(out, "linkwright-mpi", stage, depends, "science", SUMMARY + " (on many machines)")


# What CMake looks for when a program links the mechanics.
NEEDED_BY_MECHANICS = ("libfmt-dev", "libeigen3-dev", "libtbb-dev", "libsundials-dev", "libnlopt-dev", "libnlopt-cxx-dev",
                       "libpagmo-dev", "libboost1.74-dev")


def development_deb(build, out, work, component, name, needs, summary):
    """Headers, libraries and their packages of CMake and pkg-config: of the mechanics, or of study files and reports."""
    stage = work / component
    install(build, component, stage / "usr")
    for library in (stage / "usr").rglob("*.a"):
        run("strip", "--strip-debug", "--enable-deterministic-archives", library)
    return deb(out, name, stage, needs, "libdevel", f"{SUMMARY} (C++ library{summary})")


def development_debs(build, out, work):
    mechanics = [p for p in build_packages() if p in NEEDED_BY_MECHANICS]
    return [development_deb(build, out, work, "development", "linkwright-dev", mechanics, ""),
            development_deb(build, out, work, "studies-development", "linkwright-studies-dev", [f"linkwright-dev (= {VERSION})", "zlib1g-dev"],
                            " for study files and reports")]


def python_deb(build, out, work):
    source = build / "python/linkwright"
    if not source.is_dir():
        return None
    stage = work / "python"
    target = stage / "usr/lib/python3/dist-packages/linkwright"
    target.mkdir(parents=True)
    for file in sorted(source.iterdir()):
        if file.suffix in (".py", ".pyi", ".so", ".typed") or file.name == "py.typed":
            shutil.copy(file, target / file.name)
    (extension,) = target.glob("*.so")
    depends = shared_library_packages(source / extension.name)
    run("strip", "--strip-unneeded", extension)
    run("patchelf", "--remove-rpath", extension)
    minor = int(re.search(r"cpython-3(\d+)", extension.name)[1])
    depends += [f"python3 (>= 3.{minor})", f"python3 (<< 3.{minor + 1})", "python3-numpy"]
    return deb(out, "python3-linkwright", stage, depends, "python", SUMMARY + " (Python module)")


# --- The program to be unpacked anywhere -------------------------------------------------------------------------------------

def tarball(build, out, work, bundled, bill):
    name = f"linkwright-{VERSION}-linux-{output('uname', '-m')}"
    stage = work / name
    install(build, "program", stage)
    program = stage / "bin/linkwright"
    plug_in = stage / PAGMO
    libraries = plug_in.parent
    run("strip", program)
    run("strip", "--strip-unneeded", plug_in)
    run("patchelf", "--set-rpath", "$ORIGIN/../lib/linkwright", program)
    run("patchelf", "--set-rpath", "$ORIGIN", plug_in)
    documents = stage / "share/doc/linkwright"
    (documents / "licences").mkdir(parents=True)
    for library, path in sorted(bundled.items()):
        shutil.copy(path.resolve(), libraries / library)
        run("patchelf", "--set-rpath", "$ORIGIN", libraries / library)
        (documents / "licences" / f"{library}.txt").write_bytes(wheel_backend.licence_of(path) or b"")
    for path in bill["licences"]:
        shutil.copy(path, documents / "licences" / f"{path.parent.name}.txt")
    shutil.copy(ROOT / "LICENSE", documents / "LICENSE")
    (documents / "sbom.cdx.json").write_text(bill["text"], encoding="utf-8")
    for path in [stage, *stage.rglob("*")]:
        path.chmod(0o755 if path.is_dir() or path == program else 0o644)
    file = out / f"{name}.tar.xz"
    with file.open("wb") as stream:
        tar = subprocess.Popen(["tar", "-C", str(work), "--sort=name", "--owner=0", "--group=0", "--numeric-owner", f"--mtime=@{commit_time()}",
                                "--format=gnu", "-c", name], stdout=subprocess.PIPE)
        # Machine code is packed closer when jumps are written as places; every xz unpacks it.
        filters = ["--x86"] if output("uname", "-m") == "x86_64" else []
        subprocess.run(["xz", *filters, "--lzma2=preset=9e,lc=4,depth=5000", "-T1", "-c"], stdin=tar.stdout, stdout=stream, check=True)
        tar.stdout.close()
        if tar.wait():
            sys.exit("tar failed")
    return file


# --- What is in them ---------------------------------------------------------------------------------------------------------

def bill_of_materials(bundled):
    """CycloneDX of libraries that are carried along, compiled in, or part of the pages; and the licences of those of npm."""
    parts, licences = {}, []
    for path in bundled.values():
        if found := owner(path):
            parts[found] = "shared library, carried along"
    for name in build_packages():
        if (name.startswith("lib") or name == "nlohmann-json3-dev") and (found := package(name)):
            parts.setdefault(found, "compiled in")
    components = [{"type": "library", "name": name, "version": version, "purl": f"pkg:deb/debian/{name}@{version}", "description": use}
                  for (name, version), use in sorted(parts.items())]
    lock = json.loads((ROOT / "web/package-lock.json").read_text(encoding="utf-8"))
    for path, entry in sorted(lock["packages"].items()):
        if not path or entry.get("dev") or entry.get("optional"):
            continue
        name = path.removeprefix("node_modules/")
        component = {"type": "library", "name": name, "version": entry["version"],
                     "purl": f"pkg:npm/{name.replace('@', '%40')}@{entry['version']}", "description": "in reports and the workbench"}
        if "license" in entry:
            component["licenses"] = [{"license": {"id": entry["license"]}}]
        components.append(component)
        licences += [f for f in sorted((ROOT / "web" / path).glob("LICEN[CS]E*"))[:1] if f.is_file()]
    document = {"bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1,
                "metadata": {"component": {"type": "application", "name": "linkwright", "version": VERSION,
                                           "licenses": [{"license": {"id": "BSD-3-Clause"}}]}},
                "components": components}
    return {"text": json.dumps(document, indent=1) + "\n", "licences": licences}


def main():
    arguments = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    arguments.add_argument("build", type=lambda p: pathlib.Path(p).resolve())
    arguments.add_argument("out", type=lambda p: pathlib.Path(p).resolve())
    given = arguments.parse_args()
    program = given.build / "bin/linkwright"
    if not program.is_file():
        sys.exit(f"{program} is missing: build it first, for example by ./test")
    os.environ["SOURCE_DATE_EPOCH"] = commit_time()
    given.out.mkdir(parents=True, exist_ok=True)
    bundled = wheel_backend.libraries_of(program) | wheel_backend.libraries_of(given.build / PAGMO)
    bill = bill_of_materials(bundled)
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        python = python_deb(given.build, given.out, work)
        made = [program_deb(given.build, given.out, work), mpi_deb(given.build, given.out, work),
                *development_debs(given.build, given.out, work),
                python, tarball(given.build, given.out, work, bundled, bill)]
    if python:
        os.environ["LINKWRIGHT_BUILD"] = str(given.build)
        made.append(given.out / wheel_backend.build_wheel(given.out))
    (given.out / "sbom.cdx.json").write_text(bill["text"], encoding="utf-8")
    made.append(given.out / "sbom.cdx.json")
    page = ROOT / "build/wasm/workbench.html"
    if page.is_file():
        made.append(pathlib.Path(shutil.copy(page, given.out)))
    made = [file for file in made if file]
    sums = [f"{hashlib.sha256(file.read_bytes()).hexdigest()}  {file.name}" for file in made]
    (given.out / "SHA256SUMS").write_text("\n".join(sums) + "\n", encoding="utf-8")
    for file in made:
        print(f"{file.stat().st_size / 1e6:7.2f} MB  {file.name}")


if __name__ == "__main__":
    main()
