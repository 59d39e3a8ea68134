"""Bricard's mechanism of the IFToMM benchmarks (A04) in one coordinate.

Five bars of 1 m and 1 kg between two bearings, hinge axes y z x y z x. The linkage is symmetric three times over, so that its
hinges turn by a, -b, a, -b, a, -b with sin b = sin a / (1 + sin a); that its end stays at its bearing is checked here. What is
left is one equation of motion, Newton's and Euler's along the one freedom.
"""

from math import asin, cos, sin

from extrapolation import solve
from printing import fixed, row, table
from vectors import add, cross, dot, minus, times, turned

P = [[0, 0, 0], [1, 0, 0], [1, -1, 0], [1, -1, 1], [0, -1, 1], [0, 0, 1]]
AXES = [[0, 1, 0], [0, 0, 1], [1, 0, 0]]
GRAVITY = [0.0, -9.81, 0.0]
ALONG, ACROSS = 0.1**2 / 6.0, (1.0 + 0.1**2) / 12.0  # moments of inertia of a bar, 0.1 m square [kg m^2]


def chain(a):
    """Joints and bars at a: points, and per bar the direction, with rates and accelerations for unit a' and for a'^2."""
    sine = sin(a) / (1.0 + sin(a))
    b = asin(sine)
    # sin b = s: b' = s' / cos b, b'' = (s'' + sin b b'^2) / cos b.
    ds = cos(a) / (1.0 + sin(a)) ** 2
    dds = -sin(a) / (1.0 + sin(a)) ** 2 - 2.0 * cos(a) ** 2 / (1.0 + sin(a)) ** 3
    db = ds / cos(b)
    ddb = (dds + sine * db * db) / cos(b)
    points, bars = [[0.0, 0.0, 0.0]], []
    frame = [[1.0, 0, 0], [0, 1.0, 0], [0, 0, 1.0]]  # images of the axes at home
    w, bias = [0.0] * 3, [0.0] * 3
    v, v_bias = [0.0] * 3, [0.0] * 3
    for k in range(5):
        angle, rate, change = (a, 1.0, 0.0) if k % 2 == 0 else (-b, -db, -ddb)
        axis = add(*(times(c, f) for c, f in zip(AXES[k % 3], frame)))
        bias = add(bias, times(change, axis), times(rate, cross(w, axis)))
        w = add(w, times(rate, axis))
        frame = [turned(axis, angle, f) for f in frame]
        along = add(*(times(c, f) for c, f in zip(minus(P[k + 1], P[k]), frame)))
        reach = lambda s: (add(v, cross(w, times(s, along))),
                           add(v_bias, cross(bias, times(s, along)), cross(w, cross(w, times(s, along)))))
        bars.append({"along": along, "w": w, "bias": bias, "v": reach(0.5)[0], "v_bias": reach(0.5)[1]})
        v, v_bias = reach(1.0)
        points.append(add(points[-1], along))
        bars[-1]["end_rate"] = v
    return points, bars


def inertia_times(bar, x):
    along = dot(bar["along"], x)
    return add(times(ACROSS, x), times((ALONG - ACROSS) * along, bar["along"]))


def acceleration(a, rate):
    _, bars = chain(a)
    mass = force = 0.0
    for bar in bars:
        Lw = inertia_times(bar, bar["w"])
        mass += dot(bar["v"], bar["v"]) + dot(bar["w"], Lw)
        force += dot(bar["v"], GRAVITY) - rate**2 * (dot(bar["v"], bar["v_bias"]) + dot(bar["w"], inertia_times(bar, bar["bias"]))
                                                     + dot(bar["w"], cross(bar["w"], Lw)))
    return force / mass


def closed(a):
    end = chain(a)[0][5]
    assert max(abs(x - y) for x, y in zip(end, P[5])) < 1e-13, (a, end)


times_out = [0.0, 0.1, 0.2, 0.5, 0.8, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 8.0, 10.0]
states = solve(lambda t, y: [y[1], acceleration(*y)], [0.0, 0.0], times_out, 0.11)
for a, _ in states:
    closed(a)
table("far end of bar 2", "t x y z q1")
for t, (a, _) in zip(times_out[1:], states[1:]):
    row(t, *(fixed(x, 10) for x in chain(a)[0][2]), fixed(a, 10))
table("corner between bars 3 and 4", "t x y z")
for t in (1.0, 2.0):
    row(t, *(fixed(x, 10) for x in chain(states[times_out.index(t)][0])[0][3]))
table("velocity of the far end after 1 s", "vx vy vz")
a, rate = states[times_out.index(1.0)]
row(*(fixed(rate * x, 8) for x in chain(a)[1][1]["end_rate"]))
table("acceleration of the first hinge", "a")
row(fixed(acceleration(0.0, 0.0), 8))

# At rest again near 4.99 s: its rate there against its acceleration, by Newton's method.
t = 4.99
y = solve(lambda t, y: [y[1], acceleration(*y)], states[times_out.index(4.0)], [4.0, t], 0.1)[-1]
for _ in range(3):
    by = -y[1] / acceleration(*y)
    t, y = t + by, solve(lambda t, y: [y[1], acceleration(*y)], y, [t, t + by], 0.1)[-1]
table("period", "T")
row(fixed(t, 6))
