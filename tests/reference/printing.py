"""How every generator prints its tables, and reads numbers back: what reference.hpp and check.py expect."""


def table(name, columns):
    print(f"table {name}: {columns}")


def row(*values):
    print(" ".join(str(v) for v in values))


def fixed(x, places):
    """With so many places after the point; no minus sign before a zero."""
    text = f"{x:.{places}f}"
    return text[1:] if text.startswith("-") and not text.strip("-0.") else text


def digits(x, count):
    """With so many significant digits."""
    return f"{x:.{count - 1}e}"
