# SPDX-License-Identifier: BSD-3-Clause
"""Proves that tools/mutate_studies.py and tools/kill_and_resume.py find what they look for, with programs that do wrong."""

import subprocess
import sys
import tempfile
from pathlib import Path

TOOLS = Path(__file__).resolve().parent.parent.parent / "tools"

GOOD = """
import json, pathlib, sys
if sys.argv[1] == "catalogue":
    print("[]")
if sys.argv[1] == "run":
    folder = pathlib.Path(sys.argv[sys.argv.index("--out") + 1])
    folder.mkdir(exist_ok=True)
    (folder / "result.json").write_text('{"run": {}, "best": 1.5}')
"""


def outcome(folder, tool, text, *options):
    program = folder / "program"
    program.write_text(f"#!{sys.executable}\n{text}", encoding="utf-8")
    program.chmod(0o755)
    done = subprocess.run([sys.executable, "-B", TOOLS / tool, program, *options], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout


with tempfile.TemporaryDirectory() as name:
    place = Path(name)

    def mutate(text, *options):
        return outcome(place, "mutate_studies.py", text, "--cases", "3", "--memory", "0", *options)

    assert mutate(GOOD)[0] == 0, mutate(GOOD)
    for wrong, told in [
        ("sys.exit(70)", "exit code 70"),
        ("sys.exit(2)", "exit code 2 without a message"),
        ("import os; os.abort()", "dies of SIGABRT"),
        ("sys.stderr.write('x.cpp:3: runtime error: signed integer overflow'); sys.exit(2)", "a sanitizer complains"),
        ("(folder / 'result.json').write_text('{')", "result.json"),
    ]:
        code, said = mutate(GOOD + "    " + wrong + "\n")
        assert code == 1 and told in said, (wrong, said)
    code, said = mutate(GOOD + "    while True: pass\n", "--cpu", "1", "--cases", "1")
    assert code == 1 and "more than 1 s of processor time" in said, said
    # The same damage for the same number, and another one for another.
    files = []
    for number in ("7", "7", "8"):
        mutate(GOOD, "--case", number, "--keep", str(place / "kept"))
        files.append((place / "kept" / f"1-{number}" / "study.toml").read_bytes())
    assert files[0] == files[1] != files[2]

    def kill(text):
        return outcome(place, "kill_and_resume.py", text, "--kills", "2", "--study", "balancing")

    slow = GOOD + "    import time; time.sleep(0.3)\n"
    code, said = kill(slow)
    assert code == 0 and "0 rounds ended differently" in said, said
    code, said = kill(slow + "    if '--resume' in sys.argv: (folder / 'result.json').write_text('{\"best\": 1.50}')\n")
    assert code == 1 and "differs in result.json" in said, said
