// SPDX-License-Identifier: MIT
// The page in Chromium, from a file and without a network: node page_test.mjs CHROMIUM [MODEL [PICTURE_FOLDER]], with the package in
// ATLAS_PACKAGE and npm's playwright-core in ATLAS_NODE_MODULES.
import assert from 'node:assert/strict';
import { mkdirSync, mkdtempSync, readFileSync, rmSync } from 'node:fs';
import { createRequire } from 'node:module';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { pathToFileURL } from 'node:url';

const [chromium, model, pictures] = process.argv.slice(2);
const require = createRequire(`${process.env.ATLAS_NODE_MODULES}/`);
const { chromium: driver } = require('playwright-core');
const { Initialize, Scene } = await import(pathToFileURL(`${process.env.ATLAS_PACKAGE}/index.js`));
await Initialize();
const folder = mkdtempSync(join(tmpdir(), 'atlas-'));
if (pictures) mkdirSync(pictures, { recursive: true });

const browser = await driver.launchPersistentContext(join(folder, 'profile'), {
  executablePath: chromium, viewport: { width: 1440, height: 860 }, acceptDownloads: true, offline: true,
  args: ['--no-sandbox', '--disable-quic', '--no-first-run', '--disable-background-networking', '--disable-component-update',
    '--disable-sync', '--use-gl=angle', '--use-angle=swiftshader', '--enable-unsafe-swiftshader'],
});

/** Colours of a canvas other than its background, as a share of its pixels, and how many there are. */
const drawn = (page, id) =>
  page.evaluate((name) => {
    const canvas = document.getElementById(name);
    const copy = Object.assign(document.createElement('canvas'), { width: canvas.width, height: canvas.height });
    const context = copy.getContext('2d');
    context.drawImage(canvas, 0, 0);
    const { data } = context.getImageData(0, 0, copy.width, copy.height);
    const colors = new Map();
    for (let i = 0; i < data.length; i += 4) {
      const key = (data[i] << 16) | (data[i + 1] << 8) | data[i + 2];
      colors.set(key, (colors.get(key) ?? 0) + 1);
    }
    const background = Math.max(...colors.values());
    return { share: 1 - background / (data.length / 4), colors: colors.size };
  }, id);

const state = (page, name, timeout = 240000) => page.waitForSelector(`body[data-state="${name}"]`, { timeout });

async function picture(page, name) {
  if (pictures) await page.screenshot({ path: join(pictures, `${name}.png`) });
}

async function download(page, button) {
  const [file] = await Promise.all([page.waitForEvent('download'), page.click(button)]);
  const path = join(folder, file.suggestedFilename());
  await file.saveAs(path);
  return path;
}

/** What is downloaded is proved by the package, not by the page. */
function verdictOf(path) {
  const scene = new Scene();
  try {
    scene.addFile(path.split('/').pop(), readFileSync(path));
    return { isValid: scene.verify(), triangles: scene.report.triangles };
  } finally {
    scene.delete();
  }
}

async function tryExample(page) {
  await page.waitForSelector('#start button.example');
  await picture(page, 'start');
  await page.click('#start button.example');
  await state(page, 'done');
  assert.match(await page.textContent('#verdict'), /^✓/);
  assert.match(await page.textContent('#figures'), /Charts\d+.*Triangles10,080/);
  for (const id of ['model', 'page']) {
    const { share, colors } = await drawn(page, id);
    assert.ok(share > 0.15, `${id} is drawn: ${share}`);
    assert.ok(colors > 5, `${id} has colours: ${colors}`);
  }
  await picture(page, 'example');
}

async function tryDownloads(page) {
  for (const format of ['glb', 'obj', 'ply']) {
    const path = await download(page, `[data-format="${format}"]`);
    assert.ok(path.endsWith(`knot_atlas.${format}`));
    assert.deepEqual(verdictOf(path), { isValid: true, triangles: 10080 }, format);
  }
  const report = JSON.parse(readFileSync(await download(page, '#report'), 'utf8'));
  assert.equal(report.certificate.is_valid, true);
  assert.equal(readFileSync(await download(page, '#picture')).subarray(1, 4).toString(), 'PNG');
}

/** Other wishes make another atlas; the certificate says that they were kept. */
async function tryOptions(page) {
  const charts = async () => Number((await page.textContent('#figures')).match(/Charts(\d+)/)[1]);
  const before = await charts();
  await page.fill('#stretch', '1.2');
  await page.fill('#gutter', '6');
  await page.selectOption('#size', '512');
  await page.click('#run');
  await state(page, 'busy');
  await state(page, 'done');
  assert.ok((await charts()) > before, 'a tighter bound makes more charts');
  const report = JSON.parse(readFileSync(await download(page, '#report'), 'utf8'));
  assert.equal(report.page_width, 512);
  assert.ok(report.certificate.chart_distance_texels >= 6);
  await page.selectOption('#look', 'checker');
  await page.hover('#page', { position: { x: 200, y: 300 } });
  await picture(page, 'checkerboard');
  await page.fill('#stretch', '0.5'); // is no stretch
  await page.click('#run');
  assert.equal(await page.getAttribute('body', 'data-state'), 'done');
  for (const [field, value] of [['#stretch', ''], ['#gutter', '']]) await page.fill(field, value);
}

/** Files that are none, and work that is stopped. */
async function tryFaults(page) {
  await page.setInputFiles('#choose', { name: 'broken.obj', mimeType: '', buffer: Buffer.from('v 0 0 zero\n') });
  await state(page, 'failed');
  assert.match(await page.textContent('#error'), /broken\.obj:1.*not a number/);
  assert.equal((await drawn(page, 'model')).share, 0); // of no other model
  await picture(page, 'broken');
  await page.click('aside button.example');
  await state(page, 'busy');
  await page.click('#run');
  await state(page, 'failed');
  assert.equal(await page.textContent('#error'), 'Stopped.');
  await page.click('#run');
  await state(page, 'done');
}

async function tryModel(page) {
  await page.setInputFiles('#choose', model);
  await state(page, 'done');
  await page.waitForTimeout(300);
  await picture(page, 'model');
  console.log((await page.textContent('#verdict')), (await page.innerText('#figures')).replace(/\n/g, ' '));
}

try {
  const page = browser.pages()[0] ?? (await browser.newPage());
  const errors = [];
  page.on('pageerror', (error) => errors.push(error.message));
  page.on('console', (message) => message.type() === 'error' && errors.push(message.text()));
  await page.goto(pathToFileURL(`${process.env.ATLAS_PACKAGE}/atlas.html`).href);
  await page.waitForSelector('body[data-ready]', { timeout: 60000 });
  if (model) await tryModel(page);
  else for (const step of [tryExample, tryDownloads, tryOptions, tryFaults]) {
    await step(page);
    console.log(`${step.name}: well`);
  }
  assert.deepEqual(errors, []);
} finally {
  await browser.close();
  rmSync(folder, { recursive: true, force: true });
}
