"""Bundles the page into OUTPUT_FOLDER/report.js and report.css, with Plotly's notice beside them in plotly-notice.txt:

    python3 bundle.py PAGE_FOLDER PLOTLY_JS PLOTLY_COPYRIGHT ESBUILD OUTPUT_FOLDER

PLOTLY_JS is the library in one file with all its kinds of charts (8.7 MB), as Debian's python3-plotly has it. A bundler
has put its modules there, numbered, each with the numbers of those that it asks for. Here they become files again, so
that esbuild takes into the page what the page asks for and nothing else.
"""
import json
import os
import re
import subprocess
import sys

page, plotly, plotly_copyright, esbuild, output = (os.path.abspath(argument) for argument in sys.argv[1:])


def refuse(problem):
    sys.exit(f"{plotly}: {problem}. The page is bundled from Plotly 2.6 as Debian 12's python3-plotly has it; "
             "name that file with -DBORESIGHT_PLOTLY=FILE")


def modules_of(text):
    """Number -> (source, {name asked for: number})."""
    first = "({1:[function(_dereq_,module,exports){\n"
    begin = text.find(first)
    if begin < 0:
        refuse("expected a bundle of numbered modules")
    between = re.compile(r"^\},(\{.*\})\]"
                         r"(?:,(\d+):\[function\(_dereq_,module,exports\)\{$"
                         r"|\},\{\},\[(\d+)\]\)\(\d+\)\s*\}\);\s*\Z)", re.MULTILINE)
    modules = {}
    number, start = 1, begin + len(first)
    for match in between.finditer(text, start):
        modules[number] = (text[start:match.start()], json.loads(match.group(1)))
        if match.group(3):
            return modules, int(match.group(3))
        if int(match.group(2)) != number + 1:
            refuse(f"expected module {number + 1}, found {match.group(2)}")
        number, start = number + 1, match.end() + 1
    refuse("its modules have no end")


def unpack(folder):
    """Writes each module as NUMBER.js, and each part that the library is put together from as NAME.js: core.js, bar.js."""
    with open(plotly, encoding="utf-8") as file:
        modules, whole = modules_of(file.read())
    os.makedirs(folder, exist_ok=True)
    for number, (source, asked) in modules.items():
        twin = re.match(r"arguments\[4\]\[(\d+)\]\[0\]\.apply\(exports,arguments\)", source)
        if twin:  # the same text as that module, asking for others by the same names
            source = modules[int(twin.group(1))][0]

        def required(match):
            name = match.group(2)
            return f'require("./{asked[name]}.js")' if name in asked else match.group(0)
        with open(os.path.join(folder, f"{number}.js"), "w", encoding="utf-8") as file:
            file.write(re.sub(r"_dereq_\((['\"])(.*?)\1\)", required, source))
    for name, number in modules[whole][1].items():
        with open(os.path.join(folder, os.path.basename(name) + ".js"), "w", encoding="utf-8") as file:
            file.write(f'module.exports = require("./{number}.js");\n')


def notice():
    """Who wrote Plotly, and under which terms: from Debian's file of its package."""
    with open(plotly_copyright, encoding="utf-8") as file:
        paragraphs = file.read().strip().split("\n\n")
    of_plotly = [one for one in paragraphs if one.startswith("Files:") and "plotly.js" in one]
    terms = [one for one in paragraphs if one.startswith("License:")]
    if not of_plotly or not terms:
        refuse(f"{plotly_copyright} has no terms of plotly.js")
    head = "The charts of the reports are drawn by plotly.js, https://github.com/plotly/plotly.js"
    return "\n\n".join([head, *of_plotly, *terms])


unpack(os.path.join(output, "plotly"))
with open(os.path.join(output, "plotly-notice.txt"), "w", encoding="utf-8") as file:
    file.write(notice() + "\n")
subprocess.run([
    esbuild, "report=" + os.path.join(page, "main.js"), "--outdir=" + output,
    "--bundle", "--minify", "--format=iife", "--platform=browser",
    "--target=es2020", "--alias:plotly=" + os.path.join(output, "plotly"),
    "--charset=ascii",  # the page may be served or opened with any guess of its encoding
    "--banner:js=/*!\n" + notice().replace("*/", "* /").encode("ascii", "replace").decode() + "\n*/",
    "--legal-comments=inline", "--log-level=warning",
], check=True)
