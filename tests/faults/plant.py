"""Plants the faults of faults.txt one at a time and tells which of them the tests near them do not see.

python3 tests/faults/plant.py [word...]     those whose names or headers have one of the words; else all
    --check         only: does every entry still apply to the sources?
    --compiler g++  --flags '-O0 ...'  --jobs 1  --folder build/faults

A fault changes one header, which is put before the others on the compiler's path; the sources stay as they are. Only the
test files that an entry names are compiled, each as a program of its own, and only until one of them fails. Without the
fault they must pass: that is tried first, and remembered in the folder for as long as no header and no test changes.
"""
import argparse
import concurrent.futures
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
HEADERS = ROOT / "include" / "tamis"
TESTS = ROOT / "tests"
SECONDS = 600  # a test that takes longer hangs
MOST_SURVIVORS = 0.1


class Wrong(Exception):
    """An entry, or the way it was used, makes no sense."""


class Fault:
    def __init__(self, name, header, tests):
        self.name, self.header = name, header
        self.tests = [word for word in tests if not word.startswith("-")]
        self.flags = [word for word in tests if word.startswith("-")]
        self.after, self.old, self.new = [], [], []

    def planted(self):
        """The header's text with the fault in it. Raises Wrong if it does not apply."""
        path = HEADERS / self.header
        if not path.is_file():
            raise Wrong(f"{self.name}: there is no header {self.header}")
        if not self.old or self.old == self.new:
            raise Wrong(f"{self.name}: it changes nothing; give a line '- old' and a line '+ new'")
        for test in self.tests:
            if not self.source(test).is_file():
                raise Wrong(f"{self.name}: there is no test tests/{test}_test.cpp")
        text, begin = path.read_text(), 0
        for anchor in self.after:
            begin = text.find(anchor, begin)
            if begin < 0:
                raise Wrong(f"{self.name}: {self.header} has no longer the text\n    {anchor}")
        old, new = "\n".join(self.old), "\n".join(self.new)
        count = text.count(old, begin)
        if count == 0:
            raise Wrong(f"{self.name}: {self.header} has no longer the text\n    {old}")
        if count > 1 and not self.after:
            raise Wrong(f"{self.name}: {self.header} has {count} times the text\n    {old}\n  name a line before it: '> ...'")
        place = text.index(old, begin)
        return text[:place] + new + text[place + len(old):]

    @staticmethod
    def source(test):
        return TESTS / (test + "_test.cpp")


def read_faults(path):
    faults = []
    for number, line in enumerate(path.read_text().splitlines(), 1):
        head = re.fullmatch(r"\[(\w+)\] (\S+) : (\S.*)", line)
        if head:
            faults.append(Fault(head[1], head[2], head[3].split()))
        elif line[:2] in ("> ", "- ", "+ ") and faults:
            {">": faults[-1].after, "-": faults[-1].old, "+": faults[-1].new}[line[0]].append(line[2:])
        elif line == "+" and faults:
            faults[-1].new.append("")
        elif line and not line.startswith("#"):
            raise Wrong(f"{path.name}, line {number}: it is none of '[name] header : tests', '> ', '- ', '+ ', '# '")
    names = [fault.name for fault in faults]
    for name in set(names):
        if names.count(name) > 1:
            raise Wrong(f"two faults are called {name}")
    return faults


def check(faults):
    wrong = []
    for fault in faults:
        try:
            fault.planted()
        except Wrong as error:
            wrong.append(str(error))
    return wrong


class Bench:
    """Where test files are compiled and run."""

    def __init__(self, options):
        self.folder = pathlib.Path(options.folder).resolve()
        self.folder.mkdir(parents=True, exist_ok=True)
        self.compiler = options.compiler
        eigen = next((d for d in ("/usr/include/eigen3", "/usr/local/include/eigen3") if os.path.isdir(d)), None)
        self.flags = ["-std=c++20", "-UNDEBUG", "-w", *options.flags.split()]
        self.paths = [f"-I{d}" for d in (ROOT / "include", TESTS, TESTS / "support", ROOT / "examples" / "support")]
        if eigen:
            self.paths += ["-isystem", eigen]
        self.files = {}
        self.prepare()

    def run(self, command, **more):
        return subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", **more)

    def prepare(self):
        """What all programs have in common: the main function, and the headers of other libraries."""
        common = "".join(f"#include {h}\n" for h in ("<tamis/core/config.hpp>", "<Eigen/Dense>", '"catch.hpp"'))
        key = hashlib.sha256(repr((self.compiler, self.flags, self.paths, common)).encode())
        key.update((HEADERS / "core" / "config.hpp").read_bytes())
        self.common = self.folder / key.hexdigest()[:12]
        self.common.mkdir(exist_ok=True)
        head = self.common / "common.hpp"
        if not (self.common / "done").exists():
            head.write_text(common)
            for command in (["-x", "c++-header", str(head), "-o", f"{head}.gch"],
                            ["-O0", "-c", str(TESTS / "support" / "main.cpp"), "-o", str(self.common / "main.o")]):
                done = self.run([self.compiler, *self.flags, *self.paths, *command])
                if done.returncode:
                    raise Wrong(f"the tests' main function does not compile:\n{done.stdout}")
            (self.common / "done").touch()

    def key_of(self, test, flags):
        """Of all that a test is made of, roughly: all headers and itself."""
        if not self.files:
            for where, kinds in ((HEADERS, "*.hpp"), (TESTS, "*.hpp"), (ROOT / "examples" / "support", "*.hpp")):
                for path in sorted(where.rglob(kinds)):
                    self.files[str(path)] = path.read_bytes()
        key = hashlib.sha256(repr((self.common.name, flags)).encode())
        for path, text in self.files.items():
            key.update(path.encode() + text)
        key.update(Fault.source(test).read_bytes())
        return key.hexdigest()[:20]

    def passes(self, test, flags, fault=None):
        """Compiles a test file and runs it: does it pass, how long did it take, and what did it say?"""
        place = self.folder / (fault.name if fault else test.replace("/", "+"))
        place.mkdir(exist_ok=True)
        paths = list(self.paths)
        if fault:
            changed = place / "tamis" / fault.header
            changed.parent.mkdir(parents=True, exist_ok=True)
            changed.write_text(fault.planted())
            paths.insert(0, f"-I{place}")
        begin = time.time()
        program = place / "program"
        made = self.run([self.compiler, *self.flags, *flags, "-include", str(self.common / "common.hpp"), *paths,
                         str(Fault.source(test)), str(self.common / "main.o"), "-o", str(program)])
        if made.returncode:
            first = next((line for line in made.stdout.splitlines() if " error: " in line), made.stdout[-2000:])
            raise Wrong(f"{fault.name if fault else 'without a fault'}: {test} does not compile\n    {first}")
        try:
            done = self.run([str(program)], cwd=place, timeout=SECONDS)
            said, good = done.stdout, done.returncode == 0
        except subprocess.TimeoutExpired:
            said, good = f"it hangs: more than {SECONDS} s", False
        (place / "said.txt").write_text(said)
        program.unlink()
        return good, time.time() - begin, said

    def check_without_fault(self, test_and_flags):
        test, flags = test_and_flags
        known = self.folder / "passed"
        known.mkdir(exist_ok=True)
        mark = known / self.key_of(test, flags)
        if mark.exists():
            return
        good, seconds, said = self.passes(test, flags)
        if not good:
            raise Wrong(f"{test} fails without any fault:\n{said[-2000:]}")
        mark.touch()
        print(f"passes    {test} without a fault ({seconds:.0f} s)", flush=True)

    def try_fault(self, fault):
        """The test that sees the fault, or none."""
        total = 0
        for test in fault.tests:
            good, seconds, _ = self.passes(test, fault.flags, fault)
            total += seconds
            if not good:
                return test, total
        return None, total


def main():
    options = argparse.ArgumentParser(description="Plants faults, and tells which of them the tests do not see.")
    options.add_argument("words", nargs="*")
    options.add_argument("--check", action="store_true")
    options.add_argument("--compiler", default=os.environ.get("CXX", "g++"))
    options.add_argument("--flags", default="-O0 -march=native -fopenmp")
    options.add_argument("--jobs", type=int, default=1)
    options.add_argument("--folder", default=str(ROOT / "build" / "faults"))
    options = options.parse_args()

    faults = read_faults(pathlib.Path(__file__).with_name("faults.txt"))
    wrong = check(faults)
    if wrong:
        raise Wrong("\n".join(wrong) + f"\n{len(wrong)} of {len(faults)} faults no longer apply; change or remove them")
    if options.check:
        print(f"{len(faults)} faults apply")
        return 0
    if options.words:
        faults = [f for f in faults if any(word in f.name or word in f.header for word in options.words)]
    if not faults:
        raise Wrong("no fault has such a name")

    bench = Bench(options)
    survivors, errors = [], []

    def each(what, f):
        with concurrent.futures.ThreadPoolExecutor(options.jobs) as pool:
            for future in [pool.submit(f, one) for one in what]:
                try:
                    future.result()
                except Wrong as error:
                    errors.append(str(error))
                    print(f"ERROR     {error}", flush=True)

    def one_fault(fault):
        seen_by, seconds = bench.try_fault(fault)
        if seen_by:
            print(f"killed    {fault.name} by {seen_by} ({seconds:.0f} s)", flush=True)
        else:
            survivors.append(fault.name)
            print(f"SURVIVES  {fault.name}, {fault.header}: {' '.join(fault.tests)} ({seconds:.0f} s)", flush=True)

    each(sorted({(test, tuple(fault.flags)) for fault in faults for test in fault.tests}), bench.check_without_fault)
    if errors:
        return 1
    each(faults, one_fault)
    killed = len(faults) - len(survivors) - len(errors)
    print(f"{killed} of {len(faults)} faults are seen, {len(survivors)} survive ({100 * len(survivors) / len(faults):.0f} %): "
          + (", ".join(survivors) or "none"))
    return 1 if errors or len(survivors) > MOST_SURVIVORS * len(faults) else 0


try:
    sys.exit(main())
except Wrong as wrong:
    sys.exit(f"faults: {wrong}")
