// SPDX-License-Identifier: Apache-2.0
// What vite does for the page, as far as the model needs it: TypeScript into one module a file, and
// DBC files and styles as text.

import {readFileSync} from 'node:fs';
import {dirname, join, resolve} from 'node:path';
import {fileURLToPath} from 'node:url';
import {build} from 'esbuild';

const here = dirname(fileURLToPath(import.meta.url));
const dbc = process.env.GRABEN_DBC ?? resolve(here, '../../../../can_dbc');

const raw_dbc = {
  name: 'raw-dbc',
  setup(of) {
    of.onResolve({filter: /^@dbc\/.*\?raw$/}, ({path}) => ({
      path: join(dbc, path.slice('@dbc/'.length, -'?raw'.length)), namespace: 'raw-dbc'}));
    of.onResolve({filter: /\.css\?raw$/}, ({path, resolveDir}) => ({
      path: join(resolveDir, path.slice(0, -'?raw'.length)), namespace: 'raw-dbc'}));
    of.onLoad({filter: /.*/, namespace: 'raw-dbc'}, ({path}) => ({
      contents: readFileSync(path, 'utf8'), loader: 'text'}));
  },
};

export const bundle = (files, out) => build({
  entryPoints: files, outdir: out, bundle: true, platform: 'node', format: 'esm', target: 'node18',
  outExtension: {'.js': '.mjs'}, plugins: [raw_dbc], logLevel: 'warning', sourcemap: 'inline',
});
