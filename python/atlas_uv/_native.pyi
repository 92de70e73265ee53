# SPDX-License-Identifier: MIT
# The compiled part. Call atlas_uv instead.
from typing import Any, Callable, Dict, List, Optional, Tuple

import numpy as np

__version__: str

class IOError(RuntimeError): ...

class Soup:
    def __init__(
        self,
        positions: np.ndarray,
        face_sizes: Optional[np.ndarray],
        indices: np.ndarray,
        uvs: Optional[np.ndarray],
        normals: Optional[np.ndarray],
        colors: Optional[np.ndarray],
        pages: Optional[np.ndarray],
    ) -> None: ...
    def set_old_uv(self, uvs: np.ndarray) -> None: ...
    def become_source(self) -> None: ...

class Scene:
    def __init__(self) -> None: ...
    def add(
        self,
        positions: np.ndarray,
        face_sizes: Optional[np.ndarray],
        indices: np.ndarray,
        uvs: Optional[np.ndarray],
        normals: Optional[np.ndarray],
        colors: Optional[np.ndarray],
        pages: Optional[np.ndarray],
        materials: Optional[np.ndarray],
        seams: Optional[np.ndarray],
        forbidden_seams: Optional[np.ndarray],
        visibility: Optional[np.ndarray],
        selected: Optional[np.ndarray],
        pinned: Optional[np.ndarray],
    ) -> None: ...
    def __len__(self) -> int: ...
    def generate(self, options: Dict[str, Any], progress: Optional[Callable[[str, float], Optional[bool]]]) -> str: ...
    def pack(self, options: Dict[str, Any], progress: Optional[Callable[[str, float], Optional[bool]]]) -> str: ...
    def verify(self, options: Dict[str, Any], is_single: bool) -> str: ...
    def report(self) -> Any: ...
    def summary(self) -> Dict[str, Any]: ...
    def result(self, mesh: int, is_owned: bool) -> Dict[str, np.ndarray]: ...
    def draw(self, size: int, page: int) -> np.ndarray: ...
    def textured(self) -> Soup: ...
    def welded(self) -> Soup: ...

has_occlusion: bool

def bake(
    soup: Soup,
    what: str,
    width: int,
    height: int,
    page: int,
    threads: int,
    samples: int,
    images: List[np.ndarray],
    face_texture: np.ndarray,
    detail: Optional[Soup],
    cage: float,
) -> np.ndarray: ...
def make_seamless(
    soup: Soup, pages: List[np.ndarray], are_tangent: bool, threads: int
) -> Tuple[List[np.ndarray], int, List[float], List[float]]: ...
def sample_page(soup: Soup, width: int, height: int, page: int) -> Tuple[np.ndarray, np.ndarray, np.ndarray]: ...
def nearest(covered: np.ndarray) -> np.ndarray: ...
