# SPDX-License-Identifier: MIT
"""parametrize(): the same faces, valid coordinates, whatever type of arrays comes in."""

import threading
from types import SimpleNamespace

import atlas_uv
import numpy as np
import pytest
from meshes import box, check_result, torus, triangles_of


@pytest.mark.parametrize("mesh", [torus(), (box()[0], triangles_of(box()[1]))])
def test_result_is_valid_and_fits(mesh):
    result = atlas_uv.parametrize(*mesh)
    check_result(*mesh, *result)
    vmapping, indices, uvs = result
    assert atlas_uv.verify(*mesh, uvs, indices)["is_valid"]
    assert atlas_uv.verify(mesh[0][vmapping], indices, uvs)["is_valid"]  # as a mesh of its own
    uvs[:] = 0  # the arrays are the caller's
    vmapping[0] = 7


def test_types_of_arrays_do_not_matter():
    positions, faces = box()[0], triangles_of(box()[1])
    positions = positions.astype(np.float32)
    first = atlas_uv.parametrize(positions, faces)
    padded = np.zeros((len(positions), 5))
    padded[:, 1:4] = positions
    for p, f in [
        (positions.astype(float), faces.astype(np.int32)),
        (positions.tolist(), faces.tolist()),
        (np.asfortranarray(positions), np.asfortranarray(faces)),
        (padded[:, 1:4], faces.astype(np.uint64)),
        (positions, faces.astype(float)),
        (SimpleNamespace(vertices=positions, faces=faces), None),  # trimesh
        (SimpleNamespace(vertices=positions, triangles=faces), None),  # Open3D
    ]:
        for a, b in zip(first, atlas_uv.parametrize(p, f)):
            assert np.array_equal(a, b)


def test_threads_do_not_matter():
    mesh = torus(12, 6)
    expected = atlas_uv.parametrize(*mesh, threads=1)
    results = [None] * 6

    def work(i):
        results[i] = atlas_uv.parametrize(*mesh, threads=i % 3)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(len(results))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for result in results:
        for a, b in zip(expected, result):
            assert np.array_equal(a, b)


def test_rejected_faces_stay_in_their_place():
    positions, quads = box()
    faces = triangles_of(quads)
    faces[3] = [1, 1, 2]
    atlas = atlas_uv.Atlas()
    atlas.add_mesh(positions, faces)
    report = atlas.generate()
    assert [f["face"] for f in report["rejected_faces"]] == [3]
    assert atlas.result().face_charts[3] == -1
    check_result(positions, faces, *atlas[0])


def test_polygons_of_all_sizes():
    positions = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [2, 0, 0], [3, 0.5, 0], [2, 1, 0]])
    faces = [[0, 1, 2, 3], [1, 4, 5, 6, 2], [0, 3, 1]]
    vmapping, indices, uvs = atlas_uv.parametrize(positions, faces)
    assert vmapping[indices].tolist() == sum(faces, [])
    vmapping, indices, uvs = atlas_uv.parametrize(*box())
    assert indices.shape == (6, 4)


def test_faults_have_clear_words():
    positions, faces = torus()
    for wrong, words in [
        (lambda: atlas_uv.parametrize(np.zeros(3), faces), "positions must be Nx3"),
        (lambda: atlas_uv.parametrize(np.zeros((4, 2)), faces), "positions must be Nx3"),
        (lambda: atlas_uv.parametrize(positions, np.zeros(3, int)), "indices must be Nx3"),
        (lambda: atlas_uv.parametrize(positions, faces + 0.5), "indices must be whole numbers"),
        (lambda: atlas_uv.parametrize(positions, -1 - faces), "out of range"),
        (lambda: atlas_uv.parametrize(positions[:5], faces), "out of range: there are 5 vertices"),
        (lambda: atlas_uv.parametrize(positions, faces, normals=np.zeros((1, 3))), "first dimension"),
        (lambda: atlas_uv.parametrize(positions, faces, uvs=np.zeros((1, 2))), "first dimension"),
        (lambda: atlas_uv.parametrize(positions, faces, gutter=-1), "gutter"),
        (lambda: atlas_uv.parametrize(positions, faces, texture_size=0), "width"),
        (lambda: atlas_uv.parametrize(positions, faces, mode="best"), "'few-seams'"),
        (lambda: atlas_uv.parametrize(positions, faces, max_charts=-1), "max_charts must be in 0 to"),
    ]:
        with pytest.raises(ValueError) as error:
            wrong()
        assert words in str(error.value)
    for wrong, words in [
        (lambda: atlas_uv.parametrize(positions, faces, size=1), "there is no option 'size'"),
        (lambda: atlas_uv.parametrize(positions, faces, max_charts=1.5), "max_charts must be an integer"),
        (lambda: atlas_uv.parametrize(positions, faces, gutter="wide"), "gutter must be a number"),
        (lambda: atlas_uv.parametrize(positions), "a mesh is"),
    ]:
        with pytest.raises(TypeError) as error:
            wrong()
        assert words in str(error.value)
    with pytest.raises(atlas_uv.AtlasError, match="no face of the mesh has an area"):
        atlas_uv.parametrize(np.zeros((3, 3)), [[0, 1, 2]])
    with pytest.raises(atlas_uv.AtlasError, match="no face"):
        atlas_uv.parametrize(positions, np.zeros((0, 3), int))
