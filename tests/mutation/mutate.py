"""Small mutations of the physics and the analyses: which of them does the fast suite notice?

    python3 tests/mutation/mutate.py --count 200 --seed 1            # draws, and goes on where an earlier start of it stopped
    python3 tests/mutation/mutate.py --count 200 --seed 1 --list     # what would be tried
    python3 tests/mutation/mutate.py --only lib/boresight/contact/flores.hpp   # of these files alone
    python3 tests/mutation/mutate.py --like FILE                     # those of an earlier draw's results, found again by their lines
    python3 tests/mutation/mutate.py --report                        # share killed and the survivors, of what has been tried

README.md says how it goes about it.
"""

import argparse
import json
import os
import pathlib
import random
import re
import shutil
import signal
import subprocess
import sys
import time

ROOT = pathlib.Path(__file__).resolve().parents[2]
CORE = "lib/boresight/"
ROOMS = tuple(CORE + room for room in ("contact", "contact_events", "formulations", "rungs", "stepping", "scene", "multibody", "perturbation", "statics",
                                    "ladder")) + ("analyses",)

# Without NDEBUG and with the library's assertions: a loop that reads beyond an end is then noticed, whatever lies there.
FLAGS = "-O1 -D_GLIBCXX_ASSERTIONS"

# Operators as the formatter leaves them, with a blank on either side, so that neither pointers nor templates are met.
SWAPS = {"+": "-", "-": "+", "*": "/", "/": "*", "<": "<=", "<=": "<", ">": ">=", ">=": ">", "==": "!=", "!=": "==", "&&": "||",
         "||": "&&", "+=": "-=", "-=": "+=", "*=": "/="}
OPERATOR = re.compile(r"(?<=[\w)\]]) (\+=|-=|\*=|<=|>=|==|!=|&&|\|\||[-+*/<>]) (?=[\w(\-!*&])")
SIGN = re.compile(r"(?:(?<=[(,{] )|(?<=[({])|(?<== )|(?<=return )|(?<=\? )|(?<=: ))-(?=[A-Za-z(])")
NUMBER = re.compile(r"(?<![\w.\"'])(\d+\.\d*(?:e[-+]?\d+)?|\.\d+|\d+e[-+]?\d+|\d+)(?![\w.])")
# Lines whose mutation changes no answer (words for people and the room for them, room set aside, what the compiler checks) or is no part
# of what runs.
SKIPPED = re.compile(r"^\s*#|static_assert|\bchar \w+\[\d+\]|\breserve\(|fmt::|\.push_back\(\"|throw |std::string\b.*=|EXPECT|assert\(|^\s*(using|template|enum|case)\b"
                     r"|progress|_why|\bwhy\b|warnings|message|precision\(|operator")


def blanked(text):
    """The source with comments and what is quoted made blank, character for character."""
    out, i, n = list(text), 0, len(text)
    while i < n:
        if text.startswith("//", i):
            end = text.find("\n", i)
        elif text.startswith("/*", i):
            end = text.find("*/", i) + 2
        elif text.startswith('R"(', i):
            end = text.find(')"', i) + 2
        elif text[i] in "\"'" and not (text[i] == "'" and i and text[i - 1].isalnum()):
            end = i + 1
            while end < n and text[end] != text[i]:
                end += 2 if text[end] == "\\" else 1
            end += 1
        else:
            i += 1
            continue
        end = n if end <= 0 else end
        out[i:end] = [c if c == "\n" else " " for c in text[i:end]]
        i = end
    return "".join(out)


def other_number(text):
    """Another number for a constant: whole ones by one, others doubled; 0.0 becomes 1.0."""
    if text.isdigit():
        return str(int(text) + 1)
    return "1.0" if float(text) == 0.0 else repr(2.0 * float(text))


def places(path):
    """Every mutation of one file: (line, column, before, after)."""
    text = (ROOT / path).read_text()
    lines = blanked(text).split("\n")
    found, depth = [], 0
    for number, line in enumerate(lines, 1):
        if SKIPPED.search(text.split("\n")[number - 1]):
            continue
        for match in OPERATOR.finditer(line):
            found.append((number, match.start(1), match.group(1), SWAPS[match.group(1)]))
        for match in SIGN.finditer(line):
            found.append((number, match.start(), "-", ""))
        for match in NUMBER.finditer(line):
            found.append((number, match.start(1), match.group(1), other_number(match.group(1))))
    return found


def found_again(records):
    """The mutations of an earlier draw where their lines stand now; those whose lines are gone are named and left out."""
    found = []
    for r in records:
        path = ROOT / r["file"]
        lines = path.read_text().split("\n") if path.is_file() else []
        same = [n for n, line in enumerate(lines, 1) if line.strip() == r["text"]]
        if not same or SKIPPED.search(r["text"]):
            print(f"{r['file']}:{r['line']}: {'no such line any more' if not same else 'left alone now'}: {r['text']}", file=sys.stderr)
            continue
        here = min(same, key=lambda n: abs(n - r["line"]))
        columns = [c for n, c, before, _ in places(r["file"]) if n == here and before == r["before"]]
        found.append((r["file"], here, min(columns, key=lambda c: abs(c - r["column"])), r["before"], r["after"]))
    return found


def drawn(options):
    """The mutations in the order in which they are tried: file, line, column, before, after."""
    if options.like:
        found = found_again([json.loads(line) for line in options.like.read_text().splitlines()])
        return found, len(found)
    files = [str(p.relative_to(ROOT)) for room in ROOMS for p in sorted((ROOT / room).rglob("*.[ch]pp"))]
    if options.only:
        unknown = [f for f in options.only if f not in files]
        if unknown:
            sys.exit(f"--only {unknown[0]}: found no such source below {', '.join(ROOMS)}")
        files = options.only
    every = [(f, *place) for f in files for place in places(f)]
    random.Random(options.seed).shuffle(every)
    return every[: options.count], len(every)


def key(mutation):
    """What makes a mutation the same one in another start: the line's own text beside its place, so that an edited file is tried anew."""
    f, line, column, before, after = mutation
    return {"file": f, "line": line, "column": column, "before": before, "after": after,
            "text": (ROOT / f).read_text().split("\n")[line - 1].strip()}


class Scratch:
    """A copy of the tree with a build folder of its own."""

    def __init__(self, folder, jobs, cmake_arguments):
        self.folder, self.jobs = pathlib.Path(folder), jobs
        self.build = self.folder / "build" / "mutation"
        self.cmake_arguments = cmake_arguments

    def prepare(self, leave=()):
        """Copies what has changed, but for files that are to be written by the caller and are there."""
        self.folder.mkdir(parents=True, exist_ok=True)
        tracked = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=ROOT, capture_output=True,
                                 text=True, check=True).stdout.split("\0")
        wanted = {name for name in tracked if name and (ROOT / name).is_file()}
        for name in wanted:
            source, target = ROOT / name, self.folder / name
            if target.exists() and (name in leave or target.read_bytes() == source.read_bytes()):
                continue
            target.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(source, target)
        if not (self.build / "build.ninja").exists():
            call = ["cmake", "-S", str(self.folder), "-B", str(self.build), "-G", "Ninja", *self.cmake_arguments]
            subprocess.run(call, check=True, stdout=subprocess.DEVNULL)

    def ninja(self, targets, seconds):
        """None where it built, else the end of what was said; raises TimeoutExpired."""
        done = run(["ninja", "-C", str(self.build), f"-j{self.jobs}", *targets], seconds)
        return None if done.returncode == 0 else done.stdout[-2000:]

    def stale(self, target):
        """Would a build change this program?"""
        said = run(["ninja", "-C", str(self.build), "-n", target], 120).stdout
        return "no work to do" not in said

    def binary(self, target):
        return self.build / "bin" / target


def run(command, seconds, cwd=None):
    """As subprocess.run, its whole group ended when the time is over."""
    child = subprocess.Popen(command, cwd=cwd, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace", start_new_session=True)
    try:
        out, _ = child.communicate(timeout=seconds)
    except subprocess.TimeoutExpired:
        os.killpg(child.pid, signal.SIGKILL)
        child.communicate()
        raise
    except BaseException:
        os.killpg(child.pid, signal.SIGKILL)
        raise
    return subprocess.CompletedProcess(command, child.returncode, out, None)


# The programs of the fast suite, nearest first: by room, then those that everything ends in.
def test_programs(*folders):
    """What boresight_test() makes of these folders below tests/, so that no room's tests are forgotten here."""
    found = []
    for folder in folders:
        for file in sorted((ROOT / "tests" / folder).rglob("CMakeLists.txt")):
            found += re.findall(r"^\s*boresight_test\((\w+)", file.read_text(), re.MULTILINE)
    return tuple(found)


LIBRARY = test_programs("lib")
ANALYSES = test_programs("analyses", "threads")
PROGRAMS = test_programs("apps/boresight")
CALL_THE_PROGRAM = set(PROGRAMS)


def own_program(path):
    """The test program of a file's room; of rooms without one, that of all rungs."""
    own = pathlib.PurePath(path).parts[2] + "_tests"
    return own if own in LIBRARY + ANALYSES else "ladder_tests"


def programs_for(path, known):
    """Test programs in the order in which a mutation of this file meets them."""
    own = own_program(path)
    order = [own] + [p for p in (*LIBRARY, *ANALYSES, *PROGRAMS) if p != own]
    if path.startswith("analyses/"):
        order = [own] + [p for p in (*ANALYSES, *PROGRAMS) if p != own]
    return [p for p in order if p in known]


def tests_of(scratch, program, allowed, left_out):
    """None where all pass, else the first that fails; the time taken."""
    command = [str(scratch.binary(program)), "--gtest_brief=1", "--gtest_fail_fast", "--gtest_filter=-*Long*:*LongRun*" + "".join(":" + t for t in left_out)]
    start = time.monotonic()
    try:
        done = run(command, allowed)
    except subprocess.TimeoutExpired:
        return "timed out", time.monotonic() - start
    if done.returncode == 0:
        return None, time.monotonic() - start
    failed = re.findall(r"\[  FAILED  \] ([\w./]+)", done.stdout)
    return (failed[0] if failed else f"ended with {done.returncode}"), time.monotonic() - start


def baseline(scratch, wanted, file):
    """Builds the tree as it is, runs every program once: its time, and the tests that fail already, which are left out."""
    known = json.loads(file.read_text()) if file.exists() else {}
    for program in wanted:
        fault = scratch.ninja([program], 7200)
        if fault:
            print(f"{program} does not build here and is left out:\n{fault}", file=sys.stderr)
            continue
        if program in known:
            continue
        failing, seconds = [], 0.0
        while True:
            failed, seconds = tests_of(scratch, program, 1800, failing)
            if failed is None or len(failing) > 20:
                break
            print(f"{program}: {failed} fails without a mutation, and is left out", file=sys.stderr)
            failing.append(failed)
        known[program] = {"seconds": seconds, "left_out": failing}
        file.write_text(json.dumps(known, indent=1))
        print(f"{program}: {seconds:.0f} s", file=sys.stderr)
    return known


def tried(scratch, mutation, known, options):
    """Applies one, builds and tests until something fails; the tree is as before afterwards."""
    f, line, column, before, after = mutation
    source, target = ROOT / f, scratch.folder / f
    original = source.read_text()
    lines = original.split("\n")
    text = lines[line - 1]
    assert text[column : column + len(before)] == before, (f, line, text)
    lines[line - 1] = text[:column] + after + text[column + len(before) :]
    start = time.monotonic()
    left = lambda: max(1.0, options.most_seconds - (time.monotonic() - start))
    verdict = {"verdict": "survived", "by": None, "not_run": []}
    try:
        target.write_text("\n".join(lines))
        ran = 0
        for program in programs_for(f, known):
            if program in CALL_THE_PROGRAM:
                stale = scratch.stale("boresight") or program in verdict["not_run"] or verdict.get("program_changed", False)
                verdict["program_changed"] = stale
            else:
                stale = scratch.stale(program)
            if not stale:
                continue  # the same program as before: it would pass again
            if time.monotonic() - start > options.most_seconds:
                verdict["not_run"].append(program)
                continue
            try:
                fault = scratch.ninja([program], left() + 300)
            except subprocess.TimeoutExpired:
                verdict["not_run"].append(program)
                continue
            if fault:
                verdict.update(verdict="does not compile", by=program, said=fault[-300:])
                break
            allowed = 20.0 + 5.0 * known[program]["seconds"]
            failed, _ = tests_of(scratch, program, allowed, known[program]["left_out"])
            ran += 1
            if failed == "timed out":
                verdict.update(verdict="timed out", by=program)
                break
            if failed:
                verdict.update(verdict="killed", by=f"{program}: {failed}")
                break
        if ran == 0 and verdict["verdict"] == "survived":
            verdict["verdict"] = "changes nothing"
    finally:
        target.write_text(original)
        # Older objects than the restored file are rebuilt: what was built of the mutation is not taken for the original.
    verdict.pop("program_changed", None)
    verdict["seconds"] = round(time.monotonic() - start, 1)
    return verdict


def unfinished(record):
    """What a survivor was spared, in words."""
    left = record.get("not_run")
    if record.get("by"):
        return f"   ({record['by']})"
    if isinstance(left, list):
        return f"   (for want of time not run: {', '.join(left)})" if left else ""
    return f"   ({record['ran']} tests ran, {left} did not for want of time)"


def report(records):
    counts = {}
    for r in records:
        counts[r["verdict"]] = counts.get(r["verdict"], 0) + 1
    noticed, passed = counts.get("killed", 0) + counts.get("timed out", 0), counts.get("survived", 0)
    print(", ".join(f"{counts[v]} {v}" for v in sorted(counts)) or "nothing tried yet")
    if noticed + passed:
        print(f"{noticed} of {noticed + passed} that compile and change a program were noticed: {100.0 * noticed / (noticed + passed):.1f} %")
    for r in records:
        if r["verdict"] == "survived":
            print(f"survived  {r['file']}:{r['line']}: {r['before']!r} -> {r['after']!r}   {r['text']}{unfinished(r)}")


def arguments_of_both(parser):
    """What mutate.py and together.py are both asked for."""
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", action="append", default=[], metavar="FILE", help="mutate this file alone; may be given again")
    parser.add_argument("--like", type=pathlib.Path, metavar="FILE", help="in place of a draw those of these results, found again by their lines")
    parser.add_argument("--report", action="store_true", help="of what has been tried")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="side by side")


def records_in(file):
    return [json.loads(line) for line in file.read_text().splitlines()] if file.exists() else []


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=200, help="how many are drawn")
    arguments_of_both(parser)
    parser.add_argument("--list", action="store_true", help="say what would be tried, and try nothing")
    parser.add_argument("--results", type=pathlib.Path, default=ROOT / "build" / "mutation.jsonl", help="a line for each that was tried")
    parser.add_argument("--scratch", type=pathlib.Path, default=ROOT / "build" / "mutation", help="the copy that is built and tested")
    parser.add_argument("--most-seconds", type=float, default=1200.0, help="for one mutation; programs that are left then are named as not run")
    parser.add_argument("--programs", default="", help="test programs that are enough, separated by commas; otherwise all of the fast suite")
    parser.add_argument("--cmake", action="append", default=[], metavar="ARGUMENT",
                        help="how the copy is configured; otherwise -O1 without debug symbols, the lanes' kernel of this machine alone")
    options = parser.parse_args()

    records = records_in(options.results)
    if options.report:
        report(records)
        return
    mutations, of_all = drawn(options)
    if options.list:
        print(f"{len(mutations)} of {of_all}")
        for f, line, _, before, after in mutations:
            print(f"{f}:{line}: {before!r} -> {after!r}   {(ROOT / f).read_text().split(chr(10))[line - 1].strip()}")
        return
    arguments = options.cmake or ["-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_CXX_FLAGS_RELEASE={FLAGS}", "-DBORESIGHT_LANES=native"]
    scratch = Scratch(options.scratch, options.jobs, arguments)
    scratch.prepare()
    wanted = [p for p in (options.programs.split(",") if options.programs else (*LIBRARY, *ANALYSES, *PROGRAMS)) if p]
    known = baseline(scratch, wanted, options.results.with_suffix(".baseline.json"))
    done = [{k: r[k] for k in ("file", "line", "column", "before", "after", "text")} for r in records]
    for number, mutation in enumerate(mutations, 1):
        what = key(mutation)
        if what in done:
            continue
        verdict = tried(scratch, mutation, known, options)
        records.append({**what, **verdict})
        with options.results.open("a") as out:
            out.write(json.dumps(records[-1]) + "\n")
        print(f"{number} of {len(mutations)}: {what['file']}:{what['line']}: {what['before']!r} -> {what['after']!r}: {verdict['verdict']}"
              f"{' by ' + str(verdict['by']) if verdict['by'] else ''}, {verdict['seconds']:.0f} s", file=sys.stderr, flush=True)
    report(records)


if __name__ == "__main__":
    main()
