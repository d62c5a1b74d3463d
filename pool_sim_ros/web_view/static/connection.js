// The websocket to the server; comes back by itself.

const FIRST_WAIT = 250; // ms
const LONGEST_WAIT = 4000;

export class Connection {
  // `onText(kind, content)`, `onFrame(Float64Array)`, `onOpen(bool)`
  constructor({ onText, onFrame, onOpen }) {
    Object.assign(this, { onText, onFrame, onOpen });
    this.wait = FIRST_WAIT;
    this.open();
  }

  open() {
    const url = new URL('socket', document.baseURI);
    url.protocol = url.protocol.replace('http', 'ws');
    const socket = new WebSocket(url);
    socket.binaryType = 'arraybuffer';
    socket.onopen = () => {
      this.wait = FIRST_WAIT;
      this.onOpen(true);
    };
    socket.onmessage = ({ data }) => {
      if (data instanceof ArrayBuffer) {
        this.onFrame(new Float64Array(data));
      } else {
        const { kind, content } = JSON.parse(data);
        this.onText(kind, content);
      }
    };
    socket.onclose = () => {
      this.onOpen(false);
      setTimeout(() => this.open(), this.wait);
      this.wait = Math.min(2 * this.wait, LONGEST_WAIT);
    };
    this.socket = socket;
  }

  // Returns whether it could be sent.
  send(command) {
    if (this.socket.readyState !== WebSocket.OPEN) return false;
    this.socket.send(JSON.stringify(command));
    return true;
  }
}
