# SPDX-License-Identifier: MIT
"""The package xatlas on Atlas: what its users rely on."""

import numpy as np
import pytest
import xatlas
from meshes import box, check_result, torus, triangles_of

MESH = torus()


def normals(mesh=MESH):
    n = mesh[0] / np.linalg.norm(mesh[0], axis=1, keepdims=True)
    return n


@pytest.mark.parametrize(
    "arguments, words",
    [
        ((np.zeros(1), MESH[1]), "Nx3"),
        ((np.zeros((1, 1)), MESH[1]), "Nx3"),
        ((MESH[0], np.zeros(1)), "Nx3"),
        ((MESH[0], np.zeros((1, 1))), "Nx3"),
        ((*MESH, np.zeros(1)), "Nx3"),
        ((*MESH, np.zeros((1, 1))), "Nx3"),
        ((*MESH, np.zeros((1, 3))), "first dimension"),
        ((*MESH, normals(), np.zeros(1)), "Nx2"),
        ((*MESH, normals(), np.zeros((1, 1))), "Nx2"),
        ((*MESH, normals(), np.zeros((1, 2))), "first dimension"),
    ],
)
def test_shapes_are_checked(arguments, words):
    for call in (xatlas.Atlas().add_mesh, xatlas.parametrize):
        with pytest.raises(ValueError) as error:
            call(*arguments)
        assert words in str(error.value)


def test_indices_are_checked():
    with pytest.raises(RuntimeError) as error:
        xatlas.Atlas().add_mesh(np.zeros((1, 3)), MESH[1])
    assert "out of range" in str(error.value)


def test_generate():
    atlas = xatlas.Atlas()
    atlas.add_mesh(*MESH, normals())
    assert atlas.mesh_count == 0
    atlas.generate()
    assert atlas.mesh_count == len(atlas) == 1
    check_result(*MESH, *atlas.get_mesh(0))
    for a, b in zip(atlas[0], xatlas.parametrize(*MESH, normals())):
        assert np.array_equal(a, b)
    assert 1 <= atlas.chart_count < 20 and atlas.width >= 900 and atlas.height >= 900
    assert atlas.atlas_count == 1 and 0.3 < atlas.utilization == atlas.get_utilization(0) < 1
    pages, charts = atlas.get_mesh_vertex_assignment(0)
    assert pages.tolist() == [0] * len(atlas[0][0]) and set(charts) == set(range(atlas.chart_count))
    assert atlas.get_mesh_chart_count(0) == atlas.chart_count
    chart = atlas.get_mesh_chart(0, 0)
    assert chart.type == xatlas.ChartType.LSCM and chart.atlas_index == 0
    faces = np.concatenate([atlas.get_mesh_chart(0, i).faces for i in range(atlas.chart_count)])
    assert np.array_equal(np.sort(faces), np.arange(len(MESH[1])))
    assert set(charts[atlas[0][1][chart.faces]].ravel()) == {0}


def test_indices_of_results_are_checked():
    atlas = xatlas.Atlas()
    with pytest.raises(IndexError, match="out of bounds"):
        atlas.get_mesh(0)
    atlas.generate()
    atlas.add_mesh(*MESH)
    atlas.generate()
    atlas.get_mesh(0)
    for call in (atlas.get_mesh, atlas.get_mesh_chart_count, lambda i: atlas.get_mesh_chart(0, 1000 * i), atlas.get_utilization):
        with pytest.raises(IndexError, match="out of bounds"):
            call(1)
    with pytest.raises(RuntimeError, match="does not have an image"):
        atlas.chart_image


def test_options():
    atlas = xatlas.Atlas()
    atlas.add_mesh(box()[0], triangles_of(box()[1]))
    charts, pack = xatlas.ChartOptions(), xatlas.PackOptions()
    charts.max_iterations = 4
    pack.resolution, pack.padding, pack.create_image, pack.bruteForce = 256, 4, True, True
    atlas.generate(charts, pack)
    assert (atlas.width, atlas.height) == (256, 256) and atlas.chart_image.shape == (256, 256, 3)
    vmapping, indices, uvs = atlas[0]
    u, v = (uvs[indices[0]].mean(0) * 256).astype(int)
    assert atlas.chart_image[v, u].max() > 0  # the first row is at v = 0
    pack = xatlas.PackOptions()
    pack.texels_per_unit, pack.padding = 100, 2
    atlas.generate(pack_options=pack, verbose=True)
    assert atlas.texels_per_unit == pytest.approx(100, rel=0.05) and atlas.atlas_count == 1
    for _ in range(5):
        atlas.add_mesh(box()[0], triangles_of(box()[1]))
    pack.texels_per_unit, pack.resolution = 20, 128
    atlas.generate(chart_options=charts, pack_options=pack)
    assert atlas.atlas_count > 1 and atlas.width == 128
    assert atlas.texels_per_unit == pytest.approx(20)
    assert {atlas.get_mesh_chart(i, 0).atlas_index for i in range(6)} == set(range(atlas.atlas_count))


def test_uv_meshes_are_packed():
    uvs = np.array([[0, 0], [3, 0], [3, 3], [0, 3], [9, 9], [10, 9], [10, 10]], np.float32)
    faces = np.array([[0, 1, 2], [0, 2, 3], [4, 5, 6]])
    atlas = xatlas.Atlas()
    atlas.add_uv_mesh(uvs, faces, [1, 1, 2])
    atlas.add_uv_mesh(uvs, faces)
    atlas.generate()
    assert atlas.mesh_count == 2 and atlas.chart_count == 4
    assert sorted(atlas.get_mesh_chart(0, i).material for i in range(2)) == [1, 2]
    for i in range(2):
        vmapping, indices, packed = atlas[i]
        check_result(uvs, faces, vmapping, indices, packed)
        sides = [np.linalg.norm(packed[indices[f]][1] - packed[indices[f]][0]) for f in (0, 2)]
        assert sides[0] / sides[1] == pytest.approx(3, rel=1e-3)


def test_nothing_to_map_is_no_error():
    atlas = xatlas.Atlas()
    atlas.add_mesh(np.zeros((3, 3)), [[0, 1, 2]])
    atlas.generate()
    vmapping, indices, uvs = atlas[0]
    assert vmapping.tolist() == [0, 1, 2] and indices.tolist() == [[0, 1, 2]] and not uvs.any()


def test_export(tmp_path):
    positions, faces = MESH
    vmapping, indices, uvs = xatlas.parametrize(*MESH)
    for given, corner in [
        ({}, "{0}"), (dict(uvs=uvs), "{0}/{0}"), (dict(normals=normals()[vmapping]), "{0}//{0}"),
        (dict(uvs=uvs, normals=normals()[vmapping]), "{0}/{0}/{0}"),
    ]:
        xatlas.export(str(tmp_path / "out.obj"), positions[vmapping], indices, **given)
        lines = [line.split() for line in (tmp_path / "out.obj").read_text().splitlines()]
        read = np.array([row[1:] for row in lines if row[0] == "v"], float)
        assert np.allclose(read, positions[vmapping], atol=1e-6)
        assert [row[1:] for row in lines if row[0] == "f"] == [[corner.format(v + 1) for v in f] for f in indices.tolist()]
        assert sum(row[0] == "vt" for row in lines) == (len(uvs) if "uvs" in given else 0)
    with pytest.raises(ValueError, match="Cannot open path"):
        xatlas.export("/no/such/folder/out.obj", positions)


class Mesh:
    """As trimesh has it: a subclass of arrays, and a call that makes a mesh with coordinates of a mesh."""

    class Tracked(np.ndarray):
        pass

    def __init__(self, vertices, faces, uv=None):
        self.vertices, self.faces, self.uv = np.asarray(vertices).view(self.Tracked), np.asarray(faces).view(self.Tracked), uv

    def unwrap(self):
        vmapping, faces, uv = xatlas.parametrize(self.vertices, self.faces)
        return Mesh(self.vertices[vmapping], faces, uv)


def test_unwrap_of_a_mesh_library():
    mesh = Mesh(*MESH).unwrap()
    assert np.array_equal(mesh.vertices[mesh.faces], MESH[0][MESH[1]]) and len(mesh.uv) == len(mesh.vertices)


def test_call_of_reconstruction_pipelines():
    positions, faces = MESH[0].astype(np.float32), MESH[1].astype(np.int32)
    atlas = xatlas.Atlas()
    atlas.add_mesh(positions, faces)
    options = xatlas.ChartOptions()
    options.max_iterations = 4
    atlas.generate(chart_options=options)
    vmapping, ft, vt = atlas[0]
    check_result(positions, faces, vmapping, ft, vt)
    assert vmapping.astype(np.int64).max() < len(positions) and vt.astype(np.float32).min() >= 0
