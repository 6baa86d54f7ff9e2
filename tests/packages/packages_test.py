# SPDX-License-Identifier: BSD-3-Clause
"""Makes the packages, and uses each in a Debian from which everything else is missing.

    packages_test.py BUILD OUT [SUITE MIRROR]

With SUITE and MIRROR only the archive that is unpacked anywhere is used, in a root of that suite (Ubuntu: jammy
http://archive.ubuntu.com/ubuntu). Ends with 77, which is a skipped test, where no root can be made, and says why.
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

SOURCE = pathlib.Path(__file__).resolve().parents[2]
STUDY = "hoeken"
LARGEST = 12e6  # bytes, of what is loaded to have the program


def run(*command, **options):
    done = subprocess.run([str(word) for word in command], capture_output=True, text=True, check=False, **options)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, command))}: exit code {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout


class Root:
    """A file system with a distribution in it, and little else."""

    def __init__(self, folder, suite, mirror):
        self.folder = pathlib.Path(folder)
        words = [] if "debian" in mirror else ["--no-check-gpg"]
        made = subprocess.run(["debootstrap", "--variant=minbase", *words, suite, self.folder, mirror],
                              capture_output=True, text=True, check=False)
        if made.returncode:
            print(f"no root could be made, nothing was installed: {made.stdout[-2000:]}{made.stderr[-2000:]}")
            sys.exit(77)

    def call(self, *command):
        # Libraries beside a program are found through /proc, which every running system has; the mount ends with the command.
        return run("unshare", "--mount", "sh", "-euc", 'mount --bind /proc "$0/proc" && exec chroot "$0" "$@"', self.folder,
                   "/usr/bin/env", "-i", "PATH=/usr/sbin:/usr/bin:/sbin:/bin", "HOME=/root", "LC_ALL=C.UTF-8",
                   "DEBIAN_FRONTEND=noninteractive", *command)

    def put(self, file):
        shutil.copy(file, self.folder / "root")
        return f"/root/{pathlib.Path(file).name}"

    def result(self, *command):
        """Of the study, by a program in the root."""
        self.call("sh", "-euc", f"rm -rf /srv/study && mkdir /srv/study && cd /srv/study && {' '.join(command)}")
        assert (self.folder / "srv/study/out/report.html").stat().st_size > 1e5
        return json.loads((self.folder / "srv/study/out/result.json").read_text(encoding="utf-8"))


def attack_python(root, python):
    """The tests of what must not bring Python down, by a Python of the root."""
    environment = ["env", "LINKWRIGHT=/nowhere", "LINKWRIGHT_EXAMPLES=/nowhere", python, "-B"]
    chosen = ["-k", "test_nesting", "-k", "test_files_of_examples", "-k", "test_results_have_all_numbers"]
    for test, words in (("exit_test.py", []), ("interruption_test.py", []), ("studies_test.py", chosen)):
        script = root.put(SOURCE / "tests/python" / test)
        root.call(*environment, script, *words)
    print(f"{python}: threads at the end, Ctrl-C, deep values and pickles")


def same(result, expected, where):
    for part in ("answer", "tables", "checks"):
        assert result[part] == expected[part], f"{part} of {where} is not that of the build"
    print(f"{where}: the numbers of the build")


def main():
    build, out = (pathlib.Path(p).resolve() for p in sys.argv[1:3])
    suite, mirror = sys.argv[3:5] if len(sys.argv) > 3 else ("bookworm", "http://deb.debian.org/debian")
    if os.geteuid() or not shutil.which("debootstrap"):
        print("a clean root takes root and debootstrap; nothing was installed")
        sys.exit(77)
    if subprocess.run(["unshare", "--mount", "true"], capture_output=True, check=False).returncode:
        print("a clean root takes a machine that allows mounts (unshare --mount); nothing was installed")
        sys.exit(77)
    shutil.rmtree(out, ignore_errors=True)
    print(run(sys.executable, "-B", SOURCE / "tools/package.py", build, out))
    with tempfile.TemporaryDirectory() as again:
        run(sys.executable, "-B", SOURCE / "tools/package.py", build, again)
        for file in out.iterdir():
            assert file.read_bytes() == (pathlib.Path(again) / file.name).read_bytes(), f"{file.name} differs from build to build"
    (archive,) = out.glob("*.tar.xz")
    assert archive.stat().st_size < LARGEST
    bill = json.loads((out / "sbom.cdx.json").read_text(encoding="utf-8"))
    names = {part["name"] for part in bill["components"]}
    assert {"libpagmo8", "libeigen3-dev", "preact", "three"} <= names, names
    command = ["linkwright", "examples", "--copy", STUDY, "&&", "linkwright", "run", f"{STUDY}.toml", "--out", "out", "--quiet"]
    # Pagmo is loaded when it is needed.
    by_pagmo = ["linkwright", "examples", "--copy", "fourbar-18-points", "&&", "linkwright", "run", "fourbar-18-points.toml", "--out", "out",
                "--set", "\"optimiser={method='cma_es'}\"", "--set", "check=[]", "--quiet"]
    with tempfile.TemporaryDirectory() as here:
        run("sh", "-euc", " ".join(command).replace("linkwright ", f"{build}/bin/linkwright "), cwd=here)
        expected = json.loads((pathlib.Path(here) / "out/result.json").read_text(encoding="utf-8"))

    with tempfile.TemporaryDirectory() as folder:
        root = Root(pathlib.Path(folder) / "root", suite, mirror)
        for missing in ("g++", "cc", "cmake", "node", "linkwright", "python3"):
            assert not (root.folder / "usr/bin" / missing).exists(), missing
        # 1: unpacked somewhere, by somebody, in a root without anything.
        if not (root.folder / "usr/bin/xz").exists():
            root.call("apt-get", "-q", "-y", "install", "--no-install-recommends", "xz-utils")
        root.call("tar", "-C", "/opt", "-xf", root.put(archive))
        (unpacked,) = (root.folder / "opt").iterdir()
        program = f"/opt/{unpacked.name}/bin/linkwright"
        same(root.result(*[program if word == "linkwright" else word for word in command]), expected, f"{archive.name} on {suite}")
        root.result(*[program if word == "linkwright" else word for word in by_pagmo])
        if len(sys.argv) > 3:
            return
        shutil.rmtree(unpacked)

        # 2: Debian's packages.
        root.call("apt-get", "-q", "update")
        left_out = ("linkwright-dev", "linkwright-studies-dev", "linkwright-mpi")
        debs = [root.put(file) for file in out.glob("*.deb") if not file.name.startswith(left_out)]
        root.call("apt-get", "-q", "-y", "install", "--no-install-recommends", *debs)
        same(root.result(*command), expected, "linkwright.deb")
        root.result(*by_pagmo)
        for file in ("man1/linkwright.1.gz", "../bash-completion/completions/linkwright"):
            assert (root.folder / "usr/share/man" / file).is_file(), file
        for missing in ("g++", "cc", "cmake", "node"):
            assert not (root.folder / "usr/bin" / missing).exists(), missing
        script = f'import linkwright; linkwright.example("{STUDY}").run().save("out")'
        if any("python3-linkwright" in deb for deb in debs):
            same(root.result("/usr/bin/python3", "-c", f"'{script}'"), expected, "python3-linkwright.deb")
            root.call("/usr/bin/python3", "-B", root.put(SOURCE / "tests/packages/attacks.py"), "/usr/bin/linkwright")
            root.put(SOURCE / "tests/python/program.py")
            attack_python(root, "/usr/bin/python3")
            # 3: the wheel, without the libraries of Debian's packages.
            root.call("apt-get", "-q", "-y", "remove", "linkwright", "python3-linkwright", "libpagmo8", "libfmt9", "libtbb12")
            root.call("apt-get", "-q", "-y", "install", "--no-install-recommends", "python3-venv")
            (wheel,) = out.glob("*.whl")
            root.call("/usr/bin/python3", "-m", "venv", "--system-site-packages", "/opt/venv")
            root.call("/opt/venv/bin/pip", "--disable-pip-version-check", "install", "--quiet", "--no-index", root.put(wheel))
            same(root.result("/opt/venv/bin/python", "-c", f"'{script}'"), expected, wheel.name)
            attack_python(root, "/opt/venv/bin/python")
        # The requirements of a library are listed; compilers are no part of it.
        listed = run("dpkg-deb", "-c", next(out.glob("linkwright-dev_*.deb")))
        for file in ("usr/include/linkwright/planar.h", "cmake/Linkwright/LinkwrightConfig.cmake",
                     "pkgconfig/linkwright.pc", "liblinkwright_planar.a"):
            assert file in listed, file
        for file in ("liblinkwright_study.a", "linkwright/studies.h", "linkage/kernel.h"):
            assert file not in listed, file
        listed = run("dpkg-deb", "-c", next(out.glob("linkwright-studies-dev_*.deb")))
        for file in ("usr/include/linkwright/studies.h", "cmake/Linkwright/LinkwrightStudiesTargets.cmake",
                     "pkgconfig/linkwright-studies.pc", "liblinkwright_app.a"):
            assert file in listed, file


if __name__ == "__main__":
    main()
