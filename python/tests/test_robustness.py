# SPDX-License-Identifier: MIT
"""Random soups: no crash, valid results, flat memory. Forty, or as many as ATLAS_SOUPS says."""

import os
import resource
from pathlib import Path

import atlas_uv
import numpy as np
from meshes import check_result, soup

SOUPS = int(os.environ.get("ATLAS_SOUPS", 40))


def resident_bytes():
    return int(Path("/proc/self/statm").read_text().split()[1]) * resource.getpagesize()


def run(seed):
    positions, faces = soup(seed)
    try:
        result = atlas_uv.parametrize(positions, faces, threads=1, texture_size=256)
    except atlas_uv.AtlasError as error:
        assert "no face" in str(error)
        finite = np.isfinite(positions[faces]).all((1, 2))
        a, b = (positions[faces[finite][:, i]] - positions[faces[finite][:, 0]] for i in (1, 2))
        scale = max(np.abs(positions[np.isfinite(positions)]).max(), 1e-300)
        assert (np.linalg.norm(np.cross(a / scale, b / scale), axis=1) < 1e-9).all()
        return
    check_result(positions, faces, *result)
    vmapping, indices, uvs = result
    assert atlas_uv.verify(positions, faces, uvs, indices, texture_size=256)["is_valid"]


def test_soups():
    for seed in range(SOUPS // 5):
        run(seed)
    before = resident_bytes()
    for seed in range(SOUPS // 5, SOUPS):
        run(seed)
    assert resident_bytes() - before < 8e6
