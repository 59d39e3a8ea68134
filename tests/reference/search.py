"""Where a function of one number is largest, by golden section (Kiefer 1953, Proceedings of the AMS 4, 502-506)."""
from math import sqrt

RATIO = (sqrt(5.0) - 1.0) / 2.0


def place_of_largest(function, low, high, sections):
    for _ in range(sections):
        a, b = high - RATIO * (high - low), low + RATIO * (high - low)
        if function(a) < function(b):
            low = a
        else:
            high = b
    return 0.5 * (low + high)
