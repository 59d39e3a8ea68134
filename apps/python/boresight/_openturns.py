"""The index as a Function of OpenTURNS. It is loaded when it is asked for, and not before."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Optional, Sequence

import numpy

from ._errors import ComputationError, InputError

if TYPE_CHECKING:
    from ._core import Function


def openturns(f: "Function", gradient: str = "auto", steps: Optional[Sequence[float]] = None, jobs: int = 0) -> Any:
    """An openturns.Function from the inputs of f to its index, all in SI. Samples are computed as batches.

    gradient: "exact", that of f; "differences", centred ones of OpenTURNS over `steps`, one for each input; "auto": exact
        where f has one, else differences. Without steps they are a hundredth of the nominal values, which must not be 0.
    """
    import openturns as ot

    if gradient not in ("auto", "exact", "differences"):
        raise InputError(f'gradient: found "{gradient}", expected auto, exact or differences')
    if gradient == "exact" and f.why_no_gradient:
        raise ComputationError(f.why_no_gradient)
    exact = gradient == "exact" or (gradient == "auto" and not f.why_no_gradient)

    def of_sample(sample: Any) -> Any:
        values = f.batch(numpy.asarray(sample), jobs=jobs).values
        return values.reshape(-1, 1)

    def of_gradient(point: Any) -> Any:
        return [[float(slope)] for slope in f.gradient(numpy.asarray(point))]

    size = len(f.inputs)
    function = ot.PythonFunction(size, 1, func=lambda x: [f(numpy.asarray(x))], func_sample=of_sample,
                                 **({"gradient": of_gradient} if exact else {}))
    function.setInputDescription(f.inputs)
    function.setOutputDescription([f.index])
    if not exact:
        if steps is None:
            steps = [size / 100.0 for size in f.sizes]
            if not all(steps):
                raise InputError("steps: found none, expected one for each input, as a nominal value is 0")
        function.setGradient(ot.CenteredFiniteDifferenceGradient(list(steps), function.getEvaluation()))
    return function
