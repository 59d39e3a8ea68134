"""Vectors, rotations and quaternions (scalar first) as lists, for the generators."""

from math import cos, sin


def add(*vectors):
    return [sum(c) for c in zip(*vectors)]


def minus(a, b):
    return [x - y for x, y in zip(a, b)]


def times(s, a):
    return [s * x for x in a]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def turned(axis, angle, v):
    """v turned about a unit axis (Rodrigues)."""
    c, s = cos(angle), sin(angle)
    return add(times(c, v), times(s, cross(axis, v)), times((1.0 - c) * dot(axis, v), axis))


def product(p, q):
    v = add(times(p[0], q[1:]), times(q[0], p[1:]), cross(p[1:], q[1:]))
    return [p[0] * q[0] - dot(p[1:], q[1:])] + v


def rotated(q, v):
    return product(product(q, [0.0] + list(v)), [q[0]] + times(-1.0, q[1:]))[1:]


def solved(A, b):
    """A x = b by elimination with the largest pivots."""
    n = len(b)
    M = [list(r) + [x] for r, x in zip(A, b)]
    for k in range(n):
        p = max(range(k, n), key=lambda i: abs(M[i][k]))
        M[k], M[p] = M[p], M[k]
        for i in range(k + 1, n):
            f = M[i][k] / M[k][k]
            M[i] = [a - f * c for a, c in zip(M[i], M[k])]
    x = [0.0] * n
    for k in reversed(range(n)):
        x[k] = (M[k][n] - sum(M[k][j] * x[j] for j in range(k + 1, n))) / M[k][k]
    return x
