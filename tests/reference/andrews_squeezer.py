"""Andrews' squeezing mechanism (IFToMM A03; Test Set for IVP Solvers, problem andrews) in one coordinate, the crank's angle.

Angles beta, theta, gamma, phi, delta, Omega, epsilon and the equations M q'' = f - G^T lambda, g(q) = 0 are the test set's. Its
three loops meet in one point E, so that all angles follow from beta by intersections of circles.
"""

from math import atan2, cos, hypot, sin, sqrt

from extrapolation import solve
from printing import fixed, row, table
from vectors import dot, solved

M1, M2, M3, M4, M5, M6, M7 = 0.04325, 0.00365, 0.02373, 0.00706, 0.07050, 0.00706, 0.05498
I1, I2, I3, I4, I5, I6, I7 = 2.194e-6, 4.410e-7, 5.255e-6, 5.667e-7, 1.169e-5, 5.667e-7, 1.912e-5
A, B, C = (-0.06934, -0.00227), (-0.03635, 0.03273), (0.014, 0.072)
D, DA, E, EA, RR, RA, SS, SA, SB, SC, SD = 0.028, 0.0115, 0.02, 0.01421, 0.007, 0.00092, 0.035, 0.01874, 0.01043, 0.018, 0.02
TA, TB, U, UA, UB, ZF, ZT, FA = 0.02308, 0.00916, 0.04, 0.01228, 0.00449, 0.02, 0.04, 0.01421
STIFFNESS, FREE_LENGTH, TORQUE = 4530.0, 0.07785, 0.033
START = (-0.0617138900142764, 0.0, 0.455279819163070, 0.222668390165886, 0.487364979543843, -0.222668390165886, 1.23054744454982)


def meeting(p, r, q, s, side):
    """Where circles of radius r about p and s about q meet, on the given side of the line from p to q."""
    dx, dy = q[0] - p[0], q[1] - p[1]
    d = hypot(dx, dy)
    along = (d * d + r * r - s * s) / (2.0 * d)
    across = side * sqrt(r * r - along * along)
    return p[0] + (along * dx - across * dy) / d, p[1] + (along * dy + across * dx) / d


def side_of(p, q, x):
    return 1.0 if (q[0] - p[0]) * (x[1] - p[1]) - (q[1] - p[1]) * (x[0] - p[0]) > 0.0 else -1.0


def points(q):
    """F on the crank, E, and the middle joints of the chains from A to E."""
    be, th, ga, ph, de, om, ep = q
    F = (RR * cos(be), RR * sin(be))
    end = (F[0] - D * cos(be + th), F[1] - D * sin(be + th))
    return F, end, (A[0] + ZT * cos(de), A[1] + ZT * sin(de)), (A[0] + U * sin(ep), A[1] - U * cos(ep))


_F, _E, _H, _G = points(START)
SIDES = (side_of(_F, B, _E), side_of(A, _E, _H), side_of(A, _E, _G))


def angles(be):
    F = (RR * cos(be), RR * sin(be))
    end = meeting(F, D, B, SS, SIDES[0])
    H, G = meeting(A, ZT, end, E, SIDES[1]), meeting(A, U, end, ZF, SIDES[2])
    th = atan2(F[1] - end[1], F[0] - end[0]) - be
    ga = atan2(end[0] - B[0], B[1] - end[1])
    de = atan2(H[1] - A[1], H[0] - A[0])
    ph = atan2(end[0] - H[0], H[1] - end[1]) - de
    ep = atan2(G[0] - A[0], A[1] - G[1])
    om = atan2(end[1] - G[1], end[0] - G[0]) - ep
    return [be, th, ga, ph, de, om, ep]


def loops(q):
    be, th, ga, ph, de, om, ep = q
    x, y = RR * cos(be) - D * cos(be + th), RR * sin(be) - D * sin(be + th)
    return [x - SS * sin(ga) - B[0], y + SS * cos(ga) - B[1], x - E * sin(ph + de) - ZT * cos(de) - A[0],
            y + E * cos(ph + de) - ZT * sin(de) - A[1], x - ZF * cos(om + ep) - U * sin(ep) - A[0],
            y - ZF * sin(om + ep) + U * cos(ep) - A[1]]


def jacobian(q):
    be, th, ga, ph, de, om, ep = q
    x2, y2 = D * sin(be + th), -D * cos(be + th)
    x1, y1 = -RR * sin(be) + x2, RR * cos(be) + y2
    ex, ey = -E * cos(ph + de), -E * sin(ph + de)
    zx, zy = ZF * sin(om + ep), -ZF * cos(om + ep)
    return [[x1, x2, -SS * cos(ga), 0, 0, 0, 0], [y1, y2, -SS * sin(ga), 0, 0, 0, 0],
            [x1, x2, 0, ex, ex + ZT * sin(de), 0, 0], [y1, y2, 0, ey, ey - ZT * cos(de), 0, 0],
            [x1, x2, 0, 0, 0, zx, zx - U * cos(ep)], [y1, y2, 0, 0, 0, zy, zy - U * sin(ep)]]


def second(q, v):
    """d/dt(G) v: what the loops' second derivatives are without accelerations."""
    be, th, ga, ph, de, om, ep = q
    b, bt, g, pd, d, oe, e = v[0], v[0] + v[1], v[2], v[3] + v[4], v[4], v[5] + v[6], v[6]
    x = -RR * cos(be) * b * b + D * cos(be + th) * bt * bt
    y = -RR * sin(be) * b * b + D * sin(be + th) * bt * bt
    return [x + SS * sin(ga) * g * g, y - SS * cos(ga) * g * g,
            x + E * sin(ph + de) * pd * pd + ZT * cos(de) * d * d, y - E * cos(ph + de) * pd * pd + ZT * sin(de) * d * d,
            x + ZF * cos(om + ep) * oe * oe + U * sin(ep) * e * e, y + ZF * sin(om + ep) * oe * oe - U * cos(ep) * e * e]


def mass(q):
    be, th, ga, ph, de, om, ep = q
    M = [[0.0] * 7 for _ in range(7)]
    M[0][0] = M1 * RA**2 + M2 * (RR**2 - 2 * DA * RR * cos(th) + DA**2) + I1 + I2
    M[0][1] = M[1][0] = M2 * (DA**2 - DA * RR * cos(th)) + I2
    M[1][1] = M2 * DA**2 + I2
    M[2][2] = M3 * (SA**2 + SB**2) + I3
    M[3][3] = M4 * (E - EA) ** 2 + I4
    M[3][4] = M[4][3] = M4 * ((E - EA) ** 2 + ZT * (E - EA) * sin(ph)) + I4
    M[4][4] = M4 * (ZT**2 + 2 * ZT * (E - EA) * sin(ph) + (E - EA) ** 2) + M5 * (TA**2 + TB**2) + I4 + I5
    M[5][5] = M6 * (ZF - FA) ** 2 + I6
    M[5][6] = M[6][5] = M6 * ((ZF - FA) ** 2 - U * (ZF - FA) * sin(om)) + I6
    M[6][6] = M6 * ((ZF - FA) ** 2 - 2 * U * (ZF - FA) * sin(om) + U**2) + M7 * (UA**2 + UB**2) + I6 + I7
    return M


def spring(q):
    ga = q[2]
    dx, dy = SD * cos(ga) + SC * sin(ga) + B[0] - C[0], SD * sin(ga) - SC * cos(ga) + B[1] - C[1]
    return dx, dy, hypot(dx, dy)


def force(q, v):
    be, th, ga, ph, de, om, ep = q
    dx, dy, length = spring(q)
    F = -STIFFNESS * (length - FREE_LENGTH) / length
    return [TORQUE - M2 * DA * RR * v[1] * (v[1] + 2 * v[0]) * sin(th), M2 * DA * RR * v[0] ** 2 * sin(th),
            F * dx * (SC * cos(ga) - SD * sin(ga)) + F * dy * (SD * cos(ga) + SC * sin(ga)),
            M4 * ZT * (E - EA) * v[4] ** 2 * cos(ph), -M4 * ZT * (E - EA) * v[3] * (v[3] + 2 * v[4]) * cos(ph),
            -M6 * U * (ZF - FA) * v[6] ** 2 * cos(om), M6 * U * (ZF - FA) * v[5] * (v[5] + 2 * v[6]) * cos(om)]


def along(q, v1):
    """Rates for a rate of beta, and the tangent."""
    G = jacobian(q)
    tangent = [1.0] + solved([r[1:] for r in G], [-r[0] for r in G])
    return tangent, [v1 * x for x in tangent]


def acceleration(be, rate):
    q = angles(be)
    tangent, v = along(q, rate)
    G = jacobian(q)
    bias = [0.0] + solved([r[1:] for r in G], [-x for x in second(q, v)])
    M, f = mass(q), force(q, v)
    M_tangent = [dot(r, tangent) for r in M]
    return (dot(tangent, f) - dot(M_tangent, bias)) / dot(M_tangent, tangent)


def energy(be, rate):
    q = angles(be)
    v = along(q, rate)[1]
    return 0.5 * dot(v, [dot(r, v) for r in mass(q)]) + 0.5 * STIFFNESS * (spring(q)[2] - FREE_LENGTH) ** 2 - TORQUE * be


assert max(abs(x) for x in loops(START)) < 1e-15
assert max(abs(sin(0.5 * (a - b))) for a, b in zip(angles(START[0]), START)) < 1e-7, angles(START[0])

times = [0.0, 0.001, 0.005, 0.010, 0.015, 0.020, 0.025, 0.030, 0.040, 0.050]
states = solve(lambda t, y: [y[1], acceleration(*y)], [START[0], 0.0], times, 2.5e-4, 1e-10)
table("crank", "t beta rate x y")
for t, (be, rate) in zip(times[1:], states[1:]):
    assert max(abs(x) for x in loops(angles(be))) < 1e-15
    assert abs(energy(be, rate) - energy(START[0], 0.0)) < 1e-11, energy(be, rate)
    row(t, fixed(be, 9), fixed(rate, 7), fixed(RR * cos(be), 11), fixed(RR * sin(be), 11))
table("energy", "E")
row(fixed(energy(START[0], 0.0), 13))
