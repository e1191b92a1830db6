// SPDX-License-Identifier: Apache-2.0
/// The worker of a page that only looks.

import {ServerSocket} from './socket';
import {work} from './worker_end';

work((url, batches, hear) => new ServerSocket(url, batches, hear));
