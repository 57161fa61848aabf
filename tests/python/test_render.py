# SPDX-License-Identifier: Apache-2.0
"""Pictures: what is where, what hides what, where shadows fall; against rays and projections."""

import itertools

import numpy as np
import pytest

import carom
import carom.render
from carom.render import picture
from carom.render.light import SUN, lit_by, sky_directions, sun_directions
from carom.render.outlines import outline
from carom.render.raster import raster
from carom.render.surfaces import surfaces_of
from carom.render.views import camera, parallel

SIZE = 160, 120
CORNER = carom.Mesh(np.eye(4, 3), [[0, 1, 2], [0, 2, 3], [1, 3, 2], [0, 3, 1]])
"""A tetrahedron: three unit vectors and the origin."""


def make(*bodies):
    scene = carom.Scene()
    for shape, position, orientation in bodies:
        scene.add(shape, position=position, orientation=orientation)
    return scene, carom.Simulation(scene).poses()


def mixed():
    turned = np.array([0.1, -0.5, 0.3, 0.8])
    return make(
        (carom.Box([1, 0.6, 0.3]), [0, 0, 0.5], turned / np.linalg.norm(turned)),
        (carom.Sphere(0.4), [0.3, -0.6, 0.5], [0, 0, 0, 1]),
        (CORNER, [-0.8, 0, 0], [0, 0, 0, 1]),
    )


def first_hits(view, surfaces):
    """The nearest surface along the ray of each pixel, one ray and one surface at a time (Moeller
    and Trumbore for triangles): index (H, W), depth (H, W)."""
    index = np.full((view.height, view.width), -1)
    depth = np.full(index.shape, np.inf)
    for y, x in itertools.product(range(view.height), range(view.width)):
        origin, direction = (a[0] for a in view.rays(np.array([x]), np.array([y])))
        for i, (a, b, c) in enumerate(surfaces.corners):
            p = np.cross(direction, c - a)
            det = (b - a) @ p
            u = (origin - a) @ p / det
            q = np.cross(origin - a, b - a)
            v, t = direction @ q / det, (c - a) @ q / det
            if u >= 0 and v >= 0 and u + v <= 1 and t < depth[y, x]:
                index[y, x], depth[y, x] = i, t
        for i, (centre, r) in enumerate(zip(surfaces.centres, surfaces.radii, strict=True)):
            roots = np.roots([direction @ direction, 2 * direction @ (origin - centre),
                              (origin - centre) @ (origin - centre) - r * r])  # fmt: skip
            if np.isreal(roots).all() and roots.real.min() < depth[y, x]:
                index[y, x], depth[y, x] = len(surfaces.corners) + i, roots.real.min()
    return index, depth


@pytest.mark.parametrize("kind", ["perspective", "parallel"])
def test_every_pixel_sees_the_surface_its_ray_meets_first(kind):
    surfaces = surfaces_of(*mixed())
    hull = picture._hull(surfaces)
    view = camera(hull, (48, 36), -1.0, 0.4) if kind == "perspective" else parallel(hull, -SUN, 48)
    keys, index = raster(view, surfaces)
    expected, depth = first_hits(view, surfaces)
    # A ray through an edge may take either side of it: rounding decides. None here does.
    np.testing.assert_array_equal(index, expected)
    seen = index >= 0
    assert {-1, len(surfaces.corners)} < set(np.unique(index))  # nothing, the sphere, triangles
    ours = 1 / keys[seen] if view.perspective else -keys[seen]
    np.testing.assert_allclose(ours, depth[seen], rtol=1e-10)


def test_the_camera_has_everything_in_the_picture():
    hull = picture._hull(surfaces_of(*mixed()))
    for azimuth, elevation in itertools.product((-1, 0.5, 3), (0.1, 1.2)):
        xy, key = camera(hull, SIZE, azimuth, elevation).project(hull)
        assert (key > 0).all()
        assert (xy >= 0).all()
        assert (xy <= np.array(SIZE) - 1).all()
        # And not from farther than needed: something comes within the margin of an edge.
        assert np.abs(xy / (np.array(SIZE) - 1) - 0.5).max() > 0.43


def test_a_ball_shades_the_floor_where_the_sun_says():
    scene = carom.Scene()
    scene.add(carom.Plane([0, 0, 1], 0), static=True)
    scene.add(carom.Sphere(0.2), position=[0, 0, 1])
    surfaces = surfaces_of(scene, carom.Simulation(scene).poses())
    under = np.array([0, 0, 1]) - SUN / SUN[2]  # where the line from the ball along the sun lands
    beside = under + np.array([0.6, 0, 0])
    points = np.array([under, beside])
    normals = np.tile([0.0, 0, 1], (2, 1))
    light = lit_by(surfaces, picture._hull(surfaces), sun_directions(), points, normals, 256)
    assert light[0] == 0
    # The mean over the sun's disc of the cosine: its directions are spread evenly round its middle.
    assert light[1] == pytest.approx(SUN[2], rel=2e-3)


def test_the_sky_over_a_ball_is_darkened_by_its_share():
    """A point straight below a ball of radius r at distance d loses the cosine-weighted share
    (r/d)^2 of the sky (form factor of a sphere); 64 directions give it to a few hundredths."""
    scene = carom.Scene()
    scene.add(carom.Sphere(0.6), position=[0, 0, 1])
    surfaces = surfaces_of(scene, carom.Simulation(scene).poses())
    point, normal = np.zeros((1, 3)), np.array([[0.0, 0, 1]])
    (light,) = lit_by(surfaces, picture._hull(surfaces), sky_directions(), point, normal, 256)
    assert light / 0.5 == pytest.approx(1 - 0.36, abs=2 / 64 + 0.02)


def test_faces_that_meet_at_a_flat_angle_are_smooth_and_others_have_edges():
    scene, poses = make((carom.Box([1, 2, 3]), [0, 0, 0], [0, 0, 0, 1]))
    normals = surfaces_of(scene, poses).normals
    assert np.isin(np.abs(normals), (0.0, 1.0)).all()
    trimesh = pytest.importorskip("trimesh")
    ball = trimesh.creation.icosphere(subdivisions=3)
    scene, poses = make((carom.Mesh(ball.vertices, ball.faces), [0, 0, 0], [0, 0, 0, 1]))
    surfaces = surfaces_of(scene, poses)
    # On a ball the smooth normal is the direction from the centre, up to the faces' unevenness.
    assert (surfaces.normals * surfaces.corners).sum(-1).min() > 0.999


@pytest.mark.parametrize(
    ("kind", "sizes", "volume"),
    [
        ("Box", {"extents": np.array([1, 2, 3])}, 6),
        ("Capsule", {"radius": 0.5, "length": 2}, np.pi * 0.25 * (2 + 4 / 3 * 0.5)),
        ("Cylinder", {"radius": 0.5, "length": 2}, np.pi * 0.25 * 2),
        ("Cone", {"radius": 0.5, "length": 2}, np.pi * 0.25 * 2 / 3),
        ("Ellipsoid", {"radii": np.array([1, 2, 3])}, 4 / 3 * np.pi * 6),
    ],
)
def test_an_outline_holds_the_volume_of_its_shape(kind, sizes, volume):
    """By the divergence theorem; a face turned the wrong way, or missing, would be missed. Facets
    lie inside: a circle of 48 corners loses 0.3 %, arcs of a half circle in 24 parts 0.9 %."""
    shape = type(kind, (), sizes)()
    corners = np.array(outline(shape)[0])[np.array(outline(shape)[1])]
    found = np.einsum("ij,ij->", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    assert 0.985 * volume < found <= volume * (1 + 1e-12)
    centre = (corners.mean(1) * np.linalg.det(corners)[:, None]).sum(0) * 3 / 4 / (6 * found)
    np.testing.assert_allclose(centre, 0, atol=1e-12)  # the centre of mass is the origin


def test_the_picture_holds_bodies_floor_and_horizon():
    pytest.importorskip("PIL", reason="pictures need carom[plot]")
    scene = carom.Scene()
    scene.add(carom.Plane([0, 0, 1], 0), static=True)
    scene.add(carom.Sphere(0.3), position=[0, 0, 0.3])
    image = carom.render.render(scene, carom.Simulation(scene).poses(), SIZE)
    assert image.shape == (120, 160, 3)
    assert image.dtype == np.uint8
    red = (image[..., 0] > image[..., 2].astype(int) + 60).sum()
    # The ball's outline: a circle that reaches from margin to margin of the picture's height.
    assert 0.25 < red / (np.pi / 4 * 120**2) < 1
    assert image[0].min() > 150  # the sky, or the floor far away
    assert image[-1].min() > 120  # the floor


def test_a_png_shows_moments_side_by_side(tmp_path):
    image = pytest.importorskip("PIL.Image", reason="pictures need carom[plot]")
    scene, poses = mixed()
    path = tmp_path / "strip.png"
    carom.render.save(path, scene, [poses, poses], (124, 60))
    with image.open(path) as strip:
        pixels = np.asarray(strip)
    assert pixels.shape == (60, 124, 3)
    np.testing.assert_array_equal(pixels[:, :60], pixels[:, 64:])
    assert (pixels[:, 60:64] == 255).all()


def test_an_empty_scene_and_a_lone_floor_can_be_drawn():
    empty = carom.Scene()
    assert carom.render.render(empty, np.zeros((0, 7)), (32, 24)).shape == (24, 32, 3)
    empty.add(carom.Plane([0, 0, 1]), static=True)
    carom.render.render(empty, carom.Simulation(empty).poses(), (32, 24))


def test_a_place_that_cannot_be_written_is_refused(tmp_path):
    pytest.importorskip("PIL", reason="pictures need carom[plot]")
    with pytest.raises(carom.InvalidInput, match="must be writable"):
        carom.render.save(tmp_path / "no" / "end.png", *mixed_moments(), (32, 24))


def mixed_moments():
    scene, poses = mixed()
    return scene, [poses]


def test_a_compound_is_drawn_part_by_part_and_a_distance_grid_by_its_surface():
    quarter = [0, 0, np.sqrt(0.5), np.sqrt(0.5)]
    parts = [
        carom.Part(carom.Box([2, 1, 1]), [0, 5, 0], quarter),
        carom.Part(carom.Sphere(0.5), [0, 0, 3]),
    ]
    vertices, faces = outline(carom.Compound(parts))
    assert faces.max() == len(vertices) - 1
    # The box turned by a quarter is 1 x 2 m about (0, 5); the ball ends at 3.5.
    assert vertices.min(axis=0) == pytest.approx([-0.5, -0.5, -0.5])
    assert vertices.max(axis=0) == pytest.approx([0.5, 6, 3.5])
    cube = carom.Mesh(*outline(carom.Box([1, 1, 1])))
    grid = carom.Sdf(cube, 0.1)
    assert np.abs(np.array(grid.vertices)).max() == pytest.approx(0.5, abs=grid.error + 1e-9)
    assert outline(grid)[1].shape[1] == 3
