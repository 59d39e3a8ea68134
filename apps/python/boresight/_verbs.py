"""The verbs of the command line as functions. Each writes the folder that the command writes, and returns it as a Result."""

from __future__ import annotations

import os
import shutil
import tempfile
from typing import Any, Callable, Mapping, Optional, Union

from . import _core
from ._results import Result

Progress = Callable[[float, float, str, str], None]
File = Union[str, "os.PathLike[str]"]


def _text(value: Any) -> str:
    return value if isinstance(value, str) else repr(float(value)) if isinstance(value, float) else str(value)


def verb(
    name: str,
    file: Optional[File] = None,
    *,
    settings: Optional[Mapping[str, Any]] = None,
    out: Optional[File] = None,
    progress: Optional[Progress] = None,
    **options: Any,
) -> Result:
    """Calls `boresight NAME FILE`, as the program does it.

    settings: values of the mechanism that replace those of its file, by their paths: {"clearance.F1.radial": "0.2 mm"}.
    out: the folder of the results, with which the same call goes on where it was stopped; otherwise one that goes with
        the Result. A verb that has no such option writes where it writes, or prints (paths, schema, help).
    options: those of the command, with _ for -: rung="perturbation", accuracy="1 %", jobs=4, step_error="off". True is
        an option without a value; a list gives an option several times.
    progress(done, total, unit, estimate): called ten times a second; what it raises ends the study, and so does Ctrl-C:
        with `out`, what was reached is kept.

    Raises InputError, ComputationError, ResultsError. That the answer is no (a requirement not met) is no error:
    Result.answer is False.
    """
    known = _core.options_of_verb(name)
    own = tempfile.mkdtemp(prefix="boresight-") if out is None and "--out" in known else None
    words = [name] + ([os.fspath(file)] if file is not None else [])
    if own is not None or out is not None:
        folder = os.path.join(own, name) if own is not None else os.fspath(out)  # type: ignore[arg-type]
        words += ["--out", folder]
    else:  # what such a verb writes, it writes into what it is called on: new, report
        folder = ""
    if "--quiet" in known:
        words.append("--quiet")
    for path, value in (settings or {}).items():
        words += ["--set", f"{path}={_text(value)}"]
    for option, value in options.items():
        dashed = "--" + option.replace("_", "-")
        for one in value if isinstance(value, (list, tuple)) else [value]:
            if one is True:
                words.append(dashed)
            elif one is not None and one is not False:
                words.append(f"{dashed}={_text(one)}")
    try:
        found = _core.call_verb(words, progress)
    except BaseException:
        if own is not None:
            shutil.rmtree(own, ignore_errors=True)
        raise
    if not folder and file is not None and os.path.isdir(file):
        folder = os.fspath(file)
    return Result(name, found["status"], found["folder"] or folder, own)


def _named(name: str, of_study: bool, says: str) -> Callable[..., Result]:
    def call(file: File, **options: Any) -> Result:
        return verb(name, file, **options)

    call.__name__ = call.__qualname__ = name
    kind = "study" if of_study else "mechanism"
    call.__doc__ = f"{says}\n\nfile: a {kind} file. Options and errors: those of verb(); `boresight {name} --help` lists them."
    return call


check = _named("check", False, "What would go wrong in a mechanism's motion, before it does.")
sweep = _named("sweep", True, "The index over a grid of parameters.")
montecarlo = _named("montecarlo", True, "The index's distribution, with confidence intervals.")
sensitivity = _named("sensitivity", True, "Which parameter's scatter matters most.")
match = _named("match", True, "The clearances, loads or masses that give the least error.")
allocate = _named("allocate", True, "Fits and tolerances that meet the requirement at least cost.")
calibrate = _named("calibrate", True, "Contact parameters and errors by measured pointing errors.")
budget = _named("budget", True, "The pointing budget, by the error indices of ECSS-E-ST-60-10C.")
chart = _named("chart", False, "How accurate and how fast each method is here.")
stability = _named("stability", False, "Where the methods fail.")


def _written(name: str, file: File, to: File, options: Mapping[str, Any]) -> None:
    words = [name, os.fspath(file), "--to", os.fspath(to), "--quiet"]
    words += [f"--{option}={_text(value)}" for option, value in options.items() if value is not None]
    _core.call_verb(words, None)


def import_mechanism(
    file: File,
    to: File,
    *,
    boresight: Optional[str] = None,
    drive: Optional[str] = None,
    ground: Optional[str] = None,
    duration: Optional[str] = None,
) -> None:
    """Writes a mechanism file, `to`, from a file of URDF, SDF or MJCF.

    boresight: the link that points, and its axis that does: "camera:x". drive: the driven joints and their courses,
    "pan=0.5*sin(t); tilt". ground: a link that stands still. duration: of the motion, "1 s". What is not given is as the file
    says, or assumed; the written file tells what was, and what was left out.

    Raises InputError (what is wrong with the file), ResultsError (`to` is there already).
    """
    _written("import", file, to, {"boresight": boresight, "drive": drive, "ground": ground, "duration": duration})


def convert(file: File, to: File) -> None:
    """Writes the ideal mechanism of a mechanism file for other programs: as SDF or, where `to` ends in .xml or .mjcf, as MJCF.

    Raises InputError, ResultsError (`to` is there already).
    """
    _written("convert", file, to, {})


def laws(file: Optional[File] = None, **options: Any) -> Result:
    """Contact and friction laws, for a mechanism file's joint or for the default pin. Options and errors: those of verb()."""
    return verb("laws", file, **options)


def report_of_run(file: File, **options: Any) -> Result:
    """One motion with its report, as `boresight run` gives it; run() gives the motion as arrays. Options and errors: those of
    verb()."""
    return verb("run", file, **options)
