"""The slider-crank of Flores, Leine and Glocker (2010), whose slider has a play of 1 mm in its guide: rigid bodies, unilateral contact at the
slider's four corners with Newton's restitution and Coulomb's friction. What contact that gives way comes to as it grows stiff.

Parameters from Siconos' sample. Lagrange's equations in the angles of crank, rod and slider; the slider's centre of mass may lie off its pin.
Two schemes of Moreau and Jean:

  run        forces and masses at the middle of the step: of second order between impacts
  as_siconos theta 1/2 with the masses at the step's end and corners put back onto the guide, the scheme of Siconos' sample

Siconos prints 2,001 rows at steps of 0.1 ms (examples/mechanics/SliderCrank, SliderCrankMoreauJeanDirectProjectionOSI.ref). Table "scheme"
has the same figures by the same scheme; table "steps" what becomes of them as steps shorten. The scheme adds energy in flight, 1.5 J to 7.5 J
at 0.1 ms, which Siconos' rows show too: its revolutions carry that error.
"""

from math import cos, pi, sin

from printing import fixed, row, table

L1, L2 = 0.153, 0.306
HALF_LENGTH, HALF_HEIGHT, GAP = 0.05, 0.025, 0.001
M1, M2, M3, J1, J2, J3 = 0.038, 0.038, 0.076, 7.4e-5, 5.9e-4, 2.7e-6
G, RESTITUTION, FRICTION, DURATION = 9.81, 0.4, 0.01, 0.2
CORNERS = ((1, -1), (1, 1), (-1, -1), (-1, 1))  # side of the guide, end of the slider
START = ([0.0, 0.0, 0.0], [150.0, -75.0, 0.0])


def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def solved(m, r):
    (a, b, c), (_, e, f), (_, _, i) = m  # symmetric, by cofactors
    p, q, s = e * i - f * f, c * f - b * i, b * f - c * e
    det = a * p + b * q + c * s
    return [(r[0] * p + r[1] * q + r[2] * s) / det, (r[0] * q + r[1] * (a * i - c * c) + r[2] * (b * c - a * f)) / det,
            (r[0] * s + r[1] * (b * c - a * f) + r[2] * (a * e - b * b)) / det]


class SliderCrank:
    """ahead: of the slider's centre of mass before its pin, along the slider [m]."""

    def __init__(self, ahead=0.0):
        self.ahead = ahead

    def mass(self, q):
        pins, lever = (0.5 * M2 + M3) * L1 * L2 * cos(q[0] - q[1]), M3 * self.ahead
        with_crank, with_rod = lever * L1 * cos(q[0] - q[2]), lever * L2 * cos(q[1] - q[2])
        return ((J1 + (0.25 * M1 + M2 + M3) * L1**2, pins, with_crank), (pins, J2 + (0.25 * M2 + M3) * L2**2, with_rod),
                (with_crank, with_rod, J3 + M3 * self.ahead**2))

    def force(self, q, u):
        pins, lever = (0.5 * M2 + M3) * L1 * L2 * sin(q[0] - q[1]), M3 * self.ahead
        a, b = lever * L1 * sin(q[0] - q[2]), lever * L2 * sin(q[1] - q[2])
        return [-pins * u[1]**2 - a * u[2]**2 - (0.5 * M1 + M2 + M3) * G * L1 * cos(q[0]),
                pins * u[0]**2 - b * u[2]**2 - (0.5 * M2 + M3) * G * L2 * cos(q[1]),
                a * u[0]**2 + b * u[1]**2 - lever * G * cos(q[2])]

    def energy(self, q, u):
        m = self.mass(q)
        kinetic = 0.5 * sum(u[i] * dot(m[i], u) for i in range(3))
        return kinetic + G * ((0.5 * M1 + M2 + M3) * L1 * sin(q[0]) + (0.5 * M2 + M3) * L2 * sin(q[1]) + M3 * self.ahead * sin(q[2]))


def gaps(q):
    y, c, s = L1 * sin(q[0]) + L2 * sin(q[1]), cos(q[2]), sin(q[2])
    return [HALF_HEIGHT + GAP - side * (y + end * HALF_LENGTH * s) - HALF_HEIGHT * c for side, end in CORNERS]


def directions(q, corner):
    """Gradients of the gap and of the corner's place along the guide."""
    (side, end), c, s = CORNERS[corner], cos(q[2]), sin(q[2])
    return ([-side * L1 * cos(q[0]), -side * L2 * cos(q[1]), -side * end * HALF_LENGTH * c + HALF_HEIGHT * s],
            [-L1 * sin(q[0]), -L2 * sin(q[1]), -end * HALF_LENGTH * s - side * HALF_HEIGHT * c])


def push(v, by, size):
    for i in range(3):
        v[i] += size * by[i]


class Contact:
    def __init__(self, m, q, corner, approach, impulses):
        self.corner, self.approach = corner, approach
        self.normal, self.along = directions(q, corner)
        self.by_normal, self.by_along = solved(m, self.normal), solved(m, self.along)
        self.impulses = impulses  # normal, along

    def apply(self, v):
        push(v, self.by_normal, self.impulses[0])
        push(v, self.by_along, self.impulses[1])

    def improve(self, v):
        wanted = self.impulses[0] - (dot(self.normal, v) + RESTITUTION * self.approach) / dot(self.normal, self.by_normal)
        change = max(0.0, wanted) - self.impulses[0]
        self.impulses[0] += change
        push(v, self.by_normal, change)
        limit = FRICTION * self.impulses[0]
        rub = max(-limit, min(limit, self.impulses[1] - dot(self.along, v) / dot(self.along, self.by_along))) - self.impulses[1]
        self.impulses[1] += rub
        push(v, self.by_along, rub)
        return max(abs(change), abs(rub))


def impact(contacts, v):
    """Gauss and Seidel over the corners."""
    for contact in contacts:
        contact.apply(v)
    for _ in range(400):
        if max((contact.improve(v) for contact in contacts), default=0.0) < 1e-13:
            return


def run(system, h, duration=DURATION):
    """Yields t, q, u, the normal impulses of the four corners."""
    (q, u), normal = ([*START[0]], [*START[1]]), [0.0] * 4
    for k in range(round(duration / h)):
        middle = [q[i] + 0.5 * h * u[i] for i in range(3)]
        m, mean = system.mass(middle), u
        for _ in range(3):
            a = solved(m, system.force(middle, mean))
            mean = [u[i] + 0.5 * h * a[i] for i in range(3)]
        v = [u[i] + h * a[i] for i in range(3)]
        contacts = [Contact(m, middle, c, dot(directions(middle, c)[0], u), [normal[c], 0.0])
                    for c, gap in enumerate(gaps(middle)) if gap <= 0.0]
        impact(contacts, v)
        normal = [0.0] * 4
        for contact in contacts:
            normal[contact.corner] = contact.impulses[0]
        q, u = [middle[i] + 0.5 * h * v[i] for i in range(3)], v
        yield (k + 1) * h, q, u, normal


def put_back(system, q):
    m = system.mass(q)
    normals = [directions(q, c)[0] for c in range(4)]
    by, depth = [solved(m, n) for n in normals], gaps(q)
    multiplier, change = [0.0] * 4, [0.0] * 3
    for _ in range(300):
        for c in range(4):
            more = max(0.0, multiplier[c] - (depth[c] + dot(normals[c], change)) / dot(normals[c], by[c])) - multiplier[c]
            multiplier[c] += more
            push(change, by[c], more)
    return [q[i] + change[i] for i in range(3)]


def as_siconos(system, h):
    (q, u), normal = ([*START[0]], [*START[1]]), [0.0] * 4
    for k in range(round(DURATION / h)):
        before, v = system.force(q, u), u
        touching = {c: [normal[c], 0.0] for c, gap in enumerate(gaps(q)) if gap <= 1e-6}
        for _ in range(50):
            end = [q[i] + 0.5 * h * (u[i] + v[i]) for i in range(3)]
            m, after = system.mass(end), system.force(end, v)
            a = solved(m, [0.5 * (before[i] + after[i]) for i in range(3)])
            new = [u[i] + h * a[i] for i in range(3)]
            impact([Contact(m, end, c, dot(directions(q, c)[0], u), impulses) for c, impulses in touching.items()], new)
            moved, v = max(abs(new[i] - v[i]) for i in range(3)), new
            if moved < 1e-10:
                break
        normal = [touching[c][0] if c in touching else 0.0 for c in range(4)]
        q, u = [q[i] + 0.5 * h * (u[i] + v[i]) for i in range(3)], v
        for _ in range(20):
            if min(gaps(q)) > -1e-10:
                break
            q = put_back(system, q)
        yield (k + 1) * h, q, u, normal


# What Siconos' rows say: revolutions, lowest and highest crank speed, share of steps without impulse; and all others push adjacent corners.
SICONOS = (3.0543, 65.5206, 159.8124, 0.875)
MODES = ("none", "one", "adjacent", "opposite")


def mode(corners):
    return "adjacent" if corners in ((0, 1), (2, 3)) else ("none", "one", "opposite", "opposite", "opposite")[len(corners)]


def figures(system, motion, touching):
    """Revolutions, lowest and highest crank speed, energy gained in flight and lost in contact, shares of the modes in time."""
    energy, gained, lost, slowest, fastest = system.energy(*START), 0.0, 0.0, START[1][0], START[1][0]
    count, steps = dict.fromkeys(MODES, 0), 0
    for _, q, u, normal in motion:
        now = system.energy(q, u)
        if max(normal) > 0.0:
            lost += energy - now
        else:
            gained += now - energy
        energy, slowest, fastest, steps = now, min(slowest, u[0]), max(fastest, u[0]), steps + 1
        count[mode(touching(q, normal))] += 1
    return [q[0] / (2.0 * pi), slowest, fastest, gained, lost], [count[m] / steps for m in MODES]


def pushing(_, normal):
    return tuple(c for c in range(4) if normal[c] > 0.0)


def near(q, _):
    """At the guide: within a hundredth of the play."""
    return tuple(c for c, gap in enumerate(gaps(q)) if gap < 0.01 * GAP)


def strikes(system, h, duration, count):
    """When each corner strikes first after having left the guide: half a step early on average, which is taken off; and how fast."""
    away, found, speed = [True] * 4, [], START[1]
    for t, q, u, normal in run(system, h, duration):
        for c in range(4):
            if normal[c] > 0.0 and away[c]:
                found.append((t - 0.5 * h, c, -dot(directions(q, c)[0], speed)))
            away[c] = normal[c] == 0.0
        speed = u
    return found[:count]


def main():
    centred, ahead = SliderCrank(), SliderCrank(2e-3)
    values, shares = figures(centred, as_siconos(centred, 1e-4), pushing)
    for mine, theirs in zip([*values[:3], shares[0]], SICONOS):
        assert abs(mine - theirs) < 1e-3 * theirs, f"Siconos has {theirs}, the same scheme here {mine}"
    assert shares[1] == shares[3] == 0.0
    table("scheme", "revolutions slowest fastest gained lost none one adjacent opposite")
    row(fixed(values[0], 2), *(fixed(x, 1) for x in values[1:]), *(fixed(x, 2) for x in shares))
    table("steps", "h revolutions slowest fastest gained lost")
    for h in (5e-5, 2e-5, 1e-5):
        values = figures(centred, as_siconos(centred, h), pushing)[0]
        row(h, fixed(values[0], 2), *(fixed(x, 1) for x in values[1:]))
    table("limit", "revolutions slowest fastest gained lost none one adjacent; whether opposite corners ever touch at once")
    for name, system in (("centred", centred), ("ahead", ahead)):
        values, shares = figures(system, run(system, 1e-5), near)
        row(name, fixed(values[0], 2), *(fixed(x, 1) for x in values[1:]), *(fixed(x, 1) for x in shares[:3]), int(shares[3] > 0.0))
    for name, system, duration, count in (("centred", centred, 3e-3, 2), ("ahead", ahead, 4e-3, 5)):
        table("strikes " + name, "t corner speed")
        for t, corner, speed in strikes(system, 1e-6, duration, count):
            row(fixed(t, 6), corner, fixed(speed, 3))


if __name__ == "__main__":
    main()
