// The connection to the server: comes back by itself, and says so.
const AGAIN_MS = 500;
const SILENT_MS = 2000;

export class Link {
  constructor(onMessage, onState) {
    this.onMessage = onMessage;
    this.onState = onState;
    this.heard = performance.now();
    this.open();
    setInterval(() => this.check(), 500);
  }

  open() {
    const scheme = location.protocol === "https:" ? "wss:" : "ws:";
    const socket = new WebSocket(`${scheme}//${location.host}/live`);
    socket.binaryType = "arraybuffer";
    this.socket = socket;
    this.heard = performance.now();
    socket.onmessage = (event) => {
      if (socket !== this.socket) return;
      this.heard = performance.now();
      this.onMessage(parse(event.data));
    };
    socket.onclose = (event) => {
      if (socket !== this.socket) return;
      this.onState(event.code === 4401 ? "sign in" : "lost");
      setTimeout(() => { if (socket === this.socket) this.open(); }, AGAIN_MS);
    };
  }

  // A socket that says nothing is taken for dead; the server speaks several times a second.
  check() {
    if (performance.now() - this.heard < SILENT_MS) return;
    if (this.socket.readyState === WebSocket.CLOSED) return;
    this.onState("lost");
    this.reopen();
  }

  reopen() {
    const old = this.socket;
    this.open();
    old.close();
  }

  send(type, fields = {}) {
    if (this.socket.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify({ type, ...fields }));
    return true;
  }
}

// A binary message is the length of its JSON, 4 bytes with the lowest first, the JSON, and a JPEG.
export function parse(data) {
  if (typeof data === "string") return JSON.parse(data);
  const end = 4 + new DataView(data).getUint32(0, true);
  const message = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, end - 4)));
  message.jpeg = new Blob([new Uint8Array(data, end)], { type: "image/jpeg" });
  return message;
}
