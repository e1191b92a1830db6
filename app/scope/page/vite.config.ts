// SPDX-License-Identifier: Apache-2.0
import {resolve} from 'node:path';
import {defineConfig} from 'vite';
import {viteSingleFile} from 'vite-plugin-singlefile';

// The build makes one HTML file that needs nothing beside it: it is embedded in the program, and
// with a log inside it is a report that opens from disk. `--mode operator` makes the operator's
// view. The DBC files stay where the codecs are generated from them; a build elsewhere says where
// that is.
const dbc = process.env.GRABEN_DBC ?? resolve(process.cwd(), '../../../can_dbc');

export default defineConfig(({mode}) => ({
  plugins: [viteSingleFile()],
  resolve: {alias: {'@dbc': dbc}},
  server: {fs: {allow: ['.', dbc]}},
  build: {
    target: 'es2022', chunkSizeWarningLimit: 4000, emptyOutDir: false,
    rollupOptions: {input: mode === 'operator' ? 'operator.html' : 'index.html'},
  },
  worker: {format: 'iife'},
}));
