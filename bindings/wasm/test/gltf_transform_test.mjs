// SPDX-License-Identifier: MIT
// glTF-Transform takes the package in place of watlas. The modules of npm are in ATLAS_NODE_MODULES.
import assert from 'node:assert/strict';
import { createRequire } from 'node:module';
import { pathToFileURL } from 'node:url';

const require = createRequire(`${process.env.ATLAS_NODE_MODULES}/`);
const load = (name) => import(pathToFileURL(require.resolve(name)));
const { Document } = await load('@gltf-transform/core');
const { unwrap } = await load('@gltf-transform/functions');
const watlas = await import(pathToFileURL(`${process.env.ATLAS_PACKAGE}/index.js`));

/** A cube of two triangles a side. */
function addCube(document, name, scale, Indices) {
  const corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => [i & 1, (i >> 1) & 1, i >> 2]);
  const sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
  const buffer = document.getRoot().listBuffers()[0] ?? document.createBuffer();
  const accessor = (type, array) => document.createAccessor().setType(type).setArray(array).setBuffer(buffer);
  const primitive = document.createPrimitive()
    .setAttribute('POSITION', accessor('VEC3', Float32Array.from(corners.flat())))
    .setIndices(accessor('SCALAR', Indices.from(sides.flatMap(([a, b, c, d]) => [a, b, c, a, c, d]))));
  const mesh = document.createMesh(name).addPrimitive(primitive);
  document.createScene().addChild(document.createNode(name).setMesh(mesh).setScale([scale, scale, scale]));
}

const document = new Document();
addCube(document, 'small', 1, Uint16Array);
addCube(document, 'large', 2, Uint32Array);
await document.transform(unwrap({ watlas, texcoord: 1, groupBy: 'scene' }));

const areas = document.getRoot().listMeshes().map((mesh) => {
  const [primitive] = mesh.listPrimitives();
  const uvs = primitive.getAttribute('TEXCOORD_1').getArray();
  const positions = primitive.getAttribute('POSITION').getArray();
  const indices = primitive.getIndices().getArray();
  assert.equal(indices.length, 36);
  assert.equal(positions.length / 3, uvs.length / 2);
  assert.ok(uvs.every((x) => x >= 0 && x <= 1));
  let area = 0;
  for (let i = 0; i < indices.length; i += 3) {
    const [a, b, c] = indices.subarray(i, i + 3);
    const twice = (uvs[2 * b] - uvs[2 * a]) * (uvs[2 * c + 1] - uvs[2 * a + 1]) - (uvs[2 * b + 1] - uvs[2 * a + 1]) * (uvs[2 * c] - uvs[2 * a]);
    assert.ok(twice > 0, 'a triangle is flipped, or flat');
    area += twice / 2;
    const sum = [0, 1, 2].map((k) => [a, b, c].filter((v) => positions[3 * v + k] === 0).length);
    assert.ok(sum.includes(3) || sum.includes(0), 'a triangle has other corners than before');
  }
  return area;
});
assert.ok(Math.abs(areas[1] / areas[0] - 4) < 1e-3, `scale tells the density: ${areas}`);
assert.ok(areas[0] + areas[1] > 0.3);
console.log(`two cubes cover ${areas.map((area) => (100 * area).toFixed(1)).join(' and ')} % of their page`);
