#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Prints the tables of the manual's pages on performance and quality: meshes of different kinds, whole runs of texture_atlas.

scripts/make_tables.sh builds the program and calls this. Most meshes are those of Debian's package libcgal-demo; the others are made here.
"""
import argparse
import json
import math
import os
import subprocess
import sys
import tarfile
import tempfile

# Kind, what it is, a mesh of the archive or a function that makes one, and options.
KINDS = [
    ("tiny", "one triangle", "triangle.off"),
    ("tiny", "a cube", "cube_quad.off"),
    ("CAD", "pinion", "pinion.off"),
    ("CAD", "couplingdown", "couplingdown.off"),
    ("CAD", "fandisk", "fandisk.off"),
    ("CAD", "mech-holes-shark", "mech-holes-shark.off"),
    ("character", "cow", "cow.off"),
    ("character", "homer", "homer.off"),
    ("character", "man", "man.off"),
    ("character", "elephant", "refined_elephant.off"),
    ("scan", "mannequin", "mannequin-devil.off"),
    ("scan", "bunny", "bunny00.off"),
    ("terrain", "hills of 512 x 512 points", "terrain"),
    ("soup", "boeing, faces of any orientation", "boeing.off"),
    ("soup", "loose triangles of a ball", "loose"),
    ("soup", "the same, `--weld 2e-4`", "loose", "--weld", "2e-4"),
    ("many", "500 boxes", "boxes"),
    ("many", "200 copies of a ball", "balls"),
]


STAGES = ["segmentation", "parameterization", "packing", "verification"]


class Random:
    """The same numbers on every machine."""

    def __init__(self, seed):
        self.state = seed

    def __call__(self):
        self.state = (self.state * 6364136223846793005 + 1442695040888963407) % 2**64
        return (self.state >> 11) / 2**53


def terrain(n=512):
    """Heights by the midpoints of ever smaller squares, over a grid of n x n points."""
    side, random = 1, Random(1)
    while side < n - 1:
        side *= 2
    height = [[0.0] * (side + 1) for _ in range(side + 1)]
    step, size = side, 0.25
    while step > 1:
        half = step // 2
        for y in range(half, side, step):
            for x in range(half, side, step):
                corners = sum(height[y + a][x + b] for a in (-half, half) for b in (-half, half))
                height[y][x] = corners / 4 + size * (random() - 0.5)
        for y in range(0, side + 1, half):
            for x in range((y + half) % step, side + 1, step):
                near = [(y + a, x + b) for a, b in ((-half, 0), (half, 0), (0, -half), (0, half))]
                near = [height[a][b] for a, b in near if 0 <= a <= side and 0 <= b <= side]
                height[y][x] = sum(near) / len(near) + size * (random() - 0.5)
        step, size = half, size / 2
    points = [(x / (n - 1), y / (n - 1), height[y][x]) for y in range(n) for x in range(n)]
    faces = []
    for y in range(n - 1):
        for x in range(n - 1):
            a = y * n + x
            faces += [(a, a + 1, a + n + 1), (a, a + n + 1, a + n)]
    return points, faces


def ball(n, center=(0, 0, 0), radius=1.0):
    """A ball of 2n meridians."""
    points, faces = [], []
    for i in range(n + 1):
        for j in range(2 * n):
            a, b = math.pi * i / n, math.pi * j / n
            direction = (math.sin(a) * math.cos(b), math.sin(a) * math.sin(b), math.cos(a))
            points.append(tuple(c + radius * d for c, d in zip(center, direction)))
    for i in range(n):
        for j in range(2 * n):
            p, q = 2 * n * i + j, 2 * n * i + (j + 1) % (2 * n)
            if i < n - 1:
                faces.append((p, p + 2 * n, q + 2 * n))
            if i > 0:
                faces.append((p, q + 2 * n, q))
    return points, faces


def loose():
    """The triangles of a ball, each with corners of its own that are a little off."""
    points, faces = ball(20)
    random, corners = Random(2), []
    for face in faces:
        corners += [tuple(c + 1e-4 * (random() - 0.5) for c in points[v]) for v in face]
    return corners, [(3 * f, 3 * f + 1, 3 * f + 2) for f in range(len(faces))]


def joined(parts):
    points, faces = [], []
    for some_points, some_faces in parts:
        faces += [tuple(v + len(points) for v in face) for face in some_faces]
        points += some_points
    return points, faces


def box(corner, size):
    points = [tuple(c + s * (k >> i & 1) for i, (c, s) in enumerate(zip(corner, size))) for k in range(8)]
    return points, [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]


def boxes():
    random = Random(3)
    return joined([box((2 * (i % 25), 2 * (i // 25), 0), [0.2 + random() for _ in range(3)]) for i in range(500)])


def balls():
    return joined([ball(8, (3 * (i % 20), 3 * (i // 20), 0)) for i in range(200)])


def write_off(path, mesh):
    points, faces = mesh
    with open(path, "w") as file:
        file.write("OFF\n%d %d 0\n" % (len(points), len(faces)))
        file.writelines("%.9g %.9g %.9g\n" % p for p in points)
        file.writelines("%d %s\n" % (len(f), " ".join(map(str, f))) for f in faces)


def measure(program, mesh, folder, options):
    """The report of a run, its CPU seconds and the most memory that it had, in MB."""
    out = os.path.join(folder, "out.obj")
    child = subprocess.Popen([program, mesh, "-o", out, "--quiet"] + options)
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    if child.returncode != 0:
        sys.exit("%s: exit code %d" % (mesh, child.returncode))
    with open(os.path.join(folder, "out.json")) as file:
        return json.load(file), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def table(head, rows):
    """A Markdown table; columns after the second are numbers."""
    print("| " + " | ".join(head) + " |")
    print("|---|---|" + "---:|" * (len(head) - 2))
    for row in rows:
        print("| " + " | ".join(row) + " |")
    print()


def main():
    if sys.argv[1:2] == ["--write"]:
        write_off(sys.argv[3], globals()[sys.argv[2]]())
        return
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--program", required=True, help="texture_atlas")
    parser.add_argument("--archive", required=True, help="data.tar.gz of libcgal-demo")
    parser.add_argument("--repeat", type=int, default=3, help="runs of each mesh; the fastest counts")
    parser.add_argument("--only", help="meshes whose name has this in it")
    parser.add_argument("options", nargs="*", help="options of the program, after --")
    arguments = parser.parse_args()
    options = ["--threads", "1"] + arguments.options
    performance, quality = [], []
    with tempfile.TemporaryDirectory() as folder, tarfile.open(arguments.archive) as archive:
        for kind, name, source, *more in KINDS:
            if arguments.only and arguments.only not in name:
                continue
            path = os.path.join(folder, "mesh.off")
            if source.endswith(".off"):
                with open(path, "wb") as file:
                    file.write(archive.extractfile("data/meshes/" + source).read())
            else:
                # In a process of its own: the memory that a program has had counts that of the one which started it.
                subprocess.run([sys.executable, __file__, "--write", source, path], check=True)
            runs = [measure(arguments.program, path, folder, options + more) for _ in range(arguments.repeat)]
            report, memory = runs[0][0], max(run[2] for run in runs)
            cpu = min(run[1] for run in runs)
            seconds = {stage: min(run[0]["seconds"][stage] for run in runs) for stage in STAGES}
            shares = ["%.0f %%" % (100 * seconds[stage] / sum(seconds.values())) for stage in STAGES]
            performance.append([kind, name, "%d" % report["faces"], "%.2f" % cpu, *shares, "%.0f" % memory])
            distortion = report["distortion"]
            quality.append([kind, name, "%d" % report["number_of_charts"],
                            "%.2f" % (report["seam_length"] / math.sqrt(report["area"])),
                            "%.4f" % distortion["symmetric_dirichlet_mean"], "%.2f" % distortion["stretch_p99"],
                            "%.0f %%" % (100 * report["packing_efficiency"]), "yes" if report["is_valid"] else "no"])
            print(".", end="", file=sys.stderr, flush=True)
    print(file=sys.stderr)
    table(["kind", "mesh", "faces", "CPU s", *STAGES, "MB"], performance)
    table(["kind", "mesh", "charts", "seams", "energy", "stretch, 99 %", "page", "valid"], quality)


main()
