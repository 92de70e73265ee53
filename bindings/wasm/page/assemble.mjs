// SPDX-License-Identifier: MIT
// Puts the page into one file that works from a folder, without a server: node assemble.mjs PACKAGE FOLDER OUTPUT
import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

const [packageFolder, folder, output] = process.argv.slice(2);
const source = (name) => readFileSync(join(folder, name), 'utf8');
const ofPackage = (name) => readFileSync(join(packageFolder, name), 'utf8');

/** A module as a part of a script of several: what it imports stands before it. */
function part(text) {
  return text.replace(/^import [^;]*;$/gm, '').replace(/^export default [^;]*;$/gm, '').replace(/^export /gm, '');
}

/** Text that ends no script element. */
function inScript(text) {
  return text.replace(/<\/script/gi, '<\\/script');
}

// The module's loader finds its own address by that of its file, which a script in a page does not have.
const glue = part(ofPackage('atlas_module.js').replace(/export default (\w+);?\s*$/, 'const createModule = $1;'));
const library = part(ofPackage('index.js').replace(/^export {[^}]*} from [^;]*;$/gm, '')).replaceAll('import.meta.url', 'self.location.href');
const parts = {
  STYLE: source('style.css'),
  WORKER: inScript([glue, `(() => {${library}\n${source('worker.mjs')}})();`].join('\n')),
  WASM: readFileSync(join(packageFolder, 'atlas_module.wasm')).toString('base64'),
  PAGE: inScript(['view.mjs', 'example.mjs', 'page.mjs'].map((name) => part(source(name))).join('\n')),
};
writeFileSync(output, source('page.html').replace(/@@(\w+)@@/g, (_, name) => parts[name]));
