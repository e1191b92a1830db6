// SPDX-License-Identifier: Apache-2.0
// How long an hour of log takes: node test/hour.mjs. Figures, no test: they depend on the machine.

import {mkdtempSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {dirname, join} from 'node:path';
import {fileURLToPath, pathToFileURL} from 'node:url';
import {bundle} from './bundle.mjs';

const folder = mkdtempSync(join(tmpdir(), 'graben-hour-'));
try {
  await bundle([join(dirname(fileURLToPath(import.meta.url)), 'hour.ts')], folder);
  await import(pathToFileURL(join(folder, 'hour.mjs')).href);
} finally {
  rmSync(folder, {recursive: true});
}
