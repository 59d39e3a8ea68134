"""The simple pendulum of the IFToMM benchmarks (A01): 1 kg on 1 m, released level, 9.81 m/s^2, in closed form.

sin(theta / 2) = -sin(pi / 4) cd(w0 t | 1/2), w0 = sqrt(9.81); the elliptic functions by Landen's descending
transformation (Abramowitz, Stegun, section 16.4).
"""

from math import asin, cos, pi, sin, sqrt

from printing import fixed, row, table

W0 = sqrt(9.81)
M = 0.5


def means(m):
    """a and c of the arithmetic-geometric mean of 1 and sqrt(1 - m)."""
    a, b, c = [1.0], sqrt(1.0 - m), [sqrt(m)]
    for _ in range(8):
        a_next, b_next = 0.5 * (a[-1] + b), sqrt(a[-1] * b)
        c.append(0.5 * (a[-1] - b))
        a.append(a_next)
        b = b_next
    return a, c


def sn_cn_dn(u, m):
    a, c = means(m)
    n = len(a) - 1  # the mean has settled to the last digit after five
    phi = 2.0**n * a[n] * u
    for k in range(n, 0, -1):
        phi = 0.5 * (phi + asin(c[k] / a[k] * sin(phi)))
    s = sin(phi)
    return s, cos(phi), sqrt(1.0 - m * s * s)


quarter = 0.5 * pi / means(M)[0][-1]  # K(1/2)

table("swing", "t x y vx vy")
for t in (0.1, 0.5, 1, 2, 3, 5, 7, 9.99, 10):
    s, c, d = sn_cn_dn(W0 * t, M)
    half_sine = -sqrt(M) * c / d
    half_cosine = sqrt(1.0 - half_sine**2)
    rate = 2.0 * sqrt(M) * (1.0 - M) * s / d**2 * W0 / half_cosine  # cd' = -(1 - m) sn / dn^2
    x, y = 2.0 * half_sine * half_cosine, -(half_cosine**2 - half_sine**2)
    row(t, fixed(x, 11), fixed(y, 11), fixed(-y * rate, 10), fixed(x * rate, 10))
table("period", "T")
row(fixed(4.0 * quarter / W0, 13))
