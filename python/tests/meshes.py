# SPDX-License-Identifier: MIT
"""Meshes for the tests."""

import numpy as np


def box():
    """Eight positions and six quads."""
    positions = np.array([[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 2)], float)
    return positions, np.array([[2, 3, 1, 0], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]])


def triangles_of(quads):
    return np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])


def torus(n=24, m=12):
    """A closed surface of genus 1 with 2 n m triangles."""
    u, v = np.meshgrid(np.arange(n) * 2 * np.pi / n, np.arange(m) * 2 * np.pi / m, indexing="ij")
    r = 2 + 0.7 * np.cos(v)
    positions = np.stack([r * np.cos(u), r * np.sin(u), 0.7 * np.sin(v)], -1).reshape(-1, 3)
    i, j = (x.ravel() for x in np.meshgrid(np.arange(n), np.arange(m), indexing="ij"))
    at = lambda a, b: a % n * m + b % m
    quads = np.stack([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)], -1)
    return positions, triangles_of(quads)


def soup(seed):
    """Few random faces of any kind: flat, doubled, non-manifold, with corners that are not finite."""
    random = np.random.default_rng(seed)
    n = int(random.integers(3, 12))
    positions = random.integers(0, 4, (n, 3)) if seed % 2 else random.normal(size=(n, 3))
    positions = positions * 10.0 ** random.integers(-12, 12)
    if seed % 5 == 0:
        positions[random.integers(n)] = np.nan if seed % 10 else np.inf
    faces = random.integers(0, n, (int(random.integers(1, 10)), 3))
    return positions, faces


def check_result(positions, faces, vmapping, indices, uvs):
    """What holds for every result: the same faces in their order, all vertices used, finite coordinates on the page."""
    positions, faces = np.asarray(positions), np.asarray(faces)
    assert vmapping.dtype == np.uint32 and indices.dtype == np.uint32 and uvs.dtype == np.float32
    assert indices.shape == faces.shape and uvs.shape == (len(vmapping), 2)
    assert np.array_equal(vmapping[indices], faces)
    assert np.array_equal(np.unique(indices), np.arange(len(vmapping)))
    assert ((uvs >= 0) & (uvs <= 1)).all()
