# SPDX-License-Identifier: Apache-2.0
"""Free flight of a rigid body in 60-digit arithmetic, by its Taylor series: the judge of the rest.

It shares nothing with the library but Euler's equations. Two of its own settings (order and step)
must agree to 45 digits before a test believes it. As a program it prints the table that the C++
tests hold: `python -m carom.studies.top_reference`.
"""

from __future__ import annotations

from mpmath import mp, mpf


def _product(f, g, n):
    return mp.fdot(f[: n + 1], reversed(g[: n + 1]))


def _value(series, t):
    total = mpf(0)
    for c in reversed(series):
        total = total * t + c
    return total


def fly(moments, q, w_body, seconds, *, digits=60, order=45, turn=1.0):
    """Principal moments, q x y z w (principal to world), body rates; each exact as given.

    Returns q at the end, four mpf. `turn`: radians per step.
    """
    with mp.workdps(digits):
        inertia = [mpf(m) for m in moments]
        b = [mpf(v) for v in w_body]
        x = [mpf(v) for v in q]
        norm = mp.sqrt(mp.fsum(v * v for v in x))
        x = [v / norm for v in x]
        ratio = [
            (inertia[1] - inertia[2]) / inertia[0],
            (inertia[2] - inertia[0]) / inertia[1],
            (inertia[0] - inertia[1]) / inertia[2],
        ]
        seconds = mpf(seconds)
        speed = mp.sqrt(mp.fsum(i * v * v for i, v in zip(inertia, b, strict=True)) / min(inertia))
        steps = max(1, int(mp.ceil(speed * abs(seconds) / turn)))
        h = seconds / steps
        for _ in range(steps):
            w = [[v] for v in b]
            p = [[v] for v in x]
            for n in range(order):
                f = 1 / mpf(n + 1)
                new_w = [
                    f * ratio[i] * _product(w[(i + 1) % 3], w[(i + 2) % 3], n) for i in range(3)
                ]
                c = [[_product(p[j], w[i], n) for i in range(3)] for j in range(4)]
                new_p = [
                    f / 2 * (c[3][0] + c[1][2] - c[2][1]),
                    f / 2 * (c[3][1] + c[2][0] - c[0][2]),
                    f / 2 * (c[3][2] + c[0][1] - c[1][0]),
                    -f / 2 * (c[0][0] + c[1][1] + c[2][2]),
                ]
                for series, v in zip(w + p, new_w + new_p, strict=True):
                    series.append(v)
            b = [_value(series, h) for series in w]
            x = [_value(series, h) for series in p]
        return x


def angle(a, b):
    """Angle between two orientations x y z w, rad, small ones too."""
    with mp.workdps(60):
        a, b = [mpf(v) for v in a], [mpf(v) for v in b]
        size = mp.sqrt(mp.fsum(v * v for v in a)) * mp.sqrt(mp.fsum(v * v for v in b))
        dot = mp.fsum(u * v for u, v in zip(a, b, strict=True)) / size
        cross = mp.fsum((a[i] * b[j] - a[j] * b[i]) ** 2 for i in range(4) for j in range(i))
        return float(2 * mp.atan2(mp.sqrt(cross) / size, abs(dot)))


#: name, principal moments kg m^2, body rates rad/s, seconds. Numbers exact in binary where it
#: matters, so that both sides start from the same body.
CASES = [
    ("asymmetric", (1, 2, 2.5), (1, 1, 1), 10),
    ("about_axis_1", (1, 2, 2.5), (2, 0.25, 0.125), 10),
    ("about_axis_3", (1, 2, 2.5), (0.125, 0.25, 2), 10),
    ("two_flips", (1, 2, 2.5), (2.0**-20, 1, 2.0**-20), 60),
    ("unstable_axis", (1, 2, 3), (1e-6, 2, -1e-6), 40),
    ("near_separatrix", (1, 2, 2.5), (1, 2.0**-8, 0.7302967433402214), 20),
    ("nearly_prolate", (1, 1 + 2.0**-30, 1.5), (1, 0.5, 0.25), 20),
    ("nearly_oblate", (0.75, 1.25, 1.25 + 2.0**-30), (0.25, 1, 0.5), 20),
    ("nearly_a_sphere", (1, 1 + 2.0**-40, 1 + 2.0**-39), (1, 2, 3), 10),
    ("flat_plate", (1, 2, 3), (1, 1, 1), 10),
    ("needle", (2.0**-10, 1, 1 + 2.0**-11), (50, 0.25, 0.125), 4),
    ("backwards", (1, 2, 2.5), (1, 1, 1), -10),
    ("fast", (1, 2, 2.5), (200, 100, 50), 1),
]


def main() -> None:
    print("// Printed by carom.studies.top_reference: 60-digit arithmetic.")
    for name, moments, w, seconds in CASES:
        q = fly(moments, (0, 0, 0, 1), w, seconds)
        values = ", ".join(mp.nstr(v, 20) for v in q)
        print(
            f'{{"{name}", {{{", ".join(map(repr, moments))}}}, '
            f"{{{', '.join(map(repr, w))}}}, {seconds}, {{{values}}}}},"
        )


if __name__ == "__main__":
    main()
