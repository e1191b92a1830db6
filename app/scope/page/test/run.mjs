// SPDX-License-Identifier: Apache-2.0
// Bundles every *.test.ts beside this file and runs them with node's own test runner.
//   node test/run.mjs OUTPUT_FOLDER
// GRABEN_DBC: folder of the DBC files, unless it is the tree's. GRABEN_TOOL: the program `graben`,
// which the page's mathematics is compared with.

import {spawnSync} from 'node:child_process';
import {mkdirSync, readdirSync} from 'node:fs';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';
import {bundle} from './bundle.mjs';

const here = dirname(fileURLToPath(import.meta.url));
const [out] = process.argv.slice(2);
if (out === undefined) {
  console.error('usage: node test/run.mjs OUTPUT_FOLDER');
  process.exit(2);
}
mkdirSync(out, {recursive: true});
const names = readdirSync(here).filter((name) => name.endsWith('.test.ts'));
await bundle(names.map((name) => join(here, name)), resolve(out));
const files = names.map((name) => join(resolve(out), name.replace(/\.ts$/, '.mjs')));
const done = spawnSync(process.execPath, ['--test', ...files], {stdio: 'inherit'});
process.exit(done.status ?? 1);
