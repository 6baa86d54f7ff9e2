#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Runs the program on damaged studies: whatever a file holds, it must end in time, in its memory, and with an exit code of its
own.

    tools/mutate_studies.py LINKWRIGHT [--cases N] [--seed S] [--case K] [--keep FOLDER] [--shrink] [--jobs J]
                            [--memory MB] [--cpu SECONDS] [--time-limit SECONDS] [--large]

Each case takes an example or a template of `linkwright new` and damages it one to four times: bytes, lines, keys, numbers,
types, nesting, lengths, characters. The case (seed, number) is always the same one; --case runs it alone, --keep leaves its
files, --shrink drops the damages that are not needed for the fault. With --large the only damage is that one or two numbers are
multiplied by 1e3 to 1e9: what is then kept of a run must still fit into the memory.
Exit code 1 when a case broke a rule, and 2 when the program could not be tried at all.
"""

import argparse
import collections
import concurrent.futures
import difflib
import json
import random
import re
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
GOOD_CODES = range(0, 5)
WALL = 20  # times the limit of processor time: against what sleeps for ever, on a busy machine too
SANITIZERS = re.compile(r"runtime error:|Sanitizer|Assertion|terminate called")

NUMBERS = ["0", "-1", "1", "2", "0.5", "-0.0", "1e308", "-1e308", "1e-308", "5e-324", "nan", "inf", "-inf", "1e16", "1e-16",
           "2147483647", "2147483648", "4294967296", "9223372036854775807", "-9223372036854775808", "1000000", "100000000",
           "360", "90", "180", "1e-9", "3"]
OTHER = ['""', '"x"', '"0"', "true", "false", "[]", "{}", "[[]]", "[1]", "[1, 2, 3]", '["a"]', "[nan, inf]", "{ a = 1 }",
         "1979-05-27", "07:32:00", "0x7fffffffffffffff", "[[1, 2], [3, 4]]", "'", '"""', "[ , ]", "[1, 'a']"]
ODD = ["\u202e", "\U0001f980", "\u0000", "\ufeff", "e\u0301" * 50, "\u2028", "%s%n", "../../x", "<script>", "\\u0000", "\\uD800",
       "\t", "a" * 5000, "\u00a0", "-", ".", "]"]
NUMBER = re.compile(r"(?<![\w\".])[-+]?\d[\d_]*(?:\.\d+)?(?:[eE][-+]?\d+)?(?![\w\"])")
VALUE = re.compile(r"^(\s*[\w.\"'-]+\s*=\s*)(.*)$")
STRING = re.compile(r"\"[^\"\n]*\"|'[^'\n]*'")


def lines_with(pattern, lines):
    return [i for i, line in enumerate(lines) if pattern.search(line)]


class Damage:
    """The ways to damage a text; each takes the random numbers and the lines, and changes the lines."""

    def __init__(self, pool):
        self.pool = pool  # lines of all studies by their key
        self.values = [value for lines in pool.values() for value in lines]

    def number(self, rng, lines):
        found = lines_with(NUMBER, lines)
        if not found:
            return
        i = rng.choice(found)
        spot = rng.choice(list(NUMBER.finditer(lines[i])))
        how = rng.random()
        if how < 0.6:
            new = rng.choice(NUMBERS)
        elif how < 0.75:
            others = [m.group() for line in lines for m in NUMBER.finditer(line)]
            new = rng.choice(others)
        else:
            try:
                value = float(spot.group().replace("_", ""))
            except ValueError:
                return
            new = repr(rng.choice([-value, value * 1e3, value * 1e-3, value + 1, value * (1 + 1e-12), value * 1e6, value / 2]))
        lines[i] = lines[i][:spot.start()] + new + lines[i][spot.end():]

    def near_number(self, rng, lines):
        """Numbers that the reading lets through more often: what is then computed must end well, too."""
        found = lines_with(NUMBER, lines)
        if not found:
            return
        i = rng.choice(found)
        spot = rng.choice(list(NUMBER.finditer(lines[i])))
        old = spot.group().replace("_", "")
        others = [m.group() for m in NUMBER.finditer(lines[i])]
        if re.fullmatch(r"[-+]?\d+", old):
            value = int(old)
            new = str(rng.choice([value + 1, max(value - 1, 0), 2 * value, value // 2, 0, 1, -value, 10 * value]))
        else:
            value = float(old)
            new = repr(rng.choice([value / 2, 2 * value, value * 1.01, -value, 0.0, 10 * value, value / 10, 1e-6 * value, 1e4 * value]))
        lines[i] = lines[i][:spot.start()] + (rng.choice(others) if rng.random() < 0.1 else new) + lines[i][spot.end():]

    def large_number(self, rng, lines):
        found = lines_with(NUMBER, lines)
        if not found:
            return
        i = rng.choice(found)
        spot = rng.choice(list(NUMBER.finditer(lines[i])))
        old, factor = spot.group().replace("_", ""), 10 ** rng.randint(3, 9)
        new = str(int(old) * factor) if re.fullmatch(r"[-+]?\d+", old) else repr(float(old) * factor)
        lines[i] = lines[i][:spot.start()] + new + lines[i][spot.end():]

    def other_word(self, rng, lines):
        """A text in the place of one that stands at the same key of some study; true for false."""
        found = [i for i in lines_with(VALUE, lines) if re.search(r"[\"']|true|false", VALUE.match(lines[i])[2])]
        if not found:
            return
        i = rng.choice(found)
        head, value = VALUE.match(lines[i]).groups()
        if value.startswith(("true", "false")):
            lines[i] = head + ("false" if value.startswith("true") else "true")
        else:
            lines[i] = head + rng.choice(self.pool.get(head.split("=")[0].strip(), [value]))

    def wrong_type(self, rng, lines):
        found = lines_with(VALUE, lines)
        if found:
            i = rng.choice(found)
            lines[i] = VALUE.match(lines[i])[1] + rng.choice(OTHER + NUMBERS[:4])

    def delete_line(self, rng, lines):
        if lines:
            del lines[rng.randrange(len(lines))]

    def double_line(self, rng, lines):
        if lines:
            i = rng.randrange(len(lines))
            lines.insert(rng.randrange(len(lines) + 1), lines[i])

    def swap_lines(self, rng, lines):
        if len(lines) > 1:
            i, j = rng.sample(range(len(lines)), 2)
            lines[i], lines[j] = lines[j], lines[i]

    def swap_keys(self, rng, lines):
        found = lines_with(VALUE, lines)
        if len(found) > 1:
            i, j = rng.sample(found, 2)
            a, b = VALUE.match(lines[i]), VALUE.match(lines[j])
            lines[i], lines[j] = b[1] + a[2], a[1] + b[2]

    def value_of_another(self, rng, lines):
        found = [i for i in lines_with(VALUE, lines) if VALUE.match(lines[i])[1].split("=")[0].strip() in self.pool]
        if found:
            i = rng.choice(found)
            head = VALUE.match(lines[i])[1]
            lines[i] = head + rng.choice(self.pool[head.split("=")[0].strip()])

    def line_of_another(self, rng, lines):
        key = rng.choice(sorted(self.pool))
        lines.insert(rng.randrange(len(lines) + 1), f"{key} = {rng.choice(self.pool[key])}")

    def block(self, rng, lines):
        """Deletes, doubles or multiplies a table with its header."""
        heads = [i for i, line in enumerate(lines) if line.startswith("[")]
        if not heads:
            return
        k = rng.randrange(len(heads))
        begin, end = heads[k], heads[k + 1] if k + 1 < len(heads) else len(lines)
        block = lines[begin:end]
        how = rng.random()
        if how < 0.4:
            del lines[begin:end]
        elif how < 0.8:
            at = rng.choice(heads + [len(lines)])
            lines[at:at] = block
        else:
            lines[end:end] = block * rng.choice([3, 40, 400])

    def nesting(self, rng, lines):
        found = lines_with(VALUE, lines)
        if not found:
            return
        i = rng.choice(found)
        head, value = VALUE.match(lines[i]).groups()
        depth = rng.choice([2, 30, 300, 30000])
        lines[i] = head + rng.choice(["[" * depth + value + "]" * depth, "{ a = " * depth + value + " }" * depth, "[" * depth])

    def long_list(self, rng, lines):
        found = lines_with(VALUE, lines)
        if found:
            i = rng.choice(found)
            head, value = VALUE.match(lines[i]).groups()
            lines[i] = head + "[" + ", ".join([value] * rng.choice([2, 50, 5000])) + "]"

    def text(self, rng, lines):
        found = lines_with(STRING, lines)
        if not found:
            return
        i = rng.choice(found)
        spot = rng.choice(list(STRING.finditer(lines[i])))
        quote = spot.group()[0]
        inner = spot.group()[1:-1]
        strings = [m.group()[1:-1] for line in lines for m in STRING.finditer(line)]
        at = rng.randrange(len(inner) + 1)
        new = rng.choice(["", inner[:at] + rng.choice(ODD) + inner[at:], inner * 2, rng.choice(strings), rng.choice(strings),
                          "x" * 100_000, inner.upper(), inner[:-1]])
        lines[i] = lines[i][:spot.start()] + quote + new + quote + lines[i][spot.end():]

    def truncate(self, rng, lines):
        if lines:
            at = rng.randrange(len(lines))
            lines[at] = lines[at][:rng.randrange(len(lines[at]) + 1)]
            del lines[at + 1:]


def flip_bytes(rng, data):
    data = bytearray(data)
    for _ in range(rng.choice([1, 1, 2, 8])):
        if not data:
            break
        i = rng.randrange(len(data))
        how = rng.randrange(3)
        if how == 0:
            data[i] ^= 1 << rng.randrange(8)
        elif how == 1:
            del data[i]
        else:
            data.insert(i, rng.randrange(256))
    return bytes(data)


# Numbers reach deepest, so that they come most often.
WEIGHTS = {"number": 10, "near_number": 5, "other_word": 2, "wrong_type": 3, "delete_line": 4, "double_line": 1, "swap_lines": 1, "swap_keys": 4,
           "value_of_another": 5, "line_of_another": 2, "block": 5, "nesting": 1, "long_list": 1, "text": 4, "truncate": 1,
           "bytes": 2}
LARGE = {"large_number": 1}
GENTLE = {"near_number": 12, "other_word": 3, "delete_line": 2, "block": 1, "value_of_another": 1}


def read_corpus(program):
    """Name -> (text, folder of the files beside it)."""
    corpus = {}
    for folder in ("studies", "robots", "suspension"):
        for path in sorted((ROOT / "examples" / folder).glob("*.toml")):
            corpus[str(path.relative_to(ROOT))] = (path.read_bytes(), path.parent)
    kinds = subprocess.run([program, "catalogue", "--json"], capture_output=True, text=True, check=True).stdout
    for kind in [one["name"] for one in json.loads(kinds)]:
        text = subprocess.run([program, "new", kind, "-"], capture_output=True, check=True).stdout
        corpus[f"template {kind}"] = (text, None)
    return corpus


def pool_of(corpus):
    pool = {}
    for name in sorted(corpus):
        for line in corpus[name][0].decode().splitlines():
            if match := VALUE.match(line):
                pool.setdefault(match[1].split("=")[0].strip(), []).append(match[2])
    return pool


class Case:
    def __init__(self, seed, number, corpus, names, damage, large=False):
        self.seed, self.number = seed, number
        rng = random.Random(f"{seed} {number}")
        self.name = rng.choice(names)
        self.text, self.folder = corpus[self.name]
        self.damage = damage
        weights = GENTLE if rng.random() < 0.5 else WEIGHTS
        kinds = rng.choices(list(weights), list(weights.values()), k=rng.choice([1, 1, 2, 3, 4]))
        if large:
            kinds = rng.choices(list(LARGE), k=rng.choice([1, 1, 2]))
        self.steps = [(kind, rng.randrange(1 << 30)) for kind in kinds]
        # Now and then the table beside the study is damaged, too.
        self.beside = rng.random() < 0.5

    def files(self):
        """Files that the study names, beside it."""
        if self.folder is None:
            return []
        words = set(re.findall(r"[\w.-]+\.(?:csv|txt|dat)", self.text.decode()))
        return [self.folder / w for w in sorted(words) if (self.folder / w).is_file()]

    def write(self, folder, steps):
        data = self.text
        tables = {path.name: path.read_bytes() for path in self.files()}
        for kind, seed in steps:
            rng = random.Random(seed)
            table = rng.choice(sorted(tables)) if tables and self.beside else None
            source = tables[table] if table else data
            if kind == "bytes":
                new = flip_bytes(rng, source)
            else:
                lines = source.decode("utf-8", "replace").split("\n")
                getattr(self.damage, kind)(rng, lines)
                new = "\n".join(lines).encode("utf-8", "replace")
            if table:
                tables[table] = new
            else:
                data = new
        for name, content in tables.items():
            (folder / name).write_bytes(content)
        (folder / "study.toml").write_bytes(data)
        return data

    def difference(self, data):
        old = self.text.decode("utf-8", "replace").split("\n")
        new = data.decode("utf-8", "replace").split("\n")
        shown = [line if len(line) < 160 else line[:150] + f"... ({len(line)} characters)"
                 for line in difflib.unified_diff(old, new, lineterm="", n=0)][2:]
        return "\n".join("      " + line for line in shown[:24] + (["..."] if len(shown) > 24 else []))


def attempt(program, folder, options):
    """Runs the study of the folder: what is wrong with how it ended, or None, and its exit code."""

    def limits():
        resource.setrlimit(resource.RLIMIT_CPU, (options.cpu, options.cpu + 5))
        resource.setrlimit(resource.RLIMIT_FSIZE, (1 << 29, 1 << 29))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        if options.memory:
            resource.setrlimit(resource.RLIMIT_AS, (options.memory << 20, options.memory << 20))

    command = [program, "run", "study.toml", "--out", "out", "--threads", "1", "--time-limit", str(options.time_limit)]
    with open(folder / "stdout", "wb") as out, open(folder / "stderr", "wb") as err:
        process = subprocess.Popen(command, cwd=folder, stdin=subprocess.DEVNULL, stdout=out, stderr=err, preexec_fn=limits)
        try:
            code = process.wait(timeout=WALL * options.cpu)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()
            return f"neither ends nor works, after {WALL * options.cpu} s", None
    return fault_in(code, folder, options), code


def fault_in(code, folder, options):
    complaint = (folder / "stderr").read_text("utf-8", "replace")
    last = complaint.strip().splitlines()[-2:]
    if code in (-signal.SIGXCPU, -signal.SIGKILL):
        return f"takes more than {options.cpu} s of processor time"
    if code < 0:
        return f"dies of {signal.Signals(-code).name}: {' / '.join(last)}"
    if SANITIZERS.search(complaint):
        return f"a sanitizer complains: {' / '.join(line for line in complaint.splitlines() if SANITIZERS.search(line))[:400]}"
    if code not in GOOD_CODES:
        return f"exit code {code}: {' / '.join(last)[:400]}"
    if code == 2 and not complaint.strip():
        return "exit code 2 without a message"
    record = folder / "out" / "result.json"
    if code in (0, 1):
        try:
            json.loads(record.read_text("utf-8"))
        except (OSError, ValueError) as error:
            return f"exit code {code}, but result.json: {error}"
    return None


def fault_of(case, options, steps=None):
    with tempfile.TemporaryDirectory(prefix="mutated-") as name:
        folder = Path(name)
        data = case.write(folder, case.steps if steps is None else steps)
        fault, code = attempt(options.program, folder, options)
        if options.keep:
            target = Path(options.keep) / f"{case.seed}-{case.number}"
            if fault or options.case is not None:
                shutil.rmtree(target, ignore_errors=True)
                shutil.copytree(folder, target)
        return fault, data, code


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program")
    parser.add_argument("--cases", type=int, default=200)
    parser.add_argument("--first", type=int, default=0, help="number of the first case")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--case", type=int, help="this one alone")
    parser.add_argument("--keep", help="folder for the files of cases that broke a rule")
    parser.add_argument("--shrink", action="store_true")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--memory", type=int, default=2048, help="MB of address space, 0 = any (for sanitizers)")
    parser.add_argument("--cpu", type=int, default=30, help="s of processor time that a case may take")
    parser.add_argument("--time-limit", type=float, default=0.5, help="s, given to the program")
    parser.add_argument("--large", action="store_true", help="multiply numbers alone")
    options = parser.parse_args()
    options.program = str(Path(options.program).resolve())
    corpus = read_corpus(options.program)
    if not corpus:
        print("there are no studies to damage", file=sys.stderr)
        return 2
    damage = Damage(pool_of(corpus))
    names = sorted(corpus)
    numbers = [options.case] if options.case is not None else range(options.first, options.first + options.cases)
    faults = 0
    codes = collections.Counter()

    def judge(number):
        case = Case(options.seed, number, corpus, names, damage, options.large)
        fault, data, code = fault_of(case, options)
        steps = case.steps
        if fault and options.shrink:
            for step in list(steps):
                fewer = [s for s in steps if s is not step]
                again, smaller, _ = fault_of(case, options, fewer)
                if again:
                    steps, fault, data = fewer, again, smaller
        return case, fault, steps, data, code

    with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
        for done, (case, fault, steps, data, code) in enumerate(pool.map(judge, numbers), 1):
            codes[code] += 1
            if fault:
                faults += 1
                print(f"seed {case.seed}, case {case.number}: {fault}\n   {case.name} with {', '.join(k for k, _ in steps)}\n"
                      f"{case.difference(data)}", flush=True)
            if done % 500 == 0:
                print(f"{done} cases, {faults} broke a rule", flush=True)
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    ends = ", ".join(f"{count} with {code}" for code, count in sorted(codes.items(), key=str))
    print(f"{len(numbers)} damaged studies, seed {options.seed}: {faults} broke a rule; they ended {ends}; "
          f"{used.ru_utime + used.ru_stime:.0f} s of processor time, the largest took {used.ru_maxrss // 1024} MB")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
