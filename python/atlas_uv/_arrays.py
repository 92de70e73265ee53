# SPDX-License-Identifier: MIT
"""What users hand over, as arrays of the types that the compiled part takes."""

from __future__ import annotations

from typing import Any, NamedTuple, Optional

import numpy as np


class Mesh(NamedTuple):
    """Positions, and faces as a flat list of corners with the number of corners of each."""

    positions: np.ndarray  # N x 3, float64
    face_sizes: Optional[np.ndarray]  # uint32; None: triangles
    indices: np.ndarray  # uint32
    columns: int  # corners of every face if they are all alike, else 0

    @property
    def number_of_faces(self) -> int:
        return len(self.indices) // 3 if self.face_sizes is None else len(self.face_sizes)


def number_rows(array: Any, columns: int, name: str, rows: Optional[int] = None, dtype: Any = np.float64) -> np.ndarray:
    """An array of N x `columns` numbers."""
    try:
        result = np.ascontiguousarray(array, dtype=dtype)
    except (TypeError, ValueError) as error:
        raise ValueError(f"{name} must be Nx{columns} numbers: {error}") from None
    if result.ndim != 2 or result.shape[1] != columns:
        raise ValueError(f"{name} must be Nx{columns} numbers, but their shape is {_shape(array)}")
    if rows is not None and len(result) != rows:
        raise ValueError(
            f"{name} have the wrong size in the first dimension: {rows} are expected, but there are {len(result)}"
        )
    return result


def index_array(array: Any, name: str) -> np.ndarray:
    """Whole numbers in [0, 2^32) of any type and shape, as uint32."""
    result = np.asarray(array)
    if result.dtype == np.uint32:
        return np.ascontiguousarray(result)
    if result.size == 0:
        return np.zeros(result.shape, np.uint32)
    if result.dtype.kind not in "iu":
        if result.dtype.kind not in "fb" or not np.array_equal(result, np.floor(result)):
            raise ValueError(f"{name} must be whole numbers, but are of type {result.dtype}")
        result = result.astype(np.int64)
    if result.dtype.kind == "i" and result.min() < 0:
        raise ValueError(f"{name} must not be negative, but there is {result.min()}: out of range")
    if result.max() > 0xFFFFFFFF:
        raise ValueError(f"{name} must be below 2^32, but there is {result.max()}: out of range")
    return np.ascontiguousarray(result, dtype=np.uint32)


def per_face(array: Any, faces: int, name: str) -> Optional[np.ndarray]:
    """A whole number for each face."""
    if array is None:
        return None
    result = index_array(array, name)
    if result.shape != (faces,):
        raise ValueError(f"{name} must have one number for each of the {faces} faces, but their shape is {result.shape}")
    return result


def as_mesh(mesh: Any, faces: Any = None) -> Mesh:
    """Positions and faces, or an object that has them: trimesh's, Open3D's, or any with `vertices` and `faces`."""
    if faces is None:
        faces = getattr(mesh, "faces", None)
        if faces is None:
            faces = getattr(mesh, "triangles", None)
        mesh = getattr(mesh, "vertices", None)
        if mesh is None or faces is None:
            raise TypeError("a mesh is an object with vertices and faces (or triangles), or two arrays")
    positions = number_rows(mesh, 3, "positions")
    rows = _face_rows(faces)
    if rows is None:
        sizes = np.fromiter((len(face) for face in faces), np.uint32)
        corners = np.concatenate([np.asarray(face) for face in faces]) if len(sizes) else []
        return Mesh(positions, sizes, index_array(corners, "indices"), 0)
    if rows.ndim != 2 or (rows.shape[1] < 3 and rows.size > 0):
        raise ValueError(f"indices must be Nx3, or Nxk for polygons, but their shape is {rows.shape}")
    indices = index_array(rows, "indices")
    columns = rows.shape[1] or 3
    sizes = None if columns == 3 else np.full(len(rows), columns, np.uint32)
    return Mesh(positions, sizes, indices.reshape(-1), columns)


def corner_uvs(uvs: Any, uv_faces: Any, mesh: Mesh, name: str = "uvs") -> Optional[np.ndarray]:
    """Coordinates at corners, of those at vertices, at corners, or of a table with its own faces."""
    if uvs is None:
        return None
    array = np.asarray(uvs, np.float64)
    corners = len(mesh.indices)
    if array.ndim == 3 and uv_faces is None:  # faces x corners x 2
        array = array.reshape(-1, array.shape[2])
        return number_rows(array, 2, name, corners)
    array = number_rows(array, 2, name)
    if uv_faces is not None:
        table = as_mesh(np.zeros((len(array), 3)), uv_faces)
        if len(table.indices) != corners:
            raise ValueError(f"uv_faces must have as many corners as the faces, {corners}, but have {len(table.indices)}")
        if corners and table.indices.max() >= len(array):
            raise ValueError(f"uv_faces name row {table.indices.max()} of {name}, which is out of range: there are {len(array)}")
        return array[table.indices]
    if len(array) == len(mesh.positions):
        if corners and mesh.indices.max() >= len(array):
            raise ValueError(f"indices name vertex {mesh.indices.max()}, which is out of range: there are {len(array)} vertices")
        return array[mesh.indices]
    if len(array) == corners:
        return array
    raise ValueError(
        f"{name} have the wrong size in the first dimension: {len(mesh.positions)} are expected, one for each vertex "
        f"(or {corners}, one for each corner), but there are {len(array)}"
    )


def corner_flags(flags: Any, name: str, mesh: Mesh) -> np.ndarray:
    """Booleans at corners, of those at vertices or at corners."""
    array = np.ascontiguousarray(flags, bool).reshape(-1)
    corners, vertices = len(mesh.indices), len(mesh.positions)
    if len(array) == vertices and not (corners and mesh.indices.max() >= vertices):
        return array[mesh.indices]
    if len(array) == corners:
        return array
    raise ValueError(f"{name} must have an entry for each of the {vertices} vertices or {corners} corners, but have {len(array)}")


def colors_of(colors: Any, vertices: int) -> Optional[np.ndarray]:
    """Red, green, blue and perhaps alpha per vertex, in [0, 1] or as bytes."""
    if colors is None:
        return None
    array = np.asarray(colors)
    scale = 255.0 if array.dtype == np.uint8 else 1.0
    if array.ndim != 2 or array.shape[1] not in (3, 4) or len(array) != vertices:
        raise ValueError(f"colors must be {vertices}x3 or {vertices}x4 numbers, but their shape is {array.shape}")
    result = np.ones((vertices, 4), np.float32)
    result[:, : array.shape[1]] = array / scale
    return result


def _face_rows(faces: Any) -> Optional[np.ndarray]:
    """Faces as an array, if they all have the same number of corners."""
    if isinstance(faces, np.ndarray) and faces.dtype != object:
        return faces
    try:
        rows = np.asarray(faces)
    except ValueError:  # rows of different lengths
        return None
    if rows.dtype == object:
        return None
    if rows.size == 0 and rows.ndim == 1:
        return np.zeros((0, 3), np.uint32)
    return rows


def _shape(array: Any) -> Any:
    return np.shape(array)
