"""Which scatter matters, and how likely is an error beyond the limit? Sobol' indices and FORM of OpenTURNS on a motion.

    PYTHONPATH=build/release/python python3 examples/python/reliability.py
"""

import os
import sys

import boresight
import openturns as ot

EXAMPLES = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..")
quick = "--quick" in sys.argv

# The pin of a four-bar lies on its sleeve: what it deviates by is smooth in its numbers.
mechanism = boresight.Mechanism(os.path.join(EXAMPLES, "four-bar", "four-bar.toml"))
f = boresight.Function(mechanism, ["clearance.D.radial", "clearance.D.contact.young", "gravity.z"],
                       index="position_error.rms", rung="quasistatic")
print(f)
function = boresight.openturns(f)

# The shaft is of steel and its housing of aluminium: the path of both sets one value, and f.nominal has none for it.
numbers = mechanism.parameters()
radial, young, gravity = numbers["clearance.D.radial"], 207e9, numbers["gravity.z"]
scatter = ot.JointDistribution if hasattr(ot, "JointDistribution") else ot.ComposedDistribution
distribution = scatter([ot.TruncatedNormal(radial, 0.1 * radial, 0.5 * radial, 1.5 * radial),
                        ot.Uniform(0.9 * young, 1.1 * young), ot.Normal(gravity, 0.01 * abs(gravity))])

# First-order and total Sobol' indices.
ot.RandomGenerator.SetSeed(1)
size = 64 if quick else 512
algorithm = ot.SaltelliSensitivityAlgorithm(distribution, size, function)
first, total = algorithm.getFirstOrderIndices(), algorithm.getTotalOrderIndices()
for name, s, t in zip(f.inputs, first, total):
    print(f"Sobol' indices of {name}: first {s:.3f}, total {t:.3f}")

# The probability that the error exceeds what 20 % more play would give.
limit = f([1.2 * radial, young, gravity])
event = ot.ThresholdEvent(ot.CompositeRandomVector(function, ot.RandomVector(distribution)), ot.Greater(), limit)
form = ot.FORM(ot.AbdoRackwitz(), event, distribution.getMean())
form.run()
result = form.getResult()
print(f"FORM: P(error > {1e6 * limit:.2f} um) = {result.getEventProbability():.4g}, "
      f"beta = {result.getHasoferReliabilityIndex():.3f}")
assert abs(result.getHasoferReliabilityIndex() - 2.0) < 0.2, "two sd of the play"
