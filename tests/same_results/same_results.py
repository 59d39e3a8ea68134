#!/usr/bin/env python3
"""Are the tables of two builds the same, bit for bit?

    python3 tests/same_results/same_results.py compute build/release/bin/boresight before/
    python3 tests/same_results/same_results.py compute build/release/bin/boresight after/     # after the change
    python3 tests/same_results/same_results.py compare before/ after/

`compute` runs each command below, shortened examples of every verb, rung, integrator and formulation, and keeps what they leave behind: every
table, the summary and what the terminal showed. `compare` lists what differs, number by number, and ends with status 1 if anything does. Times,
and what they decide, are left out; a report is compared by the data that its charts show.
"""

import argparse
import concurrent.futures
import json
import pathlib
import re
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
THREE = "examples/3-rrcpr/"
SHORT = "--set motion.duration=50ms"

# Changes of a study that make it short: text of the file as written, text instead.
EDITS = {
    "montecarlo.toml": [("samples = 2000", "samples = 200")],
    "sensitivity.toml": [("samples = 512", "samples = 128")],
    "match.toml": [("samples = 48", "samples = 16"), ("map = 13", "map = 5"), ("confirm = 24", "confirm = 8"), ("evaluations = 24", "evaluations = 8")],
    "allocate.toml": [("samples = 1000", "samples = 200"), ("confirm = 120", "confirm = 80"), ("front = 6", "front = 2")],
    "budget.toml": [("members = 400", "members = 60"), ("attribution = 64", "attribution = 8"), ('start = "50 ms"', 'start = "5 ms"'),
                    ('window = "50 ms"', 'window = "5 ms"'), ('separation = "0.2 s"', 'separation = "10 ms"'), ('observation = "0.45 s"', 'observation = "22 ms"')],
}

SCENES = ["2-us-pointing/2-us-pointing", "3-rrr/3-rrr", "bricard/bricard", "crank-slider/crank-slider", "double-four-bar/double-four-bar",
          "flores-slider-crank/flores-slider-crank", "four-bar/four-bar", "four-bar/planar", "free-body/free-body", "heavy-top/heavy-top",
          "pendulum/pendulum", "spatial-double-crank/spatial-double-crank", "spatial-slider-crank/spatial-slider-crank"]


def commands():
    """Name and words of each command."""
    made = {}

    def add(name, *words):
        made[name] = " ".join(words).split()

    for verb in ["check", "run"]:
        add(f"{verb}-3-rrcpr", verb, THREE + "3-rrcpr.toml")
    add("run-free-axes", "run", THREE + "3-rrcpr.toml --set clearance.F1.axes=free --compare", SHORT)
    add("run-twelve", "run", THREE + "twelve-joints.toml", SHORT)
    for rung in ["envelope", "quasistatic", "perturbation", "multibody"]:
        add(f"run-{rung}", "run", THREE + "3-rrcpr.toml --rung", rung, SHORT)
        add(f"run-twelve-{rung}", "run", THREE + "twelve-joints.toml --rung", rung, "--set motion.duration=2ms")
    add("run-paper", "run", THREE + "3-rrcpr.toml --rung multibody --formulation paper", SHORT)
    add("run-projection", "run", THREE + "3-rrcpr.toml --rung multibody --formulation paper --stabilisation projection", SHORT)
    for integrator in ["dopri5", "rosenbrock", "generalized-alpha"]:
        add(f"run-{integrator}", "run", THREE + "3-rrcpr.toml --rung multibody --integrator", integrator, SHORT)
    for integrator in ["dopri5", "rosenbrock"]:
        add(f"run-perturbation-{integrator}", "run", THREE + "3-rrcpr.toml --rung perturbation --integrator", integrator, SHORT)
    add("run-nonlinear", "run", "examples/flores-slider-crank/flores-slider-crank.toml --rung perturbation --nonlinear", "2ms")
    add("run-squeezer", "run", "examples/andrews-squeezer/andrews-squeezer.toml --rung multibody --step 10us --pose K5")
    for law in ["hertz", "hunt-crossley", "lankarani-nikravesh", "flores", "gonthier", "hu-guo"]:
        add(f"run-{law}", "run", THREE + f"3-rrcpr.toml --rung perturbation --set clearance.F1.contact.law={law}", SHORT)
    for law in ["threlfall", "modified-coulomb", "lugre", "bengisu-akay", "brown-mcphee", "none"]:
        add(f"run-friction-{law}", "run", THREE + f"3-rrcpr.toml --rung perturbation --set clearance.F1.friction.law={law}", SHORT)
    for scene in SCENES:
        name = scene.split("/")[1]
        add(f"check-{name}", "check", f"examples/{scene}.toml")
        add(f"scene-{name}", "run", f"examples/{scene}.toml", "--set motion.duration=0.2s")
    for sweep in ["clearance-sweep", "load-sweep"]:
        add(sweep, "sweep", THREE + sweep + ".toml --rung perturbation")
    add("montecarlo", "montecarlo", THREE + "montecarlo.toml")
    add("montecarlo-multibody", "montecarlo", THREE + "montecarlo.toml --rung multibody --set motion.duration=5ms")
    add("montecarlo-rosenbrock", "montecarlo", THREE + "montecarlo.toml --rung perturbation --integrator rosenbrock --set motion.duration=5ms")
    add("fidelities", "montecarlo", THREE + "fidelities.toml --set motion.duration=20ms")
    add("tail", "montecarlo", THREE + "tail.toml --set motion.duration=20ms")
    add("sensitivity", "sensitivity", THREE + "sensitivity.toml --rung perturbation --set motion.duration=100ms")
    add("match", "match", THREE + "match.toml --rung perturbation --set motion.duration=50ms")
    add("allocate", "allocate", THREE + "allocate.toml --rung perturbation --set motion.duration=2ms")
    add("budget", "budget", THREE + "budget.toml --rung perturbation --set clearance.F1.axes=free", SHORT)
    add("calibrate", "calibrate", "examples/calibration/calibrate.toml --jobs 2")
    add("laws", "laws", THREE + "3-rrcpr.toml")
    add("laws-flores", "laws", "examples/flores-slider-crank/flores-slider-crank.toml")
    add("stability", "stability", THREE + "3-rrcpr.toml", "--set motion.duration=20ms")
    add("chart", "chart", THREE + "3-rrcpr.toml --time 1s --set motion.duration=20ms")
    return made


def shortened(folder):
    """The examples with their studies made short, beside the results."""
    copy = folder / "examples"
    for file in sorted((ROOT / "examples").rglob("*")):
        if not file.is_file() or file.suffix == ".png":
            continue
        text = file.read_text()
        for old, new in EDITS.get(file.name, []):
            if old not in text:
                sys.exit(f"{file}: no longer says '{old}'; mend EDITS")
            text = text.replace(old, new)
        target = copy / file.relative_to(ROOT / "examples")
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(text)


def compute(program, folder, only, jobs):
    program = pathlib.Path(program).resolve()
    folder.mkdir(parents=True, exist_ok=True)
    shortened(folder)
    chosen = {name: words for name, words in commands().items() if re.search(only, name)}

    def one(name):
        words = chosen[name]
        out = folder / name
        subprocess.run(["rm", "-rf", out], check=True)
        out.mkdir()
        command = [program, *words] + ([] if words[0] in ("check",) else ["--out", f"{name}/results"])
        ended = subprocess.run(command, cwd=folder, capture_output=True, text=True)
        (out / "stdout.txt").write_text(f"$ boresight {' '.join(words)}\n{ended.stdout}status {ended.returncode}\n")
        if ended.returncode not in (0, 1):
            (out / "stderr.txt").write_text(ended.stderr)
        if (out / "results" / "samples.db").exists() and not (out / "results" / "samples.csv").exists():
            subprocess.run([program, "export", f"{name}/results"], cwd=folder, capture_output=True)
        print(f"{name}: {ended.returncode}", flush=True)

    with concurrent.futures.ThreadPoolExecutor(jobs) as pool:
        list(pool.map(one, chosen))


TIMED = re.compile(r"hash|seconds|cpu|time_left|wall|speed_up|elapsed|version|started|finished|date|replay|host|_per_second$|timing|cost$", re.I)


def without_times(value):
    if isinstance(value, dict):
        return {key: without_times(inside) for key, inside in value.items() if not TIMED.search(key) or key == "impacts_per_second"}
    return [without_times(inside) for inside in value] if isinstance(value, list) else value


def lines(text):
    """Of a text for people: those that give no time."""
    return [line for line in text.splitlines() if not re.search(r"\d ?(ms|us|s|min|h)\b.*(sample|CPU|took|thread|core)|CPU|core|took|real time|computed in", line)]


def differences(a, b, where=""):
    if type(a) is not type(b):
        yield f"{where}: {a!r} before, {b!r} after"
    elif isinstance(a, dict):
        for key in sorted(a.keys() | b.keys()):
            if key not in a or key not in b:
                yield f"{where}.{key}: {'new' if key in b else 'gone'}"
            else:
                yield from differences(a[key], b[key], f"{where}.{key}")
    elif isinstance(a, list):
        if len(a) != len(b):
            yield f"{where}: {len(a)} entries before, {len(b)} after"
        for k, (left, right) in enumerate(zip(a, b)):
            yield from differences(left, right, f"{where}[{k}]")
    elif a != b and not (a != a and b != b):
        yield f"{where}: {a!r} before, {b!r} after"


def content(file):
    if file.suffix == ".json":
        return without_times(json.loads(file.read_text()))
    if file.suffix in (".csv", ".toml", ".txt"):
        return lines(file.read_text()) if file.name == "stdout.txt" else file.read_text().splitlines()
    return None  # stores are compared by what `export` gives, reports by their summaries


def compare(before, after):
    wrong = compared = 0
    files = {f.relative_to(before) for f in before.rglob("*") if f.is_file()} | {f.relative_to(after) for f in after.rglob("*") if f.is_file()}
    for name in sorted(files):
        if name.parts[0] == "examples":
            continue
        if not (before / name).exists() or not (after / name).exists():
            print(f"{name}: only {'before' if (before / name).exists() else 'after'}")
            wrong += 1
            continue
        a = content(before / name)
        if a is None:
            continue
        compared += 1
        found = list(differences(a, content(after / name)))
        if found:
            wrong += 1
            print(f"{name}: {len(found)} differ; " + "; ".join(found[:4]))
    print(f"{compared} files compared, {wrong} differ")
    return 1 if wrong else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    verbs = parser.add_subparsers(dest="verb", required=True)
    one = verbs.add_parser("compute")
    one.add_argument("program")
    one.add_argument("folder", type=pathlib.Path)
    one.add_argument("--only", default="", help="commands whose name matches")
    one.add_argument("--jobs", type=int, default=2)
    two = verbs.add_parser("compare")
    two.add_argument("before", type=pathlib.Path)
    two.add_argument("after", type=pathlib.Path)
    given = parser.parse_args()
    if given.verb == "compare":
        sys.exit(compare(given.before, given.after))
    compute(given.program, given.folder, given.only, given.jobs)


if __name__ == "__main__":
    main()
