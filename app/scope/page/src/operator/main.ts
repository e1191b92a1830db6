// SPDX-License-Identifier: Apache-2.0
import '../view/styles/theme.css';
import './operator.css';
import {start} from './operator';

const root = document.getElementById('app')!;
try {
  start(root);
} catch (error) {
  root.textContent = `The page could not be started: ${(error as Error).message}`;
  throw error;
}
