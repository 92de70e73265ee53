// SPDX-License-Identifier: MIT
// The package in Node.js: node --test package_test.mjs, with the folder of the package in ATLAS_PACKAGE.
import assert from 'node:assert/strict';
import { before, test } from 'node:test';
import { pathToFileURL } from 'node:url';

const folder = process.env.ATLAS_PACKAGE;
const atlas = await import(pathToFileURL(`${folder}/index.js`));
const { Atlas, AtlasError, ChartType, Initialize, NONE, Scene, version } = atlas;

/** A closed box of quadrilaterals, its sides divided: positions and corners. */
function box(n) {
  const vertices = new Map();
  const positions = [];
  const vertex = (p) => {
    const key = p.join();
    if (!vertices.has(key)) {
      vertices.set(key, vertices.size);
      positions.push(...p.map((x) => x / n));
    }
    return vertices.get(key);
  };
  const corners = [];
  for (let axis = 0; axis < 3; ++axis)
    for (const side of [0, n])
      for (let i = 0; i < n; ++i)
        for (let k = 0; k < n; ++k) {
          const at = (a, b) => {
            const p = [0, 0, 0];
            p[axis] = side;
            p[(axis + 1) % 3] = a;
            p[(axis + 2) % 3] = b;
            return vertex(p);
          };
          const square = [at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)];
          corners.push(...(side ? square : square.reverse()));
        }
  return { positions: Float32Array.from(positions), corners: Uint32Array.from(corners) };
}

/** Quadrilaterals as two triangles each. */
function halves(corners) {
  const indices = [];
  for (let i = 0; i < corners.length; i += 4) {
    const [a, b, c, d] = corners.subarray(i, i + 4);
    indices.push(a, b, c, a, c, d);
  }
  return Uint32Array.from(indices);
}

const { positions, corners } = box(5);
const faceSizes = new Uint32Array(corners.length / 4).fill(4);
const triangles = halves(corners);

function withScene(body) {
  const scene = new Scene();
  try {
    return body(scene);
  } finally {
    scene.delete();
  }
}

before(async () => {
  assert.throws(() => new Scene(), /not loaded yet/);
  await Initialize();
  await Initialize(); // loads it once
});

test('the version is that of the package', async () => {
  const { default: about } = await import(pathToFileURL(`${folder}/package.json`), { with: { type: 'json' } });
  assert.equal(version(), about.version);
});

test('an atlas of polygons covers each corner, and is proved', () =>
  withScene((scene) => {
    assert.equal(scene.addMesh({ positions, indices: corners, faceSizes }), 0);
    assert.equal(scene.generate({ width: 256, height: 128, gutter: 3 }), true);
    const { certificate } = scene.report;
    assert.equal(certificate.is_valid, true);
    assert.equal(certificate.faces, faceSizes.length);
    assert.ok(certificate.chart_distance_texels >= 3 || certificate.charts === 1);
    const { charts, pages, width, height, efficiency } = scene.summary;
    assert.deepEqual([pages, width, height], [1, 256, 128]);
    assert.ok(efficiency > 0.3 && efficiency <= 1);
    const result = scene.result(0);
    assert.equal(Math.max(...result.faceCharts) + 1, charts);
    assert.equal(result.cornerUvs.length, 2 * corners.length);
    assert.deepEqual(result.indices.map((v) => result.vmapping[v]), corners);
    result.indices.forEach((v, c) => {
      assert.equal(result.uvs[2 * v], result.cornerUvs[2 * c]);
      assert.equal(result.uvs[2 * v + 1], result.cornerUvs[2 * c + 1]);
    });
    assert.ok(result.uvs.every((x) => x >= 0 && x <= 1));
    assert.equal(result.triangles.length, 3 * result.faceOfTriangle.length);
  }));

test('the area of the triangles is what the summary says is covered', () =>
  withScene((scene) => {
    scene.addMesh({ positions, indices: triangles });
    scene.generate({ width: 256, height: 256 });
    const { uvs, triangles: of } = scene.result(0);
    let area = 0;
    for (let t = 0; t < of.length; t += 3) {
      const [ax, ay, bx, by, cx, cy] = [0, 1, 2].flatMap((i) => [uvs[2 * of[t + i]], uvs[2 * of[t + i] + 1]]);
      const twice = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
      assert.ok(twice > 0, 'a triangle is flipped');
      area += twice / 2;
    }
    assert.ok(Math.abs(area - scene.summary.efficiency) < 1e-6);
  }));

test('other arrays: doubles, a stride, no indices, 16 bits', () => {
  const uvsOf = (mesh) =>
    withScene((scene) => {
      scene.addMesh(mesh);
      scene.generate({ width: 128, height: 128 });
      return scene.result(0).cornerUvs;
    });
  const expected = uvsOf({ positions, indices: triangles });
  const strided = new Float32Array((positions.length / 3) * 5);
  for (let v = 0; 3 * v < positions.length; ++v) strided.set(positions.subarray(3 * v, 3 * v + 3), 5 * v);
  assert.deepEqual(uvsOf({ positions: Float64Array.from(positions), indices: triangles }), expected);
  assert.deepEqual(uvsOf({ positions: strided, stride: 5, indices: Uint16Array.from(triangles) }), expected);
  assert.deepEqual(uvsOf({ positions: [...positions], indices: [...triangles] }), expected);
  const loose = Float32Array.from(triangles, (v) => v).length;
  const soup = new Float32Array(3 * loose);
  triangles.forEach((v, c) => soup.set(positions.subarray(3 * v, 3 * v + 3), 3 * c));
  assert.equal(uvsOf({ positions: soup }).length, 2 * loose);
});

test('options and arrays that few need', () => {
  const chartsOf = (mesh, options) =>
    withScene((scene) => {
      scene.addMesh(mesh);
      scene.generate({ width: 128, height: 128, ...options });
      return scene.summary.charts;
    });
  const apart = { positions: [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 1e-6, 1, 1, 1e-6, 0, 1, 1e-6] };
  assert.equal(chartsOf(apart, {}), 2);
  assert.equal(chartsOf(apart, { weld: 1e-4 }), 1);
  const box = { positions, indices: corners, faceSizes };
  assert.equal(chartsOf(box, { segmentation: 'seams', hard_angle: 60, packer: 'rows' }), 6);
  assert.equal(chartsOf(box, { only_given_seams: true, hard_angle: 60 }), 6);
  assert.ok(chartsOf(box, { hide_seams: 'dome', hide_axis: [0, 0, 1] }) >= 1);
  assert.ok(chartsOf({ ...box, visibility: Array(positions.length / 3).fill(0.5) }, {}) >= 1);
  for (const [mesh, options] of [
    [box, { segmentation: 'nobody' }],
    [box, { hide_seams: 'dome' }],
    [{ ...box, visibility: [1] }, {}],
    [{ ...box, selected: [true] }, {}],
    [{ ...box, pinned: [true] }, {}],
    [{ ...box, pinned: corners.map(() => true) }, {}], // without coordinates
  ])
    assert.throws(() => chartsOf(mesh, options), AtlasError);
  // One face is unwrapped anew, and the others stay.
  withScene((scene) => {
    scene.addMesh(box);
    scene.generate({ width: 256, height: 256, hard_angle: 60 });
    const cornerUvs = scene.result(0).cornerUvs.slice();
    withScene((again) => {
      again.addMesh({ ...box, cornerUvs, selected: faceSizes.map((_, f) => f === 0) });
      assert.equal(again.generate({ width: 256, height: 256 }), true);
      assert.deepEqual(again.result(0).cornerUvs.slice(8), cornerUvs.slice(8));
    });
    // A corner is pinned, and its chart follows.
    withScene((again) => {
      const pinned = corners.map((_, c) => c === 0);
      again.addMesh({ ...box, cornerUvs: cornerUvs.map((x, i) => (i < 2 ? 0.5 : x)), pinned });
      assert.equal(again.generate({ width: 256, height: 256, hard_angle: 60 }), true);
      assert.deepEqual([...again.result(0).cornerUvs.slice(0, 2)], [0.5, 0.5]);
      assert.deepEqual(again.report.moved_pins, []);
    });
    // Its six charts merge.
    assert.ok(chartsOf({ ...box, cornerUvs }, { defragment: true }) < 6);
    assert.throws(() => chartsOf(box, { defragment: true }), AtlasError);
  });
});

test('verify says yes to what was made, and no to what overlaps', () =>
  withScene((scene) => {
    scene.addMesh({ positions, indices: triangles });
    scene.generate();
    const { cornerUvs } = scene.result(0);
    const verdictOf = (uvs) =>
      withScene((other) => {
        other.addMesh({ positions, indices: triangles, cornerUvs: uvs });
        return [other.verify(), other.report];
      });
    assert.equal(verdictOf(cornerUvs)[0], true);
    const overlapping = cornerUvs.slice();
    overlapping.set(cornerUvs.subarray(60, 66), 0); // the first triangle lies where the eleventh is
    const [isValid, report] = verdictOf(overlapping);
    assert.equal(isValid, false);
    assert.equal(report.is_overlap_free, false);
    assert.match(report.message, /overlap/);
  }));

test('faults are exceptions with a sentence', () =>
  withScene((scene) => {
    const fails = (body, message, status) =>
      assert.throws(body, (error) => error instanceof AtlasError && message.test(error.message) && error.status === status);
    fails(() => scene.generate(), /no meshes/, -1);
    fails(() => scene.addMesh({ positions, indices: [0, 1, 9999] }), /9999/, -1);
    fails(() => scene.addMesh({ positions, indices: [0, 1] }), /indices/, -1);
    scene.addMesh({ positions, indices: triangles });
    fails(() => scene.generate({ mode: 'best' }), /known are standard/, -1);
    fails(() => scene.generate({ wide: 3 }), /wide/, -1);
    fails(() => scene.generate({ max_charts: 1.5 }), /whole number/, -1);
    fails(() => scene.generate({ width: -5 }), /width/, -1);
    fails(() => scene.result(0), /no coordinates/, -1);
    fails(() => scene.addFile('model.obj', new TextEncoder().encode('v 0 0 zero\n')), /^model\.obj:1.*not a number/, -3);
    withScene((flat) => {
      flat.addMesh({ positions: [0, 0, 0, 1, 1, 1, 2, 2, 2] });
      fails(() => flat.generate(), /./, 2);
    });
  }));

test('progress is told, and ends the work', () =>
  withScene((scene) => {
    scene.addMesh({ positions, indices: triangles });
    const stages = new Set();
    scene.generate({}, (stage, fraction) => {
      stages.add(stage);
      assert.ok(fraction >= 0 && fraction <= 1);
    });
    assert.deepEqual([...stages], ['segmentation', 'parameterization', 'packing', 'verification']);
    assert.throws(() => scene.generate({}, () => false), (error) => error.status === 4);
  }));

const text = (lines) => new TextEncoder().encode(lines.join('\n'));
const rows = (width, array) => Array.from({ length: array.length / width }, (_, i) => array.subarray(width * i, width * (i + 1)));

test('files are read and written', () =>
  withScene((scene) => {
    const obj = text([...rows(3, positions).map((p) => `v ${p.join(' ')}`),
      ...rows(4, corners).map((f) => `f ${[...f].map((v) => v + 1).join(' ')}`)]);
    assert.equal(scene.addFile('Box.OBJ', obj), 0);
    const { positions: read, corners: vertices, firstCorners } = scene.model(0);
    assert.deepEqual(Float32Array.from(read), positions);
    assert.deepEqual(vertices, corners);
    assert.equal(firstCorners.length, faceSizes.length + 1);
    scene.generate();
    const { cornerUvs } = scene.result(0);
    for (const format of ['obj', 'ply', 'glb'])
      withScene((again) => {
        again.addFile(`box.${format}`, scene.write(0, format));
        assert.equal(again.verify(), true, format);
        assert.equal(again.report.triangles, 2 * faceSizes.length);
        if (format === 'glb') return; // triangles, and vertices at seams split
        again.pack(); // the coordinates are those of the file
        assert.deepEqual(again.model(0).corners, corners);
      });
    const lines = new TextDecoder().decode(scene.write(0, 'obj')).split('\n');
    const written = lines.filter((line) => line.startsWith('vt ')).map((line) => line.slice(3).split(' ').map(Math.fround));
    const used = lines.filter((line) => line.startsWith('f ')).flatMap((line) => line.slice(2).trim().split(' '));
    used.forEach((corner, c) => {
      const uv = written[Number(corner.split('/')[1]) - 1];
      assert.deepEqual(uv, [cornerUvs[2 * c], cornerUvs[2 * c + 1]]);
    });
    const off = text([`OFF ${positions.length / 3} ${triangles.length / 3} 0`, ...rows(3, positions).map((p) => p.join(' ')),
      ...rows(3, triangles).map((t) => `3 ${t.join(' ')}`)]);
    const stl = text(['solid box', ...rows(3, triangles).flatMap((t) => ['facet normal 0 0 0', 'outer loop',
      ...[...t].map((v) => `vertex ${positions.subarray(3 * v, 3 * v + 3).join(' ')}`), 'endloop', 'endfacet']), 'endsolid box']);
    for (const [name, bytes] of [['a.off', off], ['a.stl', stl]])
      withScene((other) => {
        other.addFile(name, bytes);
        assert.equal(other.generate(), true, name);
        assert.equal(other.report.triangles, triangles.length / 3);
      });
  }));

test('numbers of files: what the standard says of from_chars, to the last bit', () => {
  const numbers = ['1', '-0.5', '.25', '3.', '1e3', '-1E-3', '0.1', '1.7976931348623157e308', '4.9e-324', '123456789012345678901234567890',
    '0.30000000000000004', '9007199254740993', '1e22', '1e23', '8.5e-23', '2.2250738585072014e-308', '00001.50', '123456.789e-7'];
  const lines = [...numbers.flatMap((x) => [`v ${x} 0 0`]), 'v 0 1 0', 'v 0 0 1', `f 1 ${numbers.length + 1} ${numbers.length + 2}`];
  withScene((scene) => {
    scene.addFile('numbers.obj', text(lines));
    const { positions: read } = scene.model(0);
    numbers.forEach((x, i) => assert.equal(read[3 * i], Number(x), x));
  });
  for (const wrong of ['0x10', '1e', '--1', 'e5', '1.2.3', '-'])
    withScene((scene) => assert.throws(() => scene.addFile('a.obj', text([`v ${wrong} 0 0`])), /not a number/, wrong));
});

test('the interface of watlas', () => {
  const made = new Atlas();
  made.addMesh({ vertexPositionData: positions, vertexCount: positions.length / 3, vertexPositionStride: 12,
    indexData: Uint16Array.from(triangles), indexCount: triangles.length });
  made.addMesh({ vertexPositionData: positions.map((x) => 2 * x), vertexCount: positions.length / 3, vertexPositionStride: 12,
    indexData: triangles, indexCount: triangles.length });
  made.generate({ maxCost: 3 }, { resolution: 512, padding: 2 });
  assert.deepEqual([made.meshCount, made.width, made.height, made.atlasCount], [2, 512, 512, 1]);
  let charts = 0;
  for (let m = 0; m < made.meshCount; ++m) {
    const mesh = made.getMesh(m);
    const indices = new Uint32Array(mesh.indexCount);
    assert.equal(mesh.getIndexArray(indices), true);
    assert.equal(mesh.getIndexArray(new Uint32Array(2)), false);
    assert.deepEqual(indices.map((v) => mesh.getVertex(v).xref), triangles);
    const faces = [];
    for (let i = 0; i < mesh.chartCount; ++i) {
      const chart = mesh.getChart(i);
      const list = new Uint32Array(chart.faceCount);
      assert.equal(chart.getFaceArray(list), true);
      assert.deepEqual([chart.type, chart.atlasIndex, chart.material], [ChartType.LSCM, 0, 0]);
      list.forEach((f) => assert.equal(mesh.getVertex(indices[3 * f]).chartIndex, charts + i));
      faces.push(...list);
    }
    assert.deepEqual(faces.sort((a, b) => a - b), [...Array(triangles.length / 3).keys()]);
    for (let v = 0; v < mesh.vertexCount; ++v) assert.ok(mesh.getVertex(v).uv.every((x) => x >= 0 && x <= 512));
    charts += mesh.chartCount;
  }
  assert.equal(made.chartCount, charts);
  const share = new Float32Array(1);
  assert.equal(made.getUtilization(share), true);
  assert.ok(share[0] > 0.2 && share[0] < 1);
  assert.ok(made.texelsPerUnit > 0);
  made.delete();
});

test('watlas: charts that exist, a density, nothing with an area', () => {
  const flat = new Atlas();
  flat.addUvMesh({ vertexUvData: Float32Array.of(0, 0, 4, 0, 4, 4, 0, 4), vertexCount: 4, vertexStride: 8, indexData: Uint16Array.of(0, 1, 2, 0, 2, 3) });
  flat.computeCharts();
  flat.packCharts({ resolution: 64 });
  assert.deepEqual([flat.chartCount, flat.width], [1, 64]);
  const dense = new Atlas();
  dense.addMesh({ vertexPositionData: positions, vertexCount: positions.length / 3, vertexPositionStride: 12, indexData: triangles });
  dense.generate({}, { texelsPerUnit: 40 });
  assert.ok(dense.width < 200 && Math.abs(dense.texelsPerUnit - 40) < 6, `${dense.width} ${dense.texelsPerUnit}`);
  const point = new Atlas();
  point.addMesh({ vertexPositionData: new Float32Array(9), vertexCount: 3, vertexPositionStride: 12 });
  point.generate();
  assert.deepEqual([point.meshCount, point.chartCount, point.getMesh(0).vertexCount, point.getMesh(0).indexCount], [1, 0, 3, 3]);
  assert.equal(point.getMesh(0).getVertex(0).chartIndex, -1);
  assert.equal(NONE, 0xffffffff);
});
