# SPDX-License-Identifier: MIT
"""The Blender add-on: blender -b --factory-startup --python-exit-code 1 --python test_add_on.py -- FOLDER_OF_ATLAS_UV"""

import sys
import time
from pathlib import Path

sys.path[:0] = [sys.argv[-1], str(Path(__file__).parent)]

import atlas_uv
import bmesh
import bpy
import numpy as np
import unwrap_with_atlas as add_on


def scene(*makers):
    """An empty scene with what the operators `makers` add, all of it selected."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    for i, make in enumerate(makers):
        make(location=(4 * i, 0, 0))
    bpy.ops.object.select_all(action="SELECT")
    return list(bpy.context.selected_objects)


def cube(**where):
    bpy.ops.mesh.primitive_cube_add(size=2, calc_uvs=False, **where)


def grid(**where):
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=4, y_subdivisions=4, size=2, **where)


def coordinates(obj):
    """Faces x corners x 2, of an object whose faces have as many corners."""
    uvs = np.zeros(2 * len(obj.data.loops))
    obj.data.uv_layers.active.data.foreach_get("uv", uvs)
    return uvs.reshape(len(obj.data.polygons), -1, 2)


def mesh(obj):
    return np.array([obj.matrix_world @ v.co for v in obj.data.vertices]), [list(p.vertices) for p in obj.data.polygons]


def certificate(objects, **options):
    atlas = atlas_uv.Atlas(**options)
    for obj in objects:
        atlas.add_mesh(*mesh(obj), uvs=coordinates(obj))
    return atlas.verify()


def edit(objects, select):
    """Edit mode, with the faces selected for which select(object, face) holds."""
    bpy.context.view_layer.objects.active = objects[0]
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.context.tool_settings.mesh_select_mode = (False, False, True)
    for obj in objects:
        bm = bmesh.from_edit_mesh(obj.data)
        for face in bm.faces:
            face.select_set(select(obj, face))
        bm.select_flush_mode()
        bmesh.update_edit_mesh(obj.data)


def unwrap(**options):
    assert bpy.ops.uv.unwrap_with_atlas(**options) == {"FINISHED"}
    if bpy.context.mode == "EDIT_MESH":
        bpy.ops.object.mode_set(mode="OBJECT")


def test_objects_share_an_atlas_with_one_density():
    objects = scene(cube, grid)
    objects[0].scale = (2, 2, 2)
    bpy.context.view_layer.update()
    unwrap(width=512, height=512, gutter=3)
    assert certificate(objects, texture_size=512, gutter=3)["is_valid"]
    sides = [np.linalg.norm(np.diff(coordinates(o)[0][:2], axis=0)) for o in objects]
    lengths = [np.linalg.norm(np.diff(mesh(o)[0][mesh(o)[1][0][:2]], axis=0)) for o in objects]
    assert abs(sides[0] / lengths[0] / (sides[1] / lengths[1]) - 1) < 0.01


def test_selected_faces_only():
    objects = scene(grid, grid)
    first, second = objects
    before = [coordinates(o).copy() for o in objects]
    edit(objects, lambda obj, face: obj.name == first.name and face.index < 8)
    unwrap()
    after = coordinates(first)
    assert np.array_equal(after[8:], before[0][8:]) and np.array_equal(coordinates(second), before[1])
    assert (after[:8] != before[0][:8]).any((1, 2)).all()
    positions, faces = mesh(first)
    assert atlas_uv.verify(positions, faces[:8], after[:8])["is_valid"]


def test_other_faces_are_kept_clear_of():
    objects = scene(grid)
    (obj,) = objects
    for loop in obj.data.uv_layers.active.data:
        loop.uv = 0.1 + 0.5 * loop.uv.x, 0.1 + 0.5 * loop.uv.y
    before = coordinates(obj).copy()
    edit(objects, lambda obj, face: face.index < 8)
    unwrap(keep_clear=True)
    after = coordinates(obj)
    assert np.array_equal(after[8:], before[8:]) and (after[:8] != before[:8]).any((1, 2)).all()
    assert certificate(objects)["is_valid"]
    edit(objects, lambda obj, face: face.index < 8)
    try:
        bpy.ops.uv.unwrap_with_atlas(keep_clear=True, stack="copies")
    except RuntimeError as error:
        assert "stacked" in str(error)
    else:
        raise AssertionError("stacked")


def test_seams_are_cut():
    (obj,) = scene(grid)
    for edge in obj.data.edges:
        edge.use_seam = all(abs(obj.data.vertices[v].co.x) < 1e-6 for v in edge.vertices)
    for use_seams, charts in ((True, 2), (False, 1)):
        unwrap(use_seams=use_seams)
        assert certificate([obj])["charts"] == charts


def test_pinned_islands_stay():
    objects = scene(grid, cube)
    first = objects[0]
    uvs = first.data.uv_layers.active.data
    for loop in uvs:
        loop.uv = 0.1 + 0.3 * loop.uv.x, 0.2 + 0.3 * loop.uv.y
    before = coordinates(first).copy()
    edit(objects, lambda obj, face: True)
    bm = bmesh.from_edit_mesh(first.data)
    bm.faces.ensure_lookup_table()
    bm.faces[5].loops[0][bm.loops.layers.uv.active].pin_uv = True  # one vertex, the island stays
    bmesh.update_edit_mesh(first.data)
    unwrap(gutter=2)
    assert np.array_equal(coordinates(first), before)
    assert certificate(objects, texture_size=1024, gutter=2)["is_valid"]


def test_options_and_faults():
    (obj,) = scene(cube)
    unwrap(hard_angle=1.0)
    assert certificate([obj])["charts"] == 6
    unwrap(hard_angle=1.0, stack="copies")
    assert np.ptp([c.mean(0) for c in coordinates(obj)], axis=0).max() < 1e-3  # all in one place
    for wrong, words in ((dict(max_distortion=0.5), "max_distortion"), (dict(width=8, height=8, gutter=9), "gutter")):
        try:
            bpy.ops.uv.unwrap_with_atlas(**wrong)
        except RuntimeError as error:  # what operators report as an error
            assert words in str(error), error
        else:
            raise AssertionError(wrong)
    edit([obj], lambda obj, face: False)
    try:
        bpy.ops.uv.unwrap_with_atlas()
    except RuntimeError as error:
        assert "No faces" in str(error)
    else:
        raise AssertionError("no faces")


def test_progress_and_cancelling():
    """What the window does: a thread works on arrays, is asked for news, and told to stop."""
    (obj,) = scene(grid)
    before = coordinates(obj).copy()
    parts = [add_on.Part(obj)]
    job = add_on.Job(parts, {})
    job.thread.join()
    assert job.error is None and job.report["is_valid"] and job.news[0] == "verification"
    job = add_on.Job(parts, {"effort": "best", "texture_size": 4096})
    job.is_cancelled = True
    start = time.monotonic()
    job.thread.join()
    assert isinstance(job.error, atlas_uv.Cancelled) and time.monotonic() - start < 60
    assert np.array_equal(coordinates(obj), before)  # nothing is written before the end


def test_it_is_in_the_menus_and_leaves_them():
    menus = [getattr(bpy.types, name) for name in add_on.MENUS]
    functions = [menu.draw._draw_funcs for menu in menus]
    assert all(add_on.draw_menu in list_ for list_ in functions)
    add_on.unregister()
    assert not any(add_on.draw_menu in list_ for list_ in functions)
    assert not hasattr(bpy.types, "UV_OT_unwrap_with_atlas")
    add_on.register()


add_on.register()
tests = [test for name, test in sorted(globals().items()) if name.startswith("test_")]
for test in tests:
    test()
    print("passed:", test.__name__)
print(f"{len(tests)} passed, 0 failed")
