#!/bin/bash
# SPDX-License-Identifier: MIT
# The calling contract of texture_atlas. Usage: cli_test.sh PROGRAM
source "$(dirname "$0")/cli_helpers.sh"
cd "$folder" || exit 2

# expect CODE LINES ARGUMENTS...: the exit code and the number of lines on stderr
expect() {
  local code=$1 lines=$2
  shift 2
  run "$code" "$@"
  [ "$(wc -l <stderr)" -eq "$lines" ] || fail "$(wc -l <stderr) lines on stderr instead of $lines: $*"
}

# files NAME...: exactly these files are in the folder `out`
files() {
  local got wanted
  got=$(cd out && find . -type f | sort | tr '\n' ' ')
  wanted=$(for name in "$@"; do echo "./$name"; done | sort | tr '\n' ' ')
  [ "$got" = "$wanted" ] || fail "files: $got instead of $wanted"
  rm -rf out && mkdir out
}

mkdir out
cat >cube.obj <<'CUBE'
v 0 0 0
v 1 0 0
v 0 1 0
v 1 1 0
v 0 0 1
v 1 0 1
v 0 1 1
v 1 1 1
f 1 3 4 2
f 5 6 8 7
f 1 2 6 5
f 3 7 8 4
f 1 5 7 3
f 2 4 8 6
CUBE
all=(.obj .mtl _checkerboard.png .json)
pictures=(_page.png _stretch.png _view.png .html)

# The main job, with all options.
expect 0 0 cube.obj -o out/a.obj
grep -q '^verdict  *valid' stdout || fail "no verdict on stdout"
for word in charts distortion packing time segmentation verification; do
  grep -q "$word" stdout || fail "no word $word on stdout"
done
grep -q '^v 1 0 1$' out/a.obj || fail "vertex changed"
[ "$(grep -c '^f ' out/a.obj)" -eq 6 ] || fail "number of faces"
[ "$(grep '^f ' out/a.obj | sed 's#/[0-9]*##g')" = "$(grep '^f ' cube.obj)" ] || fail "faces changed"
grep -q 'mtllib a.mtl' out/a.obj && grep -q 'map_Kd a_checkerboard.png' out/a.mtl || fail "material"
python3 -c 'import json, sys; r = json.load(open("out/a.json")); sys.exit(not (r["is_valid"] and r["faces"] == 6))' ||
  fail "report"
files "${all[@]/#/a}"
expect 0 0 cube.obj -o out/b.obj --texture-size 256 --gutter 4 --report out/r.json --threads 2 --picture out/p.png --quiet
[ -s stdout ] && fail "--quiet prints"
files b.obj b.mtl b_checkerboard.png r.json p.png
expect 0 0 cube.obj -o out/b.obj --pictures
files "${all[@]/#/b}" "${pictures[@]/#/b}"
(cd out && expect 0 0 ../cube.obj && rm stdout stderr)
files "${all[@]/#/cube_atlas}"
expect 0 4 cube.obj -o out/c.obj --progress
rm out/*

# The other formats.
for format in glb ply; do
  expect 0 0 cube.obj -o out/a.$format
  expect 0 0 out/a.$format -o out/again.obj
  [ "$(grep -c '^f ' out/again.obj)" -ge 6 ] || fail "faces lost on the way over $format"
done
rm out/*

# Colours of vertices as a texture.
sed 's/^v .*/& 0.5 0.25 1/' cube.obj >colored.obj
expect 0 0 colored.obj -o out/a.obj --bake colors
grep -q 'map_Kd a_color.png' out/a.mtl && [ -s out/a_color.png ] || fail "no baked texture"
rm out/*
expect 3 1 cube.obj -o out/a.obj --bake colors

# Normals and occlusion beside it; an old texture comes along.
expect 0 0 cube.obj -o out/a.obj --bake normals --bake occlusion --texture-size 64
files "${all[@]/#/a}" a_normal.png a_occlusion.png
expect 0 0 cube.obj -o out/a.obj --texture-size 256
expect 0 0 out/a.obj -o out/b.obj --bake texture
grep -q 'map_Kd b_texture.png' out/b.mtl && [ -s out/b_texture.png ] || fail "no old texture"
rm out/a_checkerboard.png out/b*
expect 0 1 out/a.obj -o out/b.obj --bake texture
grep -q "no picture 'a_checkerboard.png'" stderr || fail "a missing picture goes unnoticed: $(cat stderr)"
rm out/b*
files a.obj a.mtl a.json
expect 3 1 cube.obj -o out/a.obj --bake texture

# What charts are like.
charts() { sed -n 's/^charts *\([0-9]*\) on.*/\1/p' stdout; }
expect 0 0 cube.obj -o out/a.obj --hard-angle 60
[ "$(charts)" -eq 6 ] || fail "hard edges: $(charts) charts"
for mode in standard few-seams conformal; do
  expect 0 0 cube.obj -o out/a.obj --mode $mode --max-distortion 1.2
done
for measure in symmetric-dirichlet l2-stretch linf-stretch area-ratio area-ratio-quantiles quasi-conformal; do
  expect 0 0 cube.obj -o out/a.obj --measure $measure --max-distortion 1.3
  grep -q "\"measure\": \"$(echo $measure | tr - _)" out/a.json || fail "the report names another measure: $measure"
done
expect 2 1 cube.obj -o out/b.obj --measure l2-stretch
expect 2 1 cube.obj -o out/b.obj --measure length --max-distortion 1.3
expect 0 0 cube.obj -o out/a.obj --max-charts 2
[ "$(charts)" -eq 2 ] || fail "two charts asked for: $(charts)"
sed 's/^f 1 3/usemtl a\n&/; s/^f 1 2/usemtl b\n&/' cube.obj >materials.obj
expect 0 1 materials.obj -o out/b.obj --separate-materials --max-charts 1
[ "$(charts)" -eq 3 ] || fail "materials: $(charts) charts"
expect 0 0 cube.obj -o out/a.obj --hard-angle 60
expect 0 0 out/a.obj -o out/b.obj --keep-uv --texture-size 256
[ "$(charts)" -eq 6 ] || fail "charts of the file: $(charts)"
expect 3 1 cube.obj -o out/b.obj --keep-uv
expect 2 1 cube.obj -o out/b.obj --mode none
for option in '--mode standard' '--max-distortion 1.2' '--max-charts 2' '--min-chart-texels 9' '--hard-angle 60' \
  --separate-materials; do
  expect 2 1 out/a.obj -o out/b.obj --keep-uv $option
  grep -q -e "--keep-uv: .*${option%% *}.*leave out" stderr || fail "--keep-uv does not refuse $option: $(cat stderr)"
done
# Faces that are charts of their own become one again, but not beyond a bound.
expect 3 1 cube.obj -o out/b.obj --defragment
expect 0 0 out/a.obj -o out/b.obj --defragment --texture-size 256
[ "$(charts)" -le 3 ] || fail "charts that were to merge: $(charts)"
expect 0 0 out/a.obj -o out/b.obj --defragment --hard-angle 60
[ "$(charts)" -eq 6 ] || fail "seams that were asked for: $(charts)"
for option in --keep-uv '--symmetry x' --straighten '--mode paper' '--parameterizer lscm' '--only m'; do
  expect 2 1 out/a.obj -o out/b.obj --defragment $option
done
rm out/*

# What the charts of materials may do: six squares on a page, of two materials.
python3 - >squares.obj <<'SQUARES'
for i in range(6):
    z = 2 * i
    print("\n".join("v %g %g %g" % p for p in [(0, 0, z), (1, 0, z), (1, 1, z), (0, 1, z)]))
    u, v = 0.05 + 0.3 * (i % 3), 0.05 + 0.45 * (i // 3)
    print("\n".join("vt %g %g" % p for p in [(u, v), (u + 0.1, v), (u + 0.1, v + 0.1), (u, v + 0.1)]))
for i in range(6):
    print("usemtl", "wood" if i < 2 else "iron")
    print("f", *("%d/%d" % (4 * i + k, 4 * i + k) for k in range(1, 5)))
SQUARES
# places FILE: u and v of the first two corners of each face
places() {
  awk '$1 == "vt" { u[++n] = $2; v[n] = $3 }
       $1 == "f" { split($2, a, "/"); split($3, b, "/"); print u[a[2]], v[a[2]], u[b[2]], v[b[2]] }' "$1"
}
# sides FILE: the side of each square, in texels of a page of 256
sides() { places "$1" | awk '{ printf "%.3f\n", 256 * sqrt(($1 - $3)^2 + ($2 - $4)^2) }'; }
# moved FILE: the number of each face whose first two corners are not where they were in squares.obj
moved() {
  paste -d ' ' <(places squares.obj) <(places "$1") |
    awk '{ for (k = 1; k <= 4; ++k) if (($k - $(k + 4))^2 > 1e-12) { printf "%d ", NR; next } }'
}
for weight in '--weight wood=3' '--weight wood=3 --weight iron=1' '--weight wood=1.5 --weight iron=0.5'; do
  expect 0 0 $weight squares.obj -o out/a.obj --texture-size 256 --quiet
  sides out/a.obj | awk '{ s[NR] = $1 } END { exit !(NR == 6 && s[3] > 1 && s[1] / s[3] > 2.995 && s[1] / s[3] < 3.005 && s[1] - s[2] < 0.01 && s[3] - s[6] < 0.01) }' ||
    fail "$weight: $(sides out/a.obj | tr '\n' ' ')"
done
expect 0 0 squares.obj -o out/a.obj --texture-size 256 --keep-uv --weight iron=2 --quiet
sides out/a.obj | awk '{ s[NR] = $1 } END { exit !(s[3] / s[1] > 1.995 && s[3] / s[1] < 2.005) }' || fail "weights of kept charts"
expect 0 0 squares.obj -o out/a.obj --texture-size 256 --keep-uv --lock wood --quiet
[ "$(moved out/a.obj)" = '3 4 5 6 ' ] || fail "locked charts: moved are $(moved out/a.obj)"
expect 0 0 squares.obj -o out/a.obj --texture-size 256 --keep-uv --lock wood --lock iron --quiet
[ -z "$(moved out/a.obj)" ] || fail "all charts are locked: moved are $(moved out/a.obj)"
expect 0 0 squares.obj -o out/a.obj --texture-size 256 --keep-uv --group wood --quiet
places out/a.obj | awk '{ x[NR] = $1; y[NR] = $2; w[NR] = sqrt(($1 - $3)^2 + ($2 - $4)^2) }
  END { d = sqrt((x[1] - x[2])^2 + (y[1] - y[2])^2) / w[1]; exit !(d > 2.999 && d < 3.001 && w[1] / w[3] > 0.999 && w[1] / w[3] < 1.001) }' ||
  fail "no group: $(places out/a.obj)"
# A chart that has no coordinates, or lies face down, cannot stay.
sed 's#^f 1/1 2/2 3/3 4/4#f 1 2 3 4#; s#^f 5/5 6/6 7/7 8/8#f 5/6 6/5 7/8 8/7#' squares.obj >unlockable.obj
expect 0 1 unlockable.obj -o out/a.obj --texture-size 256 --keep-uv --lock wood
grep -q '2 faces that are to stay' stderr || fail "faces that do not stay: $(cat stderr)"
expect 0 0 squares.obj -o out/a.obj --texture-size 256 --stack copies --hard-angle 30 --quiet
[ "$(places out/a.obj | sort -u | wc -l)" -eq 1 ] || fail "copies are not stacked: $(places out/a.obj)"
# A part of a mesh: what is not unwrapped stays to the bit, and has room.
expect 0 0 squares.obj -o out/a.obj --texture-size 256 --only iron --quiet
[ "$(moved out/a.obj)" = '3 4 5 6 ' ] || fail "only iron: moved are $(moved out/a.obj)"
sides out/a.obj | awk 'NR > 2 && !($1 > 26) { exit 1 }' || fail "only iron: small squares, $(sides out/a.obj)"
expect 0 0 squares.obj -o out/a.obj --texture-size 256 --only iron --only wood --quiet
[ "$(moved out/a.obj)" = '1 2 3 4 5 6 ' ] || fail "only iron and wood: moved are $(moved out/a.obj)"
sed 's#^f 9/9 10/10 11/11 12/12#f 9 10 11 12#' squares.obj >partly.obj # the new face alone has no coordinates
expect 0 0 partly.obj -o out/a.obj --texture-size 256 --only iron --quiet
expect 0 1 unlockable.obj -o out/a.obj --texture-size 256 --only iron
grep -q '1 faces that are to stay' stderr || fail "a face that cannot stay: $(cat stderr)"
[ "$(sed -n 2p <(places out/a.obj))" = "$(sed -n 2p <(places unlockable.obj))" ] || fail "a face that lies face down is moved"
awk '$1 == "vt" { $2 += 3; $3 += 1 } 1' squares.obj >tile.obj # tile 1014 of pages that are no squares
expect 0 0 tile.obj -o out/a.obj --texture-size 256x512 --only iron --quiet
[ "$(places out/a.obj | head -2)" = "$(places tile.obj | head -2)" ] || fail "faces on another tile: $(places out/a.obj)"
printf 'l 9 10\n' >cuts.obj
expect 0 0 squares.obj -o out/a.obj --texture-size 256 --only iron --seams cuts.obj --quiet
[ "$(moved out/a.obj)" = '3 4 5 6 ' ] || fail "only iron, with seams: moved are $(moved out/a.obj)"
printf '9 0.5 0.5\n' >places.txt
expect 0 0 squares.obj -o out/a.obj --texture-size 256 --pinned places.txt --quiet
grep -q '^vt 0.5 0.5$' out/a.obj || fail "a pinned vertex of a mesh with materials: $(places out/a.obj)"
awk '$1 == "vt" { $2 += 0.9 } 1' squares.obj >wide.obj # across the border of a tile
rm -f out/a.obj
expect 3 1 wide.obj -o out/a.obj --texture-size 256 --only iron
grep -q 'goes beyond its tile' stderr && [ ! -e out/a.obj ] || fail "charts that are to stay and cannot: $(cat stderr)"
expect 2 1 squares.obj -o out/a.obj --only gold
expect 2 1 squares.obj -o out/a.obj --only iron --keep-uv
expect 2 1 squares.obj -o out/a.obj --only iron --lock wood
expect 2 1 squares.obj -o out/a.obj --only iron --pinned places.txt
for wish in '--lock wood' '--group wood'; do
  expect 2 1 squares.obj -o out/b.obj $wish
  grep -q -e "${wish% *}: .*keep-uv" stderr || fail "no word on --keep-uv: $(cat stderr)"
  expect 2 1 squares.obj -o out/b.obj --keep-uv ${wish% *} none
  grep -q "no material called 'none'" stderr || fail "an unknown material: $(cat stderr)"
done
expect 2 1 squares.obj -o out/b.obj --keep-uv --lock wood --texture-size 64x128
for weight in wood wood= wood=0 wood=-1 wood=x none=2; do
  expect 2 1 squares.obj -o out/b.obj --weight $weight
done
expect 2 1 squares.obj -o out/b.obj --stack all
rm out/*

# What pages are like.
expect 0 0 cube.obj -o out/a.obj --hard-angle 60 --pages 2 --effort normal --rotation quarter --mip-levels 2 --block 4
grep -q 'on 2 pages' stdout || fail "two pages asked for"
grep -q 'map_Kd a_checkerboard.<UDIM>.png' out/a.mtl || fail "the material names no tiles"
[ -s out/a_checkerboard.1001.png ] && [ -s out/a_checkerboard.1002.png ] || fail "a texture per page"
expect 0 0 cube.obj -o out/a.obj --density 100 --texture-size 256 --hard-angle 60
grep -q 'on 2 pages' stdout && grep -q ' 100 texels per unit' stdout || fail "density: $(cat stdout)"
expect 0 1 cube.obj -o out/a.obj --density 1000 --texture-size 256
rm out/*

# Pages that are not square, through all files. `png NAME WIDTH HEIGHT`: the size of a picture.
png() {
  local size
  size=$(python3 -c 'import struct, sys; print(*struct.unpack(">II", open(sys.argv[1], "rb").read(24)[16:]))' "$1")
  [ "$size" = "$2 $3" ] || fail "$1 measures $size instead of $2 $3"
}
for size in 256x64 100x300; do
  width=${size%x*} height=${size#*x}
  expect 0 0 colored.obj -o out/a.obj --texture-size $size --hard-angle 60 --bake normals --bake occlusion --pictures
  grep -q "of $width x $height texels" stdout || fail "a page of $size: $(cat stdout)"
  for picture in checkerboard normal occlusion; do
    png out/a_$picture.png "$width" "$height"
  done
  python3 - out/a.obj "$width" "$height" <<'SQUARES' || fail "the faces of the cube are no squares on a page of $size"
import math, sys
uv, ok = [], True
for line in open(sys.argv[1]):
    if line.startswith("vt "):
        uv.append([float(x) * float(n) for x, n in zip(line.split()[1:3], sys.argv[2:])])
    if line.startswith("f "):
        p = [uv[int(corner.split("/")[1]) - 1] for corner in line.split()[1:]]
        sides = [math.dist(p[i], p[i - 1]) for i in range(4)]
        ok = ok and max(sides) - min(sides) < 1e-3 and abs(math.dist(p[0], p[2]) - math.sqrt(2) * sides[0]) < 1e-3
sys.exit(not ok)
SQUARES
  expect 0 0 colored.obj -o out/b.glb --texture-size $size --bake colors --picture out/p.png
  expect 0 0 out/b.glb -o out/c.ply --texture-size $size --bake texture --pages 2 --hard-angle 60
  png out/c_texture.1002.png "$width" "$height"
done
png out/a_page.png 341 1024
expect 0 0 cube.obj -o out/a.obj --texture-size 256x64 --pictures
png out/a_page.png 1024 256
png out/a_stretch.png 1024 341
rm out/*
for size in 64x 0x64 64x0 x64 64x64x64 64X64 70000 -1; do
  expect 2 1 cube.obj -o out/a.obj --texture-size=$size
done

# Several meshes in one file have one density.
(cat cube.obj && sed -n 's/^v \(.*\) \(.*\) \(.*\)/\1 \2 \3/p' cube.obj | awk '{ print "v", 5 + 3 * $1, 3 * $2, 3 * $3 }' &&
 sed -n 's/^f //p' cube.obj | awk '{ print "f", $1 + 8, $2 + 8, $3 + 8, $4 + 8 }') >two.obj
expect 0 0 two.obj -o out/a.obj --hard-angle 60 --gutter 4 --rotation none
python3 - out/a.obj <<'DENSITY' || fail "two meshes have two densities"
import math, sys
v, vt, densities = [], [], []
for line in open(sys.argv[1]):
    words = line.split()
    if words[:1] == ["v"]:
        v.append([float(x) for x in words[1:4]])
    if words[:1] == ["vt"]:
        vt.append([float(x) for x in words[1:3]])
    if words[:1] == ["f"]:
        corners = [[int(i) - 1 for i in word.split("/")] for word in words[1:]]
        for a, b in zip(corners, corners[1:]):
            densities.append(math.dist(vt[a[1]], vt[b[1]]) / math.dist(v[a[0]], v[b[0]]))
sys.exit(len(densities) != 36 or max(densities) > 1.0001 * min(densities))
DENSITY
rm out/*

# Several meshes have one atlas, and come back one by one.
expect 0 0 cube.obj -o out/box.glb
cp out/box.glb box.glb
rm out/*
(cat cube.obj && printf 'f 1 2 99\n') >repair.obj
# shared DENSITY FILE...: faces of cubes are squares of one density, and no two of all files overlap
shared() {
  python3 - "$@" <<'SHARED'
import math, sys
squares = []
for name in sys.argv[2:]:
    v, vt = [], []
    for line in open(name):
        words = line.split()
        if words[:1] == ["v"]:
            v.append([float(x) for x in words[1:4]])
        if words[:1] == ["vt"]:
            vt.append([float(x) for x in words[1:3]])
        if words[:1] == ["f"] and "99" not in line:
            corners = [vt[int(w.split("/")[1]) - 1] for w in words[1:]]
            squares.append([sum(x) / 4 for x in zip(*corners)] + [math.dist(corners[0], corners[1])])
sides = sorted(s[2] for s in squares)
apart = min(math.dist(a[:2], b[:2]) for i, a in enumerate(squares) for b in squares[:i])
sys.exit(not (len(squares) == int(sys.argv[1]) and sides[-1] < 1.001 * sides[0] and apart > sides[0]))
SHARED
}
shared_files=(.mtl _checkerboard.png .json)
expect 0 1 cube.obj repair.obj ./cube.obj -o out/s.obj --hard-angle 60 --texture-size 256
grep -q 'repair.obj: face 6 ' stderr || fail "the mesh of a rejected face is not named: $(cat stderr)"
shared 18 out/s_cube.obj out/s_repair.obj out/s_cube_2.obj || fail "several meshes do not share a page"
for name in cube repair; do
  [ "$(grep '^v ' out/s_$name.obj)" = "$(grep '^v ' $name.obj)" ] || fail "vertices of $name"
  [ "$(grep '^f ' out/s_$name.obj | sed 's#/[0-9]*##g')" = "$(grep '^f ' $name.obj)" ] || fail "faces of $name"
  grep -q 'mtllib s.mtl' out/s_$name.obj || fail "material of $name"
done
grep -q 'map_Kd s_checkerboard.png' out/s.mtl || fail "the texture of several meshes"
python3 -c 'import json, sys; m = json.load(open("out/s.json"))["meshes"]; sys.exit(not ([x["mesh"] for x in m] == ["cube.obj", "repair.obj", "./cube.obj"] and [x["first_face"] for x in m] == [0, 6, 13] and m[2]["model"] == "out/s_cube_2.obj"))' ||
  fail "the report on several meshes"
files s_cube.obj s_repair.obj s_cube_2.obj "${shared_files[@]/#/s}"
expect 0 0 cube.obj box.glb -o "out/s 1.glb" --pages 2 --texture-size 128
for name in cube box; do
  expect 0 0 "out/s 1_$name.glb" -o out/t.obj --bake texture --texture-size 64
  rm out/t*
done
python3 - "out/s 1_cube.glb" <<'URI' || fail "a glTF file of several does not name the textures"
import json, struct, sys
data = open(sys.argv[1], "rb").read()
gltf = json.loads(data[20:20 + struct.unpack("<I", data[12:16])[0]])
sys.exit([image["uri"] for image in gltf["images"]] != ["s%201_checkerboard.1001.png", "s%201_checkerboard.1002.png"])
URI
rm out/*
expect 0 0 cube.obj colored.obj -o out/s.ply --bake colors --texture-size 64
grep -a -q 'TextureFile s_color.png' out/s_cube.ply && grep -a -q 'TextureFile s_color.png' out/s_colored.ply || fail "textures of PLY files"
rm out/*
expect 0 0 cube.obj materials.obj -o out/s.obj --weight a=2 --hard-angle 60 --quiet
shared 12 out/s_cube.obj out/s_materials.obj && fail "a weight has no effect on the second mesh"
expect 0 0 out/s_cube.obj out/s_materials.obj -o out/t.obj --keep-uv --bake texture --quiet
shared 12 out/t_s_cube.obj out/t_s_materials.obj || fail "several meshes with coordinates"
rm out/*
(cd out && expect 0 0 ../cube.obj ../box.glb && rm stdout stderr)
files atlas_cube.obj atlas_box.obj "${shared_files[@]/#/atlas}"
expect 2 1 cube.obj box.glb -o /dev/null
printf 'v 0 0 0\nv 1 x 0\n' >broken.obj
expect 3 1 cube.obj broken.obj -o out/s.obj
grep -q 'broken.obj:2' stderr || fail "the broken one of several meshes is not named"
mkdir out/s_box.obj
expect 3 1 cube.obj box.glb -o out/s.obj
rmdir out/s_box.obj
files

# The same bytes for any number of threads.
expect 0 0 cube.obj -o out/1.obj --threads 1
expect 0 0 cube.obj -o out/2.obj --threads 3
cmp <(grep -v mtllib out/1.obj) <(grep -v mtllib out/2.obj) || fail "threads change the result"
rm out/*

# Names of any kind.
cp cube.obj "a b é 'q'.obj"
expect 0 0 "a b é 'q'.obj" -o "out/ü x.obj"
files "${all[@]/#/ü x}"

# Wrong command lines.
expect 2 1
expect 2 1 cube.obj --no-such-option
expect 2 1 cube.obj --up w -o out/a.obj
expect 0 0 cube.obj --up -z --snap --quiet -o out/a.obj
rm out/*
expect 2 1 cube.obj --texture-size 0 -o out/a.obj
expect 2 1 cube.obj --texture-size big -o out/a.obj
expect 2 1 cube.obj --gutter -1 -o out/a.obj
expect 2 1 cube.obj --gutter nan -o out/a.obj
expect 2 1 cube.obj --gutter 600 -o out/a.obj
expect 2 1 cube.obj --threads x -o out/a.obj
expect 2 1 cube.obj -o out/a.txt
expect 2 1 cube.obj --min-coverage 1.5 -o out/a.obj
expect 2 1 cube.obj --min-coverage 0.8 --density 9 -o out/a.obj
expect 0 0 --help
for option in MESH --output --mode --max-distortion --measure --max-charts --min-chart-texels --hard-angle --separate-materials \
  --min-coverage --seam-exchange-rate --min-texels-per-chart \
  --keep-uv --defragment --texture-size --gutter --pages --density --effort --rotation --up --snap --mip-levels --block --stack --weight --group --lock --report --threads \
  --pictures --picture --bake --quiet; do
  grep -q -e "$option" stdout || fail "--help does not explain $option"
done
files

# Files that cannot be read: one line that names file and line.
expect 3 1 missing.obj -o out/a.obj
expect 3 1 . -o out/a.obj
: >empty.obj
expect 3 1 empty.obj -o out/a.obj
printf 'v 0 0 0\nv 1 x 0\n' >broken.obj
expect 3 1 broken.obj -o out/a.obj
grep -q 'broken.obj:2: .*x' stderr || fail "the line is not named: $(cat stderr)"
head -c 5000 /dev/urandom >random.ply
expect 3 1 random.ply -o out/a.obj
printf 'v 0 0 0\nf 1 1 1\n' >point.obj
expect 1 2 point.obj -o out/a.obj
files

# Faces that take no part are told, and the others get coordinates.
(cat cube.obj && printf 'f 1 2 99\n') >repair.obj
expect 0 1 repair.obj -o out/a.obj
grep -q 'face 6' stderr || fail "the rejected face is not named"
[ "$(grep -c '^f ' out/a.obj)" -eq 7 ] || fail "the rejected face is lost"
rm out/*

# Places that cannot be written: one line, and nothing half-written.
expect 3 1 cube.obj -o out/no/such/folder.obj
expect 3 1 cube.obj -o out/a.obj --report out/no/r.json
expect 3 1 cube.obj -o out/a.obj --picture out/no/p.png
expect 3 1 cube.obj -o out/a.obj --report /dev/full
expect 3 1 cube.obj -o /dev/full
mkdir out/dir.obj
expect 3 1 cube.obj -o out/dir.obj
rmdir out/dir.obj
files
timeout 60 "$program" cube.obj -o out/a.obj >/dev/full 2>stderr
[ $? -eq 3 ] || fail "a full stdout goes unnoticed"
rm -f out/*
(ulimit -f 8 && timeout 60 "$program" cube.obj -o out/a.obj >/dev/null 2>&1)
[ $? -eq 3 ] || fail "a limit of the file size goes unnoticed"
files
echo old >out/a.obj
expect 3 1 cube.obj -o out/a.obj --report /dev/full
[ "$(cat out/a.obj)" = old ] || fail "the old file is gone"
rm out/a.obj
if [ "$(id -u)" -ne 0 ]; then
  chmod a-w out
  expect 3 1 cube.obj -o out/a.obj
  chmod u+w out
  files
fi

# A signal ends the run without a trace.
python3 - >big.obj <<'BIG'
n = 400
for j in range(n):
    for i in range(n):
        print("v", i, j, ((i * 7919 + j * 104729) % 97) / 10)
for j in range(n - 1):
    for i in range(n - 1):
        a = j * n + i + 1
        print("f", a, a + 1, a + n + 1, a + n)
BIG
timeout -s INT 1 "$program" big.obj -o out/a.obj >stdout 2>stderr
[ $? -eq 124 ] || fail "not interrupted in time"
[ "$(wc -l <stderr)" -eq 1 ] || fail "an interruption is told in one line: $(cat stderr)"
files

# So does the end of the time; enough of it is as good as no limit.
expect 124 1 big.obj -o out/a.obj --time-limit 0.7
grep -q 'time limit' stderr || fail "no word of the time limit: $(cat stderr)"
files
expect 0 0 cube.obj -o out/a.obj --time-limit 600
files "${all[@]/#/a}"
expect 2 1 cube.obj -o out/a.obj --time-limit -1

# Limits of memory: refused by the estimate, and by the system.
expect 0 0 cube.obj -o out/a.obj --memory-limit 0.5
expect 3 1 cube.obj -o out/b.obj --memory-limit 0.05
grep -q '12 triangles take about 0.1 GB' stderr || fail "no estimate: $(cat stderr)"
expect 3 1 cube.obj -o out/b.obj --memory-limit 0.101 --texture-size 8192 --packer rectangles --bake normals
grep -q 'not enough memory' stderr || fail "the limit of memory: $(cat stderr)"
[ ! -e out/b.obj ] || fail "something is written beyond the limit of memory"
rm -f out/*
files

# Faces that disagree which side is outside are turned on request; else they are told of.
python3 - >mixed.obj <<'MIXED'
import math, random
random.seed(5)
n = 12
for j in range(n):
    for i in range(n):
        print("v", i, j, 2 * math.sin(0.2 * i))
for j in range(n - 1):
    for i in range(n - 1):
        a = j * n + i + 1
        face = [a, a + 1, a + n + 1, a + n]
        print("f", *(face if random.random() < 0.7 else face[::-1]))
MIXED
charts() { python3 -c 'import json; print(len(json.load(open("out/a.json"))["charts"]))'; }
expect 0 1 mixed.obj -o out/a.obj
grep -q -- '--orient' stderr || fail "no hint at --orient: $(cat stderr)"
[ "$(grep '^f ' out/a.obj | sed 's#/[0-9]*##g')" = "$(grep '^f ' mixed.obj)" ] || fail "faces changed"
[ "$(charts)" -gt 20 ] || fail "charts run over edges where faces disagree"
rm out/*
expect 0 0 mixed.obj -o out/a.obj --orient
[ "$(charts)" -le 2 ] || fail "$(charts) charts of a sheet that has been oriented"
[ "$(grep -c '^f ' out/a.obj)" -eq 121 ] || fail "number of faces"
files "${all[@]/#/a}"

finish
