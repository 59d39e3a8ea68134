"""A free body by Euler's equations, and the heavy top of EXUDYN's benchmarks about its fixed point."""

from math import sqrt

from extrapolation import solve
from printing import fixed, row, table
from vectors import cross, dot, product, rotated, times


def turning(inertia, moment):
    """State: quaternion and angular velocity in body axes; moment(q) in body axes."""

    def derivative(t, y):
        q, w = y[:4], y[4:]
        L = [i * x for i, x in zip(inertia, w)]
        torque = moment(q)
        return times(0.5, product(q, [0.0] + w)) + [(m - g) / i for m, g, i in zip(torque, cross(w, L), inertia)]

    return derivative


def upright(q):
    """Its first number positive, on the sphere to the last digit."""
    n = sqrt(dot(q, q))
    return times((1.0 if q[0] > 0.0 else -1.0) / n, q)


# Moments of inertia 1, 2, 3 kg m^2, from rest of the axes with 1 rad/s about each.
table("free", "t wx wy wz qw qx qy qz")
ends = [0.0, 1.0, 10.0]
for t, y in zip(ends[1:], solve(turning([1.0, 2.0, 3.0], lambda q: [0.0] * 3), [1.0, 0, 0, 0, 1.0, 1.0, 1.0], ends, 0.1)[1:]):
    row(t, *(fixed(x, 10) for x in y[4:] + upright(y[:4])))

# 15 kg, its centre of mass 1 m along body y from the fixed point; moments about the centre of mass. Weight along world -z.
MASS, G, CENTER = 15.0, 9.81, [0.0, 1.0, 0.0]
about_center = [0.234375, 0.46875, 0.234375]
about_point = [about_center[0] + MASS, about_center[1], about_center[2] + MASS]


def weight(q):
    down = rotated([q[0]] + times(-1.0, q[1:]), [0.0, 0.0, -MASS * G])
    return cross(CENTER, down)


start = [1.0, 0.0, 0.0, 0.0, 0.0, 150.0, -4.61538]
ends = [0.0, 0.2, 0.5, 1.0, 2.0]
states = solve(turning(about_point, weight), start, ends, 0.004)
table("top orientation", "t qw qx qy qz")
row(ends[1], *(fixed(x, 8) for x in upright(states[1][:4])))
table("top position", "t x y z")
for t, y in zip(ends[2:], states[2:]):
    row(t, *(fixed(x, 10) for x in rotated(upright(y[:4]), CENTER)))
table("top energy", "E")
row(fixed(0.5 * sum(i * w * w for i, w in zip(about_point, start[4:])), 9))
