# SPDX-License-Identifier: MIT
"""What parametrize() takes beyond the C++ call, on one thread; the least of several runs that take turns.

On a machine that does other things the difference of two long times says little. What one call takes outside of the
stages that its own report has times of is a bound from above: `build_surface()` is in it, which the C++ call has too.

    cmake --build BUILD --target atlas_uv_native cpp_call
    PYTHONPATH=BUILD/python python3 overhead.py BUILD/python/tests/cpp_call
"""

import subprocess
import sys
import tempfile
import time

import atlas_uv
import numpy as np
from meshes import torus


def compare(program, positions, faces, turns, runs):
    with tempfile.NamedTemporaryFile(suffix=".mesh") as file:
        file.write(np.array([len(positions), len(faces)], np.uint64).tobytes())
        file.write(positions.tobytes() + faces.astype(np.uint32).tobytes())
        file.flush()
        cpp, python, outside = [], [], []
        for _ in range(turns):
            cpp.append(float(subprocess.check_output([program, file.name, str(runs)])))
            for _ in range(runs):
                start = time.perf_counter()
                atlas_uv.parametrize(positions, faces, threads=1)
                python.append(time.perf_counter() - start)
                start = time.perf_counter()
                atlas = atlas_uv.Atlas(threads=1)
                atlas.add_mesh(positions, faces)
                stages = atlas.generate()["seconds"]["total"]
                atlas[0]
                outside.append(time.perf_counter() - start - stages)
    return min(cpp), min(python), min(outside)


for mesh, turns, runs in (((torus()[0], torus()[1][:10]), 5, 40), (torus(250, 200), 5, 1)):
    cpp, python, outside = compare(sys.argv[1], *mesh, turns, runs)
    print(
        f"{len(mesh[1]):7} faces: C++ {1000 * cpp:9.3f} ms, Python {1000 * python:9.3f} ms, "
        f"overhead {1000 * (python - cpp):.3f} ms, {100 * (python / cpp - 1):.1f} %; "
        f"outside of the stages at most {1000 * outside:.3f} ms, {100 * outside / cpp:.1f} %"
    )
