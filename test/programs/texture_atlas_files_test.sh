#!/bin/bash
# SPDX-License-Identifier: MIT
# What other programs write, and what is baked of it. Usage: files_test.sh PROGRAM
source "$(dirname "$0")/cli_helpers.sh"
cd "$folder" || exit 2

# make CODE LINES MESH ARGUMENTS...: the exit code and the number of lines on stderr; the model is a.*
make() {
  local code=$1 lines=$2
  shift 2
  run "$code" "$@" --texture-size 64 --threads 1
  [ "$(wc -l <stderr)" -eq "$lines" ] || fail "$(wc -l <stderr) lines on stderr instead of $lines: $* ($(cat stderr))"
}

# picture COLOR NAME: a picture of 4 x 4 texels, of which the left half is red and the right half COLOR, r g b [a]
picture() {
  python3 - "$1" "$2" <<'PNG'
import struct, sys, zlib
right = bytes(int(c) for c in sys.argv[1].split())
left = bytes([255, 0, 0, 255])[:len(right)]
rows = b"".join(b"\0" + left * 2 + right * 2 for _ in range(4))
def chunk(kind, data):
    return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
open(sys.argv[2], "wb").write(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", 4, 4, 8, 6 if len(right) == 4 else 2, 0, 0, 0))
                              + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))
PNG
}

# colors NAME: the colours of a PNG file of RGB, RGBA or grey, sorted, each once
colors() {
  python3 - "$1" <<'PNG'
import struct, sys, zlib
data, at, idat = open(sys.argv[1], "rb").read(), 8, b""
while at < len(data):
    size, kind = struct.unpack(">I4s", data[at:at + 8])
    if kind == b"IHDR":
        width, height, depth, color = struct.unpack(">IIBB", data[at + 8:at + 18])
    if kind == b"IDAT":
        idat += data[at + 8:at + 8 + size]
    at += size + 12
n, raw, before, result = {0: 1, 2: 3, 6: 4}[color] * depth // 8, zlib.decompress(idat), None, set()
for y in range(height):
    row = bytearray(raw[y * (n * width + 1):(y + 1) * (n * width + 1)])
    kind, row = row[0], row[1:]
    for i in range(len(row)):
        a = row[i - n] if i >= n else 0
        b = before[i] if before else 0
        c = before[i - n] if before and i >= n else 0
        p = a + b - c
        paeth = min((abs(p - a), 0, a), (abs(p - b), 1, b), (abs(p - c), 2, c))[2]
        row[i] = (row[i] + [0, a, b, (a + b) // 2, paeth][kind]) % 256
    before = row
    values = row if depth == 8 else struct.unpack(f">{len(row) // 2}H", row)
    m = n * 8 // depth
    result |= {tuple(values[m * x:m * x + m]) for x in range(width)}
print(*sorted(result))
PNG
}

# Outputs are tried before the work: nothing is read, even.
make 3 1 missing.obj -o no/such/folder.obj
grep -q 'no/such/folder.obj: cannot write' stderr || fail "read before it is known that nothing can be written: $(cat stderr)"
make 3 1 missing.obj -o a.obj --report no/r.json
grep -q 'no/r.json' stderr || fail "the report is tried too late: $(cat stderr)"
[ -z "$(find . -name '*.part')" ] || fail "a file is left behind"

# Errors are text, whatever the file is.
printf 'v 0 0 0\nf 1 1 \xff\x1b[2J\n' >raw.obj
make 3 1 raw.obj -o a.obj
grep -q '\\xFF\\x1B' stderr && ! LC_ALL=C grep -q $'[\xff\x1b]' stderr || fail "raw bytes on the terminal"

# Colours of faces, and of materials without coordinates.
printf 'OFF4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1 255 0 0\n3 0 1 3 0 0 255\n3 1 2 3 255 0 0\n3 2 0 3 0 0 255\n' >face.off
make 0 0 face.off -o a.obj --bake colors --hard-angle 30
[ "$(colors a_color.png)" = "(0, 0, 255) (255, 0, 0)" ] || fail "colours of faces: $(colors a_color.png)"
printf 'newmtl r\nKd 1 0 0\nnewmtl b\nKd 0 0 1\n' >plain.mtl
printf 'mtllib plain.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nusemtl r\nf 1 2 3\nusemtl b\nf 2 4 3\n' >plain.obj
make 0 0 plain.obj -o a.obj --bake texture
[ "$(colors a_texture.png)" = "(0, 0, 255) (255, 0, 0)" ] || fail "colours of materials: $(colors a_texture.png)"

# Libraries and pictures that are not there are told of.
picture '0 0 255' tex.png
printf 'newmtl m\nmap_Kd C:\\me\\TEX.PNG\nnewmtl gone\nKd 0 1 0\nmap_Kd gone.png\n' >a_lib.mtl
printf 'mtllib none.mtl A_LIB.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3\nusemtl gone\nf 1/1 3/3 4/4\n' >lib.obj
make 0 2 lib.obj -o a.obj --bake texture
grep -q "no material library 'none.mtl'" stderr && grep -q "no picture 'gone.png'" stderr || fail "what is missing: $(cat stderr)"
case $(colors a_texture.png) in *'(0, 0, 255)'*'(0, 255, 0)'*'(255, 0, 0)'*) ;; *) fail "colours: $(colors a_texture.png)" ;; esac
make 0 0 lib.obj -o a.obj --bake texture --quiet
sed 's/ A_LIB.mtl//' lib.obj >lost.obj # nothing is left to show: grey, but an atlas all the same
make 0 1 lost.obj -o a.obj --bake texture
grep -q "no material library 'none.mtl'" stderr && [ "$(colors a_texture.png)" = "(128, 128, 128)" ] || fail "a lost library: $(cat stderr) $(colors a_texture.png)"
sed '/mtllib/d' lib.obj >without.obj
make 3 1 without.obj -o a.obj --bake texture

# Alpha goes along, into the material too. After a bake a glTF file has no colours of vertices.
picture '255 255 255 0' leaf.png
printf 'newmtl m\nmap_Kd leaf.png\nmap_d leaf.png\n' >leaf.mtl
printf 'mtllib leaf.mtl\nv 0 0 0 .5 .5 .5\nv 1 0 0 .5 .5 .5\nv 1 1 0 .5 .5 .5\nv 0 1 0 .5 .5 .5\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl m\nf 1/1 2/2 3/3 4/4\n' >leaf.obj
make 0 0 leaf.obj -o a.obj --bake texture
grep -q 'map_d a_texture.png' a.mtl || fail "no map_d"
grep -q '^v 0 0 0 0.5 0.5 0.5' a.obj || fail "colours of vertices are lost"
case $(colors a_texture.png) in *'(255, 0, 0, 255)'*'255, 0)'*) ;; *) fail "alpha: $(colors a_texture.png)" ;; esac
make 0 0 leaf.obj -o a.glb --bake texture
grep -aq '"alphaMode":"BLEND"' a.glb || fail "no alphaMode"
! grep -aq 'COLOR_0' a.glb || fail "colours that multiply what has been baked"

# Charts that are copies share a place only if they show the same.
printf 'newmtl m\nmap_Kd tex.png\n' >copies.mtl
printf 'mtllib copies.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 3 0 0\nv 4 0 0\nv 4 1 0\nv 3 1 0\nvt 0.1 0\nvt .4 0\nvt .4 1\nvt 0.1 1\nvt .6 0\nvt .9 0\nvt .9 1\nvt .6 1\nusemtl m\nf 1/1 2/2 3/3 4/4\nf 5/5 6/6 7/7 8/8\n' >copies.obj
make 0 1 copies.obj -o a.obj --bake texture --stack copies
grep -q 'none are stacked' stderr || fail "no warning: $(cat stderr)"
case $(colors a_texture.png) in *'(0, 0, 255)'*'(255, 0, 0)'*) ;; *) fail "one colour: $(colors a_texture.png)" ;; esac
sed 's#f 5/5 6/6 7/7 8/8#f 5/1 6/2 7/3 8/4#' copies.obj >alike.obj
make 0 0 alike.obj -o a.obj --bake texture --stack copies
grep -q ', 1 of them on copies' stdout || fail "charts that look alike are apart: $(cat stdout)"
printf 'newmtl m\nKd 1 0 0\nnewmtl glass\nKd 1 0 0\nd 0.5\n' >copies.mtl
sed 's/^f 5/usemtl glass\n&/' alike.obj >glass.obj
make 0 1 glass.obj -o a.obj --bake texture --stack copies
grep -q 'none are stacked' stderr || fail "glass on what is opaque: $(cat stderr)"
make 0 0 copies.obj -o a.obj --stack copies
grep -q ', 1 of them on copies' stdout || fail "copies are apart although nothing is baked: $(cat stdout)"

# From another mesh: of two sheets in its cage, that which looks the same way, although the other is nearer.
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n' >low.obj
printf 'OFF 8 4 0\n0 0 .01\n1 0 .01\n1 1 .01\n0 1 .01\n0 0 .005\n1 0 .005\n1 1 .005\n0 1 .005\n' >high.off
printf '3 0 1 2 255 0 0\n3 0 2 3 0 0 255\n3 6 5 4 0 255 0\n3 7 6 4 0 255 0\n' >>high.off
make 0 0 low.obj -o a.obj --bake-from high.off --bake colors --bake normals
[ "$(colors a_color.png)" = "(0, 0, 255) (255, 0, 0)" ] || fail "colours of another mesh: $(colors a_color.png)"
[ "$(colors a_normal.png)" = "(128, 128, 255)" ] || fail "normals of another mesh: $(colors a_normal.png)"
make 0 0 low.obj -o a.obj --bake-from high.off --bake tangent-normals
[ "$(colors a_tangent_normal.png)" = "(128, 128, 255)" ] && grep -q '^vn 0 0 1' a.obj || fail "normals in tangent space: $(colors a_tangent_normal.png)"
make 0 0 low.obj -o a.obj --bake-from high.off --bake colors --cage 0
[ "$(colors a_color.png)" = "(0, 255, 0)" ] || fail "colours of nearest points: $(colors a_color.png)"
make 0 0 low.obj -o a.obj --bake-from plain.obj --bake texture --cage 1
[ "$(colors a_texture.png)" = "(0, 0, 255) (255, 0, 0)" ] || fail "materials of another mesh: $(colors a_texture.png)"
# Its alpha, its height along the normals (the largest is white, and in the report), and what hides it from the sky.
sed 's/mtllib leaf.mtl/&\n/; s/ .5 .5 .5//; s/^v \(.\) \(.\) 0/v \1 \2 .01/' leaf.obj >high_leaf.obj
make 0 0 low.obj -o a.obj --bake-from high_leaf.obj --bake texture --bake displacement
grep -q 'map_d a_texture.png' a.mtl || fail "the alpha of another mesh"
case $(colors a_texture.png) in *'(255, 0, 0, 255)'*'255, 0)'*) ;; *) fail "alpha of another mesh: $(colors a_texture.png)" ;; esac
[ "$(colors a_displacement.png)" = "(65535,)" ] || fail "a plane above: $(colors a_displacement.png)"
python3 -c 'import json; assert abs(json.load(open("a.json"))["largest_displacement"] - 0.01) < 1e-8' || fail "no scale"
printf 'v 0 0 -.01\nv 1 0 -.01\nv 1 1 .005\nv 0 1 .005\nf 1 2 3 4\n' >slope.obj
make 0 0 low.obj -o a.obj --bake-from slope.obj --bake displacement
colors a_displacement.png | tr ')' '\n' | awk -F'[(,]' 'NF > 1 { if (!n++) first = $2; last = $2 } END { exit !(n > 50 && first < 256 && last > 48800 && last < 49200) }' ||
  fail "a slope: $(colors a_displacement.png)"
make 2 1 low.obj -o a.obj --bake displacement
printf 'v -9 -9 .1\nv -9 9 .1\nv 9 9 .1\nv 9 -9 .1\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 5 6 7 8\n' >roofed.obj
make 0 0 low.obj -o a.obj --bake-from roofed.obj --bake occlusion --cage 0.001
[ "$(colors a_occlusion.png)" = "(0, 0, 0)" ] || fail "under a roof: $(colors a_occlusion.png)"
make 0 0 low.obj -o a.obj --bake-from high.off --bake occlusion
[ "$(colors a_occlusion.png)" = "(255, 255, 255)" ] || fail "in the open: $(colors a_occlusion.png)"
make 3 1 low.obj -o a.obj --bake-from low.obj --bake colors
grep -q 'low.obj: neither' stderr || fail "colours that are not there: $(cat stderr)"
make 2 1 low.obj -o a.obj --bake-from high.off
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' >line.obj
make 3 1 low.obj -o a.obj --bake-from line.obj --bake normals

# Seams that do not show: the report tells what is left.
python3 - <<'MESH'
with open("colored.obj", "w") as out:
    for i in range(8):
        x, y, z = i & 1, i >> 1 & 1, i >> 2
        out.write(f"v {x} {y} {z} {.3 + .4 * x} {.3 + .4 * y} {.3 + .4 * z}\n")
    for face in ("1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"):
        out.write(f"f {face}\n")
MESH
make 0 0 colored.obj -o a.obj --hard-angle 30 --mip-levels 2 --bake colors --bake normals --bake occlusion --bake tangent-normals --seamless
python3 - a.json <<'REPORT' || fail "differences at seams: $(cat stdout)"
import json, sys
seams = json.load(open(sys.argv[1]))["seams_of_textures"]
assert [s["texture"] for s in seams] == ["_color.png", "_normal.png", "_tangent_normal.png", "_occlusion.png"], seams
assert [s["edges"] for s in seams] == [12, 12, 0, 12], seams
assert seams[0]["largest_difference_before"][0] > 2 and seams[1]["largest_difference_before"][0] > 100, seams
assert all(d <= 1 for s in seams for d in s["largest_difference"]), seams
REPORT
grep -q '^seams  *_color.png: sides differ by at most 0' stdout || fail "nothing is said of seams: $(cat stdout)"
[ "$(grep -h '^map_Kd\|^norm' a.mtl | tr '\n' ' ')" = 'map_Kd a_color.png norm a_tangent_normal.png ' ] || fail "no map of normals in the material: $(cat a.mtl)"
make 0 0 colored.obj -o a.obj --hard-angle 30 --density 30 --bake tangent-normals --quiet
[ "$(ls a_tangent_normal.*.png | wc -l)" -gt 1 ] && grep -q '^norm a_tangent_normal.<UDIM>.png$' a.mtl || fail "maps of normals of several pages: $(cat a.mtl; ls)"
make 0 0 colored.obj -o a.obj --bake normals --quiet
grep -q '^norm' a.mtl && fail "normals that are not of tangent space: $(cat a.mtl)"
python3 - <<'MESH' # the same, each face with its own vertices, hardly off
with open("apart.obj", "w") as out:
    for k, face in enumerate(([0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5])):
        for i in face:
            x, y, z = i & 1, i >> 1 & 1, i >> 2
            out.write(f"v {x + 1e-6 * k} {y} {z} {.3 + .4 * x} {.3 + .4 * y} {.3 + .4 * z}\n")
        out.write("f -4 -3 -2 -1\n")
MESH
make 0 0 apart.obj -o a.obj --hard-angle 30 --weld 1e-4 --bake colors --seamless
python3 -c 'import json; s = json.load(open("a.json"))["seams_of_textures"]; assert s[0]["edges"] == 12, s' || fail "seams between faces that were welded"
make 2 1 colored.obj -o a.obj --seamless
grep -q -e '--seamless requires --bake' stderr || fail "seams without a bake: $(cat stderr)"

# A two-sided model is two sheets; vertices that hardly miss each other are one on request.
python3 - <<'MESHES'
def grid(n, turned):
    for y in range(n):
        for x in range(n):
            a, b, c, d = (y * (n + 1) + x + 1, y * (n + 1) + x + 2, (y + 1) * (n + 1) + x + 2, (y + 1) * (n + 1) + x + 1)
            yield (d, c, b, a) if turned else (a, b, c, d)
n = 6
points = [(x, y, 0.05 * x * y) for y in range(n + 1) for x in range(n + 1)]
with open("two.obj", "w") as f:
    f.writelines("v %g %g %g\n" % p for p in points)
    f.writelines("f %d %d %d %d\n" % face for turned in (False, True) for face in grid(n, turned))
with open("torn.obj", "w") as f:
    count = 0
    for face in grid(n, False):
        for v in face:
            count += 1
            f.write("v %.9g %.9g %.9g\n" % tuple(c + 1e-6 * (count * 7 % 11) for c in points[v - 1]))
        f.write("f %d %d %d %d\n" % tuple(range(count - 3, count + 1)))
MESHES
charts() { sed -n 's/^charts *\([0-9]*\) on.*/\1/p' stdout; }
make 0 0 two.obj -o a.obj
[ "$(charts)" -eq 2 ] || fail "a two-sided sheet has $(charts) charts"
make 0 1 torn.obj -o a.obj
grep -q -e '--weld' stderr || fail "no hint: $(cat stderr)"
make 0 0 torn.obj -o a.obj --weld 1e-5
[ "$(charts)" -eq 1 ] || fail "a welded sheet has $(charts) charts"
[ "$(grep -c '^v ' a.obj)" -eq 144 ] && grep '^v ' torn.obj | cmp -s - <(grep '^v ' a.obj) || fail "vertices have moved"
finish
