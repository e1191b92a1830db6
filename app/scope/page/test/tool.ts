// SPDX-License-Identifier: Apache-2.0
/// The program `graben`, which the page's mathematics and its reading of logs are compared with.

import {execFileSync} from 'node:child_process';
import {mkdtempSync, readFileSync, rmSync} from 'node:fs';
import {tmpdir} from 'node:os';
import {join} from 'node:path';

export function graben(...words: string[]): string {
  const tool = process.env.GRABEN_TOOL;
  if (tool === undefined || tool === '') {
    throw new Error('GRABEN_TOOL has to name the program graben');
  }
  return execFileSync(tool, words, {encoding: 'utf8', stdio: ['ignore', 'pipe', 'pipe']});
}

export const graben_json = (...words: string[]): any => JSON.parse(graben(...words));

/// The log of a run in memory: `dig`, `grade` or `autodig` with these options.
export function graben_log(task: string, ...options: string[]): Uint8Array {
  const folder = mkdtempSync(join(tmpdir(), 'graben-page-'));
  try {
    graben(task, '--out', folder, ...options);
    return new Uint8Array(readFileSync(join(folder, `${task}.log`)));
  } finally {
    rmSync(folder, {recursive: true});
  }
}
