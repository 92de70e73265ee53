#!/bin/bash
# SPDX-License-Identifier: MIT
# Stages by name, the paper's mode and seams of one's own in texture_atlas. Usage: stages_test.sh PROGRAM
source "$(dirname "$0")/cli_helpers.sh"
cd "$folder" || exit 2

# refuse CODE PATTERN ARGUMENTS...: the exit code, and what the one line on stderr must match
refuse() {
  local code=$1 pattern=$2
  shift 2
  run "$code" "$@"
  grep -q -e "$pattern" stderr || fail "no '$pattern' on stderr: $* ($(cat stderr))"
  [ "$(wc -l <stderr)" -eq 1 ] || fail "more than one line on stderr: $*"
  [ -e a.obj ] && fail "a model in spite of an error: $*"
}

# value KEY: of the report; of a list its length
value() {
  python3 -c 'import json, sys; v = json.load(open("a.json"))[sys.argv[1]]; print(len(v) if isinstance(v, list) else v)' "$1"
}

# make ARGUMENTS...: an atlas of a.obj and its report, with coordinates that are proved
make() {
  rm -f a.json
  run 0 "$@" -o a.obj --texture-size 128 --threads 1
  [ "$(value is_valid)" = True ] || fail "not valid: $*"
  rm -f a.obj
}

python3 - <<'MESHES'
import math
n = 12
with open("sheet.obj", "w") as f:
    for j in range(n):
        for i in range(n):
            print("v", i, j, 2 * math.sin(0.2 * i) * math.sin(0.3 * j), file=f)
    for j in range(n - 1):
        for i in range(n - 1):
            a = j * n + i + 1
            print("f", a, a + 1, a + n + 1, a + n, file=f)
with open("colored.obj", "w") as f:
    for line in open("sheet.obj"):
        shade = 0.1 * (len(line) % 7)
        f.write(f"{line.strip()} {shade} {shade} {shade}\n" if line.startswith("v") else line)
with open("seen.txt", "w") as f:
    print("# left to right", *(f"{i / (n - 1):.3f}" for j in range(n) for i in range(n)), file=f, sep="\n")
# A box of two floors: vertices 5 to 8 are around its middle.
points = [(x, y, z) for z in range(3) for x, y in [(0, 0), (1, 0), (1, 1), (0, 1)]]
sides = [(4 * z + i, 4 * z + (i + 1) % 4, 4 * z + 4 + (i + 1) % 4, 4 * z + 4 + i) for z in range(2) for i in range(4)]
with open("box.obj", "w") as f:
    for p in points:
        print("v", *p, file=f)
    for face in [(0, 3, 2, 1), (8, 9, 10, 11)] + sides:
        print("f", *(v + 1 for v in face), file=f)
for name, text in {
    "numbers.txt": "# around the middle\n5 6 7 8 5\n",
    "lines.obj": "l 5 6\nl 6 7 8\nl -5 5\n",
    "own.obj": "v 0 1 1\nv 0 0 1\nv 1 0 1\nv 1 1 1\nl 1 2 3 4 1\n",
    "wrong.txt": "5 6\n5 7\n",
    "far.txt": "5 6\n6 99\n",
    "word.txt": "5 6 x\n",
    "none.txt": "nothing here\n",
    "few.txt": "0.5\n1\n",
    "large.txt": "0.5\n1.5\n",
    "pins.txt": "# two corners of the sheet\n1 0.3 0.25\n12 0.7 0.25\n",
    "outside.txt": "1 0.9 0.9\n2 0.95 0.9\n",
    "beyond.txt": "1 0.5 0.5\n12 1.5 0.25\n",
}.items():
    open(name, "w").write(text)
MESHES

# Names that are not known are answered with those that are.
refuse 2 '--segmentation.*features.*paper.*seams' box.obj -o a.obj --segmentation nonsense
refuse 2 '--parameterizer.*abf.*bijective.*lscm.*tutte' box.obj -o a.obj --parameterizer nonsense
refuse 2 '--solver.*cg.*direct.*multigrid.*pcg' box.obj -o a.obj --solver nonsense
refuse 2 '--pins.*diameter.*sweep' box.obj -o a.obj --pins nonsense
refuse 2 '--optimizer.*none.*stretch' box.obj -o a.obj --optimizer nonsense
refuse 2 '--validator.*exact.*stencil' box.obj -o a.obj --validator nonsense
refuse 2 '--packer.*horizon.*raster.*rows' box.obj -o a.obj --packer nonsense
refuse 2 '--mode.*conformal.*paper' box.obj -o a.obj --mode nonsense

# So are combinations in which a wish would not be heard.
refuse 2 '--solver.*tutte' box.obj -o a.obj --solver cg --parameterizer tutte
refuse 2 '--max-charts.*paper' box.obj -o a.obj --max-charts 3 --mode paper
refuse 2 '--max-distortion.*features' box.obj -o a.obj --max-distortion 2 --segmentation features
refuse 2 '--max-area-ratio' box.obj -o a.obj --max-area-ratio 0.5
refuse 2 '--seams' box.obj sheet.obj -o a.obj --seams numbers.txt

# Every name does its work.
for name in features paper normals region-growing variational seams; do
  make sheet.obj --segmentation $name
done
for name in abf arap bijective bijective-conformal floater harmonic lscm mean-value schnyder spectral tutte; do
  make sheet.obj --parameterizer $name --max-area-ratio 0
done
for name in cg direct multigrid out-of-core pcg; do
  make sheet.obj --parameterizer lscm --solver $name --pins diameter
done
for name in conformal-stretch mips none stretch stretch-fixed-border symmetric-dirichlet; do
  make sheet.obj --parameterizer harmonic --optimizer $name --max-area-ratio 0
  [ $name = none ] || python3 -c '
import json, sys
r = json.load(open("a.json"))
before, after = (r[key]["l2_stretch"] for key in ("unoptimized", "distortion"))
sys.exit(not after < before)' || fail "--optimizer $name does not lower stretch"
done
for name in horizon raster rectangles rows; do
  make sheet.obj --packer $name
done
make sheet.obj --validator stencil --max-area-ratio 0
make sheet.obj --packer horizon --free-aspect
python3 -c '
import json
r = json.load(open("a.json"))
assert 0.9 < r["page_width"] * r["page_height"] / 128**2 < 1.1, r["page_width"]' || fail "another number of texels"

# The paper.
make sheet.obj --mode paper
[ "$(value rejoined_pieces)" -eq 0 ] && [ "$(value segmented_charts)" -ge 1 ] || fail "the report of the paper's mode"
[ "$(value gradient_angles)" -eq 180 ] || fail "no angles for figure 9"

# Seams: around a box's middle, by numbers, as OBJ, and with vertices of their own.
for seams in numbers.txt lines.obj own.obj; do
  make box.obj --segmentation seams --seams $seams --max-area-ratio 0
  [ "$(value charts)" -eq 2 ] || fail "$(value charts) charts of a box that is cut around the middle by $seams"
done
make box.obj --segmentation seams --max-area-ratio 0
[ "$(value charts)" -eq 1 ] || fail "$(value charts) charts of a box without seams"
refuse 3 'wrong.txt.*line 2.*5.*7' box.obj -o a.obj --seams wrong.txt
refuse 3 'far.txt.*line 2.*99' box.obj -o a.obj --seams far.txt
refuse 3 'word.txt.*line 1.*x' box.obj -o a.obj --seams word.txt
refuse 3 'none.txt' box.obj -o a.obj --seams none.txt
refuse 3 'missing.txt' box.obj -o a.obj --seams missing.txt

# Pinned vertices.
make sheet.obj --pinned pins.txt
[ "$(value moved_pins)" -eq 0 ] || fail "pins have moved: $(cat stderr)"
run 0 sheet.obj -o a.obj --texture-size 128 --threads 1 --pinned pins.txt
grep -q '^vt 0.30000001192092896 0.25$' a.obj && grep -q '^vt 0.699999988079071 0.25$' a.obj || fail "no coordinates of pins: $(grep -m3 ^vt a.obj)"
rm a.obj
make sheet.obj --pinned outside.txt
[ "$(value moved_pins)" -eq 1 ] && grep -q 'chart 0 could not stay' stderr || fail "a chart leaves the page, and nothing is said: $(cat stderr)"
refuse 2 '--pinned.*--keep-uv' sheet.obj -o a.obj --pinned pins.txt --keep-uv
refuse 2 '--pinned' box.obj sheet.obj -o a.obj --pinned pins.txt
refuse 3 'beyond.txt.*line 2' sheet.obj -o a.obj --pinned beyond.txt
refuse 3 'far.txt.*line 1' sheet.obj -o a.obj --pinned far.txt
refuse 3 'none.txt' sheet.obj -o a.obj --pinned none.txt

# Seams out of sight: by openness, viewers, colours and numbers.
for hiding in openness view:0,0,1 view:-z dome:y colors seen.txt; do
  mesh=sheet.obj
  [ $hiding = colors ] && mesh=colored.obj
  make $mesh --hide-seams $hiding
done
for hiding in view dome:0,0,0 view:1,2 dome:w view:1,2,3,4; do
  refuse 2 '--hide-seams.*axis' sheet.obj -o a.obj --hide-seams $hiding
done
refuse 3 'no colours' sheet.obj -o a.obj --hide-seams colors
refuse 3 'missing.txt' sheet.obj -o a.obj --hide-seams missing.txt
refuse 3 'few.txt.*2.*144' sheet.obj -o a.obj --hide-seams few.txt
refuse 3 'large.txt.*line 2.*1.5' sheet.obj -o a.obj --hide-seams large.txt
refuse 2 '--keep-uv.*--hide-seams' sheet.obj -o a.obj --keep-uv --hide-seams openness

finish
