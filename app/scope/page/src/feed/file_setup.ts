// SPDX-License-Identifier: Apache-2.0
/// What a setup is of a file that is opened in the page.

import type {Setup} from '../model/api';

/// Of a log's bus, which no log tells.
const ASSUMED_BITRATE = 500000;

/// Machines and words stay those that the page knows.
export function file_setup(last: Setup | null, file: {name: string; size: number}): Setup {
  return {
    source: {
      mode: 'log', name: file.name, bitrate: last?.source.bitrate ?? ASSUMED_BITRATE,
      // How long a packed text is, its file does not tell.
      ...(/\.gz$/i.test(file.name) ? {} : {bytes: file.size}),
    },
    machines: last?.machines ?? [],
    ...(last?.buses === undefined ? {} : {buses: last.buses}),
    words: last?.words ?? {fault: {}, why_not_armed: []},
  };
}
