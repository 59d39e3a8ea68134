#!/usr/bin/env python3
"""Writes the study files by which Monte Carlo over forty tolerances is timed, made of examples/3-rrcpr.

    tests/benchmarks/tolerances.py OUT
    time build/release/bin/boresight montecarlo OUT/play.toml      --rung perturbation --jobs 2 --out OUT/play
    time build/release/bin/boresight montecarlo OUT/geometry.toml  --rung perturbation --jobs 2 --out OUT/geometry

play.toml: 100,000 samples of forty errors and the clearance of F1. geometry.toml: 1,000,000 samples of the errors alone, no clearance.
"""
import pathlib
import re
import sys

# Thirteen errors a leg, and the platform's warming: name, what it is, standard deviation.
OF_A_LEG = [
    ("rod{i}.length", 'joint = "F{i}"\nbody = "rod{i}"\ntranslation = "towards C{i}"', "0.01 mm"),
    ("F{i}.x", 'joint = "F{i}"\nbody = "platform"\ntranslation = [1, 0, 0]', "0.01 mm"),
    ("F{i}.y", 'joint = "F{i}"\nbody = "platform"\ntranslation = [0, 1, 0]', "0.01 mm"),
    ("F{i}.z", 'joint = "F{i}"\nbody = "platform"\ntranslation = [0, 0, 1]', "0.01 mm"),
    ("F{i}.squareness", 'joint = "F{i}"\nbody = "platform"\nrotation = [1, 0, 0]', "0.05 mrad"),
    ("A{i}.x", 'joint = "A{i}"\nbody = "ground"\ntranslation = [1, 0, 0]', "0.01 mm"),
    ("A{i}.tilt", 'joint = "A{i}"\nbody = "ground"\nrotation = [0, 1, 0]', "0.05 mrad"),
    ("B{i}.squareness", 'joint = "B{i}"\nbody = "crank{i}"\nrotation = [0, 1, 0]', "0.05 mrad"),
    ("C{i}.squareness", 'joint = "C{i}"\nbody = "carriage{i}"\nrotation = [0, 0, 1]', "0.05 mrad"),
    ("A{i}.offset", 'drive = "A{i}"', "0.02 mrad"),
    ("A{i}.scale", 'drive = "A{i}"\nlaw = "q"', "0.01 mrad"),
    ("P{i}.offset", 'drive = "P{i}"', "5 um"),
    ("P{i}.scale", 'drive = "P{i}"\nlaw = "q"', "10 um"),
]


def spread(sd):
    return f'normal = {{ mean = "0 {sd.partition(" ")[2]}", sd = "{sd}" }}'


def main():
    out = pathlib.Path(sys.argv[1])
    out.mkdir(parents=True, exist_ok=True)
    example = pathlib.Path(__file__).resolve().parents[2] / "examples/3-rrcpr/3-rrcpr.toml"
    errors = '\n[[pattern]]\ncount = 3\naxis = "z"\n'
    errors += "".join(f'\n[[pattern.error]]\nname = "{name}"\n{what}\n' for name, what, _ in OF_A_LEG)
    errors += '\n[[error]]\nname = "platform.warming"\nbody = "platform"\nexpansion = "23.6e-6 1/K"\n'
    text = example.read_text()
    (out / "play-mechanism.toml").write_text(text + errors)
    without = re.sub(r"(?ms)^\[\[clearance\]\].*?(?=^\[\[|\Z)", "", text)
    (out / "geometry-mechanism.toml").write_text(without + errors)
    random = [(name.format(i=i), sd) for i in (1, 2, 3) for name, _, sd in OF_A_LEG] + [("platform.warming", "2 K")]
    for kind, samples, more in (("play", 100_000, [("clearance.F1.radial", None)]), ("geometry", 1_000_000, [])):
        study = f'format = 1\nmechanism = "{kind}-mechanism.toml"\naccuracy = "1 %"\n'
        study += '\n[index]\nquantity = "position_error"\nstatistic = "max"\n'
        for name, sd in random:
            study += f'\n[[random]]\nparameter = "error.{name}"\ndistribution = {{ {spread(sd)} }}\n'
        for name, _ in more:
            study += (f'\n[[random]]\nparameter = "{name}"\ndistribution = {{ normal = {{ mean = "0.1 mm", sd = "0.01 mm" }}, '
                      'truncate = ["0.05 mm", "0.15 mm"] }\n')
        study += f"\n[montecarlo]\nsamples = {samples}\nseed = 1\n"
        (out / f"{kind}.toml").write_text(study)


if __name__ == "__main__":
    main()
