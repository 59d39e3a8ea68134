"""Quantiles, bounds and numbers of samples that the analyses' tests hold, from their definitions."""

from fractions import Fraction
from math import comb, erf, exp, gamma, pi, sqrt

from printing import fixed, row, table


def bisected(f, low, high):
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if f(middle) < 0.0 else (low, middle)
    return low


def normal_quantile(p):
    return bisected(lambda x: 0.5 * (1.0 + erf(x / sqrt(2.0))) - p, -9.0, 9.0)


def t_quantile(p, n):
    """Student's: the integral of its density from 0, by Simpson's rule."""
    density = lambda x: gamma(0.5 * (n + 1)) / (sqrt(n * pi) * gamma(0.5 * n)) * (1.0 + x * x / n) ** (-0.5 * (n + 1))

    def cdf(x, steps=2000):
        h = x / steps
        return 0.5 + h / 3.0 * (density(0.0) + density(x) + sum((4 if k % 2 else 2) * density(k * h) for k in range(1, steps)))

    return bisected(lambda x: cdf(x) - p, 0.0, 20.0)


def at_most(k, n, p):
    """P(X <= k) of n draws, exactly."""
    return sum(comb(n, i) * p**i * (1 - p) ** (n - i) for i in range(k + 1))


table("normal quantile", "p z")
for p in (0.95, 0.975, 0.99, 0.9973):
    row(p, fixed(normal_quantile(p), 9))
table("student quantile", "p degrees t")
for p, n in ((0.975, 9), (0.975, 2)):
    row(p, n, fixed(t_quantile(p, n), 9))
table("normal within one deviation", "P")
row(fixed(erf(sqrt(0.5)), 12))
# Deviation of a standard normal cut at three: sqrt(1 - 6 phi(3) / (2 Phi(3) - 1)).
table("deviation cut at three", "factor")
row(fixed(sqrt(1.0 - 6.0 * exp(-4.5) / sqrt(2.0 * pi) / erf(3.0 / sqrt(2.0))), 7))
# sqrt of chi-squared with three degrees of freedom: P = erf(x / sqrt(2)) - sqrt(2 / pi) x exp(-x^2 / 2).
table("chi of three", "p x")
row(0.95, fixed(bisected(lambda x: erf(x / sqrt(2.0)) - sqrt(2.0 / pi) * x * exp(-0.5 * x * x) - 0.95, 0.0, 9.0), 7))
# Wilks: the least n of which all but `failed` lie within with the confidence, P(more than `failed` beyond) >= confidence.
table("wilks", "share confidence failed n")
for confidence in ("0.90", "0.95"):
    for failed in (0, 1, 2):
        beyond = 1.0 - 0.9973
        n = failed + 1
        low, high = failed + 1, 10000
        while high - low > 1:
            n = (low + high) // 2
            low, high = (low, n) if at_most(failed, n, beyond) <= 1.0 - float(confidence) else (n, high)
        row("0.9973", confidence, failed, high)
# Clopper and Pearson (1934): 10 of 100 at 95 %.
table("clopper-pearson", "low high")
row(fixed(bisected(lambda p: 1.0 - at_most(9, 100, p) - 0.025, 0.0, 0.5), 8), fixed(bisected(lambda p: 0.025 - at_most(10, 100, p), 0.0, 0.5), 8))
# Order statistics 2 and 9 of 10 around the median.
table("median of ten", "coverage")
row(fixed(float(sum(comb(10, k) for k in range(2, 9)) * Fraction(1, 1024)), 12))
