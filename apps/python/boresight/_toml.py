"""Mechanisms built in code: the file's own tables as dictionaries and lists."""

from __future__ import annotations

import json
from typing import Any, Mapping, Optional

from ._core import Mechanism


def _key(name: str) -> str:
    return name if name and all(c.isascii() and (c.isalnum() or c in "-_") for c in name) else json.dumps(name)


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, int):
        return repr(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_key(key)} = {_value(of)}" for key, of in value.items() if of is not None) + " }"
    if hasattr(value, "__iter__"):
        return "[" + ",\n  ".join(_value(one) for one in value) + "]"
    return repr(float(value))


def text_of(description: Mapping[str, Any]) -> str:
    """The description as a file's text, which errors name lines of."""
    return "".join(f"{_key(key)} = {_value(value)}\n" for key, value in description.items() if value is not None)


def mechanism_from_dict(
    description: Mapping[str, Any], name: str = "mechanism", settings: Optional[Mapping[str, Any]] = None
) -> Mechanism:
    """A mechanism from the tables of its file: {"format": 1, "body": [{"name": "crank", "mass": "1 kg", ...}], ...}.

    Keys and values are those of the file, quantities texts with their units; what has several tables ([[body]]) is a
    list. None is left out. name: what errors call it. Raises InputError; its line is that of text_of(description).
    """
    return Mechanism.from_text(text_of(description), name, dict(settings or {}))
