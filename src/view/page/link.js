// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The connection to lio-view: it comes back by itself, and answers each frame, so that lio-view knows
// how fast this page is.
const FIRST_WAIT_MS = 250, LONGEST_WAIT_MS = 4000;

export class Link {
  // onState is told "open", "closed" (it will be tried again) and "refused" (the token is wrong).
  constructor({onFrame, onState}) {
    Object.assign(this, {onFrame, onState, wait: FIRST_WAIT_MS, numOpened: 0});
    this.query = new URLSearchParams(location.search).get("token");
    this.open();
  }

  address(path) {
    return path + (this.query ? `?token=${encodeURIComponent(this.query)}` : "");
  }

  open() {
    const url = new URL(this.address("data"), location.href);
    url.protocol = location.protocol === "https:" ? "wss:" : "ws:";
    const socket = this.socket = new WebSocket(url);
    let numFrames = 0;
    socket.binaryType = "arraybuffer";
    socket.onopen = () => {
      this.wait = FIRST_WAIT_MS;
      ++this.numOpened;
      this.onState("open");
    };
    socket.onmessage = ({data}) => {
      try {
        this.onFrame(data);
      } finally {
        socket.send(JSON.stringify({ack: ++numFrames}));
      }
    };
    socket.onclose = () => this.onClosed();
  }

  // A browser does not say why a WebSocket was refused; a plain request does.
  async onClosed() {
    let isRefused = false;
    try {
      isRefused = (await fetch(this.address("allowed"), {cache: "no-store"})).status === 401;
    } catch {
      // lio-view is not there, which "closed" says.
    }
    this.onState(isRefused ? "refused" : "closed");
    setTimeout(() => this.open(), this.wait);
    this.wait = Math.min(LONGEST_WAIT_MS, 2 * this.wait);
  }

  send(message) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }
}
