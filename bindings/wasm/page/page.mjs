// SPDX-License-Identifier: MIT
// The page: takes a model, has a worker make its atlas, shows both and hands out the result.
import { View, boxOf } from './view.mjs';
import { exampleModel } from './example.mjs';

const $ = (id) => document.getElementById(id);
const STAGES = { reading: 'Reading the file', segmentation: 'Cutting into charts', parameterization: 'Flattening charts',
  packing: 'Packing the page', verification: 'Proving the result' };
const model = new View($('model'), { isFlat: false });
const page = new View($('page'), { isFlat: true });
let worker = null;
let file = null; // { name, bytes }
let atlas = null; // what the worker made of it
let shown = null; // triangles of the atlas: { uvs, charts, pages, page }

function wasmBytes() {
  const text = atob($('wasm').textContent.trim());
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return bytes;
}

const wasm = wasmBytes();
const workerUrl = URL.createObjectURL(new Blob([$('worker').textContent], { type: 'text/javascript' }));

/** A worker that has loaded the module. One that works cannot be told to stop: it is ended, and another takes its place. */
function startWorker() {
  worker?.terminate();
  worker = new Worker(workerUrl);
  worker.onmessage = ({ data }) => answers[data.kind](data);
  worker.onerror = (event) => answers.error({ message: event.message });
  worker.postMessage({ kind: 'load', wasm });
}

/** A colour for each chart, unlike those of the charts before. */
function colorOf(chart) {
  const hue = (chart * 0.61803398875 + 0.08) % 1;
  const light = 0.62 + 0.14 * ((chart * 0.7548776662) % 1);
  return [0, 1 / 3, 2 / 3].map((third) => light + 0.24 * Math.cos(2 * Math.PI * (hue - third)));
}

/** What View draws of corners: their places, coordinates, colours and charts. */
function drawn(corners, placeOf, uvOf, colorOfCorner, chartOf) {
  const n = corners.length;
  const mesh = { places: new Float32Array(3 * n), uvs: new Float32Array(2 * n), colors: new Float32Array(3 * n), charts: new Float32Array(n) };
  corners.forEach((corner, i) => {
    mesh.places.set(placeOf(corner, i), 3 * i);
    mesh.uvs.set(uvOf(corner, i), 2 * i);
    mesh.colors.set(colorOfCorner(corner, i), 3 * i);
    mesh.charts[i] = chartOf(corner, i);
  });
  return mesh;
}

const GREY = [0.74, 0.77, 0.82];
const NOTHING = { places: new Float32Array(0), uvs: new Float32Array(0), colors: new Float32Array(0), charts: new Float32Array(0) };

/** The model before it has an atlas: polygons as fans of triangles. */
function showPlain({ positions, corners, firstCorners }) {
  const triangles = [];
  for (let f = 0; f + 1 < firstCorners.length; ++f)
    for (let i = firstCorners[f] + 1; i + 1 < firstCorners[f + 1]; ++i)
      triangles.push(corners[firstCorners[f]], corners[i], corners[i + 1]);
  const vertices = Uint32Array.from(triangles.filter((v) => 3 * v + 2 < positions.length));
  const places = centred(positions);
  const mesh = drawn(vertices, (v) => places.subarray(3 * v, 3 * v + 3), () => [0, 0], () => GREY, () => 0);
  model.squares = 0;
  model.show(mesh, NOTHING, boxOf(places));
  page.show(NOTHING, frame(), { middle: [0.5, 0.5, 0], radius: 1 });
}

/** Places around the origin, where floats are finest. */
function centred(positions) {
  const { middle } = boxOf(positions);
  return Float32Array.from(positions, (x, i) => x - middle[i % 3]);
}

/** The border of the page, as lines. */
function frame() {
  const corners = [0, 1, 1, 2, 2, 3, 3, 0];
  const at = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]];
  return drawn(corners, (i) => at[i], () => [0, 0], () => [0.55, 0.58, 0.64], () => -1);
}

/** The edges of triangles that no other triangle has the other way round: the borders of charts. */
function bordersOf(triangles, vertices) {
  const edges = new Set();
  const key = (a, b) => a * vertices + b;
  for (let i = 0; i < triangles.length; ++i) edges.add(key(triangles[i], triangles[i % 3 === 2 ? i - 2 : i + 1]));
  const borders = [];
  for (const edge of edges) {
    const a = Math.floor(edge / vertices);
    const b = edge % vertices;
    if (!edges.has(key(b, a))) borders.push(a, b);
  }
  return Uint32Array.from(borders);
}

function showAtlas() {
  const { result, places, borders } = atlas;
  const { vmapping, uvs, triangles, faceOfTriangle, faceCharts, facePages } = result;
  const chartOfVertex = new Uint32Array(vmapping.length);
  const pageOfVertex = new Uint32Array(vmapping.length);
  triangles.forEach((v, i) => {
    chartOfVertex[v] = faceCharts[faceOfTriangle[Math.floor(i / 3)]];
    pageOfVertex[v] = facePages[faceOfTriangle[Math.floor(i / 3)]];
  });
  const number = Number($('page_number').value) || 0;
  const isHere = (list, corners) => {
    const chosen = [];
    for (let i = 0; i < list.length; i += corners)
      if (pageOfVertex[list[i]] === number) for (let k = 0; k < corners; ++k) chosen.push(list[i + k]);
    return Uint32Array.from(chosen);
  };
  const uvOf = (v) => [uvs[2 * v], uvs[2 * v + 1]];
  const flat = (v) => [uvs[2 * v], uvs[2 * v + 1], 0];
  const inSpace = (v) => places.subarray(3 * vmapping[v], 3 * vmapping[v] + 3);
  const chartOf = (v) => chartOfVertex[v];
  const color = (v) => colorOf(chartOfVertex[v]);
  const dark = () => [0.13, 0.15, 0.2];
  const here = isHere(triangles, 3);
  shown = { corners: here, uvs, chartOfVertex };
  model.squares = page.squares = $('look').value === 'checker' ? 64 : 0;
  model.show(drawn(triangles, inSpace, uvOf, color, chartOf), drawn(borders, inSpace, uvOf, dark, chartOf), boxOf(places));
  const lines = drawn(isHere(borders, 2), flat, uvOf, dark, chartOf);
  const border = frame();
  page.show(drawn(here, flat, uvOf, color, chartOf), {
    places: joined(lines.places, border.places), uvs: joined(lines.uvs, border.uvs),
    colors: joined(lines.colors, border.colors), charts: joined(lines.charts, border.charts),
  }, { middle: [0.5, 0.5, 0], radius: 1 });
}

function joined(a, b) {
  const all = new Float32Array(a.length + b.length);
  all.set(a);
  all.set(b, a.length);
  return all;
}

/** The chart at a place of the page; -1: none. */
function chartAt([u, v]) {
  if (!shown) return -1;
  const { corners, uvs, chartOfVertex } = shown;
  const side = (a, b) => (uvs[2 * b] - uvs[2 * a]) * (v - uvs[2 * a + 1]) - (uvs[2 * b + 1] - uvs[2 * a + 1]) * (u - uvs[2 * a]);
  for (let i = 0; i < corners.length; i += 3) {
    const [a, b, c] = [corners[i], corners[i + 1], corners[i + 2]];
    if (side(a, b) >= 0 && side(b, c) >= 0 && side(c, a) >= 0) return chartOfVertex[a];
  }
  return -1;
}

function mark(chart) {
  if (chart === page.marked) return;
  page.marked = model.marked = chart;
  page.draw();
  model.draw();
}

function figures() {
  const { report, summary, seconds } = atlas;
  const c = report.certificate;
  const verdict = $('verdict');
  verdict.className = c.is_valid ? 'good' : 'bad';
  verdict.textContent = c.is_valid
    ? '✓ Proved: no triangle is flipped, none overlaps another'
    : `✗ Not valid: ${c.message}`;
  const rows = [
    ['Charts', summary.charts],
    ['Pages', summary.pages],
    ['Page covered', `${(100 * summary.efficiency).toFixed(1)} %`],
    ['Stretch', report.distortion.l2_stretch.toFixed(3), '1 is none'],
    ['Triangles', c.triangles.toLocaleString('en')],
    ['Faces left out', c.rejected_faces, 'they have no area, or name no vertices'],
    ['Distance of charts', `${c.chart_distance_texels.toFixed(2)} texels`],
    ['Time', `${seconds.toFixed(1)} s`],
  ];
  $('figures').replaceChildren(...rows.filter((row) => row[0] !== 'Faces left out' || row[1] > 0).map(([name, value, title]) => {
    const row = document.createElement('div');
    row.title = title ?? '';
    row.append(Object.assign(document.createElement('dt'), { textContent: name }),
      Object.assign(document.createElement('dd'), { textContent: value }));
    return row;
  }));
}

function setState(state) {
  document.body.dataset.state = state;
  const isBusy = state === 'busy';
  $('run').textContent = isBusy ? 'Stop' : 'Make the atlas again';
}

const answers = {
  ready() {
    document.body.dataset.ready = 'yes';
  },
  progress({ stage, fraction }) {
    $('stage').textContent = STAGES[stage] ?? stage;
    const number = Math.max(0, Object.keys(STAGES).indexOf(stage));
    $('bar').value = (number + fraction) / Object.keys(STAGES).length;
  },
  model({ model: plain }) {
    atlas = { plain };
    showPlain(plain);
  },
  atlas({ result, report, summary, seconds }) {
    const places = centred(atlas.plain.positions);
    atlas = { ...atlas, result, report, summary, seconds, places, borders: bordersOf(result.triangles, result.vmapping.length) };
    const pages = Array.from({ length: summary.pages }, (_, i) => new Option(`Page ${i + 1} of ${summary.pages}`, i));
    $('page_number').replaceChildren(...pages);
    $('page_number').hidden = summary.pages < 2;
    figures();
    showAtlas();
    setState('done');
  },
  file({ format, bytes }) {
    save(`${stem()}_atlas.${format}`, bytes, 'application/octet-stream');
  },
  error({ message }) {
    $('error').textContent = message;
    setState('failed');
  },
};

function stem() {
  return file.name.replace(/\.[^.]*$/, '');
}

function save(name, content, type) {
  const link = Object.assign(document.createElement('a'), { download: name, href: URL.createObjectURL(new Blob([content], { type })) });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/** What the form asks for; empty fields ask for nothing. */
function options() {
  const wishes = { mode: $('mode').value, width: Number($('size').value), height: Number($('size').value) };
  for (const [id, name] of [['stretch', 'max_stretch'], ['charts', 'max_charts'], ['gutter', 'gutter'], ['pages', 'pages']])
    if ($(id).value !== '') wishes[name] = Number($(id).value);
  return wishes;
}

function run() {
  if (!file) return;
  if (!$('options').reportValidity()) return;
  setState('busy');
  $('error').textContent = '';
  $('file_name').textContent = file.name;
  shown = null;
  answers.progress({ stage: 'reading', fraction: 0 });
  worker.postMessage({ kind: 'run', ...file, options: options() });
}

function stop() {
  startWorker();
  setState(atlas?.result ? 'done' : 'failed');
  $('error').textContent = 'Stopped.';
}

async function take(given) {
  if (!given) return;
  if (document.body.dataset.state === 'busy') startWorker();
  file = { name: given.name, bytes: new Uint8Array(await given.arrayBuffer()) };
  atlas = null;
  for (const view of [model, page]) {
    view.reset();
    view.show(NOTHING, NOTHING, { middle: [0, 0, 0], radius: 1 });
  }
  run();
}

$('choose').onchange = ({ target }) => take(target.files[0]).finally(() => { target.value = ''; });
document.querySelectorAll('.choose').forEach((button) => { button.onclick = () => $('choose').click(); });
document.querySelectorAll('.example').forEach((button) => { button.onclick = () => take(exampleModel()); });
$('run').onclick = () => (document.body.dataset.state === 'busy' ? stop() : run());
$('options').onsubmit = (event) => { event.preventDefault(); run(); };
$('look').onchange = () => atlas?.result && showAtlas();
$('page_number').onchange = showAtlas;
$('page').addEventListener('pointermove', (event) => { if (!event.buttons) mark(chartAt(page.pageAt(event))); });
$('page').addEventListener('pointerleave', () => mark(-1));
document.querySelectorAll('[data-format]').forEach((button) => {
  button.onclick = () => worker.postMessage({ kind: 'write', format: button.dataset.format });
});
$('picture').onclick = () => $('page').toBlob((blob) => save(`${stem()}_page.png`, blob, 'image/png'));
$('report').onclick = () => save(`${stem()}_report.json`, JSON.stringify(atlas.report, null, 2), 'application/json');
addEventListener('dragover', (event) => { event.preventDefault(); document.body.classList.add('dragging'); });
addEventListener('dragleave', (event) => { if (!event.relatedTarget) document.body.classList.remove('dragging'); });
addEventListener('drop', (event) => {
  event.preventDefault();
  document.body.classList.remove('dragging');
  take(event.dataTransfer.files[0]);
});
startWorker();
