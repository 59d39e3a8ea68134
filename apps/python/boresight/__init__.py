"""Uncertainty and accuracy budgets of pointing mechanisms whose joints have play.

    import boresight as bs

    m = bs.Mechanism("antenna/mechanism.toml")
    run = bs.run(m, rung="perturbation")
    run.index["boresight_error"]["max"]          # rad
    run.boresight.displacement                   # (n, 3), m

    f = bs.Function(m, ["clearance.elevation.radial"], index="boresight_error.rms", rung="perturbation")
    f.batch(samples).values                      # samples (n, 1) in SI

    study = bs.montecarlo("antenna/montecarlo.toml")
    study.summary["index"]["p95"]["value"]
    study.report("report.html")

Everything is in SI. What is wrong with a file, a value or an option raises InputError, with its file, line and key.
"""

from ._core import (
    Batch,
    BodyHistory,
    ClearanceHistory,
    Function,
    Mechanism,
    Parameters,
    Run,
    __version__,
    run,
)
from ._errors import ComputationError, Error, InputError, ResultsError
from ._openturns import openturns
from ._results import Result
from ._toml import mechanism_from_dict
from ._verbs import (
    allocate,
    budget,
    calibrate,
    chart,
    check,
    convert,
    import_mechanism,
    laws,
    match,
    montecarlo,
    report_of_run,
    sensitivity,
    stability,
    sweep,
    verb,
)

__all__ = [
    "Batch", "BodyHistory", "ClearanceHistory", "ComputationError", "Error", "Function", "InputError", "Mechanism",
    "Parameters", "Result", "ResultsError", "Run", "__version__", "allocate", "budget", "calibrate", "chart", "check",
    "convert", "import_mechanism", "laws", "match", "mechanism_from_dict", "montecarlo", "openturns", "report_of_run", "run", "sensitivity",
    "stability", "sweep", "verb",
]
