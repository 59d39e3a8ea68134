"""check.py GENERATOR: it prints what GENERATOR.txt beside this file holds: words the same, numbers within one and a half of the last place
printed. GENERATOR: the name of a script here, or the path of a program.

check.py GENERATOR --write makes the file anew. --within SHARE allows numbers to be off by this share, where impacts make a figure a draw.
"""

import argparse
import pathlib
import subprocess
import sys


def place(text):
    """The value of a number's last printed place; 0 for a whole number; None for a word."""
    try:
        float(text)
    except ValueError:
        return None
    mantissa, _, exponent = text.lower().partition("e")
    return (10.0 ** -len(mantissa.partition(".")[2]) if "." in mantissa else 0.0) * 10.0 ** int(exponent or 0)


def same(found, expected, share):
    last = place(expected)
    if last is None or place(found) is None:
        return found == expected
    return abs(float(found) - float(expected)) <= max(1.5 * last, share * abs(float(expected)))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("generator")
    parser.add_argument("--write", action="store_true")
    parser.add_argument("--within", type=float, default=0.0)
    options = parser.parse_args()
    here = pathlib.Path(__file__).parent
    script = here / (options.generator + ".py")
    command = [sys.executable, script] if script.exists() else [options.generator]
    table = here / (pathlib.Path(options.generator).name + ".txt")
    out = subprocess.run(command, capture_output=True, text=True, check=False)
    if out.returncode != 0:
        sys.exit(f"{options.generator} failed:\n{out.stderr}")
    if options.write:
        table.write_text(out.stdout)
        return
    found, expected = out.stdout.splitlines(), table.read_text().splitlines()
    if len(found) != len(expected):
        sys.exit(f"{table.name}: {len(expected)} lines, and {options.generator} prints {len(found)}")
    for number, (mine, theirs) in enumerate(zip(found, expected), 1):
        a, b = mine.split(), theirs.split()
        if len(a) != len(b) or not all(same(x, y, options.within) for x, y in zip(a, b)):
            sys.exit(f"{table.name}:{number}: {theirs}\n{options.generator} prints: {mine}")


main()
