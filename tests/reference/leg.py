"""The legs of the default mechanism (examples/3-rrcpr) along its motion, in closed form: how far its joints move, and how well its drives
hold the platform.

A leg's A axis leads from the origin down by atan(1 / sqrt(2)) = 35.264 degrees; then B, C, P along the rod, and F on the platform.
Conditioning: smallest over largest singular value of the map from the platform's angular velocity to the three A drives, and from the
velocity of its centre of mass to the three P drives, at the same orientation.
"""

from math import asin, atan, atan2, cos, degrees, hypot, pi, sin, sqrt

from printing import fixed, row, table
from vectors import add, cross, dot, minus, times, turned

ETA = -atan(1.0 / sqrt(2.0))
X, Y, Z = [1.0, 0, 0], [0, 1.0, 0], [0, 0, 1.0]


def pose(t):
    """Images of the axes, and the centre of mass."""
    psi, theta = 2.0 * pi * sin(pi * t), pi / 6.0 * sin(pi * t)
    turn = lambda v: turned(Z, psi, turned(Y, theta, turned(Z, -psi, v)))
    return turn, [0.5 * sin(theta) * cos(psi), 0.5 * sin(theta) * sin(psi), 0.5 * cos(theta) + 0.005 * sin(pi * t)]


def leg(i, t):
    """Angles and lengths of one leg: a, b, c, d, L."""
    turn, p = pose(t)
    around = lambda v: turned(Z, 2.0 * pi * i / 3.0, v)
    frame = [around(turned(Y, -ETA, v)) for v in (X, Y, Z)]  # x along the A axis
    local = lambda v: [dot(f, v) for f in frame]
    F = local(add(p, turn(around([0.3, 0.0, -0.04]))))
    u = local(turn(around(Y)))
    b, a = -asin(u[0]), atan2(u[2], u[1])
    w = turned(Z, -b, turned(X, -a, minus(F, [0.1 / cos(ETA), 0.0, 0.0])))
    return a, b, atan2(w[0], w[2]), w[1], hypot(w[0], w[2])


def inverse_condition(rows):
    """Smallest over largest singular value of three rows, by Jacobi's rotations of their Gram matrix."""
    A = [[dot(r, s) for s in rows] for r in rows]
    for _ in range(12):
        for p, q in ((0, 1), (0, 2), (1, 2)):
            if abs(A[p][q]) < 1e-300:
                continue
            angle = 0.5 * atan2(2.0 * A[p][q], A[p][p] - A[q][q])
            c, s = cos(angle), sin(angle)
            for k in range(3):
                A[p][k], A[q][k] = c * A[p][k] + s * A[q][k], c * A[q][k] - s * A[p][k]
            for k in range(3):
                A[k][p], A[k][q] = c * A[k][p] + s * A[k][q], c * A[k][q] - s * A[k][p]
    values = sorted(A[k][k] for k in range(3))
    return sqrt(max(values[0], 0.0) / values[2])


def conditioning(t):
    angle_rows, length_rows = [], []
    turn, p = pose(t)
    for i in range(3):
        around = lambda v: turned(Z, 2.0 * pi * i / 3.0, v)
        axis_A = around(turned(Y, -ETA, X))
        C_axis = turn(around(Y))  # of C and F, at right angles to B, which is at right angles to A
        axis_B = cross(axis_A, C_axis)
        axis_B = times(1.0 / sqrt(dot(axis_B, axis_B)), axis_B)
        # w = a' A + b' B + (c' + f') C: along what B and C leave free, n = B x C, w.n = a' A.n.
        n = cross(axis_B, C_axis)
        angle_rows.append(times(1.0 / dot(axis_A, n), n))
        # At the same orientation a' = b' = 0, and F moves with L along the rod, with d along C, with c' across it.
        C_point = times(0.1 / cos(ETA), axis_A)
        rod = minus(add(p, turn(around([0.3, 0.0, -0.04]))), C_point)
        rod = minus(rod, times(dot(rod, C_axis), C_axis))
        length_rows.append(times(1.0 / sqrt(dot(rod, rod)), rod))
    return inverse_condition(angle_rows), inverse_condition(length_rows)


steps = 500
all_legs = [leg(i, k / steps) for i in range(3) for k in range(steps + 1)]
table("ranges", "shortest longest slide swing_degrees")
row(fixed(min(x[4] for x in all_legs), 6), fixed(max(x[4] for x in all_legs), 6), fixed(max(abs(x[3]) for x in all_legs), 6),
    fixed(degrees(max(abs(x[1]) for x in all_legs)), 4))
table("conditioning", "orientation position")
along = [conditioning(k / steps) for k in range(steps + 1)]
row(fixed(min(x[0] for x in along), 6), fixed(min(x[1] for x in along), 6))
