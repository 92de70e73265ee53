# SPDX-License-Identifier: MIT
"""The interface of the package xatlas, on Atlas: programs that import it run unchanged.

Options that speak of the inside of xatlas's algorithms have no counterpart and are kept without effect: all of `ChartOptions`
but `use_input_mesh_uvs` and `fix_winding`, and `max_chart_size` and `rotate_charts_to_axis` of `PackOptions`. Pages have the
resolution that was asked for, 1024 by default.
"""

import enum
import math
from typing import Any, List, Optional, Tuple

import atlas_uv
import numpy as np
from atlas_uv._arrays import index_array

__version__ = atlas_uv.__version__
__all__ = ["Atlas", "Chart", "ChartOptions", "ChartType", "PackOptions", "export", "parametrize"]

_Mesh = Tuple[np.ndarray, np.ndarray, np.ndarray]


class ChartType(enum.Enum):
    """How a chart was flattened. Those of Atlas are all `LSCM`."""

    Planar = 0
    Ortho = 1
    LSCM = 2
    Piecewise = 3
    Invalid = 4


class ChartOptions:
    """What charts are to be like."""

    def __init__(self) -> None:
        self.max_chart_area = 0.0
        self.max_boundary_length = 0.0
        self.normal_deviation_weight = 2.0
        self.roundness_weight = 0.01
        self.straightness_weight = 6.0
        self.normal_seam_weight = 4.0
        self.texture_seam_weight = 0.5
        self.max_cost = 2.0
        self.max_iterations = 1
        self.use_input_mesh_uvs = False
        self.fix_winding = False


class PackOptions:
    """What pages are to be like."""

    def __init__(self) -> None:
        self.max_chart_size = 0
        self.padding = 0
        self.texels_per_unit = 0.0
        self.resolution = 0
        self.bilinear = True
        self.blockAlign = False
        self.bruteForce = False
        self.create_image = False
        self.rotate_charts_to_axis = True
        self.rotate_charts = True


class Chart:
    """A chart of a mesh."""

    def __init__(self, faces: np.ndarray, atlas_index: int, material: int) -> None:
        self.faces = faces
        self.atlas_index = atlas_index
        self.type = ChartType.LSCM
        self.material = material


class Atlas:
    """Meshes that share pages."""

    def __init__(self) -> None:
        self._inputs: List[dict] = []
        self._atlas: Optional[atlas_uv.Atlas] = None
        self._meshes: List[_Mesh] = []
        self._charts: List[List[np.ndarray]] = []
        self._face_pages: List[np.ndarray] = []
        self._image_size = 0
        self.width = 0
        self.height = 0
        self.texels_per_unit = 0.0
        self.atlas_count = 0
        self.chart_count = 0
        self._utilization = 0.0

    def add_mesh(self, positions: Any, indices: Any, normals: Any = None, uvs: Any = None) -> None:
        """:raises ValueError: an array has the wrong shape :raises RuntimeError: an index is out of range"""
        positions = _rows("Position", positions, 3)
        indices = _triangles(indices, len(positions))
        if normals is not None:
            normals = _rows("Normal", normals, 3, len(positions))
        if uvs is not None:
            uvs = _rows("Texture coordinate", uvs, 2, len(positions))
        if any("is_flat" in mesh for mesh in self._inputs):
            raise RuntimeError("Adding mesh failed: meshes and uv meshes cannot be in one atlas")
        self._inputs.append(dict(mesh=positions, faces=indices, uvs=None if uvs is None else uvs[indices]))

    def add_uv_mesh(self, uvs: Any, indices: Any, face_materials: Any = None) -> None:
        """A mesh whose charts exist and are only to be packed."""
        uvs = _rows("Texture coordinate", uvs, 2)
        indices = _triangles(indices, len(uvs))
        if face_materials is not None:
            face_materials = np.asarray(face_materials)
            if face_materials.shape != (len(indices),):
                raise ValueError(
                    f"Face material ID array has invalid number of elements in the first dimension (expected {len(indices)})"
                )
            face_materials = index_array(face_materials, "face_materials")
        if any("is_flat" not in mesh for mesh in self._inputs):
            raise RuntimeError("Adding mesh failed: meshes and uv meshes cannot be in one atlas")
        flat = np.column_stack([uvs, np.zeros(len(uvs))])
        self._inputs.append(dict(mesh=flat, faces=indices, uvs=uvs[indices], materials=face_materials, is_flat=True))

    def generate(
        self, chart_options: Optional[ChartOptions] = None, pack_options: Optional[PackOptions] = None, verbose: bool = False
    ) -> None:
        """Makes charts, coordinates and pages."""
        charts, pack = chart_options or ChartOptions(), pack_options or PackOptions()
        if not self._inputs:
            return
        try:
            self._run(charts, pack)
        except atlas_uv.AtlasError:  # nothing has an area
            self._leave_at_origin()
        if verbose:
            print(f"--- Generated Atlas ---\nUtilization: {100 * self._utilization:f}%\nCharts: {self.chart_count}")
            print(f"Size: {self.width}x{self.height}\n")

    def get_mesh(self, mesh_index: int) -> _Mesh:
        """(vmapping, indices, uvs), arrays of your own. :raises IndexError"""
        self._check("Mesh", mesh_index, len(self._meshes))
        vmapping, indices, uvs = self._meshes[mesh_index]
        return vmapping.copy(), indices.copy(), uvs.copy()

    def get_mesh_vertex_assignment(self, mesh_index: int) -> Tuple[np.ndarray, np.ndarray]:
        """Per vertex: its page, and its chart in the atlas."""
        self._check("Mesh", mesh_index, len(self._meshes))
        vmapping, indices, _ = self._meshes[mesh_index]
        pages, charts = np.zeros(len(vmapping), np.uint32), np.full(len(vmapping), 0xFFFFFFFF, np.uint32)
        pages[indices] = self._face_pages[mesh_index][:, None]
        number = sum(map(len, self._charts[:mesh_index]))
        for i, faces in enumerate(self._charts[mesh_index]):
            charts[indices[faces]] = number + i
        return pages, charts

    def get_mesh_chart_count(self, mesh_index: int) -> int:
        self._check("Mesh", mesh_index, len(self._meshes))
        return len(self._charts[mesh_index])

    def get_mesh_chart(self, mesh_index: int, chart_index: int) -> Chart:
        self._check("Mesh", mesh_index, len(self._meshes))
        self._check("Chart", chart_index, len(self._charts[mesh_index]))
        faces = self._charts[mesh_index][chart_index]
        materials = self._inputs[mesh_index].get("materials")
        return Chart(faces, int(self._face_pages[mesh_index][faces[0]]), 0 if materials is None else int(materials[faces[0]]))

    def get_utilization(self, atlas_index: int) -> float:
        """The share of the pages that is covered; pages are not told apart."""
        self._check("Atlas", atlas_index, self.atlas_count)
        return self._utilization

    def get_chart_image(self, atlas_index: int) -> np.ndarray:
        """A page with its charts in colours, the first row at v = 0. :raises RuntimeError: none was asked for"""
        self._check("Atlas", atlas_index, self.atlas_count)
        if self._atlas is None or not self._image_size:
            raise RuntimeError("The atlas does not have an image.")
        return self._atlas.picture(self._image_size, atlas_index)[::-1].copy()

    @property
    def mesh_count(self) -> int:
        return len(self._meshes)

    @property
    def utilization(self) -> float:
        return self.get_utilization(0)

    @property
    def chart_image(self) -> np.ndarray:
        return self.get_chart_image(0)

    def __len__(self) -> int:
        return len(self._meshes)

    def __getitem__(self, mesh_index: int) -> _Mesh:
        return self.get_mesh(mesh_index)

    def _run(self, charts: ChartOptions, pack: PackOptions) -> None:
        is_flat = "is_flat" in self._inputs[0]
        atlas = atlas_uv.Atlas()
        for mesh in self._inputs:
            atlas.add_mesh(**{k: v for k, v in mesh.items() if k != "is_flat"})
        keeps_uv = bool(charts.use_input_mesh_uvs) and any(mesh["uvs"] is not None for mesh in self._inputs)

        def run(**page: Any) -> None:
            if is_flat:
                atlas.pack(**page)
            else:
                atlas.generate(keep_uv=keeps_uv, orient=bool(charts.fix_winding), **page)

        page = dict(
            gutter=max(float(pack.padding) + (1 if pack.bilinear else 0), 1.0),
            block=4 if pack.blockAlign else 1,
            rotation="any" if pack.rotate_charts else "none",
            effort="normal" if pack.bruteForce else "fast",
        )
        side = int(pack.resolution) or 1024
        run(texture_size=side, density=float(pack.texels_per_unit) if pack.resolution else 0.0, **page)
        if pack.texels_per_unit and not pack.resolution:  # one page, as large as it takes
            density = atlas.summary["texels_per_unit"]
            side = min(max(math.ceil(side * pack.texels_per_unit / density), 4), 65536)
            run(texture_size=side, **page)
        self._keep(atlas, side if pack.create_image else 0)

    def _keep(self, atlas: atlas_uv.Atlas, image_size: int) -> None:
        summary = atlas.summary
        self._atlas, self._image_size = atlas, image_size
        self.width, self.height = summary["width"], summary["height"]
        self.texels_per_unit, self._utilization = summary["texels_per_unit"], summary["efficiency"]
        self.atlas_count = summary["pages"]
        self._meshes, self._charts, self._face_pages = [], [], []
        for i in range(len(atlas)):
            result = atlas.result(i)
            self._meshes.append((result.vmapping, result.indices, result.uvs))
            self._face_pages.append(result.face_pages)
            order = np.argsort(result.face_charts, kind="stable")
            first = np.flatnonzero(np.diff(result.face_charts[order], prepend=-2))
            self._charts.append([f.astype(np.uint32) for f in np.split(order, first)[1:] if result.face_charts[f[0]] >= 0])
        self.chart_count = sum(map(len, self._charts))

    def _leave_at_origin(self) -> None:
        self._atlas, self._image_size = None, 0
        self.width = self.height = self.atlas_count = self.chart_count = 0
        self._meshes = [
            (np.arange(len(m["mesh"]), dtype=np.uint32), m["faces"], np.zeros((len(m["mesh"]), 2), np.float32))
            for m in self._inputs
        ]
        self._charts = [[] for _ in self._inputs]
        self._face_pages = [np.zeros(len(m["faces"]), np.uint32) for m in self._inputs]

    @staticmethod
    def _check(what: str, index: int, count: int) -> None:
        if not 0 <= index < count:
            raise IndexError(f"{what} index {index} out of bounds: there are {count}.")


def parametrize(positions: Any, indices: Any, normals: Any = None, uvs: Any = None) -> _Mesh:
    """(vmapping uint32, indices uint32, uvs float32) of one mesh."""
    atlas = Atlas()
    atlas.add_mesh(positions, indices, normals, uvs)
    atlas.generate()
    return atlas.get_mesh(0)


def export(path: str, positions: Any, indices: Any = None, uvs: Any = None, normals: Any = None) -> None:
    """Writes an OBJ file whose coordinates and normals are per vertex."""
    positions = _rows("Position", positions, 3)
    n = len(positions)
    uvs = None if uvs is None else _rows("Texture coordinate", uvs, 2, n)
    normals = None if normals is None else _rows("Normal", normals, 3, n)
    faces = None if indices is None else _triangles(indices, n)
    corner = "{0}/{0}/{0}" if uvs is not None and normals is not None else "{0}//{0}" if normals is not None else "{0}/{0}"
    corner = "{0}" if uvs is None and normals is None else corner
    try:
        file = open(path, "w")
    except OSError as error:
        raise ValueError(f"Cannot open path {path}: {error}") from None
    with file:
        for keyword, rows in (("v", positions), ("vn", normals), ("vt", uvs)):
            for row in () if rows is None else rows.tolist():
                file.write(f"{keyword} {' '.join(map(repr, row))}\n")
        for face in () if faces is None else (faces + 1).tolist():
            file.write(f"f {' '.join(map(corner.format, face))}\n")


def _rows(name: str, array: Any, columns: int, rows: Optional[int] = None) -> np.ndarray:
    array = np.asarray(array)
    if array.ndim != 2 or array.shape[1] != columns:
        raise ValueError(f"{name} array expected to be Nx{columns}.")
    if rows is not None and len(array) != rows:
        raise ValueError(
            f"{name} array has invalid number of elements in the first dimension (expected {rows}, got {len(array)})"
        )
    return np.ascontiguousarray(array, np.float32)


def _triangles(indices: Any, vertices: int) -> np.ndarray:
    array = np.asarray(indices)
    if array.ndim != 2 or array.shape[1] != 3:
        raise ValueError("Index array expected to be Nx3.")
    if array.dtype.kind == "f":
        array = np.trunc(array).astype(np.int64)
    if array.size and (array.min() < 0 or array.max() >= vertices):
        raise RuntimeError(f"Adding mesh failed: index out of range: there are {vertices} vertices")
    return np.ascontiguousarray(array, np.uint32)
