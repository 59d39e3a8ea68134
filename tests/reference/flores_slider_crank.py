"""The slider-crank of Flores et al. (2006) with clearance between rod and slider: its first impacts, and its ideal motion in closed form.

Two coordinates, the rod's angle and the slider's position; a crank that turns evenly at 5000 rpm, no gravity. Between impacts the
motion is smooth and followed by extrapolation; within one F = K d^1.5 (1 + h d' / d'_0) begins and ends with d^1.5, and steps grow
from either end. The test holds the same problem in Cartesian coordinates, with a library that shares nothing with this.
"""

from math import atan2, cos, degrees, hypot, pi, sin, sqrt

from extrapolation import step
from printing import digits, fixed, row, table
from search import place_of_largest

BEARING, CLEARANCE = 0.01, 0.5e-3
JOURNAL = BEARING - CLEARANCE
CRANK, ROD = 0.05, 0.12
ROD_MASS, ROD_INERTIA, SLIDER = 0.21, 2.5e-4, 0.14
SPEED = 2.0 * pi * 5000.0 / 60.0
STIFFNESS = 4.0 / 3.0 * 207e9 / (2.0 * (1.0 - 0.3**2)) * sqrt(BEARING * JOURNAL / CLEARANCE)


class Motion:
    def __init__(self, damping_factor):
        self.h = damping_factor
        self.impact_speed = 1.0
        self.touching = False

    def contact(self, t, y):
        x = CRANK * cos(SPEED * t) + ROD * cos(y[0]) - y[1]
        z = CRANK * sin(SPEED * t) + ROD * sin(y[0])
        vx = -CRANK * SPEED * sin(SPEED * t) - ROD * sin(y[0]) * y[2] - y[3]
        vz = CRANK * SPEED * cos(SPEED * t) + ROD * cos(y[0]) * y[2]
        length = hypot(x, z) + 1e-30
        nx, nz = x / length, z / length
        depth, rate = length - CLEARANCE, vx * nx + vz * nz
        force = 0.0
        if self.touching and depth > 0.0:
            force = max(0.0, STIFFNESS * depth**1.5 * (1.0 + self.h * rate / self.impact_speed))
        return depth, rate, nx, nz, -vx * nz + vz * nx + y[2] * JOURNAL, force

    def __call__(self, t, y):
        _, _, nx, nz, _, force = self.contact(t, y)
        fx, fz = -force * nx, -force * nz
        ax, az = -CRANK * SPEED**2 * cos(SPEED * t), -CRANK * SPEED**2 * sin(SPEED * t)
        s, c = sin(y[0]), cos(y[0])
        moment = ROD * (c * fz - s * fx) - 0.5 * ROD_MASS * ROD * (c * az - s * ax)
        return [y[2], y[3], moment / (ROD_INERTIA + 0.25 * ROD_MASS * ROD**2), -fx / SLIDER]

    def crossing(self, t, y, H):
        """The part of a step of flight after which the journal touches: by bisection, and regula falsi where that is quicker."""
        depth = lambda s: self.contact(t + s, step(self, t, y, s)[0])[0]
        low, high, below, above = 0.0, H, self.contact(t, y)[0], depth(H)
        for k in range(60):
            s = low - below * (high - low) / (above - below) if k % 2 else 0.5 * (low + high)
            value = depth(s)
            if value <= 0.0:
                low, below = s, value
            else:
                high, above = s, value
            if above < 1e-19 or high - low < 1e-18:
                break
        return high

    def peak(self, which, t, y, H):
        """The largest value of one of the contact's numbers within a step."""
        value = lambda s: self.contact(t + s, step(self, t, y, s)[0])[which]
        return value(place_of_largest(value, 0.0, H, 24))

    def events(self, duration):
        """Contacts that end before `duration`: start, angle of the normal, speed, sliding, duration, depth, force, speed at the end."""
        t, y, out = 0.0, [0.0, CRANK + ROD, -CRANK * SPEED / ROD, 0.0], []
        while t < duration:
            # In flight: steps of up to a six-hundredth of a turn of the crank.
            self.touching, H = False, 2e-6
            while t < duration:
                new = step(self, t, y, H)[0]
                if self.contact(t + H, new)[0] > 0.0:
                    H = self.crossing(t, y, H)
                    y = step(self, t, y, H)[0]
                    t += H
                    break
                t, y = t + H, new
                H = min(1.5 * H, 2e-5)
            if t >= duration:
                break
            _, rate, nx, nz, sliding, _ = self.contact(t, y)
            self.impact_speed, self.touching = rate, True
            start, deepest, hardest = t, 0.0, 0.0
            first = [t, degrees(atan2(nz, nx)), rate, sliding]
            # In contact: from 1e-13 s on by tenths of what has passed, and down again towards the end.
            H, before = 1e-13, None
            while True:
                depth, rate, *_, force = self.contact(t, y)
                if rate < 0.0 and depth > 0.0:
                    H = min(H, 0.1 * depth / -rate)
                    if depth < 1e-13:
                        break
                new = step(self, t, y, H)[0]
                d, new_rate, *_, f = self.contact(t + H, new)
                if d <= 0.0:
                    H *= 0.5
                    continue
                if rate >= 0.0 > new_rate:
                    deepest = max(deepest, self.peak(0, t, y, H))
                if before is not None and f < force and force > hardest:
                    hardest = max(self.peak(-1, *before), self.peak(-1, t, y, H))
                before = (t, y, H)
                t, y = t + H, new
                H = min(1.15 * H, 4e-7)
            t += self.contact(t, y)[0] / -self.contact(t, y)[1]  # the last 1e-13 m
            out.append(first + [t - start, deepest, hardest, -self.contact(t, y)[1]])
        return out


def event_table(name, damping_factor, duration):
    table(name, "start normal speed sliding duration depth force end_speed")
    for e in Motion(damping_factor).events(duration):
        row(digits(e[0], 9), fixed(e[1], 5), fixed(e[2], 7), fixed(e[3], 5), digits(e[4], 6), digits(e[5], 6), digits(e[6], 7), fixed(e[7], 7))


def ideal():
    """At degrees: the slider's acceleration; largest and smallest of what the ideal motion has, on a fine grid refined by parabolas."""
    L, r, w = ROD, CRANK, SPEED

    def at(angle):
        """Slider's speed and acceleration, force between rod and slider, moment on the crank."""
        s, c = sin(angle), cos(angle)
        root = sqrt(L * L - r * r * s * s)
        rod, turn = -r * s / L, -r * w * c / root  # sine of the rod's angle, its rate
        # Slider x = r cos + root: its derivatives by those of root^2 = L^2 - r^2 sin^2.
        root1 = -r * r * s * c * w / root
        root2 = (-r * r * (c * c - s * s) * w * w - root1 * root1) / root
        v, a = -r * w * s + root1, -r * w * w * c + root2
        # Along the guide the pin pushes the slider; across it turns the rod about its crank pin, which accelerates.
        fx = SLIDER * a
        cosine, sine = root / L, rod
        turning = (r * w * w * s / L + sine * turn * turn) / cosine
        pin_x, pin_z = -r * w * w * c, -r * w * w * s
        I = ROD_INERTIA + 0.25 * ROD_MASS * L * L
        fz = (I * turning + 0.5 * ROD_MASS * L * (cosine * pin_z - sine * pin_x)) / L / cosine - sine * fx / cosine
        # Power of the drive over the speed: kinetic energy of rod and slider.
        cx, cz = -r * w * s - 0.5 * L * sine * turn, r * w * c + 0.5 * L * cosine * turn
        cax = -r * w * w * c - 0.5 * L * (cosine * turn * turn + sine * turning)
        caz = -r * w * w * s + 0.5 * L * (cosine * turning - sine * turn * turn)
        moment = (ROD_MASS * (cx * cax + cz * caz) + ROD_INERTIA * turn * turning + SLIDER * v * a) / w
        return v, a, hypot(fx, fz), moment

    table("ideal slider", "degrees speed acceleration")
    for k in range(7):
        v, a, *_ = at(30.0 * k * pi / 180.0)
        row(30 * k, fixed(v, 6), fixed(a, 4))

    def extreme(f, low, high):
        """Largest value and where, in degrees: a grid, then golden section."""
        best = max((low + (high - low) * k / 720.0 for k in range(721)), key=lambda d: f(d * pi / 180.0))
        a, b = best - (high - low) / 720.0, best + (high - low) / 720.0
        ratio = (sqrt(5.0) - 1.0) / 2.0
        for _ in range(60):
            x, y = b - ratio * (b - a), a + ratio * (b - a)
            a, b = (x, b) if f(x * pi / 180.0) < f(y * pi / 180.0) else (a, y)
        return f(0.5 * (a + b) * pi / 180.0), 0.5 * (a + b)

    table("ideal extremes", "value degrees")
    for name, f, low, high in (("fastest", lambda q: -at(q)[0], 0.0, 180.0), ("highest", lambda q: at(q)[1], 180.0, 360.0),
                               ("lowest", lambda q: -at(q)[1], -90.0, 90.0), ("pin", lambda q: at(q)[2], 0.0, 360.0),
                               ("largest_moment", lambda q: at(q)[3], 0.0, 360.0), ("smallest_moment", lambda q: -at(q)[3], 0.0, 360.0)):
        value, where = extreme(f, low, high)
        row(name, digits(value, 8), fixed(where, 2))


if __name__ == "__main__":
    e = 0.9
    event_table("lankarani-nikravesh", 0.75 * (1.0 - e * e), 4.2e-3)
    event_table("flores", 1.6 * (1.0 - e) / e, 0.83e-3)
    event_table("hertz", 0.0, 0.75e-3)
    ideal()
