# SPDX-License-Identifier: MIT
"""Texture atlases of polygon meshes, proved free of flips and overlaps.

>>> import numpy as np, atlas_uv
>>> positions = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]])
>>> quads = [[3, 2, 1, 0], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
>>> faces = np.array([[a, b, c] for a, b, c, d in quads] + [[a, c, d] for a, b, c, d in quads])
>>> vmapping, indices, uvs = atlas_uv.parametrize(positions, faces)
>>> indices.shape, uvs.dtype, uvs.shape == (len(vmapping), 2)
((12, 3), dtype('float32'), True)
>>> bool((positions[vmapping][indices] == positions[faces]).all())  # the same faces in the same order
True
>>> atlas_uv.verify(positions, faces, uvs, indices)["is_valid"]
True

A mesh is two arrays, or one object that has `vertices` and `faces` (trimesh) or `triangles` (Open3D). Faces are triangles,
quads or any polygons; all of them come back, in their order. Texture coordinates are in the unit square of their page, with
the origin at the bottom left.

**Options** are keywords of `Atlas`, `Atlas.generate` and `pack`; `None` stands for the default:

========================  ============  ================================================================================
name                      default       meaning
========================  ============  ================================================================================
``mode``                  'standard'    'few-seams': fewer and larger charts with more distortion; 'conformal': least
                                        squares conformal maps as they are; 'paper': Lévy et al. 2002 to the letter
``max_distortion``        the mode's    bound under which charts merge, at least 1
``measure``               the mode's    what that bound is about: 'symmetric-dirichlet', 'l2-stretch', 'linf-stretch',
                                        'area-ratio', 'area-ratio-quantiles', 'quasi-conformal'
``max_stretch``           the mode's    besides, bound on how single triangles are stretched, at least 1
``max_stretch_share``     the mode's    the share of each chart's area that has to keep it
``straighten``            False         make rectangles of regular grids of quadrilaterals
``max_charts``            none          merge on until there are at most so many charts
``min_chart_texels``      none          merge charts of fewer texels with a neighbour
``min_coverage``          none          cut charts until they cover this share of the pages
``seam_exchange_rate``    the mode's    cut where that gives so many per cent more density for one of seam; 0: never
``min_texels_per_chart``  none          enlarge smaller charts up to so many texels
``symmetry``              'off'         'auto', 'x', 'y', 'z': mirrored charts where the surface is its own image
``hard_angle``            none          cut at edges sharper than so many degrees
``separate_materials``    False         no chart has faces of two materials
``only_given_seams``      False         charts are what seams, angles and materials make, whatever their distortion
``keep_uv``               False         keep the shapes of the charts that the meshes' own coordinates have
``defragment``            False         merge the charts of the meshes' own coordinates within the bounds; all others keep theirs
``hide_seams``            none          seams run where they are hardly seen: 'openness', 'view:AXIS', 'dome:AXIS', with an axis
                                        as '-y' or '0,1,1'; maps of your own are `visibility` of `Atlas.add_mesh`
``segmentation``          the mode's    who makes charts, which are not merged then: 'seams' (nobody: yours alone, and what discs
                                        need), 'features', 'normals', 'region-growing', 'variational', 'paper'
``parameterizer``         the mode's    who flattens them: 'bijective', 'bijective-conformal', 'lscm', 'abf', 'arap', 'floater',
                                        'harmonic', 'mean-value', 'schnyder', 'spectral', 'tutte'
``solver``, ``pins``      the mode's    of LSCM: 'direct', 'cg', 'pcg', 'multigrid', 'out-of-core'; 'sweep', 'diameter'
``optimizer``             the mode's    'none', 'symmetric-dirichlet', 'mips', 'stretch', 'stretch-fixed-border',
                                        'conformal-stretch'
``packer``                the mode's    'raster', 'horizon', 'rectangles', 'rows'
``weld``                  0             vertices nearer than this share of their mesh's size are one, as 1e-5
``orient``                False         turn faces around first so that neighbours agree; `indices` are of turned faces
``texture_size``          1024          side of the page in texels, or (width, height)
``gutter``                2             least distance between two charts in texels; half of it to the border
``pages``, ``density``    1, none       how many pages may be filled; texels per unit, on as many pages as that takes
``rotation``              'aligned'     'free', 'any', 'quarter', 'none': how charts may turn
``up``                    none          'x' ... '-z' or a direction: what is up in space is up on the page
``snap``                  False         straight borders of charts lie on borders of texels
``free_aspect``           False         the page may have another ratio of its sides
``mip_levels``            0             keep charts apart down to this level of a mip-map
``block``                 1             no two charts share a block of so many texels squared
``stack``                 'none'        'copies': charts that are equal share a place; 'mirrored': mirror images too
``effort``                'fast'        'normal', 'best': look longer for a tighter packing
``weight``                none          {material: factor}: so many times the density
``group``, ``lock``       none          [material, ...]: charts keep the places beside each other, or stay where they are
``threads``               0             0 takes all cores; the result is the same for any number
``time_limit``            none          seconds, then TimeoutError
========================  ============  ================================================================================
"""

from __future__ import annotations

import warnings
from typing import Any, Callable, Dict, Iterator, List, NamedTuple, Optional, Tuple, Union

import numpy as np

from . import _native
from ._arrays import Mesh as _Mesh
from ._arrays import as_mesh, colors_of, corner_flags, corner_uvs, index_array, number_rows, per_face

__version__: str = _native.__version__
__all__ = [
    "Atlas", "AtlasError", "AtlasWarning", "Cancelled", "Result", "SeamDifference", "Source", "bake", "fill_gutters",
    "make_seamless", "pack", "parametrize", "sample_page", "verify",
]

#: Called with the name of a stage and the fraction of it that is done; returning False cancels.
Progress = Callable[[str, float], Optional[bool]]


class AtlasError(RuntimeError):
    """There is no atlas: no face has an area, or the pages have no room."""


class Cancelled(AtlasError):
    """The progress callback returned False."""


class AtlasWarning(UserWarning):
    """There are coordinates, but the certificate names faults."""


class Result(NamedTuple):
    """Coordinates of one mesh. The arrays are views that cannot be written to.

    Polygons that do not all have the same number of corners come as flat lists of corners, face by face.
    """

    corner_uvs: np.ndarray  #: F x k x 2 float32 (or C x 2): per corner of each face
    vmapping: np.ndarray  #: N uint32: per new vertex, the vertex that it was
    indices: np.ndarray  #: F x k uint32 (or C): per corner, its new vertex
    uvs: np.ndarray  #: N x 2 float32: per new vertex
    face_charts: np.ndarray  #: F int64: charts count over the whole atlas; -1: the face was rejected
    face_pages: np.ndarray  #: F uint32
    triangles: np.ndarray  #: T x 3 uint32: the triangles that polygons were taken for, of new vertices
    face_of_triangle: np.ndarray  #: T uint32
    turned_faces: np.ndarray  #: the faces that were turned around


class SeamDifference(NamedTuple):
    """How much the two sides of seams differ, all along them, in what a renderer shows of a texture.

    Largest differences of a component from 0 to 255, at the mip levels 0, 1 and 2.
    """

    seams: int  #: edges whose two sides lie apart on the page
    before: Tuple[float, float, float]
    after: Tuple[float, float, float]


class Source:
    """A mesh that textures of another one are made from, such as the scan that it has been simplified from.

    >>> scan = Source([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], colors=[[1, 0, 0]] * 3)
    >>> bake([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]], [[0, 0], [1, 0], [0, 1]], what="colors", source=scan, size=2)[1, 0].tolist()
    [255, 0, 0]
    """

    def __init__(
        self, mesh: Any, faces: Any = None, normals: Any = None, uvs: Any = None, *, uv_faces: Any = None, colors: Any = None,
        texture: Any = None,
    ) -> None:
        """See `Atlas.add_mesh()`. `uvs` are those of its `texture`."""
        m = as_mesh(mesh, faces)
        if texture is not None and uvs is None:
            raise ValueError("uvs are needed, the coordinates that the texture belongs to")
        self._soup = _soup(m, corner_uvs(uvs, uv_faces, m), normals, colors_of(colors, len(m.positions)), None)
        self._soup.become_source()
        self._images = [] if texture is None else [_picture(texture)]
        self._face_texture = np.zeros(m.number_of_faces, np.uint32)


def _raise_unless_done(word: str) -> None:
    if word == "cancelled":
        raise Cancelled("the progress callback asked to stop")
    if word == "out of time":
        raise TimeoutError("not finished within the time limit")
    if word == "no surface":
        raise AtlasError("no face of the mesh has an area")
    if word == "no room":
        raise AtlasError("the pages have no room for the charts")


class Atlas:
    """Meshes that share one atlas.

    >>> square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])
    >>> atlas = Atlas(texture_size=256, gutter=4)
    >>> atlas.add_mesh(square, [[0, 1, 2, 3]])
    0
    >>> atlas.add_mesh(2 * square, [[0, 1, 2], [0, 2, 3]])
    1
    >>> report = atlas.generate()
    >>> report["is_valid"], report["number_of_charts"], report["pages"]
    (True, 2, 1)
    >>> len(atlas), atlas.result(0).corner_uvs.shape
    (2, (1, 4, 2))
    >>> vmapping, indices, uvs = atlas[1]
    >>> indices.tolist()
    [[0, 1, 2], [0, 2, 3]]
    """

    def __init__(self, **options: Any) -> None:
        """:param options: see the module; they hold for all calls, which can change them"""
        self._scene = _native.Scene()
        self._options = options
        self._meshes: List[_Mesh] = []
        self._textures: List[Optional[np.ndarray]] = []
        self._report: Dict[str, Any] = {}

    def add_mesh(
        self, mesh: Any, faces: Any = None, normals: Any = None, uvs: Any = None, *, uv_faces: Any = None,
        colors: Any = None, materials: Any = None, pages: Any = None, seams: Any = None, forbidden_seams: Any = None,
        texture: Any = None, visibility: Any = None, selected: Any = None, pinned: Any = None,
    ) -> int:
        """Adds a mesh and returns its number.

        :param mesh: positions, N x 3; or an object with vertices and faces
        :param faces: F x k, or a list of polygons
        :param normals: per vertex, for baking; shapes and charts do not depend on them
        :param uvs: coordinates that there are, per vertex or corner, or a table of which `uv_faces` name the rows;
            NaN where there are none. For `keep_uv`, `lock`, `group`, `pack`, `verify` and baking of `texture`
        :param colors: per vertex, for baking
        :param materials: a number per face
        :param pages: the page of the coordinates of each face
        :param seams: edges that must be seams, pairs of vertices
        :param forbidden_seams: edges that must not be seams, as far as topology allows
        :param texture: the picture that `uvs` are about, height x width x 3 or 4 bytes, the first row on top
        :param selected: per face, whether it is unwrapped anew; all others keep their `uvs`, in the unit square
            of their `pages`, to the bit
        :param pinned: per vertex or corner, whether it keeps its `uvs`, in the unit square; charts follow. What could not be
            kept is in `moved_pins` of the report
        :param visibility: how much each vertex is seen, in [0, 1]; seams run where it is small
        :raises ValueError: an array has the wrong shape, or names what does not exist
        """
        m = as_mesh(mesh, faces)
        n, f = len(m.positions), m.number_of_faces
        self._scene.add(
            positions=m.positions,
            face_sizes=m.face_sizes,
            indices=m.indices,
            uvs=corner_uvs(uvs, uv_faces, m),
            normals=None if normals is None else number_rows(normals, 3, "normals", n),
            colors=colors_of(colors, n),
            pages=per_face(pages, f, "pages"),
            materials=per_face(materials, f, "materials"),
            seams=_edges(seams, "seams"),
            forbidden_seams=_edges(forbidden_seams, "forbidden_seams"),
            selected=None if selected is None else np.ascontiguousarray(selected, bool),
            pinned=None if pinned is None else corner_flags(pinned, "pinned", m),
            visibility=None if visibility is None else np.ascontiguousarray(visibility, np.float64),
        )
        self._meshes.append(m)
        self._textures.append(None if texture is None else _picture(texture))
        return len(self._meshes) - 1

    def generate(self, progress: Optional[Progress] = None, **options: Any) -> Dict[str, Any]:
        """Makes the atlas, and returns the report. Other threads run meanwhile; Ctrl-C ends it.

        :param progress: called, in this thread, with the name of a stage and the fraction of it that is done;
            returning False cancels, and what it raises ends the work too
        :raises Cancelled, TimeoutError, AtlasError: there is no atlas
        :raises ValueError, TypeError: an option cannot be

        >>> atlas = Atlas()
        >>> atlas.add_mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
        0
        >>> atlas.generate(lambda stage, fraction: False)
        Traceback (most recent call last):
        atlas_uv.Cancelled: the progress callback asked to stop
        """
        word = self._scene.generate({**self._options, **options}, progress)
        self._report = self._scene.report()
        _raise_unless_done(word)
        return self._report

    def pack(self, progress: Optional[Progress] = None, **options: Any) -> Dict[str, Any]:
        """Packs the coordinates that the meshes came with anew, and returns a report."""
        word = self._scene.pack({**self._options, **options}, progress)
        self._report = self._scene.report()
        _raise_unless_done(word)
        return self._report

    def verify(self, precision: str = "single", **options: Any) -> Dict[str, Any]:
        """Examines the coordinates that the meshes came with, and returns the certificate.

        Of the options `texture_size`, `gutter` (0 here, unless given) and `threads` count.
        """
        if precision not in ("single", "double"):
            raise ValueError(f"precision must be 'single' or 'double', but is {precision!r}")
        self._scene.verify({"gutter": 0, **self._options, **options}, precision == "single")
        self._report = self._scene.report()
        return self._report

    @property
    def report(self) -> Dict[str, Any]:
        """What the last call said. Empty before."""
        return self._report

    @property
    def summary(self) -> Dict[str, Any]:
        """charts, pages, width, height, texels_per_unit, efficiency"""
        return self._scene.summary()

    def result(self, mesh: int = 0) -> Result:
        """All arrays of a mesh, as views without copies. :raises IndexError: there are no coordinates"""
        return self._result(mesh, False)

    def _result(self, mesh: int, is_owned: bool) -> Result:
        if not 0 <= mesh < len(self._meshes):
            raise IndexError(f"mesh {mesh} is out of bounds: there are {len(self._meshes)} meshes")
        arrays = self._scene.result(mesh, is_owned)
        columns = self._meshes[mesh].columns
        charts = arrays["face_charts"].astype(np.int32).astype(np.int64)  # 2^32 - 1 is -1
        if columns:
            arrays["corner_uvs"] = arrays["corner_uvs"].reshape(-1, columns, 2)
            arrays["indices"] = arrays["indices"].reshape(-1, columns)
        return Result(**{**arrays, "face_charts": charts})

    def __len__(self) -> int:
        return len(self._meshes)

    def __getitem__(self, mesh: int) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
        """vmapping, indices and uvs of a mesh, as arrays of your own."""
        r = self._result(mesh, False)
        return r.vmapping.copy(), r.indices.copy(), r.uvs.copy()

    def __iter__(self) -> Iterator[Tuple[np.ndarray, np.ndarray, np.ndarray]]:
        return (self[i] for i in range(len(self)))

    def picture(self, size: int = 1024, page: int = 0) -> np.ndarray:
        """A page with its charts in colours: height x width x 3 bytes, the first row on top."""
        return self._scene.draw(size, page)

    def bake(
        self, what: str, size: Union[int, Tuple[int, int], None] = None, page: int = 0, *, threads: int = 0, samples: int = 64,
        source: Optional[Source] = None, cage: float = 0.02,
    ) -> np.ndarray:
        """A texture for a page of all meshes: see `bake()`. The size is that of the page unless given."""
        if not self._report:
            raise IndexError("there are no coordinates yet")
        summary = self.summary
        size = size or (summary["width"], summary["height"])
        if source is not None:
            return _bake(self._scene.textured(), what, size, page, threads, samples, source, cage)
        used = [t for t in self._textures if t is not None]
        number = np.cumsum([t is not None for t in self._textures]) - 1
        faces = [
            np.full(m.number_of_faces, n if t is not None else 0xFFFFFFFF, np.uint32)
            for m, t, n in zip(self._meshes, self._textures, number)
        ]
        return _bake(
            self._scene.textured(), what, size, page, threads, samples, None, cage, used, np.concatenate(faces)
        )

    def make_seamless(
        self, images: List[np.ndarray], *, tangent_normals: bool = False, threads: int = 0
    ) -> Tuple[List[np.ndarray], SeamDifference]:
        """Changes the pictures of all pages so that both sides of seams show the same: see `make_seamless()`.

        >>> atlas = Atlas(texture_size=64, mip_levels=2)
        >>> atlas.add_mesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]], colors=np.eye(4, 3))
        0
        >>> _ = atlas.generate()
        >>> pages, difference = atlas.make_seamless([atlas.bake("colors")])
        >>> difference.seams > 0, max(difference.after) <= 1
        (True, True)
        """
        if not self._report:
            raise IndexError("there are no coordinates yet")
        soup = self._scene.textured() if tangent_normals else self._scene.welded()
        return _make_seamless(soup, images, tangent_normals, threads)


def parametrize(
    positions: Any, indices: Any = None, normals: Any = None, uvs: Any = None, **options: Any
) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The atlas of one mesh: (vmapping uint32, indices uint32, uvs float32).

    New vertex i is vertex ``vmapping[i]`` of the mesh with the coordinates ``uvs[i]``; ``indices`` are the faces of the mesh in
    their order, of new vertices. `normals` and `uvs` are checked, but the atlas depends on positions alone, unless
    ``keep_uv=True`` is among the options.

    >>> vmapping, indices, uvs = parametrize([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> vmapping.tolist(), indices.tolist(), uvs.shape
    ([0, 1, 2], [[0, 1, 2]], (3, 2))

    :raises ValueError: an array or an option cannot be
    :raises AtlasError: no face has an area
    """
    progress = options.pop("progress", None)
    atlas = Atlas(**options)
    atlas.add_mesh(positions, indices, normals, uvs)
    report = atlas.generate(progress)
    if not report["is_valid"]:
        warnings.warn(report["certificate"]["message"], AtlasWarning, stacklevel=2)
    result = atlas._result(0, True)  # nobody else will see them
    return result.vmapping, result.indices, result.uvs


def verify(
    positions: Any, faces: Any = None, uvs: Any = None, uv_faces: Any = None, *, pages: Any = None,
    texture_size: Union[int, Tuple[int, int], None] = None, gutter: float = 0, precision: str = "single", threads: int = 0,
) -> Dict[str, Any]:
    """Proves or disproves that coordinates, whoever made them, are an atlas; returns the certificate.

    :param uvs: per vertex, per corner, or a table of which `uv_faces` name the rows
    :param pages: the page of each face; default: all on one
    :param gutter: texels between charts that are asked for

    >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    >>> triangles = [[0, 1, 2], [0, 2, 3]]
    >>> verify(square, triangles, [[.1, .1], [.9, .1], [.9, .9], [.1, .9]])["is_valid"]
    True
    >>> certificate = verify(square, triangles, [[.1, .1], [.9, .1], [.9, .9], [.8, .2]])
    >>> certificate["is_valid"], certificate["flipped"], certificate["culprits"]
    (False, 1, [0, 1])
    """
    if uvs is None:
        raise ValueError("uvs are needed")
    atlas = Atlas(texture_size=texture_size, threads=threads)
    atlas.add_mesh(positions, faces, uvs=uvs, uv_faces=uv_faces, pages=pages)
    return atlas.verify(precision, gutter=gutter)


def pack(
    positions: Any, faces: Any = None, uvs: Any = None, uv_faces: Any = None, *, materials: Any = None,
    progress: Optional[Progress] = None, **options: Any,
) -> Tuple[np.ndarray, np.ndarray, Dict[str, Any]]:
    """Packs coordinates anew, whoever made them; the shapes of charts stay as they are.

    :returns: per corner its coordinates, per face its page, and a report

    >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    >>> corner_uvs, face_pages, report = pack(square, [[0, 1, 2, 3]], [[5, 5], [6, 5], [6, 6], [5, 6]], gutter=0)
    >>> corner_uvs.shape, report["number_of_charts"], report["packing_efficiency"] > 0.99
    ((1, 4, 2), 1, True)
    """
    if uvs is None:
        raise ValueError("uvs are needed")
    atlas = Atlas(**options)
    atlas.add_mesh(positions, faces, uvs=uvs, uv_faces=uv_faces, materials=materials)
    report = atlas.pack(progress)
    result = atlas._result(0, True)
    return result.corner_uvs, result.face_pages, report


def bake(
    positions: Any, faces: Any, uvs: Any, uv_faces: Any = None, *, what: str = "normals",
    size: Union[int, Tuple[int, int]] = 1024, pages: Any = None, page: int = 0, colors: Any = None, normals: Any = None,
    texture: Any = None, source_uvs: Any = None, source_uv_faces: Any = None, threads: int = 0, samples: int = 64,
    source: Optional[Source] = None, cage: float = 0.02,
) -> np.ndarray:
    """A texture: height x width x 3 bytes (4, if an old one has alpha), the first row on top, gutters filled to the end of the page.

    :param what: 'colors' of the vertices; 'normals', those given or smooth ones, in the space of the model;
        'tangent-normals', the same in the frames of MikkTSpace; the old 'texture', to which `source_uvs` belong; ambient
        'occlusion'; the 'displacement' of the source along the normals, height x width floats in the unit of the mesh
    :param source: another mesh, whose surface is shown: its colours, normals, texture or occlusion, or where it is
    :param cage: how far the source is looked for along normals, as a share of its diagonal; beyond, and for 0, at its nearest point

    Occlusion and sources are there only where the module was built with CGAL's AABB tree, which is under the GPL: not by pip.

    >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    >>> bake(square, [[0, 1, 2, 3]], [[0, 0], [1, 0], [1, 1], [0, 1]], size=4)[0, 0].tolist()  # straight up
    [128, 128, 255]
    """
    m = as_mesh(positions, faces)
    n, f = len(m.positions), m.number_of_faces
    soup = _soup(m, _needed_uvs(uvs, uv_faces, m), normals, colors_of(colors, n), per_face(pages, f, "pages"))
    images = []
    if texture is not None:
        old = corner_uvs(source_uvs, source_uv_faces, m, "source_uvs")
        if old is None:
            raise ValueError("source_uvs are needed, the coordinates that the old texture belongs to")
        soup.set_old_uv(old)
        images = [_picture(texture)]
    return _bake(soup, what, size, page, threads, samples, source, cage, images, np.zeros(f, np.uint32))


def make_seamless(
    positions: Any, faces: Any, uvs: Any, uv_faces: Any = None, *, images: List[np.ndarray], pages: Any = None, normals: Any = None,
    tangent_normals: bool = False, threads: int = 0,
) -> Tuple[List[np.ndarray], SeamDifference]:
    """Changes textures near seams, as little as it takes, so that both sides of every seam show the same.

    :param images: a picture for each page, of one size, height x width x 3 or 4 bytes, the first row on top
    :param tangent_normals: whether the pictures show normals in tangent space
    :returns: the new pictures, and what the sides of seams differ in: at most 1 of 255 at mip levels 0 to 2, unless what crosses
        the seams has detail of a few texels, or gutters are narrower than ``mip_levels=2`` makes them

    >>> square = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
    >>> uvs = [[[.1, .1], [.4, .1], [.4, .9]], [[.6, .1], [.9, .9], [.6, .9]]]
    >>> page = np.zeros((64, 64, 3), np.uint8)
    >>> page[:, 32:] = 100
    >>> pages, difference = make_seamless(square, [[0, 1, 2], [0, 2, 3]], uvs, images=[page])
    >>> difference.seams, difference.before[0], max(difference.after) <= 1
    (1, 100.0, True)
    """
    m = as_mesh(positions, faces)
    soup = _soup(m, _needed_uvs(uvs, uv_faces, m), normals, None, per_face(pages, m.number_of_faces, "pages"))
    return _make_seamless(soup, images, tangent_normals, threads)


def sample_page(
    positions: Any, faces: Any, uvs: Any, uv_faces: Any = None, *, size: Union[int, Tuple[int, int]] = 1024, pages: Any = None,
    page: int = 0,
) -> Tuple[np.ndarray, np.ndarray, np.ndarray]:
    """What each texel shows: its face (-1: nothing), three corners, and their weights. For baking anything.

    Corners count face by face. With values per corner, ``(values[corners] * weights[..., None]).sum(2)`` is a texture of
    them, and `fill_gutters()` completes it.

    >>> square = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0.]])
    >>> face, corner, weight = sample_page(square, [[0, 1, 2, 3]], square[:, :2] / 2, size=4)
    >>> (face >= 0).astype(int).tolist()
    [[0, 0, 0, 0], [0, 0, 0, 0], [1, 1, 0, 0], [1, 1, 0, 0]]
    >>> heights = (square[corner, 1] * weight).sum(2)
    >>> np.round(fill_gutters(heights, face >= 0)[:, 0], 2).tolist()
    [0.75, 0.75, 0.75, 0.25]
    """
    m = as_mesh(positions, faces)
    soup = _soup(m, _needed_uvs(uvs, uv_faces, m), None, None, per_face(pages, m.number_of_faces, "pages"))
    width, height = _size(size)
    return _native.sample_page(soup, width, height, page)


def fill_gutters(image: Any, covered: Any) -> np.ndarray:
    """Gives texels that are not covered the value of the nearest one that is, to the end of the page."""
    image = np.asarray(image)
    covered = np.asarray(covered, bool)
    if image.shape[:2] != covered.shape:
        raise ValueError(f"covered must have the shape {image.shape[:2]} of the image, but has {covered.shape}")
    nearest = _native.nearest(covered)
    return image.reshape((-1,) + image.shape[2:])[nearest].reshape(image.shape)


def _edges(edges: Any, name: str) -> Optional[np.ndarray]:
    if edges is None:
        return None
    result = index_array(edges, name)
    if result.size == 0:
        return None
    if result.ndim != 2 or result.shape[1] != 2:
        raise ValueError(f"{name} must be Nx2 vertices, but their shape is {result.shape}")
    return result


def _picture(texture: Any) -> np.ndarray:
    array = np.asarray(texture)
    if array.ndim != 3 or array.shape[2] not in (3, 4) or array.dtype != np.uint8:
        raise ValueError("texture must be height x width x 3 or 4 bytes")
    return np.ascontiguousarray(array)


def _size(size: Union[int, Tuple[int, int]]) -> Tuple[int, int]:
    width, height = (size, size) if np.isscalar(size) else size
    return int(width), int(height)


def _needed_uvs(uvs: Any, uv_faces: Any, mesh: _Mesh) -> np.ndarray:
    result = corner_uvs(uvs, uv_faces, mesh)
    if result is None:
        raise ValueError("uvs are needed")
    return result


def _soup(mesh: _Mesh, uvs: Any, normals: Any, colors: Any, pages: Any) -> Any:
    if len(mesh.indices) and mesh.indices.max() >= len(mesh.positions):
        raise ValueError(f"indices name vertex {mesh.indices.max()}, which is out of range")
    if normals is not None:
        normals = number_rows(normals, 3, "normals", len(mesh.positions))
    return _native.Soup(mesh.positions, mesh.face_sizes, mesh.indices, uvs, normals, colors, pages)


_BAKES = ("colors", "normals", "tangent-normals", "texture", "occlusion", "displacement")


def _bake(
    soup: Any, what: str, size: Any, page: int, threads: int, samples: int, source: Optional[Source], cage: float,
    images: List[np.ndarray] = [], face_texture: Optional[np.ndarray] = None,
) -> np.ndarray:
    width, height = _size(size)
    what = what.replace("_", "-") if isinstance(what, str) else what
    if what not in _BAKES:
        raise ValueError(f"what must be one of {', '.join(map(repr, _BAKES))}, but is {what!r}")
    if (what == "occlusion" or source is not None) and not _native.has_occlusion:
        raise NotImplementedError(
            f"this build has no {'sources' if source is not None else 'ambient occlusion'}: it needs a part of CGAL under the GPL"
        )
    if source is not None:
        images, face_texture = source._images, source._face_texture
    if what == "texture" and not images:
        raise ValueError("texture is needed, the picture to bake")
    if face_texture is None:
        face_texture = np.zeros(0, np.uint32)
    return _native.bake(
        soup, what, width, height, page, threads, samples, images, face_texture, None if source is None else source._soup, cage
    )


def _make_seamless(
    soup: Any, images: List[np.ndarray], tangent_normals: bool, threads: int
) -> Tuple[List[np.ndarray], SeamDifference]:
    if isinstance(images, np.ndarray) and images.ndim == 3:
        images = [images]
    pages, seams, before, after = _native.make_seamless(soup, [_picture(image) for image in images], tangent_normals, threads)
    return pages, SeamDifference(seams, tuple(before), tuple(after))
