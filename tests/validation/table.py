"""table.py --bin FOLDER: the tests that hold printed numbers give those that tests/README.md lists.

It runs every program whose tests call printed.hpp (those tests alone), makes the table of what they record, and compares it with the one in
tests/README.md: words the same, our numbers within one and a half of the last place shown there. --write puts the table into the file.
"""

import argparse
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).parent
TESTS = HERE.parent
README = TESTS / "README.md"
BEGIN, END = "<!-- made by tests/validation/table.py -->\n", "<!-- end of the table -->\n"


def holders():
    """For each program the files of its tests that record numbers, and the names of those tests."""
    programs, files = {}, set()
    for file in sorted(TESTS.rglob("*_test.cpp")):
        text = file.read_text()
        if '#include "validation/printed.hpp"' not in text:
            continue
        files.add(file.relative_to(TESTS).as_posix())
        program = re.search(r"boresight_test\((\w+)", (file.parent / "CMakeLists.txt").read_text()).group(1)
        for test in re.split(r"^TEST(?:_F)?\(", text, flags=re.M)[1:]:
            if "expect_printed(" in test or "PrintedTable " in test:
                suite, name = re.match(r"(\w+),\s*(\w+)\)", test).groups()
                programs.setdefault(program, []).append(f"{suite}.{name}")
    return programs, files


def records(folder):
    programs, files = holders()
    with tempfile.TemporaryDirectory() as temporary:
        log = pathlib.Path(temporary) / "records"
        for program, names in sorted(programs.items()):
            command = [pathlib.Path(folder) / program, "--gtest_brief=1", "--gtest_filter=" + ":".join(names)]
            ran = subprocess.run(command, capture_output=True, text=True, check=False, env={**os.environ, "BORESIGHT_VALIDATION": str(log)})
            if ran.returncode != 0:
                sys.exit(f"{program} failed:\n{ran.stdout}{ran.stderr}")
        rows = [line.split("\t") for line in log.read_text().splitlines()]
    silent = files - {("/" + row[0]).split("/tests/")[-1] for row in rows}
    if silent:
        sys.exit("include printed.hpp and record nothing: " + ", ".join(sorted(silent)))
    return sorted(rows, key=lambda row: (row[0], row[1]))  # not as the tests happen to be linked


def decimals(number):
    """Of a printed number: "0.0409" has 4, "-24631.8" has 1, "0.208e-7" has 10."""
    mantissa, _, exponent = number.lower().partition("e")
    return len(mantissa.partition(".")[2]) - int(exponent or 0)


def shown(ours, printed, tolerance):
    """Our number to the last place printed, and to no place that the test does not hold."""
    held = math.ceil(-math.log10(tolerance)) if tolerance > 0 else 0
    places = max(0, min(decimals(printed), held))
    return f"{ours:.{places}f}"


def table(rows):
    lines = ["| source | quantity | printed | ours | deviation | within | test |", "|---|---|---|---|---|---|---|"]
    for _, test, source, quantity, printed, ours, deviation, tolerance, count in rows:
        both = (printed, shown(float(ours), printed, float(tolerance))) if count == "1" else (f"{count} numbers", "the same")
        lines.append(f"| {source} | {quantity} | {both[0]} | {both[1]} | {float(deviation):.0e} | {float(tolerance):.2g} | `{test}` |")
    return lines


def same(found, expected):
    """Two lines of the table; deviations beyond the digits shown are another machine's to choose, within the tolerance of the test."""
    mine, theirs = found.split(" | "), expected.split(" | ")
    if len(mine) != 7 or found == expected:
        return found == expected
    if mine[:3] + mine[5:] != theirs[:3] + theirs[5:]:
        return False
    if mine[3] == theirs[3]:
        return True
    try:
        return abs(float(mine[3]) - float(theirs[3])) <= 1.5 * 10.0 ** -decimals(theirs[3])
    except ValueError:
        return False


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--bin", required=True)
    parser.add_argument("--write", action="store_true")
    options = parser.parse_args()
    lines = table(records(options.bin))
    before, _, rest = README.read_text().partition(BEGIN)
    held, _, after = rest.partition(END)
    if options.write:
        README.write_text(before + BEGIN + "\n" + "\n".join(lines) + "\n\n" + END + after)
        return
    listed = held.strip().splitlines()
    for mine, theirs in zip(lines, listed):
        if not same(mine, theirs):
            sys.exit(f"tests/README.md lists\n  {theirs}\nand the tests give\n  {mine}\npython3 tests/validation/table.py --bin build/release/bin --write")
    if len(lines) != len(listed):
        sys.exit(f"tests/README.md lists {len(listed) - 2} rows, the tests give {len(lines) - 2}")


main()
