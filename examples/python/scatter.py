"""A Monte Carlo study in ten lines, on the samples' own array.

    PYTHONPATH=build/release/python python3 examples/python/scatter.py
"""

import os

import boresight
import numpy

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")

mechanism = boresight.Mechanism(os.path.join(EXAMPLES, "3-rrcpr", "3-rrcpr.toml"), {"motion.duration": "0.1 s"})
f = boresight.Function(mechanism, ["clearance.F1.radial", "payload.mass"], index="position_error.rms", rung="perturbation")
draw = numpy.random.default_rng(1)
samples = numpy.column_stack([draw.normal(0.1e-3, 0.01e-3, 200), draw.uniform(0.0, 50.0, 200)])  # m, kg
values = f.batch(samples).values
print(f"{f}: mean {1e6 * values.mean():.1f} um, sd {1e6 * values.std(ddof=1):.1f} um")
print(f"correlation with the clearance {numpy.corrcoef(samples[:, 0], values)[0, 1]:.2f}")
