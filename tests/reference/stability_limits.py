"""RK4 on x'' + 2 zeta beta x' + beta^2 x = 0, as Baumgarte's stabilisation is (alpha = zeta beta): largest stable beta h, and by what a
step multiplies the violation. R(z) = 1 + z + z^2/2 + z^3/6 + z^4/24 at the roots z of z^2 + 2 zeta b z + b^2 = 0.
"""

from cmath import sqrt

from printing import digits, fixed, row, table


def growth(alpha, beta):
    """Of alpha h and beta h: the larger |R|."""
    root = sqrt(alpha * alpha - beta * beta)
    return max(abs(1 + z + z**2 / 2 + z**3 / 6 + z**4 / 24) for z in (-alpha + root, -alpha - root))


def limit(zeta):
    """The least beta h at which growth is 1 again."""
    b = 0.0
    while growth(zeta * (b + 1e-3), b + 1e-3) < 1.0:
        b += 1e-3
    low, high = b, b + 1e-3
    for _ in range(60):
        middle = 0.5 * (low + high)
        if growth(zeta * middle, middle) < 1.0:
            low = middle
        else:
            high = middle
    return low


table("axes", "real imaginary")
low, high = 2.0, 3.0
for _ in range(60):
    middle = 0.5 * (low + high)
    low, high = (middle, high) if abs(1 - middle + middle**2 / 2 - middle**3 / 6 + middle**4 / 24) < 1.0 else (low, middle)
row(fixed(low, 13), fixed(8.0**0.5, 13))
table("baumgarte", "zeta limit")
for zeta in (0.05, 0.1, 0.2, 0.3, 0.5, 0.7071, 0.8, 0.9, 1.0, 1.25, 1.5, 2.0, 3.0, 5.0):
    row(zeta, fixed(limit(zeta), 7))
table("growth", "alpha_h beta_h growth")
for a, b in ((1.0, 2.0**0.5), (1.0, 1.0), (0.5, 0.5), (0.1, 0.1), (0.05, 0.05), (5e-5, 5e-5)):
    row(a, digits(b, 16), fixed(growth(a, b), 10))
