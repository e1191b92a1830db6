// SPDX-License-Identifier: Apache-2.0
import 'uplot/dist/uPlot.min.css';
import './view/styles/theme.css';
import './view/styles/base.css';
import './view/styles/layout.css';
import './view/styles/panel.css';
import './view/styles/plots.css';
import './view/styles/print.css';
import {start} from './app';

const root = document.getElementById('app')!;
try {
  start(root);
} catch (error) {
  // A page that stays empty would say nothing of why.
  root.textContent = `The page could not be started: ${(error as Error).message}`;
  throw error;
}
