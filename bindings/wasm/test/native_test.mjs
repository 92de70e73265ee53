// SPDX-License-Identifier: MIT
// The package against the program: node native_test.mjs TEXTURE_ATLAS ARCHIVE_OF_MESHES [MESH...], with the folder of the package in
// ATLAS_PACKAGE. Meshes that are named are compared instead. Of the program's atlas the package has to give the very certificate that
// the program gives. Its own atlas has the same charts; they lie elsewhere, as not all is rounded alike.
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { exampleModel } from '../page/example.mjs';

const [program, archive, ...named] = process.argv.slice(2);
const { Initialize, Scene } = await import(pathToFileURL(`${process.env.ATLAS_PACKAGE}/index.js`));
await Initialize();
const folder = mkdtempSync(join(tmpdir(), 'atlas-'));

/** What the program makes of a mesh: its report, and the model that it writes. */
function natively(mesh, words) {
  const model = join(folder, 'native.obj');
  const report = join(folder, 'native.json');
  const start = performance.now();
  execFileSync(program, [mesh, '-o', model, '--report', report, '--threads', '1', ...words], { stdio: ['ignore', 'ignore', 'inherit'] });
  const seconds = (performance.now() - start) / 1000;
  return { model, report: JSON.parse(readFileSync(report, 'utf8')), seconds };
}

/** What the package makes of it, or says of it. */
function here(mesh, work) {
  const scene = new Scene();
  try {
    const start = performance.now();
    scene.addFile(basename(mesh), readFileSync(mesh));
    work(scene);
    const written = work.isMade ? scene.write(0, 'obj') : null;
    return { report: scene.report, written, seconds: (performance.now() - start) / 1000 };
  } finally {
    scene.delete();
  }
}

/**
 * Whether two certificates are equal. A run states its own for the model moved to the origin and scaled, so numbers in the model's unit are
 * rounded otherwise. All else is equal to the last bit: counts, lists, and distances on the page.
 */
function assertSame(certificate, native, name) {
  const same = { ...certificate };
  for (const key of ['seam_length', 'texels_per_unit_min', 'texels_per_unit_max']) {
    const ratio = certificate[key] / native[key];
    assert.ok(Math.abs(ratio - 1) < 1e-12, `${key} of ${name}: ${ratio}`);
    same[key] = native[key];
  }
  assert.deepEqual(same, native, `certificate of ${name}`);
}

/** The certificate of a native atlas, made here: it is the same. */
function certify(mesh, words) {
  const name = [basename(mesh), ...words].join(' ');
  const native = natively(mesh, words);
  const { page_width: width, page_height: height, gutter_texels: gutter } = native.report;
  const { report } = here(native.model, (scene) => scene.verify({ width, height, gutter }));
  assertSame(report, native.report.certificate, name);
  assert.ok(report.is_valid, name);
  return { name, native, report };
}

/** Packings differ, as sines do: so charts are the same only where none is cut for its page. */
function compare(mesh, words, options) {
  const { name, native, report } = certify(mesh, words);
  const make = (scene) => scene.generate(options);
  make.isMade = true;
  const own = here(mesh, make);
  for (const key of ['is_valid', 'faces', 'triangles', 'rejected_faces', 'flipped', 'degenerate', 'is_overlap_free', 'charts', 'seam_length'])
    assert.equal(own.report.certificate[key], native.report.certificate[key], `${key} of ${name}`);
  for (const key of ['packing_efficiency', 'texels_per_unit'])
    assert.ok(Math.abs(own.report[key] / native.report[key] - 1) < 0.08, `${key} of ${name}: ${own.report[key]}, ${native.report[key]}`);
  const stretches = [own, native].map((made) => made.report.distortion.l2_stretch);
  assert.ok(Math.abs(stretches[0] / stretches[1] - 1) < 1e-3, `stretch of ${name}: ${stretches}`);
  console.log(`${name}: the same certificate, ${report.charts} charts; native ${native.seconds.toFixed(2)} s, here ${own.seconds.toFixed(2)} s`);
}

try {
  if (named.length) named.forEach((mesh) => compare(mesh, ['--seam-exchange-rate', '0'], { seam_exchange_rate: 0 }));
  else {
    const knot = join(folder, 'knot.off');
    writeFileSync(knot, new Uint8Array(await exampleModel(60, 16).arrayBuffer()));
    const elephant = join(folder, 'elephant.off');
    writeFileSync(elephant, execFileSync('tar', ['-xzOf', archive, 'data/meshes/elephant.off'], { maxBuffer: 1 << 26 }));
    certify(knot, []);
    compare(knot, ['--seam-exchange-rate', '0'], { seam_exchange_rate: 0 });
    compare(knot, ['--mode', 'conformal', '--texture-size', '512x256'], { mode: 'conformal', width: 512, height: 256 });
    compare(elephant, ['--mode', 'few-seams', '--gutter', '4'], { mode: 'few-seams', gutter: 4 });
    compare(elephant, ['--max-stretch', '1.5', '--seam-exchange-rate', '0'], { max_stretch: 1.5, seam_exchange_rate: 0 });
  }
} finally {
  rmSync(folder, { recursive: true });
}
