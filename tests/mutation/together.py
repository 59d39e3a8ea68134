"""As mutate.py, with all mutations in one build, each behind a switch: seconds a mutation instead of minutes.

    python3 tests/mutation/together.py --count 200 --seed 1          # draws, builds, tries; goes on where an earlier start stopped
    python3 tests/mutation/together.py --report                      # share noticed, and the survivors

README.md says how it goes about it.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import time

import mutate
from mutate import ANALYSES, LIBRARY, PROGRAMS, ROOT, Scratch
from switches import LIVE, NONE, VARIABLE, switched

HEADER = pathlib.Path(__file__).resolve().parent / "mutants.hpp"
SKIPPED_TESTS = "-*Long*:*LongRun*"
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
    for program in wanted:
        of = known.setdefault(program, {})
        for test in tests_in(scratch.binary(program)):
            if test in of:
                continue
            marks = scratch.folder / "met"
            marks.unlink(missing_ok=True)
            failed, seconds = one_test(scratch.binary(program), test, 600, {"BORESIGHT_MUTANTS_MET": str(marks)}, scratch.folder)
            met = marks.read_bytes() if marks.exists() else b""
            of[test] = {"seconds": round(seconds, 3), "passes": failed is None, "met": [k for k, mark in enumerate(met) if mark == 1],
                        "not_valid": [k for k, mark in enumerate(met) if mark == 2]}
            if failed is not None:
                print(f"{program}: {test} fails without a mutation ({failed}) and is left out", file=sys.stderr, flush=True)
        file.write_text(json.dumps(known))
        print(f"{program}: {len(of)} tests, {sum(t['seconds'] for t in of.values()):.0f} s", file=sys.stderr, flush=True)
    return known


def tried(scratch, id, file, known, most_seconds):
    """Runs the tests that meet the mutation, the nearest and quickest first, until one fails."""
    order = {program: k for k, program in enumerate(mutate.programs_for(file, known))}
    meet = sorted((order.get(program, 99) > 0, t["seconds"] > 5.0, order.get(program, 99), t["seconds"], program, name)
                  for program, tests in known.items() for name, t in tests.items() if id in t["met"] and t["passes"])
    if not meet:
        return {"verdict": "survived", "by": "no test comes across it", "ran": 0, "not_run": 0, "seconds": 0.0}
    start = time.monotonic()
    for ran, (_, _, _, seconds, program, name) in enumerate(meet):
        if time.monotonic() - start > most_seconds:
            return {"verdict": "survived", "by": None, "ran": ran, "not_run": len(meet) - ran, "seconds": round(time.monotonic() - start, 1)}
        failed, _ = one_test(scratch.binary(program), name, 5.0 + 5.0 * seconds, {"BORESIGHT_MUTANT": str(id)}, scratch.folder)
        if failed is not None:
            verdict = "timed out" if failed == "timed out" else "killed"
            return {"verdict": verdict, "by": f"{program}: {name}", "ran": ran + 1, "not_run": 0, "seconds": round(time.monotonic() - start, 1)}
    return {"verdict": "survived", "by": None, "ran": len(meet), "not_run": 0, "seconds": round(time.monotonic() - start, 1)}


def report(records):
    counts = {}
    for r in records:
        counts[r["verdict"]] = counts.get(r["verdict"], 0) + 1
    noticed, passed = counts.get("killed", 0) + counts.get("timed out", 0), counts.get("survived", 0)
    print(", ".join(f"{counts[v]} {v}" for v in sorted(counts)) or "nothing tried yet")
    if noticed + passed:
        print(f"{noticed} of {noticed + passed} were noticed: {100.0 * noticed / (noticed + passed):.1f} %")
    for r in records:
        if r["verdict"] == "survived":
            rest = f"   ({r['by']})" if r["by"] else f"   ({r['ran']} tests ran, {r['not_run']} did not for want of time)"
            print(f"survived  {r['file']}:{r['line']}: {r['before']!r} -> {r['after']!r}   {r['text']}{rest}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--count", type=int, default=200, help="how many are tried; more are drawn, as some cannot be switched")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", action="append", default=[], metavar="FILE", help="mutate this file alone; may be given again")
    parser.add_argument("--build-only", action="store_true", help="build, run every test once, and try nothing")
    parser.add_argument("--again", action="store_true", help="try those that survived once more: after tests were added")
    parser.add_argument("--report", action="store_true", help="of what has been tried")
    parser.add_argument("--results", type=pathlib.Path, default=ROOT / "build" / "mutants.jsonl", help="a line for each that was tried")
    parser.add_argument("--scratch", type=pathlib.Path, default=ROOT / "build" / "mutants", help="the copy that is built and tested")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1, help="of the build")
    parser.add_argument("--most-seconds", type=float, default=300.0, help="of tests for one mutation; how many were left is said")
    parser.add_argument("--programs", default="", help="build and run these alone, separated by commas, and try what is in their rooms; otherwise all of the fast suite")
    options = parser.parse_args()

    records = [json.loads(line) for line in options.results.read_text().splitlines()] if options.results.exists() else []
    if options.report:
        report(records)
        return
    drawn = argparse.Namespace(**{**vars(options), "count": int(DRAWN_BESIDE * options.count)})
    mutations, of_all = mutate.drawn(drawn)
    scratch = Scratch(options.scratch, options.jobs, ["-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS_RELEASE=-O1 -DNDEBUG", "-DBORESIGHT_LANES=scalar",
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
    last = {json.dumps([r[k] for k in ("file", "line", "column", "after", "text")]): r for r in records}
    tried_so_far = 0
    for id, mutation in enumerate(mutations, 1):
        if tried_so_far == options.count:
            break
        what = mutate.key(mutation)
        before = last.get(json.dumps([what[k] for k in ("file", "line", "column", "after", "text")]))
        if before and not (options.again and before["verdict"] == "survived"):
            tried_so_far += before["verdict"] != "not switched"
            continue
        if pathlib.PurePath(mutation[0]).parts[1] + "_tests" not in wanted:
            continue  # without its own room's tests nothing would be said of it
        if id not in met and (id in not_valid or levels.get(id, VARIABLE) > VARIABLE):
            verdict = {"verdict": "not switched", "by": None, "ran": 0, "not_run": 0, "seconds": 0.0}
        else:
            verdict = tried(scratch, id, mutation[0], known, options.most_seconds)
            tried_so_far += 1
        last[json.dumps([what[k] for k in ("file", "line", "column", "after", "text")])] = {**what, **verdict}
        options.results.write_text("".join(json.dumps(r) + "\n" for r in last.values()))
        print(f"{tried_so_far} of {options.count}: {what['file']}:{what['line']}: {what['before']!r} -> {what['after']!r}: {verdict['verdict']}"
              f"{' by ' + str(verdict['by']) if verdict['by'] else ''}, {verdict['seconds']:.0f} s", file=sys.stderr, flush=True)
    print(f"{tried_so_far} of {of_all} mutations")
    report(list(last.values()))


if __name__ == "__main__":
    main()
