"""The results of a verb: a folder, read as it is asked for."""

from __future__ import annotations

import csv
import html
import json
import os
import shutil
import weakref
from typing import Any, Dict, List, Optional

import numpy


# Columns that hold names, which may look like numbers.
_NAMES = {"joint", "contact", "body", "parameter", "name", "group"}


def _column(texts: List[str]) -> numpy.ndarray:
    # Yes or no, whole numbers, then numbers of any kind, of which nothing is none; text otherwise.
    if texts and set(texts) <= {"true", "false"}:
        return numpy.array([text == "true" for text in texts])
    if any("_" in text for text in texts):  # no number is written so, though Python reads some
        return numpy.array(texts)
    try:
        numbers = [int(text) for text in texts]
        if [str(number) for number in numbers] == texts:
            return numpy.array(numbers)
    except (ValueError, OverflowError):
        pass
    try:
        return numpy.array([float(text) if text else numpy.nan for text in texts])
    except ValueError:
        return numpy.array(texts)


class Result:
    """What a verb found. Everything is in SI.

    It owns its folder where no other was named with `out`: that then goes with it, so keep what is wanted with report() or
    save().
    """

    def __init__(self, verb: str, status: int, folder: str, own: Optional[str] = None) -> None:
        self.verb: str = verb  #: "montecarlo"
        self.status: int = status  #: exit status of the command: 0, or 1 where the answer is no
        self.folder: str = folder  #: "" of a verb that only prints
        if own is not None:
            weakref.finalize(self, shutil.rmtree, own, ignore_errors=True)
        self.summary: Dict[str, Any] = {}  #: summary.json; apps/boresight/summary.md says what is in it. Empty where a verb writes none
        path = os.path.join(folder, "summary.json")
        if folder and os.path.exists(path):
            with open(path, encoding="utf-8") as file:
                self.summary = json.load(file)

    @property
    def answer(self) -> bool:
        """False where the answer is no: a requirement not met, an accuracy not shown."""
        return self.status == 0

    @property
    def warnings(self) -> List[str]:
        return list(self.summary.get("warnings", []))

    @property
    def files(self) -> List[str]:
        """The names of all files in the folder."""
        return sorted(os.listdir(self.folder)) if self.folder else []

    def table(self, name: str) -> numpy.ndarray:
        """A table of the folder ("timeseries.csv") as a structured array, one field a column, text as str."""
        with open(os.path.join(self.folder, name), encoding="utf-8", newline="") as file:
            names, *rows = csv.reader(file)
        columns = ([numpy.array(texts) if name in _NAMES else _column(list(texts)) for name, texts in zip(names, zip(*rows))]
                   if rows else [numpy.empty(0) for _ in names])
        table = numpy.empty(len(rows), dtype=[(name, column.dtype) for name, column in zip(names, columns)])
        for name, column in zip(names, columns):
            table[name] = column
        return table

    def report(self, path: "str | os.PathLike[str]") -> str:
        """Writes the report, one file for a browser, and returns its path."""
        return shutil.copyfile(os.path.join(self.folder, "report.html"), path)

    def save(self, folder: "str | os.PathLike[str]") -> str:
        """Copies the whole folder, and returns the copy's path. FileExistsError where it exists."""
        return shutil.copytree(self.folder, folder)

    def _document(self) -> Dict[str, Any]:
        with open(os.path.join(self.folder, "report.json"), encoding="utf-8") as file:
            return json.load(file)

    def _repr_html_(self) -> str:
        if "report.json" not in self.files:
            return f"<p>{html.escape(repr(self))}</p>"
        document = self._document()
        rows = "".join(
            f"<tr><th style='text-align:left'>{html.escape(str(fact['label']))}</th>"
            f"<td>{html.escape(str(fact['value']))} {html.escape(str(fact.get('unit', '')))}</td>"
            f"<td>{html.escape(str(fact.get('note', '')))}</td></tr>"
            for fact in document.get("facts", []))
        warnings = "".join(f"<li>{html.escape(text)}</li>" for text in self.warnings)
        return (f"<h3>{html.escape(str(document.get('title', self.verb)))}</h3>"
                f"<p>{html.escape(str(document.get('subtitle', '')))}</p><table>{rows}</table>"
                + (f"<ul>{warnings}</ul>" if warnings else ""))

    def __repr__(self) -> str:
        return f"<Result of {self.verb}: {self.folder}{'' if self.answer else ', the answer is no'}>"
