"""The slider-crank of Flores, Leine and Glocker (2010) in flight: crank and rod, and a block on the rod's end that turns with
nothing, until the block has used up the play of 1 mm in its guide; and the impulse that throws it back there.

Parameters from Siconos' sample. Lagrange's equations in the angles of crank and rod.
"""

from math import cos, pi, sin

from extrapolation import solve
from printing import fixed, row, table
from vectors import solved

L1, L2 = 0.153, 0.306
M1, M2, M3, J1, J2 = 0.038, 0.038, 0.076, 7.4e-5, 5.9e-4
G = 9.81


def mass(q1, q2):
    coupling = (0.5 * M2 + M3) * L1 * L2
    return ((J1 + (0.25 * M1 + M2 + M3) * L1**2, coupling * cos(q1 - q2)), (coupling * cos(q1 - q2), J2 + (0.25 * M2 + M3) * L2**2))


def derivative(t, y):
    q1, q2, u1, u2 = y
    s = (0.5 * M2 + M3) * L1 * L2 * sin(q1 - q2)
    a = solved(mass(q1, q2), [-s * u2**2 - (0.5 * M1 + M2 + M3) * G * L1 * cos(q1), s * u1**2 - (0.5 * M2 + M3) * G * L2 * cos(q2)])
    return [u1, u2] + a


def height(y):
    return L1 * sin(y[0]) + L2 * sin(y[1])


def rise(y):
    return L1 * cos(y[0]) * y[2] + L2 * cos(y[1]) * y[3]


START = [0.0, 0.0, 150.0, -75.0]


def after(t):
    return solve(derivative, START, [0.0, t], 2e-4)[-1]


table("flight", "t q1 q2 u1 u2")
for t in (1e-3, 2e-3):
    row(t, *(fixed(x, 10) for x in after(t)))
t = 2.7e-3
for _ in range(6):
    y = after(t)
    t -= (height(y) - 1e-3) / rise(y)
y = after(t)
table("contact", "t q1 q2 u1 u2 vy turns")
row(fixed(t, 12), *(fixed(x, 10) for x in y), fixed(rise(y), 9), fixed(y[0] / (2.0 * pi), 9))
# An impulse P down on the block changes the rates by M^-1 W P; it makes the rise -0.4 times what it was.
W = [L1 * cos(y[0]), L2 * cos(y[1])]
by = solved(mass(y[0], y[1]), W)
P = 1.4 * rise(y) / (W[0] * by[0] + W[1] * by[1])
table("impulse", "P u1 u2")
row(fixed(P, 9), fixed(y[2] - P * by[0], 8), fixed(y[3] - P * by[1], 8))
