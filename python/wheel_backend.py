# SPDX-License-Identifier: BSD-3-Clause
"""Builds the wheel: the package and its extension, by CMake, with the libraries that not every Linux has. What pip calls are the
hooks of PEP 517; nothing but Python's own library is used, so that no network is needed.

LINKWRIGHT_BUILD names a folder that CMake has configured for this Python; without it the one of ./run is used, so that what
./run has compiled is not compiled again.
"""

import base64
import hashlib
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig
import tomllib
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
LIBRARIES = "libs"  # beside the extension, which looks there first (src/linkwright/python/CMakeLists.txt)
# On every Linux with this processor; newer ones run what was linked with older ones.
EVERYWHERE = re.compile(r"(linux-vdso|ld-linux.*|lib(c|m|dl|rt|pthread|util|stdc\+\+|gcc_s|z))\.so.*")


def get_requires_for_build_wheel(config_settings=None):
    return []


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    version = re.search(r'LINKWRIGHT_VERSION "(.*)"', (ROOT / "src/linkwright/version.h").read_text(encoding="utf-8"))[1]
    package = built_package()
    tag = f"cp{sys.version_info.major}{sys.version_info.minor}"
    tags = f"{tag}-{tag}-{re.sub(r'[-.]', '_', sysconfig.get_platform())}"
    name = f"{project['name']}-{version}-{tags}.whl"
    info = f"{project['name']}-{version}.dist-info"
    with Wheel(pathlib.Path(wheel_directory, name), info) as wheel:
        extension = package / f"_linkwright{sysconfig.get_config_var('EXT_SUFFIX')}"
        for path in sorted((ROOT / "python/linkwright").iterdir()):
            if path.suffix in (".py", ".pyi", ".typed") or path.name == "py.typed":
                wheel.add(f"linkwright/{path.name}", path.read_bytes())
        wheel.add(f"linkwright/{extension.name}", stripped(extension), executable=True)
        wheel.add(f"{info}/licenses/LICENSE", (ROOT / "LICENSE").read_bytes())
        for library, path in sorted(libraries_of(extension).items()):
            wheel.add(f"linkwright/{LIBRARIES}/{library}", path.read_bytes(), executable=True)
            if licence := licence_of(path):
                wheel.add(f"{info}/licenses/{library}.txt", licence)
        wheel.add(f"{info}/METADATA", metadata(project, version).encode())
        wheel.add(f"{info}/WHEEL", f"Wheel-Version: 1.0\nGenerator: linkwright\nRoot-Is-Purelib: false\nTag: {tags}\n".encode())
    return name


def built_package():
    """The folder of the package, built."""
    # pip hides the installed packages from what it calls; CMake's scripts may use them.
    environment = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    folder = os.environ.get("LINKWRIGHT_BUILD")
    if not folder:
        folder = ROOT / "build/release"
        run(["cmake", "--preset", "release", "-D", "LINKWRIGHT_PYTHON=ON", "-D", f"LINKWRIGHT_PYTHON_EXECUTABLE={sys.executable}"],
            environment)
    run(["cmake", "--build", folder, "--target", "python_package", "--parallel", jobs()], environment)
    package = pathlib.Path(folder, "python/linkwright")
    if not (package / f"_linkwright{sysconfig.get_config_var('EXT_SUFFIX')}").is_file():
        sys.exit(f"{folder} is configured for another Python than {sys.executable}")
    return package


def jobs():
    return subprocess.run([ROOT / "tools/build-jobs.sh"], capture_output=True, text=True, check=True).stdout.strip()


def run(command, environment):
    if subprocess.run(command, cwd=ROOT, env=environment, check=False).returncode != 0:
        sys.exit(f"{' '.join(map(str, command))} failed; tools/install-packages.sh test installs what is needed")


def libraries_of(extension):
    """{name: file} of what it loads and not every Linux has."""
    listed = subprocess.run(["ldd", extension], capture_output=True, text=True, check=True).stdout
    found = dict(re.findall(r"^\s*(\S+) => (/\S+) ", listed, re.M))
    return {name: pathlib.Path(path) for name, path in found.items() if not EVERYWHERE.fullmatch(name)}


def licence_of(library):
    """What Debian says of the copyright of a library, without the names of its source files; None on other systems."""
    if not shutil.which("dpkg-query"):
        return None
    owner = subprocess.run(["dpkg-query", "-S", library.resolve()], capture_output=True, text=True, check=False).stdout
    file = pathlib.Path("/usr/share/doc", owner.split(":")[0], "copyright")
    if not owner or not file.is_file():
        return None
    # The holders and the licences are what has to be passed on; for Boost the names of the files alone take 2 MB.
    return re.sub(rb"^Files(-Excluded)?:.*\n([ \t].*\n)*", b"", file.read_bytes(), flags=re.MULTILINE)


def stripped(extension):
    """Its bytes without the names of functions that nobody outside calls."""
    strip = shutil.which("strip")
    if not strip:
        return extension.read_bytes()
    copy = extension.with_suffix(".stripped")
    try:
        subprocess.run([strip, "--strip-unneeded", "-o", copy, extension], check=True)
        return copy.read_bytes()
    finally:
        copy.unlink(missing_ok=True)


def metadata(project, version):
    lines = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {version}", f"Summary: {project['description']}",
             f"Requires-Python: {project['requires-python']}", "Description-Content-Type: text/markdown"]
    lines += [f"Requires-Dist: {name}" for name in project["dependencies"]]
    for extra, names in project["optional-dependencies"].items():
        lines += [f"Provides-Extra: {extra}", *(f'Requires-Dist: {name}; extra == "{extra}"' for name in names)]
    return "\n".join(lines) + "\n\n" + (ROOT / "docs/python.md").read_text(encoding="utf-8")


class Wheel:
    """A wheel that is being written; the list of its files comes last."""

    def __init__(self, path, info):
        self.info, self.record = info, []
        self.file = zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED)

    def add(self, name, data, executable=False):
        entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))  # the same bytes whenever it is built
        entry.compress_type = zipfile.ZIP_DEFLATED
        entry.external_attr = (0o100755 if executable else 0o100644) << 16
        self.file.writestr(entry, data)
        digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
        self.record.append(f"{name},sha256={digest},{len(data)}")

    def __enter__(self):
        return self

    def __exit__(self, *raised):
        if raised[0] is None:
            name = f"{self.info}/RECORD"
            self.record.append(f"{name},,")
            entry = zipfile.ZipInfo(name, (1980, 1, 1, 0, 0, 0))
            entry.external_attr = 0o100644 << 16
            self.file.writestr(entry, "\n".join(self.record) + "\n")
        self.file.close()
