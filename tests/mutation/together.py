"""As mutate.py, with all mutations in one build, each behind a switch: seconds a mutation instead of minutes.

    python3 tests/mutation/together.py --count 200 --seed 1          # draws, builds, tries; goes on where an earlier start stopped
    python3 tests/mutation/together.py --like FILE                   # those of an earlier draw's results, found again by their lines
    python3 tests/mutation/together.py --report                      # share noticed, and the survivors

README.md says how it goes about it.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import time

import mutate
from mutate import ANALYSES, FLAGS, LIBRARY, PROGRAMS, ROOT, Scratch
from switches import LIVE, NONE, VARIABLE, switched

HEADER = pathlib.Path(__file__).resolve().parent / "mutants.hpp"
SKIPPED_TESTS = "-*Long*:*LongRun*"
FAR = 0.3  # [s]
DRAWN_BESIDE = 1.3  # some cannot be switched: so many more are drawn


def write_sources(scratch, mutations, levels):
    """The copy's sources with a switch for each mutation; ids of those that cannot be."""
    by_file, cannot = {}, []
    for id, (file, *place) in enumerate(mutations, 1):
        by_file.setdefault(file, []).append((id, *place, levels.get(id, VARIABLE)))
    for file, own in by_file.items():
        text, not_these = switched(file, (ROOT / file).read_text(), own, HEADER)
        cannot += not_these
        target = scratch.folder / file
        if target.read_text() != text:
            target.write_text(text)
    return cannot


def blamed(said, scratch, mutations, levels):
    """Mutations that a compiler's faults name; or else those on the lines of a fault, or in its file."""
    named = {int(id) % LIVE for id in re.findall(r"(?:error: |required from ).*?(?:\bid = |\b(?:number|logical|at|product_at|At|Left)<)(\d+)", said)}
    named = {id for id in named if 0 < id <= len(mutations) and levels.get(id, VARIABLE) < NONE}
    if named:
        return named
    places = {}
    for id, (file, line, *_) in enumerate(mutations, 1):
        if levels.get(id, VARIABLE) < NONE:
            places.setdefault(file, []).append((line, id))
    on_line, in_file = set(), set()
    for path, line, kind in re.findall(r"([\w./+-]+\.[ch]pp):(\d+):\d+:\s+(error|required from|  )", said):
        for file, own in places.items():
            if path.endswith(file):
                on_line |= {id for at, id in own if 0 <= int(line) - 1 - at <= 3}
                if kind == "error":
                    in_file |= {id for _, id in own}
    if not on_line and not in_file:
        for file, own in places.items():
            if f"/{pathlib.PurePath(file).name}" in said:
                in_file |= {id for _, id in own}
    return on_line or in_file


def build(scratch, mutations, wanted, file):
    """Builds, and gives in where a switch does not compile. Returns what each mutation had to give in to, and what was built."""
    levels = {int(k): v for k, v in json.loads(file.read_text()).items()} if file.exists() else {}
    while True:
        cannot = write_sources(scratch, mutations, levels)
        start = time.monotonic()
        done = mutate.run(["ninja", "-C", str(scratch.build), f"-j{scratch.jobs}", "-k", "0", *wanted], 36000)
        if done.returncode == 0:
            print(f"built in {time.monotonic() - start:.0f} s", file=sys.stderr, flush=True)
            return {**levels, **{id: NONE for id in cannot}}
        (scratch.folder / "build.log").write_text(done.stdout)
        found = blamed(done.stdout, scratch, mutations, levels)
        if not found:
            sys.exit(f"does not build, and no mutation is to blame: {scratch.folder / 'build.log'}\n{done.stdout[-3000:]}")
        for id in found:
            levels[id] = levels.get(id, VARIABLE) + 1
        print(f"{len(found)} switches do not compile as they are: {sorted(found)}", file=sys.stderr, flush=True)
        file.write_text(json.dumps(levels))


def tests_in(binary):
    names, suite = [], ""
    for line in mutate.run([str(binary), "--gtest_list_tests", f"--gtest_filter={SKIPPED_TESTS}"], 60).stdout.split("\n"):
        word = line.split("#")[0].rstrip()
        if word.endswith(".") and not word.startswith(" "):
            suite = word
        elif word.startswith("  "):
            names.append(suite + word.strip())
    return names


def one_test(binary, test, seconds, environment, folder):
    """None where it passed, else how it ended; the time taken."""
    start = time.monotonic()
    child = subprocess.Popen([str(binary), "--gtest_brief=1", f"--gtest_filter={test}"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                             start_new_session=True, cwd=folder, env={**os.environ, **environment})
    try:
        status = child.wait(timeout=seconds)
    except subprocess.TimeoutExpired:
        status = "timed out"
    finally:
        try:
            os.killpg(child.pid, 9)
        except ProcessLookupError:
            pass
        child.wait()
    return (None if status == 0 else status), time.monotonic() - start


def looked_at(scratch, wanted, file):
    """Every test once without a mutation: how long it takes, and which mutations it meets. Tests that fail as it is are left out."""
    known = json.loads(file.read_text()) if file.exists() else {}

    def look(program, test):
        marks = scratch.folder / f"met-{program}-{test.replace('/', '-')}"
        marks.unlink(missing_ok=True)
        failed, seconds = one_test(scratch.binary(program), test, 600, {"BORESIGHT_MUTANTS_MET": str(marks)}, scratch.folder)
        met = marks.read_bytes() if marks.exists() else b""
        marks.unlink(missing_ok=True)
        if failed is not None:
            print(f"{program}: {test} fails without a mutation ({failed}) and is left out", file=sys.stderr, flush=True)
        return {"seconds": round(seconds, 3), "passes": failed is None, "met": [k for k, mark in enumerate(met) if mark == 1],
                "not_valid": [k for k, mark in enumerate(met) if mark == 2]}

    for program in wanted:
        of = known.setdefault(program, {})
        tests = [t for t in tests_in(scratch.binary(program)) if t not in of]
        with concurrent.futures.ThreadPoolExecutor(scratch.jobs) as threads:
            of.update(zip(tests, threads.map(lambda t: look(program, t), tests)))
        file.write_text(json.dumps(known))
        print(f"{program}: {len(of)} tests, {sum(t['seconds'] for t in of.values()):.0f} s", file=sys.stderr, flush=True)
    return known


def tried(scratch, id, file, known, most_seconds):
    """Runs the tests that meet the mutation, the quickest first, until one fails; those of other rooms as if they took longer."""
    own = mutate.own_program(file)
    meet = sorted((t["seconds"] + (FAR if program != own else 0.0), program, name)
                  for program, tests in known.items() for name, t in tests.items() if id in t["met"] and t["passes"])
    if not meet:
        return {"verdict": "survived", "by": "no test comes across it", "ran": 0, "not_run": 0, "seconds": 0.0}
    start = time.monotonic()
    for ran, (_, program, name) in enumerate(meet):
        seconds = known[program][name]["seconds"]
        if time.monotonic() - start > most_seconds:
            return {"verdict": "survived", "by": None, "ran": ran, "not_run": len(meet) - ran, "seconds": round(time.monotonic() - start, 1)}
        failed, _ = one_test(scratch.binary(program), name, 5.0 + 5.0 * seconds, {"BORESIGHT_MUTANT": str(id)}, scratch.folder)
        if failed is not None:
            verdict = "timed out" if failed == "timed out" else "killed"
            return {"verdict": verdict, "by": f"{program}: {name}", "ran": ran + 1, "not_run": 0, "seconds": round(time.monotonic() - start, 1)}
    return {"verdict": "survived", "by": None, "ran": len(meet), "not_run": 0, "seconds": round(time.monotonic() - start, 1)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=200, help="how many are tried; more are drawn, as some cannot be switched")
    mutate.arguments_of_both(parser)
    parser.add_argument("--build-only", action="store_true", help="build, run every test once, and try nothing")
    parser.add_argument("--again", action="store_true", help="try those that survived once more: after tests were added")
    parser.add_argument("--results", type=pathlib.Path, default=ROOT / "build" / "mutants.jsonl", help="a line for each that was tried")
    parser.add_argument("--scratch", type=pathlib.Path, default=ROOT / "build" / "mutants", help="the copy that is built and tested")
    parser.add_argument("--most-seconds", type=float, default=300.0, help="of tests for one mutation; how many were left is said")
    parser.add_argument("--programs", default="", help="build and run these alone, separated by commas, and try what is in their rooms; otherwise all of the fast suite")
    options = parser.parse_args()

    records = mutate.records_in(options.results)
    if options.report:
        mutate.report(records)
        return
    drawn = argparse.Namespace(**{**vars(options), "count": int(DRAWN_BESIDE * options.count)})
    if options.like:
        options.count = len(options.like.read_text().splitlines())
    mutations, of_all = mutate.drawn(drawn)
    scratch = Scratch(options.scratch, options.jobs, ["-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_CXX_FLAGS_RELEASE={FLAGS}", "-DBORESIGHT_LANES=scalar",
                      "-DBORESIGHT_MPI=OFF", "-DBORESIGHT_BENCHMARKS=OFF", "-DBORESIGHT_WARNINGS_AS_ERRORS=OFF", "-DCMAKE_CXX_FLAGS=-w"])
    scratch.prepare(leave={m[0] for m in mutations})
    wanted = [p for p in (options.programs.split(",") if options.programs else (*LIBRARY, *ANALYSES, *PROGRAMS)) if p]
    beside = lambda what: options.results.with_suffix(f".{what}.json")
    levels = build(scratch, mutations, wanted, beside("levels"))
    known = looked_at(scratch, wanted, beside("tests"))
    if options.build_only:
        return

    not_valid = {id for tests in known.values() for t in tests.values() for id in t["not_valid"]}
    met = {id for tests in known.values() for t in tests.values() for id in t["met"]}
    name = lambda r: json.dumps([r[k] for k in ("file", "line", "column", "after", "text")])
    last, to_try, counted = {name(r): r for r in records}, [], 0
    for id, mutation in enumerate(mutations, 1):
        if counted == options.count:
            break
        what = mutate.key(mutation)
        before = last.get(name(what))
        if before and not (options.again and before["verdict"] == "survived"):
            counted += before["verdict"] != "not switched"
        elif mutate.own_program(mutation[0]) not in wanted:
            continue  # without its own room's tests nothing would be said of it
        elif id not in met and (id in not_valid or levels.get(id, VARIABLE) > VARIABLE):
            last[name(what)] = {**what, "verdict": "not switched", "by": None, "ran": 0, "not_run": 0, "seconds": 0.0}
        else:
            to_try.append((id, what))
            counted += 1

    threads = concurrent.futures.ThreadPoolExecutor(options.jobs)
    try:
        trials = {threads.submit(tried, scratch, id, what["file"], known, options.most_seconds): what for id, what in to_try}
        for number, trial in enumerate(concurrent.futures.as_completed(trials), 1):
            what, verdict = trials[trial], trial.result()
            last[name(what)] = {**what, **verdict}
            options.results.write_text("".join(json.dumps(r) + "\n" for r in last.values()))
            print(f"{number} of {len(to_try)}: {what['file']}:{what['line']}: {what['before']!r} -> {what['after']!r}: {verdict['verdict']}"
                  f"{' by ' + str(verdict['by']) if verdict['by'] else ''}, {verdict['seconds']:.0f} s", file=sys.stderr, flush=True)
    finally:
        threads.shutdown(cancel_futures=True)
    print(f"{counted} of {of_all} mutations")
    mutate.report(list(last.values()))


if __name__ == "__main__":
    main()
