# SPDX-License-Identifier: Apache-2.0
"""Mass properties from Python: every factory against an answer found another way."""

import math
import pickle
from fractions import Fraction

import mpmath
import numpy as np
import pytest
from mpmath import mpf

import carom
from carom import MassProperties

U = 2.0**-53
RHO = 700.0
CLOSED_FORM = 32 * U  # a dozen roundings in the longest formula, one in each input

# ---- references: integrals of 1, z, xx, yy, zz over the body at 30 digits -----------------------


def quad(f, *points):
    with mpmath.workdps(30):
        return mpmath.quad(f, [mpf(p) for p in points])


def of_revolution(radius, *z, hollow=lambda z: 0):
    """Solid of revolution about z: discs of radius(z), less hollow(z)."""

    def disc(power):
        return lambda h: mpmath.pi * (radius(h) ** power - hollow(h) ** power)

    across = quad(lambda h: disc(4)(h) / 4, *z)
    return (
        quad(disc(2), *z),
        quad(lambda h: disc(2)(h) * h, *z),
        across,
        across,
        quad(lambda h: disc(2)(h) * h * h, *z),
    )


def skin_of_revolution(*pieces):
    """Surface of revolution: curves (r(t), z(t), |d(r,z)/dt|(t), from, to)."""
    total = [mpf(0)] * 5
    for r, z, speed, a, b in pieces:
        values = (
            lambda t, r=r, z=z: 1,
            lambda t, r=r, z=z: z(t),
            lambda t, r=r, z=z: r(t) ** 2 / 2,
            lambda t, r=r, z=z: r(t) ** 2 / 2,
            lambda t, r=r, z=z: z(t) ** 2,
        )
        for i, f in enumerate(values):
            weight = lambda t, r=r, speed=speed: 2 * mpmath.pi * r(t) * speed(t)  # noqa: E731
            total[i] += quad(lambda t, f=f, weight=weight: weight(t) * f(t), a, b)
    return tuple(total)


def line(r0, z0, r1, z1):
    r0, z0, r1, z1 = (mpf(x) for x in (r0, z0, r1, z1))
    return (
        lambda t: r0 + t * (r1 - r0),
        lambda t: z0 + t * (z1 - z0),
        lambda t: mpmath.hypot(r1 - r0, z1 - z0),
        0,
        1,
    )


def arc(r, centre_r, centre_z, a, b):
    r, centre_r, centre_z = mpf(r), mpf(centre_r), mpf(centre_z)
    return (
        lambda t: centre_r + r * mpmath.cos(t),
        lambda t: centre_z + r * mpmath.sin(t),
        lambda t: r,
        a,
        b,
    )


def ellipsoid_skin(a, b, c):
    """By angles, a double integral: another road than the one line integral of the library."""
    a, b, c = mpf(a), mpf(b), mpf(c)

    def integral(f):
        def ring(theta, phi):
            s, k = mpmath.sin(theta), mpmath.cos(theta)
            x, y = s * mpmath.cos(phi), s * mpmath.sin(phi)
            area = s * a * b * c * mpmath.sqrt((x / a) ** 2 + (y / b) ** 2 + (k / c) ** 2)
            return area * f(a * x, b * y, c * k)

        with mpmath.workdps(17):
            octant = mpmath.pi / 2
            return 8 * mpmath.quad(ring, [0, octant], [0, octant])

    moments = (lambda x, y, z: x * x, lambda x, y, z: y * y, lambda x, y, z: z * z)
    return (integral(lambda x, y, z: 1), mpf(0), *(integral(f) for f in moments))


def box_solid(a, b, c):
    a, b, c = (Fraction(x) for x in (a, b, c))
    v = a * b * c
    return (v, 0, v * a * a / 12, v * b * b / 12, v * c * c / 12)


def box_skin(a, b, c):
    """Six rectangles, each by its own parallel axis, exactly."""
    e = [Fraction(x) for x in (a, b, c)]
    area, second = Fraction(0), [Fraction(0)] * 3
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        face = e[i] * e[j]
        area += 2 * face
        second[k] += 2 * face * (e[k] / 2) ** 2
        second[i] += 2 * face * e[i] ** 2 / 12
        second[j] += 2 * face * e[j] ** 2 / 12
    return (area, 0, *second)


def ball(r, up=1):
    return lambda z: mpmath.sqrt(max(mpf(r) ** 2 - z * z, 0))


PI = math.pi
R, L = 0.375, 1.25  # exact in binary
HALF = L / 2


def capsule_radius(z):
    beyond = abs(z) - mpf(HALF)
    return mpf(R) if beyond <= 0 else mpmath.sqrt(max(mpf(R) ** 2 - beyond**2, 0))


def torus_outer(z):
    return mpf(L) + mpmath.sqrt(mpf(R) ** 2 - z * z)


def torus_inner(z):
    return mpf(L) - mpmath.sqrt(mpf(R) ** 2 - z * z)


with mpmath.workdps(30):
    HALF_TURN = mpmath.pi / 2
    TURN = 2 * mpmath.pi

SOLIDS = {
    "sphere": (
        lambda **k: MassProperties.sphere(R, **k),
        lambda: of_revolution(ball(R), -R, R),
    ),
    "hemisphere": (
        lambda **k: MassProperties.hemisphere(R, **k),
        lambda: of_revolution(ball(R), 0, R),
    ),
    "hollow_sphere": (
        lambda **k: MassProperties.hollow_sphere(0.25, R, **k),
        lambda: of_revolution(ball(R), -R, -0.25, 0.25, R, hollow=ball(0.25)),
    ),
    "box": (
        lambda **k: MassProperties.box([0.5, 1.25, 3], **k),
        lambda: box_solid(0.5, 1.25, 3),
    ),
    "capsule": (
        lambda **k: MassProperties.capsule(R, L, **k),
        lambda: of_revolution(capsule_radius, -HALF - R, -HALF, HALF, HALF + R),
    ),
    "capsule_without_length": (
        lambda **k: MassProperties.capsule(R, 0, **k),
        lambda: of_revolution(ball(R), -R, R),
    ),
    "cylinder": (
        lambda **k: MassProperties.cylinder(R, L, **k),
        lambda: of_revolution(lambda z: mpf(R), -HALF, HALF),
    ),
    "tube": (
        lambda **k: MassProperties.tube(0.25, R, L, **k),
        lambda: of_revolution(lambda z: mpf(R), -HALF, HALF, hollow=lambda z: mpf(0.25)),
    ),
    "cone": (
        lambda **k: MassProperties.cone(R, L, **k),
        lambda: of_revolution(lambda z: R * (mpf(3) / 4 - z / L), -L / 4, 3 * L / 4),
    ),
    "torus": (
        lambda **k: MassProperties.torus(L, R, **k),
        lambda: of_revolution(torus_outer, -R, R, hollow=torus_inner),
    ),
    "ellipsoid": (
        lambda **k: MassProperties.ellipsoid([0.5, 0.5, 2], **k),
        lambda: of_revolution(lambda z: mpmath.sqrt(4 - z * z) / 4, -2, 2),
    ),
}

SKINS = {
    "sphere": (
        lambda **k: MassProperties.sphere(R, **k),
        lambda: skin_of_revolution(arc(R, 0, 0, -HALF_TURN, HALF_TURN)),
    ),
    "hemisphere": (
        lambda **k: MassProperties.hemisphere(R, **k),
        lambda: skin_of_revolution(arc(R, 0, 0, 0, HALF_TURN), line(0, 0, R, 0)),
    ),
    "dome": (
        lambda **k: MassProperties.hemisphere(R, caps=False, **k),
        lambda: skin_of_revolution(arc(R, 0, 0, 0, HALF_TURN)),
    ),
    "box": (
        lambda **k: MassProperties.box([0.5, 1.25, 3], **k),
        lambda: box_skin(0.5, 1.25, 3),
    ),
    "capsule": (
        lambda **k: MassProperties.capsule(R, L, **k),
        lambda: skin_of_revolution(
            arc(R, 0, HALF, 0, HALF_TURN),
            line(R, -HALF, R, HALF),
            arc(R, 0, -HALF, -HALF_TURN, 0),
        ),
    ),
    "cylinder": (
        lambda **k: MassProperties.cylinder(R, L, **k),
        lambda: skin_of_revolution(
            line(0, -HALF, R, -HALF), line(R, -HALF, R, HALF), line(R, HALF, 0, HALF)
        ),
    ),
    "pipe": (
        lambda **k: MassProperties.cylinder(R, L, caps=False, **k),
        lambda: skin_of_revolution(line(R, -HALF, R, HALF)),
    ),
    "cone": (
        lambda **k: MassProperties.cone(R, L, **k),
        lambda: skin_of_revolution(line(R, -L / 4, 0, 3 * L / 4), line(R, -L / 4, 0, -L / 4)),
    ),
    "funnel": (
        lambda **k: MassProperties.cone(R, L, caps=False, **k),
        lambda: skin_of_revolution(line(R, -L / 4, 0, 3 * L / 4)),
    ),
    "torus": (
        lambda **k: MassProperties.torus(L, R, **k),
        lambda: skin_of_revolution(arc(R, L, 0, 0, TURN)),
    ),
    "ellipsoid": (
        lambda **k: MassProperties.ellipsoid([0.5, 0.75, 1], **k),
        lambda: ellipsoid_skin(0.5, 0.75, 1),
    ),
    "ball_as_ellipsoid": (
        lambda **k: MassProperties.ellipsoid([R, R, R], **k),
        lambda: skin_of_revolution(arc(R, 0, 0, -HALF_TURN, HALF_TURN)),
    ),
}


def check(body, reference, density):
    """Mass, centre and tensor against (1, z, xx, yy, zz) integrals of another maker."""
    one, z, xx, yy, zz = reference
    centre = z / one
    zz = zz - one * centre * centre
    size = math.sqrt(float((xx + yy + zz) / one))
    assert body.mass == pytest.approx(density * float(one), rel=CLOSED_FORM)
    np.testing.assert_allclose(body.com, [0, 0, float(centre)], atol=CLOSED_FORM * size)
    moments = [density * float(m) for m in (yy + zz, zz + xx, xx + yy)]
    np.testing.assert_allclose(body.inertia, np.diag(moments), rtol=CLOSED_FORM, atol=0)
    assert body.rank == 3
    assert body.error is None
    assert body.warnings == []


@pytest.mark.parametrize("name", SOLIDS)
def test_solid_agrees_with_its_integrals(name):
    make, reference = SOLIDS[name]
    check(make(density=RHO), reference(), RHO)


@pytest.mark.parametrize("name", SKINS)
def test_shell_agrees_with_its_integrals(name):
    make, reference = SKINS[name]
    check(make(density=RHO, thickness=1 / 512), reference(), RHO / 512)


@pytest.mark.parametrize("ratio", [1e-6, 1e-3, 1e3, 1e6])
def test_flat_and_long_ellipsoid_shells_have_the_area_of_the_spheroid(ratio):
    # oblate and prolate areas in closed form, at 40 digits: they cancel near a sphere
    body = MassProperties.ellipsoid([1, 1, ratio], shell=True, thickness=1.0, density=1.0)
    with mpmath.workdps(40):
        c = mpf(ratio)
        if ratio < 1:
            e = mpmath.sqrt(1 - c * c)
            area = 2 * mpmath.pi * (1 + c * c / e * mpmath.atanh(e))
        else:
            e = mpmath.sqrt(1 - 1 / (c * c))
            area = 2 * mpmath.pi * (1 + c / e * mpmath.asin(e))
    # some 300 positive terms of a dozen roundings, summed: errors average out far below this
    assert body.mass == pytest.approx(float(area), rel=300 * U)


def test_thick_shell_tends_to_the_thin_one():
    t = 2.0**-20  # so that both radii are exact
    thin = MassProperties.sphere(1, thickness=t, density=1)
    thick = MassProperties.hollow_sphere(1 - t / 2, 1 + t / 2, density=1)
    # the next term of the wall, t^2/12 in mass and 10/12 t^2 in inertia, is 8e-13
    np.testing.assert_allclose(thick.inertia, thin.inertia, rtol=1e-12, atol=1e-25)


# ---- material ----------------------------------------------------------------------------------


def test_density_is_that_of_water_where_nothing_is_given():
    assert MassProperties.box([1, 2, 3]).mass == 6000
    assert MassProperties.box([1, 2, 3], 500).mass == 3000


def test_mass_instead_of_density_scales_the_tensor():
    given = MassProperties.cone(1, 2, mass=3)
    np.testing.assert_allclose(
        given.inertia, MassProperties.cone(1, 2).scaled_to(3).inertia, rtol=4 * U
    )
    assert given.mass == 3
    assert MassProperties.cone(1, 2, mass=3, shell=True).mass == 3


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: MassProperties.sphere(1, density=1, mass=1), "mass: 2 ways"),
        (lambda: MassProperties.sphere(1, shell=True), "shell: no weight, must come with"),
        (lambda: MassProperties.sphere(1, thickness=0.0), "thickness: 0 m"),
        (lambda: MassProperties.sphere(-1), "radius: -1 m, must be finite and > 0"),
        (lambda: MassProperties.cylinder(1, 1, caps=False), "caps: False"),
        (lambda: MassProperties.torus(1, 2), "minor_radius: 2 m, must not exceed"),
        (lambda: MassProperties.box([1, 2]), r"extents: an array of shape \(2,\)"),
        (
            lambda: MassProperties(1, [0, 0, 0], np.diag([1, 1, 5])),
            "inertia: principal moments 1 1 5",
        ),
        (lambda: MassProperties(1, [0, 0, 0], -np.eye(3)), "no negative moment"),
        (lambda: MassProperties(0, [0, 0, 0], np.eye(3)), "mass: 0 kg"),
        (lambda: MassProperties(1, [0, 0, math.nan], np.eye(3)), "com: .* must be finite"),
        (lambda: MassProperties(1, [0, 0, 0], [[1, 0, 0]]), "inertia: an array of shape"),
        (lambda: MassProperties.particles([[0, 0, 0]], [1, 2]), "masses: 2 masses"),
        (lambda: MassProperties.particles([[0, 0, 0]], [-1]), r"masses\[0\]: -1 kg"),
        (lambda: MassProperties.sphere(1).transformed(-np.eye(3), [0, 0, 0]), "not a reflection"),
        (lambda: MassProperties.combined([]), "parts"),
    ],
)
def test_input_that_cannot_be_used_is_refused(make, message):
    with pytest.raises(carom.InvalidInput, match=message):
        make()


def test_a_flat_plate_is_legal_and_just_beyond_is_not():
    MassProperties(1, [0, 0, 0], np.diag([1, 2, 3]))
    MassProperties(1, [0, 0, 0], MassProperties.plate(1, 2, 5).inertia)
    with pytest.raises(ValueError, match="above the sum of the other two"):
        MassProperties(1, [0, 0, 0], np.diag([1, 2, 3 * (1 + 1e-11)]))


# ---- rank, frames, unions ----------------------------------------------------------------------


@pytest.mark.parametrize(
    ("body", "rank"),
    [
        (MassProperties.sphere(1), 3),
        (MassProperties.plate(1, 2, 3.0), 3),
        (MassProperties.rod(2, 3.0), 2),
        (MassProperties.particles([[1, 1, 1], [2, 3, 4], [3, 5, 7]], [1, 2, 3]), 2),
        (MassProperties.point([1, 2, 3], 4.0), 0),
        (MassProperties.particles([[5, 5, 5]], [2]), 0),
    ],
)
def test_rank_and_pseudo_inverse(body, rank):
    q, _ = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))
    turned = body.transformed(q * np.linalg.det(q), [1, 2, 3])
    for each in (body, turned):
        assert each.rank == rank
        # numpy's own pseudo-inverse, by singular values; condition number below 10
        expected = np.linalg.pinv(each.inertia, rcond=1e-13)
        np.testing.assert_allclose(
            each.inverse_inertia, expected, atol=100 * U * np.abs(expected).max()
        )


def test_principal_axes_rebuild_the_tensor():
    body = MassProperties.box([1, 2, 3]) + MassProperties.point([2, 1, 0.5], 900.0)
    moments, axes = body.principal()
    assert (np.diff(moments) >= 0).all()
    assert np.linalg.det(axes) == pytest.approx(1, abs=24 * U)
    np.testing.assert_allclose(
        axes @ np.diag(moments) @ axes.T, body.inertia, atol=80 * U * moments[2]
    )
    np.testing.assert_allclose(moments, np.linalg.eigvalsh(body.inertia), rtol=80 * U * 10)


def test_union_of_the_parts_of_a_box_is_the_box():
    halves = [MassProperties.box([1, 2, 3]).transformed(np.eye(3), [x, 0, 0]) for x in (0.5, -0.5)]
    for whole in (halves[0] + halves[1], sum(halves), MassProperties.combined(halves)):
        np.testing.assert_allclose(
            whole.inertia, MassProperties.box([2, 2, 3]).inertia, rtol=8 * U, atol=1e-11
        )


def test_pickle_keeps_every_bit():
    body = MassProperties.sampled(lambda p: p[:, 0] > 0, [-1, -1, -1], [1, 1, 1], samples=100)
    copy = pickle.loads(pickle.dumps(body))
    assert copy.mass == body.mass
    assert (copy.inertia == body.inertia).all()
    assert copy.warnings == body.warnings
    assert copy.error.mass == body.error.mass


# ---- meshes against exact rational sums --------------------------------------------------------


def box_mesh(lower, upper):
    corners = [[(upper if i >> k & 1 else lower)[k] for k in range(3)] for i in range(8)]
    quads = [(0, 4, 6, 2), (1, 3, 7, 5), (0, 1, 5, 4), (2, 6, 7, 3), (0, 2, 3, 1), (4, 5, 7, 6)]
    return np.array(corners, float), np.array(
        [t for a, b, c, d in quads for t in [(a, b, c), (a, c, d)]]
    )


def icosphere(rounds):
    g = (1 + 5**0.5) / 2
    v = [(s, t * g, 0) for s in (-1, 1) for t in (-1, 1)]
    v = np.array([np.roll(p, k) for p in v for k in range(3)], float)
    d2 = ((v[:, None] - v[None]) ** 2).sum(2)
    near = np.isclose(d2, 4)
    n = range(12)
    faces = [
        (i, j, k)
        for i in n
        for j in n
        for k in n
        if i < j < k and near[i, j] and near[j, k] and near[k, i]
    ]
    faces = [f if np.linalg.det(v[list(f)]) > 0 else f[::-1] for f in faces]
    for _ in range(rounds):
        index, finer = {}, []
        points = list(v)
        for a, b, c in faces:
            mid = []
            for e in ((a, b), (b, c), (c, a)):
                key = tuple(sorted(e))
                if key not in index:
                    index[key] = len(points)
                    points.append(points[e[0]] + points[e[1]])
                mid.append(index[key])
            finer += [(a, mid[0], mid[2]), (b, mid[1], mid[0]), (c, mid[2], mid[1]), tuple(mid)]
        v, faces = np.array(points), finer
        v /= np.linalg.norm(v, axis=1)[:, None]
    return v / np.linalg.norm(v, axis=1)[:, None], np.array(faces)


def exact(vertices, faces):
    """Volume, centroid and tensor of density 1 in rational arithmetic over the doubles given."""
    v = [[Fraction(float(x)) for x in row] for row in vertices]
    six, first = Fraction(0), [Fraction(0)] * 3
    second = [[Fraction(0)] * 3 for _ in range(3)]
    for f in faces:
        a, b, c = (v[i] for i in f)
        d = (
            a[0] * (b[1] * c[2] - b[2] * c[1])
            + a[1] * (b[2] * c[0] - b[0] * c[2])
            + a[2] * (b[0] * c[1] - b[1] * c[0])
        )
        s = [a[k] + b[k] + c[k] for k in range(3)]
        six += d
        for k in range(3):
            first[k] += d * s[k]
            for m in range(3):
                second[k][m] += d * (s[k] * s[m] + a[k] * a[m] + b[k] * b[m] + c[k] * c[m])
    volume = six / 6
    com = [x / 24 / volume for x in first]
    cov = [[second[k][m] / 120 - volume * com[k] * com[m] for m in range(3)] for k in range(3)]
    trace = cov[0][0] + cov[1][1] + cov[2][2]
    tensor = [[(trace if k == m else 0) - cov[k][m] for m in range(3)] for k in range(3)]
    return volume, com, tensor


def turned(vertices):
    q, _ = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))
    return vertices @ q


SHAPES = {
    "cube": box_mesh([0, 0, 0], [1, 1, 1]),
    "sphere": icosphere(2),
    "needle": box_mesh([0, 0, 0], [1e-4, 1e-4, 1]),
    "plate": box_mesh([0, 0, 0], [1, 1, 1e-6]),
    "sliver": box_mesh([0, 0, 0], [1, 0.1, 1e-7]),
}


@pytest.mark.parametrize("place", ["here", "turned", "far", "far_and_turned"])
@pytest.mark.parametrize("shape", SHAPES)
def test_mesh_agrees_with_rational_sums(shape, place):
    vertices, faces = SHAPES[shape]
    if "turned" in place:
        vertices = turned(vertices)
    if "far" in place:
        # Coordinates rounded to 1e-10 would turn slivers inside out: the thinnest stay coarser.
        vertices = vertices * (1 if shape in ("cube", "sphere", "needle") else 1000) + 1e6
    volume, com, tensor = exact(vertices, faces)
    body = MassProperties.mesh(vertices, faces, density=1)
    # asked for: 1e-12 near the origin, 1e-9 far out; the same double-double sums give both
    smallest = np.linalg.eigvalsh(np.array(tensor, float))[0]
    assert abs(Fraction(body.mass) / volume - 1) < 1e-13
    for k in range(3):
        assert abs(Fraction(body.com[k]) - com[k]) <= 2 * U * max(1, abs(com[k]))
        for m in range(3):
            off = float(Fraction(body.inertia[k, m]) - tensor[k][m])
            assert abs(off) <= 1e-12 * abs(tensor[k][m]) + 1e-13 * smallest + 2 * U * abs(
                tensor[k][m]
            )


def test_mesh_of_a_sphere_is_off_by_its_facets_only():
    errors = []
    for rounds in (1, 2, 3):
        body = MassProperties.mesh(*icosphere(rounds), density=1)
        errors.append(1 - body.inertia[0, 0] / (8 * PI / 15))
    # an inscribed mesh is short by a term in the square of the edge: a quarter each round
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(4, rel=0.03)


def test_compound_of_boxes_is_their_mesh():
    a, b = box_mesh([0, 0, 0], [1, 2, 3]), box_mesh([1, 0.5, 0.25], [4, 1, 1.5])
    mesh = MassProperties.mesh(np.vstack([a[0], b[0]]), np.vstack([a[1], b[1] + 8]))
    parts = MassProperties.mesh(*a) + MassProperties.mesh(*b)
    assert mesh.mass == pytest.approx(parts.mass, rel=8 * U)
    np.testing.assert_allclose(mesh.com, parts.com, rtol=16 * U)
    np.testing.assert_allclose(
        mesh.inertia, parts.inertia, rtol=0, atol=64 * U * mesh.inertia.max()
    )


# ---- what is odd about a mesh ------------------------------------------------------------------

CUBE = box_mesh([0, 0, 0], [1, 1, 1])


def joined(*meshes):
    offsets = np.cumsum([0] + [len(v) for v, _ in meshes])
    return (
        np.vstack([v for v, _ in meshes]),
        np.vstack([f + o for (_, f), o in zip(meshes, offsets, strict=False)]),
    )


def reverse(mesh):
    return mesh[0], mesh[1][:, ::-1]


def with_faces(change):
    faces = CUBE[1].copy()
    return CUBE[0], change(faces)


def one_turned(faces):
    faces[4] = faces[4][::-1]
    return faces


ODD = {
    "cavity": (
        joined(box_mesh([0, 0, 0], [2, 3, 4]), reverse(box_mesh([0.5] * 3, [1.5, 2.5, 3.5]))),
        "1 cavity",
        18,
    ),
    "inside out": (reverse(CUBE), "1 part was inside out", 1),
    "mixed winding": (with_faces(one_turned), "mixed winding at 3 edges", 1),
    "copy": (with_faces(lambda f: np.vstack([f, f[:1]])), "1 duplicate face was left out", 1),
    "corner twice": (with_faces(lambda f: np.vstack([f, [[0, 0, 1]]])), "1 face uses a corner", 1),
    "crossing": (joined(CUBE, box_mesh([0.5] * 3, [1.5] * 3)), "crosses itself", 2),
    "nested": (joined(CUBE, box_mesh([0.25] * 3, [0.75] * 3)), "wound the same way", 1.125),
    "on one edge": (joined(CUBE, box_mesh([1, 1, 0], [2, 2, 1])), "shared by four", 2),
    "thin": (box_mesh([0, 0, 0], [1, 1, 1e-7]), "tiny volume", 1e-7),
}


@pytest.mark.parametrize("case", ODD)
def test_odd_mesh_is_said_and_mended(case):
    mesh, said, volume = ODD[case]
    body = MassProperties.mesh(*mesh, density=1)
    assert body.mass == pytest.approx(volume, rel=1e-13)
    assert any(said in warning for warning in body.warnings), body.warnings
    assert MassProperties.mesh(*CUBE).warnings == []


def test_open_mesh_is_refused_but_has_a_skin():
    vertices, faces = CUBE
    with pytest.raises(carom.InvalidInput, match="open at 3 edges, must be closed"):
        MassProperties.mesh(vertices, faces[:-1])
    assert carom.diagnose_mesh(vertices, faces[:-1]).open_edges == 3
    skin = MassProperties.mesh(vertices, faces, density=1, thickness=1.0)
    np.testing.assert_allclose(
        skin.inertia, MassProperties.box([1, 1, 1], 1, thickness=1.0).inertia, atol=16 * U
    )
    assert MassProperties.mesh(vertices, faces[:-1], mass=2, shell=True).mass == pytest.approx(2)


def test_mended_mesh_is_sound():
    mesh, _, _ = ODD["mixed winding"]
    vertices, faces, diagnosis = carom.mend_mesh(*mesh)
    assert diagnosis.mixed_edges == 3
    assert carom.diagnose_mesh(vertices, faces).findings == []


# ---- sampling ----------------------------------------------------------------------------------


def in_ball(p):
    return (p * p).sum(1) <= 1


CORNERS = ([-1, -1, -1], [1, 1, 1])


def test_varying_density_meets_the_closed_form():
    # rho = 1000 r^2 in the unit ball: m = 4 pi/5 1000, I = 2/3 * 4 pi/7 1000
    body = MassProperties.sampled(
        in_ball, *CORNERS, density=lambda p: 1000 * (p * p).sum(1), samples=200_000, seed=1
    )
    # 5 standard errors; the estimate itself is checked against the scatter over seeds below
    assert abs(body.mass - 4000 * PI / 5) < 5 * body.error.mass
    assert abs(body.inertia[0, 0] - 8000 * PI / 21) < 5 * body.error.inertia[0, 0]
    assert np.linalg.norm(body.com) < 5 * np.linalg.norm(body.error.com)
    assert body.error.mass < 1e-3 * body.mass
    assert body.error.samples <= 200_000


def test_density_is_asked_inside_only():
    def density(p):
        assert in_ball(p).all()
        return np.full(len(p), 3.0)

    varying = MassProperties.sampled(in_ball, *CORNERS, density=density, samples=1000)
    uniform = MassProperties.sampled(in_ball, *CORNERS, density=3.0, samples=1000)
    assert (varying.inertia == uniform.inertia).all()


@pytest.mark.parametrize("stratified", [True, False])
def test_error_estimate_is_the_scatter(stratified):
    exact_mass = 1000 * 4 / 3 * PI
    runs = [
        MassProperties.sampled(in_ball, *CORNERS, samples=2000, stratified=stratified, seed=s)
        for s in range(60)
    ]
    scatter = math.sqrt(np.mean([(r.mass - exact_mass) ** 2 for r in runs]))
    said = math.sqrt(np.mean([r.error.mass**2 for r in runs]))
    assert scatter / said == pytest.approx(1, abs=0.37)  # 60 draws: 9 %, times 4


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: MassProperties.sampled(in_ball, [1, 1, 1], [0, 0, 0]), "lower: 1 m"),
        (lambda: MassProperties.sampled(in_ball, *CORNERS, samples=1), "samples: 1"),
        (lambda: MassProperties.sampled(lambda p: p[0] > 0, *CORNERS), "inside: .* another shape"),
        (lambda: MassProperties.sampled(lambda p: p[:, 0] > 5, *CORNERS), "none inside"),
        (lambda: MassProperties.sampled(in_ball, *CORNERS, density=-1.0), "density: -1"),
        (
            lambda: MassProperties.sampled(in_ball, *CORNERS, density=lambda p: p[:, 0]),
            "density: .* must be finite and >= 0",
        ),
        (lambda: MassProperties.sampled(in_ball, *CORNERS, method="sobol"), "method: 'sobol'"),
    ],
)
def test_sampling_refuses_what_it_cannot_use(make, message):
    with pytest.raises(carom.InvalidInput, match=message):
        make()


# ---- particles ---------------------------------------------------------------------------------


def test_body_of_particles_behaves_as_its_particles():
    rng = np.random.default_rng(3)
    masses = rng.uniform(0.1, 1, 20)
    p = carom.particles.centred(rng.normal(size=(20, 3)), masses)
    body = MassProperties.particles(p, masses)
    q = rng.normal(size=4)
    q /= np.linalg.norm(q)
    pose = np.r_[1, -2, 3, q]
    centre, velocity, omega = pose[:3], np.array([1.0, 2, 3]), np.array([-1.0, 0.5, 2])
    x = carom.particles.to_world(p, pose)
    v = carom.particles.velocities(x, centre, velocity, omega)
    # 20 terms of size below 100, some 10 roundings each
    allowed = 20 * 100 * 10 * U
    np.testing.assert_allclose(carom.particles.to_object(x, pose), p, atol=64 * U)
    # the rotation matrix found from the particles themselves
    rotation = (x - centre).T @ np.linalg.pinv(p.T)
    tensor = rotation @ body.inertia @ rotation.T
    np.testing.assert_allclose(
        carom.particles.momentum(masses, v), body.mass * velocity, atol=allowed
    )
    np.testing.assert_allclose(
        carom.particles.angular_momentum(masses, x, v, centre), tensor @ omega, atol=allowed
    )
    energy = 0.5 * body.mass * velocity @ velocity + 0.5 * omega @ tensor @ omega
    assert carom.particles.kinetic_energy(masses, v) == pytest.approx(energy, abs=allowed)
    force, torque = carom.particles.net_wrench(masses[:, None] * v, x, centre)
    np.testing.assert_allclose(force, body.mass * velocity, atol=allowed)
    np.testing.assert_allclose(torque, tensor @ omega, atol=allowed)
