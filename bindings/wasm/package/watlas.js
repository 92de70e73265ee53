// SPDX-License-Identifier: MIT
// The interface of the package watlas, so that glTF-Transform's unwrap() takes this package in its place.
import { AtlasError, NONE, Scene, floats, loaded } from './index.js';

/** How a chart was flattened. Those of Atlas are all LSCM. */
export const ChartType = Object.freeze({ Planar: 0, Ortho: 1, LSCM: 2, Piecewise: 3, Invalid: 4 });

/** A row of numbers without the gaps of a stride in bytes. */
function rows(data, width, strideBytes, count, name) {
  const numbers = floats(data);
  const step = strideBytes ? strideBytes / numbers.BYTES_PER_ELEMENT : width;
  if (!(Number.isInteger(step) && step >= width))
    throw new AtlasError(`the stride of ${name} must be a multiple of 4 and at least ${4 * width}, but is ${strideBytes}`, -1);
  if (numbers.length < (count - 1) * step + width)
    throw new AtlasError(`${name} must have entries for ${count} vertices, but has ${numbers.length} numbers`, -1);
  if (step === width) return numbers.subarray(0, count * width);
  const dense = new Float32Array(count * width);
  for (let i = 0; i < count; ++i) dense.set(numbers.subarray(i * step, i * step + width), i * width);
  return dense;
}

/** Indices as watlas takes them: the first `indexCount` of them, `indexOffset` added; none: the vertices in turn. */
function indicesOf(mesh) {
  if (!mesh.indexData) return Uint32Array.from({ length: mesh.indexCount || mesh.vertexCount }, (_, i) => i);
  const offset = mesh.indexOffset ?? 0;
  const indices = mesh.indexData.subarray(0, mesh.indexCount ?? mesh.indexData.length);
  return Uint32Array.from(indices, (index) => index + offset);
}

function meshOf(mesh) {
  return {
    positions: rows(mesh.vertexPositionData, 3, mesh.vertexPositionStride, mesh.vertexCount, 'vertexPositionData'),
    indices: indicesOf(mesh),
    faceSizes: mesh.faceVertexCount?.subarray(0, mesh.faceCount ?? mesh.faceVertexCount.length),
    faceMaterials: mesh.faceMaterialData,
    vertexUvs: mesh.vertexUvData
      ? rows(mesh.vertexUvData, 2, mesh.vertexUvStride, mesh.vertexCount, 'vertexUvData')
      : undefined,
  };
}

/** A mesh of which only coordinates are known, flat in space. */
function flatMeshOf(mesh) {
  const uvs = rows(mesh.vertexUvData, 2, mesh.vertexStride, mesh.vertexCount, 'vertexUvData');
  const positions = new Float32Array(3 * mesh.vertexCount);
  for (let i = 0; i < mesh.vertexCount; ++i) positions.set(uvs.subarray(2 * i, 2 * i + 2), 3 * i);
  return { positions, indices: indicesOf(mesh), faceMaterials: mesh.faceMaterialData, vertexUvs: uvs };
}

class Chart {
  constructor(faces, atlasIndex, material) {
    this.faces = faces;
    this.atlasIndex = atlasIndex;
    this.type = ChartType.LSCM;
    this.material = material;
  }

  get faceCount() {
    return this.faces.length;
  }

  getFaceArray(array) {
    return fill(array, this.faces);
  }
}

function fill(array, values) {
  if (array.length < values.length) return false;
  array.set(values);
  return true;
}

/** The atlas of a mesh. Coordinates are in texels. */
class Mesh {
  #result;
  #scale;
  #pages;
  #vertexCharts;
  #charts;

  constructor(result, scale, materials) {
    this.#result = result;
    this.#scale = scale;
    const { faceCharts, facePages, faceOfTriangle, triangles } = result;
    this.#pages = new Int32Array(result.vmapping.length).fill(-1);
    this.#vertexCharts = new Int32Array(result.vmapping.length).fill(-1);
    const faces = new Map();
    faceCharts.forEach((chart, face) => {
      if (chart === NONE) return;
      if (!faces.has(chart)) faces.set(chart, []);
      faces.get(chart).push(face);
    });
    faceOfTriangle.forEach((face, t) => {
      for (let i = 3 * t; i < 3 * t + 3; ++i) {
        this.#vertexCharts[triangles[i]] = faceCharts[face];
        this.#pages[triangles[i]] = facePages[face];
      }
    });
    this.#charts = [...faces.keys()]
      .sort((a, b) => a - b)
      .map((chart) => faces.get(chart))
      .map((list) => new Chart(Uint32Array.from(list), facePages[list[0]], materials ? materials[list[0]] : 0));
  }

  get chartCount() {
    return this.#charts.length;
  }

  get indexCount() {
    return this.#result.indices.length;
  }

  get vertexCount() {
    return this.#result.vmapping.length;
  }

  getChart(index) {
    return this.#charts[index];
  }

  getIndexArray(array) {
    return fill(array, this.#result.indices);
  }

  getVertex(index) {
    const { uvs, vmapping } = this.#result;
    return {
      atlasIndex: this.#pages[index],
      chartIndex: this.#vertexCharts[index],
      uv: [uvs[2 * index] * this.#scale[0], uvs[2 * index + 1] * this.#scale[1]],
      xref: vmapping[index],
    };
  }
}

/** Meshes without an area have no atlas: they keep their vertices, all at the origin. */
function unmapped(mesh) {
  const vertices = mesh.positions.length / 3;
  const faces = mesh.faceSizes ? mesh.faceSizes.length : mesh.indices.length / 3;
  return {
    faceCharts: new Uint32Array(faces).fill(NONE),
    facePages: new Uint32Array(faces),
    vmapping: Uint32Array.from({ length: vertices }, (_, i) => i),
    uvs: new Float32Array(2 * vertices),
    indices: mesh.indices,
    triangles: new Uint32Array(0),
    faceOfTriangle: new Uint32Array(0),
  };
}

/**
 * The interface of watlas. Options that speak of the inside of xatlas's algorithms have no counterpart and are without effect:
 * all of the charts' but `useInputMeshUvs` and `fixWinding`, and `maxChartSize` and `rotateChartsToAxis`.
 * Options of Atlas can be given beside them, as `atlas: { mode: 'few-seams' }`.
 */
export class Atlas {
  #inputs = [];
  #areFlat = false;
  #charts = {};
  #meshes = [];
  #summary = { charts: 0, pages: 0, width: 0, height: 0, texelsPerUnit: 0, efficiency: 0 };

  constructor() {
    loaded();
  }

  delete() {
    this.#inputs = [];
    this.#meshes = [];
  }

  addMesh(mesh) {
    this.#add(meshOf(mesh), false);
  }

  addUvMesh(mesh) {
    this.#add(flatMeshOf(mesh), true);
  }

  #add(mesh, isFlat) {
    if (this.#inputs.length && this.#areFlat !== isFlat)
      throw new AtlasError('meshes and uv meshes cannot be in one atlas', -1);
    this.#areFlat = isFlat;
    this.#inputs.push(mesh);
  }

  /** What charts are to be like: they are made together with the pages. */
  computeCharts(options = {}) {
    this.#charts = options;
  }

  packCharts(options = {}) {
    this.generate(this.#charts, options);
  }

  generate(charts = {}, pack = {}) {
    const scene = new Scene();
    try {
      this.#inputs.forEach((mesh) => scene.addMesh(mesh));
      if (this.#inputs.length) this.#run(scene, charts, pack);
    } finally {
      scene.delete();
    }
  }

  #run(scene, charts, pack) {
    const side = pack.resolution || 1024;
    const page = {
      gutter: Math.max((pack.padding ?? 0) + (pack.bilinear === false ? 0 : 1), 1),
      block: pack.blockAlign ? 4 : 1,
      rotation: pack.rotateCharts === false ? 'none' : 'any',
      effort: pack.bruteForce ? 'normal' : 'fast',
      width: side,
      height: side,
      density: pack.resolution ? (pack.texelsPerUnit ?? 0) : 0,
      ...pack.atlas,
    };
    const run = (size) =>
      this.#areFlat
        ? scene.pack({ ...page, ...size })
        : scene.generate({
            keep_uvs: Boolean(charts.useInputMeshUvs) && this.#inputs.some((mesh) => mesh.vertexUvs),
            orient: Boolean(charts.fixWinding),
            ...page,
            ...charts.atlas,
            ...size,
          });
    try {
      run({});
      if (pack.texelsPerUnit && !pack.resolution) {
        const wanted = Math.ceil((side * pack.texelsPerUnit) / scene.summary.texelsPerUnit);
        const width = Math.min(Math.max(wanted, 4), 65536);
        run({ width, height: width });
      }
    } catch (error) {
      if (error.status !== 2) throw error; // 2: nothing has an area
      this.#meshes = this.#inputs.map((mesh) => new Mesh(unmapped(mesh), [0, 0], mesh.faceMaterials));
      return;
    }
    this.#summary = scene.summary;
    const scale = [this.width, this.height];
    this.#meshes = this.#inputs.map((mesh, i) => new Mesh(scene.result(i), scale, mesh.faceMaterials));
  }

  getMesh(index) {
    return this.#meshes[index];
  }

  /** The share of the pages that is covered; pages are not told apart. */
  getUtilization(array) {
    if (array.length < this.atlasCount) return false;
    array.fill(this.#summary.efficiency, 0, this.atlasCount);
    return true;
  }

  get width() {
    return this.#summary.width;
  }

  get height() {
    return this.#summary.height;
  }

  get atlasCount() {
    return this.#summary.pages;
  }

  get chartCount() {
    return this.#summary.charts;
  }

  get meshCount() {
    return this.#meshes.length;
  }

  get texelsPerUnit() {
    return this.#summary.texelsPerUnit;
  }
}
