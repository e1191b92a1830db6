// SPDX-License-Identifier: Apache-2.0
/// Whose work is in this page beside ours, with the licences that have to come with it.

import candied from '../../../node_modules/candied/LICENSE?raw';
import three from '../../../node_modules/three/LICENSE?raw';
import uplot from '../../../node_modules/uplot/LICENSE?raw';
import {el} from './dom';

const NOTICES: readonly (readonly [string, string])[] =
  [['three.js', three], ['uPlot', uplot], ['candied', candied]];

export function notices(): HTMLElement {
  return el('details', {class: 'notices'},
    el('summary', {}, 'Licences: Graben is Apache-2.0; it carries three.js, uPlot and candied (MIT)'),
    ...NOTICES.flatMap(([name, licence]) => [el('h3', {}, name), el('pre', {}, licence.trim())]));
}
