// SPDX-License-Identifier: Apache-2.0
/// What is saved of a plot: a file that the browser keeps. Nothing is sent anywhere.

import type {Columns} from '../basics/curves';

/// Twice the points: sharp in a text.
const SHARP = 2;

/// For names of files on any system.
export const file_name = (title: string, ending: string): string =>
  `${title.toLowerCase().replace(/[^a-z0-9]+/g, '_').replace(/^_|_$/g, '') || 'plot'}.${ending}`;

function keep(name: string, blob: Blob): void {
  const url = URL.createObjectURL(blob);
  const link = document.createElement('a');
  link.href = url;
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

export const save_text = (name: string, type: string, text: string): void =>
  keep(name, new Blob([text], {type}));

export async function save_png(name: string, svg: string): Promise<void> {
  const image = new Image();
  image.src = URL.createObjectURL(new Blob([svg], {type: 'image/svg+xml'}));
  await image.decode();
  const canvas = document.createElement('canvas');
  canvas.width = SHARP * image.naturalWidth;
  canvas.height = SHARP * image.naturalHeight;
  canvas.getContext('2d')!.drawImage(image, 0, 0, canvas.width, canvas.height);
  URL.revokeObjectURL(image.src);
  const blob = await new Promise<Blob | null>((done) => canvas.toBlob(done, 'image/png'));
  if (blob !== null) {
    keep(name, blob);
  }
}

/// A line for each time at which any of the values has one; no value: an empty field.
export function csv_of(heads: readonly string[], columns: Columns): string {
  const field = (head: string): string => (/[",\n]/.test(head) ? `"${head.replace(/"/g, '""')}"` : head);
  const [times, ...values] = columns;
  const rows = times.map((time_s, row) => [Number(time_s.toFixed(6)),
    ...values.map((column) => (column[row] == null ? '' : Number(column[row]!.toPrecision(9))))].join());
  return `${[heads.map(field).join(), ...rows].join('\n')}\n`;
}
