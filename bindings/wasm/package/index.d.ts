// SPDX-License-Identifier: MIT

/** Loads the module, once. `bytes`: the module, where it is not beside the package's index.js. */
export function Initialize(bytes?: ArrayBuffer | Uint8Array): Promise<void>;

/** "major.minor.patch"; after Initialize(). */
export function version(): string;

/** The chart of a face that was left out. */
export const NONE: 0xffffffff;

/** What the library says no to. `status` is one of the numbers of atlas.h. */
export class AtlasError extends Error {
  status: number;
}

/** The options of atlas.h by their names; what is left out is as there. */
export interface Options {
  mode?: 'standard' | 'few-seams' | 'conformal' | 'paper';
  measure?:
    | 'of-mode'
    | 'symmetric-dirichlet'
    | 'l2-stretch'
    | 'linf-stretch'
    | 'area-ratio'
    | 'area-ratio-quantiles'
    | 'quasi-conformal';
  max_distortion?: number;
  max_stretch?: number;
  max_stretch_share?: number;
  max_charts?: number;
  min_chart_texels?: number;
  min_texels_per_chart?: number;
  min_coverage?: number;
  seam_exchange_rate?: number;
  hard_angle?: number;
  symmetry?: 'off' | 'auto' | 'x' | 'y' | 'z';
  hide_seams?: 'none' | 'openness' | 'dome' | 'view';
  hide_axis?: [number, number, number];
  only_given_seams?: boolean;
  weld?: number;
  segmentation?: 'features' | 'normals' | 'paper' | 'region-growing' | 'seams' | 'variational';
  parameterizer?:
    | 'abf'
    | 'arap'
    | 'bijective'
    | 'bijective-conformal'
    | 'floater'
    | 'harmonic'
    | 'lscm'
    | 'mean-value'
    | 'schnyder'
    | 'spectral'
    | 'tutte';
  solver?: 'cg' | 'direct' | 'multigrid' | 'out-of-core' | 'pcg';
  pins?: 'diameter' | 'sweep';
  optimizer?: 'conformal-stretch' | 'mips' | 'none' | 'stretch' | 'stretch-fixed-border' | 'symmetric-dirichlet';
  packer?: 'horizon' | 'raster' | 'rectangles' | 'rows';
  straighten?: boolean;
  separate_materials?: boolean;
  keep_uvs?: boolean;
  defragment?: boolean;
  orient?: boolean;
  width?: number;
  height?: number;
  gutter?: number;
  mip_levels?: number;
  block?: number;
  pages?: number;
  density?: number;
  rotation?: 'aligned' | 'free' | 'any' | 'quarter' | 'none';
  up?: [number, number, number];
  snap?: boolean;
  free_aspect?: boolean;
  stack?: 'none' | 'copies' | 'mirrored';
  effort?: 'fast' | 'normal' | 'best';
  rules?: { material: number; weight?: number; is_grouped?: boolean; is_locked?: boolean }[];
  time_limit?: number;
}

export interface SceneMesh {
  /** Three numbers per vertex. */
  positions: Float32Array | Float64Array | number[];
  /** Numbers from one vertex to the next; 3 if left out. */
  stride?: number;
  indices?: Uint32Array | Uint16Array | number[];
  /** Corners per face; triangles if left out. */
  faceSizes?: Uint32Array | number[];
  vertexUvs?: Float32Array | number[];
  cornerUvs?: Float32Array | number[];
  facePages?: Uint32Array | number[];
  faceMaterials?: Uint32Array | number[];
  /** Edges, two vertices each. */
  seams?: Uint32Array | number[];
  forbiddenSeams?: Uint32Array | number[];
  /** Per vertex, in [0, 1]: seams run where it is small. */
  visibility?: Float64Array | number[];
  /** Per face: whether it is unwrapped anew. All others keep their coordinates. */
  selected?: Uint8Array | boolean[];
  /** Per corner: whether it keeps its coordinates, in the unit square of the first page. Charts follow. */
  pinned?: Uint8Array | boolean[];
}

export interface Result {
  cornerUvs: Float32Array;
  faceCharts: Uint32Array;
  facePages: Uint32Array;
  vmapping: Uint32Array;
  uvs: Float32Array;
  indices: Uint32Array;
  triangles: Uint32Array;
  faceOfTriangle: Uint32Array;
}

export interface Summary {
  charts: number;
  pages: number;
  width: number;
  height: number;
  texelsPerUnit: number;
  efficiency: number;
}

/** Returns false to cancel. */
export type Progress = (stage: string, fraction: number) => boolean | void;

export class Scene {
  delete(): void;
  get meshCount(): number;
  addMesh(mesh: SceneMesh): number;
  addFile(name: string, bytes: Uint8Array): number;
  generate(options?: Options, progress?: Progress | null): boolean;
  pack(options?: Options, progress?: Progress | null): boolean;
  verify(options?: Options): boolean;
  get report(): any;
  get summary(): Summary;
  result(mesh: number): Result;
  model(mesh: number): { positions: Float64Array; corners: Uint32Array; firstCorners: Uint32Array };
  write(mesh: number, format: 'obj' | 'ply' | 'glb'): Uint8Array;
}

// The interface of watlas.

export enum ChartType {
  Planar = 0,
  Ortho = 1,
  LSCM = 2,
  Piecewise = 3,
  Invalid = 4,
}

export interface MeshDecl {
  vertexPositionData: Float32Array;
  vertexCount: number;
  /** Bytes. */
  vertexPositionStride: number;
  vertexNormalData?: Float32Array;
  vertexNormalStride?: number;
  vertexUvData?: Float32Array;
  vertexUvStride?: number;
  indexData?: Uint32Array | Uint16Array;
  indexCount?: number;
  indexOffset?: number;
  faceCount?: number;
  faceVertexCount?: Uint32Array;
  faceMaterialData?: Uint32Array;
  epsilon?: number;
}

export interface UvMeshDecl {
  vertexUvData: Float32Array;
  vertexCount: number;
  vertexStride: number;
  indexData?: Uint32Array | Uint16Array;
  indexCount?: number;
  indexOffset?: number;
  faceMaterialData?: Uint32Array;
}

export interface ChartOptions {
  useInputMeshUvs?: boolean;
  fixWinding?: boolean;
  /** Options of Atlas beside those of watlas. */
  atlas?: Options;
  [withoutEffect: string]: unknown;
}

export interface PackOptions {
  padding?: number;
  texelsPerUnit?: number;
  resolution?: number;
  bilinear?: boolean;
  blockAlign?: boolean;
  bruteForce?: boolean;
  rotateCharts?: boolean;
  atlas?: Options;
  [withoutEffect: string]: unknown;
}

export interface Chart {
  readonly faceCount: number;
  readonly atlasIndex: number;
  readonly type: ChartType;
  readonly material: number;
  getFaceArray(array: Uint32Array): boolean;
}

export interface Vertex {
  atlasIndex: number;
  chartIndex: number;
  /** Texels. */
  uv: [number, number];
  xref: number;
}

export interface Mesh {
  readonly chartCount: number;
  readonly indexCount: number;
  readonly vertexCount: number;
  getChart(index: number): Chart;
  getIndexArray(array: Uint32Array): boolean;
  getVertex(index: number): Vertex;
}

export class Atlas {
  delete(): void;
  addMesh(mesh: MeshDecl): void;
  addUvMesh(mesh: UvMeshDecl): void;
  computeCharts(options?: ChartOptions): void;
  packCharts(options?: PackOptions): void;
  generate(chartOptions?: ChartOptions, packOptions?: PackOptions): void;
  getMesh(index: number): Mesh;
  getUtilization(array: Float32Array): boolean;
  get width(): number;
  get height(): number;
  get atlasCount(): number;
  get chartCount(): number;
  get meshCount(): number;
  get texelsPerUnit(): number;
}
