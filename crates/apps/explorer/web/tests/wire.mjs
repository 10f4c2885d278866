/** What a page and its server say to each other, listened to from outside: PROTOCOL.md beside the crate explains it. */

const FRAME = 1;
const CELLS = 2;
const SWARM = 4;
const HEADER = 16;
/** Frames that are kept. */
const MOST = 2000;

/** Listens to every WebSocket that the page opens. */
export class Wire {
  /** Verbs that the page sent, counted. */
  sent = new Map();
  /** What the page said last, of each verb. */
  said = new Map();
  /** Answers, the last of each kind. */
  last = new Map();
  /** Branches of motions, in the order in which they came. */
  branches = [];
  /** Cells of maps in the order in which they came: column and row. */
  cells = [];
  /** Motions of the bodies of a swarm. */
  members = new Map();
  /** Swarms: bodies with places and distances. */
  swarms = [];
  /** Frames of the body, the last ones. */
  frames = [];

  constructor(page) {
    page.on("websocket", (socket) => {
      socket.on("framesent", ({ payload }) => typeof payload === "string" && this.#say(payload));
      socket.on("framereceived", ({ payload }) => (typeof payload === "string" ? this.#hear(payload) : this.#take(payload)));
    });
  }

  /** Listens from inside the page, before it has begun: Firefox tells those who drive it nothing of a WebSocket. */
  async listenInside(page) {
    await page.exposeFunction("overheard", (messages) => {
      for (const { sent, text, base64 } of messages) {
        if (sent) this.#say(text);
        else if (base64) this.#take(Buffer.from(base64, "base64"));
        else this.#hear(text);
      }
    });
    await page.addInitScript(overhear);
  }

  /** How often the page said this. */
  count(verb) {
    return this.sent.get(verb) ?? 0;
  }

  /** The last frame of the body; `null` before the first. */
  get frame() {
    return this.frames.at(-1) ?? null;
  }

  #say(text) {
    if (!text.startsWith("{")) return; // a test's own nonsense
    const wish = JSON.parse(text);
    this.said.set(wish.do, wish);
    this.sent.set(wish.do, this.count(wish.do) + 1);
  }

  #hear(text) {
    const answer = JSON.parse(text);
    this.last.set(answer.is, answer);
    if (answer.is === "member") this.members.set(answer.body, answer.regime);
    if (answer.is === "branch") this.branches.push(answer);
  }

  #take(bytes) {
    if (bytes[0] === CELLS) for (let at = HEADER; at < bytes.length; at += HEADER) this.cells.push([bytes.readUInt16LE(at), bytes.readUInt16LE(at + 2)]);
    if (bytes[0] === SWARM) this.swarms.push(swarm(bytes));
    if (bytes[0] !== FRAME) return;
    this.frames.push(frame(bytes));
    if (this.frames.length > MOST) this.frames.shift();
  }
}

/** In the page: every message of every WebSocket goes to `overheard`, some at a time. */
function overhear() {
  const waiting = [];
  const pass = () => waiting.length && window.overheard(waiting.splice(0));
  window.setInterval(pass, 30);
  const base64 = (bytes) => btoa(Array.from(new Uint8Array(bytes), (byte) => String.fromCharCode(byte)).join(""));
  window.WebSocket = class extends window.WebSocket {
    constructor(...where) {
      super(...where);
      this.addEventListener("message", ({ data }) => waiting.push(typeof data === "string" ? { text: data } : { base64: base64(data) }));
    }

    send(text) {
      waiting.push({ sent: true, text });
      super.send(text);
    }
  };
}

/** The bodies of a swarm. */
function swarm(bytes) {
  const bodies = Array.from({ length: bytes.readUInt16LE(2) }, (_, k) => {
    const [x, y, distance] = [0, 1, 2].map((place) => bytes.readDoubleLE(HEADER + 8 + 24 * k + 8 * place));
    return { x, y, distance };
  });
  return Object.assign(bodies, { revision: bytes.readUInt32LE(8) });
}

/** The body in a binary message. */
function frame(bytes) {
  const [samples, columns] = [bytes.readUInt16LE(2), bytes.readUInt16LE(4)];
  const [revision, coordinates] = [bytes.readUInt32LE(8), bytes.readUInt32LE(12)];
  const numbers = (from, count) => Array.from({ length: count }, (_, k) => bytes.readDoubleLE(HEADER + 8 * (from + k)));
  const [t, x, y, radius] = numbers(0, 4);
  const state = numbers(4, coordinates);
  const points = bytes.readUInt16LE(6);
  const outline = Array.from({ length: points }, (_, k) => numbers(4 + coordinates + samples * columns + 2 * k, 2));
  const rows = Array.from({ length: samples }, (_, row) => numbers(4 + coordinates + row * columns, columns));
  return { revision, t, x, y, radius, state, rows, outline };
}
