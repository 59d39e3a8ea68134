"""Smooth ordinary differential equations to the last digits of a double: Gragg's midpoint rule, extrapolated.

Gragg (1965); Hairer, Norsett, Wanner, Solving Ordinary Differential Equations I, section II.9. Order 16 from the even
sequence 2, 4, ..., 16.
"""

_SEQUENCE = range(2, 18, 2)


def _midpoint(f, t, y, H, n):
    h = H / n
    before, now = y, [a + h * b for a, b in zip(y, f(t, y))]
    for k in range(1, n):
        slope = f(t + k * h, now)
        before, now = now, [a + 2.0 * h * b for a, b in zip(before, slope)]
    slope = f(t + H, now)
    return [0.5 * (a + b + h * c) for a, b, c in zip(before, now, slope)]


def step(f, t, y, H):
    """y(t + H) and by how much the last extrapolation changed it."""
    rows = []
    for j, n in enumerate(_SEQUENCE):
        row = [_midpoint(f, t, y, H, n)]
        for k in range(1, j + 1):
            ratio = (n / _SEQUENCE[j - k]) ** 2 - 1.0
            row.append([a + (a - b) / ratio for a, b in zip(row[k - 1], rows[j - 1][k - 1])])
        rows.append(row)
    return rows[-1][-1], max(abs(a - b) for a, b in zip(rows[-1][-1], rows[-1][-2]))


def solve(f, y, times, largest_step, tolerance=1e-12):
    """The states at `times`, the first being where it starts; steps no larger than `largest_step` end there exactly.
    `tolerance`: relative to the state's largest component, of one step."""
    states = [y]
    for begin, end in zip(times, times[1:]):
        count = max(1, round((end - begin) / largest_step + 0.5))
        for k in range(count):
            y, change = step(f, begin + (end - begin) * k / count, y, (end - begin) / count)
            size = max(1.0, max(abs(a) for a in y))
            if change > tolerance * size:
                raise ArithmeticError(f"a step of {(end - begin) / count} is too long: {change} off")
        states.append(y)
    return states
