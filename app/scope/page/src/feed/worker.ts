// SPDX-License-Identifier: Apache-2.0
/// The scope's worker.

import {SteeringSocket} from './steering_socket';
import {work} from './worker_end';

work((url, batches, hear) => new SteeringSocket(url, batches, hear));
