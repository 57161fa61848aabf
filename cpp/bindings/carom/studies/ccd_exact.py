# SPDX-License-Identifier: Apache-2.0
"""Exact answers for moving triangles and edges, by a route of its own.

The library classifies signs of quadratics in closed form; here roots of the coplanarity cubic are
isolated by Sturm sequences and refined until quartics are sign-definite, with polynomial gcds for
exact zeros. Python integers throughout: no rounding, no shared code.
"""

from __future__ import annotations

from fractions import Fraction
from math import gcd

# A polynomial is a list of integers, ascending powers, without trailing zeros; [] is 0.


def trim(p):
    while p and p[-1] == 0:
        p.pop()
    return p


def add(p, q):
    if len(p) < len(q):
        p, q = q, p
    return trim([a + (q[i] if i < len(q) else 0) for i, a in enumerate(p)])


def sub(p, q):
    return add(p, [-b for b in q])


def mul(p, q):
    if not p or not q:
        return []
    r = [0] * (len(p) + len(q) - 1)
    for i, a in enumerate(p):
        for j, b in enumerate(q):
            r[i + j] += a * b
    return trim(r)


def primitive(p):
    g = gcd(*p)
    return [a // g for a in p] if g > 1 else p


def remainder(p, q):
    """A positive multiple of p mod q."""
    p = list(p)
    lead, sign = abs(q[-1]), 1 if q[-1] > 0 else -1
    while len(p) >= len(q):
        top, shift = p[-1] * sign, len(p) - len(q)
        p = [a * lead for a in p]
        for i, b in enumerate(q):
            p[i + shift] -= top * b
        trim(p)
    return primitive(p) if p else p


def common_divisor(p, q):
    while q:
        p, q = q, remainder(p, q)
    return primitive(p)


def quotient(p, q):
    """p / q for q dividing p, up to a positive factor."""
    p, out = [Fraction(a) for a in p], [Fraction(0)] * (len(p) - len(q) + 1)
    for shift in range(len(out) - 1, -1, -1):
        out[shift] = p[shift + len(q) - 1] / q[-1]
        for i, b in enumerate(q):
            p[i + shift] -= out[shift] * b
    scale = 1
    for a in out:
        scale = scale * a.denominator // gcd(scale, a.denominator)
    return primitive([int(a * scale) for a in out])


def derivative(p):
    return trim([i * a for i, a in enumerate(p)][1:])


def sign_at(p, num, bits):
    """The sign of p(num / 2^bits)."""
    total = 0
    for i in range(len(p) - 1, -1, -1):
        total = total * num + (p[i] << (bits * (len(p) - 1 - i)))
    return (total > 0) - (total < 0)


def sturm_sequence(p):
    s = [p, derivative(p)]
    while s[-1]:
        r = remainder(s[-2], s[-1])
        if not r:
            break
        s.append([-a for a in r])
    return s


def variations(s, num, bits):
    count, before = 0, 0
    for p in s:
        here = sign_at(p, num, bits)
        if here:
            count += here * before < 0
            before = here
    return count


def bounds_on(p, low, high, bits):
    """Whether p is sign-definite on [low, high] / 2^bits, by its Bernstein coefficients."""
    n = len(p) - 1
    width, q = high - low, []
    for i in range(n, -1, -1):  # Horner on p(low + width x), scaled by 2^(bits n)
        shifted = [0] * (len(q) + 1)
        for j, a in enumerate(q):
            shifted[j] += a * low
            shifted[j + 1] += a * width
        shifted[0] += p[i] << (bits * (n - i))
        q = shifted
    coefficients = bernstein(q, n)
    positive = all(b > 0 for b in coefficients)
    negative = all(b < 0 for b in coefficients)
    return 1 if positive else -1 if negative else 0


BINOMIAL = [[1], [1, 1], [1, 2, 1], [1, 3, 3, 1], [1, 4, 6, 4, 1], [1, 5, 10, 10, 5, 1]]
LCM = [1, 1, 2, 3, 12, 10]


def bernstein(q, n):
    """Bernstein coefficients times a positive number."""
    row, scale = BINOMIAL[n], LCM[n]
    return [
        sum(BINOMIAL[k][i] * q[i] * scale // row[i] for i in range(min(k, len(q) - 1) + 1))
        for k in range(n + 1)
    ]


class Root:
    """A root in [0, 1] of a square-free polynomial: exact dyadic, or alone in (low, high)."""

    def __init__(self, p, low, high, bits):
        self.p, self.low, self.high, self.bits = p, low, high, bits
        self.sign_low = None if low == high else sign_at(p, low, bits)

    def refine(self):
        if self.low == self.high:
            return
        self.low, self.high, self.bits = 2 * self.low, 2 * self.high, self.bits + 1
        middle = (self.low + self.high) // 2
        s = sign_at(self.p, middle, self.bits)
        if s == 0:
            self.low = self.high = middle
        elif s == self.sign_low:
            self.low = middle
        else:
            self.high = middle

    def sign_of(self, q):
        """The sign of q at this root."""
        if not q:
            return 0
        if self.low == self.high:
            return sign_at(q, self.low, self.bits)
        decided = bounds_on(q, self.low, self.high, self.bits)
        if decided:
            return decided
        g = common_divisor(self.p, q)
        if len(g) > 1 and self.vanishes(g):
            return 0
        while True:
            self.refine()
            if self.low == self.high:
                return sign_at(q, self.low, self.bits)
            decided = bounds_on(q, self.low, self.high, self.bits)
            if decided:
                return decided

    def vanishes(self, g):
        """Whether the divisor g of the square-free p has this root: a sign change of g says so."""
        if self.low == self.high:
            return sign_at(g, self.low, self.bits) == 0
        return sign_at(g, self.low, self.bits) * sign_at(g, self.high, self.bits) < 0

    def minus(self, t: float):
        """The sign of root - t."""
        num, den = t.as_integer_ratio()
        return self.sign_of([-num, den])

    def narrower_than(self, bits):
        while self.low != self.high and self.bits < bits:
            self.refine()
        return Fraction(self.low, 1 << self.bits), Fraction(self.high, 1 << self.bits)


def roots_in_unit_interval(p):
    """Distinct roots of p != 0 in [0, 1], ascending."""
    if len(p) <= 1:
        return []
    square_free = p
    g = common_divisor(p, derivative(p))
    if len(g) > 1:
        square_free = quotient(p, g)
    s = sturm_sequence(square_free)
    found = []
    if sign_at(square_free, 0, 0) == 0:
        found.append(Root(square_free, 0, 0, 0))

    # cells (low, high] / 2^bits with the sign variations at their ends, earliest on top
    stack = [(0, 1, 0, variations(s, 0, 0), variations(s, 1, 0))]
    while stack:
        low, high, bits, v_low, v_high = stack.pop()
        count = v_low - v_high
        if count == 0:
            continue
        if sign_at(square_free, high, bits) == 0:
            if count == 1:
                found.append(Root(square_free, high, high, bits))
                continue
        elif count == 1 and sign_at(square_free, low, bits) != 0:
            found.append(Root(square_free, low, high, bits))
            continue
        middle = low + high
        v = variations(s, middle, bits + 1)
        stack.append((middle, 2 * high, bits + 1, v, v_high))
        stack.append((2 * low, middle, bits + 1, v_low, v))
    return found


def as_integers(query):
    """24 doubles as integers on one common grid (scaling changes no answer)."""
    ratios = [float(x).as_integer_ratio() for x in query]
    top = max(d for _, d in ratios)
    return [n * (top // d) for n, d in ratios]


def vec(s, e):
    return [trim([a, b - a]) for a, b in zip(s, e, strict=True)]


def vsub(a, b):
    return [sub(x, y) for x, y in zip(a, b, strict=True)]


def cross(a, b):
    return [
        sub(mul(a[1], b[2]), mul(a[2], b[1])),
        sub(mul(a[2], b[0]), mul(a[0], b[2])),
        sub(mul(a[0], b[1]), mul(a[1], b[0])),
    ]


def dot(a, b):
    return add(add(mul(a[0], b[0]), mul(a[1], b[1])), mul(a[2], b[2]))


def segments_touch_origin(r, edges):
    """Whether the origin is on one of the closed segments (a, b) at root r."""
    for a, b in edges:
        if all(r.sign_of(c) == 0 for c in cross(a, b)) and r.sign_of(dot(a, b)) <= 0:
            return True
    return False


def first_contact(kind, query):
    """None, or the Root at which the closed primitives first share a point in [0, 1].

    kind: "point_triangle" or "edge_edge"; query: (8, 3).
    """
    q = as_integers(query.reshape(-1).tolist())
    p = [vec(q[3 * i : 3 * i + 3], q[12 + 3 * i : 15 + 3 * i]) for i in range(4)]
    if kind == "point_triangle":
        corners = [vsub(p[i], p[0]) for i in (1, 2, 3)]
        normal = cross(vsub(p[2], p[1]), vsub(p[3], p[1]))
        f = dot(corners[0], normal)
    else:
        corners = [vsub(p[0], p[2]), vsub(p[1], p[2]), vsub(p[1], p[3]), vsub(p[0], p[3])]
        d, e, w = vsub(p[1], p[0]), vsub(p[3], p[2]), vsub(p[2], p[0])
        normal = cross(d, e)
        f = dot(w, normal)
    n = len(corners)
    edges = [(corners[i], corners[(i + 1) % n]) for i in range(n)]

    def contact(r):
        if any(r.sign_of(c) != 0 for c in normal):
            if kind == "point_triangle":
                return all(r.sign_of(dot(cross(a, b), normal)) >= 0 for a, b in edges)
            nn = dot(normal, normal)
            s, t = dot(cross(w, e), normal), dot(cross(w, d), normal)
            return (
                r.sign_of(s) >= 0
                and r.sign_of(t) >= 0
                and r.sign_of(sub(nn, s)) >= 0
                and r.sign_of(sub(nn, t)) >= 0
            )
        return segments_touch_origin(r, edges)

    if f:
        return next((r for r in roots_in_unit_interval(primitive(f)) if contact(r)), None)
    start = Root([0, 1], 0, 0, 0)
    if contact(start):
        return start
    candidates = []
    for a, b in edges:
        # the origin enters through an edge: a x b = 0 there, a . b <= 0; if a x b vanishes
        # throughout, it enters where a . b changes sign
        c = [x for x in cross(a, b) if x] or [x for x in [dot(a, b)] if x]
        if c:
            candidates += [r for r in roots_in_unit_interval(primitive(c[0])) if contact(r)]
    if not candidates:
        return None
    first = candidates[0]
    for r in candidates[1:]:
        if earlier(r, first):
            first = r
    return first


def earlier(a, b):
    """Whether root a < root b."""
    while True:
        bits = max(a.bits, b.bits)
        a_low, a_high = a.low << (bits - a.bits), a.high << (bits - a.bits)
        b_low, b_high = b.low << (bits - b.bits), b.high << (bits - b.bits)
        if a_low == a_high and b_low == b_high:
            return a_low < b_low
        if a_high <= b_low:
            return True
        if b_high <= a_low:
            return False
        g = common_divisor(a.p, b.p)
        low, high = max(a_low, b_low), min(a_high, b_high)
        if len(g) > 1 and sign_at(g, low, bits) * sign_at(g, high, bits) < 0:
            return False  # one and the same number
        a.refine()
        b.refine()
