"""A calibration with a plot of one's own: what was measured, and what the fitted mechanism does.

    PYTHONPATH=build/release/python python3 examples/python/calibration.py PLOT.html

Takes Debian's python3-plotly.
"""

import os
import sys

import boresight
import numpy
import plotly.graph_objects as graph

HERE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "calibration")

fit = boresight.calibrate(os.path.join(HERE, "calibrate.toml"))
optimum, interval = fit.summary["optimum"], fit.summary["interval"]
parameters = {path: value for path, value in optimum.items() if path.startswith("clearance.")}
for path, value in parameters.items():
    print(f"{path}: {value:.6g} ({interval[path]['low']:.6g} to {interval[path]['high']:.6g})")

# The run in the middle, followed with the fitted numbers.
measured = numpy.loadtxt(os.path.join(HERE, "middle.csv"), delimiter=",", skiprows=1)
rig = boresight.Mechanism(os.path.join(HERE, "rig.toml"), {"motion.drives.A": "2*pi*2.4*t"})
numbers = rig.parameters()
for path, value in parameters.items():
    numbers[path] = value
run = boresight.run(rig, numbers, rung="multibody", sample=1e-3)
fitted = 1e6 * (run.boresight.displacement[:, 0] + optimum["bias.dx"])  # um
rest = measured[:, 1] - numpy.interp(measured[:, 0], run.time, fitted)
print(f"dx of the run in the middle: {numpy.std(measured[:, 1]):.1f} um measured, {numpy.std(rest):.1f} um unexplained")

plot = graph.Figure([graph.Scatter(x=measured[:, 0], y=measured[:, 1], mode="markers", name="measured"),
                     graph.Scatter(x=run.time, y=fitted, name="fitted")])
plot.update_layout(xaxis_title="t [s]", yaxis_title="dx [um]")
if len(sys.argv) > 1:
    plot.write_html(sys.argv[1], include_plotlyjs=True)
