# SPDX-License-Identifier: MIT
"""Several meshes, options, progress and cancelling, packing, verifying, baking."""

import os
import signal
import threading
import time

import atlas_uv
import numpy as np
import pytest
from meshes import box, check_result, torus, triangles_of

SQUARE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
HALVES = np.array([[0, 1, 2], [0, 2, 3]])


def test_meshes_share_a_page():
    meshes = [torus(), box()]
    atlas = atlas_uv.Atlas(texture_size=(512, 256), gutter=4)
    for i, mesh in enumerate(meshes):
        assert atlas.add_mesh(*mesh) == i
    report = atlas.generate()
    assert report["is_valid"] and report["page_width"] == 512 and report["page_height"] == 256
    assert atlas.report is report and len(atlas) == 2 and len(list(atlas)) == 2
    charts = [set(atlas.result(i).face_charts) for i in range(2)]
    assert not charts[0] & charts[1]
    assert charts[0] | charts[1] == set(range(report["number_of_charts"]))
    for i, mesh in enumerate(meshes):
        check_result(*mesh, *atlas[i])
        result = atlas.result(i)
        assert np.array_equal(result.uvs[result.indices], result.corner_uvs)
        assert not result.uvs.flags.writeable
    with pytest.raises(ValueError):
        atlas.result(0).uvs[0] = 0
    summary = atlas.summary
    assert summary["charts"] == report["number_of_charts"] and summary["width"] == 512


def test_arrays_outlive_the_atlas():
    atlas = atlas_uv.Atlas()
    atlas.add_mesh(*torus())
    atlas.generate()
    view, copy = atlas.result().corner_uvs, atlas.result().corner_uvs.copy()
    atlas.generate(mode="conformal")
    del atlas
    assert np.array_equal(view, copy)


def test_options_have_their_effect():
    def charts(*mesh, add={}, **options):
        atlas = atlas_uv.Atlas(**options)
        atlas.add_mesh(*mesh, **add)
        return atlas.generate()["number_of_charts"]

    assert charts(SQUARE, HALVES) == 1
    assert charts(SQUARE, HALVES, add=dict(seams=[[2, 0]])) == 2
    assert charts(SQUARE, HALVES, add=dict(materials=[5, 9]), separate_materials=True) == 2
    assert charts(SQUARE, HALVES, add=dict(materials=[5, 9])) == 1
    assert charts(*box(), hard_angle=60) == 6
    assert charts(*box(), hard_angle=60, segmentation="seams", parameterizer="abf", packer="rectangles") == 6
    assert charts(*box()) == 1 and charts(*box(), segmentation="normals") == 3
    for wrong in (
        dict(segmentation="none"), dict(parameterizer="abf", solver="cg"), dict(segmentation="seams", max_charts=2),
        dict(packer=3), dict(keep_uv=True, optimizer="mips"), dict(only_given_seams=True, max_charts=2),
        dict(only_given_seams=True, segmentation="features"),
    ):
        with pytest.raises((ValueError, TypeError)):
            charts(*box(), add=dict(uvs=np.zeros((8, 2))), **wrong)
    apart = SQUARE[[0, 1, 2, 0, 2, 3]] + np.array([0, 0, 0, 1, 1, 1])[:, None] * 1e-7
    assert charts(apart, np.arange(6).reshape(2, 3)) == 2
    assert charts(apart, np.arange(6).reshape(2, 3), weld=1e-5) == 1
    assert charts(*box(), hard_angle=60, max_charts=None) == 6
    assert charts(*box(), max_charts=1) == 1
    assert charts(*box(), mode="few_seams") <= charts(*box(), hard_angle=60)
    inside_out = HALVES.copy()
    inside_out[1] = inside_out[1][::-1]
    assert charts(SQUARE, inside_out) == 2
    atlas = atlas_uv.Atlas(orient=True)
    atlas.add_mesh(SQUARE, inside_out)
    assert atlas.generate()["number_of_charts"] == 1
    result = atlas.result()
    (turned,) = result.turned_faces
    faces = inside_out.copy()
    faces[turned, 1:] = faces[turned, :0:-1]
    assert np.array_equal(result.vmapping[result.indices], faces)


def corner_uvs(*mesh, uvs=None, **options):
    """The coordinates of one mesh in texels, and the report."""
    atlas = atlas_uv.Atlas(**options)
    atlas.add_mesh(*mesh, uvs=uvs)
    report = atlas.generate()
    assert report["is_valid"]
    return atlas.result().corner_uvs * [report["page_width"], report["page_height"]], report


def test_bounds_reach_the_report():
    mesh = torus(6, 4)
    report = corner_uvs(*mesh, max_distortion=1.3, max_stretch=1.5, max_stretch_share=0.9)[1]
    assert report["bound"] == {
        "measure": "symmetric_dirichlet_mean", "max": 1.3, "max_stretch": 1.5, "max_stretch_share": 0.9
    }
    for chart in report["charts"]:
        assert chart["is_within_bound"] == (chart["stretch"] <= 1.5 and chart["symmetric_dirichlet_mean"] <= 1.3)
        assert chart["is_within_bound"] == (chart["bound_message"] == "the chart keeps its bound")
    assert report["charts_beyond_bound"] == sum(not chart["is_within_bound"] for chart in report["charts"])
    with pytest.raises(ValueError, match="max_stretch"):
        corner_uvs(*mesh, max_stretch=0.5)
    with pytest.raises(ValueError, match="share"):
        corner_uvs(*mesh, max_stretch=2, max_stretch_share=1.5)


def test_the_mode_of_the_paper():
    report = corner_uvs(*torus(12, 6), mode="paper")[1]
    assert sum(report["gradient_angles"]) == pytest.approx(1) and report["split_charts"] >= 0
    with pytest.raises(ValueError, match="paper merges no charts"):
        corner_uvs(*torus(12, 6), mode="paper", max_charts=3)


def test_directions_of_charts():
    # A rectangle in space whose coordinates lie askew.
    positions = np.array([[0, 0, 0], [1, 0, 0], [1, 0, 3], [0, 0, 3]], float)
    quad, turn = [[0, 1, 2, 3]], np.exp(0.5j)
    askew = np.array([0, 1, 1 + 3j, 3j]) * turn
    askew = np.stack([askew.real, askew.imag], 1)
    for rotation, is_askew in (("none", True), ("aligned", False)):
        uvs = corner_uvs(positions, quad, uvs=askew, keep_uv=True, rotation=rotation)[0][0]
        assert (np.abs(uvs[1] - uvs[0]).min() > 1) == is_askew
    for up, sign in (("z", 1), ("-z", -1), ((0, 0, 2), 1)):
        uvs = corner_uvs(positions, quad, up=up)[0][0]
        assert sign * (uvs[3] - uvs[0])[1] > 100
    with pytest.raises(ValueError, match="up"):
        corner_uvs(positions, quad, up="w")


def test_borders_on_texels():
    positions = np.array([[0, 0, 0], [1, 0, 0], [1, 0.37, 0], [0, 0.37, 0]])
    for snap in (False, True):
        uvs = corner_uvs(positions, [[0, 1, 2, 3]], snap=snap, texture_size=200)[0]
        assert (np.abs(uvs - uvs.round()).max() < 1e-3) == snap


def test_copies_share_a_place():
    two = np.concatenate([SQUARE, SQUARE + 2]), np.concatenate([HALVES, HALVES + 4])
    uvs, report = corner_uvs(*two, stack="copies")
    assert report["stacked_charts"] == 1 and np.allclose(np.sort(uvs[:2], 0), np.sort(uvs[2:], 0))
    assert corner_uvs(*two)[1]["stacked_charts"] == 0


def test_grids_become_rectangles():
    u, v = np.meshgrid(np.arange(7), np.arange(3), indexing="ij")
    positions = np.stack([(4 + v / 2) * np.cos(u / 6), (4 + v / 2) * np.sin(u / 6), 0 * u], -1).reshape(-1, 3)
    quads = np.array([[3 * i + j, 3 * i + 3 + j, 3 * i + 4 + j, 3 * i + 1 + j] for i in range(6) for j in range(2)])
    for straighten in (False, True):
        uvs = corner_uvs(positions, quads, straighten=straighten, seam_exchange_rate=0)[0].reshape(-1, 2)
        lines = sorted(len(np.unique((x / 0.1).round())) for x in uvs.T)
        assert (lines == [3, 7]) == straighten


def test_pages_of_another_ratio():
    strip = np.array([[0, 0, 0], [9, 0, 0], [9, 1, 0], [0, 1, 0]])
    report = corner_uvs(strip, [[0, 1, 2, 3]], mode="paper", free_aspect=True, texture_size=256)[1]
    assert report["page_width"] > 2 * report["page_height"] or report["page_height"] > 2 * report["page_width"]


def test_weights_of_materials():
    atlas = atlas_uv.Atlas(weight={9: 3})
    atlas.add_mesh(SQUARE, HALVES, materials=[5, 9])
    atlas.generate()
    a, b = (np.linalg.norm(c[1] - c[0]) for c in atlas.result().corner_uvs)
    assert b / a == pytest.approx(3 * np.sqrt(2), rel=1e-3)  # (0, 0) to (1, 1), and to (1, 0)
    with pytest.raises(ValueError, match="material 7 has a rule"):
        atlas.generate(weight={7: 2})


def test_charts_that_exist_are_kept():
    uvs = np.array([[0, 0], [1, 0], [1, 1], [0.25, 1]])
    for given in (uvs, uvs[HALVES], uvs[HALVES].reshape(-1, 2)):
        atlas = atlas_uv.Atlas(keep_uv=True, rotation="none")
        atlas.add_mesh(SQUARE, HALVES, uvs=given)
        assert atlas.generate()["is_valid"]
        kept = atlas.result().uvs[[0, 1, 2, 3]]
        scale = np.linalg.norm(kept[1] - kept[0])
        assert np.allclose((kept - kept[0]) / scale, uvs - uvs[0], atol=1e-4)


def test_charts_that_exist_merge():
    positions, faces = torus(20, 12)
    uvs = np.tile([[0, 0], [1, 0], [0, 1]], (len(faces), 1)) + 2 * np.repeat(np.arange(len(faces)), 3)[:, None]
    atlas = atlas_uv.Atlas(defragment=True)
    atlas.add_mesh(positions, faces, uvs=uvs)
    report = atlas.generate()
    assert report["is_valid"] and report["number_of_charts"] < len(faces) / 10
    with pytest.raises(ValueError, match="uvs"):
        corner_uvs(positions, faces, defragment=True)  # there is nothing to merge
    with pytest.raises(ValueError, match="defragment"):
        corner_uvs(positions, faces, uvs=uvs, defragment=True, symmetry="x")


def test_verify_and_pack():
    uvs = np.array([[0.2, 0.2], [0.6, 0.2], [0.6, 0.6], [0.2, 0.6]])
    assert atlas_uv.verify(SQUARE, HALVES, uvs)["is_valid"]
    order = np.array([2, 0, 3, 1])
    assert atlas_uv.verify(SQUARE, HALVES, uvs[order], np.argsort(order)[HALVES])["is_valid"]
    assert not atlas_uv.verify(SQUARE, HALVES, uvs, gutter=500)["is_valid"]  # too near to the border
    folded = atlas_uv.verify(SQUARE, HALVES, [[0, 0], [1, 0], [1, 1], [0.9, 0.1]])
    assert folded["flipped"] == 1 and not folded["is_valid"]
    two = np.concatenate([SQUARE, SQUARE + 2]), np.concatenate([HALVES, HALVES + 4])
    twice = np.concatenate([uvs, uvs])
    certificate = atlas_uv.verify(*two, twice)
    assert certificate["overlaps_between_charts"] > 0
    assert atlas_uv.verify(*two, twice, pages=[0, 0, 1, 1])["is_valid"]
    corner_uvs, pages, report = atlas_uv.pack(*two, twice, texture_size=128)
    assert report["is_valid"] and report["number_of_charts"] == 2 and pages.tolist() == [0] * 4
    assert atlas_uv.verify(*two, corner_uvs, texture_size=128, gutter=2)["is_valid"]
    for call in (atlas_uv.verify, atlas_uv.pack):
        with pytest.raises(ValueError, match="uvs are needed"):
            call(*two)


def test_progress_is_told_in_this_thread():
    heard = []
    atlas = atlas_uv.Atlas()
    atlas.add_mesh(*torus())
    atlas.generate(lambda stage, fraction: heard.append((stage, fraction, threading.get_ident())))
    stages = list(dict.fromkeys(stage for stage, _, _ in heard))
    assert stages == ["segmentation", "parameterization", "packing", "verification"]
    assert all(0 <= f <= 1 and thread == threading.get_ident() for _, f, thread in heard)


def test_wishes_for_pages_and_symmetry_arrive():
    atlas = atlas_uv.Atlas()
    atlas.add_mesh(SQUARE, HALVES)
    atlas.add_mesh(0.001 * np.asarray(SQUARE), HALVES)
    report = atlas.generate(min_coverage=0.25, min_texels_per_chart=16)
    assert report["min_coverage"] == 0.25
    assert report["enlarged_charts"] == 1
    atlas = atlas_uv.Atlas()
    atlas.add_mesh(*torus())
    as_it_is, mirrored = (corner_uvs(*torus(), symmetry=symmetry)[0] for symmetry in ("off", "auto"))
    assert not np.array_equal(as_it_is, mirrored)
    with pytest.raises(ValueError, match="symmetry"):
        atlas.generate(symmetry="w")
    with pytest.raises(ValueError, match="min_coverage"):
        atlas.generate(min_coverage=2)


def test_cancelling():
    atlas = atlas_uv.Atlas()
    atlas.add_mesh(*torus(96, 48))
    for last in ("segmentation", "packing"):
        with pytest.raises(atlas_uv.Cancelled):
            atlas.generate(lambda stage, fraction: stage != last)
        with pytest.raises(IndexError):
            atlas.result()

    class Oops(Exception):
        pass

    def fail(stage, fraction):
        raise Oops

    with pytest.raises(Oops):
        atlas.generate(fail)
    with pytest.raises(TimeoutError):
        atlas.generate(time_limit=1e-9)
    assert atlas.generate(time_limit=600)["is_valid"]


def test_ctrl_c_ends_the_work():
    atlas = atlas_uv.Atlas()
    atlas.add_mesh(*torus(600, 300))
    # Work in the background of a shell starts deaf to Ctrl-C.
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
        start = time.monotonic()
        with pytest.raises(KeyboardInterrupt):
            atlas.generate(effort="best", time_limit=60)
        assert time.monotonic() - start < 20
    finally:
        signal.signal(signal.SIGINT, before)


def test_other_threads_run_meanwhile():
    atlas = atlas_uv.Atlas()
    atlas.add_mesh(*torus(96, 48))
    thread = threading.Thread(target=atlas.generate)
    thread.start()
    turns = 0
    while thread.is_alive():
        turns += 1
        time.sleep(0.001)
    assert turns > 5


def test_baking():
    uvs = SQUARE[:, :2]
    colors = np.array([[1, 0, 0], [1, 0, 0], [0, 0, 1], [0, 0, 1]], float)
    image = atlas_uv.bake(SQUARE, HALVES, uvs, what="colors", colors=colors, size=(8, 16))
    assert image.shape == (16, 8, 3) and image.dtype == np.uint8
    assert image[0, 0, 2] > 240 and image[-1, 0, 0] > 240 and image[8, 4, 0] in range(110, 146)
    assert (atlas_uv.bake(SQUARE, HALVES, uvs, size=4) == [128, 128, 255]).all()
    tilted = np.tile([[0, 0.6, 0.8]], (4, 1))
    assert (atlas_uv.bake(SQUARE, HALVES, uvs, normals=tilted, size=4) == [128, 204, 230]).all()
    # An old texture, turned by half: the new page shows it upside down.
    old = np.zeros((8, 8, 3), np.uint8)
    old[:4] = 255
    new = atlas_uv.bake(SQUARE, HALVES, uvs, what="texture", texture=old, source_uvs=1 - uvs, size=8)
    assert (new[:3] == 0).all() and (new[5:] == 255).all()
    for wrong, words in [(dict(what="colors"), "colour"), (dict(what="texture"), "texture"), (dict(what="x"), "'occlusion'")]:
        with pytest.raises(ValueError, match=words):
            atlas_uv.bake(SQUARE, HALVES, uvs, **wrong)


def test_faces_of_a_selection_are_unwrapped():
    positions, faces = torus()
    first = atlas_uv.Atlas(texture_size=512)
    first.add_mesh(positions, faces)
    first.generate()
    old = first.result()
    chosen = positions[faces].mean(1)[:, 0] > 1
    atlas = atlas_uv.Atlas(texture_size=512)
    atlas.add_mesh(positions, faces, uvs=old.corner_uvs, selected=chosen)
    report = atlas.generate()
    new = atlas.result()
    assert report["is_valid"] and 0 < chosen.sum() < len(faces)
    assert np.array_equal(new.corner_uvs[~chosen], old.corner_uvs[~chosen])
    assert (new.corner_uvs[chosen] != old.corner_uvs[chosen]).any(2).any(1).mean() > 0.9
    assert atlas_uv.verify(positions, faces, new.corner_uvs)["is_valid"]
    for wrong, words in (
        (dict(selected=chosen), "uvs"), (dict(selected=chosen[1:], uvs=old.corner_uvs), "selected"),
        (dict(selected=chosen, uvs=old.corner_uvs + 5), r"\[0, 1\]"),
    ):
        with pytest.raises(ValueError, match=words):
            atlas = atlas_uv.Atlas()
            atlas.add_mesh(positions, faces, **wrong)
            atlas.generate()


def test_pinned_vertices_stay():
    positions, faces = torus()
    pinned = np.zeros(len(positions), bool)
    pinned[7] = True
    uvs = np.where(pinned[:, None], [0.5, 0.5], np.nan)
    atlas = atlas_uv.Atlas(texture_size=512)
    atlas.add_mesh(positions, faces, uvs=uvs, pinned=np.zeros(len(positions), bool))
    atlas.add_mesh(positions[faces[0]] + 9, [[0, 1, 2]], uvs=[[0.25, 0.3], [0.5, 0.3], [0.3, 0.45]], pinned=[True] * 3)
    report = atlas.generate()
    assert report["is_valid"] and report["moved_pins"] == []
    triangle = atlas.result(1).corner_uvs.reshape(-1, 2)
    assert np.array_equal(triangle, np.array([[0.25, 0.3], [0.5, 0.3], [0.3, 0.45]], np.float32))
    alone = atlas_uv.Atlas(texture_size=512)
    alone.add_mesh(positions, faces, uvs=uvs, pinned=pinned[faces])
    report = alone.generate()
    moved = {corner for pins in report["moved_pins"] for corner in pins["corners"]}
    kept = [c for c in np.flatnonzero(pinned[faces]) if c not in moved]
    assert report["is_valid"] and (alone.result().corner_uvs.reshape(-1, 2)[kept] == 0.5).all()
    for wrong, words in ((dict(pinned=pinned), "uvs"), (dict(pinned=pinned[1:], uvs=uvs), "pinned"), (dict(pinned=pinned, uvs=uvs + 5), r"\[0, 1\]")):
        with pytest.raises(ValueError, match=words):
            atlas = atlas_uv.Atlas()
            atlas.add_mesh(positions, faces, **wrong)
            atlas.generate()


def test_given_seams_alone_make_the_charts():
    positions, faces = torus()
    # Two rings cut the torus into two bent tubes, which are no discs: a cut more for each.
    ring = lambda i: [[12 * i + j, 12 * i + (j + 1) % 12] for j in range(12)]
    atlas = atlas_uv.Atlas(only_given_seams=True)
    atlas.add_mesh(positions, faces, seams=ring(0) + ring(12))
    report = atlas.generate()
    assert report["is_valid"] and report["number_of_charts"] == 2 and report["added_seams"] > 0


def test_seams_are_hidden():
    positions, faces = torus(32, 16)

    def seams_above(axis, add={}, **options):
        """The share of the length of seams whose middle lies on that side."""
        atlas = atlas_uv.Atlas(threads=1, **options)
        atlas.add_mesh(positions, faces, **add)
        atlas.generate()
        r = atlas.result()
        sides = {}
        for f, face in enumerate(faces):
            for k in range(3):
                a, b = face[k], face[(k + 1) % 3]
                here = tuple(map(tuple, r.corner_uvs[f, [k, (k + 1) % 3]]))
                sides.setdefault((min(a, b), max(a, b)), []).append(here if a < b else here[::-1])
        cut = np.array([edge for edge, (s, t) in sides.items() if s != t])
        length = np.linalg.norm(positions[cut[:, 0]] - positions[cut[:, 1]], axis=1)
        return length[positions[cut].mean(1) @ axis > 0].sum() / length.sum()

    up = np.array([0, 0, 1])
    assert seams_above(up, hide_seams="dome:z") < 0.42 < 0.55 < seams_above(up, hide_seams="dome:-z")
    assert seams_above(up, hide_seams="view:0,0,1") < 0.42
    above = (positions[:, 2] > 0).astype(float)
    assert seams_above(up, add=dict(visibility=above)) < 0.42 < 0.55 < seams_above(up, add=dict(visibility=1 - above))
    for wrong in ("dome", "view:w", "openly"):
        with pytest.raises(ValueError, match="openness"):
            seams_above(up, hide_seams=wrong)
    for wrong in (above[1:], above * 2):
        with pytest.raises(ValueError, match="visibility"):
            seams_above(up, add=dict(visibility=wrong))


def test_alpha_goes_along():
    uvs = SQUARE[:, :2]
    old = np.zeros((4, 4, 4), np.uint8)
    old[:, :2, 3] = 255
    new = atlas_uv.bake(SQUARE, HALVES, uvs, what="texture", texture=old, source_uvs=uvs, size=4)
    assert new.shape == (4, 4, 4) and (new[:, 0, 3] == 255).all() and (new[:, 3, 3] == 0).all()


def test_another_mesh_is_baked():
    # The scan lies a little above the square, is finer, and knows colours, a texture and normals.
    n = 8
    x, y = (a.ravel() for a in np.meshgrid(np.linspace(0, 1, n + 1), np.linspace(0, 1, n + 1)))
    i = np.arange(n * (n + 1)).reshape(n, n + 1)[:, :n].ravel()
    quads = np.stack([i, i + 1, i + n + 2, i + n + 1], -1)
    scan = np.stack([x, y, np.full_like(x, 0.01)], -1)
    tilted = np.tile([[0, 0.6, 0.8]], (len(scan), 1))
    texture = np.zeros((16, 16, 3), np.uint8)
    texture[:, 8:] = [200, 0, 0]
    source = atlas_uv.Source(
        scan, quads, tilted, scan[:, :2], colors=np.stack([x, y, 0 * x], -1), texture=texture
    )
    uvs = SQUARE[:, :2]
    bake = lambda what, **more: atlas_uv.bake(SQUARE, HALVES, uvs, what=what, source=source, size=16, **more).astype(int)
    centres = (np.arange(16) + 0.5) / 16 * 255
    assert abs(bake("colors")[..., 0] - centres).max() <= 1.5
    assert abs(bake("colors")[..., 1] - centres[::-1, None]).max() <= 1.5
    assert (bake("normals") == [128, 204, 230]).all()
    assert abs(bake("tangent-normals") - [128, 204, 230]).max() <= 1
    assert (bake("texture")[:, 2:6, 0] == 0).all() and (bake("texture")[:, 10:14, 0] == 200).all()
    heights = atlas_uv.bake(SQUARE, HALVES, uvs, what="displacement", source=source, size=(16, 8))
    assert heights.shape == (8, 16) and heights.dtype == np.float32 and np.allclose(heights, 0.01)
    with pytest.raises(ValueError, match="source"):
        atlas_uv.bake(SQUARE, HALVES, uvs, what="displacement")
    assert (bake("colors", cage=0) == bake("colors")).all()  # the nearest points are those above
    atlas = atlas_uv.Atlas(texture_size=32)
    atlas.add_mesh(SQUARE, HALVES)
    atlas.generate()
    assert (atlas.bake("normals", source=source) == [128, 204, 230]).all()
    with pytest.raises(ValueError, match="texture is needed"):
        atlas.bake("texture", source=atlas_uv.Source(scan, quads))
    with pytest.raises(ValueError, match="uvs are needed"):
        atlas_uv.Source(scan, quads, texture=texture)
    with pytest.raises(ValueError, match="cage"):
        bake("colors", cage=-1)


def test_seams_are_closed():
    positions, faces = torus()
    atlas = atlas_uv.Atlas(texture_size=128, mip_levels=2)
    atlas.add_mesh(positions, faces, colors=(positions - positions.min(0)) / np.ptp(positions, 0).max())
    atlas.generate()
    page = atlas.bake("colors")
    (closed,), difference = atlas.make_seamless([page])
    assert difference.seams > 10 and max(difference.before) > 2 and max(difference.after) <= 1
    assert closed.shape == page.shape and (closed != page).any()
    assert abs(closed.astype(int) - page).mean() < 8
    # By the coordinates alone it is the same; a page too few is refused.
    uvs = atlas.result().corner_uvs
    (again,), same = atlas_uv.make_seamless(positions, faces, uvs, images=[page])
    assert (again == closed).all() and same == difference
    with pytest.raises(ValueError):
        atlas_uv.make_seamless(positions, faces, uvs, images=[])


def test_welded_seams_are_closed():
    # Two squares that do not quite meet: only welded they have an edge in common.
    a = SQUARE[[0, 1, 2, 0, 2, 3]].copy()
    a[3:] += [0, 1e-7, 0]
    faces = np.arange(6).reshape(2, 3)
    for weld, seams in ((1e-5, 1), (0, 0)):
        atlas = atlas_uv.Atlas(texture_size=64, weld=weld)
        atlas.add_mesh(a, faces, colors=[[1, 0, 0]] * 3 + [[0, 0, 1]] * 3, materials=[0, 1])
        report = atlas.generate(separate_materials=True)
        assert report["number_of_charts"] == 2
        assert atlas.make_seamless([atlas.bake("colors")])[1].seams == seams
        assert atlas.generate(separate_materials=False)["number_of_charts"] == 2 - seams


def test_a_whole_atlas_is_baked():
    atlas = atlas_uv.Atlas(texture_size=64)
    red, blue = np.zeros((2, 2, 3), np.uint8), np.zeros((2, 2, 3), np.uint8)
    red[..., 0], blue[..., 2] = 200, 200
    atlas.add_mesh(SQUARE, HALVES, uvs=SQUARE[:, :2], texture=red)
    atlas.add_mesh(SQUARE + 5, HALVES, uvs=SQUARE[:, :2], texture=blue)
    with pytest.raises(IndexError):
        atlas.bake("texture")
    atlas.generate()
    image = atlas.bake("texture")
    assert image.shape == (64, 64, 3)
    assert {tuple(c) for c in image.reshape(-1, 3).tolist()} == {(200, 0, 0), (0, 0, 200)}
    for i, channel in enumerate((0, 2)):
        u, v = atlas.result(i).uvs.mean(0)
        assert image[int((1 - v) * 64), int(u * 64), channel] == 200
    picture = atlas.picture(128)
    assert picture.shape == (128, 128, 3) and picture.min() < 100 < picture.max()


def test_anything_can_be_baked():
    face, corner, weight = atlas_uv.sample_page(SQUARE, HALVES, SQUARE[:, :2] * 0.5, size=32)
    inside = face >= 0
    assert inside.sum() == 256 and inside[16:, :16].all()
    assert np.allclose(weight[inside].sum(1), 1)
    positions = (SQUARE[HALVES.ravel()][corner] * weight[..., None]).sum(2)
    y, x = np.nonzero(inside)
    assert np.allclose(positions[inside][:, 0] * 16, x + 0.5, atol=1e-4)
    assert np.allclose(positions[inside][:, 1] * 16, 32 - (y + 0.5), atol=1e-4)
    full = atlas_uv.fill_gutters(positions, inside)
    assert np.array_equal(full[0, 31], positions[16, 15])
