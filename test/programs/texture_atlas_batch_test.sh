#!/bin/bash
# SPDX-License-Identifier: MIT
# Atlases of a thousand small meshes, in one part and in eight, killed and taken up again. Usage: batch_test.sh PROGRAM
source "$(dirname "$0")/cli_helpers.sh"
cd "$folder" || exit 2

count=1000
mkdir meshes
python3 - $count <<'MESHES'
import sys
# Strips of 2 to 21 quadrilaterals, each folded its own way.
for i in range(int(sys.argv[1])):
    n, step = 2 + i % 20, 0.01 * (i // 20 % 50)
    with open(f"meshes/{i:04}.obj", "w") as file:
        for k in range(n + 1):
            z = step * (k % 2 + 0.1 * k)
            file.write(f"v {k} 0 {z}\nv {k} 1 {z}\n")
        for k in range(n):
            a = 2 * k + 1
            file.write(f"f {a} {a + 2} {a + 3} {a + 1}\n")
MESHES
ls meshes/*.obj >list.txt
options=(--texture-size 64 --packer rectangles --mode conformal)

# batch CODE FOLDER ARGUMENTS...: a run over the list; what it prints is kept as FOLDER.txt and FOLDER.err
batch() {
  local code=$1 out=$2 got
  shift 2
  timeout 250 "$program" --batch list.txt --threads "${threads:-1}" -o "$out" "${options[@]}" "$@" >"$out.txt" 2>"$out.err" </dev/null
  got=$?
  [ $got -eq "$code" ] || fail "exit code $got instead of $code: $out $* ($(tail -n 1 "$out.err"))"
}

# summary FOLDER TEXT: the last line on stderr
summary() { tail -n 1 "$1.err" | grep -q -F -e "$2" || fail "$1: no '$2' in: $(tail -n 1 "$1.err")"; }

# same FOLDER FOLDER: files and bytes
same() { diff -r "$1" "$2" >/dev/null || fail "$1 and $2 differ: $(diff -rq "$1" "$2" | head -n 3)"; }

# In one part: a line for each mesh, in order, and files that can be read.
batch 0 whole
summary whole "$count of $count meshes: $count now, 0 before, 0 failed"
python3 - whole.txt list.txt <<'LINES' || fail "the lines of the whole run"
import json, os, sys
lines = [json.loads(line) for line in open(sys.argv[1])]
assert [line["mesh"] for line in lines] == open(sys.argv[2]).read().split()
for line in lines:
    assert line["result"] == "valid" and line["exit_code"] == 0 and line["messages"] == [], line
    report = json.load(open(line["model"].replace(".obj", ".json")))
    assert report["faces"] == line["faces"] and report["is_valid"] and "seconds" not in report
LINES

# In eight parts, some at the same time. Then a run over all of it finds everything done, and has all lines.
for group in '1 2' '3 4' '5 6' '7 8'; do
  for part in $group; do
    "$program" --batch list.txt --threads 1 -o parts "${options[@]}" --shard "$part/8" >"part$part.txt" 2>"part$part.err" &
  done
  wait
done
[ "$(cat part?.txt | wc -l)" -eq $count ] || fail "lines of the parts: $(cat part?.txt | wc -l)"
sort part?.txt | sed 's/"parts/"whole/' | diff -q - whole.txt >/dev/null || fail "the lines of the parts are others"
batch 0 parts
summary parts "$count of $count meshes: 0 now, $count before, 0 failed"
sed 's/"parts/"whole/' parts.txt | diff -q - whole.txt >/dev/null || fail "the lines of a run that finds all done are others"
same whole parts

# Killed in the middle; the next run does the rest.
count=300
head -n $count list.txt >short.txt && mv short.txt list.txt
"$program" --batch list.txt --threads 1 -o killed "${options[@]}" >killed.txt 2>killed.err &
process=$!
for ((i = 0; i < 2000; ++i)); do
  [ "$(wc -l <killed.txt)" -ge 100 ] && break
  sleep 0.05
done
kill -9 $process
wait $process 2>killed.wait
done_before=$(wc -l <killed.txt)
[ "$done_before" -ge 100 ] && [ "$done_before" -lt $count ] || fail "killed after $done_before lines"
: >killed/meshes/.0000.obj.99999999.part # as a run that is killed may leave
batch 0 killed
before=$(tail -n 1 killed.err | sed -n 's/.* \([0-9]*\) before.*/\1/p')
[ $((before - done_before)) -ge 0 ] && [ $((before - done_before)) -le 1 ] ||
  fail "$done_before meshes were done, $before of them are known"
[ -z "$(diff -rq whole killed | grep -v '^Only in whole')" ] || fail "other files after a run that was killed"
[ "$(find killed -type f | wc -l)" -eq $((5 * count)) ] || fail "$(find killed -type f | wc -l) files after a run that was killed"

# Only what has changed is done again: a mesh, a file that is gone, one with other bytes; then an option.
sed -i 's/^v 0 0 .*/v 0 0 0.7/' meshes/0007.obj
rm killed/meshes/0100.mtl
echo >>killed/meshes/0200.obj
batch 0 killed
summary killed ": 3 now, $((count - 3)) before, 0 failed"
head -n 20 list.txt >short.txt && mv short.txt list.txt
batch 0 killed --gutter 3
summary killed "20 of 20 meshes: 20 now, 0 before, 0 failed"
threads=2 batch 0 killed --gutter 3 --time-limit 1000
summary killed "0 now, 20 before, 0 failed"

# What is read besides the mesh counts: its material, which is missing at first, and a picture.
cat >textured.obj <<'MESH'
mtllib textured.mtl
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
vt 0 0
vt 1 0
vt 1 1
vt 0 1
usemtl paint
f 1/1 2/2 3/3 4/4
MESH
echo textured.obj >list.txt
batch 0 textures --bake texture # without the library it is grey
printf 'newmtl paint\nKd 1 0 0\n' >textured.mtl
batch 0 textures --bake texture
summary textures "1 now, 0 before, 0 failed"
batch 0 textures --bake texture
summary textures "0 now, 1 before, 0 failed"
printf 'newmtl paint\nKd 0 1 0\n' >textured.mtl
batch 0 textures --bake texture
summary textures "1 now, 0 before, 0 failed"

# Meshes that fail stop nothing: one that is not there, one that is nothing, one without area, one that cannot be written.
cp meshes/0001.obj a.obj && cp meshes/0002.obj b.obj
echo nothing >broken.obj
printf 'v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n' >point.obj
printf '%s\n' a.obj missing.obj '' broken.obj point.obj a.obj 'sub/../b.obj' a.off blocked/c.obj b.obj >list.txt
printf 'OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n' >a.off
mkdir -p sub blocked && cp a.obj blocked/c.obj
mkdir -p fails && : >fails/blocked
batch 1 fails
summary fails "8 of 8 meshes: 8 now, 0 before, 4 failed"
python3 - fails.txt <<'LINES' || fail "the lines of meshes that fail: $(cat fails.txt)"
import json, sys
lines = [json.loads(line) for line in open(sys.argv[1])]
codes = [(line["mesh"], line["model"], line["exit_code"]) for line in lines]
assert codes == [("a.obj", "fails/a.obj", 0), ("missing.obj", "fails/missing.obj", 3), ("broken.obj", "fails/broken.obj", 3),
                 ("point.obj", "fails/point.obj", 1), ("sub/../b.obj", "fails/b.obj", 0), ("a.off", "fails/a_2.obj", 0),
                 ("blocked/c.obj", "fails/blocked/c.obj", 3), ("b.obj", "fails/b_2.obj", 0)], codes
assert "cannot read" in lines[1]["messages"][0] and lines[1]["result"] == "failed"
LINES
[ "$(wc -l <fails.err)" -eq 5 ] || fail "a line for each failure and one for all: $(cat fails.err)"
batch 1 fails
summary fails "8 of 8 meshes: 4 now, 4 before, 4 failed"

# A process that is killed is a mesh that fails.
python3 - <<'MESH'
n = 700
with open("large.obj", "w") as file:
    for i in range(n):
        for j in range(n):
            file.write(f"v {i} {j} {(i * i + j * j) % 17 * 0.1}\n")
    for i in range(n - 1):
        for j in range(n - 1):
            a = i * n + j + 1
            file.write(f"f {a} {a + 1} {a + n + 1} {a + n}\n")
MESH
printf '%s\n' large.obj b.obj >list.txt
"$program" --batch list.txt --threads 1 -o shot "${options[@]}" >shot.txt 2>shot.err &
process=$!
for ((i = 0; i < 400; ++i)); do
  child=$(cat /proc/$process/task/$process/children 2>/dev/null || pgrep -P $process)
  [ -n "$child" ] && break
  sleep 0.05
done
kill -9 $child
wait $process
[ $? -eq 1 ] || fail "exit code after a mesh was killed"
grep -q '"exit_code":137,"messages":\["large.obj: ended by signal 9' shot.txt || fail "no line for the mesh that was killed: $(cat shot.txt)"
grep -q '"mesh":"b.obj".*"result":"valid"' shot.txt || fail "the mesh after it"

# Interrupted: the summary, and the exit code.
"$program" --batch list.txt --threads 1 -o stopped "${options[@]}" >stopped.txt 2>stopped.err &
process=$!
sleep 0.5
kill -TERM $process
wait $process
[ $? -eq 130 ] || fail "exit code after an interrupt"
[ ! -s stopped.txt ] && [ ! -e stopped/large.obj ] || fail "something is left of a run that was interrupted"
summary stopped "0 of 2 meshes"

# Wrong command lines.
for wrong in '--shard 0/3' '--shard 4/3' '--shard 1' '--shard 1/2x' 'a.obj' '--report r.json' '--picture p.png' \
  '--keep-uv --hard-angle 3' '--format off'; do
  batch 2 wrong $wrong
  [ ! -e wrong ] && [ ! -s wrong.txt ] || fail "something is done: $wrong"
done
run 2 a.obj --shard 1/2
echo a.obj >list.txt
batch 3 .
grep -q overwritten ..err || fail "a mesh would be overwritten by its atlas"
cp meshes/0000.obj b.obj
printf 'deep/b.obj\nb.obj\n' >list.txt
mkdir deep old
cp b.obj deep/b.obj
cp b.obj deep/kept.obj
batch 3 . # deep/b.obj is first and would take the name of b.obj
cmp -s b.obj deep/kept.obj || fail "a mesh of the list is overwritten by the atlas of another"
printf '\357\273\277a.obj\n' >list.txt # as Windows starts a text
batch 0 windows
# What has been read is not written over: the second run would start from another texture.
run 0 a.obj -o old/tq.obj --texture-size 64
cp old/tq_checkerboard.png old/tq_texture.png
sed -i 's/tq_checkerboard/tq_texture/' old/tq.mtl
cp old/tq_texture.png kept.png
echo old/tq.obj >list.txt
batch 1 . --format ply --bake texture
cmp -s old/tq_texture.png kept.png || fail "a texture that was read is overwritten"
run 3 --batch none.txt
finish
