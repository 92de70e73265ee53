// SPDX-License-Identifier: MIT
// Does the work of the page, so that the page does not freeze. What index.js exports stands before it in one script.
/* global Initialize, Scene, self */
let scene = null;

function tell(kind, data = {}, transfer = []) {
  self.postMessage({ kind, ...data }, transfer);
}

function run({ name, bytes, options }) {
  scene?.delete();
  scene = new Scene();
  tell('progress', { stage: 'reading', fraction: 0 });
  scene.addFile(name, bytes);
  const model = scene.model(0);
  tell('model', { model });
  const start = performance.now();
  let told = 0;
  scene.generate(options, (stage, fraction) => {
    if (performance.now() - told < 50) return;
    told = performance.now();
    tell('progress', { stage, fraction });
  });
  const { report } = scene;
  tell('atlas', { result: scene.result(0), report, summary: scene.summary, seconds: (performance.now() - start) / 1000 });
}

const calls = {
  load: ({ wasm }) => Initialize(wasm),
  run,
  write: ({ format }) => tell('file', { format, bytes: scene.write(0, format) }),
};

self.onmessage = async ({ data }) => {
  try {
    await calls[data.kind](data);
    if (data.kind === 'load') tell('ready');
  } catch (error) {
    tell('error', { message: error.message });
  }
};
