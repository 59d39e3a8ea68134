"""What can go wrong."""


class Error(Exception):
    """Any error of this package."""


class InputError(Error, ValueError):
    """A file, a setting, an option or a value that is refused.

    str() is one line: FILE:LINE: KEY: found FOUND, expected EXPECTED.
    """

    file: str = ""  #: as it was named; "command line" of settings and options; "" of values
    line: int = 0  #: from 1; 0: of no line
    key: str = ""  #: what the value was given to: "clearance.F1.radial"
    found: str = ""
    expected: str = ""
    nearest: str = ""  #: the name that may have been meant; "": none


class ComputationError(Error, RuntimeError):
    """A motion that cannot be followed, or a study that failed: what, when, and what to do."""


class ResultsError(Error, OSError):
    """A folder of results that cannot be used: another study's, one in use, one that cannot be written."""
