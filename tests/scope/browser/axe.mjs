// SPDX-License-Identifier: Apache-2.0
/// What axe-core has to say of a page, in words.

import {readFileSync} from 'node:fs';
import {createRequire} from 'node:module';

/// Colour schemes and sizes of screen to look at: all, or for each day the light one at the largest and the smallest
/// and the dark one at the largest. A look takes two seconds.
export const looks_at_each = (sizes) => process.env.GRABEN_LOOKS === 'every' ? [['light', sizes], ['dark', sizes]]
  : [['light', [sizes[0], sizes.at(-1)]], ['dark', [sizes[0]]]];

const AXE = readFileSync(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

/// The page's context has to bypass the page's own policy.
export async function axe(page) {
  await page.evaluate((code) => {
    if (window.axe === undefined) (0, eval)(code);
  }, AXE);
  const {violations} = await page.evaluate(() => window.axe.run(document, {resultTypes: ['violations']}));
  return violations.map(({id, nodes}) => `${id}: ${nodes.slice(0, 3).map(({target, failureSummary}) =>
    `${target} ${failureSummary.split('\n')[1] ?? ''}`).join(' | ')}`);
}
