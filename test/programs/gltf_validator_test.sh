#!/bin/bash
# SPDX-License-Identifier: MIT
# The validator of the Khronos Group finds no error in what is written as glTF. Usage: gltf_validator_test.sh PROGRAM FOLDER
# FOLDER keeps the validator, an npm package.
source "$(dirname "$0")/cli_helpers.sh"
package=gltf-validator@2.0.0-dev.3.10
[ -d "$2/node_modules/gltf-validator" ] || npm install --no-audit --no-fund --prefix "$2" "$package" >&2 ||
  { echo "FAILED: $package cannot be installed"; exit 1; }
cd "$folder" || exit 2

# validate FILE...: errors and warnings are printed and counted
validate() {
  NODE_PATH=$2/node_modules node - "${@:3}" <<'JS' || fail "$1"
const fs = require("fs"), path = require("path"), validator = require("gltf-validator");
const load = (file) => async (uri) => new Uint8Array(fs.readFileSync(path.join(path.dirname(file), decodeURIComponent(uri))));
(async () => {
  let count = 0;
  for (const file of process.argv.slice(2)) {
    const { issues } = await validator.validateBytes(new Uint8Array(fs.readFileSync(file)), { uri: file, externalResourceFunction: load(file) });
    for (const issue of issues.messages.filter((m) => m.severity < 2)) {
      console.log(`${file}: ${issue.code} at ${issue.pointer}: ${issue.message}`);
      ++count;
    }
  }
  process.exit(count > 0 ? 1 : 0);
})();
JS
}

# A bent sheet of quadrilaterals with colours, and a material; a box beside it.
python3 - <<'MESH'
n = 8
with open("sheet.obj", "w") as f:
    f.write("mtllib sheet.mtl\nusemtl plain\n")
    for y in range(n + 1):
        for x in range(n + 1):
            f.write("v %g %g %g %g .5 1\n" % (x, y, 0.3 * (x - 4) ** 2 - 0.1 * x * y, x / n))
    for y in range(n):
        for x in range(n):
            a = y * (n + 1) + x + 1
            f.write("f %d %d %d %d\n" % (a, a + 1, a + n + 2, a + n + 1))
with open("sheet.mtl", "w") as f:
    f.write("newmtl plain\nKd 1 .5 0\nd 0.5\n")
with open("box.obj", "w") as f:
    for z in (0, 1):
        f.write("v 20 0 %d\nv 21 0 %d\nv 21 1 %d\nv 20 1 %d\n" % (z, z, z, z))
    f.write("f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n")
MESH

# model NAME ARGUMENTS...: a model of 128 texels a side
model() {
  run 0 "${@:2}" -o "$1" --texture-size 128 --threads 1 --quiet
}
model plain.glb sheet.obj
model colors.glb sheet.obj --bake colors
model alpha.glb sheet.obj --bake texture
model normals.glb sheet.obj --bake tangent-normals
model pages.glb sheet.obj box.obj --density 8
validate "models" "$2" plain.glb colors.glb alpha.glb normals.glb pages_sheet.glb pages_box.glb

# Documents that stay what they are, with one set of coordinates more.
model lightmap.glb alpha.glb --uv-set 1
model again.glb colors.glb --bake texture
model both.glb lightmap.glb --uv-set 0
validate "documents" "$2" lightmap.glb again.glb both.glb

# The validator is one that finds faults: an attribute that is not there.
sed 's/"TEXCOORD_0"/"TEXCOORD_7"/' plain.glb >broken.glb
if (validate "a fault is found" "$2" broken.glb) | grep -q 'broken.glb: MESH_PRIMITIVE'; then :; else fail "no fault is found in a broken file"; fi
finish
