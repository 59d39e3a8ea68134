"""The double four-bar of the IFToMM benchmarks (A02, N = 2): five rods of 1 m and 1 kg, pushed over by 1 m/s.

On the right branch the three cranks turn alike: 3 phi'' = 3.5 g sin phi, phi(0) = 0, phi'(0) = 1, phi from the upright.
Hence phi'^2 = 1 + (7/3) g (1 - cos phi), and times by quadrature.
"""

from math import cos, pi, sin, sqrt

from extrapolation import solve
from printing import fixed, row, table

G = 9.81


def rate_at(phi):
    return sqrt(1.0 + 7.0 / 3.0 * G * (1.0 - cos(phi)))


def simpson_extrapolated(f, a, b, levels=14):
    """Romberg's rule."""
    rows = [[0.5 * (b - a) * (f(a) + f(b))]]
    for k in range(1, levels):
        h = (b - a) / 2**k
        new = [0.5 * rows[-1][0] + h * sum(f(a + (2 * i + 1) * h) for i in range(2 ** (k - 1)))]
        for j in range(1, k + 1):
            new.append(new[-1] + (new[-1] - rows[-1][j - 1]) / (4**j - 1))
        rows.append(new)
        if k > 6 and abs(new[-1] - rows[-2][-1]) < 1e-15:
            break
    return rows[-1][-1]


times = [0.0, 0.5, 1.0, 2.0, 3.0, 4.0, 5.0, 8.0, 10.0]
states = solve(lambda t, y: [y[1], 3.5 * G * sin(y[0]) / 3.0], [0.0, 1.0], times, 0.05)
table("crank", "t phi rate x y vx vy")
for t, (phi, rate) in zip(times[1:], states[1:]):
    row(t, fixed(phi, 9), fixed(rate, 9), fixed(sin(phi), 9), fixed(cos(phi), 9), fixed(cos(phi) * rate, 9),
        fixed(-sin(phi) * rate, 9))
table("times", "level revolution fastest")
row(fixed(simpson_extrapolated(lambda x: 1.0 / rate_at(x), 0.0, 0.5 * pi), 12),
    fixed(2.0 * simpson_extrapolated(lambda x: 1.0 / rate_at(x), 0.0, pi), 12), fixed(rate_at(pi), 12))
