"""Impacts of a mass on one contact F = K d^1.5 (1 + h d' / d'_0), in the form that needs no integration.

With v the approach speed over its first value and h the damping factor, K d^n d' (1 + h v) = -m v v' gives
    d^(n+1) K / ((n+1) m d'_0^2) = [ln((1 + h) / (1 + h v)) ... ] = (1 - v) / h - ln((1 + h) / (1 + h v)) / h^2,
zero again at v = -e: h (1 + e) = ln((1 + h) / (1 - h e)), whatever exponent, stiffness, mass and speed. Depth where v = 0; force and
duration by a search and a quadrature over v.
"""

from decimal import Decimal, getcontext
from math import exp, gamma, log, log1p, pi, sqrt

from printing import digits, fixed, row, table
from search import place_of_largest

getcontext().prec = 40

FACTORS = {  # damping factor h for the restitution asked for; the laws' own papers
    "hunt-crossley": lambda e: 1.5 * (1.0 - e),
    "herbert-mcwhannell": lambda e: 6.0 * (1.0 - e) / ((2.0 * e - 1.0) ** 2 + 3.0),
    "lee-wang": lambda e: 0.75 * (1.0 - e),
    "lankarani-nikravesh": lambda e: 0.75 * (1.0 - e * e),
    "gonthier": lambda e: (1.0 - e * e) / e,
    "zhiying-qishao": lambda e: 0.75 * (1.0 - e * e) * exp(2.0 * (1.0 - e)),
    "flores": lambda e: 8.0 * (1.0 - e) / (5.0 * e),
    "hu-guo": lambda e: 3.0 * (1.0 - e) / (2.0 * e),
    "carvalho-martins": lambda e: 1.5 * (1.0 - e) * (11.0 - e) / (1.0 + 9.0 * e),
}
ASKED = (0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95, 0.99)


def bisected(f, low, high):
    """A root of f between low, where it is negative, and high."""
    for _ in range(200):
        middle = (low + high) / 2
        if f(middle) < 0:
            low = middle
        else:
            high = middle
    return low


def returned(h):
    """e > 0 with h (1 + e) = ln((1 + h) / (1 - h e)): the difference is negative below the root beyond 0."""
    top = min(1.0, (1.0 - 1e-16) / h)
    return bisected(lambda e: log1p(h) - log1p(-h * e) - h * (1.0 + e) if e > 0.0 else -1.0, 0.0, top)


def exact_factor(e):
    """h that returns e, with 40 digits."""
    e = Decimal(repr(e))
    f = lambda h: h * (1 + e) - (1 + h).ln() + (1 - h * e).ln()
    # Positive between the trivial root 0 and the one looked for, beyond which it falls without bound towards 1 / e.
    return bisected(lambda h: -f(h), Decimal("1e-6"), (1 - Decimal("1e-30")) / e)


def energy(h, v):
    """K d^(n+1) / ((n+1) m d'_0^2) where the speed is v times the first."""
    return (1.0 - v) / h - (log1p(h) - log1p(h * v)) / h**2


def shape(h):
    """Depth, force and duration (over depth / speed) relative to the undamped impact with n = 1.5."""
    whole = 0.5  # of the undamped one: m v^2 / 2
    depth = (energy(h, 0.0) / whole) ** 0.4
    # The largest force over v.
    force = lambda v: (energy(h, v) / whole) ** 0.6 * (1.0 + h * v)
    fastest = place_of_largest(force, 0.0, 1.0 - 1e-12, 90)
    # dt = -m dv / F = -dv / (K d^1.5 (1 + h v) / m): over v from 1 to -e, d ~ energy^0.4; steep at both ends: v = ... by tanh-sinh.
    e = returned(h)
    K = 1.0 / 0.8  # such that the undamped depth is 1 for m = v = 1: K d^2.5 / 2.5 = 1/2
    total, step = 0.0, 1.0 / 64.0
    from math import cosh, sinh, tanh

    for k in range(-64 * 5, 64 * 5 + 1):
        s = k * step
        u = 0.5 * pi * sinh(s)
        x = tanh(u)
        weight = 0.5 * pi * cosh(s) / cosh(u) ** 2
        # v near its ends without cancellation: distance from 1 is (1 + e) / 2 (1 - x).
        to_end = 0.5 * (1.0 + e) * (2.0 / (exp(2.0 * u) + 1.0) if u > 0 else 1.0 - x)
        to_begin = 0.5 * (1.0 + e) * (2.0 / (exp(-2.0 * u) + 1.0) if u < 0 else 1.0 + x)
        d = depth_between(h, e, to_end, to_begin, K)
        if d <= 0.0:
            continue
        v = 1.0 - to_end
        total += weight * step * 0.5 * (1.0 + e) / (K * d**1.5 * (1.0 + h * v))
    return depth, force(fastest), total


def depth_between(h, e, from_first, from_last, K):
    """Where the speed lies so far below its first value and so far above its last, without cancellation at either."""
    if from_first < from_last:
        x = h * from_first / (1.0 + h)  # ln((1 + h) / (1 + h v)) = -ln(1 - x)
        value = (h * from_first + log1p(-x)) / h**2 if x > 1e-4 else (h * from_first - x - x * x / 2 - x**3 / 3 - x**4 / 4 - x**5 / 5) / h**2
    else:
        x = h * from_last / (1.0 - h * e)
        value = (log1p(x) - h * from_last) / h**2 if x > 1e-4 else (x - x * x / 2 + x**3 / 3 - x**4 / 4 + x**5 / 5 - h * from_last) / h**2
    return (2.5 * value / K) ** 0.4 if value > 0.0 else 0.0


table("returned", "law, for restitutions of " + " ".join(map(str, ASKED)))
for name, factor in FACTORS.items():
    row(name, *(fixed(returned(factor(e)), 5) for e in ASKED))
table("exact factors", "e h")
for e in ASKED:
    row(e, digits(float(exact_factor(e)), 14))
table("shape", "law e depth force duration")
for e, names in ((0.9, ("hunt-crossley", "lankarani-nikravesh", "gonthier", "flores", "hu-guo")), (0.7, ("lankarani-nikravesh", "flores")),
                 (0.5, ("hunt-crossley", "lankarani-nikravesh", "gonthier", "hu-guo", "flores")), (0.3, ("flores", "gonthier"))):
    for name in names:
        row(name, e, *(fixed(x, 6) for x in shape(FACTORS[name](e))))
# Undamped: depth (5 m v^2 / 4 K)^(2/5), duration 2 sqrt(pi) Gamma(2/5) / (5 Gamma(9/10)) of them, 2.9432...
span = 4.0 * sqrt(pi) * gamma(1.4) / (2.0 * gamma(0.9))
table("undamped duration over depth and speed", "c")
row(fixed(span, 10))
table("undamped", "mass speed depth force duration, K = 6.6102e10 N/m^1.5")
for m, v in ((1.0, 0.1), (0.1, 1.0), (1.0, 1.0)):
    d = (1.25 * m * v * v / 6.6102e10) ** 0.4
    row(m, v, digits(d, 7), digits(6.6102e10 * d**1.5, 7), digits(span * d / v, 7))
# Steel on steel (207 GPa, 0.3), bearing radius 10 mm: K = 4/3 E* sqrt(R), 1/R = 1/R_j - 1/R_s.
E = 207e9 / (2.0 * (1.0 - 0.3**2))
table("stiffness", "clearance K")
for c in (0.5e-3, 0.2e-3, 0.1e-3, 0.05e-3, 0.02e-3, 0.01e-3):
    row(c, digits(4.0 / 3.0 * E * sqrt(10e-3 * (10e-3 - c) / c), 7))
