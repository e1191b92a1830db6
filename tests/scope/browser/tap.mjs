// SPDX-License-Identifier: Apache-2.0
/// Between a browser and a server: all that the browser says, down to the frames of its WebSockets.

import {connect, createServer} from 'node:net';

const OPCODES = {0: 'continuation', 1: 'text', 2: 'binary', 8: 'close', 9: 'ping', 10: 'pong'};

/// One connection's words, as they come.
class Ear {
  constructor(said) {
    this.said = said;
    this.rest = Buffer.alloc(0);
    this.is_socket = false;
  }

  hear(bytes) {
    this.rest = Buffer.concat([this.rest, bytes]);
    while (this.is_socket ? this.frame() : this.request());
  }

  request() {
    const end = this.rest.indexOf('\r\n\r\n');
    if (end < 0) return false;
    const head = this.rest.subarray(0, end).toString('latin1');
    this.rest = this.rest.subarray(end + 4);
    const [method, path] = head.split(' ');
    this.is_socket = /\r\nupgrade: *websocket/i.test(head);
    this.said.push(`${this.is_socket ? 'socket' : method} ${path}`);
    return true;
  }

  frame() {
    if (this.rest.length < 2) return false;
    const short = this.rest[1] & 0x7f;
    const long = short === 126 ? 2 : short === 127 ? 8 : 0;
    if (this.rest.length < 2 + long) return false;
    const size = long === 2 ? this.rest.readUInt16BE(2) : long === 8 ? Number(this.rest.readBigUInt64BE(2)) : short;
    const whole = 2 + long + 4 + size;  // a browser's are masked
    if (this.rest.length < whole) return false;
    this.said.push(`frame ${OPCODES[this.rest[0] & 0xf] ?? this.rest[0]}`);
    this.rest = this.rest.subarray(whole);
    return true;
  }
}

/// `said` grows while the browser uses `url` in place of the server's.
export async function tap(url) {
  const {hostname, port} = new URL(url);
  const said = [];
  const sockets = new Set();
  const server = createServer((browser) => {
    const ear = new Ear(said);
    const to = connect(Number(port), hostname);
    for (const socket of [browser, to]) {
      sockets.add(socket);
      socket.on('error', () => {});
      socket.on('close', () => { browser.destroy(); to.destroy(); });
    }
    browser.on('data', (bytes) => { ear.hear(bytes); to.write(bytes); });
    to.pipe(browser);
  });
  await new Promise((done) => server.listen(0, '127.0.0.1', done));
  return {url: `http://127.0.0.1:${server.address().port}/`, said, close: () => {
    server.close();
    sockets.forEach((socket) => socket.destroy());
  }};
}
