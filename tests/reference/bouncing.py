"""A ball that bounces with constant restitution, and what fixed steps of RK4 do to an elastic impact."""

from math import gamma, pi, sqrt

from printing import digits, fixed, row, table

G = 9.81
# Impacts at t_1 = sqrt(2 H / g), then each flight e times as long as the one before; at rest after t_1 (1 + e) / (1 - e).
table("ball", "height restitution rest, first impacts")
for height, e, count in ((1.0, 0.9, 4), (0.9, 0.9, 0), (1.0, 0.5, 3), (1.0, 0.7, 0)):
    first = sqrt(2.0 * height / G)
    impacts, t, flight = [], first, 2.0 * first * e
    for _ in range(count):
        impacts.append(t)
        t, flight = t + flight, flight * e
    row(height, e, fixed(first * (1.0 + e) / (1.0 - e), 9), *(fixed(x, 9) for x in impacts))

# x'' = K d^1.5, d = -x > 0, with so many steps in the contact of 2.94 depth / speed: root mean square of 1 - e over where in a step the
# contact begins. In units of depth and speed: K = 1.25.
SPAN = 4.0 * sqrt(pi) * gamma(1.4) / (2.0 * gamma(0.9))


def acceleration(x):
    return 1.25 * (-x) ** 1.5 if x < 0.0 else 0.0


def left(steps, phase):
    """Speed after the impact."""
    h = SPAN / steps
    x, v = h * phase, -1.0
    for _ in range(3 * steps):
        a1 = acceleration(x)
        a2 = acceleration(x + 0.5 * h * v)
        a3 = acceleration(x + 0.5 * h * (v + 0.5 * h * a1))
        a4 = acceleration(x + h * (v + 0.5 * h * a2))
        x, v = x + h * (v + h / 6.0 * (a1 + a2 + a3)), v + h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4)
    return v


table("fixed steps", "steps_in_contact error")
PHASES = 400
for steps in (5, 10, 20, 40, 80, 160):
    row(steps, digits(sqrt(sum((1.0 - left(steps, (k + 0.5) / PHASES)) ** 2 for k in range(PHASES)) / PHASES), 4))
