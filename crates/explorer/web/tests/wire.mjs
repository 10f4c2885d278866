/** What a page and its server say to each other, listened to from outside: PROTOCOL.md beside the crate explains it. */

const FRAME = 1;
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
  /** Frames of the body, the last ones. */
  frames = [];

  constructor(page) {
    page.on("websocket", (socket) => {
      socket.on("framesent", ({ payload }) => typeof payload === "string" && this.#say(payload));
      socket.on("framereceived", ({ payload }) => (typeof payload === "string" ? this.#hear(payload) : this.#take(payload)));
    });
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
    if (answer.is === "branch") this.branches.push(answer);
  }

  #take(bytes) {
    if (bytes[0] !== FRAME) return;
    this.frames.push(frame(bytes));
    if (this.frames.length > MOST) this.frames.shift();
  }
}

/** The body in a binary message. */
function frame(bytes) {
  const [samples, columns] = [bytes.readUInt16LE(2), bytes.readUInt16LE(4)];
  const [revision, coordinates] = [bytes.readUInt32LE(8), bytes.readUInt32LE(12)];
  const numbers = (from, count) => Array.from({ length: count }, (_, k) => bytes.readDoubleLE(HEADER + 8 * (from + k)));
  const [t, x, y, radius] = numbers(0, 4);
  const state = numbers(4, coordinates);
  const rows = Array.from({ length: samples }, (_, row) => numbers(4 + coordinates + row * columns, columns));
  return { revision, t, x, y, radius, state, rows };
}
