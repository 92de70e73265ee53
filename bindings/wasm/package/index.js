// SPDX-License-Identifier: MIT
// Atlas in JavaScript: the class Scene has all options. watlas.js has the interface of another package, on it.
import createModule from './atlas_module.js';

let module = null;
let loading = null;

const STATUS_NOT_VALID = 1;
export const NONE = 0xffffffff;

/** What the library says no to. `status` is one of the numbers of atlas.h. */
export class AtlasError extends Error {
  constructor(message, status) {
    super(message);
    this.name = 'AtlasError';
    this.status = status;
  }
}

async function bytesOfModule() {
  const url = new URL('./atlas_module.wasm', import.meta.url);
  if (url.protocol === 'file:' && typeof process !== 'undefined' && process.versions?.node) {
    const { readFile } = await import('node:fs/promises');
    return readFile(url);
  }
  const response = await fetch(url);
  if (!response.ok) throw new AtlasError(`${url}: ${response.status} ${response.statusText}`, -3);
  return response.arrayBuffer();
}

/** Loads the module, once. \param bytes the module, where it is not beside this file */
export function Initialize(bytes) {
  loading ??= (async () => {
    module = await createModule({ wasmBinary: bytes ?? (await bytesOfModule()) });
  })();
  return loading;
}

export function loaded() {
  if (!module) throw new AtlasError('the module is not loaded yet: await Initialize() first', -1);
  return module;
}

/** "major.minor.patch" */
export function version() {
  return loaded().UTF8ToString(loaded()._wasm_version());
}

/** Memory of the module that lives as long as a call. */
class Arena {
  constructor() {
    this.addresses = [];
  }

  /** Room for so many bytes. Memory may grow here: views of it are made after. */
  room(bytes) {
    const address = loaded()._malloc(Math.max(bytes, 8));
    if (!address) throw new AtlasError('not enough memory', -2);
    this.addresses.push(address);
    return address;
  }

  copy(array) {
    if (!array) return 0;
    const address = this.room(array.byteLength);
    module.HEAPU8.set(new Uint8Array(array.buffer, array.byteOffset, array.byteLength), address);
    return address;
  }

  text(text) {
    const bytes = module.lengthBytesUTF8(text) + 1;
    const address = this.room(bytes);
    module.stringToUTF8(text, address, bytes);
    return address;
  }

  free() {
    this.addresses.forEach((address) => module._free(address));
  }
}

function withArena(body) {
  const arena = new Arena();
  try {
    return body(arena);
  } finally {
    arena.free();
  }
}

function unsigned(array, name) {
  if (array === undefined || array === null || array instanceof Uint32Array) return array;
  for (const value of array)
    if (!(Number.isInteger(value) && value >= 0 && value <= NONE))
      throw new AtlasError(`${name} must be whole numbers of 32 bits, but has ${value}`, -1);
  return Uint32Array.from(array);
}

export function floats(array) {
  return array === undefined || array === null || array instanceof Float32Array ? array : Float32Array.from(array);
}

function flags(array) {
  return array && Uint8Array.from(array, (is) => (is ? 1 : 0));
}

function requireLength(array, length, name) {
  if (array && array.length !== length)
    throw new AtlasError(`${name} must have ${length} entries, but has ${array.length}`, -1);
}

/** Meshes that share one atlas. Ends with delete(). */
export class Scene {
  #address;
  #meshes = 0;

  constructor() {
    this.#address = loaded()._wasm_create();
  }

  delete() {
    if (this.#address) module._wasm_destroy(this.#address);
    this.#address = 0;
  }

  get meshCount() {
    return this.#meshes;
  }

  #handle() {
    if (!this.#address) throw new AtlasError('the scene has been deleted', -1);
    return this.#address;
  }

  /** Throws unless the call went well. A certificate that names faults is an answer, not an error. */
  #check(status) {
    if (status !== 0 && status !== STATUS_NOT_VALID)
      throw new AtlasError(module.UTF8ToString(module._wasm_error(this.#handle())), status);
    return status;
  }

  /**
   * Adds a mesh and returns its number.
   * mesh: { positions, indices, faceSizes, stride, vertexUvs, cornerUvs, facePages, faceMaterials, seams, forbiddenSeams,
   * visibility, selected, pinned };
   * all but positions may be left out. Without indices every three vertices are a triangle, without faceSizes all faces are.
   */
  addMesh(mesh) {
    const isDouble = mesh.positions instanceof Float64Array;
    const positions = isDouble ? mesh.positions : floats(mesh.positions);
    if (!positions) throw new AtlasError('positions are missing', -1);
    const step = mesh.stride ?? 3;
    if (!(Number.isInteger(step) && step >= 3)) throw new AtlasError(`stride must be at least 3, but is ${step}`, -1);
    const vertices = Math.floor((positions.length + step - 3) / step);
    const indices = unsigned(mesh.indices, 'indices') ?? Uint32Array.from({ length: vertices }, (_, i) => i);
    const sizes = unsigned(mesh.faceSizes, 'faceSizes');
    const corners = sizes ? sizes.reduce((sum, n) => sum + n, 0) : indices.length;
    requireLength(indices, sizes ? corners : indices.length - (indices.length % 3), 'indices');
    const faces = sizes ? sizes.length : indices.length / 3;
    const vertexUvs = floats(mesh.vertexUvs);
    const cornerUvs = floats(mesh.cornerUvs);
    const pages = unsigned(mesh.facePages, 'facePages');
    const materials = unsigned(mesh.faceMaterials, 'faceMaterials');
    const seams = unsigned(mesh.seams, 'seams');
    const forbidden = unsigned(mesh.forbiddenSeams, 'forbiddenSeams');
    const visibility = mesh.visibility && Float64Array.from(mesh.visibility);
    const selected = flags(mesh.selected);
    const pinned = flags(mesh.pinned);
    requireLength(visibility, vertices, 'visibility');
    requireLength(selected, faces, 'selected');
    requireLength(pinned, corners, 'pinned');
    requireLength(vertexUvs, 2 * vertices, 'vertexUvs');
    requireLength(cornerUvs, 2 * corners, 'cornerUvs');
    requireLength(pages, faces, 'facePages');
    requireLength(materials, faces, 'faceMaterials');
    withArena((arena) => {
      const arrays =
        [positions, indices, sizes, vertexUvs, cornerUvs, pages, materials, seams, forbidden, visibility, selected, pinned];
      const addresses = arena.copy(Uint32Array.from(arrays, (array) => arena.copy(array)));
      const numbers = arena.copy(
        Uint32Array.of(isDouble ? 1 : 0, step * positions.BYTES_PER_ELEMENT, vertices, faces,
          Math.floor((seams?.length ?? 0) / 2), Math.floor((forbidden?.length ?? 0) / 2)));
      this.#check(module._wasm_add_mesh(this.#handle(), addresses, numbers));
    });
    return this.#meshes++;
  }

  /** Adds the model of a file: obj, ply, stl, off, glb, as the extension of its name says. Returns its number. */
  addFile(name, bytes) {
    const path = `/model_${this.#meshes}.${name.split('.').pop().toLowerCase()}`;
    module.FS.writeFile(path, bytes);
    withArena((arena) => this.#checkFile(name, path, module._wasm_read(this.#handle(), arena.text(path))));
    return this.#meshes++;
  }

  /** Messages name the file as the user does. */
  #checkFile(name, path, status) {
    if (status !== 0)
      throw new AtlasError(module.UTF8ToString(module._wasm_error(this.#handle())).replaceAll(path, name), status);
  }

  #run(call, options, progress) {
    module.atlasProgress = progress
      ? (stage, fraction) => (progress(module.UTF8ToString(module._wasm_stage_name(stage)), fraction) === false ? 0 : 1)
      : null;
    try {
      return withArena((arena) => this.#check(call(this.#handle(), arena.text(JSON.stringify(options)))) === 0);
    } finally {
      module.atlasProgress = null;
    }
  }

  /** Makes the atlas. Options are those of atlas.h. Returns whether the certificate has no fault. */
  generate(options = {}, progress = null) {
    return this.#run(module._wasm_generate, options, progress);
  }

  /** Packs the coordinates that the meshes came with. */
  pack(options = {}, progress = null) {
    return this.#run(module._wasm_pack, options, progress);
  }

  /** Examines the coordinates that the meshes came with. */
  verify(options = { gutter: 0 }) {
    return this.#run(module._wasm_verify, options, null);
  }

  /** The report on the last of these three. */
  get report() {
    return JSON.parse(module.UTF8ToString(module._wasm_report(this.#handle())));
  }

  get summary() {
    return withArena((arena) => {
      const address = arena.room(6 * 8);
      this.#check(module._wasm_summary(this.#handle(), address));
      const [charts, pages, width, height, texelsPerUnit, efficiency] = new Float64Array(module.HEAPU8.buffer, address, 6);
      return { charts, pages, width, height, texelsPerUnit, efficiency };
    });
  }

  /** The atlas of a mesh, as arrays of your own. */
  result(mesh) {
    const n = this.#numbers(12, (address) => module._wasm_result(this.#handle(), mesh, address));
    const { buffer } = module.HEAPU8;
    const indices = (address, length) => new Uint32Array(buffer, address, length).slice();
    const numbers = (address, length) => new Float32Array(buffer, address, length).slice();
    return {
      cornerUvs: numbers(n[4], 2 * n[1]),
      faceCharts: indices(n[5], n[0]),
      facePages: indices(n[6], n[0]),
      vmapping: indices(n[7], n[2]),
      uvs: numbers(n[8], 2 * n[2]),
      indices: indices(n[9], n[1]),
      triangles: indices(n[10], 3 * n[3]),
      faceOfTriangle: indices(n[11], n[3]),
    };
  }

  #numbers(length, call) {
    return withArena((arena) => {
      const address = arena.room(4 * length);
      this.#check(call(address));
      return new Uint32Array(module.HEAPU8.buffer, address, length).slice();
    });
  }

  /** A model that addFile() has read: three doubles per vertex, the vertices of all corners, where the corners of faces start. */
  model(mesh) {
    const n = this.#numbers(6, (address) => module._wasm_model(this.#handle(), mesh, address));
    const { buffer } = module.HEAPU8;
    return {
      positions: new Float64Array(buffer.slice(n[3], n[3] + 24 * n[0])),
      corners: new Uint32Array(buffer, n[4], n[1]).slice(),
      firstCorners: new Uint32Array(buffer, n[5], n[2] + 1).slice(),
    };
  }

  /** A model that addFile() has read, as the bytes of a file with the coordinates of the atlas: obj, ply or glb. */
  write(mesh, format) {
    return withArena((arena) => {
      const name = arena.text(format);
      const n = this.#numbers(2, (address) => module._wasm_write(this.#handle(), mesh, name, address));
      return module.HEAPU8.slice(n[1], n[1] + n[0]);
    });
  }
}

export { Atlas, ChartType } from './watlas.js';
